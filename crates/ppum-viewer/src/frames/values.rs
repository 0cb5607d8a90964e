//! Values at the pixels: the whole picture, and a rough one that is there sooner.

use std::sync::Arc;
use std::time::Instant;

use ppum::progress::Watcher;
use ppum_render::RenderError;
use ppum_render::resample::norms::Norms;
use ppum_render::samples::Samples;
use ppum_render::scatter::render;
use ppum_render::view::View;
use ppum_scene::deformed;
use ppum_scene::drawing::{BodyView, Drawn, PROCESSOR, Shown};
use ppum_scene::engine::Engine;
use ppum_scene::shot::{Asked, FieldSource};

use super::Fault;
use super::memo::Memo;
use super::renderer::Renderer;
use super::stop::StageEnd;
use super::strips::{Shift, moved};
use super::subject::{FrameSubject, OwnedSeen, SubjectView};

/// What may take longer has a rough picture first \[s\].
const QUICK: f64 = 0.02;
/// Pixels of the view, in each direction, for one of a coarse picture.
const COARSE: u32 = 4;

/// Draws values, and keeps those of the last place.
pub(super) struct ValueCache {
    pub(super) renderer: Renderer,
    pub(super) whole: Memo<SubjectView, Arc<Drawn>>,
    pub(super) rough: Memo<SubjectView, Arc<Drawn>>,
    /// Pixels of rough pictures that were drawn.
    pub(super) pixels: usize,
    seen: Memo<SubjectView, Arc<OwnedSeen>>,
    /// How far the two sides of the last difference are from each other.
    norms: Memo<FrameSubject, Norms>,
    pace: Pace,
}

/// Seconds a pixel, as the last pictures of a subject took.
#[derive(Debug, Default)]
struct Pace {
    subject: Option<FrameSubject>,
    whole: Option<f64>,
    single: Option<f64>,
}

impl ValueCache {
    pub(super) fn new(renderer: Renderer) -> Self {
        Self {
            renderer,
            whole: Memo::default(),
            rough: Memo::default(),
            pixels: 0,
            seen: Memo::default(),
            norms: Memo::default(),
            pace: Pace::default(),
        }
    }

    /// True if a place needs a rough picture: it may take long, or one moves on before it could
    /// be done.
    pub(super) fn needs_rough(&self, target: &SubjectView, is_moving: bool) -> bool {
        let is_quick =
            self.pace.of(&target.subject).whole.is_some_and(|pace| is_quick(pace, &target.view));
        // differences and mirrored plates are the processor's
        let is_for_card = target.subject.minus.is_none() && !target.subject.is_mirrored();
        let has_card = self.renderer.has_card() && is_for_card;
        !is_quick || is_moving && !has_card
    }

    /// Draws all that is to be seen.
    pub(super) fn draw_whole(
        &mut self,
        target: &SubjectView,
        watcher: &dyn Watcher,
    ) -> Result<Arc<Drawn>, StageEnd> {
        let start = Instant::now();
        if target.subject.minus.is_none() {
            self.norms = Memo::default();
        }
        let FrameSubject { field, shown, factor, .. } = &target.subject;
        let drawn = match (&*shown.0, factor) {
            _ if target.subject.minus.is_some() => self.draw_minus(target, watcher)?,
            _ if target.subject.is_mirrored() => self.draw_mirrored(target, watcher)?,
            (shown, Some(_)) => {
                let seen = self.seen(target, watcher)?;
                deform(seen.seen(), shown, watcher)?
            }
            (Shown::Quantity(quantity), None) => {
                let drawn = self.renderer.draw(&target.subject, &target.view, quantity, watcher);
                drawn.map_err(StageEnd::at(Fault::Quantity))?
            }
            (Shown::Cells(_, values), None) => {
                Drawn::of_cells(values, field.0.field(), &target.view)
            }
        };
        self.pace.of_mut(&target.subject).whole = Some(per_pixel(start, &target.view));
        let drawn = Arc::new(drawn);
        self.whole.set(target.clone(), Arc::clone(&drawn));
        Ok(drawn)
    }

    /// The whole of a half, by the processor.
    fn draw_mirrored(
        &mut self,
        target: &SubjectView,
        watcher: &dyn Watcher,
    ) -> Result<Drawn, StageEnd> {
        let (seen, owned) = (self.seen(target, watcher)?, &target.subject.field.0);
        let source = FieldSource::of(owned.dataset(), owned.field());
        let asked = Asked { shown: Shown::clone(&target.subject.shown.0), name: String::new() };
        let input = source.input(&asked, seen.seen());
        let drawn = input.values(Samples::CENTER, &Engine::processor(watcher));
        drawn.map_err(StageEnd::at(Fault::Mirror))
    }

    fn draw_minus(
        &mut self,
        target: &SubjectView,
        watcher: &dyn Watcher,
    ) -> Result<Drawn, StageEnd> {
        let minus = target.subject.minus().expect("a subject with something to subtract");
        let apart = minus.draw(&target.view, watcher).map_err(StageEnd::at(Fault::Minus))?;
        self.norms.set(target.subject.clone(), apart.norms);
        Ok(apart.drawn)
    }

    /// How far the two sides of a difference are from each other, in the view that was last
    /// drawn whole.
    pub(super) fn norms(&self, subject: &FrameSubject) -> Option<Norms> {
        self.norms.get(subject)
    }

