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

/// A step of 1, 2 or 5 × 10^exponent.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Step {
    digit: i64,
    exponent: i32,
}

impl Step {
    /// The smallest step of at least `size` > 0.
    #[must_use]
    pub fn at_least(size: f64) -> Self {
        // One decade lower than log10 says, lest its rounding skip a step.
        let start = magnitude(size) - 1;
        let steps = (start..).flat_map(|exponent| [1, 2, 5].map(|digit| Self { digit, exponent }));
        let enough = |step: &Self| step.size() >= size * (1.0 - 1e-9);
        steps.take(12).find(enough).unwrap_or(Self { digit: 1, exponent: start + 4 })
    }

    /// The step's length.
    #[must_use]
    pub fn size(self) -> f64 {
        times_power(self.digit as f64, self.exponent)
    }

    /// Its multiples inside an open interval, rising: exact decimals. One on an end in spite of rounding is not inside.
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

/// Ticks of an axis that spans `center ± half`; `at` is the offset from the centre. Where the leading
/// digits are all alike the labels are relative to `anchor`, or to a rounded centre without one.
#[must_use]
pub fn axis(center: f64, half: f64, step: Step, anchor: Option<f64>) -> Ticks {
    let far = (center.abs() + half) / step.size() > FAR;
    let reference = if far { anchor.unwrap_or_else(|| rounded(center, half)) } else { 0.0 };
    let middle = center - reference;
    // A tick on the border stays in spite of rounding.
    let border = half * (1.0 + 1e-9) + f64::EPSILON * center.abs();
    let first = ((middle - border) / step.size()).ceil() as i64;
    let last = ((middle + border) / step.size()).floor() as i64;
    let multiples: Vec<i64> = (first..=last).map(|k| k * step.digit).collect();
    let largest = multiples.iter().map(|m| m.abs()).max().unwrap_or_default();
    let exponent = label_exponent(largest as f64, step.exponent);
    let tick = |m: i64| Tick {
        at: times_power(m as f64, step.exponent) - middle,
        label: decimal(m, step.exponent - exponent),
    };
    let major = multiples.into_iter().map(tick).collect();
    Ticks { major, minor: Vec::new(), reference, exponent }
}

/// Ticks of a colour bar with at most about `most` labels; `at` is the position from 0 to 1.
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
pub struct Span {
    /// The middle.
    pub center: f64,
    /// Half the length.
    pub half: f64,
}

impl Positions for Span {
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
pub fn at(values: &[f64], positions: &impl Positions) -> Ticks {
    let mut values = values.to_vec();
    values.sort_by(f64::total_cmp);
    values.dedup();
    let label = |value: f64| trimmed(value).replace('-', "−");
    let tick = |value: f64| Some(Tick { at: positions.place(value)?, label: label(value) });
    Ticks { major: values.into_iter().filter_map(tick).collect(), ..Ticks::default() }
}

/// The tick of a value that is alone; none if it lies outside the range.
#[must_use]
pub fn of_one_value(norm: &Normalization, value: f64) -> Ticks {
    at(&[value], norm)
}

/// Even values, wherever the scale puts them.
fn evenly(norm: &Normalization, most: usize) -> Ticks {
    let half = 0.5 * (norm.max() - norm.min());
    let center = norm.min() + half;
    let step = Step::at_least(2.0 * half / most.max(1) as f64);
    let mut ticks = axis(center, half, step, None);
    for tick in &mut ticks.major {
        tick.at = norm.position(center + tick.at);
    }
    ticks
}

/// Decades; where there are fewer than two, 1, 2 and 5 of each.
fn log(norm: &Normalization, most: usize) -> Ticks {
    let decades = magnitude(norm.min())..=magnitude(norm.max());
    let is_inside = |v: f64| (-1e-9..=1.0 + 1e-9).contains(&norm.position(v));
    let inside: Vec<i32> = decades.clone().filter(|&k| is_inside(times_power(1.0, k))).collect();
    if inside.len() < 2 {
        let values = decades.flat_map(|k| [1, 2, 5].map(|digit| (digit, k)));
        return labelled(norm, values.filter(|&(d, k)| is_inside(times_power(d as f64, k))));
    }
    let stride = inside.len().div_ceil(most.max(2)) as i32;
    let (major, other) = inside.iter().partition(|&&k| k.rem_euclid(stride) == 0);
    let label = |k: i32| Tick { at: norm.position(times_power(1.0, k)), label: power_of_ten(k) };
    let between = if stride == 1 { parts_of(decades) } else { decade_values(other) };
    Ticks {
        major: Vec::into_iter(major).map(label).collect(),
        minor: between.into_iter().filter(|&v| is_inside(v)).map(|v| norm.position(v)).collect(),
        ..Ticks::default()
    }
}

/// Zero and the decades of both signs beyond the linear part.
fn symlog(norm: &Normalization, most: usize) -> Ticks {
    let decades = magnitude(norm.threshold()) + 1..=magnitude(norm.min().abs().max(norm.max()));
    let is_inside = |v: f64| (-1e-9..=1.0 + 1e-9).contains(&norm.position(v));
    let stride = (2 * decades.clone().count() + 1).div_ceil(most.max(3)) as i32;
    let last = *decades.end();
    let labelled = decades.clone().filter(|k| (last - k) % stride == 0);
    let mut major = vec![(0.0, "0".to_owned())];
    for k in labelled {
        major.push((times_power(1.0, k), power_of_ten(k)));
        major.push((-times_power(1.0, k), format!("−{}", power_of_ten(k))));
    }
    major.retain(|(value, _)| is_inside(*value));
    major.sort_by(|a, b| a.0.total_cmp(&b.0));
    let between = parts_of(decades).into_iter().flat_map(|v| [v, -v]);
    Ticks {
        major: major.into_iter().map(|(v, label)| Tick { at: norm.position(v), label }).collect(),
        minor: between.filter(|&v| is_inside(v)).map(|v| norm.position(v)).collect(),
        ..Ticks::default()
    }
}

/// 2 to 9 times each power of ten.
fn parts_of(decades: impl Iterator<Item = i32>) -> Vec<f64> {
    decades.flat_map(|k| (2..10).map(move |digit| times_power(f64::from(digit), k))).collect()
}

fn decade_values(decades: Vec<i32>) -> Vec<f64> {
    decades.into_iter().map(|k| times_power(1.0, k)).collect()
}

/// Ticks at digit × 10^k, in units of one power of ten.
fn labelled(norm: &Normalization, values: impl Iterator<Item = (i64, i32)>) -> Ticks {
    let values: Vec<(i64, i32)> = values.collect();
    let (digit, k) = values.last().copied().unwrap_or((1, 0));
    let exponent = label_exponent(digit as f64, k);
    let tick = |&(digit, k): &(i64, i32)| Tick {
        at: norm.position(times_power(digit as f64, k)),
        label: decimal(digit, k - exponent),
    };
    Ticks { major: values.iter().map(tick).collect(), exponent, ..Ticks::default() }
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
    use ppum_render::range::Range;
    use ppum_render::raster::Raster;

    fn labels(ticks: &Ticks) -> Vec<&str> {
        ticks.major.iter().map(|t| t.label.as_str()).collect()
    }

    fn norm(scale: Scale, min: f64, max: f64) -> Normalization {
        let empty = Raster::<f64>::new([0, 0], vec![]);
        Range::Fixed(min, max).normalization(scale, false, &empty).unwrap()
    }

    #[test]
    fn steps_are_nice_and_large_enough() {
        let step = |size| (Step::at_least(size).digit, Step::at_least(size).exponent);
        assert_eq!(step(0.9), (1, 0));
        assert_eq!(step(1.0), (1, 0));
        assert_eq!(step(1.1), (2, 0));
        assert_eq!(step(0.0021), (5, -3));
        assert_eq!(step(5.1e-13), (1, -12));
        assert_eq!(step(1e6), (1, 6));
        for k in -300..300 {
            let size = 3.7 * 10f64.powi(k);
            let found = Step::at_least(size).size();
            assert!(found >= size && found < 2.6 * size, "{size:e} {found:e}");
        }
    }

    #[test]
    fn an_ordinary_axis_has_plain_labels() {
        let ticks = axis(0.0, 1.0, Step::at_least(0.5), None);
        assert_eq!(labels(&ticks), ["−1.0", "−0.5", "0.0", "0.5", "1.0"]);
        assert_eq!((ticks.reference, ticks.exponent), (0.0, 0));
        assert_eq!(ticks.major[1].at, -0.5);
        let ticks = axis(50.0, 30.0, Step::at_least(19.0), None);
        assert_eq!(labels(&ticks), ["20", "40", "60", "80"]);
    }

    #[test]
    fn tiny_and_huge_numbers_have_a_power_of_ten() {
        let ticks = axis(0.0, 2.5e-5, Step::at_least(1e-5), None);
        assert_eq!(labels(&ticks), ["−2", "−1", "0", "1", "2"]);
        assert_eq!(ticks.exponent, -5);
        let ticks = axis(2e9, 2e9, Step::at_least(1e9), None);
        assert_eq!((labels(&ticks).join(" "), ticks.exponent), ("0 1 2 3 4".to_owned(), 9));
    }

    #[test]
    fn a_deep_axis_counts_from_the_tip() {
        let (tip, half) = (0.3, 5e-13);
        let center = tip + 2e-13;
        let ticks = axis(center, half, Step::at_least(1.9e-13), Some(tip));
        assert_eq!((ticks.reference, ticks.exponent), (tip, -13));
        assert_eq!(labels(&ticks), ["−2", "0", "2", "4", "6"]);
        // The tick at the tip is at the tip, to the last bit.
        assert_eq!(ticks.major[1].at, tip - center);
    }

    #[test]
    fn a_deep_axis_without_a_tip_counts_from_a_short_number() {
        let center = 1.0 / 3.0;
        let ticks = axis(center, 5e-9, Step::at_least(2e-9), None);
        assert_eq!(ticks.reference, 0.33333333);
        assert_eq!((labels(&ticks), ticks.exponent), (vec!["0", "2", "4", "6", "8"], -9));
        for tick in &ticks.major {
            let value: f64 = tick.label.parse().unwrap();
            assert!((center + tick.at - 0.33333333 - value * 1e-9).abs() < 1e-16);
        }
        assert_eq!(axis(7654321.0, 4.0, Step::at_least(2.0), None).reference, 7654320.0);
        assert_eq!(axis(7654321.0, 40.0, Step::at_least(20.0), None).reference, 7654300.0);
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
        let ticks = at(&[2.0, -0.5, 7.0, f64::NAN, -0.5, 1e-7], &norm(Scale::Linear, -1.0, 3.0));
        assert_eq!(labels(&ticks), ["−0.5", "1e−7", "2"]);
        assert_eq!(ticks.major[2].at, 0.75);
        let ticks = at(&[0.3, 5.0, 0.1], &Span { center: 0.2, half: 0.1 });
        assert_eq!(labels(&ticks), ["0.1", "0.3"]);
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
