//! The lines along which elements are cut: zeros of their level fields, as far as the element's
//! other clips hold.
//!
//! In the square of ξ with the half-width h around a, |φ(ξ) − φ(a)| ≤ h Σ (j + k) |c_jk|. Squares
//! that this shows to hold no zero are left out, and so are those out of sight. The others are
//! halved until they are a few pixels wide, where φ is as good as linear along their sides.

use std::collections::BTreeSet;

use ppum::dataset::{FieldData, Step};
use ppum::field::Field;
use ppum::function::{Frame, FunctionKind};
use ppum::mesh::Mesh;
use ppum::polynomial::{PolynomialSpace, polynomial_in};
use ppum::vec2::Vec2;
use ppum_render::pieces::steepness;
use ppum_render::view::View;

use super::edges::is_near;
use super::strokes::{CRACK, CRACK_WIDTH, SEAM, SEAM_WIDTH};
use crate::canvas::{CanvasItem, CanvasPath, StrokeStyle};

/// Half the diagonal of squares that are small enough, in pixels, and the least halvings.
const SMALL: f64 = 1.5;
const HALVINGS: i32 = 2;

/// Least half-width of a square: that of ξ without digits.
const FINEST: f64 = 1e-15;

/// The cuts of the elements in sight, drawn as cracks are; nothing of covers.
#[must_use]
pub fn cuts(view: &View, scale: f64, field: &Field<'_>) -> Vec<CanvasItem> {
    let Some(mesh) = field.step.partition.mesh() else { return Vec::new() };
    let mut path = CanvasPath::default();
    for patch in (0..mesh.len()).filter(|&patch| is_near(view, mesh.bounds(patch))) {
        for line in lines(field, mesh, patch) {
            CutLine::new(view, field.step, patch, &line).add([0.0; 2], 1.0, &mut path);
        }
    }
    let pen = StrokeStyle::new(CRACK, CRACK_WIDTH * scale);
    let halo = pen.with_halo(SEAM, SEAM_WIDTH * scale);
    [halo, pen].map(|pen| CanvasItem::Line { path: path.clone(), pen }).to_vec()
}

/// The zero line of a level field, where other level fields are of some sign.
#[derive(PartialEq, Eq, PartialOrd, Ord)]
struct ZeroLine {
    field: u32,
    sides: Vec<(u32, bool)>,
}

/// The lines of a patch: of its clips, of signs, and of the cuts of angles, which are where φ = 0
/// and ψ < 0.
fn lines(field: &Field<'_>, mesh: &Mesh, patch: usize) -> BTreeSet<ZeroLine> {
    let clips: Vec<_> = mesh.clips(patch).iter().map(|clip| (clip.field, clip.is_above)).collect();
    let line = |field: u32, behind: Option<u32>| {
        let others = clips.iter().copied().filter(|(other, _)| *other != field);
        ZeroLine { field, sides: others.chain(behind.map(|psi| (psi, false))).collect() }
    };
    let functions = field.data.blocks(patch).filter_map(|block| {
        match field.step.functions[field.data.block_function[block] as usize].kind {
            FunctionKind::Level { field } => Some(line(field, None)),
            FunctionKind::Formula { frame: Frame::Levels([psi, phi]), .. } => {
                Some(line(phi, Some(psi)))
            }
            _ => None,
        }
    });
    clips.iter().map(|(field, _)| line(*field, None)).chain(functions).collect()
}

/// A level field on one patch.
struct Level<'a> {
    blocks: Vec<(PolynomialSpace, usize, &'a [f64])>,
    /// Bound of |φ(ξ) − φ(a)| / max |ξ − a| in the square.
    slope: f64,
}

impl<'a> Level<'a> {
    fn new(data: &'a FieldData, patch: usize) -> Self {
        let block = |k| (data.space(k), data.block_degree[k].into(), data.block_coefficients(k, 0));
        let blocks: Vec<_> = data.blocks(patch).map(block).collect();
        let slopes = blocks.iter().map(|(space, degree, c)| steepness(*space, *degree, c));
        Self { slope: slopes.sum(), blocks }
    }

    fn at(&self, xi: [f64; 2]) -> f64 {
        let value = |(space, degree, c): &(PolynomialSpace, usize, &[f64])| {
            polynomial_in::<f64, 0>(*space, c, *degree, xi).v
        };
        self.blocks.iter().map(value).sum()
    }
}

/// A line of one patch on an image.
struct CutLine<'a> {
    view: &'a View,
    mesh: &'a Mesh,
    patch: usize,
    level: Level<'a>,
    sides: Vec<(Level<'a>, f64)>,
    /// Bound of the slope of the map, in pixels.
    slope: f64,
}

