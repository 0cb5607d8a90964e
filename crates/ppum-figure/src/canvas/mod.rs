//! A page: what is drawn, back to front.
//!
//! Everything that figures draw is first a [`CanvasItem`] on a [`Canvas`], and only then pixels
//! ([`Canvas::image`]) or a vector file. Positions and lengths are pixels: the origin is the upper
//! left corner, y runs down, and pixel (i, j) covers [i, i + 1] × [j, j + 1].

pub mod base64;
mod dashes;
mod mask;
mod pdf;
mod raster;
mod svg;
pub mod xml;
pub mod zlib;

use ppum::edge::Edge;
use ppum::segment::sides;
use ppum::vec2::{Vec2, vec2};
use ppum_render::image::{Image, Rgba};
use ppum_render::png::TextChunk;

use crate::text;

/// A page with what is drawn on it.
#[derive(Clone, Debug, PartialEq)]
pub struct Canvas {
    /// Columns and rows.
    pub size: [u32; 2],
    /// The page's own colour; may be transparent.
    pub paper: Rgba,
    /// The drawn items, the lowest first.
    pub items: Vec<CanvasItem>,
}

/// One thing on a page.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub enum CanvasItem {
    /// An image, one of its pixels on one of the page's.
    Picture {
        /// The image.
        image: Image,
        /// Its upper left corner: column and row of the page.
        corner: [u32; 2],
    },
    /// The inside of closed lines, in one colour; where they overlap it is no darker.
    Fill {
        /// The lines.
        outline: CanvasPath,
        /// The colour.
        color: Rgba,
    },
    /// Lines; where they cross they are no darker.
    Line {
        /// The lines.
        path: CanvasPath,
        /// The pen.
        pen: StrokeStyle,
    },
    /// A line of text.
    Text(TextItem),
    /// A page on the page: what leaves it is not seen.
    Inset {
        /// Its upper left corner: column and row of the page.
        corner: [u32; 2],
        /// The page, its positions counted from its own corner.
        canvas: Canvas,
    },
}

/// Straight and round lines.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct CanvasPath {
    /// Straight lines: points, in order.
    pub pieces: Vec<Vec<Vec2>>,
    /// Segments and arcs, each of which begins where the one before ends.
    pub curves: Vec<Vec<Edge>>,
}

/// The way lines are drawn.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct StrokeStyle {
    /// The colour.
    pub color: Rgba,
    /// The width.
    pub width: f64,
    /// A seam on both sides, drawn below all of the item's lines, that parts them from what lies
    /// under them; also where a line has gaps.
    pub halo: Option<Halo>,
    /// Lengths of dashes and of the gaps between them; one unbroken line if there are none.
    pub dashes: Option<[f64; 2]>,
}

/// A seam around lines or letters.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Halo {
    /// The colour.
    pub color: Rgba,
    /// The width on each side.
    pub width: f64,
}

/// A line of text on a page. `_{…}` sets a subscript.
#[derive(Clone, Debug, PartialEq)]
pub struct TextItem {
    /// The text.
    pub text: String,
    /// The point of its base line that `align` names.
    pub at: Vec2,
    /// Length of an em.
    pub size: f64,
    /// The colour.
    pub color: Rgba,
    /// The part of the line that lies at `at`.
    pub align: Align,
    /// Direction of reading, from the right towards the page's top \[radians\].
    pub angle: f64,
    /// A seam around the letters.
    pub halo: Option<Halo>,
}

/// The part of a line of text that lies at its point.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Align {
    /// The start.
    #[default]
    Start,
    /// The middle.
    Middle,
    /// The end.
    End,
}

impl Canvas {
    /// An empty page.
    #[must_use]
    pub fn new(size: [u32; 2], paper: Rgba) -> Self {
        Self { size, paper, items: Vec::new() }
    }

    /// The page as pixels.
    #[must_use]
    pub fn image(&self) -> Image {
        raster::image(self)
    }

    /// The characters of its texts that the font lacks, each once ([`text::missing`]).
    #[must_use]
    pub fn missing(&self) -> Vec<char> {
        let mut all: Vec<char> = Vec::new();
        for item in &self.items {
            let found = match item {
                CanvasItem::Text(line) => text::missing(&line.text),
                CanvasItem::Inset { canvas, .. } => canvas.missing(),
                _ => Vec::new(),
            };
            all.extend(found.into_iter().filter(|c| !all.contains(c)).collect::<Vec<_>>());
        }
        all
    }

    /// The page as an SVG file of `dpi` pixels per inch. Lines and letters are lines and letters,
    /// the font is in the file, images are PNG with their pixels kept apart. The texts `Title`
    /// and `Description` are the file's own, the others its metadata.
    #[must_use]
    pub fn svg(&self, dpi: f64, texts: &[TextChunk]) -> String {
        svg::file(self, dpi, texts)
    }

