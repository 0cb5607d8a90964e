"""What is seen of a plate, and figures."""

from __future__ import annotations

import json
from collections.abc import Iterable
from dataclasses import dataclass
from typing import Any

from . import _core
from .drawn import Drawn, Page

__all__ = ["Animation", "Extremum", "Figure", "View"]

Spot = tuple[tuple[float, float], float]


@dataclass(frozen=True)
class View:
    """The part of the plane that a picture shows.

    Attributes:
        center: The middle of the picture.
        width: From the left border to the right one, a length; down to 1e-12 of the plate.
        size: Columns and rows of pixels; they are squares, so the height follows.

    Example:
        >>> ppum.View(center=(0.0, 0.0), width=2.0, size=(400, 300)).height
        1.5
    """

    center: tuple[float, float]
    width: float
    size: tuple[int, int] = (1024, 768)

    @property
    def height(self) -> float:
        """From the lower border to the upper one."""
        return self.width * self.size[1] / self.size[0]

    @property
    def _spot(self) -> Spot:
        return (float(self.center[0]), float(self.center[1])), float(self.width)


@dataclass(frozen=True)
class Extremum:
    """An extreme value.

    Attributes:
        value: To about 1e-6 of its size; infinite at a singular point.
        xy: Its place.
        offset: The way there from the middle of the view, in all digits.
        on: What it lies on: ``inside``, ``border``, ``face``, ``rim``, ``interface``, ``singular``, ``pixel``,
            ``everywhere`` (one value but for rounding).
        side: Of a face, ``above`` or ``below``.
    """

    value: float
    xy: tuple[float, float]
    offset: tuple[float, float]
    on: str
    side: str | None


def spot(
    domain: tuple[tuple[float, float], tuple[float, float]],
    size: tuple[int, int],
    center: tuple[float, float] | None,
    width: float | None,
    zoom: float | None,
) -> Spot:
    """Center and width of a view, by default of all of the plate."""
    (x0, y0), (x1, y1) = domain
    whole = max(x1 - x0, (y1 - y0) * size[0] / max(size[1], 1))
    if width is not None and zoom is not None:
        raise ValueError("give a width or a zoom, not both")
    if center is None:
        center = (0.5 * x0 + 0.5 * x1, 0.5 * y0 + 0.5 * y1)
    elif width is None:
        zoom = zoom or 10.0
    return center, width if width is not None else whole / (zoom or 1.0)


def figure_scene(quantity: str | None, options: dict[str, Any]) -> str:
    """What a picture shows, as the libraries read it; takes what it knows out of the options, which are all then."""
    colors = {
        "colormap": options.pop("cmap", None),
        "range": _range(options.pop("clim", "auto")),
        "scale": options.pop("norm", "linear"),
        "contrast": bool(options.pop("contrast", False)),
        "bands": options.pop("bands", None),
        "symmetric": bool(options.pop("symmetric", False)),
    }
    isolines, deformed = options.pop("isolines", None), options.pop("deformed", None)
    overlays = {
        "shown": list(options.pop("overlays", ())),
        "isolines": None if isolines is None else _levels(isolines),
        "level_labels": bool(options.pop("level_labels", False)),
        "arrows": options.pop("arrows", None),
        "crosses": options.pop("crosses", None),
    }
    scene = {
        "quantity": quantity,
        "colors": colors,
        "overlays": overlays,
        "deformed": None if deformed is None else str(deformed),
        "outline": bool(options.pop("outline", False)),
        "samples": int(options.pop("samples", 1)),
        "blank": bool(options.pop("blank", False)),
        "labels": dict(options.pop("labels", {})),
        "precision": options.pop("precision", None),
    }
    if options:
        raise TypeError(f"no such option: {', '.join(sorted(options))}")
    return json.dumps(scene)


def figure_look(options: dict[str, Any]) -> dict[str, Any]:
    """The look of a figure; takes it out of the options."""
    theme = options.pop("theme", "light")
    if theme not in ("light", "dark"):
        raise ValueError(f"theme: {theme!r} is none; there are light, dark")
    return {
        "size": tuple(options.pop("size", (1024, 768))),
        "inches": options.pop("inches", None),
        "dpi": options.pop("dpi", None),
        "font_size": options.pop("font_size", None),
        "dark": theme == "dark",
        "transparent": bool(options.pop("transparent", False)),
        "bar": options.pop("bar", None),
    }


def _range(clim: Any) -> str:
    if isinstance(clim, str):
        return clim
    low, high = clim
    return f"{low},{high}" if isinstance(low, str) else f"{float(low)!r},{float(high)!r}"


def _levels(isolines: Any) -> str:
    if isinstance(isolines, Iterable) and not isinstance(isolines, str):
        return ",".join(repr(float(level)) for level in isolines) + ","
    return str(isolines)


class Figure(Page):
    """A figure; drawn when its bytes are asked for. Made by `Field.figure`. Notebooks show it."""

    def __init__(self, core: _core.Field, scene: str, spot: Spot | None, look: str) -> None:
        super().__init__()
        self._core, self._scene, self._spot, self._look = core, scene, spot, look

    def _draw(self, form: str) -> bytes:
        return self._told(_core.figure(self._core, self._scene, self._spot, self._look, form))

    def __repr__(self) -> str:
        size = json.loads(self._look)["size"]
        return f"<ppum.Figure {json.loads(self._scene)['quantity'] or 'of a field'}, {size[0]}x{size[1]}>"


class Animation(Drawn):
    """A moving picture; drawn when its bytes are asked for. Made by `Field.animate`. Notebooks show it.

    Its forms are ``gif``, in 256 colours, which is the default, and ``apng``, without loss.
    """

    _form = "gif"

    def __init__(
        self,
        core: _core.Field,
        dataset: _core.Dataset,
        what: tuple[str, str, list[int], Spot | None, tuple[int, int], str | None],
        milliseconds: int,
        progress: Any,
    ) -> None:
        super().__init__()
        self._core, self._dataset, self._what = core, dataset, what
        self._time, self._progress = milliseconds, progress

    def _draw(self, form: str) -> bytes:
        return self._told(
            _core.animation(self._core, self._dataset, *self._what, self._time, form, self._progress)
        )

    def gif(self) -> bytes:
        """In 256 colours, for programs that know no other."""
        return self.to_bytes("gif")

    def apng(self) -> bytes:
        """Without loss."""
        return self.to_bytes("apng")

    def _repr_png_(self) -> bytes:
        return self.apng()

    def __repr__(self) -> str:
        (columns, rows), steps = self._what[4], len(self._what[2])
        name = json.loads(self._what[1])["quantity"] or "a field"
        return f"<ppum.Animation of {name}, {steps} step{'s' if steps > 1 else ''}, {columns}x{rows}>"


def milliseconds(fps: float) -> int:
    """The time for which a picture is shown, where so many are shown in a second."""
    if not 1 / 60 <= fps <= 50:
        raise ValueError(f"fps: {fps} is no rate; give a number of steps a second, from 1/60 to 50")
    return int(1000 / fps + 0.5)


for _class in (Animation, Extremum, Figure, View):
    _class.__module__ = "ppum"
