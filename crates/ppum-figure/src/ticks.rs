//! Ticks of axes and colour bars, and their labels.
//!
//! Labels stay short at any zoom: numbers are written relative to a *reference* where their leading
//! digits are all alike ("x − 0.5"), and in units of a power of ten where they are tiny or huge.
//! Ticks are integer multiples of 1, 2 or 5 × 10^k, so labels are exact decimals.

use ppum::text::trimmed;

use ppum_render::scale::{Normalization, Scale};

/// A labelled mark.
#[derive(Clone, Debug, PartialEq)]
pub struct Tick {
    /// Its place: the offset from the axis' middle, or the position along the colour bar.
    pub at: f64,
    /// The label.
    pub label: String,
}

/// The marks of an axis or a colour bar. A label says (value − reference) / 10^exponent.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Ticks {
    /// Labelled marks, rising.
    pub major: Vec<Tick>,
    /// Marks without a label.
    pub minor: Vec<f64>,
    /// The number that is subtracted from the values.
    pub reference: f64,
    /// The power of ten that the labels are multiples of.
    pub exponent: i32,
}

impl Ticks {
    /// Marks whose labels are written in one notation.
    pub(crate) fn new(major: Vec<Tick>, notation: Notation) -> Self {
        let Notation { reference, exponent, .. } = notation;
        Self { major, minor: Vec::new(), reference, exponent }
    }

    /// Leaves the first and the last of the labels; the other marks have none.
    #[must_use]
    pub fn ends(mut self) -> Self {
        if self.major.len() > 2 {
            let last = self.major.len() - 1;
            self.minor.extend(self.major.drain(1..last).map(|tick| tick.at));
        }
        self
    }
}

/// The way the numbers of one range of values are written, wherever they stand: (value −
/// reference) / 10^exponent, or, of a range of many decades, digits × 10^k.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Notation {
    /// The number that is subtracted from the values.
    pub reference: f64,
    /// The power of ten that the numbers are multiples of.
    pub exponent: i32,
    /// True if all numbers but 0 have powers of ten of their own.
    has_powers: bool,
}

impl Notation {
    /// Numbers as they are.
    pub const PLAIN: Self = Self { reference: 0.0, exponent: 0, has_powers: false };

    /// The notation of a colour bar, of its marks and of levels between them.
    #[must_use]
    pub fn of(norm: &Normalization) -> Self {
        let has_powers = match norm.scale() {
            Scale::Linear => false,
            Scale::Log => whole_decades(norm).len() > 1,
            Scale::SymLog => signed_decades(norm, 1).len() > 1,
        };
        if has_powers {
            return Self { has_powers, ..Self::PLAIN };
        }
        let half = 0.5 * norm.max() - 0.5 * norm.min();
        Self::spanning(norm.min() + half, half)
    }

    /// The notation of the values `center ± half`: with a reference where their leading digits are
    /// all alike.
    fn spanning(center: f64, half: f64) -> Self {
        let far = center.abs() + half > FAR * half * (2.0 / STEPS);
        let reference = if far { rounded(center, half) } else { 0.0 };
        let farthest = (center - reference).abs() + half + 2.0 * f64::EPSILON * center.abs();
        Self { reference, exponent: label_exponent(farthest, 0), has_powers: false }
    }

    /// A number in this notation, without a `×10ᵏ` that stands in a bar's label; of its own where
    /// it is much smaller or larger than that.
    #[must_use]
    pub fn label(&self, value: f64) -> String {
        let number = (value - self.reference) / 10f64.powi(self.exponent);
        let is_short = PLAIN_NUMBERS.contains(&number.abs());
        let written = match number {
            0.0 => "0".to_owned(),
            _ if self.has_powers || !is_short => with_power(number),
            _ => trimmed(number),
        };
        written.replace('-', "−")
    }

    /// The number that a label says; none of one with a power of ten of its own.
    pub(crate) fn read(&self, label: &str) -> Option<f64> {
        let number: f64 = label.replace('−', "-").parse().ok()?;
        Some(number * 10f64.powi(self.exponent) + self.reference)
    }
}

/// Sizes of numbers that are written without a power of ten, though a bar has none below 0.001.
const PLAIN_NUMBERS: std::ops::Range<f64> = 1e-4..1e5;

