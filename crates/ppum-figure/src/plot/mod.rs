//! Plots: curves over axes.
//!
//! A [`Plot`] has an axis for each direction, linear or logarithmic, and [`PlotCurve`]s in colours
//! that people with any colour vision tell apart, with dashes where there are more of them. Curves
//! break where a value is missing or has no place on its axis, and are cut off at the frame.

mod curves;
mod frame;
mod legend;
mod thin;

use ppum::vec2::{Vec2, vec2};
use ppum_render::image::Rgba;
use ppum_render::scale::Normalization;

use crate::canvas::{Canvas, CanvasItem, CanvasPath, StrokeStyle};
use crate::overlay::{LegendEntry, Symbol};
use curves::has_place;
pub use curves::{CurveStyle, Plot, PlotAxis, PlotCurve};
pub use frame::LEAST;
use frame::PlotFrame;
use legend::legend;
use thin::thinned;

/// Exponent p of the power law y = c x^p nearest to points in the logarithms of both (least
/// squares). None with fewer than two different x among the points whose coordinates are
/// both positive.
#[must_use]
pub fn slope(points: &[[f64; 2]]) -> Option<f64> {
    let positive = points.iter().filter(|p| p.iter().all(|v| *v > 0.0 && v.is_finite()));
    let logs: Vec<[f64; 2]> = positive.map(|p| p.map(f64::ln)).collect();
    let count = logs.len() as f64;
    let mean = |k: usize| logs.iter().map(|p| p[k]).sum::<f64>() / count;
    let (x, y) = (mean(0), mean(1));
    let spread: f64 = logs.iter().map(|p| (p[0] - x).powi(2)).sum();
    let both: f64 = logs.iter().map(|p| (p[0] - x) * (p[1] - y)).sum();
    (logs.len() > 1 && spread > 1e-20 * count).then(|| both / spread)
}

/// A curve's label with the exponent of its power law in so many decimals: `σ_yy, slope −0.500`.
#[must_use]
pub fn with_slope(label: &str, slope: f64, decimals: usize) -> String {
    let written = format!("{slope:.decimals$}");
    // zero has no sign
    let is_zero = written.trim_start_matches(['-', '0', '.']).is_empty();
    let written = if is_zero { written.trim_start_matches('-').to_owned() } else { written };
    format!("{label}, slope {}", written.replace('-', "−"))
}

/// Colours by M. Okabe and K. Ito (2008), told apart with any colour vision.
const COLORS: [Rgba; 7] = [
    [0, 114, 178, 255],
    [213, 94, 0, 255],
    [0, 158, 115, 255],
    [204, 121, 167, 255],
    [230, 159, 0, 255],
    [86, 180, 233, 255],
    [38, 38, 42, 255],
];
const WIDTH: f64 = 1.8;
const DOT: f64 = 3.2;
/// Dashes and gaps of the curves that have the colours once more, and of those after them.
const DASHES: [[f64; 2]; 4] = [[9.0, 4.0], [2.0, 3.0], [16.0, 4.0], [5.0, 7.0]];

/// Draws a plot of at least [`LEAST`] pixels; a smaller size is enlarged.
#[must_use]
pub fn plot(plot: &Plot, size: [u32; 2]) -> Canvas {
    let frame = PlotFrame::new(plot, size);
    let mut page = Canvas::new(frame.size, frame::PAPER);
    page.items.extend(frame.grid());
    page.items.push(inside(plot, &frame));
    page.items.extend(frame.lines());
    page.items.extend(frame.texts(plot));
    if plot.has_names_above {
        let named = plot.curves.iter().enumerate().filter(|(_, curve)| !curve.label.is_empty());
        let sample = |(k, curve): (usize, &PlotCurve)| pen(curve.look, k, frame.scale);
        let names: Vec<_> = named.map(|all| (sample(all), &*all.1.label)).collect();
        page.items.extend(frame.names(&names));
    }
    page
}

/// Where the curves of a plot lie on its page.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PlotArea {
    /// The upper left corner.
    pub corner: Vec2,
    /// Width and height.
    pub size: Vec2,
    norms: [Normalization; 2],
}

impl PlotArea {
    /// The area of a plot that [`plot`] draws in this size.
    #[must_use]
    pub fn new(plot: &Plot, size: [u32; 2]) -> Self {
        let frame = PlotFrame::new(plot, size);
        let [corner, size] = [frame.corner(), frame.pixels()].map(|c| c.map(f64::from).into());
        Self { corner, size, norms: frame.norms }
    }

