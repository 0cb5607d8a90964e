//! Overlays of images, as shapes of the window: sharp at any magnification of the display.

use egui::{Color32, FontId, Mesh, Pos2, Rect, Shape, Stroke, pos2, vec2};
use ppum_figure::canvas::{Align, CanvasItem, CanvasPath, StrokeStyle, TextItem};
use ppum_render::image::{Image, Rgba};

/// Where the pixels of an image lie in the window.
#[derive(Clone, Copy, Debug)]
pub struct ImagePlacement {
    /// The image's upper left corner.
    pub corner: Pos2,
    /// Points of the window per pixel of the image.
    pub scale: f32,
    /// The scale of the widths of lines and sizes of letters.
    pub pen: f32,
}

impl ImagePlacement {
    /// Pixels with all that is drawn in them.
    #[must_use]
    pub fn new(corner: Pos2, scale: f32) -> Self {
        Self { corner, scale, pen: scale }
    }

    /// A position in pixels of the image.
    pub(crate) fn at(&self, point: ppum::vec2::Vec2) -> Pos2 {
        self.corner + vec2(point.x as f32, point.y as f32) * self.scale
    }

    /// Largest distance of arcs from what is drawn for them, in pixels of the image.
    fn smooth(&self) -> f64 {
        SMOOTH / f64::from(self.scale).max(1.0)
    }

    fn length(&self, pixels: f64) -> f32 {
        pixels as f32 * self.pen
    }
}

/// Largest distance of arcs from what is drawn for them, in points of the window.
const SMOOTH: f64 = 1.0 / 64.0;

/// Longest side of what is a sign and no line of the body \[pixels\].
const SIGN: f64 = 64.0;

/// Draws the long lines of items that were made for quite another magnification: signs would be as
/// large as the window, or specks.
pub fn draw_lines(painter: &egui::Painter, placed: ImagePlacement, items: &[CanvasItem]) {
    let is_long = |piece: &Vec<ppum::vec2::Vec2>| {
        let extent = |of: fn(&ppum::vec2::Vec2) -> f64| {
            let [lo, hi] = piece
                .iter()
                .map(of)
                .fold([f64::INFINITY, f64::NEG_INFINITY], |e, v| [e[0].min(v), e[1].max(v)]);
            hi - lo
        };
        extent(|p| p.x).max(extent(|p| p.y)) > SIGN
    };
    for item in items {
        if let CanvasItem::Line { path, pen } = item {
            let pieces = path.polylines(placed.smooth()).filter(is_long).collect();
            lines(painter, placed, &CanvasPath::of_pieces(pieces), pen);
        }
    }
}

/// Draws items.
pub fn draw(painter: &egui::Painter, placed: ImagePlacement, items: &[CanvasItem]) {
    for item in items {
        match item {
            CanvasItem::Line { path, pen } => lines(painter, placed, path, pen),
            CanvasItem::Fill { outline, color } => fill(painter, placed, outline, *color),
            CanvasItem::Text(lettering) => text(painter, placed, lettering),
            CanvasItem::Picture { image, corner } => picture(painter, placed, image, *corner),
            CanvasItem::Inset { corner, canvas } => {
                let corner = placed.at(corner.map(f64::from).into());
                let inner = ImagePlacement { corner, ..placed };
                let size = canvas.size.map(|n| n as f32 * placed.scale);
                let clip = Rect::from_min_size(corner, vec2(size[0], size[1]));
                draw(
                    &painter.with_clip_rect(clip.intersect(painter.clip_rect())),
                    inner,
                    &canvas.items,
                );
            }
            _ => {}
        }
    }
}

/// An image of few colours, as that of a bar is: what is equal in a row is one rectangle, and so
/// are equal rows.
fn picture(painter: &egui::Painter, placed: ImagePlacement, image: &Image, corner: [u32; 2]) {
    let columns = image.size[0].max(1) as usize;
    let mut mesh = Mesh::default();
    let rows: Vec<&[Rgba]> = image.rgba.as_chunks().0.chunks(columns).collect();
    let mut top = 0;
    for equal in rows.chunk_by(|a, b| a == b) {
        let mut left = 0;
        for run in equal[0].chunk_by(|a, b| a == b) {
            let at = |x: usize, y: usize| {
                let [x, y] = [corner[0] as usize + x, corner[1] as usize + y].map(|n| n as f64);
                placed.at(ppum::vec2::vec2(x, y))
            };
            let (right, bottom) = (left + run.len(), top + equal.len());
            mesh.add_colored_rect(
                Rect::from_min_max(at(left, top), at(right, bottom)),
                color(run[0]),
            );
            left = right;
        }
        top += equal.len();
    }
    painter.add(mesh);
}

