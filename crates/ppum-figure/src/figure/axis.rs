//! Axes, and what is written along them.

use ppum::crack::{Crack, tips};
use ppum::vec2::Vec2;

use super::ink::TICK_TEXT;
use super::style::{FigureStyle, Labels, TickChoice};
use crate::text;
use crate::ticks::{self, AxisSpan, Notation, TickStep, Ticks, power_of_ten};
use ppum_render::picture::ColoredRaster;

/// Least distances of labelled ticks, across and along the direction of reading.
const TICK_DISTANCE: [f64; 2] = [72.0, 44.0];

/// The smallest size of a label that is too long for its axis, in parts of that of others.
const SMALLEST: f64 = 0.7;

/// Part of the room that smaller letters take: widths are rounded.
const WITHIN: f64 = 0.999;

/// An axis or the bar: its ticks, what is written along it, and how wide its tick labels are.
pub(super) struct FigureAxis {
    pub(super) ticks: Ticks,
    pub(super) label: String,
    /// Bytes of the label that are the name; the rest is a number and units, which stay whole.
    name: usize,
    pub(super) widest: f64,
}

impl FigureAxis {
    pub(super) fn new(ticks: Ticks, label: &str, name: usize, scale: f64) -> Self {
        Self { label: label.to_owned(), name, widest: widest(&ticks, scale), ticks }
    }

    /// The label and its size, for a size that it has where it fits into some room \[pixels\].
    /// Where its name, the power of ten and the unit do not fit, letters are smaller, down to
    /// [`SMALLEST`]; then words of the name give way, to half of the room at least, and last the
    /// power of ten and the unit. Digits of the number behind the name have what is left.
    pub(super) fn fitted(&self, size: f64, room: f64) -> (String, f64) {
        let (name, rest) = self.label.split_at(self.name);
        let (number, measure) = rest.split_at(rest.find(" [").unwrap_or(rest.len()));
        let least = text::width(name, size) + text::width(measure, size);
        let size = if least > room { size * (WITHIN * room / least).max(SMALLEST) } else { size };
        let kept = (room - text::width(measure, size)).max(0.5 * room);
        let name = text::abbreviated(name, size, kept);
        let room = room - text::width(&name, size);
        let measure = text::fitted(measure, size, room);
        let number = text::fitted(number, size, room - text::width(&measure, size));
        (format!("{name}{number}{measure}"), size)
    }
}

/// Width of the widest label.
fn widest(ticks: &Ticks, scale: f64) -> f64 {
    let widths = ticks.major.iter().map(|tick| text::width(&tick.label, TICK_TEXT * scale));
    widths.fold(0.0, f64::max)
}

/// Where labels stand along an axis whose marks lie at `at`, rising or falling: there, but two that
/// would touch move apart, out of an axis that is shorter than they are. `lengths` are theirs along
/// the axis.
pub(super) fn label_places(at: &[f64], lengths: &[f64], gap: f64) -> Vec<f64> {
    let (&[a, b], &[first, second]) = (at, lengths) else { return at.to_vec() };
    let missing = (0.5 * (first + second) + gap - (b - a).abs()).max(0.0);
    let out = 0.5 * missing.copysign(b - a);
    vec![a - out, b + out]
}

/// The axes x and y, with the same step where that leaves y two ticks at least.
pub(super) fn axes(
    picture: &ColoredRaster,
    labels: &Labels,
    cracks: &[Crack],
    style: &FigureStyle,
) -> [FigureAxis; 2] {
    let (view, scale) = (&picture.view, style.scale());
    let half = view.half();
    let step = |distance: f64| TickStep::at_least(distance * scale * view.pixel_size());
    let [across, along] = TICK_DISTANCE.map(step);
    let (x_step, y_step) = (across, if half.y > across.size() { across } else { along });
    let tip = nearest_tip(picture, cracks);
    let axis =
        |span: AxisSpan, step: TickStep, choice: &TickChoice, tip: Option<f64>, name: &str| {
            let ticks = match choice {
                TickChoice::Auto => ticks::axis_with_two(span.center, span.half, step, tip),
                TickChoice::Count(count) => {
                    let step = TickStep::at_least(2.0 * span.half / (*count).max(1) as f64);
                    let ticks = if *count > 1 { ticks::axis_with_two } else { ticks::axis };
                    ticks(span.center, span.half, step, tip)
                }
                TickChoice::At(values) => ticks::at(values, &span, Notation::PLAIN),
            };
            let label = axis_label(name, &ticks, &labels.length_unit);
            FigureAxis::new(ticks, &label, name.len(), scale)
        };
    let [x, y] = [(view.center.x, half.x), (view.center.y, half.y)]
        .map(|(center, half)| AxisSpan { center, half });
    [
        axis(x, x_step, &style.x_ticks, tip.map(|t| t.x), &labels.x),
        axis(y, y_step, &style.y_ticks, tip.map(|t| t.y), &labels.y),
    ]
}

