"""Fields of steps: parts, other functions and weights, stress intensity factors, and all that is made of a field."""

from __future__ import annotations

import json
from collections.abc import Mapping
from typing import TYPE_CHECKING, Any, ClassVar, Unpack, overload

from . import _core
from ._compare import Comparing
from ._draw import Drawing
from ._errors import require, warn
from ._export import Exporting
from ._facts import Tip, tips_of
from ._options import passes
from ._sample import Sampling
from ._styles import ViewerOptions
from ._tables import Table

if TYPE_CHECKING:
    from ._widget import Viewer

#: Fields of a series in a file that are kept ready.
KEPT = 4


class Field(Sampling, Comparing, Drawing, Exporting):
    """A field of one step, to be evaluated exactly wherever one likes. Made by `Step.field` and `Dataset.field`.

    It never changes: `part`, `with_function`, `with_weight` and `with_quantity` give others. It can be pickled.

    Example:
        >>> f = ds.field
        >>> round(float(f.at(0.5, 0.25).von_mises), 6)
        1.276572
    """

    #: Makes views, which are of an upper layer; bound by the package.
    _viewer: ClassVar[Any]
    _tips: Table[Tip] | None = None

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
            warn(*told)
            self._tips = tips_of(json.loads(found), ends)
        return self._tips

    @passes(ViewerOptions)
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
        require("anywidget", "anywidget", "views in notebooks")
        made: Viewer = self._viewer(self, quantity, **options)
        return made

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
