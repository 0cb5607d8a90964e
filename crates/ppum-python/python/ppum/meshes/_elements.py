"""What all importers share: elements and polynomials from the values that a library gives at reference places."""

import inspect
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from typing import Annotated, Any, ParamSpec

import numpy as np
from numpy.typing import NDArray

from .._blocks import MAX_DEGREE, exponents
from .._checks import Ragged
from .._dataset import Dataset
from .._errors import BuildError
from .._head import BuildOptions
from .._mesh import Clip, Mesh
from .._options import Option
from .._shapes import SQUARE, TRIANGLE, interpolated, nodes, random_places
from .._state import Coefficients, Sampled, State
from .._units import Floats
from ..build import dataset

_P = ParamSpec("_P")

#: Reference places of each shape, (k, 2).
Places = Mapping[int, Floats]

#: Coefficients of a map below this part of its largest one are rounding.
STRAIGHT = 1e-14
SEED = 1


@dataclass(frozen=True)
class Group:
    """Elements of one shape, and what a library gives at the same reference places of each.

    Attributes:
        shape: Of the elements.
        elements: Their numbers, (n,).
        points: The points that the places have, (n, k, 2).
        values: Values of the field there, (n, k, c).
        places: The reference places, (k, 2).
        order: The highest degree that the places fix.
    """

    shape: int
    elements: NDArray[np.int64]
    points: Floats
    values: Floats
    places: Floats
    order: int = MAX_DEGREE


#: Asks a library for values at places.
Sampler = Callable[[Places], list[Group]]
#: Points and values of elements (n,) at places (k, 2).
Values = Callable[[NDArray[np.int64], Floats], tuple[Floats, Floats]]


class ImportOptions(BuildOptions, total=False):
    """Labels of an imported field, how it is verified, and what is said of its dataset."""

    name: Annotated[str | None, Option(None, "name of the field; by default `u`, of files that of the data")]
    components: Annotated[list[str] | None, Option(None, "names of its components, see `Coefficients`")]
    unit: Annotated[str, Option("", "its unit, for labels")]
    verify: Annotated[int, Option(1000, "number of random points at which the dataset is compared with the library")]


def importer(
    state: Callable[_P, State], name: str, library: str, version: Callable[..., str] = lambda *_, **__: ""
) -> Callable[_P, Dataset]:
    """The function of this name that builds the dataset of a state, and has its arguments."""

    def load(*args: _P.args, **options: _P.kwargs) -> Dataset:
        # a library that is missing is said first
        program = f"{library} {version(*args, **options)}".strip()
        made = state(*args, **options)
        others: Any = {key: options[key] for key in BuildOptions.__annotations__ if key in options}
        return dataset(made, **{"program": program} | others)

    load.__signature__ = inspect.signature(state).replace(return_annotation=Dataset)  # type: ignore[attr-defined]
    load.__name__, load.__qualname__, load.__module__, load.__doc__ = name, name, state.__module__, state.__doc__
    return load


class Elements:
    """The elements of a library in the order of their numbers, and polynomials on them."""

    def __init__(self, sampler: Sampler, order: int, geometry: int) -> None:
        degree = max(checked(order), checked(geometry), 1)
        self.groups = sampler({shape: nodes(shape, degree) for shape in (TRIANGLE, SQUARE)})
        self.order = np.argsort(np.concatenate([group.elements for group in self.groups]), kind="stable")
        # libraries that sort an element's nodes by their numbers have some that go clockwise
        self.turned: list[NDArray[np.bool_]] = []
        parts = [self._maps(group, max(geometry, 1)) for group in self.groups]
        self.spaces = np.concatenate([space for space, *_ in parts])
        self.origins = np.concatenate([origin for *_, origin in parts])
        maps = [found for _, found, _ in parts]
        self.maps = Ragged(np.concatenate([m.values for m in maps]), np.concatenate([m.sizes for m in maps]))

    def _maps(self, group: Group, geometry: int) -> tuple[NDArray[np.str_], Ragged, Floats]:
        """Space, coefficients and constants of each map, of the least degree that it has."""
        geometry = min(geometry, group.order)
        powers = exponents(geometry, group.shape == SQUARE)
        found = interpolated(group.points, group.places, powers)
        x, y = found[:, powers.index((1, 0))].T, found[:, powers.index((0, 1))].T
        self.turned.append(x[0] * y[1] < x[1] * y[0])
        found = _turned(found, powers, self.turned[-1])
        return *_least(found[:, 1:], powers[1:], geometry, group.shape), found[:, 0]

    def mesh(self, patches: Sequence[int] | None = None, clips: Mapping[int, Sequence[Clip]] | None = None) -> Mesh:
        """The mesh of the elements with these places in their order, by default of all."""
        order = self.order if patches is None else self.order[list(patches)]
        shapes = np.concatenate([np.full(len(group.elements), group.shape) for group in self.groups])
        numbers = np.concatenate([group.elements for group in self.groups])
        return Mesh(
            shapes[order],
            self.origins[order],
            self.maps.at(order),
            space=self.spaces[order].tolist(),
            element=numbers[order],
            clips=clips,
        )

    def polynomials(self, order: int, columns: slice = slice(None)) -> Ragged:
        """Coefficients (m, c) on each element, of total degree on triangles and tensor products on squares."""
        parts = []
        for group, turned in zip(self.groups, self.turned):
            powers = exponents(min(order, group.order), group.shape == SQUARE)
            found = interpolated(group.values[:, :, columns], group.places, powers)
            parts.append(_turned(found, powers, turned))
        return Ragged.joined(parts).at(self.order)


