"""Problems: built in Python, from dictionaries or from problem files."""

from __future__ import annotations

import os
import sys
import tomllib
from collections.abc import Callable, Iterable, Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np

from . import _core
from .dataset import Dataset
from .errors import Finding, ProblemError

__all__ = ["Elastic", "Poisson", "Problem", "solve"]

Progress = Callable[[str, int, int, int], object]


@dataclass(frozen=True)
class Elastic:
    """A linear elastic, isotropic material.

    Attributes:
        young: Young's modulus, a stress; a number or a formula of x and y.
        poisson: Poisson's ratio; a number or a formula.
        state: ``plane-strain`` or ``plane-stress``.
    """

    young: float | str
    poisson: float | str
    state: str = "plane-strain"


@dataclass(frozen=True)
class Poisson:
    """The material of Poisson's equation, −∇·(κ ∇u) = f, with the conductivity κ."""

    conductivity: float | str = 1.0


class Problem:
    """A problem, frozen: each call gives a new one.

    What can be said is what problem files can say, by the same names (docs/problem-file.md).

    Example:
        >>> plate = (
        ...     ppum.Problem(
        ...         domain=((-1, -2), (1, 2)),
        ...         material=ppum.Elastic(young=1.0, poisson=0.3),
        ...         title="Slanted crack",
        ...     )
        ...     .crack((-0.3535533906, -0.3535533906), (0.3535533906, 0.3535533906))
        ...     .boundary("bottom", traction=(0, -1))
        ...     .boundary("top", traction=(0, 1))
        ...     .discretization(cells=(8, 16), order=2)
        ... )
        >>> plate.check()
        ()
        >>> plate.crack((2, 2), (3, 3)).check()[0].place
        'crack[1].points'
    """

    def __init__(
        self,
        domain: Iterable[Iterable[float]],
        material: Elastic | Poisson,
        *,
        title: str = "",
    ) -> None:
        low, high = domain
        spec: dict[str, Any] = {"title": title} if title else {}
        spec["domain"] = {"min": low, "max": high}
        if isinstance(material, Poisson):
            spec["equation"] = {"kind": "poisson"}
            spec["material"] = {"conductivity": material.conductivity}
        else:
            spec["material"] = {
                "young": material.young,
                "poisson": material.poisson,
                "state": material.state,
            }
        self._set(_plain(spec), None, "problem", Path())

    def _set(self, spec: dict[str, Any], text: str | None, name: str, folder: Path) -> None:
        self._spec, self._text, self._name, self._folder = spec, text, name, folder

    @classmethod
    def _of(cls, spec: dict[str, Any], text: str | None, name: str, folder: Path) -> Problem:
        problem = cls.__new__(cls)
        problem._set(spec, text, name, folder)
        return problem

    @classmethod
    def read(cls, path: str | os.PathLike[str]) -> Problem:
        """The problem of a file; files that it names are looked for beside it. Mistakes are found by `check` and `solve`.

        Raises:
            OSError: It cannot be read.
            ProblemError: It is no TOML.
        """
        path = Path(path)
        return cls._parse(path.read_text(encoding="utf-8"), str(path), path.parent)

    @classmethod
    def parse(cls, text: str) -> Problem:
        """The problem of a text, as `read`; files that it names are looked for in the working folder."""
        return cls._parse(text, "problem", Path())

    @classmethod
    def _parse(cls, text: str, name: str, folder: Path) -> Problem:
        try:
            spec = tomllib.loads(text)
        except tomllib.TOMLDecodeError as error:
            # the library says it with line and column
            findings = [Finding(**f) for f in _core.check(text, name, folder)]
            if not findings:
                findings = [Finding(name, None, None, str(error))]
            raise ProblemError("\n".join(map(str, findings)), findings) from None
        return cls._of(spec, text, name, folder)

    @classmethod
    def from_dict(cls, spec: Mapping[str, Any]) -> Problem:
        """The problem of a dictionary with the sections and keys of problem files.

        Example:
            >>> ppum.Problem.from_dict(plate.to_dict()) == plate
            True
        """
        return cls._of(_plain(dict(spec)), None, "problem", Path())

    def to_dict(self) -> dict[str, Any]:
        """The problem as a dictionary, a copy."""
        copied: dict[str, Any] = _plain(self._spec)
        return copied

    def to_toml(self) -> str:
        """The text of a problem file."""
        return self._text if self._text is not None else _written(self._spec)[0]

    def crack(self, *points: Iterable[float], **keys: Any) -> Problem:
        """One more crack, through points; or by keys: arc, ellipse, spline, path, segments."""
        return self.add("crack", **({"points": points} if points else {}), **keys)

    def hole(self, **keys: Any) -> Problem:
        """One more hole: center and radius, points, ellipse or spline."""
        return self.add("hole", **keys)

    def boundary(self, on: str | Mapping[str, Any], **keys: Any) -> Problem:
        """One more condition on an edge, a rim or the faces of a crack: displacement, traction, pressure, symmetry; for
        Poisson's equation value, flux."""
        return self.add("boundary", on=on, **keys)

    def quantity(self, name: str, formula: str, unit: str = "") -> Problem:
        """One more quantity with a name."""
        return self.add("quantity", name=name, formula=formula, **({"unit": unit} if unit else {}))

    def discretization(self, **keys: Any) -> Problem:
        """Cells and functions: level, cells, order, overlap, weight, enrichment, accuracy and more. Keys that are given
        already stay, unless they are given anew; what says how many cells there are replaces what said it."""
        old = dict(self._spec.get("discretization", {}))
        sizes = ("level", "cells", "points", "accuracy")
        if any(key in keys for key in sizes):
            old = {key: value for key, value in old.items() if key not in sizes}
        return self.section("discretization", **{**old, **keys})

    def section(self, name: str, /, **keys: Any) -> Problem:
        """The problem with a section of this name, e.g. ``adaptivity``, ``growth``, ``solver``, in place of what it had."""
        return self._with({**self._spec, name: keys})

    def add(self, name: str, /, **keys: Any) -> Problem:
        """The problem with one more section of a kind that there may be several of, e.g. ``refine``, ``table``."""
        return self._with({**self._spec, name: [*self._spec.get(name, ()), keys]})

    def _with(self, spec: dict[str, Any]) -> Problem:
        return self._of(_plain(spec), None, "problem", self._folder)

    def check(self) -> tuple[Finding, ...]:
        """Everything that is wrong; nothing if the problem can be solved as far as its text tells. Findings of problems
        made in Python name keys, those of files lines."""
        if self._text is not None:
            found = _core.check(self._text, self._name, self._folder)
            return tuple(Finding(**f) for f in found)
        text, keys = _written(self._spec)
        return tuple(_of_key(Finding(**f), keys) for f in _core.check(text, "problem", self._folder))

    def solve(self, **options: Any) -> Dataset:
        """Solves the problem, see `ppum.solve`."""
        return solve(self, **options)

    def __eq__(self, other: object) -> bool:
        if not isinstance(other, Problem):
            return NotImplemented
        return self._spec == other._spec and self._folder == other._folder

    def __hash__(self) -> int:
        return hash(_written(self._spec)[0])

    def __reduce__(self) -> tuple[Any, ...]:
        return _again, (self._spec, self._text, self._name, str(self._folder))

    def __repr__(self) -> str:
        title = self._spec.get("title", "")
        cracks = self._spec.get("crack", ())
        return f"<ppum.Problem {title!r}, {len(cracks)} crack{'' if len(cracks) == 1 else 's'}>"


