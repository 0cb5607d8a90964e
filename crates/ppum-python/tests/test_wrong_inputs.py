"""Wrong inputs, each argument with each kind of them: a `BuildError` that names the argument and the remedy, never an error
of Python or a cast in silence."""

import re

import numpy as np
import ppum
import pytest

PATCHES = 8
COVER = ppum.build.Cover.uniform([(0, 0), (2, 1)], (4, 2))
ONE = np.ones((PATCHES, 1))
BOXES = {"domain": [(0, 0), (2, 1)], "center": [(0.5, 0.5), (1.5, 0.5)], "half": [(0.7, 0.7), (0.7, 0.7)]}
CELLS = [(0, 0, 1, 1), (1, 0, 2, 1)]
LINE = [(0, 0.5), (1, 0.5)]
CORNERS = [(-0.5, -0.5), (1, -0.5), (-0.5, 1)]

#: What no argument takes, unless it says so.
WRONG = {
    "complex": ONE * 1j,
    "complex list": [1j] * PATCHES,
    "masked": np.ma.array(ONE, mask=np.arange(PATCHES)[:, None] == 3),
    "masked rows": [np.ma.array([1.0], mask=[k == 3]) for k in range(PATCHES)],
    "texts": ONE.astype(str),
    "text rows": [["1"]] * PATCHES,
    "dates": ONE.astype("M8[s]"),
    "objects": np.array([[None]] * PATCHES),
    "ragged": [1, [2, 3]],
    "nan": np.full((PATCHES, 1), np.nan),
    "dictionary": {"a": 1},
    "object": object(),
    "function": lambda x, y: x,
    "number": 3,
    "text": "y y",
    "bytes": b"abc",
    "none": None,
}
NUMBER = {"number"}
DEFAULT = {"none"}


def field(block=ONE, name="u", **more):
    return ppum.build.Coefficients(name, {"one": block}, **more)


def build(fields=None, functions=None, cracks=(LINE,), attributes=None, cover=COVER, load=1.0, **more):
    blocks = {"one": ONE, "f": ONE} if functions else {"one": ONE}
    fields = ppum.build.Coefficients("u", blocks) if fields is None else fields
    state = ppum.build.State(cover, fields, cracks=cracks, functions=functions or {}, attributes=attributes or {}, load=load)
    return ppum.build.dataset(state, **more)


def elastic(**more):
    material = ppum.Elastic(**{"young": 1.0, "poisson": 0.3, **more})
    count = 3 if material.expansion is not None else 2
    return build(field(np.zeros((PATCHES, 1, count)), "displacement"), equation=material)


def element(**more):
    return ppum.build.Mesh(**{"shape": "triangle", "origin": [(0, 0)], "map": [np.eye(2)], **more})


def function(f):
    return build(functions={"f": f})


def covers(name, **more):
    return lambda value: ppum.build.Cover(**BOXES | more | {name: value})


