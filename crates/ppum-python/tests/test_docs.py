"""The examples of docstrings run as they stand, and those of docs/python.md."""

import doctest
import importlib
import inspect
import os
import pkgutil
import re
import subprocess
import sys

import numpy as np
import ppum
import pytest
from conftest import ROOT

MODULES = [f"ppum.{m.name}" for m in pkgutil.iter_modules(ppum.__path__) if m.name != "_core"]
PAGE = ROOT / "docs/python.md"


def examples(module):
    """Those of a module and of all that it offers; `doctest.testmod` passes over classes that say they are of `ppum`."""
    finder = doctest.DocTestFinder()
    things = {name: getattr(module, name) for name in getattr(module, "__all__", ())}
    things = {name: thing for name, thing in things.items() if not inspect.ismodule(thing)}
    if doc := module.__doc__:
        things[module.__name__] = type("Head", (), {"__doc__": doc})
    return [test for name, thing in things.items() for test in finder.find(thing, name, module=False) if test.examples]


@pytest.mark.parametrize("name", ["ppum", *MODULES])
def test_docstrings(name, ds, f, problem, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    names = {"ppum": ppum, "np": np, "ds": ds, "f": f, "plate": problem.discretization(cells=(8, 16))}
    runner = doctest.DocTestRunner(optionflags=doctest.ELLIPSIS)
    for test in examples(importlib.import_module(name)):
        test.globs = dict(names)
        runner.run(test)
    assert runner.failures == 0


def test_examples_of_methods_are_run():
    modules = [importlib.import_module(f"ppum.{name}") for name in ("field", "drawing", "sampling")]
    names = {test.name for module in modules for test in examples(module)}
    assert {"Field", "Field.at", "Drawing.figure", "Sampling.line", "Field.intensities"} <= names


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
