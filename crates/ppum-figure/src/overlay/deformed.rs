//! Overlays of the deformed body: the faces of its cracks, its border, the cells of the cover,
//! isolines, and where the border was.

use ppum::vec2::{Vec2, vec2};
use ppum_render::deform::{DeformError, Deformation, DeformedView, Paths};
use ppum_render::image::Rgba;
use ppum_render::isoline::Isoline;
use ppum_render::view::View;

use super::strokes::{CRACK, CRACK_WIDTH, RIM_WIDTH, SEAM, SEAM_WIDTH};
use crate::canvas::{CanvasItem, CanvasPath, StrokeStyle};

/// Colour of the cells' borders, and of the undeformed body.
const CELL: Rgba = [16, 16, 20, 110];
const BEFORE: Rgba = [120, 120, 128, 255];
/// Dashes and gaps of the undeformed border.
const DASHES: [f64; 2] = [7.0, 5.0];

/// The faces of all cracks, and of the cuts of elements, where they have moved to.
#[must_use]
pub fn faces(view: &DeformedView<'_>, scale: f64) -> Vec<CanvasItem> {
    let faces = view.faces().into_iter().flatten().flatten();
    let lines = faces.chain(view.cut_faces()).collect();
    let pen =
        StrokeStyle::new(CRACK, 0.7 * CRACK_WIDTH * scale).with_halo(SEAM, SEAM_WIDTH * scale);
    vec![line(view, lines, pen)]
}

/// The border of the body and the rims of its holes where they have moved to, except for sides of
/// its box on the lines x = a and y = b at which it is mirrored.
#[must_use]
pub fn deformed_outline(
    view: &DeformedView<'_>,
    mirrors: [Option<f64>; 2],
    scale: f64,
) -> Vec<CanvasItem> {
    vec![line(view, view.outline(mirrors), StrokeStyle::new(CRACK, RIM_WIDTH * scale))]
}

/// The border of the body, the rims and the cracks where they are without displacement, dashed,
/// except for sides on lines at which it is mirrored.
///
/// # Errors
/// As [`Deformation::new`].
pub fn undeformed_outline(
    view: &DeformedView<'_>,
    mirrors: [Option<f64>; 2],
    scale: f64,
) -> Result<Vec<CanvasItem>, DeformError> {
    let before = Deformation::new(view.field(), 0.0)?.seen(&view.view);
    let above = before.faces().into_iter().flat_map(|[above, _]| above);
    let [dash, gap] = DASHES.map(|length| length * scale);
    let pen = StrokeStyle::new(BEFORE, RIM_WIDTH * scale).dashed(dash, gap);
    let lines = before.outline(mirrors).into_iter().chain(above).chain(before.cut_faces());
    Ok(vec![line(&before, lines.collect(), pen)])
}

/// The borders of the cover's cells, or the edges of elements, where they have moved to.
#[must_use]
pub fn deformed_cells(
    view: &DeformedView<'_>,
    mirrors: [Option<f64>; 2],
    scale: f64,
) -> Vec<CanvasItem> {
    let offset = |p: Vec2| p - view.anchor;
    // the border of a cell on the right or above is that of its neighbour, or of the body
    let sides: Vec<[Vec2; 3]> = (view.field().step.partition.boxes().cell.iter())
        .map(|c| [vec2(c.min.x, c.max.y), c.min, vec2(c.max.x, c.min.y)].map(offset))
        .collect();
    let borders = view.paths(&sides).into_iter().chain(view.element_edges()).collect();
    let mut items = vec![line(view, borders, StrokeStyle::new(CELL, scale))];
    items.extend(deformed_outline(view, mirrors, scale));
    items
}

/// Isolines of the undeformed body, found about the view's anchor, where they have moved to.
#[must_use]
pub fn carried(view: &DeformedView<'_>, lines: &[Isoline]) -> Vec<Isoline> {
    // lines of one level follow one another
    let levels = lines.chunk_by(|a, b| a.level == b.level);
    let moved = levels.flat_map(|lines| {
        let level = lines[0].level;
        let paths = view.paths(&lines.iter().map(Isoline::polyline).collect::<Vec<_>>());
        paths.into_iter().map(move |points| Isoline { level, points, closed: false })
    });
    moved.collect()
}

