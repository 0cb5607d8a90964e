//! Values at the pixels: the whole image, and a rough one that is there sooner.

use std::sync::Arc;
use std::time::Instant;

use ppum::progress::Watcher;
use ppum_render::resample::norms::DifferenceNorms;
use ppum_render::samples::Samples;
use ppum_render::scatter::render;
use ppum_render::view::View;
use ppum_scene::backend::{Backend, Precision};
use ppum_scene::engine::Engine;
use ppum_scene::values::{DrawingInput, PROCESSOR, PixelValues, single_precision_error};

use super::renderer::GraphicsCard;
use super::strips::{Shift, moved};
use super::subject::{FrameSubject, OwnedBody, SubjectView, visible_body};
use super::{FaultOrigin, ImageFailure};
use crate::memo::Memo;

/// Time above which values are drawn roughly first \[s\].
const QUICK: f64 = 0.02;
/// Pixels of the view, in each direction, for one of a coarse image.
const COARSE: u32 = 4;

/// Draws values, and keeps those of the last place.
pub(super) struct ValueCache {
    pub(super) card: GraphicsCard,
    pub(super) whole: Memo<SubjectView, Arc<PixelValues>>,
    pub(super) rough: Memo<SubjectView, Arc<PixelValues>>,
    /// Pixels of rough images that were drawn.
    pub(super) pixels: usize,
    bodies: Memo<SubjectView, Arc<OwnedBody>>,
    pace: (Option<FrameSubject>, Pace),
}

/// Seconds a pixel, as the last images of a subject took.
#[derive(Debug, Default)]
struct Pace {
    whole: Option<f64>,
    single: Option<f64>,
}

impl ValueCache {
    pub(super) fn new(backend: Backend) -> Self {
        Self {
            card: GraphicsCard::new(backend),
            whole: Memo::default(),
            rough: Memo::default(),
            pixels: 0,
            bodies: Memo::default(),
            pace: Default::default(),
        }
    }

    /// How fast images of a subject are drawn.
    fn pace(&mut self, subject: &FrameSubject) -> &mut Pace {
        if self.pace.0.as_ref() != Some(subject) {
            self.pace = (Some(subject.clone()), Pace::default());
        }
        &mut self.pace.1
    }

    /// True if a place needs a rough image: it may take long, or one moves on before it could be
    /// done.
    pub(super) fn needs_rough(&mut self, target: &SubjectView, is_moving: bool) -> bool {
        let subject = &target.subject;
        let is_quick = self.pace(subject).whole.is_some_and(|pace| is_quick(pace, &target.view));
        // differences and mirrored bodies are the processor's
        let has_card = self.card.is_open() && subject.left.is_none() && !subject.is_mirrored();
        !is_quick || is_moving && !has_card
    }