    /// The value of the horizontal axis at a column of the page.
    #[must_use]
    pub fn across(&self, column: f64) -> f64 {
        self.norms[0].value((column - self.corner.x) / self.size.x)
    }

    /// The position of a point on the page; none of one that the axes have no place for.
    #[must_use]
    pub fn position(&self, point: [f64; 2]) -> Option<Vec2> {
        let is_seen = self.norms.iter().zip(point).all(|(norm, v)| has_place(norm.scale(), v));
        let [x, y] = [0, 1].map(|k| self.norms[k].position(point[k]));
        is_seen.then(|| self.corner + vec2(x * self.size.x, (1.0 - y) * self.size.y))
    }
}

/// The curves with their legend, on a page of the frame's size.
fn inside(plot: &Plot, frame: &PlotFrame) -> CanvasItem {
    let mut canvas = Canvas::new(frame.pixels(), [0; 4]);
    let (mut entries, mut paths) = (Vec::new(), Vec::new());
    let bars = plot.curves.iter().filter(|curve| curve.look == CurveStyle::Bars).count();
    for (k, curve) in plot.curves.iter().enumerate() {
        let color = COLORS[k % COLORS.len()];
        let pen = pen(curve.look, k, frame.scale);
        let is_bar = curve.look == CurveStyle::Bars;
        canvas.items.extend(if is_bar {
            let outline = bars_of(curve, [k, bars], frame);
            paths.extend(outline.pieces.clone());
            vec![CanvasItem::Fill { outline, color }]
        } else {
            let (items, path) = drawn(curve, pen, frame);
            paths.extend(path.pieces);
            items
        });
        if !curve.label.is_empty() {
            let symbol = if is_bar { Symbol::Square(color) } else { Symbol::Line(pen) };
            entries.push(LegendEntry::new(symbol, &curve.label));
        }
    }
    if !plot.has_names_above && (plot.curves.len() > 1 || entries.len() > 1) {
        canvas.items.extend(legend(frame.pixels(), &entries, &paths, frame.scale));
    }
    CanvasItem::Inset { corner: frame.corner(), canvas }
}

/// The pen of curve k: colours in turn, and dashes where they come again.
fn pen(look: CurveStyle, k: usize, scale: f64) -> StrokeStyle {
    let pen = StrokeStyle::new(COLORS[k % COLORS.len()], WIDTH * scale);
    let again = k / COLORS.len() + usize::from(look == CurveStyle::Dashed);
    match again.checked_sub(1) {
        Some(k) => {
            let [dash, gap] = DASHES[k % DASHES.len()].map(|length| length * scale);
            pen.dashed(dash, gap)
        }
        None => pen,
    }
}

/// The bars of curve k of `count`, side by side around their places.
fn bars_of(curve: &PlotCurve, [k, count]: [usize; 2], frame: &PlotFrame) -> CanvasPath {
    let width = 0.8 / count as f64;
    let mut path = CanvasPath::default();
    for &[x, y] in curve.points.iter().filter(|p| p.iter().all(|v| v.is_finite())) {
        let left = x - 0.4 + k as f64 * width;
        path.rect(frame.position([left, 0.0]), frame.position([left + 0.9 * width, y]));
    }
    path
}

/// The unbroken pieces of a curve, and its dots.
fn drawn(curve: &PlotCurve, pen: StrokeStyle, frame: &PlotFrame) -> (Vec<CanvasItem>, CanvasPath) {
    let pieces = curve.points.split(|p| !frame.has_place(*p)).filter(|piece| !piece.is_empty());
    let positions = |piece: &[[f64; 2]]| thinned(piece.iter().map(|&p| frame.position(p)));
    let path = CanvasPath::of_pieces(pieces.map(positions).collect());
    let mut items = vec![CanvasItem::Line { path: path.clone(), pen }];
    if curve.look == CurveStyle::Dotted {
        let dots = path.pieces.iter().flatten().map(|&p| vec![p]).collect();
        let pen = StrokeStyle::new(pen.color, 2.0 * DOT * frame.scale);
        items.push(CanvasItem::Line { path: CanvasPath::of_pieces(dots), pen });
    }
    (items, path)
}

#[cfg(test)]
mod tests {
    use super::*;
    use ppum_render::scale::Scale;

    fn line(points: &[[f64; 2]]) -> Plot {
        let curves = vec![PlotCurve::new("a", points.to_vec())];
        let (x, y) = (PlotAxis::new("x", "m"), PlotAxis::new("σ_{yy}", "MPa"));
        Plot { title: "A plot".into(), x, y, curves, ..Plot::default() }
    }

