"""Fields of DOLFINx."""

from typing import Any, Unpack

import numpy as np
from numpy.typing import NDArray

from .._checks import real
from .._errors import BuildError
from .._options import takes
from .._shapes import SQUARE, TRIANGLE
from .._state import State
from .._units import Floats
from ._elements import Group, ImportOptions, Places, Sampler, compared, importer, smooth, to_unit

__all__ = ["from_dolfinx", "state"]

SHAPES = {"triangle": TRIANGLE, "quadrilateral": SQUARE}
REMEDY = "interpolate the field into discontinuous Lagrange elements of its degree"


@takes(ImportOptions, "from_dolfinx()")
def state(u: Any, **options: Unpack[ImportOptions]) -> State:
    """Import a Function of DOLFINx in a Lagrange space, continuous or not, of scalars or vectors.

    Degrees of freedom multiply basix's shape functions, on triangles or quadrilaterals of any order.

    Args:
        u: The Function; parts of mixed ones by ``u.sub(k).collapse()``.
    """
    mesh, element = u.function_space.mesh, _element(u)
    if mesh.comm.size > 1:
        raise BuildError(f"u: is spread over {mesh.comm.size} processes; run the import on one")
    order, geometry = _degree(element), int(_geometry_map(mesh).degree)
    return smooth(sampler(u, False), options, order, geometry, compared(sampler(u, True), options["verify"]))


from_dolfinx = importer(state, "from_dolfinx", "DOLFINx", "dolfinx")


def _element(u: Any) -> Any:
    """Return the element of a component, whose functions are mapped without a change of value."""
    space = u.function_space.element
    if space.needs_dof_transformations:
        raise BuildError(f"u: its degrees of freedom are turned from cell to cell; {REMEDY}")
    # before version 0.6 the element of a vector has that of its components as a part
    try:
        element = space.basix_element
    except RuntimeError:
        element = u.function_space.sub(0).element.basix_element
    if "identity" not in str(element.map_type):
        raise BuildError(f"u: its functions are mapped by {element.map_type}; {REMEDY}")
    return element


def _degree(element: Any) -> int:
    """Return the degree, on quadrilaterals in each variable; the names are those of basix before and since 0.8."""
    names = ("embedded_superdegree", "highest_degree")
    if "quadrilateral" in str(element.cell_type):
        names = ("embedded_subdegree", "highest_complete_degree")
    return int(next(getattr(element, name) for name in names if hasattr(element, name)))


def _geometry_map(mesh: Any) -> Any:
    maps = getattr(mesh.geometry, "cmaps", None)
    return maps[0] if maps else mesh.geometry.cmap


def _cells(mesh: Any) -> int:
    return int(mesh.topology.index_map(2).size_local)


def _rows(mesh: Any, table: Any) -> NDArray[np.int64]:
    """Return the numbers that each cell has, which early versions have in an adjacency list."""
    return np.asarray(getattr(table, "array", table), np.int64).reshape(_cells(mesh), -1)


def sampler(u: Any, evaluate: bool) -> Sampler:
    """Sample by the degrees of freedom, or by the evaluation of DOLFINx."""
    space, element = u.function_space, _element(u)
    mesh, block = space.mesh, int(space.dofmap.bs)
    name = getattr(mesh.topology, "cell_name", None)
    shape = SHAPES[name() if name else mesh.ufl_cell().cellname()]
    coordinates = mesh.geometry.x[_rows(mesh, mesh.geometry.dofmap)][..., :2]
    values = real("u", u.x.array).reshape(-1, block)[_rows(mesh, space.dofmap.list)]

    def evaluated(points: Floats) -> Floats:
        flat = np.zeros((points.shape[0] * points.shape[1], 3))
        flat[:, :2] = points.reshape(-1, 2)
        cells = np.repeat(np.arange(len(points), dtype=np.int32), points.shape[1])
        return real("u", u.eval(flat, cells)).reshape(*points.shape[:2], block)

    def sample(places: Places) -> list[Group]:
        at = to_unit(shape, places[shape])
        # maps are linear in the nodes
        to_world, count = _geometry_map(mesh).push_forward, coordinates.shape[1]
        map_ = [to_world(at, np.ascontiguousarray(np.outer(row, [1.0, 0.0])))[:, 0] for row in np.eye(count)]
        points = np.einsum("jk,njc->nkc", map_, coordinates)
        table = np.asarray(element.tabulate(0, at))[0].reshape(len(at), -1)
        found = evaluated(points) if evaluate else np.einsum("kd,ndc->nkc", table, values)
        return [Group(shape, np.arange(len(values)), points, found, places[shape])]

    return sample
