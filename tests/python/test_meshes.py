"""The independent reader on meshes, against closed forms and 50 digits.

    python tests/python/test_meshes.py          (from the repository's root; or: pytest tests/python)
"""

import math
import pathlib
import subprocess
import sys
import tempfile

import h5py
import mpmath
import numpy as np

sys.path.insert(0, str(pathlib.Path(__file__).parent))
import programs
from mesh_files import element, mesh, write
from ppum_formulas import Double, Extended
from ppum_meshes import SQUARE, TRIANGLE, exponents
from ppum_reader import Field

TEMPORARY = tempfile.TemporaryDirectory(prefix="ppum-")
mpmath.mp.dps = 60
F = mpmath.mpf


def opened(arrays, numbers=Double, field=0):
    path = pathlib.Path(TEMPORARY.name) / "mesh.h5"
    write(path, arrays)
    with h5py.File(path) as file:
        return Field(file, field=field, numbers=numbers)


def polynomial(c, space, xi, eta, degree):
    """Σ c ξ^i η^j, for arrays of one row."""
    return mpmath.fsum(F(float(v)) * xi**i * eta**j for v, (i, j) in zip(c, exponents(degree, space), strict=True))


def slopes(function, x, y):
    """Derivatives by differences of 60 digits."""
    h = F(10) ** -24
    return [(function(x + a * h, y + b * h) - function(x - a * h, y - b * h)) / (2 * h) for a, b in ((1, 0), (0, 1))]


def compared(arrays, exact, points, side=1, double=1e-12):
    """Value and gradient of both readers against `exact(x, y)`, in parts of the largest number."""
    readers, worst = {n: opened(arrays, n) for n in (Double, Extended)}, {Double: 0.0, Extended: 0.0}
    wanted = [(exact(F(x), F(y)), *slopes(exact, F(x), F(y))) for x, y in points]
    sizes = [max(abs(row[k]) for row in wanted) for k in range(3)]
    for (x, y), row in zip(points, wanted):
        for numbers, reader in readers.items():
            jet = reader.evaluate(x, y, side)[0]
            # a comparison with NaN is false
            errors = [float(abs(a - b) / max(size, 1)) for a, b, size in zip(jet, row, sizes)]
            assert not any(map(math.isnan, errors)), (x, y)
            worst[numbers] = max(worst[numbers], *errors)
    print(f"    doubles {worst[Double]:.1e}, 50 digits {worst[Extended]:.1e}")
    assert worst[Double] < double and worst[Extended] < 1e-26, worst


def images(shape, function, count=12, seed=1):
    """Points x, y in an element, as doubles."""
    random = np.random.default_rng(seed)
    xi, eta = random.uniform(-0.95, 0.95, (2, count))
    if shape == TRIANGLE:
        turned = xi + eta > 0
        xi, eta = np.where(turned, -xi, xi), np.where(turned, -eta, eta)
        xi, eta = 0.74 * xi + 0.24, 0.74 * eta + 0.24
        kept = xi + eta < 0.49
        xi, eta = xi[kept], eta[kept]
    return [tuple(map(float, function(a, b))) for a, b in zip(xi, eta)]


def test_affine_triangles_of_all_degrees():
    """A rotated sliver of aspect 1000; the inverse of its map is a matrix."""
    turn, long, thin = math.radians(31), 2.0, 2e-3
    A = np.array([[math.cos(turn) * long, -math.sin(turn) * thin], [math.sin(turn) * long, math.cos(turn) * thin]])
    inverse, origin = mpmath.matrix(A.tolist()) ** -1, (0.3, -0.7)
    for degree in range(9):
        c = np.random.default_rng(degree).normal(size=len(exponents(degree)))

        def exact(x, y):
            xi, eta = inverse * mpmath.matrix([x - F(origin[0]), y - F(origin[1])])
            return polynomial(c, 0, xi, eta, degree)

        arrays = mesh([element(TRIANGLE, origin, A, blocks=[[(0, 0, c)]])])
        compared(arrays, exact, images(TRIANGLE, lambda a, b: A @ [a, b] + origin, 40), double=1e-10)


