"""What newcomers type: taken where it has one meaning, else refused with the remedy."""

import builtins
import io
import os
import pathlib
import pickle
import sys

import numpy as np
import ppum
import pytest
from conftest import plate

plt = pytest.importorskip("matplotlib.pyplot")
plt.switch_backend("agg")


@pytest.fixture(autouse=True)
def no_figures_stay():
    yield
    plt.close("all")


def test_equal_datasets_have_equal_hashes(ds, grown, potential):
    copy = ppum.open(ds.to_bytes())
    assert copy == ds and hash(copy) == hash(ds) and len({ds, copy}) == 1
    assert len({ds, grown, potential}) == 3 and grown != ds
    assert copy.field == ds.field and len({copy.field, ds.field}) == 1
    assert ds.field.part("jump") != ds.field and ds.field.part("jump") == copy.field.part("jump")


def test_a_problem_solved_twice_gives_equal_datasets():
    """But for seconds."""
    problem = plate(cells=(4, 8))
    one, other = problem.solve(), problem.solve()
    assert one == other and hash(one) == hash(other)
    assert one != problem.discretization(order=1).solve()
    assert one != problem.boundary("left", traction=(0, 0)).solve()


def test_ranges_in_matplotlib(f):
    assert f.draw.plot("ux", vmin=0, vmax=2).get_clim() == (0, 2)
    auto = f.draw.plot("ux").get_clim()
    assert f.draw.plot("ux", vmin=-7).get_clim() == (-7, auto[1])
    finite = f.draw.plot("ux", clim=("10%", "90%")).get_clim()
    assert auto[0] < finite[0] < finite[1] < auto[1]
    x, _ = f.step.tips[1].xy
    assert f.draw.plot("ux", tip=1, zoom=4, ax=plt.figure().gca()).axes.get_xlim() == pytest.approx((x - 0.25, x + 0.25))


def test_colour_maps_are_known_in_matplotlib(f):
    for name in ppum.COLORMAPS:
        for cmap in (name, f"{name}_r"):
            assert f.draw.plot("ux", cmap=cmap, colorbar=False).cmap.name == cmap
    for name in ("batlow", "vik", "roma"):
        # those of the program, which draws a ramp with them
        colors = plt.get_cmap(name)(np.array([0.0, 1.0]), bytes=True)[:, :3]
        image = f.draw.image("x", center=(0, 1), width=0.2, size=(256, 1), cmap=name, clim=(-0.1, 0.1))
        assert np.abs(image[0, [0, -1], :3].astype(int) - colors).max() <= 2


def test_points_without_a_value_have_a_colour(f):
    figure = plt.figure(figsize=(1, 2), dpi=50)
    ax = figure.add_axes((0, 0, 1, 1))
    ax.set_axis_off()
    f.draw.plot("sqrt(x)", ax=ax, colorbar=False, cracks=False, cmap="gray", nan_color=(1, 0, 0))
    file = io.BytesIO()
    with np.errstate(invalid="ignore"):
        figure.savefig(file, dpi=50)
    image = plt.imread(io.BytesIO(file.getvalue()))
    assert np.allclose(image[20:80, 5:20, :3], (1, 0, 0)) and np.ptp(image[20:80, 30:45, :3], axis=-1).max() < 0.01


def test_cracks_are_arrays_too():
    empty = ppum.Problem(((0, 0), (1, 1)), ppum.Elastic(1.0, 0.3))
    points = [(0.2, 0.5), (0.5, 0.5), (0.6, 0.6)]
    expected = empty.crack(*points)
    assert all(empty.crack(given) == expected for given in (points, np.array(points), tuple(points)))


def test_angles_are_radians(ds, f):
    tip = ds.tips[1]
    ray = f.sample.ray(1, angle=tip.growth_angle, num=5, quantities=["ux"])
    way = np.arctan2(ray.y.values[-1] - tip.xy[1], ray.x.values[-1] - tip.xy[0])
    assert way == pytest.approx(tip.angle + tip.growth_angle, abs=1e-9)
    around = f.sample.around(1, num=5, quantities=["ux"])
    assert np.allclose(around.theta, np.linspace(-np.pi, np.pi, 5)) and around.theta.attrs["units"] == "rad"
    for wrong in (lambda: f.sample.ray(1, angle=45.0), lambda: ppum.plots.ray(f, 1, 45.0)):
        with pytest.raises(ValueError, match="angles are in radians"):
            wrong()