/// The parts of paths in and near the image, as lines.
fn line(view: &DeformedView<'_>, paths: Paths, pen: StrokeStyle) -> CanvasItem {
    let seen = &view.view;
    let pieces = paths.iter().flat_map(|path| visible_runs(seen, path)).collect();
    CanvasItem::Line { path: CanvasPath::of_pieces(pieces), pen }
}

/// Runs of a path that come near the image, in pixels.
fn visible_runs(view: &View, path: &[Vec2]) -> Vec<Vec<Vec2>> {
    let reach = 2.0 * view.half().length();
    let is_near = |pair: &[Vec2]| {
        let (a, b) = (pair[0], pair[1]);
        let nearest = ppum::segment::distance([a, b], Vec2::ZERO);
        nearest <= reach
    };
    let clamped =
        |p: Vec2| if p.length() > 1e6 * reach { p * (1e6 * reach / p.length()) } else { p };
    let mut runs: Vec<Vec<Vec2>> = Vec::new();
    let mut goes_on = false;
    for pair in path.windows(2) {
        if is_near(pair) {
            let [a, b] = [pair[0], pair[1]].map(|p| view.pixel_of_offset(clamped(p)));
            match runs.last_mut() {
                Some(run) if goes_on => run.push(b),
                _ => runs.push(vec![a, b]),
            }
        }
        goes_on = is_near(pair);
    }
    runs
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::overlay::tests::on;
    use ppum::field::Field;
    use ppum::progress::unwatched;
    use ppum::quantity::Quantity;
    use ppum_render::isoline::isolines;
    use ppum_render::scatter::render;
    use ppum_testkit::random::Random;
    use ppum_testkit::synthetic::{Coefficients, Recipe};

    /// A body that is only moved: its border, rims and cells are those of the undeformed body,
    /// shifted.
    #[test]
    fn lines_of_a_moved_plate_are_moved() {
        let zeros = |constant: f64| [constant, 0.0, 0.0, 0.0, 0.0, 0.0].to_vec();
        let coefficients = Coefficients::Polynomial(vec![zeros(0.25), zeros(-0.125)]);
        let dataset = Recipe { coefficients, ..Recipe::default() }.dataset();
        let field = Field::new(&dataset, 0).unwrap();
        let view = View::fit(dataset.domain.bounds, [200, 150]).unwrap();
        let moved = View { center: view.center + vec2(0.5, -0.25), ..view };
        let draw = |factor: f64, view: &View| {
            let seen = Deformation::new(&field, factor).unwrap().seen(view);
            let items = [
                deformed_outline(&seen, [None; 2], 1.0),
                deformed_cells(&seen, [None; 2], 1.0),
                faces(&seen, 1.0),
            ]
            .concat();
            on([255; 4], view, items)
        };
        let [before, after] = [draw(0.0, &view), draw(2.0, &moved)];
        let apart = before.rgba.iter().zip(&after.rgba).map(|(a, b)| a.abs_diff(*b)).max();
        assert!(apart <= Some(3), "{apart:?}");
        // the middle of the crack's first segment, and a place away from all lines
        let [x, y] = {
            let ends = &dataset.steps[0].cracks[0].points;
            <[f64; 2]>::from(view.pixel((ends[0] + ends[1]) * 0.5)).map(|c| c as u32)
        };
        assert!(before.pixel(x, y)[0] < 90, "{:?}", before.pixel(x, y));
        assert!(before.rgba.chunks(4).filter(|p| p[0] > 250).count() > 10_000);
        let seen = Deformation::new(&field, 2.0).unwrap().seen(&moved);
        let outline = on([255; 4], &moved, undeformed_outline(&seen, [None; 2], 1.0).unwrap());
        let grey = outline.rgba.chunks(4).filter(|p| p[0] < 200).count();
        assert!(grey > 50, "{grey}");
    }

    /// u = G X in closed form: circles become ellipses, each point of a line lies on one to a tenth
    /// of a pixel, and lines end at the crack, on their own side.
    #[test]
    fn isolines_are_carried_over() {
        let mut random = Random(41);
        for _ in 0..4 {
            let g: [f64; 4] = std::array::from_fn(|_| random.between(-0.3, 0.3));
            let linear = |a: f64, b: f64| vec![0.0, a, b, 0.0, 0.0, 0.0];
            let parts = vec![linear(g[0], g[1]), linear(g[2], g[3])];
            let coefficients = Coefficients::Polynomial(parts);
            let dataset = Recipe { coefficients, ..Recipe::default() }.dataset();
            let field = Field::new(&dataset, 0).unwrap();
            let center = dataset.domain.bounds.center();
            let factor = random.between(0.5, 2.0);
            let text = format!("hypot(x - ({:?}), y - ({:?}))", center.x, center.y);
            let quantity = Quantity::parse(&text, &field).unwrap();
            let view = View::new(center, 1.2 * dataset.domain.bounds.size().x, [240, 200]).unwrap();
            let deformation = Deformation::new(&field, factor).unwrap();
            let points = deformation.seen(&view).points(unwatched()).unwrap();
            let material = points.material_view().expect("something is seen");
            let raster = render::<f64>(&field, &material, &quantity, unwatched()).unwrap();
            let levels = [0.11, 0.23, 0.37];
            let lines =
                isolines(&field, &material, &quantity, &levels, &raster, unwatched()).unwrap();
            let moved = carried(&points.view, &lines);
            assert!(levels.iter().all(|level| moved.iter().any(|line| line.level == *level)));
            let [a, b, c, d] = g.map(|entry| factor * entry);
            let (a, d) = (1.0 + a, 1.0 + d);
            let back = |p: Vec2| vec2(d * p.x - b * p.y, a * p.y - c * p.x) / (a * d - b * c);
            for line in &moved {
                for offset in &line.points {
                    let miss = (back(view.center + *offset - center).length() - line.level).abs();
                    assert!(miss < 0.1 * view.pixel_size(), "{miss}");
                }
            }
        }
    }

    /// Near an open crack: the value of the pixel that a point of a line lies in is the line's, but
    /// for what changes from pixel to pixel, on whichever side of the crack; and what is seen has
    /// its lines.
    #[test]
    fn carried_lines_lie_where_pixels_have_their_value() {
        for seed in 0..4 {
            let dataset =
                Recipe { coefficients: Coefficients::Taylor, ..Recipe::random(seed) }.dataset();
            let field = Field::new(&dataset, 0).unwrap();
            let quantity = Quantity::parse("ux", &field).unwrap();
            let view = View::fit(dataset.domain.bounds, [180, 140]).unwrap();
            let seen = Deformation::new(&field, 0.05).unwrap().seen(&view);
            let points = seen.points(unwatched()).unwrap();
            let drawn = points.raster(&quantity, unwatched()).unwrap();
            let material = points.material_view().expect("something is seen");
            let raster = render::<f64>(&field, &material, &quantity, unwatched()).unwrap();
            let all = raster.statistics();
            let levels = [0.3, 0.5, 0.7].map(|t| all.min + t * (all.max - all.min));
            let lines =
                isolines(&field, &material, &quantity, &levels, &raster, unwatched()).unwrap();
            let (mut right, mut count) = (0, 0);
            for line in carried(&seen, &lines) {
                for p in line.points.iter().map(|&offset| view.pixel_of_offset(offset)) {
                    let [i, j] = [p.x, p.y].map(|c| c.floor() as i64);
                    if !(1..179).contains(&i) || !(1..139).contains(&j) {
                        continue;
                    }
                    let around = (-1..=1).flat_map(|k| (-1..=1).map(move |l| (i + k, j + l)));
                    let around = around.map(|(i, j)| (i as u32, j as u32));
                    // of layers that lie over each other lines of all are drawn
                    if around.clone().any(|(i, j)| points.at(i, j).len() > 1) {
                        continue;
                    }
                    let values = around.map(|(i, j)| drawn.values.value(i, j));
                    let [low, high] = values
                        .fold([f64::INFINITY, f64::NEG_INFINITY], |[a, b], v| [a.min(v), b.max(v)]);
                    right += usize::from(low <= line.level && line.level <= high);
                    count += 1;
                }
            }
            assert!(count > 100, "{count}");
            assert!(right as f64 > 0.98 * f64::from(count), "{right} of {count}");
        }
    }
}
