"""Fields: values at points, along curves and on grids, and pictures."""

from __future__ import annotations

import json
import warnings
from collections.abc import Mapping, Sequence
from functools import cached_property
from typing import TYPE_CHECKING, Any, Literal, Unpack, overload

import numpy as np
from numpy.typing import ArrayLike, NDArray

from . import _core
from .extras import needed
from .options import one_of, passes, takes
from .pictures import Animation, Extremum, Figure, milliseconds
from .styles import (
    ColorOptions,
    FigureOptions,
    PlotOptions,
    RgbaOptions,
    ViewerOptions,
    page,
    scene,
    span,
)
from .views import SIZE, PixelOptions, PlaceOptions, Spot, View, pixels, place, spot, view_of
from .values import Quantities, Quantity, Values, degrees, pair

if TYPE_CHECKING:
    from .comparing import Comparison, Resampling
    from .dataset import Dataset, Step, Table, Tip
    from .widget import Viewer

__all__ = ["Field"]

Floats = NDArray[np.float64]
SideName = Literal["above", "below", "both"]
ResamplingMethod = Literal["nearest", "bilinear", "bicubic", "cells"]


def _widget() -> Any:
    """The module of views, whose needs are extra ones."""
    needed("anywidget", "anywidget", "views in notebooks")
    from . import widget

    return widget