def test_curves_take_radians():
    """And tables of problem files their degrees, as before."""
    empty = ppum.Problem(((0, 0), (1, 1)), ppum.Elastic(1.0, 0.3))
    for start, end in np.random.default_rng(3).uniform(-np.pi, np.pi, (20, 2)):
        arc = ppum.arc((0.5, 0.4), 0.2, start, end)
        table = {"center": (0.5, 0.4), "radius": 0.2, "from": np.degrees(start), "to": np.degrees(end)}
        assert empty.crack(arc=arc) == empty.crack(arc=table)
        part = ppum.ellipse((0.5, 0.4), (0.3, 0.1), start, start=end, end=start)
        assert part["angle"] == part["to"] == np.degrees(start) and part["from"] == np.degrees(end)
    assert set(ppum.ellipse((0.5, 0.4), (0.3, 0.1))) == {"center", "axes", "angle"}
    for wrong in (lambda: ppum.arc((0, 0), 1, 20, 110), lambda: ppum.ellipse((0, 0), (2, 1), 45)):
        with pytest.raises(ValueError, match="angles are in radians"):
            wrong()


def test_points_without_a_value_have_a_colour_in_figures(f):
    look = {"center": (0, 0), "width": 2, "size": (80, 40), "cmap": "magma"}
    plain, red = f.draw.image("sqrt(x)", **look), f.draw.image("sqrt(x)", nan_color="#f01020", **look)
    without = (red[..., :3] == (0xF0, 0x10, 0x20)).all(axis=-1)
    assert without[:, :40].mean() > 0.98 and not without[:, 41:].any()
    assert np.array_equal(plain[~without], red[~without]) and not np.array_equal(plain, red)
    named = f.draw.image("sqrt(x)", nan_color="white", **look)
    assert (named[without] == 255).all() and np.array_equal(red, f.draw.image("sqrt(x)", nan_color=(0xF0 / 255, 0x10 / 255, 0x20 / 255), **look))
    with pytest.raises(ValueError, match="nan_color: 'gray17x'"):
        f.draw.figure("sqrt(x)", nan_color="gray17x")


def test_labels_are_mathtext(f):
    line = f.sample.line((-1, 0.1), (1, 0.1), num=5, quantities=["syy"])
    assert line.syy.attrs["long_name"] == "σ$_{yy}$"
    assert f.sample.grid(3, 3, quantities=["syy"]).syy.attrs["long_name"] == "σ$_{yy}$"
    axis = plt.figure().gca()
    line.syy.plot(ax=axis)
    assert "$_{yy}$" in axis.get_ylabel()


def test_pictures_and_plots_are_pickled(f):
    figure = f.draw.figure("ux", tip=1, zoom=3, size=(400, 300))
    assert pickle.loads(pickle.dumps(figure)).png() == figure.png()
    moving = f.draw.animate("ux", size=(60, 80), bare=True, progress=lambda *_: None)
    assert pickle.loads(pickle.dumps(moving)).gif() == moving.gif()
    plot = ppum.plots.line(f, (-1, 0.1), (1, 0.1), ["ux"])
    assert pickle.loads(pickle.dumps(plot)).svg() == plot.svg()


def test_stars_leave_names_of_python(tmp_path):
    names = {}
    exec("from ppum import *", names)
    assert names.get("open", builtins.open) is builtins.open and names.get("Warning", Warning) is Warning
    assert names["solve"] is ppum.solve and ppum.open is not builtins.open and ppum.results.Warning is not Warning


def test_a_quantity_of_the_name_of_a_method(potential):
    values = potential.field.at(0.5, 0.5)
    assert values["gradient"] == pytest.approx(np.hypot(*values.gradient("u"))) and dir(values).count("gradient") == 1


