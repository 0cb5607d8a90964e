//! Makes images step by step, each step from what those before have kept.

use std::sync::Arc;
use std::time::{Duration, Instant};

use ppum::dataset::Dataset;
use ppum::progress::{Progress, Verdict, Watcher};
use ppum_render::picture::Style;
use ppum_render::range::ColorRange;
use ppum_render::scale::Scale;
use ppum_scene::colors::ColorOptions;
use ppum_scene::layers::LayerInput;
use ppum_scene::overlays::Overlays;
use ppum_scene::values::{PixelValues, RasterValues as Pixels, single_precision_warning};

use super::ease::EasedRange;
use super::overlay_shapes::OverlayShapes;
use super::paint::ColoredImage;
use super::renderer::Backend;
use super::request::{AskStatus, LatestRequest, RequestStatus};
use super::resampled::Resampler;
use super::subject::{FrameSubject, SubjectView, Subjects};
use super::values::ValueCache;
use super::{FaultOrigin, FrameRequest, ImageFailure, RenderedFrame, SubtractedImage};
use crate::memo::Memo;
use crate::same_arc::SameArc;

/// The result of a step, and the time of the next one.
pub(super) struct StepResult {
    pub(super) frame: Option<Arc<RenderedFrame>>,
    pub(super) next: NextStep,
}

/// The end of a step without a result.
#[derive(Clone, Debug, PartialEq)]
pub(super) enum FrameStop {
    /// Something else is requested.
    Cancelled,
    /// There can be none.
    Failed(ImageFailure),
}

/// When the next step is due.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum NextStep {
    /// Now.
    More,
    /// Later.
    After(Duration),
    /// Not before something else is wanted.
    Rest,
}

/// Time between images whose range glides.
const GLIDE: Duration = Duration::from_millis(16);
/// Time between looks at a card that is prepared meanwhile: should there be none after all, that
/// is told.
const LOOK: Duration = Duration::from_millis(50);

/// The input that a range is computed from.
type RangeKey = (SameArc<PixelValues>, Scale, String, bool);
/// The subject of an eased range: a quantity of a dataset, and what is subtracted from it.
type EasedQuantity = (SameArc<Dataset>, Option<String>, Option<SubtractedImage>);

/// The input of layers, with no more of the image below than they depend on: isolines have levels
/// of its range, and labels that stand out from its colours.
type LayerKey = (SubjectView, Overlays, bool, Option<SameArc<ColoredImage>>);

/// Makes the images of one pane.
pub(super) struct FrameMaker {
    pub(super) subjects: Subjects,
    pub(super) values: ValueCache,
    pub(super) ranges: Memo<RangeKey, ColorRange>,
    eased: EasedRange<EasedQuantity>,
    styles: Memo<(SameArc<PixelValues>, ColorOptions), Style>,
    pub(super) painted: Memo<(SameArc<PixelValues>, Style, ColorRange), Arc<ColoredImage>>,
    pub(super) layers: Memo<LayerKey, Arc<OverlayShapes>>,
    pub(super) resampling: Resampler,
    newest: Option<Arc<RenderedFrame>>,
    pub(super) patience: Patience,
    seconds: f64,
}

/// The input of an image, as far as it is known.
struct FrameInput<'a> {
    request: &'a FrameRequest,
    target: &'a SubjectView,
    drawn: &'a Arc<PixelValues>,
    /// True if these are all values.
    is_whole: bool,
    style: &'a Style,
}

impl FrameMaker {
    pub(super) fn new(backend: Backend) -> Self {
        Self {
            subjects: Subjects::default(),
            values: ValueCache::new(backend),
            ranges: Memo::default(),
            eased: EasedRange::default(),
            styles: Memo::default(),
            painted: Memo::default(),
            layers: Memo::default(),
            resampling: Resampler::default(),
            newest: None,
            patience: Patience::default(),
            seconds: 0.0,
        }
    }

    /// Does the first thing that is left to do. `status` says whether it is still to be done.
    pub(super) fn step(
        &mut self,
        latest: &LatestRequest,
        now: Instant,
        status: AskStatus<'_>,
    ) -> Result<StepResult, FrameStop> {
        self.next_stage(latest, now, status).map_err(|failure| match status() {
            RequestStatus::Current => FrameStop::Failed(failure),
            // the work was stopped, or why it failed is no news
            RequestStatus::Replaced | RequestStatus::Closed => FrameStop::Cancelled,
        })
    }

