"""Compares the independent reader with the program and with extended precision.

    pip install -r tests/python/requirements.txt
    python tests/python/test_reader.py          (from the repository's root; or: pytest tests/python)

Needs cargo: the datasets come from the example `fixture` of `ppum-format`.
"""

import json
import math
import pathlib
import subprocess
import sys
import tempfile

import h5py
import mpmath
import numpy as np

sys.path.insert(0, str(pathlib.Path(__file__).parent))
from ppum_reader import Field, checksum, text

ROOT = pathlib.Path(__file__).parents[2]
COUNT = 6
FOLDER = pathlib.Path(tempfile.mkdtemp(prefix="ppum-"))
mpmath.mp.dps = 40


def fixture(*arguments):
    """Runs the example; its exit status and what it says."""
    command = ["cargo", "run", "-q", "-p", "ppum-format", "--example", "fixture", "--"]
    done = subprocess.run(command + [str(a) for a in arguments], cwd=ROOT, capture_output=True, text=True)
    return done.returncode, done.stdout + done.stderr


def files():
    if not any(FOLDER.iterdir()):
        status, message = fixture("write", FOLDER, COUNT)
        assert status == 0, message
    found = sorted(FOLDER.glob("0*.h5"))
    assert len(found) == COUNT
    return found


def points(field, count=25):
    """Random points, and points close to tips and kinks, all inside the domain."""
    random = np.random.default_rng(1)
    yield from field.min + (field.max - field.min) * random.random((count, 2))
    for crack in field.cracks:
        for vertex in crack:
            for distance in (1e-2, 1e-6):
                angle = random.random() * 2 * math.pi
                point = vertex + distance * np.array([math.cos(angle), math.sin(angle)])
                if (point > field.min).all() and (point < field.max).all():
                    yield point


def scale(jets):
    return max(abs(c) for jet in jets for c in jet)


def test_h5py_reads_and_the_checksum_agrees():
    for path in files():
        with h5py.File(path) as file:
            assert text(file.attrs["format"]) == "ppum"
            assert list(file.attrs["format_version"]) == [1, 0]
            assert text(file.attrs["title"]) == f"Übung {int(path.stem)}"
            assert checksum(file) == text(file.attrs["sha256"])


def test_double_agrees_with_extended_precision():
    worst = 0
    for path in files():
        with h5py.File(path) as file:
            double, exact = Field(file), Field(file, numbers=mpmath)
            for point in points(double):
                a, b = double.evaluate(*point), exact.evaluate(*point)
                difference = max(abs(u - v) for p, q in zip(a, b) for u, v in zip(p, q))
                worst = max(worst, difference / scale(b))
    print(f"    largest difference {float(worst):.1e} of the local scale")
    # the offsets from a tip 1e-6 away keep ten digits in double precision
    assert worst < 1e-9


def test_gradients_are_those_of_the_values():
    for path in files()[:3]:
        with h5py.File(path) as file:
            field, h = Field(file, numbers=mpmath), mpmath.mpf(10) ** -18
            for x, y in list(points(field))[::3]:
                x, y = mpmath.mpf(float(x)), mpmath.mpf(float(y))
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
            field = Field(file, numbers=mpmath)
            for k, crack in enumerate(field.cracks):
                a, b = [tuple(map(mpmath.mpf, map(float, p))) for p in crack[:2]]
                middle = [(u + v) / 2 for u, v in zip(a, b)]
                left = (a[1] - b[1], b[0] - a[0])
                for side in (1, -1):
                    beside = [m + side * mpmath.mpf(10) ** -25 * n for m, n in zip(middle, left)]
                    on, near = field.evaluate(*middle, side), field.evaluate(*beside)
                    difference = max(abs(p[0] - q[0]) for p, q in zip(on, near))
                    assert field.nearest(middle, k) == 0
                    assert difference < 1e-12 * max(1, scale(on))
                above, below = field.evaluate(*middle, 1), field.evaluate(*middle, -1)
                jumps += any(abs(p[0] - q[0]) > 1e-3 for p, q in zip(above, below))
    assert jumps > 0


def test_outside_the_domain_is_nan():
    with h5py.File(files()[0]) as file:
        field = Field(file)
        assert all(math.isnan(v) for jet in field.evaluate(field.max[0] + 1e-9, 0) for v in jet)


def test_the_program_reads_what_h5py_writes():
    """Chunked, compressed, variable-length text, and groups from the future."""
    original, copy = files()[2], FOLDER / "copy.h5"
    with h5py.File(original) as source, h5py.File(copy, "w") as target:
        recreate(source, target)
        target["user/anything"] = np.array([(1, 2.0)], dtype=[("a", "i4"), ("b", "f8")])
    status, message = fixture("same", original, copy)
    assert status == 0, message
    with h5py.File(copy, "a") as target:
        target["steps/0000/from-the-future"] = np.arange(3.0)
        target.attrs["format_version"] = np.array([1, 7], dtype="u4")
        target.attrs["sha256"] = checksum(target)
    status, message = fixture("same", original, copy)
    assert status == 0, message
    with h5py.File(copy, "a") as target:
        target["steps/0000/partition/half"][3, 1] *= 1 + 1e-15
    status, message = fixture("same", original, copy)
    assert status != 0 and "checksum" in message, message
    with h5py.File(copy, "a") as target:
        del target.attrs["sha256"]
        target["steps/0000/partition/half"][3, 1] = math.nan
    status, message = fixture("same", original, copy)
    assert status != 0 and "partition.half[3]" in message, message


def recreate(source, target):
    for name, value in source.attrs.items():
        target.attrs[name] = text(value) if isinstance(value, bytes) else value
    for name, node in source.items():
        if isinstance(node, h5py.Group):
            recreate(node, target.create_group(name))
        elif node.dtype.kind == "S":
            target.create_dataset(name, data=node.asstr()[()], dtype=h5py.string_dtype())
        else:
            packed = {"compression": "gzip", "shuffle": True} if node.size else {}
            target.create_dataset(name, data=node[()], **packed)


def test_the_newest_hdf5_layout_is_refused_with_a_remedy():
    original, copy = files()[2], FOLDER / "latest.h5"
    with h5py.File(original) as source, h5py.File(copy, "w", libver="latest") as target:
        recreate(source, target)
    status, message = fixture("same", original, copy)
    assert status == 0 or "h5repack" in message, message


def test_a_newer_major_version_is_refused():
    copy = FOLDER / "newer.h5"
    copy.write_bytes(files()[0].read_bytes())
    with h5py.File(copy, "a") as target:
        target.attrs["format_version"] = np.array([2, 0], dtype="u4")
    status, message = fixture("same", copy, copy)
    assert status != 0 and "2.0" in message and "newer" in message, message


if __name__ == "__main__":
    for name, test in list(globals().items()):
        if name.startswith("test_"):
            test()
            print(f"ok  {name[5:].replace('_', ' ')}")
