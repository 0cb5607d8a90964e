"""How images look: their options, and what the libraries read of them."""

import json
import math
import os
import re
from collections.abc import Iterable, Mapping, Sequence
from typing import TYPE_CHECKING, Annotated, Any, Literal, TypedDict

import numpy as np

from . import _core
from ._options import Option, options_of, refuse_unknown
from ._text import plain
from ._units import pixels
from ._views import SIZE, PixelOptions, PlaceOptions, ProgressOptions, Window, window

if TYPE_CHECKING:
    from ._field import Field

Clim = Literal["auto", "full"] | Sequence[float] | tuple[str, str]
Norm = Literal["linear", "log", "symlog"]
Levels = Literal["auto"] | float | Sequence[float]
Overlay = Literal["cracks", "cells", "patches", "boxes", "points", "centers", "rings", "supports", "loads"]

#: The ends of a range, one of which may be left to be found.
Ends = tuple[float | str | None, float | str | None]


def _colormap(cmap: Any) -> str:
    if not isinstance(cmap, (str, os.PathLike)):
        raise TypeError(
            f"cmap: a name such as 'viridis', or the path of a table of colours, is needed, not {type(cmap).__name__}; maps of "
            "matplotlib are for `field.draw.plot`"
        )
    return str(os.fspath(cmap))


def _list(given: str | Sequence[str]) -> list[str]:
    return [given] if isinstance(given, str) else list(given)


def _layout(layout: tuple[int, int]) -> tuple[int, int]:
    return pixels(layout, "layout")


def _mirror(asked: bool | str) -> str | None:
    """The edges at which a body is mirrored."""
    return asked if isinstance(asked, str) else "auto" if asked else None


def _bar(asked: bool | str) -> str | None:
    return asked if isinstance(asked, str) else None if asked else "none"


def _inches(inches: Any) -> str:
    """A size on paper."""
    try:
        sides = [float(side) for side in np.atleast_1d(inches)]
    except (TypeError, ValueError):
        sides = []
    if len(sides) not in (1, 2) or not all(0 < side < math.inf for side in sides):
        raise ValueError(f"inches: {inches!r} is not a size; give a width, or a width and a height")
    return "x".join(map(repr, sides))


def _color(color: Any) -> str:
    """A colour as `#rrggbb`; names and numbers are those of matplotlib."""
    if isinstance(color, str) and re.fullmatch("#[0-9a-fA-F]{6}", color):
        return color
    try:
        from matplotlib.colors import to_hex
    except ImportError:
        raise ValueError(f"nan_color: {color!r} is not '#rrggbb'; other colours need matplotlib") from None
    try:
        return str(to_hex(color))
    except ValueError:
        raise ValueError(f"nan_color: {color!r} is no colour; give '#rrggbb' or one of matplotlib") from None


def _levels(isolines: Any) -> str:
    if isinstance(isolines, Iterable) and not isinstance(isolines, str):
        return ",".join(repr(float(level)) for level in isolines) + ","
    return str(isolines)


class Labels(TypedDict, total=False):
    """Texts in place of those of a figure; an empty one removes the label."""

    title: str
    x: str
    y: str
    colorbar: str


class Ticks(TypedDict, total=False):
    """Ticks in place of those of a figure: `auto`, about how many, or at these values."""

    x: Levels
    y: Levels
    colorbar: Levels


def _ticks(ticks: Mapping[str, Any]) -> list[str]:
    refuse_unknown("ticks", ticks, Ticks.__annotations__)
    return [f"{'bar' if name == 'colorbar' else name}={_levels(marks)}" for name, marks in ticks.items()]


def _labels(labels: Mapping[str, str]) -> dict[str, str]:
    refuse_unknown("labels", labels, Labels.__annotations__)
    return {"bar" if name == "colorbar" else name: text for name, text in labels.items()}


LABELS = "texts in place of those of the figure: a dictionary of title, x, y, colorbar"
PARTS = "parts of the field, each in a panel: those of `Field.part`, and `all`, the whole field"


class RangeOptions(TypedDict, total=False):
    """The values that colours span."""

    clim: Annotated[Clim, Option("auto")]
    vmin: Annotated[float | None, Option(None, "the lower end of `clim` alone")]
    vmax: Annotated[float | None, Option(None, "the upper end of `clim` alone")]


