//! Overlays of an image: cracks, rims of holes, the cover and its enrichment, integration discs,
//! supports and loads.
//!
//! Each gives what is to be drawn on a page of the view's pixels. Widths of lines and sizes of
//! marks and letters are multiples of a `scale`, not of pixels, so that in a figure they are
//! lengths on paper. Lines are placed through offsets from the view's centre, so they are where the
//! field has them at any zoom: an oblique line through a view 1e-12 of the domain wide is drawn by
//! its distance from the centre and its direction, not between end points that lie 10^15 pixels
//! away. A line has one colour throughout, and a seam that parts it from its own colour.

mod cover;
mod cuts;
mod deformed;
mod edges;
mod glyphs;
mod isolines;
mod legend;
mod rings;
mod strokes;
mod supports;

use ppum::border::{is_mirrored_side, touch};
use ppum::crack::{Crack, tips};
use ppum::domain::Hole;
use ppum::edge::Edge;
use ppum_render::view::View;

use crate::canvas::{CanvasItem, CanvasPath, StrokeStyle};
pub use cover::{EnrichmentClass, boxes, cells, centers, elements, enrichments, patches, points};
pub use cuts::cuts;
pub use deformed::{carried, deformed_cells, deformed_outline, faces, undeformed_outline};
pub use glyphs::{arrows, crosses};
pub use isolines::{Room, isolines};
pub(crate) use legend::{LegendBox, MARGIN as LEGEND_MARGIN, TEXT as LEGEND_TEXT};
pub use legend::{LegendEntry, Symbol, legend, legend_box};
pub use rings::rings;
use strokes::{
    CRACK, CRACK_WIDTH, RIM_WIDTH, SEAM, SEAM_WIDTH, TIP_RADIUS, circle, visible_edges,
    visible_part,
};
pub use supports::{LoadMark, SupportMark, loads, supports};

/// Scale of a bare image's lines and letters: 1 up to 1024 × 768 pixels, lest they be unreadable,
/// and growing with larger ones. In a figure it is
/// [`FigureStyle::scale`](crate::figure::FigureStyle::scale).
#[must_use]
pub fn line_scale(size: [u32; 2]) -> f64 {
    (f64::from(size[0]) / 1024.0).min(f64::from(size[1]) / 768.0).clamp(1.0, 20.0)
}

/// The cracks as lines and their tips as dots.
#[must_use]
pub fn cracks(view: &View, scale: f64, cracks: &[Crack]) -> Vec<CanvasItem> {
    let mut lines = CanvasPath::default();
    for crack in cracks {
        add_edges(&mut lines, view, crack.edges(), crack.is_curved());
    }
    let ends = tips(cracks).map(|tip| cracks[tip.crack as usize].end_point(tip.end));
    let dots = CanvasPath::of_pieces(ends.map(|end| vec![view.pixel(end)]).collect());
    let pen =
        |width: f64| StrokeStyle::new(CRACK, width * scale).with_halo(SEAM, SEAM_WIDTH * scale);
    // seams below all lines
    let (lines_pen, dots_pen) = (pen(CRACK_WIDTH), pen(2.0 * TIP_RADIUS));
    let plain = |pen: StrokeStyle| StrokeStyle { halo: None, ..pen };
    vec![
        CanvasItem::Line { path: lines.clone(), pen: lines_pen },
        CanvasItem::Line { path: dots, pen: dots_pen },
        CanvasItem::Line { path: lines, pen: plain(lines_pen) },
    ]
}

/// The rims of holes as thin lines, except for sides on the lines x = a and y = b at which the body
/// is mirrored.
#[must_use]
pub fn rims(view: &View, scale: f64, holes: &[Hole], mirrors: [Option<f64>; 2]) -> Vec<CanvasItem> {
    let mut path = CanvasPath::default();
    for hole in holes {
        if let Hole::Circle { center, radius } = hole {
            circle(view, *center, *radius).into_iter().for_each(|edge| path.edge(edge));
        }
        let touch = touch(&hole.rim_bounds());
        let is_drawn =
            |edge: &Edge| edge.is_arc() || !is_mirrored_side([edge.from, edge.to], mirrors, touch);
        let is_curved = hole.edges().any(|edge| edge.is_arc());
        add_edges(&mut path, view, hole.edges().filter(is_drawn), is_curved);
    }
    vec![CanvasItem::Line { path, pen: StrokeStyle::new(CRACK, RIM_WIDTH * scale) }]
}

