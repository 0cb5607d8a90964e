"""What stands in datasets, and problems."""

import math
import pickle
import weakref

import h5py
import numpy as np
import ppum
import pytest
from ppum._field import KEPT
from conftest import ROOT, plate


def test_a_dataset(ds):
    assert ds.title == "Slanted crack" and ds.equation == "elasticity" and ds.program.startswith("ppum ")
    assert ds.domain == ((-1.0, -2.0), (1.0, 2.0)) and ds.holes == () and len(ds.steps) == 1
    (crack,) = ds.cracks
    assert crack.length == pytest.approx(1.0) and crack.ends == ("tip", "tip")
    assert not crack.points.flags.writeable
    k1, k2 = 0.76682, 0.68413  # see docs/validation.md
    for tip in ds.tips:
        assert tip.k1 == pytest.approx(k1, rel=1e-3) and tip.k2 == pytest.approx(k2, rel=1e-3)
        assert tip.rings.shape[1] == 4 and tip.g == pytest.approx((tip.k1**2 + tip.k2**2) * 0.91)
        assert tip.j == pytest.approx(tip.g, rel=1e-2)
    assert ds.history["unknowns"] == ds.steps[-1].unknowns and ds.history.unit("assembly") == "s"
    assert set(ds.history) == {name for name, _, _ in ds.history.records}
    assert len(ds.steps[0].attributes["order"]) == ds.steps[0].patches
    assert "order" in ds.steps[0].attributes and ds.steps[0].growth is None
    frame = ds.tips.to_pandas()
    assert frame.shape == (2, 12) and frame.k1[0] == ds.tips[0].k1
    assert ds.warnings.to_pandas().empty == (len(ds.warnings) == 0)
    for thing in (ds, ds.tips, ds.history, ds.warnings):
        assert "<table>" in thing._repr_html_()
    with pytest.raises(IndexError):
        ppum.Field(ds, 3)


def test_supports_and_holes(holed):
    assert holed.holes[0].radius == 0.23 and holed.holes[0].points is None
    assert len(holed.tips) == 2 and math.isnan(holed.tips[0].t_stress) in (True, False)
    (reaction,) = holed.steps[-1].reactions
    assert reaction.on == "left" and reaction.held == (True, True)
    # the right edge, 1.5 high, is pulled by (1, 0.3)
    assert reaction.force == pytest.approx((-1.5, -0.45), rel=1e-9)
    assert np.isnan(holed.field.at(1.7, 0.4).ux) and np.isfinite(holed.field.at(1.7 + 0.23, 0.4).ux)
    assert holed.quantities["safety"].formula == "2/von_mises"


def test_potentials(potential):
    v = potential.field.at([0.0, 1.0], 0.5)
    assert v.u == pytest.approx([0.0, 1.5], abs=1e-6) and not hasattr(v, "ux")
    assert potential.field.draw.render(size=(8, 8)).shape == (8, 8)


def test_a_series_of_growth():
    problem = plate((8, 16)).section("growth", steps=2)
    series = ppum.solve(problem)
    assert len(series.steps) == 3 and series.steps[1].growth.tips[0].fate == "grows"
    lengths = [step.cracks[0].length for step in series.steps]
    assert lengths == sorted(lengths) and lengths[2] > lengths[0]
    first, last = series.steps[0].field, series.field
    assert first.at(0.3, 0.4).uy != last.at(0.3, 0.4).uy
    assert last.part("jump").at(0.0, 0.0).uy != 0.0 and "step 2" in repr(last)


def test_a_series_in_a_file_is_that_in_memory(grown, tmp_path):
    """Its steps are read when they are asked for, whatever happens to its name."""
    path = tmp_path / "grown.h5"
    grown.save(path)
    stored = ppum.open(path)
    assert stored._core.is_stored() and not grown._core.is_stored()
    path.unlink()
    assert stored.title == grown.title and len(stored.steps) == len(grown.steps) == 3
    x, y = np.random.default_rng(3).uniform(0, 1, (2, 400))
    for ours, theirs in zip([*stored.steps, *stored.steps[::-1]], [*grown.steps, *grown.steps[::-1]], strict=True):
        assert np.array_equal(ours.field.at(x, y).uy, theirs.field.at(x, y).uy, equal_nan=True)
        assert ours.field.part("jump").at(0.3, 0.5).uy == theirs.field.part("jump").at(0.3, 0.5).uy
        assert ours.tips == theirs.tips and ours.load == theirs.load and ours.field is ours.field
        assert np.array_equal(ours.attributes["order"], theirs.attributes["order"])
    assert stored == grown and hash(stored) == hash(grown) and stored.field == grown.field
    assert pickle.loads(pickle.dumps(stored)) == grown and stored.to_bytes() == grown.to_bytes()
    assert stored.steps[0].field.draw.figure("uy").png() == grown.steps[0].field.draw.figure("uy").png()
    assert stored.field.draw.animate("uy", size=(300, 240)).apng() == grown.field.draw.animate("uy", size=(300, 240)).apng()
    assert stored.steps[1].field.export.to_html() == grown.steps[1].field.export.to_html()
    for kind in (ppum.plots.history, ppum.plots.series):
        assert kind(stored).svg() == kind(grown).svg()
    with pytest.raises(IndexError, match="there is no step 3; the dataset has 3"):
        ppum.Field(stored, 3)


