"""Options of images, and the requests that the libraries draw."""

import math
import os
import re
import sys
from collections.abc import Callable, Iterable, Mapping, Sequence
from functools import partial
from typing import TYPE_CHECKING, Annotated, Any, Literal, TypedDict

import numpy as np

from . import _core
from ._options import Option, options_of, refuse_unknown
from ._text import plain
from ._units import pixels
from ._views import SIZE, PixelOptions, PlaceOptions, ProgressOptions, View, view_at

if TYPE_CHECKING:
    from ._field import Field

Clim = Literal["auto", "full"] | Sequence[float] | tuple[str, str]
Norm = Literal["linear", "log", "symlog"]
Levels = Literal["auto"] | float | Sequence[float]
Overlay = Literal["cracks", "cells", "patches", "boxes", "points", "centers", "rings", "supports", "loads"]

#: The ends of a range, one of which may be left to be found.
Ends = tuple[float | str | None, float | str | None]


def colormap(cmap: Any) -> str:
    """Return a name, a path, or the colours of a map of matplotlib as the text of a table."""
    if isinstance(cmap, str) and cmap.removesuffix("_r") not in _core.colormaps() and not os.path.exists(cmap):
        maps: Any = getattr(sys.modules.get("matplotlib"), "colormaps", {})
        cmap = maps[cmap] if cmap in maps else cmap
    if callable(cmap) and hasattr(cmap, "N"):
        return "".join("{:.6f} {:.6f} {:.6f}\n".format(*color) for color in cmap(np.linspace(0, 1, 256))[:, :3])
    if not isinstance(cmap, (str, os.PathLike)):
        raise TypeError(
            "cmap: a name such as 'viridis', a map of matplotlib, or the path of a table of colours is needed, not "
            f"{type(cmap).__name__}"
        )
    return str(os.fspath(cmap))


def _list(given: str | Sequence[str]) -> list[str]:
    return [given] if isinstance(given, str) else list(given)


def _word(yes: str | None, no: str | None) -> Callable[[bool | str], str | None]:
    """Make the conversion of an option that is a word, True or False."""
    return lambda asked: asked if isinstance(asked, str) else yes if asked else no


def _mirror(asked: bool | str | None) -> str | None:
    return None if asked is None else _word("auto", "none")(asked)


def _inches(inches: Any) -> str:
    try:
        sides = [float(side) for side in np.atleast_1d(inches)]
    except (TypeError, ValueError):
        sides = []
    if len(sides) not in (1, 2) or not all(0 < side < math.inf for side in sides):
        raise ValueError(f"inches: {inches!r} is not a size; give a width, or a width and a height")
    return "x".join(map(repr, sides))


def _color(color: Any) -> str:
    """Return a colour as `#rrggbb`; names and numbers are those of matplotlib."""
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


def _labels(labels: Mapping[str, Any], what: str = "labels", kind: type = Labels) -> dict[str, Any]:
    refuse_unknown(what, labels, kind.__annotations__)
    return {"bar" if name == "colorbar" else name: text for name, text in labels.items()}


def _ticks(ticks: Mapping[str, Any]) -> list[str]:
    return [f"{name}={_levels(marks)}" for name, marks in _labels(ticks, "ticks", Ticks).items()]


LABELS = "texts in place of those of the figure: a dictionary of title, x, y, colorbar"
PARTS = "parts of the field, each in a panel: those of `Field.part`, and `all`, the whole field"


class RangeOptions(TypedDict, total=False):
    """The values that colours span."""

    clim: Annotated[Clim, Option("auto")]
    vmin: Annotated[float | None, Option(None, "the lower end of `clim` alone")]
    vmax: Annotated[float | None, Option(None, "the upper end of `clim` alone")]


class ColorOptions(RangeOptions, total=False):
    """Colours, and the deformed plate."""

    cmap: Annotated[Any, Option(None, more="or a map of matplotlib", at="colors.colormap", written=colormap)]
    norm: Annotated[Norm, Option("linear", at="colors.scale")]
    deformed: Annotated[Literal["auto"] | float | None, Option(None, at="deformed", written=str)]


class SceneOptions(ColorOptions, total=False):
    """The content of an image."""

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
    """The first view of a page for browsers."""


class ComputedOptions(SceneOptions, total=False):
    """The content of an image, and how it is computed."""

    mirror: Annotated[
        bool | str | None, Option(None, more="``True`` is auto, ``False`` none", at="mirror", written=_mirror)
    ]
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
    colorbar: Annotated[bool | Literal["right", "bottom"], Option(True, at="look.bar", written=_word(None, "none"))]
    ticks: Annotated[Ticks, Option({}, more="a dictionary of x, y, colorbar", at="look.ticks", written=_ticks)]
    labels: Annotated[Labels, Option({}, LABELS, at="labels", written=_labels)]