/// Adds what is seen of edges: of polylines each segment, of others curves that go on at joints.
fn add_edges(
    path: &mut CanvasPath,
    view: &View,
    edges: impl Iterator<Item = Edge>,
    is_curved: bool,
) {
    for edge in edges {
        if is_curved {
            visible_edges(view, edge).into_iter().for_each(|edge| path.edge(edge));
        } else {
            path.pieces.extend(visible_part(view, edge.from, edge.to).map(Vec::from));
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::canvas::Canvas;
    use ppum::crack::CrackEnd;
    use ppum::domain::PolygonSide;
    use ppum::vec2::{Vec2, vec2};
    use ppum_render::image::{Image, Rgba};

    const GREY: Rgba = [128, 128, 128, 255];

    fn straight(a: Vec2, b: Vec2) -> Crack {
        Crack::polyline(vec![a, b], [CrackEnd::Tip, CrackEnd::Mouth])
    }

    /// The items on a page of one colour.
    pub(super) fn on(color: Rgba, view: &View, items: Vec<CanvasItem>) -> Image {
        Canvas { size: view.pixels, paper: color, items }.image()
    }

    fn draw(view: &View, crack: Crack) -> Image {
        on(GREY, view, cracks(view, 1.0, &[crack]))
    }

    #[test]
    fn a_crack_is_dark_with_a_light_seam_and_a_dot_at_its_tip() {
        let view = View::window(-1.0, -1.0, 1.0, 1.0, [201, 201]).unwrap();
        let image = draw(&view, straight(Vec2::ZERO, vec2(1.0, 0.0)));
        assert_eq!(image.pixel(150, 100), CRACK);
        let seam = image.pixel(150, 98);
        assert!(seam[0] > 150, "{seam:?}");
        assert_eq!(image.pixel(150, 90), GREY);
        assert_eq!(image.pixel(50, 100), GREY);
        assert_eq!(image.pixel(100, 102), CRACK, "the dot of the tip");
        let mouth = image.pixel(198, 104);
        assert_eq!(mouth, GREY, "no dot at a mouth");
    }

    /// A crack from (0, 0) to (1, 3): the f64 nearest to its middle third is off the line by a
    /// known part of a pixel, found here with exact integers.
    #[test]
    fn an_oblique_crack_is_in_place_at_a_width_of_1e_12() {
        let center = vec2(0.123456789, 3.0 * 0.123456789);
        let view = View::new(center, 1e-12, [201, 201]).unwrap();
        let [a, b] = visible_part(&view, Vec2::ZERO, vec2(1.0, 3.0)).unwrap();
        // y − 3x of the centre, exact as both are multiples of 2^-60.
        let whole = |v: f64| (v * 2f64.powi(60)) as i128;
        let excess = (whole(center.y) - 3 * whole(center.x)) as f64 / 2f64.powi(60);
        let across = -excess / 10f64.sqrt() / view.pixel_size();
        let middle = vec2(100.5, 100.5);
        let found = (a - middle).cross((b - a).unit());
        assert!((found.abs() - across.abs()).abs() < 0.05, "{found} {across}");
        let slope = (b.y - a.y) / (b.x - a.x);
        assert!((slope + 3.0).abs() < 1e-9);
        assert!((b - a).length() > 400.0);
    }

    #[test]
    fn a_tip_is_in_place_at_a_width_of_1e_12() {
        let tip = vec2(0.7, -0.3);
        let view = View::new(tip, 1e-12, [101, 101]).unwrap();
        let image = draw(&view, straight(tip, vec2(0.2, -0.3)));
        assert_eq!(image.pixel(50, 50), CRACK);
        assert_eq!(image.pixel(10, 50), CRACK);
        assert_eq!(image.pixel(60, 50), GREY);
    }

    /// The pixels whose centres lie near the rim are dark, those a pixel away are not; also where
    /// the arc is the border of a view 1e-12 wide.
    #[test]
    fn rims_of_holes_are_in_place() {
        let circle = Hole::Circle { center: vec2(0.5, 0.25), radius: 0.625 };
        let corners = [[0.5, 0.25], [0.875, 0.75], [0.0, 1.0]].map(Vec2::from);
        let polygon = Hole::polygon(corners.to_vec());
        for (hole, center, width) in [
            (&circle, vec2(0.4, 0.3), 1.5),
            (&circle, vec2(0.875, 0.75), 1e-12),
            (&polygon, vec2(0.4, 0.6), 1.5),
            (&polygon, vec2(0.875, 0.75), 1e-12),
        ] {
            let view = View::new(center, width, [101, 101]).unwrap();
            let image = on(GREY, &view, rims(&view, 1.0, std::slice::from_ref(hole), [None; 2]));
            for (column, row) in (0..101).flat_map(|i| (0..101).map(move |j| (i, j))) {
                // A world coordinate is rounded to a fiftieth of the smallest pixel.
                let distance = hole.rim_distance(center + view.offset(column, row));
                let pixels = distance / view.pixel_size();
                let is_dark = image.pixel(column, row)[0] < 72;
                assert!(pixels < 1.1 || !is_dark, "{hole:?} {width} {column} {row}");
                assert!(pixels > 0.3 || is_dark, "{hole:?} {width} {column} {row}");
            }
        }
    }

    /// Stadium and lens: rims with arcs are where their points are, at joints too.
    #[test]
    fn rims_with_arcs_are_in_place() {
        let corners = [[0.2, 0.3], [0.7, 0.3], [0.7, 0.6], [0.2, 0.6]].map(Vec2::from).to_vec();
        let hole = Hole::with_arcs(corners, vec![0.0, 1.0, 0.0, -0.4], PolygonSide::Inside);
        let arc = hole.edges().nth(1).unwrap();
        for (center, width) in [
            (vec2(0.5, 0.4), 1.5),
            (arc.at(0.3), 1e-3),
            (arc.at(0.3), 1e-12),
            (arc.from, 1e-12),
            (arc.to, 1e-12),
        ] {
            let view = View::new(center, width, [101, 101]).unwrap();
            let image = on(GREY, &view, rims(&view, 1.0, std::slice::from_ref(&hole), [None; 2]));
            for (column, row) in (0..101).flat_map(|i| (0..101).map(move |j| (i, j))) {
                let distance = hole.rim_distance(center + view.offset(column, row));
                let pixels = distance / view.pixel_size();
                let is_dark = image.pixel(column, row)[0] < 72;
                assert!(pixels < 1.1 || !is_dark, "{center:?} {width} {column} {row}");
                assert!(pixels > 0.3 || is_dark, "{center:?} {width} {column} {row}");
            }
        }
    }

    /// Points of an exact circle: a view 1e-12 wide draws them to hundredths of a pixel.
    #[test]
    fn an_arc_has_no_noise_at_a_width_of_1e_12() {
        let (center, radius) = (vec2(0.5, 0.25), 0.625);
        let bulge = std::f64::consts::FRAC_PI_8.tan();
        let arc = Edge { from: vec2(1.125, 0.25), to: vec2(0.5, 0.875), bulge };
        for edge in [arc, arc.reversed()] {
            for at in [vec2(0.875, 0.75), arc.from, arc.to] {
                let view = View::new(at, 1e-12, [1000, 1000]).unwrap();
                let drawn = visible_edges(&view, edge);
                assert!(!drawn.is_empty());
                for p in drawn.iter().flat_map(|e| [0.0, 0.3, 0.5, 0.9, 1.0].map(|t| e.at(t))) {
                    let pixels = p - vec2(500.0, 500.0);
                    let offset = vec2(pixels.x, -pixels.y) * view.pixel_size();
                    // |p − c|² − r² by the offset from a point of the circle
                    let excess = ((at - center) * 2.0 + offset).dot(offset);
                    let away = excess / (2.0 * radius) / view.pixel_size();
                    assert!(away.abs() < 0.03, "{at:?} {away}");
                }
            }
        }
    }

    /// A crack of arcs, reversed and divided, is the same image.
    #[test]
    fn a_curved_crack_does_not_depend_on_its_division() {
        let crack = Crack {
            points: [[-0.7, 0.1], [0.1, 0.3], [0.5, -0.2], [0.8, -0.2]].map(Vec2::from).to_vec(),
            bulges: vec![0.5, -1.4, 0.0],
            ends: [CrackEnd::Tip, CrackEnd::Mouth],
        };
        let reversed = Crack {
            points: crack.points.iter().rev().copied().collect(),
            bulges: crack.bulges.iter().rev().map(|bulge| -bulge).collect(),
            ends: [crack.ends[1], crack.ends[0]],
        };
        let parts: Vec<Edge> = crack
            .edges()
            .flat_map(|e| (0..10).map(move |k| e.part([k, k + 1].map(|k| f64::from(k) / 10.0))))
            .collect();
        let divided = Crack {
            points: parts.iter().map(|e| e.from).chain([parts[29].to]).collect(),
            bulges: parts.iter().map(|e| e.bulge).collect(),
            ends: crack.ends,
        };
        let joint = crack.points[1];
        for (center, width) in [(Vec2::ZERO, 2.0), (joint, 1e-2), (joint, 1e-9)] {
            let view = View::new(center, width, [151, 151]).unwrap();
            let image = draw(&view, crack.clone());
            for other in [&reversed, &divided] {
                let other = draw(&view, other.clone());
                let pairs = image.rgba.iter().zip(&other.rgba);
                let most = pairs.map(|(a, b)| a.abs_diff(*b)).max();
                assert!(most <= Some(6), "{center:?} {width} {most:?}");
            }
        }
    }

    #[test]
    fn what_is_far_away_does_not_show() {
        let view = View::new(Vec2::ZERO, 1e-6, [32, 32]).unwrap();
        for crack in
            [straight(vec2(0.1, -1.0), vec2(0.1, 1.0)), straight(vec2(0.5, 0.0), vec2(1.0, 0.0))]
        {
            assert_eq!(draw(&view, crack), Image::filled([32, 32], GREY));
        }
    }
}
