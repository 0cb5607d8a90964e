"""Fields of files of VTK, and of meshio."""

import importlib.util
import os
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Annotated, Any, Unpack

import numpy as np
from numpy.typing import NDArray

from .._blocks import DEGREES, MAX_DEGREE, TENSOR
from .._checks import check_type, numbers, sequence
from .._errors import BuildError, require
from .._head import components_of
from .._options import Option, takes
from .._shapes import SQUARE, TRIANGLE
from .._state import Sampled, State
from .._units import Floats
from ._elements import SEED, Group, ImportOptions, Places, compared, from_unit, imported, importer, smooth, to_unit

__all__ = ["from_meshio", "from_vtu", "meshio_state", "vtu_state"]

#: Cells in two dimensions by their numbers in VTK: shape, and order if it is fixed.
CELLS = {5: (TRIANGLE, 1), 9: (SQUARE, 1), 22: (TRIANGLE, 2), 23: (SQUARE, 2), 28: (SQUARE, 2), 69: (TRIANGLE, 0), 70: (SQUARE, 0)}
#: The same by their names in meshio.
NAMES = {
    "triangle": 5, "quad": 9, "triangle6": 22, "quad8": 23, "quad9": 28,
    "VTK_LAGRANGE_TRIANGLE": 69, "VTK_LAGRANGE_QUADRILATERAL": 70,
}  # fmt: skip
#: Cells that are no area, which are passed over: vertices and lines.
PASSED_OVER = {1, 2, 3, 4, 21, 68}
SERENDIPITY = 23


@dataclass(frozen=True)
class Kind:
    """Cells of one of VTK's types with one number of nodes."""

    #: The number of the type in VTK.
    type: int
    #: The numbers of the cells, (n,), and of their nodes, (n, k).
    cells: NDArray[np.int64]
    nodes: NDArray[np.int64]


class PointOptions(ImportOptions, total=False):
    """The columns of point data, and the options of all importers."""

    columns: Annotated[
        Sequence[int] | None,
        Option(None, "numbers of the data's columns that are the components; by default all, but a third one that is zero"),
    ]


@takes(PointOptions, "from_vtu()")
def vtu_state(path: str | os.PathLike[str], data: str | None = None, **options: Unpack[PointOptions]) -> State:
    """Import point data of a file .vtu or .vtkhdf: linear, quadratic and Lagrange cells of orders up to 8.

    Needs vtk, or for .vtu meshio, with which the dataset is compared at nodes.

    Args:
        path: The file.
        data: Name of the point data, if there are several arrays.
    """
    check_type("path", path, isinstance(path, (str, os.PathLike)), "the path of a file .vtu or .vtkhdf")
    if importlib.util.find_spec("vtk") is None and not os.fspath(path).endswith(".vtkhdf"):
        mesh = require("meshio", "vtk", "files of VTK").read(path)
        return meshio_state(mesh, data, **options)
    grid = _grid(path)
    arrays = grid.GetPointData()
    known = [arrays.GetAbstractArray(k).GetName() for k in range(arrays.GetNumberOfArrays())]
    chosen = _chosen(data, known)
    points = _numpy(grid.GetPoints().GetData())
    if arrays.GetArray(chosen) is None:
        raise BuildError(f"data: {chosen!r} has texts; give one of numbers")
    values = _values(chosen, _numpy(arrays.GetArray(chosen)), options)
    kinds = _kinds_of(grid)
    reference = compared(lambda places: _interpolated(grid, kinds, points, values, places), options["verify"])
    return _state(points, kinds, values, _named(options, chosen), reference)


@takes(PointOptions, "from_meshio()")
def meshio_state(mesh: Any, data: str | None = None, **options: Unpack[PointOptions]) -> State:
    """Import point data of a mesh of meshio: linear, quadratic and VTK's Lagrange triangles and quadrilaterals.

    Data and columns are as of `from_vtu`; the dataset is compared at nodes, since meshio evaluates no fields.
    """
    check_type("mesh", mesh, hasattr(mesh, "point_data"), "a meshio.Mesh, as by meshio.read(path)")
    chosen = _chosen(data, list(mesh.point_data))
    points, values = numbers("mesh.points", mesh.points), _values(chosen, mesh.point_data[chosen], options)
    unknown = [part.type for part in mesh.cells if part.type not in NAMES and part.dim == 2]
    if unknown:
        raise BuildError(f"mesh: has cells of the type {unknown[0]}; there are {', '.join(NAMES)}")
    kinds, first = [], 0
    for part in mesh.cells:
        if part.type in NAMES:
            nodes = np.asarray(part.data, int)
            kinds.append(Kind(NAMES[part.type], first + np.arange(len(nodes)), nodes))
        first += len(part.data)
    _check_nodes(kinds, len(points))
    return _state(points, kinds, values, _named(options, chosen), _at_nodes(points, kinds, values, options["verify"]))