    fn next_stage(
        &mut self,
        latest: &LatestRequest,
        now: Instant,
        status: AskStatus<'_>,
    ) -> Result<StepResult, ImageFailure> {
        let request = &latest.request;
        self.values.card.look();
        let target = SubjectView { subject: self.subjects.find(request)?, view: request.view };
        let watcher = |_: Progress| Verdict::go_on_unless(status() != RequestStatus::Current);
        let (drawn, is_whole) = self.drawn(latest, &target, status)?;
        let style = self.style(request, &target, &drawn)?;
        let input = FrameInput { request, target: &target, drawn: &drawn, is_whole, style: &style };
        let goal = self.goal(&input);
        if let Some(goal) = &goal {
            // what cannot be used is refused before it is shown, or anything glides there
            goal.normalization(style.scale).map_err(ImageFailure::at(FaultOrigin::Colors))?;
        }
        let (span, is_there) = self.span(&input, goal.as_ref(), now);
        let painted = self.paint(&input, span)?;
        let note = self.note(&target.subject, &drawn);
        let is_shown = |frame: &Arc<RenderedFrame>| {
            Arc::ptr_eq(&frame.colored, &painted) && frame.request == *request && frame.note == note
        };
        let Some(newest) = self.newest.clone().filter(is_shown) else {
            let next = if is_there { NextStep::More } else { NextStep::After(GLIDE) };
            let frame = self.frame(&input, painted, note);
            return Ok(self.publish(frame, next));
        };
        if let Some(rest) = latest.moves_for(now) {
            return Ok(StepResult { frame: None, next: NextStep::After(rest) });
        }
        if !is_whole {
            let start = Instant::now();
            self.values.draw_whole(&target, &watcher)?;
            self.seconds = start.elapsed().as_secs_f64();
        } else if goal.is_none() {
            let body = self.values.body(&target, &watcher)?;
            let (subject, body) = (target.subject.image(), body.borrow_dependent());
            let found = subject.span(body, &drawn, &style, &watcher);
            let found = found.map_err(ImageFailure::at(FaultOrigin::Colors))?;
            self.ranges.set(range_key(&drawn, &style), found);
        } else if is_there {
            return self.finish(&input, &newest, &watcher);
        }
        Ok(StepResult { frame: None, next: NextStep::More })
    }

    /// The values: the whole ones if they are there or soon done, else rough ones.
    fn drawn(
        &mut self,
        latest: &LatestRequest,
        target: &SubjectView,
        status: AskStatus<'_>,
    ) -> Result<(Arc<PixelValues>, bool), ImageFailure> {
        if let Some(whole) = self.values.whole.get(target) {
            return Ok((whole, true));
        }
        if let Some(rough) = self.values.rough.get(target) {
            return Ok((rough, false));
        }
        let start = Instant::now();
        let is_rough = self.values.needs_rough(target, latest.rests_at.is_some());
        let values = &mut self.values;
        let drawn = self.patience.with(status, |watcher| match is_rough {
            true => values.draw_rough(target, watcher),
            false => values.draw_whole(target, watcher),
        })?;
        self.seconds = start.elapsed().as_secs_f64();
        Ok((drawn, !is_rough))
    }

    /// The way in which values become colours.
    fn style(
        &mut self,
        request: &FrameRequest,
        SubjectView { subject, .. }: &SubjectView,
        drawn: &Arc<PixelValues>,
    ) -> Result<Style, ImageFailure> {
        let colors = &request.scene.colors;
        self.styles.get_or((drawn.into(), colors.clone()), || {
            let style = subject.image().style(colors, drawn);
            style.map_err(ImageFailure::at(FaultOrigin::Colors))
        })
    }

    /// The range that belongs to the image, if it is known: one that is found has to be looked
    /// for, at rest.
    fn goal(&self, input: &FrameInput<'_>) -> Option<ColorRange> {
        let FrameInput { target: SubjectView { subject, .. }, drawn, style, is_whole, .. } = *input;
        // the pixels are all that is known of a difference
        let is_of_pixels = match subject.left {
            Some(_) => is_whole,
            None => subject.shown.quantity().is_none(),
        };
        if is_of_pixels || !style.range.is_found() {
            return Some(subject.image().pixel_span(drawn, style));
        }
        self.ranges.get(&range_key(drawn, style)).filter(|_| is_whole)
    }

    /// The range that is shown now; true if it is the one that belongs there, or stands for it.
    fn span(
        &mut self,
        input: &FrameInput<'_>,
        goal: Option<&ColorRange>,
        now: Instant,
    ) -> (ColorRange, bool) {
        let FrameInput { request, target, drawn, style, .. } = input;
        let quantity = request.scene.quantity.clone();
        let about = ((request.dataset.clone(), quantity, request.minus.clone()), style.scale);
        let span = match goal {
            Some(goal) if style.range.is_found() => {
                return self.eased.toward(about, goal.clone(), now);
            }
            Some(goal) => goal.clone(),
            None => {
                let shown = self.eased.shown(&about).cloned();
                shown.unwrap_or_else(|| target.subject.image().pixel_span(drawn, style))
            }
        };
        self.eased.set(about, span.clone());
        (span, true)
    }

    /// The reason why no card draws, or what is wrong with the images of the card.
    fn note(&self, subject: &FrameSubject, drawn: &PixelValues) -> Option<String> {
        let is_single = matches!(drawn.values, Pixels::Single(_));
        let warning = || single_precision_warning(subject.field.field().step);
        self.values.card.note.clone().or_else(|| is_single.then(warning).flatten())
    }

