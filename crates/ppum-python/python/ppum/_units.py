"""Numbers that calls are given: coordinates, angles, sizes."""

import math
import operator

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ._errors import RenderError

Floats = NDArray[np.float64]


def floats(values: ArrayLike) -> Floats:
    """Return an array of float64, without a copy where it need not be."""
    if isinstance(values, np.ma.MaskedArray):
        values = np.ma.filled(values.astype(np.float64), np.nan)
    try:
        array = np.asarray(values)
    except ValueError as error:
        raise ValueError(f"coordinates are no array of numbers ({error})") from None
    if array.dtype.kind not in "fiub":
        raise TypeError(f"coordinates are real numbers, not {array.dtype}")
    return np.asarray(array, dtype=np.float64)


def pair(point: ArrayLike) -> tuple[float, float]:
    array = floats(point)
    if array.shape != (2,) or not np.isfinite(array).all():
        raise ValueError("a point is two finite numbers: x, y")
    return float(array[0]), float(array[1])


def degrees(angle: float) -> float:
    """Return an angle in degrees, which the libraries take."""
    if not abs(angle) <= 2 * math.pi:
        raise ValueError(f"angle: {angle!r} is more than a turn; angles are in radians, see math.radians")
    return math.degrees(angle)


def check_out(out: Floats, shape: tuple[int, ...]) -> None:
    if not isinstance(out, np.ndarray) or out.dtype != np.float64 or out.shape != shape:
        raise ValueError(f"`out` has to be a float64 array of shape {shape}")
    if not out.flags.c_contiguous or not out.flags.writeable:
        raise ValueError("`out` has to be writeable and in C order")


def pixels(size: tuple[int, int], name: str = "size") -> tuple[int, int]:
    """Return columns and rows, both positive, of an option of this name."""
    try:
        columns, rows = (operator.index(n) for n in size)
    except (TypeError, ValueError):
        raise RenderError(f"{name}: {size!r} is not two whole numbers, columns and rows") from None
    if not (0 < columns < 2**32 and 0 < rows < 2**32):
        raise RenderError(f"{name}: {columns}x{rows} cannot be drawn; give positive numbers")
    return columns, rows


def positive(name: str, value: float | None) -> None:
    if value is not None and not (math.isfinite(value) and value > 0):
        raise ValueError(f"{name}: {value} is not a positive number")


def milliseconds(fps: float) -> int:
    """Return the time of an image, with so many images in a second."""
    if not 1 / 60 <= fps <= 50:
        raise ValueError(f"fps: {fps} is not a rate; give a number of steps a second, from 1/60 to 50")
    return int(1000 / fps + 0.5)
