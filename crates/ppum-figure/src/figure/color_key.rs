//! The content of a colour bar.

use super::axis::{FigureAxis, axis_label};
use super::style::{Labels, TickChoice};
use crate::ticks::{self, Notation, Tick, Ticks};
use ppum_render::colormap::Colormap;
use ppum_render::image::Rgba;
use ppum_render::picture::ColoredRaster;
use ppum_render::range::Basis;
use ppum_render::scale::Normalization;

/// Characters of a number that is short.
const SHORT: usize = 6;
/// Rounding of the borders of bands, in parts of the range.
const ROUNDING: f64 = 1e-12;

/// The content of a colour bar: of a range of values, or of some values with a colour each.
#[derive(Clone, Debug)]
pub(super) struct ColorKey {
    pub(super) normalization: Normalization,
    pub(super) colormap: Colormap,
    pub(super) one_value: Option<f64>,
    pub(super) has_values: bool,
    pub(super) has_below: bool,
    pub(super) has_above: bool,
    /// Values beyond the ends that are told.
    pub(super) beyond: [Option<f64>; 2],
    pub(super) name: String,
    pub(super) unit: String,
}

impl ColorKey {
    pub(super) fn new(picture: &ColoredRaster, labels: &Labels) -> Self {
        let remark = match picture.one_value {
            _ if is_infinite(picture) => "no finite values",
            _ if !picture.has_values => "no values",
            Some(_) => "one value",
            None => "",
        };
        let words = [labels.quantity.as_str(), remark].into_iter().filter(|word| !word.is_empty());
        let name = words.collect::<Vec<_>>().join(", ");
        Self {
            normalization: picture.normalization,
            colormap: picture.colormap.clone(),
            one_value: picture.one_value,
            has_values: picture.has_values,
            has_below: picture.has_below,
            has_above: picture.has_above,
            beyond: beyond(picture),
            name,
            unit: labels.unit.clone(),
        }
    }

    /// One key for two images; none if a colour means one value here and another one there.
    pub(super) fn shared(mut self, other: &Self) -> Option<Self> {
        self.has_below |= other.has_below;
        self.has_above |= other.has_above;
        self.has_values |= other.has_values;
        let far = |k: usize, farther: fn(f64, f64) -> f64| {
            let both = [self.beyond[k], other.beyond[k]];
            both.into_iter().flatten().reduce(farther)
        };
        self.beyond = [far(0, f64::min), far(1, f64::max)];
        if self.one_value != other.one_value {
            self.one_value = None;
        }
        let is_same = self.normalization == other.normalization && self.colormap == other.colormap;
        is_same.then_some(self)
    }

    /// Marks at the borders of bands, if there are no more than `most` and short numbers say where
    /// they are.
    fn borders(&self, most: usize) -> Option<Ticks> {
        let bands = self.colormap.bands().filter(|&n| usize::from(n) < most)?;
        let norm = &self.normalization;
        let notation = Notation::of(norm);
        let tick = |k: u16| {
            let at = f64::from(k) / f64::from(bands);
            let (value, label) = (norm.value(at), notation.label(norm.value(at)));
            let error = (notation.read(&label)? - value).abs();
            let is_exact = error <= ROUNDING * (norm.max() - norm.min());
            (is_exact && label.chars().count() <= SHORT).then_some(Tick { at, label })
        };
        let major = (0..=bands).map(tick).collect::<Option<Vec<_>>>()?;
        Some(Ticks::new(major, notation))
    }

    /// Labels in the middle of the bands of values that have a colour each; where there are more
    /// than `most` some are left out.
    fn classes(&self, choice: &TickChoice, most: usize) -> Ticks {
        let classes = self.colormap.classes();
        let count = classes.len();
        let stride = |most: usize| count.div_ceil(most.max(1));
        let is_shown = |k: usize, value: f64| match choice {
            TickChoice::At(values) => values.contains(&value),
            TickChoice::Count(count) => k.is_multiple_of(stride(*count).max(stride(most))),
            TickChoice::Auto => k.is_multiple_of(stride(most)),
        };
        let notation = Notation::of(&self.normalization);
        let tick = |(k, &value): (usize, &f64)| Tick {
            at: (k as f64 + 0.5) / count as f64,
            label: notation.label(value),
        };
        let shown = classes.iter().enumerate().filter(|(k, value)| is_shown(*k, **value));
        Ticks::new(shown.map(tick).collect(), notation)
    }

    /// True if values have a colour each: the bar then has a band for each, of one length.
    pub(super) fn has_classes(&self) -> bool {
        !self.colormap.classes().is_empty()
    }

    /// The colour at a place from 0 to 1 along the bar; none where nothing has a finite value.
    pub(super) fn color(&self, at: f64) -> Rgba {
        let count = self.colormap.classes().len();
        match count {
            _ if !self.has_values => [0; 4],
            0 => self.colormap.color(at),
            _ => self.colormap.class_color(((at * count as f64) as usize).min(count - 1)),
        }
    }

    /// The marks of a bar with room for `most` labels.
    pub(super) fn axis(&self, choice: &TickChoice, most: usize, scale: f64) -> FigureAxis {
        let norm = &self.normalization;
        let found = match (choice, self.one_value) {
            _ if !self.has_values => Ticks::default(),
            _ if self.has_classes() => self.classes(choice, most),
            (TickChoice::At(values), _) => ticks::at(values, norm, Notation::of(norm)),
            (_, Some(value)) => ticks::of_one_value(norm, value),
            (TickChoice::Count(count), None) => ticks::bar(norm, *count),
            (TickChoice::Auto, None) => {
                self.borders(most).unwrap_or_else(|| ticks::bar(norm, most))
            }
        };
        let label = axis_label(&self.name, &found, &self.unit);
        FigureAxis::new(found, &label, self.name.len(), scale)
    }
}

/// How far values reach beyond a range that was found; of one that was given nothing is said.
fn beyond(picture: &ColoredRaster) -> [Option<f64>; 2] {
    if is_infinite(picture) {
        let ends = [(picture.has_below, f64::NEG_INFINITY), (picture.has_above, f64::INFINITY)];
        return ends.map(|(is_seen, end)| is_seen.then_some(end));
    }
    let is_told =
        picture.has_values && picture.one_value.is_none() && picture.span.basis != Basis::Given;
    if is_told { picture.span.beyond() } else { [None; 2] }
}

/// True if all values that there are are infinite.
fn is_infinite(picture: &ColoredRaster) -> bool {
    !picture.has_values && (picture.has_below || picture.has_above)
}