/// A colour of figures.
pub(crate) fn color([r, g, b, a]: Rgba) -> Color32 {
    Color32::from_rgba_unmultiplied(r, g, b, a)
}

fn lines(painter: &egui::Painter, placed: ImagePlacement, path: &CanvasPath, pen: &StrokeStyle) {
    let pieces = || {
        let lines = path.polylines(placed.smooth());
        lines.map(|piece| apart(piece.iter().map(|p| placed.at(*p))))
    };
    if let Some(halo) = pen.halo {
        let stroke = Stroke::new(placed.length(pen.width + 2.0 * halo.width), color(halo.color));
        pieces().for_each(|piece| {
            painter.add(Shape::line(piece, stroke));
        });
    }
    let stroke = Stroke::new(placed.length(pen.width), color(pen.color));
    for piece in pieces() {
        match pen.dashes {
            // ends of lines are round: a single point is a dot
            _ if piece.len() == 1 => {
                painter.circle_filled(piece[0], 0.5 * stroke.width, stroke.color);
            }
            Some([dash, gap]) => {
                let [dash, gap] = [dash, gap].map(|length| placed.length(length).max(0.5));
                painter.extend(Shape::dashed_line(&piece, stroke, dash, gap));
            }
            None => {
                painter.add(Shape::line(piece, stroke));
            }
        }
    }
}

fn fill(painter: &egui::Painter, placed: ImagePlacement, outline: &CanvasPath, fill: Rgba) {
    for piece in outline.polylines(placed.smooth()) {
        let points = corners(piece.iter().map(|p| placed.at(*p)));
        if can_be_filled(&points) {
            painter.add(Shape::convex_polygon(points, color(fill), Stroke::NONE));
        }
    }
}

/// Points of a line that lie apart from those before: where several are one, egui knows
/// no direction.
fn apart(points: impl Iterator<Item = Pos2>) -> Vec<Pos2> {
    let mut kept: Vec<Pos2> = Vec::new();
    for point in points {
        if kept.last().is_none_or(|last| is_apart(point, *last)) {
            kept.push(point);
        }
    }
    kept
}

/// True of points whose distance can be seen.
fn is_apart(p: Pos2, q: Pos2) -> bool {
    p.distance(q) > nothing(p)
}

/// Size below which shapes are not visible, or rounding of single precision \[points\].
fn nothing(at: Pos2) -> f32 {
    NOTHING.max(16.0 * f32::EPSILON * at.x.abs().max(at.y.abs()))
}

/// The corners of an outline.
fn corners(points: impl Iterator<Item = Pos2>) -> Vec<Pos2> {
    let mut kept = apart(points);
    while kept.len() > 1 && !is_apart(kept[0], kept[kept.len() - 1]) {
        kept.pop();
    }
    kept
}

/// True if an outline has an inside that is seen; the soft border of one that turns back on itself
/// would lie nowhere.
fn can_be_filled(points: &[Pos2]) -> bool {
    let cross = |pair: &[Pos2]| {
        let [p, q] = [pair[0] - points[0], pair[1] - points[0]];
        p.x * q.y - p.y * q.x
    };
    let area = 0.5 * points.windows(2).map(cross).sum::<f32>();
    let extent = Rect::from_points(points).size().max_elem();
    points.first().is_some_and(|first| area.abs() > nothing(*first) * extent)
}

/// Size below which shapes are not visible \[points\].
const NOTHING: f32 = 1e-3;

fn text(painter: &egui::Painter, placed: ImagePlacement, lettering: &TextItem) {
    let font = FontId::proportional(placed.length(lettering.size).max(1.0));
    let galley = painter.layout_no_wrap(plain(&lettering.text), font, color(lettering.color));
    let width = galley.size().x;
    let shift = match lettering.align {
        Align::Start => 0.0,
        Align::Middle => -0.5 * width,
        Align::End => -width,
    };
    let at = placed.at(lettering.at);
    // the base line of letters lies at about four fifths of their line
    let rise = 0.8 * galley.size().y;
    let angle = -lettering.angle as f32;
    let (sin, cos) = angle.sin_cos();
    let corner = pos2(at.x + cos * shift + sin * rise, at.y + sin * shift - cos * rise);
    let shape =
        egui::epaint::TextShape::new(corner, galley, color(lettering.color)).with_angle(angle);
    painter.add(shape);
}

