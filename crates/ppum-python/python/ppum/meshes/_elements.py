"""The shared part of importers: elements and polynomials from a library's values at reference places."""

import inspect
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from typing import Annotated, Any, ParamSpec

import numpy as np
from numpy.typing import NDArray

from .._blocks import MAX_DEGREE, exponents
from .._checks import Ragged
from .._dataset import Dataset
from .._errors import BuildError, require
from .._head import BuildOptions
from .._mesh import Clip, Mesh
from .._options import Option
from .._shapes import SQUARE, TRIANGLE, interpolated, nodes, random_places
from .._state import Coefficients, Sampled, State
from .._units import Floats
from ..build import dataset

_P = ParamSpec("_P")

#: What needs a package, and how to get it, where that is not pip with the name of the package.
PACKAGES = {
    "dolfinx": ("fields of DOLFINx", "fenics-dolfinx", "conda install -c conda-forge"),
    "getfem": ("fields of GetFEM", "python3-getfem", "apt install"),
    "meshio": ("meshes of meshio", "meshio"),
    "mfem": ("fields of MFEM", "mfem"),
    "ngsolve": ("fields of NGSolve", "ngsolve"),
    "skfem": ("fields of scikit-fem", "scikit-fem"),
    "vtk": ("files of VTK", "vtk"),
    "xfem": ("fields of ngsxfem", "xfem"),
}

#: Reference places of each shape, (k, 2).
Places = Mapping[int, Floats]

#: Coefficients of a map below this part of its largest one are rounding.
STRAIGHT = 1e-14
SEED = 1


@dataclass(frozen=True)
class Group:
    """Elements of one shape, with a library's values at the same reference places of each."""

    shape: int
    #: The numbers of the elements, (n,).
    elements: NDArray[np.int64]
    #: The points of the places, (n, k, 2), and the values of the field there, (n, k, c).
    points: Floats
    values: Floats
    #: The reference places, (k, 2), and the highest degree that they fix.
    places: Floats
    order: int = MAX_DEGREE


#: Asks a library for values at places.
Sampler = Callable[[Places], list[Group]]
#: Points and values of elements (n,) at places (k, 2).
Values = Callable[[NDArray[np.int64], Floats], tuple[Floats, Floats]]


class ImportOptions(BuildOptions, total=False):
    """The labels of an imported field, its verification, and the data of its dataset."""

    name: Annotated[str | None, Option(None, "name of the field; by default `u`, of files that of the data")]
    components: Annotated[list[str] | None, Option(None, "names of its components, see `Coefficients`")]
    unit: Annotated[str, Option("", "its unit, for labels")]
    verify: Annotated[int, Option(1000, "number of random points at which the dataset is compared with the library")]


def imported(module: str) -> Any:
    """Import a module of a library."""
    what, *remedy = PACKAGES[module.split(".")[0]]
    return require(module, remedy[0], what, *remedy[1:])


