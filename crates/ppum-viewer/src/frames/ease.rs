//! Ranges that glide to where they belong, so that colours do not jump.

use std::time::{Duration, Instant};

use ppum_render::range::ColorRange;
use ppum_render::scale::Scale;

/// The duration of a transition between ranges.
const TAKES: Duration = Duration::from_millis(200);
/// A change of less than this part of the range is not seen.
const UNSEEN: f64 = 0.004;

/// The subject of a range: a range of another subject appears without a transition.
pub(super) type RangeSubject<K> = (K, Scale);

/// The range that is shown.
#[derive(Debug)]
pub(super) struct EasedRange<K> {
    shown: Option<(RangeSubject<K>, ColorRange)>,
    glide: Option<Glide>,
}

/// A way from one range to another.
#[derive(Debug)]
struct Glide {
    from: [f64; 2],
    to: ColorRange,
    began: Instant,
}

impl<K> Default for EasedRange<K> {
    fn default() -> Self {
        Self { shown: None, glide: None }
    }
}

impl<K: PartialEq> EasedRange<K> {
    /// The range that is shown of this, if one is.
    pub(super) fn shown(&self, about: &RangeSubject<K>) -> Option<&ColorRange> {
        self.shown.as_ref().filter(|(known, _)| known == about).map(|(_, span)| span)
    }

    /// Shows a range at once.
    pub(super) fn set(&mut self, about: RangeSubject<K>, span: ColorRange) {
        (self.shown, self.glide) = (Some((about, span)), None);
    }

    /// The range on its way to another one; true once it is there.
    pub(super) fn toward(
        &mut self,
        about: RangeSubject<K>,
        to: ColorRange,
        now: Instant,
    ) -> (ColorRange, bool) {
        let Some(shown) = self.shown(&about).filter(|shown| !is_near(shown, &to)) else {
            self.set(about, to.clone());
            return (to, true);
        };
        let from = [shown.min, shown.max];
        let glide = match self.glide.take() {
            Some(glide) if glide.to == to => glide,
            _ => Glide { from, to: to.clone(), began: now },
        };
        let part = now.duration_since(glide.began).as_secs_f64() / TAKES.as_secs_f64();
        if part >= 1.0 {
            self.set(about, to.clone());
            return (to, true);
        }
        let span = glide.at(part, about.1);
        (self.shown, self.glide) = (Some((about, span.clone())), Some(glide));
        (span, false)
    }
}

impl Glide {
    /// The range after a part of the time, 0 to 1.
    fn at(&self, part: f64, scale: Scale) -> ColorRange {
        // slow at both ends
        let t = part * part * (3.0 - 2.0 * part);
        let mix = |a: f64, b: f64| match scale {
            Scale::Log => a * (b / a).powf(t),
            _ => a + t * (b - a),
        };
        let ends = [mix(self.from[0], self.to.min), mix(self.from[1], self.to.max)];
        ColorRange { min: ends[0], max: ends[1], ..self.to.clone() }
    }
}

fn is_near(a: &ColorRange, b: &ColorRange) -> bool {
    let size = UNSEEN * (b.max - b.min);
    (a.min - b.min).abs() <= size && (a.max - b.max).abs() <= size
}