def test_a_bilinear_quadrilateral():
    """x = ξ + ξη/4, y = η: ξ = x/(1 + y/4), by coefficients of total degree 2 and of a tensor product."""
    c = np.random.default_rng(1).normal(size=16)
    exact = lambda x, y: polynomial(c, 1, x / (1 + y / 4), y, 3)
    for space, rows in ((0, [[1, 0, 0, 0.25, 0], [0, 1, 0, 0, 0]]), (1, [[1, 0, 0.25], [0, 1, 0]])):
        arrays = mesh([element(SQUARE, (0, 0), rows, space, blocks=[[(0, 1, c)]])])
        compared(arrays, exact, images(SQUARE, lambda a, b: (a + a * b / 4, b)))


def curved(shape, space, degree, strength, seed):
    """Coefficients of a map near the identity."""
    random = np.random.default_rng(seed)
    powers = exponents(degree, space)
    rows = strength * random.uniform(-1, 1, (2, len(powers)))
    rows[0][powers.index((1, 0))] += 1
    rows[1][powers.index((0, 1))] += 1
    return rows[:, 1:]


def test_curved_elements():
    """Triangles and squares with maps of degree 4, against the solver for equations of mpmath."""
    for shape, space, degree in ((TRIANGLE, 0, 4), (SQUARE, 0, 4), (SQUARE, 1, 4), (TRIANGLE, 0, 2)):
        rows, origin = curved(shape, space, degree, 0.02 if space else 0.04, degree + shape), (5.0, -3.0)
        c = np.random.default_rng(9).normal(size=len(exponents(4, space)))
        moved = lambda a, b: [F(o) + polynomial([0, *row], space, a, b, degree) for o, row in zip(origin, rows)]

        def exact(x, y):
            miss = lambda a, b: [m - t for m, t in zip(moved(a, b), (x, y))]
            a, b = mpmath.findroot(miss, (x - origin[0], y - origin[1]))
            return polynomial(c, space, a, b, 4)

        arrays = mesh([element(shape, origin, rows, space, blocks=[[(0, space, c)]])])
        compared(arrays, exact, images(shape, lambda a, b: moved(F(a), F(b)), 6))


def test_tensor_products_of_degree_8():
    """81 coefficients, powers of ξ fastest."""
    c = np.random.default_rng(3).normal(size=81)
    exact = lambda x, y: mpmath.fsum(F(c[9 * j + i]) * (x / 2) ** i * y**j for i in range(9) for j in range(9))
    arrays = mesh([element(SQUARE, (0, 0), [[2, 0], [0, 1]], blocks=[[(0, 1, c)]])])
    compared(arrays, exact, images(SQUARE, lambda a, b: (2 * a, b)), double=1e-11)


def square(left, value, **more):
    """A square of side 2 with a constant."""
    return element(SQUARE, (left + 1, 0), [[1, 0], [0, 1]], blocks=[[(0, 0, [value])]], **more)


def test_the_owner_of_a_border():
    """The first patch whose closed shape holds the point, then the nearest one, then none."""
    field = opened(mesh([square(0, 1.0), square(2, 2.0)]))
    for x, value in ((1.0, 1), (2.0, 1), (np.nextafter(2, 3), 2), (3, 2), (4, 2), (-1e-12, 1), (4 + 1e-12, 2)):
        assert field.evaluate(x, 0.3)[0][0] == value, x
    for x, y in ((-1e-10, 0.3), (4 + 1e-10, 0.3), (1, 1 + 1e-10), (9, 9)):
        assert math.isnan(field.evaluate(x, y)[0][0]) and not field.contains((x, y)), (x, y)


def test_points_rounded_onto_shared_edges_have_an_owner():
    """Triangles about a point that no double hits, points on their common edges."""
    random = np.random.default_rng(5)
    middle, rim = random.random(2), [random.random(2) + 2 * np.array([math.cos(a), math.sin(a)]) for a in range(6)]
    triangles = [np.array([middle, a, b]) for a, b in zip(rim, rim[1:])]
    to = lambda p: [(2 * (p[1] - p[0])[k] / 3, 2 * (p[2] - p[0])[k] / 3) for k in range(2)]
    elements = [element(TRIANGLE, p.mean(axis=0), to(p), blocks=[[(0, 0, [1.0])]]) for p in triangles]
    field = opened(mesh(elements))
    for corner in rim[1:-1]:
        for t in random.random(100):
            assert field.evaluate(*(middle + t * (corner - middle)))[0][0] == 1


