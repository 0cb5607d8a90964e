//! Drawing scenes, and surviving the loss of the device.

use std::collections::BTreeSet;

use ppum::field::Field;
use ppum::quantity::{Quantity, QuantityError};
use ppum_render::view::View;
#[cfg(not(target_arch = "wasm32"))]
use ppum_render::{image::Image, raster::Raster};
use wgpu::Texture;

use crate::adapter::Choice;
use crate::areas::{Area, areas};
use crate::color::Shading;
use crate::device::Gpu;
use crate::error::GpuError;
use crate::geometry::Geometry;
use crate::program::{Method, Output, Program};
use crate::quads::quads;
#[cfg(not(target_arch = "wasm32"))]
use crate::read;
use crate::scene::Scene;
use crate::seen::Seen;
use crate::targets::Targets;

/// Why a picture was not drawn.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum RenderError {
    /// The graphics card could not.
    #[error(transparent)]
    Gpu(#[from] GpuError),
    /// The quantity has no meaning for the field.
    #[error(transparent)]
    Quantity(#[from] QuantityError),
}

/// Draws fields on a graphics device.
///
/// A [`Scene`] is a field on the card, a [`Program`] a quantity compiled; any program of a scene draws any
/// view of it. Either may be replaced while the other stays. When the device is lost, the next call
/// opens another one, uploads and compiles anew, and goes on.
///
/// ```no_run
/// use ppum::{dataset::Dataset, field::Field, quantity::Quantity};
/// use ppum_gpu::{Choice, Method, Renderer};
/// use ppum_render::view::View;
///
/// fn largest_stress(dataset: &Dataset, view: &View) -> Result<f64, Box<dyn std::error::Error>> {
///     let field = Field::new(dataset, 0)?;
///     let mut renderer = Renderer::open(Choice::Any)?;
///     let stress = renderer.render(&field, view, &Quantity::VonMises, Method::Gather)?;
///     Ok(stress.statistics().max)
/// }
/// ```
#[derive(Debug)]
#[cfg_attr(target_arch = "wasm32", allow(dead_code, reason = "a page opens devices by itself"))]
pub struct Renderer {
    gpu: Gpu,
    choice: Choice,
    /// Counts the devices that were opened: what was made for another one is made anew.
    generation: u64,
    /// Most rows of a texture of data.
    rows: u32,
    targets: Targets,
}

/// A picture on the card. Reading it waits until it is drawn; drawing goes on meanwhile, so the next
/// one, of the next step say, can be begun before.
#[derive(Debug)]
#[cfg_attr(
    target_arch = "wasm32",
    allow(dead_code, reason = "a page cannot wait for pictures yet")
)]
pub struct Drawn {
    pub(crate) textures: Vec<Texture>,
    pub(crate) size: [u32; 2],
}

impl Renderer {
    /// Opens a device.
    ///
    /// # Errors
    /// [`GpuError::NoAdapter`] if there is none of the choice; see [`Gpu::open`].
    #[cfg(not(target_arch = "wasm32"))]
    pub fn open(choice: Choice) -> Result<Self, GpuError> {
        Ok(Self::new(Gpu::open(choice)?, choice))
    }

    /// A renderer on an open device; a choice for the one after its loss.
    #[must_use]
    pub fn new(gpu: Gpu, choice: Choice) -> Self {
        let rows = gpu.limits().max_texture_dimension_2d;
        Self { gpu, choice, generation: 0, rows, targets: Targets::default() }
    }

    /// The device that draws.
    #[must_use]
    pub fn gpu(&self) -> &Gpu {
        &self.gpu
    }

    /// Takes data of at most this many rows of 128 KiB, so that a test can see too many.
    #[doc(hidden)]
    pub fn limit_rows(&mut self, rows: u32) {
        self.rows = rows.min(self.gpu.limits().max_texture_dimension_2d);
    }

    /// Puts a field on the card. Linear in its coefficients.
    ///
    /// # Errors
    /// [`GpuError::TooLarge`] if it does not fit into a texture: 1 GiB on any device, 2 GiB on most.
    pub fn upload(&mut self, field: &Field<'_>) -> Result<Scene, GpuError> {
        self.again(|renderer| Scene::new(&renderer.gpu, renderer.generation, field, renderer.rows))
    }

