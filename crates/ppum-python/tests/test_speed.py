"""What the package promises about time, where it is asked for: PPUM_SPEED=1, a release build, a quiet machine of two cores."""

import os
import time

import numpy as np
import ppum
import pytest

pytestmark = pytest.mark.skipif("PPUM_SPEED" not in os.environ, reason="PPUM_SPEED is not set")


def least(work, times=7):
    """The least time of several, in seconds."""
    found = []
    for _ in range(times):
        start = time.perf_counter()
        work()
        found.append(time.perf_counter() - start)
    return min(found)


@pytest.fixture(scope="module")
def demo():
    """The plate of the demo: 4,096 patches of order 2 and some at the tips."""
    return ppum.solve(
        ppum.Problem(domain=((-1, -1), (1, 1)), material=ppum.Elastic(1.0, 0.3))
        .crack((-0.5, 0), (0.5, 0))
        .boundary("bottom", traction=(0, -1))
        .boundary("top", traction=(0, 1))
        .discretization(level=6, order=2)
    )


def test_a_million_points(demo):
    axis = np.linspace(-1, 1, 1000)
    x, y = np.meshgrid(axis, axis)
    random = np.random.default_rng(0).uniform(-1, 1, (2, 1_000_000))
    for name in ("ux", "von_mises"):
        grid = least(lambda: demo.field.at(x, y)[name])
        scattered = least(lambda: demo.field.at(*random)[name])
        print(f"{name}: grid {1e3 * grid:.0f} ms, random {1e3 * scattered:.0f} ms")
        assert grid <= 0.1


def test_one_point(demo):
    f = demo.field
    for name in ("ux", "von_mises"):
        one = least(lambda: [f.at(0.3, 0.4)[name] for _ in range(1000)]) / 1000
        print(f"{name}: {1e6 * one:.1f} us")
        assert one <= 5e-6


def test_opening(demo, tmp_path):
    demo.save(tmp_path / "a.h5")
    opening = least(lambda: ppum.open(tmp_path / "a.h5"))
    print(f"open: {1e3 * opening:.1f} ms")
    assert opening <= 5e-3
