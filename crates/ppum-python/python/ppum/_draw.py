"""Images of a field: values at pixels, colours, figures, animations, axes of matplotlib."""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, Unpack

import numpy as np
from numpy.typing import NDArray

from . import _core
from ._errors import require
from ._files import Drawn, Page
from ._options import passes, takes
from ._styles import (
    AnimationOptions, FigureOptions, ImageOptions, PlotOptions, SeriesOptions, checked_request, quantities, request,
)  # fmt: skip
from ._text import plural
from ._units import milliseconds, pixels
from ._views import SIZE, PlaceOptions, RasterOptions, view_at
from ._warnings import warn

if TYPE_CHECKING:
    from ._field import Field


class Figure(Page):
    """A figure, drawn when its bytes are asked for. Made by `field.draw.figure`. Notebooks show it; it can be pickled."""

    def __init__(self, field: "Field", request: dict[str, Any]) -> None:
        super().__init__()
        self._made_of = field, request

    def _draw(self, form: str) -> bytes:
        field, request = self._made_of
        return self._with_warnings(_core.figure(field._core, request, form))

    def __repr__(self) -> str:
        asked = self._made_of[1]
        look, (quantities, parts) = asked["look"], (asked["panels"].get(name, []) for name in ("quantities", "parts"))
        names = [*(quantities or [asked.get("quantity") or "of a field"]), *parts]
        size = "panels" if quantities + parts and not {"size", "inches"} & look.keys() else _size(look)
        return f"<ppum.Figure {', '.join(names)}, {size}>"


def _size(look: dict[str, Any]) -> str:
    return f"{look['inches']} inches" if "inches" in look else "{}x{}".format(*look.get("size", SIZE))


class Animation(Drawn):
    """An animation, drawn when its bytes are asked for. Made by `field.draw.animate`. Notebooks show it.

    Its forms are ``gif``, the default, in 256 colours, and ``apng``, without loss. It is pickled without `progress`.
    """

    _forms = ("gif", "apng")

    def __init__(self, field: "Field", request: dict[str, Any], steps: list[int], fps: float, progress: Any) -> None:
        super().__init__()
        self._made_of, self._progress = (field, request, steps, milliseconds(fps)), progress

    def _draw(self, form: str) -> bytes:
        field, request, steps, time = self._made_of
        return self._with_warnings(_core.animation(field._core, request, steps, time, form, self._progress))

    def gif(self) -> bytes:
        """Return the bytes of a file in 256 colours, for programs that know no other."""
        return self.to_bytes("gif")

    def apng(self) -> bytes:
        """Return the bytes of a file without loss."""
        return self.to_bytes("apng")

    def _repr_png_(self) -> bytes:
        return self.apng()

    def __getstate__(self) -> dict[str, Any]:
        return {**self.__dict__, "_progress": None}

    def __repr__(self) -> str:
        _, asked, numbers, _ = self._made_of
        quantity, steps = asked.get("quantity") or "a field", plural(len(numbers), "step")
        return f"<ppum.Animation of {quantity}, {steps}, {_size(asked['look'])}>"


