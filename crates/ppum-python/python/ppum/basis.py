"""Coefficients of other bases as those of the file format: monomials 1, ξ, η, ξ², ξη, η², … of the patch's coordinates.

Example:
    >>> q2 = ppum.basis.legendre(2, order="total")
    >>> c = np.zeros((1, 6)); c[0, 3] = 2.0      # 2 P_2(ξ) = 3 ξ² - 1
    >>> q2.convert(c).tolist()
    [[-1.0, 0.0, 0.0, 3.0, 0.0, 0.0]]
"""

from collections.abc import Callable, Sequence
from fractions import Fraction
from math import comb, prod
from numbers import Integral
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from ._blocks import DEGREES, MAX_DEGREE, exponents
from ._checks import check_shape, check_type, numbers, rows, short
from ._cover import Cover
from ._errors import BuildError
from ._units import Floats
from ._warnings import warn

__all__ = ["Basis", "bernstein", "chebyshev", "fit", "lagrange", "legendre", "monomials", "reframe"]

#: The polynomial ξ; all that is computed of it is exact.
X: Any = np.polynomial.Polynomial(np.array([Fraction(0), Fraction(1)], object))

#: A conversion that loses more than this is warned of.
LARGE = 1e6


class Basis:
    """Products p_i(ξ) q_j(η), in the order of `indices`, as polynomials of total degree.

    Attributes:
        indices: Pairs (i, j), in the order of the coefficients.
        degree: Total degree of the products.
        matrix: Monomials' coefficients from those of the basis, shape ((d + 1)(d + 2)/2, m); exact except for rounding.
        condition: Condition number of the matrix.
    """

    def __init__(self, x: Sequence[Any], y: Sequence[Any], indices: Sequence[tuple[int, int]]) -> None:
        self.indices = tuple((int(i), int(j)) for i, j in indices)
        for k, (i, j) in enumerate(self.indices):
            if not (0 <= i < len(x) and 0 <= j < len(y)):
                raise BuildError(f"order[{k}]: {(i, j)} is no product of {len(x)} × {len(y)} polynomials")
        products = [(x[i], y[j]) for i, j in self.indices]
        self.degree = max(p.trim().degree() + q.trim().degree() for p, q in products)
        if self.degree > MAX_DEGREE:
            raise BuildError(
                f"the products have the total degree {self.degree}, a block at most {MAX_DEGREE}: "
                "of tensor products of degree p that is 2p, so p ≤ 4"
            )
        exact = [[_at(p, a) * _at(q, b) for p, q in products] for a, b in exponents(self.degree)]
        self._extended = np.array(
            [[np.longdouble(v.numerator) / np.longdouble(v.denominator) for v in row] for row in exact]
        )
        self.matrix: Floats = self._extended.astype(float)
        self.condition = float(np.linalg.cond(self.matrix))

    def convert(self, coefficients: ArrayLike, axis: int = 1) -> Floats:
        """Return coefficients of monomials, on `axis` in place of those of the basis. Warns of a condition number above 1e6."""
        given, count = numbers("coefficients", coefficients), len(self.indices)
        if not -given.ndim <= axis < given.ndim or given.shape[axis] != count:
            one = "; give axis=0 for those of one patch" if given.shape[:1] == (count,) else ""
            raise BuildError(f"coefficients: has the shape {given.shape}, expected {count} on axis {axis}: {self}{one}")
        if self.condition > LARGE:
            digits = np.log10(self.condition)
            warn(f"the condition number of the conversion is {self.condition:.1e}: up to {digits:.0f} digits are lost")
        product = np.tensordot(np.moveaxis(given, axis, -1).astype(np.longdouble), self._extended, (-1, 1))
        return np.ascontiguousarray(np.moveaxis(product, -1, axis), float)

    def __repr__(self) -> str:
        return f"<ppum.basis.Basis of {len(self.indices)} products, total degree {self.degree}>"


def legendre(degree: int, order: Any = "total", interval: tuple[float, float] = (-1, 1)) -> Basis:
    """Return the Legendre polynomials, P_k(1) = 1.

    Args:
        degree: Highest degree in each variable.
        order: Order of the products: ``total`` (by degree, powers of ξ descending, as in files), ``total-y`` (powers of η
            descending), ``tensor`` (all i, j ≤ degree, i first), ``tensor-y`` (j first), or the pairs (i, j) themselves.
        interval: The local coordinate of the basis where ξ is -1 and 1: (0, 1) for shifted polynomials.
    """
    return _basis(_recurrent(degree, lambda k: (Fraction(2 * k + 1, k + 1), Fraction(k, k + 1))), order, interval)