class AnimationOptions(PlaceOptions, ComputedOptions, PageOptions, total=False):
    """The content of an animation or a figure, and its page."""


class SeriesOptions(AnimationOptions, ProgressOptions, total=False):
    """All options of an animation and of its steps."""

    steps: Annotated[Sequence[int] | slice | None, Option(None, "numbers of steps, or a slice of them; by default all")]
    fps: Annotated[float, Option(5.0, "steps shown in a second, up to 50")]
    bare: Annotated[bool, Option(False, "whether axes and colour bar are left out: the image has the size in pixels")]


class FigureOptions(AnimationOptions, total=False):
    """All options of a figure."""

    parts: Annotated[Sequence[str] | None, Option(None, PARTS, at="panels.parts", written=list)]
    layout: Annotated[tuple[int, int] | None, Option(None, at="panels.layout", written=partial(pixels, name="layout"))]
    shared_range: Annotated[bool, Option(False, at="panels.shared_range")]


class ImageOptions(PixelOptions, ComputedOptions, total=False):
    """All options of an image without a page."""


class ViewerOptions(PlaceOptions, ColorOptions, total=False):
    """The first view, and the traits of a `Viewer`."""

    cracks: Annotated[bool, Option(True, "whether cracks are drawn")]
    height: Annotated[int, Option(480, "height of the image on the page, pixels")]


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
    """Return the range of the colours from `clim`, or `vmin` and `vmax`; an end that is not given is None."""
    ends: list[Any] = [options.get("vmin"), options.get("vmax")]
    clim = options.get("clim", "auto")
    is_auto = isinstance(clim, str) and clim == "auto"
    if ends != [None, None]:
        if not is_auto:
            raise TypeError("give `clim`, or `vmin` and `vmax`, not both")
        return _ends(*ends)
    if isinstance(clim, str) and clim in ("auto", "full"):
        return clim
    ends = list(clim) if isinstance(clim, Iterable) and not isinstance(clim, str) else []
    if len(ends) != 2 or None in ends:
        words = "give 'auto', 'full', two percentiles, or give the lower and the upper value"
        raise ValueError(f"clim: {clim!r} is not a range; {words}")
    return _ends(*ends)


def _ends(low: Any, high: Any) -> Ends:
    if isinstance(low, str) and isinstance(high, str):
        return low, high
    try:
        low, high = (None if end is None else float(end) for end in (low, high))
    except (TypeError, ValueError):
        raise ValueError(f"clim: {low!r} and {high!r} are not two values") from None
    known = [end for end in (low, high) if end is not None]
    if not all(map(math.isfinite, known)):
        raise ValueError(f"clim: from {low} to {high} is not a range; give finite values")
    if known != sorted(set(known)):
        raise ValueError(f"clim: from {low} to {high} is not a range; give the smaller value first")
    return low, high


def quantities(asked: str | Sequence[str] | None) -> tuple[str | None, list[str]]:
    """Return the quantity of an image, and those of panels if there are several."""
    if asked is None or isinstance(asked, str):
        return asked, []
    several = list(asked)
    if not several:
        raise ValueError("quantity: give one at least, or None for the one that suits")
    return (several[0], []) if len(several) == 1 else (None, several)


def request(
    field: "Field", asked: str | Sequence[str] | None, options: ColorOptions, at: View | None, *, may_find: bool = True
) -> dict[str, Any]:
    """Return the request for an image; an end of the range that is not given is that of an automatic one."""
    made: dict[str, Any] = {"colors": {}, "panels": {}}
    for name, option in REQUEST_OPTIONS.items():
        if (value := options.get(name)) is not None:
            *group, key = option.at.split(".")
            inner = made.setdefault(group[0], {}) if group else made
            inner[key] = option.written(value) if option.written else value
    made["quantity"], made["panels"]["quantities"] = quantities(asked)
    made, found = plain(made, "image"), span(options)
    if not isinstance(found, str) and None in found:
        if not may_find:
            raise ValueError("give both vmin and vmax: the range is that of all panels or steps")
        ends = _core.frame(field._core, made, at or view_at(field.dataset.domain, SIZE))[1]["range"]
        found = _ends(*(end if given is None else given for given, end in zip(found, ends, strict=True)))
    made["colors"]["range"] = found if isinstance(found, str) else ",".join(map(str, found))
    return made


def checked_request(field: "Field", made: dict[str, Any]) -> dict[str, Any]:
    """Return a request that the field can be drawn by."""
    _core.check_request(field._core, made)
    return made
