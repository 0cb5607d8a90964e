//! Figures: a picture with axes, a colour bar, a title and the cracks.
//!
//! The picture's pixels are shown as they are, one to one; frame and ticks lie outside them. Pixels
//! without a value are hatched where the picture is transparent. At deep zoom axes count from the
//! tip nearest to the view's centre ("x − 0.5 \[×10⁻¹²\]"), without one from a rounded centre.
//!
//! ```text
//!      title
//!      ┌──────────────┐  ▲  above the range
//!    y ┤              │  █─
//!      ┤   picture    │  █─  quantity [unit]
//!      └──┬────┬────┬─┘  ▼  below the range
//!              x
//! ```

mod axis;
mod color_bar;
mod sheet;

use ppum::crack::Crack;

use crate::canvas::{Canvas, Item};
use crate::overlay::line_scale;
use ppum_render::image::{Image, Rgba};
use ppum_render::picture::Picture;
use sheet::Sheet;

/// The words of a figure; empty ones are left out. `_{…}` sets a subscript: `σ_{yy}`. Characters are
/// those of Latin, Greek and mathematics; others appear as boxes.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Labels {
    /// Line above the picture.
    pub title: String,
    /// The quantity that the colours show, e.g. `von Mises stress`.
    pub quantity: String,
    /// Unit of the values.
    pub unit: String,
    /// Unit of lengths.
    pub length_unit: String,
}

/// The reason why there is no such figure.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum FigureError {
    /// No room for the picture between the labels.
    #[error("a figure of {}x{} pixels leaves no room; give at least {}x{}",
        size[0], size[1], least[0], least[1])]
    TooSmall {
        /// The size asked for.
        size: [u32; 2],
        /// The smallest size.
        least: [u32; 2],
    },
    /// The picture is larger than the room between the labels.
    #[error("a picture of {}x{} pixels does not fit a figure with room for {}x{}; \
        draw it with the size that plot_area gives", plot[0], plot[1], room[0], room[1])]
    TooLarge {
        /// The picture's size.
        plot: [u32; 2],
        /// The room.
        room: [u32; 2],
    },
}

const PAGE: Rgba = [255, 255, 255, 255];
const INK: Rgba = [38, 38, 42, 255];
const HATCH: Rgba = [214, 214, 218, 255];
/// Between the diagonal lines of the hatching \[pixels\].
const HATCH_STEP: u32 = 8;

/// Room kept around the picture: left (labels of y) and right (the bar), above and below.
const ROOM_X: f64 = 96.0 + 150.0;
const ROOM_Y: f64 = 52.0 + 68.0;
/// Least side of a picture.
const LEAST: u32 = 48;

/// The largest picture that a figure of `size` has room for.
///
/// # Errors
/// If that is less than 48 pixels wide or high.
pub fn plot_area(size: [u32; 2]) -> Result<[u32; 2], FigureError> {
    let scale = line_scale(size);
    let rooms = [ROOM_X, ROOM_Y].map(|room| (room * scale).ceil() as u32);
    let least = rooms.map(|room| room + LEAST);
    if size[0] < least[0] || size[1] < least[1] {
        return Err(FigureError::TooSmall { size, least });
    }
    Ok([size[0] - rooms[0], size[1] - rooms[1]])
}

/// A figure of `size` pixels around a picture of at most [`plot_area`], in the middle: over it the layers,
/// whose positions are pixels of the picture. Axes count from the tips of the cracks at deep zoom.
///
/// # Errors
/// A size without room for the picture.
pub fn figure(
    picture: &Picture,
    layers: Vec<Item>,
    labels: &Labels,
    cracks: &[Crack],
    size: [u32; 2],
) -> Result<Canvas, FigureError> {
    let (plot, room) = (picture.image.size, plot_area(size)?);
    if plot[0] > room[0] || plot[1] > room[1] {
        return Err(FigureError::TooLarge { plot, room });
    }
    let sheet = Sheet::new(picture, labels, cracks, size);
    let mut page = Canvas::new(size, PAGE);
    page.items.push(sheet.plot(layers));
    sheet.paint_bar(&mut page);
    sheet.draw_frame(&mut page);
    sheet.draw_x_axis(&mut page);
    sheet.draw_y_axis(&mut page);
    sheet.draw_bar(&mut page);
    sheet.draw_title(&mut page, &labels.title);
    Ok(page)
}

/// A picture with layers over it, and nothing around it.
#[must_use]
pub fn bare(picture: &Picture, layers: Vec<Item>) -> Canvas {
    let mut page = Canvas::new(picture.image.size, [0; 4]);
    page.items.push(Item::Picture { image: picture.image.clone(), corner: [0, 0] });
    page.items.extend(layers);
    page
}

/// A page with diagonal lines: what shows where the picture has no values.
fn hatched(size: [u32; 2]) -> Image {
    let mut image = Image::filled(size, PAGE);
    let pixels = image.rgba.as_chunks_mut().0;
    for (row, line) in (0u32..).zip(pixels.chunks_mut(size[0] as usize)) {
        for (column, pixel) in (0u32..).zip(line) {
            if (column + row) % HATCH_STEP == 0 {
                *pixel = HATCH;
            }
        }
    }
    image
}

#[cfg(test)]
mod tests {
    use super::color_bar::{ARROW, BAR};
    use super::sheet::BAR_GAP;
    use super::*;
    use ppum::vec2::{Rect, Vec2, vec2};
    use ppum_render::picture::Style;
    use ppum_render::range::Range;
    use ppum_render::raster::Raster;
    use ppum_render::view::View;

