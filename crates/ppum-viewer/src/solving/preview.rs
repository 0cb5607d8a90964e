//! The geometry in the text of a problem, before it is solved.

use ppum::crack::Crack;
use ppum::domain::{Domain, Hole};
use ppum::vec2::{Rect, Vec2, vec2};
use ppum_figure::canvas::{CanvasItem, CanvasPath, StrokeStyle};
use ppum_figure::overlay::{self, LoadMark, SupportMark};
use ppum_problem::{Body, BoundaryStation, Problem};
use ppum_render::image::{Image, Rgba};
use ppum_render::view::View;

/// The body with its holes and cracks, and what holds and loads it.
#[derive(Clone, Debug, PartialEq)]
pub struct Preview {
    domain: Domain,
    cracks: Vec<Crack>,
    supports: Vec<SupportMark>,
    loads: Vec<LoadMark>,
    /// True if the text has no errors: else supports and loads are not known.
    pub(crate) is_complete: bool,
}

/// Distance of supports and loads, in parts of the body's longer side.
const SPACING: f64 = 0.1;
/// Room around the body for supports and loads, in parts of the image's sides.
const MARGIN: f64 = 0.16;
/// Most cracks and holes that are drawn: more of them are specks, and every image of the window
/// draws all.
pub(super) const MOST: usize = 2000;

const PLATE: Rgba = [150, 160, 175, 110];
const BORDER: Rgba = [110, 120, 135, 255];

impl Preview {
    /// That of a problem.
    #[must_use]
    pub fn new(problem: &Problem) -> Self {
        let size = problem.domain().bounds.size();
        let stations = problem.stations(SPACING * size.x.max(size.y));
        let support =
            |&BoundaryStation { at, outward, held, axis, exchanges, .. }: &BoundaryStation| {
                SupportMark { at, outward, held, axis, yields: exchanges }
            };
        let load = |&BoundaryStation { at, outward, traction, .. }: &BoundaryStation| LoadMark {
            at,
            outward,
            traction,
        };
        let held =
            stations.iter().filter(|station| station.exchanges || station.held != [false; 2]);
        let loaded = stations.iter().filter(|station| station.traction != Vec2::ZERO);
        let (supports, loads) = (held.map(support).collect(), loaded.map(load).collect());
        Self { supports, loads, is_complete: true, ..Self::of_body(&problem.body) }
    }

    /// That of a body whose supports and loads are not known.
    #[must_use]
    pub fn of_body(body: &Body) -> Self {
        let mut domain = body.domain().clone();
        // what lies outside of the outline is the last of the holes
        let outline = domain.holes.pop_if(|hole| hole.is_outside());
        domain.holes.truncate(MOST);
        domain.holes.extend(outline);
        let cracks = body.cracks().iter().take(MOST).cloned().collect();
        Self { domain, cracks, supports: Vec::new(), loads: Vec::new(), is_complete: false }
    }

    /// Holes, cracks, supports and loads, by number.
    pub(crate) fn counts(&self) -> [usize; 4] {
        [self.holes().len(), self.cracks.len(), self.supports.len(), self.loads.len()]
    }

    /// The holes but for what lies outside of the outline.
    fn holes(&self) -> &[Hole] {
        let count = self.domain.outline().unwrap_or(self.domain.holes.len());
        &self.domain.holes[..count]
    }

    /// The view of the body on so many pixels; none of a body that has no room there.
    pub(crate) fn view(&self, pixels: [u32; 2]) -> Option<View> {
        let bounds = self.domain.body_bounds();
        let (size, center) = (bounds.size(), bounds.center());
        let [across, up] = pixels.map(|count| f64::from(count) * (1.0 - 2.0 * MARGIN));
        let width = f64::from(pixels[0]) * (size.x / across).max(size.y / up);
        View::new(center, width, pixels).ok()
    }

    /// Drawn on so many pixels; nothing of a body that has no room there.
    pub(crate) fn items(&self, pixels: [u32; 2], scale: f64) -> Vec<CanvasItem> {
        let Some(view) = self.view(pixels) else { return Vec::new() };
        let mut items = self.body(&view, &self.domain.body_bounds(), scale);
        items.extend(overlay::rims(&view, scale, self.holes(), [None; 2]));
        items.extend(overlay::cracks(&view, scale, &self.cracks));
        items.extend(overlay::supports(&view, scale, &self.supports));
        items.extend(overlay::loads(&view, scale, &self.loads));
        items
    }

    /// The body as a grey area with its border.
    fn body(&self, view: &View, bounds: &Rect, scale: f64) -> Vec<CanvasItem> {
        let Rect { min, max } = *bounds;
        let corners = [min, vec2(max.x, min.y), max, vec2(min.x, max.y), min];
        let border = match self.domain.outline() {
            Some(outline) => rim(view, &self.domain.holes[outline]),
            None => corners.map(|corner| view.pixel(corner)).to_vec(),
        };
        let mut image = Image::filled(view.pixels, [0; 4]);
        fill(&mut image, &border, PLATE);
        self.holes().iter().for_each(|hole| fill(&mut image, &rim(view, hole), [0; 4]));
        let path = CanvasPath::of_pieces(vec![border]);
        let border = CanvasItem::Line { path, pen: StrokeStyle::new(BORDER, scale) };
        vec![CanvasItem::Picture { image, corner: [0, 0] }, border]
    }
}

