//! Where numbers lie in memory: slopes at a vector of points, functions in the basis.

use ppum::function::GROUP;
use ppum::real::Real;

use super::collapse::{ROWS, Slopes, numbers};

#[inline(always)]
pub(super) fn load_slopes<R: Real, const D: usize>(from: &[R::Scalar], like: R) -> Slopes<R> {
    let mut slopes = Slopes::constant(like.load(from));
    if D >= 1 {
        slopes.x = like.load(&from[R::LANES..]);
        slopes.y = like.load(&from[2 * R::LANES..]);
    }
    slopes
}

#[inline(always)]
pub(super) fn store_slopes<R: Real, const D: usize>(slopes: Slopes<R>, to: &mut [R::Scalar]) {
    let to = &mut to[..size::<R, D>()];
    slopes.v.store(to);
    if D >= 1 {
        slopes.x.store(&mut to[R::LANES..]);
        slopes.y.store(&mut to[2 * R::LANES..]);
    }
}

/// Numbers a function has at a vector of points.
#[inline(always)]
pub(super) const fn size<R: Real, const D: usize>() -> usize {
    numbers::<D>() * R::LANES
}

/// Numbers a group has at a vector of points.
#[inline(always)]
pub(super) const fn basis_stride<R: Real, const D: usize>() -> usize {
    GROUP * size::<R, D>()
}

/// Numbers a group has in the basis.
#[inline(always)]
pub(super) const fn basis_len<R: Real, const D: usize>() -> usize {
    ROWS * basis_stride::<R, D>()
}

/// Length of the weight's part of a table.
#[inline(always)]
pub(super) const fn weight_len<R: Real, const D: usize>() -> usize {
    (1 + D) * R::LANES
}
