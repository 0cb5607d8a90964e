//! What is drawn over pictures, as shapes of the window: sharp at any magnification of the display.

use egui::{Color32, FontId, Mesh, Pos2, Rect, Shape, Stroke, pos2, vec2};
use ppum_figure::canvas::{Align, Item, Lettering, Path, Pen};
use ppum_render::image::{Image, Rgba};

/// Where the pixels of a picture lie in the window.
#[derive(Clone, Copy, Debug)]
pub struct Placed {
    /// The picture's upper left corner.
    pub corner: Pos2,
    /// Points of the window per pixel of the picture.
    pub scale: f32,
    /// The same of widths of lines and sizes of letters.
    pub pen: f32,
}

impl Placed {
    /// Pixels with all that is drawn in them.
    #[must_use]
    pub fn new(corner: Pos2, scale: f32) -> Self {
        Self { corner, scale, pen: scale }
    }

    /// A position in pixels of the picture.
    #[must_use]
    pub fn at(&self, point: ppum::vec2::Vec2) -> Pos2 {
        self.corner + vec2(point.x as f32, point.y as f32) * self.scale
    }

    fn length(&self, pixels: f64) -> f32 {
        pixels as f32 * self.pen
    }
}

/// Longest side of what is a sign and no line of the plate \[pixels\].
const SIGN: f64 = 64.0;

/// Draws the long lines of items that were made for quite another magnification: signs would be as large as the window, or
/// specks.
pub fn draw_lines(painter: &egui::Painter, placed: Placed, items: &[Item]) {
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
        if let Item::Line { path, pen } = item {
            let pieces = path.pieces.iter().filter(|piece| is_long(piece)).cloned().collect();
            lines(painter, placed, &Path { pieces }, pen);
        }
    }
}

/// Draws items.
pub fn draw(painter: &egui::Painter, placed: Placed, items: &[Item]) {
    for item in items {
        match item {
            Item::Line { path, pen } => lines(painter, placed, path, pen),
            Item::Fill { outline, color } => fill(painter, placed, outline, *color),
            Item::Text(lettering) => text(painter, placed, lettering),
            Item::Picture { image, corner } => picture(painter, placed, image, *corner),
            Item::Inset { corner, canvas } => {
                let corner = placed.at(corner.map(f64::from).into());
                let inner = Placed { corner, ..placed };
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

/// A picture of few colours, as that of a bar is: what is equal in a row is one rectangle, and so are equal rows.
fn picture(painter: &egui::Painter, placed: Placed, image: &Image, corner: [u32; 2]) {
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
#[must_use]
pub fn color([r, g, b, a]: Rgba) -> Color32 {
    Color32::from_rgba_unmultiplied(r, g, b, a)
}

fn lines(painter: &egui::Painter, placed: Placed, path: &Path, pen: &Pen) {
    let pieces =
        || path.pieces.iter().map(|piece| piece.iter().map(|p| placed.at(*p)).collect::<Vec<_>>());
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

fn fill(painter: &egui::Painter, placed: Placed, outline: &Path, fill: Rgba) {
    for piece in &outline.pieces {
        let points: Vec<_> = piece.iter().map(|p| placed.at(*p)).collect();
        // what has no extent has no sides, and its soft border would lie nowhere
        let extent = Rect::from_points(&points).size();
        if extent.max_elem() < NOTHING {
            continue;
        }
        painter.add(Shape::convex_polygon(points, color(fill), Stroke::NONE));
    }
}

/// What is smaller is not seen \[points\].
const NOTHING: f32 = 1e-3;

fn text(painter: &egui::Painter, placed: Placed, lettering: &Lettering) {
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

    use super::*;

    /// What is drawn of items.
    fn drawn(
        placed: Placed,
        items: &[Item],
        how: fn(&egui::Painter, Placed, &[Item]),
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

    #[test]
    fn lines_are_no_wider_where_a_picture_is_enlarged_and_signs_are_left_out() {
        let line = |length: f64| vec![vec2(3.0, 5.0), vec2(3.0 + length, 5.0)];
        let path = Path { pieces: vec![line(400.0), line(10.0)] };
        let head = Path { pieces: vec![vec![vec2(0.0, 0.0), vec2(8.0, 0.0), vec2(4.0, 8.0)]] };
        let items = [
            Item::Line { path, pen: Pen::new([0, 0, 0, 255], 1.5) },
            Item::Fill { outline: head, color: [0, 0, 0, 255] },
        ];
        let near = Placed { corner: pos2(0.0, 0.0), scale: 1.8, pen: 1.0 };
        let shapes = drawn(near, &items, draw);
        assert_eq!((widths(&shapes), shapes.len()), (vec![1.5, 1.5], 3));
        let far = Placed { scale: 50.0, ..near };
        let shapes = drawn(far, &items, draw_lines);
        assert_eq!((widths(&shapes), shapes.len()), (vec![1.5], 1));
    }
}
