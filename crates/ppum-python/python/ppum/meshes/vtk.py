"""Fields of files of VTK, and of meshio."""

from __future__ import annotations

import importlib.util
import os
from collections.abc import Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ..blocks import MAX_DEGREE, exponents
from ..building import State
from ..dataset import Dataset
from ..errors import BuildError
from ..extras import needed
from ..interpolating import SQUARE, TRIANGLE
from .importing import SEED, Floats, Group, Labels, Places, built, compared, from_unit, smooth, to_unit

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

Cells = list[tuple[int, NDArray[np.int64]]]


def from_vtu(
    path: str | os.PathLike[str],
    data: str | None = None,
    *,
    name: str | None = None,
    components: list[str] | None = None,
    unit: str = "",
    verify: int = 1000,
    **options: Any,
) -> Dataset:
    """The dataset of point data of a file .vtu or .vtkhdf: linear, quadratic and Lagrange cells of orders up to 8, with the
    values of the nodes. Needs vtk, or for .vtu meshio.

    Args:
        path: The file.
        data: Name of the point data; may be left out if there is one array.
        name: Of the field, by default that of the data.
        components, unit, verify, options: As of `from_ngsolve`. Without vtk the dataset is compared at nodes.
    """
    made = vtu_state(path, data, labels=Labels(name or "", components, unit), verify=verify)
    return built(made, "VTK file", os.path.basename(os.fspath(path)), options)


def from_meshio(
    mesh: Any,
    data: str | None = None,
    *,
    name: str | None = None,
    components: list[str] | None = None,
    unit: str = "",
    verify: int = 1000,
    **options: Any,
) -> Dataset:
    """The dataset of point data of a mesh of meshio: triangles and quadrilaterals, linear, quadratic and of VTK's Lagrange
    cells.

    Args:
        mesh: A `meshio.Mesh`.
        data: Name of the point data; may be left out if there is one array.
        name, components, unit, options: As of `from_vtu`.
        verify: Number of nodes at which the dataset is compared; meshio evaluates no fields.
    """
    version = needed("meshio", "meshio", "meshes of meshio").__version__
    made = meshio_state(mesh, data, labels=Labels(name or "", components, unit), verify=verify)
    return built(made, "meshio", version, options)


def vtu_state(
    path: str | os.PathLike[str], data: str | None = None, *, labels: Labels = Labels(""), verify: int = 1000
) -> State:
    """The state of `from_vtu`."""
    if importlib.util.find_spec("vtk") is None and not os.fspath(path).endswith(".vtkhdf"):
        return meshio_state(_meshio_file(path), data, labels=labels, verify=verify)
    grid = _grid(path)
    arrays = grid.GetPointData()
    known = [arrays.GetArrayName(k) for k in range(arrays.GetNumberOfArrays())]
    chosen = _chosen(data, known)
    support = needed("vtk.util.numpy_support", "vtk", "files of VTK")
    points = np.asarray(support.vtk_to_numpy(grid.GetPoints().GetData()), float)
    values = np.asarray(support.vtk_to_numpy(arrays.GetArray(chosen)), float)
    cells = _cells_of(grid)
    reference = compared(lambda places: _interpolated(grid, cells, points, values, places), verify)
    return _state(points, cells, values, _named(labels, chosen), reference)


def meshio_state(mesh: Any, data: str | None = None, *, labels: Labels = Labels(""), verify: int = 1000) -> State:
    """The state of `from_meshio`."""
    chosen = _chosen(data, list(mesh.point_data))
    points, values = np.asarray(mesh.points, float), np.asarray(mesh.point_data[chosen], float)
    cells: Cells = []
    for part in mesh.cells:
        cells += [(NAMES.get(part.type, -1), np.asarray(nodes, int)) for nodes in part.data]
    unknown = [part.type for part in mesh.cells if part.type not in NAMES and part.dim == 2]
    if unknown:
        raise BuildError(f"mesh: has cells of the type {unknown[0]}; there are {', '.join(NAMES)}")
    return _state(points, cells, values, _named(labels, chosen), _at_nodes(points, cells, values, verify))


def _meshio_file(path: str | os.PathLike[str]) -> Any:
    return needed("meshio", "vtk", "files of VTK").read(path)


def _named(labels: Labels, data: str) -> Labels:
    return labels if labels.name else Labels(data, labels.components, labels.unit)


def _chosen(data: str | None, known: Sequence[str]) -> str:
    """The name of point data."""
    if data is None and len(known) == 1:
        return known[0]
    if data not in known:
        asked = "several arrays" if data is None else f"no point data {data!r}"
        raise BuildError(f"data: there are {asked}; give one of {', '.join(map(repr, known)) or 'none'}")
    return str(data)


def _grid(path: str | os.PathLike[str]) -> Any:
    """The unstructured grid of a file."""
    vtk = needed("vtk", "vtk", "files of VTK")
    if not os.path.exists(path):
        raise FileNotFoundError(f"{os.fspath(path)}: there is no such file")
    reader = vtk.vtkHDFReader() if os.fspath(path).endswith(".vtkhdf") else vtk.vtkXMLUnstructuredGridReader()
    reader.SetFileName(os.fspath(path))
    reader.Update()
    grid = reader.GetOutputDataObject(0)
    if grid is None or not grid.IsA("vtkUnstructuredGrid") or not grid.GetNumberOfCells():
        raise BuildError(f"{os.fspath(path)}: holds no unstructured grid with cells")
    return grid