    /// The page as a PDF file of `dpi` pixels per inch: vectors, letters that can be searched and
    /// copied, and images without loss. The texts are the document's information.
    #[must_use]
    pub fn pdf(&self, dpi: f64, texts: &[TextChunk]) -> Vec<u8> {
        pdf::file(self, dpi, texts)
    }
}

impl CanvasItem {
    /// The box that the item may draw into: its upper left and lower right corner. Without items,
    /// the least coordinates are +∞.
    #[must_use]
    pub fn bounds(&self) -> [Vec2; 2] {
        let grown = |[lo, hi]: [Vec2; 2], by: f64| [lo - vec2(by, by), hi + vec2(by, by)];
        let of_page = |corner: &[u32; 2], size: [u32; 2]| {
            let (corner, size) =
                (Vec2::from(corner.map(f64::from)), Vec2::from(size.map(f64::from)));
            [corner, corner + size]
        };
        match self {
            Self::Picture { image, corner } => of_page(corner, image.size),
            Self::Fill { outline, .. } => outline.bounds(),
            Self::Line { path, pen } => {
                let halo = pen.halo.map_or(0.0, |halo| halo.width);
                grown(path.bounds(), 0.5 * pen.width + halo)
            }
            Self::Text(line) => line.bounds(),
            Self::Inset { corner, canvas } => of_page(corner, canvas.size),
        }
    }

    /// Lines and fills reflected in a page of a size, from left to right, from top to bottom or
    /// both. Texts stay upright, with their point reflected; images and pages stay as they are.
    #[must_use]
    pub fn flipped(mut self, [across, down]: [bool; 2], size: [u32; 2]) -> Self {
        let [width, height] = size.map(f64::from);
        let flip = |p: &mut Vec2| {
            p.x = if across { width - p.x } else { p.x };
            p.y = if down { height - p.y } else { p.y };
        };
        match &mut self {
            Self::Fill { outline: path, .. } | Self::Line { path, .. } => {
                path.pieces.iter_mut().flatten().for_each(flip);
                for edge in path.curves.iter_mut().flatten() {
                    [&mut edge.from, &mut edge.to].into_iter().for_each(flip);
                    edge.bulge = if across == down { edge.bulge } else { -edge.bulge };
                }
            }
            Self::Text(line) => flip(&mut line.at),
            Self::Picture { .. } | Self::Inset { .. } => {}
        }
        self
    }
}

impl TextItem {
    /// Text that starts at a point of its base line and reads to the right.
    #[must_use]
    pub fn new(text: impl Into<String>, size: f64, at: Vec2, color: Rgba) -> Self {
        let align = Align::Start;
        Self { text: text.into(), at, size, color, align, angle: 0.0, halo: None }
    }

    /// The text with another part of its line at its point.
    #[must_use]
    pub fn aligned(self, align: Align) -> Self {
        Self { align, ..self }
    }

    /// The text read upwards.
    #[must_use]
    pub fn upwards(self) -> Self {
        Self { angle: std::f64::consts::FRAC_PI_2, ..self }
    }

    /// Length of the line.
    #[must_use]
    pub fn width(&self) -> f64 {
        text::width(&self.text, self.size)
    }

    /// The box around the letters and their seam.
    fn bounds(&self) -> [Vec2; 2] {
        let curves = text::outlines(&self.text, self.size, self.start(), self.angle);
        let [lo, hi] = text::curve_bounds(&curves);
        let by = self.halo.map_or(0.0, |halo| halo.width);
        [lo - vec2(by, by), hi + vec2(by, by)]
    }

    /// The point where the line starts.
    fn start(&self) -> Vec2 {
        let before = match self.align {
            Align::Start => 0.0,
            Align::Middle => 0.5,
            Align::End => 1.0,
        };
        let (sin, cos) = self.angle.sin_cos();
        self.at - vec2(cos, -sin) * (before * self.width())
    }
}

impl CanvasPath {
    /// One line through points.
    #[must_use]
    pub fn through(points: Vec<Vec2>) -> Self {
        Self::of_pieces(vec![points])
    }

    /// Straight lines through points.
    #[must_use]
    pub fn of_pieces(pieces: Vec<Vec<Vec2>>) -> Self {
        Self { pieces, curves: Vec::new() }
    }

    /// Adds a segment or an arc, to the end of the last one if it begins there.
    pub fn edge(&mut self, edge: Edge) {
        match self.curves.last_mut() {
            Some(curve) if curve.last().is_some_and(|last| is_same(last.to, edge.from)) => {
                curve.push(edge);
            }
            _ => self.curves.push(vec![edge]),
        }
    }