from_vtu = importer(vtu_state, "from_vtu", "VTK file", version=lambda path, *_, **__: os.path.basename(os.fspath(path)))
from_meshio = importer(meshio_state, "from_meshio", "meshio", "meshio")


def _values(name: str, given: Any, options: PointOptions) -> Floats:
    """Return the columns of point data that are the components, (n, c)."""
    place = f"data {name!r}"
    values = numbers(place, given)
    values = values.reshape(len(values), -1)
    count, columns = values.shape[1], options["columns"]
    if columns is None:
        is_plane = count == 3 and not values[:, 2].any() and len(options["components"] or ()) != 3
        return values[:, :2] if is_plane else values
    chosen = [int(k) for k in sequence("columns", columns, "numbers")]
    if not chosen or not all(0 <= k < count for k in chosen):
        raise BuildError(f"columns: {columns!r}, but {place} has {count} columns, counted from 0")
    return values[:, chosen]


def _check_columns(count: int, equation: Any) -> None:
    wanted = components_of(equation)
    if wanted and count != len(wanted):
        raise BuildError(
            f"data: has {count} columns, but the equation has {len(wanted)} components, {', '.join(wanted)}; choose by "
            f"columns={list(range(len(wanted)))}"
        )


def _check_nodes(kinds: Sequence[Kind], count: int) -> None:
    for kind in kinds:
        wrong = ((kind.nodes < 0) | (kind.nodes >= count)).any(axis=1)
        if wrong.any():
            k = int(np.flatnonzero(wrong)[0])
            nodes = kind.nodes[k].tolist()
            raise BuildError(f"cells[{kind.cells[k]}]: has the nodes {nodes}, but there are {count} points, from 0")


def _named(options: PointOptions, data: str) -> PointOptions:
    return {**options, "name": options["name"] or data}


def _chosen(data: str | None, known: Sequence[str]) -> str:
    if data is None and len(known) == 1:
        return known[0]
    if data not in known:
        asked = "several arrays" if data is None else f"no point data {data!r}"
        asked = asked if known else "no point data; interpolate data of cells to the points"
        raise BuildError(f"data: there are {asked}" + (f"; give one of {', '.join(map(repr, known))}" if known else ""))
    return str(data)


def _grid(path: str | os.PathLike[str]) -> Any:
    vtk, name = imported("vtk"), os.fspath(path)
    if not os.path.exists(path):
        raise FileNotFoundError(f"{name}: there is no such file")
    if not name.endswith((".vtu", ".vtkhdf")):
        raise BuildError(f"{name}: ends in neither .vtu nor .vtkhdf; save it as an unstructured grid, as ParaView does")
    reader = vtk.vtkHDFReader() if name.endswith(".vtkhdf") else vtk.vtkXMLUnstructuredGridReader()
    reader.SetFileName(name)
    before = vtk.vtkLogger.GetCurrentVerbosityCutoff()
    vtk.vtkLogger.SetStderrVerbosity(vtk.vtkLogger.VERBOSITY_OFF)
    try:
        reader.Update()
    finally:
        vtk.vtkLogger.SetStderrVerbosity(before)
    grid = reader.GetOutputDataObject(0)
    if grid is None or not grid.IsA("vtkUnstructuredGrid") or not grid.GetNumberOfCells():
        raise BuildError(f"{name}: holds no unstructured grid with cells; save one, as ParaView does")
    return grid


def _numpy(array: Any) -> NDArray[Any]:
    return np.asarray(imported("vtk.util.numpy_support").vtk_to_numpy(array))


def _kinds_of(grid: Any) -> list[Kind]:
    cells = grid.GetCells()
    starts, nodes = _numpy(cells.GetOffsetsArray()), _numpy(cells.GetConnectivityArray())
    types, counts = np.array([grid.GetCellType(k) for k in range(grid.GetNumberOfCells())]), np.diff(starts)
    kinds = []
    for type_, count in np.unique(np.column_stack([types, counts]), axis=0).tolist():
        of = np.flatnonzero((types == type_) & (counts == count))
        kinds.append(Kind(type_, of, nodes[starts[of][:, None] + np.arange(count)]))
    return kinds


def _state(points: Floats, kinds: Sequence[Kind], values: Floats, options: PointOptions, verify: Sampled | None) -> State:
    if np.ptp(points[:, 2:]) if points.shape[1] > 2 else 0:
        raise BuildError("points: do not lie in a plane z = constant; give a mesh of the x-y plane")
    _check_columns(values.shape[1], options["equation"])
    groups = [_group(kind, points, values) for kind in _plane(kinds)]
    order = max(group.order for group in groups)
    return smooth(lambda _: groups, options, order, order, verify)


