"""Datasets from arrays: what is built evaluates as the arrays do, and mistakes are told where they are."""

import itertools
import os
import re
import shutil
import subprocess
import sys

import numpy as np
import ppum
import pytest
from conftest import ROOT

PAGE = ROOT / "docs/writing.md"


def weight(name, s):
    """The weights by their piecewise polynomials."""
    t = np.abs(s)
    pieces = {
        "linear": 1 - t,
        "quadratic": np.where(t <= 1 / 3, 1 - 3 * t**2, 1.5 * (1 - t) ** 2),
        "cubic": np.where(t <= 1 / 2, 1 - 6 * t**2 + 6 * t**3, 2 * (1 - t) ** 3),
        "(1 - t)^2*(1 + 2*t)": (1 - t) ** 2 * (1 + 2 * t),
    }
    return np.where(t < 1, pieces[name], 0.0)


def polynomial(c, xi, eta):
    degree = int(np.sqrt(2 * len(c))) - 1
    powers = [(d - k, k) for d in range(degree + 1) for k in range(d + 1)]
    return sum(np.multiply.outer(xi**a * eta**b, row) for (a, b), row in zip(powers, c, strict=True))


def evaluated(cover, blocks, functions, x, y):
    """The field of blocks: {name: {patch: (m, c)}}, and the sizes of its parts."""
    total, value, size = np.zeros(len(x)), 0.0, 0.0
    for i, (center, half, origin, scale) in enumerate(zip(cover.center, cover.half, cover.origin, cover.scale)):
        of = weight(cover.weight, (x - center[0]) / half[0]) * weight(cover.weight, (y - center[1]) / half[1])
        total += of
        for name, block in blocks.items():
            if i in block:
                p = polynomial(block[i], (x - origin[0]) / scale[0], (y - origin[1]) / scale[1])
                part = (of * functions[name](x, y))[:, None] * p
                value, size = value + part, size + np.abs(part)
    return value / total[:, None], (size / total[:, None]).max()


def random_cover(rng):
    domain = [rng.uniform(-2, 0, 2), rng.uniform(1, 3, 2)]
    low, size = domain[0], domain[1] - domain[0]
    name = rng.choice(["linear", "quadratic", "cubic", "(1 - t)^2*(1 + 2*t)"])
    overlap = rng.uniform(1.1, 1.9)
    kind = rng.integers(4)
    if kind == 0:
        return ppum.build.Cover.uniform(domain, tuple(rng.integers(2, 6, 2).tolist()), overlap, name)
    if kind == 1:
        return ppum.build.Cover.from_points(domain, low + size * rng.random((9, 2)), overlap, name)
    if kind == 2:
        return ppum.build.Cover(domain, *scattered_boxes(rng, low, size), name)
    grid = ppum.build.Cover.uniform(domain, (4, 3))
    center = grid.center + 0.2 * grid.half * rng.uniform(-1, 1, (12, 2))
    half = grid.half * rng.uniform(1.2, 1.6, (12, 2))
    origin, scale = center + 0.3 * half * rng.uniform(-1, 1, (12, 2)), half * rng.uniform(0.6, 1.5, (12, 2))
    order = rng.permutation(12)
    return ppum.build.Cover(domain, center[order], half[order], name, origin=origin[order], scale=scale[order])


def scattered_boxes(rng, low, size):
    """Centres and half-extents of boxes anywhere that tile nothing: added until each point lies well inside one."""
    step, boxes = 1 / 40, []
    for p in rng.permutation(np.stack(np.meshgrid(*[np.arange(step / 2, 1, step)] * 2), -1).reshape(-1, 2)):
        if not any((abs(p - c) <= 0.95 * h - step).all() for c, h in boxes):
            half = rng.uniform(0.08, 0.35, 2)
            boxes.append((p + 0.4 * half * rng.uniform(-1, 1, 2), half))
    center, half = np.array(boxes).transpose(1, 0, 2)
    return low + size * center, size * half


def random_functions(rng, cover):
    """A straight crack from the left edge, functions of it, in ppum's words and in numpy."""
    (x0, y0), (x1, y1) = cover.domain
    a = np.array([x0, rng.uniform(0.7 * y0 + 0.3 * y1, 0.3 * y0 + 0.7 * y1)])
    b = np.array([rng.uniform(0.5, 0.8) * (x1 - x0) + x0, rng.uniform(0.7 * y0 + 0.3 * y1, 0.3 * y0 + 0.7 * y1)])
    tangent = (b - a) / np.hypot(*(b - a))
    crack = [a, b] if rng.random() < 0.5 else [b, a]
    turn = 1 if crack[0] is a else -1
    end = "last" if turn == 1 else "start"

    def polar(x, y):
        u, v = x - b[0], y - b[1]
        u, v = tangent[0] * u + tangent[1] * v, tangent[0] * v - tangent[1] * u
        return np.hypot(u, v), np.arctan2(v, u)

    shapes = [
        lambda r, t: np.sqrt(r) * np.cos(t / 2),
        lambda r, t: np.sqrt(r) * np.sin(t / 2),
        lambda r, t: np.sqrt(r) * np.sin(t) * np.sin(t / 2),
        lambda r, t: np.sqrt(r) * np.sin(t) * np.cos(t / 2),
    ]
    side = lambda x, y: turn * np.where(tangent[0] * (y - b[1]) - tangent[1] * (x - b[0]) >= 0, 1.0, -1.0)
    theirs = {"across": side, "wave": lambda x, y: np.sin(3 * x) * np.exp(-y)}
    theirs["data"] = lambda x, y: np.interp(x, [-9, 9], [-18.0, 36.0])
    theirs["turned"] = lambda x, y: 2.5 * np.hypot(x - 0.1, y - 0.2) + np.cos(0.3) * (x - 0.1) + np.sin(0.3) * (y - 0.2)
    tips = ppum.build.tip_functions(0, end)
    theirs |= {n: lambda x, y, f=f: f(*polar(x, y)) for n, f in zip(tips, shapes)}
    ours = {
        "across": ppum.build.Jump(0),
        "wave": "sin(3*x)*exp(-y)",
        "data": ppum.build.Formula("table(line, x)"),
        "turned": ppum.build.Formula("k*r + x", origin=(0.1, 0.2), angle=0.3, parameters={"k": 2.5}),
        **tips,
    }
    return crack, ours, theirs | {"one": lambda x, y: np.ones_like(x)}


