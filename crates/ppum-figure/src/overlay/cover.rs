//! The cover: points, cells, patches and their centres.

use ppum::dataset::BoxPartition;
use ppum::decompose::FieldPart;
use ppum::field::Field;
use ppum::mesh::Mesh;
use ppum::vec2::{Rect, Vec2, vec2};
use ppum_render::image::Rgba;
use ppum_render::view::View;

use super::edges::{edges, is_near, reach};
use super::legend::{LegendEntry, Symbol};
use crate::canvas::{CanvasItem, CanvasPath, StrokeStyle};

/// Lines of cells, and their seam; both paler where cells are small.
const CELL: Rgba = [24, 24, 30, 210];
const SEAM: Rgba = [255, 255, 255, 120];
/// Borders and insides of patches: they overlap, so the insides add up.
const PATCH: Rgba = [30, 60, 140, 150];
const PATCH_INSIDE: Rgba = [60, 110, 200, 18];
const POINT: Rgba = [16, 16, 20, 255];
const WIDTH: f64 = 1.0;
const POINT_RADIUS: f64 = 2.0;
/// Side of a centre's square, and its largest part of the cell.
const CENTER: f64 = 7.0;
const CENTER_PART: f64 = 0.5;
/// Side of a cell from which on its lines are drawn in full.
const FULL: f64 = 24.0;

/// The kind of enrichment of a patch, by the functions of its blocks.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum EnrichmentClass {
    /// Polynomials alone.
    None,
    /// Polynomials times the side of a crack: multiplicative enrichment.
    Jump,
    /// Functions of a crack tip: additive enrichment.
    Tip,
    /// Both.
    JumpAndTip,
    /// Other functions, whatever else there is.
    Other,
}

impl EnrichmentClass {
    /// All kinds.
    pub const ALL: [Self; 5] = [Self::None, Self::Jump, Self::Tip, Self::JumpAndTip, Self::Other];

    /// Colours, those of Üffinger et al. 2011, figure 2, where it has them, and words of legends.
    const MARKS: [(Rgba, &'static str); 5] = [
        ([150, 150, 155, 255], "polynomials"),
        ([208, 38, 42, 255], "jump"),
        ([38, 78, 205, 255], "tip functions"),
        ([140, 50, 165, 255], "jump and tip functions"),
        ([24, 140, 80, 255], "other functions"),
    ];

    /// The colour.
    #[must_use]
    pub fn color(self) -> Rgba {
        Self::MARKS[self as usize].0
    }

    /// The words of a legend.
    #[must_use]
    pub fn label(self) -> &'static str {
        Self::MARKS[self as usize].1
    }

    /// The kind of the functions of a patch.
    fn of(parts: impl Iterator<Item = FieldPart>) -> Self {
        let add = |kind, part| match (kind, part) {
            (Self::Other, _) | (_, FieldPart::Other | FieldPart::Patch(_)) => Self::Other,
            (Self::Jump | Self::JumpAndTip, FieldPart::Tip) | (Self::Tip, FieldPart::Jump) => {
                Self::JumpAndTip
            }
            (Self::None, FieldPart::Jump) => Self::Jump,
            (Self::None, FieldPart::Tip) => Self::Tip,
            (kind, _) => kind,
        };
        parts.fold(Self::None, add)
    }
}

/// The kind of enrichment of each patch of a field.
#[must_use]
pub fn enrichments(field: &Field<'_>) -> Vec<EnrichmentClass> {
    let (data, functions) = (field.data, &field.step.functions);
    let part = |block: usize| FieldPart::of(&functions[data.block_function[block] as usize].kind);
    (0..field.step.partition.len()).map(|i| EnrichmentClass::of(data.blocks(i).map(part))).collect()
}

/// The points the cover was made from; nothing of a uniform cover.
#[must_use]
pub fn points(view: &View, scale: f64, partition: &BoxPartition) -> Vec<CanvasItem> {
    let seen = partition.points.iter().filter(|&&p| is_near(view, Rect::new(p, p)));
    let path = CanvasPath::of_pieces(seen.map(|&p| vec![view.pixel(p)]).collect());
    let pen = StrokeStyle::new(POINT, 2.0 * POINT_RADIUS * scale).with_halo(SEAM, scale);
    vec![CanvasItem::Line { path, pen }]
}

