"""Fields in matplotlib, exact at every pixel of the device.

`plot` puts an artist into axes, which evaluates the field at the pixels that matplotlib draws: on screen, in a PNG of any
resolution, in a PDF, zoomed or not. Colour maps, norms, colour bars and masks are matplotlib's own. Axes know places as
double precision has them: below some 1e-12 of the coordinates use `field.draw.figure`.
"""

from typing import TYPE_CHECKING, Any, Unpack, get_args

import matplotlib
import numpy as np
from matplotlib.colors import ListedColormap, to_rgba
from matplotlib.image import AxesImage
from matplotlib.transforms import Bbox

from . import _core
from ._edges import polyline
from ._errors import QuantityError
from ._options import takes
from ._styles import Norm, PlotOptions, request
from ._text import math_text
from ._views import View, view_at

if TYPE_CHECKING:
    from ._field import Field

#: Longer side of the image that colours are chosen from, in pixels.
COARSE = 256

#: Columns of a view of the plate that places are counted in.
FINE = 1 << 20


@takes(PlotOptions)
def plot(field: "Field", quantity: str | None = None, **options: Unpack[PlotOptions]) -> "FieldImage":
    """Draw a quantity into axes, see `field.draw.plot`, and return the artist."""
    import matplotlib.pyplot as plt

    (x0, y0), (x1, y1) = field.dataset.domain
    # as wide and high as the plate, so that a zoom is counted from all of it
    shape = FINE, max(1, round(FINE * (y1 - y0) / (x1 - x0)))
    seen = field._place(options, shape)
    ax = options["ax"] if options["ax"] is not None else plt.gca()
    name = quantity or field._core.default_quantity()
    artist = {key: options[key] for key in ("cmap", "norm", "alpha", "zorder", "label", "visible", "rasterized", "gid")}
    image = FieldImage(ax, field, name, options["nan_color"], **artist)
    image.set_clim(*_limits(field, name, options))
    ax.add_image(image)
    _show(ax, field, seen)
    if options["cracks"]:
        _draw_lines(field, ax)
    if bar := options["colorbar"]:
        _draw_bar(ax, image, bar if isinstance(bar, str) else "right")
    return image


def _show(ax: Any, field: "Field", seen: View | None) -> None:
    """Set equal scales, and limits that show a place or all of the plate."""
    (x0, y0), (x1, y1) = field.dataset.domain
    ax.set_aspect("equal")
    if seen is None:
        ax.update_datalim([(x0, y0), (x1, y1)])
        ax.autoscale_view()
        return
    (x, y), half = seen.center, 0.5 * seen.width
    tall = half * (y1 - y0) / (x1 - x0)
    ax.set(xlim=(x - half, x + half), ylim=(y - tall, y + tall))


def _draw_bar(ax: Any, image: "FieldImage", location: str) -> None:
    bar = ax.figure.colorbar(image, ax=ax, location=location)
    symbol, unit = image._field._core.words(image._quantity)
    bar.set_label(f"{math_text(symbol)} [{unit}]" if unit else math_text(symbol))


def _register() -> None:
    """Register the colour maps that matplotlib lacks, under their names."""
    known = matplotlib.colormaps
    names = [name for name in _core.colormaps() if name not in known]
    for name in names:
        colors = np.array(_core.colormap(name)) / 255
        known.register(ListedColormap(colors, name=name))
        known.register(ListedColormap(colors[::-1], name=f"{name}_r"))


def _limits(field: "Field", quantity: str, options: PlotOptions) -> tuple[float, float]:
    """Return the ends of the colours of all of the plate, as those of a figure."""
    asked: Any = {name: options.get(name) for name in ("clim", "vmin", "vmax")}
    if options.get("norm") in get_args(Norm):
        asked["norm"] = options["norm"]
    seen = _coarse(field)
    low, high = _core.frame(field._core, request(field, quantity, asked, seen), seen)[1]["range"]
    return low, high


def _coarse(field: "Field") -> View:
    (x0, y0), (x1, y1) = field.dataset.domain
    columns, rows = (max(1, round(COARSE * d / max(x1 - x0, y1 - y0))) for d in (x1 - x0, y1 - y0))
    return view_at(field.dataset.domain, (columns, rows))