    /// Compiles a quantity for a scene. The functions and the weight are those of `field`, the one that was
    /// uploaded or the same with [replaced](ppum::replace) functions: nothing is uploaded again, and a program
    /// compiled before keeps drawing if this one fails. Areas of a picture that need less than the whole program
    /// get their own when they are seen first.
    ///
    /// # Errors
    /// A formula that is too large for a shader; quantities that single precision cannot show; splatting on
    /// a device that cannot.
    pub fn compile(
        &mut self,
        scene: &Scene,
        field: &Field<'_>,
        quantity: &Quantity,
        method: Method,
        output: Output,
    ) -> Result<Program, RenderError> {
        quantity.check(field)?;
        scene.check(field)?;
        if let Output::Component(component) = output
            && usize::from(component) >= field.components()
        {
            let message = format!("there is no component {component}, counted from 0");
            return Err(GpuError::Unsupported(message).into());
        }
        let mut program = Program::new(&scene.groups, field, quantity, method, output)?;
        self.again(|renderer| {
            let all = BTreeSet::from([scene.layout.shape.others]);
            program.made(&renderer.gpu, renderer.generation, scene.layout, &all).map(|_| ())
        })?;
        Ok(program)
    }

    /// Draws a view of a scene. `field` is the one whose functions the program has.
    ///
    /// # Errors
    /// See [`GpuError`]. A lost device is replaced; [`GpuError::Lost`] comes only if that fails twice.
    ///
    /// [`GpuError::Unsupported`] if the program writes colours and there is no shading.
    pub fn draw(
        &mut self,
        scene: &mut Scene,
        program: &mut Program,
        field: &Field<'_>,
        view: &View,
        shading: Option<&Shading>,
    ) -> Result<Drawn, GpuError> {
        scene.check(field)?;
        self.check_size(view)?;
        if program.output == Output::Colors && shading.is_none() {
            let message = "a program that writes colours needs a shading to draw";
            return Err(GpuError::Unsupported(message.to_owned()));
        }
        self.again(|renderer| {
            if scene.generation != renderer.generation {
                *scene = scene.renewed(&renderer.gpu, renderer.generation, field, renderer.rows)?;
            }
            renderer.draw_once(scene, program, field, view, shading)
        })
    }

    /// The values of a quantity at the pixel centres of a view: uploads, compiles, draws and reads.
    ///
    /// # Errors
    /// See [`RenderError`].
    #[cfg(not(target_arch = "wasm32"))]
    pub fn render(
        &mut self,
        field: &Field<'_>,
        view: &View,
        quantity: &Quantity,
        method: Method,
    ) -> Result<Raster<f32>, RenderError> {
        let mut scene = self.upload(field)?;
        let mut program = self.compile(&scene, field, quantity, method, Output::Values)?;
        let drawn = self.draw(&mut scene, &mut program, field, view, None)?;
        Ok(self.raster(&drawn)?)
    }

    /// The values of a picture that was drawn with [`Output::Values`].
    ///
    /// # Errors
    /// The device is lost, with the picture.
    #[cfg(not(target_arch = "wasm32"))]
    pub fn raster(&self, drawn: &Drawn) -> Result<Raster<f32>, GpuError> {
        let bytes = self.bytes(drawn, 0)?;
        Ok(Raster::new(drawn.size, read::floats(&bytes)))
    }

    /// The colours of a picture that was drawn with [`Output::Colors`].
    ///
    /// # Errors
    /// As [`raster`](Self::raster).
    #[cfg(not(target_arch = "wasm32"))]
    pub fn image(&self, drawn: &Drawn) -> Result<Image, GpuError> {
        Ok(Image { size: drawn.size, rgba: self.bytes(drawn, 0)? })
    }

    /// Value, gradient and Hessian of a picture that was drawn with [`Output::Component`]: v, x, y, xx, xy, yy.
    ///
    /// # Errors
    /// As [`raster`](Self::raster).
    #[cfg(not(target_arch = "wasm32"))]
    pub fn component(&self, drawn: &Drawn) -> Result<[Raster<f32>; 6], GpuError> {
        let [first, second] =
            [read::floats(&self.bytes(drawn, 0)?), read::floats(&self.bytes(drawn, 1)?)];
        let of = |k: usize| {
            let from = if k < 4 { &first } else { &second };
            Raster::new(drawn.size, from.iter().skip(k % 4).step_by(4).copied().collect())
        };
        Ok(std::array::from_fn(of))
    }

