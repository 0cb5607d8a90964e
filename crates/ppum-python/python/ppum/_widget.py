"""Views in notebooks: fields that follow the mouse, exact in every frame.

A view draws where the field is, in this process; the browser gets finished pixels, without loss, and sends what the mouse
does. At most two frames are on their way at a time and what happens in between becomes one, so nothing piles up. Needs anywidget.
"""

import base64
import math
import os
import sys
from collections.abc import Mapping, Sequence
from dataclasses import replace
from functools import lru_cache
from pathlib import Path
from typing import TYPE_CHECKING, Any, Unpack, get_args

import anywidget
import numpy as np
import traitlets

from . import _core
from ._draw import Figure
from ._errors import PpumError
from ._field import KEPT
from ._options import passes, takes
from ._styles import FigureOptions, Norm, ViewerOptions, colormap, request, span
from ._text import plural
from ._views import ZOOM, PlaceOptions, View, view_at

if TYPE_CHECKING:
    from ._field import Field

#: Most pixels of a frame: two screens of 4K.
MOST_PIXELS = 1 << 24

#: Least width of a view in units of its farthest coordinate; below, double precision has no neighbours.
FINEST = 4.0 * sys.float_info.epsilon

#: Least width of a view anywhere: pixels are normal numbers.
SMALLEST = 1e-300

#: Largest width of a view in plates.
FARTHEST = 1e6

#: Width of the view of all of the plate, in plates: its border is seen.
MARGIN = 1.04

#: Reach of the mouse to cracks, pixels.
REACH = 6.0

#: What makes another image of the same place.
_LOOK = ("quantity", "norm", "cmap", "step", "clim", "cracks", "deformed")

#: What the controls may set.
_SETTABLE = ("quantity", "norm", "cmap", "step", "clim", "deformed")

_NORMS = get_args(Norm)


