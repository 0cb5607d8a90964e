"""Compares the independent reader with the program, in double and in extended precision.

    pip install -r tests/python/requirements.txt
    python tests/python/test_reader.py          (from the repository's root; or: pytest tests/python)

Needs cargo: the datasets come from the example `fixture` of `ppum-bench` (see programs.py).
"""

import math
import pathlib
import shutil
import subprocess
import sys
import tempfile

import h5py
import mpmath
import numpy as np

sys.path.insert(0, str(pathlib.Path(__file__).parent))
import programs
from h5py_files import DATA, LAYOUTS, LIBVERS, rewrite
from ppum_formulas import Extended
from ppum_reader import Field, is_right, seal, text, texts

ROOT = pathlib.Path(__file__).parents[2]
OLD = DATA / "version-1.0.h5"
COUNT = 8  # of these 3 and 7 have cracks with arcs
TEMPORARY = tempfile.TemporaryDirectory(prefix="ppum-")
FOLDER = pathlib.Path(TEMPORARY.name)
mpmath.mp.dps = 40


def fixture(*arguments, input=None):
    """Runs the example: exit status, answer, complaints."""
    command = programs.fixture(*arguments)
    done = subprocess.run(command, cwd=ROOT, capture_output=True, text=True, input=input)
    return done.returncode, done.stdout, done.stderr


def files():
    if not any(FOLDER.glob("0*.h5")):
        status, _, message = fixture("write", FOLDER, COUNT)
        assert status == 0, message
    found = sorted(FOLDER.glob("0*.h5"))
    assert len(found) == COUNT
    return found


def points(field, distances, count=25):
    """Those of `anywhere` that lie in the domain."""
    for anchor, offset in anywhere(field, distances, count):
        if field.contains([field.real(float(a)) + field.real(float(b)) for a, b in zip(anchor, offset)]):
            yield anchor, offset


def anywhere(field, distances, count):
    """(anchor, offset): random points, points close to tips and kinks, and middles of edges of cracks."""
    random = np.random.default_rng(1)
    for point in field.min + (field.max - field.min) * random.random((count, 2)):
        yield point, np.zeros(2)
    for crack, bulges in zip(field.cracks, field.bulges):
        for vertex in crack:
            for distance in distances:
                angle = random.random() * 2 * math.pi
                offset = distance * np.array([math.cos(angle), math.sin(angle)])
                if (vertex + offset > field.min).all() and (vertex + offset < field.max).all():
                    yield vertex, offset
        for a, b, bulge in zip(crack, crack[1:], bulges):
            yield middle(a, b, bulge), distances[-1] * (random.random(2) - 0.5)


def middle(a, b, bulge):
    """The middle of an edge."""
    (dx, dy) = b - a
    return (a + b - bulge * np.array([-dy, dx])) / 2


def exact_sum(anchor, offset):
    return [mpmath.mpf(float(a)) + mpmath.mpf(float(b)) for a, b in zip(anchor, offset)]


def difference(jets, exact):
    """Largest difference of values and of gradients, relative to the local size of values and of
    values and gradients."""
    values, all = max(abs(jet[0]) for jet in exact), scale(exact)
    sizes = (values, all, all)
    return max(
        float(abs(u - v) / size)
        for jet, other in zip(jets, exact, strict=True)
        for u, v, size in zip(jet, other, sizes)
    )


def scale(jets):
    return max(abs(c) for jet in jets for c in jet)


def test_h5py_reads_and_the_checksum_agrees():
    for path in files():
        with h5py.File(path) as file:
            assert text(file.attrs["format"]) == "ppum"
            assert list(file.attrs["format_version"]) == [1, 9]
            assert text(file.attrs["title"]) == f"Übung {int(path.stem)}"
            assert is_right(file)
            assert counts_attributes(file)


def counts_attributes(file):
    """Whether HDF5 counts the attributes that it finds: its tools copy as many as it counts."""
    groups = [file]
    file.visititems(lambda name, item: groups.append(item) if isinstance(item, h5py.Group) else None)
    return all(len(group.attrs) == len(list(group.attrs)) for group in groups)


def program(path, asked, *quantities):
    """What the program gives at (anchor, offset, side), a list of numbers for each."""
    lines = [" ".join(map(repr, map(float, [*a, *o, s]))) for a, o, s in asked]
    status, answer, message = fixture("values", path, *quantities, input="\n".join(lines))
    assert status == 0, message
    return [list(map(float, line.split())) for line in answer.splitlines()]