ARRAYS = ppum.build.arrays(ppum.build.State(COVER, field()))
#: By the place that messages name: a call with the argument, and the kinds of WRONG that it takes.
ARGUMENTS = {
    "fields['u'].blocks['one']": (lambda v: build(field(v)), set()),
    "fields['u'].blocks": (lambda v: build(ppum.build.Coefficients("u", v)), set()),
    "fields['u'].components": (lambda v: build(field(components=v)), DEFAULT),
    "fields['u'].components[0]": (lambda v: build(field(components=[v])), set()),
    "fields['u'].exact": (lambda v: build(field(exact=v)), set()),
    "fields['u'].exact[0]": (lambda v: build(field(exact=[v])), set()),
    "fields['u'].unit": (lambda v: build(field(unit=v)), {"text"}),
    "fields['u'].space": (lambda v: build(field(space=v)), set()),
    "fields['u'].verify": (lambda v: build(field(verify=v)), DEFAULT),
    "fields['u'].verify[0]": (lambda v: build(field(verify=(v, [1.0]))), set()),
    "fields['u'].verify ": (lambda v: build(field(verify=([(0.1, 0.1)], v))), set()),
    "fields['u'].verify  ": (lambda v: build(field(verify=lambda x, y: v)), set()),
    "fields.name": (lambda v: build(field(name=v)), {"text"}),
    "fields": (lambda v: build(fields=() if v is None else v), set()),
    "cover": (lambda v: build(cover=v), set()),
    "load": (lambda v: build(load=v), NUMBER),
    "states": (ppum.build.dataset, set()),
    "cracks": (lambda v: build(cracks=v), set()),
    "cracks[0]": (lambda v: build(cracks=[v]), set()),
    "attributes": (lambda v: ppum.build.dataset(ppum.build.State(COVER, field(), attributes=v)), set()),
    "attributes['a']": (lambda v: build(attributes={"a": v}), set()),
    "functions": (lambda v: ppum.build.dataset(ppum.build.State(COVER, field(), functions=v)), set()),
    "functions['f']": (function, set()),
    "functions['f'] ": (lambda v: function(ppum.build.Jump(v)), set()),
    "functions['f'].text": (lambda v: function(ppum.build.Formula(v)), set()),
    "functions['f'].cuts": (lambda v: function(ppum.build.Component(v)), set()),
    "functions['f'].tip": (lambda v: function(ppum.build.Formula("r", tip=v)), DEFAULT),
    "functions['f'].origin": (lambda v: function(ppum.build.Formula("r", origin=v)), DEFAULT),
    "functions['f'].angle": (lambda v: function(ppum.build.Formula("r", angle=v)), NUMBER),
    "functions['f'].levels": (lambda v: function(ppum.build.Formula("r", levels=v)), DEFAULT),
    "functions['f'].parameters": (lambda v: function(ppum.build.Formula("r", parameters=v)), {"dictionary"}),
    "functions['f'].parameters['a']": (lambda v: function(ppum.build.Formula("r", parameters={"a": v})), NUMBER),
    "functions['f'].kinks": (lambda v: function(ppum.build.Formula("r", kinks=v)), set()),
    "functions['f'].singular": (lambda v: function(ppum.build.Formula("r", singular=v)), set()),
    "title": (lambda v: build(title=v), {"text"}),
    "program": (lambda v: build(program=v), {"text"}),
    "tolerance": (lambda v: build(field(verify=lambda x, y: 1 + 0 * x), tolerance=v), NUMBER),
    "equation": (lambda v: build(equation=v), DEFAULT),
    "equation.young": (lambda v: elastic(young=v), NUMBER),
    "equation.poisson": (lambda v: elastic(poisson=v), set()),
    "equation.state": (lambda v: elastic(state=v), set()),
    "equation.expansion": (lambda v: elastic(expansion=v), NUMBER | DEFAULT),
    "equation.eigenstrain": (lambda v: elastic(eigenstrain=v), DEFAULT),
    "equation.conductivity": (lambda v: build(field(name="potential"), equation=ppum.Poisson(v)), NUMBER),
    "holes": (lambda v: build(holes=v), set()),
    "holes[0]": (lambda v: build(holes=[v]), set()),
    "holes[0]    ": (lambda v: build(holes=[ppum.Hole(v, 0.1)]), set()),
    "holes[0]   ": (lambda v: build(holes=[ppum.Hole((1, 0.2), v)]), NUMBER),
    "holes[0]  ": (lambda v: build(holes=[ppum.Hole(points=v)]), set()),
    "tables": (lambda v: build(tables=v), DEFAULT),
    "tables['t']": (lambda v: build(tables={"t": v}), set()),
    "tables['t'].x": (lambda v: build(tables={"t": (v, [1, 2])}), set()),
    "quantities": (lambda v: build(quantities=v), DEFAULT),
    "quantities['q']": (lambda v: build(quantities={"q": v}), set()),
    **{name: (covers(name), set()) for name in ("domain", "center", "half")},
    "weight": (covers("weight"), {"text"}),
    **{name: (covers(name), DEFAULT) for name in ("origin", "scale", "cell")},
    "breakpoints": (covers("breakpoints"), DEFAULT | NUMBER),
    "level": (covers("level", cell=CELLS), DEFAULT | NUMBER),
    "points": (covers("points"), set()),
    "point": (covers("point"), NUMBER),
    "cells": (lambda v: ppum.build.Cover.uniform(BOXES["domain"], v), set()),
    "overlap": (lambda v: ppum.build.Cover.uniform(BOXES["domain"], (2, 2), v), set()),
    "shape": (lambda v: element(shape=v), set()),
    "origin ": (lambda v: element(origin=v), set()),
    "map": (lambda v: element(map=v), set()),
    "map[0]": (lambda v: element(map=[v]), set()),
    "space": (lambda v: element(space=v), set()),
    "element": (lambda v: element(element=v), DEFAULT),
    "clips": (lambda v: element(clips=v), DEFAULT),
    "clips[0]": (lambda v: element(clips={0: v}), set()),
    "nodes": (ppum.build.Mesh.from_nodes, set()),
    "at": (lambda v: ppum.build.Mesh.from_nodes([CORNERS], v), DEFAULT),
    "order": (lambda v: ppum.build.Mesh.lattice("square", v), NUMBER),
    "coefficients": (ppum.basis.legendre(2).convert, set()),
    "degree": (ppum.basis.legendre, NUMBER),
    "order ": (lambda v: ppum.basis.legendre(2, v), set()),
    "interval": (lambda v: ppum.basis.legendre(2, "total", v), set()),
    "nodes ": (ppum.basis.lagrange, NUMBER),
    "function": (lambda v: ppum.basis.fit(COVER, 2, lambda patch, x, y: v), set()),
    "cover ": (lambda v: ppum.basis.fit(v, 1, lambda patch, x, y: x), set()),
    "arrays": (lambda v: ppum.build.from_arrays(ARRAYS if isinstance(v, dict) else v), {"dictionary"}),
    "steps/0000/partition/center": (lambda v: ppum.build.from_arrays(ARRAYS | {"steps/0000/partition/center": v}), set()),
    "end": (lambda v: ppum.build.tip_functions(0, v), set()),
}  # fmt: skip
#: Words of a remedy.
REMEDY = re.compile(r"give|expected|convert|fill|there (is|are)|Look at|but|none of|neither|unknown")


