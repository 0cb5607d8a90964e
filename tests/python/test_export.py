"""Meshes of `ppum export` as other programs read them, against `ppum sample` at random points.

    pip install meshio vtk                        (either; what is missing is skipped)
    python tests/python/test_export.py            (from the repository's root; or: pytest tests/python)

Needs cargo, see programs.py.
"""

import importlib.util
import pathlib
import subprocess
import sys
import tempfile

import numpy as np

sys.path.insert(0, str(pathlib.Path(__file__).parent))
import programs

ROOT = pathlib.Path(__file__).parents[2]
TOLERANCE = 1e-2
RADIUS = 0.05
POINTS = 10_000
TIPS = np.array([[-0.35, -0.25], [0.35, 0.25]])
PROBLEM = """
title = "Slanted crack & <tags>"
[domain]
min = [-1.0, -1.0]
max = [1.0, 1.0]
[material]
young = 1.0
poisson = 0.3
state = "plane-strain"
[[crack]]
points = [[-0.35, -0.25], [0.35, 0.25]]
[[boundary]]
on = "bottom"
traction = [0.0, -1.0]
[[boundary]]
on = "top"
traction = [0.0, 1.0]
[discretization]
level = 3
"""


def run(*arguments, folder):
    done = subprocess.run(programs.ppum(*arguments), cwd=ROOT if programs.BUILT is None else folder, capture_output=True, text=True)
    assert done.returncode == 0, done.stderr
    return done.stdout


def exported(folder):
    """The paths of a dataset and of its mesh."""
    (folder / "plate.toml").write_text(PROBLEM)
    run("solve", folder / "plate.toml", "-o", folder / "plate.h5", folder=folder)
    accuracy = ["--tolerance", TOLERANCE, "--tip-radius", RADIUS]
    run("export", folder / "plate.h5", "-o", folder / "plate.vtu", *accuracy, folder=folder)
    return folder / "plate.h5", folder / "plate.vtu"


def sampled(dataset, points, folder):
    """Exact ux, uy, syy and von Mises' stress at points that lie on no crack."""
    np.savetxt(folder / "points.csv", points, delimiter=",", fmt="%.17g")
    quantities = ["-q", "ux,uy,syy,von-mises", "-o", folder / "values.npy"]
    run("sample", dataset, "--points", folder / "points.csv", *quantities, folder=folder)
    rows = np.load(folder / "values.npy")
    assert len(rows) == len(points)
    return np.stack([rows[name] for name in rows.dtype.names if name in ("ux", "uy", "syy", "von-mises")], axis=1)


def allowed(field_data):
    """The tolerance of displacement, stress and von Mises' stress, in columns of `sampled`."""
    u, stress, mises = np.ravel(field_data["allowed_difference"])
    return np.array([u, u, stress, mises])


def text(field_data, name):
    return bytes(np.ravel(field_data[name]).astype(np.uint8)).decode()


def is_beside(points):
    """True where a point lies farther from the crack's line than rounding: `sample` has two rows on a crack."""
    along = (TIPS[1] - TIPS[0]) / np.linalg.norm(TIPS[1] - TIPS[0])
    from_tip = points - TIPS[0]
    return np.abs(along[0] * from_tip[:, 1] - along[1] * from_tip[:, 0]) > 1e-14


def check_differences(dataset, interpolated, points, tolerances, folder):
    """Displacements everywhere, stresses outside of the radius about tips."""
    beside = is_beside(points)
    assert beside.mean() > 0.95
    points, interpolated = points[beside], interpolated[beside]
    exact = sampled(dataset, points, folder)
    away = np.linalg.norm(points[:, None] - TIPS[None], axis=2).min(axis=1)
    off = np.abs(exact - interpolated)
    assert (off[:, :2] <= tolerances[:2]).all(), off.max(axis=0)
    assert (off[away > RADIUS] <= tolerances).all(), off[away > RADIUS].max(axis=0)
    assert off[:, 0].max() > 0