@pytest.mark.parametrize(
    "use, kind, message",
    [
        (lambda ds, p: ppum.solve(p / "plate.h5"), ValueError, "is a dataset.*ppum.open"),
        (lambda ds, p: ppum.solve(ds), TypeError, "this is a dataset"),
        (lambda ds, p: ppum.solve(3), TypeError, "a path is needed, not int"),
        (lambda ds, p: ppum.Problem.read(p / "latin"), ppum.ProblemError, "byte 9 is no UTF-8"),
        (lambda ds, p: ppum.open(open(p / "latin", encoding="latin-1")), TypeError, "mode 'rb'"),
        (lambda ds, p: ppum.open(pytest.importorskip("h5py").File(p / "plate.h5")), TypeError, "give '.*plate.h5'"),
        (lambda ds, p: ppum.Problem(((0, 0), (1, 1)), {"young": 1}), TypeError, "ppum.Elastic, ppum.Anisotropic or ppum.Poisson is needed, not dict"),
        (lambda ds, p: ppum.Problem((0, 0), (1, 1)), TypeError, "ppum.Elastic, ppum.Anisotropic or ppum.Poisson is needed, not tuple"),
        (lambda ds, p: ppum.Problem((0, 0), ppum.Poisson()), TypeError, "two corners are needed"),
        (lambda ds, p: ds.field.draw.render("ux", zoom=0), ppum.RenderError, "zoom: 0 does not enlarge"),
        (lambda ds, p: ds.field.draw.render("ux", size=(-1, 5)), ppum.RenderError, "-1x5 cannot be drawn"),
        (lambda ds, p: ds.field.draw.figure("ux").save(p / "no/x.png"), FileNotFoundError, "there is no folder .*no"),
        (lambda ds, p: ds.field.draw.figure("ux").save(p / "x"), ValueError, "'x' has no end.*png, svg, pdf"),
        (lambda ds, p: ds.field.draw.figure("ux").save(p / "x.jpg"), ValueError, "'jpg': the forms of Figure are png, svg, pdf"),
        (lambda ds, p: ds.quantities["vonmises"], KeyError, "no quantity is called `vonmises`; did you mean `von-mises`"),
        (lambda ds, p: ds.history["unknown"], KeyError, "did you mean `unknowns`"),
        (lambda ds, p: ds.tips[7], IndexError, "no tip 7: there are 2 tips, numbered from 0"),
        (lambda ds, p: ds.steps[3], IndexError, "no step 3: there is 1 step, numbered from 0"),
        (lambda ds, p: ds.cracks[-2], IndexError, "no crack -2: there is 1 crack"),
        (lambda ds, p: ds.field.draw.figure(tip=9), IndexError, "no tip 9"),
        (lambda ds, p: ds.field.intensities(9), IndexError, "no tip 9"),
    ],
)
def test_what_has_no_meaning_is_refused(ds, tmp_path, use, kind, message):
    ds.save(tmp_path / "plate.h5")
    (tmp_path / "latin").write_bytes('title = "é"'.encode("latin-1"))
    with pytest.raises(kind, match=message):
        use(ds, tmp_path)
    assert sorted(path.name for path in tmp_path.iterdir()) == ["latin", "plate.h5"]


def test_tables_keep_their_words(ds):
    tips = pickle.loads(pickle.dumps(ds.tips))
    assert tips == ds.tips and tips[-1] == ds.tips[1] and tips[:1] == (ds.tips[0],)
    with pytest.raises(IndexError, match="there are 2 tips"):
        tips[2]
    assert [tip.end for tip in tips] == ["start", "end"]
    assert "unknowns 6600" in repr(ds.history)


def test_points_in_rows_and_tensors(ds, f):
    points = np.random.default_rng(1).uniform(-0.9, 0.9, (4, 5, 2))
    rows, both = f.at(points), ds.at(points, side="both")
    assert np.array_equal(rows.ux, f.at(points[..., 0], points[..., 1]).ux)
    assert np.array_equal(rows.displacement, np.stack([rows.ux, rows.uy], -1))
    for tensor, letter in ((rows.stress, "s"), (rows.strain, "e")):
        assert tensor.shape == (4, 5, 2, 2) and np.array_equal(tensor, np.swapaxes(tensor, -1, -2))
        assert np.array_equal(tensor[..., 0, 1], rows[f"{letter}xy"]) and np.array_equal(tensor[..., 1, 1], rows[f"{letter}yy"])
    # ½ σ:ε
    assert np.allclose(0.5 * (rows.stress * rows.strain).sum((-1, -2)), rows.energy, rtol=1e-12)
    assert both.stress.shape == (4, 5, 2, 2, 2) and f.at(0.5, 0.5).stress.shape == (2, 2)
    for wrong in (3.0, [1.0, 2.0, 3.0], np.zeros((2, 3))):
        with pytest.raises(TypeError, match=r"give x and y, or points of the shape \(\.\.\., 2\)"):
            f.at(wrong)


