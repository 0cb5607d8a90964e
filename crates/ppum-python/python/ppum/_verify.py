"""Fields that are built compared with the evaluation of the code that they come from."""

import logging
from collections.abc import Callable, Mapping, Sequence
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ._checks import check_shape, numbers, real, short
from ._edges import along, lengths
from ._errors import BuildError
from ._functions import Component, Formula, Jump, Level
from ._state import Coefficients, Sampled, State
from ._units import Floats

LOG = logging.getLogger("ppum")

POINTS = 1000
#: Points beside each face of a crack, and how far from it, in parts of the domain's size.
BESIDE, DISTANCE = 50, 1e-7


def verified(field: Callable[[int], Any], state: State, tolerance: float) -> dict[str, float]:
    """Return the largest differences of fields from their references, relative to their largest values, by name.

    The function `field` returns a field of the step by its number.
    """
    fields = [state.fields] if isinstance(state.fields, Coefficients) else state.fields
    return {g.name: _compared(g, field(k), state, tolerance) for k, g in enumerate(fields) if g.verify is not None}


def _compared(given: Coefficients, field: Any, state: State, tolerance: float) -> float:
    place = f"fields[{given.name!r}].verify"
    names = field._core.components()
    if callable(given.verify):
        x, y = _points(state, field).T
        wanted = given.verify(x.copy(), y.copy())
    else:
        if not isinstance(given.verify, (tuple, list)) or len(given.verify) != 2:
            raise BuildError(f"{place}: is {short(given.verify)}; give a function of x and y, or a pair of points and values")
        points, wanted = given.verify
        x, y = _given(place, points).T
    values = field.evaluate(x, y, names)
    outside = np.flatnonzero(np.isnan(values).any(axis=1))
    if len(outside):
        k = outside[0]
        raise BuildError(f"{place}[{k}]: the field has no value at ({x[k]:g}, {y[k]:g}); give points of the domain")
    wanted = _shaped(place, wanted, values.shape)
    scale = float(np.abs(wanted).max()) or 1.0
    differences = np.abs(values - wanted).max(axis=1) / scale
    k = int(np.argmax(differences))
    worst, count = float(differences[k]), len(values)
    if not worst <= tolerance:
        wrong = ~(differences <= tolerance)
        raise BuildError(
            f"{place}: at ({x[k]:.6g}, {y[k]:.6g}) the arrays give {_short(values[k])}, verify "
            f"{_short(wanted[k])}: a difference of {worst:.1e} of the largest value, and more than {tolerance:g} at "
            f"{np.mean(wrong):.0%} of {count} points. {_remedy(given, field, state, (x, y), wrong)}"
        )
    LOG.info("verified: field %r at %d points, largest difference %.1e of its largest value", given.name, count, worst)
    return worst


#: What goes wrong with functions, by their kinds.
LOOKS = {
    Jump: "the direction of its crack, on whose left it is +1 and on whose right -1, and factors: H is (1 + jump)/2",
    Level: "the sign of its level field, +1 where that is ≥ 0, and factors: H is (1 + level)/2",
    Component: "its cuts, left before right, with -1 for outside and -2 for inside",
    Formula: "its formula and parameters, its frame (origin, end of the crack, angle in radians), and the branch of theta",
}


def _remedy(given: Coefficients, field: Any, state: State, at: tuple[Floats, Floats], wrong: NDArray[np.bool_]) -> str:
    """Describe what may be the reason for differences at some of the points."""
    if isinstance(given.verify, Sampled):
        return (
            "The field is not a polynomial of this degree on elements; interpolate it into L2, a discontinuous space, of a "
            "degree up to 8, or give the degree by order="
        )
    functions = [name for name in given.blocks if name != "one"]
    touched = {name: _touched(field, name, at) for name in functions}
    near = [name for name, where in touched.items() if where[wrong].all() and not where.all()]
    if near and not wrong.all():
        least = min(int(touched[name].sum()) for name in near)
        named = [name for name in near if touched[name].sum() == least]
        patches = state.cover.around(np.column_stack(at)[wrong])
        return (
            f"All these points are on patches with {' and '.join(map(repr, named))}, such as "
            f"{_few(patches, given, named)}: look at {_looks(state, named)}"
        )
    others = f"; and of {', '.join(map(repr, functions))} at {_looks(state, functions)}" if functions else ""
    return (
        f"Look at the order of the coefficients (1, ξ, η, ξ², ξη, η², …), {state.cover.FRAME}, and the order of the "
        f"patches{others}"
    )