def chebyshev(degree: int, order: Any = "total", interval: tuple[float, float] = (-1, 1)) -> Basis:
    """Return the Chebyshev polynomials of the first kind; arguments as of `legendre`."""
    return _basis(_recurrent(degree, lambda k: (Fraction(2 if k else 1), Fraction(1))), order, interval)


def bernstein(degree: int, order: Any = "tensor", interval: tuple[float, float] = (0, 1)) -> Basis:
    """Return the Bernstein polynomials C(p, k) t^k (1 − t)^(p − k), products of two; arguments as of `legendre`.

    Example:
        >>> ppum.basis.bernstein(1).convert([[1.0, 1.0, 1.0, 1.0]]).tolist()
        [[1.0, 0.0, 0.0, 0.0, 0.0, 0.0]]
    """
    all_ = [comb(degree, k) * X**k * (1 - X) ** (degree - k) for k in range(_bounded(degree) + 1)]
    return _basis(all_, order, interval)


def lagrange(nodes: ArrayLike, order: Any = "tensor", interval: tuple[float, float] = (-1, 1)) -> Basis:
    """Return the Lagrange polynomials of nodes, the same in both directions: values at the nodes are the coefficients."""
    at = [Fraction(v) for v in numbers("nodes", nodes).reshape(-1).tolist()]
    if len(set(at)) < len(at):
        raise BuildError("nodes: two are equal; leave one out")
    _bounded(len(at) - 1)
    all_ = [prod(((X - b) / (a - b) for b in at if b != a), start=X**0) for a in at]
    return _basis(all_, order, interval)


def monomials(degree: int, order: Any = "total-y", interval: tuple[float, float] = (-1, 1)) -> Basis:
    """Return the monomials in another order or of another coordinate; arguments as of `legendre`."""
    return _basis([X**k for k in range(_bounded(degree) + 1)], order, interval)


def reframe(
    coefficients: ArrayLike, origin: ArrayLike, scale: ArrayLike, new_origin: ArrayLike, new_scale: ArrayLike
) -> Floats:
    """Convert monomials' coefficients (n, m) or (n, m, c) of ξ = (p − origin)/scale to those of (p − new_origin)/new_scale.

    Origins and scales have the shape (n, 2), or (2,) for all patches.

    Example:
        >>> ppum.basis.reframe([[0.0, 1.0, 0.0]], (0, 0), (1, 1), (0.5, 0.5), (2, 2)).tolist()
        [[0.5, 2.0, 0.0]]
    """
    given = numbers("coefficients", coefficients)
    is_fit = given.ndim in (2, 3) and given.shape[1] in DEGREES
    check_shape("coefficients", given, is_fit, "(n, m) or (n, m, c), m = (d + 1)(d + 2)/2")
    old, size, new, new_size = (
        _points(name, values, len(given)).astype(np.longdouble)
        for name, values in zip(("origin", "scale", "new_origin", "new_scale"), (origin, scale, new_origin, new_scale))
    )
    shift, factor = (new - old) / size, new_size / size
    of = exponents(DEGREES[given.shape[1]])
    matrix = np.zeros((len(given), len(of), len(of)), np.longdouble)
    for k, (a, b) in enumerate(of):
        for j, (i, l) in enumerate(of):
            if i <= a and l <= b:
                x = comb(a, i) * shift[:, 0] ** (a - i) * factor[:, 0] ** i
                matrix[:, j, k] = x * comb(b, l) * shift[:, 1] ** (b - l) * factor[:, 1] ** l
    return np.asarray(np.einsum("njk,nk...->nj...", matrix, given.astype(np.longdouble)), float)


def _points(name: str, values: ArrayLike, count: int) -> Floats:
    array = numbers(name, values)
    check_shape(name, array, array.shape in ((2,), (count, 2)), f"({count}, 2), or (2,) for all patches")
    return np.broadcast_to(array, (count, 2))


