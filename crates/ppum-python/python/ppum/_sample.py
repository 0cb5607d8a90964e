"""Values of a field along curves and on grids, as xarray datasets."""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Annotated, Any, TypedDict, Unpack

import numpy as np
from numpy.typing import ArrayLike

from . import _core
from ._errors import RenderError, require
from ._options import Option, takes
from ._text import math_text, plain
from ._units import Floats, degrees, floats, pair
from ._values import SideName
from ._views import PixelOptions

if TYPE_CHECKING:
    from ._field import Field

#: A curve as the libraries read it.
Curve = dict[str, dict[str, Any]]

STRESSES = ("sxx", "syy", "sxy", "von-mises")


@dataclass(frozen=True)
class Extremum:
    """An extreme value.

    Attributes:
        value: The value, to about 1e-6 of its size; infinite at a singular point.
        xy: Position.
        offset: Position relative to the view's centre, in full precision.
        on: ``inside``, ``border``, ``face``, ``rim``, ``interface``, ``singular``, ``pixel``, or ``everywhere`` for one value.
        side: Side of a face, ``above`` or ``below``.
    """

    value: float
    xy: tuple[float, float]
    offset: tuple[float, float]
    on: str
    side: str | None


class ValueOptions(TypedDict, total=False):
    """The quantities that are evaluated."""

    quantities: Annotated[
        Sequence[str] | None, Option(None, "names or formulas; by default the components, for elasticity also the stresses")
    ]


class PointOptions(TypedDict, total=False):
    """The number of points."""

    num: Annotated[int, Option(201, "number of points")]


class CurveOptions(ValueOptions, PointOptions, total=False):
    """The quantities and the points of a curve."""


class GridOptions(ValueOptions, total=False):
    """The quantities and the points of a grid."""

    x: Annotated[ArrayLike | None, Option(None, "coordinates of the columns, in place of their number")]
    y: Annotated[ArrayLike | None, Option(None, "coordinates of the rows, in place of their number")]
    side: Annotated[SideName, Option("above", "as in `Field.at`; ``both`` adds a dimension `side`")]


