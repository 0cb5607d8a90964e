//! Evaluation at many points, on lanes.

use super::local::{LocalField, take_values};
use crate::crack::Side;
use crate::jet::Jet;
use crate::mesh::grid::PointGrid;
use crate::vec2::Vec2;
use ppum_formula::real::{LaneJob, LaneNumber, Real};

/// The field at many points, on lanes.
struct FieldEvaluation<'a, 'f, const D: usize> {
    local: &'a LocalField<'f>,
    offsets: &'a [Vec2],
    side: Side,
    /// All patches that cover any of the points; if they are not known, they are searched for, and
    /// points outside the domain are left out.
    patches: Option<&'a [u32]>,
    out: &'a mut [Jet<f64>],
}

impl<const D: usize> LaneJob<f64> for FieldEvaluation<'_, '_, D> {
    type Output = ();

    #[inline(always)]
    fn run<R: Real<Scalar = f64>>(self, zero: R) {
        let Self { local, side, .. } = self;
        let components = local.field.components();
        let (mut lanes, mut found) = (vec![Jet::constant(zero); components], Vec::new());
        let chunks = self.offsets.chunks(R::LANES).zip(self.out.chunks_mut(R::LANES * components));
        for (points, out) in chunks {
            if self.patches.is_none() {
                local.covering_any(points, side, &mut found);
            }
            let patches = self.patches.unwrap_or(&found);
            local.at_once::<R, D>(points, side, patches, &mut lanes, out);
            if self.patches.is_none() {
                for (&point, out) in points.iter().zip(out.chunks_mut(components)) {
                    if !local.contains(point) {
                        out.fill(Jet::NAN);
                    }
                }
            }
        }
    }
}

/// Entries for a number of derivatives that are not generic: kernels are compiled here, once, and
/// not in every crate that calls them.
macro_rules! entries {
    ($derivatives:literal: $at:ident, $over:ident) => {
        impl LocalField<'_> {
            #[inline(never)]
            fn $at(&self, offsets: &[Vec2], side: Side, out: &mut [Jet<f64>]) {
                if let Some(mesh) = &self.mesh {
                    let functions = &self.functions;
                    return mesh.evaluate_many::<$derivatives>(functions, (offsets, side), out);
                }
                self.on_lanes::<$derivatives>(offsets, side, None, out);
            }

            #[inline(never)]
            fn $over(&self, offsets: &[Vec2], side: Side, patches: &[u32], out: &mut [Jet<f64>]) {
                self.on_lanes::<$derivatives>(offsets, side, Some(patches), out);
            }
        }
    };
}

entries!(0: values_at, values_over);
entries!(1: gradients_at, gradients_over);
entries!(2: hessians_at, hessians_over);

impl LocalField<'_> {
    /// Evaluates at many points, vectorised over lanes: `out` holds the components of the first
    /// point, then those of the second, and so on; points outside the domain give NaN.
    ///
    /// Consecutive points should be close to each other, because the lanes of a vector evaluate the
    /// patches of all its points. The last digit of a value may therefore depend on its neighbours:
    /// the weight of a single patch at a point is left out, or, if a neighbour has more patches,
    /// multiplied and divided.
    ///
    /// # Panics
    /// If `out` is shorter than points × components.
    pub fn evaluate_into<const D: usize>(
        &mut self,
        offsets: &[Vec2],
        side: Side,
        out: &mut [Jet<f64>],
    ) {
        match D {
            0 => self.values_at(offsets, side, out),
            1 => self.gradients_at(offsets, side, out),
            _ => self.hessians_at(offsets, side, out),
        }
    }

    /// Evaluates a field on a mesh at the points of a grid, row by row: as
    /// [`evaluate_into`](Self::evaluate_into), element by element. Leaves `out` alone for a cover.
    ///
    /// # Panics
    /// If `out` is shorter than points × components.
    pub(crate) fn evaluate_grid<const D: usize>(
        &self,
        grid: &PointGrid<'_>,
        side: Side,
        out: &mut [Jet<f64>],
    ) {
        if let Some(mesh) = &self.mesh {
            mesh.evaluate_grid::<D>(&self.functions, (grid, side), out);
        }
    }

    /// Evaluates at many points over a given list of patches, which must contain all that cover any
    /// of the points: like [`evaluate_into`](Self::evaluate_into), without searching for patches or
    /// checking the boundary.
    ///
    /// # Panics
    /// If `out` is shorter than points × components.
    pub fn evaluate_over<const D: usize>(
        &self,
        offsets: &[Vec2],
        side: Side,
        patches: &[u32],
        out: &mut [Jet<f64>],
    ) {
        match D {
            0 => self.values_over(offsets, side, patches, out),
            1 => self.gradients_over(offsets, side, patches, out),
            _ => self.hessians_over(offsets, side, patches, out),
        }
    }

    fn on_lanes<const D: usize>(
        &self,
        offsets: &[Vec2],
        side: Side,
        patches: Option<&[u32]>,
        out: &mut [Jet<f64>],
    ) {
        if self.outer == Some(side) {
            return out.fill(Jet::NAN);
        }
        let local = self;
        f64::dispatch(FieldEvaluation::<D> { local, offsets, side, patches, out });
        if self.is_sided::<D>() {
            let mut values = out.to_vec();
            f64::dispatch(FieldEvaluation::<0> { local, offsets, side, patches, out: &mut values });
            take_values(out, &values);
        }
    }

    /// Evaluates at no more points than there are lanes; `lanes` holds one vector per component.
    #[inline(always)]
    fn at_once<R: Real<Scalar = f64>, const D: usize>(
        &self,
        points: &[Vec2],
        side: Side,
        patches: &[u32],
        lanes: &mut [Jet<R>],
        out: &mut [Jet<f64>],
    ) {
        let components = lanes.len();
        // unused lanes repeat the last point
        let at = |k: usize| points[k.min(points.len() - 1)];
        let like = lanes[0].v;
        let offset = [like.with_lanes(|k| at(k).x), like.with_lanes(|k| at(k).y)];
        self.over_patches::<R, D>(offset, side, patches, lanes);
        for (component, jet) in lanes.iter().enumerate() {
            let places = (0..points.len()).map(|k| (k, k * components + component));
            jet.store::<D>(places, out);
        }
    }
}
