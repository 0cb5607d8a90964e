//! Values at the pixels: the whole picture, and a rough one that is there sooner.

use std::sync::Arc;
use std::time::Instant;

use ppum::progress::Watcher;
use ppum_render::RenderError;
use ppum_render::resample::norms::Norms;
use ppum_render::scatter::render;
use ppum_render::view::View;
use ppum_scene::deformed;
use ppum_scene::drawing::{Drawn, PROCESSOR, Seen, Shown};

use super::Fault;
use super::memo::Memo;
use super::renderer::Renderer;
use super::stop::Stop;
use super::strips::{Shift, moved};
use super::subject::{OwnedSeen, Place, Subject};

/// What may take longer has a rough picture first \[s\].
const QUICK: f64 = 0.02;
/// Pixels of the view, in each direction, for one of a coarse picture.
const COARSE: u32 = 4;

/// Draws values, and keeps those of the last place.
pub(super) struct Values {
    pub(super) renderer: Renderer,
    pub(super) whole: Memo<Place, Arc<Drawn>>,
    pub(super) rough: Memo<Place, Arc<Drawn>>,
    /// Pixels of rough pictures that were drawn.
    pub(super) pixels: usize,
    seen: Memo<Place, Arc<OwnedSeen>>,
    /// How far the two sides of the last difference are from each other.
    norms: Memo<Subject, Norms>,
    pace: Pace,
}

/// Seconds a pixel, as the last pictures of a subject took.
#[derive(Debug, Default)]
struct Pace {
    subject: Option<Subject>,
    whole: Option<f64>,
    single: Option<f64>,
}

impl Values {
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
    pub(super) fn needs_rough(&self, place: &Place, is_moving: bool) -> bool {
        let is_quick =
            self.pace.of(&place.subject).whole.is_some_and(|pace| is_quick(pace, &place.view));
        // differences are the processor's
        let has_card = self.renderer.has_card() && place.subject.minus.is_none();
        !is_quick || is_moving && !has_card
    }

    /// Draws all that is to be seen.
    pub(super) fn draw_whole(
        &mut self,
        place: &Place,
        watcher: &dyn Watcher,
    ) -> Result<Arc<Drawn>, Stop> {
        let start = Instant::now();
        if place.subject.minus.is_none() {
            self.norms = Memo::default();
        }
        let Subject { field, shown, factor, .. } = &place.subject;
        let drawn = match (&*shown.0, factor) {
            _ if place.subject.minus.is_some() => self.draw_minus(place, watcher)?,
            (shown, Some(_)) => {
                let seen = self.seen(place, watcher)?;
                deform(seen.seen(), shown, watcher)?
            }
            (Shown::Quantity(quantity), None) => {
                let drawn = self.renderer.draw(&place.subject, &place.view, quantity, watcher);
                drawn.map_err(Stop::at(Fault::Quantity))?
            }
            (Shown::Cells(_, values), None) => {
                Drawn::of_cells(values, field.0.field(), &place.view)
            }
        };
        self.pace.of_mut(&place.subject).whole = Some(per_pixel(start, &place.view));
        let drawn = Arc::new(drawn);
        self.whole.set(place.clone(), Arc::clone(&drawn));
        Ok(drawn)
    }

    fn draw_minus(&mut self, place: &Place, watcher: &dyn Watcher) -> Result<Drawn, Stop> {
        let minus = place.subject.minus().expect("a subject with something to subtract");
        let apart = minus.draw(&place.view, watcher).map_err(Stop::at(Fault::Minus))?;
        self.norms.set(place.subject.clone(), apart.norms);
        Ok(apart.drawn)
    }

    /// How far the two sides of a difference are from each other, in the view that was last
    /// drawn whole.
    pub(super) fn norms(&self, subject: &Subject) -> Option<Norms> {
        self.norms.get(subject)
    }