def test_meshio_reads_the_mesh():
    if importlib.util.find_spec("meshio") is None:
        print("SKIPPED 1 (so far): meshes in meshio: it is not installed")
        return
    import meshio

    with tempfile.TemporaryDirectory(prefix="ppum-") as name:
        folder = pathlib.Path(name)
        dataset, path = exported(folder)
        mesh = meshio.read(path)
        [cells] = mesh.cells
        assert cells.type == "triangle"
        random = np.random.default_rng(1)
        chosen = cells.data[random.integers(len(cells.data), size=POINTS)]
        weights = random.dirichlet([1, 1, 1], size=POINTS)
        points = np.einsum("nk,nkd->nd", weights, mesh.points[chosen])[:, :2]
        u, stress, mises = (mesh.point_data[key] for key in ("displacement", "stress", "von-mises"))
        assert u.shape[1] == 3 and stress.shape[1] == 6
        columns = np.column_stack([u[:, :2], stress[:, 1], mises])
        interpolated = np.einsum("nk,nkc->nc", weights, columns[chosen])
        check_differences(dataset, interpolated, points, allowed(mesh.field_data), folder)
        assert text(mesh.field_data, "title") == "Slanted crack & <tags>"
        assert text(mesh.field_data, "quantities").split("\n") == ["displacement", "stress", "von-mises"]


def test_vtk_probes_the_mesh():
    if importlib.util.find_spec("vtkmodules") is None:
        print("SKIPPED 1 (so far): meshes in VTK: it is not installed")
        return
    import vtk
    from vtk.util.numpy_support import numpy_to_vtk, vtk_to_numpy

    with tempfile.TemporaryDirectory(prefix="ppum-") as name:
        folder = pathlib.Path(name)
        dataset, path = exported(folder)
        reader = vtk.vtkXMLUnstructuredGridReader()
        reader.SetFileName(str(path))
        reader.Update()
        grid = reader.GetOutput()
        assert grid.GetNumberOfCells() > 1000
        points = np.random.default_rng(2).uniform(-1, 1, size=(POINTS, 2))
        cloud, positions = vtk.vtkPolyData(), vtk.vtkPoints()
        positions.SetData(numpy_to_vtk(np.column_stack([points, np.zeros(POINTS)]), deep=True))
        cloud.SetPoints(positions)
        probe = vtk.vtkProbeFilter()
        probe.SetInputData(cloud)
        probe.SetSourceData(grid)
        # the default search misses points of cells that are there
        probe.SetCellLocatorPrototype(vtk.vtkStaticCellLocator())
        probe.Update()
        found = probe.GetOutput().GetPointData()
        valid = vtk_to_numpy(found.GetArray("vtkValidPointMask")) == 1
        assert valid.all()
        array = lambda name: vtk_to_numpy(found.GetArray(name))
        interpolated = np.column_stack([array("displacement")[:, :2], array("stress")[:, 1], array("von-mises")])
        fields = grid.GetFieldData()
        data = {fields.GetArrayName(k): vtk_to_numpy(fields.GetArray(k)) for k in range(fields.GetNumberOfArrays())}
        check_differences(dataset, interpolated, points, allowed(data), folder)
        assert [grid.GetPointData().GetArray("stress").GetComponentName(k) for k in range(6)] == [
            "XX", "YY", "ZZ", "XY", "YZ", "XZ",
        ]
        assert data["tips"].shape == (2, 3) and data["stress_intensity_factors"].shape == (2, 2)