    const SIZE: [u32; 2] = [640, 480];

    fn labels() -> Labels {
        let word = |text: &str| text.to_owned();
        Labels {
            title: word(
                "A plate with a title that is much longer than the figure is wide, as they are",
            ),
            quantity: word(
                "a quantity whose name is longer than the figure is high, von Mises say",
            ),
            unit: word("MPa"),
            length_unit: word("mm"),
        }
    }

    /// x on a square, NaN in its upper left quarter.
    fn picture(half: f64, range: Range) -> Picture {
        let square = Rect::around(Vec2::ZERO, vec2(half, half));
        let view = View::hug(square, plot_area(SIZE).unwrap()).unwrap();
        let raster = Raster::from_fn(view.pixels, |i, j| match view.offset(i, j) {
            p if p.x < 0.0 && p.y > 0.0 => f64::NAN,
            p => p.x,
        });
        Picture::bare(&raster, &view, &Style { range, ..Style::default() }).unwrap()
    }

    fn drawn(picture: &Picture) -> Image {
        figure(picture, vec![], &labels(), &[], SIZE).unwrap().image()
    }

    /// The corner of the plot, found as the first place with the picture's last row of colours.
    fn plot_corner(page: &Image, picture: &Picture) -> [u32; 2] {
        let [columns, rows] = picture.image.size;
        let last_row = |x: u32, y: u32| {
            (0..columns).all(|i| page.pixel(x + i, y) == picture.image.pixel(i, rows - 1))
        };
        let mut places = (rows..SIZE[1]).flat_map(|y| (0..SIZE[0] - columns).map(move |x| [x, y]));
        let found = places.rfind(|&[x, y]| last_row(x, y)).expect("the plot is on the page");
        [found[0], found[1] + 1 - rows]
    }

    #[test]
    fn the_picture_is_shown_pixel_for_pixel() {
        let picture = picture(1.0, Range::Auto);
        let page = drawn(&picture);
        let [x, y] = plot_corner(&page, &picture);
        let [columns, rows] = picture.image.size;
        assert_eq!(page.size, SIZE);
        for (i, j) in (0..columns).flat_map(|i| (0..rows).map(move |j| (i, j))) {
            let (shown, color) = (page.pixel(x + i, y + j), picture.image.pixel(i, j));
            let expected = match (color[3], (i + j) % HATCH_STEP) {
                (0, 0) => HATCH,
                (0, _) => PAGE,
                _ => color,
            };
            assert_eq!(shown, expected, "{i}, {j}");
        }
        for (i, j) in [(x - 1, y - 1), (x + columns, y + rows), (x - 1, y + 7)] {
            assert_eq!(page.pixel(i, j), INK, "the frame");
        }
    }

    #[test]
    fn ticks_are_at_their_values() {
        let picture = picture(1.0, Range::Auto);
        let page = drawn(&picture);
        let [x, y] = plot_corner(&page, &picture);
        let [columns, rows] = picture.image.size;
        let below = y + rows + 3;
        let marked: Vec<u32> =
            (0..=columns + 1).filter(|&i| page.pixel(x + i - 1, below) == INK).collect();
        let expected = [0, columns / 4, columns / 2, 3 * columns / 4, columns];
        assert_eq!(marked.len(), 5);
        for (found, place) in marked.into_iter().zip(expected) {
            assert!(found.abs_diff(place) <= 1, "{found} {place}");
        }
    }

    #[test]
    fn the_bar_runs_from_low_to_high_and_ends_in_arrows() {
        let picture = picture(1.0, Range::Fixed(-0.5, 0.5));
        let page = drawn(&picture);
        let [x, y] = plot_corner(&page, &picture);
        let [columns, rows] = picture.image.size;
        let column = x + columns + (BAR_GAP + BAR / 2.0) as u32;
        let map = &picture.colormap;
        assert_eq!(page.pixel(column, y + ARROW as u32 - 3), map.above);
        assert_eq!(page.pixel(column, y + rows - ARROW as u32 + 3), map.below);
        let near = |a: Rgba, b: Rgba| (0..3).all(|k| a[k].abs_diff(b[k]) < 6);
        assert!(near(page.pixel(column, y + ARROW as u32 + 1), map.color(1.0)));
        assert!(near(page.pixel(column, y + rows - ARROW as u32 - 2), map.color(0.0)));
        assert!(near(page.pixel(column, y + rows / 2), map.color(0.5)));
    }

    #[test]
    fn long_words_stay_on_the_page() {
        for half in [1.0, 1e-5, 3e7] {
            let page = drawn(&picture(half, Range::Auto));
            let [right, bottom] = SIZE.map(|n| n - 1);
            for (i, j) in (0..SIZE[0]).flat_map(|i| (0..SIZE[1]).map(move |j| (i, j))) {
                let is_margin = i < 2 || j < 2 || i + 1 >= right || j + 1 >= bottom;
                assert!(!is_margin || page.pixel(i, j) == PAGE, "{i}, {j}");
            }
        }
    }

    #[test]
    fn figures_without_room_are_refused() {
        let picture = picture(1.0, Range::Auto);
        let refused = |size| figure(&picture, vec![], &labels(), &[], size).unwrap_err();
        assert!(matches!(refused([200, 480]), FigureError::TooSmall { .. }));
        assert!(matches!(refused([500, 400]), FigureError::TooLarge { .. }));
        let FigureError::TooSmall { least, .. } = refused([10, 10]) else { unreachable!() };
        assert_eq!(plot_area(least), Ok([LEAST, LEAST]));
    }
}
