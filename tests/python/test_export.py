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


def needs(package, what):
    """Gives a test an empty folder, and skips it where a package is missing."""

    def decorate(test):
        def wrapper():
            if importlib.util.find_spec(package) is None:
                print(f"SKIPPED 1 (so far): {what}: it is not installed")
                return
            with tempfile.TemporaryDirectory(prefix="ppum-") as name:
                test(pathlib.Path(name))

        wrapper.__name__, wrapper.__doc__ = test.__name__, test.__doc__
        return wrapper

    return decorate


def solved(folder, problem=PROBLEM):
    """The path of a dataset."""
    (folder / "plate.toml").write_text(problem)
    run("solve", folder / "plate.toml", "-o", folder / "plate.h5", folder=folder)
    return folder / "plate.h5"


def exported(dataset, name, *options):
    """The path of a file made of a dataset."""
    path = dataset.with_name(name)
    run("export", dataset, "-o", path, *options, folder=path.parent)
    return path


def read(reader, path):
    reader.SetFileName(str(path))
    reader.Update()
    return reader.GetOutputDataObject(0)


ACCURACY = ["--tolerance", TOLERANCE, "--tip-radius", RADIUS]


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


def columns_of(arrays):
    """The columns of `sampled` among arrays at points."""
    return np.column_stack([arrays["displacement"][:, :2], arrays["stress"][:, 1], arrays["von-mises"]])


def check_differences(dataset, interpolated, points, field_data):
    """Displacements everywhere, stresses outside of the radius about tips."""
    beside, tolerances = is_beside(points), allowed(field_data)
    assert beside.mean() > 0.95
    points, interpolated = points[beside], interpolated[beside]
    exact = sampled(dataset, points, dataset.parent)
    away = np.linalg.norm(points[:, None] - TIPS[None], axis=2).min(axis=1)
    off = np.abs(exact - interpolated)
    assert (off[:, :2] <= tolerances[:2]).all(), off.max(axis=0)
    assert (off[away > RADIUS] <= tolerances).all(), off[away > RADIUS].max(axis=0)
    assert off[:, 0].max() > 0


@needs("meshio", "meshes in meshio")
def test_meshio_reads_the_mesh(folder):
    import meshio

    dataset = solved(folder)
    mesh = meshio.read(exported(dataset, "plate.vtu", *ACCURACY))
    [cells] = mesh.cells
    assert cells.type == "triangle"
    random = np.random.default_rng(1)
    chosen = cells.data[random.integers(len(cells.data), size=POINTS)]
    weights = random.dirichlet([1, 1, 1], size=POINTS)
    points = np.einsum("nk,nkd->nd", weights, mesh.points[chosen])[:, :2]
    assert mesh.point_data["displacement"].shape[1] == 3 and mesh.point_data["stress"].shape[1] == 6
    interpolated = np.einsum("nk,nkc->nc", weights, columns_of(mesh.point_data)[chosen])
    check_differences(dataset, interpolated, points, mesh.field_data)
    assert text(mesh.field_data, "title") == "Slanted crack & <tags>"
    assert text(mesh.field_data, "quantities").split("\n") == ["displacement", "stress", "von-mises"]
    assert text(mesh.field_data, "units").split("\n") == [""] * 3


def probed(grid, points):
    """The arrays of a grid at points of the plane or in space, as VTK interpolates in its cells."""
    import vtk
    from vtk.util.numpy_support import numpy_to_vtk

    cloud, positions = vtk.vtkPolyData(), vtk.vtkPoints()
    positions.SetData(numpy_to_vtk(np.pad(points, ((0, 0), (0, 3 - points.shape[1]))), deep=True))
    cloud.SetPoints(positions)
    probe = vtk.vtkProbeFilter()
    probe.SetInputData(cloud)
    probe.SetSourceData(grid)
    # the default search misses points of cells that are there
    (getattr(probe, "SetCellLocator", None) or probe.SetCellLocatorPrototype)(vtk.vtkStaticCellLocator())
    probe.Update()
    found = arrays_of(probe.GetOutput())
    assert (found["vtkValidPointMask"] == 1).all()
    return found