def random_blocks(rng, cover, functions, components):
    blocks = {"one": {k: rng.normal(size=(size(rng), components)) for k in range(len(cover))}}
    for name in rng.permutation(list(functions))[:5]:
        some = np.flatnonzero(rng.random(len(cover)) < 0.6)
        if len(some):
            blocks[str(name)] = {int(k): rng.normal(size=(size(rng, 3), components)) for k in some}
    return blocks


def size(rng, most=8):
    degree = int(rng.integers(0, most + 1))
    return (degree + 1) * (degree + 2) // 2


TABLE = {"line": ([-9.0, 0.0, 9.0], [-18.0, 9.0, 36.0])}


def random_dataset(seed):
    """A dataset whose fields are compared with numpy while it is made."""
    rng = np.random.default_rng(seed)
    cover = random_cover(rng)
    crack, ours, theirs = random_functions(rng, cover)
    fields, sizes = [], []
    for k in range(2):
        components = int(rng.integers(1, 4))
        blocks = random_blocks(rng, cover, ours, components)
        evaluate = lambda x, y, blocks=blocks: evaluated(cover, blocks, theirs, x, y)[0]
        x, y = (cover.domain[0] + np.ptp(cover.domain, axis=0) * rng.random((200, 2))).T
        sizes.append(evaluated(cover, blocks, theirs, x, y)[1])
        fields.append(ppum.build.Coefficients(f"field {k}", blocks, verify=evaluate, components=[f"v{c}" for c in range(components)]))
    state = ppum.build.State(cover, fields, cracks=[crack], functions=ours)
    return ppum.build.dataset(state, title="Ünicode", tables=TABLE, tolerance=1e-12), state


@pytest.mark.parametrize("seed", range(24))
def test_arrays_evaluate_as_numpy_does(seed, caplog, capsys):
    """`verify` compares both fields with 1e-12 of the largest value; its numbers are in the history."""
    caplog.set_level("INFO", "ppum")
    ds, _ = random_dataset(seed)
    history = ds.steps[0].history
    assert all(0 <= history[f"verified field {k}"] <= 1e-12 for k in range(2))
    assert caplog.text.count("verified: field") == 2 and capsys.readouterr().out == ""
    assert ppum.open(ds.to_bytes()) == ds and ds.equation == "none"


@pytest.mark.parametrize("seed", range(6))
def test_files_evaluate_as_numpy_does(seed, tmp_path):
    """The saved file, read by the independent reader."""
    h5py = pytest.importorskip("h5py")
    pytest.importorskip("mpmath")
    sys.path.insert(0, str(ROOT / "tests/python"))
    from ppum_reader import Field, is_right

    ds, state = random_dataset(100 + seed)
    ds.save(tmp_path / "made.h5")
    rng = np.random.default_rng(seed)
    points = state.cover.domain[0] + np.ptp(state.cover.domain, axis=0) * rng.random((40, 2))
    with h5py.File(tmp_path / "made.h5") as file:
        assert is_right(file)
        for k, given in enumerate(state.fields):
            field = Field(file, 0, k)
            found = np.array([[jet[0] for jet in field.evaluate(*p)] for p in points])
            wanted = given.verify(*points.T)
            assert np.abs(found - wanted).max() <= 1e-12 * np.abs(wanted).max()


def test_the_program_reads_them(tmp_path, program):
    ds, _ = random_dataset(7)
    ds.save(tmp_path / "made.h5")
    program("check", tmp_path / "made.h5")
    told = program("info", tmp_path / "made.h5")
    assert re.search(r"equation\s+none", told)
    assert "v0" in program("probe", tmp_path / "made.h5", "--at", "0.5,0.5")
    program("render", tmp_path / "made.h5", "-o", tmp_path / "made.png")


def test_boxes_that_do_not_tile(tmp_path, program, capsys):
    """Without cells there are values, pictures and all facts; what needs cells says so."""
    rng = np.random.default_rng(3)
    cover = ppum.build.Cover(domain(), *scattered_boxes(rng, np.zeros(2), np.array([2, 1])), "quadratic")
    assert cover.cell is None and len(cover) > 20
    blocks = {"one": {k: rng.normal(size=(6, 1)) for k in range(len(cover))}}
    evaluate = lambda x, y: evaluated(cover, blocks, {"one": lambda x, y: np.ones_like(x)}, x, y)[0][:, 0]
    ds = ppum.build.dataset(ppum.build.State(cover, ppum.build.Coefficients("u", blocks, verify=evaluate)), tolerance=1e-12)
    raster = ds.field.draw.render(size=(80, 40))
    x, y = np.meshgrid((np.arange(80) + 0.5) / 40, 1 - (np.arange(40) + 0.5) / 40)
    wanted = evaluate(x.ravel(), y.ravel()).reshape(x.shape)
    assert np.abs(raster - wanted).max() <= 1e-12 * np.abs(wanted).max()
    path = tmp_path / "boxes.h5"
    ds.save(path)
    program("check", path)
    assert "cells" not in program("info", path)
    assert "within" not in program("export", path, "-o", tmp_path / "boxes.vtu"), "all points are within the tolerance"
    assert f"{evaluate(np.array([0.7]), np.array([0.4]))[0]:.6f}"[:8] in program("probe", path, "--at", "0.7,0.4")
    capsys.readouterr()
    ds.field.draw.figure(overlays=["patches", "centers", "cells"]).save(tmp_path / "boxes.png")
    weight = lambda t: np.where(t < 1 / 3, 1 - 3 * t**2, 1.5 * np.maximum(1 - t, 0) ** 2)
    t = np.abs(np.stack([x, y], -1)[:, :, None] - cover.center) / cover.half
    owner = weight(t).prod(axis=-1).argmax(axis=-1)
    mine = ppum.build.State(cover, ppum.build.Coefficients("u", blocks), attributes={"mine": np.arange(len(cover)) ** 2.0})
    assert (ppum.build.dataset(mine).field.draw.render("mine", size=(80, 40)) == owner**2.0).mean() > 0.999, "but for ties"
    with pytest.raises(ppum.PpumError, match="`level` is that of cells, and this cover has none"):
        ds.field.draw.render("level")
    with pytest.raises(ppum.PpumError, match="no cells"):
        ds.field.compare.resample("u", method="cells")


