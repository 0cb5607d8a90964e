//! Writes the items of a page as operators.

use pdf_writer::types::{LineCapStyle, LineJoinStyle, TextRenderingMode};
use pdf_writer::{Content, Name, Ref, Str};
use ppum::edge::Edge;
use ppum::vec2::Vec2;
use ppum_render::image::{Image, Rgba};

use super::font::{self, Font};
use super::{File, image};
use crate::canvas::{Canvas, CanvasItem, CanvasPath, StrokeStyle, TextItem, bezier_curves};
use crate::text;

/// Resources that operators refer to.
#[derive(Default)]
pub(super) struct Resources {
    pub(super) font: Font,
    /// Images by their names.
    pub(super) images: Vec<(String, Ref)>,
    /// Opacities by their names.
    pub(super) states: Vec<(String, f32)>,
}

/// Writes items one after another.
pub(super) struct PdfWriter<'f> {
    file: &'f mut File,
    content: Content,
    resources: Resources,
}

impl<'f> PdfWriter<'f> {
    pub(super) fn new(file: &'f mut File, content: Content) -> Self {
        Self { file, content, resources: Resources::default() }
    }

    pub(super) fn finish(self) -> (Vec<u8>, Resources) {
        (self.content.finish().to_vec(), self.resources)
    }

    /// The paper and all items.
    pub(super) fn page(&mut self, canvas: &Canvas) {
        if canvas.paper[3] > 0 {
            let [width, height] = canvas.size.map(|n| n as f32);
            self.color(canvas.paper);
            self.content.rect(0.0, 0.0, width, height).fill_nonzero();
        }
        for item in &canvas.items {
            match item {
                CanvasItem::Picture { image, corner } => self.image(image, *corner),
                CanvasItem::Fill { outline, color } => {
                    self.color(*color);
                    if self.path(&outline.turned_alike(), true) {
                        self.content.fill_nonzero();
                    }
                }
                CanvasItem::Line { path, pen } => self.line(path, pen),
                CanvasItem::Text(text) => self.text(text),
                CanvasItem::Inset { corner, canvas } => self.inset(canvas, *corner),
            }
        }
    }

    /// A page on the page, cut off at its border.
    fn inset(&mut self, canvas: &Canvas, corner: [u32; 2]) {
        let ([x, y], [width, height]) = (corner.map(|n| n as f32), canvas.size.map(|n| n as f32));
        self.content.save_state().transform([1.0, 0.0, 0.0, 1.0, x, y]);
        self.content.rect(0.0, 0.0, width, height).clip_nonzero().end_path();
        self.page(canvas);
        self.content.restore_state();
    }

    /// An image, which is a unit square with its base line below.
    fn image(&mut self, image: &Image, corner: [u32; 2]) {
        let ([x, y], [width, height]) = (corner.map(|n| n as f32), image.size.map(|n| n as f32));
        if image.rgba.is_empty() {
            return;
        }
        let name = format!("P{}", self.resources.images.len());
        let place = image::image(self.file, image);
        self.opacity(255);
        self.content.save_state().transform([width, 0.0, 0.0, -height, x, y + height]);
        self.content.x_object(Name(name.as_bytes())).restore_state();
        self.resources.images.push((name, place));
    }

    fn line(&mut self, path: &CanvasPath, pen: &StrokeStyle) {
        let content = &mut self.content;
        content.set_line_cap(LineCapStyle::RoundCap).set_line_join(LineJoinStyle::RoundJoin);
        content.set_dash_pattern([], 0.0);
        if let Some(halo) = pen.halo {
            self.stroke(path, halo.color, pen.width + 2.0 * halo.width);
        }
        let dashes = pen.dashes.iter().flatten().map(|&length| length as f32);
        self.content.set_dash_pattern(dashes, 0.0);
        self.stroke(path, pen.color, pen.width);
    }

    fn stroke(&mut self, path: &CanvasPath, color: Rgba, width: f64) {
        self.color(color);
        self.content.set_line_width(width as f32);
        if self.path(path, false) {
            self.content.stroke();
        }
    }

    fn text(&mut self, line: &TextItem) {
        if let Some(halo) = line.halo {
            self.color(halo.color);
            self.content.set_line_join(LineJoinStyle::RoundJoin).set_dash_pattern([], 0.0);
            self.content.set_line_width(2.0 * halo.width as f32);
            self.show(line, TextRenderingMode::Stroke);
        }
        self.color(line.color);
        self.show(line, TextRenderingMode::Fill);
    }

    fn show(&mut self, line: &TextItem, mode: TextRenderingMode) {
        let (sin, cos) = line.angle.sin_cos();
        let (along, down) = (Vec2::from([cos, -sin]), Vec2::from([sin, cos]));
        let mut at = line.start();
        self.content.begin_text().set_text_rendering_mode(mode);
        for run in text::runs(&line.text, line.size) {
            let base = at + down * run.lowered;
            self.content.set_font(font::NAME, run.size as f32);
            let matrix = [along.x, along.y, -down.x, -down.y, base.x, base.y];
            self.content.set_text_matrix(matrix.map(|number| number as f32));
            self.content.show(Str(&self.resources.font.encoded(&run.text)));
            at = at + along * text::width(&run.text, run.size);
        }
        self.content.end_text();
    }

    /// The pieces of a path; those that lead to no place are left out. False if there are
    /// no others.
    fn path(&mut self, path: &CanvasPath, is_closed: bool) -> bool {
        let mut is_drawn = false;
        for points in path.pieces.iter().filter(|points| points.iter().all(|p| p.is_finite())) {
            let Some((first, rest)) = points.split_first() else { continue };
            self.content.move_to(first.x as f32, first.y as f32);
            for p in rest {
                self.content.line_to(p.x as f32, p.y as f32);
            }
            match rest {
                // a disc
                [] => self.content.line_to(first.x as f32, first.y as f32),
                _ if is_closed => self.content.close_path(),
                _ => &mut self.content,
            };
            is_drawn = true;
        }
        for curve in path.finite_curves() {
            self.content.move_to(curve[0].from.x as f32, curve[0].from.y as f32);
            curve.iter().for_each(|edge| self.edge(edge));
            if is_closed {
                self.content.close_path();
            }
            is_drawn = true;
        }
        is_drawn
    }

    fn edge(&mut self, edge: &Edge) {
        if !edge.is_arc() {
            self.content.line_to(edge.to.x as f32, edge.to.y as f32);
            return;
        }
        for points in bezier_curves(edge) {
            let [a, b, to] = points.map(|p| [p.x as f32, p.y as f32]);
            self.content.cubic_to(a[0], a[1], b[0], b[1], to[0], to[1]);
        }
    }

    /// The colour and opacity of what follows.
    fn color(&mut self, [red, green, blue, opacity]: Rgba) {
        let [red, green, blue] = [red, green, blue].map(|c| f32::from(c) / 255.0);
        self.content.set_fill_rgb(red, green, blue).set_stroke_rgb(red, green, blue);
        self.opacity(opacity);
    }

    fn opacity(&mut self, opacity: u8) {
        let name = format!("S{opacity}");
        self.content.set_parameters(Name(name.as_bytes()));
        if !self.resources.states.iter().any(|(known, _)| *known == name) {
            self.resources.states.push((name, f32::from(opacity) / 255.0));
        }
    }
}