def test_vtk_reads_lines():
    """The tips with their K, the crack from one to the other, and all of the border."""
    if importlib.util.find_spec("vtkmodules") is None:
        print("SKIPPED 1 (so far): lines in VTK: it is not installed")
        return
    import h5py
    import vtk
    from vtk.util.numpy_support import vtk_to_numpy

    with tempfile.TemporaryDirectory(prefix="ppum-") as name:
        folder = pathlib.Path(name)
        dataset, _ = exported(folder)
        run("export", dataset, "-o", folder / "lines.vtp", folder=folder)
        reader = vtk.vtkXMLPolyDataReader()
        reader.SetFileName(str(folder / "lines.vtp"))
        reader.Update()
        lines = reader.GetOutput()
        array = lambda name: vtk_to_numpy(lines.GetCellData().GetArray(name))
        assert (lines.GetNumberOfVerts(), lines.GetNumberOfLines()) == (2, 5)
        points = vtk_to_numpy(lines.GetPoints().GetData())
        assert (points[:2, :2] == TIPS).all()
        ends = points[2:, :2].reshape(-1, 2, 2)
        lengths = np.linalg.norm(ends[:, 1] - ends[:, 0], axis=1)
        is_crack = array("crack")[2:] == 0
        assert (array("kind")[2:] == is_crack).all() and (array("kind")[:2] == 2).all()
        assert np.isclose(lengths[is_crack].sum(), np.linalg.norm(TIPS[1] - TIPS[0]))
        assert np.isclose(lengths[~is_crack].sum(), 8)
        with h5py.File(dataset) as file:
            stored = file["steps/0000/intensities"]
            for name, array_name in [("k1", "K_I"), ("k2", "K_II"), ("t_stress", "T"), ("j", "J"), ("error", "error")]:
                assert (array(array_name)[:2] == stored[name][()]).all()
        assert np.isnan(array("K_I")[2:]).all()


GROWTH = """
[growth]
steps = 2
increment = 0.05
"""


def arrays_of(grid):
    """Points, corners of cells, arrays at points and field data, by names."""
    from vtk.util.numpy_support import vtk_to_numpy

    named = {"points": grid.GetPoints().GetData(), "corners": grid.GetCells().GetConnectivityArray()}
    for kind, data in [("", grid.GetPointData()), ("field ", grid.GetFieldData())]:
        named.update({kind + data.GetArrayName(k): data.GetArray(k) for k in range(data.GetNumberOfArrays())})
    return {name: vtk_to_numpy(array) for name, array in named.items()}


def test_vtk_reads_the_steps_of_one_file():
    """The file of a series has in each step what the file of that step has."""
    if importlib.util.find_spec("vtkmodules") is None:
        print("SKIPPED 1 (so far): series in VTK: it is not installed")
        return
    import vtk

    with tempfile.TemporaryDirectory(prefix="ppum-") as name:
        folder = pathlib.Path(name)
        (folder / "growth.toml").write_text(PROBLEM + GROWTH)
        run("solve", folder / "growth.toml", "-o", folder / "growth.h5", folder=folder)
        asked = ["-q", "displacement,stress,sxx/2", "--tolerance", 0.05]
        run("export", folder / "growth.h5", "-o", folder / "growth.vtkhdf", *asked, folder=folder)
        series = vtk.vtkHDFReader()
        series.SetFileName(str(folder / "growth.vtkhdf"))
        series.UpdateInformation()
        steps = series.GetNumberOfSteps()
        sizes = set()
        for step in range(steps):
            run("export", folder / "growth.h5", "-o", folder / "step.vtu", "--step", step, *asked, folder=folder)
            one = vtk.vtkXMLUnstructuredGridReader()
            one.SetFileName(str(folder / "step.vtu"))
            one.Update()
            series.SetStep(step)
            series.Update()
            assert series.GetTimeValue() == step
            alone, together = arrays_of(one.GetOutput()), arrays_of(series.GetOutputDataObject(0))
            together["sxx/2"] = together.pop("sxx\u22152")
            together = {name: rows for name, rows in together.items() if name != "field Time"}
            assert together.keys() == alone.keys(), together.keys() ^ alone.keys()
            for name, rows in alone.items():
                assert (together[name] == rows).all(), name
            sizes.add(len(alone["points"]))
        assert steps == 3 and len(sizes) > 1


if __name__ == "__main__":
    for name, test in list(globals().items()):
        if name.startswith("test_"):
            test()
            print("ok ", name)
