"""Views in notebooks: fields that follow the mouse, exact in every frame.

A view draws where the field is, in this process; the browser gets finished pixels, without loss, and sends what the mouse
does. At most two frames are on their way at a time and what happens in between becomes one, so nothing piles up. Needs anywidget.
"""

import base64
import math
import os
import sys
from collections.abc import Mapping
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
from ._styles import FigureOptions, Norm, ViewerOptions, request, span, to_json
from ._views import PlaceOptions, View, Window, window

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
    """Shows a field in a notebook; made by `Dataset.view` and `Field.view`. What is seen at the moment is its `view`, a `View`.

    Drag to pan, turn the wheel to zoom about the mouse, point to read values: near a crack those of both faces. With the
    image in focus the arrows, ``+``, ``-`` and ``0`` do the same. All that is shown are traits, to be read, set and observed.

    The traits `center`, `width`, `quantity`, `step`, `clim`, `norm`, `cmap`, `cracks`, `deformed` and `height` are the options
    that it is made by; a cmap of None is ``auto`` here. `error` says what is wrong with the last frame, if anything.

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
        center, width = seen or self._whole()
        name = quantity or field._core.default_quantity()
        super().__init__(
            center=center,
            width=width,
            quantity=name,
            clim=_clim(field, name, options, (center, width)),
            norm=options["norm"],
            cmap="auto" if options["cmap"] is None else os.fspath(options["cmap"]),
            deformed=options["deformed"],
            cracks=options["cracks"],
            height=options["height"],
            step=field._number,
            _offers=_offers(field),
        )
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
        """What is seen at the moment, for `field.draw.figure` and all that take a `view`."""
        return View(self.center, self.width, self._size)

    def home(self) -> None:
        """Shows all of the plate."""
        self.center, self.width = self._whole()
        self._is_whole = True

    def _whole(self) -> tuple[tuple[float, float], float]:
        center, width = window(self.field.dataset.domain, self._size)
        return center, MARGIN * width

    def go_to_tip(self, tip: int, zoom: float = 10.0) -> None:
        """Shows a tip, enlarged `zoom` times."""
        self.center, self.width = self._at_step()._window(self._size, {"tip": tip, "zoom": zoom})

    @passes(FigureOptions)
    def figure(self, **options: Unpack[FigureOptions]) -> Figure:
        """A figure of what is seen; what is not given is as in the view.

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
        """Answers a message of the browser: a frame, or what is under the mouse. All views hear it, and ask for their own."""
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
        """Pixel p of what is seen goes to k p + (x, y)."""
        if not (k > 0 and all(map(math.isfinite, (k, x, y)))):
            raise ValueError("a move is a positive factor and two finite numbers")
        asked, width = k, self.width
        k = width / min(max(width / k, self._least()), FARTHEST * self._whole()[1])
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
        """The bytes of a PNG, and what the colour bar says."""
        look = self._look()
        is_found = isinstance(self.clim, str)
        if moving and is_found and self._held:
            look["clim"] = self._held
        field, seen = self._at_step(), (self.center, self.width)
        made = to_json(request(field, self.quantity, look, seen))  # type: ignore[arg-type]
        png, facts = _core.frame(field._core, made, seen, size)
        self._held = facts["range"] if is_found else None
        return png, facts

    def _controls(self) -> dict[str, Any]:
        """What the controls show."""
        place = f"({self.center[0]:.9g}, {self.center[1]:.9g}), {self.width:.3g} wide"
        return {"state": {name: getattr(self, name) for name in _SETTABLE}, "place": place}

    def _probed(self, pixel: Any, size: tuple[int, int]) -> str:
        """Values under the mouse, near a crack those of its faces, in words."""
        side = self.width / size[0]
        offset = np.array([float(pixel[0]) - 0.5 * size[0], 0.5 * size[1] - float(pixel[1])]) * side
        anchor = np.array(self.center)
        near = None if self.deformed is not None else _nearest(self._at_step(), anchor, offset, REACH * side)
        anchor, offset = near or (anchor, offset)
        x, y = anchor + offset
        place = f"x = {x:.12g}, y = {y:.12g}"
        if self.deformed is not None:
            return f"{place}: {self._on_deformed((x, y), side)}"
        if near is None or not self._at_step()._is_quantity(self.quantity):
            return f"{place}: {self._value(anchor, offset, side):.9g}"
        above, below = self._at_step().at(*offset, anchor=anchor, side="both")[self.quantity]
        return f"{place}: {above:.9g} above, {below:.9g} below the crack"

    def _on_deformed(self, place: tuple[float, float], side: float) -> str:
        """What a pixel of the deformed plate shows: the value, and where that point of the plate was before."""
        found = _core.material(self._at_step()._core, str(self.deformed), (place, side))
        if found is None:
            return "the deformed plate is not here"
        anchor, offset = np.array(found["anchor"]), np.array(found["offset"])
        x, y = anchor + offset
        text = f"{self._value(anchor, offset, side):.9g}, moved from x = {x:.12g}, y = {y:.12g}"
        others = found["count"] - 1
        return f"{text}, over {others} more point{'s' if others > 1 else ''} of the plate" if others else text

    def _value(self, anchor: Any, offset: Any, side: float) -> float:
        """The quantity at a point; of cells that of the cell."""
        field = self._at_step()
        if not field._is_quantity(self.quantity):
            return float(field.draw.render(self.quantity, center=anchor + offset, width=side, size=(1, 1))[0, 0])
        return float(field.at(*offset, anchor=anchor)[self.quantity])

    def _repr_mimebundle_(self, **options: Any) -> Any:
        """The widget, and an image for where there is no kernel: pages with the widget's state show `_still`. Where a program
        runs the notebook the image is alone: nobody could touch the widget, whose code would come from the network."""
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
    """Whether a program runs the notebook, such as `jupyter nbconvert --execute`: it answers no questions. Voilà does
    neither, but shows the widgets of its notebooks."""
    shell = sys.modules["IPython"].get_ipython() if "IPython" in sys.modules else None
    answers = getattr(getattr(shell, "kernel", None), "_allow_stdin", True)
    return not answers and "voila" not in os.environ.get("SERVER_SOFTWARE", "").lower()