    /// Draws what is soon done: strips beside what was seen before, all in single precision, or a
    /// coarse picture.
    pub(super) fn draw_rough(
        &mut self,
        place: &Place,
        watcher: &dyn Watcher,
    ) -> Result<Arc<Drawn>, Stop> {
        let drawn = match (&*place.subject.shown.0, place.subject.factor) {
            _ if place.subject.minus.is_some() => self.draw_soon(place, |subject, view| {
                let minus = subject.minus().expect("a subject with something to subtract");
                minus.draw(view, watcher).map(|apart| apart.drawn)
            })?,
            (Shown::Quantity(quantity), None) => self.draw_soon(place, |subject, view| {
                let field = subject.field.0.field();
                if !subject.bears_single() {
                    let raster = render::<f64>(field, view, quantity, watcher)?;
                    return Ok(Drawn::new(raster, field, view, PROCESSOR));
                }
                let raster = render::<f32>(field, view, quantity, watcher)?;
                Ok(Drawn::new(raster, field, view, "cpu f32"))
            })?,
            (Shown::Cells(_, values), None) => {
                Drawn::of_cells(values, place.subject.field.0.field(), &coarse(&place.view))
            }
            (shown, Some(_)) => {
                let coarse = Place { view: coarse(&place.view), ..place.clone() };
                let seen = OwnedSeen::new(&coarse, watcher).map_err(Stop::at(Fault::Deformed))?;
                deform(seen.seen(), shown, watcher)?
            }
        };
        let drawn = Arc::new(drawn);
        self.rough.set(place.clone(), Arc::clone(&drawn));
        Ok(drawn)
    }

    /// Draws strips, all of it or a coarse picture, by what draws the pixels of a view.
    fn draw_soon(
        &mut self,
        place: &Place,
        pixels_of: impl Fn(&Subject, &View) -> Result<Drawn, RenderError>,
    ) -> Result<Drawn, Stop> {
        let mut pixels = 0;
        let mut draw = |view: &View| -> Result<Drawn, RenderError> {
            pixels += view.pixels.iter().map(|&n| n as usize).product::<usize>();
            pixels_of(&place.subject, view)
        };
        let (start, beside) = (Instant::now(), self.beside(place));
        let view = self.affordable(place);
        let (drawn, is_beside) = match &beside {
            Some((old, shift)) => (moved(old, *shift, &mut draw), true),
            None => (draw(&view), false),
        };
        let drawn = drawn.map_err(Stop::at(Fault::Quantity))?;
        self.pixels += pixels;
        if !is_beside {
            self.pace.of_mut(&place.subject).single = Some(per_pixel(start, &view));
        }
        Ok(drawn)
    }

    /// The picture of the same subject in full resolution that shares most with a place.
    fn beside(&self, place: &Place) -> Option<(Arc<Drawn>, Shift)> {
        let known = [self.rough.last(), self.whole.last()].into_iter().flatten();
        let same = known.filter(|(known, _)| known.subject == place.subject);
        let shifted = same.filter_map(|(_, drawn)| {
            Some((Arc::clone(drawn), Shift::between(&drawn.view, &place.view)?))
        });
        let kept = |(_, shift): &(_, Shift)| shift.kept(place.view.pixels);
        shifted.max_by(|a, b| kept(a).total_cmp(&kept(b)))
    }

    /// The view itself if it is soon drawn in single precision, else a coarse one.
    fn affordable(&self, place: &Place) -> View {
        let Pace { whole, single, .. } = self.pace.of(&place.subject);
        // double precision takes longer; coarse pictures take longer for each of their pixels
        let pace = [whole, single].into_iter().flatten().reduce(f64::min);
        let is_quick = pace.is_some_and(|pace| is_quick(pace, &place.view));
        if is_quick { place.view } else { coarse(&place.view) }
    }

    /// What is seen of a place that was drawn.
    pub(super) fn seen(
        &mut self,
        place: &Place,
        watcher: &dyn Watcher,
    ) -> Result<Arc<OwnedSeen>, Stop> {
        let make = || OwnedSeen::new(place, watcher).map(Arc::new);
        self.seen.get_or(place.clone(), || make().map_err(Stop::at(Fault::Deformed)))
    }
}

impl Pace {
    fn of(&self, subject: &Subject) -> Self {
        match self.subject.as_ref() == Some(subject) {
            true => Self { subject: None, ..*self },
            false => Self::default(),
        }
    }

    fn of_mut(&mut self, subject: &Subject) -> &mut Self {
        if self.subject.as_ref() != Some(subject) {
            *self = Self { subject: Some(subject.clone()), ..Self::default() };
        }
        self
    }
}

fn deform(seen: &Seen<'_>, shown: &Shown, watcher: &dyn Watcher) -> Result<Drawn, Stop> {
    let points = seen.moved().expect("a subject with a factor is deformed");
    deformed::draw(points, shown, watcher).map_err(Stop::at(Fault::Deformed))
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
