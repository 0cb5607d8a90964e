"""Values of fields at points, and the quantities that there are."""

from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, Literal, get_args

import numpy as np
from numpy.typing import ArrayLike

from ._errors import MissingKey, QuantityError
from ._text import hint
from ._units import Floats, check_out, floats, pair

if TYPE_CHECKING:
    from ._field import Field

SideName = Literal["above", "below", "both"]
SIDES = get_args(SideName)


@dataclass(frozen=True)
class Quantity:
    """A quantity of a field.

    Attributes:
        name: Name in the program, e.g. ``von-mises``.
        symbol: Symbol for labels, with subscripts as ``_{…}``.
        unit: Unit for labels; may be empty.
        formula: Text of a formula that the dataset names.
    """

    name: str
    symbol: str
    unit: str
    formula: str | None


class Quantities(Mapping[str, Quantity]):
    """Quantities by name, found under names with `_` too."""

    def __init__(self, all: list[Quantity]) -> None:
        self._all = {quantity.name: quantity for quantity in all}

    def __getitem__(self, name: str) -> Quantity:
        found = self._all.get(name) or self._all.get(name.replace("_", "-"))
        if found is None:
            raise MissingKey(f"no quantity is called `{name}`; {hint(name.replace('_', '-'), self._all)}")
        return found

    def __iter__(self) -> Iterator[str]:
        return iter(self._all)

    def __len__(self) -> int:
        return len(self._all)

    def __repr__(self) -> str:
        return f"<ppum quantities: {', '.join(self._all)}>"


class Values:
    """The values of a field at points, evaluated when they are asked for. Made by `Field.at`.

    Attributes are quantities with ``_`` for ``-``, items are quantities and formulas of them. Results have the
    shape of the points, with one axis more for ``side="both"``: above, below. They are NaN outside the domain. On cracks
    there are also the quantities of `Field.face_quantities`, such as `normal_traction`; NaN elsewhere.

    Example:
        >>> v = f.at([0.0, 0.5], [1.0, 0.25])
        >>> v.ux.shape, v["sxx + syy"].shape
        ((2,), (2,))
    """

    __slots__ = ("_anchor", "_field", "_is_one", "_shape", "_side", "_x", "_y")

    def __init__(self, field: "Field", x: ArrayLike, y: ArrayLike, side: str, anchor: ArrayLike | None) -> None:
        if side not in SIDES:
            raise ValueError(f"side: {side!r} is none; there are above, below, both")
        self._field, self._side = field, side
        self._anchor = None if anchor is None else pair(anchor)
        self._x: Any = x
        self._y: Any = y
        self._shape: tuple[int, ...] = ()
        is_point = isinstance(x, (float, int)) and isinstance(y, (float, int))
        self._is_one = is_point and anchor is None and side != "both"
        if not is_point:
            x, y = floats(x), floats(y)
            x, y = (x, y) if x.shape == y.shape else np.broadcast_arrays(x, y)
            self._shape, self._x, self._y = x.shape, np.ravel(x), np.ravel(y)

    def __getattr__(self, name: str) -> Floats:
        if name.startswith("_"):
            raise AttributeError(name)
        try:
            return self[name]
        except QuantityError as error:
            raise AttributeError(str(error)) from error

    def __getitem__(self, quantity: str) -> Floats:
        if self._is_one:
            value = self._field._core.value(quantity, self._x, self._y, self._side == "below")
            return np.float64(value)  # type: ignore[return-value]
        return self._evaluate([quantity], False, None)[..., 0]

    def gradient(self, quantity: str) -> Floats:
        """Return the exact gradient of a quantity: shape (..., 2) with ∂/∂x and ∂/∂y last.

        The quantity `gradient` of a potential, the length of ∇u, is ``values["gradient"]``.

        Example:
            >>> f.at([0.1, 0.2], 0.5).gradient("uy").shape
            (2, 2)
        """
        return self._evaluate([quantity], True, None)[..., 0, 1:]

    @property
    def displacement(self) -> Floats:
        """Displacement (ux, uy): shape (..., 2).

        Example:
            >>> f.at([0.1, 0.2], 0.5).displacement.shape
            (2, 2)
        """
        return self._tensor([["ux", "uy"]])[..., 0, :]

    @property
    def strain(self) -> Floats:
        """Strain tensor in the plane: shape (..., 2, 2), of which [..., 0, 1] is ε_xy, half the engineering shear strain."""
        return self._tensor([["exx", "exy"], ["exy", "eyy"]])

    @property
    def stress(self) -> Floats:
        """Stress tensor in the plane: shape (..., 2, 2).

        Example:
            >>> stress = f.at([0.1, 0.2], 0.5).stress
            >>> np.allclose(np.linalg.eigvalsh(stress)[:, 1], f.at([0.1, 0.2], 0.5).s1)
            True
        """
        return self._tensor([["sxx", "sxy"], ["sxy", "syy"]])

    def _tensor(self, rows: list[list[str]]) -> Floats:
        """Return the components of a tensor on two axes behind those of the points."""
        found = self._evaluate([name for row in rows for name in row], False, None)
        return found.reshape((*found.shape[:-1], len(rows), 2))

    def _evaluate(self, names: list[str], gradient: bool, out: Floats | None) -> Floats:
        """Return shape (..., q), or (..., q, 3) with gradients; both sides have an axis of two before these."""
        shape = self._shape + ((len(names), 3) if gradient else (len(names),))
        if self._side == "both":
            sides = [self._run(names, below, gradient, np.empty(shape)) for below in (False, True)]
            return np.stack(sides, axis=len(self._shape))
        if out is None:
            out = np.empty(shape)
        else:
            check_out(out, shape)
            if any(np.may_share_memory(out, points) for points in (self._x, self._y)):
                raise ValueError("`out` shares memory with the coordinates")
        return self._run(names, self._side == "below", gradient, out)

    def _run(self, names: list[str], below: bool, gradient: bool, out: Floats) -> Floats:
        x, y = np.atleast_1d(self._x), np.atleast_1d(self._y)
        if self._shape == ():
            x, y = x.astype(np.float64), y.astype(np.float64)
        self._field._core.evaluate(names, x, y, below, self._anchor, gradient, out.reshape(-1))
        return out

    def __dir__(self) -> list[str]:
        names = (name.replace("-", "_") for name in self._field.quantities)
        return sorted({*super().__dir__(), *(name for name in names if name.isidentifier())})

    def __repr__(self) -> str:
        return f"<ppum.Values at {'a point' if self._shape == () else f'points of shape {self._shape}'}>"
