//! Table 1 of Üffinger et al. 2011 beside what draws here, and what else drawing depends on.
//!
//! Before anything is measured, every frame is compared with the reference ([`agreement`]). Then scenes and
//! ways take turns, each frame with a view of its own, as in [`super::renderer`].

mod agreement;
mod chart;
mod files;
mod scenes;
mod tables;

use std::path::Path;

use anyhow::{Context as _, ensure};
use ppum::dataset::Dataset;
use ppum::field::Field;
use ppum::progress::{Phase, Progress, Watcher, unwatched};
use ppum::quantity::Quantity;
use ppum_render::raster::Raster;
use ppum_render::scatter::render;
use ppum_render::view::View;
use rayon::ThreadPool;
use serde::Serialize;

use super::frames::{Subject, Summary, Times, WAYS, Way, moved, style};
use super::machine::Machine;
use super::synthetic::{DOMAIN, Recipe};
use super::table::Table;
use crate::graphics::Cards;
use crate::output::Output;
use crate::progress::Bar;
use agreement::{Agreement, WRONG, agreements};
use files::Opening;
use scenes::{Group, Scene, scenes};

/// Table 1: patches, milliseconds.
const PAPER: [(usize, f64); 6] =
    [(16, 2.33), (64, 2.38), (256, 2.48), (1024, 2.89), (4096, 4.76), (16384, 11.76)];

/// The paper's milliseconds for a uniform cover.
pub(super) fn published(patches: usize) -> Option<f64> {
    PAPER.iter().find(|row| row.0 == patches).map(|row| row.1)
}

/// The report of `ppum bench paper`.
#[derive(Debug, Serialize)]
pub(super) struct Report {
    machine: Machine,
    pixels: [u32; 2],
    frames: u32,
    rows: Vec<Row>,
    files: Vec<Opening>,
    /// True if all frames are right, and all controls caught.
    holds: bool,
}

/// A scene.
#[derive(Debug, Serialize)]
struct Row {
    group: Group,
    scene: String,
    cover: &'static str,
    patches: usize,
    order: u8,
    enriched: f64,
    zoom: f64,
    quantity: &'static str,
    /// The paper's time, milliseconds on a GeForce GTX 470.
    paper_ms: Option<f64>,
    methods: Vec<Timed>,
}

/// The frames of a scene by one way.
#[derive(Debug, Serialize)]
struct Timed {
    method: &'static str,
    /// On one thread, of what the CPU draws.
    one: Option<Spent>,
    /// On all threads; none if there is one only.
    all: Option<Spent>,
    /// How many times faster all threads are, by medians of time that passes.
    gain: Option<f64>,
    agreement: Option<Agreement>,
}

#[derive(Clone, Copy, Debug, Serialize)]
struct Spent {
    wall_ms: Summary,
    /// Processor time of all threads; not of hardware, which has other processors.
    core_ms: Option<Summary>,
}

/// One thread, and all of them if there are more.
struct Pools {
    one: ThreadPool,
    all: Option<ThreadPool>,
}

impl Pools {
    fn new(threads: usize) -> anyhow::Result<Self> {
        let pool = |n| rayon::ThreadPoolBuilder::new().num_threads(n).build();
        Ok(Self { one: pool(1)?, all: (threads > 1).then(|| pool(threads)).transpose()? })
    }

    /// The one that is fastest.
    fn most(&self) -> &ThreadPool {
        self.all.as_ref().unwrap_or(&self.one)
    }
}

/// A scene with all that draws it, and what its frames take.
struct Measured<'d> {
    scene: Scene,
    subject: Subject<'d>,
    /// What the colours of the first view are made of.
    rasters: Option<(Raster<f64>, Raster<f32>)>,
    agreements: [Option<Agreement>; 4],
    one: [Times; 4],
    all: [Times; 4],
}