def _again(spec: dict[str, Any], text: str | None, name: str, folder: str) -> Problem:
    return Problem._of(spec, text, name, Path(folder))


def _of_key(finding: Finding, keys: list[str]) -> Finding:
    """The finding with a key in place of the line of a text that nobody wrote."""
    if finding.line is None:
        return finding
    key = keys[min(finding.line, len(keys)) - 1] if keys else finding.place
    return Finding(key, None, None, finding.message)


def _plain(value: Any) -> Any:
    """Values that TOML has; frozen data are copied."""
    if isinstance(value, Mapping):
        return {str(k): _plain(v) for k, v in value.items() if v is not None}
    if isinstance(value, np.ndarray):
        return _plain(value.tolist())
    if isinstance(value, np.generic):
        return value.item()
    if isinstance(value, (bool, int, float, str)):
        return value
    if isinstance(value, os.PathLike):
        return os.fspath(value)
    if isinstance(value, Iterable):
        return [_plain(v) for v in value]
    raise TypeError(f"a problem is made of numbers, texts, lists and dictionaries, not of {type(value)}")


def _written(spec: Mapping[str, Any]) -> tuple[str, list[str]]:
    """The text of a problem file, and the key of each of its lines."""
    lines: list[tuple[str, str]] = []
    for name, value in spec.items():
        if not isinstance(value, dict) and not _is_tables(value):
            lines.append((f"{_key(name)} = {_value(value)}", name))
    for name, value in spec.items():
        if isinstance(value, dict):
            _section(lines, f"[{_key(name)}]", name, value)
        elif _is_tables(value):
            for k, one in enumerate(value):
                _section(lines, f"[[{_key(name)}]]", f"{name}[{k}]", one)
    text = "".join(line + "\n" for line, _ in lines)
    return text, [key for _, key in lines]


