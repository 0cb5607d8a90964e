"""Fields against fields and against what resampling makes of them, with numpy and the program as references."""

import json
import pickle

import numpy as np
import ppum
import pytest
from conftest import plate
from test_pictures import centers

#: Rounding of values that several orders of evaluation give, in parts of the largest one.
ROUNDING = 1e-11


def off_cracks(fields, view, name):
    """Pixels that do not lie on a crack, of which pictures take the side that rounding finds."""
    sides = [field.at(*centers(view), side="both")[name] for field in fields]
    return np.all([np.ptp(both, axis=-1) == 0 for both in sides], axis=0)


def norms(d):
    """By their definition, over the finite ones."""
    d = np.abs(d[np.isfinite(d)])
    return np.array([d.mean(), np.sqrt((d * d).mean()), d.max()])


def test_a_field_is_no_different_from_itself(f, holed):
    for field in (f, holed.field):
        found = field.compare(field, "von_mises", size=(83, 71))
        assert found.absolute == found.relative == (0, 0, 0)
        assert np.array_equal(np.isnan(found.values), np.isnan(field.draw.render("von_mises", size=(83, 71))))
        assert np.nanmax(np.abs(found.values)) == 0 and found.warnings == ()


def test_exchanged_fields_differ_by_the_sign(f):
    g = f.with_weight("bump")
    there, back = f.compare(g, "syy", size=(61, 90)), g.compare(f, "syy", size=(61, 90))
    assert np.array_equal(there.values, -back.values, equal_nan=True) and there.absolute == back.absolute
    assert there.absolute.l2 > 0 and there.relative != back.relative


@pytest.mark.parametrize("name", ["uy", "von_mises", "sxx*syy"])
def test_values_and_norms_are_those_of_numpy(f, name):
    g = ppum.solve(plate(cells=(10, 20))).field
    for seen in ({}, {"tip": 1, "zoom": 30}, {"center": (0.7, 1.4), "width": 1.1}):
        view = f.view_at(size=(64, 57), **seen)
        found = f.compare(g, name, view=view)
        own, its = f.at(*centers(view))[name], g.at(*centers(view))[name]
        off = off_cracks((f, g), view, name)
        size = np.nanmax(np.abs(own)) + np.nanmax(np.abs(its))
        assert np.nanmax(np.abs(found.values - (own - its))[off]) < ROUNDING * size
        assert np.array_equal(np.isfinite(found.values), np.isfinite(own - its))
        # the norms of the values as they are, and those of the field that was taken away from an evaluation of our own
        assert np.allclose(found.absolute, norms(found.values), rtol=1e-12)
        field = norms(np.where(off, its, g.draw.render(name, view=view)))
        assert np.allclose(found.relative, norms(found.values) / field, rtol=1e-9)
        assert found.compared == np.isfinite(found.values).sum() and found.view == view


def test_a_finer_cover_is_nearer(ds):
    """At least of first order, as r^(1/2) has it without enrichments: (1 - 1/4)/(1/2 - 1/4) from a reference of a quarter."""
    coarse, middle = (ppum.solve(plate(cells=cells)).field for cells in ((8, 16), (16, 32)))
    fine = ppum.solve(plate(cells=(32, 64))).field
    far, near = (field.compare(fine, "uy", size=(100, 200)).relative.l2 for field in (coarse, middle))
    assert 0 < 3 * near < far < 0.1


def test_plates_of_different_places(f, holed):
    found = f.compare(holed.field, "uy", center=(0.5, 0), width=3, size=(60, 60))
    assert "the plates are not the same" in found.warnings[0]
    assert found.lost > 0 and found.invented > 0 and found.compared + found.lost + found.invented < 3600
    with pytest.raises(ppum.RenderError, match="no pixel where `ux` has a value in both"):
        f.compare(holed.field, "ux", center=(-0.8, 0), width=0.2)


def test_what_cannot_be_compared_is_told(f, potential):
    with pytest.raises(ppum.QuantityError, match="no quantity `von_mises`"):
        f.compare(potential.field, "von_mises")
    for wrong, message in [
        ({"method": "linear"}, "method: 'linear' is not one of 'nearest', .*; did you mean 'bilinear'"),
        ({"over": "plate"}, "over: 'plate' is not one of 'domain', 'view'"),
        ({"error": -1.0}, "give a positive number"),
        ({"grid": 1}, "at least 2x2"),
        ({"quantity": "level"}, "constant in each cell"),
    ]:
        with pytest.raises(ValueError, match=message):
            f.compare.resample(**wrong)