def test_gaps_between_boxes_are_named():
    """A box that is left out leaves a place uncovered, in a hole or not."""
    grid = ppum.build.Cover.uniform(domain(), (8, 4))
    kept = np.arange(32) != 18
    cover = ppum.build.Cover(domain(), grid.center[kept], grid.half[kept])
    make = lambda radius: ppum.build.dataset(
        ppum.build.State(cover, field({"one": np.ones((31, 1))})), holes=[ppum.Hole(tuple(grid.center[18]), radius, None)]
    )
    assert np.isnan(float(make(0.2).field.at(*grid.center[18]).u))
    with pytest.raises(ppum.BuildError, match=r"half.*no support holds"):
        make(0.05)


def domain():
    return [(0, 0), (2, 1)]


def smooth(weight="quadratic", **changes):
    """A field of degree 2 on 8 × 4 patches and its evaluation in numpy, which changes do not touch."""
    rng = np.random.default_rng(5)
    cover = ppum.build.Cover.uniform(domain(), (8, 4), 1.5, "quadratic")
    c = rng.normal(size=(32, 6))
    reference = lambda x, y: evaluated(cover, {"one": dict(enumerate(c[:, :, None]))}, {"one": lambda x, y: 1 + 0 * x}, x, y)[0][:, 0]
    other = ppum.build.Cover(cover.domain, **{**dict(center=cover.center, half=cover.half, weight=weight, cell=cover.cell), **changes})
    return other, c, reference


def test_no_wrong_order_passes():
    """Each exchange of two coefficients, of patches, another frame, weight, sign."""
    cover, c, reference = smooth()
    make = lambda cover, c: ppum.build.dataset(ppum.build.State(cover, ppum.build.Coefficients("u", {"one": c}, verify=reference)))
    assert make(cover, c).history["verified u"] < 1e-14
    wrong = []
    for a, b in itertools.combinations(range(6), 2):
        changed = c.copy()
        changed[:, [a, b]] = c[:, [b, a]]
        wrong.append((cover, changed))
    changed = c.copy()
    changed[[3, 4]] = c[[4, 3]]
    wrong += [(cover, changed), (cover, -c), (cover, c + np.eye(6)[5] * 1e-8)]
    wrong += [(smooth("cubic")[0], c), (smooth(origin=cover.center + 1e-6)[0], c), (smooth(scale=cover.half / 2)[0], c)]
    for case in wrong:
        with pytest.raises(ppum.BuildError, match=r"fields\['u'\].verify: at .*order of the coefficients"):
            make(*case)


def test_sides_of_cracks_are_compared():
    """A jump that is wrong on one side alone, within a millionth of the crack, is seen."""
    cover, c, reference = smooth()
    crack = [(0.5, 0.5), (1.5, 0.6)]
    at = lambda x, y: np.where(np.abs(y - 0.5 - (x - 0.5) / 10) < 1e-6, 9.0, 0.0) * (x > 0.5) * (x < 1.5) * (y > 0.5 + (x - 0.5) / 10)
    make = lambda verify: ppum.build.State(cover, ppum.build.Coefficients("u", {"one": c}, verify=verify), cracks=[crack])
    ppum.build.dataset(make(reference))
    with pytest.raises(ppum.BuildError, match="verify"):
        ppum.build.dataset(make(lambda x, y: reference(x, y) + at(x, y)))


def test_points_and_values_verify():
    cover, c, reference = smooth()
    points = np.random.default_rng(0).random((50, 2))
    make = lambda *verify: ppum.build.dataset(ppum.build.State(cover, ppum.build.Coefficients("u", {"one": c}, verify=verify)))
    assert make(points, reference(*points.T)).history["verified u"] < 1e-14
    for bad, said in (
        ((points, np.zeros(50) + 1), "a difference of"),
        ((points, np.zeros(49)), r"shape \(49,\)"),
        ((points + 5, np.zeros(50)), r"verify\[0\]: the field has no value"),
        ((points[0], np.zeros(1)), r"expected \(k, 2\)"),
        ((points, np.full(50, np.nan)), "finite"),
    ):
        with pytest.raises(ppum.BuildError, match=said):
            make(*bad)


def field(blocks, name="u", **others):
    return ppum.build.Coefficients(name, blocks, **others)


def state(blocks=None, **others):
    cover = ppum.build.Cover.uniform(domain(), (4, 2))
    return ppum.build.State(cover, field({"one": np.zeros((8, 3))} if blocks is None else blocks), **others)


