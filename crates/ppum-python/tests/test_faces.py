"""Quantities of the faces of cracks, against stresses, jumps and the laws of contact; quantities of heat."""

import numpy as np
import ppum
import pytest

FACES = ("normal-traction", "shear-traction", "opening", "sliding", "closed")


def pressed(friction, **more):
    problem = ppum.Problem(((-1.5, -2), (1.5, 2)), ppum.Elastic(1.0, 0.3), title="Pressed")
    problem = problem.crack((-0.35, -0.35), (0.35, 0.35), contact=True, friction=friction)
    for edge in ("bottom", "top"):
        problem = problem.boundary(edge, pressure=1.0)
    return problem.discretization(**{"cells": (18, 24), "order": 2, **more})


@pytest.fixture(scope="module")
def rubbing():
    return pressed(0.2).solve()


def bent():
    problem = ppum.Problem(((-2, -2), (2, 2)), ppum.Elastic(1.0, 0.3))
    return problem.crack(arc=ppum.arc((0, -0.4), 0.6, 0.5, 2.2)).boundary("top", traction=(0, 1)).boundary("bottom", traction=(0, -1))


def wood():
    material = ppum.Anisotropic((10.0, 1.0), (0.3,), 0.7, axis=25, state="plane-stress")
    problem = ppum.Problem(((-2, -2), (2, 2)), material).crack((-0.5, -0.2), (0.4, 0.3))
    return problem.boundary("top", traction=(0, 1)).boundary("bottom", traction=(0, -1))


def cone():
    material = ppum.Elastic(1.0, 0.3, state="axisymmetric")
    problem = ppum.Problem(((0, -2), (2, 2)), material).crack((0.5, -0.2), (1.0, 0.3))
    return problem.boundary("top", traction=(0, 1)).boundary("bottom", traction=(0, -1))


@pytest.mark.parametrize("make", [bent, wood, cone])
def test_faces_have_the_stresses_of_the_body(make):
    """σ_n = m·σ m and τ = t·σ m of the stresses beside the face, and jumps of the displacement, along any line."""
    field = make().discretization(cells=(16, 16), order=2).solve().field
    assert field.face_quantities == FACES
    line = field.sample.crack(0, quantities=["sxx", "syy", "sxy", "normal-traction", "shear-traction", "opening", "closed"], num=41)
    inner = slice(2, -2)
    x, y = line.x.values, line.y.values
    if make is bent:
        t = np.stack([-(y + 0.4), x], -1) / 0.6
    else:
        t = np.broadcast_to(np.array([x[-1] - x[0], y[-1] - y[0]]) / np.hypot(x[-1] - x[0], y[-1] - y[0]), (41, 2))
    m = np.stack([-t[:, 1], t[:, 0]], -1)
    for side in ("above", "below"):
        sxx, syy, sxy, normal, shear = (
            line[f"{name}_{side}"].values[inner] for name in ("sxx", "syy", "sxy", "normal_traction", "shear_traction")
        )
        traction = np.stack([sxx * m[inner, 0] + sxy * m[inner, 1], sxy * m[inner, 0] + syy * m[inner, 1]], -1)
        assert np.allclose(normal, (traction * m[inner]).sum(-1), atol=1e-12)
        assert np.allclose(shear, (traction * t[inner]).sum(-1), atol=1e-12)
        # free faces, but for the error of the solution
        assert np.abs(normal[2:-2]).max() < 0.06 and np.abs(shear[2:-2]).max() < 0.06
    jump = np.stack([line.jump_ux.values, line.jump_uy.values], -1)
    assert np.allclose(line.opening.values, (jump * m).sum(-1), atol=1e-14) and (line.opening.values[inner] > 0).all()
    assert (line.closed.values[inner] == 0).all()
    # the same at points
    at = field.at(x[20], y[20], side="both")
    assert np.allclose(at.normal_traction, [line.normal_traction_above[20], line.normal_traction_below[20]], atol=1e-12)
    assert np.allclose(at.opening, line.opening[20]) and np.isnan(field.at(1.5, 1.5).normal_traction)


def test_pressed_faces_obey_coulomb(rubbing):
    field = rubbing.field
    line = field.sample.crack(0, quantities=list(FACES), num=61)
    closed, inner = line.closed.values, slice(3, -3)
    assert (closed[inner] == 1).all() and {"opening", "sliding"} <= set(line)
    for side in ("above", "below"):
        normal, shear = line[f"normal_traction_{side}"].values[inner], line[f"shear_traction_{side}"].values[inner]
        assert (normal < 0).all()
        # it slides everywhere, against the friction; the error of the solution is some percent of the load
        assert np.abs(np.abs(shear) - 0.2 * np.abs(normal)).max() < 0.05
    # sliding down the slope under σ = -1: σ_n = τ_∞ = -1/2 of a crack at 45° that does not disturb the normal stress
    assert np.median(line.normal_traction_above.values[inner]) == pytest.approx(-0.5, abs=0.05)
    assert np.abs(line.opening.values[inner]).max() < 1e-3 * np.abs(line.sliding.values).max()