def test_the_program_agrees_with_extended_precision():
    worst = 0
    for path in [OLD, *files()]:
        with h5py.File(path) as file:
            field = Field(file, numbers=Extended)
            asked = [(*p, side) for p in points(field, [1e-2, 1e-6, 1e-13]) for side in (1, -1)]
            for (anchor, offset, side), numbers in zip(asked, program(path, asked), strict=True):
                jets = [numbers[k : k + 3] for k in range(0, len(numbers), 3)]
                exact = field.evaluate(*exact_sum(anchor, offset), side)
                worst = max(worst, difference(jets, exact))
    print(f"    largest difference {worst:.1e} of the local size")
    assert worst < 1e-12


def test_the_reader_in_double_agrees_with_extended_precision():
    worst = 0
    for path in files():
        with h5py.File(path) as file:
            double, exact = Field(file), Field(file, numbers=Extended)
            for anchor, offset in points(double, [1e-2]):
                p = anchor + offset
                worst = max(worst, difference(double.evaluate(*p), exact.evaluate(*p)))
    print(f"    largest difference {worst:.1e} of the local size")
    assert worst < 1e-11  # it has no anchors


def test_quantities_agree_with_extended_precision():
    """Those of the library, those of the file, and a formula; relative to the largest of the points."""
    worst = max(map(compared, files()))
    print(f"    largest difference {worst:.1e} of the largest value")


def test_quantities_of_other_bodies_agree_with_extended_precision():
    """Of bodies of revolution and of anisotropic ones, which no fixture is: the fields of others with their equations."""
    paths = {state: path for path in files() if (state := attribute(path, "state"))}
    assert paths.keys() == {"plane-strain", "plane-stress"}
    for path in paths.values():
        round, stiff = (FOLDER / f"{name}-{path.name}" for name in ("revolution", "anisotropic"))
        for copy, change in ((round, revolve), (stiff, stiffen)):
            shutil.copy(path, copy)
            with h5py.File(copy, "a") as file:
                change(file["equation"].attrs)
                file.pop("quantities", None)
                seal(file)
            print(f"    {copy.stem}: largest difference {compared(copy):.1e} of the largest value")
        with h5py.File(round) as file:
            assert {"ehoop", "shoop"} < Field(file).quantities.keys()


def attribute(path, name):
    """A text of a file's equation, empty where it has none."""
    with h5py.File(path) as file:
        return text(file["equation"].attrs.get(name, ""))


def revolve(equation):
    equation["state"] = "axisymmetric"


def stiffen(equation):
    is_strain = text(equation["state"]) == "plane-strain"
    for name in ("young", "poisson", "expansion"):
        equation.pop(name, None)
    plane = dict(c11=3.0, c12=0.5, c16="0.2 + 0.1*sin(x)", c22=2.0, c26=-0.1, c66=0.75)
    through = dict(c13=0.4, c23=0.3, c36=0.1, c33=1.5) if is_strain else {}
    for name, value in (plane | through | dict(kind="anisotropic", axis="0.4 + 0.1*y")).items():
        equation[name] = value


def compared(path):
    """The largest difference of a file's quantities in the program and in the reader, relative to the largest value."""
    worst = 0
    with h5py.File(path) as file:
        field = Field(file, numbers=Extended)
        formula = f"{field.components[0]}*x - gradient"
        names = [name.replace("von_m", "von-m") for name in field.quantities] + [formula]
        asked = [(*p, side) for p in points(field, [1e-2, 1e-6], count=10) for side in (1, -1)]
        found = program(path, asked, *names, *["error"][: len(field.exact)])
        exact = [quantities(field, exact_sum(a, o), side, names) for a, o, side in asked]
    for name, u, v in zip([*names, "error"], zip(*found), zip(*exact)):
        error = max(float(abs(a - b)) for a, b in zip(u, v, strict=True))
        size = float(max(map(abs, v)))
        if name == "direction":
            # modulo a half turn, where the principal stresses differ
            error = max(float(abs(mpmath.sin(a - b))) for a, b in zip(u, v))
        assert error <= 1e-11 * size, (path.name, name, error, size)
        worst = max(worst, error / size if size else 0)
    return worst


def quantities(field, point, side, names):
    values = [field.quantity(name, *point, side) for name in names]
    at = dict(zip("xy", point))
    u = [jet[0] for jet in field.evaluate(*point, side)]
    errors = [a - formula.evaluate(at).v for a, formula in zip(u, field.exact)]
    return values + ([mpmath.sqrt(sum(e * e for e in errors))] if errors else [])


