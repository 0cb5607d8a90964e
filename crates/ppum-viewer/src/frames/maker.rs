//! Makes images step by step, each step from what those before have kept.

use std::sync::Arc;
use std::time::{Duration, Instant};

use ppum::dataset::Dataset;
use ppum::progress::{Progress, Verdict, Watcher};
use ppum_render::picture::Style;
use ppum_render::range::ColorRange;
use ppum_render::scale::Scale;
use ppum_scene::drawing::{PixelValues, RasterValues as Pixels, single_precision_warning};

use super::ease::EasedRange;
use super::memo::{Memo, SameArc};
use super::over::LayerCache;
use super::overlay_shapes::OverlayShapes;
use super::paint::ColoredImage;
use super::renderer::{Backend, ValueRenderer};
use super::resampled::{ResampledView, Resampler};
use super::stop::{Ask, FrameClaim, FrameStop};
use super::subject::{FrameSubject, SubjectView, Subjects, SubtrahendSubject};
use super::values::ValueCache;
use super::{
    FaultOrigin, FrameRequest, ImageFailure, RenderedFrame, SubtractedImage, SubtractedValues,
};

/// The request, and the time when the moving view will be at rest.
#[derive(Clone, Debug)]
pub(super) struct LatestRequest {
    pub(super) wanted: FrameRequest,
    /// None if one does not move.
    pub(super) rests_at: Option<Instant>,
}

impl LatestRequest {
    /// How long it takes until one is at rest; none if one is.
    fn moves_for(&self, now: Instant) -> Option<Duration> {
        let rest = self.rests_at?.checked_duration_since(now);
        rest.filter(|rest| !rest.is_zero())
    }
}

/// The result of a step, and the time of the next one.
pub(super) struct StepResult {
    pub(super) frame: Option<Arc<RenderedFrame>>,
    pub(super) next: NextStep,
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

/// Makes the images of one pane.
pub(super) struct FrameMaker {
    pub(super) subjects: Subjects,
    pub(super) values: ValueCache,
    pub(super) ranges: Memo<RangeKey, ColorRange>,
    eased: EasedRange<EasedQuantity>,
    styles: Memo<(SameArc<PixelValues>, ppum_scene::colors::ColorOptions), Style>,
    pub(super) painted: Memo<(SameArc<PixelValues>, Style, ColorRange), Arc<ColoredImage>>,
    pub(super) over: LayerCache,
    pub(super) resampling: Resampler,
    newest: Option<Arc<RenderedFrame>>,
    pub(super) patience: Patience,
    seconds: f64,
}

impl FrameMaker {
    pub(super) fn new(backend: Backend) -> Self {
        Self {
            subjects: Subjects::default(),
            values: ValueCache::new(ValueRenderer::new(backend)),
            ranges: Memo::default(),
            eased: EasedRange::default(),
            styles: Memo::default(),
            painted: Memo::default(),
            over: LayerCache::default(),
            resampling: Resampler::default(),
            newest: None,
            patience: Patience::default(),
            seconds: 0.0,
        }
    }

    /// Does the first thing that is left to do. `claim` says whether it is still wanted.
    pub(super) fn step(
        &mut self,
        wish: &LatestRequest,
        now: Instant,
        claim: Ask<'_>,
    ) -> Result<StepResult, FrameStop> {
        self.next_stage(wish, now, claim).map_err(|failure| match claim() {
            FrameClaim::Wanted => FrameStop::Failed(failure),
            // the work was stopped, or why it failed is no news
            FrameClaim::Replaced | FrameClaim::Gone => FrameStop::Cancelled,
        })
    }

    fn next_stage(
        &mut self,
        wish: &LatestRequest,
        now: Instant,
        claim: Ask<'_>,
    ) -> Result<StepResult, ImageFailure> {
        let wanted = &wish.wanted;
        self.values.renderer.look();
        let target = SubjectView { subject: self.subjects.find(wanted)?, view: wanted.view };
        let watcher = |_: Progress| Verdict::go_on_unless(claim() != FrameClaim::Wanted);
        let (drawn, is_whole) = self.drawn(wish, &target, claim)?;
        let style = self.style(wanted, &target, &drawn)?;
        let goal = self.goal(&target, (&drawn, is_whole), &style);
        if let Some(goal) = &goal {
            // what cannot be used is refused before it is shown, or anything glides there
            goal.normalization(style.scale).map_err(ImageFailure::at(FaultOrigin::Colors))?;
        }
        let (span, is_there) =
            self.span(wanted, (&target.subject, &drawn), &style, goal.as_ref(), now);
        let painted = self.paint(&drawn, &style, span)?;
        let note = self.note(&target.subject, &drawn);
        let is_shown = |frame: &Arc<RenderedFrame>| {
            Arc::ptr_eq(&frame.picture, &painted) && frame.wanted == *wanted && frame.note == note
        };
        if !self.newest.as_ref().is_some_and(is_shown) {
            let next = if is_there { NextStep::More } else { NextStep::After(GLIDE) };
            return Ok(self.show(wanted, &target, (drawn, painted), next));
        }
        if let Some(rest) = wish.moves_for(now) {
            return Ok(StepResult { frame: None, next: NextStep::After(rest) });
        }
        if !is_whole {
            self.draw_whole(&target, &watcher)?;
        } else if goal.is_none() {
            self.find_range(&target, (&drawn, &style), &watcher)?;
        } else if is_there {
            return self.finish(wanted, &target, (drawn, painted, &style), &watcher);
        }
        Ok(StepResult { frame: None, next: NextStep::More })
    }

