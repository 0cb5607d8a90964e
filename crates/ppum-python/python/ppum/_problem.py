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
        state: ``plane-strain``, ``plane-stress``, or ``axisymmetric``: a body of revolution about x = 0.
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
class Anisotropic:
    """A linear elastic, anisotropic material: engineering constants along its axes, or a stiffness.

    Attributes:
        young: (E1, E2) in plane stress, (E1, E2, E3) in plane strain; numbers or formulas of x and y.
        poisson: (ν12,) or (ν12, ν13, ν23), with ν12/E1 = ν21/E2.
        shear: The shear modulus G12.
        axis: Angle of the first axis from the x axis, in degrees; a formula where fibres are curved.
        stiffness: Instead of the three: ((c11, c12, c16), (c12, c22, c26), (c16, c26, c66)).
        out_of_plane: With `stiffness` in plane strain: (c13, c23, c36, c33).
        state: ``plane-strain`` or ``plane-stress``.
        expansion: Coefficient of thermal expansion, or (α1, α2) or (α1, α2, α3) along the axes.
        eigenstrain: The given strains ε⁰_xx, ε⁰_yy, ε⁰_xy, ε⁰_zz of the x and y axes that make no stress.

    Example:
        >>> ply = ppum.Anisotropic((144.8, 11.7), (0.21,), 9.66, axis=60, state="plane-stress")
        >>> plate = ppum.Problem(((-1, -1), (1, 1)), ply).crack((-0.5, 0), (0.5, 0))
        >>> plate = plate.boundary("bottom", traction=(0, -1)).boundary("top", traction=(0, 1))
        >>> plate.discretization(level=4).check()
        ()
    """

    young: tuple[float | str, ...] | None = None
    poisson: tuple[float | str, ...] | None = None
    shear: float | str | None = None
    axis: float | str = 0.0
    stiffness: tuple[tuple[float | str, ...], ...] | None = None
    out_of_plane: tuple[float | str, ...] | None = None
    state: str = "plane-strain"
    expansion: float | str | tuple[float | str, ...] | None = None
    eigenstrain: tuple[float | str, float | str, float | str, float | str] | None = None


@dataclass(frozen=True)
class Poisson:
    """The material of Poisson's equation, −∇·(κ ∇u) = f, with the conductivity κ.

    Attributes:
        conductivity: κ; a number or a formula of x and y.
        axisymmetric: Whether the body is one of revolution about x = 0.
    """

    conductivity: float | str = 1.0
    axisymmetric: bool = False