/// A number as digits × 10^k, one of them left out if it says nothing.
#[must_use]
pub(crate) fn with_power(number: f64) -> String {
    let text = format!("{number:.5e}");
    let (digits, k) = text.split_once('e').unwrap_or((&text, "0"));
    let (digits, k) = (digits.trim_end_matches('0').trim_end_matches('.'), k.parse().unwrap_or(0));
    match digits {
        "1" => power_of_ten(k),
        "-1" => format!("-{}", power_of_ten(k)),
        _ if k == 0 => digits.to_owned(),
        _ => format!("{digits}×{}", power_of_ten(k)),
    }
}

/// A step of 1, 2 or 5 × 10^exponent.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct TickStep {
    digit: i64,
    exponent: i32,
}

impl TickStep {
    /// The smallest step of at least `size` > 0.
    #[must_use]
    pub fn at_least(size: f64) -> Self {
        // One decade lower than log10 says, lest its rounding skip a step.
        let start = magnitude(size) - 1;
        let steps = (start..).flat_map(|exponent| [1, 2, 5].map(|digit| Self { digit, exponent }));
        let enough = |step: &Self| step.size() >= size * (1.0 - 1e-9);
        steps.take(12).find(enough).unwrap_or(Self { digit: 1, exponent: start + 4 })
    }

    /// The next smaller one.
    #[must_use]
    pub fn finer(self) -> Self {
        match self.digit {
            5 => Self { digit: 2, ..self },
            2 => Self { digit: 1, ..self },
            _ => Self { digit: 5, exponent: self.exponent - 1 },
        }
    }

    /// The step's length.
    #[must_use]
    pub fn size(self) -> f64 {
        times_power(self.digit as f64, self.exponent)
    }

    /// Its multiples inside an open interval, rising: exact decimals. One on an end in spite of
    /// rounding is not inside.
    #[must_use]
    pub fn multiples(self, min: f64, max: f64) -> Vec<f64> {
        let border = 1e-9 * (max - min);
        let first = ((min + border) / self.size()).ceil() as i64;
        let last = ((max - border) / self.size()).floor() as i64;
        let value = |k: i64| times_power((k * self.digit) as f64, self.exponent);
        (first..=last).map(value).filter(|v| *v > min && *v < max).collect()
    }
}

/// The numbers digit × 10^k inside an open interval of positive numbers, rising if the digits do.
pub(crate) fn decades([min, max]: [f64; 2], digits: &[i64]) -> Vec<f64> {
    if !(min > 0.0 && max > min) {
        return Vec::new();
    }
    let value = |k: i32| digits.iter().map(move |&digit| times_power(digit as f64, k));
    let all = (magnitude(min) - 1..=magnitude(max) + 1).flat_map(value);
    all.filter(|v| *v > min * (1.0 + 1e-9) && *v < max * (1.0 - 1e-9)).collect()
}

/// Values that need more steps than this to reach get a reference: labels then have at most about
/// six characters.
const FAR: f64 = 1e4;
/// Steps of a range of values, roughly.
const STEPS: f64 = 5.0;

/// Ticks of an axis that spans `center ± half`; `at` is the offset from the centre. Where the
/// leading digits are all alike the labels are relative to `anchor`, or to a rounded centre without
/// one.
#[must_use]
pub fn axis(center: f64, half: f64, step: TickStep, anchor: Option<f64>) -> Ticks {
    let far = (center.abs() + half) / step.size() > FAR;
    let reference = if far { anchor.unwrap_or_else(|| rounded(center, half)) } else { 0.0 };
    let multiples = multiples(center - reference, half, center, step);
    let largest = multiples.iter().map(|m| m.abs()).max().unwrap_or_default();
    let exponent = label_exponent(largest as f64, step.exponent);
    let notation = Notation { reference, exponent, has_powers: false };
    labelled_multiples(&multiples, center, step, notation)
}

/// Returns ticks with a finer step where there were fewer than two marks; of those at most two are
/// labelled, the outermost ones.
#[must_use]
pub fn axis_with_two(center: f64, half: f64, step: TickStep, anchor: Option<f64>) -> Ticks {
    let coarse = axis(center, half, step, anchor);
    if coarse.major.len() > 1 {
        return coarse;
    }
    let steps = std::iter::successors(Some(step), |step| Some(step.finer())).take(STEPS_TO_TWO);
    let mut fine = steps.map(|step| axis(center, half, step, anchor));
    fine.find(|ticks| ticks.major.len() > 1).map_or(coarse, Ticks::ends)
}