def _turned(found: Floats, powers: Sequence[tuple[int, int]], turned: NDArray[np.bool_]) -> Floats:
    """The coefficients with ξ and η exchanged on some elements, so that their nodes go counter-clockwise."""
    if not turned.any():
        return found
    exchanged = [powers.index((j, i)) for i, j in powers]
    return np.where(turned[:, None, None], found[:, exchanged], found)


def _least(c: Floats, powers: Sequence[tuple[int, int]], degree: int, shape: int) -> tuple[NDArray[np.str_], Ragged]:
    """Spaces and coefficients of maps without the higher powers that are rounding."""
    largest = STRAIGHT * np.abs(c).max(axis=(1, 2))
    spaces, left = np.full(len(c), "tensor"), np.arange(len(c))
    parts, of = [], []
    for d, tensor in [(1, False), *((d, shape == SQUARE) for d in range(1, degree + 1))]:
        kept = exponents(d, tensor)[1:]
        beyond = [k for k, power in enumerate(powers) if power not in kept]
        fits = (np.abs(c[left][:, beyond]) <= largest[left, None, None]).all(axis=(1, 2))
        parts.append(c[left[fits]][:, [powers.index(power) for power in kept]])
        of.append(left[fits])
        spaces[left[fits]] = "tensor" if tensor else "total"
        left = left[~fits]
    return spaces, Ragged.joined(parts).at(np.argsort(np.concatenate(of)))


def checked(order: int) -> int:
    """A degree that the format has."""
    if not 0 <= order <= MAX_DEGREE:
        raise BuildError(f"order: is {order}; polynomials on elements have degrees 0 to {MAX_DEGREE}")
    return order


def compared(sampler: Sampler, count: int, keep: Callable[[Floats], Any] | None = None) -> Sampled | None:
    """At most `count` random points and the library's own values there; `keep` takes values of shape (k, c) and says which
    points are left."""
    if count <= 0:
        return None
    random = np.random.default_rng(SEED)
    groups = sampler({shape: random_places(random, shape, 1) for shape in (TRIANGLE, SQUARE)})
    elements = sum(len(group.elements) for group in groups)
    if not elements:
        raise BuildError("mesh: there are no triangles and quadrilaterals, of VTK the kinds 5, 9, 22, 23, 28, 69 and 70")
    if elements < count:
        each = -(-count // elements)
        groups = sampler({shape: random_places(random, shape, each) for shape in (TRIANGLE, SQUARE)})
    points = np.concatenate([group.points.reshape(-1, 2) for group in groups])
    values = np.concatenate([group.values.reshape(len(group.points[0]) * len(group.points), -1) for group in groups])
    chosen = random.permutation(len(points))[:count]
    points, values = points[chosen], values[chosen]
    kept = np.ones(len(points), bool) if keep is None else keep(values)
    return Sampled(points[kept], values[kept])


def off_level(level: Floats) -> Any:
    """True for points that do not lie on a level set, where rounding decides their side."""
    return np.abs(level) > 1e-9 * np.abs(level).max()


def smooth(sampler: Sampler, options: ImportOptions, order: int, geometry: int, verify: Sampled | None) -> State:
    """The state of a field that is one polynomial on each element; `verify` are points and values of the library."""
    elements = Elements(sampler, order, geometry)
    return State(elements.mesh(), labelled(options, {"one": elements.polynomials(order)}, verify))


def labelled(options: ImportOptions, blocks: Mapping[str, Any], verify: Sampled | None) -> Coefficients:
    """A field of blocks with its labels."""
    return Coefficients(options["name"] or "u", blocks, options["components"], options["unit"], verify=verify)


def group_by_shape(shapes: NDArray[np.int64], among: NDArray[np.int64], places: Places, values: Values) -> list[Group]:
    """Groups of elements of each shape by what is known at places of the triangle (0, 0), (1, 0), (0, 1) or the square
    [0, 1]²: points and values."""
    groups = []
    for k in (TRIANGLE, SQUARE):
        elements = among[shapes[among] == k]
        if len(elements):
            groups.append(Group(k, elements, *values(elements, to_unit(k, places[k])), places[k]))
    return groups


def from_unit(shape: int, places: Floats) -> Floats:
    """Places of the triangle (0, 0), (1, 0), (0, 1) or the square [0, 1]² in ours."""
    return 2 * places - 1 if shape == SQUARE else 1.5 * places - 0.5


def to_unit(shape: int, places: Floats) -> Floats:
    """Our places in the triangle (0, 0), (1, 0), (0, 1) or the square [0, 1]²."""
    return (places + 1) / 2 if shape == SQUARE else (places + 0.5) / 1.5