def _plane(kinds: Sequence[Kind]) -> list[Kind]:
    """Return the cells that are areas."""
    for kind in kinds:
        if kind.type not in CELLS and kind.type not in PASSED_OVER:
            raise BuildError(
                f"cells[{kind.cells[0]}]: is of VTK's type {kind.type}; there are {', '.join(map(str, CELLS))}"
            )
    areas = [kind for kind in kinds if kind.type in CELLS]
    if not areas:
        raise BuildError("cells: there are no triangles or quadrilaterals; give a mesh of the x-y plane")
    return areas


def _group(kind: Kind, points: Floats, values: Floats) -> Group:
    shape, order = _order(kind.type, kind.nodes.shape[1], int(kind.cells[0]))
    at, data = points[kind.nodes][:, :, :2], values[kind.nodes]
    if kind.type == SERENDIPITY:
        at, data = _with_centre(at), _with_centre(data)
    return Group(shape, kind.cells, at, data, from_unit(shape, places_of(shape, order)), order)


def _order(kind: int, count: int, cell: int) -> tuple[int, int]:
    """Return shape and order of a cell by its type and number of nodes."""
    shape, fixed = CELLS[kind]
    order = (TENSOR if shape == SQUARE else DEGREES).get(count + (kind == SERENDIPITY))
    if order and order == (fixed or order):
        return shape, order
    raise BuildError(
        f"cells[{cell}]: has {count} nodes, which no cell of VTK's type {kind} has with one order, at most {MAX_DEGREE}"
    )


def _with_centre(nodes: Floats) -> Floats:
    """Add the ninth node to eight, where their functions have the value ½ Σ middles − ¼ Σ corners."""
    centre = nodes[:, 4:].sum(axis=1) / 2 - nodes[:, :4].sum(axis=1) / 4
    return np.concatenate([nodes, centre[:, None]], axis=1)


def places_of(shape: int, order: int) -> Floats:
    """Return the nodes of VTK's Lagrange cells in its parametric coordinates: corners, edges, the inside."""
    whole = _square(order) if shape == SQUARE else _triangle(order)
    return np.array(whole, float) / order


def _square(n: int) -> list[tuple[int, int]]:
    inner = range(1, n)
    corners = [(0, 0), (n, 0), (n, n), (0, n)]
    edges = [(i, 0) for i in inner] + [(n, j) for j in inner] + [(i, n) for i in inner] + [(0, j) for j in inner]
    return corners + edges + [(i, j) for j in inner for i in inner]


def _triangle(n: int) -> list[tuple[int, int]]:
    """Return the nodes of a triangle, whose inside has the order of a triangle again."""
    if n == 0:
        return [(0, 0)]
    inner = range(1, n)
    edges = [(i, 0) for i in inner] + [(n - i, i) for i in inner] + [(0, n - i) for i in inner]
    inside = [(i + 1, j + 1) for i, j in _triangle(n - 3)] if n > 2 else []
    return [(0, 0), (n, 0), (0, n)] + edges + inside


def _interpolated(grid: Any, kinds: Sequence[Kind], points: Floats, values: Floats, places: Places) -> list[Group]:
    """Return VTK's own interpolation in each cell at places."""
    groups = []
    for kind in _plane(kinds):
        shape = CELLS[kind.type][0]
        # the cells of a kind have the same shape functions
        table = _weights(grid.GetCell(int(kind.cells[0])), to_unit(shape, places[shape]))
        at, found = (np.einsum("kj,njc->nkc", table, array[kind.nodes]) for array in (points[:, :2], values))
        groups.append(Group(shape, kind.cells, at, found, places[shape]))
    return groups


def _weights(cell: Any, places: Floats) -> Floats:
    rows = []
    for x, y in places.tolist():
        weights = [0.0] * cell.GetNumberOfPoints()
        cell.InterpolateFunctions([x, y, 0.0], weights)
        rows.append(weights)
    return np.array(rows)


def _at_nodes(points: Floats, kinds: Sequence[Kind], values: Floats, count: int) -> Sampled | None:
    """Return values of the file at nodes that stand at no other's place."""
    used = np.unique(np.concatenate([kind.nodes.reshape(-1) for kind in kinds if kind.type in CELLS] or [np.empty(0, int)]))
    _, first, repeated = np.unique(points[used][:, :2], axis=0, return_index=True, return_counts=True)
    alone = np.random.default_rng(SEED).permutation(used[first[repeated == 1]])[:count]
    return Sampled(points[alone, :2], values[alone].reshape(len(alone), -1)) if len(alone) else None
