//! The problem file of a drawing.

use ppum::printable::printable;
use ppum::vec2::Vec2;

use crate::assemble::{BodyDrawing, whole_ellipse};
use crate::chain::CurveChain;
use crate::curve::{EllipseArc, PlaneCurve};
use crate::sketch::NamedCurve;

/// Digits behind the point of angles in degrees.
const ANGLE_DIGITS: usize = 13;

/// Digits behind the point of bulges: an arc is off by less than 1e-15 of its length.
const BULGE_DIGITS: usize = 15;

/// Significant digits of lengths: the error is below 1e-14 of the drawing.
const DIGITS: f64 = 15.0;

/// Columns of a line of points.
const COLUMNS: usize = 100;

/// The values that are left to the user.
const TO_BE_FILLED: &str = r#"
# Material and loads are missing: remove the signs # and enter your own.
#
# [material]
# young = 210e3
# poisson = 0.3
# state = "plane-stress"                # or "plane-strain"
"#;

/// Conditions for the first parts of the boundary.
const EXAMPLES: [&str; 2] = ["displacement = [0, 0]", "traction = [0, 1]"];

/// The lines before the parts without examples.
const OTHERS: &str = "#\n# Other parts, which are free without a [[boundary]]:\n";

impl BodyDrawing {
    /// The problem file: TOML with outline, holes and cracks; material and loads as comments.
    /// `file` is the name of the drawing in the first comment.
    #[must_use]
    pub fn problem_file(&self, title: &str, file: &str) -> String {
        let layered = self.is_layered;
        let outline = self.outline.clone().tidied(self.size).with_sides(layered);
        let holes: Vec<_> = self
            .holes
            .iter()
            .map(|hole| hole.clone().without_layer(layered).tidied(self.size))
            .collect();
        let mut text = self.head(title, file);
        text += &format!("\n[domain.outline]\n{}", self.path(&in_halves(outline.clone())));
        for (hole, drawn) in holes.iter().zip(&self.holes) {
            text += &format!("\n[[hole]]{}\n{}", comment_of(drawn), self.hole(hole));
        }
        for crack in &self.cracks {
            text += &format!(
                "\n[[crack]]{}\n{}",
                comment_of(crack),
                self.crack(crack.clone().tidied(self.size))
            );
        }
        text += TO_BE_FILLED;
        text += &self.boundaries(&outline, &holes);
        text + "\n[discretization]\nlevel = 5\n"
    }

    fn head(&self, title: &str, file: &str) -> String {
        let about = self.about.iter().map(|about| format!("# {}\n", one_line(about)));
        let counts = format!(
            "# {}, {}; ends within {:.1e} of each other are joined.\n",
            counted(self.holes.len(), "hole"),
            counted(self.cracks.len(), "crack"),
            self.tolerance
        );
        let notices = self.notices.iter().map(|notice| format!("# {}\n", one_line(notice)));
        format!("# Imported from {}.\n", one_line(file))
            + &about.chain([counts]).chain(notices).collect::<String>()
            + &format!("title = {}\n", quoted(title))
    }

    /// Examples of loads, and all parts of the boundary that can have some.
    fn boundaries(&self, outline: &CurveChain, holes: &[CurveChain]) -> String {
        let mut names = std::collections::BTreeSet::new();
        let mut parts = Vec::new();
        for named in [outline].into_iter().chain(holes).flat_map(|chain| &chain.curves) {
            let Some(name) = named.name.as_deref().filter(|name| names.insert(*name)) else {
                continue;
            };
            let [from, to] = named.curve.ends().map(|p| self.point(p));
            parts.push(format!("on = {{ piece = {} }}    # from {from} to {to}", quoted(name)));
        }
        let nameless = |k: &usize| holes[*k].curves.iter().all(|named| named.name.is_none());
        parts.extend((0..holes.len()).filter(nameless).map(|k| format!("on = {{ hole = {k} }}")));
        let text = |(k, on): (usize, &String)| match EXAMPLES.get(k) {
            Some(load) => format!("#\n# [[boundary]]\n# {on}\n# {load}\n"),
            None if k == EXAMPLES.len() => format!("{OTHERS}# {on}\n"),
            None => format!("# {on}\n"),
        };
        parts.iter().enumerate().map(text).collect()
    }

    fn path(&self, chain: &CurveChain) -> String {
        let pieces = chain.curves.iter().map(|named| {
            let name = named.name.iter().map(|name| format!(", name = {}", quoted(name)));
            format!("  {{ {}{} }},\n", self.keyed(&named.curve), name.collect::<String>())
        });
        format!("path = [\n{}]\n", pieces.collect::<String>())
    }

    fn hole(&self, hole: &CurveChain) -> String {
        let Some(arc) = whole_ellipse(hole).filter(|_| hole.curves[0].name.is_none()) else {
            return match &hole.curves[..] {
                [NamedCurve { curve: PlaneCurve::Polyline(points), name: None, .. }] => {
                    format!("points = {}\n", self.points(&points[1..]))
                }
                _ => self.path(&in_halves(hole.clone())),
            };
        };
        let (axes, center) = (arc.axes(), self.point(arc.center));
        if arc.is_circle() {
            return format!("center = {center}\nradius = {}\n", self.number(axes.axes[0]));
        }
        format!("ellipse = {{ {} }}\n", self.ellipse(arc))
    }