class Viewer(anywidget.AnyWidget):
    """A field in a notebook; made by `Dataset.view` and `Field.view`. The current view is `view`, a `View`.

    Drag to pan, turn the wheel to zoom about the mouse, point to read values: near a crack those of both faces. With the
    image in focus the arrows, ``+``, ``-`` and ``0`` do the same. The traits `center`, `width`, `quantity`, `step`, `clim`,
    `norm`, `cmap`, `cracks`, `deformed` and `height` are its options; a cmap of None is ``auto`` here. `error` has the error of
    the last frame.

    Raises:
        traitlets.TraitError: A value that a trait cannot have, such as a center that is not finite.

    Example:
        >>> view = ds.view("von_mises", tip=1, zoom=1e6, norm="log")
        >>> view.center == ds.tips[1].xy
        True
        >>> view.quantity = "(s1 - s2)/2"
        >>> view.figure().png()[1:4]
        b'PNG'
    """

    _esm = Path(__file__).parent / "widget.js"
    _offers = traitlets.Dict().tag(sync=True)
    height = traitlets.Int(480, min=40, max=4000).tag(sync=True)

    center = traitlets.Tuple(traitlets.CFloat(), traitlets.CFloat())
    width = traitlets.CFloat(1.0)
    quantity = traitlets.Unicode()
    clim = traitlets.Any("auto")
    norm = traitlets.Enum(_NORMS, "linear")
    cmap = traitlets.Unicode("auto")
    step = traitlets.Int(0)
    cracks = traitlets.Bool(True)
    deformed = traitlets.Any(None, allow_none=True)
    error = traitlets.Unicode("")

    #: An image for pages without a kernel.
    _still = traitlets.Bytes(b"").tag(sync=True)

    @takes(ViewerOptions, "view()")
    def __init__(self, field: "Field", quantity: str | None = None, **options: Unpack[ViewerOptions]) -> None:
        # counts what is seen; views in browsers ask for a frame if it is not the one that they show
        self._version, self._is_answering = 0, False
        #: The field; its step is that of `step`.
        self.field = field
        self._other = lru_cache(KEPT)(field._at_step)
        # what the center has beyond double precision
        self._rest = (0.0, 0.0)
        # the last range that was found, for frames of moving views
        self._held: tuple[float, float] | None = None
        # of the last frame
        self._size = (4, 3)
        seen = field._place(options, self._size)
        view = seen or self._whole()
        name = quantity or field._core.default_quantity()
        own: dict[str, Any] = {key: options[key] for key in ("norm", "deformed", "cracks", "height")}
        own["cmap"] = "auto" if options["cmap"] is None else colormap(options["cmap"])
        own["clim"] = _clim(field, name, options, view)
        place = {"center": view.center, "width": view.width, "step": field._number}
        super().__init__(quantity=name, **place, **own, _offers=_offers(field))
        # whether all of the plate is shown, which then fits into the page however that changes
        self._is_whole = seen is None
        self.on_msg(self._hear)

    @traitlets.validate("center", "width")
    def _finite(self, proposal: Any) -> Any:
        name, value = proposal["trait"].name, proposal["value"]
        if not np.isfinite(value).all() or name == "width" and value <= 0:
            needed = "two finite numbers" if name == "center" else "a positive length"
            raise traitlets.TraitError(f"{name}: {value} is not {needed}")
        return value

    @traitlets.validate("step")
    def _known_step(self, proposal: Any) -> Any:
        try:
            return self.field.dataset.steps[proposal["value"]].number
        except IndexError as error:
            raise traitlets.TraitError(f"step: {error}") from None

    @traitlets.validate("clim")
    def _known_clim(self, proposal: Any) -> Any:
        try:
            return span({"clim": proposal["value"]})
        except ValueError as error:
            raise traitlets.TraitError(str(error)) from None

    @traitlets.observe("center", "width", *_LOOK)
    def _changed(self, change: Any) -> None:
        if change["name"] in _LOOK:
            self._held = None
        else:
            self._is_whole = False
        if change["name"] == "center":
            self._rest = (0.0, 0.0)
        self._version += 1
        if not self._is_answering:
            self.send({"version": self._version})

    @property
    def view(self) -> View:
        """Current view, for `field.draw.figure` and all that take a `view`."""
        return View(self.center, self.width, self._size)

    def home(self) -> None:
        """Show all of the plate."""
        self._show(self._whole())
        self._is_whole = True

    def go_to_tip(self, tip: int, zoom: float = ZOOM) -> None:
        """Show a tip, enlarged `zoom` times."""
        self._show(self._at_step()._seen({"tip": tip, "zoom": zoom, "size": self._size}))

    def _show(self, view: View) -> None:
        self.center, self.width = view.center, view.width

    def _whole(self) -> View:
        view = view_at(self.field.dataset.domain, self._size)
        return replace(view, width=MARGIN * view.width)

    @passes(FigureOptions)
    def figure(self, **options: Unpack[FigureOptions]) -> Figure:
        """Make a figure of the current view, with its options where none are given.

        Example:
            >>> ds.view("ux", tip=1, zoom=4).figure(theme="dark")
            <ppum.Figure ux, 1024x768>
        """
        own: Any = self._look()
        if {"vmin", "vmax"} & options.keys():
            del own["clim"]
        if not PlaceOptions.__annotations__.keys() & options.keys():
            own["view"] = self.view
        return self._at_step().draw.figure(self.quantity, **{**own, **options})

    def _look(self) -> dict[str, Any]:
        cmap, overlays = None if self.cmap == "auto" else self.cmap, ["cracks"] if self.cracks else []
        return {"cmap": cmap, "norm": self.norm, "clim": self.clim, "overlays": overlays, "deformed": self.deformed}

    def _at_step(self) -> "Field":
        return self.field if self.step == self.field._number else self._other(self.step)

    def _hear(self, _: Any, content: Any, buffers: Any) -> None:
        """Answer a message of the browser: all views hear it, and ask for their own."""
        if not isinstance(content, Mapping) or "from" not in content:
            return
        self._is_answering = True
        try:
            answer, parts = self._answer(content)
        finally:
            self._is_answering = False
        self.send({"to": content["from"], "version": self._version, **answer}, parts)

    def _answer(self, content: Mapping[str, Any]) -> tuple[dict[str, Any], list[bytes]]:
        try:
            size = _size(content["size"])
            if "probe" in content:
                return {"kind": "probe", "text": self._probed(content["probe"], size)}, []
            self._size = size
            if content.get("fit") and self._is_whole:
                self.home()
            self._obey(content, size)
            png, facts = self._frame(size, bool(content.get("moving")))
            self.error = ""
            colors = bytes(facts.pop("colors"))
            return {"kind": "frame", "bar": facts, **self._controls()}, [png, colors]
        except (PpumError, traitlets.TraitError, ValueError, TypeError, KeyError, IndexError) as error:
            self.error = str(error)
            return {"kind": "error", "error": self.error, **self._controls()}, []

    def _obey(self, content: Mapping[str, Any], size: tuple[int, int]) -> None:
        for name, value in dict(content.get("set") or {}).items():
            if name in _SETTABLE:
                setattr(self, name, value)
        if content.get("home"):
            self.home()
        if content.get("tip") is not None:
            self.go_to_tip(int(content["tip"]))
        if content.get("move"):
            k, x, y = (float(number) for number in content["move"])
            self._move(k, x, y, size)

    def _move(self, k: float, x: float, y: float, size: tuple[int, int]) -> None:
        """Move pixel p of the view to k p + (x, y)."""
        if not (k > 0 and all(map(math.isfinite, (k, x, y)))):
            raise ValueError("a move is a positive factor and two finite numbers")
        asked, width = k, self.width
        k = width / min(max(width / k, self._least()), FARTHEST * self._whole().width)
        if k != asked:
            x, y = ((1 - k) / (1 - asked) * v if asked != 1 else v for v in (x, y))
        pixel, (columns, rows) = width / size[0], size
        dx = (0.5 * columns - x) / k - 0.5 * columns
        dy = 0.5 * rows - (0.5 * rows - y) / k
        pairs = [_sum(a, b, d * pixel) for a, b, d in zip(self.center, self._rest, (dx, dy), strict=True)]
        self.center, self.width = tuple(high for high, _ in pairs), width / k
        self._rest = tuple(low for _, low in pairs)  # type: ignore[assignment]

    def _least(self) -> float:
        x, y = self.center
        return float(max(FINEST * abs(x), FINEST * abs(y), SMALLEST))

    def _frame(self, size: tuple[int, int], moving: bool) -> tuple[bytes, dict[str, Any]]:
        """Return the bytes of a PNG, and the texts of the colour bar."""
        look = self._look()
        is_found = isinstance(self.clim, str)
        if moving and is_found and self._held:
            look["clim"] = self._held
        field, view = self._at_step(), replace(self.view, size=size)
        png, facts = _core.frame(field._core, request(field, self.quantity, look, view), view)  # type: ignore[arg-type]
        self._held = facts["range"] if is_found else None
        return png, facts

    def _controls(self) -> dict[str, Any]:
        place = f"({self.center[0]:.9g}, {self.center[1]:.9g}), {self.width:.3g} wide"
        return {"state": {name: getattr(self, name) for name in _SETTABLE}, "place": place}

    def _probed(self, pixel: Any, size: tuple[int, int]) -> str:
        """Return values under the mouse in words: near a crack of its faces, of a deformed plate at the point that moved there."""
        x, y, factor = float(pixel[0]), float(pixel[1]), None if self.deformed is None else str(self.deformed)
        view = replace(self.view, size=size)
        place, found = _core.probe(self._at_step()._core, self.quantity, view, (x, y), REACH, factor)
        if found is None:
            return f"{_place(place)}: the deformed plate is not here"
        point, values, count = found
        if len(values) == 2 and factor is None:
            return f"{_place(place)}: {values[0]:.9g} above, {values[1]:.9g} below the crack"
        text = f"{_place(place)}: {values[0]:.9g}"
        if factor is not None:
            text += f", moved from {_place(point)}"
        return text + (f", over {plural(count - 1, 'more point')} of the plate" if count > 1 else "")

    def _repr_mimebundle_(self, **options: Any) -> Any:
        """Return the widget, and an image for pages without a kernel; these show `_still` with the widget's state.

        Where a program runs the notebook the image is alone: nobody could touch the widget, whose code is on the network.
        """
        try:
            self._still = self.figure(size=(640, 480)).png()
        except (PpumError, ValueError) as error:
            self.error, self._still = str(error), b""
        bundle = super()._repr_mimebundle_(**options)
        data, metadata = bundle if isinstance(bundle, tuple) else (dict(bundle or {}), {})
        if self._still:
            data["image/png"] = base64.b64encode(self._still).decode()
            if _is_unattended():
                data = {name: data[name] for name in ("image/png", "text/plain") if name in data}
        return data, metadata

    def __repr__(self) -> str:
        return f"<ppum view of {self.quantity} around {self.center}, {self.width:g} wide>"