@needs("vtkmodules", "meshes in VTK")
def test_vtk_probes_meshes_of_all_orders(folder):
    import vtk

    dataset = solved(folder)
    counts = []
    for order in (1, 2, 3, 4):
        path = exported(dataset, "plate.vtu", *ACCURACY, "--order", order)
        grid = read(vtk.vtkXMLUnstructuredGridReader(), path)
        counts.append(grid.GetNumberOfCells())
        points = np.random.default_rng(2).uniform(-1, 1, size=(POINTS, 2))
        data = arrays_of(grid, grid.GetFieldData())
        check_differences(dataset, columns_of(probed(grid, points)), points, data)
        check_faces(dataset, arrays_of(grid))
        assert [grid.GetPointData().GetArray("stress").GetComponentName(k) for k in range(6)] == [
            "XX", "YY", "ZZ", "XY", "YZ", "XZ",
        ]
        assert data["tips"].shape == (2, 3) and data["stress_intensity_factors"].shape == (2, 2)
        if order == 1:
            check_contours(dataset, grid, data)
    assert counts[0] > max(counts[1:]) > 1000


REVOLUTION = """
[domain]
min = [0.0, -1.0]
max = [1.0, 1.0]
[material]
young = 1.0
poisson = 0.3
state = "axisymmetric"
[[crack]]
points = [[0.3, -0.2], [0.6, 0.1]]
[[boundary]]
on = "bottom"
traction = [0.0, -1.0]
[[boundary]]
on = "top"
traction = [0.0, 1.0]
[discretization]
level = 3
"""


@needs("vtkmodules", "swept meshes in VTK")
def test_vtk_reads_swept_bodies(folder):
    """Wedges, pyramids and tetrahedra fill the body, and what turns with the points is that of the half-plane."""
    import vtk

    segments, dataset = 60, solved(folder, REVOLUTION)
    accuracy = ("--tolerance", 0.05, "--tip-radius", RADIUS)
    flat, body = (
        read(vtk.vtkXMLUnstructuredGridReader(), exported(dataset, name, *accuracy, *options))
        for name, options in (("flat.vtu", ()), ("body.vtu", ("--revolve", segments)))
    )
    assert body.GetNumberOfCells() == segments * flat.GetNumberOfCells()
    sizes = vtk.vtkCellSizeFilter()
    sizes.SetInputData(body)
    sizes.Update()
    data = sizes.GetOutput().GetCellData()
    volumes = np.array([data.GetArray("Volume").GetValue(k) for k in range(body.GetNumberOfCells())])
    assert (volumes > 0).all() and abs(volumes.sum() / (segments * np.sin(2 * np.pi / segments)) - 1) < 1e-9
    random = np.random.default_rng(5)
    x, y, angle = random.uniform(0.01, 0.99, 2000), random.uniform(-1, 1, 2000), random.uniform(0, 2 * np.pi, 2000)
    far = (np.hypot(x - 0.3, y + 0.2) > 0.1) & (np.hypot(x - 0.6, y - 0.1) > 0.1) & (abs(y + 0.5 - x) > 0.02)
    x, y, angle = x[far], y[far], angle[far]
    c, s = np.cos(angle), np.sin(angle)
    found = probed(body, np.column_stack([x * c, y, -x * s]))
    own = probed(flat, np.column_stack([x, y]))
    u, (xx, yy, zz, xy, yz, xz) = found["displacement"], found["stress"].T
    pairs = [
        (c * u[:, 0] - s * u[:, 2], own["displacement"][:, 0]),
        (s * u[:, 0] + c * u[:, 2], 0 * x),
        (u[:, 1], own["displacement"][:, 1]),
        (c * c * xx + s * s * zz - 2 * c * s * xz, own["stress"][:, 0]),
        (yy, own["stress"][:, 1]),
        (s * s * xx + c * c * zz + 2 * c * s * xz, own["stress"][:, 2]),
        (c * xy - s * yz, own["stress"][:, 3]),
        (s * xy + c * yz, 0 * x),
        (found["von-mises"], own["von-mises"]),
    ]
    of_displacement, of_stress, of_mises = arrays_of(flat, flat.GetFieldData())["allowed_difference"]
    bounds = [of_displacement] * 3 + [of_stress] * 5 + [of_mises]
    for k, ((turned, expected), bound) in enumerate(zip(pairs, bounds, strict=True)):
        # chords are nearer to the axis than the half-plane's points, perhaps in another triangle
        assert abs(turned - expected).max() < bound, (k, abs(turned - expected).max(), bound)


