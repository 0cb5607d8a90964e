"""The evaluation of a field at points, and the places that pictures of it show."""

from __future__ import annotations

import json
from collections.abc import Mapping, Sequence
from functools import cached_property
from typing import TYPE_CHECKING, Any

from numpy.typing import ArrayLike, NDArray

from . import _core
from ._errors import QuantityError
from ._units import Floats, pair, pixels
from ._values import Quantities, Quantity, SideName, Values
from ._views import SIZE, PixelOptions, PlaceOptions, Spot, View, spot, view_of

if TYPE_CHECKING:
    from ._dataset import Dataset, Step


class Evaluation:
    """A field of one step of a dataset, to be evaluated at points: the base of all that fields can do."""

    def __init__(self, dataset: Dataset, step: int = -1, _subject: Mapping[str, Any] | None = None) -> None:
        count = len(dataset.steps)
        #: The dataset.
        self.dataset = dataset
        self._number = step if step >= 0 else count + step
        self._subject = dict(_subject or {})
        self._core = _core.Field(dataset._core, self._number, json.dumps(self._subject))

    @cached_property
    def quantities(self) -> Mapping[str, Quantity]:
        """All quantities that have a name. Formulas of them are quantities too."""
        return Quantities([Quantity(**q) for q in self._core.known()])

    def at(self, x: ArrayLike, y: ArrayLike, *, side: SideName = "above", anchor: ArrayLike | None = None) -> Values:
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

    @property
    def step(self) -> Step:
        """The step that the field belongs to."""
        return self.dataset.steps[self._number]

    @cached_property
    def components(self) -> tuple[str, ...]:
        """Names of the components: ``ux``, ``uy``, or ``u``."""
        return tuple(self._core.components())

    def _is_quantity(self, name: str) -> bool:
        """Whether points have values by this name: those of cells and what there is not have none."""
        try:
            self._core.check(name)
        except QuantityError:
            return False
        return True

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
        return self._seen({"view": view, "center": center, "width": width, "tip": tip, "zoom": zoom, "size": size})

    def _seen(self, options: PixelOptions) -> View:
        """What a picture in pixels shows."""
        if (view := options.get("view")) is not None:
            return view_of(view, options)
        size = options.get("size")
        size = pixels(SIZE if size is None else size)
        return View(*self._spot(size, options), size)

    def _place(self, options: PlaceOptions, size: tuple[int, int]) -> Spot | None:
        """Center and width of what a page of this size shows; None where nothing is said."""
        seen: Any = {name: options.get(name) for name in PlaceOptions.__annotations__}
        return None if all(value is None for value in seen.values()) else self._seen(seen | {"size": size})._spot

    def _spot(self, size: tuple[int, int], options: PlaceOptions) -> Spot:
        center, tip = options.get("center"), options.get("tip")
        if tip is not None and center is not None:
            raise TypeError("give a tip or a center, not both")
        at = None if center is None else pair(center)
        if tip is not None:
            at = self.step.tips[tip].xy
        return spot(self.dataset.domain, size, at, options.get("width"), options.get("zoom"))
