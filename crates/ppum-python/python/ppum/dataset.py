"""Datasets: solved problems, or fields from elsewhere in the same representation."""

from __future__ import annotations

import html
import json
import math
import os
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field, fields
from functools import cached_property
from pathlib import Path
from typing import IO, TYPE_CHECKING, Any, TypeVar, Unpack

import numpy as np
from numpy.typing import NDArray

from . import _core
from .options import passes
from .styles import ViewerOptions
from .tables import History, Numbered, Table

if TYPE_CHECKING:
    from .field import Field
    from .problem import Problem
    from .widget import Viewer

__all__ = [
    "Advance",
    "Crack",
    "Dataset",
    "Growth",
    "History",
    "Hole",
    "Reaction",
    "Step",
    "Table",
    "Tip",
    "Warning",
    "from_bytes",
    "open",
]

Point = tuple[float, float]
_Row = TypeVar("_Row")


@dataclass(frozen=True)
class Crack:
    """A crack: a polyline with a direction, whose left side is above.

    Attributes:
        index: Its number, from 0.
        points: The vertices, shape (n, 2), lengths.
        ends: The kinds of its ends: ``tip``, ``mouth`` or ``junction``.
    """

    index: int
    points: NDArray[np.float64]
    ends: tuple[str, str]

    @property
    def length(self) -> float:
        """Arc length from end to end."""
        return float(np.hypot(*np.diff(self.points, axis=0).T).sum())

    def __repr__(self) -> str:
        return f"<ppum.Crack {self.index}, {len(self.points)} points, {self.ends[0]} to {self.ends[1]}>"


@dataclass(frozen=True)
class Hole:
    """A hole: a circle (`center`, `radius`) or a polygon (`points`, shape (n, 2)); the others are None."""

    center: Point | None
    radius: float | None
    points: NDArray[np.float64] | None


@dataclass(frozen=True)
class Tip:
    """A crack tip with its stress intensity factors; what is not known is NaN.

    Attributes:
        crack: Number of its crack.
        end: ``start`` or ``end``, the crack's first or last vertex.
        xy: Its place.
        angle: Direction of growth, the angle to the x axis, radians.
        k1, k2: K_I and K_II, stress · length^½.
        t_stress: T, a stress.
        j: The J-integral, stress · length.
        g: Energy released per length of growth, (K_I² + K_II²)/E′, stress · length.
        growth_angle: Direction of the largest hoop stress, radians from `angle`.
        error: Estimated error of (K_I, K_II), stress · length^½.
        spread: Largest relative difference of two rings, a check and no estimate of the error.
        rings: Of each ring inner and outer radius, K_I and K_II; shape (n, 4).
    """

    crack: int
    end: str
    xy: Point
    angle: float
    k1: float
    k2: float
    t_stress: float
    j: float
    g: float
    growth_angle: float
    error: float
    spread: float
    rings: NDArray[np.float64] = field(repr=False, compare=False)

    def __repr__(self) -> str:
        x, y = self.xy
        return f"<ppum.Tip at ({x:.6g}, {y:.6g}), K_I = {self.k1:.6g}, K_II = {self.k2:.6g}>"


@dataclass(frozen=True)
class Warning:
    """A finding that does not make a solution wrong to have, but wrong to trust unread.

    Attributes:
        kind: A word, e.g. ``faces-overlap``.
        at: The place, if it is about one.
        value: The number that gave rise to it.
        limit: The bound that the number passes.
        message: What is wrong, and the remedy.
    """

    kind: str
    at: Point | None
    value: float
    limit: float
    message: str

    def __repr__(self) -> str:
        return f"<ppum.Warning {self.kind}: {self.message}>"


@dataclass(frozen=True)
class Reaction:
    """The resultant of what a support exerts on the plate.

    Attributes:
        on: The support in words, e.g. ``bottom``.
        held: Of each component, whether the support holds it.
        force: Force per thickness of each component, stress · length; zero where not held.
        moment: About the centre of the domain's box, counter-clockwise, stress · length².
    """

    on: str
    held: tuple[bool, ...]
    force: tuple[float, ...]
    moment: float


