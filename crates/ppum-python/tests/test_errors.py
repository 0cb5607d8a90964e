"""Exceptions: what people catch, with remedies, and all of them can be pickled."""

import io
import pathlib
import pickle
import sys

import numpy as np
import ppum
import pytest
from ppum import _core


def caught(work):
    with pytest.raises(Exception) as info:
        work()
    error = info.value
    again = pickle.loads(pickle.dumps(error))
    assert type(again) is type(error) and str(again) == str(error)
    return error


def test_files(tmp_path, ds):
    missing = caught(lambda: ppum.open(tmp_path / "none.h5"))
    assert isinstance(missing, FileNotFoundError) and missing.filename.endswith("none.h5")
    assert isinstance(caught(lambda: ppum.open(tmp_path)), OSError)
    assert isinstance(caught(lambda: ds.save(tmp_path / "no" / "a.h5")), FileNotFoundError)
    (tmp_path / "bad.h5").write_bytes(b"no dataset")
    for source in (tmp_path / "bad.h5", str(tmp_path / "bad.h5"), b"no dataset", io.BytesIO(b"")):
        bad = caught(lambda: ppum.open(source))
        assert type(bad) is ppum.FormatError and isinstance(bad, (ppum.PpumError, ValueError))
    cut = ds.to_bytes()
    for length in np.linspace(0, len(cut) - 1, 20).astype(int):
        assert type(caught(lambda: ppum.open(cut[:length]))) is ppum.FormatError
    assert isinstance(caught(lambda: ppum.open(5)), TypeError)


def test_quantities(f):
    error = caught(lambda: f.evaluate(0, 0, ["von-misse"]))
    assert isinstance(error, ppum.QuantityError) and "did you mean" in str(error)
    for wrong in ("1 +", "", "sin(", "phi:99999", "error", "nothing", "ux;uy"):
        assert isinstance(caught(lambda: f.at(0, 0)[wrong]), ppum.QuantityError), wrong
        assert isinstance(caught(lambda: f.draw.render(wrong or " ")), ppum.QuantityError), wrong


def test_problems_name_keys(problem):
    wrong = problem.crack((0, 0)).boundary("nowhere", traction=(0, 1)).section("discretization", ordr=3)
    error = caught(lambda: ppum.solve(wrong))
    assert type(error) is ppum.ProblemError and isinstance(error, ValueError)
    assert error.diagnostics == list(wrong.check())
    places = [finding.place for finding in error.diagnostics]
    assert places and all(p.split(".")[0].split("[")[0] in ("crack", "boundary", "discretization") for p in places)
    assert all(finding.line is None and finding.message for finding in error.diagnostics)
    again = pickle.loads(pickle.dumps(error))
    assert again.diagnostics == error.diagnostics


def test_files_of_problems_name_lines(tmp_path, problem):
    path = tmp_path / "plate.toml"
    path.write_text(problem.to_toml().replace("young", "yong"))
    findings = ppum.Problem.read(path).check()
    assert findings[0].place == str(path) and findings[0].line and "young" in str(findings[0])
    error = caught(lambda: ppum.solve(path))
    assert error.diagnostics[0] == findings[0]
    path.write_text("title = ")
    error = caught(lambda: ppum.Problem.read(path))
    assert type(error) is ppum.ProblemError and error.diagnostics[0].line == 1
    assert isinstance(caught(lambda: ppum.solve(tmp_path / "none.toml")), FileNotFoundError)


def test_solutions(problem):
    loose = problem.section("boundary") if False else problem.boundary("left", traction=(1, 0))
    error = caught(lambda: ppum.solve(loose))
    assert type(error) is ppum.SolveError and isinstance(error, RuntimeError) and "force" in str(error)
    error = caught(lambda: ppum.solve(problem, memory=1000))
    assert type(error) is ppum.SolveError and "memory" in str(error)
    with pytest.raises(ValueError):
        ppum.solve(problem, threads=0)