# φ = y − x²/4 and ψ = x − 0.1 on the unit square, as columns of total degree 2
PHI, PSI = [0, 0, 1, -0.25, 0, 0], [-0.1, 1, 0]
LEVELS = (("u", ["u"]), ("phi", ["phi"]), ("psi", ["psi"]))


def level(x):
    return x**2 / 4


def test_two_sides_of_a_cut():
    """Both sides share their map; what lies on the level set belongs to the side that is asked for."""
    blocks = [[(0, 0, PHI)], [(0, 0, PSI)]]
    sides = [
        element(SQUARE, (0, 0), [[1, 0], [0, 1]], clips=[(1, side)], blocks=[[(0, 0, [value, side, 0])], *blocks])
        for side, value in ((0, -1.0), (1, 2.0))
    ]
    arrays = mesh(sides, LEVELS)
    arrays["steps/0000/partition/map_offset"] = [0, 0]
    arrays["steps/0000/partition/map"] = np.eye(2)
    exact = lambda x, y: 2 + x if y >= level(x) else F(-1)
    points = [(x, y + e) for x in (-0.7, 0.1, 0.6) for y in (level(x),) for e in (0.3, 1e-9, -1e-9, -0.3)]
    compared(arrays, exact, points)
    field = opened(arrays)
    for x in (-0.5, 0.0, 0.75):
        assert field.evaluate(x, level(x), 1)[0] == (2 + x, 1, 0)
        assert field.evaluate(x, level(x), -1)[0] == (-1, 0, 0)


def test_a_junction():
    """φ ≥ 0; below it ψ ≥ 0 and ψ < 0."""
    parts = [([(1, 1)], 1.0), ([(1, 0), (2, 1)], 2.0), ([(1, 0), (2, 0)], 3.0)]
    blocks = [[(0, 0, PHI)], [(0, 0, PSI)]]
    elements = [
        element(SQUARE, (0, 0), [[1, 0], [0, 1]], clips=clips, blocks=[[(0, 0, [value])], *blocks])
        for clips, value in parts
    ]
    exact = lambda x, y: F(1) if y >= level(x) else F(2) if x >= F(0.1) else F(3)
    random = np.random.default_rng(4).uniform(-1, 1, (40, 2)).tolist()
    compared(mesh(elements, LEVELS), exact, random)
    field = opened(mesh(elements, LEVELS))
    assert [field.evaluate(0.1, -0.5, side)[0][0] for side in (1, -1)] == [2, 3]


TIP = ["sqrt(r)*sin(theta/2)", "sqrt(r)*cos(theta/2)", "sqrt(r)*sin(theta)*sin(theta/2)", "sqrt(r)*sin(theta)*cos(theta/2)"]


def test_tip_functions_of_level_fields():
    """Curved level sets on an affine element, down to 1e-9 from the tip and on both faces."""
    functions = [dict(kind="formula", formula=text, frame="levels", levels=(2, 1)) for text in TIP]
    c = np.random.default_rng(6).normal(size=(4, 3))
    blocks = [[(0, 0, [0.5]), *((k + 1, 0, row) for k, row in enumerate(c))], [(0, 0, PHI)], [(0, 0, PSI)]]
    arrays = mesh([element(SQUARE, (0, 0), [[1, 0], [0, 1]], blocks=blocks)], LEVELS, functions)

    def exact(x, y, side=1):
        phi, psi = y - x**2 / 4, x - F(0.1)
        r, theta = mpmath.hypot(psi, phi), side * mpmath.atan2(abs(phi), psi) * (1 if phi >= 0 else -1)
        half = [mpmath.sin(theta / 2), mpmath.cos(theta / 2)]
        terms = [*half, *(mpmath.sin(theta) * h for h in half)]
        return F(0.5) + mpmath.fsum(
            polynomial(row, 0, x, y, 1) * mpmath.sqrt(r) * term for row, term in zip(c, terms)
        )

    tip, points = np.array([0.1, 0.0025]), []
    for distance, count in ((0.3, 12), (1e-3, 8), (1e-9, 8)):
        angles = np.random.default_rng(7).uniform(-3, 3, count)
        points += [tuple((tip + distance * np.array([math.cos(a), math.sin(a)])).tolist()) for a in angles]
    # without anchors, differences of coordinates next to the tip have few digits
    compared(arrays, exact, points[:20], double=1e-11)
    compared(arrays, exact, points[20:], double=1e-9)
    field = opened(arrays, Extended)
    for side in (1, -1):
        assert abs(field.evaluate(-0.5, 0.0625, side)[0][0] - exact(F(-0.5), F(0.0625), side)) < 1e-40


