"""The program's own plots, curves over axes: values along curves, K over steps, errors against unknowns, the solver's work.

Each function takes a field or dataset, or several by name: ``{"coarse": …, "fine": …}``; names stand in the legend. Plots are
drawn when their bytes are asked for, and are those of `ppum plot`.

Example:
    >>> plot = ppum.plots.line(f, (-1, 0.1), (1, 0.1), ["syy", "sxx"])
    >>> plot.save("line.svg")
    >>> [label for label, _ in plot.curves]
    ['syy', 'sxx']
"""

from __future__ import annotations

import json
from collections.abc import Callable, Mapping, Sequence
from typing import TYPE_CHECKING, Any, Literal

import numpy as np
from numpy.typing import ArrayLike, NDArray

from . import _core
from ._errors import warn
from ._files import Page
from ._sample import POINTS
from ._units import degrees, pair, pixels

if TYPE_CHECKING:
    from ._dataset import Dataset
    from ._field import Field

__all__ = ["Plot", "around", "circle", "convergence", "crack", "history", "line", "ray", "series"]

Size = tuple[int, int]
Axes = Literal["", "x", "y", "xy"]

#: Columns and rows of a plot, as the program has them.
SIZE: Size = (900, 600)


class Plot(Page):
    """Curves over axes; made by the functions of `ppum.plots`. Notebooks show it; it can be pickled."""

    def __init__(self, curves: Callable[..., _core.Curves], made_of: tuple[Any, ...], size: Size) -> None:
        super().__init__()
        self._core, self._size = curves(*made_of), pixels(size)
        self._again = curves, made_of, self._size
        warn(*self._core.warnings())

    def __reduce__(self) -> tuple[Any, ...]:
        return Plot, self._again

    @property
    def curves(self) -> list[tuple[str, NDArray[np.float64]]]:
        """Labels and points: shape (n, 2); NaN where a curve breaks."""
        return [(label, np.array(points).reshape(-1, 2)) for label, points in self._core.curves()]

    def _draw(self, form: str) -> bytes:
        return self._core.bytes(self._size, form)

    def __repr__(self) -> str:
        labels = ", ".join(label for label, _ in self._core.curves())
        return f"<ppum.plots.Plot of {labels}, {self._size[0]}x{self._size[1]}>"


def line(
    fields: Field | Mapping[str, Field],
    start: ArrayLike,
    end: ArrayLike,
    quantities: Sequence[str] | None = None,
    *,
    num: int = POINTS,
    log: Axes = "",
    size: Size = SIZE,
) -> Plot:
    """Quantities along a line.

    Args:
        fields: A field, or several by name.
        start, end: Two points.
        quantities: Names or formulas; by default von Mises' stress, of a potential its gradient.
        num: Points.
        log: The logarithmic axes.
        size: Columns and rows of pixels.

    Raises:
        QuantityError: No quantity of a field; two points that are one.
        RenderError: Nothing would be seen.
    """
    along = {"line": {"from": pair(start), "to": pair(end)}}
    return _profiles(fields, along, quantities, num, log, size)


def circle(
    fields: Field | Mapping[str, Field],
    center: ArrayLike,
    radius: float,
    quantities: Sequence[str] | None = None,
    *,
    num: int = POINTS,
    log: Axes = "",
    size: Size = SIZE,
) -> Plot:
    """Quantities on a circle, over the angle from the x axis, drawn in degrees; further arguments as for `line`."""
    along = {"circle": {"center": pair(center), "radius": radius}}
    return _profiles(fields, along, quantities, num, log, size)


def crack(
    fields: Field | Mapping[str, Field],
    crack: Any = 0,
    quantities: Sequence[str] | None = None,
    *,
    num: int = POINTS,
    log: Axes = "",
    size: Size = SIZE,
) -> Plot:
    """Opening and sliding along a crack, or quantities on both of its faces.

    Args:
        crack: A `Crack` or its number.
        quantities: Without any the jumps of the displacement are drawn.

    Further arguments are as for `line`.

    Raises:
        IndexError: There is no such crack.
    """
    along = {"crack": {"index": getattr(crack, "index", crack)}}
    return _profiles(fields, along, quantities, num, log, size)


def around(
    fields: Field | Mapping[str, Field],
    tip: int,
    radius: float | None = None,
    quantities: Sequence[str] | None = None,
    *,
    num: int = POINTS,
    log: Axes = "",
    size: Size = SIZE,
) -> Plot:
    """Quantities on a circle around a tip, over the angle from the crack's extension; by default a hundredth of the crack's
    length away. Further arguments are as for `line`."""
    along = {"around": {"tip": tip, "radius": radius}}
    return _profiles(fields, along, quantities, num, log, size)


