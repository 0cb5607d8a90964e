"""Fields of MFEM, by PyMFEM."""

from collections.abc import Callable
from typing import Any, Unpack

import numpy as np
from numpy.typing import NDArray

from .._checks import check_type, real
from .._errors import BuildError
from .._options import takes
from .._shapes import SQUARE, TRIANGLE
from .._state import State
from .._units import Floats
from ._elements import SEED, ImportOptions, Sampler, compared, group_by_shape, imported, importer, smooth

__all__ = ["from_mfem", "state"]


@takes(ImportOptions, "from_mfem()")
def state(gf: Any, order: int | None = None, **options: Unpack[ImportOptions]) -> State:
    """Import a GridFunction of MFEM: H1 and L2 of any order on straight and curved meshes, with hanging nodes too.

    It is sampled at reference points of each element.

    Args:
        gf: A GridFunction of PyMFEM.
        order: Degree of the polynomials, on squares in each variable; by default the highest of the space.
    """
    check_type("gf", gf, hasattr(gf, "FESpace"), "a GridFunction of MFEM")
    space = gf.FESpace()
    mesh = space.GetMesh()
    if mesh.Dimension() != 2 or mesh.SpaceDimension() != 2:
        raise BuildError(f"gf: its mesh has {mesh.SpaceDimension()} dimensions, expected 2")
    curve = mesh.GetNodes()
    geometry = int(curve.FESpace().GetMaxElementOrder()) if curve is not None else 1
    order = int(space.GetMaxElementOrder()) if order is None else order
    known = compared(evaluator(gf, mesh, options["verify"]), options["verify"])
    return smooth(sampler(gf, mesh), options, order, geometry, known)


from_mfem = importer(state, "from_mfem", "MFEM", "mfem")


def _shapes(mesh: Any) -> NDArray[np.int64]:
    mfem = imported("mfem.ser")
    shapes = {mfem.Geometry.TRIANGLE: TRIANGLE, mfem.Geometry.SQUARE: SQUARE}
    return np.array([shapes[mesh.GetElementGeometry(k)] for k in range(mesh.GetNE())])


def sampler(gf: Any, mesh: Any) -> Sampler:
    """Sample by the degrees of freedom where these are values, else by the evaluation of MFEM."""
    fields = [gf] if mesh.GetNodes() is None else [gf, mesh.GetNodes()]
    elements = [(field.FESpace(), field.FESpace().GetFE(0)) for field in fields if mesh.GetNE()]
    is_plain = [e.GetMapType() == e.VALUE and e.GetRangeType() == e.SCALAR and s.GetNURBSext() is None for s, e in elements]
    if not all(is_plain):
        return evaluator(gf, mesh)
    shape, values = _shapes(mesh), _tabulated(gf)
    points = _straight(mesh) if mesh.GetNodes() is None else _tabulated(mesh.GetNodes())

    all_ = np.arange(len(shape))
    return lambda places: group_by_shape(shape, all_, places, lambda of, at: (points(of, at), values(of, at)))


#: Values (n, k, c) of elements of one shape at places (k, 2).
Table = Callable[[NDArray[np.int64], Floats], Floats]


def _tabulated(gf: Any) -> Table:
    """Multiply degrees of freedom with shape functions, for elements with as many of them at once."""
    space, data, count = gf.FESpace(), real("gf", gf.GetDataArray()), int(gf.VectorDim())
    by_component = space.GetOrdering() == imported("mfem.ser").Ordering.byNODES
    data = data.reshape(count, -1).T if by_component else data.reshape(-1, count)
    dofs, starts = _dofs(space)

    def values(elements: NDArray[np.int64], at: Floats) -> Floats:
        sizes = np.diff(starts)[elements]
        found = np.empty((len(elements), len(at), count))
        for size in np.unique(sizes):
            of = np.flatnonzero(sizes == size)
            table = _table(space.GetFE(int(elements[of[0]])), at)
            own = dofs[starts[elements[of]][:, None] + np.arange(size)]
            # a negative number is that of a function with the other sign
            signed = np.where(own[..., None] < 0, -data[-1 - own], data[own])
            found[of] = np.einsum("kd,ndc->nkc", table, signed)
        return found

    return values


def _dofs(space: Any) -> tuple[NDArray[np.int64], NDArray[np.int64]]:
    """Return the elements' degrees of freedom, one element after the other, and where each begins."""
    table, array = space.GetElementToDofTable(), imported("mfem.ser").intArray
    dofs = array((table.GetJ(), table.Size_of_connections())).GetDataArray()
    starts = array((table.GetI(), table.Size() + 1)).GetDataArray()
    return dofs.astype(np.int64), starts.astype(np.int64)


def _table(element: Any, at: Floats) -> Floats:
    """Return shape functions at places, (k, functions)."""
    shapes, rows = imported("mfem.ser").Vector(element.GetDof()), []
    for place in _rule(at):
        element.CalcShape(place, shapes)
        rows.append(shapes.GetDataArray().copy())
    return np.array(rows)


def _straight(mesh: Any) -> Table:
    """Return points of straight elements by their vertices."""
    mfem, corners = imported("mfem.ser"), np.array([mesh.GetVertexArray(k)[:2] for k in range(mesh.GetNV())])
    linear = mfem.H1_FECollection(1, 2)
    vertices, starts = _dofs(mfem.FiniteElementSpace(mesh, linear))

    def points(elements: NDArray[np.int64], at: Floats) -> Floats:
        x, y = at.T
        count = int(starts[elements[0] + 1] - starts[elements[0]])
        table = [1 - x - y, x, y] if count == 3 else [(1 - x) * (1 - y), x * (1 - y), x * y, (1 - x) * y]
        own = corners[vertices[starts[elements][:, None] + np.arange(count)]]
        found: Floats = np.einsum("dk,ndc->nkc", np.array(table), own)
        return found

    return points


def evaluator(gf: Any, mesh: Any, most: int | None = None) -> Sampler:
    """Return points and values by the evaluation of MFEM, on all elements or on so many random ones."""
    shape = _shapes(mesh)
    chosen = np.sort(np.random.default_rng(SEED).permutation(len(shape))[:most])
    # a space of vectors is not the same as a vector of spaces
    count = int(gf.VectorDim())

    def at(elements: NDArray[np.int64], places: Floats) -> tuple[Floats, Floats]:
        rule, points, values = _rule(places), [], []
        for element in elements.tolist():
            transformation = mesh.GetElementTransformation(element)
            for place in rule:
                transformation.SetIntPoint(place)
                points.append([float(v) for v in transformation.Transform(place)])
                values.append(_value(gf, element, place, count))
        shape = len(elements), len(rule), -1
        return np.array(points).reshape(shape)[..., :2], np.array(values).reshape(shape)

    return lambda places: group_by_shape(shape, chosen, places, at)


def _rule(places: Floats) -> list[Any]:
    rule = []
    for x, y in places.tolist():
        rule.append(imported("mfem.ser").IntegrationPoint())
        rule[-1].Set2(x, y)
    return rule


def _value(gf: Any, element: int, place: Any, count: int) -> list[float]:
    if count == 1:
        return [float(gf.GetValue(element, place))]
    vector = imported("mfem.ser").Vector(count)
    gf.GetVectorValue(element, place, vector)
    return [float(vector[k]) for k in range(count)]
