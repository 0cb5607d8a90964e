//! An image that has moved by whole pixels: what it shares with the new view is kept, the strips
//! that have come into view are drawn.

use ppum::vec2::vec2;
use ppum_render::raster::Raster;
use ppum_render::view::View;
use ppum_scene::values::{PixelValues, RasterValues};

/// A move of an image's content, in whole pixels: pixel (i, j) was (i + columns, j + rows) before.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Shift {
    columns: i64,
    rows: i64,
}

/// Pixels whose places doubles know to no better than this part of themselves cannot be put side
/// by side.
const BLURRED: f64 = 0.01;
/// Less than this part of an image is not worth keeping.
const WORTH: f64 = 0.5;

impl Shift {
    /// From one view to another; none if they differ in more than their place, or share too little.
    pub(super) fn between(old: &View, new: &View) -> Option<Self> {
        let size = new.pixel_size();
        let far = old
            .center
            .x
            .abs()
            .max(old.center.y.abs())
            .max(new.center.x.abs())
            .max(new.center.y.abs());
        if old.pixels != new.pixels || old.width != new.width || f64::EPSILON * far > BLURRED * size
        {
            return None;
        }
        let by = (new.center - old.center) / size;
        // conversions saturate
        let shift = Self { columns: by.x.round() as i64, rows: -by.y.round() as i64 };
        (shift.kept(new.pixels) > WORTH).then_some(shift)
    }

    /// The part of the pixels that both views share.
    pub(super) fn kept(self, pixels: [u32; 2]) -> f64 {
        let rect = |by: i64, n: u32| 1.0 - (by.unsigned_abs() as f64 / f64::from(n)).min(1.0);
        rect(self.columns, pixels[0]) * rect(self.rows, pixels[1])
    }

    /// The view that lies so many whole pixels beside another.
    fn of(self, view: &View) -> View {
        let by = vec2(self.columns as f64, -self.rows as f64) * view.pixel_size();
        View { center: view.center + by, ..*view }
    }

    /// The rectangle of pixels that was in view before, and those that were not.
    fn split(self, [nx, ny]: [u32; 2]) -> (PixelRect, [PixelRect; 2]) {
        let edge = |by: i64, n: u32| match by {
            ..0 => [0, by.unsigned_abs() as u32],
            _ => [n - by as u32, n],
        };
        let rest = |by: i64, n: u32| match by {
            ..0 => [by.unsigned_abs() as u32, n],
            _ => [0, n - by as u32],
        };
        let (columns, rows) = (rest(self.columns, nx), rest(self.rows, ny));
        let across = PixelRect { columns: [0, nx], rows: edge(self.rows, ny) };
        let beside = PixelRect { columns: edge(self.columns, nx), rows };
        (PixelRect { columns, rows }, [across, beside])
    }
}

/// A rectangle of pixels: first column and row, and those behind the last.
#[derive(Clone, Copy, Debug)]
struct PixelRect {
    columns: [u32; 2],
    rows: [u32; 2],
}

impl PixelRect {
    fn size(&self) -> [u32; 2] {
        [self.columns[1] - self.columns[0], self.rows[1] - self.rows[0]]
    }

    fn is_empty(&self) -> bool {
        self.size().contains(&0)
    }

    /// The view of these pixels alone.
    fn view(&self, whole: &View) -> View {
        let [x, y] = [self.columns, self.rows].map(|[a, b]| 0.5 * (f64::from(a) + f64::from(b)));
        let width = whole.pixel_size() * f64::from(self.size()[0]);
        View { center: whole.center + whole.offset_at(vec2(x, y)), width, pixels: self.size() }
    }
}

/// The values of an image that has moved, in single precision; `draw` draws strips.
pub(super) fn moved<E>(
    old: &PixelValues,
    shift: Shift,
    mut draw: impl FnMut(&View) -> Result<PixelValues, E>,
) -> Result<PixelValues, E> {
    let view = shift.of(&old.view);
    let [nx, ny] = view.pixels.map(|n| n as usize);
    let mut new =
        ShiftedImage { columns: nx, values: vec![f32::NAN; nx * ny], without: Vec::new() };
    let (kept, strips) = shift.split(view.pixels);
    new.put(kept, old, [shift.columns, shift.rows].map(|by| by.max(0) as u32));
    for strip in strips.into_iter().filter(|strip| !strip.is_empty()) {
        new.put(strip, &draw(&strip.view(&view))?, [0, 0]);
    }
    let values = RasterValues::from(Raster::new(view.pixels, new.values));
    let by = format!("{}, moved", old.by);
    Ok(PixelValues {
        view,
        values,
        by,
        without: new.without,
        overlap: Vec::new(),
        opacity: None,
        norms: None,
    })
}

/// An image while it is put together.
struct ShiftedImage {
    columns: usize,
    values: Vec<f32>,
    without: Vec<u32>,
}

impl ShiftedImage {
    /// Copies a rectangle from another image, in which it begins at a pixel.
    fn put(&mut self, rect: PixelRect, from: &PixelValues, [x, y]: [u32; 2]) {
        let ([width, height], columns) = (rect.size(), from.view.pixels[0]);
        let [left, top] = [rect.columns[0], rect.rows[0]];
        for row in 0..height {
            let start = (y + row) as usize * columns as usize + x as usize;
            let to = (top + row) as usize * self.columns + left as usize;
            self.put_row(to, from, start..start + width as usize);
        }
        let is_kept = |[i, j]: &[u32; 2]| (x..x + width).contains(i) && (y..y + height).contains(j);
        let kept = from.without.iter().map(|&k| [k % columns, k / columns]).filter(is_kept);
        let place = |[i, j]: [u32; 2]| (top + j - y) * self.columns as u32 + left + i - x;
        self.without.extend(kept.map(place));
    }

    fn put_row(&mut self, to: usize, from: &PixelValues, range: std::ops::Range<usize>) {
        let row = &mut self.values[to..to + range.len()];
        match &from.values {
            RasterValues::Single(raster) => row.copy_from_slice(&raster.values[range]),
            RasterValues::Double(raster) => {
                row.iter_mut().zip(&raster.values[range]).for_each(|(to, &from)| *to = from as f32);
            }
        }
    }
}
