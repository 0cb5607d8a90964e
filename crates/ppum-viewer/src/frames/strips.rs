//! An image that has moved by whole pixels: what it shares with the new view is kept, the strips
//! that have come into view are drawn.

use ppum::vec2::vec2;
use ppum_render::raster::Raster;
use ppum_render::view::View;
use ppum_scene::drawing::{PixelValues, RasterValues};

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

    /// The rectangles of pixels that were not in view before.
    fn uncovered(self, [nx, ny]: [u32; 2]) -> [PixelRect; 2] {
        let edge = |by: i64, n: u32| match by {
            ..0 => [0, by.unsigned_abs() as u32],
            _ => [n - by as u32, n],
        };
        let rest = |by: i64, n: u32| match by {
            ..0 => [by.unsigned_abs() as u32, n],
            _ => [0, n - by as u32],
        };
        let (rows, rest) = (edge(self.rows, ny), rest(self.rows, ny));
        [
            PixelRect { columns: [0, nx], rows },
            PixelRect { columns: edge(self.columns, nx), rows: rest },
        ]
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
    let mut new = ShiftedImage::new(old, view, shift);
    for rect in shift.uncovered(view.pixels).into_iter().filter(|rect| !rect.is_empty()) {
        new.put(rect, &draw(&rect.view(&view))?);
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
    /// Copies the part that both views share.
    fn new(old: &PixelValues, view: View, Shift { columns, rows }: Shift) -> Self {
        let [nx, ny] = view.pixels.map(i64::from);
        let mut new = Self {
            columns: nx as usize,
            values: vec![f32::NAN; (nx * ny) as usize],
            without: Vec::new(),
        };
        let (first, last) = ((-columns).max(0), (nx - columns).min(nx));
        for row in (-rows).max(0)..(ny - rows).min(ny) {
            let from = ((row + rows) * nx + first + columns) as usize;
            new.put_row((row * nx + first) as usize, old, from..from + (last - first) as usize);
        }
        let places =
            old.without.iter().map(|&k| (i64::from(k) % nx - columns, i64::from(k) / nx - rows));
        let seen = places.filter(|(i, j)| (0..nx).contains(i) && (0..ny).contains(j));
        new.without = seen.map(|(i, j)| (j * nx + i) as u32).collect();
        new
    }

    /// A strip.
    fn put(&mut self, rect: PixelRect, strip: &PixelValues) {
        let [nx, ny] = rect.size().map(|n| n as usize);
        let [x, y] = [rect.columns[0] as usize, rect.rows[0] as usize];
        for row in 0..ny {
            self.put_row((y + row) * self.columns + x, strip, row * nx..(row + 1) * nx);
        }
        let (nx, columns) = (nx as u32, self.columns as u32);
        let place = |k: u32| (rect.rows[0] + k / nx) * columns + rect.columns[0] + k % nx;
        self.without.extend(strip.without.iter().map(|&k| place(k)));
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