def _offers(field: "Field") -> dict[str, Any]:
    tips = [f"tip {k}" for k in range(len(field.step.tips))]
    steps = len(field.dataset.steps) if len(field.dataset.steps) > 1 else 0
    return {"quantities": list(field.quantities), "cmaps": ["auto", *_core.colormaps()], "tips": tips, "steps": steps}


def _clim(field: "Field", quantity: str, options: ViewerOptions, at: Window) -> Any:
    """The range that options say; an end that they leave is that of an automatic one."""
    found = span(options)
    if isinstance(found, str) or None not in found:
        return found
    made = request(field, quantity, options, at)
    return tuple(float(end) for end in made["colors"]["range"].split(","))


def _size(size: Any) -> tuple[int, int]:
    columns, rows = (int(n) for n in size)
    if columns < 1 or rows < 1 or columns * rows > MOST_PIXELS:
        raise ValueError(f"a frame of {columns}x{rows} pixels")
    return columns, rows


def _sum(high: float, low: float, more: float) -> tuple[float, float]:
    """high + low + more as a number and what it lacks of the sum (Knuth's sum of two)."""
    total = high + more
    part = total - high
    lacks = (high - (total - part)) + (more - part) + low
    again = total + lacks
    return again, lacks - (again - total)


def _nearest(field: "Field", anchor: Any, offset: Any, reach: float) -> Any:
    """The point of a crack within reach, as an offset from the nearer vertex of its segment, not rounded; None without."""
    found = None
    for crack in field.step.cracks:
        for ends in zip(crack.points[:-1], crack.points[1:], strict=True):
            near, far = sorted(ends, key=lambda end: np.hypot(*(anchor - end + offset)))
            way, to = far - near, (anchor - near) + offset
            along = min(max(float(to @ way) / float(way @ way), 0.0), 1.0)
            distance = float(np.hypot(*(to - along * way)))
            if distance <= reach:
                found, reach = (near, along * way), distance
    return found