    /// Draws what is soon done: strips beside what was seen before, all in single precision, or a
    /// coarse picture.
    pub(super) fn draw_rough(
        &mut self,
        target: &SubjectView,
        watcher: &dyn Watcher,
    ) -> Result<Arc<Drawn>, StageEnd> {
        let drawn = match (&*target.subject.shown.0, target.subject.factor) {
            _ if target.subject.minus.is_some() => self.draw_soon(target, |subject, view| {
                let minus = subject.minus().expect("a subject with something to subtract");
                minus.draw(view, watcher).map(|apart| apart.drawn)
            })?,
            _ if target.subject.is_mirrored() => {
                let coarse = SubjectView { view: coarse(&target.view), ..target.clone() };
                self.draw_mirrored(&coarse, watcher)?
            }
            (Shown::Quantity(quantity), None) => self.draw_soon(target, |subject, view| {
                let field = subject.field.0.field();
                if !subject.bears_single() {
                    let raster = render::<f64>(field, view, quantity, watcher)?;
                    return Ok(Drawn::new(raster, field, view, PROCESSOR));
                }
                let raster = render::<f32>(field, view, quantity, watcher)?;
                Ok(Drawn::new(raster, field, view, "cpu f32"))
            })?,
            (Shown::Cells(_, values), None) => {
                Drawn::of_cells(values, target.subject.field.0.field(), &coarse(&target.view))
            }
            (shown, Some(_)) => {
                let coarse = SubjectView { view: coarse(&target.view), ..target.clone() };
                let seen =
                    OwnedSeen::new(&coarse, watcher).map_err(StageEnd::at(Fault::Deformed))?;
                deform(seen.seen(), shown, watcher)?
            }
        };
        let drawn = Arc::new(drawn);
        self.rough.set(target.clone(), Arc::clone(&drawn));
        Ok(drawn)
    }

    /// Draws strips, all of it or a coarse picture, by what draws the pixels of a view.
    fn draw_soon(
        &mut self,
        target: &SubjectView,
        pixels_of: impl Fn(&FrameSubject, &View) -> Result<Drawn, RenderError>,
    ) -> Result<Drawn, StageEnd> {
        let mut pixels = 0;
        let mut draw = |view: &View| -> Result<Drawn, RenderError> {
            pixels += view.pixels.iter().map(|&n| n as usize).product::<usize>();
            pixels_of(&target.subject, view)
        };
        let (start, beside) = (Instant::now(), self.beside(target));
        let view = self.affordable(target);
        let (drawn, is_beside) = match &beside {
            Some((old, shift)) => (moved(old, *shift, &mut draw), true),
            None => (draw(&view), false),
        };
        let drawn = drawn.map_err(StageEnd::at(Fault::Quantity))?;
        self.pixels += pixels;
        if !is_beside {
            self.pace.of_mut(&target.subject).single = Some(per_pixel(start, &view));
        }
        Ok(drawn)
    }

    /// The picture of the same subject in full resolution that shares most with a place.
    fn beside(&self, target: &SubjectView) -> Option<(Arc<Drawn>, Shift)> {
        let known = [self.rough.last(), self.whole.last()].into_iter().flatten();
        let same = known.filter(|(known, _)| known.subject == target.subject);
        let shifted = same.filter_map(|(_, drawn)| {
            Some((Arc::clone(drawn), Shift::between(&drawn.view, &target.view)?))
        });
        let kept = |(_, shift): &(_, Shift)| shift.kept(target.view.pixels);
        shifted.max_by(|a, b| kept(a).total_cmp(&kept(b)))
    }

    /// The view itself if it is soon drawn in single precision, else a coarse one.
    fn affordable(&self, target: &SubjectView) -> View {
        let Pace { whole, single, .. } = self.pace.of(&target.subject);
        // double precision takes longer; coarse pictures take longer for each of their pixels
        let pace = [whole, single].into_iter().flatten().reduce(f64::min);
        let is_quick = pace.is_some_and(|pace| is_quick(pace, &target.view));
        if is_quick { target.view } else { coarse(&target.view) }
    }

    /// What is seen of a place that was drawn.
    pub(super) fn seen(
        &mut self,
        target: &SubjectView,
        watcher: &dyn Watcher,
    ) -> Result<Arc<OwnedSeen>, StageEnd> {
        let make = || OwnedSeen::new(target, watcher).map(Arc::new);
        self.seen.get_or(target.clone(), || make().map_err(StageEnd::at(Fault::Deformed)))
    }
}

impl Pace {
    fn of(&self, subject: &FrameSubject) -> Self {
        match self.subject.as_ref() == Some(subject) {
            true => Self { subject: None, ..*self },
            false => Self::default(),
        }
    }

    fn of_mut(&mut self, subject: &FrameSubject) -> &mut Self {
        if self.subject.as_ref() != Some(subject) {
            *self = Self { subject: Some(subject.clone()), ..Self::default() };
        }
        self
    }
}

fn deform(seen: &BodyView<'_>, shown: &Shown, watcher: &dyn Watcher) -> Result<Drawn, StageEnd> {
    let points = seen.moved().expect("a subject with a factor is deformed");
    deformed::draw(points, shown, watcher).map_err(StageEnd::at(Fault::Deformed))
}

fn count(view: &View) -> f64 {
    view.pixels.iter().map(|&n| f64::from(n)).product()
}

fn per_pixel(start: Instant, view: &View) -> f64 {
    start.elapsed().as_secs_f64() / count(view)
}

fn is_quick(pace: f64, view: &View) -> bool {
    pace * count(view) <= QUICK
}

/// The view on a sixteenth of the pixels; it shows a little more where they cannot be divided.
fn coarse(view: &View) -> View {
    let pixels = view.pixels.map(|n| n.div_ceil(COARSE));
    let size = view.pixel_size() * f64::from(COARSE);
    View { width: size * f64::from(pixels[0]), pixels, ..*view }
}
