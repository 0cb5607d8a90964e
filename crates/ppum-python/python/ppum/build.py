"""Datasets from the arrays of one's own code: `dataset` takes states, each a cover or mesh with its fields and functions."""

import re
import sys
from collections.abc import Mapping, Sequence
from functools import lru_cache, partial
from types import ModuleType
from typing import Any, Unpack

import numpy as np
from numpy.typing import ArrayLike

from . import _core
from ._arrays import in_arguments, packed
from ._blocks import arranged
from ._checks import check_shape, mapping, real, rows, scalar, sequence, text
from ._cover import Cover
from ._dataset import Dataset
from ._errors import BuildError, QuantityError
from ._facts import Crack, Hole
from ._functions import Component, Formula, Jump, Level, columns, tip_functions
from ._head import Arrays, BuildOptions, DatasetOptions, Material, components_of, crack_arrays, listed, of_state, shared
from ._mesh import Mesh
from ._options import defaults, takes
from ._problem import Anisotropic, Elastic, Poisson
from ._state import Coefficients, State
from ._verify import verified
from ._warnings import warn

__all__ = [
    "Coefficients", "Component", "Cover", "Formula", "Jump", "Level", "Mesh", "State", "arrays", "dataset", "from_arrays",
    "tip_functions",
]  # fmt: skip

TAKEN = "has a meaning in formulas already"
#: Values of patches that each field has.
OF_PATCHES = ("level", "element", "order", "blocks", "functions")


@takes(BuildOptions)
def dataset(states: State | Sequence[State], **options: Unpack[BuildOptions]) -> Dataset:
    """Make the dataset of arrays: one step, or the steps of a series on one domain.

    `Coefficients.verify` is compared at 1000 random points, spread over the patches, and at 100 points close to both
    sides of each crack. The largest difference is logged, and kept in `Step.history`, as ``verified NAME``.

    Raises:
        BuildError: Arrays are wrong, with the array, the row and the remedy; or a field is not the one of its `verify`.
    """
    series, records = _series(states), dict[str, Any]()
    shared_options: Any = dict(options)
    tolerance = scalar("tolerance", shared_options.pop("tolerance"))
    named = arrays(series, **shared_options)
    try:
        made = from_arrays(named)
    except BuildError as error:
        raise BuildError(in_arguments(str(error), named, len(series) > 1)) from None
    for k, state in enumerate(series):
        with of_state(k, len(series)):
            if state.attributes:
                _check_attributes(state, made.steps[k].field)
            found = verified(partial(_field_of, made, named, k), state, tolerance)
        records |= _history(f"steps/{k:04}/history", found)
    return from_arrays(named | records) if records else made


@takes(DatasetOptions)
def arrays(states: State | Sequence[State], **options: Unpack[DatasetOptions]) -> Arrays:
    """Return arrays and attributes of a dataset by their paths in the file format (FORMAT.md, section 3).

    They are for files that are written elsewhere, and what `dataset` hands to `from_arrays`. Nothing is verified.

    Example:
        >>> mesh = ppum.build.Mesh.from_nodes([[(0, 0), (2, 0), (0, 1)]])
        >>> made = ppum.build.arrays(ppum.build.State(mesh, ppum.build.Coefficients("u", {"one": [[1.0]]})))
        >>> made["steps/0000/partition/map"].tolist()
        [[1.3333333333333333, 0.0], [0.0, 0.6666666666666666]]
    """
    series, equation = _series(states), options["equation"]
    holes = options["holes"] = listed("holes", options["holes"], Hole, "ppum.Hole(center, radius)")
    named = shared(series, options)
    for k, state in enumerate(series):
        with of_state(k, len(series)):
            named |= _step(f"steps/{k:04}", state, equation, holes)
            _check_names(f"steps/{k:04}/fields", named, equation)
    return named


def _series(states: Any) -> list[State]:
    given = [states] if isinstance(states, State) else states
    series: list[State] = listed("states", given, State, "ppum.build.State(cover, fields)")
    if not series:
        raise BuildError("states: a dataset needs at least one step")
    return series