def test_at_a_tip_quantities_of_the_gradient_are_infinite():
    tip, names = (0.0, 0.0), ["gradient", "u", "if(x > 1, du_dx, 7)", "magnitude"]
    [found] = program(OLD, [(tip, tip, 1)], *names)
    with h5py.File(OLD) as file:
        field = Field(file)
        own = [field.quantity(name, *tip) for name in names]
    assert [math.isinf(value) for value in found] == [True, False, True, False]
    assert [math.isinf(value) for value in own] == [True, False, True, False]


def test_the_angle_at_the_origin_of_a_frame_is_zero():
    """Also where a coordinate is -0: the formulas of FORMAT.md alone would give pi there."""
    copy, point = FOLDER / "origin.h5", (0.0, 0.0)
    for frame, end, angle in [("tip", "last", 0), ("tip", "start", 0), ("fixed", "", 3), ("world", "", 0)]:
        copy.write_bytes(OLD.read_bytes())
        with h5py.File(copy, "a") as file:
            step = file["steps/0000"]
            row = texts(step["functions/frame"]).index("tip")
            crack = step["functions/crack"][row]
            if frame == "tip":
                points = step["cracks/points"][()]
                point = tuple(points[0] if end == "start" else points[-1])
            for name, value in [
                ("formula", "10*cos(theta/2)"),
                ("frame", frame),
                ("frame_end", end),
                ("crack", crack if frame == "tip" else -1),
                ("frame_angle", angle),
            ]:
                values = step[f"functions/{name}"]
                values = texts(values) if values.dtype.kind in "SO" else values[()]
                del step[f"functions/{name}"]
                values[row] = value
                step[f"functions/{name}"] = values
            seal(file)
        [[found]] = program(copy, [(point, (0.0, 0.0), 1)], "u")
        with h5py.File(copy) as file:
            own = Field(file).quantity("u", *point)
        assert abs(found - own) < 1e-12, (frame, end, found, own)


def smallest():
    """The file that the page writes."""
    page = (ROOT / "FORMAT.md").read_text()
    code = page.split("```python\n")[1].split("```")[0]
    path = FOLDER / "smallest.h5"
    exec(code.replace('"smallest.h5"', repr(str(path))), {})
    return path


def run(*arguments):
    return subprocess.run(programs.ppum(*arguments), cwd=ROOT, capture_output=True, text=True)


def test_the_smallest_file_of_the_page():
    path = smallest()
    checked = run("check", path)
    assert checked.returncode == 0 and "no errors" in checked.stdout, checked
    for x in [0.0, 0.3, 1.0, 1.9]:
        with h5py.File(path) as file:
            [(u, dx, dy)] = Field(file).evaluate(x, 0.4)
        assert max(abs(u - x), abs(dx - 1), abs(dy)) < 1e-12, (x, u, dx, dy)
        assert abs(program(path, [((x, 0.4), (0.0, 0.0), 1)], "u")[0][0] - x) < 1e-12


def test_scalars_may_be_arrays_of_one_element():
    """As h5py writes a list of one text or number."""
    path = smallest()
    exact = run("probe", path, "--at", "0.3,0.4").stdout
    with h5py.File(path, "a") as file:
        groups = [file]
        file.visititems(lambda _, node: groups.append(node))
        for attributes in (group.attrs for group in groups):
            for name, value in list(attributes.items()):
                if np.ndim(value) == 0:
                    kind = h5py.string_dtype() if isinstance(value, str) else None
                    attributes[name] = np.array([value], dtype=kind)
        assert file.attrs["format"].shape == file["steps/0000"].attrs["load"].shape == (1,)
        seal(file)
    checked = run("check", path)
    assert checked.returncode == 0, checked
    assert run("probe", path, "--at", "0.3,0.4").stdout == exact != ""
    with h5py.File(path) as file:
        assert Field(file).evaluate(0.3, 0.4)