def test_results_are_frozen_rows_and_pickled(f):
    found = f.compare.resample("uy", grid=(9, 17), size=(20, 40))
    with pytest.raises(AttributeError):
        found.compared = 0
    for values in (found.values, found.resampled):
        with pytest.raises(ValueError, match="read-only"):
            values[0, 0] = 1
    copy = pickle.loads(pickle.dumps(found))
    assert copy == found and np.array_equal(copy.values, found.values, equal_nan=True)
    row = found.to_dict()
    assert (row["method"], row["nx"], row["ny"], row["l2"]) == ("bilinear", 9, 17, found.absolute.l2)
    assert repr(found).startswith("<ppum.Resampling of uy, bilinear, 9x17, relative L1 ")
    assert "\n" not in repr(found) and "1800 pixels" in repr(f.compare(f, size=(30, 60)))


def interpolated(f, name, view, nx, ny):
    """Linear in x, then in y, by numpy: an interpolation of our own."""
    (x0, y0), (x1, y1) = f.dataset.domain
    xs, ys = np.linspace(x0, x1, nx), np.linspace(y0, y1, ny)
    samples = f.at(xs, ys[:, None])[name]
    x, y = (axis.ravel() for axis in centers(view))
    rows = np.array([np.interp(x, xs, row) for row in samples])
    return np.array([np.interp(y, ys, column) for column in rows.T]).T


def test_bilinear_is_that_of_numpy(f):
    view = f.view_at(size=(73, 91), center=(0.1, 0.3), width=1.3)
    found = f.compare.resample("uy", grid=(20, 31), view=view)
    expected, direct = interpolated(f, "uy", view, 20, 31), f.at(*centers(view)).uy
    off, size = off_cracks([f], view, "uy"), np.abs(expected).max()
    assert np.abs(found.resampled - expected).max() < ROUNDING * size
    assert np.abs(found.values - (expected - direct))[off].max() < ROUNDING * size
    assert np.allclose(found.absolute, norms(found.values), rtol=1e-12)
    assert found.bytes == 8 * 20 * 31 and found.grid == (20, 31) and found.direct_bytes > 0


def test_cells_have_one_value_each(potential):
    found = potential.field.compare.resample("u", method="cells", size=(64, 64))
    assert found.grid is None and found.bytes == 8 * potential.steps[0].patches == 8 * 16
    assert np.all(np.ptp(found.resampled.reshape(4, 16, 4, 16), axis=(1, 3)) == 0) and found.absolute.l2 > 0


def test_the_grid_for_an_error(f):
    at = {"center": (0.6, 1.5), "width": 0.3, "size": (50, 50)}
    l1, l2, most = f.compare.resample("uy", error=1e-3, over="view", **at).needed
    assert l1.kind == "measured" and l1.reason is None and l2.kind == most.kind == "measured"
    grid = tuple(int(n) for n in most.grid)
    assert f.compare.resample("uy", grid=grid, over="view", **at).relative.max < 2e-3
    assert f.compare.resample("uy", error=1e-3, size=(50, 100)).needed[2] == ppum.results.Needed("none", None, "jump")
    assert f.compare.resample("syy", error=1e-3, size=(50, 100)).needed[2].reason == "singular"


def test_numbers_are_those_of_the_program(ds, f, program, tmp_path):
    ds.save(tmp_path / "plate.h5")
    at = ["--view", "-0.5,-0.5,0.5,0.5", "--grid", "40x30", "--error", "1e-2", "--method", "all", "--json"]
    theirs = json.loads(program("compare", tmp_path / "plate.h5", "-q", "syy", *at))
    assert [row["method"] for row in theirs["resampled"]] == ["nearest", "bilinear", "bicubic", "cells"]
    view = ppum.View(tuple(theirs["center"]), theirs["width"], tuple(theirs["pixels"]))
    for row in theirs["resampled"]:
        ours = f.compare.resample("syy", grid=(40, 30), method=row["method"], error=1e-2, view=view)
        for name in ("absolute", "relative"):
            assert list(getattr(ours, name)) == row[name]
        for name in ("bytes", "compared", "infinite", "lost", "invented"):
            assert getattr(ours, name) == row[name]
        if row["needed"]:
            assert [one.kind for one in ours.needed] == [one["kind"] for one in row["needed"]["grids"]]