    /// The values: the whole ones if they are there or soon done, else rough ones.
    fn drawn(
        &mut self,
        wish: &LatestRequest,
        target: &SubjectView,
        claim: Ask<'_>,
    ) -> Result<(Arc<PixelValues>, bool), ImageFailure> {
        if let Some(whole) = self.values.whole.get(target) {
            return Ok((whole, true));
        }
        if let Some(rough) = self.values.rough.get(target) {
            return Ok((rough, false));
        }
        let start = Instant::now();
        let is_rough = self.values.needs_rough(target, wish.rests_at.is_some());
        let drawn = match is_rough {
            true => self.patience.with(claim, |watcher| self.values.draw_rough(target, watcher))?,
            false => {
                self.patience.with(claim, |watcher| self.values.draw_whole(target, watcher))?
            }
        };
        self.seconds = start.elapsed().as_secs_f64();
        Ok((drawn, !is_rough))
    }

    fn draw_whole(
        &mut self,
        target: &SubjectView,
        watcher: &dyn Watcher,
    ) -> Result<(), ImageFailure> {
        let start = Instant::now();
        self.values.draw_whole(target, watcher)?;
        self.seconds = start.elapsed().as_secs_f64();
        Ok(())
    }

    /// The way in which values become colours.
    fn style(
        &mut self,
        wanted: &FrameRequest,
        target: &SubjectView,
        drawn: &Arc<PixelValues>,
    ) -> Result<Style, ImageFailure> {
        let (colors, subject) = (&wanted.scene.colors, &target.subject);
        self.styles.get_or((SameArc::of(drawn), colors.clone()), || {
            let style = subject.source().style(&subject.shown.0, colors, drawn);
            style.map_err(ImageFailure::at(FaultOrigin::Colors))
        })
    }

    /// The range that belongs to the image, if it is known: one that is found has to be looked
    /// for, at rest.
    fn goal(
        &self,
        target: &SubjectView,
        (drawn, is_whole): (&Arc<PixelValues>, bool),
        style: &Style,
    ) -> Option<ColorRange> {
        let subject = &target.subject;
        // the pixels are all that is known of a difference
        let is_of_pixels = match subject.minus {
            Some(_) => is_whole,
            None => subject.shown.0.quantity().is_none(),
        };
        if is_of_pixels || !style.range.is_found() {
            return Some(subject.source().pixel_span(drawn, style));
        }
        self.ranges.get(&ranged(drawn, style)).filter(|_| is_whole)
    }

    /// The range that is shown now; true if it is the one that belongs there, or stands for it.
    fn span(
        &mut self,
        wanted: &FrameRequest,
        (subject, drawn): (&FrameSubject, &PixelValues),
        style: &Style,
        goal: Option<&ColorRange>,
        now: Instant,
    ) -> (ColorRange, bool) {
        let about = about(wanted, style);
        match goal {
            Some(goal) if style.range.is_found() => self.eased.toward(about, goal.clone(), now),
            Some(goal) => {
                // one that is refused must not be what the next range begins with
                if goal.normalization(style.scale).is_ok() {
                    self.eased.set(about, goal.clone());
                }
                (goal.clone(), true)
            }
            None => {
                let span = self.eased.shown(&about).cloned();
                let span = span.unwrap_or_else(|| subject.source().pixel_span(drawn, style));
                self.eased.set(about, span.clone());
                (span, true)
            }
        }
    }

    fn find_range(
        &mut self,
        target: &SubjectView,
        (drawn, style): (&Arc<PixelValues>, &Style),
        watcher: &dyn Watcher,
    ) -> Result<(), ImageFailure> {
        let seen = self.values.seen(target, watcher)?;
        let found = target.subject.input(seen.seen()).span(drawn, style, watcher);
        let found = found.map_err(ImageFailure::at(FaultOrigin::Colors))?;
        self.ranges.set(ranged(drawn, style), found);
        Ok(())
    }

    /// The reason why no card draws, or what is wrong with the images of the card.
    fn note(&self, subject: &FrameSubject, drawn: &PixelValues) -> Option<String> {
        let note = self.values.renderer.note().map(str::to_owned);
        let is_single = matches!(drawn.values, Pixels::Single(_));
        let warning = || single_precision_warning(subject.field.0.field().step);
        note.or_else(|| is_single.then(warning).flatten())
    }

    fn paint(
        &mut self,
        drawn: &Arc<PixelValues>,
        style: &Style,
        span: ColorRange,
    ) -> Result<Arc<ColoredImage>, ImageFailure> {
        let key = (SameArc::of(drawn), style.clone(), span.clone());
        let paint = || ColoredImage::of(drawn, style, span).map(Arc::new);
        self.painted.get_or(key, || paint().map_err(ImageFailure::at(FaultOrigin::Colors)))
    }