ONE = np.zeros((8, 3))
HOLED = ONE.copy()
HOLED[5, 2] = np.nan
LINE = [(0, 0.5), (1, 0.5)]
GIVEN = dict(center=[(0.5, 0.5), (1.5, 0.5)], half=[(0.7, 0.7), (0.7, 0.7)])
CELLS = [(0, 0, 1, 1), (1, 0, 2, 1)]
MISTAKES = {
    "length": (lambda: state({"one": ONE[:7]}), r"fields\['u'\].blocks\['one'\]: has the shape \(7, 3\), expected \(8, m\)"),
    "number": (lambda: state({"one": ONE[:, :2]}), r"\['one'\]: has 2 coefficients.* here 1 or 3: fill up with zeros"),
    "degree": (lambda: state({"one": np.zeros((8, 55))}), r"has 55 coefficients.*at most 8"),
    "finite": (lambda: state({"one": HOLED}), r"\['one'\]: coefficient 2 on patch 5 is nan; give finite"),
    "ragged": (lambda: state({"one": {3: [1, 2, np.inf]}}), r"coefficient 2 on patch 3 is inf"),
    "patch": (lambda: state({"one": {8: [1.0]}}), r"\['one'\]\[8\]: there is no such patch; the cover has 8"),
    "list": (lambda: state({"one": [[1.0]] * 7}), r"has 7 entries, but the cover has 8"),
    "none": (lambda: state({"one": {}}), r"no coefficients on any patch; leave it out"),
    "numbers": (lambda: state({"one": {0: ["a"]}}), r"\['one'\]\[0\]: has texts; convert them"),
    "components": (lambda: state({"one": {0: [[1.0, 2.0]], 1: [[1.0]]}}), r"\[1\]: has 1 components, patch 0 2"),
    "differ": (lambda: state({"one": ONE, "f": np.zeros((8, 1, 2))}, functions={"f": "x"}), r"differ in the number of components"),
    "function": (lambda: state({"jmp": ONE}, functions={"jump": "x"}), r"\['jmp'\]: is no function of the state; did you mean `jump`"),
    "empty": (lambda: state({}), r"blocks: is empty"),
    "names": (lambda: ppum.build.State(ppum.build.Cover.uniform(domain(), (4, 2)), field({"one": ONE}, components=["a", "b"])), r"components: has 2 names, but"),
    "fields": (lambda: ppum.build.State(ppum.build.Cover.uniform(domain(), (4, 2)), []), r"fields: a step needs at least one"),
    "one": (lambda: state(functions={"one": "x"}), r"functions\['one'\]: is the function 1 already"),
    "kind": (lambda: state(functions={"f": 3}), r"functions\['f'\]: is int; give a Jump"),
    "crack": (lambda: state(functions={"f": ppum.build.Jump(1)}, cracks=[LINE]), r"\['f'\]: names crack 1, but there is 1 crack, counted from 0"),
    "tip": (lambda: state(functions={"f": ppum.build.Formula("r", (0, "first"))}, cracks=[LINE]), r"tip: \(0, 'first'\) is no tip; give the number of a crack, and 'start' or 'end'"),
    "frames": (lambda: state(functions={"f": ppum.build.Formula("r", (0, "last"), angle=1)}, cracks=[LINE]), r"has several frames"),
    "origin": (lambda: state(functions={"f": ppum.build.Formula("r", origin=(1, 2, 3))}), r"origin: has the shape \(3,\), expected \(2,\)"),
    "segment": (lambda: state(functions={"f": ppum.build.Component([(0, 1, -1, -2)])}, cracks=[LINE]), r"cuts\[0\]: names segment 1, but crack 0 has 1"),
    "cut": (lambda: state(functions={"f": ppum.build.Component([(0, 0, 5, -2)])}, cracks=[LINE]), r"functions\['f'\].cuts\[0\]\[2\]: index 5"),
    "formula": (lambda: state(functions={"f": "sin(z)"}), r"^functions\['f'\].text: line 1, column 5: unknown name `z`"),
    "short": (lambda: state(cracks=[[(0, 0)]]), r"cracks\[0\]: has 1 points; a crack needs two"),
    "double": (lambda: state(cracks=[[(0, 0), (1, 1), (1, 1)]]), r"cracks\[0\]\[2\]: is the point before it"),
    "flat": (lambda: state(cracks=[[0, 0, 1, 1]]), r"cracks\[0\]: has the shape \(4,\), expected \(n, 2\)"),
    "attribute": (lambda: state(attributes={"mine": [1, 2]}), r"attributes\['mine'\]: has the shape \(2,\), expected \(8,\)"),
    "domain": (lambda: ppum.build.Cover([(0, 0), (0, 1)], **GIVEN), r"domain: .* has no area"),
    "support": (lambda: ppum.build.Cover(domain(), GIVEN["center"], [(0.7, 0.7), (0.7, 0)]), r"half\[1\]: the extent 0.0 in y must be positive"),
    "halves": (lambda: ppum.build.Cover(domain(), GIVEN["center"], [(0.7, 0.7)]), r"half: has the shape \(1, 2\), expected \(2, 2\)"),
    "outside": (lambda: ppum.build.Cover(domain(), [(0.5, 0.5), (4, 4)], GIVEN["half"]), r"center\[1\]: the support around \(4.0, 4.0\) lies outside"),
    "nan": (lambda: ppum.build.Cover(domain(), [(0.5, np.nan), (1, 1)], GIVEN["half"]), r"center\[0\]\[1\]: is nan"),
    "overlap": (lambda: ppum.build.Cover.uniform(domain(), (4, 2), 2.5), r"overlap: 2.5 is not in 1.01 to 1.99"),
    "cells": (lambda: ppum.build.Cover.uniform(domain(), (0, 2)), r"cells: \(0, 2\) has no cells"),
    "huge": (lambda: ppum.build.Cover.uniform(domain(), (200_000, 200_000)), r"cells: .* are 40,000,000,000 patches, of at most"),
    "level": (lambda: ppum.build.Cover(domain(), **GIVEN, level=1), r"level: is that of cells; give the cells too"),
    "flipped": (lambda: ppum.build.Cover.uniform([(1, 1), (0, 2)], (1, 1)), r"domain: .*give the lower left corner first"),
    "legendre": (lambda: ppum.basis.legendre(500), r"degree: is 500, expected 0 to 8"),
    "bernstein": (lambda: ppum.basis.bernstein(500), r"degree: is 500, expected 0 to 8"),
    "lagrange": (lambda: ppum.basis.lagrange(np.arange(200.0)), r"degree: is 199, expected 0 to 8"),
    "monomials": (lambda: ppum.basis.monomials(-1), r"degree: is -1, expected 0 to 8"),
    "points": (lambda: ppum.build.Cover.from_points(domain(), [(3, 3)]), r"points: .*outside"),
    "level": (lambda: ppum.build.Cover(domain(), level=[0.5, 1], cell=CELLS, **GIVEN), r"level\[0\]: is 0.5; give whole numbers"),
    "level alone": (lambda: ppum.build.Cover(domain(), level=[0, 1], **GIVEN), r"level: is that of cells; give the cells too"),
    "gap": (lambda: ppum.build.State(ppum.build.Cover(domain(), GIVEN["center"], [(0.4, 0.7)] * 2), field({"one": ONE[:2]})), r"^cover(\.\w+)?(\[\d+\])*: "),
    "weight": (lambda: ppum.build.State(ppum.build.Cover(domain(), weight="1 - t/2", **GIVEN), field({"one": ONE[:2]})), r"^cover.weight: .*vanish"),
    "text": (lambda: state(attributes={"a\0b": np.zeros(8)}), r"^attributes\['a.*b'\]: .* NUL"),
}  # fmt: skip