/// The borders of the cells.
#[must_use]
pub fn cells(view: &View, scale: f64, partition: &BoxPartition) -> Vec<CanvasItem> {
    let mut path = CanvasPath::default();
    let seen = partition.cell.iter().filter(|cell| is_near(view, **cell));
    seen.clone().for_each(|cell| frame(&mut path, view, *cell));
    let smallest = seen.map(|cell| cell.size().x.min(cell.size().y)).fold(f64::INFINITY, f64::min);
    let strength = (smallest / view.pixel_size() / (FULL * scale)).clamp(0.35, 1.0);
    let [line, seam] = [CELL, SEAM].map(|[r, g, b, a]| [r, g, b, (f64::from(a) * strength) as u8]);
    let pen = StrokeStyle::new(line, WIDTH * scale).with_halo(seam, 0.6 * scale * strength);
    vec![CanvasItem::Line { path, pen }]
}

/// The edges of a mesh's elements, in the place of cells.
#[must_use]
pub fn elements(view: &View, scale: f64, mesh: &Mesh) -> Vec<CanvasItem> {
    let pen = StrokeStyle::new(CELL, WIDTH * scale).with_halo(SEAM, 0.6 * scale);
    vec![CanvasItem::Line { path: edges(view, mesh, 0..mesh.len()), pen }]
}

/// The supports ω_i of the patches, translucent: darker where more of them overlap.
#[must_use]
pub fn patches(view: &View, scale: f64, partition: &BoxPartition) -> Vec<CanvasItem> {
    let (mut insides, mut borders) = (Vec::new(), CanvasPath::default());
    for support in (0..partition.len()).map(|i| partition.support(i)) {
        if is_near(view, support) {
            let mut outline = CanvasPath::default();
            frame(&mut outline, view, support);
            borders.pieces.extend(outline.pieces.iter().cloned());
            insides.push(CanvasItem::Fill { outline, color: PATCH_INSIDE });
        }
    }
    let pen = StrokeStyle::new(PATCH, WIDTH * scale);
    insides.push(CanvasItem::Line { path: borders, pen });
    insides
}

/// The centres of the cells as squares, coloured by the kind of enrichment, and what the colours
/// mean. Üffinger et al. 2011, figure 2.
#[must_use]
pub fn centers(view: &View, scale: f64, field: &Field<'_>) -> (Vec<CanvasItem>, Vec<LegendEntry>) {
    let cells = field.step.partition.cells();
    by_enrichment(view, field, |kind, seen| {
        let mut outline = CanvasPath::default();
        for cell in seen.iter().map(|&patch| cells[patch]) {
            let side = cell.size().x.min(cell.size().y) / view.pixel_size();
            let half = 0.5 * (CENTER * scale).min(CENTER_PART * side);
            let at = view.pixel_of_offset(cell.center() - view.center);
            outline.rect(at - vec2(half, half), at + vec2(half, half));
        }
        vec![CanvasItem::Fill { outline, color: kind.color() }]
    })
}

/// Draws the patches in sight of each kind of enrichment, and says what the colours mean.
fn by_enrichment(
    view: &View,
    field: &Field<'_>,
    draw: impl Fn(EnrichmentClass, &[usize]) -> Vec<CanvasItem>,
) -> (Vec<CanvasItem>, Vec<LegendEntry>) {
    let (cells, kinds) = (field.step.partition.cells(), enrichments(field));
    let (mut items, mut entries) = (Vec::new(), Vec::new());
    for kind in EnrichmentClass::ALL {
        let is_seen = |patch: &usize| kinds[*patch] == kind && is_near(view, cells[*patch]);
        let seen: Vec<usize> = (0..cells.len()).filter(is_seen).collect();
        if !seen.is_empty() {
            entries.push(LegendEntry::new(Symbol::Square(kind.color()), kind.label()));
            items.extend(draw(kind, &seen));
        }
    }
    (items, entries)
}

/// Widest line of a box, as a part of its side: what is inside is to be seen.
const BOX_PART: f64 = 0.1;

/// Opacity of the boxes of patches that have nothing but polynomials.
const PLAIN: u8 = 110;

/// The boxes of the cells in the colour of the kind of enrichment, and what the colours mean: two
/// boxes that share a side both show theirs. Üffinger et al. 2011, figure 8.
#[must_use]
pub fn boxes(view: &View, scale: f64, field: &Field<'_>) -> (Vec<CanvasItem>, Vec<LegendEntry>) {
    let (cells, mesh) = (field.step.partition.cells(), field.step.partition.mesh());
    by_enrichment(view, field, |kind, seen| {
        let [r, g, b, opaque] = kind.color();
        let opacity = if kind == EnrichmentClass::None { PLAIN } else { opaque };
        let color = [r, g, b, opacity];
        if let Some(mesh) = mesh {
            let pen = StrokeStyle::new(color, 1.5 * WIDTH * scale);
            return vec![CanvasItem::Line { path: edges(view, mesh, seen.iter().copied()), pen }];
        }
        seen.iter().map(|&patch| frame_inside(view, scale, cells[patch], color)).collect()
    })
}

