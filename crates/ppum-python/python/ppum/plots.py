"""The program's own plots, curves over axes: values along curves, K over steps, errors against unknowns, the solver's work.

Each function takes a field or dataset, or several by name: ``{"coarse": …, "fine": …}``; names stand in the legend. Plots are
drawn when their bytes are asked for, and are those of `ppum plot`; `RenderError` says that nothing would be seen. Curves are
those of `Field.sample`; by default von Mises' stress is drawn along them, of a potential its gradient.

Example:
    >>> plot = ppum.plots.line(f, (-1, 0.1), (1, 0.1), ["syy", "sxx"])
    >>> plot.save("line.svg")
    >>> [label for label, _ in plot.curves]
    ['syy', 'sxx']
"""

from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING, Annotated, Any, Literal, TypeAlias, TypedDict, Unpack, get_args

import numpy as np
from numpy.typing import ArrayLike, NDArray

from . import _core, _sample
from ._files import Page
from ._options import Option, takes
from ._sample import PointOptions, names_of
from ._text import one_of
from ._units import pixels
from ._warnings import warn

if TYPE_CHECKING:
    from ._dataset import Dataset
    from ._field import Field

__all__ = ["Plot", "around", "circle", "convergence", "crack", "history", "line", "ray", "series"]

Fields: TypeAlias = "Field | Dataset | Mapping[str, Field | Dataset]"
Names = Sequence[str] | None
Work = Literal["seconds", "bytes", "residuals", "levels"]
Axis = Literal["step", "load", "length", "extension", "cycles"]


class PlotOptions(TypedDict, total=False):
    """The axes and the size of a plot."""

    log: Annotated[Literal["", "x", "y", "xy"], Option("", "the logarithmic axes")]
    size: Annotated[tuple[int, int], Option((900, 600), "columns and rows of pixels")]


class ProfileOptions(PlotOptions, PointOptions, total=False):
    """The points of a curve, and its plot."""


class StepOptions(PlotOptions, total=False):
    """The step that is drawn, and its plot."""

    step: Annotated[int | None, Option(None, "number of the step; by default the last, of seconds and bytes all")]


class Plot(Page):
    """Curves over axes; made by the functions of `ppum.plots`. Notebooks show it; it can be pickled."""

    def __init__(self, kind: str, named: list[tuple[str, Any]], how: tuple[Any, ...], size: tuple[int, int]) -> None:
        super().__init__()
        self._made_of, self._size = (kind, named, how, size), pixels(size)
        self._core: _core.Curves = getattr(_core, kind)([(name, thing._core) for name, thing in named], *how)
        warn(*self._core.warnings())

    def __reduce__(self) -> tuple[Any, ...]:
        return Plot, self._made_of

    @property
    def curves(self) -> list[tuple[str, NDArray[np.float64]]]:
        """Labels and points: shape (n, 2); NaN where a curve breaks."""
        return [(label, np.array(points).reshape(-1, 2)) for label, points in self._core.curves()]

    def _draw(self, form: str) -> bytes:
        return self._core.bytes(self._size, form)

    def __repr__(self) -> str:
        labels = ", ".join(label for label, _ in self._core.curves())
        return f"<ppum.plots.Plot of {labels}, {self._size[0]}x{self._size[1]}>"


@takes(ProfileOptions)
def line(
    fields: Fields, start: ArrayLike, end: ArrayLike, quantities: Names = None, **options: Unpack[ProfileOptions]
) -> Plot:
    """Plot quantities along a line."""
    return _profiles(fields, _sample.line(start, end), quantities, options)


@takes(ProfileOptions)
def circle(
    fields: Fields, center: ArrayLike, radius: float, quantities: Names = None, **options: Unpack[ProfileOptions]
) -> Plot:
    """Plot quantities on a circle, over the angle from the x axis, drawn in degrees."""
    return _profiles(fields, _sample.circle(center, radius), quantities, options)


@takes(ProfileOptions)
def crack(fields: Fields, crack: Any = 0, quantities: Names = None, **options: Unpack[ProfileOptions]) -> Plot:
    """Plot opening and sliding along a crack, or quantities on both of its faces."""
    return _profiles(fields, _sample.along_crack(crack), quantities, options)


@takes(ProfileOptions)
def around(
    fields: Fields, tip: int, radius: float | None = None, quantities: Names = None, **options: Unpack[ProfileOptions]
) -> Plot:
    """Plot quantities on a circle around a tip, over the angle from the crack's extension."""
    return _profiles(fields, _sample.around(tip, radius), quantities, options)


@takes(ProfileOptions)
def ray(
    fields: Fields,
    tip: int,
    angle: float = 0.0,
    length: float | None = None,
    quantities: Names = None,
    **options: Unpack[ProfileOptions],
) -> Plot:
    """Plot quantities on a ray from a tip, on logarithmic axes, with the exponents of their power laws near it.

    Example:
        >>> plot = ppum.plots.ray(f, 1, quantities=["syy"])
        >>> plot.curves[0][1].shape
        (201, 2)
    """
    return _profiles(fields, _sample.ray(tip, angle, length), quantities, options)


@takes(PlotOptions)
def series(
    datasets: "Dataset | Mapping[str, Dataset]",
    numbers: Sequence[str] = ("k1", "k2"),
    over: Axis = "step",
    **options: Unpack[PlotOptions],
) -> Plot:
    """Plot numbers of the steps of a series, ``k1``, ``k2``, ``load``, ``length``, ``extension``, over another one."""
    one_of("over", over, get_args(Axis))
    return _reports(datasets, {"series": {"numbers": names_of(numbers, "numbers"), "over": over}}, options)


@takes(StepOptions)
def history(
    datasets: "Dataset | Mapping[str, Dataset]",
    what: Work = "seconds",
    **options: Unpack[StepOptions],
) -> Plot:
    """Plot the solver's work: seconds or bytes of its phases, residuals after each iteration, sizes of levels.

    Example:
        >>> ppum.plots.history(ds).png()[1:4]
        b'PNG'
    """
    one_of("what", what, get_args(Work))
    return _reports(datasets, {"history": {"what": what, "step": options["step"]}}, options)


@takes(StepOptions)
def convergence(
    datasets: "Dataset | Sequence[Dataset] | Mapping[str, Dataset]", **options: Unpack[StepOptions]
) -> Plot:
    """Plot errors of solutions of one problem against their unknowns, with the exponents of their power laws.

    These are errors in the energy norm and in L² if an exact solution is known, else the distances of energy and K from those
    of the dataset with most unknowns. It takes three datasets or more of different sizes, or one with the steps of an adaptation.
    """
    if isinstance(datasets, Sequence):
        datasets = {f"dataset {k}": one for k, one in enumerate(datasets)}
    return _reports(datasets, {"convergence": {"step": options["step"]}}, options)


def _profiles(fields: Any, curve: dict[str, Any], quantities: Names, options: ProfileOptions) -> Plot:
    wanted = None if quantities is None else names_of(quantities)
    # of a dataset its last field
    named = [(name, getattr(thing, "field", thing)) for name, thing in _named(fields)]
    return Plot("profiles", named, (curve, options["num"], wanted, options["log"]), options["size"])


def _reports(datasets: Any, kind: dict[str, Any], options: PlotOptions) -> Plot:
    return Plot("reports", _named(datasets), (kind, options["log"]), options["size"])


def _named(things: Any) -> list[tuple[str, Any]]:
    """Return fields or datasets by name; a single one has the title of its dataset."""
    if isinstance(things, Mapping):
        return [(str(name), thing) for name, thing in things.items()]
    return [(getattr(things, "dataset", things).title or "a dataset", things)]
