"""How far fields are from each other, and from what resampling makes of them."""

from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Annotated, Any, Literal, NamedTuple, Unpack

import numpy as np

from . import _core
from ._errors import RenderError
from ._options import Option, takes
from ._units import Floats
from ._views import RasterOptions, View

if TYPE_CHECKING:
    from ._field import Field

ResamplingMethod = Literal["nearest", "bilinear", "bicubic", "cells"]
GRID = "points of the grid, borders included: as many columns as rows, or both"
METHOD = (
    "the nearest point's value; ``bilinear`` of four points; ``bicubic`` of sixteen; or ``cells``: the value at the centre of "
    "each cell of the cover, without a grid"
)


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
    """How far a field is from another at the pixels of a view. Made by `field.compare`.

    Attributes:
        quantity: What was compared.
        view: Where.
        absolute: Norms of the differences.
        relative: The same in parts of the norms of what was taken away.
        compared: Pixels where both have a finite value.
        infinite: Pixels where one value at least is infinite, and the two are not the same.
        lost: Pixels where only what was taken away has a value.
        invented: Pixels where it alone has none.
        warnings: What makes the numbers less than they seem, e.g. plates that are not the same.
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
        """The numbers, for a row of a table: quantity, ``l1``, ``l2``, ``max``, ``relative_l1`` …, counts of pixels.

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
        grid: Its columns and rows.
        reason: Where there is none: the quantity is ``singular`` or has a ``jump`` in the view, or the error ``stalled``.
    """

    kind: str
    grid: tuple[float, float] | None
    reason: str | None


@dataclass(frozen=True, repr=False)
class Resampling(Comparison):
    """How far what resampling makes of a field is from the field. Made by `field.compare.resample`.

    The differences are what resampling gives minus the field.

    Attributes:
        method: ``nearest``, ``bilinear``, ``bicubic``, or ``cells``: one value for each cell of the cover.
        grid: Columns and rows of the points; none for cells.
        bytes: Memory of their values.
        direct_bytes: Memory of all that the field is made of.
        needed: For l1, l2 and max the grid of the error that was asked for.
        resampled: What resampling gives, of the shape of `values`.
    """

    method: str
    grid: tuple[int, int] | None
    bytes: int
    direct_bytes: int
    needed: tuple[Needed, Needed, Needed] | None
    resampled: Floats = field(compare=False)

    def to_dict(self) -> dict[str, Any]:
        """The numbers, for a row of a table: those of `Comparison.to_dict`, method, ``nx``, ``ny``, bytes."""
        nx, ny = self.grid or (None, None)
        own = {"method": self.method, "nx": nx, "ny": ny, "bytes": self.bytes, "direct_bytes": self.direct_bytes}
        return super().to_dict() | own

    def _words(self) -> str:
        if self.grid is None:
            return "one value a cell"
        return f"{self.method}, {self.grid[0]}x{self.grid[1]}"


class ResamplingOptions(RasterOptions, total=False):
    """How a field is resampled, and where the result is compared."""

    grid: Annotated[int | tuple[int, int], Option(64, GRID)]
    method: Annotated[ResamplingMethod, Option("bilinear", METHOD)]
    over: Annotated[Literal["domain", "view"], Option("domain", "the rectangle of the grid: the box of the domain, or the view")]
    error: Annotated[float | None, Option(None, "a relative error for which the grid is looked for, see `Resampling.needed`")]


@dataclass(frozen=True)
class Compare:
    """How far a field is from another, or from what other programs make of it, at the pixels of a view.

    Raises:
        QuantityError: A quantity that one of them does not have.
        RenderError: No pixel has a value in both, or there is no such grid.
    """

    _field: "Field"

    @takes(RasterOptions, "compare()")
    def __call__(self, other: "Field", quantity: str | None = None, **options: Unpack[RasterOptions]) -> Comparison:
        """The field minus another, of this dataset or another: another step, part, weight or cover.

        Both are evaluated at the centre of each pixel; a quantity is one that both have, by default as in `Draw`.

        Example:
            >>> found = f.compare(f.part("smooth"), "uy", size=(100, 200))
            >>> found.compared, found.values.shape, found.relative.l2 > 0.1
            (20000, (200, 100), True)
            >>> f.compare(f).absolute
            Norms(l1=0.0, l2=0.0, max=0.0)
        """
        view = self._field._seen(options)
        name, window, size = self._field._asked(quantity, options)
        values, norms, warnings = _core.compare(self._field._core, other._core, name, window, size, options["progress"])
        if np.isnan(values).all():
            raise RenderError(
                f"there is no pixel where `{name}` has a value in both fields: show a part of the plane where both plates are"
            )
        return Comparison(name, view, **_norms(norms), warnings=tuple(warnings), values=_frozen(values))

    @takes(ResamplingOptions)
    def resample(self, quantity: str | None = None, **options: Unpack[ResamplingOptions]) -> Resampling:
        """What resampling makes of the field, as other programs draw it, and how far that is from it.

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
        view = self._field._seen(options)
        name, window, size = self._field._asked(quantity, options)
        values, found, norms, facts = _core.resample(self._field._core, name, how, window, size, options["progress"])
        return Resampling(
            name,
            view,
            **_norms(norms),
            warnings=(),
            values=_frozen(values),
            method=method,
            grid=None if method == "cells" else points,
            bytes=facts["bytes"],
            direct_bytes=facts["direct_bytes"],
            needed=facts["needed"] and tuple(
                Needed(one["kind"], one["grid"] and tuple(one["grid"]), one["reason"]) for one in facts["needed"]
            ),
            resampled=_frozen(found),
        )


def _norms(norms: dict[str, Any]) -> dict[str, Any]:
    return {**norms, "absolute": Norms(*norms["absolute"]), "relative": Norms(*norms["relative"])}


def _frozen(values: Floats) -> Floats:
    values.flags.writeable = False
    return values