def ray(
    fields: Field | Mapping[str, Field],
    tip: int,
    angle: float = 0.0,
    length: float | None = None,
    quantities: Sequence[str] | None = None,
    *,
    num: int = POINTS,
    log: Axes = "",
    size: Size = SIZE,
) -> Plot:
    """Quantities on a ray from a tip, on logarithmic axes, with the exponents of their power laws near it.

    Args:
        angle: That from the crack's extension, radians, as `Tip.growth_angle`.

    Further arguments are as for `line`.

    Example:
        >>> plot = ppum.plots.ray(f, 1, quantities=["syy"])
        >>> plot.curves[0][1].shape
        (201, 2)
    """
    along = {"ray": {"tip": tip, "angle": degrees(angle), "far": length}}
    return _profiles(fields, along, quantities, num, log, size)


def series(
    datasets: Dataset | Mapping[str, Dataset],
    numbers: Sequence[str] = ("k1", "k2"),
    over: Literal["step", "load", "length", "extension", "cycles"] = "step",
    *,
    log: Axes = "",
    size: Size = SIZE,
) -> Plot:
    """What was found in the steps of a series: stress intensity factors of all tips, and others.

    Args:
        datasets: A dataset of several steps, or several by name.
        numbers: ``k1``, ``k2``, ``load``, ``length``, ``extension``.
        over: What they are drawn over.

    Raises:
        RenderError: One step alone; extensions or cycles of cracks that do not grow.
    """
    kind = {"series": {"numbers": _list(numbers, "numbers"), "over": over}}
    return _told(datasets, kind, log, size)


def history(
    datasets: Dataset | Mapping[str, Dataset],
    what: Literal["seconds", "bytes", "residuals", "levels"] = "seconds",
    *,
    step: int | None = None,
    log: Axes = "",
    size: Size = SIZE,
) -> Plot:
    """The solver's work: seconds or bytes of its phases, residuals after each iteration, sizes of levels.

    Args:
        step: By default the last, of seconds and bytes all.

    Raises:
        IndexError: There is no such step.
        RenderError: The history does not tell it.

    Example:
        >>> ppum.plots.history(ds).png()[1:4]
        b'PNG'
    """
    return _told(datasets, {"history": {"what": what, "step": step}}, log, size)


def convergence(
    datasets: Dataset | Sequence[Dataset] | Mapping[str, Dataset],
    *,
    step: int | None = None,
    log: Axes = "",
    size: Size = SIZE,
) -> Plot:
    """Errors of solutions of one problem against their unknowns, with the exponents of their power laws.

    Of problems with an exact solution these are errors in the energy norm and in L²; of others the distances of energy and K
    from those of the dataset with most unknowns.

    Args:
        datasets: Three or more, of different numbers of unknowns; or one whose steps are those of an adaptation.
        step: By default the last of each.

    Raises:
        RenderError: Too few datasets, or datasets of several problems.
    """
    if isinstance(datasets, Sequence):
        datasets = {f"dataset {k}": one for k, one in enumerate(datasets)}
    return _told(datasets, {"convergence": {"step": step}}, log, size)


def _named(things: Any) -> list[tuple[str, Any]]:
    """Fields or datasets by name; a single one has the title of its dataset."""
    if isinstance(things, Mapping):
        return [(str(name), thing) for name, thing in things.items()]
    return [(getattr(things, "dataset", things).title or "a dataset", things)]


def _profiles(fields: Field | Mapping[str, Field], along: Any, quantities: Any, num: int, log: str, size: Size) -> Plot:
    wanted = None if quantities is None else _list(quantities, "quantities")
    return Plot(_curves, ("profiles", _named(fields), json.dumps(along), num, wanted, log), size)


def _told(datasets: Dataset | Mapping[str, Dataset], kind: Any, log: str, size: Size) -> Plot:
    return Plot(_curves, ("told", _named(datasets), json.dumps(kind), log), size)


def _curves(kind: Literal["profiles", "told"], named: list[tuple[str, Any]], *how: Any) -> _core.Curves:
    made: _core.Curves = getattr(_core, kind)([(name, thing._core) for name, thing in named], *how)
    return made


def _list(names: Sequence[str], what: str) -> list[str]:
    if isinstance(names, str):
        raise TypeError(f"{what}: give a list of names")
    return list(names)
