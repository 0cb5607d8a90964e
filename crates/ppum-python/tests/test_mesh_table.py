"""The table of docs/meshes.md: fields of libraries through the package, against these libraries and the reader.

    python crates/ppum-python/tests/test_mesh_table.py          (prints it; tests take fewer points)
"""

import sys

import numpy as np
import ppum
import pytest
from conftest import ROOT

h5py = pytest.importorskip("h5py")
mpmath = pytest.importorskip("mpmath")
sys.path.insert(0, str(ROOT / "tests/python"))
from ppum_formulas import Extended  # noqa: E402
from ppum_reader import Field  # noqa: E402

FIXTURES = sorted((ROOT / "tests/python/fixtures").glob("*.h5"))
POINTS, PIXELS, WIDTH = 1000, (24, 18), 1e-12
mpmath.mp.dps = 60


def opened(path, **numbers):
    """The independent reader on all fields of a file."""
    with h5py.File(path) as file:
        return [Field(file, field=k, **numbers) for k in range(len(file["steps/0000/fields"]))]


def names_of(field):
    """Components and their derivatives, as the reader's jets have them."""
    components = [name[1:-3] for name in field.quantities if name.startswith("d") and name.endswith("_dx")]
    return [name for c in components for name in (c, f"d{c}_dx", f"d{c}_dy")]


def jets(reader, points):
    """Values and derivatives of the components, a row for each point."""
    return np.array([[float(part) for jet in reader.evaluate(*p) for part in jet] for p in points])


def largest(found, exact):
    """The largest difference of values and of derivatives, in parts of the largest of these."""
    assert (np.isnan(found) == np.isnan(exact)).all() and np.isfinite(exact).any()
    parts = [np.arange(exact.shape[1]) % 3 == 0, np.arange(exact.shape[1]) % 3 > 0]
    return [float(np.nanmax(np.abs(found - exact)[:, part]) / np.nanmax(np.abs(exact[:, part]))) for part in parts]


def pixels(field, size, center, width):
    """Values and derivatives at the pixels of an image, and their centres from the middle."""
    drawn = [field.draw.render(name, size=size, center=center, width=width).ravel() for name in names_of(field)]
    across, down = np.meshgrid(np.arange(size[0]) + 0.5 - size[0] / 2, np.arange(size[1]) + 0.5 - size[1] / 2)
    return np.stack(drawn, axis=1), np.column_stack([across.ravel(), -down.ravel()]) * width / size[0]


def between(a, b, is_first):
    """Where a condition changes between two points, by halving."""
    for _ in range(60):
        middle = (a + b) / 2
        a, b = (middle, b) if is_first(middle) else (a, middle)
    return a


def tip(readers, place):
    """Where two level fields are zero, by Newton's method."""
    for _ in range(20):
        rows = np.array([reader.evaluate(*place)[0] for reader in readers], float)
        place = place - np.linalg.solve(rows[:, 1:], rows[:, 0])
    return place


def anchors(path, inside):
    """Points on the border of two patches, on a level line, and at a tip, as far as a file has them."""
    first, *levels = opened(path)
    owner, a = lambda p: (first.mesh.owner(p, 1) or [None])[0], inside[0]
    yield between(a, next(b for b in inside if owner(b) != owner(a)), lambda p: owner(p) == owner(a))
    if levels:
        level = lambda p: levels[0].evaluate(*p)[0][0]
        line = between(min(inside, key=level), max(inside, key=level), lambda p: level(p) < 0)
        yield line
    if len(levels) > 1:
        yield tip(levels, line)


def row_of(path, count, size):
    """The largest differences: from the library, at points, at pixels, at pixels of small views."""
    field, reader, extended = ppum.open(path).field, opened(path)[0], opened(path, numbers=Extended)[0]
    with h5py.File(path) as file:
        places, values = (file["user"][name][()] for name in ("points", "values"))
    names, low, high = names_of(field), reader.min, reader.max
    library = np.abs(field.evaluate(*places.T, names[::3]) - values).max() / np.abs(values).max()
    points = np.random.default_rng(1).uniform(low, high, (count, 2))
    exact = jets(reader, points)
    # beside symmetric places: points that are rounded onto edges have one of two gradients
    width, views = float(np.min(high - low)), []
    middle = (low + high) / 2 + np.array([0.0137, 0.0071]) * width
    drawn, offsets = pixels(field, size, tuple(map(float, middle)), width)
    for place in anchors(path, points[np.isfinite(exact[:, 0])]):
        near, moved = pixels(field, (3, 2), tuple(map(float, place)), WIDTH)
        asked = [[mpmath.mpf(float(a)) + mpmath.mpf(float(b)) for a, b in zip(place, offset)] for offset in moved]
        views.append(largest(near, jets(extended, asked)))
    sampled, imaged = largest(field.evaluate(*points.T, names), exact), largest(drawn, jets(reader, middle + offsets))
    return [library, *sampled, *imaged, *np.max(views, axis=0)]


@pytest.mark.parametrize("path", FIXTURES, ids=lambda path: path.stem)
def test_row(path):
    library, *others = row_of(path, 40, (6, 4))
    assert library < 2e-12 and max(others) < 1e-12, others


if __name__ == "__main__":
    for path in FIXTURES:
        print(f"| {path.stem} | {' | '.join(f'{number:.0e}' for number in row_of(path, POINTS, PIXELS))} |", flush=True)
