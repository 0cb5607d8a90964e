"""Data that all steps of a dataset share: domain, holes, equation, tables, quantities; and the ends of cracks."""

from collections.abc import Iterator, Mapping, Sequence
from contextlib import contextmanager
from typing import Annotated, Any, SupportsFloat, TypedDict

import numpy as np
from numpy.typing import ArrayLike, NDArray

from . import _core
from ._checks import check_shape, check_type, mapping, numbers, rows, scalar, sequence, short, text
from ._cover import Cover
from ._edges import distance, polyline
from ._errors import BuildError
from ._facts import Crack, Hole
from ._mesh import Mesh
from ._options import Option
from ._problem import Anisotropic, Elastic, Poisson
from ._state import State
from ._stiffness import constant, stiffness

Arrays = dict[str, Any]
Material = Anisotropic | Elastic | Poisson
#: Points, and bulges of the edges between them, None without arcs.
Chain = tuple[NDArray[np.float64], NDArray[np.float64] | None]

EQUATION = "the material, for stresses and energy; then the first field is ``displacement`` or ``potential``"
TABLES = "data that formulas read, by name: (x, values), or (x, y, values) with a row of values for each y"


class DatasetOptions(TypedDict, total=False):
    """The data that all steps of a dataset share."""

    title: Annotated[str, Option("", "one line that names the problem")]
    program: Annotated[str, Option("", "name and version of the code that the arrays come from")]
    equation: Annotated[Anisotropic | Elastic | Poisson | None, Option(None, EQUATION)]
    holes: Annotated[Sequence[Hole], Option((), "holes of the domain, with `center` and `radius`, or with `points` and perhaps `bulges`")]
    tables: Annotated[Mapping[str, Sequence[ArrayLike]] | None, Option(None, TABLES)]
    quantities: Annotated[
        Mapping[str, str | tuple[str, str]] | None,
        Option(None, "formulas of components and derivatives by name, or pairs of formula and unit"),
    ]


class BuildOptions(DatasetOptions, total=False):
    """The data that all steps share, and the accuracy that is verified."""

    tolerance: Annotated[
        SupportsFloat, Option(1e-10, "largest difference from `Coefficients.verify` that is no error, relative to the largest value")
    ]


def listed(place: str, given: Any, kind: Any, remedy: str) -> list[Any]:
    entries = sequence(place, given, remedy)
    for k, one in enumerate(entries):
        check_type(f"{place}[{k}]", one, isinstance(one, kind), remedy)
    return entries


@contextmanager
def of_state(number: int, count: int) -> Iterator[None]:
    """Put the state of a series before the places of errors in it."""
    try:
        yield
    except BuildError as error:
        raise BuildError(f"states[{number}].{error}" if count > 1 else str(error)) from None


def shared(series: Sequence[State], options: DatasetOptions) -> Arrays:
    """Return the arrays of what all steps share."""
    holes, tables, quantities = options["holes"], options["tables"], options["quantities"]
    named = _tables({} if tables is None else tables) | _quantities({} if quantities is None else quantities)
    for k, state in enumerate(series):
        with of_state(k, len(series)):
            check_type("cover", state.cover, isinstance(state.cover, (Cover, Mesh)), "a ppum.build.Cover or a ppum.build.Mesh")
    low, high = domain = series[0].cover.domain
    for k, state in enumerate(series):
        if not np.array_equal(state.cover.domain, domain):
            raise BuildError(f"states[{k}].cover.domain: differs from that of states[0]; a series has one domain")
    arrays = {
        "@title": text("title", options["title"]),
        "@program": text("program", options["program"]) or f"ppum {_core.VERSION}, arrays",
        "domain@min": low,
        "domain@max": high,
        "domain@kind": _domain(series[0].cover, holes),
    }
    return arrays | (_holes(holes) if holes else {}) | _equation(options["equation"]) | named


def _domain(cover: Cover | Mesh, holes: Sequence[Hole]) -> str:
    if isinstance(cover, Mesh):
        if holes:
            raise BuildError("holes: the domain of a mesh is what its elements cover; leave them out")
        return "mesh"
    return "box-with-holes" if holes else "box"