def test_all_errors_are_listed():
    path = smallest()
    with h5py.File(path, "a") as file:
        file.attrs["format_version"] = [1, 5]
        step = file["steps/0000"]
        step.attrs["load"] = 1
        step["partition"].attrs["weight"] = "bspline"
        del step["partition/level"], step["fields/0000/block_offset"]
        step["partition/level"] = [0, 0]
        step["fields/0000/block_offset"] = [0, 3]
        step["functions/kind"][0] = "heaviside"
    lines = run("check", path).stdout.splitlines()
    assert len(lines) == 1 and lines[0].startswith("@format_version: has type i64, expected u32"), lines
    with h5py.File(path, "a") as file:
        file.attrs["format_version"] = np.array([1, 5], "u4")
    checked = run("check", path)
    places = sorted(line.split(":")[0] for line in checked.stdout.splitlines())
    expected = ["fields/0000/block_offset", "functions/kind", "partition/level", "partition@weight"]
    assert places == sorted([f"steps/0000/{name}" for name in expected] + ["steps/0000@load"]), checked
    assert checked.returncode == 1 and "linear, quadratic, cubic, formula" in checked.stdout, checked
    assert "ppum check" in run("info", path).stderr


def test_supports_that_do_not_cover_are_refused():
    """By both readers, and covers of boxes that come from no tree are not, if they overlap well."""
    random = np.random.default_rng(35)
    answers = []
    for half in [0.48, 0.5, 0.502, 0.51] + list(random.uniform(0.495, 0.515, 12)):
        path = smallest()
        with h5py.File(path, "a") as file:
            partition = file["steps/0000/partition"]
            partition["half"][...] = [[half + random.uniform(-0.01, 0.02), 0.7], [half, 0.7]]
        program = run("check", path)
        with h5py.File(path) as file:
            try:
                Field(file)
                own = True
            except AssertionError:
                own = False
        assert (program.returncode == 0) == own, (half, program)
        assert own or "no support holds (" in program.stdout, program
        answers.append(own)
    assert 3 < sum(answers) < 13, answers


def test_gradients_at_the_origin_of_a_frame():
    """The derivative of r is that from the right; where a function has none, no coefficient matters."""
    for formula, coefficient, has_gradient in [
        ("r", 1, True),
        ("r^1.5", 1, True),
        ("x*r", 1, True),
        ("0*sqrt(r)", 1, True),
        ("if(x > 5, 1, 0)*sqrt(r)", 1, True),
        ("sqrt(r)", 1, False),
        ("sqrt(r)", 0, False),
        ("theta", 1, False),
        ("r^2*theta", 1, False),
    ]:
        path = smallest()
        with h5py.File(path, "a") as file:
            step = file["steps/0000"]
            for name, value in [("kind", "formula"), ("formula", formula), ("frame", "fixed")]:
                step[f"functions/{name}"][0] = value
            step["functions/frame_origin"][0] = [0.9, 0.3]
            step["functions/frame_angle"][0] = 0.5
            step["fields/0000/coefficients"][...] = [[coefficient, 0, 0] * 2]
        found = program(path, [((0.9, 0.3), (0.0, 0.0), 1)], "u", "du_dx", "du_dy")[0]
        with h5py.File(path) as file:
            own = [Field(file).quantity(name, 0.9, 0.3) for name in ("u", "du_dx", "du_dy")]
        assert math.isfinite(found[1]) == has_gradient, (formula, found)
        both = [(0, 0) if math.isinf(a) and math.isinf(b) else (a, b) for a, b in zip(found, own)]
        assert all(abs(a - b) < 1e-12 for a, b in both), (formula, found, own)


def junctions(field):
    """Ends of cracks that lie on others, and points where two cross."""
    segments = [(i, a, b) for i, crack in enumerate(field.cracks) for a, b in zip(crack, crack[1:])]
    cross = lambda a, b: a[0] * b[1] - a[1] * b[0]
    for i, a, b in segments:
        for j, c, d in segments:
            area = cross(b - a, d - c)
            if i < j and area != 0:
                s, t = cross(c - a, d - c) / area, cross(c - a, b - a) / area
                if -1e-9 < s < 1 + 1e-9 and -1e-9 < t < 1 + 1e-9:
                    yield a + s * (b - a)