/// Steps from any length to one that fits twice into a span not 1000 times as short.
const STEPS_TO_TWO: usize = 12;

/// The multiples of a step, in units of its power of ten, on `middle ± half`, which are
/// `center ± half` without a reference.
fn multiples(middle: f64, half: f64, center: f64, step: TickStep) -> Vec<i64> {
    // A tick on the border stays in spite of rounding.
    let border = half * (1.0 + 1e-9) + f64::EPSILON * center.abs();
    let first = ((middle - border) / step.size()).ceil() as i64;
    let last = ((middle + border) / step.size()).floor() as i64;
    (first..=last).map(|k| k * step.digit).collect()
}

/// Ticks at multiples of a step; `at` is the offset from the centre.
fn labelled_multiples(multiples: &[i64], center: f64, step: TickStep, notation: Notation) -> Ticks {
    let middle = center - notation.reference;
    let tick = |&m: &i64| Tick {
        at: times_power(m as f64, step.exponent) - middle,
        label: decimal(m, step.exponent - notation.exponent),
    };
    Ticks::new(multiples.iter().map(tick).collect(), notation)
}

/// Ticks of a colour bar with at most about `most` labels, and two at least; `at` is the position
/// from 0 to 1.
#[must_use]
pub fn bar(norm: &Normalization, most: usize) -> Ticks {
    let ticks = match norm.scale() {
        Scale::Linear => Ticks::default(),
        Scale::Log => log(norm, most),
        Scale::SymLog => symlog(norm, most),
    };
    if ticks.major.len() < 2 { evenly(norm, most) } else { ticks }
}

/// Where the values of an axis lie on it.
pub trait Positions {
    /// The place of a value as ticks have it; none if it lies outside.
    fn place(&self, value: f64) -> Option<f64>;
}

/// A part of an axis, `center ± half`; places are offsets from the centre.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct AxisSpan {
    /// The middle.
    pub center: f64,
    /// Half the length.
    pub half: f64,
}

impl Positions for AxisSpan {
    fn place(&self, value: f64) -> Option<f64> {
        let offset = value - self.center;
        (offset.abs() <= self.half * (1.0 + 1e-9)).then_some(offset)
    }
}

impl Positions for Normalization {
    fn place(&self, value: f64) -> Option<f64> {
        (self.min()..=self.max()).contains(&value).then(|| self.position(value))
    }
}

/// Ticks at given values, in any order; those that lie outside are left out.
#[must_use]
pub fn at(values: &[f64], positions: &impl Positions, notation: Notation) -> Ticks {
    let mut values = values.to_vec();
    values.sort_by(f64::total_cmp);
    values.dedup();
    let tick =
        |value: f64| Some(Tick { at: positions.place(value)?, label: notation.label(value) });
    Ticks::new(values.into_iter().filter_map(tick).collect(), notation)
}

/// The tick of a value that is alone; none if it lies outside the range.
#[must_use]
pub fn of_one_value(norm: &Normalization, value: f64) -> Ticks {
    at(&[value], norm, Notation::of(norm))
}

/// Even values, wherever the scale puts them; two at least: if there would be more than `most`
/// then, the outermost ones.
fn evenly(norm: &Normalization, most: usize) -> Ticks {
    let (half, notation) = (0.5 * norm.max() - 0.5 * norm.min(), Notation::of(norm));
    let center = norm.min() + half;
    let all = |step: TickStep| multiples(center - notation.reference, half, center, step);
    let first = TickStep::at_least(2.0 * (half / most.max(1) as f64));
    let steps = std::iter::successors(Some(first), |step| Some(step.finer()));
    let has_enough = |step: &TickStep| all(*step).len() >= most.min(2);
    let step = steps.take(STEPS_TO_TWO).find(has_enough).unwrap_or(first);
    let mut ticks = labelled_multiples(&all(step), center, step, notation);
    for tick in &mut ticks.major {
        tick.at = norm.position(center + tick.at);
    }
    if step != first && ticks.major.len() > most { ticks.ends() } else { ticks }
}

