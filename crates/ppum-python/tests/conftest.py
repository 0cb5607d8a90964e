"""What the tests have in common: solved plates, and the program where it has been built."""

import os
import pathlib
import subprocess

import ppum
import pytest

ROOT = pathlib.Path(__file__).parents[3]


def plate(cells=(16, 32), title="Slanted crack"):
    """The problem of the README."""
    return (
        ppum.Problem(
            domain=((-1, -2), (1, 2)),
            material=ppum.Elastic(young=1.0, poisson=0.3, state="plane-strain"),
            title=title,
        )
        .crack((-0.3535533906, -0.3535533906), (0.3535533906, 0.3535533906))
        .boundary("bottom", traction=(0, -1))
        .boundary("top", traction=(0, 1))
        .discretization(cells=cells, order=2)
    )


@pytest.fixture(scope="session")
def problem():
    return plate()


@pytest.fixture(scope="session")
def ds(problem):
    return ppum.solve(problem)


@pytest.fixture(scope="session")
def f(ds):
    return ds.field


@pytest.fixture(scope="session")
def holed():
    """A graded cover with a hole, kinked and crossing cracks, a quantity with a name."""
    return ppum.solve(
        ppum.Problem(
            domain=((0.1, -0.3), (2.3, 1.2)), material=ppum.Elastic(2.0, "0.2 + 0.05*x", "plane-stress")
        )
        .hole(center=(1.7, 0.4), radius=0.23)
        .crack((0.4, 0.1), (0.7, 0.3), (1.1, 0.25))
        .boundary("left", displacement=(0, 0))
        .boundary("right", traction=(1, 0.3))
        .quantity("safety", "2/von_mises")
        .discretization(cells=(8, 6), order=2)
    )


@pytest.fixture(scope="session")
def potential():
    return ppum.solve(
        ppum.Problem(domain=((0, 0), (1, 1)), material=ppum.Poisson(2.0))
        .boundary("left", value=0)
        .boundary("right", value="1 + y")
        .discretization(level=2)
    )


@pytest.fixture(scope="session")
def grown():
    """Three steps of a crack that grows."""
    return ppum.solve(
        ppum.Problem(domain=((0, 0), (2, 1)), material=ppum.Elastic(1.0, 0.3), title="Grown")
        .crack((0, 0.5), (0.5, 0.5))
        .boundary("bottom", traction=(0, -1))
        .boundary("top", traction=(0, 1))
        .section("growth", steps=2, increment=0.05)
        .discretization(cells=(16, 8), order=1)
    )


@pytest.fixture(scope="session")
def program():
    """Runs the program, where it has been built."""
    path = pathlib.Path(os.environ.get("PPUM", ROOT / "target/release/ppum"))
    if not path.exists():
        pytest.skip("the program has not been built: cargo build --release")

    def run(*args):
        done = subprocess.run([path, *map(str, args)], capture_output=True, text=True)
        assert done.returncode == 0, done.stderr
        run.warnings = [line.removeprefix("warning: ") for line in done.stderr.splitlines()]
        return done.stdout

    return run