def test_where_cracks_meet_the_program_agrees_with_extended_precision():
    worst, sectors = 0, set()
    random = np.random.default_rng(2)
    for path in files():
        with h5py.File(path) as file:
            field = Field(file, numbers=Extended)
            if not any("cuts" in row and len(row["cuts"]) for row in field.table):
                continue
            angles = 2 * math.pi * random.random(8)
            around = [np.array([math.cos(a), math.sin(a)]) for a in angles]
            places = list(junctions(field))
            assert len(places) >= 4
            asked = [(p, r * d, 1) for p in places for r in (1e-3, 1e-8, 1e-12) for d in around]
            for (anchor, offset, side), numbers in zip(asked, program(path, asked), strict=True):
                jets = [numbers[k : k + 3] for k in range(0, len(numbers), 3)]
                exact = field.evaluate(*exact_sum(anchor, offset), side)
                worst = max(worst, difference(jets, exact))
                values = [field.cache[b].v for b in field.cache if field.table[b]["kind"] == "component"]
                sectors.add((path.stem, *map(float, anchor), tuple(map(int, values))))
    print(f"    largest difference {worst:.1e} of the local size, {len(sectors)} sectors")
    assert worst < 1e-12 and len(sectors) >= 24


def test_the_component_of_the_page():
    """The example of section 3."""
    field = Field.__new__(Field)
    field.n, field.real = Extended, Extended.real
    field.cracks = [np.array([[-1.0, 0], [1, 0]]), np.array([[0.0, 0], [0, 1]])]
    field.bulges = np.zeros((2, 2))
    cuts = [(0, 0, 1, -1), (1, 0, -2, -1)]
    for x, y, above, below in [
        (-0.5, 0.5, 1, 1),
        (0.5, 0.5, 0, 0),
        (-0.5, -0.5, 0, 0),
        (-0.5, 0, 1, 0),
        (0, 0.5, 1, 0),
        (0, 0, 1, 0),
    ]:
        for field.side, expected in ((1, above), (-1, below)):
            assert field.indicator((field.real(x), field.real(y)), cuts) == expected


def test_gradients_are_those_of_the_values():
    for path in files()[:3]:
        with h5py.File(path) as file:
            field, h = Field(file, numbers=Extended), mpmath.mpf(10) ** -18
            for anchor, offset in list(points(field, [1e-2, 1e-6]))[::3]:
                x, y = exact_sum(anchor, offset)
                here = field.evaluate(x, y)
                for axis, (dx, dy) in enumerate([(h, 0), (0, h)], 1):
                    after, before = field.evaluate(x + dx, y + dy), field.evaluate(x - dx, y - dy)
                    for c, jet in enumerate(here):
                        slope = (after[c][0] - before[c][0]) / (2 * h)
                        assert abs(slope - jet[axis]) < 1e-12 * scale(here), (path.name, x, y)


def test_both_sides_of_a_crack():
    """On a crack the values jump, and each side continues the field on its side."""
    jumps = 0
    for path in files():
        with h5py.File(path) as file:
            field = Field(file, numbers=Extended)
            for k, crack in enumerate(field.cracks):
                if field.bulges[k].any():
                    continue  # points on arcs are no numbers
                a, b = [tuple(map(mpmath.mpf, map(float, p))) for p in crack[:2]]
                middle = [(u + v) / 2 for u, v in zip(a, b)]
                left = (a[1] - b[1], b[0] - a[0])
                for side in (1, -1):
                    beside = [m + side * mpmath.mpf(10) ** -25 * n for m, n in zip(middle, left)]
                    on, near = field.evaluate(*middle, side), field.evaluate(*beside)
                    assert field.nearest(middle, k) == 0
                    assert all(abs(p[0] - q[0]) < 1e-12 * scale(on) for p, q in zip(on, near))
                above, below = field.evaluate(*middle, 1), field.evaluate(*middle, -1)
                jumps += any(abs(p[0] - q[0]) > 1e-3 for p, q in zip(above, below))
    assert jumps > 0


def curved():
    """A file whose first crack is a segment, an arc of its tangent, and a large arc; the second one is an arc of more
    than half a turn, the third one two arcs with a kink."""
    path = FOLDER / "curved.h5"
    shutil.copy(files()[3], path)
    with h5py.File(path, "a") as file:
        cracks = file["steps/0000/cracks"]
        points, offsets = cracks["points"][()], cracks["offsets"][()]
        assert offsets.tolist() == [0, 4, 6, 9]
        (cos, sin), (x, y) = points[1] - points[0], points[2] - points[1]
        # half of the sweep is the angle between the tangent and the chord
        half = math.atan2(cos * y - sin * x, cos * x + sin * y)
        cracks["bulges"][...] = [0, math.tan(half / 2), -3, 0, 1.5, 0, 0.4, -0.9, 0]
        seal(file)
    return path


