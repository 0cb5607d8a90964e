"""The examples of docstrings run as they stand, and those of docs/python.md."""

import doctest
import importlib
import os
import re
import subprocess
import sys

import numpy as np
import ppum
import pytest
from conftest import ROOT

PUBLIC = {
    "ppum": [*ppum.__all__, "open"],
    "ppum.build": ppum.build.__all__,
    "ppum.results": ppum.results.__all__,
    "ppum.basis": ppum.basis.__all__,
    "ppum.plots": ppum.plots.__all__,
    "ppum._widget": ["Viewer"],
    **{f"ppum._{name.lower()}": [name] for name in ("Sample", "Draw", "Export", "Compare")},
}
PAGE = ROOT / "docs/python.md"


def kinds(thing):
    """A class and those of the package that it inherits from; else the thing itself."""
    return [kind for kind in thing.__mro__ if kind.__module__.startswith("ppum")] if isinstance(thing, type) else [thing]


def examples(module):
    """Those of a module, of all that it offers, and of what this inherits."""
    public = [getattr(module, name) for name in PUBLIC[module.__name__]]
    things = {kind.__name__: kind for thing in public if callable(thing) for kind in kinds(thing)}
    things["head"] = type("Head", (), {"__doc__": module.__doc__})
    finder = doctest.DocTestFinder()
    return [test for name, thing in things.items() for test in finder.find(thing, name, module=False) if test.examples]


@pytest.mark.parametrize("name", PUBLIC)
def test_docstrings(name, ds, f, problem, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    names = {"ppum": ppum, "np": np, "ds": ds, "f": f, "plate": problem.discretization(cells=(8, 16))}
    runner = doctest.DocTestRunner(optionflags=doctest.ELLIPSIS)
    for test in examples(importlib.import_module(name)):
        test.globs = dict(names)
        runner.run(test)
    assert runner.failures == 0


def test_examples_of_methods_are_run():
    names = {test.name for name in PUBLIC for test in examples(importlib.import_module(name))}
    assert {"Field", "Field.at", "Draw.figure", "Sample.line", "Field.intensities", "Cover.uniform", "open"} <= names


def test_everything_is_documented():
    for name in ppum.__all__:
        thing = getattr(ppum, name)
        if not isinstance(thing, type):
            continue
        ours = [kind for kind in thing.__mro__ if kind.__module__.split(".")[0] == "ppum"]
        for key, member in {key: value for kind in ours for key, value in vars(kind).items()}.items():
            if not key.startswith("_") and (callable(member) or isinstance(member, property)):
                assert member.__doc__, f"{name}.{key}"


def test_the_page_runs(tmp_path):
    """All of the page in one go."""
    blocks = re.findall(r"```python\n(.*?)```", PAGE.read_text(), re.DOTALL)
    assert len(blocks) > 5
    environment = {**os.environ, "MPLBACKEND": "agg"}
    run = [sys.executable, "-c", "\n".join(blocks)]
    done = subprocess.run(run, cwd=tmp_path, capture_output=True, text=True, env=environment)
    assert done.returncode == 0, done.stderr