@dataclass(frozen=True)
class Sample:
    """Values of a field along curves and on grids, each an `xarray.Dataset`, and its extreme values.

    The coordinates along a curve are `x`, `y` and `side`: where it meets a crack there are two rows, above (1) and below (-1).
    """

    _field: "Field"

    @takes(CurveOptions)
    def line(self, start: ArrayLike, end: ArrayLike, **options: Unpack[CurveOptions]) -> Any:
        """Evaluate along a line, over the distance `s` from its start.

        Example:
            >>> line = f.sample.line((-1, 0), (1, 0), num=5, quantities=["uy"])
            >>> line.side.values
            array([ 0.,  0.,  1., -1.,  0.,  0.])
        """
        return self._curve(line(start, end), options)

    @takes(CurveOptions)
    def circle(self, center: ArrayLike, radius: float, **options: Unpack[CurveOptions]) -> Any:
        """Evaluate on a circle, over the angle `theta` from the x axis, radians.

        Example:
            >>> f.sample.circle((0, 0), 0.6, num=5, quantities=["uy"]).theta.values
            array([-3.14159265, -1.57079633,  0.        ,  1.57079633,  3.14159265])
        """
        return self._curve(circle(center, radius), options)

    @takes(CurveOptions)
    def crack(self, crack: Any = 0, **options: Unpack[CurveOptions]) -> Any:
        """Evaluate on both sides of a crack, a `Crack` or its number, over the arc length `s`.

        Each quantity is there as `…_above` and `…_below`, a displacement also as `jump_ux`, `jump_uy`, `opening` and `sliding`.

        Example:
            >>> sorted(f.sample.crack(0, quantities=["ux", "uy"]))
            ['jump_ux', 'jump_uy', 'opening', 'sliding', 'ux_above', 'ux_below', 'uy_above', 'uy_below']
        """
        return self._curve(along_crack(crack), options)

    @takes(CurveOptions)
    def around(self, tip: int, radius: float | None = None, **options: Unpack[CurveOptions]) -> Any:
        """Evaluate on a circle around a tip, over the angle `theta` from the crack's extension, radians.

        The default radius is a hundredth of the crack's length.

        Example:
            >>> f.sample.around(1, num=5, quantities=["syy"]).sizes["theta"]
            5
        """
        return self._curve(around(tip, radius), options)

    @takes(CurveOptions)
    def ray(self, tip: int, angle: float = 0.0, length: float | None = None, **options: Unpack[CurveOptions]) -> Any:
        """Evaluate on a ray from a tip, over the distance `r` in steps of its logarithm.

        Args:
            angle: Angle from the crack's extension, radians, as `Tip.growth_angle`.
            length: The largest distance; by default a tenth of the crack's length.

        Example:
            >>> ahead = f.sample.ray(1, angle=ds.tips[1].growth_angle, quantities=["syy"])
            >>> bool(ahead.syy[0] > ahead.syy[-1] > 0)
            True
        """
        return self._curve(ray(tip, angle, length), options)

    def _curve(self, along: Any, options: CurveOptions) -> Any:
        """Return the table of a curve: the first column is the dimension, x, y and side are coordinates."""
        xarray, names = _xarray(), self._names(options["quantities"])
        heads, rows = self._field._core.table(along, options["num"], names)
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
        return xarray.Dataset(variables, coords, {"title": self._field.dataset.title})

    @takes(GridOptions)
    def grid(self, nx: int | None = None, ny: int | None = None, **options: Unpack[GridOptions]) -> Any:
        """Evaluate on a grid, over rising y and x: `nx` columns and `ny` rows from border to border of the domain's box.

        Example:
            >>> f.sample.grid(3, 5, quantities=["s1"]).s1.dims
            ('y', 'x')
        """
        xarray, names, side = _xarray(), self._names(options["quantities"]), options["side"]
        (x0, y0), (x1, y1) = self._field.dataset.domain
        x, y = _axis("x", nx, options["x"], x0, x1), _axis("y", ny, options["y"], y0, y1)
        found: Floats = self._field.evaluate(x[None, :], y[:, None], names, side=side)
        dims = ("y", "x", "side") if side == "both" else ("y", "x")
        coords = {"x": x, "y": y, **({"side": ["above", "below"]} if side == "both" else {})}
        variables = {_attribute(n): (dims, found[..., k], self._labels(n)) for k, n in enumerate(names)}
        return xarray.Dataset(variables, coords, {"title": self._field.dataset.title})

    @takes(PixelOptions)
    def extrema(self, quantity: str | None = None, **options: Unpack[PixelOptions]) -> tuple[Extremum, Extremum]:
        """Find the smallest and the largest value in a view, also between its pixels; they are infinite at tips.

        Example:
            >>> low, high = f.sample.extrema("uy")
            >>> low.value < 0 < high.value
            True
        """
        name, view = self._field._asked(quantity, options)
        found = _core.extrema(self._field._core, name, view)
        if found is None:
            raise RenderError(f"`{name}` has no value in the view; show some of the plate")
        low, high = (Extremum(*one) for one in found)
        return low, high

    def _names(self, quantities: Sequence[str] | None) -> list[str]:
        if quantities is not None:
            return names_of(quantities)
        return [*self._field.components, *(STRESSES if self._field.dataset.equation == "elasticity" else ())]

    def _labels(self, name: str) -> dict[str, str]:
        symbol, unit = self._field._core.words(name)
        words = {"long_name": math_text(symbol), "units": unit}
        return {key: value for key, value in words.items() if value}


def line(start: ArrayLike, end: ArrayLike) -> Curve:
    return {"line": {"from": pair(start), "to": pair(end)}}


def circle(center: ArrayLike, radius: float) -> Curve:
    return _curve("circle", center=pair(center), radius=radius)


def along_crack(crack: Any) -> Curve:
    return _curve("crack", index=getattr(crack, "index", crack))


def around(tip: int, radius: float | None) -> Curve:
    return _curve("around", tip=tip, radius=radius)


def ray(tip: int, angle: float, length: float | None) -> Curve:
    return _curve("ray", tip=tip, angle=degrees(angle), far=length)


def _curve(kind: str, **numbers: Any) -> Curve:
    return {kind: plain(numbers, f"curve.{kind}")}


def names_of(names: Sequence[str], what: str = "quantities") -> list[str]:
    """Return a list of names, which a single text is not."""
    if isinstance(names, str):
        raise TypeError(f"{what}: give a list of names")
    return list(names)


def _xarray() -> Any:
    return require("xarray", "xarray", "values along curves and on grids")


def _attribute(name: str) -> str:
    """Return the name of a variable, so that it can be an attribute."""
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
