"""Differences between fields, and between a field and its resampling."""

from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Annotated, Any, Literal, NamedTuple, Unpack

import numpy as np

from . import _core
from ._errors import RenderError
from ._options import Option, takes
from ._text import plain
from ._units import Floats
from ._views import RasterOptions, View

if TYPE_CHECKING:
    from ._field import Field

ResamplingMethod = Literal["nearest", "bilinear", "bicubic", "cells"]
GRID = "points of the grid, borders included: as many columns as rows, or both"
METHOD = "value of the nearest point; ``bilinear`` of four; ``bicubic`` of sixteen; or ``cells``: at the centres of cells"


class Norms(NamedTuple):
    """Means over the n pixels where both have a finite value, so that they do not depend on the size of the view.

    Attributes:
        l1: Σ|d|/n of the differences d.
        l2: √(Σd²/n).
        max: max |d|; infinite if one value is and the other is not.
    """

    l1: float
    l2: float
    max: float


@dataclass(frozen=True)
class Comparison:
    """The difference of two fields at the pixels of a view. Made by `field.compare`.

    Attributes:
        quantity: The compared quantity.
        view: The view.
        absolute: Norms of the differences.
        relative: Norms of the differences, relative to those of the subtracted field.
        compared: Pixels where both have a finite value.
        infinite: Pixels where a value is infinite, and the two differ.
        lost: Pixels where only the subtracted field has a value.
        invented: Pixels where only the other one has a value.
        warnings: Reasons to doubt the numbers, e.g. different plates.
        values: The differences: shape (rows, columns), rows from the top; NaN where one has no value. Not written to.
    """

    quantity: str
    view: View
    absolute: Norms
    relative: Norms
    compared: int
    infinite: int
    lost: int
    invented: int
    warnings: tuple[str, ...]
    values: Floats = field(compare=False, repr=False)

    def to_dict(self) -> dict[str, Any]:
        """Return a row of a table: quantity, ``l1``, ``l2``, ``max``, ``relative_l1`` …, counts of pixels.

        Example:
            >>> rows = [f.compare(f.part("smooth"), q, size=(60, 120)).to_dict() for q in ("ux", "uy")]
            >>> [row["quantity"] for row in rows], rows[0]["l2"] > 0
            (['ux', 'uy'], True)
        """
        relative = {f"relative_{name}": value for name, value in self.relative._asdict().items()}
        counts = {name: getattr(self, name) for name in ("compared", "infinite", "lost", "invented")}
        return {"quantity": self.quantity, **self.absolute._asdict(), **relative, **counts}

    def __repr__(self) -> str:
        l1, l2, most = self.relative
        return (
            f"<ppum.{type(self).__name__} of {self.quantity}, {self._words()}, "
            f"relative L1 {l1:.3g}, L2 {l2:.3g}, max {most:.3g}>"
        )

    def _words(self) -> str:
        return f"{self.compared} pixels"


@dataclass(frozen=True)
class Needed:
    """The grid that resampling would need for an error, in one norm.

    Attributes:
        kind: ``measured``, ``extrapolated`` from the last measured ones, or ``none``.
        grid: Its columns and rows; None without one.
        reason: Why there is none: the quantity is ``singular`` or has a ``jump`` in the view, or the error ``stalled``.
    """

    kind: str
    grid: tuple[float, float] | None
    reason: str | None


@dataclass(frozen=True, repr=False)
class Resampling(Comparison):
    """The difference of a resampled field from the field itself. Made by `field.compare.resample`.

    Attributes:
        method: ``nearest``, ``bilinear``, ``bicubic``, or ``cells``: one value for each cell of the cover.
        grid: Columns and rows of the points; none for cells.
        bytes: Memory of their values.
        direct_bytes: Memory of the field.
        needed: The grids for the given error in l1, l2 and max.
        resampled: The resampled values, of the shape of `values`.
    """

    method: str
    grid: tuple[int, int] | None
    bytes: int
    direct_bytes: int
    needed: tuple[Needed, Needed, Needed] | None
    resampled: Floats = field(compare=False)

    def to_dict(self) -> dict[str, Any]:
        """Return a row of a table: that of `Comparison.to_dict`, method, ``nx``, ``ny``, bytes."""
        nx, ny = self.grid or (None, None)
        own = {"method": self.method, "nx": nx, "ny": ny, "bytes": self.bytes, "direct_bytes": self.direct_bytes}
        return super().to_dict() | own

    def _words(self) -> str:
        if self.grid is None:
            return "one value a cell"
        return f"{self.method}, {self.grid[0]}x{self.grid[1]}"