def _holes(holes: Sequence[Hole]) -> Arrays:
    points = [_outline(f"holes[{k}]", hole) for k, hole in enumerate(holes)]
    bulges = [bulges_of(f"holes[{k}].bulges", hole.bulges, len(points[k])) for k, hole in enumerate(holes)]
    return {
        "domain/holes/kind": [_kind(hole, given) for hole, given in zip(holes, bulges)],
        "domain/holes/points": np.concatenate(points),
        "domain/holes/offsets": np.cumsum([0, *map(len, points)]),
        "domain/holes/radius": [scalar(f"holes[{k}].radius", h.radius if h.points is None else 0) for k, h in enumerate(holes)],
        **_bulges("domain/holes/bulges", points, bulges),
    }


def _kind(hole: Hole, bulges: NDArray[np.float64] | None) -> str:
    kind = "circle" if hole.points is None else "outside" if hole.is_outside else "polygon"
    return kind if bulges is None else f"curved-{kind}"


def bulges_of(place: str, given: ArrayLike | None, count: int) -> NDArray[np.float64] | None:
    """Return the bulges of so many edges; None if there are no arcs."""
    if given is None:
        return None
    bulges = numbers(place, given)
    check_shape(place, bulges, bulges.shape == (count,), f"({count},), one for each edge")
    return bulges if bulges.any() else None


def _bulges(name: str, points: Sequence[NDArray[np.float64]], bulges: Sequence[NDArray[np.float64] | None]) -> Arrays:
    """Return the array of bulges of the edges behind all points; none without arcs."""
    if all(given is None for given in bulges):
        return {}
    known = [np.empty(0) if given is None else given for given in bulges]
    padded = [np.pad(given, (0, len(of) - len(given))) for of, given in zip(points, known)]
    return {name: np.concatenate(padded)}


def _outline(place: str, hole: Hole) -> NDArray[np.float64]:
    """Return the points of a polygon, or the centre of a circle."""
    if hole.points is None and hole.bulges is not None:
        raise BuildError(f"{place}.bulges: belong to sides between `points`; leave them out")
    if hole.points is not None:
        return rows(f"{place}.points", hole.points, 2)
    if hole.center is None or hole.radius is None:
        raise BuildError(f"{place}: has neither points nor a center and a radius; give either")
    return rows(f"{place}.center", [numbers(f"{place}.center", hole.center)], 2)


def _equation(equation: Material | None) -> Arrays:
    if equation is None:
        return {"equation@kind": "none"}
    if isinstance(equation, Poisson):
        kind = "axisymmetric-poisson" if equation.axisymmetric else "poisson"
        return {"equation@kind": kind, "equation@conductivity": constant("conductivity", equation.conductivity)}
    is_elastic = isinstance(equation, (Anisotropic, Elastic))
    check_type("equation", equation, is_elastic, "ppum.Elastic, ppum.Anisotropic, ppum.Poisson or None")
    given = equation.eigenstrain if equation.eigenstrain is not None or equation.expansion is None else (0.0,) * 4
    if given is not None and (isinstance(given, str) or not hasattr(given, "__len__") or len(given) != 4):
        raise BuildError(f"equation.eigenstrain: is {short(given)}; give four numbers or formulas, of xx, yy, xy and zz")
    strains = dict(zip(("xx", "yy", "xy", "zz"), given or ()))
    constants = {f"eigenstrain_{name}": constant("eigenstrain", value) for name, value in strains.items()}
    constants |= stiffness(equation) if isinstance(equation, Anisotropic) else _isotropic(equation)
    kind = "anisotropic" if isinstance(equation, Anisotropic) else "eigenstrain" if strains else "elasticity"
    named = {f"equation@{name}": value for name, value in constants.items()}
    return {"equation@kind": kind, "equation@state": text("equation.state", equation.state), **named}


def _isotropic(equation: Elastic) -> dict[str, float | str]:
    names = ("young", "poisson") if equation.expansion is None else ("young", "poisson", "expansion")
    return {name: constant(name, getattr(equation, name)) for name in names}


def _tables(tables: Mapping[str, Sequence[ArrayLike]]) -> Arrays:
    arrays: Arrays = {}
    for k, (name, given) in enumerate(mapping("tables", tables, "(x, values)").items()):
        given = sequence(f"tables[{name!r}]", given, "arrays, (x, values) or (x, y, values)")
        if len(given) not in (2, 3):
            raise BuildError(f"tables[{name!r}]: has {len(given)} arrays; give (x, values) or (x, y, values)")
        path = f"tables/{k:04}"
        arrays[f"{path}@name"] = name
        for key, values in zip(("x", "values") if len(given) == 2 else ("x", "y", "values"), given):
            arrays[f"{path}/{key}"] = numbers(f"tables[{name!r}].{key}", values)
    return arrays