#: Distance from the crack at which its faces are sampled.
BESIDE = 1e-9


def check_faces(dataset, arrays):
    """Each place on the crack has a point for each side, with the displacement beside it."""
    along = (TIPS[1] - TIPS[0]) / np.linalg.norm(TIPS[1] - TIPS[0])
    across = np.array([-along[1], along[0]])
    from_tip = arrays["points"][:, :2] - TIPS[0]
    s = from_tip @ along / np.linalg.norm(TIPS[1] - TIPS[0])
    on = (np.abs(from_tip @ across) < 1e-12) & (s > 0.01) & (s < 0.99)
    at, u = arrays["points"][on][:, :2], arrays["displacement"][on][:, :2]
    above, below = (sampled(dataset, at + side * BESIDE * across, dataset.parent)[:, :2] for side in (1, -1))
    off = np.stack([np.abs(u - face).max(axis=1) for face in (above, below)])
    # gradients of 20 at most outside of s > 0.01
    assert (off.min(axis=0) < 20 * BESIDE).all() and (np.abs(above - below).max(axis=1) > 1e-3).all()
    own = np.argmin(off, axis=0)
    faces = {}
    for place, side in zip(map(tuple, np.round(at, 12)), own):
        faces.setdefault(place, set()).add(side)
    assert len(faces) > 20 and all(sides == {0, 1} for sides in faces.values())


def check_contours(dataset, grid, field_data):
    """Contours of VTK end at the crack, and are where the field has their level."""
    import vtk
    from vtk.util.numpy_support import vtk_to_numpy

    uy = vtk.vtkArrayCalculator()
    uy.SetInputData(grid)
    uy.AddScalarVariable("uy", "displacement", 1)
    uy.SetFunction("uy")
    uy.SetResultArrayName("uy")
    contour = vtk.vtkContourFilter()
    contour.SetInputConnection(uy.GetOutputPort())
    contour.SetInputArrayToProcess(0, 0, 0, vtk.vtkDataObject.FIELD_ASSOCIATION_POINTS, "uy")
    levels = np.linspace(-2, 2, 9) + 0.1
    for k, level in enumerate(levels):
        contour.SetValue(k, level)
    contour.Update()
    found = contour.GetOutput()
    points = vtk_to_numpy(found.GetPoints().GetData())[:, :2].astype(float)
    ends = points[vtk_to_numpy(found.GetLines().GetConnectivityArray()).reshape(-1, 2)]
    line = TIPS[1] - TIPS[0]
    side = line[0] * (ends - TIPS[0])[..., 1] - line[1] * (ends - TIPS[0])[..., 0]
    s = (ends - TIPS[0]) @ line / (line @ line)
    crosses = (side[:, 0] * side[:, 1] < 0) & (np.abs(side).min(axis=1) > 1e-6) & ((s > 0) & (s < 1)).all(axis=1)
    assert len(ends) > 100 and not crosses.any()
    exact = sampled(dataset, points[is_beside(points)], dataset.parent)[:, 1]
    off = np.abs(exact[:, None] - levels).min(axis=1)
    # points of contours are in single precision
    assert off.max() <= 1.01 * allowed(field_data)[1], off.max()