def test_deep_places_beside_arcs():
    """1e-12 and less beside arcs, joints and tips: on the side that they are put, values as in extended precision."""
    worst, asked, sides = 0, [], []
    path, random = curved(), np.random.default_rng(4)
    with h5py.File(path) as file:
        field = Field(file, numbers=Extended)
        for k, (crack, bulges) in enumerate(zip(field.cracks, field.bulges)):
            for a, b, bulge in zip(crack, crack[1:], bulges):
                at = middle(a, b, bulge)
                left = np.array([a[1] - b[1], b[0] - a[0]]) / math.dist(a, b)
                for distance in (1e-2, 1e-6, 1e-12):
                    for side in (1, -1):
                        asked.append((at, side * distance * left, 1))
                        sides.append((k, side if distance < 1e-3 else None))
            for vertex in crack:
                for distance in (1e-6, 1e-12, 1e-14):
                    for angle in 2 * math.pi * random.random(6):
                        asked.append((vertex, distance * np.array([math.cos(angle), math.sin(angle)]), 1))
                        sides.append((k, None))
        for (anchor, offset, side), (k, known), numbers in zip(asked, sides, program(path, asked), strict=True):
            p = exact_sum(anchor, offset)
            if not field.contains(p):
                continue
            assert known is None or field.sign(field.nearest(p, k)) == known, (k, anchor, offset)
            jets = [numbers[j : j + 3] for j in range(0, len(numbers), 3)]
            worst = max(worst, difference(jets, field.evaluate(*p, side)))
    print(f"    largest difference {worst:.1e} of the local size at {len(asked)} places")
    assert worst < 1e-13


def test_earlier_words_are_not_those_of_arcs():
    """Readers of versions before 1.8 know none of the words of cracks and rims with arcs."""
    with h5py.File(curved()) as file:
        ends = [text(end) for end in file["steps/0000/cracks/ends"][()].ravel()]
        kinds = texts(file["domain/holes/kind"])
        assert len(ends) == 6 and all(end.startswith("curved-") for end in ends)
        assert [kind for kind in kinds if kind not in ("circle", "polygon", "outside")] == ["curved-outside", "curved-polygon"]


def test_outside_the_domain_is_nan():
    with h5py.File(files()[0]) as file:
        field = Field(file)
        assert all(math.isnan(v) for jet in field.evaluate(field.max[0] + 1e-9, 0) for v in jet)


def test_holes_are_cut_out_sharply():
    """In the middle of rims and at corners, beside them by 1e-2 … 1e-14."""
    outcomes = set()
    for path in files()[1::2]:
        with h5py.File(path) as file:
            field = Field(file, numbers=Extended)
            random, asked = np.random.default_rng(2), []
            for kind, corners, radius, bulges in field.holes:
                if kind == "circle":
                    angles = random.random(20) * 2 * math.pi
                    anchors = [corners[0] + radius * np.array([math.cos(a), math.sin(a)]) for a in angles]
                else:
                    sides = zip(corners, np.roll(corners, -1, axis=0), bulges)
                    anchors = [*corners, *(middle(*side) for side in sides)]
                for anchor in anchors:
                    for distance in (1e-2, 1e-6, 1e-14):
                        asked.append((anchor, distance * (random.random(2) - 0.5), 1))
            for (anchor, offset, _), numbers in zip(asked, program(path, asked), strict=True):
                p = [field.real(c) for c in exact_sum(anchor, offset)]
                assert math.isnan(numbers[0]) != field.contains(p)
                outcomes.add((float(abs(offset).max()) < 1e-13, math.isnan(numbers[0])))
    assert len(outcomes) == 4


def test_numpy_reads_samples():
    """A grid as NPY: the values are those of the independent reader."""
    path, output = files()[0], FOLDER / "grid.npy"
    asked = ["--grid", "7x5", "--step", "0", "-q", "gradient,if(x > 0, 1, 2)", "-o", output]
    command = programs.ppum("sample", path, *asked)
    done = subprocess.run(command, cwd=ROOT, capture_output=True, text=True)
    assert done.returncode == 0, done.stderr
    grid = np.load(output)
    assert grid.shape == (5, 7)
    assert grid.dtype.names == ("x", "y", "side", "gradient", "if(x > 0, 1, 2)")
    with h5py.File(path) as file:
        field = Field(file)
        for row in grid.reshape(-1):
            x, y = row["x"], row["y"]
            exact = field.quantity("gradient", x, y)
            assert abs(row["gradient"] - exact) <= 1e-9 * abs(exact), (x, y)
            assert row["if(x > 0, 1, 2)"] == (1 if x > 0 else 2)
    assert (grid["x"][0] == grid["x"][4]).all() and (np.diff(grid["y"][:, 0]) > 0).all()