@pytest.mark.filterwarnings("error")
@pytest.mark.parametrize("argument", ARGUMENTS)
def test_wrong_inputs_are_refused(argument, capsys):
    call, taken = ARGUMENTS[argument]
    for kind, value in WRONG.items():
        if kind in taken:
            call(value)
            continue
        with pytest.raises(ppum.BuildError) as error:
            call(value)
            pytest.fail(f"{argument} takes {kind}")
        first = str(error.value).splitlines()[0]
        assert first.startswith(argument.strip()), (kind, first)
        assert REMEDY.search(first) and len(first) < 300, (kind, first)


@pytest.mark.parametrize("seed", range(8))
def test_wrong_places_are_named(seed):
    """One number of random coefficients is wrong: the message names its patch and its coefficient."""
    rng = np.random.default_rng(seed)
    count = int(rng.choice([1, 3, 6, 10]))
    block = rng.normal(size=(PATCHES, count))
    patch, k = int(rng.integers(PATCHES)), int(rng.integers(count))
    for wrong, said in ((np.nan, f"coefficient {k} on patch {patch} is nan"), (np.inf, f"coefficient {k} on patch {patch} is inf")):
        damaged = block.copy()
        damaged[patch, k] = wrong
        for given in (damaged, list(damaged), dict(enumerate(damaged))):
            with pytest.raises(ppum.BuildError, match=re.escape(said)):
                build(field(given))
    mask = np.zeros(block.shape, bool)
    mask[patch, k] = True
    with pytest.raises(ppum.BuildError, match=re.escape(f"['one'][{patch}][{k}]: is masked")):
        build(field(np.ma.array(block, mask=mask)))
    # a mask that hides nothing is none
    assert build(field(np.ma.array(block, mask=False))) == build(field(block))
