//! Computation of the values by the processor or a graphics card, as with `ppum render --backend`.

use ppum::progress::Watcher;
use ppum_render::RasterError;
use ppum_render::scatter::render;
use ppum_scene::drawing::{DrawingInput, PROCESSOR, PixelValues};
pub use ppum_scene::engine::Backend;

use super::subject::FrameSubject;

/// Draws values by a backend.
pub(super) struct ValueRenderer {
    cards: cards::GraphicsCard,
}

impl ValueRenderer {
    pub(super) fn new(backend: Backend) -> Self {
        Self { cards: cards::GraphicsCard::new(backend) }
    }

    /// True if a card draws, which needs no rough images.
    pub(super) fn has_card(&self) -> bool {
        self.cards.is_open()
    }

    /// True while a card is being prepared.
    pub(super) fn is_away(&self) -> bool {
        self.cards.is_away()
    }

    /// Sees whether the card is prepared.
    pub(super) fn look(&mut self) {
        self.cards.take_back();
    }

    /// The reason why no card draws, if one was to.
    pub(super) fn note(&self) -> Option<&str> {
        self.cards.note.as_deref()
    }

    /// Draws the values of a quantity; by the processor, in double precision, what no card can.
    pub(super) fn draw(
        &mut self,
        subject: &FrameSubject,
        job: DrawingInput<'_>,
        watcher: &dyn Watcher,
    ) -> Result<PixelValues, RasterError> {
        let DrawingInput { field, view, quantity } = job;
        if let Some((raster, by)) = self.cards.draw(subject, job) {
            return Ok(PixelValues::new(raster, field, view, &by));
        }
        Ok(PixelValues::new(render::<f64>(field, view, quantity, watcher)?, field, view, PROCESSOR))
    }
}

mod cards {
    use std::sync::Arc;
    use std::sync::atomic::{AtomicBool, Ordering};
    use std::thread::{self, JoinHandle};

    use ppum::quantity::Quantity;
    use ppum_gpu::{AdapterChoice, GpuError, Method, Program, RenderError, Renderer, Values};
    use ppum_render::raster::Raster;
    use ppum_render::view::View;
    use ppum_scene::drawing::DrawingInput;
    use self_cell::self_cell;

    use super::Backend;
    use crate::field::OwnedField;
    use crate::frames::subject::FrameSubject;

    type Pictures<'f> = Program<'f, Values>;

    self_cell!(
        struct CompiledSubject {
            owner: Arc<OwnedField>,
            #[not_covariant]
            dependent: Pictures,
        }
    );

    /// A graphics card, opened when it is needed first. Opening it, uploading and compiling take
    /// their time: a thread sees to them, and until it is done the processor draws.
    pub(super) struct GraphicsCard {
        backend: Backend,
        card: CardState,
        /// The last subject, compiled; none if it cannot be.
        compiled: Option<(FrameSubject, Option<CompiledSubject>)>,
        /// The reason why the processor draws in its place.
        pub(super) note: Option<String>,
    }

    enum CardState {
        Unopened,
        Open(Box<Renderer>),
        /// Prepared for a subject by a thread.
        Away(FrameSubject, JoinHandle<OpenCard>),
        None,
    }

    /// The card, if it is open, and the subject compiled on it.
    type OpenCard = (Option<Box<Renderer>>, Result<CompiledSubject, RenderError>);

    /// True once it is known that this machine has no card: each look for one keeps some megabytes
    /// of the drivers for good.
    static HAS_NO_CARD: AtomicBool = AtomicBool::new(false);

    impl GraphicsCard {
        pub(super) fn new(backend: Backend) -> Self {
            let none = match backend {
                Backend::Cpu => true,
                Backend::Auto => HAS_NO_CARD.load(Ordering::Relaxed),
                Backend::Gpu | Backend::Splat => false,
            };
            let card = if none { CardState::None } else { CardState::Unopened };
            Self { backend, card, compiled: None, note: None }
        }

        pub(super) fn is_open(&self) -> bool {
            matches!(self.card, CardState::Open(_)) && !matches!(self.compiled, Some((_, None)))
        }

        /// True while a thread has the card.
        pub(super) fn is_away(&self) -> bool {
            matches!(self.card, CardState::Away(..))
        }

        /// The values, and what drew them; nothing if the processor has to.
        pub(super) fn draw(
            &mut self,
            subject: &FrameSubject,
            DrawingInput { field, view, quantity }: DrawingInput<'_>,
        ) -> Option<(Raster<f32>, String)> {
            // each part of the whole of a half has a quantity of its own
            if subject.is_mirrored() || self.backend.needs_processor(field, quantity) {
                return None;
            }
            if self.compiled.as_ref().is_none_or(|(known, _)| known != subject) {
                self.prepare(subject, view, quantity);
            }
            match self.try_draw(view) {
                Ok(drawn) => drawn,
                Err(error) => {
                    self.give_up(subject.clone(), &error);
                    None
                }
            }
        }

        /// Takes the card back from a thread that is done.
        pub(super) fn take_back(&mut self) {
            if !matches!(&self.card, CardState::Away(_, thread) if thread.is_finished()) {
                return;
            }
            let CardState::Away(subject, thread) =
                std::mem::replace(&mut self.card, CardState::None)
            else {
                return;
            };
            let lost = |_| (None, Err(GpuError::Lost.into()));
            let (renderer, compiled) = thread.join().unwrap_or_else(lost);
            self.card = renderer.map_or(CardState::None, CardState::Open);
            match compiled {
                Ok(compiled) => self.compiled = Some((subject, Some(compiled))),
                Err(error) => self.give_up(subject, &error),
            }
        }

        /// Has the card prepared for a subject, if there is one and it is here.
        fn prepare(&mut self, subject: &FrameSubject, view: &View, quantity: &Quantity) {
            let renderer = match std::mem::replace(&mut self.card, CardState::None) {
                CardState::Unopened => None,
                CardState::Open(renderer) => Some(renderer),
                other => {
                    self.card = other;
                    return;
                }
            };
            (self.compiled, self.note) = (None, None);
            let auto = self.backend == Backend::Auto;
            let choice = if auto { AdapterChoice::Real } else { AdapterChoice::Any };
            let (method, field) = (self.method(), Arc::clone(&subject.field.0));
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
            self.card = CardState::Away(subject.clone(), thread);
        }

        fn method(&self) -> Method {
            if self.backend == Backend::Splat { Method::Splat } else { Method::Gather }
        }

        fn try_draw(&mut self, view: &View) -> Result<Option<(Raster<f32>, String)>, RenderError> {
            let method = self.method();
            let (CardState::Open(renderer), Some((_, Some(compiled)))) =
                (&mut self.card, &mut self.compiled)
            else {
                return Ok(None);
            };
            let raster = compiled.with_dependent_mut(|_, program| {
                renderer.draw(program, view).and_then(|drawn| drawn.read())
            })?;
            let way = if method == Method::Splat { "gpu splat f32" } else { "gpu f32" };
            Ok(Some((raster, format!("{way}, {}", renderer.gpu().info().name))))
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
                RenderError::Gpu(
                    GpuError::Lost | GpuError::Device { .. } | GpuError::Memory { .. }
                )
            ) {
                self.card = CardState::None;
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
}