impl Report {
    /// Compares and measures; `quick` takes small pictures of few patches.
    pub(super) fn new(quick: bool, frames: u32, threads: usize) -> anyhow::Result<Self> {
        let pixels = if quick { [256, 192] } else { [1024, 768] };
        let mut cards = Cards::open();
        let machine = Machine::new(threads, cards.as_ref());
        let (pools, scenes) = (Pools::new(threads)?, scenes(quick));
        let datasets = pools.most().install(|| Datasets::new(&scenes))?;
        let fields = datasets.fields()?;
        let mut cards = cards.as_mut().ok();
        let mut all = Vec::new();
        for &scene in &scenes {
            let field = datasets.field(&scene.recipe, &fields)?;
            // shaders take their time to compile: a quick run has those of the first scenes
            let on_devices =
                scene.group == Group::Patches || !quick && scene.group != Group::Colors;
            let mut cards = cards.as_deref_mut().filter(|_| on_devices);
            let mut measured = Measured::new(scene, field, cards.as_deref_mut())?;
            measured.compare(pixels, &pools, cards)?;
            all.push(measured);
        }
        measure(&mut all, frames, pixels, &pools, cards.as_deref_mut())?;
        let opened = || Opening::all(quick, pixels, cards.as_deref_mut());
        let files = pools.most().install(opened)?;
        let has_core = cards.as_ref().is_none_or(|cards| cards.is_software());
        let rows: Vec<Row> = all.iter().map(|measured| measured.row(has_core, !quick)).collect();
        let holds = rows.iter().flat_map(|row| &row.methods).all(Timed::is_good);
        Ok(Self { machine, pixels, frames, rows, files, holds })
    }

    pub(super) fn tables(&self) -> Vec<Table> {
        tables::tables(self)
    }

    /// What was measured, and how.
    pub(super) fn words(&self) -> String {
        tables::words(self)
    }

    pub(super) fn chart(
        &self,
        path: &Path,
        is_silent: bool,
        out: &mut Output,
    ) -> anyhow::Result<()> {
        chart::save(self, path, is_silent, out)
    }

    /// An error if a frame was wrong, or a wrong one not noticed: then times mean nothing.
    pub(super) fn verdict(&self) -> anyhow::Result<()> {
        ensure!(
            self.holds,
            "a frame is not what the reference shows, or a wrong derivative was not noticed: see the table of differences"
        );
        Ok(())
    }
}

/// The datasets of some scenes, each once.
struct Datasets(Vec<(Recipe, Dataset)>);

impl Datasets {
    fn new(scenes: &[Scene]) -> anyhow::Result<Self> {
        let mut all: Vec<(Recipe, Dataset)> = Vec::new();
        for Scene { recipe, .. } in scenes {
            if all.iter().all(|(known, _)| known != recipe) {
                all.push((*recipe, recipe.dataset()?));
            }
        }
        Ok(Self(all))
    }

    fn fields(&self) -> anyhow::Result<Vec<Field<'_>>> {
        Ok(self.0.iter().map(|(_, dataset)| Field::new(dataset, 0)).collect::<Result<_, _>>()?)
    }

    fn field<'d>(&self, recipe: &Recipe, fields: &'d [Field<'d>]) -> anyhow::Result<&'d Field<'d>> {
        let mut all = self.0.iter().zip(fields);
        let found = all.find(|((known, _), _)| known == recipe);
        found.map(|(_, field)| field).context("every scene has a dataset")
    }
}