def importer(
    state: Callable[_P, State], name: str, library: str, package: str = "", version: Callable[..., str] = lambda *_, **__: ""
) -> Callable[_P, Dataset]:
    """Make the function of this name that builds the dataset of a state, and has its arguments.

    The program of the dataset is the library with the version of its package, or that of the arguments.
    """

    def load(*args: _P.args, **options: _P.kwargs) -> Dataset:
        # a library that is missing is said first
        of = getattr(imported(package), "__version__", "") if package else version(*args, **options)
        made = state(*args, **options)
        others: Any = {key: options[key] for key in BuildOptions.__annotations__ if key in options}
        return dataset(made, **{"program": f"{library} {of}".strip()} | others)

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
        """Return space, coefficients and constants of each map, of the least degree that it has."""
        geometry = min(geometry, group.order)
        powers = exponents(geometry, group.shape == SQUARE)
        found = interpolated(group.points, group.places, powers)
        x, y = found[:, powers.index((1, 0))].T, found[:, powers.index((0, 1))].T
        self.turned.append(x[0] * y[1] < x[1] * y[0])
        found = _turned(found, powers, self.turned[-1])
        return *_least(found[:, 1:], powers[1:], geometry, group.shape), found[:, 0]

    def mesh(self, patches: Sequence[int] | None = None, clips: Mapping[int, Sequence[Clip]] | None = None) -> Mesh:
        """Return the mesh of the elements with these places in their order, by default of all."""
        order = self.order if patches is None else self.order[list(patches)]
        shapes = np.concatenate([np.full(len(group.elements), group.shape) for group in self.groups])
        numbers = np.concatenate([group.elements for group in self.groups])
        space, element = self.spaces[order].tolist(), numbers[order]
        return Mesh(shapes[order], self.origins[order], self.maps.at(order), space=space, element=element, clips=clips)

    def polynomials(self, order: int, columns: slice = slice(None)) -> Ragged:
        """Return coefficients (m, c) on each element, of total degree on triangles and tensor products on squares."""
        parts = []
        for group, turned in zip(self.groups, self.turned):
            powers = exponents(min(order, group.order), group.shape == SQUARE)
            found = interpolated(group.values[:, :, columns], group.places, powers)
            parts.append(_turned(found, powers, turned))
        return Ragged.joined(parts).at(self.order)


def _turned(found: Floats, powers: Sequence[tuple[int, int]], turned: NDArray[np.bool_]) -> Floats:
    """Exchange ξ and η in the coefficients of some elements, so that their nodes go counter-clockwise."""
    if not turned.any():
        return found
    exchanged = [powers.index((j, i)) for i, j in powers]
    return np.where(turned[:, None, None], found[:, exchanged], found)


def _least(c: Floats, powers: Sequence[tuple[int, int]], degree: int, shape: int) -> tuple[NDArray[np.str_], Ragged]:
    """Return spaces and coefficients of maps without the higher powers that are rounding."""
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
    if not 0 <= order <= MAX_DEGREE:
        raise BuildError(f"order: is {order}; polynomials on elements have degrees 0 to {MAX_DEGREE}")
    return order


def compared(sampler: Sampler, count: int, keep: Callable[[Floats], Any] | None = None) -> Sampled | None:
    """Return at most `count` random points and the library's values there; `keep` takes values (k, c) and selects points."""
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
    """Return True for points off a level set, on which rounding decides their side."""
    return np.abs(level) > 1e-9 * np.abs(level).max()


def smooth(sampler: Sampler, options: ImportOptions, order: int, geometry: int, verify: Sampled | None) -> State:
    """Return the state of a field that is one polynomial on each element."""
    elements = Elements(sampler, order, geometry)
    return State(elements.mesh(), labelled(options, {"one": elements.polynomials(order)}, verify))


def labelled(options: ImportOptions, blocks: Mapping[str, Any], verify: Sampled | None) -> Coefficients:
    return Coefficients(options["name"] or "u", blocks, options["components"], options["unit"], verify=verify)


def group_by_shape(shapes: NDArray[np.int64], among: NDArray[np.int64], places: Places, values: Values) -> list[Group]:
    """Group elements by shape, with points and values at places of the triangle (0, 0), (1, 0), (0, 1) or the square [0, 1]²."""
    groups = []
    for k in (TRIANGLE, SQUARE):
        elements = among[shapes[among] == k]
        if len(elements):
            groups.append(Group(k, elements, *values(elements, to_unit(k, places[k])), places[k]))
    return groups


def from_unit(shape: int, places: Floats) -> Floats:
    """Convert places of the triangle (0, 0), (1, 0), (0, 1) or the square [0, 1]² to ours."""
    return 2 * places - 1 if shape == SQUARE else 1.5 * places - 0.5


def to_unit(shape: int, places: Floats) -> Floats:
    """Convert our places to the triangle (0, 0), (1, 0), (0, 1) or the square [0, 1]²."""
    return (places + 1) / 2 if shape == SQUARE else (places + 0.5) / 1.5
