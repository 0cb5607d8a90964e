//! Frame times of the renderers beside table 1 of Üffinger et al. 2011, and their dependence on
//! order, enrichment, zoom and formulas.
//!
//! Before anything is measured, every frame is compared with the reference (`agreement`). Then
//! scenes and renderers alternate frame by frame, each frame with a different view, so that other
//! load on the machine slows all of them down alike.

mod agreement;
mod chart;
mod files;
mod report;
mod scenes;
mod single;
mod tables;
mod turns;

use std::path::Path;

use anyhow::{Context as _, ensure};
use ppum::dataset::Dataset;
use ppum::field::Field;
use ppum::progress::unwatched;
use ppum::quantity::Quantity;
use ppum_render::scatter::render;
use ppum_render::view::View;

use crate::cards::BenchDevice;
use crate::frames::{DrawingDevice, QuantityRenderer, moved, style};
use crate::machine::Machine;
use crate::synthetic::{CrackRecipe, DOMAIN};
use crate::table::ReportTable;
use agreement::{Agreement, WRONG, agreements};
use files::OpeningTime;
pub use report::PaperReport;
use report::{SceneRow, pixels_of};
pub use scenes::SceneGroup;
use scenes::{PaperScene, scenes};
pub use single::Single;
use turns::{FrameTiming, Pools, Turns};

/// Table 1: patches, milliseconds.
const PAPER: [(usize, f64); 6] =
    [(16, 2.33), (64, 2.38), (256, 2.48), (1024, 2.89), (4096, 4.76), (16384, 11.76)];

/// The paper's milliseconds for a uniform cover.
fn published(patches: usize) -> Option<f64> {
    PAPER.iter().find(|row| row.0 == patches).map(|row| row.1)
}

/// A scene with all that draws it.
struct MeasuredScene<'d> {
    scene: PaperScene,
    turns: Turns<'d>,
    agreements: [Option<Agreement>; 4],
}

impl PaperReport {
    /// Compares and measures all scenes, or those of some groups; `quick` takes small images of few
    /// patches.
    ///
    /// # Errors
    /// A device that fails, or files that cannot be written.
    pub fn new(quick: bool, frames: u32, groups: &[SceneGroup]) -> anyhow::Result<Self> {
        let (threads, pixels) = (rayon::current_num_threads(), pixels_of(quick));
        let mut cards = BenchDevice::open();
        let machine = Machine::new(threads, cards.as_ref());
        let (pools, mut scenes) = (Pools::new(threads)?, scenes(quick));
        scenes.retain(|scene| groups.is_empty() || groups.contains(&scene.group));
        let datasets = pools.most().install(|| Datasets::new(&scenes))?;
        let fields = datasets.fields()?;
        let mut cards = cards.as_mut().ok();
        let mut all = Vec::new();
        for &scene in &scenes {
            let field = datasets.field(&scene.recipe, &fields)?;
            // shaders are slow to compile: a quick run compiles those of the first scenes only
            let on_devices =
                scene.group == SceneGroup::Patches || !quick && scene.group != SceneGroup::Colors;
            let mut cards = cards.as_deref_mut().filter(|_| on_devices);
            let mut measured = MeasuredScene::new(scene, field, cards.as_deref_mut())?;
            measured.compare(pixels, &pools, cards)?;
            all.push(measured);
        }
        measure(&mut all, frames, pixels, &pools, cards.as_deref_mut())?;
        let opened = || OpeningTime::all(quick, pixels, cards.as_deref_mut());
        let files = groups.is_empty().then(|| pools.most().install(opened)).transpose()?;
        let has_core = cards.as_ref().is_none_or(|cards| cards.is_software());
        let rows: Vec<SceneRow> =
            all.iter().map(|measured| measured.row(has_core, !quick)).collect();
        let holds = rows.iter().flat_map(|row| &row.methods).all(FrameTiming::is_good);
        Ok(Self { machine, pixels, frames, rows, files: files.unwrap_or_default(), holds })
    }

    /// Draws the times against the patches.
    ///
    /// # Errors
    /// A file that cannot be written.
    pub fn chart(&self, path: &Path) -> anyhow::Result<()> {
        chart::save(self, path)
    }
}

impl crate::Report for PaperReport {
    fn tables(&self) -> Vec<ReportTable> {
        tables::tables(self)
    }

    fn words(&self) -> String {
        tables::words(self)
    }

    /// An error if a frame was wrong, or a wrong one not noticed: then times mean nothing.
    fn verdict(&self) -> anyhow::Result<()> {
        ensure!(
            self.holds,
            "a frame is not what the reference shows, or a wrong derivative was not noticed: see the table of differences"
        );
        Ok(())
    }
}