@needs("vtkmodules", "lines in VTK")
def test_vtk_reads_lines(folder):
    """The tips with their K, the crack from one to the other, all of the border, its loads, and isolines."""
    import h5py
    import vtk

    dataset = solved(folder)
    path = exported(dataset, "lines.vtp", "-q", "uy", "--isolines", "-0.5,0.7,1.1")
    lines = read(vtk.vtkXMLPolyDataReader(), path)
    array = arrays_of(lines, lines.GetCellData())
    kind, offsets = array["kind"], arrays_of(lines, lines.GetFieldData(), lines.GetLines())["offsets"]
    verts, isolines = lines.GetNumberOfVerts(), kind == 3
    count = isolines.sum()
    assert (kind[:2] == 2).all() and (kind[2:verts] == 5).all() and lines.GetNumberOfLines() == 5 + count
    points = arrays_of(lines)["points"][:, :2]
    assert (points[:2] == TIPS).all()
    loads = points[2:verts]
    assert len(loads) > 40 and (np.abs(loads[:, 1]) == 1).all()
    assert (array["traction"][2:verts] == loads[:, 1:] * [0, 1, 0]).all()
    assert not array["traction"][verts:].any() and not array["held"].any()
    ends = points[verts : verts + 10].reshape(-1, 2, 2)
    lengths = np.linalg.norm(ends[:, 1] - ends[:, 0], axis=1)
    is_crack = array["crack"][verts : verts + 5] == 0
    assert (kind[verts : verts + 5] == is_crack).all()
    assert np.isclose(lengths[is_crack].sum(), np.linalg.norm(TIPS[1] - TIPS[0]))
    assert np.isclose(lengths[~is_crack].sum(), 8)
    with h5py.File(dataset) as file:
        stored = file["steps/0000/intensities"]
        for name, array_name in [("k1", "K_I"), ("k2", "K_II"), ("t_stress", "T"), ("j", "J"), ("error", "error")]:
            assert (array[array_name][:2] == stored[name][()]).all()
    assert np.isnan(array["K_I"][2:]).all() and np.isnan(array["level"][~isolines]).all()
    assert set(array["level"][isolines]) == {-0.5, 0.7, 1.1} and (array["crack"][isolines] == -1).all()
    levels, places = np.repeat(array["level"][isolines], np.diff(offsets)[5:]), points[verts + 10 :]
    beside = is_beside(places)
    off = np.abs(sampled(dataset, places[beside], folder)[:, 1] - levels[beside])
    # Newton's method and places on faces are good to 1e-6 of a pixel of 2/768, with slopes of 20 at most
    assert count >= 3 and off.max() < 1e-6 * 2 / 768 * 20, off.max()


GROWTH = """
[growth]
steps = 2
increment = 0.05
"""


def arrays_of(grid, data=None, cells=None):
    """Arrays of a grid by names: those at points with the points, or the given ones."""
    from vtk.util.numpy_support import vtk_to_numpy

    data = grid.GetPointData() if data is None else data
    named = {data.GetArrayName(k): data.GetArray(k) for k in range(data.GetNumberOfArrays())}
    named["points"] = grid.GetPoints().GetData()
    if cells is not None:
        named.update(corners=cells.GetConnectivityArray(), offsets=cells.GetOffsetsArray())
    return {name: vtk_to_numpy(array) for name, array in named.items()}


