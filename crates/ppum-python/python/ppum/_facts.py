"""Rows of the facts of datasets: cracks, tips, warnings, reactions, growth."""

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass, field, fields
from typing import Any, TypeVar

import numpy as np
from numpy.typing import NDArray

from ._tables import Table

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
    """A hole: a circle (`center`, `radius`) or a polygon (`points`, shape (n, 2)); the others are None.

    With `is_outside` it is all that is outside of the polygon, which is the outline of the body.
    """

    center: Point | None = None
    radius: float | None = None
    points: NDArray[np.float64] | None = None
    is_outside: bool = False


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


def tips_of(facts: list[dict[str, Any]], ends: Sequence[str]) -> Table[Tip]:
    """The tips of facts, and of the names of their ends."""
    both = zip(facts, ends, strict=True)
    tips = (row(Tip, t, end=end, xy=t["tip"], rings=_rings(t["rings"])) for t, end in both)
    return Table(tips, "tip")


def points(points: Sequence[Point]) -> NDArray[np.float64]:
    array = np.array(points, float).reshape(-1, 2)
    array.flags.writeable = False
    return array


def _rings(rings: list[dict[str, Any]]) -> NDArray[np.float64]:
    return np.array([[number(v) for v in r.values()] for r in rings], float).reshape(-1, 4)


def number(value: Any) -> float:
    """A number of the facts: undefined ones are null there, infinite ones texts."""
    return math.nan if value is None else float(value)


def _numbers(values: Sequence[Any]) -> tuple[float, ...]:
    return tuple(number(v) for v in values)


_READERS: dict[Any, Callable[[Any], Any]] = {
    float: number,
    Point: tuple,
    Point | None: lambda point: None if point is None else tuple(point),
    tuple[bool, ...]: tuple,
    tuple[float, ...]: _numbers,
}


def row(kind: Callable[..., _Row], facts: dict[str, Any], **others: Any) -> _Row:
    """A row of the facts of a dataset, some of whose attributes are given."""
    values = {**facts, **others}
    attributes = fields(kind)  # type: ignore[arg-type]
    return kind(**{f.name: _READERS.get(f.type, lambda v: v)(values[f.name]) for f in attributes})