def _section(lines: list[tuple[str, str]], head: str, place: str, keys: dict[str, Any]) -> None:
    lines.append((head, place))
    lines.extend((f"{_key(k)} = {_value(v)}", f"{place}.{k}") for k, v in keys.items())


def _is_tables(value: Any) -> bool:
    return isinstance(value, list) and bool(value) and all(isinstance(v, dict) for v in value)


def _key(name: str) -> str:
    plain = name and all(c.isascii() and (c.isalnum() or c in "_-") for c in name)
    return name if plain else _text(name)


def _value(value: Any) -> str:
    if isinstance(value, bool):
        return "true" if value else "false"
    if isinstance(value, (int, float)):
        return repr(value)
    if isinstance(value, str):
        return _text(value)
    if isinstance(value, dict):
        return "{" + ", ".join(f"{_key(k)} = {_value(v)}" for k, v in value.items()) + "}"
    return "[" + ", ".join(_value(v) for v in value) + "]"


_ESCAPES = {'"': '\\"', "\\": "\\\\", "\n": "\\n", "\t": "\\t", "\r": "\\r"}


def _text(text: str) -> str:
    escaped = (
        _ESCAPES.get(c) or (f"\\u{ord(c):04x}" if ord(c) < 32 or ord(c) == 127 else c) for c in text
    )
    return '"' + "".join(escaped) + '"'


def solve(
    problem: Problem | Mapping[str, Any] | str | os.PathLike[str],
    *,
    threads: int | None = None,
    memory: int | None = None,
    progress: bool | Progress = False,
) -> Dataset:
    """Solves a problem; a problem with growing cracks gives a dataset of all steps. Ctrl-C ends it within moments.

    The result depends on the problem alone, not on the number of threads.

    Args:
        problem: A `Problem`, a dictionary as for `Problem.from_dict`, or the path of a problem file.
        threads: How many to work on; by default as many as there are processors, which all calls share.
        memory: Bytes that may be used; a solution that needs more is refused before it begins.
        progress: True for a line on standard error; or a function that is called now and then with the phase, the parts that
            are done, all parts and the step. What it raises ends the solution and is raised.

    Raises:
        ProblemError: Mistakes in the problem, all in `findings`.
        SolveError: What cannot be solved, e.g. loads that nothing holds.
        OSError: A file that cannot be read.
        KeyboardInterrupt: Ctrl-C.

    Example:
        >>> ppum.solve(plate, threads=2).tips[1].k1 > 0.7
        True
    """
    if isinstance(problem, (str, os.PathLike)):
        problem = Problem.read(problem)
    elif not isinstance(problem, Problem):
        problem = Problem.from_dict(problem)
    if threads is not None and threads < 1:
        raise ValueError("threads: one or more")
    told = _Line() if progress is True else progress or None
    text = problem.to_toml()
    try:
        return Dataset(_core.solve(text, problem._name, problem._folder, memory, threads, told))
    except ProblemError as error:
        findings = problem.check() if problem._text is None else ()
        if not findings:
            raise
        raise ProblemError("\n".join(map(str, findings)), list(findings)) from None
    finally:
        if isinstance(told, _Line):
            told.clear()


class _Line:
    """Progress on one line of standard error, which is gone afterwards."""

    def __init__(self) -> None:
        self._width = 0

    def __call__(self, phase: str, done: int, total: int, step: int) -> None:
        of = f" {100 * done // max(total, 1):3d} %" if total > 1 else ""
        text = f"{f'step {step}  ' if step else ''}{phase}{of}"
        sys.stderr.write("\r" + text.ljust(self._width))
        sys.stderr.flush()
        self._width = len(text)

    def clear(self) -> None:
        sys.stderr.write("\r" + " " * self._width + "\r")
        sys.stderr.flush()


for _class in (Elastic, Poisson, Problem):
    _class.__module__ = "ppum"
