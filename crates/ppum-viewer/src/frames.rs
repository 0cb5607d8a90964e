//! Pictures, computed in the background: the window says what is wanted, and takes the newest there is.

use std::sync::{Arc, Condvar, Mutex, MutexGuard, PoisonError};
use std::thread;
use std::time::Instant;

use ppum::dataset::Dataset;
use ppum::field::Field;
use ppum::progress::{Progress, Verdict, Watcher};
use ppum_render::deform::Deformation;
use ppum_render::picture::{Picture, Style};
use ppum_render::range::Range;
use ppum_render::resample::norms::{Norms, difference};
use ppum_render::resample::representation_bytes;
use ppum_render::scatter::render;
use ppum_render::view::View;
use ppum_scene::compare::{Compare, Resampled, signed};
use ppum_scene::drawing::{Drawn, Seen, Shown, Values};
use ppum_scene::layers::{Ground, Layers};
use ppum_scene::scene::{Scene, default_quantity, shown};
use ppum_scene::{deformed, range};

use crate::field::OwnedField;

/// What is wanted: a view of a scene of a dataset.
#[derive(Clone, Debug)]
pub struct Wanted {
    /// The dataset.
    pub dataset: Arc<Dataset>,
    /// What is shown of it, and how.
    pub scene: Scene,
    /// Where, on how many pixels.
    pub view: View,
    /// What resampling gives beside it, if that is asked for.
    pub compare: Option<Compare>,
    /// True if a range that was found stays as it is, whatever is seen.
    pub keeps_range: bool,
}

impl Wanted {
    /// A view of a scene, and nothing beside it.
    #[must_use]
    pub fn new(dataset: Arc<Dataset>, scene: Scene, view: View) -> Self {
        Self { dataset, scene, view, compare: None, keeps_range: false }
    }
}

impl PartialEq for Wanted {
    fn eq(&self, other: &Self) -> bool {
        Arc::ptr_eq(&self.dataset, &other.dataset)
            && self.scene == other.scene
            && self.view == other.view
            && self.compare == other.compare
            && self.keeps_range == other.keeps_range
    }
}

/// A picture with all that it was made of.
#[derive(Debug)]
pub struct Frame {
    /// What was wanted.
    pub wanted: Wanted,
    /// The field, with what is replaced in it.
    pub field: Arc<OwnedField>,
    /// What is shown.
    pub shown: Shown,
    /// Its values.
    pub drawn: Drawn,
    /// Their colours.
    pub picture: Picture,
    /// What lies over them.
    pub layers: Layers,
    /// How many times its displacement the plate is drawn with, if it is deformed.
    pub factor: Option<f64>,
    /// What resampling gives, if that was asked for; of an older view until it is there.
    pub other: Option<Arc<Other>>,
    /// What it took \[s\].
    pub seconds: f64,
}

/// What resampling gives in a view, beside the direct picture.
#[derive(Debug)]
pub struct Other {
    /// The way of resampling.
    pub compare: Compare,
    /// What was resampled, in the colours of the direct picture.
    pub picture: Picture,
    /// The difference, resampled − direct: blue, white, red.
    pub difference: Picture,
    /// The errors over the pixels of the view.
    pub norms: Norms,
    /// Memory of the samples.
    pub bytes: u64,
    /// Memory of what the field is evaluated from.
    pub direct_bytes: u64,
    /// What sampling and drawing took \[s\].
    pub seconds: [f64; 2],
}

/// Where a mistake lies that keeps a picture from being made.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Fault {
    /// The step, the part, the functions or the weight.
    Subject,
    /// The quantity.
    Quantity,
    /// The deformation.
    Deformed,
    /// Range, scale or map of the colours.
    Colors,
    /// Isolines, arrows, crosses.
    Overlays,
    /// The comparison with resampling.
    Compare,
}

/// The reason why there is no picture of what is wanted.
#[derive(Clone, Debug, PartialEq)]
pub struct Failure {
    /// Where it arose.
    pub fault: Fault,
    /// The reason, with the remedy.
    pub message: String,
}

impl Failure {
    fn new(fault: Fault, error: &dyn std::error::Error) -> Self {
        Self { fault, message: error.to_string() }
    }
}

type Outcome = Result<Arc<Frame>, Failure>;

/// The pictures of one pane.
pub struct Frames {
    shared: Arc<Shared>,
    asked: Option<Wanted>,
    newest: Option<Arc<Frame>>,
    failure: Option<Failure>,
}

#[derive(Default)]
struct Shared {
    state: Mutex<State>,
    changed: Condvar,
}

