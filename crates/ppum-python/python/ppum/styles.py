"""How pictures look: their options, and what the libraries read of them."""

from __future__ import annotations

import json
import math
import os
import re
from collections.abc import Iterable, Mapping, Sequence
from typing import Annotated, Any, Literal, TypedDict

import numpy as np

from .options import Option, refuse_unknown
from .views import PixelOptions, PlaceOptions, pixels

__all__ = [
    "AnimationOptions",
    "ColorOptions",
    "FigureOptions",
    "Labels",
    "Norm",
    "PlotOptions",
    "RangeOptions",
    "RgbaOptions",
    "SceneOptions",
    "Ticks",
    "ViewerOptions",
    "page",
    "plain",
    "quantities",
    "scene",
    "span",
]

Clim = Literal["auto", "full"] | Sequence[float] | tuple[str, str]
Norm = Literal["linear", "log", "symlog"]
Overlay = Literal[
    "cracks", "cells", "patches", "boxes", "points", "centers", "rings", "supports", "loads"
]

#: The ends of a range, one of which may be left to be found.
Ends = tuple[float | str | None, float | str | None]


class RangeOptions(TypedDict, total=False):
    """The values that colours span."""

    clim: Annotated[Clim, Option("auto")]
    vmin: Annotated[float | None, Option(None, "the lower end of `clim` alone")]
    vmax: Annotated[float | None, Option(None, "the upper end of `clim` alone")]


class ColorOptions(RangeOptions, total=False):
    """Colours, and the deformed plate."""

    cmap: Annotated[str | os.PathLike[str] | None, Option(None)]
    norm: Annotated[Norm, Option("linear")]
    deformed: Annotated[Literal["auto"] | float | None, Option(None)]


class SceneOptions(ColorOptions, total=False):
    """What a picture shows."""

    bands: Annotated[int | None, Option(None)]
    symmetric: Annotated[bool, Option(False)]
    nan_color: Annotated[Any, Option(None, more="or a colour of matplotlib")]
    contrast: Annotated[bool, Option(False)]
    overlays: Annotated[Overlay | Sequence[Overlay], Option(())]
    no_cracks: Annotated[bool, Option(False)]
    isolines: Annotated[Literal["auto"] | float | Sequence[float] | None, Option(None)]
    level_labels: Annotated[bool, Option(False)]
    arrows: Annotated[float | None, Option(None)]
    crosses: Annotated[float | None, Option(None)]
    outline: Annotated[bool, Option(False)]


class HtmlOptions(PlaceOptions, SceneOptions, total=False):
    """What a page shows first."""


class ImageOptions(SceneOptions, total=False):
    """What an image shows, and how it is computed."""

    mirror: Annotated[bool | str, Option(False, more="``True`` is auto")]
    samples: Annotated[int, Option(1)]
    precision: Annotated[Literal["f64", "f32"] | None, Option(None)]
    blank: Annotated[bool, Option(False)]


class Labels(TypedDict, total=False):
    """Texts in place of those of a figure; an empty one removes the label."""

    title: str
    x: str
    y: str
    colorbar: str


class Ticks(TypedDict, total=False):
    """Marks in place of those of a figure: `auto`, about how many, or at these values."""

    x: Literal["auto"] | float | Sequence[float]
    y: Literal["auto"] | float | Sequence[float]
    colorbar: Literal["auto"] | float | Sequence[float]


class PageOptions(TypedDict, total=False):
    """The page of a figure."""

    size: Annotated[tuple[int, int] | None, Option(None)]
    inches: Annotated[float | tuple[float, float] | None, Option(None)]
    dpi: Annotated[float | None, Option(None)]
    font_size: Annotated[float | None, Option(None)]
    theme: Annotated[Literal["light", "dark"], Option("light")]
    transparent: Annotated[bool, Option(False)]
    colorbar: Annotated[bool | Literal["right", "bottom"], Option(True)]
    ticks: Annotated[Ticks, Option({}, more="a dictionary of x, y, colorbar")]
    labels: Annotated[
        Labels, Option({}, "texts in place of those of the figure: a dictionary of title, x, y, colorbar")
    ]