def from_arrays(arrays: Mapping[str, Any]) -> Dataset:
    """Make the dataset of arrays and attributes by their paths in the file format (FORMAT.md, section 3), as of `arrays`.

    Numbers become those of the format's types; objects that are not optional have to be there, except for ``@format`` and
    ``@format_version``.

    Raises:
        BuildError: All that is wrong, a line for each array.

    Example:
        >>> ppum.build.from_arrays({"@title": "Nothing"})
        Traceback (most recent call last):
        ...
        ppum.BuildError: @program: is missing
        ...
    """
    named = mapping("arrays", arrays, "arrays, such as those of `ppum.build.arrays`")
    return Dataset(_core.build([packed(path, value) for path, value in named.items()]))


def _field_of(made: Dataset, arrays: Arrays, step: int, number: int) -> Any:
    """Return a field of a step: only the first of a dataset can be evaluated, so another takes its place in a copy."""
    if number == 0:
        return made.steps[step].field
    path = f"steps/{step:04}"
    of, to = (f"{path}/fields/{k:04}" for k in (number, 0))
    others = {k: v for k, v in arrays.items() if not k.startswith(("equation", "quantities", to))}
    this = {k.replace(of, to): v for k, v in others.items() if k.startswith(of)}
    one = {k: v for k, v in (others | this).items() if not k.startswith("steps/") or k.startswith(path)}
    moved = {k.replace(path, "steps/0000"): v for k, v in one.items()}
    name = f"{moved['steps/0000/fields/0000@name']}, compared"
    return from_arrays(moved | {"equation@kind": "none", "steps/0000/fields/0000@name": name}).field


def _step(path: str, state: State, equation: Material | None, holes: Sequence[Hole]) -> Arrays:
    cover, fields = state.cover, [state.fields] if isinstance(state.fields, Coefficients) else state.fields
    fields = listed("fields", fields, Coefficients, "ppum.build.Coefficients(name, blocks)")
    if not fields:
        raise BuildError("fields: a step needs at least one field; give ppum.build.Coefficients(name, blocks)")
    given = enumerate(sequence("cracks", state.cracks, "cracks, each its points"))
    cracks = [rows(f"cracks[{k}]", crack.points if isinstance(crack, Crack) else crack, 2) for k, crack in given]
    functions: dict[str, Any] = {"one": None}
    if "one" in mapping("functions", state.functions, "functions"):
        raise BuildError("functions['one']: is the function 1 already; give yours another name")
    functions |= state.functions
    names = [one.name for one in fields]
    group = {"@load": scalar("load", state.load), **_partition(cover, names), **crack_arrays(state, cracks, holes)}
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


def _field(
    given: Coefficients, cover: Cover | Mesh, functions: list[str], equation: Material | None
) -> Arrays:
    place = f"fields[{text('fields.name', given.name)!r}]"
    given_blocks = mapping(f"{place}.blocks", given.blocks, "arrays, such as {'one': array}")
    one_space = dict.fromkeys(given_blocks, given.space) if isinstance(given.space, str) else given.space
    spaces = mapping(f"{place}.space", one_space, "words, or one for all")
    if unknown := sorted(spaces.keys() - given_blocks.keys()):
        raise BuildError(f"{place}.space[{unknown[0]!r}]: there are blocks of {', '.join(given_blocks)} alone")
    tensor = {name: cover.in_space(f"{place}.space", spaces.get(name, "shape")) for name in given.blocks}
    blocks = arranged(place, given.blocks, tensor, functions)
    names = _components(place, given, len(blocks["coefficients"]), equation)
    arrays = {"@name": given.name, "@unit": text(f"{place}.unit", given.unit), "components": names, **blocks}
    exact = [text(f"{place}.exact[{k}]", f) for k, f in enumerate(sequence(f"{place}.exact", given.exact, "formulas"))]
    return arrays | ({"exact": exact} if exact else {})


def _components(place: str, given: Coefficients, count: int, equation: Material | None) -> list[str]:
    """Return the names of the components, as many as the blocks have, and as the equation wants them."""
    wanted = components_of(equation)
    if equation is not None:
        unknown = "potential" if isinstance(equation, Poisson) else "displacement"
        if given.name != unknown:
            raise BuildError(f"{place}: is the first field, which the equation calls {unknown!r}; name it so")
        if count != len(wanted):
            raise BuildError(
                f"{place}.blocks: have {count} components, but the equation has {len(wanted)}, {', '.join(wanted)}; "
                "leave out others, or leave out `equation`"
            )
    names = wanted or _names(given.name, count)
    if given.components is not None:
        given_names = enumerate(sequence(f"{place}.components", given.components, "names"))
        names = [text(f"{place}.components[{k}]", name) for k, name in given_names]
    if len(names) != count:
        raise BuildError(f"{place}.components: has {len(names)} names, but the blocks have {count} components")
    return names