/// The powers of ten in the range of a logarithmic scale.
fn whole_decades(norm: &Normalization) -> Vec<i32> {
    let decades = magnitude(norm.min())..=magnitude(norm.max());
    decades.filter(|&k| is_inside(norm, times_power(1.0, k))).collect()
}

fn is_inside(norm: &Normalization, value: f64) -> bool {
    (-1e-9..=1.0 + 1e-9).contains(&norm.position(value))
}

/// Decades; where there are fewer than two, 1, 2 and 5 of each.
fn log(norm: &Normalization, most: usize) -> Ticks {
    let decades = magnitude(norm.min())..=magnitude(norm.max());
    let inside = whole_decades(norm);
    if inside.len() < 2 {
        let notation = Notation::of(norm);
        let tick = |(digit, k): (i64, i32)| {
            let (value, label) =
                (times_power(digit as f64, k), decimal(digit, k - notation.exponent));
            is_inside(norm, value).then(|| Tick { at: norm.position(value), label })
        };
        let values = decades.flat_map(|k| [1, 2, 5].map(|digit| (digit, k)));
        return Ticks::new(values.filter_map(tick).collect(), notation);
    }
    let stride = inside.len().div_ceil(most.max(2)) as i32;
    let (mut major, mut other): (Vec<i32>, Vec<i32>) =
        inside.iter().partition(|&&k| k.rem_euclid(stride) == 0);
    if major.len() < 2 {
        major = vec![inside[0], inside[inside.len() - 1]];
        other = inside[1..inside.len() - 1].to_vec();
    }
    let label = |k: i32| Tick { at: norm.position(times_power(1.0, k)), label: power_of_ten(k) };
    let between = match stride {
        1 => parts_of(decades),
        _ => other.into_iter().map(|k| times_power(1.0, k)).collect(),
    };
    let between = between.into_iter().filter(|&v| is_inside(norm, v));
    Ticks {
        major: major.into_iter().map(label).collect(),
        minor: between.map(|v| norm.position(v)).collect(),
        ..Ticks::default()
    }
}

/// Zero and the decades of both signs beyond the linear part.
fn symlog(norm: &Normalization, most: usize) -> Ticks {
    let decades = beyond_threshold(norm);
    let stride = (2 * decades.clone().count() + 1).div_ceil(most.max(3));
    let all = signed_decades(norm, 1);
    let mut major = signed_decades(norm, stride);
    if let ([first, .., last], true) = (&all[..], major.len() < 2) {
        major = vec![first.clone(), last.clone()];
    }
    let between = parts_of(decades).into_iter().flat_map(|v| [v, -v]);
    Ticks {
        major: major.into_iter().map(|(v, label)| Tick { at: norm.position(v), label }).collect(),
        minor: between.filter(|&v| is_inside(norm, v)).map(|v| norm.position(v)).collect(),
        ..Ticks::default()
    }
}

/// The decades of a symmetric scale beyond its linear part.
fn beyond_threshold(norm: &Normalization) -> std::ops::RangeInclusive<i32> {
    magnitude(norm.threshold()) + 1..=magnitude(norm.min().abs().max(norm.max()))
}

/// Zero and every so many of the decades of both signs, rising, with their labels.
fn signed_decades(norm: &Normalization, stride: usize) -> Vec<(f64, String)> {
    let decades = beyond_threshold(norm);
    let mut all = vec![(0.0, "0".to_owned())];
    for k in decades.rev().step_by(stride.max(1)) {
        all.push((times_power(1.0, k), power_of_ten(k)));
        all.push((-times_power(1.0, k), format!("−{}", power_of_ten(k))));
    }
    all.retain(|(value, _)| is_inside(norm, *value));
    all.sort_by(|a, b| a.0.total_cmp(&b.0));
    all
}

/// 2 to 9 times each power of ten.
fn parts_of(decades: impl Iterator<Item = i32>) -> Vec<f64> {
    decades.flat_map(|k| (2..10).map(move |digit| times_power(f64::from(digit), k))).collect()
}

/// 10^k in figures, e.g. 10⁻³.
#[must_use]
pub fn power_of_ten(k: i32) -> String {
    let raised = |c: char| match c {
        '-' => '⁻',
        '1' => '¹',
        '2' => '²',
        '3' => '³',
        digit => {
            char::from_u32(u32::from('⁰') + u32::from(digit) - u32::from('0')).unwrap_or(digit)
        }
    };
    format!("10{}", k.to_string().chars().map(raised).collect::<String>())
}

