"""Arrays that are given: real numbers without masks, which nothing casts in silence; and lists of arrays."""

import reprlib
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property
from numbers import Real
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ._errors import BuildError
from ._units import Floats


#: What is wrong with arrays of other kinds of numpy than real numbers.
OTHERS = {
    "c": "is complex; give its .real, its .imag, or both as two fields",
    "S": "has texts; convert them by .astype(float)",
    "U": "has texts; convert them by .astype(float)",
    "M": "has dates; give numbers, such as seconds",
    "m": "has times; give numbers, such as seconds",
    "V": "has records; give one of their columns",
}


def check_type(place: str, value: Any, fits: bool, remedy: str) -> None:
    if not fits:
        raise BuildError(f"{place}: is {type(value).__name__}; give {remedy}")


def check_shape(place: str, array: NDArray[Any], fits: bool, expected: str) -> None:
    if not fits:
        raise BuildError(f"{place}: has the shape {array.shape}, expected {expected}")


def known(name: str, values: Any) -> NDArray[Any]:
    """Return an array of real numbers as it is, or refuse it with the place and the remedy."""
    _refuse_mask(name, values)
    try:
        array = np.asarray(values)
        if array.dtype.kind == "O":
            _refuse_objects(name, array)
            array = array.astype(float)
    except (TypeError, ValueError, OverflowError) as error:
        if isinstance(error, BuildError):
            raise
        raise BuildError(f"{name}: is no array of numbers ({error}); give numbers, as many in each row") from None
    if wrong := OTHERS.get(array.dtype.kind):
        raise BuildError(f"{name}: {wrong}")
    return array


def real(name: str, values: Any) -> Floats:
    """Return a copy of an array of real numbers, finite or not."""
    array = known(name, values)
    return array.astype(float)


def numbers(name: str, values: ArrayLike) -> Floats:
    """Return a copy of an array of finite numbers."""
    array = real(name, values)
    if not np.isfinite(array).all():
        place = _first(~np.isfinite(array))
        raise BuildError(f"{indexed(name, place)}: is {array[place]}; give finite numbers")
    return array


def rows(name: str, values: ArrayLike, columns: int, count: int | None = None) -> Floats:
    """Return a copy of an array of finite numbers of the shape (count, columns)."""
    array = numbers(name, values)
    wanted = f"({'n' if count is None else count}, {columns})"
    if array.size == 0 and not count:
        return np.empty((0, columns))
    check_shape(name, array, array.shape[1:] == (columns,) and count in (None, len(array)), wanted)
    return array


def positive(name: str, array: Floats) -> Floats:
    if (array <= 0).any():
        row, column = _first(array <= 0)
        raise BuildError(f"{name}[{row}]: the extent {array[row, column]} in {'xy'[column]} must be positive")
    return array


def column(name: str, values: ArrayLike, count: int, kind: type) -> NDArray[Any]:
    """Return whole numbers of a type, one per patch; a single one is that of all."""
    array = known(name, values)
    if array.ndim == 0:
        array = np.full(count, array)
    check_shape(name, array, array.shape == (count,), f"({count},), one entry per patch")
    with np.errstate(invalid="ignore"):
        whole: NDArray[Any] = array.astype(kind)
    if (whole != array).any():
        k = _first(whole != array)[0]
        raise BuildError(f"{name}[{k}]: is {array[k]}; give whole numbers of the type {np.dtype(kind)}")
    return whole


def index(value: Any, count: int) -> int | None:
    """Return a whole number from 0 to `count` - 1, None for all else."""
    is_number = isinstance(value, Real) and not isinstance(value, bool)
    return int(value) if is_number and 0 <= value < count and int(value) == value else None


def scalar(name: str, value: Any) -> float:
    array = numbers(name, value)
    if array.shape != ():
        raise BuildError(f"{name}: has the shape {array.shape}; give one number")
    return float(array)


def integers(name: str, values: Any, count: int) -> list[int]:
    array = numbers(name, values)
    if array.shape != (count,) or (array != np.floor(array)).any():
        raise BuildError(f"{name}: is {short(values)}; give {count} whole numbers")
    return [int(number) for number in array]