def _cells_of(grid: Any) -> Cells:
    cells: Cells = []
    for k in range(grid.GetNumberOfCells()):
        nodes = grid.GetCell(k).GetPointIds()
        cells.append((grid.GetCellType(k), np.array([nodes.GetId(i) for i in range(nodes.GetNumberOfIds())])))
    return cells


def _state(points: Floats, cells: Cells, values: Floats, labels: Labels, verify: tuple[Floats, Floats] | None) -> State:
    """The state of nodes and their values."""
    if np.ptp(points[:, 2:]) if points.shape[1] > 2 else 0:
        raise BuildError("points: do not lie in a plane z = constant")
    groups = _groups(points, cells, values.reshape(len(values), -1))
    order = max(group.order for group in groups)
    return smooth(lambda _: groups, labels, order, order, verify)


def _groups(points: Floats, cells: Cells, values: Floats) -> list[Group]:
    """Cells with the same nodes together."""
    kinds: dict[tuple[int, int], list[int]] = {}
    for k, (kind, nodes) in enumerate(cells):
        if kind in CELLS:
            kinds.setdefault((kind, len(nodes)), []).append(k)
        elif kind not in PASSED_OVER and kind >= 0:
            raise BuildError(f"cells[{k}]: is of VTK's type {kind}; there are {', '.join(map(str, CELLS))}")
    if not kinds:
        raise BuildError("cells: there are no triangles or quadrilaterals")
    groups = []
    for (kind, count), of in kinds.items():
        shape, order = _order(kind, count, of[0])
        nodes = np.array([cells[k][1] for k in of])
        at, data = points[nodes][:, :, :2], values[nodes]
        if kind == SERENDIPITY:
            at, data = _with_centre(at), _with_centre(data)
        groups.append(Group(shape, np.array(of), at, data, from_unit(shape, places_of(shape, order)), order))
    return groups


def _order(kind: int, count: int, cell: int) -> tuple[int, int]:
    """Shape and order of a cell by its type and number of nodes."""
    shape, fixed = CELLS[kind]
    for order in [fixed] if fixed else range(1, MAX_DEGREE + 1):
        if count + (kind == SERENDIPITY) == len(exponents(order, shape == SQUARE)):
            return shape, order
    raise BuildError(
        f"cells[{cell}]: has {count} nodes, which no cell of VTK's type {kind} has with one order, at most {MAX_DEGREE}"
    )


def _with_centre(nodes: Floats) -> Floats:
    """Quadrilaterals of eight nodes with the ninth, where their functions have the value ½ Σ middles − ¼ Σ corners."""
    centre = nodes[:, 4:].sum(axis=1) / 2 - nodes[:, :4].sum(axis=1) / 4
    return np.concatenate([nodes, centre[:, None]], axis=1)


def places_of(shape: int, order: int) -> Floats:
    """Nodes of VTK's Lagrange cells in its parametric coordinates, in their order: corners, edges, the inside."""
    whole = _square(order) if shape == SQUARE else _triangle(order)
    return np.array(whole, float) / order


def _square(n: int) -> list[tuple[int, int]]:
    inner = range(1, n)
    corners = [(0, 0), (n, 0), (n, n), (0, n)]
    edges = [(i, 0) for i in inner] + [(n, j) for j in inner] + [(i, n) for i in inner] + [(0, j) for j in inner]
    return corners + edges + [(i, j) for j in inner for i in inner]


def _triangle(n: int) -> list[tuple[int, int]]:
    """The inside has the order of a triangle again."""
    if n == 0:
        return [(0, 0)]
    inner = range(1, n)
    edges = [(i, 0) for i in inner] + [(n - i, i) for i in inner] + [(0, n - i) for i in inner]
    inside = [(i + 1, j + 1) for i, j in _triangle(n - 3)] if n > 2 else []
    return [(0, 0), (n, 0), (0, n)] + edges + inside


def _interpolated(grid: Any, cells: Cells, points: Floats, values: Floats, places: Places) -> list[Group]:
    """VTK's own interpolation in each cell at places."""
    data, groups = values.reshape(len(values), -1), []
    for shape in (TRIANGLE, SQUARE):
        of = [k for k, (kind, _) in enumerate(cells) if kind in CELLS and CELLS[kind][0] == shape]
        tables = [_weights(grid.GetCell(k), to_unit(shape, places[shape])) for k in of]
        if of:
            at = np.array([w @ points[cells[k][1], :2] for k, w in zip(of, tables)])
            found = np.array([w @ data[cells[k][1]] for k, w in zip(of, tables)])
            groups.append(Group(shape, np.array(of), at, found, places[shape]))
    return groups


def _weights(cell: Any, places: Floats) -> Floats:
    """VTK's shape functions of a cell."""
    rows = []
    for x, y in places.tolist():
        weights = [0.0] * cell.GetNumberOfPoints()
        cell.InterpolateFunctions([x, y, 0.0], weights)
        rows.append(weights)
    return np.array(rows)


def _at_nodes(points: Floats, cells: Cells, values: Floats, count: int) -> tuple[Floats, Floats] | None:
    """Values of the file at nodes that stand at no other's place."""
    used = np.unique(np.concatenate([nodes for kind, nodes in cells if kind in CELLS] or [np.empty(0, int)]))
    _, first, repeated = np.unique(points[used][:, :2], axis=0, return_index=True, return_counts=True)
    alone = np.random.default_rng(SEED).permutation(used[first[repeated == 1]])[:count]
    return (points[alone, :2], values[alone].reshape(len(alone), -1)) if len(alone) else None
