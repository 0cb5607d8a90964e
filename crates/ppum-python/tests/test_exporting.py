"""Triangles and pages for other programs."""

import base64
import json
import re

import numpy as np
import ppum
import pytest


def places(mesh, random, number):
    """Random triangles, and weights of their corners at random points in them."""
    cells = mesh.cells[random.integers(len(mesh.cells), size=number)]
    weights = random.dirichlet([1, 1, 1], number)
    return cells, weights, np.einsum("nk,nkd->nd", weights, mesh.points[cells])


@pytest.mark.parametrize("tolerance", [1e-2, 1e-3])
def test_triangles_resolve_a_field_to_a_tolerance(holed, tolerance):
    mesh = holed.field.export.triangles(["displacement", "ux", "von_mises"], tolerance=tolerance)
    cells, weights, points = places(mesh, np.random.default_rng(7), 4000)
    found = holed.field.at(*points.T)
    inside = np.isfinite(found.ux) & (
        np.linalg.norm(points[:, None] - mesh.singular, axis=2) > mesh.tip_radii
    ).all(axis=1)
    assert inside.mean() > 0.9
    for name in ("ux", "von_mises"):
        told = mesh.accuracy[name]
        off = np.abs(np.einsum("nk,nk->n", weights, mesh.values[name][cells]) - getattr(found, name))
        assert np.mean(off[inside] <= told.allowed) > 0.999
        assert told.allowed == pytest.approx(tolerance * told.range) and told.share > 0.999
    assert np.array_equal(mesh.values["displacement"][:, 0], mesh.values["ux"])
    assert not mesh.values["displacement"][:, 2].any()
    assert mesh.accuracy["von_mises"].is_singular and not mesh.accuracy["ux"].is_singular


def test_cells_cover_the_plate_and_cracks_are_open(f):
    mesh = f.export.triangles(tolerance=0.01)
    a, b, c = (mesh.points[mesh.cells[:, k]] for k in range(3))
    areas = 0.5 * ((b - a)[:, 0] * (c - a)[:, 1] - (b - a)[:, 1] * (c - a)[:, 0])
    assert (areas > 0).all() and areas.sum() == pytest.approx(8, rel=1e-12)
    on = np.isclose(mesh.points[:, 0], mesh.points[:, 1], atol=1e-12) & (np.abs(mesh.points[:, 0]) < 0.3)
    uy = mesh.values["displacement"][:, 1]
    both = f.at(*mesh.points[on].T, side="both").uy
    assert np.min(np.abs(uy[on][:, None] - both), axis=1).max() < 1e-9
    assert np.ptp(uy[on]) > 0.1 * np.ptp(uy)
    assert set(mesh.accuracy) == {"displacement", "stress", "von-mises"}
    assert mesh.values["stress"].shape == (len(mesh.points), 6)


def test_files_are_those_of_the_program(ds, program, tmp_path):
    ds.save(tmp_path / "plate.h5")
    mesh = ds.field.export.triangles(["uy", "displacement"], tolerance=0.01, order=2)
    mesh.save(tmp_path / "ours.vtu")
    mesh.save(tmp_path / "ours.vtkhdf")
    asked = ["-q", "uy,displacement", "--tolerance", "0.01", "--order", "2"]
    program("export", tmp_path / "plate.h5", "-o", tmp_path / "its.vtu", *asked)
    program("export", tmp_path / "plate.h5", "-o", tmp_path / "its.vtkhdf", *asked)
    for form in ("vtu", "vtkhdf"):
        ds.save(tmp_path / f"whole.{form}", ["uy", "displacement"], tolerance=0.01, order=2)
        its = (tmp_path / f"its.{form}").read_bytes()
        assert (tmp_path / f"ours.{form}").read_bytes() == its
        assert (tmp_path / f"whole.{form}").read_bytes() == its


def test_all_steps_are_saved(grown, program, tmp_path):
    assert len(grown.steps) > 2
    grown.save(tmp_path / "grown.h5")
    grown.save(tmp_path / "ours.vtkhdf", ["uy"], tolerance=0.02)
    program("export", tmp_path / "grown.h5", "-o", tmp_path / "its.vtkhdf", "-q", "uy", "--tolerance", "0.02")
    assert (tmp_path / "ours.vtkhdf").read_bytes() == (tmp_path / "its.vtkhdf").read_bytes()
    for name, options, error, words in [
        ("grown.vtu", {}, ValueError, r"one step, this dataset has \d+; end its name in .vtkhdf"),
        ("none/grown.vtkhdf", {}, FileNotFoundError, "none"),
        ("grown.vtkhdf", {"tolerance": -1}, ValueError, "tolerance: -1"),
        ("grown.vtkhdf", {"toleranze": 1}, TypeError, "did you mean `tolerance`"),
        ("grown.h5", {"tolerance": 0.1}, TypeError, "tolerance: for names that end in .vtkhdf or .vtu"),
        ("grown.h5", {"quantities": ["uy"]}, TypeError, "quantities: for names"),
    ]:
        with pytest.raises(error, match=words):
            grown.save(tmp_path / name, **options)
    assert not (tmp_path / "grown.vtkhdf").exists()


