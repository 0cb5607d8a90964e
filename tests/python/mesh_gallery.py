"""Fields of finite element libraries for docs/gallery.md, and their pictures by VTK, which draws for ParaView.

    python tests/python/mesh_gallery.py getfem|ngsolve|vtk      (by a python that has the library)

writes out/gallery-NAME.h5, the field itself, and out/gallery-NAME.vtu, what the library exports for ParaView.

    python tests/python/mesh_gallery.py draw NAME -o OUT.png ARRAY X,Y,WIDTH LEAST,MOST      (with pyvista)

draws the exported file with ParaView's default settings, 480 × 450 pixels.
"""

import sys

import numpy as np


def getfem():
    """A plate pulled at top and bottom, with an edge crack that the squares of the mesh do not know."""
    import getfem as gf
    import ppum
    from ppum.meshes.getfem import Crack

    side = np.linspace(-1, 1, 12)
    mesh = gf.Mesh("cartesian", side, side)
    levelset, cut = gf.LevelSet(mesh, 1, "y-0.03-0.1*x", "x-0.05"), gf.MeshLevelSet(mesh)
    cut.add(levelset)
    cut.adapt()
    base, hats = gf.MeshFem(mesh, 1), gf.MeshFem(mesh, 1)
    base.set_fem(gf.Fem("FEM_QK(2,2)"))
    hats.set_fem(gf.Fem("FEM_QK(2,1)"))
    jump = gf.MeshFem("levelset", cut, base)
    tips = gf.MeshFem("global function", mesh, levelset, [gf.GlobalFunction("crack", k) for k in range(4)], 1)
    at = [gf.compute_interpolate_on(levelset.mf(), levelset.values(k), hats) for k in (1, 0)]
    near = np.flatnonzero(np.hypot(*at) <= 0.3)
    product = gf.MeshFem("product", hats, tips)
    product.set_enriched_dofs(near)
    mf = gf.MeshFem("sum", jump, product)
    mf.set_qdim(2)
    u = _pulled(gf, mesh, cut, mf)
    elastic = ppum.Elastic(young=1.0, poisson=0.3, state="plane-strain")
    crack = Crack(levelset, base, jump, (hats, near))
    options = {"name": "displacement", "components": ["ux", "uy"], "equation": elastic, "title": "XFEM of GetFEM"}
    ppum.meshes.from_getfem(mf, u, crack, **options).save("out/gallery-getfem.h5")
    pieces = cut.cut_mesh()
    exported = gf.MeshFem(pieces, 2)
    exported.set_classical_discontinuous_fem(2, 0.001)
    values = gf.compute_interpolate_on(mf, u, exported)
    exported.export_to_vtu("out/gallery-getfem.vtu", exported, values, "displacement")


def _pulled(gf, mesh, cut, mf):
    """Degrees of freedom of the plate's displacement."""
    outer = mesh.outer_faces()
    normals = mesh.normal_of_faces(outer)
    mesh.set_region(1, outer[:, np.abs(normals[1]) > 0.5])
    squares = "IM_GAUSS_PARALLELEPIPED(2,8)"
    rules = ("IM_STRUCTURED_COMPOSITE(IM_TRIANGLE(6),4)", f"IM_STRUCTURED_COMPOSITE({squares},6)", squares)
    integration = gf.MeshIm("levelset", cut, "all", *map(gf.Integ, rules))
    model, plain = gf.Model("real"), gf.MeshFem(mesh, 2)
    plain.set_classical_fem(1)
    model.add_fem_variable("u", mf)
    model.add_initialized_data("lambda", [0.3 / (1.3 * 0.4)])
    model.add_initialized_data("mu", [1 / 2.6])
    model.add_isotropic_linearized_elasticity_brick(integration, "u", "lambda", "mu")
    model.add_initialized_fem_data("pull", plain, plain.eval("[0*x, 0.1*y]"))
    model.add_Dirichlet_condition_with_penalization(integration, "u", 1e8, 1, "pull")
    model.solve()
    return model.variable("u")


def ngsolve():
    """A field of order 8 on few curved triangles."""
    import ngsolve as ngs
    import ppum
    from mesh_cases import netgen

    mesh = netgen(False, 0.7)
    mesh.Curve(8)
    field = ngs.GridFunction(ngs.H1(mesh, order=8))
    field.Set(ngs.sin(9 * ngs.x * ngs.y) + ngs.cos(7 * ngs.x))
    ppum.meshes.from_ngsolve(field, name="u", title="Order 8 of NGSolve").save("out/gallery-ngsolve.h5")
    ngs.VTKOutput(mesh, [field], ["u"], filename="out/gallery-ngsolve", subdivision=2).Do()


def vtk():
    """Lagrange cells of order 4 over a quarter of a ring."""
    import vtk as library
    from ppum.meshes.vtk import CELLS, places_of
    from vtk.util.numpy_support import numpy_to_vtk

    import ppum

    places = np.array(places_of(CELLS[70][0], 4))
    places = (places - places.min(axis=0)) / np.ptp(places, axis=0)
    grid, nodes = library.vtkUnstructuredGrid(), []
    for row, column in np.ndindex(3, 2):
        ids = library.vtkIdList()
        for s, t in places:
            ids.InsertNextId(len(nodes))
            radius, angle = 1 + (column + s) / 2, (row + t) * np.pi / 6
            nodes.append((radius * np.cos(angle), radius * np.sin(angle), 0.0))
        grid.InsertNextCell(70, ids)
    points = library.vtkPoints()
    points.SetDataTypeToDouble()
    points.SetData(numpy_to_vtk(np.array(nodes), deep=1))
    grid.SetPoints(points)
    x, y, _ = np.array(nodes).T
    data = numpy_to_vtk(np.sin(5 * x) * np.cos(4 * y), deep=1)
    data.SetName("u")
    grid.GetPointData().AddArray(data)
    writer = library.vtkXMLUnstructuredGridWriter()
    writer.SetFileName("out/gallery-vtk.vtu")
    writer.SetInputData(grid)
    writer.Write()
    ppum.meshes.from_vtu("out/gallery-vtk.vtu", title="VTU of order 4").save("out/gallery-vtk.h5")


def draw(name, _, out, array, view, limits):
    """A picture by VTK of what was exported."""
    import pyvista

    (x, y, width), pixels = map(float, view.split(",")), (480, 450)
    plotter = pyvista.Plotter(off_screen=True, window_size=pixels)
    grid = pyvista.read(f"out/gallery-{name}.vtu")
    array, _, component = array.partition(".")
    clim = [float(n) for n in limits.split(",")]
    options = {"scalars": array, "component": int(component) if component else None, "clim": clim, "cmap": "viridis"}
    plotter.add_mesh(grid, lighting=False, show_scalar_bar=False, **options)
    plotter.set_background("white")
    plotter.view_xy()
    plotter.enable_parallel_projection()
    plotter.camera.focal_point, plotter.camera.position = (x, y, 0), (x, y, 1)
    plotter.camera.parallel_scale = width * pixels[1] / pixels[0] / 2
    plotter.screenshot(out)


if __name__ == "__main__":
    task, *arguments = sys.argv[1:]
    globals()[task](*arguments)