def _is_unattended() -> bool:
    """Return whether a program runs the notebook, such as `jupyter nbconvert --execute`, and not Voilà for its widgets."""
    shell = sys.modules["IPython"].get_ipython() if "IPython" in sys.modules else None
    answers = getattr(getattr(shell, "kernel", None), "_allow_stdin", True)
    return not answers and "voila" not in os.environ.get("SERVER_SOFTWARE", "").lower()


def _offers(field: "Field") -> dict[str, Any]:
    tips = [f"tip {k}" for k in range(len(field.step.tips))]
    steps = len(field.dataset.steps) if len(field.dataset.steps) > 1 else 0
    return {"quantities": list(field.quantities), "cmaps": ["auto", *_core.colormaps()], "tips": tips, "steps": steps}


def _place(point: Sequence[float]) -> str:
    return f"x = {point[0]:.12g}, y = {point[1]:.12g}"


def _clim(field: "Field", quantity: str, options: ViewerOptions, view: View) -> Any:
    """Return the range that options say; an end that they leave is that of an automatic one."""
    found = span(options)
    if isinstance(found, str) or None not in found:
        return found
    made = request(field, quantity, options, view)
    return tuple(float(end) for end in made["colors"]["range"].split(","))


def _size(size: Any) -> tuple[int, int]:
    columns, rows = (int(n) for n in size)
    if columns < 1 or rows < 1 or columns * rows > MOST_PIXELS:
        raise ValueError(f"a frame of {columns}x{rows} pixels")
    return columns, rows


def _sum(high: float, low: float, more: float) -> tuple[float, float]:
    """Return high + low + more as a number and what it lacks of the sum (Knuth's sum of two)."""
    total = high + more
    part = total - high
    lacks = (high - (total - part)) + (more - part) + low
    again = total + lacks
    return again, lacks - (again - total)