def text(name: str, value: Any) -> str:
    check_type(name, value, isinstance(value, str), "a text")
    return str(value)


def mapping(name: str, given: Mapping[str, Any], what: str) -> Mapping[str, Any]:
    """Return a dictionary by names; `what` says of what."""
    check_type(name, given, isinstance(given, Mapping), f"a dictionary of names and {what}")
    for key in given:
        text(f"{name}[{short(key)}]", key)
    return given


def short(value: Any) -> str:
    """Return a value for a line of a message."""
    shape = getattr(value, "shape", ())
    return f"an array of the shape {shape}" if shape else reprlib.repr(value)


def sequence(name: str, values: Any, what: str) -> list[Any]:
    """Return the entries of a list; `what` says of what."""
    is_one = isinstance(values, (str, bytes, Mapping)) or getattr(values, "shape", None) == ()
    if is_one or not hasattr(values, "__iter__"):
        raise BuildError(f"{name}: is {type(values).__name__}; give a list of {what}")
    return list(values)


def repeated(rows: Floats) -> list[tuple[int, int]]:
    """Return the rows that occur before, each with the first such row."""
    _, first, which = np.unique(rows.view(f"V{rows.itemsize * rows.shape[1]}"), return_index=True, return_inverse=True)
    firsts = first[which.reshape(-1)]
    again = np.flatnonzero(firsts != np.arange(len(rows)))
    return list(zip(again.tolist(), firsts[again].tolist()))


def _refuse_mask(name: str, values: Any) -> None:
    """Refuse masks, which are lost where arrays are converted."""
    if isinstance(values, np.ma.MaskedArray):
        mask = np.ma.getmaskarray(values)
        if mask.any():
            raise BuildError(f"{indexed(name, _first(mask))}: is masked; fill the gaps, as by .filled(0)")
    elif isinstance(values, (list, tuple)):
        for k, part in enumerate(values):
            if isinstance(part, (list, tuple, np.ma.MaskedArray)):
                _refuse_mask(f"{name}[{k}]", part)


def _refuse_objects(name: str, array: NDArray[Any]) -> None:
    """Refuse objects that Python would convert, though they are no real numbers."""
    for place, item in np.ndenumerate(array):
        if isinstance(item, (str, bytes, complex, np.complexfloating)) or not hasattr(item, "__float__"):
            raise BuildError(f"{indexed(name, place)}: is {short(item)}; give a real number")


def _first(wrong: NDArray[np.bool_]) -> tuple[int, ...]:
    return tuple(int(k) for k in np.argwhere(wrong)[0])


def indexed(name: str, place: Sequence[int]) -> str:
    return name + "".join(f"[{k}]" for k in place)


@dataclass(frozen=True, eq=False)
class Ragged:
    """Arrays (m, c) of several lengths m, one after the other."""

    #: All rows, shape (total, c), and the numbers of rows of the arrays.
    values: Floats
    sizes: NDArray[np.int64]

    @classmethod
    def joined(cls, parts: Sequence[Floats]) -> "Ragged":
        """Join the arrays of parts (n, m, c), each with one length."""
        sizes = np.concatenate([np.full(len(part), part.shape[1]) for part in parts])
        return cls(np.concatenate([part.reshape(-1, part.shape[2]) for part in parts]), sizes)

    @cached_property
    def starts(self) -> NDArray[np.int64]:
        starts: NDArray[np.int64] = np.cumsum(self.sizes) - self.sizes
        return starts

    def at(self, order: ArrayLike) -> "Ragged":
        order = np.asarray(order, np.int64)
        return Ragged(self.values[gathered(self.starts[order], self.sizes[order])], self.sizes[order])

    def __len__(self) -> int:
        return len(self.sizes)

    def __getitem__(self, k: int) -> Floats:
        start = int(self.starts[k])
        return self.values[start : start + int(self.sizes[k])]


def gathered(starts: NDArray[np.int64], sizes: NDArray[np.int64]) -> NDArray[np.int64]:
    """Return the indices of runs that begin at `starts`, run after run."""
    offsets = np.cumsum(sizes) - sizes
    found: NDArray[np.int64] = np.repeat(starts - offsets, sizes) + np.arange(int(sizes.sum()))
    return found
