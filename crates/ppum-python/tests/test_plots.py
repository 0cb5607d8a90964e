"""The program's plots: their points against the fields, their bytes against the program's files."""

import io
import re

import numpy as np
import ppum
import pytest
from conftest import plate


def test_points_are_values(ds, f):
    ((label, points),) = ppum.plots.line(f, (-0.9, 1.3), (0.9, 1.5), ["uy"]).curves
    along = np.linspace(0, np.hypot(1.8, 0.2), 201)
    assert label == "uy" and np.allclose(points[:, 0], along, rtol=1e-14)
    expected = f.at(-0.9 + 1.8 * along / along[-1], 1.3 + 0.2 * along / along[-1]).uy
    assert np.allclose(points[:, 1], expected, rtol=1e-11)
    first, last = (np.array(ds.cracks[0].points[k]) for k in (0, -1))
    along = (last - first) / np.linalg.norm(last - first)
    across = np.array([-along[1], along[0]])
    curves = ppum.plots.crack(f, ds.cracks[0]).curves
    for (label, points), name, way in zip(curves, ("opening", "sliding"), (across, along), strict=True):
        places = first + points[:, :1] * along
        above, below = (f.at(*places.T, side=side) for side in ("above", "below"))
        jump = np.column_stack([above.ux - below.ux, above.uy - below.uy]) @ way
        assert label == name and np.allclose(points[:, 1], jump, rtol=1e-9, atol=1e-12)
        # they crowd at the tips
        steps = np.diff(points[:, 0])
        assert steps[0] < 0.1 * steps.max() and steps[-1] < 0.1 * steps.max()
    angles = ppum.plots.around(f, 1, 0.01, ["sxx", "syy"], num=73).curves
    assert [label for label, _ in angles] == ["sxx", "syy"]
    assert np.allclose(angles[1][1][:, 1], f.sample.around(1, 0.01, num=73, quantities=["syy"]).syy, rtol=1e-11)
    # stresses fall with the root of the distance, as the legend tells
    ((label, points),) = ppum.plots.ray(f, 1, quantities=["syy"]).curves
    assert float(re.search(r"[−-]0\.\d+", label)[0].replace("−", "-")) == pytest.approx(-0.5, abs=2e-3), label
    assert np.allclose(points[:, 1], f.sample.ray(1, quantities=["syy"]).syy, rtol=1e-11)


def test_curves_break_at_cracks(f):
    ((_, points),) = ppum.plots.line(f, (0, -0.5), (0, 0.5), ["uy"]).curves
    assert np.isnan(points).any(axis=1).sum() == 1
    above, below = f.at(0.0, 0.0, side="both").uy
    assert any(np.isclose(points[:, 1], above)) and any(np.isclose(points[:, 1], below))


def test_series_are_those_of_the_steps(grown):
    assert len(grown.steps) == 3
    ((label, points),) = ppum.plots.series(grown, ["k1"], over="length").curves
    assert label == "K_I" and points[:, 1].tolist() == [step.tips[0].k1 for step in grown.steps]
    assert np.allclose(points[:, 0], [0.5, 0.55, 0.6], atol=1e-12)
    seconds = dict(ppum.plots.history({"one": grown}).curves)["one"]
    assert seconds[:, 1].sum() > 0


def test_convergence_has_the_unknowns(ds):
    coarse, middle = (ppum.solve(plate(cells=cells)) for cells in ((4, 8), (8, 16)))
    curves = ppum.plots.convergence([middle, ds, coarse]).curves
    energy = [one.steps[0].history["energy"] for one in (coarse, middle, ds)]
    assert curves[0][0].startswith("energy")
    assert curves[0][1][:, 0].tolist() == [one.steps[0].unknowns for one in (coarse, middle)]
    assert np.allclose(curves[0][1][:, 1], np.abs(np.array(energy[:2]) / energy[2] - 1), rtol=1e-12)


