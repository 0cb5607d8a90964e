"""Pictures of a field: values at pixels, colours, figures, animations."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any, Unpack

import numpy as np
from numpy.typing import NDArray

from . import _core
from ._errors import RenderError, require, warn
from ._evaluation import Evaluation
from ._options import passes, takes
from ._pictures import Animation, Extremum, Figure
from ._styles import AnimationOptions, FigureOptions, PlotOptions, RgbaOptions, quantities, request, request_text
from ._units import milliseconds, pixels
from ._views import SIZE, PixelOptions, PlaceOptions, Spot


class Drawing(Evaluation):
    """The pictures of a `Field`."""

    @takes(PixelOptions)
    def render(
        self,
        quantity: str | None = None,
        *,
        dtype: Any = np.float64,
        progress: Any = None,
        **options: Unpack[PixelOptions],
    ) -> NDArray[Any]:
        """Values at the centres of the pixels of a view: shape (rows, columns), rows from the top; NaN outside.

        Args:
            quantity: A quantity, a formula or a value of cells; by default von Mises' stress, of a potential itself.
            dtype: float64 or float32, in which the values are computed too; warns where float32 has no three digits.
            progress: Is called with phase, parts done, all parts, step.

        Raises:
            QuantityError: No quantity of the field.
            RenderError: A view or a size that cannot be drawn.

        Example:
            >>> f.render("uy", size=(40, 80)).shape
            (80, 40)
        """
        kind = np.dtype(dtype)
        if kind not in (np.dtype(np.float64), np.dtype(np.float32)):
            raise ValueError(f"dtype: values are float64 or float32, not {kind}")
        seen = self._seen(options)
        name = quantity or self._core.default_quantity()
        is_single = kind == np.float32
        if is_single and (text := self._core.single_precision_warning()):
            warn(text)
        return _core.render(self._core, name, seen._spot, seen.size, is_single, progress)

    @takes(RgbaOptions)
    def rgba(self, quantity: str | None = None, **options: Unpack[RgbaOptions]) -> NDArray[np.uint8]:
        """The colours of a picture: shape (rows, columns, 4), rows from the top; transparent outside.

        Args:
            quantity: As in `render`.

        Raises:
            TypeError: No such option.
            ValueError: No such value of an option; `QuantityError` and `RenderError` are of this kind.

        Example:
            >>> f.rgba("ux", size=(40, 80), cmap="magma", vmin=0).shape
            (80, 40, 4)
        """
        seen = self._seen(options)
        scene: Any = {name: value for name, value in options.items() if name != "size"}
        asked = request_text(self, request(self, quantity, scene, seen._spot))
        rgba, told = _core.rgba(self._core, asked, seen._spot, seen.size)
        warn(*told)
        return rgba

    @takes(FigureOptions)
    def figure(self, quantity: str | Sequence[str] | None = None, **options: Unpack[FigureOptions]) -> Figure:
        """A figure with axes and a colour bar, as the program draws it; notebooks show it. Several quantities, or parts
        of the field, have a panel each.

        Options are checked here; the figure is drawn when its bytes are asked for. What is to be known of it, such as pixels
        without a value, is warned of then, and kept as `Figure.warnings`.

        Args:
            quantity: As in `render`, or a list.

        Raises:
            TypeError: No such option.
            ValueError: No such value of an option; `QuantityError` and `RenderError` are of this kind.

        Example:
            >>> figure = f.figure("von_mises", tip=0, zoom=1e6, norm="log")
            >>> figure.save("tip.png")
            >>> figure.png()[1:4]
            b'PNG'
            >>> f.figure(["ux", "uy"], parts=["all", "jump"], shared_range=True)
            <ppum.Figure ux, uy, all, jump, panels>
        """
        parts = options.get("parts")
        if isinstance(parts, str) or (parts is not None and len(parts) < 2):
            raise ValueError(f"parts: {parts!r} is no list of several parts; `Field.part` gives one")
        return Figure(self, self._request(quantity, options, is_one=not (parts or quantities(quantity)[1])))

    def _request(
        self, quantity: str | Sequence[str] | None, options: AnimationOptions, *, is_one: bool, is_figure: bool = True
    ) -> str:
        """All that is asked of a picture, checked."""
        size = options["size"]
        if size is not None and options["inches"] is not None:
            raise TypeError("give `size` or `inches`, not both")
        at = self._place(options, SIZE if size is None else pixels(size))
        made = request(self, quantity, options, at, may_find=is_one)
        return request_text(self, {**made, "figure": is_figure, "place": self._placed(options, at)})

    def _placed(self, options: PlaceOptions, at: Spot | None) -> dict[str, Any]:
        """The place of a picture, as the libraries read it; a tip is followed where the plate is deformed."""
        tip = options.get("tip")
        if tip is not None and options.get("width") is None:
            return {"tip": self.step.tips._number(tip), "zoom": options.get("zoom")}
        return {} if at is None else {"center": at[0], "width": at[1]}

    @takes(AnimationOptions)
    def animate(
        self,
        quantity: str | None = None,
        *,
        steps: Sequence[int] | slice | None = None,
        fps: float = 5.0,
        bare: bool = False,
        progress: Any = None,
        **options: Unpack[AnimationOptions],
    ) -> Animation:
        """A moving picture of the steps of a series, as the program's: one range of colours, one factor of deformation, one place.

        Args:
            quantity: As in `render`.
            steps: Numbers of steps, or a slice of them; by default all.
            fps: Steps shown in a second, up to 50.
            bare: Whether axes and colour bar are left out: the picture has the size in pixels.
            progress: As in `render`.

        Raises:
            IndexError: There is no such step.
            ValueError: No steps; a rate that programs do not show; no such value of an option.
            TypeError: No such option.

        Example:
            >>> moving = f.animate("uy", deformed="auto", size=(320, 400))
            >>> moving.save("moving.gif")
            >>> moving.gif()[:6]
            b'GIF89a'
        """
        if quantities(quantity)[1]:
            raise ValueError("quantity: an animation shows one; `figure` has panels for those of one step")
        made = self._request(quantity, options, is_one=False, is_figure=not bare)
        return Animation(self, (made, self._numbers(steps)), milliseconds(fps), progress)

    def _numbers(self, steps: Sequence[int] | slice | None) -> list[int]:
        count = len(self.dataset.steps)
        if steps is None or isinstance(steps, slice):
            numbers = list(range(count)[steps or slice(None)])
        else:
            numbers = [self.dataset.steps[step].number for step in steps]
        if not numbers:
            raise ValueError("steps: a moving picture needs one step at least")
        return numbers

    @takes(PixelOptions)
    def extrema(self, quantity: str | None = None, **options: Unpack[PixelOptions]) -> tuple[Extremum, Extremum]:
        """The smallest and the largest value in a view, also between its pixels, at tips infinite.

        Args:
            quantity: A quantity or a formula.

        Raises:
            RenderError: There is no value in the view.

        Example:
            >>> low, high = f.extrema("uy")
            >>> low.value < 0 < high.value
            True
        """
        seen = self._seen(options)
        name = quantity or self._core.default_quantity()
        found = _core.extrema(self._core, name, seen._spot, seen.size)
        if found is None:
            raise RenderError(f"`{name}` has no value in the view; show some of the plate")
        low, high = (Extremum(**one) for one in found)
        return low, high

    @passes(PlotOptions)
    def plot(self, quantity: str | None = None, **options: Unpack[PlotOptions]) -> Any:
        """Draws the field into matplotlib axes: exact at every pixel of the device, on screen, in PNG and PDF, zoomed or not.

        Args:
            quantity: A quantity or a formula, as in `render`.

        Returns:
            The artist, a `matplotlib.image.AxesImage`.

        Raises:
            ImportError: The package matplotlib is not installed.
            TypeError: No such option.

        Example:
            >>> image = f.plot("uy", vmin=0, cmap="vik", tip=1, zoom=4)
            >>> bool(image.axes.get_xlim()[1] > 0.35)
            True
        """
        require("matplotlib", "matplotlib xarray", "pictures in matplotlib")
        from . import _axes

        plot: Any = _axes.plot
        return plot(self, quantity, **options)