class ColorOptions(RangeOptions, total=False):
    """Colours, and the deformed plate."""

    cmap: Annotated[str | os.PathLike[str] | None, Option(None, at="colors.colormap", written=_colormap)]
    norm: Annotated[Norm, Option("linear", at="colors.scale")]
    deformed: Annotated[Literal["auto"] | float | None, Option(None, at="deformed", written=str)]


class SceneOptions(ColorOptions, total=False):
    """What an image shows."""

    bands: Annotated[int | None, Option(None, at="colors.bands")]
    symmetric: Annotated[bool, Option(False, at="colors.symmetric")]
    nan_color: Annotated[Any, Option(None, more="or a colour of matplotlib", at="colors.nan_color", written=_color)]
    contrast: Annotated[bool, Option(False, at="colors.contrast")]
    overlays: Annotated[Overlay | Sequence[Overlay], Option((), at="overlays.shown", written=_list)]
    no_cracks: Annotated[bool, Option(False, at="overlays.no_cracks")]
    isolines: Annotated[Levels | None, Option(None, at="overlays.isolines", written=_levels)]
    level_labels: Annotated[bool, Option(False, at="overlays.level_labels")]
    arrows: Annotated[float | None, Option(None, at="overlays.arrows")]
    crosses: Annotated[float | None, Option(None, at="overlays.crosses")]
    outline: Annotated[bool, Option(False, at="outline")]


class HtmlOptions(PlaceOptions, SceneOptions, total=False):
    """What a page shows first."""


class ComputedOptions(SceneOptions, total=False):
    """What an image shows, and how it is computed."""

    mirror: Annotated[bool | str, Option(False, more="``True`` is auto", at="mirror", written=_mirror)]
    samples: Annotated[int, Option(1, at="samples")]
    precision: Annotated[Literal["f64", "f32"] | None, Option(None, at="precision")]
    blank: Annotated[bool, Option(False, at="blank")]


class PageOptions(TypedDict, total=False):
    """The page of a figure."""

    size: Annotated[tuple[int, int] | None, Option(None, at="look.size", written=pixels)]
    inches: Annotated[float | tuple[float, float] | None, Option(None, at="look.inches", written=_inches)]
    dpi: Annotated[float | None, Option(None, at="look.dpi")]
    font_size: Annotated[float | None, Option(None, at="look.font_size")]
    theme: Annotated[Literal["light", "dark"], Option("light", at="look.theme")]
    transparent: Annotated[bool, Option(False, at="look.transparent")]
    colorbar: Annotated[bool | Literal["right", "bottom"], Option(True, at="look.bar", written=_bar)]
    ticks: Annotated[Ticks, Option({}, more="a dictionary of x, y, colorbar", at="look.ticks", written=_ticks)]
    labels: Annotated[Labels, Option({}, LABELS, at="labels", written=_labels)]


class AnimationOptions(PlaceOptions, ComputedOptions, PageOptions, total=False):
    """What an animation and a figure show, and their pages."""


class SeriesOptions(AnimationOptions, ProgressOptions, total=False):
    """All options of an animation and of its steps."""

    steps: Annotated[Sequence[int] | slice | None, Option(None, "numbers of steps, or a slice of them; by default all")]
    fps: Annotated[float, Option(5.0, "steps shown in a second, up to 50")]
    bare: Annotated[bool, Option(False, "whether axes and colour bar are left out: the image has the size in pixels")]


class FigureOptions(AnimationOptions, total=False):
    """All options of a figure."""

    parts: Annotated[Sequence[str] | None, Option(None, PARTS, at="panels.parts", written=list)]
    layout: Annotated[tuple[int, int] | None, Option(None, at="panels.layout", written=_layout)]
    shared_range: Annotated[bool, Option(False, at="panels.shared_range")]


class ImageOptions(PixelOptions, ComputedOptions, total=False):
    """All options of an image without a page."""


class ViewerOptions(PlaceOptions, ColorOptions, total=False):
    """What is seen first, and the traits of a `Viewer`."""

    cracks: Annotated[bool, Option(True, "whether cracks are drawn")]
    height: Annotated[int, Option(480, "of the image on the page, pixels")]


