"""Small fields of finite element libraries, as states of the package `ppum`, and the files of tests/python/fixtures.

    python tests/python/mesh_cases.py ngsolve          (by a python that has the library)

writes the fixtures of a library: its arrays, and in the group `user` points with the library's own values, and digits of
the field there by the independent reader in 50 digits.
"""

import pathlib
import sys

import numpy as np

#: The cases of which there are files.
WRITTEN = {
    "ngsolve-triangles", "ngsolve-squares", "ngsxfem", "skfem-triangles", "mfem-squares", "dolfinx-curved-triangles",
    "getfem-crack-curved", "getfem-crack-bilinear", "vtk-vtu",
}  # fmt: skip
FIXTURES = pathlib.Path(__file__).parent / "fixtures"
POINTS, DIGITS = 100, 2


def bent(x, y):
    return [
        x + 0.06 * np.sin(np.pi * x) * np.sin(2 * np.pi * y),
        y + 0.05 * np.sin(2 * np.pi * x) * np.sin(np.pi * y),
    ]


def netgen(quads, size):
    """A square with a round hole."""
    import ngsolve as ngs
    from netgen.geom2d import SplineGeometry

    geometry = SplineGeometry()
    geometry.AddRectangle((-1, -1), (1, 1), bc="outer")
    geometry.AddCircle((0.1, -0.05), 0.45, leftdomain=0, rightdomain=1, bc="hole")
    return ngs.Mesh(geometry.GenerateMesh(maxh=size, quad_dominated=quads))


def ngsolve():
    """Order 4 on curved triangles, order 3 on curved squares, vectors of DG."""
    import ngsolve as ngs
    from ppum.meshes.ngsolve import state

    u = ngs.sin(3 * ngs.x) * ngs.cos(2 * ngs.y) + ngs.x * ngs.x * ngs.y
    for name, quads, geometry, space, value in (
        ("triangles", False, 4, lambda mesh: ngs.H1(mesh, order=4), u),
        ("squares", True, 3, lambda mesh: ngs.H1(mesh, order=3), u),
        ("dg", False, 2, lambda mesh: ngs.VectorL2(mesh, order=3), ngs.CF((u, ngs.sin(5 * ngs.x) * ngs.y))),
    ):
        mesh = netgen(quads, 0.7)
        mesh.Curve(geometry)
        gf = ngs.GridFunction(space(mesh))
        gf.Set(value)
        yield f"ngsolve-{name}", state(gf)


def xfem():
    """Two fields of order 3 on the sides of a circle's interpolant."""
    import ngsolve as ngs
    import xfem as _xfem
    from netgen.geom2d import SplineGeometry
    from ppum.meshes.ngsxfem import state

    geometry = SplineGeometry()
    geometry.AddRectangle((-1.5, -1.5), (1.5, 1.5), bc=1)
    mesh = ngs.Mesh(geometry.GenerateMesh(maxh=0.8))
    levelset = ngs.GridFunction(ngs.H1(mesh, order=1))
    _xfem.InterpolateToP1(ngs.sqrt(ngs.x**2 + ngs.y**2) - 1, levelset)
    sides = [ngs.GridFunction(ngs.H1(mesh, order=3)) for _ in range(2)]
    sides[0].Set(ngs.exp(ngs.x) * ngs.y)
    sides[1].Set(ngs.sin(3 * ngs.x) + 2)
    yield "ngsxfem", state(*sides, levelset)


def skfem():
    """P4 on quadratic triangles, some of which go clockwise, Q2, vectors, Argyris."""
    import skfem as fem
    from ppum.meshes.skfem import state

    square = fem.MeshQuad.init_tensor(np.linspace(0, 1, 4) ** 1.3, np.linspace(0, 1, 4))
    circle, straight = fem.MeshTri2.init_circle(1), fem.MeshTri.init_circle(1)
    for name, mesh, element in (
        ("triangles", circle, fem.ElementTriP4()),
        ("squares", square, fem.ElementQuad2()),
        ("vectors", circle, fem.ElementVector(fem.ElementTriP2())),
        ("argyris", straight, fem.ElementTriArgyris()),
    ):
        basis = fem.Basis(mesh, element)
        yield f"skfem-{name}", state(basis, np.random.default_rng(1).normal(size=basis.N))