    /// Completes the frame when the image is there: layers, then the comparison.
    fn finish(
        &mut self,
        wanted: &FrameRequest,
        target: &SubjectView,
        (drawn, painted, style): (Arc<PixelValues>, Arc<ColoredImage>, &Style),
        watcher: &dyn Watcher,
    ) -> Result<StepResult, ImageFailure> {
        let Some(newest) = self.newest.clone() else {
            return Ok(self.show(wanted, target, (drawn, painted), NextStep::More));
        };
        let next =
            if self.values.renderer.is_away() { NextStep::After(LOOK) } else { NextStep::Rest };
        let mut frame = RenderedFrame::clone(&newest);
        let seen = self.values.seen(target, watcher)?;
        let below = (&*drawn, &painted, seen.seen());
        frame.layers = self.over.draw(wanted, target, below, watcher)?;
        frame.layers_view = wanted.view;
        let has_news =
            !Arc::ptr_eq(&frame.layers, &newest.layers) || newest.layers_view != wanted.view;
        if let (Some(_), true) = (wanted.compare, has_news) {
            return Ok(self.publish(frame, NextStep::More));
        }
        if let Some(compare) = wanted.compare {
            let direct = (&drawn, &painted, style);
            frame.other = Some(self.resampling.compare(compare, target, direct, watcher)?);
        }
        frame.is_final = true;
        Ok(self.publish(frame, next))
    }

    /// A frame of an image, with what lay over the one before until that is drawn again.
    fn show(
        &mut self,
        wanted: &FrameRequest,
        target: &SubjectView,
        (drawn, picture): (Arc<PixelValues>, Arc<ColoredImage>),
        next: NextStep,
    ) -> StepResult {
        let (layers, layers_view, other) = self.carried(wanted, target);
        let subject = &target.subject;
        let note = self.note(subject, &drawn);
        let frame = RenderedFrame {
            wanted: wanted.clone(),
            field: Arc::clone(&subject.field.0),
            shown: Arc::clone(&subject.shown.0),
            subtracted: self.subtracted(subject),
            drawn,
            picture,
            layers,
            layers_view,
            factor: subject.factor,
            lines: subject.lines,
            other,
            is_final: false,
            note,
            seconds: self.seconds,
        };
        self.publish(frame, next)
    }

    fn subtracted(&self, subject: &FrameSubject) -> Option<SubtractedValues> {
        let SubtrahendSubject { field, shown } = subject.minus.as_ref()?;
        let (field, shown) = (Arc::clone(&field.0), Arc::clone(&shown.0));
        Some(SubtractedValues { field, shown, norms: self.values.norms(subject) })
    }

    /// Returns the layers over the previous image, and beside it, if that is of the same body.
    fn carried(
        &self,
        wanted: &FrameRequest,
        target: &SubjectView,
    ) -> (Arc<OverlayShapes>, ppum_render::view::View, Option<Arc<ResampledView>>) {
        let subject = &target.subject;
        let is_same = |frame: &&Arc<RenderedFrame>| {
            let is_as_before = frame.factor == subject.factor && frame.lines == subject.lines;
            Arc::ptr_eq(&frame.field, &subject.field.0) && is_as_before
        };
        let Some(newest) = self.newest.as_ref().filter(is_same) else {
            return (Arc::default(), wanted.view, None);
        };
        let shows_same = Arc::ptr_eq(&newest.shown, &subject.shown.0) && wanted.compare.is_some();
        let other = newest.other.clone().filter(|_| shows_same);
        (Arc::clone(&newest.layers), newest.layers_view, other)
    }

    fn publish(&mut self, frame: RenderedFrame, next: NextStep) -> StepResult {
        let frame = Arc::new(frame);
        self.newest = Some(Arc::clone(&frame));
        StepResult { frame: Some(frame), next }
    }
}

fn about(wanted: &FrameRequest, style: &Style) -> (EasedQuantity, Scale) {
    let quantity = wanted.scene.quantity.clone();
    ((SameArc::of(&wanted.dataset), quantity, wanted.minus.clone()), style.scale)
}

fn ranged(drawn: &Arc<PixelValues>, style: &Style) -> RangeKey {
    (SameArc::of(drawn), style.scale, style.range.to_string(), style.colormap.diverging)
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
        claim: Ask<'_>,
        work: impl FnOnce(&dyn Watcher) -> Result<T, ImageFailure>,
    ) -> Result<T, ImageFailure> {
        let (start, most) = (Instant::now(), self.0);
        let is_over = || match claim() {
            FrameClaim::Wanted => false,
            FrameClaim::Replaced => start.elapsed() > most,
            FrameClaim::Gone => true,
        };
        let done = work(&|_: Progress| Verdict::go_on_unless(is_over()));
        self.0 = match &done {
            Err(_) if is_over() => most.saturating_mul(2),
            _ => PATIENCE,
        };
        done
    }
}