/// Draws all scenes in turn, first without counting: the first frames find nothing prepared.
fn measure(
    all: &mut [Measured<'_>],
    frames: u32,
    pixels: [u32; 2],
    pools: &Pools,
    mut cards: Option<&mut Cards>,
) -> anyhow::Result<()> {
    let (bar, scenes) = (Bar::new(), all.len());
    let watcher: &dyn Watcher = &bar;
    let total = (frames as usize + 1) * scenes;
    for frame in 0..=frames {
        for (k, measured) in all.iter_mut().enumerate() {
            watcher.report(Progress::new(Phase::Evaluation, frame as usize * scenes + k, total))?;
            let view = measured.view(frame, pixels)?;
            measured.draw_all(&view, pools, cards.as_deref_mut(), frame > 0)?;
        }
    }
    Ok(())
}

impl<'d> Measured<'d> {
    fn new(scene: Scene, field: &'d Field<'d>, cards: Option<&mut Cards>) -> anyhow::Result<Self> {
        let quantity = Quantity::parse(scene.subject.quantity(), field)?;
        let may_splat = scene.group == Group::Patches;
        let subject = Subject::new(field, (quantity, style(scene.zoom)), cards, may_splat)?;
        let (one, all) = Default::default();
        Ok(Self { scene, subject, rasters: None, agreements: [None; 4], one, all })
    }

    fn view(&self, frame: u32, pixels: [u32; 2]) -> anyhow::Result<View> {
        let (center, width) = (self.scene.center(), DOMAIN.size().x / self.scene.zoom);
        moved(View::new(center, width, pixels)?, frame)
    }

    /// Compares with the reference, or makes what is coloured.
    fn compare(
        &mut self,
        pixels: [u32; 2],
        pools: &Pools,
        cards: Option<&mut Cards>,
    ) -> anyhow::Result<()> {
        let (view, subject) = (self.view(0, pixels)?, &self.subject);
        if self.scene.subject == scenes::Subject::Colors {
            let (field, quantity) = (subject.field, &subject.quantity);
            let wide = render(field, &view, quantity, unwatched())?;
            self.rasters = Some((wide, render(field, &view, quantity, unwatched())?));
            return Ok(());
        }
        let recipe = Recipe { weight: Some(WRONG), ..self.scene.recipe };
        let wrong = (self.scene.group == Group::Patches).then(|| recipe.dataset()).transpose()?;
        let wrong = wrong.as_ref().map(|dataset| Field::new(dataset, 0)).transpose()?;
        self.agreements =
            pools.most().install(|| agreements(subject, wrong.as_ref(), &view, cards))?;
        Ok(())
    }

    fn draw_all(
        &mut self,
        view: &View,
        pools: &Pools,
        mut cards: Option<&mut Cards>,
        counts: bool,
    ) -> anyhow::Result<()> {
        for (k, way) in WAYS.into_iter().enumerate() {
            if !way.is_on_cpu() {
                self.all[k].take(counts, || self.subject.draw(way, view, cards.as_deref_mut()))?;
                continue;
            }
            let (subject, rasters) = (&mut self.subject, self.rasters.as_ref());
            self.one[k]
                .take(counts, || pools.one.install(|| on_cpu(subject, rasters, way, view)))?;
            if let Some(pool) = &pools.all {
                self.all[k]
                    .take(counts, || pool.install(|| on_cpu(subject, rasters, way, view)))?;
            }
        }
        Ok(())
    }

    fn row(&self, has_core: bool, has_paper: bool) -> Row {
        let Scene { group, recipe, zoom, subject } = self.scene;
        let patches = self.subject.field.step.partition.len();
        let is_published = has_paper && group == Group::Patches && self.scene.cover() == "uniform";
        let timed = (0..WAYS.len()).filter_map(|k| self.timed(k, has_core)).collect();
        Row {
            group,
            scene: self.scene.words(),
            cover: self.scene.cover(),
            patches,
            order: recipe.order,
            enriched: recipe.enriched,
            zoom,
            quantity: subject.quantity(),
            paper_ms: published(patches).filter(|_| is_published),
            methods: timed,
        }
    }

    fn timed(&self, k: usize, has_core: bool) -> Option<Timed> {
        let has_core = WAYS[k].is_on_cpu() || has_core;
        let spent = |times: &Times| {
            let core_ms = has_core.then(|| times.core());
            Spent { wall_ms: times.wall(), core_ms }
        };
        let [one, all] =
            [&self.one[k], &self.all[k]].map(|times| (!times.is_empty()).then(|| spent(times)));
        let gain = one.zip(all).map(|(one, all)| one.wall_ms.median / all.wall_ms.median);
        one.or(all)?;
        Some(Timed { method: WAYS[k].name(), one, all, gain, agreement: self.agreements[k] })
    }
}

/// Draws, or colours alone.
fn on_cpu(
    subject: &mut Subject<'_>,
    rasters: Option<&(Raster<f64>, Raster<f32>)>,
    way: Way,
    view: &View,
) -> anyhow::Result<bool> {
    match rasters {
        None => return subject.draw(way, view, None),
        Some((wide, _)) if way == Way::CpuF64 => subject.color(wide, view)?,
        Some((_, narrow)) => subject.color(narrow, view)?,
    }
    Ok(true)
}

impl Timed {
    fn is_good(&self) -> bool {
        self.agreement.is_none_or(|agreement| agreement.is_good())
    }
}

impl Row {
    fn method(&self, way: Way) -> Option<&Timed> {
        self.methods.iter().find(|timed| timed.method == way.name())
    }
}