def test_a_file_of_version_1_0_is_read():
    with h5py.File(OLD) as file:
        assert list(file.attrs["format_version"]) == [1, 0]
        assert is_right(file)
        u, opening = Field(file).evaluate(0.3, 0.4)[0], math.sqrt(0.5) * math.sin(math.atan2(4, 3) / 2)
    assert abs(u[0] - (2 + 3 + 5 * opening + 7 * math.sin(-0.6) / 2.15)) < 1e-14
    status, _, message = fixture("same", OLD, OLD)
    assert status == 0, message


def test_the_program_reads_what_h5py_writes():
    """Additions of the user's, and groups from the future; what is changed is noticed."""
    for original in files()[1:3]:
        copy = FOLDER / f"copy-of-{original.name}"
        rewrite(original, copy, "earliest", strings="variable", **LAYOUTS["single"])
        with h5py.File(copy, "a") as target:
            target["user/anything"] = np.array([(1, 2.0)], dtype=[("a", "i4"), ("b", "f8")])
        status, _, message = fixture("same", original, copy)
        assert status == 0, message
        with h5py.File(copy, "a") as target:
            target["steps/0000/from-the-future"] = np.arange(3.0)
            target.attrs["format_version"] = np.array([1, 9], dtype="u4")
            seal(target)
        status, _, message = fixture("same", original, copy)
        assert status == 0, message
        with h5py.File(copy, "a") as target:
            target["steps/0000/partition/half"][3, 1] *= 1 + 1e-15
        status, _, message = fixture("same", original, copy)
        assert status != 0 and "checksum" in message, message
        with h5py.File(copy, "a") as target:
            for group in (target, *target["steps"].values()):
                group.attrs.pop("sha256", None)
            target["steps/0000/partition/half"][3, 1] = math.nan
        status, _, message = fixture("same", original, copy)
        assert status != 0 and "partition/half[3]" in message, message


def test_mistakes_in_formulas_are_named():
    """A copy of a file with one text changed: the program says where, and where in the text."""
    copy = FOLDER / "mistake.h5"
    for group, name, place in [
        ("equation", "young", "equation@young: line 1, column 5: unknown name `z`"),
        ("tables/0000", "name", "no table `curve`"),
        ("steps/0000/partition", "weight_formula", "partition@weight_formula: a weight must vanish"),
    ]:
        copy.write_bytes(files()[1].read_bytes())
        with h5py.File(copy, "a") as file:
            file[group].attrs[name] = {"young": "x + z", "name": "other"}.get(name, "1 + t")
            seal(file)
        status, _, message = fixture("same", copy, copy)
        assert status != 0 and place in message, message


def test_every_layout_of_every_version_of_hdf5_is_read():
    """All ways to store arrays, in files for all versions of HDF5; `same` compares what the program reads."""
    original, seen = files()[2], 0
    for libver in LIBVERS:
        copies = [FOLDER / f"{libver}-{layout}.h5" for layout in LAYOUTS]
        for copy, (layout, how) in zip(copies, LAYOUTS.items()):
            strings = "variable" if layout in ("contiguous", "first", "every") else "fixed"
            rewrite(original, copy, libver, strings=strings, **how)
        status, _, message = fixture("same", original, *copies)
        assert status == 0, (libver, message)
        seen += len(copies)
        for copy in copies:
            copy.unlink()
    print(f"    {seen} files")


