//! Drawing scenes, and surviving the loss of the device.

pub(crate) mod pending;
mod targets;

use std::collections::BTreeMap;
use std::sync::Arc;

use ppum::field::Field;
use ppum::progress::{Phase, Progress, Watcher};
use ppum::quantity::Quantity;
use ppum_render::raster::Raster;
use ppum_render::view::View;

use crate::choice::AdapterChoice;
use crate::device::Gpu;
use crate::device::read;
use crate::error::{GpuError, RenderError};
use crate::frame::areas::{PixelArea, areas};
use crate::frame::geometry::{PairGeometry, check_size};
use crate::frame::quads::quads;
use crate::frame::shading::TransferFunction;
use crate::frame::view_data::ViewData;
use crate::program::Program;
use crate::program::output::Output;
use crate::program::output::Values;
use crate::scene::bodies::Others;
use crate::scene::card::Card;
use crate::scene::{OnCard, Scene};
use crate::shader::passes::Method;
use pending::QueuedOutput;
use targets::Targets;

/// Draws fields on a graphics device.
///
/// A [`Scene`] is a field on the card, a [`Program`] a quantity of it compiled, which draws any
/// view. When the device is lost, the next call opens another one, uploads and compiles again, and
/// goes on. So it does with scenes and programs of another renderer.
#[derive(Debug)]
pub struct Renderer {
    card: Card,
    choice: AdapterChoice,
    targets: Targets,
}

impl Renderer {
    /// Opens a device.
    ///
    /// # Errors
    /// [`GpuError::NoAdapter`] if there is none of the choice; see [`Gpu::open`].
    pub fn open(choice: AdapterChoice) -> Result<Self, GpuError> {
        Ok(Self::new(Gpu::open(choice)?, choice))
    }

    /// A renderer on an open device; a choice for the one after its loss.
    #[must_use]
    pub fn new(gpu: Gpu, choice: AdapterChoice) -> Self {
        Self { card: Card::new(gpu), choice, targets: Targets::default() }
    }

    /// The device that draws.
    #[must_use]
    pub fn gpu(&self) -> &Gpu {
        &self.card.gpu
    }

    /// Takes data of at most this many rows of 128 KiB, so that a test can see too many.
    #[doc(hidden)]
    pub fn limit_rows(&mut self, rows: u32) {
        self.card.rows = rows.min(self.gpu().limits().max_texture_dimension_2d);
    }

    /// Puts a field on the card. Linear in its coefficients.
    ///
    /// # Errors
    /// [`GpuError::TooLarge`] if it does not fit into a texture: 1 GiB on any device, 2 GiB on
    /// most.
    pub fn upload<'f>(&mut self, field: &'f Field<'f>) -> Result<Scene<'f>, GpuError> {
        self.again(|renderer| Scene::new(&renderer.card, field))
    }