class ResamplingOptions(RasterOptions, total=False):
    """The method of resampling, and the view where the result is compared."""

    grid: Annotated[int | tuple[int, int], Option(64, GRID)]
    method: Annotated[ResamplingMethod, Option("bilinear", METHOD)]
    over: Annotated[Literal["domain", "view"], Option("domain", "the rectangle of the grid: the box of the domain, or the view")]
    error: Annotated[float | None, Option(None, "a relative error for which the grid is looked for, see `Resampling.needed`")]


@dataclass(frozen=True)
class Compare:
    """Differences of a field from others, and from what other programs make of it, at the pixels of a view.

    Raises:
        QuantityError: One of them does not have the quantity.
        RenderError: No pixel has a value in both, or there is no such grid.
    """

    _field: "Field"

    @takes(RasterOptions, "compare()")
    def __call__(self, other: "Field", quantity: str | None = None, **options: Unpack[RasterOptions]) -> Comparison:
        """Subtract another field, of this dataset or another: another step, part, weight or cover.

        Both are evaluated at the centre of each pixel; a quantity is one that both have, by default as in `Draw`.

        Example:
            >>> found = f.compare(f.part("smooth"), "uy", size=(100, 200))
            >>> found.compared, found.values.shape, found.relative.l2 > 0.1
            (20000, (200, 100), True)
            >>> f.compare(f).absolute
            Norms(l1=0.0, l2=0.0, max=0.0)
        """
        name, view = self._field._asked(quantity, options)
        values, norms, warnings = _core.compare(self._field._core, other._core, name, view, options["progress"])
        if np.isnan(values).all():
            raise RenderError(
                f"there is no pixel where `{name}` has a value in both fields: show a part of the plane where both plates are"
            )
        return Comparison(name, view, *_norms(*norms), tuple(warnings), _frozen(values))

    @takes(ResamplingOptions)
    def resample(self, quantity: str | None = None, **options: Unpack[ResamplingOptions]) -> Resampling:
        """Resample the field as other programs do, and compare the result with the field.

        Exact values at the points of a grid are interpolated at the pixels of a view, as `ppum compare` does.

        Example:
            >>> coarse, fine = (f.compare.resample("uy", grid=n, size=(100, 200)) for n in (16, 256))
            >>> fine.relative.l1 < coarse.relative.l1, fine.bytes
            (True, 524288)
        """
        grid, method, error = options["grid"], options["method"], options["error"]
        if error is not None and not error > 0:
            raise ValueError(f"error: {error!r} cannot be reached; give a positive number, e.g. 0.01")
        points: Any = (grid, grid) if isinstance(grid, int) else tuple(grid)
        how = {"method": method, "grid": points, "over_view": options["over"] == "view", "error": error}
        name, view = self._field._asked(quantity, options)
        how = plain(how, "resample")
        values, resampled, norms, memory = _core.resample(self._field._core, name, how, view, options["progress"])
        size, direct, needed = memory
        return Resampling(
            name, view, *_norms(*norms), (), _frozen(values), method, None if method == "cells" else points, size, direct,
            needed and (Needed(*needed[0]), Needed(*needed[1]), Needed(*needed[2])), _frozen(resampled),
        )  # fmt: skip


def _norms(absolute: Any, relative: Any, counts: Any) -> tuple[Norms, Norms, int, int, int, int]:
    return Norms(*absolute), Norms(*relative), *counts


def _frozen(values: Floats) -> Floats:
    values.flags.writeable = False
    return values