    /// The curves' paths, in pixels of the page.
    fn paths(page: &Canvas) -> Vec<Vec<Vec2>> {
        let mut found = Vec::new();
        for item in &page.items {
            let CanvasItem::Inset { corner, canvas } = item else { continue };
            let shift = vec2(f64::from(corner[0]), f64::from(corner[1]));
            for item in &canvas.items {
                if let CanvasItem::Line { path, .. } = item {
                    let moved = path.pieces.iter();
                    found.extend(moved.map(|p| p.iter().map(|&q| q + shift).collect::<Vec<_>>()));
                }
            }
        }
        found
    }

    /// Positions and values of the area are those of what is drawn.
    #[test]
    fn the_area_says_where_points_are() {
        let law = [[1e-9, 2e4], [1e-6, 3e3], [1e-3, 2e1]];
        let mut plot_of_law = line(&law);
        plot_of_law.x = plot_of_law.x.logarithmic();
        let drawn = paths(&plot(&plot_of_law, [640, 480]));
        let area = PlotArea::new(&plot_of_law, [640, 480]);
        for (point, position) in law.iter().zip(&drawn[0]) {
            let found = area.position(*point).expect("it has a place");
            assert!((found - *position).length() < 1e-9);
            assert!((area.across(found.x) / point[0] - 1.0).abs() < 1e-9);
        }
        assert_eq!(area.position([-1.0, 1.0]), None);
    }

    #[test]
    fn exponents_are_written_without_a_minus_zero() {
        assert_eq!(with_slope("σ", -0.5, 3), "σ, slope −0.500");
        assert_eq!(with_slope("K_{I}", -0.0001, 3), "K_{I}, slope 0.000");
        assert_eq!(with_slope("u", 1.996, 2), "u, slope 2.00");
    }

    #[test]
    fn slopes_are_those_of_power_laws() {
        let law = |p: f64| (1..20).map(move |k| [f64::from(k), 3.0 * f64::from(k).powf(p)]);
        for p in [-0.5, 0.0, 1.5, -3.0] {
            assert!((slope(&law(p).collect::<Vec<_>>()).unwrap() - p).abs() < 1e-12);
        }
        let with_gaps: Vec<_> =
            law(-0.5).chain([[0.0, 1.0], [2.0, f64::NAN], [-1.0, 5.0]]).collect();
        assert!((slope(&with_gaps).unwrap() + 0.5).abs() < 1e-12);
        assert_eq!(slope(&[[1.0, 2.0]]), None);
        assert_eq!(slope(&[[1.0, 2.0], [1.0, 3.0]]), None);
    }

    /// Equal steps of values are equal steps of pixels; logarithmic axes make power laws straight.
    #[test]
    fn points_are_where_their_values_say() {
        let drawn = paths(&plot(&line(&[[0.0, 1.0], [1.0, 3.0], [2.0, 5.0]]), [640, 480]));
        assert_eq!(drawn.len(), 1);
        let [a, b, c] = drawn[0][..] else { panic!("three points") };
        assert!((b - a - (c - b)).length() < 1e-9 && c.x > a.x && c.y < a.y);
        let mut law = line(&[[1e-9, 2e4], [1e-6, 2e4 / 1e1_f64.powf(1.5)], [1e-3, 2e1]]);
        (law.x, law.y) = (law.x.logarithmic(), law.y.logarithmic());
        let [a, b, c] = paths(&plot(&law, [640, 480]))[0][..] else { panic!("three points") };
        assert!((b - a - (c - b)).length() < 1e-6, "{a:?} {b:?} {c:?}");
    }

    #[test]
    fn curves_break_where_values_are_missing() {
        let gaps =
            [[0.0, 1.0], [1.0, 2.0], [2.0, f64::NAN], [3.0, f64::INFINITY], [4.0, 1.0], [5.0, 2.0]];
        let drawn = paths(&plot(&line(&gaps), [640, 480]));
        assert_eq!(drawn.iter().map(Vec::len).collect::<Vec<_>>(), [2, 2]);
    }

    /// On a logarithmic axis values that are not positive are gaps, and nothing is drawn below the
    /// frame for them.
    #[test]
    fn logarithmic_axes_leave_out_what_has_no_place() {
        let points: Vec<_> = (0..400).map(|k| [f64::from(k), (0.1 * f64::from(k)).sin()]).collect();
        let mut waves = line(&points);
        waves.y = waves.y.logarithmic();
        let size = [640, 480];
        let drawn = paths(&plot(&waves, size));
        let positive = points.chunk_by(|a, b| (a[1] > 0.0) == (b[1] > 0.0));
        let expected: Vec<_> =
            positive.filter(|run| run[0][1] > 0.0).map(<[[f64; 2]]>::len).collect();
        assert_eq!(drawn.iter().map(Vec::len).collect::<Vec<_>>(), expected);
        assert!(drawn.iter().flatten().all(|p| p.y > 0.0 && p.y < f64::from(size[1])));
    }

