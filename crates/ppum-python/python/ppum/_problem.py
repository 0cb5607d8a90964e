"""Problems: built in Python, from dictionaries or from problem files."""

import os
import tomllib
from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any, Unpack

import numpy as np
from numpy.typing import ArrayLike

from . import _core
from ._dataset import Dataset
from ._errors import Diagnostic, ProblemError
from ._options import passes, takes
from ._sections import (
    AdaptivityOptions, BoundaryOptions, CrackOptions, DiscretizationOptions, GrowthOptions, HoleOptions, SolveOptions, SpaceOptions,
)  # fmt: skip
from ._text import ProgressLine, plain, plural, toml_lines


@dataclass(frozen=True)
class Elastic:
    """A linear elastic, isotropic material.

    Attributes:
        young: Young's modulus, a stress; a number or a formula of x and y.
        poisson: Poisson's ratio; a number or a formula.
        state: ``plane-strain`` or ``plane-stress``.
        expansion: Coefficient of thermal expansion, for ``problem.section("temperature", value=…)`` or ``problem="heat.toml"``;
            in `build` for a temperature that is the third component of the field.
        eigenstrain: The given strains ε⁰_xx, ε⁰_yy, ε⁰_xy, ε⁰_zz that make no stress; numbers or formulas.
    """

    young: float | str
    poisson: float | str
    state: str = "plane-strain"
    expansion: float | str | None = None
    eigenstrain: tuple[float | str, float | str, float | str, float | str] | None = None


@dataclass(frozen=True)
class Poisson:
    """The material of Poisson's equation, −∇·(κ ∇u) = f, with the conductivity κ."""

    conductivity: float | str = 1.0


