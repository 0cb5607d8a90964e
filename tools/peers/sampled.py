"""What is sampled for peers, and Lagrange cells made of it."""

import numpy as np

CELLS, ORDER = 64, 4
GRID = 2048


def cell_points():
    """The nodes of all cells on [−1, 1]², drawn in by 1e-9, so that those on a crack are on their cell's side of it."""
    nodes = np.linspace(-1, 1, ORDER + 1) * (1 - 1e-9)
    centers = (np.arange(CELLS) + 0.5) * 2 / CELLS - 1
    y, x = np.meshgrid(nodes, nodes, indexing="ij")
    cy, cx = np.meshgrid(centers, centers, indexing="ij")
    at = lambda c, n: c.reshape(-1, 1) + n.reshape(1, -1) / CELLS
    return np.stack([at(cx, x), at(cy, y)], axis=-1)


def cell_values(folder):
    """Values at the nodes. That at a tip, where the stress has none, is the largest of the others of its cell."""
    values = np.load(folder / "cells.npy")["von-mises"].reshape(CELLS**2, -1)
    for tip in (-0.5, 0.0), (0.5, 0.0):
        at_tip = np.hypot(*(cell_points() - tip).transpose(2, 0, 1)) < 1e-6
        cells = at_tip.any(axis=1)
        others = np.where(at_tip[cells], -np.inf, values[cells]).max(axis=1, keepdims=True)
        values[cells] = np.where(at_tip[cells], others, values[cells])
    return values


def grid_values(folder):
    return np.load(folder / "grid.npy")["von-mises"]


def lagrange_order(order):
    """Where VTK wants the nodes of a quadrilateral, by rows: corners, edges, inside."""
    n, last = order + 1, order
    at = lambda i, j: j * n + i
    inner = range(1, last)
    corners = [at(0, 0), at(last, 0), at(last, last), at(0, last)]
    edges = [at(i, 0) for i in inner] + [at(last, j) for j in inner]
    edges += [at(i, last) for i in inner] + [at(0, j) for j in inner]
    return corners + edges + [at(i, j) for j in inner for i in inner]


def lagrange_grid(values):
    """Cells with points of their own, so that what jumps at a crack does so here too."""
    # of VTK and of ParaView's own copy of it
    from vtkmodules import vtkCommonDataModel as vtk
    from vtkmodules.util.numpy_support import numpy_to_vtk, numpy_to_vtkIdTypeArray
    from vtkmodules.vtkCommonCore import vtkPoints

    order = lagrange_order(ORDER)
    points = cell_points()[:, order].reshape(-1, 2)
    count = len(order)
    grid, at, cells = vtk.vtkUnstructuredGrid(), vtkPoints(), vtk.vtkCellArray()
    at.SetData(numpy_to_vtk(np.c_[points, np.zeros(len(points))], deep=True))
    offsets = np.arange(0, len(points) + 1, count)
    ids = [numpy_to_vtkIdTypeArray(a.astype(np.int64), deep=True) for a in (offsets, np.arange(len(points)))]
    cells.SetData(*ids)
    grid.SetPoints(at)
    grid.SetCells(vtk.VTK_LAGRANGE_QUADRILATERAL, cells)
    scalars = numpy_to_vtk(values[:, order].ravel().astype(np.float32), deep=True)
    scalars.SetName("von-mises")
    grid.GetPointData().SetScalars(scalars)
    return grid