#[derive(Default)]
struct State {
    wanted: Option<Wanted>,
    is_working: bool,
    is_closed: bool,
    outcome: Option<Outcome>,
}

impl Shared {
    fn state(&self) -> MutexGuard<'_, State> {
        self.state.lock().unwrap_or_else(PoisonError::into_inner)
    }
}

impl Frames {
    /// Starts a thread that calls `wake` whenever there is something new.
    #[must_use]
    pub fn new(wake: impl Fn() + Send + 'static) -> Self {
        let shared = Arc::new(Shared::default());
        let theirs = Arc::clone(&shared);
        thread::spawn(move || serve(&theirs, &wake));
        Self { shared, asked: None, newest: None, failure: None }
    }

    /// Says what is wanted now. What was wanted before is stopped.
    pub fn want(&mut self, wanted: Wanted) {
        if self.asked.as_ref() != Some(&wanted) {
            self.asked = Some(wanted.clone());
            self.shared.state().wanted = Some(wanted);
            self.shared.changed.notify_all();
        }
    }

    /// Takes what has been made since; true if that is something new.
    pub fn poll(&mut self) -> bool {
        match self.shared.state().outcome.take() {
            None => return false,
            Some(Ok(frame)) => {
                self.newest = Some(frame);
                self.failure = None;
            }
            Some(Err(failure)) => self.failure = Some(failure),
        }
        true
    }

    /// The newest picture, of whatever was wanted then.
    #[must_use]
    pub fn newest(&self) -> Option<&Arc<Frame>> {
        self.newest.as_ref()
    }

    /// The reason why there is no picture of what is wanted now.
    #[must_use]
    pub fn failure(&self) -> Option<&Failure> {
        self.failure.as_ref()
    }

    /// True while something better than the newest picture is being made.
    #[must_use]
    pub fn is_working(&self) -> bool {
        let state = self.shared.state();
        state.is_working || state.wanted.is_some() || state.outcome.is_some()
    }
}

impl Drop for Frames {
    fn drop(&mut self) {
        self.shared.state().is_closed = true;
        self.shared.changed.notify_all();
    }
}

/// Makes pictures until nobody wants any.
fn serve(shared: &Shared, wake: &dyn Fn()) {
    let mut kept = None;
    while let Some(wanted) = next(shared) {
        let outcome = frame(&wanted, &mut kept, &Wish(shared));
        let mut state = shared.state();
        state.is_working = false;
        if let Some(outcome) = outcome {
            state.outcome = Some(outcome);
        }
        drop(state);
        wake();
    }
}

/// Waits for the next thing that is wanted; none if the pane is closed.
fn next(shared: &Shared) -> Option<Wanted> {
    let mut state = shared.state();
    loop {
        if state.is_closed {
            return None;
        }
        if let Some(wanted) = state.wanted.take() {
            state.is_working = true;
            return Some(wanted);
        }
        state = shared.changed.wait(state).unwrap_or_else(PoisonError::into_inner);
    }
}

/// Stops work that is no longer wanted.
struct Wish<'a>(&'a Shared);

impl Watcher for Wish<'_> {
    fn hear(&self, _: Progress) -> Verdict {
        let state = self.0.state();
        Verdict::go_on_unless(state.wanted.is_some() || state.is_closed)
    }
}

/// The field of the last picture, and what it was made from.
type Kept = Option<(Wanted, Arc<OwnedField>)>;

/// A picture; nothing if it was stopped.
fn frame(wanted: &Wanted, kept: &mut Kept, watcher: &dyn Watcher) -> Option<Outcome> {
    match try_frame(wanted, kept, watcher) {
        Err(failure) if failure.message == ppum::progress::Cancelled.to_string() => None,
        outcome => Some(outcome),
    }
}

