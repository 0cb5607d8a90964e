"""Values of a field along curves and on grids."""

from __future__ import annotations

import json
from collections.abc import Sequence
from typing import TYPE_CHECKING, Any, cast

from numpy.typing import ArrayLike

from .fieldcore import FieldCore
from .toml import plain
from .values import SideName, degrees, pair

if TYPE_CHECKING:
    from .field import Field

__all__ = ["Sampling"]


class Sampling(FieldCore):
    """The curves and grids of a `Field`."""

    def line(
        self, start: ArrayLike, end: ArrayLike, *, num: int = 201, quantities: Sequence[str] | None = None
    ) -> Any:
        """Values along a line, as an `xarray.Dataset` over the distance `s` from its start.

        Coordinates are `x`, `y` and `side`: where the line meets a crack there are two rows, above (1) and below (-1).

        Example:
            >>> line = f.line((-1, 0), (1, 0), num=5, quantities=["uy"])
            >>> line.side.values
            array([ 0.,  0.,  1., -1.,  0.,  0.])
        """
        along = {"line": {"from": pair(start), "to": pair(end)}}
        return self._curve(along, num, quantities)

    def circle(
        self, center: ArrayLike, radius: float, *, num: int = 201, quantities: Sequence[str] | None = None
    ) -> Any:
        """Values on a circle, as an `xarray.Dataset` over the angle `theta` from the x axis, radians.

        Example:
            >>> f.circle((0, 0), 0.6, num=5, quantities=["uy"]).theta.values
            array([-3.14159265, -1.57079633,  0.        ,  1.57079633,  3.14159265])
        """
        along = {"circle": {"center": pair(center), "radius": radius}}
        return self._curve(along, num, quantities)

    def along(self, crack: Any, *, num: int = 201, quantities: Sequence[str] | None = None) -> Any:
        """Values on both sides of a crack, as an `xarray.Dataset` over the arc length `s`: of each quantity
        `…_above` and `…_below`, and of a displacement the jumps `jump_ux` and `jump_uy`, `opening` and `sliding`.

        Args:
            crack: A `Crack` or its number.

        Example:
            >>> sorted(f.along(0, quantities=["ux", "uy"]))
            ['jump_ux', 'jump_uy', 'opening', 'sliding', 'ux_above', 'ux_below', 'uy_above', 'uy_below']
        """
        return self._curve({"crack": {"index": getattr(crack, "index", crack)}}, num, quantities)

    def around(
        self, tip: int, radius: float | None = None, *, num: int = 201, quantities: Sequence[str] | None = None
    ) -> Any:
        """Values on a circle around a tip, as an `xarray.Dataset` over the angle `theta` from the crack's extension,
        radians; by default a hundredth of the crack's length away.

        Example:
            >>> f.around(1, num=5, quantities=["syy"]).sizes["theta"]
            5
        """
        return self._curve({"around": {"tip": tip, "radius": radius}}, num, quantities)

    def ray(
        self,
        tip: int,
        angle: float = 0.0,
        length: float | None = None,
        *,
        num: int = 201,
        quantities: Sequence[str] | None = None,
    ) -> Any:
        """Values on a ray from a tip, as an `xarray.Dataset` over the distance `r` in steps of its logarithm.

        Args:
            tip: The number of a tip.
            angle: That from the crack's extension, radians, as `Tip.growth_angle`.
            length: The largest distance; by default a tenth of the crack's length.

        Example:
            >>> ahead = f.ray(1, angle=ds.tips[1].growth_angle, quantities=["syy"])
            >>> bool(ahead.syy[0] > ahead.syy[-1] > 0)
            True
        """
        along = {"ray": {"tip": tip, "angle": degrees(angle), "far": length}}
        return self._curve(along, num, quantities)

    def _curve(self, along: Any, num: int, quantities: Sequence[str] | None) -> Any:
        from .xarrays import curve

        return curve(self, json.dumps(plain(along, "curve")), num, self._names(quantities))

    def grid(
        self,
        nx: int | None = None,
        ny: int | None = None,
        *,
        x: ArrayLike | None = None,
        y: ArrayLike | None = None,
        quantities: Sequence[str] | None = None,
        side: SideName = "above",
    ) -> Any:
        """Values on a grid, as an `xarray.Dataset` over y and x, both rising.

        Args:
            nx, ny: Numbers of columns and rows, from border to border of the domain's box.
            x, y: Or the coordinates themselves.
            quantities: By default the components, for elasticity also the stresses.
            side: As in `at`; ``both`` adds a dimension `side`.

        Example:
            >>> f.grid(3, 5, quantities=["s1"]).s1.dims
            ('y', 'x')
        """
        from .xarrays import grid

        return grid(cast("Field", self), (nx, x), (ny, y), self._names(quantities), side)

    def _names(self, quantities: Sequence[str] | None) -> list[str]:
        if isinstance(quantities, str):
            raise TypeError("quantities: give a list of names")
        if quantities is not None:
            return list(quantities)
        stresses = ["sxx", "syy", "sxy", "von-mises"]
        return [*self.components, *(stresses if self.dataset.equation == "elasticity" else [])]