impl<'a> CutLine<'a> {
    fn new(view: &'a View, step: &'a Step, patch: usize, line: &ZeroLine) -> Self {
        let mesh = step.partition.mesh().expect("a line of a mesh");
        let level = |field: u32| Level::new(&step.fields[field as usize], patch);
        let sign = |is_above: bool| if is_above { 1.0 } else { -1.0 };
        let sides = line.sides.iter().map(|(field, is_above)| (level(*field), sign(*is_above)));
        let (space, degree) = (mesh.map_space[patch], mesh.map_degree[patch].into());
        let slopes = mesh.map_of(patch).map(|c| steepness(space, degree, &[&[0.0], c].concat()));
        let slope = slopes[0].max(slopes[1]) / view.pixel_size();
        Self { view, mesh, patch, level: level(line.field), sides: sides.collect(), slope }
    }

    fn pixel(&self, xi: [f64; 2]) -> Vec2 {
        self.view.pixel_of_offset(self.mesh.image(self.patch, xi).0 - self.view.center)
    }

    /// Adds the part of the line in a square of ξ.
    fn add(&self, at: [f64; 2], half: f64, path: &mut CanvasPath) {
        let shape = self.mesh.shape[self.patch];
        let is_beside = shape.margin([0.0; 2], at) < -2.0 * half || self.level.slope == 0.0;
        if is_beside || self.level.at(at).abs() > self.level.slope * half || !self.is_seen(at, half)
        {
            return;
        }
        let corners = [[-1.0, -1.0], [1.0, -1.0], [1.0, 1.0], [-1.0, 1.0]];
        if self.is_small(at, half) {
            let corners = corners.map(|[i, j]| [at[0] + i * half, at[1] + j * half]);
            return self.cross(corners, path);
        }
        let quarter = 0.5 * half;
        for [i, j] in corners {
            self.add([at[0] + i * quarter, at[1] + j * quarter], quarter, path);
        }
    }

    /// True if the image of a square may come near the image.
    fn is_seen(&self, at: [f64; 2], half: f64) -> bool {
        let (pixel, [columns, rows]) = (self.pixel(at), self.view.pixels.map(f64::from));
        let is_near = |x: f64, size: f64| {
            let reach = self.slope * half + 0.1 * size;
            -reach <= x && x <= size + reach
        };
        is_near(pixel.x, columns) && is_near(pixel.y, rows)
    }

    fn is_small(&self, at: [f64; 2], half: f64) -> bool {
        let size = |[i, j]: [f64; 2]| {
            let corner = self.pixel([at[0] + i * half, at[1] + j * half]);
            (corner - self.pixel(at)).length()
        };
        let is_deep = half <= 0.5f64.powi(HALVINGS);
        is_deep && (half < FINEST || size([1.0, 1.0]).max(size([1.0, -1.0])) <= SMALL)
    }

    /// Adds the zero line of a small square.
    fn cross(&self, corners: [[f64; 2]; 4], path: &mut CanvasPath) {
        let values = corners.map(|corner| self.level.at(corner));
        let crossings = (0..4).filter_map(|k| {
            let (a, b) = (values[k], values[(k + 1) % 4]);
            let at = || between(corners[k], corners[(k + 1) % 4], a / (a - b));
            ((a >= 0.0) != (b >= 0.0)).then(at)
        });
        let crossings: Vec<[f64; 2]> = crossings.collect();
        for ends in crossings.as_chunks::<2>().0 {
            if let Some([from, to]) = self.kept(*ends) {
                path.pieces.push(vec![self.pixel(from), self.pixel(to)]);
            }
        }
    }

    /// The part of a segment in the shape and on its sides.
    fn kept(&self, [a, b]: [[f64; 2]; 2]) -> Option<[[f64; 2]; 2]> {
        let edges = self.mesh.shape[self.patch].edges();
        let margins = edges.iter().map(|[c, x, y]| [a, b].map(|p| c + x * p[0] + y * p[1]));
        let sides = self.sides.iter().map(|(level, sign)| [a, b].map(|p| sign * level.at(p)));
        let (mut from, mut to) = (0.0f64, 1.0f64);
        for [at_a, at_b] in margins.chain(sides) {
            let zero = at_a / (at_a - at_b);
            match (at_a >= 0.0, at_b >= 0.0) {
                (true, true) => {}
                (true, false) => to = to.min(zero),
                (false, true) => from = from.max(zero),
                (false, false) => return None,
            }
        }
        (from < to).then(|| [between(a, b, from), between(a, b, to)])
    }
}

fn between(a: [f64; 2], b: [f64; 2], t: f64) -> [f64; 2] {
    [0, 1].map(|k| a[k] + t * (b[k] - a[k]))
}