    /// All lines as points in order, no farther from arcs than a tolerance.
    pub fn polylines(&self, tolerance: f64) -> impl Iterator<Item = Vec<Vec2>> + '_ {
        let flattened = move |curve: &Vec<Edge>| {
            let first = curve.iter().take(1).map(|edge| edge.from);
            let rest = curve.iter().flat_map(|edge| edge.flattened(tolerance).into_iter().skip(1));
            first.chain(rest).collect()
        };
        self.pieces.iter().cloned().chain(self.curves.iter().map(flattened))
    }

    /// Adds a straight line.
    pub fn line(&mut self, a: Vec2, b: Vec2) {
        self.pieces.push(vec![a, b]);
    }

    /// Adds an axis-parallel box by two opposite corners, closed.
    pub fn rect(&mut self, a: Vec2, b: Vec2) {
        self.pieces.push(vec![a, vec2(b.x, a.y), b, vec2(a.x, b.y), a]);
    }

    /// Adds a circle, closed, as chords that leave it by less than a fiftieth of a pixel.
    pub fn circle(&mut self, center: Vec2, radius: f64) {
        let step = (0.16 / radius.max(0.1)).sqrt();
        let count = (std::f64::consts::TAU / step).ceil().max(8.0) as u32;
        let at = |k: u32| {
            let (sin, cos) =
                (f64::from(k % count) / f64::from(count) * std::f64::consts::TAU).sin_cos();
            center + vec2(cos, sin) * radius
        };
        self.pieces.push((0..=count).map(at).collect());
    }

    /// The lines all turning one way, so that none takes away what another fills.
    fn turned_alike(&self) -> Self {
        let turned = |points: &Vec<Vec2>| {
            let area: f64 = sides(points).map(|[a, b]| a.cross(b)).sum();
            let mut points = points.clone();
            if area < 0.0 {
                points.reverse();
            }
            points
        };
        let turned_curve = |curve: &Vec<Edge>| {
            let area: f64 = curve.iter().map(|edge| edge.area_from(Vec2::ZERO)).sum();
            let reversed = curve.iter().rev().map(Edge::reversed);
            if area < 0.0 { reversed.collect() } else { curve.clone() }
        };
        Self {
            pieces: self.pieces.iter().map(turned).collect(),
            curves: self.curves.iter().map(turned_curve).collect(),
        }
    }

    /// The box around the lines: least and largest coordinates; of no lines, the least are +∞.
    fn bounds(&self) -> [Vec2; 2] {
        let boxes: Vec<_> = self.curves.iter().flatten().map(Edge::bounds).collect();
        let corners = boxes.iter().flat_map(|bounds| [&bounds.min, &bounds.max]);
        text::bounds(self.pieces.iter().flatten().chain(corners))
    }

    /// True if there is nothing to draw.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.pieces.is_empty() && self.curves.is_empty()
    }

    /// The curves without places that are none.
    fn finite_curves(&self) -> impl Iterator<Item = &Vec<Edge>> {
        let is_finite =
            |edge: &Edge| edge.from.is_finite() && edge.to.is_finite() && edge.bulge.is_finite();
        self.curves.iter().filter(move |curve| curve.iter().all(is_finite))
    }
}

/// Distance of two places that are one.
const SAME: f64 = 1e-3;

fn is_same(a: Vec2, b: Vec2) -> bool {
    (b - a).length() <= SAME
}

/// Arcs no farther than this from segments or Bézier curves may be drawn as these.
const UNSEEN: f64 = 1e-4;

/// The parts of an edge that cubic Bézier curves stand for, by their inner control points and
/// their end: a segment is one.
fn bezier_curves(edge: &Edge) -> Vec<[Vec2; 3]> {
    // a cubic is (φ/(π/2))⁶ · 2.73e-4 r away from an arc of a sweep φ
    let radius = edge.curvature().abs().recip();
    let turn = std::f64::consts::FRAC_PI_2 * (UNSEEN / (2.73e-4 * radius)).powf(1.0 / 6.0);
    let part = |part: Edge| {
        let ([start, end], chord) = (part.end_tangents(), part.chord().length());
        let handle = (1.0 + part.bulge * part.bulge) * chord / 3.0;
        [part.from + start * handle, part.to - end * handle, part.to]
    };
    edge.divided(turn).map(part).collect()
}

impl StrokeStyle {
    /// A pen of a colour and a width.
    #[must_use]
    pub fn new(color: Rgba, width: f64) -> Self {
        Self { color, width, halo: None, dashes: None }
    }

    /// The pen with a seam on both sides of its lines.
    #[must_use]
    pub fn with_halo(self, color: Rgba, width: f64) -> Self {
        Self { halo: Some(Halo { color, width }), ..self }
    }

    /// The pen with dashes and gaps of these lengths.
    #[must_use]
    pub fn dashed(self, dash: f64, gap: f64) -> Self {
        Self { dashes: Some([dash, gap]), ..self }
    }
}

#[cfg(test)]
mod tests;
