"""How far fields are from each other, and from what resampling makes of them."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any, Literal, NamedTuple, Unpack

import numpy as np

from . import _core
from ._errors import RenderError
from ._evaluation import Evaluation
from ._options import takes
from ._text import one_of
from ._units import Floats
from ._views import PixelOptions, View

if TYPE_CHECKING:
    from ._field import Field

ResamplingMethod = Literal["nearest", "bilinear", "bicubic", "cells"]


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
    """How far a field is from another at the pixels of a view. Made by `Field.compare`.

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
    """How far what resampling makes of a field is from the field. Made by `Field.resampled`.

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
        return {
            **super().to_dict(),
            "method": self.method,
            "nx": nx,
            "ny": ny,
            "bytes": self.bytes,
            "direct_bytes": self.direct_bytes,
        }

    def _words(self) -> str:
        if self.grid is None:
            return "one value a cell"
        return f"{self.method}, {self.grid[0]}x{self.grid[1]}"


class Comparing(Evaluation):
    """The comparisons of a `Field`."""

    @takes(PixelOptions)
    def compare(
        self, other: Field, quantity: str | None = None, *, progress: Any = None, **options: Unpack[PixelOptions]
    ) -> Comparison:
        """This field minus another at the pixels of a view: how far they are from each other, and where.

        Both are evaluated at the centre of each pixel; covers, functions and steps may be any.

        Args:
            other: A field, of this dataset or another: another step, part, weight or cover.
            quantity: A quantity or formula that both have, or a value of cells; by default as in `render`.
            progress: As in `render`.

        Raises:
            QuantityError: One of them does not have the quantity.
            RenderError: No pixel has a value in both.

        Example:
            >>> found = f.compare(f.part("smooth"), "uy", size=(100, 200))
            >>> found.compared, found.values.shape, found.relative.l2 > 0.1
            (20000, (200, 100), True)
            >>> f.compare(f).absolute
            Norms(l1=0.0, l2=0.0, max=0.0)
        """
        view, name = self._seen(options), quantity or self._core.default_quantity()
        values, norms, warnings = _core.compare(self._core, other._core, name, view._spot, view.size, progress)
        if np.isnan(values).all():
            raise RenderError(
                f"there is no pixel where `{name}` has a value in both fields: show a part of the plane where both plates are"
            )
        return Comparison(name, view, **_norms(norms), warnings=tuple(warnings), values=_frozen(values))

    @takes(PixelOptions)
    def resampled(
        self,
        quantity: str | None = None,
        *,
        grid: int | tuple[int, int] = 64,
        method: ResamplingMethod = "bilinear",
        over: Literal["domain", "view"] = "domain",
        error: float | None = None,
        progress: Any = None,
        **options: Unpack[PixelOptions],
    ) -> Resampling:
        """What resampling makes of the field, as other programs draw it, and how far that is from it.

        Exact values at the points of a grid are interpolated at the pixels of a view, as `ppum compare` does.

        Args:
            quantity: A quantity or formula; by default as in `render`.
            grid: Points of the grid, borders included: as many columns as rows, or both.
            method: The nearest point's value; ``bilinear`` of four points; ``bicubic`` of sixteen; or ``cells``: the value at
                the centre of each cell of the cover, without a grid.
            over: The rectangle of the grid: the box of the domain, or what the view shows.
            error: A relative error for which the grid is looked for too, see `Resampling.needed`.
            progress: As in `render`.

        Raises:
            QuantityError: No quantity of the field.
            RenderError: No grid: fewer than 2x2 points, or too many.
            ValueError: No such method, no such rectangle.

        Example:
            >>> coarse, fine = (f.resampled("uy", grid=n, size=(100, 200)) for n in (16, 256))
            >>> fine.relative.l1 < coarse.relative.l1, fine.bytes
            (True, 524288)
        """
        one_of("over", over, ("domain", "view"))
        if error is not None and not error > 0:
            raise ValueError(f"error: {error!r} cannot be reached; give a positive number, e.g. 0.01")
        points: Any = (grid, grid) if isinstance(grid, int) else tuple(grid)
        way = {"method": method, "grid": points, "over_view": over == "view", "error": error}
        view, name = self._seen(options), quantity or self._core.default_quantity()
        values, found, norms, facts = _core.resample(self._core, name, way, view._spot, view.size, progress)
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
            needed=facts["needed"] and tuple(_needed(one) for one in facts["needed"]),
            resampled=_frozen(found),
        )


def _needed(found: dict[str, Any]) -> Needed:
    return Needed(found["kind"], found["grid"] and tuple(found["grid"]), found["reason"])


def _norms(norms: dict[str, Any]) -> dict[str, Any]:
    return {**norms, "absolute": Norms(*norms["absolute"]), "relative": Norms(*norms["relative"])}


def _frozen(values: Floats) -> Floats:
    values.flags.writeable = False
    return values