/// Largest k with 10^k ≤ |x|, up to rounding.
fn magnitude(x: f64) -> i32 {
    x.abs().max(f64::MIN_POSITIVE).log10().floor() as i32
}

/// m × 10^k, rounded once for |k| ≤ 22.
fn times_power(m: f64, k: i32) -> f64 {
    if k < 0 { m / 10f64.powi(-k) } else { m * 10f64.powi(k) }
}

/// The power of ten to write numbers up to m × 10^k in: none from 0.001 to 99999.
fn label_exponent(m: f64, k: i32) -> i32 {
    let largest = k + if m > 0.0 { magnitude(m) } else { 0 };
    if (-3..5).contains(&largest) { 0 } else { largest }
}

/// m × 10^k as a decimal number with exactly −k digits behind the point.
fn decimal(m: i64, k: i32) -> String {
    let digits = usize::try_from(-k).unwrap_or(0);
    format!("{:.digits$}", times_power(m as f64, k)).replace('-', "−")
}

/// The shortest decimal number within the span's length of the centre.
fn rounded(center: f64, half: f64) -> f64 {
    let k = magnitude(2.0 * half);
    let near = |r: &f64| (center - r).abs() <= 2.0 * half;
    [k + 2, k + 1]
        .into_iter()
        .map(|k| round_to(center, k))
        .find(near)
        .unwrap_or(round_to(center, k))
}

/// The multiple of 10^k nearest to `x`.
fn round_to(x: f64, k: i32) -> f64 {
    if k >= 0 {
        return times_power(times_power(x, -k).round(), k);
    }
    let digits = k.unsigned_abs() as usize;
    format!("{x:.digits$}").parse().expect("a formatted number is a number")
}

#[cfg(test)]
mod tests {
    use super::*;
    use ppum_render::range::RangeChoice;
    use ppum_render::raster::Raster;
    use ppum_testkit::random::Random;

    fn labels(ticks: &Ticks) -> Vec<&str> {
        ticks.major.iter().map(|t| t.label.as_str()).collect()
    }

    fn norm(scale: Scale, min: f64, max: f64) -> Normalization {
        let empty = Raster::<f64>::new([0, 0], vec![]);
        RangeChoice::Fixed(min, max).span(scale, false, &empty, None).normalization(scale).unwrap()
    }

    #[test]
    fn steps_are_nice_and_large_enough() {
        let step = |size| (TickStep::at_least(size).digit, TickStep::at_least(size).exponent);
        assert_eq!(step(0.9), (1, 0));
        assert_eq!(step(1.0), (1, 0));
        assert_eq!(step(1.1), (2, 0));
        assert_eq!(step(0.0021), (5, -3));
        assert_eq!(step(5.1e-13), (1, -12));
        assert_eq!(step(1e6), (1, 6));
        for k in -300..300 {
            let size = 3.7 * 10f64.powi(k);
            let found = TickStep::at_least(size).size();
            assert!(found >= size && found < 2.6 * size, "{size:e} {found:e}");
        }
    }

    #[test]
    fn an_ordinary_axis_has_plain_labels() {
        let ticks = axis(0.0, 1.0, TickStep::at_least(0.5), None);
        assert_eq!(labels(&ticks), ["−1.0", "−0.5", "0.0", "0.5", "1.0"]);
        assert_eq!((ticks.reference, ticks.exponent), (0.0, 0));
        assert_eq!(ticks.major[1].at, -0.5);
        let ticks = axis(50.0, 30.0, TickStep::at_least(19.0), None);
        assert_eq!(labels(&ticks), ["20", "40", "60", "80"]);
    }

    #[test]
    fn tiny_and_huge_numbers_have_a_power_of_ten() {
        let ticks = axis(0.0, 2.5e-5, TickStep::at_least(1e-5), None);
        assert_eq!(labels(&ticks), ["−2", "−1", "0", "1", "2"]);
        assert_eq!(ticks.exponent, -5);
        let ticks = axis(2e9, 2e9, TickStep::at_least(1e9), None);
        assert_eq!((labels(&ticks).join(" "), ticks.exponent), ("0 1 2 3 4".to_owned(), 9));
    }