    fn crack(&self, crack: CurveChain) -> String {
        let nameless = |named| NamedCurve { name: None, ..named };
        let curves: Vec<_> = crack.curves.into_iter().map(nameless).collect();
        match &curves[..] {
            [named] => format!("{}\n", self.keyed(&named.curve)),
            _ => self.path(&CurveChain { curves, is_closed: false }),
        }
    }

    /// A curve as a key and its value.
    fn keyed(&self, curve: &PlaneCurve) -> String {
        match curve {
            PlaneCurve::Polyline(points) => format!("points = {}", self.points(points)),
            PlaneCurve::Spline(points) => format!("spline = {}", self.points(points)),
            PlaneCurve::Edges(edges) => {
                let ends = edges.iter().map(|edge| edge.to);
                let points: Vec<Vec2> = [edges[0].from].into_iter().chain(ends).collect();
                let bulges = edges.iter().map(|edge| rounded(edge.bulge, BULGE_DIGITS));
                let bulges = list(&bulges.collect::<Vec<_>>());
                format!("points = {}, bulges = {bulges}", self.points(&points))
            }
            PlaneCurve::Arc(arc) if arc.is_circle() => format!(
                "arc = {{ center = {}, radius = {}, {} }}",
                self.point(arc.center),
                self.number(arc.axes().axes[0]),
                range(arc)
            ),
            PlaneCurve::Arc(arc) => {
                format!("ellipse = {{ {}, {} }}", self.ellipse(arc), range(arc))
            }
        }
    }

    fn ellipse(&self, arc: &EllipseArc) -> String {
        let axes = arc.axes();
        let [a, b] = axes.axes.map(|axis| self.number(axis));
        let angle = rounded(axes.angle.to_degrees(), ANGLE_DIGITS);
        format!("center = {}, axes = [{a}, {b}], angle = {angle}", self.point(arc.center))
    }

    fn points(&self, points: &[Vec2]) -> String {
        list(&points.iter().map(|point| self.point(*point)).collect::<Vec<_>>())
    }

    fn point(&self, p: Vec2) -> String {
        format!("[{}, {}]", self.number(p.x), self.number(p.y))
    }

    /// A length, without digits that are rounding.
    fn number(&self, value: f64) -> String {
        rounded(value, (DIGITS - self.size.log10().ceil()).clamp(0.0, 300.0) as usize)
    }
}

/// A list in lines that are not too long.
fn list(items: &[String]) -> String {
    let (mut text, mut column) = ("[".to_owned(), 12);
    for (k, item) in items.iter().enumerate() {
        let comma = if k == 0 { "" } else { ", " };
        column += comma.len() + item.len();
        if column > COLUMNS && k > 0 {
            column = 4 + item.len();
            text += &format!(",\n    {item}");
        } else {
            text += &format!("{comma}{item}");
        }
    }
    text + "]"
}

/// The parameters of an arc in degrees, the first one from 0 to 360.
fn range(arc: &EllipseArc) -> String {
    let [from, to] = arc.axes().range.map(f64::to_degrees);
    let shift = 360.0 * ((from + 1e-9) / 360.0).floor();
    let [from, to] = [from, to].map(|angle| rounded(angle - shift, ANGLE_DIGITS));
    format!("from = {from}, to = {to}")
}

/// Whole ellipses as halves: a piece of a path turns by less than 360°.
fn in_halves(mut chain: CurveChain) -> CurveChain {
    if let Some(arc) = whole_ellipse(&chain) {
        let half = |half| NamedCurve { curve: PlaneCurve::Arc(half), ..chain.curves[0].clone() };
        chain.curves = arc.halves().map(half).to_vec();
    }
    chain
}

/// The shortest text of a number rounded to some digits behind the point.
fn rounded(value: f64, digits: usize) -> String {
    let value = format!("{value:.digits$}").parse().unwrap_or(value) + 0.0;
    let text = format!("{value:?}");
    text.strip_suffix(".0").unwrap_or(&text).to_owned()
}

/// The names and the line of a chain.
fn comment_of(chain: &CurveChain) -> String {
    let mut names: Vec<&str> =
        chain.curves.iter().filter_map(|named| named.name.as_deref()).collect();
    names.dedup();
    names.truncate(3);
    let name = if names.is_empty() { String::new() } else { format!("{}, ", names.join(", ")) };
    one_line(&format!("    # {name}{} of the drawing", chain.curves[0].source))
}

fn counted(count: usize, noun: &str) -> String {
    if count == 1 { format!("1 {noun}") } else { format!("{count} {noun}s") }
}

/// A text for a comment.
fn one_line(text: &str) -> String {
    printable(&text.replace(['\n', '\r', '\t'], " ")).into_owned()
}

/// A text as a string of TOML.
fn quoted(text: &str) -> String {
    let escaped = |c: char| match c {
        '"' | '\\' => format!("\\{c}"),
        c if c.is_control() => format!("\\u{:04X}", u32::from(c)),
        c => c.to_string(),
    };
    format!("\"{}\"", text.chars().map(escaped).collect::<String>())
}