@dataclass(frozen=True)
class Draw:
    """Images of a field.

    A quantity is a name, a formula or a value of cells; the default is von Mises' stress, or a potential itself. Options are
    checked at the call: unknown ones raise `TypeError`, wrong values `ValueError`.
    """

    _field: "Field"

    @takes(RasterOptions)
    def render(
        self, quantity: str | None = None, *, dtype: Any = np.float64, **options: Unpack[RasterOptions]
    ) -> NDArray[Any]:
        """Return values at the centres of the pixels of a view: shape (rows, columns), rows from the top; NaN outside.

        They are computed in `dtype`, float64 or float32, with a warning where float32 has no three digits.

        Example:
            >>> f.draw.render("uy", size=(40, 80)).shape
            (80, 40)
        """
        kind = np.dtype(dtype)
        if kind not in (np.dtype(np.float64), np.dtype(np.float32)):
            raise ValueError(f"dtype: values are float64 or float32, not {kind}")
        core, is_single = self._field._core, kind == np.float32
        asked = self._field._asked(quantity, options)
        if is_single and (text := core.single_precision_warning()):
            warn(text)
        return _core.render(core, *asked, is_single, options["progress"])

    @takes(ImageOptions)
    def image(self, quantity: str | None = None, **options: Unpack[ImageOptions]) -> NDArray[np.uint8]:
        """Return the colours of an image: shape (rows, columns, 4), rows from the top; transparent outside.

        Example:
            >>> f.draw.image("ux", size=(40, 80), cmap="magma", vmin=0).shape
            (80, 40, 4)
        """
        view = self._field._seen(options)
        scene: Any = {name: value for name, value in options.items() if name != "size"}
        asked = checked_request(self._field, request(self._field, quantity, scene, view))
        if all(options.get(name) is None for name in PlaceOptions.__annotations__):
            view = view_at(_core.whole(self._field._core, asked), view.size)
        colors, messages = _core.rgba(self._field._core, asked, view)
        warn(*messages)
        return colors

    @takes(FigureOptions)
    def figure(self, quantity: str | Sequence[str] | None = None, **options: Unpack[FigureOptions]) -> Figure:
        """Make a figure with axes and a colour bar, as the program does; several quantities or parts have a panel each.

        It is drawn when its bytes are asked for. Messages, such as about pixels without a value, are warned of then, and kept
        as `Figure.warnings`.

        Example:
            >>> figure = f.draw.figure("von_mises", tip=0, zoom=1e6, norm="log")
            >>> figure.save("tip.png")
            >>> figure.png()[1:4]
            b'PNG'
            >>> f.draw.figure(["ux", "uy"], parts=["all", "jump"], shared_range=True)
            <ppum.Figure ux, uy, all, jump, panels>
        """
        parts = options.get("parts")
        if isinstance(parts, str) or (parts is not None and len(parts) < 2):
            raise ValueError(f"parts: {parts!r} is no list of several parts; `Field.part` gives one")
        return Figure(self._field, self._request(quantity, options, is_one=not (parts or quantities(quantity)[1])))

    @takes(SeriesOptions)
    def animate(self, quantity: str | None = None, **options: Unpack[SeriesOptions]) -> Animation:
        """Make an animation of the steps of a series: one range of colours, one factor of deformation, one place.

        Example:
            >>> moving = f.draw.animate("uy", deformed="auto", size=(320, 400))
            >>> moving.save("moving.gif")
            >>> moving.gif()[:6]
            b'GIF89a'
        """
        if quantities(quantity)[1]:
            raise ValueError("quantity: an animation shows one; `figure` has panels for those of one step")
        steps, known = options["steps"], range(len(self._field.dataset.steps))
        made = self._request(quantity, options, is_one=False, is_figure=not options["bare"])
        if steps is None or isinstance(steps, slice):
            numbers = list(known[steps or slice(None)])
        else:
            numbers = [self._field.dataset.steps[step].number for step in steps]
        if not numbers:
            raise ValueError("steps: an animation needs one step at least")
        return Animation(self._field, made, numbers, options["fps"], options["progress"])

    @passes(PlotOptions)
    def plot(self, quantity: str | None = None, **options: Unpack[PlotOptions]) -> Any:
        """Draw the field into matplotlib axes, exact at every pixel of the device, and return the `matplotlib.image.AxesImage`.

        Example:
            >>> image = f.draw.plot("uy", vmin=0, cmap="vik", tip=1, zoom=4)
            >>> bool(image.axes.get_xlim()[1] > 0.35)
            True
        """
        require("matplotlib", "matplotlib xarray", "images in matplotlib")
        from . import _axes

        return _axes.plot(self._field, quantity, **options)

    def _request(
        self, quantity: str | Sequence[str] | None, options: AnimationOptions, *, is_one: bool, is_figure: bool = True
    ) -> dict[str, Any]:
        """Return the request for a page, checked; a tip is followed where the plate is deformed."""
        field, size, tip = self._field, options["size"], options.get("tip")
        if size is not None and options["inches"] is not None:
            raise TypeError("give `size` or `inches`, not both")
        at = field._place(options, SIZE if size is None else pixels(size))
        made = request(field, quantity, options, at, may_find=is_one)
        place: dict[str, Any] = {} if at is None else {"center": at.center, "width": at.width}
        if tip is not None and options.get("width") is None:
            place = {"tip": field.step.tips._number(tip), "zoom": options.get("zoom")}
        return checked_request(field, {**made, "figure": is_figure, "place": place})
