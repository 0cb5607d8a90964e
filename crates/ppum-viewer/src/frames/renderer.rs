//! Computation of the values by a graphics card, as with `ppum render --backend`.

use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::thread::{self, JoinHandle};

use ppum::quantity::Quantity;
use ppum_gpu::{AdapterChoice, GpuError, Method, Program, RenderError, Renderer, Values};
use ppum_render::view::View;
pub use ppum_scene::backend::Backend;
use ppum_scene::values::{DrawingInput, PixelValues};
use self_cell::self_cell;

use super::subject::FrameSubject;
use crate::field::OwnedField;

self_cell!(
    struct CompiledSubject {
        owner: Arc<OwnedField>,
        #[not_covariant]
        dependent: CompiledProgram,
    }
);

type CompiledProgram<'f> = Program<'f, Values>;

/// A graphics card, opened when it is needed first. Opening it, uploading and compiling take
/// their time: a thread sees to them, and until it is done the processor draws.
pub(super) struct GraphicsCard {
    backend: Backend,
    /// The card, while it is open and here.
    renderer: Option<Box<Renderer>>,
    /// The subject that a thread prepares the card for.
    preparing: Option<(FrameSubject, JoinHandle<OpenCard>)>,
    /// True once it is known that there is none of use.
    is_missing: bool,
    /// The last subject, compiled; none if it cannot be.
    compiled: Option<(FrameSubject, Option<CompiledSubject>)>,
    /// The reason why the processor draws in its place.
    pub(super) note: Option<String>,
}

/// The card, if it is open, and the subject compiled on it.
type OpenCard = (Option<Box<Renderer>>, Result<CompiledSubject, RenderError>);

/// True once it is known that this machine has no card: each look for one keeps some megabytes
/// of the drivers for good.
static HAS_NO_CARD: AtomicBool = AtomicBool::new(false);

impl GraphicsCard {
    pub(super) fn new(backend: Backend) -> Self {
        let is_missing = match backend {
            Backend::Cpu => true,
            Backend::Auto => HAS_NO_CARD.load(Ordering::Relaxed),
            Backend::Gpu | Backend::Splat => false,
        };
        let (renderer, preparing, compiled) = (None, None, None);
        Self { backend, renderer, preparing, is_missing, compiled, note: None }
    }

    /// True if the card draws, which needs no rough images.
    pub(super) fn is_open(&self) -> bool {
        self.renderer.is_some() && !matches!(self.compiled, Some((_, None)))
    }

    /// True while a thread has the card.
    pub(super) fn is_away(&self) -> bool {
        self.preparing.is_some()
    }

    /// The values, and what drew them; nothing if the processor has to.
    pub(super) fn draw(
        &mut self,
        subject: &FrameSubject,
        DrawingInput { field, view, quantity }: DrawingInput<'_>,
    ) -> Option<PixelValues> {
        // each part of the whole of a half has a quantity of its own
        if subject.is_mirrored() || self.backend.needs_processor(field, quantity) {
            return None;
        }
        if self.compiled.as_ref().is_none_or(|(known, _)| known != subject) {
            self.prepare(subject, view, quantity);
        }
        let method = self.method();
        let renderer = self.renderer.as_mut()?;
        let (_, Some(compiled)) = self.compiled.as_mut()? else { return None };
        let drawn = compiled.with_dependent_mut(|_, program| {
            renderer.draw(program, view).and_then(|drawn| drawn.read())
        });
        match drawn {
            Ok(raster) => {
                let way = if method == Method::Splat { "gpu splat f32" } else { "gpu f32" };
                let by = format!("{way}, {}", renderer.gpu().info().name);
                Some(PixelValues::new(raster, field, view, &by))
            }
            Err(error) => {
                self.give_up(subject.clone(), &error.into());
                None
            }
        }
    }

    /// Takes the card back from a thread that is done.
    pub(super) fn look(&mut self) {
        let is_ready = |(_, thread): &mut (_, JoinHandle<_>)| thread.is_finished();
        let Some((subject, thread)) = self.preparing.take_if(is_ready) else { return };
        let lost = |_| (None, Err(GpuError::Lost.into()));
        let (renderer, compiled) = thread.join().unwrap_or_else(lost);
        (self.is_missing, self.renderer) = (renderer.is_none(), renderer);
        match compiled {
            Ok(compiled) => self.compiled = Some((subject, Some(compiled))),
            Err(error) => self.give_up(subject, &error),
        }
    }

    /// Has the card prepared for a subject, if there is one and it is here.
    fn prepare(&mut self, subject: &FrameSubject, view: &View, quantity: &Quantity) {
        if self.is_missing || self.preparing.is_some() {
            return;
        }
        let renderer = self.renderer.take();
        (self.compiled, self.note) = (None, None);
        let auto = self.backend == Backend::Auto;
        let choice = if auto { AdapterChoice::Real } else { AdapterChoice::Any };
        let (method, field) = (self.method(), Arc::clone(&subject.field));
        let (view, quantity) = (*view, quantity.clone());
        let thread = thread::spawn(move || {
            let opened = renderer.map_or_else(|| Renderer::open(choice).map(Box::new), Ok);
            match opened {
                Err(error) => (None, Err(error.into())),
                Ok(mut renderer) => {
                    let compiled = compiled(&mut renderer, field, &quantity, method, &view);
                    (Some(renderer), compiled)
                }
            }
        });
        self.preparing = Some((subject.clone(), thread));
    }

    fn method(&self) -> Method {
        if self.backend == Backend::Splat { Method::Splat } else { Method::Gather }
    }

    /// Leaves a subject to the processor, or everything if the device is of no use.
    fn give_up(&mut self, subject: FrameSubject, error: &RenderError) {
        let is_missing = matches!(error, RenderError::Gpu(GpuError::NoAdapter { .. }));
        let is_normal = self.backend == Backend::Auto && is_missing;
        HAS_NO_CARD.fetch_or(is_normal, Ordering::Relaxed);
        if !is_normal && !matches!(error, RenderError::Quantity(_)) {
            let lines: Vec<_> =
                error.to_string().lines().map(|line| line.trim().to_owned()).collect();
            self.note = Some(format!("drawn by the processor: {}", lines.join(" ")));
        }
        if matches!(
            error,
            RenderError::Gpu(GpuError::Lost | GpuError::Device { .. } | GpuError::Memory { .. })
        ) {
            (self.renderer, self.is_missing) = (None, true);
        }
        self.compiled = Some((subject, None));
    }
}

/// A field on the card, and a quantity of it compiled and ready for a view.
fn compiled(
    renderer: &mut Renderer,
    field: Arc<OwnedField>,
    quantity: &Quantity,
    method: Method,
    view: &View,
) -> Result<CompiledSubject, RenderError> {
    CompiledSubject::try_new(field, |field| {
        let scene = renderer.upload(field.field())?;
        let mut program = renderer.compile(&scene, Values(quantity.clone()), method)?;
        renderer.prepare(&mut program, view)?;
        Ok(program)
    })
}