class Problem:
    """A problem, which never changes: each call returns a new one.

    Options are the keys of problem files (docs/problem-file.md); `section` and `add` take what has no method of its own.

    Example:
        >>> body = ppum.Problem(((-1, -2), (1, 2)), ppum.Elastic(young=1.0, poisson=0.3), title="Slanted crack")
        >>> plate = body.crack((-0.3535533906, -0.3535533906), (0.3535533906, 0.3535533906))
        >>> plate = plate.boundary("bottom", traction=(0, -1)).boundary("top", traction=(0, 1))
        >>> plate = plate.discretization(cells=(8, 16), order=2)
        >>> plate.check()
        ()
        >>> plate.crack((2, 2), (3, 3)).check()[0].place
        'crack[1].points'
        >>> more = plate.hole(center=(0.6, 1.2), radius=0.2).quantity("safety", "2/von_mises").section("solver", kind="direct")
        >>> more = more.force((1, 0), (0.5, 0)).force((-1, 0), (-0.5, 0)).support((0, 1)).support((0, -1), (0, "free"))
        >>> more = more.add("refine", center=(0.3, 0.4), radius=0.2, size=0.1).adaptivity(tolerance=0.01, keep="all")
        >>> more.check()
        ()
    """

    def __init__(
        self, domain: Iterable[Iterable[float]] | Mapping[str, Any], material: Elastic | Anisotropic | Poisson, *, title: str = ""
    ) -> None:
        if not isinstance(material, (Elastic, Anisotropic, Poisson)):
            raise TypeError(f"material: ppum.Elastic, ppum.Anisotropic or ppum.Poisson is needed, not {type(material).__name__}")
        spec: dict[str, Any] = {"title": title} if title else {}
        spec["domain"] = _domain(domain)
        # those that are None are left out
        spec["material"] = {name: value for name, value in vars(material).items() if name not in ("eigenstrain", "axisymmetric")}
        if isinstance(material, Poisson):
            around = {"axisymmetric": True} if material.axisymmetric else {}
            spec["equation"] = {"kind": "poisson", **around}
        elif material.eigenstrain is not None:
            spec["strain"] = dict(zip(("xx", "yy", "xy", "zz"), material.eigenstrain, strict=True))
        self._spec: dict[str, Any] = plain(spec)

    #: The text of the file, whose name and folder follow; None for problems made in Python.
    _text: str | None = None
    _name, _folder = "problem", Path()

    @classmethod
    def _of(cls, spec: dict[str, Any], text: str | None = None, name: str = "problem", folder: Path = Path()) -> "Problem":
        problem = cls.__new__(cls)
        problem._spec, problem._text, problem._name, problem._folder = spec, text, name, folder
        return problem

    @classmethod
    def read(cls, path: str | os.PathLike[str]) -> "Problem":
        """Read a file; files that it names are looked for beside it. Errors are found by `check` and `solve`.

        Raises:
            OSError: The file cannot be read.
            ProblemError: The file is not TOML.
            ValueError: The file is a dataset.
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
        """Read a text, as `read`; files that it names are looked for in the working folder."""
        return cls._parse(text, "problem", Path())

    @classmethod
    def _parse(cls, text: str, name: str, folder: Path) -> "Problem":
        try:
            spec = tomllib.loads(text)
        except tomllib.TOMLDecodeError as error:
            # the library says it with line and column
            diagnostics = [Diagnostic(*f) for f in _core.check(text, name, folder)]
            raise _error_of(diagnostics or [Diagnostic(name, None, None, str(error))]) from None
        return cls._of(spec, text, name, folder)

    @classmethod
    def from_dict(cls, spec: Mapping[str, Any]) -> "Problem":
        """Make a problem of a dictionary with the sections and keys of problem files.

        Example:
            >>> ppum.Problem.from_dict(plate.to_dict()) == plate
            True
        """
        return cls._of(plain(dict(spec)))

    def to_dict(self) -> dict[str, Any]:
        """Return a copy of the problem as a dictionary."""
        return dict(plain(self._spec))

    def to_toml(self) -> str:
        """Return the text of a problem file."""
        return self._text if self._text is not None else toml_lines(self._spec)[0]

    @takes(CrackOptions)
    def crack(self, *points: ArrayLike, **options: Unpack[CrackOptions]) -> "Problem":
        """Add a crack, through points or an array of them, or by one of the options.

        Example:
            >>> one = plate.crack((-0.9, -1.5), (-0.6, -1.5))
            >>> one == plate.crack(np.array([[-0.9, -1.5], [-0.6, -1.5]]))
            True
        """
        if len(points) == 1 and np.ndim(plain(points[0], "points")) == 2:
            points = tuple(np.asarray(points[0]))
        return self.add("crack", points=points or None, **options)

    @takes(HoleOptions)
    def hole(self, **options: Unpack[HoleOptions]) -> "Problem":
        """Add a hole."""
        return self.add("hole", **options)

    @takes(BoundaryOptions)
    def boundary(self, on: str | Mapping[str, Any], **options: Unpack[BoundaryOptions]) -> "Problem":
        """Add a boundary condition.

        Args:
            on: ``left``, ``right``, ``bottom``, ``top``, ``outline``, or a table: edge, from, to; hole; piece; crack, face.

        Example:
            >>> plate.boundary({"crack": 0, "face": "above"}, pressure=1).check()
            ()
        """
        return self.add("boundary", on=on, **options)

    def force(self, at: ArrayLike, value: ArrayLike, face: str | None = None) -> "Problem":
        """Add a force at a point; on a crack with the face that it acts on."""
        return self.add("force", at=at, value=value, face=face or None)

    def support(self, at: ArrayLike, displacement: Iterable[float | str] = (0, 0)) -> "Problem":
        """Add a point that is held against rigid motion; components may be ``free``."""
        return self.add("support", at=at, displacement=displacement)

    def quantity(self, name: str, formula: str, unit: str = "") -> "Problem":
        """Add a named quantity."""
        return self.add("quantity", name=name, formula=formula, unit=unit or None)

    @takes(DiscretizationOptions)
    def discretization(self, **options: Unpack[DiscretizationOptions]) -> "Problem":
        """Set cells and functions; options that were given before stay.

        `level`, `cells`, `points` and `accuracy` each replace the others.

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
        """Choose cells and orders that give K to a relative error, in place of a number of cells.

        Example:
            >>> plate.accuracy(1e-3).to_dict()["discretization"]
            {'order': 2, 'accuracy': 0.001}
        """
        return self.discretization(accuracy=error, **options)

    @takes(GrowthOptions)
    def growth(self, steps: int, **options: Unpack[GrowthOptions]) -> "Problem":
        """Let the cracks grow, in at most so many steps.

        Example:
            >>> plate.growth(3, increment=0.05).check()
            ()
        """
        return self.section("growth", steps=steps, **options)

    @takes(AdaptivityOptions)
    def adaptivity(self, **options: Unpack[AdaptivityOptions]) -> "Problem":
        """Improve cells until the field is good enough."""
        return self.section("adaptivity", **options)

    def section(self, name: str, /, **keys: Any) -> "Problem":
        """Replace a section, e.g. ``solver``, ``body_force``. `check` reports unknown keys."""
        return self._with({**self._spec, name: keys})

    def add(self, name: str, /, **keys: Any) -> "Problem":
        """Append to a section that may occur several times, e.g. ``refine``, ``table``. `check` reports unknown keys."""
        return self._with({**self._spec, name: [*self._spec.get(name, ()), keys]})

    def _with(self, spec: dict[str, Any]) -> "Problem":
        return self._of(plain(spec), folder=self._folder)

    def check(self) -> tuple[Diagnostic, ...]:
        """Return the errors; none if the problem can be solved as far as its text tells.

        Diagnostics of problems made in Python name keys, those of files lines. A missing table hides errors in others.

        Example:
            >>> plate.boundary("nowhere", traction=(0, 1)).check()[0].place
            'boundary[2].on'
        """
        text, keys = (self._text, None) if self._text is not None else toml_lines(self._spec)
        found = (Diagnostic(*f) for f in _core.check(text, self._name, self._folder))
        return tuple(found if keys is None else (_of_key(diagnostic, keys) for diagnostic in found))

    @passes(SolveOptions)
    def solve(self, **options: Unpack[SolveOptions]) -> Dataset:
        """Solve the problem, see `ppum.solve`."""
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
    """Return the table of a domain, which may be two corners."""
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
    """Return a diagnostic with a key in place of the line of a text that nobody wrote."""
    if diagnostic.line is None:
        return diagnostic
    key = keys[min(diagnostic.line, len(keys)) - 1] if keys else diagnostic.place
    return Diagnostic(key, None, None, diagnostic.message)


@takes(SolveOptions)
def solve(problem: Problem | Mapping[str, Any] | str | os.PathLike[str], **options: Unpack[SolveOptions]) -> Dataset:
    """Solve a problem; one with growing cracks gives a dataset of all steps. Ctrl-C ends it within moments.

    It is a `Problem`, a dictionary as for `Problem.from_dict`, or the path of a problem file. The result depends on the
    problem alone, not on the number of threads.

    Raises:
        ProblemError: The problem has errors, all in `diagnostics`.
        SolveError: It cannot be solved, e.g. loads that nothing holds.
        OSError: A file cannot be read.
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
