"""Polynomials on reference shapes by their values."""

from collections.abc import Sequence

import numpy as np
from numpy.typing import ArrayLike

from ._errors import BuildError
from ._units import Floats

Powers = Sequence[tuple[int, int]]

#: Reference shapes: the triangle (−½, −½), (1, −½), (−½, 1) and the square [−1, 1]².
TRIANGLE, SQUARE = 0, 1
CORNERS = {
    TRIANGLE: np.array([(-0.5, -0.5), (1.0, -0.5), (-0.5, 1.0)]),
    SQUARE: np.array([(-1.0, -1.0), (1.0, -1.0), (1.0, 1.0), (-1.0, 1.0)]),
}


def vandermonde(places: Floats, powers: Powers) -> Floats:
    """Return products ξ^i η^j at places (k, 2): shape (k, m)."""
    i, j = np.array(powers).T
    result: Floats = places[:, :1] ** i * places[:, 1:] ** j
    return result


def lattice(shape: int, order: int) -> Floats:
    """Return equally spaced places, row by row from below, in a row from the left."""
    return _rows(shape, np.linspace(0, 1, order + 1))


def nodes(shape: int, order: int) -> Floats:
    """Return places that fix a polynomial of a degree accurately: Chebyshev's, one for order 0."""
    if order == 0:
        return np.zeros((1, 2))
    return _rows(shape, (1 - np.cos(np.pi * np.arange(order + 1) / order)) / 2)


def _rows(shape: int, at: Floats) -> Floats:
    """Return products of places in [0, 1], for triangles blended towards the third edge."""
    order = len(at) - 1
    if shape == SQUARE:
        return np.array([(2 * x - 1, 2 * y - 1) for y in at for x in at])
    places = []
    for j in range(order + 1):
        for i in range(order + 1 - j):
            x, y, z = at[i], at[j], at[order - i - j]
            missing = (1 - x - y - z) / 3
            places.append((1.5 * (x + missing) - 0.5, 1.5 * (y + missing) - 0.5))
    return np.array(places)


def interpolated(values: ArrayLike, places: Floats, powers: Powers) -> Floats:
    """Return coefficients (n, m, c) of polynomials by values (n, k, c) at k places, those of least squares if m < k."""
    basis = vandermonde(places, powers)
    if len(basis) < len(powers) or np.linalg.matrix_rank(basis) < len(powers):
        raise BuildError(f"at: {len(places)} places do not fix a polynomial of {len(powers)} coefficients")
    inverse = np.linalg.pinv(basis)
    # once more in extended precision: the inverse has all digits then
    exact, wide = basis.astype(np.longdouble), inverse.astype(np.longdouble)
    for _ in range(2):
        wide = wide + inverse @ (np.eye(len(basis)) - exact @ wide)
    # zeros are zeros
    wide[np.abs(wide) < 1e-18 * np.abs(wide).max()] = 0
    return np.asarray(np.einsum("mk,nkc->nmc", wide, np.asarray(values, np.longdouble)), float)


def random_places(random: np.random.Generator, shape: int, count: int) -> Floats:
    at = random.uniform(-0.999, 0.999, (count, 2))
    return at if shape == SQUARE else 0.75 * np.where(at.sum(axis=1, keepdims=True) > 0, -at, at) + 0.25