    /// Pens of many curves differ in colour or dashes.
    #[test]
    fn curves_are_told_apart() {
        let pens: Vec<_> = (0..30).map(|k| pen(CurveStyle::Line, k, 1.0)).collect();
        for (k, pen) in pens.iter().enumerate() {
            assert!(!pens[..k].contains(pen), "{k}");
        }
    }

    /// Given marks are those of the axis; where they have no room, some of them at equal steps.
    #[test]
    fn angles_have_right_angles() {
        let mut around = line(&[[-180.0, 1.0], [180.0, 2.0]]);
        around.x.marks = vec![-180.0, -90.0, 0.0, 90.0, 180.0];
        let words = |size| {
            let is_mark = |text: &String| text.contains("180") || text == "−90" || text == "90";
            let texts = plot(&around, size).items.into_iter().filter_map(|item| match item {
                CanvasItem::Text(text) => Some(text.text),
                _ => None,
            });
            texts.filter(is_mark).collect::<Vec<_>>()
        };
        assert_eq!(words([900, 600]), ["−180", "−90", "90", "180"]);
        assert_eq!(words(LEAST), ["−180", "180"]);
    }

    /// Steps have labels at round numbers, whatever their number: 19 is divided by none.
    #[test]
    fn many_marks_have_labels_at_round_numbers() {
        let mut steps = line(&[[0.0, 1.0], [19.0, 2.0]]);
        steps.x.marks = (0..20).map(f64::from).collect();
        let texts = plot(&steps, [640, 480]).items.into_iter().filter_map(|item| match item {
            CanvasItem::Text(text) => Some(text.text),
            _ => None,
        });
        let labels: Vec<_> = texts.filter(|text| text.parse::<usize>().is_ok()).collect();
        assert!(["0", "5", "10", "15"].iter().all(|label| labels.contains(&(*label).into())));
    }

    /// Names above the frame are in no box over the curves.
    #[test]
    fn names_above_the_frame_cover_no_curve() {
        let mut named = line(&[[0.0, 1.0], [1.0, 2.0]]);
        named.curves.push(PlotCurve::new("b", vec![[0.0, 2.0], [1.0, 1.0]]));
        for is_above in [false, true] {
            named.has_names_above = is_above;
            let page = plot(&named, [640, 480]);
            let top = PlotArea::new(&named, [640, 480]).corner.y;
            let has_box = page.items.iter().any(|item| match item {
                CanvasItem::Inset { canvas, .. } => {
                    canvas.items.iter().any(|item| matches!(item, CanvasItem::Text(_)))
                }
                _ => false,
            });
            let is_name = |item: &&CanvasItem| match item {
                CanvasItem::Text(text) => text.text == "b" && text.at.y < top,
                _ => false,
            };
            assert_eq!((has_box, page.items.iter().any(|i| is_name(&i))), (!is_above, is_above));
        }
    }

    /// Nothing but numbers that can be drawn, whatever is plotted, and everything on the page.
    #[test]
    fn odd_data_still_make_a_plot() {
        let huge: Vec<_> = (0..5).map(|k| [f64::from(k) * 1e300, -1e300 * f64::from(k)]).collect();
        for points in [
            vec![],
            vec![[1.0, 1.0]],
            vec![[0.0, 0.0], [1.0, 0.0]],
            vec![[f64::NAN, 1.0]],
            vec![[1.0, 1.0 + 1e-15], [2.0, 1.0]],
            vec![[1e-320, 1e-320], [2e-320, 1e-320]],
            huge,
        ] {
            for scale in [Scale::Linear, Scale::Log] {
                let mut odd = line(&points);
                (odd.x.scale, odd.y.scale) = (scale, scale);
                let page = plot(&odd, [10, 10]);
                assert_eq!(page.size, LEAST);
                assert!(paths(&page).iter().flatten().all(|p| p.is_finite()), "{points:?}");
                let image = page.image();
                let border = (0..LEAST[0]).flat_map(|i| [(i, 0), (i, LEAST[1] - 1)]);
                assert!(
                    border.clone().all(|(i, j)| image.pixel(i, j) == frame::PAPER),
                    "{points:?}"
                );
            }
        }
    }
}