/// The datasets of some scenes, each once.
struct Datasets(Vec<(CrackRecipe, Dataset)>);

impl Datasets {
    fn new(scenes: &[PaperScene]) -> anyhow::Result<Self> {
        let mut all: Vec<(CrackRecipe, Dataset)> = Vec::new();
        for PaperScene { recipe, .. } in scenes {
            if all.iter().all(|(known, _)| known != recipe) {
                all.push((*recipe, recipe.dataset()?));
            }
        }
        Ok(Self(all))
    }

    fn fields(&self) -> anyhow::Result<Vec<Field<'_>>> {
        Ok(self.0.iter().map(|(_, dataset)| Field::new(dataset, 0)).collect::<Result<_, _>>()?)
    }

    fn field<'d>(
        &self,
        recipe: &CrackRecipe,
        fields: &'d [Field<'d>],
    ) -> anyhow::Result<&'d Field<'d>> {
        let mut all = self.0.iter().zip(fields);
        let found = all.find(|((known, _), _)| known == recipe);
        found.map(|(_, field)| field).context("every scene has a dataset")
    }
}

/// Draws all scenes in turn. The first frame of each warms up and is not counted.
fn measure(
    all: &mut [MeasuredScene<'_>],
    frames: u32,
    pixels: [u32; 2],
    pools: &Pools,
    mut cards: Option<&mut BenchDevice>,
) -> anyhow::Result<()> {
    for frame in 0..=frames {
        eprintln!("frame {frame} of {frames}");
        for measured in &mut *all {
            let view = measured.view(frame, pixels)?;
            measured.turns.draw_all(&view, pools, cards.as_deref_mut(), frame > 0)?;
        }
    }
    Ok(())
}

impl<'d> MeasuredScene<'d> {
    fn new(
        scene: PaperScene,
        field: &'d Field<'d>,
        cards: Option<&mut BenchDevice>,
    ) -> anyhow::Result<Self> {
        let quantity = Quantity::parse(scene.subject.quantity(), field)?;
        let may_splat = scene.group == SceneGroup::Patches;
        let subject =
            QuantityRenderer::new(field, (quantity, style(scene.zoom)), cards, may_splat)?;
        Ok(Self { scene, turns: Turns::new(subject), agreements: [None; 4] })
    }

    fn view(&self, frame: u32, pixels: [u32; 2]) -> anyhow::Result<View> {
        let (center, width) = (self.scene.center(), DOMAIN.size().x / self.scene.zoom);
        moved(View::new(center, width, pixels)?, frame)
    }

    /// Compares the frames with the reference; for scenes of colours alone, makes their rasters.
    fn compare(
        &mut self,
        pixels: [u32; 2],
        pools: &Pools,
        cards: Option<&mut BenchDevice>,
    ) -> anyhow::Result<()> {
        let (view, subject) = (self.view(0, pixels)?, &self.turns.subject);
        if self.scene.subject == scenes::SceneQuantity::Colors {
            let (field, quantity) = (subject.field, &subject.quantity);
            let wide = render(field, &view, quantity, unwatched())?;
            self.turns.rasters = Some((wide, render(field, &view, quantity, unwatched())?));
            return Ok(());
        }
        let recipe = CrackRecipe { weight: Some(WRONG), ..self.scene.recipe };
        let wrong =
            (self.scene.group == SceneGroup::Patches).then(|| recipe.dataset()).transpose()?;
        let wrong = wrong.as_ref().map(|dataset| Field::new(dataset, 0)).transpose()?;
        self.agreements =
            pools.most().install(|| agreements(subject, wrong.as_ref(), &view, cards))?;
        Ok(())
    }

    fn row(&self, has_core: bool, has_paper: bool) -> SceneRow {
        let PaperScene { group, recipe, zoom, subject } = self.scene;
        let patches = self.turns.subject.field.step.partition.len();
        let is_published =
            has_paper && group == SceneGroup::Patches && self.scene.cover() == "uniform";
        SceneRow {
            group,
            scene: self.scene.words(),
            cover: self.scene.cover(),
            patches,
            order: recipe.order,
            enriched: recipe.enriched,
            zoom,
            quantity: subject.quantity(),
            paper_ms: published(patches).filter(|_| is_published),
            methods: self.turns.timed(has_core, &self.agreements),
        }
    }
}

impl SceneRow {
    fn method(&self, way: DrawingDevice) -> Option<&FrameTiming> {
        self.methods.iter().find(|timed| timed.method == way.name())
    }
}