class Problem:
    """A problem, frozen: each call gives a new one.

    Options are the keys of problem files (docs/problem-file.md); `section` and `add` take what has no method of its own.

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
        self, domain: Iterable[Iterable[float]] | Mapping[str, Any], material: Elastic | Poisson, *, title: str = ""
    ) -> None:
        if not isinstance(material, (Elastic, Poisson)):
            raise TypeError(f"material: ppum.Elastic or ppum.Poisson is needed, not {type(material).__name__}")
        spec: dict[str, Any] = {"title": title} if title else {}
        spec["domain"] = _domain(domain)
        # those that are None are left out
        spec["material"] = {name: value for name, value in vars(material).items() if name != "eigenstrain"}
        if isinstance(material, Poisson):
            spec["equation"] = {"kind": "poisson"}
        elif material.eigenstrain is not None:
            spec["strain"] = dict(zip(("xx", "yy", "xy", "zz"), material.eigenstrain, strict=True))
        self._spec, self._text, self._name, self._folder = plain(spec), None, "problem", Path()

    _spec: dict[str, Any]
    #: The text of the file, whose name and folder follow; None of problems made in Python.
    _text: str | None
    _name: str
    _folder: Path

    @classmethod
    def _of(cls, spec: dict[str, Any], text: str | None = None, name: str = "problem", folder: Path = Path()) -> "Problem":
        problem = cls.__new__(cls)
        problem._spec, problem._text, problem._name, problem._folder = spec, text, name, folder
        return problem

    @classmethod
    def read(cls, path: str | os.PathLike[str]) -> "Problem":
        """The problem of a file; files that it names are looked for beside it. Mistakes are found by `check` and `solve`.

        Raises:
            OSError: It cannot be read.
            ProblemError: It is not TOML.
            ValueError: It is a dataset.
        """
        path = Path(path)
        data = path.read_bytes()
        if data.startswith(b"\x89HDF"):
            raise ValueError(f"{path} is a dataset, which is solved already: open it by ppum.open")
        try:
            text = data.decode()
        except UnicodeDecodeError as error:
            message = f"byte {error.start} is no UTF-8; write the file in this encoding"
            raise _error_of([Diagnostic(str(path), None, None, message)]) from None
        return cls._parse(text.replace("\r\n", "\n"), str(path), path.parent)

    @classmethod
    def parse(cls, text: str) -> "Problem":
        """The problem of a text, as `read`; files that it names are looked for in the working folder."""
        return cls._parse(text, "problem", Path())

    @classmethod
    def _parse(cls, text: str, name: str, folder: Path) -> "Problem":
        try:
            spec = tomllib.loads(text)
        except tomllib.TOMLDecodeError as error:
            # the library says it with line and column
            diagnostics = [Diagnostic(**f) for f in _core.check(text, name, folder)]
            raise _error_of(diagnostics or [Diagnostic(name, None, None, str(error))]) from None
        return cls._of(spec, text, name, folder)

    @classmethod
    def from_dict(cls, spec: Mapping[str, Any]) -> "Problem":
        """The problem of a dictionary with the sections and keys of problem files.

        Example:
            >>> ppum.Problem.from_dict(plate.to_dict()) == plate
            True
        """
        return cls._of(plain(dict(spec)))

    def to_dict(self) -> dict[str, Any]:
        """The problem as a dictionary, a copy."""
        copied: dict[str, Any] = plain(self._spec)
        return copied

    def to_toml(self) -> str:
        """The text of a problem file."""
        return self._text if self._text is not None else toml_lines(self._spec)[0]

    @takes(CrackOptions)
    def crack(self, *points: ArrayLike, **options: Unpack[CrackOptions]) -> "Problem":
        """One more crack, through points or an array of them; or by one of the options.

        Example:
            >>> one = plate.crack((-0.9, -1.5), (-0.6, -1.5))
            >>> one == plate.crack(np.array([[-0.9, -1.5], [-0.6, -1.5]]))
            True
        """
        if len(points) == 1 and np.ndim(plain(points[0], "points")) == 2:
            points = tuple(np.asarray(points[0]))
        return self.add("crack", **({"points": points} if points else {}), **options)

    @takes(HoleOptions)
    def hole(self, **options: Unpack[HoleOptions]) -> "Problem":
        """One more hole.

        Example:
            >>> plate.hole(center=(0.6, 1.2), radius=0.2).check()
            ()
        """
        return self.add("hole", **options)

    @takes(BoundaryOptions)
    def boundary(self, on: str | Mapping[str, Any], **options: Unpack[BoundaryOptions]) -> "Problem":
        """One more condition.

        Args:
            on: ``left``, ``right``, ``bottom``, ``top`` or ``outline``; or a dictionary of edge, from, to; of hole; of
                piece; of crack and face.

        Example:
            >>> plate.boundary({"crack": 0, "face": "above"}, pressure=1).check()
            ()
        """
        return self.add("boundary", on=on, **options)

    def force(self, at: ArrayLike, value: ArrayLike, face: str | None = None) -> "Problem":
        """One more force at a point; on a crack with the face that it acts on.

        Example:
            >>> plate.force((0, 1), (0.5, 0)).force((0, -1), (-0.5, 0)).check()
            ()
        """
        return self.add("force", at=at, value=value, **({"face": face} if face else {}))

    def support(self, at: ArrayLike, displacement: Iterable[float | str] = (0, 0)) -> "Problem":
        """One more point that is held against rigid motion; components may be ``free``.

        Example:
            >>> plate.support((0, 1)).support((0, -1), (0, "free")).check()
            ()
        """
        return self.add("support", at=at, displacement=displacement)

    def quantity(self, name: str, formula: str, unit: str = "") -> "Problem":
        """One more quantity with a name.

        Example:
            >>> plate.quantity("safety", "2/von_mises").check()
            ()
        """
        return self.add("quantity", name=name, formula=formula, **({"unit": unit} if unit else {}))

    @takes(DiscretizationOptions)
    def discretization(self, **options: Unpack[DiscretizationOptions]) -> "Problem":
        """Cells and functions.

        Options that were given before stay, unless they are given anew. `level`, `cells`, `points` and `accuracy` each replace
        the others.

        Example:
            >>> plate.discretization(level=3, order=3).to_dict()["discretization"]
            {'order': 3, 'level': 3}
        """
        old = dict(self._spec.get("discretization", {}))
        sizes = ("level", "cells", "points", "accuracy")
        if any(key in options for key in sizes):
            old = {key: value for key, value in old.items() if key not in sizes}
        return self.section("discretization", **{**old, **options})

    @takes(SpaceOptions)
    def accuracy(self, error: float, **options: Unpack[SpaceOptions]) -> "Problem":
        """Cells and orders that give K to a relative error, in place of a number of cells.

        Example:
            >>> plate.accuracy(1e-3).to_dict()["discretization"]
            {'order': 2, 'accuracy': 0.001}
        """
        return self.discretization(accuracy=error, **options)

    @takes(GrowthOptions)
    def growth(self, steps: int, **options: Unpack[GrowthOptions]) -> "Problem":
        """Lets the cracks grow, in so many steps at most.

        Example:
            >>> plate.growth(3, increment=0.05).check()
            ()
        """
        return self.section("growth", steps=steps, **options)

    @takes(AdaptivityOptions)
    def adaptivity(self, **options: Unpack[AdaptivityOptions]) -> "Problem":
        """Improves cells until the field is good enough.

        Example:
            >>> plate.adaptivity(tolerance=0.01, keep="all").check()
            ()
        """
        return self.section("adaptivity", **options)

    def section(self, name: str, /, **keys: Any) -> "Problem":
        """The problem with a section of this name, e.g. ``solver``, ``body_force``, in place of what it had. `check` finds keys
        that there are not.

        Example:
            >>> plate.section("solver", kind="direct").check()
            ()
        """
        return self._with({**self._spec, name: keys})

    def add(self, name: str, /, **keys: Any) -> "Problem":
        """The problem with one more section of a kind that there may be several of, e.g. ``refine``, ``table``. `check` finds
        keys that there are not.

        Example:
            >>> plate.add("refine", center=(0.3, 0.4), radius=0.2, size=0.1).check()
            ()
        """
        return self._with({**self._spec, name: [*self._spec.get(name, ()), keys]})

    def _with(self, spec: dict[str, Any]) -> "Problem":
        return self._of(plain(spec), folder=self._folder)

    def check(self) -> tuple[Diagnostic, ...]:
        """What is wrong; nothing if the problem can be solved as far as its text tells.

        Diagnostics of problems made in Python name keys, those of files lines. Where a table is missing, others are looked into
        once it is there.

        Example:
            >>> plate.boundary("nowhere", traction=(0, 1)).check()[0].place
            'boundary[2].on'
        """
        text, keys = (self._text, None) if self._text is not None else toml_lines(self._spec)
        found = (Diagnostic(**f) for f in _core.check(text, self._name, self._folder))
        return tuple(found if keys is None else (_of_key(diagnostic, keys) for diagnostic in found))

    @passes(SolveOptions)
    def solve(self, **options: Unpack[SolveOptions]) -> Dataset:
        """Solves the problem, see `ppum.solve`."""
        return solve(self, **options)

    def __eq__(self, other: object) -> bool:
        if not isinstance(other, Problem):
            return NotImplemented
        return self._spec == other._spec and self._folder == other._folder

    def __hash__(self) -> int:
        return hash(toml_lines(self._spec)[0])

    def __reduce__(self) -> tuple[Any, ...]:
        return Problem._of, (self._spec, self._text, self._name, self._folder)

    def __repr__(self) -> str:
        title, cracks = self._spec.get("title", ""), self._spec.get("crack", ())
        return f"<ppum.Problem {title!r}, {plural(len(cracks), 'crack')}>"


def _domain(domain: Any) -> Mapping[str, Any]:
    """The table of a domain, which may be two corners."""
    if isinstance(domain, Mapping):
        return domain
    try:
        low, high = domain
        return {"min": tuple(low), "max": tuple(high)}
    except (TypeError, ValueError):
        message = "domain: two corners are needed, ((x0, y0), (x1, y1)), or a table such as {'outline': {'points': …}}"
        raise TypeError(f"{message}, not {domain!r}") from None


def _error_of(diagnostics: Iterable[Diagnostic]) -> ProblemError:
    return ProblemError("\n".join(map(str, diagnostics)), list(diagnostics))


def _of_key(diagnostic: Diagnostic, keys: list[str]) -> Diagnostic:
    """The diagnostic with a key in place of the line of a text that nobody wrote."""
    if diagnostic.line is None:
        return diagnostic
    key = keys[min(diagnostic.line, len(keys)) - 1] if keys else diagnostic.place
    return Diagnostic(key, None, None, diagnostic.message)


@takes(SolveOptions)
def solve(problem: Problem | Mapping[str, Any] | str | os.PathLike[str], **options: Unpack[SolveOptions]) -> Dataset:
    """Solves a problem; a problem with growing cracks gives a dataset of all steps. Ctrl-C ends it within moments.

    The result depends on the problem alone, not on the number of threads.

    The problem is a `Problem`, a dictionary as for `Problem.from_dict`, or the path of a problem file.

    Raises:
        ProblemError: Mistakes in the problem, all in `diagnostics`.
        SolveError: What cannot be solved, e.g. loads that nothing holds.
        OSError: A file that cannot be read.
        KeyboardInterrupt: Ctrl-C.

    Example:
        >>> ppum.solve(plate, threads=2).tips[1].k1 > 0.7
        True
    """
    if isinstance(problem, (str, os.PathLike)):
        problem = Problem.read(problem)
    elif isinstance(problem, Mapping):
        problem = Problem.from_dict(problem)
    elif isinstance(problem, Dataset):
        raise TypeError("problem: this is a dataset, which is solved already; its `problem` is what was solved")
    elif not isinstance(problem, Problem):
        raise TypeError(f"problem: a ppum.Problem, a dictionary or a path is needed, not {type(problem).__name__}")
    threads, progress, line = options["threads"], options["progress"], ProgressLine()
    if threads is not None and threads < 1:
        raise ValueError("threads: one or more")
    hears = line.solving if progress is True else progress or None
    try:
        return Dataset(_core.solve(problem.to_toml(), problem._name, problem._folder, options["memory"], threads, hears))
    except ProblemError:
        diagnostics = problem.check() if problem._text is None else ()
        if not diagnostics:
            raise
        raise _error_of(diagnostics) from None
    finally:
        if progress is True:
            line.clear()
