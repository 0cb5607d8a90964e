//! A page as pixels.

use ppum::vec2::{Vec2, vec2};
use ppum_render::image::{Image, Rgba};

use super::dashes::dashes;
use super::mask::{CoverageMask, PixelWindow, over};
use super::{Canvas, CanvasItem, CanvasPath, StrokeStyle, TextItem};
use crate::text::{self, GlyphCurve};

/// Largest distance of arcs from the chords that are drawn \[pixels\].
const SMOOTH: f64 = 1.0 / 64.0;

/// Draws a page.
pub(super) fn image(canvas: &Canvas) -> Image {
    let mut image = Image::filled(canvas.size, canvas.paper);
    let window = PixelWindow { min: [0, 0], max: canvas.size };
    Painter { image: &mut image, window, origin: Vec2::ZERO }.draw(&canvas.items);
    image
}

/// A part of an image that a page is drawn into.
struct Painter<'a> {
    image: &'a mut Image,
    /// The visible window.
    window: PixelWindow,
    /// The page's upper left corner.
    origin: Vec2,
}

impl Painter<'_> {
    fn draw(&mut self, items: &[CanvasItem]) {
        for item in items {
            match item {
                CanvasItem::Picture { image, corner } => self.paste(image, *corner),
                CanvasItem::Fill { outline, color } => self.fill(outline, *color),
                CanvasItem::Line { path, pen } => self.line(path, pen),
                CanvasItem::Text(text) => self.text(text),
                CanvasItem::Inset { corner, canvas } => self.inset(canvas, *corner),
            }
        }
    }

    /// Column and row of the image for those of the page.
    fn moved(&self, corner: [u32; 2]) -> [u32; 2] {
        [corner[0] + self.origin.x as u32, corner[1] + self.origin.y as u32]
    }

    /// The part of the window that a thing of some size at a corner takes.
    fn part(&self, corner: [u32; 2], size: [u32; 2]) -> PixelWindow {
        let end = [0, 1].map(|k| corner[k].saturating_add(size[k]));
        self.window.intersection(PixelWindow { min: corner, max: end })
    }

    fn inset(&mut self, canvas: &Canvas, corner: [u32; 2]) {
        let corner = self.moved(corner);
        let window = self.part(corner, canvas.size);
        let origin = vec2(f64::from(corner[0]), f64::from(corner[1]));
        let mut paper = CoverageMask::new(window);
        paper.fill();
        paper.paint(self.image, canvas.paper);
        Painter { image: &mut *self.image, window, origin }.draw(&canvas.items);
    }

    /// Lays an image over the page; what does not fit is lost.
    fn paste(&mut self, picture: &Image, corner: [u32; 2]) {
        let corner = self.moved(corner);
        let (seen, columns) = (self.part(corner, picture.size), self.image.size[0] as usize);
        let pixels = self.image.rgba.as_chunks_mut().0;
        for row in seen.min[1]..seen.max[1] {
            for column in seen.min[0]..seen.max[0] {
                let pixel = &mut pixels[row as usize * columns + column as usize];
                *pixel = over(picture.pixel(column - corner[0], row - corner[1]), 1.0, *pixel);
            }
        }
    }

    /// An empty mask for things within two points.
    fn mask(&self, around: [Vec2; 2], margin: f64) -> CoverageMask {
        let margin = vec2(margin, margin);
        let [lo, hi] = around.map(|p| p + self.origin);
        CoverageMask::new(self.window.around([lo - margin, hi + margin]))
    }

    fn fill(&mut self, outline: &CanvasPath, color: Rgba) {
        let mut mask = self.mask(outline.bounds(), 0.0);
        for corners in outline.polylines(SMOOTH) {
            mask.polygon(&self.shifted(&corners));
        }
        mask.paint(self.image, color);
    }

    fn line(&mut self, path: &CanvasPath, pen: &StrokeStyle) {
        if let Some(halo) = pen.halo {
            self.stroke(path, &StrokeStyle::new(halo.color, pen.width + 2.0 * halo.width));
        }
        self.stroke(path, pen);
    }

    fn stroke(&mut self, path: &CanvasPath, pen: &StrokeStyle) {
        let mut mask = self.mask(path.bounds(), 0.5 * pen.width + 1.0);
        for points in path.polylines(SMOOTH) {
            let points = self.shifted(&points);
            match pen.dashes {
                Some(lengths) => {
                    dashes(&points, lengths).iter().for_each(|dash| mask.stroke(dash, pen.width));
                }
                None => mask.stroke(&points, pen.width),
            }
        }
        mask.paint(self.image, pen.color);
    }

    fn text(&mut self, line: &TextItem) {
        let start = line.start() + self.origin;
        let curves = text::outlines(&line.text, line.size, start, line.angle);
        let around = text::curve_bounds(&curves).map(|p| p - self.origin);
        if let Some(halo) = line.halo {
            let mut mask = self.mask(around, halo.width + 1.0);
            for [a, b] in curves.iter().flat_map(GlyphCurve::chords) {
                mask.line(a, b, 2.0 * halo.width);
            }
            mask.outline(&curves);
            mask.paint(self.image, halo.color);
        }
        let mut mask = self.mask(around, 0.0);
        mask.outline(&curves);
        mask.paint(self.image, line.color);
    }

    fn shifted(&self, points: &[Vec2]) -> Vec<Vec2> {
        points.iter().map(|&p| p + self.origin).collect()
    }
}