    /// Waits until everything begun is drawn.
    ///
    /// # Errors
    /// What went wrong meanwhile.
    #[cfg(not(target_arch = "wasm32"))]
    pub fn wait(&self) -> Result<(), GpuError> {
        read::wait(&self.gpu)
    }

    #[cfg(not(target_arch = "wasm32"))]
    fn bytes(&self, drawn: &Drawn, texture: usize) -> Result<Vec<u8>, GpuError> {
        let Some(texture) = drawn.textures.get(texture) else {
            let message = "the picture was drawn with another output than is read".to_owned();
            return Err(GpuError::Unsupported(message));
        };
        let bytes = read::texture(&self.gpu, texture)?;
        self.gpu.verdict()?;
        Ok(bytes)
    }

    /// Does something, once more on a new device if the old one turns out to be lost.
    fn again<T>(
        &mut self,
        mut f: impl FnMut(&mut Self) -> Result<T, GpuError>,
    ) -> Result<T, GpuError> {
        match f(self) {
            Err(GpuError::Lost) => {
                self.reopen()?;
                f(self)
            }
            result => result,
        }
    }

    #[cfg(not(target_arch = "wasm32"))]
    fn reopen(&mut self) -> Result<(), GpuError> {
        self.gpu = Gpu::open(self.choice)?;
        self.generation += 1;
        self.targets = Targets::default();
        Ok(())
    }

    /// A page opens the next device by itself: it has to wait for it.
    #[cfg(target_arch = "wasm32")]
    fn reopen(&mut self) -> Result<(), GpuError> {
        Err(GpuError::Lost)
    }

    fn check_size(&self, view: &View) -> Result<(), GpuError> {
        let most = self.gpu.limits().max_texture_dimension_2d;
        let [columns, rows] = view.pixels;
        if columns.max(rows) <= most {
            return Ok(());
        }
        Err(GpuError::Unsupported(format!(
            "a picture of {columns}x{rows} pixels: this graphics device draws at most {most}x{most}; \
             use `--backend cpu`"
        )))
    }

    fn draw_once(
        &mut self,
        scene: &mut Scene,
        program: &mut Program,
        field: &Field<'_>,
        view: &View,
        shading: Option<&Shading>,
    ) -> Result<Drawn, GpuError> {
        scene.place(&self.gpu, field, view, self.rows)?;
        let (method, output, chosen) = (program.method, program.output, program.chosen);
        let areas = match method {
            Method::Gather => areas(view, &scene.enriched),
            Method::Splat => vec![Area::whole(view, scene.layout.shape.others)],
        };
        let kinds = areas.iter().map(|area| area.others).collect();
        let made = program.made(&self.gpu, self.generation, scene.layout, &kinds)?;
        let seen = seen(scene, field, view, (output, chosen), shading)?;
        let gpu = &self.gpu;
        let targets = &mut self.targets;
        let drawn = gpu.checked("draw", || -> Result<Drawn, GpuError> {
            targets.prepare(gpu, view.pixels, made, method, shading);
            targets.write(gpu, &seen);
            let data = targets.data(gpu, scene, made)?;
            let mut encoder = gpu.device().create_command_encoder(&Default::default());
            if method == Method::Splat {
                let (words, count) = quads(field, view, &scene.bodies);
                targets.splat(gpu, &mut encoder, made, &data, (&words, count));
            }
            let drawn = targets.finish(gpu, &mut encoder, made, (&data, &areas), output);
            gpu.queue().submit([encoder.finish()]);
            Ok(drawn)
        })??;
        Ok(drawn)
    }
}

/// A view of a scene as shaders read it.
fn seen(
    scene: &Scene,
    field: &Field<'_>,
    view: &View,
    (output, chosen): (Output, Option<u32>),
    shading: Option<&Shading>,
) -> Result<Seen, GpuError> {
    let place = scene.placed()?;
    let frames = scene.groups.frames(&field.step.functions);
    let geometry = Geometry::new(field.step, field.domain, &frames, view.center);
    let mut seen = Seen::new(field, view, geometry, place, scene.lattice.as_ref());
    if let Output::Component(component) = output {
        seen.record.component = component.into();
    }
    if let Some(patch) = chosen {
        seen.record.chosen = scene.bodies[patch as usize];
    }
    if let Some(shading) = shading {
        shading.note(&mut seen.record);
    }
    Ok(seen)
}