@dataclass(frozen=True)
class Advance:
    """What one tip of a growing crack does next.

    Attributes:
        crack, end: The tip.
        fate: In words, e.g. ``grows``, ``held``, ``meets crack 3``.
        strength: What is compared with the toughness, stress · length^½.
        direction: Of the path at the tip, angle to the x axis, radians.
        curvature: Of the path, 1 / length.
        path: The vertices that the crack gets, shape (n, 2).
        length: Length of the path.
        extension: Length of all growth at this end since the first step.
    """

    crack: int
    end: str
    fate: str
    strength: float
    direction: float
    curvature: float
    path: NDArray[np.float64] = field(repr=False, compare=False)
    length: float
    extension: float


@dataclass(frozen=True)
class Growth:
    """How the cracks of a step grow on from there.

    Attributes:
        cycles: Load cycles up to the step; None where growth has no time.
        stop: What ends the series with this step; None if it goes on.
        tips: What each tip does.
    """

    cycles: float | None
    stop: str | None
    tips: Table[Advance]


class Step:
    """One state of a series. Made by `Dataset.steps`.

    Example:
        >>> step = ds.steps[-1]
        >>> step.patches, step.unknowns
        (512, 6600)
        >>> sorted(step.history)[:2]
        ['assembly', 'basis']
    """

    def __init__(self, dataset: Dataset, number: int) -> None:
        self.dataset = dataset
        #: Number of the step, from 0.
        self.number = number

    @cached_property
    def _facts(self) -> dict[str, Any]:
        facts: dict[str, Any] = json.loads(self.dataset._core.step(self.number))
        return facts

    @property
    def load(self) -> float:
        """Load factor or pseudo-time."""
        return float(self._facts["load"])

    @property
    def patches(self) -> int:
        """Number of patches."""
        return int(self._facts["patches"])

    @property
    def unknowns(self) -> int:
        """Number of unknowns of the solution."""
        return int(self._facts["unknowns"])

    @property
    def functions(self) -> tuple[str, ...]:
        """Names of the functions that polynomials are multiplied with; `Field.with_function` takes them."""
        return tuple(self._facts["functions"])

    @cached_property
    def cracks(self) -> tuple[Crack, ...]:
        """The cracks."""
        cracks = enumerate(self._facts["cracks"])
        made = (Crack(k, _points(c["points"]), tuple(c["ends"])) for k, c in cracks)
        return Numbered(made, "crack")

    @cached_property
    def tips(self) -> Table[Tip]:
        """The crack tips with the factors that the solver found, in the order of cracks and ends."""
        return tips_of(self._facts["tips"], self._facts["ends"])

    @cached_property
    def history(self) -> History:
        """The solver's report."""
        records = self._facts["history"]
        return History([(r["name"], _number(r["value"]), r["unit"]) for r in records])

    @cached_property
    def warnings(self) -> Table[Warning]:
        """What the diagnostics found."""
        return Table((_row(Warning, w) for w in self._facts["warnings"]), "warning")

    @cached_property
    def reactions(self) -> Table[Reaction]:
        """What the supports exert on the plate."""
        names = self._facts["components"]
        rows = (
            _row(Reaction, r, held=[n in r["held"] for n in names], moment=r["moment"] or 0.0)
            for r in self._facts["reactions"]
        )
        return Table(rows, "reaction")

    @cached_property
    def growth(self) -> Growth | None:
        """How the cracks grow on from here; None without growth."""
        facts = self._facts["growth"]
        if facts is None:
            return None
        tips = (
            _row(Advance, t, curvature=curvature, path=_points(path))
            for t, (curvature, path) in zip(facts["tips"], self._facts["arcs"])
        )
        return Growth(facts["cycles"], facts["stop"], Table(tips, "tip"))

    @cached_property
    def attributes(self) -> dict[str, NDArray[np.float64]]:
        """Stored values of the cover's cells by name, each of shape (patches,)."""
        return dict(self.dataset._core.attributes(self.number))

    @cached_property
    def field(self) -> Field:
        """The field of the step.

        Raises:
            FormatError: The step has none, or a function that cannot be compiled.
        """
        from .field import Field

        return Field(self.dataset, self.number)

    def __repr__(self) -> str:
        return f"<ppum.Step {self.number}, {_count(self.patches, 'patch', 'patches')}, {_count(len(self.tips), 'tip')}>"


def tips_of(facts: list[dict[str, Any]], ends: Sequence[str]) -> Table[Tip]:
    """The tips of facts, and of the names of their ends."""
    both = zip(facts, ends, strict=True)
    tips = (_row(Tip, t, end=end, xy=t["tip"], rings=_rings(t["rings"])) for t, end in both)
    return Table(tips, "tip")


