"""Values against the independent reader, which was written from FORMAT.md alone, and against the program."""

import csv
import json
import sys

import h5py
import mpmath
import numpy as np
import ppum
import pytest
from conftest import ROOT

sys.path.append(str(ROOT / "tests/python"))
import ppum_formulas  # noqa: E402
import ppum_reader  # noqa: E402

NAMES = ["sxx", "syy", "sxy", "szz", "von-mises", "s1", "s2", "energy"]


@pytest.fixture(params=["ds", "holed"])
def both(request, tmp_path, monkeypatch):
    """A dataset, and the reader's field of it, in 40 digits: near tips its doubles cancel."""
    monkeypatch.setattr(mpmath.mp, "dps", 40)
    dataset = request.getfixturevalue(request.param)
    dataset.save(tmp_path / "plate.h5")
    with h5py.File(tmp_path / "plate.h5") as file:
        yield dataset, ppum_reader.Field(file, numbers=ppum_formulas.Extended)


def test_values_are_those_of_the_reader(both):
    dataset, reader = both
    field, random = dataset.field, np.random.default_rng(7)
    low, high = np.array(dataset.domain)
    at = random.uniform(low, high, (60, 2))
    around = [tip.xy + 10.0**-k * random.normal(size=2) for tip in dataset.tips for k in range(1, 12)]
    x, y = np.concatenate([at, around]).T
    inside = np.isfinite(field.at(x, y).ux)
    x, y = x[inside], y[inside]
    found = field.evaluate(x, y, ["ux", "uy", "dux_dx", "dux_dy", "duy_dx", "duy_dy"])
    expected = []
    for p in zip(x, y):
        u = reader.evaluate(*p)
        expected.append([float(n) for n in (u[0][0], u[1][0], u[0][1], u[0][2], u[1][1], u[1][2])])
    expected = np.array(expected)
    size = np.linalg.norm(expected[:, :2], axis=1).max()
    assert np.abs(found[:, :2] - expected[:, :2]).max() <= 1e-12 * size
    # of the local size of the gradient, which is that of the plate where it vanishes
    local = np.maximum(np.linalg.norm(expected[:, 2:], axis=1), size)
    assert (np.abs(found[:, 2:] - expected[:, 2:]).max(axis=1) / local).max() <= 1e-12


def test_quantities_are_those_of_the_reader(both):
    dataset, reader = both
    x, y = np.random.default_rng(8).uniform(*np.array(dataset.domain), (20, 2)).T
    found = dataset.field.evaluate(x, y, NAMES)
    for k, p in enumerate(zip(x, y)):
        if np.isfinite(found[k, 0]):
            expected = np.array([float(reader.quantity(name, *p)) for name in NAMES])
            size = max(abs(expected[NAMES.index("s1")]), abs(expected[NAMES.index("s2")]), 1.0)
            assert np.abs(found[k] - expected).max() <= 1e-12 * size


def test_values_are_those_of_the_program(ds, f, program, tmp_path):
    ds.save(tmp_path / "plate.h5")
    x, y = np.random.default_rng(9).uniform(*np.array(ds.domain), (200, 2)).T
    np.savetxt(tmp_path / "points.csv", np.stack([x, y], 1), fmt="%.17g", delimiter=",")
    program("sample", tmp_path / "plate.h5", "--points", tmp_path / "points.csv", "-q", "ux,von-mises", "-o", tmp_path / "v.csv")
    with open(tmp_path / "v.csv") as file:
        rows = list(csv.DictReader(line for line in file if not line.startswith("#")))
    found = f.evaluate(x, y, ["ux", "von-mises"])
    expected = np.array([[float(row["ux"]), float(row["von-mises"])] for row in rows])
    assert np.abs(found - expected).max() <= 1e-12 * np.abs(expected).max()
    info = json.loads(program("sif", tmp_path / "plate.h5", "--json"))
    assert len(str(info)) > 0


def test_sides_of_a_crack(ds, f):
    v = f.at(0.0, 0.0, side="both")
    above, below = v.uy
    assert above > 0 > below and above - below > 0.1
    assert f.at(0.0, 0.0).uy == above and f.at(0.0, 0.0, side="below").uy == below
    # off the crack there is one value
    assert np.ptp(f.at(0.5, -0.5, side="both").uy) == 0.0
    # decimal digits on an oblique crack are on it
    a, b = ds.cracks[0].points
    t = np.random.default_rng(1).uniform(0.05, 0.95, 100)[:, None]
    x, y = (a + t * (b - a)).T
    jump = f.at(x, y, side="both").uy
    assert (jump[:, 0] - jump[:, 1] > 0.01).all()
    with pytest.raises(ValueError, match="above"):
        f.at(0, 0, side="left")


def test_offsets_from_a_tip_lose_nothing(ds, f):
    tip = ds.tips[1]
    for direction in (0.3, 2.0, -2.5):
        d = np.array([np.cos(direction), np.sin(direction)])
        r = 10.0 ** -np.arange(6.0, 100.0, 8.0)
        stress = f.at(r * d[0], r * d[1], anchor=tip.xy).von_mises * np.sqrt(r)
        # near a tip σ √r depends on the direction alone; what is next is smaller by √r
        assert np.abs(stress / stress[-1] - 1).max() < 1e-2
        assert np.abs(stress[3:] / stress[-1] - 1).max() < 1e-9
    with pytest.raises(ValueError, match="point"):
        f.at(0, 0, anchor=(1, 2, 3))