def fit(
    cover: Cover, degree: int, function: Callable[[int, Floats, Floats], ArrayLike], tolerance: float = 1e-10
) -> Floats:
    """Fit local polynomials that can be evaluated: coefficients (n, m) or (n, m, c).

    Args:
        cover: The patches.
        degree: Total degree of the polynomials, at most 8.
        function: Called with a patch and arrays x and y of points in its frame; gives values of shape (k,) or (k, c).
        tolerance: Largest coefficient beyond the degree, relative to the largest one, of Chebyshev polynomials.

    Raises:
        BuildError: The function of a patch is no polynomial of this degree.

    Example:
        >>> cover = ppum.build.Cover.uniform([(0, 0), (1, 1)], cells=(2, 2))
        >>> ppum.basis.fit(cover, 2, lambda patch, x, y: x * y).shape
        (4, 6)
    """
    check_type("cover", cover, isinstance(cover, Cover), "a ppum.build.Cover")
    count = _bounded(degree) + 3
    nodes = np.cos(np.pi * (np.arange(count) + 0.5) / count)
    xi, eta = (a.reshape(-1) for a in np.meshgrid(nodes, nodes))
    values = [_sampled(cover, k, function, xi, eta) for k in range(len(cover))]
    given = np.array(values).reshape(len(cover), count * count, -1)
    to = np.polynomial.chebyshev.chebvander(nodes, count - 1).T * np.where(np.arange(count), 2, 1)[:, None] / count
    found = np.einsum("ia,jb,nbac->nijc", to, to, given.reshape(len(cover), count, count, -1))
    beyond = np.add.outer(np.arange(count), np.arange(count)) > degree
    missed = np.abs(found[:, beyond]).max(axis=(1, 2))
    wrong = np.flatnonzero(missed > tolerance * np.abs(found).max(axis=(1, 2, 3)))
    if len(wrong):
        k = wrong[0]
        raise BuildError(
            f"function: on patch {k} it is no polynomial of total degree {degree}: its coefficient of a higher one is "
            f"{missed[k]:.1e}; raise the degree, or take out what is a function of its own"
        )
    basis = chebyshev(degree)
    i, j = np.array(basis.indices).T
    result = basis.convert(found[:, i, j])
    return result[:, :, 0] if np.ndim(values[0]) == 1 else result


def _sampled(
    cover: Cover, patch: int, function: Callable[[int, Floats, Floats], ArrayLike], xi: Floats, eta: Floats
) -> Floats:
    (ox, oy), (sx, sy) = cover.origin[patch], cover.scale[patch]
    values = numbers(f"function on patch {patch}", function(patch, ox + sx * xi, oy + sy * eta))
    if values.ndim not in (1, 2) or len(values) != len(xi):
        raise BuildError(f"function: gives the shape {values.shape} on patch {patch}, expected ({len(xi)},) or ({len(xi)}, c)")
    return values


def _bounded(degree: int) -> int:
    """Return the degree, checked before exact arithmetic makes long work of it."""
    if not isinstance(degree, Integral) or not 0 <= degree <= MAX_DEGREE:
        raise BuildError(f"degree: is {short(degree)}, expected 0 to {MAX_DEGREE}")
    return int(degree)


def _recurrent(degree: int, factors: Callable[[int], tuple[Fraction, Fraction]]) -> list[Any]:
    """Return polynomials with p_{k+1} = a ξ p_k − b p_{k−1}."""
    all_ = [X**0]
    for k in range(_bounded(degree)):
        a, b = factors(k)
        all_.append(a * X * all_[-1] - (b * all_[-2] if k else 0))
    return all_


def _basis(polynomials: Sequence[Any], order: Any, interval: tuple[float, float]) -> Basis:
    ends = numbers("interval", interval)
    if ends.shape != (2,) or ends[0] == ends[1]:
        raise BuildError(f"interval: {short(interval)} has no length; give two ends, such as (-1, 1)")
    low, high = map(Fraction, ends.tolist())
    line = (low + high) / 2 + (high - low) / 2 * X
    moved = [sum((v * line**k for k, v in enumerate(p.coef)), start=0 * X) for p in polynomials]
    return Basis(moved, moved, _order(order, len(polynomials) - 1))


def _order(order: Any, degree: int) -> Sequence[tuple[int, int]]:
    total, tensor = exponents(degree), exponents(degree, tensor=True)
    known = {"total": total, "tensor": tensor}
    known |= {f"{name}-y": [(j, i) for i, j in pairs] for name, pairs in known.items()}
    if not isinstance(order, str):
        return [(int(i), int(j)) for i, j in rows("order", order, 2)]
    if order not in known:
        raise BuildError(f"order: {short(order)} is none of {', '.join(known)}, and no pairs (i, j)")
    return known[order]


def _at(p: Any, k: int) -> Any:
    return p.coef[k] if k < len(p.coef) else 0