def test_the_sign_of_a_level_field():
    """A function of the kind `level` on one patch."""
    functions = [dict(kind="level", levels=(-1, 1))]
    blocks = [[(0, 0, [1.0]), (1, 0, [0, 2.0, 0])], [(0, 0, PHI)], [(0, 0, PSI)]]
    arrays = mesh([element(SQUARE, (0, 0), [[1, 0], [0, 1]], blocks=blocks)], LEVELS, functions)
    exact = lambda x, y: 1 + 2 * x * (1 if y >= level(x) else -1)
    compared(arrays, exact, np.random.default_rng(8).uniform(-1, 1, (20, 2)).tolist())
    assert [opened(arrays).evaluate(0.5, level(0.5), side)[0][0] for side in (1, -1)] == [2, 0]


def test_fields_of_libraries():
    """Files with values of the library that they come from (mesh_cases.py): the reader in doubles, and digits in 60."""
    files = sorted((pathlib.Path(__file__).parent / "fixtures").glob("*.h5"))
    assert len(files) > 5
    for path in files:
        with h5py.File(path) as file:
            fields = {numbers: Field(file, numbers=numbers) for numbers in (Double, Extended)}
            points, values, digits = (file["user"][name][()] for name in ("points", "values", "digits"))
        found = [[jet[0] for jet in fields[Double].evaluate(*p)] for p in points]
        difference = np.abs(found - values).max() / np.abs(values).max()
        print(f"    {path.stem} {difference:.1e}")
        # that of GetFEM's and DOLFINx' search for reference points
        assert difference < 2e-12, path
        for p, row in zip(points, digits):
            exact = [jet[0] for jet in fields[Extended].evaluate(*p)]
            assert max(abs(v - mpmath.mpf(d.decode())) for v, d in zip(exact, row)) < 1e-45, path


def test_the_program_on_fields_of_libraries():
    """`ppum check` has nothing to say of the files, `sample` gives the library's values, and `render` draws values everywhere."""
    folder = pathlib.Path(TEMPORARY.name)
    for path in sorted((pathlib.Path(__file__).parent / "fixtures").glob("*.h5")):
        with h5py.File(path) as file:
            points, values = (file["user"][name][()] for name in ("points", "values"))
        np.savetxt(folder / "points.csv", points, delimiter=",", fmt="%.17g")
        run("check", path)
        run("sample", path, "--points", folder / "points.csv", "-o", folder / "values.npy")
        table = np.load(folder / "values.npy")
        found = np.stack([table[name] for name in table.dtype.names[3:]], axis=1)
        difference = np.abs(found - values).max() / np.abs(values).max()
        print(f"    {path.stem} {difference:.1e}")
        assert difference < 2e-12, path
        run("render", path, "-o", folder / f"{path.stem}.png", "--size", "240x180", "--overlay", "cells")


def run(*arguments):
    done = subprocess.run(programs.ppum(*arguments), capture_output=True, text=True, check=False)
    assert done.returncode == 0, f"{arguments}: {done.stderr}"


if __name__ == "__main__":
    for name, test in list(globals().items()):
        if name.startswith("test_"):
            test()
            print(f"ok  {name[5:].replace('_', ' ')}")