def _points(points: Sequence[Point]) -> NDArray[np.float64]:
    array = np.array(points, float).reshape(-1, 2)
    array.flags.writeable = False
    return array


def _rings(rings: list[dict[str, Any]]) -> NDArray[np.float64]:
    return np.array([[_number(v) for v in r.values()] for r in rings], float).reshape(-1, 4)


def _number(value: Any) -> float:
    """A number of the facts: undefined ones are null there, infinite ones texts."""
    return math.nan if value is None else float(value)


def _numbers(values: Sequence[Any]) -> tuple[float, ...]:
    return tuple(_number(v) for v in values)


_READERS: dict[Any, Callable[[Any], Any]] = {
    "float": _number,
    "Point": tuple,
    "Point | None": lambda point: None if point is None else tuple(point),
    "tuple[bool, ...]": tuple,
    "tuple[float, ...]": _numbers,
}


def _row(kind: Callable[..., _Row], facts: dict[str, Any], **others: Any) -> _Row:
    """A row of the facts of a dataset, some of whose attributes are given."""
    values = {**facts, **others}
    attributes = fields(kind)  # type: ignore[arg-type]
    return kind(**{f.name: _READERS.get(f.type, lambda v: v)(values[f.name]) for f in attributes})


def _count(count: int, one: str, more: str | None = None) -> str:
    return f"{count} {one if count == 1 else more or one + 's'}"


class Dataset:
    """A solved problem: all that is needed to evaluate its fields exactly. It never changes.

    Datasets are equal if all their numbers and texts are, but for the seconds that solving took; they can be pickled, and
    sent to other processes.

    Example:
        >>> ds
        <ppum.Dataset 'Slanted crack', elasticity, 1 step, 512 patches, 2 tips>
        >>> ds.tips[0]
        <ppum.Tip at (-0.353553, -0.353553), K_I = 0.766738, K_II = 0.684074>
        >>> ppum.from_bytes(ds.to_bytes()) == ds
        True
    """

    def __init__(self, core: _core.Dataset) -> None:
        self._core = core

    @cached_property
    def _facts(self) -> dict[str, Any]:
        facts: dict[str, Any] = json.loads(self._core.about())
        return facts

    @property
    def title(self) -> str:
        """One line that names the problem."""
        return str(self._facts["title"])

    @property
    def program(self) -> str:
        """Name and version of the program that made it."""
        return str(self._facts["program"])

    @property
    def equation(self) -> str:
        """``elasticity`` or ``poisson``."""
        return str(self._facts["equation"]["kind"])

    @property
    def domain(self) -> tuple[Point, Point]:
        """Lower left and upper right corner of the box; `holes` are cut out of it."""
        domain = self._facts["domain"]
        return tuple(domain["min"]), tuple(domain["max"])

    @cached_property
    def holes(self) -> tuple[Hole, ...]:
        """The holes."""
        holes = (
            Hole(tuple(h["center"]), h["radius"], None)
            if h["kind"] == "circle"
            else Hole(None, None, _points(h["points"]))
            for h in self._facts["domain"]["holes"]
        )
        return Numbered(holes, "hole")

    @property
    def problem(self) -> Problem | None:
        """The problem that was solved, by its text; None if the dataset has none. Files that it names have to be where
        they were."""
        from .problem import Problem

        text = self._facts["problem"]
        return None if text is None else Problem.parse(text)

    @cached_property
    def steps(self) -> tuple[Step, ...]:
        """The steps of the series, one or more."""
        return Numbered((Step(self, k) for k in range(len(self._core))), "step")

    @property
    def field(self) -> Field:
        """The field of the last step."""
        return self.steps[-1].field

    @property
    def cracks(self) -> tuple[Crack, ...]:
        """The cracks of the last step."""
        return self.steps[-1].cracks

    @property
    def tips(self) -> Table[Tip]:
        """The tips of the last step."""
        return self.steps[-1].tips

    @property
    def warnings(self) -> Table[Warning]:
        """The warnings of the last step."""
        return self.steps[-1].warnings

    @property
    def history(self) -> History:
        """The solver's report of the last step."""
        return self.steps[-1].history

    @property
    def quantities(self) -> Mapping[str, Any]:
        """All named quantities of the last step's field, see `Field.quantities`."""
        return self.field.quantities

    @passes
    def view(
        self, quantity: str | None = None, *, step: int = -1, **options: Unpack[ViewerOptions]
    ) -> Viewer:
        """Shows a step in a notebook, with a slider for the others; further options as in `Field.view`.

        Example:
            >>> ds.view("von_mises", tip=1, zoom=100).step
            0
        """
        return self.steps[step].field.view(quantity, **options)

    def save(self, path: str | os.PathLike[str]) -> None:
        """Writes a file. What was there stays until the new one is complete.

        Raises:
            OSError: The system refuses; `FileNotFoundError` where there is no such folder.
        """
        self._core.save(Path(path))

    def to_bytes(self) -> bytes:
        """The bytes of a file."""
        return self._core.to_bytes()

    def __reduce__(self) -> tuple[Any, ...]:
        return from_bytes, (self.to_bytes(),)

    def __eq__(self, other: object) -> bool:
        return self._core == other._core if isinstance(other, Dataset) else NotImplemented

    def __hash__(self) -> int:
        numbers = [(s.patches, s.unknowns, s.history.get("energy", 0.0)) for s in self.steps]
        # what is not a number is not equal to itself
        plain = tuple((p, u, energy if energy == energy else None) for p, u, energy in numbers)
        return hash((self.title, self.equation, plain))

    def __repr__(self) -> str:
        last = self.steps[-1]
        counts = [
            self.equation,
            _count(len(self.steps), "step"),
            _count(last.patches, "patch", "patches"),
            _count(len(last.tips), "tip"),
        ]
        return f"<ppum.Dataset {self.title!r}, {', '.join(counts)}>"

    def _repr_html_(self) -> str:
        (x0, y0), (x1, y1) = self.domain
        last = self.steps[-1]
        rows = {
            "equation": self.equation,
            "domain": f"({x0:g}, {y0:g}) to ({x1:g}, {y1:g}), {_count(len(self.holes), 'hole')}",
            "steps": str(len(self.steps)),
            "patches, unknowns": f"{last.patches}, {last.unknowns}",
            "cracks": str(len(last.cracks)),
            "warnings": "; ".join(w.message for w in last.warnings) or "none",
        }
        body = "".join(
            f"<tr><th>{html.escape(k)}</th><td>{html.escape(v)}</td></tr>" for k, v in rows.items()
        )
        tips = last.tips._repr_html_() if last.tips else ""
        return f"<p><b>{html.escape(self.title)}</b></p><table><tbody>{body}</tbody></table>{tips}"