def test_pictures(f):
    for wrong in ({"center": (0, 0), "width": -1.0}, {"center": (0.3, 0), "width": 1e-17}, {"size": (0, 5)}):
        assert isinstance(caught(lambda: f.draw.render("ux", **wrong)), ppum.RenderError)
    for options, kind in [
        ({"cmap": "nothing"}, ppum.RenderError),
        ({"norm": "log", "clim": (-1, 1)}, ppum.RenderError),
        ({"clim": (2, 1)}, ValueError),
        ({"norm": "cubic"}, ValueError),
        ({"theme": "pink"}, ValueError),
        ({"colorbar": "left"}, ValueError),
        ({"overlays": ["clouds"]}, ValueError),
        ({"nonsense": 1}, TypeError),
        ({"width": 1.0, "zoom": 2.0}, ValueError),
    ]:
        assert isinstance(caught(lambda: f.draw.figure("ux", **options).png()), kind), options
    assert isinstance(caught(lambda: f.draw.figure("ux").to_bytes("gif")), ValueError)
    assert isinstance(caught(lambda: f.sample.extrema("ux", center=(50, 50), width=1.0)), ppum.RenderError)
    with pytest.raises(IndexError):
        f.draw.figure("ux", tip=9)


@pytest.mark.parametrize("on_pool", [False, True])
def test_panics_are_exceptions(on_pool):
    error = caught(lambda: _core._panic(on_pool))
    assert type(error) is ppum.InternalError and isinstance(error, Exception) and "on purpose" in str(error)


def test_all_classes_are_of_the_package():
    for name in ppum.__all__:
        thing = getattr(ppum, name)
        if isinstance(thing, type):
            assert thing.__module__ == "ppum" and pickle.loads(pickle.dumps(thing)) is thing
        assert thing.__doc__ or name == "COLORMAPS", name


def test_the_version_is_that_of_the_crates():
    cargo = (pathlib.Path(__file__).parents[3] / "Cargo.toml").read_text()
    assert f'version = "{ppum.__version__}"' in cargo


@pytest.mark.parametrize(
    "package, remedy, use",
    [
        ("xarray", "xarray", lambda f: f.sample.line((0, 0), (1, 1))),
        ("xarray", "xarray", lambda f: f.sample.grid(3, 3)),
        ("xarray", "xarray", lambda f: ppum.sweep(lambda a: 1 / 0, a=[1]).run()),
        ("matplotlib", "matplotlib xarray", lambda f: f.draw.plot()),
        ("pandas", "pandas", lambda f: f.step.tips.to_pandas()),
        ("anywidget", "anywidget", lambda f: f.view()),
    ],
)
def test_packages_that_are_missing_have_a_remedy(f, monkeypatch, package, remedy, use):
    """Before any work: a sweep would be lost."""
    monkeypatch.setitem(sys.modules, package, None)
    error = caught(lambda: use(f))
    assert type(error) is ImportError and str(error).endswith(f"need {package}: pip install {remedy}")


def test_warnings_are_of_the_line_that_calls(f):
    """However deep in the package they arise."""
    twice = {"center": [(0.5, 0.5)] * 2, "half": [(0.7, 0.7)] * 2}
    calls = [
        lambda: ppum.build.Cover([(0, 0), (1, 1)], **twice),
        lambda: f.draw.figure("ux", layout=(2, 2), size=(700, 900)).png(),
        lambda: f.export.triangles(["uy"], tolerance=1e-9, max_cells=20_000),
        lambda: ppum.basis.legendre(4, interval=(1, 1.001)).convert(np.ones((1, 15))),
    ]
    for call in calls:
        with pytest.warns(UserWarning) as told:
            call()
        line = __file__, call.__code__.co_firstlineno
        assert [(one.filename, one.lineno) for one in told] == [line] * len(told), str(told[0].message)