class AnimationOptions(PlaceOptions, ImageOptions, PageOptions, total=False):
    """All options of an animation."""


class FigureOptions(AnimationOptions, total=False):
    """All options of a figure."""

    parts: Annotated[
        Sequence[str] | None,
        Option(None, "parts of the field, each in a panel: those of `Field.part`, and `all`, the whole field"),
    ]
    layout: Annotated[tuple[int, int] | None, Option(None)]
    shared_range: Annotated[bool, Option(False)]


class RgbaOptions(PixelOptions, ImageOptions, total=False):
    """All options of a picture without a page."""


class ViewerOptions(PlaceOptions, ColorOptions, total=False):
    """What is seen first, and the traits of a `Viewer`."""

    cracks: Annotated[bool, Option(True, "whether cracks are drawn")]
    height: Annotated[int, Option(480, "of the picture on the page, pixels")]


class PlotOptions(PlaceOptions, RangeOptions, total=False):
    """Options of `Field.plot`; percentiles of a range are those of a coarse picture of the plate, so `auto` is robust against tips."""

    ax: Annotated[Any, Option(None, "axes; by default the current ones, which get equal scales")]
    cmap: Annotated[Any, Option(None, "a map of matplotlib or of `ppum.COLORMAPS`")]
    norm: Annotated[Any, Option(None, "a norm of matplotlib, or its name")]
    colorbar: Annotated[
        bool | Literal["right", "bottom"], Option(True, "whether there is a colour bar, and where")
    ]
    cracks: Annotated[bool, Option(True, "whether cracks and rims of holes are drawn")]
    nan_color: Annotated[Any, Option(None, "the colour of points of the plate that have no value")]
    alpha: Annotated[float | None, Option(None, "opacity")]
    zorder: Annotated[float, Option(0, "the order in which artists are drawn")]
    label: Annotated[str, Option("", "the name of the artist")]
    visible: Annotated[bool, Option(True, "whether it is drawn")]
    rasterized: Annotated[bool | None, Option(None, "whether pixels are drawn in vector files")]
    gid: Annotated[str | None, Option(None, "its name in SVG files")]


def span(options: RangeOptions) -> str | Ends:
    """The range of the colours, as `clim` or `vmin` and `vmax` say it; an end that is not given is None.

    Raises:
        TypeError: Both ways at once.
        ValueError: No range.
    """
    clim, low, high = options.get("clim", "auto"), options.get("vmin"), options.get("vmax")
    if low is not None or high is not None:
        if not (isinstance(clim, str) and clim == "auto"):
            raise TypeError("give `clim`, or `vmin` and `vmax`, not both")
        return _ends(low, high)
    if isinstance(clim, str):
        if clim in ("auto", "full"):
            return clim
        raise ValueError(f"clim: {clim!r} is not a range; give 'auto', 'full', two values or two percentiles")
    if not _is_pair(clim) or None in clim:
        raise ValueError(f"clim: {clim!r} is not a range; give the lower and the upper value")
    return _ends(*clim)


def _is_pair(value: Any) -> bool:
    return isinstance(value, Iterable) and len(list(value)) == 2


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
    """The quantity of a picture, and those of panels where there are several."""
    if asked is None or isinstance(asked, str):
        return asked, []
    several = list(asked)
    if not several:
        raise ValueError("quantity: give one at least, or None for the one that suits")
    return (several[0], []) if len(several) == 1 else (None, several)