@pytest.mark.parametrize("name", MISTAKES)
def test_mistakes(name):
    make, said = MISTAKES[name]
    with pytest.raises(ppum.BuildError, match=said) as error:
        ppum.build.dataset(make())
    assert isinstance(error.value, ValueError) and isinstance(error.value, ppum.PpumError)


@pytest.mark.parametrize(
    ("options", "said"),
    [
        (dict(equation=ppum.Poisson(1.0)), r"fields\['u'\]: is the first field, which the equation calls 'potential'"),
        (dict(quantities={"q": "v + 1"}), r"quantities.*v"),
        (dict(tables={"t": ([0, 1],)}), r"tables\['t'\]: has 1 arrays; give \(x, values\)"),
        (dict(tables={"t": ([0, 0], [1, 2])}), r"^tables\['t'\].x: .*knot 1"),
        (dict(holes=[ppum.Hole(None, 1.0, None)]), r"holes\[0\]: has neither points nor a center"),
        (dict(holes=[ppum.Hole((1, 0.5), -1.0, None)]), r"^holes\[0\].radius: "),
    ],
)
def test_mistakes_of_datasets(options, said):
    with pytest.raises(ppum.BuildError, match=said):
        ppum.build.dataset(state(), **options)
    with pytest.raises(ppum.BuildError, match="at least one step"):
        ppum.build.dataset([])
    other = ppum.build.State(ppum.build.Cover.uniform([(0, 0), (1, 1)], (4, 2)), field({"one": ONE}))
    with pytest.raises(ppum.BuildError, match=r"states\[1\].cover.domain"):
        ppum.build.dataset([state(), other])


def test_all_that_a_dataset_holds(tmp_path):
    """Series, holes, tables, quantities, attributes, ends of cracks, an equation."""
    cover = ppum.build.Cover.uniform([(0, 0), (2, 2)], (4, 4), weight="cubic")
    c = np.zeros((16, 3, 2))
    c[:, 0], c[:, 1, 0], c[:, 2, 1] = np.column_stack([cover.center[:, 0], 0 * cover.center[:, 1]]), cover.half[:, 0], 0
    cracks = [[(0, 1), (0.9, 1)], [(0.5, 1), (0.5, 1.8)], [(1.2, 0.5), (1.5, 0.5), (1.6, 0.3)]]
    make = lambda load: ppum.build.State(
        cover,
        [ppum.build.Coefficients("displacement", {"one": load * c}, exact=(f"{load}*x", "0")), ppum.build.Coefficients("t", {"one": c[:, :, 0]})],
        cracks=cracks, load=load, attributes={"mine": np.arange(16.0)},
    )  # fmt: skip
    hole = ppum.Hole((1.6, 0.1), 0.2, None)
    polygon = ppum.Hole(None, None, np.array([(1.5, 1.5), (1.8, 1.5), (1.6, 1.8)]))
    ds = ppum.build.dataset(
        [make(1.0), make(2.0)], title="All", program="mine 1", holes=[hole, polygon],
        equation=ppum.Elastic("1 + table(stiff, x)", 0.25, "plane-stress"),
        tables={"stiff": ([0, 2], [0, 0.0]), "plane": ([0, 1], [0, 1, 2], np.zeros((3, 2)))},
        quantities={"twice": "2*ux", "pull": ("sxx/2", "MPa")},
    )  # fmt: skip
    assert [step.load for step in ds.steps] == [1.0, 2.0] and ds.program == "mine 1" and len(ds.holes) == 2
    assert [crack.ends for crack in ds.cracks] == [("mouth", "tip"), ("junction", "tip"), ("tip", "mouth")]
    assert float(ds.field.at(0.7, 0.3)["pull"]) == pytest.approx(1 / (1 - 0.0625), abs=1e-13)
    assert float(ds.steps[0].field.at(0.7, 0.3)["twice"]) == pytest.approx(1.4, abs=1e-14)
    assert float(ds.field.at(0.7, 0.3)["error"]) < 1e-14 and np.isnan(float(ds.field.at(1.6, 1.6).ux))
    assert ds.steps[1].attributes["mine"].tolist() == list(range(16))
    given = [ppum.Crack(0, np.array(cracks[0], float), ("tip", "tip"))]
    explicit = ppum.build.State(cover, ppum.build.Coefficients("u", {"one": c[:, :, 0]}), cracks=given)
    assert ppum.build.dataset(explicit).cracks[0].ends == ("tip", "tip")


def test_given_strains_are_taken_off():
    cover = ppum.build.Cover.uniform([(0, 0), (2, 2)], (4, 4))
    fields = [ppum.build.Coefficients("displacement", {"one": np.zeros((16, 1, 2))})]
    material = ppum.Elastic(2.0, 0.25, "plane-strain", eigenstrain=("x", "x", 0.0, "x"))
    ds = ppum.build.dataset(ppum.build.State(cover, fields), equation=material)
    # all three held: −E ε⁰/(1 − 2ν)
    assert float(ds.field.at(0.7, 0.3)["sxx"]) == pytest.approx(-2.0 * 0.7 / 0.5, rel=1e-14)
    assert float(ds.field.at(0.7, 0.3)["szz"]) == pytest.approx(-2.0 * 0.7 / 0.5, rel=1e-14)
    swollen = ppum.Elastic(2.0, 0.25, "plane-strain", eigenstrain=(0.7, 0.7, 0.0, 0.7))
    held = ppum.Problem(((0, 0), (2, 2)), swollen).discretization(cells=(2, 2), order=1)
    for edge in ("left", "right", "bottom", "top"):
        held = held.boundary(edge, displacement=[0, 0])
    assert float(ppum.solve(held).field.at(0.7, 0.3)["sxx"]) == pytest.approx(-2.0 * 0.7 / 0.5, rel=1e-12)


