"""The part of the plane that an image shows."""

import math
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Annotated, Any, TypedDict

from numpy.typing import NDArray

from ._errors import RenderError
from ._options import Option
from ._units import floats, pair, pixels

#: Columns and rows of an image where none are given.
SIZE = (1024, 768)
PIXELS = f"columns and rows of pixels; by default of `view`, or {SIZE[0]} and {SIZE[1]}"

#: The magnification at a point or a tip where none is given.
ZOOM = 10.0


@dataclass(frozen=True)
class View:
    """The part of the plane that an image shows; all functions that draw take it as `view`.

    Attributes:
        center: The middle of the image.
        width: Length from the left border to the right one; down to 1e-12 of the plate.
        size: Columns and rows of pixels; they are squares, so the height follows.

    Example:
        >>> ppum.View(center=(0.0, 0.0), width=2.0, size=(400, 300)).height
        1.5
    """

    center: tuple[float, float]
    width: float
    size: tuple[int, int] = SIZE

    @property
    def height(self) -> float:
        """Length from the lower border to the upper one."""
        return self.width * self.size[1] / self.size[0]


class ProgressOptions(TypedDict, total=False):
    """The function that hears of the progress of a long call."""

    progress: Annotated[Any, Option(None, "a function that is called with phase, parts done, all parts and step")]


class PlaceOptions(TypedDict, total=False):
    """The place that is seen, by default all of the plate."""

    view: Annotated[View | None, Option(None, "a `View`, in place of center, width, tip and zoom")]
    center: Annotated[Sequence[float] | NDArray[Any] | None, Option(None)]
    width: Annotated[float | None, Option(None)]
    tip: Annotated[int | None, Option(None)]
    zoom: Annotated[float | None, Option(None, more="or at `center`")]


class PixelOptions(PlaceOptions, total=False):
    """The place that is seen, and its pixels."""

    size: Annotated[tuple[int, int] | None, Option(None, PIXELS)]


class RasterOptions(PixelOptions, ProgressOptions, total=False):
    """The place that is seen, its pixels, and the progress."""


def view_at(
    domain: tuple[tuple[float, float], tuple[float, float]],
    size: tuple[int, int],
    center: Any = None,
    width: float | None = None,
    zoom: float | None = None,
) -> View:
    """Return the view at a point, or of all of the plate."""
    (x0, y0), (x1, y1) = domain
    if width is not None and zoom is not None:
        raise ValueError("give a width or a zoom, not both")
    if zoom is None:
        zoom = 1.0 if center is None else ZOOM
    if not (zoom > 0 and math.isfinite(zoom)):
        raise RenderError(f"zoom: {zoom!r} does not enlarge; give a positive number, e.g. 10")
    whole = max(x1 - x0, (y1 - y0) * size[0] / max(size[1], 1))
    middle = (0.5 * x0 + 0.5 * x1, 0.5 * y0 + 0.5 * y1)
    return View(middle if center is None else pair(center), whole / zoom if width is None else float(width), size)


def checked_view(view: View, options: PixelOptions) -> View:
    """Return the view that is given, in as many pixels as are asked for."""
    if not isinstance(view, View):
        raise TypeError(f"view: a ppum.View is needed, not {type(view).__name__}")
    others = [n for n in ("center", "width", "tip", "zoom") if options.get(n) is not None]
    if others:
        raise TypeError(f"`view` says what is seen, so leave out {', '.join(others)}")
    size = options.get("size")
    return View(pair(view.center), float(floats(view.width)), pixels(view.size if size is None else size))
