"""Datasets from the arrays of one's own code."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from . import _core
from .blocks import Block, Blocks, arranged
from .cover import Cover, numbers, rows
from .mesh import Mesh
from .dataset import Crack, Dataset, Hole
from .enriching import Function, columns
from .errors import BuildError
from .packing import packed
from .problem import Elastic, Poisson
from .verifying import Reference, verified

__all__ = ["Coefficients", "State", "arrays", "build", "from_arrays"]

Arrays = dict[str, Any]


@dataclass(frozen=True, eq=False)
class Coefficients:
    """A field: on each patch a sum of function × polynomial, by the coefficients of the polynomials.

    A polynomial of degree d, at most 8, has m = (d + 1)(d + 2)/2 coefficients of 1, ξ, η, ξ², ξη, η², ξ³, … with
    ξ = (p − origin) / scale of the cover, or ξ of the mesh; `ppum.basis` converts those of other bases. On meshes it may
    be a tensor product, with m = (d + 1)² coefficients of 1, ξ, …, ξ^d, η, ξη, …

    Attributes:
        name: Its name. With an equation the first field is ``displacement`` or ``potential``.
        blocks: The coefficients by the name of the function, ``one`` for 1 or a name of `State.functions`. An array of
            shape (n, m), with several components (n, m, c), for all n patches; a list with an array (m,) or (m, c) or
            None for each patch; or a dictionary of such arrays by the number of the patch.
        components: Their names; by default ``ux``, ``uy`` of ``displacement``, of others its name, with 0, 1, … if
            there are several.
        unit: For labels.
        exact: Formulas of x and y of the exact solution, one per component.
        verify: One's own evaluation, with which the field is compared: a function of arrays x and y that gives values
            of shape (k,) or (k, c), or a pair of points (k, 2) and such values.
        space: On meshes the polynomials, of all functions or by their names: ``shape``, tensor products on squares alone;
            ``total`` degree; or ``tensor``.

    Example:
        >>> cover = ppum.Cover.uniform([(0, 0), (2, 1)], cells=(2, 1))
        >>> c = np.column_stack([cover.center[:, 0], cover.half[:, 0], np.zeros(2)])
        >>> made = ppum.build(ppum.State(cover, ppum.Coefficients("u", {"one": c}, verify=lambda x, y: x)))
        verified: field 'u' at 1000 points, largest difference ... of its largest value
        >>> float(made.field.at(1.25, 0.5).u)
        1.25
    """

    name: str
    blocks: Mapping[str, Block]
    components: Sequence[str] | None = None
    unit: str = ""
    exact: Sequence[str] = ()
    verify: Reference | None = None
    space: str | Mapping[str, str | Sequence[str]] = "shape"


@dataclass(frozen=True, eq=False)
class State:
    """One step of a series: a cover or a mesh, its fields, the cracks and functions that they need.

    Attributes:
        cover: The partition of unity, or the elements.
        fields: One field or several; pictures and quantities are of the first.
        cracks: Points of each crack, shape (k, 2), or `ppum.Crack`. By default an end on the border of the domain or of a
            hole is a ``mouth``, one on another crack a ``junction``, any other a ``tip``; values do not depend on it.
        functions: Functions beside ``one`` by name: `Jump`, `Component`, `Level`, `Formula` or the text of a formula of x and y.
        attributes: Values for each patch by name, shape (n,), NaN for none.
        load: Load factor or time.
    """

    cover: Cover | Mesh
    fields: Coefficients | Sequence[Coefficients]
    cracks: Sequence[ArrayLike | Crack] = ()
    functions: Mapping[str, Function] = field(default_factory=dict)
    attributes: Mapping[str, ArrayLike] = field(default_factory=dict)
    load: float = 1.0


def build(
    states: State | Sequence[State],
    *,
    title: str = "",
    program: str = "",
    equation: Elastic | Poisson | None = None,
    holes: Sequence[Hole] = (),
    tables: Mapping[str, Sequence[ArrayLike]] | None = None,
    quantities: Mapping[str, str | tuple[str, str]] | None = None,
    tolerance: float = 1e-10,
) -> Dataset:
    """The dataset of arrays. It is in memory, draws, evaluates and saves as any other.

    Args:
        states: One step, or the steps of a series, on one domain.
        title: One line that names the problem.
        program: Name and version of the code that the arrays come from.
        equation: The material, if there are to be stresses or energy: then the first field is ``displacement`` or
            ``potential``. Without one there are values, derivatives and the dataset's own quantities.
        holes: Holes of the domain: `ppum.Hole` with `center` and `radius`, or with `points`, the others None.
        tables: Data that formulas read, by name: (x, values), or (x, y, values) with a row of values for each y.
        quantities: Formulas of components and derivatives by name, or pairs of formula and unit.
        tolerance: Largest difference from `Coefficients.verify` that is no error, in parts of the largest value.

    Raises:
        BuildError: What is wrong, with the array, the row and the remedy, before anything is written; or a field that is
            not the one of its `verify`.

    `Coefficients.verify` is compared at 1000 random points, spread over the patches, and at 100 points close to both
    sides of each crack. The largest difference is printed, and kept in `Step.history`, as ``verified NAME``.
    """
    named = arrays(
        states, title=title, program=program, equation=equation, holes=holes, tables=tables, quantities=quantities
    )
    made, records = from_arrays(named), dict[str, Any]()
    for k, state in enumerate([states] if isinstance(states, State) else states):
        found = verified(_Evaluated(made, named, k), state, tolerance)
        records |= _history(f"steps/{k:04}/history", found)
    return from_arrays(named | records) if records else made


def arrays(
    states: State | Sequence[State],
    *,
    title: str = "",
    program: str = "",
    equation: Elastic | Poisson | None = None,
    holes: Sequence[Hole] = (),
    tables: Mapping[str, Sequence[ArrayLike]] | None = None,
    quantities: Mapping[str, str | tuple[str, str]] | None = None,
) -> Arrays:
    """The arrays and attributes of a dataset by their paths in the file format (FORMAT.md, section 3), for files that are
    written elsewhere: `build` hands them to `from_arrays`. Arguments are as of `build`; nothing is verified.

    Example:
        >>> mesh = ppum.Mesh.from_nodes([[(0, 0), (2, 0), (0, 1)]])
        >>> made = ppum.arrays(ppum.State(mesh, ppum.Coefficients("u", {"one": [[1.0]]})))
        >>> made["steps/0000/partition/map"].tolist()
        [[1.3333333333333333, 0.0], [0.0, 0.6666666666666666]]
    """
    series = [states] if isinstance(states, State) else list(states)
    if not series:
        raise BuildError("states: a dataset needs at least one step")
    named = _head(series, title, program, equation, holes)
    named |= _tables(tables or {}) | _quantities(quantities or {})
    for k, state in enumerate(series):
        named |= _step(f"steps/{k:04}", state, equation, holes)
    return named


def from_arrays(arrays: Mapping[str, Any]) -> Dataset:
    """The dataset of arrays and attributes by the paths that the file format has for them (FORMAT.md, section 3), such as
    ``steps/0000/partition/center`` and ``steps/0000@load``. `build` makes such arrays.

    Numbers become those of the format's types; objects that are not optional have to be there, but for ``@format`` and
    ``@format_version``.

    Raises:
        BuildError: All that is wrong, a line for each array.

    Example:
        >>> ppum.from_arrays({"@title": "Nothing"})
        Traceback (most recent call last):
        ...
        ppum.BuildError: @program: is missing
        ...
    """
    return Dataset(_core.build([packed(path, value) for path, value in arrays.items()]))


class _Evaluated:
    """The fields of a step: only the first of a dataset can be evaluated, so others take its place in datasets of their
    own."""

    def __init__(self, made: Dataset, arrays: Arrays, step: int) -> None:
        self.made, self.arrays, self.step = made, arrays, f"steps/{step:04}"
        self.number = step

    def field(self, number: int) -> Any:
        if number == 0:
            return self.made.steps[self.number].field
        of, to = (f"{self.step}/fields/{k:04}" for k in (number, 0))
        left_out = ("equation", "quantities", to)
        others = {k: v for k, v in self.arrays.items() if not k.startswith(left_out)}
        this = {k.replace(of, to): v for k, v in others.items() if k.startswith(of)}
        one = {k: v for k, v in (others | this).items() if not k.startswith("steps/") or k.startswith(self.step)}
        moved = {k.replace(self.step, "steps/0000"): v for k, v in one.items()}
        name = f"{moved['steps/0000/fields/0000@name']}, compared"
        return from_arrays(moved | {"equation@kind": "none", "steps/0000/fields/0000@name": name}).field


def _head(
    series: Sequence[State],
    title: str,
    program: str,
    equation: Elastic | Poisson | None,
    holes: Sequence[Hole],
) -> Arrays:
    low, high = domain = series[0].cover.domain
    for k, state in enumerate(series):
        if not np.array_equal(state.cover.domain, domain):
            raise BuildError(f"states[{k}].cover.domain: differs from that of states[0]; a series has one domain")
    arrays = {
        "@title": title,
        "@program": program or f"ppum {_core.VERSION}, arrays",
        "domain@min": low,
        "domain@max": high,
        "domain@kind": _domain(series[0].cover, holes),
    }
    return arrays | (_holes(holes) if holes else {}) | _equation(equation)


def _domain(cover: Cover | Mesh, holes: Sequence[Hole]) -> str:
    if isinstance(cover, Mesh):
        if holes:
            raise BuildError("holes: the domain of a mesh is what its elements cover; leave them out")
        return "mesh"
    return "box-with-holes" if holes else "box"


def _holes(holes: Sequence[Hole]) -> Arrays:
    points = [
        rows(f"holes[{k}].points", hole.points, 2)
        if hole.points is not None
        else rows(f"holes[{k}].center", [hole.center or (np.nan, np.nan)], 2)
        for k, hole in enumerate(holes)
    ]
    return {
        "domain/holes/kind": [
            "circle" if h.points is None else "outside" if h.is_outside else "polygon" for h in holes
        ],
        "domain/holes/points": np.concatenate(points),
        "domain/holes/offsets": np.cumsum([0, *map(len, points)]),
        "domain/holes/radius": [float(h.radius or 0) for h in holes],
    }


def _equation(equation: Elastic | Poisson | None) -> Arrays:
    if equation is None:
        return {"equation@kind": "none"}
    if isinstance(equation, Poisson):
        return {"equation@kind": "poisson", "equation@conductivity": _constant(equation.conductivity)}
    given = equation.eigenstrain if equation.eigenstrain is not None or equation.expansion is None else (0.0,) * 4
    strains = dict(zip(("xx", "yy", "xy", "zz"), given or (), strict=given is not None))
    return {
        "equation@kind": "eigenstrain" if strains else "elasticity",
        "equation@young": _constant(equation.young),
        "equation@poisson": _constant(equation.poisson),
        "equation@state": equation.state,
        **{f"equation@eigenstrain_{name}": _constant(value) for name, value in strains.items()},
        **({} if equation.expansion is None else {"equation@expansion": _constant(equation.expansion)}),
    }


def _constant(value: float | str) -> float | str:
    return value if isinstance(value, str) else float(value)


def _tables(tables: Mapping[str, Sequence[ArrayLike]]) -> Arrays:
    arrays: Arrays = {}
    for k, (name, given) in enumerate(tables.items()):
        if len(given) not in (2, 3):
            raise BuildError(f"tables[{name!r}]: has {len(given)} arrays; give (x, values) or (x, y, values)")
        path = f"tables/{k:04}"
        arrays[f"{path}@name"] = name
        for key, values in zip(("x", "values") if len(given) == 2 else ("x", "y", "values"), given):
            arrays[f"{path}/{key}"] = numbers(f"tables[{name!r}].{key}", values)
    return arrays


def _quantities(quantities: Mapping[str, str | tuple[str, str]]) -> Arrays:
    if not quantities:
        return {}
    pairs = [(q, "") if isinstance(q, str) else q for q in quantities.values()]
    formula, unit = ([pair[k] for pair in pairs] for k in (0, 1))
    return {"quantities/name": list(quantities), "quantities/formula": formula, "quantities/unit": unit}


def _step(path: str, state: State, equation: Elastic | Poisson | None, holes: Sequence[Hole]) -> Arrays:
    cover = state.cover
    fields = [state.fields] if isinstance(state.fields, Coefficients) else list(state.fields)
    if not fields:
        raise BuildError("fields: a step needs at least one field")
    cracks = [
        rows(f"cracks[{k}]", c.points if isinstance(c, Crack) else c, 2) for k, c in enumerate(state.cracks)
    ]
    functions: dict[str, Any] = {"one": None}
    if "one" in state.functions:
        raise BuildError("functions['one']: is the function 1 already; give yours another name")
    functions |= state.functions
    names = [one.name for one in fields]
    group = {"@load": float(state.load), **_partition(cover, names), **_cracks(state, cracks, holes)}
    segments = [len(points) - 1 for points in cracks]
    group |= {f"functions/{k}": v for k, v in columns(functions, segments, names).items()}
    for k, one in enumerate(fields):
        data = _field(one, cover, list(functions), equation if k == 0 else None)
        group |= {f"fields/{k:04}{'' if name.startswith('@') else '/'}{name}": v for name, v in data.items()}
    group |= _attributes(state.attributes, len(cover))
    return {f"{path}{'' if k.startswith('@') else '/'}{k}": v for k, v in group.items()}


def _partition(cover: Cover | Mesh, fields: Sequence[str]) -> Arrays:
    arrays: Arrays = {f"partition/{name}": array for name, array in cover.arrays(fields).items()}
    if isinstance(cover, Mesh):
        return arrays | {"partition@kind": "mesh"}
    named = cover.weight in ("linear", "quadratic", "cubic")
    arrays |= {"partition@kind": "shepard-box", "partition@weight": cover.weight if named else "formula"}
    return arrays | ({} if named else {"partition@weight_formula": cover.weight})


def _cracks(state: State, cracks: Sequence[NDArray[np.float64]], holes: Sequence[Hole]) -> Arrays:
    for k, points in enumerate(cracks):
        if len(points) < 2:
            raise BuildError(f"cracks[{k}]: has {len(points)} points; a crack needs two or more")
        same = np.flatnonzero((points[1:] == points[:-1]).all(axis=1))
        if len(same):
            raise BuildError(f"cracks[{k}][{same[0] + 1}]: is the point before it; leave one out")
    ends = [
        list(given.ends) if isinstance(given, Crack) else _ends(k, cracks, state.cover, holes)
        for k, given in enumerate(state.cracks)
    ]
    return {
        "cracks/points": np.concatenate([np.empty((0, 2)), *cracks]),
        "cracks/offsets": np.cumsum([0, *map(len, cracks)]),
        "cracks/ends": np.array(ends, object).reshape(-1, 2),
    }


def _ends(
    crack: int, cracks: Sequence[NDArray[np.float64]], cover: Cover | Mesh, holes: Sequence[Hole]
) -> list[str]:
    (x0, y0), (x1, y1) = cover.domain.tolist()
    border = [np.array([(x0, y0), (x1, y0), (x1, y1), (x0, y1), (x0, y0)])]
    border += [np.concatenate([h.points, h.points[:1]]) for h in holes if h.points is not None]
    near = 1e-9 * max(x1 - x0, y1 - y0)
    others = [points for k, points in enumerate(cracks) if k != crack]

    def kind(p: NDArray[np.float64]) -> str:
        rims = [abs(np.hypot(*(p - np.array(h.center))) - (h.radius or 0)) for h in holes if h.center]
        if min([_distance(p, line) for line in border] + rims) <= near:
            return "mouth"
        return "junction" if any(_distance(p, line) <= near for line in others) else "tip"

    return [kind(cracks[crack][0]), kind(cracks[crack][-1])]


def _distance(p: NDArray[np.float64], line: NDArray[np.float64]) -> float:
    """From a point to a polyline."""
    start, along = line[:-1], np.diff(line, axis=0)
    t = np.clip(((p - start) * along).sum(axis=1) / (along**2).sum(axis=1), 0, 1)
    return float(np.hypot(*(start + t[:, None] * along - p).T).min())


def _field(
    given: Coefficients, cover: Cover | Mesh, functions: list[str], equation: Elastic | Poisson | None
) -> Arrays:
    place = f"fields[{given.name!r}]"
    spaces = dict.fromkeys(given.blocks, given.space) if isinstance(given.space, str) else given.space
    tensor = {name: cover.in_space(f"{place}.space", spaces.get(name, "shape")) for name in given.blocks}
    blocks: Blocks = arranged(place, given.blocks, tensor, functions)
    unknown = None if equation is None else ("potential" if isinstance(equation, Poisson) else "displacement")
    if unknown is not None and given.name != unknown:
        raise BuildError(f"{place}: is the first field, which the equation calls {unknown!r}; name it so")
    count = len(blocks.coefficients)
    is_heated = isinstance(equation, Elastic) and equation.expansion is not None
    if is_heated and count != 3:
        raise BuildError(f"{place}.blocks: have {count} components; with `expansion` they are ux, uy and the temperature")
    names = list(given.components or (["ux", "uy", "temperature"] if is_heated else _names(given.name, count)))
    if len(names) != count:
        raise BuildError(f"{place}.components: has {len(names)} names, but the blocks have {count} components")
    arrays = {"@name": given.name, "@unit": given.unit, "components": names, **blocks.arrays()}
    return arrays | ({"exact": list(given.exact)} if given.exact else {})


def _names(name: str, count: int) -> list[str]:
    if name == "displacement" and count == 2:
        return ["ux", "uy"]
    if count == 1:
        return ["u" if name == "potential" else name]
    return [f"{name}{k}" for k in range(count)]


def _attributes(attributes: Mapping[str, ArrayLike], patches: int) -> Arrays:
    if not attributes:
        return {}
    for name, values in attributes.items():
        if np.shape(values) != (patches,):
            raise BuildError(f"attributes[{name!r}]: has the shape {np.shape(values)}, expected ({patches},)")
    return {
        "attributes/name": list(attributes),
        "attributes/values": np.array(list(attributes.values()), float),
    }


def _history(path: str, found: Mapping[str, float]) -> Arrays:
    if not found:
        return {}
    names = [f"verified {name}" for name in found]
    return {f"{path}/name": names, f"{path}/value": list(found.values()), f"{path}/unit": [""] * len(names)}


for _class in (Coefficients, State):
    _class.__module__ = "ppum"