def test_of_a_series_in_a_file_few_steps_are_in_memory(grown, tmp_path):
    grown.save(tmp_path / "grown.h5")
    stored = ppum.open(tmp_path / "grown.h5")
    made = [weakref.ref(ppum.Field(stored, number)) for number in range(3)]
    assert [field() for field in made] == [None] * 3
    assert stored._field.cache_info().maxsize == KEPT and grown._field.cache_info().maxsize is None


def test_damage_is_found_where_it_is(grown, tmp_path):
    """In the step that is read, as its checksum says."""
    path = tmp_path / "grown.h5"
    grown.save(path)
    data = bytearray(path.read_bytes())
    values = np.array(h5py.File(path)["steps/0001/fields/0000/coefficients"]).tobytes()
    data[data.index(values[:64]) + 5] ^= 1
    path.write_bytes(data)
    stored = ppum.open(path)
    assert stored.steps[0].field.at(0.3, 0.4).uy == grown.steps[0].field.at(0.3, 0.4).uy
    with pytest.raises(ppum.FormatError, match="checksum"):
        stored.steps[1].field


def test_problems_are_frozen_values(problem):
    more = problem.crack((0.6, 0.6), (0.8, 0.8))
    assert len(problem.to_dict()["crack"]) == 1 and len(more.to_dict()["crack"]) == 2
    spec = problem.to_dict()
    spec["crack"].append({"points": [[9, 9], [8, 8]]})
    assert len(problem.to_dict()["crack"]) == 1
    assert problem == plate() and hash(problem) == hash(plate()) and problem != more
    assert ppum.Problem.parse(problem.to_toml()) == problem
    assert problem.discretization(level=3).to_dict()["discretization"] == {"order": 2, "level": 3}
    assert ppum.Problem.from_dict(problem.to_dict()).check() == ()


def test_texts_survive_toml():
    nasty = 'quotes " and \\ and\nlines\tand \x01 é ∂ 𝛼'
    problem = ppum.Problem(domain=((0, 0), (1, 1)), material=ppum.Elastic(1, 0.3), title=nasty)
    problem = problem.section("odd name", **{"a b": {"x": [1, 2.5, True, "t"]}, "n": np.float64(1e-300)})
    again = ppum.Problem.parse(problem.to_toml())
    assert again == problem and again.to_dict()["title"] == nasty
    with pytest.raises(TypeError):
        problem.add("hole", center=object())


def test_numpy_goes_in(problem):
    a = np.array([[-0.2, 0.1], [0.3, 0.2]])
    assert problem.crack(*a) == problem.crack((-0.2, 0.1), (0.3, 0.2))
    assert problem.crack(*a.astype(np.float64)).check() == ()


@pytest.mark.parametrize("name", ["slanted-crack", "plate-with-hole", "scattered-points", "tabulated-profile"])
def test_problem_files(name):
    path = ROOT / "examples" / f"{name}.toml"
    problem = ppum.Problem.read(path)
    assert problem.check() == ()
    # what was read, written anew
    again = ppum.Problem.from_dict(problem.to_dict())
    assert ppum.Problem.parse(again.to_toml()).to_dict() == problem.to_dict()


def test_the_problem_of_a_dataset(ds, problem):
    assert ds.problem == problem
    assert ppum.solve(ds.problem) .tips[0].k1 == ds.tips[0].k1


def test_the_program_solves_the_same(problem, ds, program, tmp_path):
    (tmp_path / "plate.toml").write_text(problem.to_toml())
    program("solve", tmp_path / "plate.toml")
    other = ppum.open(tmp_path / "plate.h5")
    assert [t.k1 for t in other.tips] == [t.k1 for t in ds.tips]
    x, y = np.random.default_rng(0).uniform(-1, 1, (2, 1000))
    assert np.array_equal(other.field.at(x, y).uy, ds.field.at(x, y).uy)
