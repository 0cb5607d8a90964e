"""How far fields are from each other, and from what resampling makes of them."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from . import _core
from .errors import RenderError
from .views import View

if TYPE_CHECKING:
    from .field import Field

__all__ = ["Comparison", "Needed", "Norms", "Resampling"]

Floats = NDArray[np.float64]


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


def compare(one: Field, other: Field, name: str, view: View, progress: Any) -> Comparison:
    """The comparison of `Field.compare`."""
    values, norms, warnings = _core.compare(
        one._core, other._core, name, view._spot, view.size, progress
    )
    if np.isnan(values).all():
        raise RenderError(
            f"there is no pixel where `{name}` has a value in both fields: show a part of the plane where both plates are"
        )
    return Comparison(name, view, **_norms(norms), warnings=tuple(warnings), values=_frozen(values))


def resample(one: Field, name: str, view: View, way: dict[str, Any], progress: Any) -> Resampling:
    """The comparison of `Field.resampled`."""
    values, resampled, norms, facts = _core.resample(
        one._core, name, way, view._spot, view.size, progress
    )
    needed = facts["needed"] and tuple(_needed(one) for one in facts["needed"])
    return Resampling(
        name,
        view,
        **_norms(norms),
        warnings=(),
        values=_frozen(values),
        method=way["method"],
        grid=None if way["method"] == "cells" else tuple(way["grid"]),
        bytes=facts["bytes"],
        direct_bytes=facts["direct_bytes"],
        needed=needed,
        resampled=_frozen(resampled),
    )


def _needed(found: dict[str, Any]) -> Needed:
    grid = found["grid"] and tuple(found["grid"])
    return Needed(found["kind"], grid, found["reason"])


def _norms(norms: dict[str, Any]) -> dict[str, Any]:
    return {**norms, "absolute": Norms(*norms["absolute"]), "relative": Norms(*norms["relative"])}


def _frozen(values: Floats) -> Floats:
    values.flags.writeable = False
    return values


for _class in (Comparison, Needed, Norms, Resampling):
    _class.__module__ = "ppum"