/// The points of a rim in pixels, from the first to the first.
fn rim(view: &View, hole: &Hole) -> Vec<Vec2> {
    let (edges, tolerance) = (hole.rim_edges(), SMOOTH * view.pixel_size());
    let points = edges.iter().flat_map(|edge| edge.flattened(tolerance));
    points.map(|point| view.pixel(point)).collect()
}

/// Largest distance of arcs from what is drawn for them \[pixels\].
const SMOOTH: f64 = 0.1;

/// Gives the pixels whose centres lie in a closed line a colour.
fn fill(image: &mut Image, line: &[Vec2], color: Rgba) {
    let columns = image.size[0] as usize;
    let rows = image.rgba.as_chunks_mut::<4>().0.chunks_mut(columns.max(1));
    for (row, pixels) in rows.enumerate() {
        let mut crossings = crossings(line, row as f64 + 0.5);
        crossings.sort_by(f64::total_cmp);
        for pair in crossings.as_chunks::<2>().0 {
            let [from, to]: [usize; 2] =
                pair.map(|x: f64| ((x - 0.5).ceil().max(0.0) as usize).min(columns));
            pixels[from..to].fill(color);
        }
    }
}

/// The places at which a closed line crosses a row.
fn crossings(line: &[Vec2], y: f64) -> Vec<f64> {
    let crossed = line.windows(2).filter(|pair| (pair[0].y <= y) != (pair[1].y <= y));
    let place = |pair: &[Vec2]| {
        let (a, way) = (pair[0], pair[1] - pair[0]);
        a.x + (y - a.y) / way.y * way.x
    };
    crossed.map(place).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_plate_lies_in_the_picture_with_all_that_it_has() {
        let text = include_str!("../../../../examples/centre-crack.toml");
        let problem = Problem::parse(text, "plate", std::path::Path::new(".")).unwrap();
        let preview = Preview::new(&problem);
        let [holes, cracks, supports, loads] = preview.counts();
        assert_eq!((holes, cracks), (0, 1));
        assert!(supports + loads > 4, "{supports} {loads}");
        let items = preview.items([300, 200], 1.0);
        let inside = |p: &Vec2| p.x >= 0.0 && p.x <= 300.0 && p.y >= 0.0 && p.y <= 200.0;
        let mut points = 0;
        for item in &items {
            let path = match item {
                CanvasItem::Line { path, .. } => path,
                CanvasItem::Fill { outline, .. } => outline,
                _ => continue,
            };
            assert!(path.pieces.iter().flatten().all(inside), "{path:?}");
            points += path.pieces.iter().map(Vec::len).sum::<usize>();
        }
        assert!(points > 20, "{points}");
        assert!(preview.items([0, 0], 1.0).is_empty());
    }

    fn is_filled(items: &[CanvasItem], [x, y]: [f64; 2]) -> bool {
        let CanvasItem::Picture { image, .. } = &items[0] else { panic!("no area") };
        let [x, y] = [x * f64::from(image.size[0]), y * f64::from(image.size[1])];
        let pixels: &[[u8; 4]] = image.rgba.as_chunks().0;
        pixels[y as usize * image.size[0] as usize + x as usize][3] > 0
    }

    /// The body has the shape of its outline and holes, also while material and loads are missing.
    #[test]
    fn the_body_has_its_true_outline() {
        let head = "[domain.outline]\npoints = [[0, 0], [3, 0], [3, 1], [1, 1], [1, 3], [0, 3]]\n";
        let hole =
            "[[hole]]\ncenter = [2.0, 0.5]\nradius = 0.3\n[[crack]]\npoints = [[0, 2], [0.5, 2]]";
        let text = format!("{head}{hole}");
        let folder = std::path::Path::new(".");
        assert!(Problem::parse(&text, "plate", folder).is_err());
        let body = Problem::body_of(&text, folder).expect("a body");
        let preview = Preview::of_body(&body.body);
        assert_eq!(preview.counts(), [1, 1, 0, 0]);
        assert!(!preview.is_complete);
        let items = preview.items([300, 300], 1.0);
        // the body takes 0.16 to 0.84 of the image
        let at = |x: f64, y: f64| [0.16 + 0.68 * x / 3.0, 0.84 - 0.68 * y / 3.0];
        for (point, is_inside) in [
            (at(0.5, 2.5), true),
            (at(2.9, 0.9), true),
            (at(2.0, 0.5), false),
            (at(1.2, 1.2), false),
            (at(2.9, 2.9), false),
            (at(-0.1, 0.5), false),
        ] {
            assert_eq!(is_filled(&items, point), is_inside, "{point:?}");
        }
        assert_eq!(Problem::body_of("[domain", folder), None);
        assert_eq!(Problem::body_of("[[crack]]\npoints = 3", folder), None);
    }
}
