"""Fields: values at points, parts, comparisons, stress intensity factors."""

from __future__ import annotations

import json
import warnings
from collections.abc import Mapping, Sequence
from functools import cached_property
from typing import TYPE_CHECKING, Any, Literal, Unpack, overload

import numpy as np
from numpy.typing import ArrayLike, NDArray

from . import _core
from .exporting import Exporting
from .facts import Tip, tips_of
from .options import one_of, takes
from .sampling import Sampling
from .tables import Table
from .values import Quantities, Quantity, SideName, Values
from .views import PixelOptions

if TYPE_CHECKING:
    from .comparing import Comparison, Resampling
    from .dataset import Dataset

__all__ = ["Field"]

#: Fields of a series in a file that are kept ready.
KEPT = 4

Floats = NDArray[np.float64]
ResamplingMethod = Literal["nearest", "bilinear", "bicubic", "cells"]


class Field(Sampling, Exporting):
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
        if not isinstance(part, str):
            raise TypeError(f"part: 'smooth', 'jump', 'tip', 'other' or 'patch:N' is needed, not {part!r}")
        return self._changed(part=part)

    def with_function(self, functions: Mapping[str | int, str]) -> Field:
        """The field with other functions in place of its own, by name or number: formulas of x, y, r, theta. The
        coefficients stay.

        Raises:
            QuantityError: No such function, no formula.

        Example:
            >>> g = f.with_function({"westergaard 1": "r"})
            >>> bool(g.at(0.4, 0.3).uy == f.at(0.4, 0.3).uy)
            False
        """
        return self._with_formulas("functions", functions)

    def with_weight(self, weight: str) -> Field:
        """The field with another weight function: one of the library by name, or a formula of t. The coefficients stay.

        Raises:
            QuantityError: No weight.

        Example:
            >>> bool(f.with_weight("bump").at(0.26, 0.1).ux != f.at(0.26, 0.1).ux)
            True
        """
        if not isinstance(weight, str):
            raise TypeError(f"weight: a name or a formula of t is needed, not {weight!r}")
        return self._changed(weight=weight)

    def with_quantity(self, quantities: Mapping[str, str]) -> Field:
        """The field with other formulas for quantities that the dataset names.

        Raises:
            QuantityError: No such quantity, no formula.
        """
        return self._with_formulas("quantities", quantities)

    def _with_formulas(self, what: str, formulas: Mapping[Any, str]) -> Field:
        """The field with more formulas in place of functions or quantities."""
        for which, text in formulas.items():
            if not isinstance(text, str):
                raise TypeError(f"{which}: a formula is needed, such as 'r*theta', not {text!r}")
        known = [tuple(pair) for pair in self._subject.get(what, [])]
        more = [(str(which), text) for which, text in formulas.items()]
        return self._changed(**{what: [*known, *more]})

    def _of_step(self, number: int) -> Field:
        """The field of another step, changed as this one is."""
        if not self._subject:
            return self.dataset.steps[number].field
        return Field(self.dataset, number, self._subject)

    def _changed(self, **what: Any) -> Field:
        return Field(self.dataset, self._number, {**self._subject, **what})

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
