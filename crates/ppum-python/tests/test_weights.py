"""Weight functions: K of loads by integrals against solutions, and what can be asked of them."""

import time

import numpy as np
import pytest

import ppum


@pytest.fixture(scope="module")
def body():
    material = ppum.Elastic(young=2.0, poisson=0.3, state="plane-stress", expansion=0.5)
    body = ppum.Problem(((0, -1), (1, 1)), material).crack((0, 0.1), (0.45, 0.1))
    return body.boundary("bottom", displacement=(0, 0)).discretization(cells=(8, 16), order=3)


@pytest.fixture(scope="module")
def solution(body):
    return body.boundary("top", traction=(0.2, 1)).solve()


@pytest.fixture(scope="module")
def weight(solution):
    return solution.weight(tip=0)


def close(found, dataset, bound=None):
    tip = dataset.tips[0]
    bound = 0.2 * tip.error if bound is None else bound * np.hypot(tip.k1, tip.k2)
    assert np.hypot(found.k1 - tip.k1, found.k2 - tip.k2) < bound, (found, tip)


def test_loads(body, solution, weight):
    close(weight.k(solution.problem), solution)
    close(weight.k(edges={"top": (0.2, 1)}), solution)
    pressed = body.boundary({"crack": 0}, pressure="1 + x").solve()
    close(weight.k(faces="1 + x"), pressed)
    close(weight.k(faces=lambda s: 1 + s), pressed)
    close(weight.k(temperature="y*exp(x)"), body.section("temperature", value="y*exp(x)").solve())
    close(weight.k(body_force=("x", 1)), body.section("body_force", value=("x", 1)).solve())
    close(weight.k(strain=("x*y", 0, 0, 0)), body.section("strain", xx="x*y").solve())
    forced = body.force((1, 0.4), (0.5, 0.7)).solve()
    # a value of w at one point, whose error is larger than that of its integrals
    close(weight.k(point=((1, 0.4), (0.5, 0.7))), forced, 5e-4)


def test_load_cases_are_products(weight):
    faces = weight.influence({"crack": 0})
    assert np.allclose(weight.k(faces=1.0), faces.pressures().sum(axis=1), rtol=1e-9)
    assert np.allclose(faces.k(-faces.normals), weight.k(faces=1.0), rtol=1e-9)
    cases = np.random.default_rng(1).normal(size=(2000, len(faces.xy)))
    start = time.perf_counter()
    found = cases @ faces.pressures().T
    print(f"{len(cases) / (time.perf_counter() - start):.3g} load cases a second of {len(faces.xy)} points")
    assert found.shape == (2000, 2)
    inside = weight.influence()
    hot = inside.strains @ np.array([1.0, 1.0, 0.0])
    assert np.allclose(0.5 * hot.sum(axis=1), weight.k(temperature=1.0), atol=1e-6)


def test_polynomials_rates_and_fields(weight, solution):
    a = 0.45
    g = weight.polynomials(2)
    assert g.shape == (2, 2)
    assert np.isclose(np.sqrt(np.pi * a) * g[0, 0], weight.k(faces=1.0).k1, rtol=1e-6)
    assert weight.modes == ("I", "II")
    values = weight.dataset.steps[0].field.at(0.3, [0.5, -0.5])
    assert np.isfinite(values.uy).all() and np.isfinite(values.sxx).all()
    assert np.isfinite(weight.rates().field.at(0.5, 0.5).uy)


def test_derivative(body, weight):
    def make(load):
        return body.boundary("top", traction=(0.2, f"{load}*x"))

    found = weight.derivative(make, 1.0)
    assert np.allclose(found, weight.k(edges={"top": (0, "x")}), rtol=1e-6)


def test_refusals(solution, weight):
    with pytest.raises(IndexError, match="no tip 1"):
        solution.weight(tip=1)
    with pytest.raises(ppum.SolveError, match="material is not"):
        weight.k({**solution.problem.to_dict(), "material": {"young": 3.0, "poisson": 0.3, "state": "plane-stress"}})
    with pytest.raises(ppum.ProblemError):
        weight.k(edges={"bottom": (0, 1)})
    with pytest.raises(ppum.ProblemError):
        weight.k(point=((0.45, 0.1), (0, 1)))