def linear(cover, rows):
    """The displacement whose components have the gradients `rows`, as coefficients of a cover."""
    blocks = np.zeros((len(cover), 3, 2))
    rows = np.array(rows)
    blocks[:, 0] = cover.center @ rows.T
    blocks[:, 1:] = (cover.half[:, None, :] * rows).transpose(0, 2, 1)
    return ppum.build.Coefficients("displacement", {"one": blocks})


def test_bodies_of_revolution(tmp_path):
    cover = ppum.build.Cover.uniform([(0, 0), (2, 2)], (4, 4))
    state = ppum.build.State(cover, linear(cover, [[0.3, 0.0], [0.1, 0.2]]))
    material = ppum.Elastic(2.0, 0.25, "axisymmetric", eigenstrain=(0.0, 0.0, 0.0, "0.1*x"))
    ppum.build.dataset(state, equation=material).save(tmp_path / "cone.h5")
    mu, lame = 0.8, 0.8
    for x in (1e-9, 0.7, 1.9):
        at = ppum.open(tmp_path / "cone.h5").field.at(x, 0.3)
        hoop = 0.3 - 0.1 * x
        exact = {"ux": 0.3 * x, "ehoop": 0.3, "shoop": 2 * mu * hoop + lame * (0.5 + hoop), "sxy": mu * 0.1, "divergence": 0.8}
        exact["syy"] = 2 * mu * 0.2 + lame * (0.5 + hoop)
        assert {name: float(at[name]) for name in exact} == pytest.approx(exact, rel=1e-6 if x < 1e-6 else 1e-13)
    # the names of its stresses are those of the equation's components alone
    c = np.zeros((16, 1, 2))
    other = ppum.build.State(cover, ppum.build.Coefficients("displacement", {"one": c}, components=("radial", "axial")))
    assert "shoop" not in ppum.build.dataset(other, equation=ppum.Elastic(2.0, 0.25, "axisymmetric")).field.quantities


def test_solved_bodies_of_revolution_have_the_stresses_of_lame():
    body = ppum.Problem(((1, 0), (2, 1)), ppum.Elastic(1.0, 0.3, "axisymmetric")).boundary("left", pressure=1.0)
    for edge in ("bottom", "top"):
        body = body.boundary(edge, symmetry=True)
    field = ppum.solve(body.discretization(level=3, order=8)).field
    x = np.linspace(1, 2, 7)
    a, b = 1 / 3, 4 / 3
    exact = {"ux": 1.3 * (0.4 * a * x + b / x), "ehoop": 1.3 * (0.4 * a + b / x**2), "shoop": a + b / x**2}
    for name, values in exact.items():
        assert np.asarray(field.at(x, 0.4)[name]) == pytest.approx(values, abs=2e-9), name


@pytest.mark.parametrize("state", ["plane-stress", "plane-strain"])
def test_anisotropic_bodies_are_those_of_problems(state):
    s = 3 if state == "plane-strain" else 2
    young, poisson = (144.8, 11.7, 12.5)[:s], (0.21, 0.3, 0.25)[: 2 * s - 3]
    ply = ppum.Anisotropic(young, poisson, 9.66, axis=30.0, state=state, eigenstrain=(0.01, 0.02, -0.03, 0.04))
    cover = ppum.build.Cover.uniform([(0, 0), (2, 2)], (4, 4))
    at = ppum.build.dataset(ppum.build.State(cover, linear(cover, [[0.3, 0.0], [0.1, 0.2]])), equation=ply).field.at(0.7, 0.3)
    stresses = ("sxx", "syy", "sxy", "szz")
    built = [float(at[name]) for name in stresses]
    # the compliance in space, turned
    ratios = dict(zip(((0, 1), (0, 2), (1, 2)), (*poisson, 0.0, 0.0)[:3]))
    compliance = np.diag([1 / e for e in (*young, 1.0)[:3]])
    for (i, j), ratio in ratios.items():
        compliance[i, j] = compliance[j, i] = -ratio / young[i]
    c, s = np.cos(np.pi / 6), np.sin(np.pi / 6)
    turn = np.array([[c, s, 0], [-s, c, 0], [0, 0, 1]])
    strain = np.array([[0.29, 0.08, 0], [0.08, 0.18, 0], [0, 0, -0.04]])
    along = turn @ strain @ turn.T
    if state == "plane-strain":
        normal = np.linalg.solve(compliance, np.diag(along))
    else:
        normal = np.append(np.linalg.solve(compliance[:2, :2], np.diag(along)[:2]), 0.0)
    stress = turn.T @ (np.diag(normal) + 2 * 9.66 * (along - np.diag(np.diag(along)))) @ turn
    assert built == pytest.approx([stress[0, 0], stress[1, 1], stress[0, 1], stress[2, 2]], rel=1e-12)
    held = ppum.Problem(((0, 0), (2, 2)), ply).discretization(cells=(2, 2), order=1)
    for edge in ("left", "right", "bottom", "top"):
        held = held.boundary(edge, displacement=["0.3*x", "0.1*x + 0.2*y"])
    solved = ppum.solve(held).field.at(0.7, 0.3)
    assert built == pytest.approx([float(solved[name]) for name in stresses], rel=1e-10)


@pytest.mark.parametrize(
    "material, said",
    [
        (ppum.Anisotropic((2.0, 1.0), (0.2,), 1.0), "equation.young: has 2 entries; give 3"),
        (ppum.Anisotropic((2.0, 1.0), (0.2,), None, state="plane-stress"), "equation.shear: is None"),
        (ppum.Anisotropic((2.0, 1.0), (0.2,), 1.0, state="plane-stress", expansion=1.0), "have no temperature"),
        (ppum.Anisotropic(stiffness=((2, 1, 0), (0, 2, 0), (0, 0, 1)), state="plane-stress"), "is not symmetric"),
        (ppum.Anisotropic(stiffness=((1, 2, 0), (2, 1, 0), (0, 0, 1)), state="plane-stress"), "makes the stiffness indefinite"),
        (ppum.Anisotropic(stiffness=((2, 1, 0), (1, 2, 0), (0, 0, 1))), "equation.out_of_plane: is NoneType"),
        (ppum.Anisotropic((2.0, 1.0, 1.0), (0.2, 0.1, 0.1), 1.0, state="axisymmetric"), "anisotropic bodies are plane"),
    ],
)
def test_anisotropic_materials_that_are_none(material, said):
    cover = ppum.build.Cover.uniform([(0, 0), (2, 2)], (2, 2))
    with pytest.raises(ppum.BuildError, match=re.escape(said)):
        ppum.build.dataset(ppum.build.State(cover, linear(cover, np.eye(2))), equation=material)