def test_gradients_are_those_of_differences(f):
    x, y = np.random.default_rng(2).uniform((-0.9, -1.9), (0.9, 1.9), (200, 2)).T
    for name in ("ux", "von_mises", "sxx + uy^2"):
        h = 1e-5
        across = f.at(x + h, y)[name] - f.at(x - h, y)[name]
        up = f.at(x, y + h)[name] - f.at(x, y - h)[name]
        found = f.at(x, y).gradient(name)
        differences = np.stack([across, up], 1) / (2 * h)
        # patches' borders have kinks in second derivatives
        assert np.median(np.abs(found - differences)) < 1e-6
    values, slopes = f.evaluate(x, y, ["ux", "uy"], gradient=True)
    assert np.allclose(slopes[:, 0, 0], f.at(x, y).dux_dx, rtol=1e-12, atol=1e-12)


def test_parts_add_up(f):
    x, y = np.random.default_rng(3).uniform((-1, -2), (1, 2), (200, 2)).T
    parts = [f.part(part).at(x, y).uy for part in ("smooth", "jump", "tip")]
    assert np.allclose(sum(parts), f.at(x, y).uy, rtol=0, atol=1e-12)
    assert f.part("smooth").part("smooth").at(0.1, 0.2).ux == f.part("smooth").at(0.1, 0.2).ux
    for wrong in ("smoth", "patch:99999", "other"):
        with pytest.raises(ppum.QuantityError):
            f.part(wrong)


def test_replacements(ds, f, holed):
    for which in ("westergaard 2", "westergaard 2 of crack 0 end", "7"):
        changed = f.with_function({which: "0"})
        assert changed.at(0.35, 0.36).uy != f.at(0.35, 0.36).uy
    both = f.with_function({"westergaard 2": "0"}).with_function({"westergaard 3": "0"})
    once = f.with_function({"westergaard 2": "0", "westergaard 3": "0"})
    assert both.at(0.35, 0.36).uy == once.at(0.35, 0.36).uy != changed.at(0.35, 0.36).uy
    bump = f.with_weight("bump")
    assert bump.at(0.1234, 0.777).uy != f.at(0.1234, 0.777).uy
    assert bump.with_weight("linear").at(0.1234, 0.777).uy == f.at(0.1234, 0.777).uy
    other = holed.field.with_quantity({"safety": "4/von_mises"})
    assert other.at(1.5, 0.9).safety == pytest.approx(2 * holed.field.at(1.5, 0.9).safety, rel=1e-14)
    for wrong in (lambda: f.with_function({"nothing": "r"}), lambda: f.with_weight("bmp"), lambda: f.with_quantity({"a": "1"})):
        with pytest.raises(ppum.QuantityError):
            wrong()


def test_tables_of_curves(ds, f):
    line = f.sample.line((-0.9, 0.13), (0.8, 1.1), num=33, quantities=["uy", "sxx + syy"])
    assert line.uy.dims == ("s",) and line.s.size == 33
    expected = f.at(line.x, line.y).uy
    assert np.abs(line.uy.values - expected).max() < 1e-13
    assert line["sxx + syy"].size == 33
    through = f.sample.line((0, -1), (0, 1), num=21, quantities=["uy"])
    assert through.s.size == 22 and set(through.side.values) == {-1.0, 0.0, 1.0}
    faces = f.sample.crack(ds.cracks[0], num=11)
    assert faces.opening.size == 11 and faces.opening[5] > 0.1
    assert np.allclose(faces.uy_above - faces.uy_below, faces.jump_uy)
    assert f.sample.around(0, num=9).sizes == {"theta": 9}
    ray = f.sample.ray(1, 0.0, num=13, quantities=["syy"])
    assert ray.r.size == 13 and ray.r[0] == pytest.approx(1e-6 * float(ray.r[-1]))
    assert f.sample.circle((0.0, 0.5), 0.2, num=8).ux.size == 8
    with pytest.raises(IndexError):
        f.sample.crack(7)
    with pytest.raises(IndexError):
        f.sample.around(9)
    assert line.to_pandas().shape[0] == 33


def test_grids(f):
    grid = f.sample.grid(7, 5, quantities=["ux", "von-mises"])
    assert grid.ux.dims == ("y", "x") and (np.diff(grid.y) > 0).all()
    assert float(grid.ux.sel(x=1, y=-2)) == float(f.at(1.0, -2.0).ux)
    assert "von_mises" in grid and grid.von_mises.attrs["long_name"] == "von Mises stress"
    given = f.sample.grid(x=[0.0, 0.1], ny=3, side="both")
    assert given.uy.dims == ("y", "x", "side") and given.x.values.tolist() == [0.0, 0.1]
    assert float(given.uy.sel(x=0, y=0, side="above") - given.uy.sel(x=0, y=0, side="below")) > 0.1
    for wrong in ({"nx": 3}, {"nx": 3, "ny": 3, "x": [0.0]}, {"nx": 3, "y": [[0.0]]}):
        with pytest.raises(ValueError):
            f.sample.grid(**wrong)