    #[test]
    fn a_deep_axis_counts_from_the_tip() {
        let (tip, half) = (0.3, 5e-13);
        let center = tip + 2e-13;
        let ticks = axis(center, half, TickStep::at_least(1.9e-13), Some(tip));
        assert_eq!((ticks.reference, ticks.exponent), (tip, -13));
        assert_eq!(labels(&ticks), ["−2", "0", "2", "4", "6"]);
        // The tick at the tip is at the tip, to the last bit.
        assert_eq!(ticks.major[1].at, tip - center);
    }

    #[test]
    fn a_deep_axis_without_a_tip_counts_from_a_short_number() {
        let center = 1.0 / 3.0;
        let ticks = axis(center, 5e-9, TickStep::at_least(2e-9), None);
        assert_eq!(ticks.reference, 0.33333333);
        assert_eq!((labels(&ticks), ticks.exponent), (vec!["0", "2", "4", "6", "8"], -9));
        for tick in &ticks.major {
            let value: f64 = tick.label.parse().unwrap();
            assert!((center + tick.at - 0.33333333 - value * 1e-9).abs() < 1e-16);
        }
        assert_eq!(axis(7654321.0, 4.0, TickStep::at_least(2.0), None).reference, 7654320.0);
        assert_eq!(axis(7654321.0, 40.0, TickStep::at_least(20.0), None).reference, 7654300.0);
    }

    #[test]
    fn log_bars_have_decades() {
        let ticks = bar(&norm(Scale::Log, 1e-3, 20.0), 12);
        assert_eq!(labels(&ticks), ["10⁻³", "10⁻²", "10⁻¹", "10⁰", "10¹"]);
        assert!(ticks.major[0].at.abs() < 1e-12);
        // 2 … 9 in four whole decades, and 20.
        assert_eq!(ticks.minor.len(), 33);
        let ticks = bar(&norm(Scale::Log, 1e-12, 1e12), 8);
        assert_eq!(labels(&ticks), ["10⁻¹²", "10⁻⁸", "10⁻⁴", "10⁰", "10⁴", "10⁸", "10¹²"]);
        assert_eq!(ticks.minor.len(), 18);
    }

    #[test]
    fn short_log_bars_have_plain_numbers() {
        let ticks = bar(&norm(Scale::Log, 0.4, 6.0), 12);
        assert_eq!(labels(&ticks), ["0.5", "1", "2", "5"]);
        assert!((ticks.major[1].at - (2.5f64.ln() / 15f64.ln())).abs() < 1e-12);
        let ticks = bar(&norm(Scale::Log, 2.1e-7, 2.9e-7), 5);
        assert_eq!((labels(&ticks).join(" "), ticks.exponent), ("2.2 2.4 2.6 2.8".to_owned(), -7));
    }

    #[test]
    fn symlog_bars_have_both_signs_and_zero() {
        let ticks = bar(&norm(Scale::SymLog, -100.0, 100.0), 12);
        assert_eq!(labels(&ticks), ["−10²", "−10¹", "−10⁰", "0", "10⁰", "10¹", "10²"]);
        assert_eq!((ticks.major[3].at, ticks.major[6].at), (0.5, 1.0));
        let positive = bar(&norm(Scale::SymLog, 200.0, 400.0), 5);
        assert_eq!(labels(&positive), ["200", "250", "300", "350", "400"]);
    }

    #[test]
    fn a_nearly_constant_bar_is_relative() {
        let ticks = bar(&norm(Scale::Linear, 0.5, 0.5 + 1e-9), 5);
        assert_eq!((ticks.reference, ticks.exponent), (0.5, -9));
        assert_eq!(labels(&ticks), ["0.0", "0.2", "0.4", "0.6", "0.8", "1.0"]);
    }

    #[test]
    fn ticks_at_given_values() {
        let norm = norm(Scale::Linear, -1.0, 3.0);
        let ticks = at(&[2.0, -0.5, 7.0, f64::NAN, -0.5, 1e-7], &norm, Notation::of(&norm));
        assert_eq!(labels(&ticks), ["−0.5", "10⁻⁷", "2"]);
        assert_eq!(ticks.major[2].at, 0.75);
        let ticks = at(&[0.3, 5.0, 0.1], &AxisSpan { center: 0.2, half: 0.1 }, Notation::PLAIN);
        assert_eq!(labels(&ticks), ["0.1", "0.3"]);
    }