    /// Draws all that is to be seen.
    pub(super) fn draw_whole(
        &mut self,
        target: &SubjectView,
        watcher: &dyn Watcher,
    ) -> Result<Arc<PixelValues>, ImageFailure> {
        let (start, subject) = (Instant::now(), &target.subject);
        let body = self.body(target, watcher)?;
        let (body, card) = (body.borrow_dependent(), &mut self.card);
        let draw = &mut |job: DrawingInput<'_>, _| match card.draw(subject, job) {
            Some(drawn) => Ok(drawn),
            None => {
                let DrawingInput { field, view, quantity } = job;
                let raster = render::<f64>(field, view, quantity, watcher)?;
                Ok(PixelValues::new(raster, field, view, PROCESSOR))
            }
        };
        let drawn = subject.image().values_by(body, Samples::CENTER, draw, watcher);
        let drawn = Arc::new(drawn.map_err(ImageFailure::at(subject.fault()))?);
        self.pace(subject).whole = Some(per_pixel(start, &target.view));
        self.whole.set(target.clone(), Arc::clone(&drawn));
        Ok(drawn)
    }

    /// How far the two sides of a difference are from each other, in the view that was last
    /// drawn whole.
    pub(super) fn norms(&self, subject: &FrameSubject) -> Option<DifferenceNorms> {
        let (known, drawn) = self.whole.last()?;
        drawn.norms.filter(|_| known.subject == *subject)
    }

    /// Draws what is soon done: strips beside what was seen before, all in single precision, or a
    /// coarse image.
    pub(super) fn draw_rough(
        &mut self,
        target: &SubjectView,
        watcher: &dyn Watcher,
    ) -> Result<Arc<PixelValues>, ImageFailure> {
        let subject = &target.subject;
        let is_whole = subject.factor.is_some() || subject.is_mirrored();
        let is_of_cells = subject.left.is_none() && subject.shown.quantity().is_none();
        let drawn = match is_whole || is_of_cells {
            true => soon(subject, &coarse(&target.view), watcher)?,
            false => self.draw_soon(target, watcher)?,
        };
        let drawn = Arc::new(drawn);
        self.rough.set(target.clone(), Arc::clone(&drawn));
        Ok(drawn)
    }

    /// Draws strips, all of it or a coarse image.
    fn draw_soon(
        &mut self,
        target: &SubjectView,
        watcher: &dyn Watcher,
    ) -> Result<PixelValues, ImageFailure> {
        let mut pixels = 0;
        let mut draw = |view: &View| {
            pixels += view.pixels.iter().map(|&n| n as usize).product::<usize>();
            soon(&target.subject, view, watcher)
        };
        let (start, beside) = (Instant::now(), self.beside(target));
        let view = self.affordable(target);
        let (drawn, is_beside) = match &beside {
            Some((old, shift)) => (moved(old, *shift, &mut draw), true),
            None => (draw(&view), false),
        };
        let drawn = drawn?;
        self.pixels += pixels;
        if !is_beside {
            self.pace(&target.subject).single = Some(per_pixel(start, &view));
        }
        Ok(drawn)
    }

    /// The image of the same subject in full resolution that shares most with a place.
    fn beside(&self, target: &SubjectView) -> Option<(Arc<PixelValues>, Shift)> {
        let known = [self.rough.last(), self.whole.last()].into_iter().flatten();
        let same = known.filter(|(known, _)| known.subject == target.subject);
        let shifted = same.filter_map(|(_, drawn)| {
            Some((Arc::clone(drawn), Shift::between(&drawn.view, &target.view)?))
        });
        let kept = |(_, shift): &(_, Shift)| shift.kept(target.view.pixels);
        shifted.max_by(|a, b| kept(a).total_cmp(&kept(b)))
    }

    /// The view itself if it is soon drawn in single precision, else a coarse one.
    fn affordable(&mut self, target: &SubjectView) -> View {
        let Pace { whole, single } = *self.pace(&target.subject);
        // double precision takes longer; coarse images take longer for each of their pixels
        let pace = [whole, single].into_iter().flatten().reduce(f64::min);
        let is_quick = pace.is_some_and(|pace| is_quick(pace, &target.view));
        if is_quick { target.view } else { coarse(&target.view) }
    }

    /// Returns the visible part of the body at a place.
    pub(super) fn body(
        &mut self,
        target: &SubjectView,
        watcher: &dyn Watcher,
    ) -> Result<Arc<OwnedBody>, ImageFailure> {
        self.bodies.get_or(target.clone(), || visible_body(target, watcher))
    }
}

/// Draws a view by the processor, in single precision where that shows the field.
fn soon(
    subject: &FrameSubject,
    view: &View,
    watcher: &dyn Watcher,
) -> Result<PixelValues, ImageFailure> {
    let body = visible_body(&SubjectView { subject: subject.clone(), view: *view }, watcher)?;
    let is_single = single_precision_error(subject.field.field().step).is_none();
    let engine = Engine::new(Backend::Cpu, is_single.then_some(Precision::F32), None, watcher);
    let engine = engine.map_err(ImageFailure::at(FaultOrigin::Quantity))?;
    let drawn = subject.image().values(body.borrow_dependent(), Samples::CENTER, &engine);
    drawn.map_err(ImageFailure::at(subject.fault()))
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