@needs("vtkmodules", "series in VTK")
def test_vtk_reads_the_steps_of_one_file(folder):
    """The file of a series has in each step what the file of that step has."""
    import vtk

    dataset = solved(folder, PROBLEM + GROWTH)
    for order in (1, 3):
        asked = ["-q", "displacement,stress,sxx/2", "--tolerance", 0.05, "--order", order]
        series = vtk.vtkHDFReader()
        series.SetFileName(str(exported(dataset, "growth.vtkhdf", *asked)))
        series.UpdateInformation()
        steps = series.GetNumberOfSteps()
        sizes = set()
        for step in range(steps):
            one = exported(dataset, "step.vtu", "--step", step, *asked)
            one = read(vtk.vtkXMLUnstructuredGridReader(), one)
            series.SetStep(step)
            series.Update()
            assert series.GetTimeValue() == step
            both = series.GetOutputDataObject(0)
            assert one.GetCellType(0) == both.GetCellType(0) == (5 if order == 1 else 69)
            for of in (lambda grid: grid.GetPointData(), lambda grid: grid.GetFieldData()):
                alone, together = (arrays_of(grid, of(grid), grid.GetCells()) for grid in (one, both))
                together = {name.replace("\u2215", "/"): rows for name, rows in together.items() if name != "Time"}
                assert together.keys() == alone.keys(), together.keys() ^ alone.keys()
                for name, rows in alone.items():
                    assert (together[name] == rows).all(), name
            sizes.add(len(alone["points"]))
        assert steps == 3 and len(sizes) > 1


def inside_cells(grid, count, seed):
    """Random points in random cells: their coordinates, and the points of the cell with their weights, by VTK."""
    import vtk

    random = np.random.default_rng(seed)
    places = []
    for number in random.integers(grid.GetNumberOfCells(), size=count):
        cell, at, weights = grid.GetCell(int(number)), [0.0] * 3, [0.0] * grid.GetCell(int(number)).GetNumberOfPoints()
        p, q = sorted(random.uniform(size=2))
        cell.EvaluateLocation(vtk.reference(0), [p, q - p, 0.0], at, weights)
        places.append((at[:2], [cell.GetPointId(k) for k in range(len(weights))], weights))
    points, numbers, weights = zip(*places)
    return np.array(points), np.array(numbers), np.array(weights)


@needs("vtkmodules", "fields on meshes in VTK")
def test_vtk_reads_fields_on_meshes(folder):
    """Straight, curved and cut elements of other libraries, against `ppum sample`."""
    import vtk

    for fixture in sorted((ROOT / "tests/python/fixtures").glob("*.h5")):
        dataset = folder / fixture.name
        dataset.write_bytes(fixture.read_bytes())
        for order in (1, 3):
            options = ["--tolerance", 5e-4, "--order", order]
            path = exported(dataset, "mesh.vtu", *options)
            grid = read(vtk.vtkXMLUnstructuredGridReader(), path)
            data, arrays = arrays_of(grid, grid.GetFieldData()), arrays_of(grid)
            name = text(data, "quantities").split("\n")[0]
            values = arrays[name].reshape(len(arrays["points"]), -1)[:, 0]
            points, numbers, weights = inside_cells(grid, 1000, order)
            np.savetxt(folder / "points.csv", points, delimiter=",", fmt="%.17g")
            quantity = name if arrays[name].ndim == 1 else "u0"
            run("sample", dataset, "--points", folder / "points.csv", "-q", quantity, "-o", folder / "values.npy", folder=folder)
            exact = np.load(folder / "values.npy")[quantity]
            off = np.abs((values[numbers] * weights).sum(axis=1) - exact)
            # chords of curved borders and cuts leave out, or add, a thousandth of an element
            assert np.isfinite(exact).mean() > 0.98, fixture.name
            beyond = off[np.isfinite(exact)] > np.ravel(data["allowed_difference"])[0]
            assert beyond.mean() <= (0.005 if "getfem" in fixture.name else 0), (fixture.name, order, beyond.sum(), off[np.isfinite(exact)].max())


if __name__ == "__main__":
    for name, test in list(globals().items()):
        if name.startswith("test_"):
            test()
            print("ok ", name)