    fn paint(
        &mut self,
        FrameInput { drawn, style, .. }: &FrameInput<'_>,
        span: ColorRange,
    ) -> Result<Arc<ColoredImage>, ImageFailure> {
        let key = (SameArc::from(*drawn), (*style).clone(), span.clone());
        let paint = || ColoredImage::of(drawn, style, span).map(Arc::new);
        self.painted.get_or(key, || paint().map_err(ImageFailure::at(FaultOrigin::Colors)))
    }

    /// Completes the newest frame, whose image is the final one: layers, then the comparison.
    fn finish(
        &mut self,
        input: &FrameInput<'_>,
        newest: &RenderedFrame,
        watcher: &dyn Watcher,
    ) -> Result<StepResult, ImageFailure> {
        let FrameInput { request, target, drawn, style, .. } = *input;
        let mut frame = newest.clone();
        let layers = self.layers(input, &frame.colored, watcher)?;
        let is_news = !Arc::ptr_eq(&layers, &newest.layers) || newest.layers_view != request.view;
        (frame.layers, frame.layers_view) = (layers, request.view);
        if let Some(compare) = request.compare {
            if is_news {
                return Ok(self.publish(frame, NextStep::More));
            }
            let direct = (drawn, &frame.colored, style);
            frame.other = Some(self.resampling.compare(compare, target, direct, watcher)?);
        }
        frame.is_final = true;
        let is_away = self.values.card.is_away();
        Ok(self.publish(frame, if is_away { NextStep::After(LOOK) } else { NextStep::Rest }))
    }

    /// Draws the layers over an image.
    fn layers(
        &mut self,
        FrameInput { request, target, drawn, .. }: &FrameInput<'_>,
        picture: &Arc<ColoredImage>,
        watcher: &dyn Watcher,
    ) -> Result<Arc<OverlayShapes>, ImageFailure> {
        let body = self.values.body(target, watcher)?;
        let (subject, scene) = (&target.subject.image(), &request.scene);
        let below = scene.overlays.isolines.is_some().then(|| picture.into());
        let key = ((*target).clone(), scene.overlays.clone(), scene.outline, below);
        self.layers.get_or(key, || {
            let (body, values) = (body.borrow_dependent(), &drawn.values);
            let input = LayerInput { subject, body, picture, values, design: None, has_bar: true };
            let layers = input.layers(scene, watcher);
            let shapes = layers.map(|layers| OverlayShapes::new(layers, picture.view.pixels));
            shapes.map(Arc::new).map_err(ImageFailure::at(FaultOrigin::Overlays))
        })
    }

    /// The frame of an image, with the layers over the previous one, and the comparison beside it,
    /// until these are drawn again, if they are of the same body.
    fn frame(
        &self,
        FrameInput { request, target: SubjectView { subject, .. }, drawn, .. }: &FrameInput<'_>,
        picture: Arc<ColoredImage>,
        note: Option<String>,
    ) -> RenderedFrame {
        let is_same = |frame: &&Arc<RenderedFrame>| {
            let is_as_before = frame.factor == subject.factor && frame.lines == subject.lines;
            frame.field == subject.field && is_as_before
        };
        let before = self.newest.as_ref().filter(is_same);
        let is_compared =
            |frame: &&Arc<RenderedFrame>| frame.shown == subject.shown && request.compare.is_some();
        RenderedFrame {
            request: (*request).clone(),
            subject: subject.clone(),
            drawn: Arc::clone(drawn),
            norms: self.values.norms(subject),
            colored: picture,
            layers: before.map(|frame| Arc::clone(&frame.layers)).unwrap_or_default(),
            layers_view: before.map_or(request.view, |frame| frame.layers_view),
            other: before.filter(is_compared).and_then(|frame| frame.other.clone()),
            is_final: false,
            note,
            seconds: self.seconds,
        }
    }

    fn publish(&mut self, frame: RenderedFrame, next: NextStep) -> StepResult {
        let frame = Arc::new(frame);
        self.newest = Some(Arc::clone(&frame));
        StepResult { frame: Some(frame), next }
    }
}

fn range_key(drawn: &Arc<PixelValues>, style: &Style) -> RangeKey {
    (drawn.into(), style.scale, style.range.to_string(), style.colormap.diverging)
}

/// How long an image that is nearly there is made on, although something else is wanted: someone
/// who moves all the time sees images all the same. It grows with each image that was given up.
#[derive(Debug)]
pub(super) struct Patience(pub(super) Duration);

const PATIENCE: Duration = Duration::from_millis(250);

impl Default for Patience {
    fn default() -> Self {
        Self(PATIENCE)
    }
}

impl Patience {
    fn with<T>(
        &mut self,
        status: AskStatus<'_>,
        work: impl FnOnce(&dyn Watcher) -> Result<T, ImageFailure>,
    ) -> Result<T, ImageFailure> {
        let (start, most) = (Instant::now(), self.0);
        let is_over = || match status() {
            RequestStatus::Current => false,
            RequestStatus::Replaced => start.elapsed() > most,
            RequestStatus::Closed => true,
        };
        let done = work(&|_: Progress| Verdict::go_on_unless(is_over()));
        self.0 = match &done {
            Err(_) if is_over() => most.saturating_mul(2),
            _ => PATIENCE,
        };
        done
    }
}
