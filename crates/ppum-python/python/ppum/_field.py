"""Fields of steps: evaluated at points, changed in parts; accessors sample, draw, export and compare them."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from functools import cached_property
from typing import TYPE_CHECKING, Any, ClassVar, Unpack, overload

from numpy.typing import ArrayLike

from . import _core
from ._errors import QuantityError, require
from ._facts import Tip, tips_of
from ._options import passes, takes
from ._styles import ViewerOptions
from ._tables import Table
from ._units import Floats, floats, pixels
from ._values import Quantities, Quantity, SideName, Values
from ._views import SIZE, PixelOptions, PlaceOptions, View, checked_view, view_at
from ._warnings import warn, with_old_names

if TYPE_CHECKING:
    from ._compare import Compare
    from ._dataset import Dataset, Step
    from ._draw import Draw
    from ._export import Export
    from ._sample import Sample
    from ._widget import Viewer

#: Fields of a series in a file that are kept ready.
KEPT = 4


@with_old_names
class Field:
    """A field of one step, evaluated exactly at any point. Made by `Step.field` and `Dataset.field`.

    It never changes: `part`, `with_function`, `with_weight` and `with_quantity` return others. It can be pickled. `sample`
    has values along curves and on grids, `draw` images, `export` files for other programs, `compare` differences.

    Example:
        >>> f = ds.field
        >>> round(float(f.at(0.5, 0.25).von_mises), 6)
        1.276572
    """

    # accessors and views are of upper layers; bound by the package
    sample: Sample
    draw: Draw
    export: Export
    compare: Compare
    _viewer: ClassVar[Any]

    _tips: Table[Tip] | None = None

    def __init__(self, dataset: Dataset, step: int = -1, _subject: Mapping[str, Any] | None = None) -> None:
        count = len(dataset.steps)
        #: The dataset.
        self.dataset = dataset
        self._number = step if step >= 0 else count + step
        self._subject = dict(_subject or {})
        self._core = _core.Field(dataset._core, self._number, self._subject)

    @property
    def step(self) -> Step:
        """Step that the field belongs to."""
        return self.dataset.steps[self._number]

    @cached_property
    def components(self) -> tuple[str, ...]:
        """Names of the components: ``ux``, ``uy``, or ``u``."""
        return tuple(self._core.components())

    @cached_property
    def quantities(self) -> Mapping[str, Quantity]:
        """Named quantities; formulas of them are quantities too."""
        return Quantities([Quantity(*q) for q in self._core.known()])

    @cached_property
    def face_quantities(self) -> tuple[str, ...]:
        """Quantities that only points of cracks have: tractions, opening, sliding and whether the faces are closed.

        Example:
            >>> f.face_quantities
            ('normal-traction', 'shear-traction', 'opening', 'sliding', 'closed')
            >>> face = f.at(0.0, 0.0)
            >>> bool(abs(face.normal_traction) < 0.02 and face.opening > 0), float(face.closed)
            (True, 0.0)
        """
        return tuple(self._core.of_faces())

    def at(
        self, x: ArrayLike, y: ArrayLike | None = None, *, side: SideName = "above", anchor: ArrayLike | None = None
    ) -> Values:
        """Return the field at points.

        A value depends on its point alone, to the last bit, whatever other points there are.

        Args:
            x, y: Coordinates, lengths; numbers or arrays, which are broadcast against each other. Without y, x has the points
                in rows: shape (..., 2).
            side: Side of points on a crack: ``above`` is left of its direction, ``both`` adds a last axis.
            anchor: Origin of x and y, to which they are never added: 1e-20 from a tip is as exact as 1.

        Raises:
            TypeError: Coordinates are no real numbers.
            ValueError: Shapes cannot be broadcast, or the side is unknown.

        Example:
            >>> f.at(0.0, 0.0, side="both").uy.shape
            (2,)
            >>> f.at([(0.0, 0.5), (0.1, 0.5), (0.2, 0.5)]).uy.shape
            (3,)
            >>> near = f.at(1e-20, 0.0, anchor=ds.tips[1].xy)
            >>> bool(near.von_mises > 1e9)
            True
        """
        if y is None:
            points = floats(x)
            if points.shape[-1:] != (2,):
                raise TypeError(f"give x and y, or points of the shape (..., 2), not {points.shape}")
            x, y = points[..., 0], points[..., 1]
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
        """Evaluate several quantities in one pass over the points.

        Args:
            x, y, side, anchor: As in `at`.
            quantities: q names or formulas.
            gradient: Whether to return gradients too.
            out: An array for the result, float64 in C order, which is returned; not with gradients or both sides.

        Returns:
            Shape (..., q), or (..., 2, q) of both sides; with `gradient` also an array (..., q, 2).

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

    def _is_quantity(self, name: str) -> bool:
        """Return whether points have values by this name; values of cells are not such."""
        try:
            self._core.check(name)
        except QuantityError:
            return False
        return True

    def part(self, part: str) -> Field:
        """Return a part of the field: ``smooth``, ``jump``, ``tip``, ``other``, or ``patch:N``. The parts add up to the whole.

        Example:
            >>> parts = [f.part(name).at(0.3, 0.1).ux for name in ("smooth", "jump", "tip")]
            >>> bool(abs(sum(parts) - f.at(0.3, 0.1).ux) < 1e-12)
            True
        """
        if not isinstance(part, str):
            raise TypeError(f"part: 'smooth', 'jump', 'tip', 'other' or 'patch:N' is needed, not {part!r}")
        return self._changed(part=part)

    def with_function(self, functions: Mapping[str | int, str]) -> Field:
        """Replace functions, by name or number, by formulas of x, y, r, theta. The coefficients stay.

        Example:
            >>> g = f.with_function({"westergaard 1": "r"})
            >>> bool(g.at(0.4, 0.3).uy == f.at(0.4, 0.3).uy)
            False
        """
        return self._with_formulas("functions", functions)

    def with_weight(self, weight: str) -> Field:
        """Replace the weight function by one of the library, by name, or a formula of t. The coefficients stay.

        Example:
            >>> bool(f.with_weight("bump").at(0.26, 0.1).ux != f.at(0.26, 0.1).ux)
            True
        """
        if not isinstance(weight, str):
            raise TypeError(f"weight: a name or a formula of t is needed, not {weight!r}")
        return self._changed(weight=weight)

    def with_quantity(self, quantities: Mapping[str, str]) -> Field:
        """Replace the formulas of quantities that the dataset names."""
        return self._with_formulas("quantities", quantities)

    def _with_formulas(self, what: str, formulas: Mapping[Any, str]) -> Field:
        for which, text in formulas.items():
            if not isinstance(text, str):
                raise TypeError(f"{which}: a formula is needed, such as 'r*theta', not {text!r}")
        known = [tuple(pair) for pair in self._subject.get(what, [])]
        return self._changed(**{what: [*known, *((str(which), text) for which, text in formulas.items())]})

    def _at_step(self, number: int) -> Field:
        """Return the field of another step, changed as this one is."""
        if not self._subject:
            return self.dataset.steps[number].field
        return Field(self.dataset, number, self._subject)

    def _changed(self, **what: Any) -> Field:
        return Field(self.dataset, self._number, {**self._subject, **what})

    @overload
    def intensities(self, tip: None = None, *, progress: Any = None) -> Table[Tip]: ...

    @overload
    def intensities(self, tip: int, radius: float | None = None, *, progress: Any = None) -> Tip: ...

    def intensities(
        self, tip: int | None = None, radius: float | None = None, *, progress: Any = None
    ) -> Table[Tip] | Tip:
        """Compute stress intensity factors, T and J by interaction integrals, of any field, also of other programs.

        The loads near the tips are those of the dataset's problem; without one none act there. Diagnostics are warned of.

        Args:
            tip: The number of a tip; by default all.
            radius: Radius of the largest disc; by default nine tenths of the largest one that nothing disturbs.
            progress: A function that is called with phase, parts done, all parts and step.

        Returns:
            The tip, or a table of all. `error` is NaN: only the solver knows it.

        Raises:
            IndexError: There is no such tip.
            SolveError: The field is a potential, a disc contains something else, or loads are unknown.

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
        return tips_of(found, ends)[0]

    def _found_tips(self, progress: Any) -> Table[Tip]:
        """Return the factors of all tips, computed once."""
        if self._tips is None:
            found, ends, messages = _core.intensities(self._core, None, progress)
            warn(*messages)
            self._tips = tips_of(found, ends)
        return self._tips

    @passes(ViewerOptions)
    def view(self, quantity: str | None = None, **options: Unpack[ViewerOptions]) -> Viewer:
        """Show the field in a notebook: pan, zoom, read values, exact in every frame. Needs the package anywidget.

        Example:
            >>> view = f.view("uy", width=0.5, center=(0, 0), clim=(0, 1))
            >>> view.width *= 0.5
            >>> view.width
            0.25
        """
        require("anywidget", "anywidget", "views in notebooks")
        made: Viewer = self._viewer(self, quantity, **options)
        return made

    @takes(PixelOptions)
    def view_at(self, **options: Unpack[PixelOptions]) -> View:
        """Return the view of an image with these options: all of the plate, a width around a center, or a tip enlarged.

        Example:
            >>> f.view_at(tip=1, zoom=4, size=(100, 100)).width
            1.0
        """
        return self._seen(options)

    def _seen(self, options: PixelOptions) -> View:
        """Return the view of an image in pixels."""
        if (view := options.get("view")) is not None:
            return checked_view(view, options)
        center, tip, size = options.get("center"), options.get("tip"), options.get("size")
        if tip is not None and center is not None:
            raise TypeError("give a tip or a center, not both")
        at = center if tip is None else self.step.tips[tip].xy
        return view_at(self.dataset.domain, pixels(SIZE if size is None else size), at, options.get("width"), options.get("zoom"))

    def _asked(self, quantity: str | None, options: PixelOptions) -> tuple[str, View]:
        """Return the quantity, by default the one that suits, and the view of an image in pixels."""
        return quantity or self._core.default_quantity(), self._seen(options)

    def _place(self, options: PlaceOptions, size: tuple[int, int] = SIZE) -> View | None:
        """Return the view of a page of this size; None where nothing is said."""
        seen: Any = {name: options.get(name) for name in PlaceOptions.__annotations__}
        return None if all(value is None for value in seen.values()) else self._seen(seen | {"size": size})

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
        return f"<ppum.Field {', '.join(self.components)} of {self.dataset.title!r}, step {self._number}{changed}>"