def test_averages_share_points(f):
    torn, mesh = (f.export.triangles(tolerance=0.05, average=average) for average in (False, True))
    assert len(mesh.cells) == len(torn.cells) and 2 * len(mesh.points) < len(torn.points)
    assert mesh.tip_radii.shape == (len(mesh.singular),) and mesh.accuracy["stress"].largest >= torn.accuracy["stress"].largest


def test_what_triangles_cannot_be_is_said(f):
    with pytest.warns(UserWarning, match="not kept: uy differs by up to .* is allowed; raise max_cells"):
        mesh = f.export.triangles(["uy"], tolerance=1e-6, max_cells=6000)
    assert not mesh.is_complete and len(mesh.cells) <= 6000
    for options, error, words in [
        ({"order": 5}, ValueError, "order: 5 is not one of 1, 2, 3 and 4"),
        ({"tolerance": 0}, ValueError, "tolerance: 0 is not a positive number"),
        ({"tip_radius": float("nan")}, ValueError, "tip_radius: nan"),
        ({"max_cells": 10}, ppum.RenderError, "along borders alone"),
        ({"quantities": "uy"}, TypeError, "give a list"),
        ({"quantities": []}, ValueError, "give one at least"),
        ({"tip_radius": 5.0}, ppum.RenderError, "leaves nothing to resolve"),
        ({"quantities": ["uz"]}, ppum.QuantityError, "uz"),
    ]:
        with pytest.raises(error, match=words):
            f.export.triangles(**options)
    with pytest.raises(ValueError, match="cannot draw 'stl': the forms of TriangleMesh are vtu, vtkhdf$"):
        mesh.save("plate.stl")
    makers = {"pvd": "export.triangles", "png": "draw.figure", "gif": "draw.animate", "csv": "sample.line", "html": "export.to_html"}
    for end, maker in makers.items():
        with pytest.raises(ValueError, match=rf"end its name in \.h5; .*field\.{maker}"):
            f.dataset.save(f"plate.{end}")


@pytest.mark.parametrize("order", [1, 2, 4])
def test_pyvista_has_the_same_numbers(f, order):
    pytest.importorskip("pyvista")
    mesh = f.export.triangles(tolerance=0.02, order=order)
    grid = f.export.to_pyvista(tolerance=0.02, order=order)
    assert mesh.cells.shape[1] == (order + 1) * (order + 2) // 2
    assert (grid.n_points, grid.n_cells) == (len(mesh.points), len(mesh.cells))
    assert np.array_equal(grid.cell_connectivity.reshape(mesh.cells.shape), mesh.cells)
    assert set(grid.celltypes) == {5 if order == 1 else 69}
    assert np.array_equal(grid.points[:, :2], mesh.points.astype(grid.points.dtype))
    for name, rows in mesh.values.items():
        assert np.array_equal(grid.point_data[name], rows)


def embedded(page, name):
    return re.search(f'id="{name}"[^>]*>([^<]*)<', page)[1]


def test_pages_hold_the_dataset(f, tmp_path):
    assert f.export.to_html(tmp_path / "plate.html", "uy", cmap="magma_r", tip=1, zoom=50) is None
    page = (tmp_path / "plate.html").read_text(encoding="utf-8")
    assert base64.b64decode(embedded(page, "dataset")) == f.dataset.to_bytes()
    start = json.loads(embedded(page, "start"))
    assert start["scene"]["quantity"] == "uy" and start["scene"]["colors"]["colormap"] == "magma_r"
    assert start["view"]["center"] == pytest.approx(f.dataset.tips[1].xy)
    assert start["file"] == "plate.h5" and "Slanted crack" in page
    part = f.part("jump").export.to_html()
    changed = ppum.open(base64.b64decode(embedded(part, "dataset")))
    assert changed.field.at(0.6, 0.4).uy == f.part("jump").at(0.6, 0.4).uy
    assert json.loads(embedded(part, "start"))["view"] is None


def test_what_pages_do_not_have_is_said(f, tmp_path):
    with pytest.raises(ppum.RenderError, match="supports and loads"):
        f.export.to_html(overlays="supports")
    start = json.loads(embedded(f.export.to_html(deformed=2), "start"))
    assert start["scene"]["deformed"] == "2.0" and start["view"]["width"] > 0
    with pytest.raises(TypeError, match="samples"):
        f.export.to_html(samples=2)
    with pytest.raises(FileNotFoundError):
        f.export.to_html(tmp_path / "none" / "plate.html")