def mfem():
    """Order 4 on cubic squares, DG on cubic triangles, hanging nodes."""
    import mfem.ser as m
    from ppum.meshes.mfem import state

    class Bend(m.VectorPyCoefficient):
        def EvalValue(self, x):
            return bent(*x)

    class Wave(m.PyCoefficient):
        def EvalValue(self, x):
            return np.sin(5 * x[0]) * np.cos(3 * x[1])

    for name, kind, curved, space, order in (
        ("squares", m.Element.QUADRILATERAL, True, m.H1_FECollection, 4),
        ("triangles", m.Element.TRIANGLE, True, m.L2_FECollection, 4),
        ("hanging", m.Element.QUADRILATERAL, False, m.H1_FECollection, 2),
    ):
        mesh = m.Mesh.MakeCartesian2D(3, 3, kind, True, 1.0, 1.0)
        if curved:
            mesh.SetCurvature(3, False, 2)
            nodes, bend = mesh.GetNodes(), Bend(2)
            moved = m.GridFunction(nodes.FESpace())
            moved.ProjectCoefficient(bend)
            nodes.Assign(moved)
        else:
            mesh.EnsureNCMesh()
            mesh.GeneralRefinement(m.intArray([0, 4]), 1)
        collection, wave = space(order, 2), Wave()
        functions = m.FiniteElementSpace(mesh, collection)
        field = m.GridFunction(functions)
        field.ProjectCoefficient(wave)
        yield f"mfem-{name}", state(field)


def dolfinx():
    """Lagrange elements of scalars and vectors, and since version 0.7 curved ones."""
    # first: it loads the library of MPI
    from mpi4py import MPI  # isort: skip
    from dolfinx import fem
    from dolfinx import mesh as meshes
    from ppum.meshes.dolfinx import state

    def function(mesh, *kind):
        shape = {"shape": (2,)} if kind[-1] == 2 else {}
        space = fem.functionspace(mesh, (kind[0], kind[1], *shape.values()))
        u = fem.Function(space)
        wave = lambda x: np.stack([np.sin(5 * x[0]) * x[1], np.cos(4 * x[0] * x[1])])
        u.interpolate(wave if shape else lambda x: wave(x)[0])
        return u

    cells = {"triangles": meshes.CellType.triangle, "squares": meshes.CellType.quadrilateral}
    for name, cell in cells.items():
        mesh = meshes.create_unit_square(MPI.COMM_WORLD, 3, 3, cell)
        yield f"dolfinx-{name}", state(function(mesh, "Lagrange", 3, 1))
        yield f"dolfinx-curved-{name}", state(function(_bent(mesh, 3), "DG", 2, 2))


def _bent(base, degree):
    """A mesh of DOLFINx with curved cells."""
    import basix.ufl
    from dolfinx import fem, mesh
    from mpi4py import MPI

    element = basix.ufl.element("Lagrange", base.topology.cell_type.name, degree, shape=(2,))
    space = fem.functionspace(base, element)
    moved = fem.Function(space)
    moved.interpolate(lambda x: np.stack(bent(x[0], x[1])))
    count = base.topology.index_map(2).size_local
    cells = np.array([space.dofmap.cell_dofs(k) for k in range(count)], np.int64)
    return mesh.create_mesh(MPI.COMM_WORLD, cells, element, moved.x.array.reshape(-1, 2))


def getfem():
    """P4 and Q3, and plates with a crack: jumps, and tip functions of level sets of degree 1 and 2."""
    import getfem as gf
    from ppum.meshes.getfem import state

    gf.util_trace_level(0)
    gf.util_warning_level(0)
    side = np.linspace(-1, 1, 4)
    for name, mesh, element in (
        ("triangles", gf.Mesh("regular simplices", side, side), "FEM_PK(2,4)"),
        ("squares", gf.Mesh("cartesian", side, side), "FEM_QK(2,3)"),
    ):
        mf = gf.MeshFem(mesh, 2)
        mf.set_fem(gf.Fem(element))
        yield f"getfem-{name}", state(mf, np.random.default_rng(1).normal(size=mf.nbdof()))
    straight, curved = ("y-0.02", "x-0.05"), ("y-0.02-0.3*sqr(x-0.1)", "x-0.07+0.2*y")
    for name, squares, degree, levels in (
        ("straight", True, 1, straight),
        ("curved", False, 2, curved),
        ("bilinear", True, 2, curved),
    ):
        *parts, _ = _cracked(gf, squares, degree, *levels)
        yield f"getfem-crack-{name}", state(*parts)


def _cracked(gf, squares, degree, phi, psi):
    """The space, random degrees of freedom and the parts of a plate with a crack, and what must stay alive."""
    from ppum.meshes.getfem import Crack

    x, y = np.linspace(-1, 1, 6), np.linspace(-1, 1, 8)
    mesh = gf.Mesh("cartesian", x, y) if squares else gf.Mesh("regular simplices", x, y)
    if degree > 1:
        mesh = _shaken(gf, mesh, squares)
    levelset, cut = gf.LevelSet(mesh, degree, phi, psi), gf.MeshLevelSet(mesh)
    cut.add(levelset)
    cut.adapt()
    element, base, hats = "FEM_QK(2,%d)" if squares else "FEM_PK(2,%d)", gf.MeshFem(mesh, 1), gf.MeshFem(mesh, 1)
    base.set_fem(gf.Fem(element % 2))
    hats.set_fem(gf.Fem(element % 1))
    jump = gf.MeshFem("levelset", cut, base)
    tips = gf.MeshFem("global function", mesh, levelset, [gf.GlobalFunction("crack", k) for k in range(4)], 1)
    at = [gf.compute_interpolate_on(levelset.mf(), levelset.values(k), hats) for k in (1, 0)]
    near = np.flatnonzero(np.hypot(*at) <= 0.45)
    product = gf.MeshFem("product", hats, tips)
    product.set_enriched_dofs(near)
    mf = gf.MeshFem("sum", jump, product)
    mf.set_qdim(2)
    u = np.random.default_rng(2).normal(size=mf.nbdof())
    return mf, u, Crack(levelset, base, jump, (hats, near)), (mesh, cut, tips, product)