def test_datasets_have_what_their_last_field_has(grown):
    last = grown.steps[-1].field
    assert grown.at(0.1, 0.2).ux == last.at(0.1, 0.2).ux
    assert np.array_equal(grown.draw.render("ux", size=(8, 4)), last.draw.render("ux", size=(8, 4)))
    assert grown.evaluate([0.1], [0.2], ["ux"]).shape == (1, 1) and grown.intensities(0) == last.intensities(0)
    for name, meant in (("plot", "draw.plot"), ("render", "draw.render"), ("line", "sample.line"), ("to_html", "export.to_html")):
        with pytest.raises(AttributeError, match=f"Dataset has no attribute '{name}'; there is `{meant}`"):
            getattr(grown, name)


@pytest.mark.skipif(sys.platform != "linux", reason="counts open files")
def test_files_are_closed(grown, tmp_path):
    grown.save(tmp_path / "grown.h5")
    files = lambda: sum(str(tmp_path) in os.path.realpath(link) for link in pathlib.Path("/proc/self/fd").iterdir())
    before = files()
    with ppum.open(tmp_path / "grown.h5") as ds:
        value = ds.at(0.1, 0.2).ux
        assert files() == before + 1
    assert files() == before and value == grown.at(0.1, 0.2).ux
    assert repr(ds) == "<ppum.Dataset, closed>"
    for use in (lambda: ds.field, lambda: ds.to_bytes(), lambda: ds.steps[1].field):
        with pytest.raises(ValueError, match="the dataset is closed; open it again"):
            use()
    ds.close()


def test_colour_maps_of_matplotlib_in_figures(f):
    look = {"center": (0, 1), "width": 0.2, "size": (256, 1), "clim": (-0.1, 0.1)}
    for cmap in ("RdBu", plt.get_cmap("RdBu"), plt.get_cmap("cubehelix_r")):
        image = f.draw.image("x", cmap=cmap, **look)[0, :, :3].astype(int)
        colors = plt.get_cmap(cmap)(np.linspace(0, 1, 256), bytes=True)[:, :3].astype(int)
        assert np.abs(image - colors).max() <= 4 and np.ptp(image, axis=0).min() > 50
    figure = f.draw.figure("ux", cmap=plt.get_cmap("RdBu"), size=(300, 300))
    assert pickle.loads(pickle.dumps(figure)).png() == figure.png() == f.draw.figure("ux", cmap="RdBu", size=(300, 300)).png()
    with pytest.raises(TypeError, match="a map of matplotlib"):
        f.draw.figure("ux", cmap=3)
    with pytest.raises(ppum.RenderError, match="no colour map is named `RdBux`"):
        f.draw.figure("ux", cmap="RdBux")


def test_images_show_the_whole_of_a_half():
    half = ppum.Problem(((0, -1), (1, 1)), ppum.Elastic(1.0, 0.3)).boundary("left", symmetry=True).boundary("bottom", traction=(0, -1))
    f = half.boundary("top", traction=(0, 1)).discretization(level=2).solve().field
    image = f.draw.image("abs(ux)", mirror=True, size=(100, 100))
    # the whole, from -1 to 1, fills the image and is symmetric
    assert (image[..., 3] == 255).all() and np.abs(image.astype(int) - image[:, ::-1].astype(int)).max() <= 1
    alone = f.draw.image("abs(ux)", size=(100, 100))
    assert (alone[:, :20, 3] == 0).all() and (alone[:, 30:70, 3] == 255).all()
    near = f.draw.image("abs(ux)", mirror=True, size=(100, 100), center=(0.5, 0), width=0.5)
    assert (near[..., 3] == 255).all()


def test_shared_blocks_are_refused(ds, tmp_path):
    h5py = pytest.importorskip("h5py")
    ds.save(tmp_path / "plate.h5")
    with h5py.File(tmp_path / "plate.h5", "r+") as file:
        offsets = file["steps/0000/fields/0000/block_offset"]
        offsets[1] = offsets[0]
        for name in list(file.attrs):
            if "sha256" in name:
                del file.attrs[name]
    with pytest.raises(ppum.FormatError):
        ppum.open(tmp_path / "plate.h5")


def test_a_sweep_outlives_a_problem_that_cannot_be_made():
    pytest.importorskip("xarray")

    def make(level):
        if level == 1:
            raise ValueError("too coarse")
        return plate().discretization(level=level)

    result = ppum.sweep(make, level=[1, 2]).run()
    assert result.status.values.tolist() == ["ValueError: too coarse", ""]
    assert np.isnan(result.k1[0]).all() and np.isfinite(result.k1[1]).all()
    assert result.k1.attrs["long_name"] == "$K_{I}$"
    with pytest.raises(ValueError, match="too coarse"):
        ppum.sweep(make, level=[1]).run()
