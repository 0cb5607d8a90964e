//! One range for several pictures: those of the steps of a series.
//!
//! All are looked at first, which [`ValueStatistics`] keeps in mind; then each has its colours by
//! the [`Coloring`] of all.

use ppum_render::extrema::Extrema;
use ppum_render::picture::{Picture, Style};
use ppum_render::range::{Basis, Range, RangeError, ValueSpan};
use ppum_render::scale::Scale;

use crate::drawing::Drawn;

/// The way values become colours.
#[derive(Clone, Debug)]
pub struct Coloring {
    /// Map and scale.
    pub style: Style,
    /// The range.
    pub span: ValueSpan,
    /// Of a series: true if values of some step lie below the range, and above it, so that all bars
    /// are alike.
    pub ends: Option<[bool; 2]>,
}

impl Coloring {
    /// The values in colours.
    ///
    /// # Errors
    /// As [`Drawn::picture`].
    pub fn picture(&self, drawn: &Drawn) -> Result<Picture, RangeError> {
        let mut picture = drawn.picture(&self.style, self.span.clone())?;
        if let Some(ends) = self.ends {
            [picture.has_below, picture.has_above] = ends;
            picture.one_value = None;
        }
        Ok(picture)
    }
}

/// Ranges of values and undefined pixels of pictures, before colours are chosen.
#[derive(Clone, Debug, Default)]
pub struct ValueStatistics {
    spans: Vec<ValueSpan>,
    /// Those of steps that have one value everywhere.
    even: Vec<ValueSpan>,
    /// Smallest and largest value.
    values: Option<[f64; 2]>,
    /// Number of pixels of the plate without a value, and of all of them.
    pub undefined: [usize; 2],
}

impl ValueStatistics {
    /// Adds a step. One without values says nothing of the range; one that has one value
    /// everywhere, as before any load, no more than this value.
    pub fn add(&mut self, mut span: ValueSpan, drawn: &Drawn, scale: Scale) {
        let [without, all] = drawn.undefined();
        self.undefined = [self.undefined[0] + without, self.undefined[1] + all];
        let found = drawn.values.statistics();
        if found.finite + found.infinite == 0 {
            return;
        }
        let constant = span.values.as_ref().and_then(Extrema::constant);
        let ends = constant.map_or_else(|| drawn.values.ends(), |value| [value; 2]);
        let known = self.values.unwrap_or(ends);
        self.values = Some([known[0].min(ends[0]), known[1].max(ends[1])]);
        match constant.or_else(|| drawn.values.one_value()) {
            Some(value) if span.basis != Basis::Given && (scale != Scale::Log || value > 0.0) => {
                self.even.push(span.clone());
                [span.min, span.max] = [value; 2];
            }
            _ => {}
        }
        self.spans.push(span);
    }

    /// The way the values of all steps become colours: classes have theirs, which `classed` says;
    /// else it follows from the range.
    #[must_use]
    pub fn coloring(self, classed: Style, style: Style) -> Coloring {
        match classed.range {
            Range::Fixed(min, max) if !classed.colormap.classes().is_empty() => {
                let span = ValueSpan { min, max, basis: Basis::Given, values: None };
                Coloring { style: classed, span, ends: Some([false; 2]) }
            }
            _ => self.ranged(style),
        }
    }

    fn ranged(self, style: Style) -> Coloring {
        let symmetric = style.colormap.diverging;
        let shared = ValueSpan::shared(&self.spans, symmetric);
        let is_range = |span: &ValueSpan| span.normalization(style.scale).is_ok();
        let span = shared.filter(is_range).or_else(|| ValueSpan::shared(&self.even, symmetric));
        let nothing = ValueSpan { min: 0.1, max: 1.0, basis: Basis::All, values: None };
        let span = span.or_else(|| self.spans.into_iter().next()).unwrap_or(nothing);
        let varies = self.values.filter(|[min, max]| min < max);
        let ends = varies.map(|[min, max]| [min < span.min, max > span.max]);
        Coloring { style, span, ends }
    }
}
