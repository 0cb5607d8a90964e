"""Values along curves and on grids, as xarray datasets."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from .extras import needed
from .values import floats, math_text

if TYPE_CHECKING:
    from .field import Field
    from .fieldcore import FieldCore

Floats = NDArray[np.float64]

#: Where xarray comes from, and for what.
EXTRA = ("xarray", "values along curves and on grids")


def _named(name: str) -> str:
    """The name of a variable, so that it can be an attribute."""
    dashed = name.replace("-", "_")
    return dashed if dashed.isidentifier() else name


def _words(field: FieldCore, name: str) -> dict[str, str]:
    symbol, unit = field._core.words(name)
    words = {"long_name": math_text(symbol), "units": unit}
    return {key: value for key, value in words.items() if value}


def curve(field: FieldCore, along: str, num: int, names: list[str]) -> Any:
    """The table of a curve: the first column is the dimension, x, y and side are coordinates."""
    xarray = needed("xarray", *EXTRA)
    heads, rows = field._core.table(along, num, names)
    dimension = heads[0][0]
    coords: dict[str, Any] = {}
    variables: dict[str, Any] = {}
    for (name, unit), column in zip(heads, rows.T, strict=True):
        if name == "theta":
            column, unit = np.radians(column), "rad"
        attributes = {"units": unit} if unit else {}
        kind = coords if name in (dimension, "x", "y", "side") else variables
        kind[_named(name)] = (dimension, column, attributes)
    for name in names:
        if (variable := variables.get(_named(name))) is not None:
            variable[2].update(_words(field, name))
    return xarray.Dataset(variables, coords, {"title": field.dataset.title})


def grid(
    field: Field,
    columns: tuple[int | None, ArrayLike | None],
    rows: tuple[int | None, ArrayLike | None],
    names: list[str],
    side: str,
) -> Any:
    """Values over y and x, both as they are given, or evenly from border to border."""
    xarray = needed("xarray", *EXTRA)
    (x0, y0), (x1, y1) = field.dataset.domain
    x, y = _axis("x", *columns, x0, x1), _axis("y", *rows, y0, y1)
    found: Floats = field.evaluate(x[None, :], y[:, None], names, side=side)  # type: ignore[arg-type]
    dims = ("y", "x", "side") if side == "both" else ("y", "x")
    coords: dict[str, Any] = {"x": x, "y": y}
    if side == "both":
        coords["side"] = ["above", "below"]
    variables = {
        _named(name): (dims, found[..., k], _words(field, name)) for k, name in enumerate(names)
    }
    return xarray.Dataset(variables, coords, {"title": field.dataset.title})


def _axis(name: str, count: int | None, given: ArrayLike | None, low: float, high: float) -> Floats:
    if (count is None) == (given is None):
        raise ValueError(f"give n{name} or {name}, one of them")
    if count is not None:
        return np.linspace(low, high, count)
    axis = floats(given)  # type: ignore[arg-type]
    if axis.ndim != 1:
        raise ValueError(f"{name}: coordinates of a grid are a list of numbers")
    return axis