/// The tip in the view that is nearest to its centre.
fn nearest_tip(picture: &ColoredRaster, cracks: &[Crack]) -> Option<Vec2> {
    let view = &picture.view;
    let offset = |p: Vec2| p - view.center;
    let is_seen =
        |p: &Vec2| offset(*p).x.abs() <= view.half().x && offset(*p).y.abs() <= view.half().y;
    tips(cracks)
        .map(|tip| cracks[tip.crack as usize].end_point(tip.end))
        .filter(is_seen)
        .min_by(|&a, &b| offset(a).length().total_cmp(&offset(b).length()))
}

/// "name − reference [×10ᵏ unit]", each part where it is needed; nothing along an axis without a
/// name and units.
#[must_use]
pub fn axis_label(name: &str, ticks: &Ticks, unit: &str) -> String {
    let mut label = name.to_owned();
    if ticks.reference != 0.0 {
        let sign = if ticks.reference > 0.0 { '−' } else { '+' };
        label = format!("{name} {sign} {}", ticks.reference.abs());
    }
    let power = match ticks.exponent {
        0 => String::new(),
        k => format!("×{}", power_of_ten(k)),
    };
    let parts = [power.as_str(), unit].into_iter().filter(|part| !part.is_empty());
    let measure = parts.collect::<Vec<_>>().join(" ");
    if measure.is_empty() { label } else { format!("{label} [{measure}]").trim_start().to_owned() }
}

#[cfg(test)]
mod tests {
    use super::*;
    use ppum::crack::CrackEnd;
    use ppum::vec2::vec2;
    use ppum_render::picture::Style;
    use ppum_render::raster::Raster;
    use ppum_render::view::View;
    use ppum_testkit::random::Random;

    fn labels() -> Labels {
        Labels { length_unit: "mm".to_owned(), ..Labels::default() }
    }

    #[test]
    fn deep_axes_count_from_the_nearest_tip_in_view() {
        let tip = vec2(0.3, -0.7);
        let crack = |tip: Vec2| {
            Crack::polyline(vec![tip + vec2(-0.1, 0.0), tip], [CrackEnd::Mouth, CrackEnd::Tip])
        };
        let cracks = [crack(tip + vec2(3e-10, 0.0)), crack(tip), crack(tip + vec2(1e-8, 0.0))];
        let view = View::new(tip, 1e-9, [300, 300]).unwrap();
        let raster = Raster::from_fn(view.pixels, |i, _| f64::from(i));
        let picture = ColoredRaster::bare(&raster, &view, &Style::default()).unwrap();
        let [x, y] = axes(&picture, &labels(), &cracks, &FigureStyle::pixels([640, 480]));
        assert_eq!(
            (x.label.as_str(), y.label.as_str()),
            ("x − 0.3 [×10⁻¹⁰ mm]", "y + 0.7 [×10⁻¹⁰ mm]")
        );
        assert!(x.ticks.major.iter().any(|t| t.at == 0.0 && t.label == "0"));
    }

    #[test]
    fn labels_have_only_the_parts_they_need() {
        let ticks = |reference, exponent| Ticks { reference, exponent, ..Ticks::default() };
        assert_eq!(axis_label("x", &ticks(0.0, 0), ""), "x");
        assert_eq!(axis_label("x", &ticks(0.0, 0), "mm"), "x [mm]");
        assert_eq!(axis_label("u", &ticks(0.0, -4), ""), "u [×10⁻⁴]");
        assert_eq!(axis_label("", &ticks(0.0, 3), "MPa"), "[×10³ MPa]");
        assert_eq!(axis_label("x", &ticks(0.25, 0), ""), "x − 0.25");
    }

