"""The examples of docstrings run as they stand, and those of docs/python.md."""

import doctest
import importlib
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
#: Members that speak for themselves to every Python programmer.
PAGE = ROOT / "docs/python.md"


@pytest.mark.parametrize("name", ["ppum", *MODULES])
def test_docstrings(name, ds, f, problem, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    names = {"ppum": ppum, "np": np, "ds": ds, "f": f, "plate": problem.discretization(cells=(8, 16))}
    failed, _ = doctest.testmod(importlib.import_module(name), extraglobs=names, optionflags=doctest.ELLIPSIS)
    assert failed == 0


def test_everything_is_documented():
    for name in ppum.__all__:
        thing = getattr(ppum, name)
        if not isinstance(thing, type):
            continue
        for key, member in vars(thing).items():
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