def test_faces_that_stick():
    """Friction larger than the slope holds them: the body is as without the crack."""
    line = pressed(1.5, cells=(12, 16)).solve().field.sample.crack(0, quantities=list(FACES), num=21)
    for side in ("above", "below"):
        assert np.allclose(line[f"normal_traction_{side}"][1:-1], -0.5, atol=1e-6)
        assert np.allclose(np.abs(line[f"shear_traction_{side}"][1:-1]), 0.5, atol=1e-6)
    assert np.abs(line.sliding).max() < 1e-6 and (line.closed.values[1:-1] == 1).all()


def test_loaded_faces_are_open():
    problem = ppum.Problem(((-2, -2), (2, 2)), ppum.Elastic(1.0, 0.3)).crack((-0.4, 0), (0.4, 0))
    for face in ("above", "below"):
        problem = problem.boundary({"crack": 0, "face": face}, pressure=1.0)
    line = problem.discretization(cells=(16, 16), order=2).solve().field.sample.crack(0, quantities=list(FACES), num=41)
    assert np.allclose(line.normal_traction_above[4:-4], -1, atol=0.05) and (line.closed.values[1:-1] == 0).all()


def test_faces_in_plots_and_images(rubbing):
    plot = ppum.plots.crack(rubbing.field, 0, quantities=["normal-traction", "opening"])
    assert [label for label, _ in plot.curves] == ["normal-traction_above", "normal-traction_below", "opening"]
    with pytest.raises(ppum.QuantityError, match="`closed` has values on the faces of cracks only: sample or plot it along"):
        rubbing.field.draw.render("closed")
    with pytest.raises(ppum.QuantityError, match="did you mean `normal-traction`"):
        rubbing.field.at(0, 0)["cpress"]
    assert "closed" not in rubbing.quantities


def test_heat_has_its_names(potential):
    field = potential.field
    at = field.at([0.3, 0.6], 0.4)
    assert {"temperature", "qx", "qy", "flux"} <= set(field.quantities)
    assert np.array_equal(at.temperature, at.u) and np.allclose(at.qx, -2 * at.du_dx) and np.allclose(at.qy, -2 * at.du_dy)
    assert np.allclose(at.flux, np.hypot(at.qx, at.qy)) and field.quantities["qx"].symbol == "q_{x}"
    assert np.isfinite(field.draw.render("temperature - u", size=(4, 4))).all() and np.isfinite(field.draw.render("flux", size=(4, 4))).all()
    with pytest.raises(ppum.QuantityError, match="did you mean `flux`"):
        at["heat_flux"]


def test_own_names_of_heat_come_first():
    problem = ppum.Problem(((0, 0), (1, 1)), ppum.Poisson(2.0)).boundary("left", value=0).boundary("right", value=1)
    problem = problem.quantity("flux", "7*u").discretization(level=1)
    assert problem.solve().field.at(0.5, 0.5).flux == pytest.approx(3.5)


@pytest.mark.parametrize("young", ["if(y > 0, 10, 1)", "if(y < 0, 1, 10)", "if(y > 0, 1, 10)"])
def test_faces_on_an_interface_have_their_own_materials(young):
    """A crack between two materials, under pressure on its faces: σ_n = −1 on both."""
    problem = ppum.Problem(((-1, -1), (1, 1)), ppum.Elastic(young, 0.3)).crack((-0.3, 0), (0.3, 0))
    field = problem.boundary({"crack": 0}, pressure=1.0).discretization(level=4, order=3).solve().field
    x = np.linspace(-0.2, 0.2, 9)
    for side in ("above", "below"):
        assert np.allclose(field.at(x, 0.0 * x, side=side).normal_traction, -1, atol=1e-2)


def test_junctions_have_no_face_of_their_own():
    """Where a crack ends on another one, faces of both meet: no traction, and nobody says that it is closed."""
    problem = ppum.Problem(((-1, -1), (1, 1)), ppum.Elastic(1.0, 0.3)).crack((-0.5, 0), (0.5, 0)).crack((0.1, 0), (0.1, 0.5))
    problem = problem.boundary("top", traction=(0, 1)).boundary("bottom", traction=(0, -1))
    field = problem.discretization(level=4).solve().field
    found = field.at([0.1, 0.1], [0.0, 0.2])
    for values in (found.normal_traction, found.closed):
        assert np.isnan(values[0]) and np.isfinite(values[1])


def test_meshes_have_no_values_of_faces(rubbing):
    with pytest.raises(ValueError, match="faces of cracks only"):
        rubbing.field.export.triangles(["opening"])


def test_curves_of_a_dataset_are_those_of_its_last_field(rubbing):
    (_, one), *_ = ppum.plots.crack(rubbing).curves
    (_, other), *_ = ppum.plots.crack(rubbing.field).curves
    assert np.array_equal(one, other, equal_nan=True)
