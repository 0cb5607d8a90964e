"""K, T and J found from fields, against the program, the solver and the linearity of the field."""

import json

import numpy as np
import ppum
import pytest

NAMES = ("k1", "k2", "t_stress", "j", "g")


def numbers(tip):
    return np.array([getattr(tip, name) for name in NAMES])


def test_factors_are_those_of_the_program(ds, f, program, tmp_path):
    ds.save(tmp_path / "plate.h5")
    theirs = json.loads(program("sif", tmp_path / "plate.h5", "--recompute", "--json"))["tips"]
    ours = f.intensities()
    assert len(ours) == len(theirs) == 2
    for mine, other in zip(ours, theirs, strict=True):
        assert np.allclose(numbers(mine), [other[name] for name in NAMES], rtol=1e-12)
        assert np.isnan(mine.error) and mine.end == ds.tips[ours.index(mine)].end
    assert f.intensities(-1) == ours[1] and ours[1].rings.shape == (3, 4)


def test_a_radius_changes_little(ds, f):
    """Discs around the tip give the same factors but for the error of the field."""
    for radius in (0.05, 0.1, 0.2):
        found = f.intensities(1, radius)
        assert found.rings[-1, 1] == pytest.approx(radius)
        assert np.hypot(found.k1 - ds.tips[1].k1, found.k2 - ds.tips[1].k2) < 2e-3
        assert found.j == pytest.approx(found.g, rel=1e-2)
    for wrong, message in ((5.0, "can be at most"), (-1.0, "not positive"), (float("nan"), "not positive")):
        with pytest.raises(ppum.SolveError, match=message):
            f.intensities(1, wrong)
    with pytest.raises(TypeError, match="give the tip"):
        f.intensities(radius=0.1)


def test_a_field_from_elsewhere_has_factors(ds, tmp_path):
    """Twice the coefficients, without a problem and stored factors: twice K and T, four times J."""
    h5py = pytest.importorskip("h5py")
    path = tmp_path / "plate.h5"
    ds.save(path)
    with h5py.File(path, "r+") as file:
        file["steps/0000/fields/0000/coefficients"][...] *= 2
        del file["steps/0000/intensities"]
        file.visititems(lambda _, thing: [thing.attrs.__delitem__(n) for n in list(thing.attrs) if "sha256" in n] and None)
        for name in [n for n in file.attrs if n == "problem" or "sha256" in n]:
            del file.attrs[name]
        if "problem" in file:
            del file["problem"]
    other = ppum.open(path)
    assert other.problem is None and np.isnan(other.tips[0].k1)
    for found, stored in zip(other.field.intensities(), ds.tips, strict=True):
        assert np.allclose(numbers(found), numbers(stored) * [2, 2, 2, 4, 4], rtol=1e-9)


def test_boxes_without_cells_have_factors(ds, program, tmp_path):
    """The same field without its cells has the same factors, and so it has in the program."""
    h5py = pytest.importorskip("h5py")
    path = tmp_path / "boxes.h5"
    ds.save(path)
    with h5py.File(path, "r+") as file:
        file.visititems(lambda _, thing: [thing.attrs.__delitem__(n) for n in list(thing.attrs) if "sha256" in n] and None)
        for name in [n for n in file.attrs if "sha256" in n]:
            del file.attrs[name]
        for name in ("cell", "level"):
            if name in file["steps/0000/partition"]:
                del file["steps/0000/partition"][name]
    other = ppum.open(path)
    found = other.field.intensities()
    assert np.allclose([numbers(tip) for tip in found], [numbers(tip) for tip in ds.tips], rtol=1e-7)
    theirs = json.loads(program("sif", path, "--recompute", "--json"))["tips"]
    assert np.allclose([tip["k1"] for tip in theirs], [tip.k1 for tip in found], rtol=1e-12)


def test_steps_of_a_series(grown):
    for step in grown.steps:
        for found, stored in zip(step.field.intensities(), step.tips, strict=True):
            assert np.allclose(numbers(found), numbers(stored), rtol=1e-9)


def test_a_potential_has_none(potential):
    with pytest.raises(ppum.SolveError, match="only displacements"):
        potential.field.intensities()