def test_temperatures_are_components(tmp_path):
    cover = ppum.build.Cover.uniform([(0, 0), (2, 2)], (4, 4))
    rng = np.random.default_rng(5)
    blocks = {"one": rng.normal(size=(16, 3, 3))}
    material = ppum.Elastic(2.0, 0.25, "plane-stress", expansion="0.5 + x", eigenstrain=(0.1, "y", 0.0, 0.0))
    ds = ppum.build.dataset(ppum.build.State(cover, ppum.build.Coefficients("displacement", blocks)), equation=material)
    assert ds.field.components == ("ux", "uy", "temperature")
    ds.save(tmp_path / "heated.h5")
    at = ppum.open(tmp_path / "heated.h5").field.at(0.7, 0.3)
    names = ("exx", "eyy", "temperature", "sxx", "eigenstrain_xx", "eigenstrain_yy")
    exx, eyy, t, sxx, xx, yy = (float(at[name]) for name in names)
    assert [xx, yy] == pytest.approx([0.1 + 1.2 * t, 0.3 + 1.2 * t], rel=1e-14)
    assert sxx == pytest.approx(2.0 / (1 - 0.0625) * (exx - xx + 0.25 * (eyy - yy)), rel=1e-12)
    plain = ppum.Elastic(2.0, 0.25, expansion=1e-5)
    only = ppum.build.dataset(ppum.build.State(cover, ppum.build.Coefficients("displacement", blocks)), equation=plain)
    assert float(only.field.at(0.7, 0.3)["eigenstrain_xy"]) == 0.0
    with pytest.raises(ppum.BuildError, match="temperature"):
        ppum.build.dataset(ppum.build.State(cover, ppum.build.Coefficients("displacement", {"one": np.zeros((16, 1, 2))})), equation=plain)


def test_outlines_are_holes_outside_of_a_polygon(tmp_path):
    cover = ppum.build.Cover.uniform([(0, 0), (2, 2)], (4, 4))
    outline = np.array([(0.1, 0.2), (1.9, 0.3), (1.0, 1.8)])
    state = ppum.build.State(cover, ppum.build.Coefficients("u", {"one": np.ones((16, 1))}))
    ds = ppum.build.dataset(state, holes=[ppum.Hole((1.0, 0.7), 0.2, None), ppum.Hole(None, None, outline, True)])
    assert [hole.is_outside for hole in ds.holes] == [False, True]
    values = ds.field.at([0.5, 1.0, 1.0, 0.3], [0.4, 0.7, 1.7, 1.5])["u"]
    assert np.isnan(values).tolist() == [False, True, False, True]
    ds.save(tmp_path / "outline.h5")
    assert (ppum.open(tmp_path / "outline.h5").holes[1].points == outline).all()
    plate = ppum.Problem(domain={"outline": {"points": outline}}, material=ppum.Elastic(1.0, 0.3, "plane-stress"))
    pressed = plate.boundary("outline", pressure=2.0).discretization(level=3).solve()
    assert float(pressed.field.at(1.0, 0.7)["sxx"]) == pytest.approx(-2.0, abs=1e-9)


def arc(radius, center, angles):
    """Ends and bulge of an arc of a circle."""
    ends = np.asarray(center) + radius * np.column_stack([np.cos(angles), np.sin(angles)])
    return ends, np.array([np.tan((angles[1] - angles[0]) / 4)])


def test_cracks_and_rims_may_be_arcs(tmp_path):
    """The side of an arc is that of its circle; a round hole of two arcs is a circle; ends on arcs are found."""
    cover, center, radius = ppum.build.Cover.uniform([(0, 0), (2, 2)], (4, 4)), np.array((1.0, 1.1)), 0.6
    points, bulges = arc(radius, center, np.radians((200, 350)))
    disc = ppum.Hole(points=np.array([(0.2, 0.3), (0.5, 0.3)]), bulges=np.ones(2))
    # from the arc to the rim of the disc
    straight = np.array([center + radius * np.array((np.cos(4.0), np.sin(4.0))), np.array((0.35, 0.3)) + 0.15 * np.sqrt([0.5, 0.5])])
    cracks = [ppum.Crack(0, points, ("tip", "tip"), bulges), straight]
    one, zero = np.ones((16, 1)), np.zeros((16, 1))
    # where the support of a patch is cut, beyond the ends the tangents go on
    inside = lambda x, y: np.hypot(x - center[0], y - center[1]) < radius
    near = lambda x, y: np.abs(np.hypot(x - center[0], y - center[1]) - radius) < 1e-6
    verify = lambda x, y: np.where(near(x, y), np.where(inside(x, y), 2.0, 0.0), np.nan)
    make = lambda verify=None: ppum.build.dataset(
        ppum.build.State(
            cover, ppum.build.Coefficients("u", {"one": one, "side": one}, verify=verify),
            cracks=cracks, functions={"side": ppum.build.Jump(0)},
        ),
        holes=[disc],
    )  # fmt: skip
    ds = make()
    curved, line = ds.cracks
    assert curved.ends == ("tip", "tip") and line.ends == ("junction", "mouth") and line.bulges is None
    assert (curved.bulges == bulges).all() and not curved.bulges.flags.writeable
    assert curved.length == pytest.approx(radius * np.radians(150), rel=1e-14)
    assert line.length == pytest.approx(np.hypot(*(straight[1] - straight[0])), rel=1e-14)
    assert repr(curved) == "<ppum.Crack 0, 2 points, 1 arc, tip to tip>"
    assert (ds.holes[0].bulges == 1).all() and (ds.holes[0].points == disc.points).all()
    angles = np.radians(np.linspace(201, 349, 40))
    for offset, value in [(-1e-12, 2.0), (1e-12, 0.0)]:
        x, y = (center + (radius + offset) * np.column_stack([np.cos(angles), np.sin(angles)])).T
        assert np.allclose(ds.field.at(x, y)["u"], value, rtol=0, atol=1e-15), offset
    x, y = np.random.default_rng(3).uniform(0, 0.7, (2, 400))
    assert (np.isnan(ds.field.at(x, y)["u"]) == (np.hypot(x - 0.35, y - 0.3) < 0.15)).all()
    ds.save(tmp_path / "arcs.h5")
    assert ppum.open(tmp_path / "arcs.h5") == ds
    with pytest.raises(ppum.BuildError, match="verify"):
        make(lambda x, y: np.where(near(x, y), np.where(inside(x, y), 0.0, 2.0), ds.field.at(x, y)["u"]))
    make(lambda x, y: np.where(near(x, y) & (y < 0.9), verify(x, y), ds.field.at(x, y)["u"]))