fn try_frame(wanted: &Wanted, kept: &mut Kept, watcher: &dyn Watcher) -> Outcome {
    let start = Instant::now();
    let scene = &wanted.scene;
    let owned = field(wanted, kept)?;
    let field = owned.field();
    let text = scene.quantity.as_deref().unwrap_or(default_quantity(field));
    let shown = shown(text, field).map_err(|e| Failure::new(Fault::Quantity, &e))?;
    let deform = |e| Failure::new(Fault::Deformed, &e);
    let factor =
        scene.deformed.map(|factor| factor.number(&[field])).transpose().map_err(deform)?;
    let seen = match factor {
        None => Seen::Plate(wanted.view),
        Some(factor) => {
            let deformation = Deformation::new(field, factor).map_err(deform)?;
            let view = deformation.seen(&wanted.view);
            Seen::Moved(view.points(watcher).map_err(deform)?)
        }
    };
    let drawn = match (&seen, &shown) {
        (Seen::Plate(view), Shown::Quantity(quantity)) => {
            let raster = render::<f64>(field, view, quantity, watcher)
                .map_err(|e| Failure::new(Fault::Quantity, &e))?;
            Drawn::new(raster, field, view, "cpu f64")
        }
        (Seen::Plate(view), Shown::Cells(_, values)) => Drawn::of_cells(values, field, view),
        (Seen::Moved(points), shown) => deformed::draw(points, shown, watcher).map_err(deform)?,
    };
    let colors = |e: &dyn std::error::Error| Failure::new(Fault::Colors, e);
    let map = scene.colors.built_in(shown.quantity()).map_err(|e| colors(&e))?;
    let style = scene.colors.style_of([(&shown, &drawn.values)], map);
    let span = match shown.quantity() {
        Some(quantity) => {
            range::found(field, &seen, quantity, &drawn, &style, watcher).map_err(|e| colors(&e))?
        }
        None => drawn.span(&style, None),
    };
    let picture = drawn.picture(&style, span).map_err(|e| colors(&e))?;
    let ground = Ground {
        dataset: &wanted.dataset,
        field,
        quantity: shown.quantity(),
        picture: &picture,
        values: &drawn.values,
        is_figure: false,
        has_bar: true,
    };
    let layers = scene
        .overlays
        .layers(ground, &seen, scene.outline, watcher)
        .map_err(|e| Failure::new(Fault::Overlays, &e))?;
    let direct = (&drawn, &picture, &style);
    let other = wanted.compare.map(|compare| other(compare, field, &shown, direct, watcher));
    let other = other.transpose()?.map(Arc::new);
    drop(seen);
    let seconds = start.elapsed().as_secs_f64();
    let (wanted, field) = (wanted.clone(), Arc::clone(&owned));
    Ok(Arc::new(Frame { wanted, field, shown, drawn, picture, layers, factor, other, seconds }))
}

/// What resampling gives.
fn other(
    compare: Compare,
    field: &Field<'_>,
    shown: &Shown,
    (drawn, picture, style): (&Drawn, &Picture, &Style),
    watcher: &dyn Watcher,
) -> Result<Other, Failure> {
    let failure = |e: &dyn std::error::Error| Failure::new(Fault::Compare, e);
    let (Values::Double(direct), Some(quantity)) = (&drawn.values, shown.quantity()) else {
        return Err(Failure { fault: Fault::Compare, message: NOT_RESAMPLED.to_owned() });
    };
    let start = Instant::now();
    let grid = compare.grid_over(field).map_err(|e| failure(&e))?;
    let samples = grid.sample(field, quantity, watcher).map_err(|e| failure(&e))?;
    let sampling = start.elapsed().as_secs_f64();
    let found = Resampled::on_grid(&samples, compare.method, &drawn.view, direct);
    let drawing = start.elapsed().as_secs_f64() - sampling;
    let norm = &picture.normalization;
    let fixed = Style { range: Range::Fixed(norm.min(), norm.max()), ..style.clone() };
    let apart = difference(direct, &found.raster);
    Ok(Other {
        compare,
        picture: Picture::bare(&found.raster, &drawn.view, &fixed).map_err(|e| failure(&e))?,
        difference: signed(&apart, &drawn.view).map_err(|e| failure(&e))?,
        norms: found.norms,
        bytes: found.bytes,
        direct_bytes: representation_bytes(field),
        seconds: [sampling, drawing],
    })
}

const NOT_RESAMPLED: &str = "values of cells are not resampled; choose a quantity to compare";

/// The field that is looked at; the one of before if it is the same.
fn field(wanted: &Wanted, kept: &mut Kept) -> Result<Arc<OwnedField>, Failure> {
    if let Some((before, field)) = kept
        && Arc::ptr_eq(&before.dataset, &wanted.dataset)
        && before.scene.subject == wanted.scene.subject
    {
        return Ok(Arc::clone(field));
    }
    let subject = &wanted.scene.subject;
    let dataset = match subject.is_whole() {
        true => Arc::clone(&wanted.dataset),
        false => {
            let mut changed = Dataset::clone(&wanted.dataset);
            subject.apply(&mut changed).map_err(|e| Failure::new(Fault::Subject, &e))?;
            Arc::new(changed)
        }
    };
    let step = subject.step_of(&dataset);
    let field = OwnedField::new(dataset, step).map_err(|e| Failure::new(Fault::Subject, &e))?;
    let field = Arc::new(field);
    *kept = Some((wanted.clone(), Arc::clone(&field)));
    Ok(field)
}