def _looks(state: State, names: Sequence[str]) -> str:
    kinds = {type(state.functions[name]) for name in names}
    return "; ".join(look for kind, look in LOOKS.items() if kind in kinds or kind is Formula and str in kinds)


def _touched(field: Any, function: str, at: tuple[Floats, Floats]) -> NDArray[np.bool_]:
    """Return True for points where a function is a part of the field."""
    names = field._core.components()
    with_, without = (f.evaluate(*at, names) for f in (field, field.with_function({function: "0"})))
    different: NDArray[np.bool_] = (with_ != without).any(axis=1)
    return different


def _few(patches: Sequence[int], given: Coefficients, functions: Sequence[str]) -> str:
    """Name some of the patches that have a function."""
    blocks = [given.blocks[name] for name in functions]
    having = [k for k in patches if all(k in b if isinstance(b, Mapping) else b[k] is not None for b in blocks)]
    return ", ".join(map(str, having[:5])) + (", …" if len(having) > 5 else "")


def _short(values: Floats) -> str:
    return ", ".join(f"{v:.6g}" for v in values)


def _given(place: str, points: ArrayLike) -> Floats:
    array = numbers(f"{place}[0]", points)
    check_shape(f"{place}[0]", array, array.shape[1:] == (2,) and len(array) > 0, "(k, 2): points")
    return array


def _shaped(place: str, wanted: ArrayLike, shape: tuple[int, int]) -> Floats:
    array = real(place, wanted)
    if array.shape == shape[:1] and shape[1] == 1:
        array = array[:, None]
    if array.shape != shape:
        raise BuildError(f"{place}: gives values of the shape {array.shape}, expected {shape}: points and components")
    wrong = np.flatnonzero(~np.isfinite(array).all(axis=1))
    if len(wrong):
        raise BuildError(f"{place}: gives {array[wrong[0]]} at point {wrong[0]}; give finite numbers")
    return array


def _points(state: State, field: Any) -> Floats:
    """Return random points of patches taken in turn and beside cracks, the same for the same cover."""
    random = np.random.default_rng(len(state.cover))
    points = np.empty((0, 2))
    while len(points) < POINTS:
        points = np.concatenate([points, _inside(state.cover.spread(random, POINTS), state, field)])
    beside = [_inside(_beside(*crack, state, random), state, field) for crack in _cracks(state)]
    return np.concatenate([points[:POINTS], *beside])


def _cracks(state: State) -> list[tuple[Floats, Floats | None]]:
    """Return points and bulges of the cracks."""
    return [(np.asarray(getattr(crack, "points", crack)), getattr(crack, "bulges", None)) for crack in state.cracks]


def _beside(points: Floats, bulges: Floats | None, state: State, random: np.random.Generator) -> Floats:
    """Return points close to both faces of a crack."""
    chords, sizes = np.diff(points, axis=0), lengths(points, bulges)
    k = random.choice(len(chords), BESIDE, p=sizes / sizes.sum())
    given = np.zeros(len(chords)) if bulges is None else np.asarray(bulges)
    way, tangents = along(chords[k], given[k], random.uniform(0, 1, BESIDE))
    off = DISTANCE * float(np.ptp(state.cover.domain, axis=0).max()) * np.column_stack([-tangents[:, 1], tangents[:, 0]])
    return np.concatenate([points[k] + way + off, points[k] + way - off])


def _inside(points: Floats, state: State, field: Any) -> Floats:
    low, high = state.cover.domain
    inside = points[((points >= low) & (points <= high)).all(axis=1)]
    values = field.evaluate(inside[:, 0], inside[:, 1], field._core.components()[:1])
    return np.asarray(inside[~np.isnan(values[:, 0])])