/// The border of a cell, drawn within it.
fn frame_inside(view: &View, scale: f64, cell: Rect, color: [u8; 4]) -> CanvasItem {
    let side = cell.size().x.min(cell.size().y) / view.pixel_size();
    let width = (1.5 * WIDTH * scale).min(BOX_PART * side);
    let inset = 0.5 * width * view.pixel_size();
    let mut path = CanvasPath::default();
    frame(&mut path, view, Rect::new(cell.min + vec2(inset, inset), cell.max - vec2(inset, inset)));
    CanvasItem::Line { path, pen: StrokeStyle::new(color, width) }
}

/// Adds a box that may be larger than the view by far.
fn frame(path: &mut CanvasPath, view: &View, rect: Rect) {
    let around = reach(view);
    let corner = |p: Vec2| view.pixel_of_offset((p - view.center).max(-around).min(around));
    path.rect(corner(rect.min), corner(rect.max));
}

#[cfg(test)]
mod tests {
    use super::super::tests::on;
    use super::*;
    use ppum::weight::WeightFunction;

    fn cover(cell: Vec<Rect>) -> BoxPartition {
        let n = cell.len();
        BoxPartition {
            weight: WeightFunction::Linear,
            center: cell.iter().map(Rect::center).collect(),
            half: cell.iter().map(|c| c.size() * 0.65).collect(),
            origin: cell.iter().map(Rect::center).collect(),
            scale: cell.iter().map(|c| c.size() * 0.65).collect(),
            cell,
            level: vec![1; n],
            point: vec![None; n],
            points: vec![],
        }
    }

    /// Darker than a light ground, lighter than a dark one: by the line or by its seam; the same
    /// line on both.
    #[test]
    fn cell_borders_show_on_any_colour_and_do_not_add_up() {
        let unit = Rect::new(Vec2::ZERO, vec2(1.0, 1.0));
        let next = Rect::new(vec2(1.0, 0.0), vec2(2.0, 1.0));
        let cover = cover(vec![unit, next]);
        let view = View::window(0.0, 0.0, 2.0, 1.0, [201, 101]).unwrap();
        for color in [[0, 0, 0, 255], [128, 128, 128, 255], [255, 255, 255, 255]] {
            let image = on(color, &view, cells(&view, 1.0, &cover));
            let seen =
                |i: u32| (0..3).map(|k| image.pixel(i, 50)[k].abs_diff(color[k])).max().unwrap();
            assert!(seen(100).max(seen(99)) > 40, "{color:?}");
            assert_eq!(image.pixel(50, 50), color);
            let alone = on(
                color,
                &view,
                cells(&view, 1.0, &BoxPartition { cell: vec![unit], ..cover.clone() }),
            );
            assert_eq!(image.pixel(100, 50), alone.pixel(100, 50), "the shared border, drawn once");
        }
    }

    /// Each box keeps its colour beside its neighbour's, and what is inside is seen, however small
    /// the boxes are.
    #[test]
    fn boxes_that_share_a_side_both_show_theirs() {
        let view = View::window(0.0, 0.0, 2.0, 1.0, [201, 101]).unwrap();
        let [red, blue] = [[200, 0, 0, 255], [0, 0, 200, 255]];
        let unit = Rect::new(Vec2::ZERO, vec2(1.0, 1.0));
        let next = Rect::new(vec2(1.0, 0.0), vec2(2.0, 1.0));
        let items = vec![frame_inside(&view, 1.0, unit, red), frame_inside(&view, 1.0, next, blue)];
        let image = on([255; 4], &view, items);
        let [left, right] = [99, 101].map(|column| image.pixel(column, 50));
        assert!(left[0] > left[2] && right[2] > right[0], "{left:?} {right:?}");
        assert_eq!(image.pixel(50, 50), [255; 4]);
        let small = Rect::new(vec2(1.0, 0.5), vec2(1.1, 0.6));
        let image = on([255; 4], &view, vec![frame_inside(&view, 1.0, small, red)]);
        assert_eq!(image.pixel(105, 45), [255; 4]);
    }

    #[test]
    fn cell_borders_are_in_place_at_a_width_of_1e_12() {
        let corner = vec2(0.3, 0.7);
        let cover = cover(vec![Rect::new(Vec2::ZERO, corner), Rect::new(corner, vec2(1.0, 1.0))]);
        let view = View::new(corner, 1e-12, [101, 101]).unwrap();
        let image = on([255; 4], &view, cells(&view, 1.0, &cover));
        // The first cell lies left of and below its corner, the second right of and above it.
        for (column, row) in [(50, 80), (20, 50), (50, 20), (80, 50)] {
            assert!(image.pixel(column, row)[0] < 120, "{column} {row}");
        }
        assert_eq!(image.pixel(20, 20)[0], 255);
    }
}