    /// Compiles an output for a scene. A program compiled before keeps drawing if this one fails.
    /// Areas of an image that need less than the whole program get their own when they are seen
    /// first.
    ///
    /// # Errors
    /// A formula that is too large for a shader; quantities that single precision cannot show, or
    /// that have no meaning for the field; splatting on a device that cannot.
    pub fn compile<'f, O: Output>(
        &mut self,
        scene: &Scene<'f>,
        output: O,
        method: Method,
    ) -> Result<Program<'f, O>, RenderError> {
        let mut program = Program::new(scene, output, method)?;
        let layout = scene.on_card().layout;
        self.again(|renderer| {
            let kind = program.kind(layout.shape.others);
            program.pipelines(&renderer.card.gpu, layout, [kind]).map(|_| ())
        })?;
        Ok(program)
    }

    /// Sees to it that no image has to wait for a shader: compiles a program for all kinds of
    /// areas, and draws some of a view with each, as drivers may leave the rest to the first
    /// image. Waits until all is done.
    ///
    /// # Errors
    /// As [`Renderer::draw`].
    pub fn prepare<O: Output>(
        &mut self,
        program: &mut Program<'_, O>,
        view: &View,
    ) -> Result<(), GpuError> {
        self.check_size(view)?;
        self.again(|renderer| renderer.draw_areas(program, view, pixels_of_all))?;
        self.wait()
    }

    /// Draws a view.
    ///
    /// # Errors
    /// See [`GpuError`]. A lost device is replaced; [`GpuError::Lost`] comes only if that fails
    /// twice.
    pub fn draw<O: Output>(
        &mut self,
        program: &mut Program<'_, O>,
        view: &View,
    ) -> Result<QueuedOutput<O>, GpuError> {
        self.check_size(view)?;
        let areas_of = |_: &Program<'_, O>, on_card: &OnCard| areas(view, &on_card.enriched);
        self.again(|renderer| renderer.draw_areas(program, view, areas_of))
    }

    /// The values of a quantity at the pixel centres of a view: uploads, compiles, draws and reads.
    /// The watcher is told between these, and can stop the call there.
    ///
    /// # Errors
    /// See [`RenderError`].
    pub fn render(
        &mut self,
        field: &Field<'_>,
        view: &View,
        quantity: &Quantity,
        method: Method,
        watcher: &dyn Watcher,
    ) -> Result<Raster<f32>, RenderError> {
        let report = |done| watcher.report(Progress::new(Phase::Evaluation, done, STAGES));
        report(0)?;
        let scene = self.upload(field)?;
        report(1)?;
        let mut program = self.compile(&scene, Values(quantity.clone()), method)?;
        report(2)?;
        let drawn = self.draw(&mut program, view)?;
        report(3)?;
        let raster = drawn.read()?;
        report(STAGES)?;
        Ok(raster)
    }

    /// Waits until everything begun is drawn.
    ///
    /// # Errors
    /// [`GpuError::Device`] for anything that failed meanwhile.
    pub fn wait(&self) -> Result<(), GpuError> {
        read::wait(self.gpu())
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

    fn reopen(&mut self) -> Result<(), GpuError> {
        self.card.gpu = Arc::new(Gpu::open(self.choice)?);
        self.targets = Targets::default();
        Ok(())
    }

    fn check_size(&self, view: &View) -> Result<(), GpuError> {
        let (pixels, most) = (view.pixels, self.gpu().limits().max_texture_dimension_2d);
        if pixels[0].max(pixels[1]) > most {
            return Err(GpuError::PictureTooLarge { pixels, most });
        }
        Ok(())
    }

    /// Draws the areas of a view that `areas_of` makes of what is on the card.
    fn draw_areas<O: Output>(
        &mut self,
        program: &mut Program<'_, O>,
        view: &View,
        areas_of: impl Fn(&Program<'_, O>, &OnCard) -> Vec<PixelArea>,
    ) -> Result<QueuedOutput<O>, GpuError> {
        let scene = program.scene().clone();
        let mut on_card = scene.on_card();
        on_card.bring(&self.card, &scene, view)?;
        let layout = on_card.layout;
        let is_gathered = program.method() == Method::Gather;
        let whole = || vec![PixelArea::whole(view, layout.shape.others)];
        let areas = if is_gathered { areas_of(program, &on_card) } else { whole() };
        let frame = view_data(&scene, &on_card, program, view)?;
        let palette = program.output().shading().map(TransferFunction::texels);
        let gpu = &self.card.gpu;
        let areas: Vec<_> = areas.iter().map(|area| (*area, program.kind(area.others))).collect();
        let pipelines = program.pipelines(gpu, layout, areas.iter().map(|(_, kind)| *kind))?;
        let targets = &mut self.targets;
        gpu.checked("draw", || {
            targets.prepare(gpu, view.pixels, pipelines, palette);
            targets.write(gpu, &frame);
            let data = targets.data(gpu, &on_card, pipelines)?;
            let mut encoder = gpu.device().create_command_encoder(&Default::default());
            if let Some(passes) = &pipelines.passes {
                let (words, count) = quads(scene.field(), view, &on_card.bodies);
                targets.sum(gpu, &mut encoder, passes, &data, (&words, count));
            }
            let drawn = targets.finish(gpu, &mut encoder, pipelines, (&data, &areas), &O::FINISH);
            gpu.queue().submit([encoder.finish()]);
            Ok(QueuedOutput::new(gpu, drawn, view.pixels))
        })?
    }
}

/// A pixel for each kind of area that a scene may have.
fn pixels_of_all<O: Output>(program: &Program<'_, O>, on_card: &OnCard) -> Vec<PixelArea> {
    let all = on_card.layout.shape.others;
    let mixed = [false, all.constants].into_iter().flat_map(|constants| {
        let with = move |polynomials| Others { constants, polynomials, group: None };
        [false, all.polynomials].map(with)
    });
    let alone = on_card.enriched.iter().map(|(_, others)| *others);
    let kinds: BTreeMap<_, _> = mixed.chain(alone).map(|o| (program.kind(o), o)).collect();
    kinds.into_values().map(PixelArea::pixel).collect()
}

/// Stages of [`Renderer::render`].
const STAGES: usize = 4;

/// A view of a scene as shaders read it.
fn view_data<O: Output>(
    scene: &Scene<'_>,
    on_card: &OnCard,
    program: &Program<'_, O>,
    view: &View,
) -> Result<ViewData, GpuError> {
    let field = scene.field();
    let frames = scene.groups().frames(&field.step.functions);
    let geometry = PairGeometry::new(field.step, field.domain, &frames, view.center);
    let region = on_card.region()?;
    let mut data = ViewData::new(field, view, geometry, region, on_card.half());
    check_size(data.pairs.len())?;
    if let Some(shading) = program.output().shading() {
        shading.note(&mut data.record);
    }
    if let Some(patch) = program.drawn_patch() {
        data.record.chosen = on_card.bodies[patch as usize];
    }
    Ok(data)
}