    /// A range between random ends of any size, on any scale.
    fn random_norm(random: &mut Random) -> Normalization {
        let size = 10f64.powf(random.between(-12.0, 12.0));
        let near = random.pick(&[0.0, 0.0, 1.0, -30.0, 1e7]);
        let [a, b] = [random.between(-1.0, 1.0), random.between(-1.0, 1.0)];
        let [min, max] = [a.min(b), a.max(b).max(a.min(b) + 1e-3)].map(|v| (v + near) * size);
        match random.below(3) {
            0 if min > 0.0 => norm(Scale::Log, min, max),
            0 => norm(Scale::Log, 10f64.powf(random.between(-9.0, 0.0)) * size, size * 1.7),
            1 => norm(Scale::SymLog, min, max),
            _ => norm(Scale::Linear, min, max),
        }
    }

    /// Whatever the range, there are two labels at least, and they say where they are: the level of
    /// the same value is written as the bar writes it.
    #[test]
    fn scales_can_be_read() {
        let mut random = Random(19);
        for _ in 0..3000 {
            let norm = random_norm(&mut random);
            let most = 2 + random.below(9);
            let (ticks, notation) = (bar(&norm, most), Notation::of(&norm));
            assert!(ticks.major.len() >= 2, "{norm:?} {most}: {ticks:?}");
            assert_eq!(
                (ticks.reference, ticks.exponent),
                (notation.reference, notation.exponent),
                "{norm:?} {most}"
            );
            for Tick { at, label } in &ticks.major {
                let level = notation.label(norm.value(*at));
                let number = |text: &str| notation.read(text);
                match (number(label), number(&level)) {
                    (Some(a), Some(b)) => {
                        let off = (a - b).abs() / (norm.max() - norm.min());
                        assert!(off < 1e-4, "{norm:?}: {label} {level}");
                    }
                    // next to nothing beside the range
                    (Some(a), None) if a == notation.reference => {}
                    _ => assert_eq!(*label, level, "{norm:?}"),
                }
            }
        }
    }

    /// An axis that is shorter than the distance of its marks has two of them, near its ends.
    #[test]
    fn short_axes_have_two_marks() {
        let mut random = Random(20);
        for _ in 0..1000 {
            let half = 10f64.powf(random.between(-9.0, 6.0));
            let center = random.pick(&[0.0, 1.0, -7.3]) * half + random.between(-half, half);
            let step = TickStep::at_least(half * random.between(0.3, 100.0));
            let ticks = axis_with_two(center, half, step, None);
            let [first, .., last] = &ticks.major[..] else { panic!("{center} {half}: {ticks:?}") };
            assert!(last.at - first.at > 0.39 * half, "{center} {half}: {ticks:?}");
            assert_eq!(ticks.major.len() > 2, axis(center, half, step, None).major.len() > 2);
        }
    }

    #[test]
    fn numbers_have_the_notation_of_the_bar() {
        let label = |scale, min, max, value| Notation::of(&norm(scale, min, max)).label(value);
        assert_eq!(label(Scale::Linear, 0.0, 1.2e6, 2e5), "0.2");
        assert_eq!(label(Scale::Linear, -3e-7, 0.0, -2.5e-7), "−2.5");
        assert_eq!(label(Scale::Linear, 0.5, 0.5 + 1e-9, 0.5 + 2e-10), "0.2");
        assert_eq!(label(Scale::Log, 1e-4, 1e4, 2e-3), "2×10⁻³");
        assert_eq!(label(Scale::SymLog, -1e4, 1e4, -100.0), "−10²");
        assert_eq!(Notation::PLAIN.label(-2.5e7), "−2.5×10⁷");
    }

    #[test]
    fn one_value_has_one_tick() {
        let norm = norm(Scale::Linear, -6.0, -2.0);
        let ticks = of_one_value(&norm, -4.0);
        assert_eq!(labels(&ticks), ["−4"]);
        assert!((ticks.major[0].at - 0.5).abs() < 1e-15 && ticks.minor.is_empty());
        assert!(of_one_value(&norm, 1.0).major.is_empty(), "outside the range");
    }
}
