"""Values of a field along curves and on grids, as xarray datasets."""

from __future__ import annotations

import json
from collections.abc import Sequence
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from ._errors import require
from ._evaluation import Evaluation
from ._text import math_text, plain
from ._units import Floats, degrees, floats, pair
from ._values import SideName

#: Points of a curve where no number is given, as the program has it.
POINTS = 201


class Sampling(Evaluation):
    """The curves and grids of a `Field`."""

    def line(self, start: ArrayLike, end: ArrayLike, *, num: int = POINTS, quantities: Sequence[str] | None = None) -> Any:
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
        self, center: ArrayLike, radius: float, *, num: int = POINTS, quantities: Sequence[str] | None = None
    ) -> Any:
        """Values on a circle, as an `xarray.Dataset` over the angle `theta` from the x axis, radians.

        Example:
            >>> f.circle((0, 0), 0.6, num=5, quantities=["uy"]).theta.values
            array([-3.14159265, -1.57079633,  0.        ,  1.57079633,  3.14159265])
        """
        along = {"circle": {"center": pair(center), "radius": radius}}
        return self._curve(along, num, quantities)

    def along(self, crack: Any, *, num: int = POINTS, quantities: Sequence[str] | None = None) -> Any:
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
        self, tip: int, radius: float | None = None, *, num: int = POINTS, quantities: Sequence[str] | None = None
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
        num: int = POINTS,
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
        """The table of a curve: the first column is the dimension, x, y and side are coordinates."""
        xarray, names = _xarray(), self._names(quantities)
        heads, rows = self._core.table(json.dumps(plain(along, "curve")), num, names)
        dimension = heads[0][0]
        coords: dict[str, Any] = {}
        variables: dict[str, Any] = {}
        for (name, unit), column in zip(heads, rows.T, strict=True):
            if name == "theta":
                column, unit = np.radians(column), "rad"
            kind = coords if name in (dimension, "x", "y", "side") else variables
            kind[_attribute(name)] = dimension, column, {"units": unit} if unit else {}
        for name in names:
            if (variable := variables.get(_attribute(name))) is not None:
                variable[2].update(self._labels(name))
        return xarray.Dataset(variables, coords, {"title": self.dataset.title})

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
        xarray, names = _xarray(), self._names(quantities)
        (x0, y0), (x1, y1) = self.dataset.domain
        x, y = _axis("x", nx, x, x0, x1), _axis("y", ny, y, y0, y1)
        found: Floats = self.evaluate(x[None, :], y[:, None], names, side=side)
        dims = ("y", "x", "side") if side == "both" else ("y", "x")
        coords = {"x": x, "y": y, **({"side": ["above", "below"]} if side == "both" else {})}
        variables = {_attribute(n): (dims, found[..., k], self._labels(n)) for k, n in enumerate(names)}
        return xarray.Dataset(variables, coords, {"title": self.dataset.title})

    def _names(self, quantities: Sequence[str] | None) -> list[str]:
        if isinstance(quantities, str):
            raise TypeError("quantities: give a list of names")
        if quantities is not None:
            return list(quantities)
        stresses = ["sxx", "syy", "sxy", "von-mises"]
        return [*self.components, *(stresses if self.dataset.equation == "elasticity" else [])]

    def _labels(self, name: str) -> dict[str, str]:
        symbol, unit = self._core.words(name)
        words = {"long_name": math_text(symbol), "units": unit}
        return {key: value for key, value in words.items() if value}


def _xarray() -> Any:
    return require("xarray", "xarray", "values along curves and on grids")


def _attribute(name: str) -> str:
    """The name of a variable, so that it can be an attribute."""
    dashed = name.replace("-", "_")
    return dashed if dashed.isidentifier() else name


def _axis(name: str, count: int | None, given: ArrayLike | None, low: float, high: float) -> Floats:
    if (count is None) == (given is None):
        raise ValueError(f"give n{name} or {name}, one of them")
    if count is not None:
        return np.linspace(low, high, count)
    axis = floats(given)  # type: ignore[arg-type]
    if axis.ndim != 1:
        raise ValueError(f"{name}: coordinates of a grid are a list of numbers")
    return axis