class Field:
    """A field of one step, to be evaluated exactly wherever one likes. Made by `Step.field` and `Dataset.field`.

    It never changes: `part`, `with_function`, `with_weight` and `with_quantity` give others. It can be pickled.

    Example:
        >>> f = ds.field
        >>> round(float(f.at(0.5, 0.25).von_mises), 6)
        1.276572
    """

    def __init__(
        self, dataset: Dataset, step: int = -1, _subject: Mapping[str, Any] | None = None
    ) -> None:
        count = len(dataset.steps)
        #: The dataset.
        self.dataset = dataset
        self._number = step if step >= 0 else count + step
        self._subject = dict(_subject or {})
        self._tips: Table[Tip] | None = None
        self._core = _core.Field(dataset._core, self._number, json.dumps(self._subject))

    @property
    def step(self) -> Step:
        """The step that the field belongs to."""
        return self.dataset.steps[self._number]

    @cached_property
    def components(self) -> tuple[str, ...]:
        """Names of the components: ``ux``, ``uy``, or ``u``."""
        return tuple(self._core.components())

    @cached_property
    def quantities(self) -> Mapping[str, Quantity]:
        """All quantities that have a name. Formulas of them are quantities too."""
        return Quantities([Quantity(**q) for q in self._core.known()])

    def at(
        self, x: ArrayLike, y: ArrayLike, *, side: SideName = "above", anchor: ArrayLike | None = None
    ) -> Values:
        """The field at points.

        A value depends on its point alone, to the last bit, whatever other points there are.

        Args:
            x, y: Coordinates, lengths; numbers or arrays, which are broadcast against each other.
            side: Of points on a crack the side that is meant: ``above`` is on the left of the crack's
                direction; ``both`` gives both along a last axis. Elsewhere sides are equal.
            anchor: Where x and y are offsets from. They are not rounded by it: 1e-20 from a tip
                is as exact as 1.

        Raises:
            TypeError: Coordinates that are no real numbers.
            ValueError: Shapes that cannot be broadcast; no such side.

        Example:
            >>> f.at(0.0, 0.0, side="both").uy.shape
            (2,)
            >>> near = f.at(1e-20, 0.0, anchor=ds.tips[1].xy)
            >>> bool(near.von_mises > 1e9)
            True
        """
        return Values(self, x, y, side, anchor)

    def evaluate(
        self,
        x: ArrayLike,
        y: ArrayLike,
        quantities: Sequence[str],
        *,
        side: SideName = "above",
        anchor: ArrayLike | None = None,
        gradient: bool = False,
        out: Floats | None = None,
    ) -> Any:
        """Several quantities in one pass over the points.

        Args:
            x, y, side, anchor: As in `at`.
            quantities: q names or formulas.
            gradient: Whether gradients are wanted too.
            out: An array for the result, float64 in C order, which is returned; not with gradients or both sides.

        Returns:
            Shape (..., q), or with both sides (..., 2, q). With `gradient` two arrays: this, and the gradients
            of shape (..., q, 2).

        Raises:
            QuantityError: No quantity of the field.
            ValueError: An `out` that does not fit.

        Example:
            >>> f.evaluate([0.0, 0.1], 0.5, ["ux", "sxx + syy"]).shape
            (2, 2)
        """
        if isinstance(quantities, str):
            raise TypeError("quantities: give a list of names; `at(x, y)[name]` takes one")
        if out is not None and (gradient or side == "both"):
            raise ValueError("`out` takes values of one side, without gradients")
        values = self.at(x, y, side=side, anchor=anchor)
        found = values._evaluate(list(quantities), gradient, out)
        return (found[..., 0], found[..., 1:]) if gradient else found

    def part(self, part: str) -> Field:
        """A part of the field: ``smooth``, ``jump``, ``tip``, ``other``, or ``patch:N``. The parts add up to the whole.

        Raises:
            QuantityError: No such part.

        Example:
            >>> parts = [f.part(name).at(0.3, 0.1).ux for name in ("smooth", "jump", "tip")]
            >>> bool(abs(sum(parts) - f.at(0.3, 0.1).ux) < 1e-12)
            True
        """
        return self._changed(part=part)

    def with_function(self, functions: Mapping[str, str]) -> Field:
        """The field with other functions in place of its own, by name or number: formulas of x, y, r, theta. The
        coefficients stay.

        Raises:
            QuantityError: No such function, no formula.

        Example:
            >>> g = f.with_function({"westergaard 1": "r"})
            >>> bool(g.at(0.4, 0.3).uy == f.at(0.4, 0.3).uy)
            False
        """
        known = [tuple(pair) for pair in self._subject.get("functions", [])]
        return self._changed(functions=[*known, *functions.items()])

    def with_weight(self, weight: str) -> Field:
        """The field with another weight function: one of the library by name, or a formula of t. The coefficients stay.

        Raises:
            QuantityError: No weight.

        Example:
            >>> bool(f.with_weight("bump").at(0.26, 0.1).ux != f.at(0.26, 0.1).ux)
            True
        """
        return self._changed(weight=weight)

    def with_quantity(self, quantities: Mapping[str, str]) -> Field:
        """The field with other formulas for quantities that the dataset names.

        Raises:
            QuantityError: No such quantity, no formula.
        """
        known = [tuple(pair) for pair in self._subject.get("quantities", [])]
        return self._changed(quantities=[*known, *quantities.items()])

    def _of_step(self, number: int) -> Field:
        """The field of another step, changed as this one is."""
        if not self._subject:
            return self.dataset.steps[number].field
        return Field(self.dataset, number, self._subject)

    def _changed(self, **what: Any) -> Field:
        return Field(self.dataset, self._number, {**self._subject, **what})

    def line(
        self, start: ArrayLike, end: ArrayLike, *, num: int = 201, quantities: Sequence[str] | None = None
    ) -> Any:
        """Values along a line, as an `xarray.Dataset` over the distance `s` from its start.

        Coordinates are `x`, `y` and `side`: where the line meets a crack there are two rows, above (1) and below (-1).

        Example:
            >>> line = f.line((-1, 0), (1, 0), num=5, quantities=["uy"])
            >>> line.side.values
            array([ 0.,  0.,  1., -1.,  0.,  0.])
        """
        along = {"line": {"from": pair(start), "to": pair(end)}}
        return self._curve(along, num, quantities)

    def circle(
        self, center: ArrayLike, radius: float, *, num: int = 201, quantities: Sequence[str] | None = None
    ) -> Any:
        """Values on a circle, as an `xarray.Dataset` over the angle `theta` from the x axis, radians.

        Example:
            >>> f.circle((0, 0), 0.6, num=5, quantities=["uy"]).theta.values
            array([-3.14159265, -1.57079633,  0.        ,  1.57079633,  3.14159265])
        """
        along = {"circle": {"center": pair(center), "radius": radius}}
        return self._curve(along, num, quantities)

    def along(self, crack: Any, *, num: int = 201, quantities: Sequence[str] | None = None) -> Any:
        """Values on both sides of a crack, as an `xarray.Dataset` over the arc length `s`: of each quantity
        `…_above` and `…_below`, and of a displacement the jumps `jump_ux` and `jump_uy`, `opening` and `sliding`.

        Args:
            crack: A `Crack` or its number.

        Example:
            >>> sorted(f.along(0, quantities=["ux", "uy"]))
            ['jump_ux', 'jump_uy', 'opening', 'sliding', 'ux_above', 'ux_below', 'uy_above', 'uy_below']
        """
        return self._curve({"crack": {"index": getattr(crack, "index", crack)}}, num, quantities)

    def around(
        self, tip: int, radius: float | None = None, *, num: int = 201, quantities: Sequence[str] | None = None
    ) -> Any:
        """Values on a circle around a tip, as an `xarray.Dataset` over the angle `theta` from the crack's extension,
        radians; by default a hundredth of the crack's length away.

        Example:
            >>> f.around(1, num=5, quantities=["syy"]).sizes["theta"]
            5
        """
        return self._curve({"around": {"tip": tip, "radius": radius}}, num, quantities)

    def ray(
        self,
        tip: int,
        angle: float = 0.0,
        length: float | None = None,
        *,
        num: int = 201,
        quantities: Sequence[str] | None = None,
    ) -> Any:
        """Values on a ray from a tip, as an `xarray.Dataset` over the distance `r` in steps of its logarithm.

        Args:
            tip: The number of a tip.
            angle: That from the crack's extension, radians, as `Tip.growth_angle`.
            length: The largest distance; by default a tenth of the crack's length.

        Example:
            >>> ahead = f.ray(1, angle=ds.tips[1].growth_angle, quantities=["syy"])
            >>> bool(ahead.syy[0] > ahead.syy[-1] > 0)
            True
        """
        along = {"ray": {"tip": tip, "angle": degrees(angle), "far": length}}
        return self._curve(along, num, quantities)

    def _curve(self, along: Any, num: int, quantities: Sequence[str] | None) -> Any:
        from .xarrays import curve

        return curve(self, json.dumps(along), num, self._names(quantities))

    def grid(
        self,
        nx: int | None = None,
        ny: int | None = None,
        *,
        x: ArrayLike | None = None,
        y: ArrayLike | None = None,
        quantities: Sequence[str] | None = None,
        side: SideName = "above",
    ) -> Any:
        """Values on a grid, as an `xarray.Dataset` over y and x, both rising.

        Args:
            nx, ny: Numbers of columns and rows, from border to border of the domain's box.
            x, y: Or the coordinates themselves.
            quantities: By default the components, for elasticity also the stresses.
            side: As in `at`; ``both`` adds a dimension `side`.

        Example:
            >>> f.grid(3, 5, quantities=["s1"]).s1.dims
            ('y', 'x')
        """
        from .xarrays import grid

        return grid(self, (nx, x), (ny, y), self._names(quantities), side)

    def _names(self, quantities: Sequence[str] | None) -> list[str]:
        if isinstance(quantities, str):
            raise TypeError("quantities: give a list of names")
        if quantities is not None:
            return list(quantities)
        stresses = ["sxx", "syy", "sxy", "von-mises"]
        return [*self.components, *(stresses if self.dataset.equation == "elasticity" else [])]

    @takes
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
            warnings.warn(text, stacklevel=3)
        return _core.render(self._core, name, seen._spot, seen.size, is_single, progress)

    @takes
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
        rgba, told = _core.rgba(
            self._core, self._scene(quantity, options, seen._spot), seen._spot, seen.size
        )
        for text in told:
            warnings.warn(text, stacklevel=3)
        return rgba

    @takes
    def figure(self, quantity: str | None = None, **options: Unpack[FigureOptions]) -> Figure:
        """A figure with axes and a colour bar, as the program draws it; notebooks show it.

        Options are checked here; the figure is drawn when its bytes are asked for. What is to be known of it, such as pixels
        without a value, is warned of then, and kept as `Figure.warnings`.

        Args:
            quantity: As in `render`.

        Raises:
            TypeError: No such option.
            ValueError: No such value of an option; `QuantityError` and `RenderError` are of this kind.

        Example:
            >>> figure = f.figure("von_mises", tip=0, zoom=1e6, norm="log")
            >>> figure.save("tip.png")
            >>> figure.png()[1:4]
            b'PNG'
        """
        look = page(options)
        at = self._place(options, look["size"])
        return Figure(self, self._scene(quantity, options, at), at, look)

    def _scene(
        self, quantity: str | None, options: ColorOptions, at: Spot | None, *, may_find: bool = True
    ) -> str:
        """What a picture shows, checked. An end of the range that is not given is that of an automatic one."""
        found = span(options)
        if not isinstance(found, str) and None in found:
            if not may_find:
                raise ValueError("give both vmin and vmax: one range is that of all steps")
            auto = scene(quantity, options, "auto")
            ends = _core.frame(self._core, auto, at or spot(self.dataset.domain, SIZE), SIZE)[1]["range"]
            both = zip(found, ends, strict=True)
            clim: Any = [end if given is None else given for given, end in both]
            found = span({"clim": clim})
        made = scene(quantity, options, found)
        _core.check_request(self._core, made)
        return made

    @takes
    def animate(
        self,
        quantity: str | None = None,
        *,
        steps: Sequence[int] | slice | None = None,
        fps: float = 5.0,
        bare: bool = False,
        progress: Any = None,
        **options: Unpack[FigureOptions],
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
        look = page(options)
        size = look["size"]
        at = self._place(options, size)
        made = self._scene(quantity, options, at, may_find=False)
        what = (made, self._numbers(steps), at, size, None if bare else json.dumps(look))
        return Animation(self, what, milliseconds(fps), progress)

    def _numbers(self, steps: Sequence[int] | slice | None) -> list[int]:
        count = len(self.dataset.steps)
        if steps is None or isinstance(steps, slice):
            numbers = list(range(count)[steps or slice(None)])
        else:
            numbers = [self.dataset.steps[step].number for step in steps]
        if not numbers:
            raise ValueError("steps: a moving picture needs one step at least")
        return numbers

    @takes
    def extrema(
        self, quantity: str | None = None, **options: Unpack[PixelOptions]
    ) -> tuple[Extremum, Extremum]:
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
        from .errors import RenderError

        seen = self._seen(options)
        name = quantity or self._core.default_quantity()
        found = _core.extrema(self._core, name, seen._spot, seen.size)
        if found is None:
            raise RenderError(f"`{name}` has no value in the view; show some of the plate")
        low, high = (Extremum(**one) for one in found)
        return low, high

    @takes
    def compare(
        self,
        other: Field,
        quantity: str | None = None,
        *,
        progress: Any = None,
        **options: Unpack[PixelOptions],
    ) -> Comparison:
        """This field minus another at the pixels of a view: how far they are from each other, and where.

        Both are evaluated at the centre of each pixel; covers, functions and steps may be any.

        Args:
            other: A field, of this dataset or another: another step, part, weight or cover.
            quantity: A quantity or formula that both have, or a value of cells; by default as in `render`.
            progress: As in `render`.

        Raises:
            QuantityError: One of them does not have the quantity.
            RenderError: No pixel has a value in both.

        Example:
            >>> found = f.compare(f.part("smooth"), "uy", size=(100, 200))
            >>> found.compared, found.values.shape, found.relative.l2 > 0.1
            (20000, (200, 100), True)
            >>> f.compare(f).absolute
            Norms(l1=0.0, l2=0.0, max=0.0)
        """
        from .comparing import compare

        name = quantity or self._core.default_quantity()
        return compare(self, other, name, self._seen(options), progress)

    @takes
    def resampled(
        self,
        quantity: str | None = None,
        *,
        grid: int | tuple[int, int] = 64,
        method: ResamplingMethod = "bilinear",
        over: Literal["domain", "view"] = "domain",
        error: float | None = None,
        progress: Any = None,
        **options: Unpack[PixelOptions],
    ) -> Resampling:
        """What resampling makes of the field, as other programs draw it, and how far that is from it.

        Exact values at the points of a grid are interpolated at the pixels of a view, as `ppum compare` does.

        Args:
            quantity: A quantity or formula; by default as in `render`.
            grid: Points of the grid, borders included: as many columns as rows, or both.
            method: The nearest point's value; ``bilinear`` of four points; ``bicubic`` of sixteen; or ``cells``: the value at
                the centre of each cell of the cover, without a grid.
            over: The rectangle of the grid: the box of the domain, or what the view shows.
            error: A relative error for which the grid is looked for too, see `Resampling.needed`.
            progress: As in `render`.

        Raises:
            QuantityError: No quantity of the field.
            RenderError: No grid: fewer than 2x2 points, or too many.
            ValueError: No such method, no such rectangle.

        Example:
            >>> coarse, fine = (f.resampled("uy", grid=n, size=(100, 200)) for n in (16, 256))
            >>> fine.relative.l1 < coarse.relative.l1, fine.bytes
            (True, 524288)
        """
        from .comparing import resample

        one_of("over", over, ("domain", "view"))
        if error is not None and not error > 0:
            raise ValueError(f"error: {error!r} cannot be reached; give a positive number, e.g. 0.01")
        size = (grid, grid) if isinstance(grid, int) else tuple(grid)
        way = {"method": method, "grid": size, "over_view": over == "view", "error": error}
        name = quantity or self._core.default_quantity()
        return resample(self, name, self._seen(options), way, progress)

    @passes
    def view(self, quantity: str | None = None, **options: Unpack[ViewerOptions]) -> Viewer:
        """Shows the field in a notebook: pan, zoom, read values, exact in every frame.

        Args:
            quantity: As in `render`.

        Raises:
            ImportError: The package anywidget is not installed.
            TypeError: No such option.
            traitlets.TraitError: No such value.

        Example:
            >>> view = f.view("uy", width=0.5, center=(0, 0), clim=(0, 1))
            >>> view.width *= 0.5
            >>> view.width
            0.25
        """
        made: Viewer = _widget().Viewer(self, quantity, **options)
        return made

    def view_at(
        self,
        view: View | None = None,
        *,
        center: Sequence[float] | NDArray[Any] | None = None,
        width: float | None = None,
        tip: int | None = None,
        zoom: float | None = None,
        size: tuple[int, int] | None = None,
    ) -> View:
        """What a picture shows: all of the plate, or a width around a center, or a tip enlarged `zoom` times (10).

        Example:
            >>> f.view_at(tip=1, zoom=4, size=(100, 100)).width
            1.0
        """
        if view is not None:
            given: PixelOptions = {"center": center, "width": width, "tip": tip, "zoom": zoom, "size": size}
            return view_of(view, given)
        size = pixels(SIZE if size is None else size)
        at, width = self._spot(size, center, width, tip, zoom)
        return View(at, width, size)

    def _seen(self, options: PixelOptions) -> View:
        """What a picture in pixels shows."""
        names = PixelOptions.__annotations__
        return self.view_at(**{name: options.get(name) for name in names})  # type: ignore[arg-type]

    def _place(self, options: PlaceOptions, size: tuple[int, int]) -> Spot | None:
        """Center and width of what a page of this size shows; None where nothing is said."""
        seen = {name: value for name, value in place(options).items() if value is not None}
        if not seen:
            return None
        return self.view_at(**seen, **({} if "view" in seen else {"size": size}))._spot  # type: ignore[arg-type]

    def _spot(
        self,
        size: tuple[int, int],
        center: ArrayLike | None = None,
        width: float | None = None,
        tip: int | None = None,
        zoom: float | None = None,
    ) -> Spot:
        if tip is not None and center is not None:
            raise TypeError("give a tip or a center, not both")
        at = None if center is None else pair(center)
        if tip is not None:
            at = self.step.tips[tip].xy
        return spot(self.dataset.domain, size, at, width, zoom)

    @passes
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
        needed("matplotlib", "matplotlib xarray", "pictures in matplotlib")
        from .plotting import plot

        return plot(self, quantity, **options)

    @overload
    def intensities(self, tip: None = None, *, progress: Any = None) -> Table[Tip]: ...

    @overload
    def intensities(self, tip: int, radius: float | None = None, *, progress: Any = None) -> Tip: ...

    def intensities(
        self, tip: int | None = None, radius: float | None = None, *, progress: Any = None
    ) -> Table[Tip] | Tip:
        """Stress intensity factors, T and J found from the field by interaction integrals, whoever made it.

        The loads near the tips are those of the problem that the dataset holds; without one none act there. What the
        diagnostics find is warned of.

        Args:
            tip: The number of a tip; by default all.
            radius: That of the largest disc; by default nine tenths of the largest one that nothing disturbs.
            progress: As in `render`.

        Returns:
            The tip, or a table of all. `error` is NaN: only the solver knows it.

        Raises:
            IndexError: There is no such tip.
            SolveError: A potential; a radius that something else lies within; loads that are not known.

        Example:
            >>> found = f.intensities(1)
            >>> abs(found.k1 / ds.tips[1].k1 - 1) < 1e-12
            True
            >>> abs(f.intensities(1, radius=0.1).k1 / found.k1 - 1) < 1e-2
            True
        """
        from .dataset import tips_of

        if tip is None:
            if radius is not None:
                raise TypeError("radius: give the tip that it is of")
            return self._found_tips(progress)
        number = self.step.tips._number(tip)
        if radius is None:
            return self._found_tips(progress)[number]
        found, ends, _ = _core.intensities(self._core, (number, float(radius)), progress)
        return tips_of(json.loads(found), ends)[0]

    def _found_tips(self, progress: Any) -> Table[Tip]:
        """The factors of all tips, found once."""
        from .dataset import tips_of

        if self._tips is None:
            found, ends, told = _core.intensities(self._core, None, progress)
            for text in told:
                warnings.warn(text, stacklevel=3)
            self._tips = tips_of(json.loads(found), ends)
        return self._tips

    def __eq__(self, other: object) -> bool:
        if not isinstance(other, Field):
            return NotImplemented
        mine, theirs = ((f._number, f._subject) for f in (self, other))
        return mine == theirs and self.dataset == other.dataset

    def __hash__(self) -> int:
        return hash((self._number, self.dataset))

    def __reduce__(self) -> tuple[Any, ...]:
        return Field, (self.dataset, self._number, self._subject)

    def __repr__(self) -> str:
        changes = [k if k != "part" else self._subject[k] for k in self._subject]
        changed = f", changed: {', '.join(changes)}" if changes else ""
        names = ", ".join(self.components)
        return f"<ppum.Field {names} of {self.dataset.title!r}, step {self._number}{changed}>"


Field.__module__ = "ppum"
