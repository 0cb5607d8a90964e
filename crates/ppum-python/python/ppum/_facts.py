"""Rows of the facts of datasets: cracks, tips, warnings, reactions, growth."""

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass, field, fields
from typing import Any, TypeVar

import numpy as np
from numpy.typing import NDArray

from ._edges import length
from ._tables import Table
from ._text import plural

Point = tuple[float, float]
_Row = TypeVar("_Row")


@dataclass(frozen=True)
class Crack:
    """A crack: segments and arcs with a direction, whose left side is above.

    Attributes:
        index: Number of the crack, from 0.
        points: The vertices, shape (n, 2), lengths.
        ends: The kinds of its ends: ``tip``, ``mouth`` or ``junction``.
        bulges: tan(sweep / 4) of each edge, positive where it turns left, 0 for segments, shape (n - 1,); None without arcs.
    """

    index: int
    points: NDArray[np.float64]
    ends: tuple[str, str]
    bulges: NDArray[np.float64] | None = None

    @property
    def length(self) -> float:
        """Arc length from end to end."""
        return length(self.points, self.bulges)

    def __repr__(self) -> str:
        arcs = "" if self.bulges is None else f", {plural(int(np.count_nonzero(self.bulges)), 'arc')}"
        return f"<ppum.Crack {self.index}, {len(self.points)} points{arcs}, {self.ends[0]} to {self.ends[1]}>"


@dataclass(frozen=True)
class Hole:
    """A hole: a circle (`center`, `radius`) or a polygon (`points`, shape (n, 2)); the others are None.

    With `is_outside` the polygon is the outline of the body, and the hole all that is outside of it. Where sides of it are
    arcs, `bulges` has tan(sweep / 4) of the side behind each corner, positive where it turns left, 0 for segments, shape (n,).
    """

    center: Point | None = None
    radius: float | None = None
    points: NDArray[np.float64] | None = None
    is_outside: bool = False
    bulges: NDArray[np.float64] | None = None


@dataclass(frozen=True)
class Tip:
    """A crack tip with its stress intensity factors; unknown numbers are NaN.

    Attributes:
        crack: Number of its crack.
        end: ``start`` or ``end``, the crack's first or last vertex.
        xy: Position.
        angle: Direction of growth, the angle to the x axis, radians.
        k1, k2: K_I and K_II, stress · length^½.
        t_stress: T, a stress.
        j: The J-integral, stress · length.
        g: Energy released per length of growth, (K_I² + K_II²)/E′, stress · length.
        growth_angle: Direction of the largest hoop stress, radians from `angle`.
        error: Estimated error of (K_I, K_II), stress · length^½.
        spread: Largest relative difference of two rings, a check and no estimate of the error.
        rings: Inner and outer radius, K_I and K_II of each ring; shape (n, 4).
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
    """A diagnostic that should be read before the solution is used.

    Attributes:
        kind: A word, e.g. ``faces-overlap``.
        at: The place, if it has one.
        value: The number that gave rise to it.
        limit: The bound that the number passes.
        message: The finding, and the remedy.
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
        held: Whether the support holds each component.
        force: Force per thickness of each component, stress · length; zero where not held.
        moment: Moment about the centre of the domain's box, counter-clockwise, stress · length².
    """

    on: str
    held: tuple[bool, ...]
    force: tuple[float, ...]
    moment: float


@dataclass(frozen=True)
class Advance:
    """The next increment of a tip of a growing crack.

    Attributes:
        crack, end: The tip.
        fate: In words, e.g. ``grows``, ``held``, ``meets crack 3``, ``meets the axis``.
        strength: The value compared with the toughness, stress · length^½.
        direction: Angle of the path at the tip to the x axis, radians.
        curvature: Curvature of the path, 1 / length.
        path: New vertices of the crack, shape (n, 2).
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
    """The growth of the cracks after a step.

    Attributes:
        cycles: Load cycles up to the step; None where growth has no time.
        stop: Why the series ends with this step; None if it goes on.
        tips: The increment of each tip.
    """

    cycles: float | None
    stop: str | None
    tips: Table[Advance]


def tips_of(facts: list[dict[str, Any]], ends: Sequence[str]) -> Table[Tip]:
    both = zip(facts, ends, strict=True)
    tips = (row(Tip, t, end=end, xy=t["tip"], rings=_rings(t["rings"])) for t, end in both)
    return Table(tips, "tip")


def bulges(given: Sequence[float]) -> NDArray[np.float64] | None:
    """Return the bulges of edges, None if there are none."""
    if not given:
        return None
    array = np.array(given, float)
    array.flags.writeable = False
    return array


def points(points: Sequence[Point]) -> NDArray[np.float64]:
    array = np.array(points, float).reshape(-1, 2)
    array.flags.writeable = False
    return array


def _rings(rings: list[dict[str, Any]]) -> NDArray[np.float64]:
    return np.array([[number(v) for v in r.values()] for r in rings], float).reshape(-1, 4)


def number(value: Any) -> float:
    """Return a number of the facts: undefined ones are None there, infinite ones texts."""
    return math.nan if value is None else float(value)


def _read(kind: Any, value: Any) -> Any:
    if isinstance(value, list):
        return tuple(v if isinstance(v, bool) else number(v) for v in value)
    return number(value) if kind is float else value


def row(kind: Callable[..., _Row], facts: dict[str, Any], **others: Any) -> _Row:
    """Return a row of the facts of a dataset, some of whose attributes are given."""
    values = {**facts, **others}
    return kind(**{f.name: _read(f.type, values[f.name]) for f in fields(kind)})  # type: ignore[arg-type]