def _names(name: str, count: int) -> list[str]:
    if name == "displacement" and count == 2:
        return ["ux", "uy"]
    if name == "potential" and count == 1:
        return ["u"]
    # formulas have letters, digits and `_` alone
    base = re.sub(r"\W", "_", name, flags=re.ASCII)
    base = f"_{base}" if base[:1].isdigit() else base
    return [base] if count == 1 else [f"{base}{k}" for k in range(count)]


def _check_names(group: str, arrays: Arrays, equation: Material | None) -> None:
    """Refuse components' names that formulas cannot have for them."""
    fields = [key.removesuffix("/components") for key in arrays if key.startswith(group) and key.endswith("/components")]
    state = getattr(equation, "state", None)
    is_round = isinstance(state, str) and state == "axisymmetric"
    for path, k, name in ((f, k, name) for f in fields for k, name in enumerate(arrays[f"{f}/components"])):
        if wrong := _unfit(name, _nameless(type(equation).__name__, is_round)):
            raise BuildError(
                f"fields[{arrays[f'{path}@name']!r}].components[{k}]: {name!r} {wrong}; give another one, of letters, digits "
                "and `_`, by components=[…]"
            )


def _unfit(name: str, field: Any) -> str | None:
    """Return why formulas of a field without names cannot have this name."""
    try:
        field._core.check(f"let {name} = 1; {name}")
    except QuantityError as error:
        return TAKEN if "already has a meaning" in str(error) else "is no name that formulas can have"
    return TAKEN if name in field.quantities else None


@lru_cache
def _nameless(equation: str, is_round: bool) -> Any:
    """Return a field of an equation whose components have names that nobody gives: in its formulas all others are free."""
    materials: dict[str, Material] = {
        "Anisotropic": Anisotropic((1.0,) * 3, (0.0,) * 3, 1.0),
        "Elastic": Elastic(1.0, 0.0, "axisymmetric" if is_round else "plane-strain"),
        "Poisson": Poisson(1.0),
    }
    material = materials.get(equation)
    count, name = (1, "potential") if equation == "Poisson" else (2, "displacement")
    field = Coefficients(name, {"one": np.zeros((1, 1, count))}, [f"__{k}" for k in range(count)])
    state = State(Cover.uniform([(0, 0), (1, 1)], (1, 1)), field)
    common = shared([state], defaults(DatasetOptions) | {"equation": material})
    return from_arrays(common | _step("steps/0000", state, material, ())).field


def _attributes(attributes: Mapping[str, ArrayLike], patches: int) -> Arrays:
    if not mapping("attributes", attributes, "arrays"):
        return {}
    values = [real(f"attributes[{name!r}]", given) for name, given in attributes.items()]
    for name, given in zip(attributes, values):
        check_shape(f"attributes[{name!r}]", given, given.shape == (patches,), f"({patches},)")
    return {"attributes/name": list(attributes), "attributes/values": np.array(values)}


def _check_attributes(state: State, field: Any) -> None:
    """Refuse attributes that are never shown, since their names are those of something else."""
    for name in state.attributes:
        if name in OF_PATCHES or field._is_quantity(name):
            raise BuildError(
                f"attributes[{name!r}]: is the name of a quantity, which would be shown in its place; give another, such "
                f"as {f'my {name}'!r}"
            )


def _history(path: str, found: Mapping[str, float]) -> Arrays:
    if not found:
        return {}
    names = [f"verified {name}" for name in found]
    return {f"{path}/name": names, f"{path}/value": list(found.values()), f"{path}/unit": [""] * len(names)}


class _Callable(ModuleType):
    """The module as the function that had its name."""

    def __call__(self, states: Any, **options: Any) -> Dataset:
        text = "ppum.build(…) is now ppum.build.dataset(…); the old name goes with the next version"
        warn(text, kind=DeprecationWarning)
        return dataset(states, **options)


sys.modules[__name__].__class__ = _Callable