def _quantities(quantities: Mapping[str, str | tuple[str, str]]) -> Arrays:
    pairs = [_quantity(name, q) for name, q in mapping("quantities", quantities, "formulas").items()]
    if not pairs:
        return {}
    formula, unit = ([pair[k] for pair in pairs] for k in (0, 1))
    return {"quantities/name": list(quantities), "quantities/formula": formula, "quantities/unit": unit}


def _quantity(name: str, given: Any) -> tuple[str, str]:
    pair = (given, "") if isinstance(given, str) else tuple(sequence(f"quantities[{name!r}]", given, "formula and unit"))
    if len(pair) != 2 or not all(isinstance(part, str) for part in pair):
        raise BuildError(f"quantities[{name!r}]: is {short(given)}; give a formula, or a pair of formula and unit")
    return pair


def components_of(equation: Material | None) -> list[str]:
    if isinstance(equation, (Anisotropic, Elastic)):
        return ["ux", "uy", "temperature"] if equation.expansion is not None else ["ux", "uy"]
    return [] if equation is None else ["u"]


def crack_arrays(state: State, cracks: Sequence[NDArray[np.float64]], holes: Sequence[Hole]) -> Arrays:
    bulges = [_crack_bulges(k, given, len(cracks[k])) for k, given in enumerate(state.cracks)]
    for k, points in enumerate(cracks):
        if len(points) < 2:
            raise BuildError(f"cracks[{k}]: has {len(points)} points; a crack needs two or more")
        same = np.flatnonzero((points[1:] == points[:-1]).all(axis=1))
        if len(same):
            raise BuildError(f"cracks[{k}][{same[0] + 1}]: is the point before it; leave one out")
        line = polyline(points, bulges[k])
        low, high = np.minimum(line[1:], line[:-1]), np.maximum(line[1:], line[:-1])
        if ((high < state.cover.domain[0]) | (low > state.cover.domain[1])).any(axis=1).all():
            box = " to ".join(f"({x:g}, {y:g})" for x, y in state.cover.domain)
            raise BuildError(f"cracks[{k}]: lies outside of the domain, {box}; leave it out, or give its points in this frame")
    named = [list(given.ends) if isinstance(given, Crack) else None for given in state.cracks]
    chains = list(zip(cracks, bulges))
    ends = [known or _ends(k, chains, state.cover, holes) for k, known in enumerate(named)]
    words = [of if given is None else [f"curved-{end}" for end in of] for of, given in zip(ends, bulges)]
    return {
        "cracks/points": np.concatenate([np.empty((0, 2)), *cracks]),
        "cracks/offsets": np.cumsum([0, *map(len, cracks)]),
        "cracks/ends": np.array(words, object).reshape(-1, 2),
        **_bulges("cracks/bulges", cracks, bulges),
    }


def _crack_bulges(k: int, crack: Any, points: int) -> NDArray[np.float64] | None:
    return bulges_of(f"cracks[{k}].bulges", crack.bulges, points - 1) if isinstance(crack, Crack) else None


def _ends(crack: int, cracks: Sequence[Chain], cover: Cover | Mesh, holes: Sequence[Hole]) -> list[str]:
    (x0, y0), (x1, y1) = cover.domain.tolist()
    border: list[Chain] = [(np.array([(x0, y0), (x1, y0), (x1, y1), (x0, y1), (x0, y0)]), None)]
    border += [(np.concatenate([h.points, h.points[:1]]), h.bulges) for h in holes if h.points is not None]
    near = 1e-9 * max(x1 - x0, y1 - y0)
    others = [chain for k, chain in enumerate(cracks) if k != crack]

    def kind(p: NDArray[np.float64]) -> str:
        rims = [abs(np.hypot(*(p - np.array(h.center))) - (h.radius or 0)) for h in holes if h.center]
        if min([distance(p, *chain) for chain in border] + rims) <= near:
            return "mouth"
        return "junction" if any(distance(p, *chain) <= near for chain in others) else "tip"

    points, _ = cracks[crack]
    return [kind(points[0]), kind(points[-1])]