class PlotOptions(PlaceOptions, RangeOptions, total=False):
    """Options of matplotlib; the range of colours is that of a figure of all of the plate."""

    ax: Annotated[Any, Option(None, "axes; by default the current ones, which get equal scales")]
    cmap: Annotated[Any, Option(None, "a map of matplotlib or of `ppum.COLORMAPS`")]
    norm: Annotated[Any, Option(None, "a norm of matplotlib, or its name")]
    colorbar: Annotated[bool | Literal["right", "bottom"], Option(True, "whether there is a colour bar, and where")]
    cracks: Annotated[bool, Option(True, "whether cracks and rims of holes are drawn")]
    nan_color: Annotated[Any, Option(None, "the colour of points of the plate that have no value")]
    alpha: Annotated[float | None, Option(None, "opacity")]
    zorder: Annotated[float, Option(0, "the order in which artists are drawn")]
    label: Annotated[str, Option("", "the name of the artist")]
    visible: Annotated[bool, Option(True, "whether it is drawn")]
    rasterized: Annotated[bool | None, Option(None, "whether pixels are drawn in vector files")]
    gid: Annotated[str | None, Option(None, "its name in SVG files")]


#: The options that stand in requests.
REQUEST_OPTIONS = {name: option for name, (_, option) in options_of(FigureOptions).items() if option.at}


def span(options: RangeOptions) -> str | Ends:
    """The range of the colours, as `clim` or `vmin` and `vmax` say it; an end that is not given is None."""
    clim, low, high = options.get("clim", "auto"), options.get("vmin"), options.get("vmax")
    if low is not None or high is not None:
        if not (isinstance(clim, str) and clim == "auto"):
            raise TypeError("give `clim`, or `vmin` and `vmax`, not both")
        return _ends(low, high)
    if isinstance(clim, str):
        if clim in ("auto", "full"):
            return clim
        raise ValueError(f"clim: {clim!r} is not a range; give 'auto', 'full', two values or two percentiles")
    ends: Any = list(clim) if isinstance(clim, Iterable) else []
    if len(ends) != 2 or None in ends:
        raise ValueError(f"clim: {clim!r} is not a range; give the lower and the upper value")
    return _ends(*ends)


def _ends(low: Any, high: Any) -> Ends:
    if isinstance(low, str) and isinstance(high, str):
        return low, high
    try:
        low, high = (None if end is None else float(end) for end in (low, high))
    except (TypeError, ValueError):
        raise ValueError(f"clim: {low!r} and {high!r} are not two values") from None
    if not all(end is None or math.isfinite(end) for end in (low, high)):
        raise ValueError(f"clim: from {low} to {high} is not a range; give finite values")
    if low is not None and high is not None and not low < high:
        raise ValueError(f"clim: from {low} to {high} is not a range; give the smaller value first")
    return low, high


def quantities(asked: str | Sequence[str] | None) -> tuple[str | None, list[str]]:
    """The quantity of an image, and those of panels where there are several."""
    if asked is None or isinstance(asked, str):
        return asked, []
    several = list(asked)
    if not several:
        raise ValueError("quantity: give one at least, or None for the one that suits")
    return (several[0], []) if len(several) == 1 else (None, several)


def request(
    field: "Field",
    asked: str | Sequence[str] | None,
    options: ColorOptions,
    at: Window | None,
    *,
    may_find: bool = True,
) -> dict[str, Any]:
    """What an image is asked for, as the libraries read it; what is not given is left out. An end of the range that is not
    given is that of an automatic one."""
    made: dict[str, Any] = {"colors": {}, "panels": {}}
    for name, option in REQUEST_OPTIONS.items():
        if (value := options.get(name)) is not None:
            *group, key = option.at.split(".")
            inner = made.setdefault(group[0], {}) if group else made
            inner[key] = option.written(value) if option.written else value
    made["quantity"], made["panels"]["quantities"] = quantities(asked)
    found = span(options)
    if not isinstance(found, str) and None in found:
        if not may_find:
            raise ValueError("give both vmin and vmax: the range is that of all panels or steps")
        ends = _core.frame(field._core, to_json(made), at or window(field.dataset.domain, SIZE), SIZE)[1]["range"]
        found = _ends(*(end if given is None else given for given, end in zip(found, ends, strict=True)))
    made["colors"]["range"] = found if isinstance(found, str) else ",".join(map(str, found))
    return made


def to_json(made: Mapping[str, Any]) -> str:
    """The text of a request."""
    return json.dumps(plain(made, "image"))


def request_text(field: "Field", made: Mapping[str, Any]) -> str:
    """The text of a request that the field can be drawn by."""
    text = to_json(made)
    _core.check_request(field._core, text)
    return text