def open(source: str | os.PathLike[str] | bytes | IO[bytes]) -> Dataset:
    """Opens a dataset, whole: no file stays open.

    Args:
        source: A path, the bytes of a file, or a file that is open for reading bytes.

    Raises:
        OSError: The file cannot be read; `FileNotFoundError` if there is none.
        FormatError: It is no dataset, or a damaged one.
        TypeError: Something else, or a file that is open for text.

    Example:
        >>> ds.save("plate.h5")
        >>> ppum.open("plate.h5") == ds
        True
    """
    if isinstance(source, (bytes, bytearray, memoryview)):
        return from_bytes(bytes(source))
    if isinstance(source, (str, os.PathLike)):
        return Dataset(_core.read(Path(source)))
    if not hasattr(source, "read"):
        raise TypeError(f"a dataset is opened by a path, bytes or an open file{_remedy(source)}")
    data = source.read()
    if not isinstance(data, bytes):
        raise TypeError("the file is open for text: open it with mode 'rb', or give its path")
    return from_bytes(data)


def _remedy(source: Any) -> str:
    name = getattr(source, "filename", None)
    if isinstance(name, str):
        return f", not by a {type(source).__name__} of h5py; close it, and give {name!r}"
    return f", not by {type(source).__name__!r}"


def from_bytes(data: bytes) -> Dataset:
    """The dataset of a file's bytes.

    Raises:
        FormatError: They are no dataset, or a damaged one.

    Example:
        >>> ppum.from_bytes(ds.to_bytes()).title
        'Slanted crack'
    """
    return Dataset(_core.from_bytes(data))


for _class in (Advance, Crack, Dataset, Growth, Hole, Reaction, Step, Tip, Warning):
    _class.__module__ = "ppum"