/// A text of figures without the signs of subscripts, which labels have no room for.
pub(crate) fn plain(text: &str) -> String {
    // factors are written as everywhere in the window
    text.replace("K_{", "K_").replace("_{", "").replace('}', "")
}

#[cfg(test)]
mod tests {
    use ppum::vec2::vec2;
    use ppum_testkit::random::Random;

    use super::*;

    /// Converts items to shapes.
    fn drawn(
        placed: ImagePlacement,
        items: &[CanvasItem],
        how: fn(&egui::Painter, ImagePlacement, &[CanvasItem]),
    ) -> Vec<Shape> {
        let mut shapes = Vec::new();
        egui::__run_test_ui(|ui| {
            let painter = ui.painter().with_clip_rect(Rect::EVERYTHING);
            how(&painter, placed, items);
            shapes = painter.ctx().graphics(|graphics| {
                let list = graphics.get(painter.layer_id());
                list.map_or(Vec::new(), |list| {
                    list.all_entries().map(|s| s.shape.clone()).collect()
                })
            });
        });
        shapes
    }

    fn widths(shapes: &[Shape]) -> Vec<f32> {
        let width = |shape: &Shape| match shape {
            Shape::LineSegment { stroke, .. } => Some(stroke.width),
            Shape::Path(path) if path.fill == Color32::TRANSPARENT => Some(path.stroke.width),
            _ => None,
        };
        shapes.iter().filter_map(width).collect()
    }

    /// However small an outline is and wherever it lies, also where it turns back on itself.
    #[test]
    fn whatever_is_drawn_lies_somewhere() {
        let mut random = Random(5);
        for _ in 0..4000 {
            let size = 10f64.powf(7.0 * random.unit() - 5.0);
            let corner = vec2(random.unit(), random.unit()) * 10f64.powf(6.0 * random.unit());
            let flat = if random.below(3) == 0 { 0.0 } else { random.unit() };
            let count = 1 + random.below(70);
            let point = |k: usize| {
                let (sin, cos) = (std::f64::consts::TAU * k as f64 / count as f64).sin_cos();
                corner + vec2(cos, flat * sin) * size
            };
            let outline = CanvasPath::of_pieces(vec![(0..count).map(point).collect()]);
            let mut pen = StrokeStyle::new([0, 0, 0, 255], 1.5);
            pen.dashes = (random.below(2) == 0).then_some([4.0, 2.0]);
            let path = outline.clone();
            let items = [
                CanvasItem::Fill { outline, color: [0, 0, 0, 255] },
                CanvasItem::Line { path, pen },
            ];
            let placed = ImagePlacement { corner: pos2(0.0, 0.0), scale: 1.0, pen: 1.0 };
            let mut mesh = Mesh::default();
            let options = egui::epaint::TessellationOptions::default();
            let mut tessellator = egui::epaint::Tessellator::new(1.0, options, [1, 1], Vec::new());
            for shape in drawn(placed, &items, draw) {
                tessellator.tessellate_shape(shape, &mut mesh);
            }
            let is_there = mesh.vertices.iter().all(|vertex| vertex.pos.is_finite());
            assert!(is_there, "{count} corners of {size} at {corner:?}, {flat}");
            let is_seen = count > 2 && flat > 0.1 && size > 0.1 && corner.length() < 1e3;
            assert!(!is_seen || !mesh.is_empty(), "{count} corners of {size} at {corner:?}");
        }
    }

    #[test]
    fn lines_are_no_wider_where_a_picture_is_enlarged_and_signs_are_left_out() {
        let line = |length: f64| vec![vec2(3.0, 5.0), vec2(3.0 + length, 5.0)];
        let path = CanvasPath::of_pieces(vec![line(400.0), line(10.0)]);
        let head =
            CanvasPath::of_pieces(vec![vec![vec2(0.0, 0.0), vec2(8.0, 0.0), vec2(4.0, 8.0)]]);
        let items = [
            CanvasItem::Line { path, pen: StrokeStyle::new([0, 0, 0, 255], 1.5) },
            CanvasItem::Fill { outline: head, color: [0, 0, 0, 255] },
        ];
        let near = ImagePlacement { corner: pos2(0.0, 0.0), scale: 1.8, pen: 1.0 };
        let shapes = drawn(near, &items, draw);
        assert_eq!((widths(&shapes), shapes.len()), (vec![1.5, 1.5], 3));
        let far = ImagePlacement { scale: 50.0, ..near };
        let shapes = drawn(far, &items, draw_lines);
        assert_eq!((widths(&shapes), shapes.len()), (vec![1.5], 1));
    }
}