def scene(asked: str | Sequence[str] | None, options: ColorOptions, found: str | Ends) -> str:
    """What a picture shows in the range that was found for it, as the libraries read it."""
    o: Any = options
    quantity, several = quantities(asked)
    cmap, deformed = o.get("cmap"), o.get("deformed")
    overlays, isolines, layout = o.get("overlays", ()), o.get("isolines"), o.get("layout")
    return json.dumps(
        {
            "quantity": quantity,
            "panels": {
                "quantities": several,
                "parts": list(o.get("parts") or ()),
                "layout": None if layout is None else pixels(layout, "layout"),
                "shared_range": bool(o.get("shared_range", False)),
            },
            "colors": {
                "colormap": None if cmap is None else _colormap(cmap),
                "range": found if isinstance(found, str) else ",".join(map(_written, found)),
                "scale": o.get("norm", "linear"),
                "contrast": bool(o.get("contrast", False)),
                "bands": o.get("bands"),
                "symmetric": bool(o.get("symmetric", False)),
                "nan_color": _color(o.get("nan_color")),
            },
            "overlays": {
                "shown": [overlays] if isinstance(overlays, str) else list(overlays),
                "no_cracks": bool(o.get("no_cracks", False)),
                "isolines": None if isolines is None else _levels(isolines),
                "level_labels": bool(o.get("level_labels", False)),
                "arrows": o.get("arrows"),
                "crosses": o.get("crosses"),
            },
            "deformed": None if deformed is None else str(deformed),
            "outline": bool(o.get("outline", False)),
            "mirror": _mirror(o.get("mirror", False)),
            "samples": int(o.get("samples", 1)),
            "blank": bool(o.get("blank", False)),
            "labels": _labels(o.get("labels", {})),
            "precision": o.get("precision"),
        },
        default=plain,
    )


def _colormap(cmap: Any) -> str:
    if not isinstance(cmap, (str, os.PathLike)):
        raise TypeError(
            f"cmap: a name such as 'viridis', or the path of a table of colours, is needed, not {type(cmap).__name__}; maps of "
            "matplotlib are for `Field.plot`"
        )
    return str(os.fspath(cmap))


def _mirror(asked: bool | str) -> str | None:
    """The edges at which a body is mirrored, as the libraries read them."""
    if isinstance(asked, str):
        return asked
    return "auto" if asked else None


def page(options: PageOptions) -> dict[str, Any]:
    """The page of a figure, as the libraries read it."""
    bar: Any = options["colorbar"]
    size = options["size"]
    if size is not None and options["inches"] is not None:
        raise TypeError("give `size` or `inches`, not both")
    return {
        "size": None if size is None else pixels(size),
        "inches": _inches(options["inches"]),
        "dpi": options["dpi"],
        "font_size": options["font_size"],
        "theme": options["theme"],
        "transparent": bool(options["transparent"]),
        "bar": bar if isinstance(bar, str) else None if bar else "none",
        "ticks": _ticks(options["ticks"]),
    }


def _inches(inches: Any) -> str | None:
    """A size on paper as the libraries read it.

    Raises:
        ValueError: It is no size.
    """
    if inches is None:
        return None
    try:
        sides = [float(side) for side in np.atleast_1d(inches)]
    except (TypeError, ValueError):
        sides = []
    if len(sides) not in (1, 2) or not all(0 < side < math.inf for side in sides):
        raise ValueError(f"inches: {inches!r} is not a size; give a width, or a width and a height")
    return "x".join(map(repr, sides))


def _color(color: Any) -> str | None:
    """A colour as `#rrggbb`; names and numbers are those of matplotlib."""
    if color is None or isinstance(color, str) and re.fullmatch("#[0-9a-fA-F]{6}", color):
        return color
    try:
        from matplotlib.colors import to_hex
    except ImportError:
        raise ValueError(f"nan_color: {color!r} is not '#rrggbb'; other colours need matplotlib") from None
    try:
        return str(to_hex(color))
    except ValueError:
        raise ValueError(f"nan_color: {color!r} is no colour; give '#rrggbb' or one of matplotlib") from None


def plain(value: Any) -> Any:
    """What JSON has in place of a number of numpy."""
    return value.item()


def _written(end: Any) -> str:
    return end if isinstance(end, str) else repr(end)


def _levels(isolines: Any) -> str:
    if isinstance(isolines, Iterable) and not isinstance(isolines, str):
        return ",".join(repr(float(level)) for level in isolines) + ","
    return str(isolines)


def _ticks(ticks: Mapping[str, Any]) -> list[str]:
    refuse_unknown("ticks", ticks, Ticks.__annotations__)
    return [f"{'bar' if name == 'colorbar' else name}={_levels(marks)}" for name, marks in ticks.items()]


def _labels(labels: Mapping[str, str]) -> dict[str, str]:
    refuse_unknown("labels", labels, Labels.__annotations__)
    return {"bar" if name == "colorbar" else name: text for name, text in labels.items()}