def _draw_lines(field: "Field", ax: Any) -> None:
    lines = [polyline(crack.points, crack.bulges) for crack in field.step.cracks]
    for hole in field.dataset.holes:
        if hole.points is not None:
            lines.append(polyline(np.vstack([hole.points, hole.points[:1]]), hole.bulges))
        else:
            angles = np.linspace(0.0, 2.0 * np.pi, 361)
            around = np.stack([np.cos(angles), np.sin(angles)], axis=-1)
            lines.append(np.asarray(hole.center) + float(hole.radius or 0.0) * around)
    for points in lines:
        ax.plot(*_fine(points).T, color="black", linewidth=1.0, scalex=False, scaley=False)


def _fine(points: Any) -> Any:
    """Return a polyline with more vertices: on logarithmic axes lines are curves."""
    along = np.arange(len(points))
    finer = np.linspace(0, len(points) - 1, 32 * (len(points) - 1) + 1)
    return np.stack([np.interp(finer, along, points[:, k]) for k in (0, 1)], axis=-1)


class FieldImage(AxesImage):
    """A quantity of a field as an image that is evaluated at the pixels that are drawn, never resampled.

    Its array is a coarse image of the plate, from which norms and colour bars begin.
    """

    def __init__(self, ax: Any, field: "Field", quantity: str, nan_color: Any = None, **properties: Any) -> None:
        (x0, y0), (x1, y1) = field.dataset.domain
        super().__init__(ax, interpolation="nearest", origin="upper", extent=(x0, x1, y0, y1), **properties)
        self._field, self._quantity = field, quantity
        self._nan_color = None if nan_color is None else to_rgba(nan_color)
        field._core.check(quantity)
        self.set_data(np.ma.masked_invalid(_core.render(field._core, quantity, _coarse(field), False, None)))
        self.set_clip_path(ax.patch)

    def get_cursor_data(self, event: Any) -> Any:
        """Return the exact value under the mouse."""
        if event.xdata is None or event.ydata is None:
            return None
        try:
            value = self._field.at(event.xdata, event.ydata)[self._quantity]
        except QuantityError:
            return None
        return None if np.isnan(value) else value

    def make_image(self, renderer: Any, magnification: float = 1.0, unsampled: bool = False) -> Any:
        """Return the colours of the pixels of the device, the lowest row first, and the place of the lower left one."""
        to_display = self.get_transform()
        corners = Bbox.null()
        x0, x1, y0, y1 = self.get_extent()
        grid = [(x, y) for x in (x0, x1) for y in (y0, y1)]
        corners.update_from_data_xy(to_display.transform(grid))
        seen = Bbox.intersection(corners, self.axes.bbox)
        if seen is None or seen.width <= 0 or seen.height <= 0:
            return None, 0, 0, None
        left, bottom = np.floor(np.array(seen.min) * magnification)
        columns, rows = np.maximum(np.ceil(np.array(seen.max) * magnification) - (left, bottom), 1)
        where = to_display, magnification, (left, bottom), (int(columns), int(rows))
        values = self._at_pixels(self._quantity, *where)
        rgba = self.to_rgba(np.ma.masked_invalid(values), bytes=True, norm=True)
        if self._nan_color is not None:
            on_plate = np.isfinite(self._at_pixels(self._field.components[0], *where))
            rgba[on_plate & np.isnan(values)] = np.round(255 * np.array(self._nan_color))
        alpha: Any = self.get_alpha()
        if alpha is not None:
            rgba[..., 3] = np.where(rgba[..., 3] > 0, round(255 * float(alpha)), 0)
        return rgba, left / magnification, bottom / magnification, None

    def _at_pixels(
        self, quantity: str, to_display: Any, scale: float, corner: tuple[float, float], size: tuple[int, int]
    ) -> Any:
        """Return values at the centres of pixels, the lowest row first."""
        x = (corner[0] + np.arange(size[0]) + 0.5) / scale
        y = (corner[1] + np.arange(size[1]) + 0.5) / scale
        to_data = to_display.inverted()
        ends = to_data.transform([(x[0], y[0]), (x[-1], y[-1])])
        if to_display.is_affine and to_display.is_separable and min(size) > 1:
            steps = (ends[1] - ends[0]) / (np.array(size) - 1)
            if steps[0] > 0 and abs(steps[1] / steps[0] - 1.0) < 1e-9:
                center = (float(ends[:, 0].mean()), float(ends[:, 1].mean()))
                view = View(center, float(steps[0] * size[0]), size)
                return _core.render(self._field._core, quantity, view, False, None)[::-1]
        points = np.stack(np.meshgrid(x, y), axis=-1).reshape(-1, 2)
        data = to_data.transform(points)
        values = self._field.at(data[:, 0], data[:, 1])[quantity]
        return values.reshape(size[::-1])


_register()