def test_chunks_that_are_much_larger_than_the_file_are_read():
    """Chunks of 8 MiB for arrays of a few hundred numbers, which h5py fills up."""
    original, copy = files()[1], FOLDER / "large-chunks.h5"
    rows = lambda shape: ((1 << 20) // math.prod(shape[1:]), *shape[1:])
    huge = {"chunks": rows, "grow": LAYOUTS["first"]["grow"], "least": 400}
    for libver, filters in [("earliest", {}), ("v110", {"shuffle": True}), ("v200", {"fletcher32": True})]:
        rewrite(original, copy, libver, compression="gzip", **filters, **huge)
        with h5py.File(copy) as file:
            large = [v for v in arrays(file) if v.chunks and v.dtype.kind == "f"]
            sizes = [math.prod(v.chunks) * v.dtype.itemsize for v in large]
        assert sum(sizes) > 100 * copy.stat().st_size, sizes
        status, _, message = fixture("same", original, copy)
        assert status == 0, (libver, message)


def arrays(file):
    found = []
    file.visititems(lambda _, node: found.append(node) if isinstance(node, h5py.Dataset) else None)
    return found


def test_the_files_of_the_tests_are_datasets():
    """Those that h5py_files.py makes: as h5py reads them their checksums are right."""
    for path in sorted((DATA / "h5py").iterdir()):
        with h5py.File(path) as file:
            assert is_right(file), path.name


def test_a_series_that_grows():
    """It is a complete file after each step, with one link, with a full header of them, and with two blocks more."""
    path = FOLDER / "series.h5"
    for count in [1, 2, 3, 4, 5, 64, 65, 66, 128, 129, 150]:
        status, _, message = fixture("grow", path, count)
        assert status == 0, message
        with h5py.File(path) as file:
            assert list(file["steps"]) == [f"{k:04}" for k in range(count)]
            assert [group.attrs["load"] for group in file["steps"].values()] == [1 + k for k in range(count)]
            assert is_right(file) and counts_attributes(file), count
    with h5py.File(path) as file:
        # random numbers do not shrink, and are not cut into chunks
        assert file["steps/0003/fields/0000/coefficients"].chunks is None
        assert [file[f"steps/{k:04}/partition/center"].chunks for k in (2, 3)] == [None, (4096, 2)]
    for libver in LIBVERS:
        copy = FOLDER / f"series-{libver}.h5"
        rewrite(path, copy, libver, **LAYOUTS["contiguous"])
        status, _, message = fixture("same", path, copy)
        assert status == 0, (libver, message)
        status, _, message = fixture("grow", copy, 151)
        assert status != 0 and "another program has rewritten it" in message, (libver, message)
    with h5py.File(path, "a") as file:
        file["user/remark"] = "looked at"
    status, _, message = fixture("grow", path, 151)
    assert status == 0, message
    with h5py.File(path) as file:
        assert len(file["steps"]) == 151 and text(file["user/remark"][()]) == "looked at" and is_right(file)
    with h5py.File(path, "a") as file:
        file["steps/0149/fields/0000/coefficients"][0, 0] += 1e-15
        assert not is_right(file)
    status, _, message = fixture("same", path, path)
    assert status != 0 and "`steps/0149@sha256`" in message, message


def test_h5repack_keeps_all():
    if shutil.which("h5repack") is None:
        print("SKIPPED 1 (so far): files of h5repack: it is not installed")
        return
    fixture("grow", FOLDER / "packed.h5", 3)
    for path in [*files(), FOLDER / "packed.h5"]:
        for how in (["-f", "NONE"], ["-l", "CONTI"], ["--low=2", "--high=2"]):
            copy = FOLDER / "repacked.h5"
            subprocess.run(["h5repack", *how, path, copy], check=True)
            status, _, message = fixture("same", path, copy)
            assert status == 0, (how, message)


def test_h5py_reads_long_titles():
    """A text that no header can hold stands in a heap."""
    title = "Übung " * 20_000
    (FOLDER / "long.toml").write_text(LONG.format(title), encoding="utf-8")
    command = programs.ppum("solve", FOLDER / "long.toml", "-o", FOLDER / "long.h5")
    done = subprocess.run(command, cwd=ROOT, capture_output=True, text=True)
    assert done.returncode == 0, done.stderr
    with h5py.File(FOLDER / "long.h5") as file:
        assert text(file.attrs["title"]) == title and is_right(file)


LONG = """title = "{}"
[domain]
min = [0.0, 0.0]
max = [1.0, 1.0]
[equation]
kind = "poisson"
[material]
conductivity = 1.0
[[boundary]]
on = "left"
value = 0.0
[[boundary]]
on = "right"
value = 1.0
[discretization]
level = 1
"""


def test_a_newer_major_version_is_refused():
    copy = FOLDER / "newer.h5"
    copy.write_bytes(files()[0].read_bytes())
    with h5py.File(copy, "a") as target:
        target.attrs["format_version"] = np.array([2, 0], dtype="u4")
    status, _, message = fixture("same", copy, copy)
    assert status != 0 and "2.0" in message and "newer" in message, message


if __name__ == "__main__":
    for name, test in list(globals().items()):
        if name.startswith("test_"):
            test()
            print(f"ok  {name[5:].replace('_', ' ')}")
