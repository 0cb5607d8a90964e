"""Weight functions: K of any load on a body, its derivatives, and the displacement of growing cracks."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

from . import _core
from ._dataset import Dataset, Step
from ._problem import Problem
from ._text import plain, toml_lines

_Floats = NDArray[np.float64]
_Pressure = Callable[[_Floats], ArrayLike] | float | str


class Factors(NamedTuple):
    """K_I and K_II, stress · length^½; 0 for a mode that a symmetric body does not have."""

    k1: float
    k2: float


@dataclass(frozen=True, eq=False)
class Influence:
    """Points on a part of the boundary, or inside, and K of what acts there: sums of products, a load case each.

    Attributes:
        xy: The points, shape (n, 2).
        normals: Normals out of the body, shape (n, 2); zero inside.
        below: Whether points lie on the face to the right of a crack, shape (n,).
        lengths: The length of the tip's crack from its start to the place nearest to a point, shape (n,).
        forces: K_I and K_II of a traction or body force 1 along x and y on the share of a point, shape (2, n, 2).
        strains: K_I and K_II of strains ε⁰_xx, ε⁰_yy and 2ε⁰_xy there, shape (2, n, 3); no numbers on boundaries.
    """

    xy: _Floats
    normals: _Floats
    below: NDArray[np.bool_]
    lengths: _Floats
    forces: _Floats
    strains: _Floats

    def k(self, loads: ArrayLike) -> _Floats:
        """Return K_I and K_II of tractions or body forces at the points.

        Args:
            loads: Shape (…, n, 2): any number of load cases.

        Returns:
            Shape (…, 2).
        """
        loads = np.asarray(loads, float)
        cases = loads.reshape(*loads.shape[:-2], -1) @ self.forces.reshape(2, -1).T
        return np.asarray(cases)

    def pressures(self) -> _Floats:
        """Return K_I and K_II of a pressure 1 on the share of each point, shape (2, n): ``p @ pressures().T`` is K."""
        return np.asarray(-np.einsum("ni,mni->mn", self.normals, self.forces))


class Weight:
    """The weight functions of one tip. Made by `Dataset.weight`.

    Example:
        >>> w = ds.weight(tip=1)
        >>> k = w.k(edges={"top": (0, 1), "bottom": (0, -1)})
        >>> abs(k.k1 - ds.tips[1].k1) < 1e-3
        True
    """

    def __init__(self, solution: Dataset, step: Step, tip: int, memory: int | None = None) -> None:
        problem = solution.problem
        if problem is None:
            raise ValueError("the dataset holds no problem, so that nothing is known of its body's boundary")
        core, modes = _core.weight_functions(solution._core, step.number, tip, memory, None)
        #: The dataset of the weight functions, a step for each mode, to be drawn like any field: ``ux`` and ``uy`` are K of
        #: a unit force at a point, ``sxx`` and ``syy`` that of a strain there.
        self.dataset = Dataset(core)
        #: The number of the tip.
        self.tip = tip
        self._modes, self._solution, self._step, self._problem = modes, solution, step, problem
        self._known: dict[Any, Influence] = {}

    @property
    def modes(self) -> tuple[str, ...]:
        """The mode of each step of `dataset`: ``I`` and ``II``, or the one that a symmetric body has."""
        return tuple("I" if mode == 0 else "II" for mode in self._modes)

    def k(
        self,
        problem: Problem | Mapping[str, Any] | None = None,
        *,
        faces: _Pressure | None = None,
        edges: Mapping[str, Sequence[float | str]] | None = None,
        body_force: Sequence[float | str] | None = None,
        temperature: float | str | None = None,
        strain: Sequence[float | str] | None = None,
        point: tuple[ArrayLike, ArrayLike] | None = None,
    ) -> Factors:
        """Return K of loads, the sum of all that are given; what the body was solved with does not act.

        Formulas are integrated up to their jumps and layers. Loads of a body that nothing holds must balance.

        Args:
            problem: Another problem on the same body, held in the same way, with all its loads.
            faces: Pressure on both faces of the crack, a value or formula of x and y, or a function of the lengths along the
                crack from its start, which should be smooth: it is taken at the points of `influence`.
            edges: Tractions by the names of edges, each a value or a formula of x and y.
            body_force: Force per area, two values.
            temperature: Change of temperature, of a material with ``expansion``.
            strain: Given strains xx, yy, xy and zz.
            point: A place and the force there.

        Raises:
            SolveError: The loads do not balance, or act on another body.
            ProblemError: They are no loads of the body, such as a traction where it is held.
        """
        spec = self._unloaded()
        if problem is not None:
            spec = (problem if isinstance(problem, Problem) else Problem.from_dict(problem)).to_dict()
        boundary = [*spec.get("boundary", ()), *({"on": on, "traction": list(t)} for on, t in (edges or {}).items())]
        if faces is not None and not callable(faces):
            boundary.append({"on": {"crack": self._crack}, "pressure": faces})
        if body_force is not None:
            spec["body_force"] = {"value": list(body_force)}
        if temperature is not None:
            spec["temperature"] = {"value": temperature}
        if strain is not None:
            spec["strain"] = dict(zip(("xx", "yy", "xy", "zz"), strain))
        if point is not None:
            at, value = point
            spec["force"] = [*spec.get("force", ()), {"at": at, "value": value}]
        found = self._factors(_core.factor(self.dataset._core, self._text({**spec, "boundary": boundary})))
        if callable(faces):
            influence = self.influence({"crack": self._crack})
            more = np.asarray(faces(influence.lengths), float) @ influence.pressures().T
            found = Factors(found.k1 + float(more[0]), found.k2 + float(more[1]))
        return found

    def influence(self, on: str | Mapping[str, Any] | None = None) -> Influence:
        """Return the points on a part of the boundary, as in `Problem.boundary`, or inside, and K of what acts there.

        With it K of a load case is a sum of products, hundred thousands a second.
        """
        key = repr(on)
        if key not in self._known:
            spec, condition = self._unloaded(), None
            if on is not None:
                condition = len(spec["boundary"])
                spec["boundary"] = [*spec["boundary"], {"on": on, "traction": [0.0, 0.0]}]
            parts = [_core.influence(self.dataset._core, k, self._text(spec), condition) for k in range(len(self._modes))]
            forces, strains = (self._of_modes([part[k] for part in parts]) for k in (4, 5))
            self._known[key] = Influence(*parts[0][:4], forces, strains)
        return self._known[key]

    def polynomials(self, count: int = 5) -> _Floats:
        """Return the influence coefficients of powers of pressures on the crack, shape (2, count).

        K = √(πa) Σ σ_j G_j of the stress Σ σ_j ξ^j across the crack, in the uncracked body. ξ goes from 0 at the other end to 1
        at the tip of a crack of the length a, and from −1 to 1 along one of two tips, whose length is 2a.
        """
        return self._of_modes(np.asarray(_core.polynomials(self.dataset._core, count), float))

    def rates(self, k: tuple[float, float] | None = None) -> Dataset:
        """Return the change of the displacement with the length of the crack, if it grows straight on at the tip.

        Args:
            k: K_I and K_II of the load; by default those of the solution.
        """
        tip = self._step.tips[self.tip]
        both = (tip.k1, tip.k2) if k is None else k
        return Dataset(_core.rate(self.dataset._core, [(step, both[mode]) for step, mode in enumerate(self._modes)]))

    def derivative(self, make: Callable[[float], Problem], value: float, step: float = 1e-4) -> Factors:
        """Return the derivatives of K by a parameter of loads, or of the material away from the tip.

        Args:
            make: Returns the problem for a value of the parameter; the solution is that of `value`.
            value: The value.
            step: Values are taken so far above and below, of formulas: nothing is solved again.

        Raises:
            SolveError: The parameter changes the body, or its material at the tip in another way than by a factor.
        """
        ends = [self._text(make(value + sign * step).to_dict()) for sign in (-1, 1)]
        return self._factors(_core.derivative(self.dataset._core, self._solution._core, ends, 2 * step))

    @property
    def _crack(self) -> int:
        return int(self._step.tips[self.tip].crack)

    def _factors(self, values: Sequence[float]) -> Factors:
        of_mode = dict(zip(self._modes, values))
        return Factors(of_mode.get(0, 0.0), of_mode.get(1, 0.0))

    def _of_modes(self, parts: Any) -> _Floats:
        both = np.zeros((2, *np.shape(parts[0])))
        both[self._modes] = parts
        return both

    def _text(self, spec: Mapping[str, Any]) -> tuple[str, str, Any]:
        return toml_lines(plain(dict(spec)))[0], self._problem._name, self._problem._folder

    def _unloaded(self) -> dict[str, Any]:
        """Return the problem without loads."""
        spec = {key: value for key, value in self._problem.to_dict().items() if key not in _LOADS}
        kept = []
        for condition in spec.get("boundary", ()):
            held = {key: value for key, value in condition.items() if key not in ("traction", "pressure")}
            if isinstance(held.get("displacement"), (list, tuple)):
                held["displacement"] = [0.0 if part != "free" else part for part in held["displacement"]]
            if len(held) > 1:
                kept.append(held)
        return {**spec, "boundary": kept, "body_force": {"value": [0.0, 0.0]}}


#: Sections that load a body, or go with its loads.
_LOADS = ("force", "body_force", "temperature", "strain", "exact", "quantity", "growth", "adaptivity", "support")


def weight(self: Dataset, tip: int = 0, *, step: int = -1, memory: int | None = None) -> Weight:
    """Compute the weight functions of a tip: they give K of any load on the body by an integral.

    Args:
        tip: Number of the tip, see `tips`.
        step: Number of the step, whose cracks are taken.
        memory: Most bytes that may be used.

    Raises:
        SolveError: Faces may touch, or the cells are too large for the tip.
        IndexError: There is no such tip.

    Example:
        >>> ds.weight(tip=0).modes
        ('I', 'II')
    """
    return Weight(self, self.steps[step], tip, memory)
