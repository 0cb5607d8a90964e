"""Covers: the boxes of a partition of unity, and its weight function."""

from collections.abc import Sequence
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from . import _core
from ._checks import column, integers, numbers, positive, repeated, rows, scalar
from ._errors import BuildError
from ._text import plural
from ._units import Floats
from ._warnings import warn


#: Weight functions with a name, and where a derivative of them jumps; any other text is a formula of t.
BREAKPOINTS = {"linear": (0.0,), "quadratic": (1 / 3,), "cubic": (0.0, 0.5)}


#: Most patches of a uniform cover: a file of 4 GiB, the most that is read as a whole, holds no more.
MOST_PATCHES = 1 << 25


class Cover:
    """The supports of the patches and their weight.

    The functions are φ_i = W_i / Σ W with W_i(p) = w(|s_x|) w(|s_y|) and s = (p − center_i) / half_i. Supports are any boxes
    that overlap and cover the domain except for its holes. Arrays have a row for each patch, in the order of the arrays that
    are built on the cover.

    Attributes:
        domain: Lower left and upper right corner, shape (2, 2).
        center, half: Centres and half-extents of the supports, shape (n, 2).
        weight: ``linear``, ``quadratic``, ``cubic``, or a formula of t = |s|, positive for 0 ≤ t < 1 and 0 at 1.
        breakpoints: The t in [0, 1) where a derivative of such a formula jumps; values do not depend on them.
        origin, scale: Origin and scale of the polynomials' ξ = (p − origin) / scale; by default `center` and `half`.
        cell: Boxes x_min, y_min, x_max, y_max that tile the domain, one in each support, shape (n, 4), or None. Values do not
            depend on them; without them cells and values of cells are not drawn, and nothing is integrated over them.
        level: Level of each cell in its tree, for reports; None without cells.
        points, point: Scattered points that the cover was made from, and the index of each patch's, -1 for none.

    Example:
        >>> cover = ppum.build.Cover([(0, 0), (2, 1)], center=[(0.5, 0.5), (1.5, 0.5)], half=[(0.7, 0.7), (0.7, 0.7)])
        >>> cover
        <ppum.build.Cover, 2 patches, linear>
        >>> cover.cell is None
        True
    """

    #: What places polynomials, in the words of messages.
    FRAME = "origin and scale of ξ, the weight"

    def __init__(
        self,
        domain: ArrayLike,
        center: ArrayLike,
        half: ArrayLike,
        weight: str = "linear",
        *,
        breakpoints: ArrayLike | None = None,
        origin: ArrayLike | None = None,
        scale: ArrayLike | None = None,
        cell: ArrayLike | None = None,
        level: ArrayLike | None = None,
        points: ArrayLike = (),
        point: ArrayLike = -1,
    ) -> None:
        low, high = self.domain = rows("domain", domain, 2, 2)
        if not (low < high).all():
            corners = self.domain.tolist()
            raise BuildError(f"domain: {corners} has no area; give the lower left and the upper right corner")
        self.center = rows("center", center, 2)
        n = len(self.center)
        if n == 0:
            raise BuildError("center: a cover needs at least one patch")
        self.half = positive("half", rows("half", half, 2, n))
        _look(self.center, self.half, self.domain)
        if not isinstance(weight, str):
            raise BuildError(
                f"weight: is {type(weight).__name__}; give {', '.join(map(repr, BREAKPOINTS))}, or a formula of t as text, "
                "such as '(1 - t)^2'"
            )
        self.weight = weight
        known = BREAKPOINTS.get(weight, ())
        self.breakpoints = numbers("breakpoints", known if breakpoints is None else breakpoints)
        self.origin = self.center if origin is None else rows("origin", origin, 2, n)
        self.scale = self.half if scale is None else positive("scale", rows("scale", scale, 2, n))
        if cell is None and level is not None:
            raise BuildError("level: is that of cells; give the cells too, or leave it out")
        self.cell = None if cell is None else rows("cell", cell, 4, n)
        self.level = None if cell is None else column("level", 0 if level is None else level, n, np.uint8)
        self.points, self.point = rows("points", points, 2), column("point", point, n, np.int64)
        for array in vars(self).values():
            if isinstance(array, np.ndarray):
                array.flags.writeable = False

    @classmethod
    def uniform(cls, domain: ArrayLike, cells: tuple[int, int], overlap: float = 1.3, weight: str = "linear") -> "Cover":
        """Make the cover of a grid of `cells` = (columns, rows) cells.

        Patch j · columns + i is that of column i and row j from the lower left corner. `overlap`, 1.01 to 1.99, enlarges
        cells to supports.

        Example:
            >>> ppum.build.Cover.uniform([(0, 0), (1, 1)], cells=(8, 8), overlap=1.5).half[0].tolist()
            [0.09375, 0.09375]
        """
        (x0, y0), (x1, y1) = rows("domain", domain, 2, 2).tolist()
        if not (x0 < x1 and y0 < y1):
            raise BuildError(f"domain: {(x0, y0)} is not left of and below {(x1, y1)}; give the lower left corner first")
        nx, ny = integers("cells", cells, 2)
        if min(nx, ny) < 1:
            raise BuildError(f"cells: {(nx, ny)} has no cells; give the numbers of columns and rows")
        if nx * ny > MOST_PATCHES:
            raise BuildError(f"cells: {nx} × {ny} cells are {nx * ny:,} patches, of at most {MOST_PATCHES:,}; give fewer")
        x, y = np.linspace(x0, x1, nx + 1), np.linspace(y0, y1, ny + 1)
        low = [np.tile(x[:-1], ny), np.repeat(y[:-1], nx)]
        high = [np.tile(x[1:], ny), np.repeat(y[1:], nx)]
        return cls.from_cells(domain, np.stack(low + high, axis=1), overlap, weight)

    @classmethod
    def from_cells(
        cls, domain: ArrayLike, cell: ArrayLike, overlap: float = 1.3, weight: str = "linear", **others: ArrayLike
    ) -> "Cover":
        """Make the cover of cells that tile the domain: shape (n, 4), rows x_min, y_min, x_max, y_max."""
        if not 1.01 <= scalar("overlap", overlap) <= 1.99:
            raise BuildError(f"overlap: {overlap} is not in 1.01 to 1.99; give the factor from cells to supports")
        boxes = rows("cell", cell, 4)
        size = positive("cell", boxes[:, 2:] - boxes[:, :2])
        center = (boxes[:, :2] + boxes[:, 2:]) / 2
        return cls(domain, center, size * (overlap / 2), weight, cell=boxes, **others)

    @classmethod
    def from_points(
        cls,
        domain: ArrayLike,
        points: ArrayLike,
        overlap: float = 1.3,
        weight: str = "linear",
        cells: tuple[int, int] = (1, 1),
    ) -> "Cover":
        """Make the cover of scattered points, whose indices are in `point`.

        Cells of a grid are halved, as quadtrees, until each holds at most one point and neighbours differ by one level or less.

        Example:
            >>> ppum.build.Cover.from_points([(0, 0), (1, 1)], [(0.1, 0.1), (0.2, 0.1), (0.7, 0.6)])
            <ppum.build.Cover, 10 patches, linear>
        """
        low, high = rows("domain", domain, 2, 2).tolist()
        of = rows("points", points, 2)
        given = [(float(x), float(y)) for x, y in of]
        nx, ny = integers("cells", cells, 2)
        if min(nx, ny) < 1 or nx * ny > MOST_PATCHES:
            raise BuildError(f"cells: {(nx, ny)} is no grid; give the numbers of columns and rows")
        try:
            cell, level, point = _core.scattered((*low, *high), (nx, ny), given)
        except ValueError as error:
            raise BuildError(f"points: {error}") from None
        return cls.from_cells(domain, cell.reshape(-1, 4), overlap, weight, level=level, point=point, points=of)

    def in_space(self, place: str, space: str | Sequence[str]) -> NDArray[np.bool_]:
        """Return True for the patches on which polynomials of a space are tensor products: none."""
        if space not in ("shape", "total"):
            raise BuildError(f"{place}: {space!r} is for meshes; polynomials on covers are of total degree, give 'total'")
        return np.zeros(len(self), bool)

    def arrays(self, fields: Sequence[str] = ()) -> dict[str, Any]:
        """Return the group `partition` of the file format."""
        names = ("center", "half", "origin", "scale", "cell", "level", "points", "point")
        given = {name: getattr(self, name) for name in names}
        return {"weight_breakpoints": self.breakpoints} | {k: v for k, v in given.items() if v is not None}

    def around(self, points: Floats) -> list[int]:
        """Return the patches whose supports hold some of the points."""
        return sorted({k for p in points for k in np.flatnonzero((np.abs(p - self.center) < self.half).all(axis=1)).tolist()})

    def spread(self, random: np.random.Generator, count: int) -> Floats:
        """Return random points of the supports, which are taken in turn."""
        patches = np.resize(random.permutation(len(self))[:count], count)
        result: Floats = self.center[patches] + self.half[patches] * random.uniform(-1, 1, (count, 2))
        return result

    def __len__(self) -> int:
        return len(self.center)

    def __repr__(self) -> str:
        return f"<ppum.build.Cover, {plural(len(self), 'patch', 'patches')}, {self.weight}>"


def _look(center: Floats, half: Floats, domain: Floats) -> None:
    """Check that each support reaches into the domain, and occurs once."""
    for k, first in repeated(np.column_stack([center, half]) + 0.0)[:1]:
        warn(f"center[{k}]: the support is that of patch {first} again; is a patch there twice?")
    outside = np.flatnonzero(((center + half <= domain[0]) | (center - half >= domain[1])).any(axis=1))
    if len(outside):
        k = outside[0]
        raise BuildError(
            f"center[{k}]: the support around {tuple(center[k].tolist())} lies outside of the domain; "
            "leave the patch out, or give the domain that it belongs to"
        )