@pytest.mark.parametrize("bulges, message", [
    ([0.1], r"^cracks\[0\].bulges: has the shape \(1,\), expected \(2,\)"),
    ([0.1, np.nan], r"^cracks\[0\].bulges\[1\]: is nan"),
    ([0.1, -70.0], r"^cracks\[0\].bulges\[1\]: is -70, not a number of at most 64: divide the arc"),
])  # fmt: skip
def test_bulges_that_are_none_are_named(bulges, message):
    cover = ppum.build.Cover.uniform([(0, 0), (2, 2)], (4, 4))
    field = ppum.build.Coefficients("u", {"one": np.ones((16, 1))})
    points = np.array([(0.5, 0.5), (1.0, 0.6), (1.5, 0.5)])
    with pytest.raises(ppum.BuildError, match=message):
        ppum.build.dataset(ppum.build.State(cover, field, cracks=[ppum.Crack(0, points, ("tip", "tip"), np.array(bulges))]))
    with pytest.raises(ppum.BuildError, match=r"^holes\[0\].bulges"):
        ppum.build.dataset(ppum.build.State(cover, field), holes=[ppum.Hole((1, 1), 0.1, bulges=np.ones(1))])


def test_forms_of_blocks_are_the_same():
    rng = np.random.default_rng(2)
    c = rng.normal(size=(8, 6))
    make = lambda block: ppum.build.dataset(state({"one": block}))
    same = make(c)
    assert make(list(c)) == same == make({k: row for k, row in reversed(list(enumerate(c)))}) == make(c[:, :, None])
    some = make([None if k == 3 else row for k, row in enumerate(c)])
    assert some == make({k: row for k, row in enumerate(c) if k != 3}) and some.steps[0].unknowns == 42


def test_arrays_by_paths():
    built = ppum.build.dataset(state())
    with pytest.raises(ppum.BuildError) as error:
        ppum.build.from_arrays({"@title": "x", "@program": "y", "equation@kind": "none", "domain@kind": "box", "domain@min": [0, 0], "domain@max": [1, 1], "steps/0000@load": 1.0})
    assert "steps/0000/partition" in str(error.value) and len(str(error.value).splitlines()) > 1
    with pytest.raises(ppum.BuildError, match=r"block_degree\[1\]: is 300, which is no number of the type uint8"):
        ppum.build.from_arrays({"steps/0000/fields/0000/block_degree": [1, 300]})
    with pytest.raises(ppum.BuildError, match="center: is complex; give its .real"):
        ppum.build.from_arrays({"steps/0000/partition/center": [1j]})
    assert built.equation == "none" and set(built.quantities) >= {"u", "du_dx", "magnitude", "gradient"}
    assert not {"energy", "von_mises", "sxx"} & set(built.quantities)


def test_the_page_runs(tmp_path):
    """All of the page in one go; what it writes by hand is what the arrays say."""
    blocks = re.findall(r"```python\n(.*?)```", PAGE.read_text(), re.DOTALL)
    assert len(blocks) == 4
    pytest.importorskip("h5py")
    log = "import logging\nlogging.basicConfig(level=logging.INFO)\n"
    run = [sys.executable, "-c", log + "\n".join(blocks)]
    done = subprocess.run(run, cwd=tmp_path, capture_output=True, text=True, env={**os.environ})
    assert done.returncode == 0, done.stderr
    assert "verified: field 'velocity' at 1000 points" in done.stderr
    written = ppum.open(tmp_path / "written.h5")
    assert float(written.field.at(1.7, 0.2).temperature) == pytest.approx(1.7, abs=1e-14)
    above, below = written.field.at(0.3, 0.5, side="both").temperature
    assert above - below == pytest.approx(0.4, abs=1e-14)
    assert (tmp_path / "opened.png").stat().st_size > 10000


def c_compiler():
    """A compiler with HDF5's library: the command and what follows the source."""
    if shutil.which("h5cc"):
        return ["h5cc"], []
    if shutil.which("cc") and shutil.which("pkg-config"):
        for name in ("hdf5", "hdf5-serial"):
            done = subprocess.run(["pkg-config", "--cflags", "--libs", name], capture_output=True, text=True)
            if done.returncode == 0:
                return ["cc"], done.stdout.split()
    pytest.skip("HDF5's library for C is not here: apt-get install libhdf5-dev")


def test_the_program_in_c_writes_a_dataset(tmp_path, program):
    """The page's program compiles without a warning, and its file has the field that it says."""
    (source,) = re.findall(r"```c\n(.*?)```", PAGE.read_text(), re.DOTALL)
    command, libraries = c_compiler()
    (tmp_path / "write.c").write_text(source)
    run = [*command, "-Wall", "-Wextra", "-Werror", "-o", "write", "write.c", *libraries]
    done = subprocess.run(run, cwd=tmp_path, capture_output=True, text=True)
    assert done.returncode == 0, done.stderr
    assert subprocess.run(["./write"], cwd=tmp_path).returncode == 0
    program("check", tmp_path / "from_c.h5")
    written = ppum.open(tmp_path / "from_c.h5")
    assert float(written.field.at(1.7, 0.2).T) == pytest.approx(1.7, abs=1e-14)
    above, below = written.field.at(0.3, 0.5, side="both").T
    assert above - below == pytest.approx(0.4, abs=1e-14)