def test_files_are_those_of_the_program(ds, f, grown, program, tmp_path):
    """To the last byte: names of files and of curves stand in them."""
    coarse = ppum.solve(plate(cells=(8, 16)))
    middle = ppum.solve(plate(cells=(10, 20)))
    for name, one in {"plate": ds, "coarse": coarse, "middle": middle, "grown": grown}.items():
        one.save(tmp_path / f"{name}.h5")
    fields = {"coarse": coarse.field, "plate": f}
    plots = ppum.plots
    cases = {
        "plate --line -1,0.1,1,0.1 -q syy,sxx": plots.line({"plate": f}, (-1, 0.1), (1, 0.1), ["syy", "sxx"]),
        "plate --line -1,0.1,1,0.1": plots.line({"plate": f}, (-1, 0.1), (1, 0.1)),
        "coarse plate --circle 0,0,0.7 -q uy --count 91": plots.circle(fields, (0, 0), 0.7, ["uy"], num=91),
        "plate --crack 0 --size 500x300": plots.crack({"plate": f}, 0, size=(500, 300)),
        "coarse plate --tip 1 --angle 0 -q syy": plots.ray(fields, 1, 0.0, quantities=["syy"]),
        "plate --tip 1 --radius 1e-6 -q sxx": plots.around({"plate": f}, 1, 1e-6, ["sxx"]),
        "plate --line 0,0.1,1,1 -q von-mises --log y": plots.line({"plate": f}, (0, 0.1), (1, 1), ["von_mises"], log="y"),
        "plate --history": plots.history({"plate": ds}),
        "grown --series --over extension": plots.series({"grown": grown}, over="extension"),
        "grown --series -q k1,length": plots.series({"grown": grown}, ["k1", "length"]),
        "coarse middle plate --convergence": plots.convergence({"coarse": coarse, "middle": middle, "plate": ds}),
    }
    for options, plot in cases.items():
        files = [word for word in options.split() if (tmp_path / f"{word}.h5").exists()]
        rest = options.split()[len(files) :]
        for form in ("png", "svg", "pdf"):
            program("plot", *(tmp_path / f"{name}.h5" for name in files), *rest, "-o", tmp_path / f"theirs.{form}")
            plot.save(tmp_path / f"ours.{form}")
            ours, theirs = ((tmp_path / f"{name}.{form}").read_bytes() for name in ("ours", "theirs"))
            assert ours == theirs, (options, form)


def test_plots_are_shown_and_saved_whole(f, tmp_path):
    plot = ppum.plots.line(f, (-1, 0.1), (1, 0.1), ["syy"], size=(400, 300))
    assert plot._repr_png_() == plot.png() and plot.svg().startswith("<") and plot.pdf()[:5] == b"%PDF-"
    assert repr(plot) == "<ppum.plots.Plot of syy, 400x300>"
    matplotlib_image = pytest.importorskip("matplotlib.image")
    assert matplotlib_image.imread(io.BytesIO(plot.png())).shape[:2] == (300, 400)
    (tmp_path / "old.svg").write_text("old")
    plot.save(tmp_path / "old.svg")
    assert (tmp_path / "old.svg").read_text() == plot.svg()
    with pytest.raises(ValueError, match="forms of Plot are png, svg, pdf"):
        plot.save(tmp_path / "plot.gif")
    with pytest.raises(FileNotFoundError):
        plot.save(tmp_path / "nowhere/plot.svg")
    assert [path.name for path in tmp_path.iterdir()] == ["old.svg"]


def test_plots_that_cannot_be_are_refused(ds, f, potential):
    plots = ppum.plots
    for wrong, error, message in [
        (lambda: plots.line(f, (50, 50), (60, 60)), ppum.RenderError, "would show nothing"),
        (lambda: plots.line(f, (0, 0), (0, 0)), ppum.QuantityError, "its two points are equal"),
        (lambda: plots.line(f, (0, 0), (1, 1), ["nonsense"]), ppum.QuantityError, "nonsense"),
        (lambda: plots.line(f, (0, 0), (1, 1), "uy"), TypeError, "a list of names"),
        (lambda: plots.line(f, (0, 0), (1, 1), log="z"), ValueError, "log: 'z' is not one of"),
        (lambda: plots.line(f, (0, 0), (1, 1), size=(100, 100)).png(), ppum.RenderError, "give at least 240x180"),
        (lambda: plots.crack(f, 7), IndexError, "numbered from 0"),
        (lambda: plots.series(ds), ppum.RenderError, "there is one alone"),
        (lambda: plots.series(ds, ["k3"]), ppum.RenderError, "k1, k2, load, length and extension, not of `k3`"),
        (lambda: plots.history(ds, "minutes"), ValueError, "what: .minutes. is not one of .seconds."),
        (lambda: plots.history(ds, step=4), IndexError, "no step 4"),
        (lambda: plots.convergence([ds]), ppum.RenderError, "three datasets or more"),
        (lambda: plots.convergence([ds, ds, ds]), ppum.RenderError, "three different numbers"),
        (lambda: plots.convergence([ds, ds, potential]), ppum.RenderError, "dataset 0 and dataset 2 are of two: the equation"),
    ]:
        with pytest.raises(error, match=message):
            wrong()


def test_what_a_plot_leaves_out_is_a_warning(f):
    with pytest.warns(UserWarning, match="is not positive at"):
        ppum.plots.line(f, (-1, 0.1), (1, 0.1), ["uy"], log="y")
