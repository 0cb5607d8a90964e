"""Fields that are built compared with the evaluation of the code that they come from."""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING, Any, Protocol

import numpy as np
from numpy.typing import ArrayLike, NDArray

from .errors import BuildError

if TYPE_CHECKING:
    from .building import Coefficients, State

Floats = NDArray[np.float64]
Reference = Callable[[Floats, Floats], ArrayLike] | tuple[ArrayLike, ArrayLike]

POINTS = 1000
#: Points beside each face of a crack, and how far from it, in parts of the domain's size.
BESIDE, DISTANCE = 50, 1e-7


class Evaluated(Protocol):
    """The fields of a step by their numbers."""

    def field(self, number: int) -> Any: ...


def verified(made: Evaluated, state: State, tolerance: float) -> dict[str, float]:
    """Largest differences of the fields that have a reference, by their names, in parts of their largest values."""
    from .building import Coefficients

    fields = [state.fields] if isinstance(state.fields, Coefficients) else state.fields
    found = {}
    for number, given in enumerate(fields):
        if given.verify is not None:
            found[given.name] = _compared(given, made.field(number), state, tolerance)
    return found


def _compared(given: Coefficients, field: Any, state: State, tolerance: float) -> float:
    place = f"fields[{given.name!r}].verify"
    names = field._core.components()
    if callable(given.verify):
        x, y = _points(state, field).T
        wanted = given.verify(x.copy(), y.copy())
    else:
        points, wanted = given.verify  # type: ignore[misc]
        x, y = _given(place, points).T
    values = field.evaluate(x, y, names)
    outside = np.flatnonzero(np.isnan(values).any(axis=1))
    if len(outside):
        k = outside[0]
        raise BuildError(f"{place}[{k}]: the field has no value at ({x[k]:g}, {y[k]:g}); give points of the domain")
    return _difference(place, given.name, (x, y), values, _shaped(place, wanted, values.shape), tolerance)


def _difference(
    place: str, name: str, at: tuple[Floats, Floats], values: Floats, wanted: Floats, tolerance: float
) -> float:
    scale = float(np.abs(wanted).max()) or 1.0
    differences = np.abs(values - wanted).max(axis=1) / scale
    k = int(np.argmax(differences))
    worst, count = float(differences[k]), len(values)
    if not worst <= tolerance:
        share = np.mean(~(differences <= tolerance))
        raise BuildError(
            f"{place}: at ({at[0][k]:.6g}, {at[1][k]:.6g}) the arrays give {_short(values[k])}, verify "
            f"{_short(wanted[k])}: a difference of {worst:.1e} of the largest value, and more than {tolerance:g} at "
            f"{share:.0%} of {count} points. Look at the order of the coefficients (1, ξ, η, ξ², ξη, η², …), origin and "
            "scale of ξ, the weight, and the order of the patches"
        )
    print(f"verified: field {name!r} at {count} points, largest difference {worst:.1e} of its largest value")
    return worst


def _short(values: Floats) -> str:
    return ", ".join(f"{v:.6g}" for v in values)


def _given(place: str, points: ArrayLike) -> Floats:
    array = np.asarray(points, float)
    if array.ndim != 2 or array.shape[1] != 2 or not len(array):
        raise BuildError(f"{place}: the points have the shape {array.shape}, expected (k, 2)")
    return array


def _shaped(place: str, wanted: ArrayLike, shape: tuple[int, int]) -> Floats:
    array = np.asarray(wanted, float)
    if array.shape == shape[:1] and shape[1] == 1:
        array = array[:, None]
    if array.shape != shape:
        raise BuildError(f"{place}: gives values of the shape {array.shape}, expected {shape}: points and components")
    wrong = np.flatnonzero(~np.isfinite(array).all(axis=1))
    if len(wrong):
        raise BuildError(f"{place}: gives {array[wrong[0]]} at point {wrong[0]}; give finite numbers")
    return array


def _points(state: State, field: Any) -> Floats:
    """Random points in the domain, the same for the same cover: of patches that are taken in turn, and beside cracks."""
    random = np.random.default_rng(len(state.cover))
    points = np.empty((0, 2))
    while len(points) < POINTS:
        points = np.concatenate([points, _inside(state.cover.spread(random, POINTS), state, field)])
    beside = [_inside(_beside(np.asarray(c), state, random), state, field) for c in _cracks(state)]
    return np.concatenate([points[:POINTS], *beside])


def _cracks(state: State) -> list[Any]:
    return [getattr(crack, "points", crack) for crack in state.cracks]


def _beside(crack: Floats, state: State, random: np.random.Generator) -> Floats:
    """Points close to both faces of a crack."""
    segments = np.diff(crack, axis=0)
    lengths = np.hypot(*segments.T)
    k = random.choice(len(segments), BESIDE, p=lengths / lengths.sum())
    on = crack[k] + segments[k] * random.uniform(0, 1, (BESIDE, 1))
    normal = np.column_stack([-segments[k, 1], segments[k, 0]]) / lengths[k, None]
    off = DISTANCE * float(np.ptp(state.cover.domain, axis=0).max()) * normal
    return np.concatenate([on + off, on - off])


def _inside(points: Floats, state: State, field: Any) -> Floats:
    low, high = state.cover.domain
    inside = points[((points >= low) & (points <= high)).all(axis=1)]
    values = field.evaluate(inside[:, 0], inside[:, 1], field._core.components()[:1])
    return np.asarray(inside[~np.isnan(values[:, 0])])