def _shaken(gf, mesh, squares):
    """A mesh with moved nodes; squares become bilinear."""
    points = mesh.pts().copy()
    inner = (np.abs(np.abs(points) - 1) > 1e-9).all(axis=0)
    mesh.set_pts(points + np.random.default_rng(3).uniform(-0.07, 0.07, points.shape) * inner)
    if not squares:
        return mesh
    made = gf.Mesh("empty", 2)
    for cell in mesh.cvid():
        made.add_convex(gf.GeoTrans("GT_QK(2,1)"), mesh.pts_from_cvid(int(cell))[0])
    return made


def vtk():
    """All cells of VTK that are read, of orders up to 8, bent."""
    import tempfile

    from ppum.meshes.vtk import vtu_state

    with tempfile.TemporaryDirectory(prefix="ppum-") as folder:
        for ending in ("vtu", "vtkhdf"):
            path = f"{folder}/cells.{ending}"
            write_vtk(path, [(69, 4), (70, 3), (22, 2), (23, 2), (28, 2), (5, 1), (9, 1), (69, 8), (70, 7)])
            yield f"vtk-{ending}", vtu_state(path)


def write_vtk(path, kinds):
    """A file of VTK with cells of these types and orders, one beside the other, and vectors `u`."""
    import vtk as library
    from ppum.meshes.vtk import CELLS, places_of
    from vtk.util.numpy_support import numpy_to_vtk

    grid, nodes = library.vtkUnstructuredGrid(), []
    for number, (kind, order) in enumerate(kinds):
        places = places_of(CELLS[kind][0], order)[: 8 if kind == 23 else None]
        ids = library.vtkIdList()
        for x, y in places:
            ids.InsertNextId(len(nodes))
            bend = order > 1
            nodes.append((1.2 * number + x + 0.07 * bend * y * y, y + 0.1 * bend * np.sin(x), 0.0))
        grid.InsertNextCell(kind, ids)
    points = library.vtkPoints()
    points.SetDataTypeToDouble()
    points.SetData(numpy_to_vtk(np.array(nodes), deep=1))
    grid.SetPoints(points)
    x, y, _ = np.array(nodes).T
    data = numpy_to_vtk(np.column_stack([np.sin(3 * x) + x * y, np.cos(2 * y)]), deep=1)
    data.SetName("u")
    grid.GetPointData().AddArray(data)
    writer = library.vtkHDFWriter() if path.endswith("hdf") else library.vtkXMLUnstructuredGridWriter()
    writer.SetFileName(path)
    writer.SetInputData(grid)
    writer.Write()


LIBRARIES = {f.__name__: f for f in (ngsolve, xfem, skfem, mfem, dolfinx, getfem, vtk)}


def reference(state):
    """Points and the library's values."""
    fields = state.fields if isinstance(state.fields, list) else [state.fields]
    points, values = fields[0].verify
    return np.asarray(points), np.asarray(values).reshape(len(points), -1)


def write_fixture(name, state, program):
    """A file with the library's values, and digits."""
    import h5py
    import mpmath
    import ppum
    from mesh_files import write
    from ppum_formulas import Extended
    from ppum_reader import Field

    mpmath.mp.dps = 60
    path = FIXTURES / f"{name}.h5"
    write(path, ppum.build.arrays(state, title=name, program=program), libver="latest", gzip=True)
    points, values = (part[:POINTS] for part in reference(state))
    with h5py.File(path) as file:
        field = Field(file, numbers=Extended)
    digits = [[mpmath.nstr(jet[0], 50) for jet in field.evaluate(*p)] for p in points[:DIGITS]]
    with h5py.File(path, "a", libver="latest") as file:
        file["user/points"], file["user/values"] = points, values
        file["user/digits"] = np.array(digits, "S60")


if __name__ == "__main__":
    if not hasattr(np, "atan2"):
        # numpy before 2, of Debian's python
        for new, old in (("atan2", "arctan2"), ("asin", "arcsin"), ("acos", "arccos"), ("atan", "arctan"), ("pow", "power")):
            setattr(np, new, getattr(np, old))
    FIXTURES.mkdir(exist_ok=True)
    for library in sys.argv[1:]:
        for name, state in LIBRARIES[library]():
            if name in WRITTEN:
                write_fixture(name, state, library)
                print(name, state.cover, flush=True)
