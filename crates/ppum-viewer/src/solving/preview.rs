//! The geometry in the text of a problem, before it is solved.

use ppum::crack::Crack;
use ppum::domain::{Domain, Hole};
use ppum::vec2::{Vec2, vec2};
use ppum_figure::canvas::{CanvasItem, CanvasPath, StrokeStyle};
use ppum_figure::overlay::{self, LoadMark, SupportMark};
use ppum_problem::{BoundaryStation, Problem};
use ppum_render::image::Rgba;
use ppum_render::view::View;

/// The body with its holes and cracks, and what holds and loads it.
#[derive(Clone, Debug, PartialEq)]
pub struct Preview {
    domain: Domain,
    cracks: Vec<Crack>,
    supports: Vec<SupportMark>,
    loads: Vec<LoadMark>,
}

/// Distance of supports and loads, in parts of the body's longer side.
const SPACING: f64 = 0.1;
/// Room around the body for supports and loads, in parts of the image's sides.
const MARGIN: f64 = 0.16;
/// Most cracks and holes that are drawn: more of them are specks, and every image of the window
/// draws all.
const MOST: usize = 2000;

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
        let mut domain = problem.domain().clone();
        domain.holes.truncate(MOST);
        let cracks = problem.cracks().iter().take(MOST).cloned().collect();
        let (supports, loads) = (held.map(support).collect(), loaded.map(load).collect());
        Self { domain, cracks, supports, loads }
    }

    /// Holes, cracks, supports and loads, by number.
    pub(crate) fn counts(&self) -> [usize; 4] {
        [self.holes().len(), self.cracks.len(), self.supports.len(), self.loads.len()]
    }

    fn holes(&self) -> &[Hole] {
        &self.domain.holes
    }

    /// Drawn on so many pixels; nothing of a body that has no room there.
    pub(crate) fn items(&self, pixels: [u32; 2], scale: f64) -> Vec<CanvasItem> {
        let bounds = self.domain.bounds;
        let (size, center) = (bounds.size(), (bounds.min + bounds.max) * 0.5);
        let [across, up] = pixels.map(|count| f64::from(count) * (1.0 - 2.0 * MARGIN));
        let width = f64::from(pixels[0]) * (size.x / across).max(size.y / up);
        let Ok(view) = View::new(center, width, pixels) else { return Vec::new() };
        let mut items = plate(&view, bounds.min, bounds.max, scale);
        items.extend(overlay::rims(&view, scale, self.holes(), [None; 2]));
        items.extend(overlay::cracks(&view, scale, &self.cracks));
        items.extend(overlay::supports(&view, scale, &self.supports));
        items.extend(overlay::loads(&view, scale, &self.loads));
        items
    }
}

/// The box of the body.
fn plate(view: &View, min: Vec2, max: Vec2, scale: f64) -> Vec<CanvasItem> {
    let corners = [min, vec2(max.x, min.y), max, vec2(min.x, max.y), min];
    let outline = CanvasPath::of_pieces(vec![corners.map(|corner| view.pixel(corner)).to_vec()]);
    let border = CanvasItem::Line { path: outline.clone(), pen: StrokeStyle::new(BORDER, scale) };
    vec![CanvasItem::Fill { outline, color: PLATE }, border]
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
}
