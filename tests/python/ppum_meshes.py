"""Meshes of datasets: which element holds a point, and where in it. Written from FORMAT.md alone.

    mesh = Mesh(group, fields, Double)
    mesh.owner((0.3, 0.1), side=1)          the patch and the jets of ξ and η there, or None outside
"""

import numpy as np
from ppum_formulas import Jet

TRIANGLE, SQUARE = 0, 1
#: How far outside of all elements a point may lie, in reference coordinates, and still be of the nearest.
TOLERANCE = 1e-11


def exponents(degree, space=0):
    """Powers of ξ and η in the order of coefficients: by total degree, or of a tensor product."""
    if space:
        return [(i, j) for j in range(degree + 1) for i in range(degree + 1)]
    return [(d - k, k) for d in range(degree + 1) for k in range(d + 1)]


def polynomials(coefficients, degree, space, xi, eta, real):
    """A jet for each row of coefficients."""
    one = Jet(real(1))
    powers = [(one, one)]
    for _ in range(degree):
        powers.append((powers[-1][0] * xi, powers[-1][1] * eta))
    sums = [Jet(real(0))] * len(coefficients)
    for (i, j), column in zip(exponents(degree, space), np.transpose(coefficients), strict=True):
        product = powers[i][0] * powers[j][1]
        sums = [s + product * real(c) for s, c in zip(sums, column)]
    return sums


def block(field, b, xi, eta, real):
    """The polynomial of a block, a jet for each component."""
    degree = int(field["block_degree"][b])
    space = int(field["block_space"][b]) if "block_space" in field else 0
    start = int(field["block_offset"][b])
    columns = field["coefficients"][:, start : start + len(exponents(degree, space))]
    return polynomials(columns, degree, space, xi, eta, real)


class Mesh:
    """The partition `mesh` of a step. `fields` are the arrays of the step's fields, for those that clip."""

    def __init__(self, group, fields, numbers):
        self.arrays, self.fields, self.real = {k: v[()] for k, v in group.items()}, fields, numbers.real
        rows = [self.coefficients(i) for i in range(len(self.arrays["shape"]))]
        # |ξ|, |η| ≤ 1 in both shapes, and a little more for points on a border
        self.reach = 1.001 * np.array([np.abs(c).sum(axis=1) for c in rows])

    def degree(self, i):
        return int(self.arrays["map_degree"][i]), int(self.arrays["map_space"][i])

    def coefficients(self, i):
        """Those of patch i's map, the constant 0 first."""
        count = len(exponents(*self.degree(i))) - 1
        start = int(self.arrays["map_offset"][i])
        return np.hstack([np.zeros((2, 1)), self.arrays["map"][:, start : start + count]])

    def owner(self, p, side):
        """The first patch whose closed shape holds p, or the one that p misses least, and jets of ξ and η."""
        at, best = np.array([float(c) for c in p]), None
        near = (np.abs(at - self.arrays["origin"]) <= self.reach).all(axis=1)
        for i in np.flatnonzero(near):
            place = self.inverse(i, p)
            if place is None or not self.is_kept(i, place, side):
                continue
            margin = self.margin(i, place)
            if margin >= 0:
                return i, place
            if margin >= -TOLERANCE and (best is None or margin > best[0]):
                best = margin, (i, place)
        return best and best[1]

    def margin(self, i, place):
        """How far inside the shape a place lies; negative outside."""
        xi, eta = (c.v for c in place)
        if self.arrays["shape"][i] == SQUARE:
            return 1 - max(abs(xi), abs(eta))
        half = self.real(0.5)
        return min(xi + half, eta + half, half - xi - eta)

    def is_kept(self, i, place, side):
        """True if the clips of patch i keep the place."""
        if "clip_offsets" not in self.arrays:
            return True
        for k in range(*map(int, self.arrays["clip_offsets"][i : i + 2])):
            level = self.level(int(self.arrays["clip_field"][k]), i, place).v
            upper = level > 0 or (level == 0 and side > 0)
            if upper != bool(self.arrays["clip_side"][k]):
                return False
        return True

    def level(self, field, i, place):
        """A field of one component, which is a polynomial on patch i."""
        field = self.fields[field]
        blocks = range(*map(int, field["patch_blocks"][i : i + 2]))
        return sum((block(field, b, *place, self.real)[0] for b in blocks), Jet(self.real(0)))

    def inverse(self, i, p):
        """ξ and η with o + M(ξ, η) = p as jets in the world, or None where Newton's method does not arrive."""
        target = [p[k] - self.real(o) for k, o in enumerate(self.arrays["origin"][i])]
        places = [self.newton(i, target, start) for start in self.starts(i, target)]
        places = [place for place in places if place is not None]
        return max(places, key=lambda place: self.margin(i, place), default=None)

    def starts(self, i, target):
        """Places of the shape whose images are the nearest."""
        degree, space = self.degree(i)
        if degree == 1 and not space:
            return [(0.0, 0.0)]
        side = np.linspace(-1, 1, 9)
        grid = np.stack(np.meshgrid(side, side), -1).reshape(-1, 2)
        powers = np.stack([grid[:, 0] ** a * grid[:, 1] ** b for a, b in exponents(degree, space)])
        images = (self.coefficients(i) @ powers).T
        distances = np.hypot(*(images - [float(t) for t in target]).T)
        return grid[np.argsort(distances)[:4]]

    def newton(self, i, target, start):
        """Newton's method until its steps no longer shrink."""
        c, degree = self.coefficients(i), self.degree(i)
        (a, b), last, real = map(self.real, map(float, start)), 2, self.real
        for _ in range(60):
            x, y = polynomials(c, *degree, Jet(a, {"a": real(1)}), Jet(b, {"b": real(1)}), real)
            xa, xb, ya, yb = (m.slopes.get(k, real(0)) for m in (x, y) for k in "ab")
            det, dx, dy = xa * yb - xb * ya, x.v - target[0], y.v - target[1]
            if det == 0:
                return None
            step = (yb * dx - xb * dy) / det, (xa * dy - ya * dx) / det
            size = max(map(abs, step))
            if size >= last and last < 1e-9:
                break
            # a step is no longer than the shape
            short = 1 if size <= 1 else 1 / size
            a, b, last = a - short * step[0], b - short * step[1], size
        if not max(abs(dx), abs(dy)) <= 1e-9 * np.abs(c).max() or not max(abs(a), abs(b)) < 2:
            return None
        return Jet(a, {"x": yb / det, "y": -xb / det}), Jet(b, {"x": -ya / det, "y": xa / det})