    /// A name that is too long gives way to the power of ten and the unit.
    #[test]
    fn shortened_labels_keep_their_units() {
        let (ticks, name) = (Ticks { exponent: -4, ..Ticks::default() }, "x + ".repeat(99));
        let label = axis_label(&name, &ticks, "mm");
        let axis = FigureAxis::new(ticks, &label, name.len(), 1.0);
        let (label, size) = axis.fitted(12.0, 200.0);
        assert!(label.starts_with("x + ") && label.ends_with(" [×10⁻⁴ mm]"), "{label}");
        assert!(label.contains('…') && text::width(&label, size) <= 200.0, "{label}");
        let (label, size) = axis.fitted(12.0, 20.0);
        assert!(text::width(&label, size) <= 20.0);
        assert_eq!(axis.fitted(12.0, 1e6), (axis.label, 12.0));
    }

    /// A tip has a place of many digits, which give way to the power of ten that ticks are in.
    #[test]
    fn places_of_many_digits_keep_their_powers() {
        let ticks = Ticks { reference: 0.5_f64.sqrt() / 2.0, exponent: -12, ..Ticks::default() };
        let axis = FigureAxis::new(ticks.clone(), &axis_label("y", &ticks, "mm"), 1, 1.0);
        let mut shown = 0;
        for room in [120.0, 150.0, 180.0, 210.0] {
            let (label, size) = axis.fitted(14.0, room);
            assert!(label.starts_with('y') && label.ends_with("… [×10⁻¹² mm]"), "{label}");
            assert!(text::width(&label, size) <= room && label.len() >= shown, "{label}");
            assert_eq!(size, 14.0);
            shown = label.len();
        }
        assert!(axis.fitted(14.0, 210.0).0.starts_with("y − 0.3"));
    }

    /// In a figure of 2 to 5 cm the power of ten and the words of a name stay whole: letters are
    /// smaller first, then whole words are left out.
    #[test]
    fn narrow_labels_shrink_before_they_are_shortened() {
        let of = |name: &str, exponent: i32| {
            let ticks = Ticks { exponent, ..Ticks::default() };
            FigureAxis::new(ticks.clone(), &axis_label(name, &ticks, ""), name.len(), 1.0)
        };
        for room in 55..400 {
            let room = f64::from(room);
            for (name, exponent) in [("y", -12), ("von Mises stress", 6), ("von Mises stress", 0)] {
                let axis = of(name, exponent);
                let (label, size) = axis.fitted(14.0, room);
                assert!(text::width(&label, size) <= room + 1e-9, "{label}");
                let full = text::width(&axis.label, 14.0);
                assert!(label == axis.label || SMALLEST * full > room, "{label} {room}");
                assert_eq!(size == 14.0, full <= room, "{label} {room}");
            }
        }
        let (label, _) = of("von Mises stress", 6).fitted(14.0, 110.0);
        assert!(["von… [×10⁶]", "von Mises… [×10⁶]"].contains(&label.as_str()), "{label}");
    }

    /// Whatever the lengths of name and unit, both begin in the label, and a power of ten is whole.
    #[test]
    fn names_are_never_lost_to_units() {
        let mut random = Random(7);
        for _ in 0..300 {
            let word = |random: &mut Random, letter: &str| letter.repeat(1 + random.below(80));
            let (name, unit) = (word(&mut random, "n"), word(&mut random, "u"));
            let ticks = Ticks { exponent: -4, ..Ticks::default() };
            let label = axis_label(&name, &ticks, &unit);
            let axis = FigureAxis::new(ticks, &label, name.len(), 1.0);
            let room = random.between(160.0, 600.0);
            let (found, size) = axis.fitted(14.0, room);
            assert!(text::width(&found, size) <= room + 1e-3, "{found}");
            assert!(found.starts_with('n') && found.contains(" [×10⁻⁴"), "{found}");
            let whole = text::width(&name, 14.0) <= 0.5 * room;
            assert!(!whole || found.starts_with(&name), "{found}");
        }
    }
}
