"""The keys of problem files as options of `Problem`, whose defaults are those of docs/problem.

Curves have angles in radians, as everywhere in Python; tables of problem files have degrees.
"""

import os
from collections.abc import Callable, Mapping, Sequence
from typing import Annotated, Any, Literal, TypedDict

from numpy.typing import ArrayLike

from ._options import UNSET, Option
from ._text import plain
from ._units import degrees, pair

#: A number, or a formula of x and y.
Value = float | str
Table = Mapping[str, Any]
PROGRESS = "True for a line on standard error; or a function of phase, parts done, all parts and step, which may raise to end it"


def _key(text: str, default: str = "") -> Option:
    """Describe a key; one that is left out has the default of problem files, by the solver."""
    return Option(UNSET, f"{text} [default: {default}]" if default else text)


class CurveOptions(TypedDict, total=False):
    """A curve, which is closed around a hole."""

    ellipse: Annotated[Table, _key("an ellipse, of a crack a part of one: `ppum.ellipse`, or a table of problem files")]
    spline: Annotated[ArrayLike, _key("points of a smooth curve, shape (n, 2)")]
    path: Annotated[Sequence[Table], _key("several curves, each from where the one before ends; those of holes have names")]
    bulges: Annotated[ArrayLike, _key("tan(sweep/4) of the edge behind each point, positive where it turns left; 0: a segment")]
    segments: Annotated[int, _key("has no effect any more")]


class HoleOptions(CurveOptions, total=False):
    """A circle, a polygon, or a curve."""

    center: Annotated[ArrayLike, _key("the centre of a circle")]
    radius: Annotated[float, _key("its radius")]
    points: Annotated[ArrayLike, _key("the corners of a polygon, shape (n, 2)")]


class CrackOptions(CurveOptions, total=False):
    """A curve in place of points, and the contact of the faces."""

    arc: Annotated[Table, _key("an arc of a circle: `ppum.arc`, or a table of problem files")]
    contact: Annotated[bool, _key("whether its faces press on each other where they touch, instead of overlapping", "False")]
    friction: Annotated[float, _key("the coefficient of friction between faces that touch", "0")]


class BoundaryOptions(TypedDict, total=False):
    """The supports and loads of an edge, a rim or the faces of a crack."""

    displacement: Annotated[Sequence[Value] | str, _key("[ux, uy], each a value, `free` or `exact`")]
    traction: Annotated[Sequence[Value] | str, _key("[tx, ty], each a value or `free`")]
    pressure: Annotated[Value, _key("pressure p: the traction −p n")]
    symmetry: Annotated[bool, _key("whether the normal displacement is 0, the other one free")]
    antisymmetry: Annotated[bool, _key("whether the tangential displacement is 0, the other one free")]
    value: Annotated[Value, _key("value u of a potential, or `exact`")]
    exchange: Annotated[Value, _key("coefficient of a potential's exchange with surroundings of that value")]
    flux: Annotated[Value, _key("flux of a potential into the plate")]


class SpaceOptions(TypedDict, total=False):
    """The functions."""

    refine: Annotated[bool, _key("whether cells are refined where the field needs it", "True")]
    order: Annotated[int | str, _key("degree of the polynomials, 0 to 8, or a formula of x and y", "2; 4 if nu > 0.476 in plane strain")]
    overlap: Annotated[float, _key("the factor by which a patch is larger than its cell, 1.01 to 1.99", "1.3")]
    weight: Annotated[str, _key("the weight function: linear, quadratic, cubic, bump, cosine, wendland, or a formula of t", "linear")]
    enrichment: Annotated[
        Literal["none", "tip-patch", "zone", "williams", "additive-only", "jumps"],
        _key("the functions in addition to polynomials", "williams"),
    ]
    interfaces: Annotated[bool, _key("whether interfaces of materials are resolved", "True")]
    enrichment_radius: Annotated[float, _key("radius of the zone around each tip", "a quarter of the crack's length")]
    tip_degree: Annotated[int, _key("degree of the polynomial at tips, 0 to 8", "1")]
    tip_terms: Annotated[int, _key("number of terms of Williams' series, 1 to 9", "the order, from 3 to 6")]


class DiscretizationOptions(SpaceOptions, total=False):
    """Cells and functions."""

    level: Annotated[int, _key("4^level cells, 0 to 10")]
    cells: Annotated[tuple[int, int], _key("columns and rows of cells")]
    points: Annotated[str | os.PathLike[str], _key("a file of points that cells are made around")]
    accuracy: Annotated[float, _key("the requested relative error of K, 1e-9 to 0.5")]


class SolveOptions(TypedDict, total=False):
    """The resources of a solution."""

    threads: Annotated[int | None, Option(None, "how many to work on; by default as many as there are processors")]
    memory: Annotated[int | None, Option(None, "bytes that may be used; a solution that needs more is refused")]
    progress: Annotated[bool | Callable[..., object], Option(False, PROGRESS)]


class GrowthOptions(TypedDict, total=False):
    """The growth of cracks."""

    criterion: Annotated[Literal["hoop", "local-symmetry", "energy"], _key("the direction in which a tip grows", "hoop")]
    increment: Annotated[float, _key("length by which the fastest tip grows in a step", "automatic")]
    toughness: Annotated[Value, _key("K_c: a tip of less strength stays", "none")]
    load: Annotated[Literal["constant", "critical"], _key("constant loads, or in each step those at which a tip reaches K_c", "constant")]
    rate: Annotated[str, _key("growth per cycle or unit of time: a formula of dk, kmax, ratio, ...")]
    paris: Annotated[Table, _key("Paris' law: a dictionary of c, m, threshold")]
    walker: Annotated[Table, _key("Walker's law: a dictionary of c, m, gamma, threshold")]
    forman: Annotated[Table, _key("Forman's law: a dictionary of c, m, threshold")]
    nasgro: Annotated[Table, _key("the law of NASGRO: a dictionary of c, m, p, q, threshold")]
    closure: Annotated[Table, _key("Newman's closure: a dictionary of alpha, stress")]
    ratio: Annotated[float, _key("the smallest load of a cycle in parts of the largest")]
    cycles: Annotated[Sequence[tuple[float, float, float]], _key("blocks of loads: number of cycles, largest, smallest load")]
    wheeler: Annotated[Table, _key("slower growth behind overloads: a dictionary of yield, exponent, constraint")]


class AdaptivityOptions(TypedDict, total=False):
    """The improvement of cells."""

    kind: Annotated[Literal["h", "p", "hp"], _key("divide cells, raise their order, or what suits each", "h")]
    steps: Annotated[int, _key("maximum number of improvements", "10")]
    fraction: Annotated[float, _key("the fraction of the squared error whose cells are improved, up to 1", "0.6")]
    max_unknowns: Annotated[int, _key("maximum number of unknowns of a step", "100000")]
    tolerance: Annotated[float, _key("the relative error in the energy norm that is small enough")]
    keep: Annotated[Literal["last", "all"], _key("the steps that the dataset keeps", "last")]


def arc(center: ArrayLike, radius: float, start: float, end: float) -> dict[str, Any]:
    """Return an arc of a circle, for `Problem.crack`.

    Args:
        center, radius: Centre and radius of the circle.
        start: The angle of the first point from the x axis, radians.
        end: The angle of the last point; the arc goes there counter-clockwise if it is larger, else clockwise.

    Example:
        >>> bent = plate.crack(arc=ppum.arc((0, 1), 0.4, np.pi, 1.5 * np.pi))
        >>> bent == plate.crack(arc={"center": (0, 1), "radius": 0.4, "from": 180, "to": 270})
        True
    """
    return {"center": pair(center), "radius": plain(radius), "from": degrees(start), "to": degrees(end)}


def ellipse(
    center: ArrayLike, axes: ArrayLike, angle: float = 0.0, *, start: float | None = None, end: float | None = None
) -> dict[str, Any]:
    """Return an ellipse, for `Problem.hole`; with `start` and `end` a part of one, for `Problem.crack`.

    Args:
        center, axes: Centre and half axes.
        angle: Angle of the first axis to the x axis, radians.
        start: The angle t of the first point `center + a cos t + b sin t`, a and b the half axes, radians.
        end: The angle t of the last point.

    Example:
        >>> plate.hole(ellipse=ppum.ellipse((0.5, 1.2), (0.2, 0.1), np.pi / 4)).check()
        ()
    """
    ends = {"from": start, "to": end}
    part = {name: degrees(value) for name, value in ends.items() if value is not None}
    return {"center": pair(center), "axes": pair(axes), "angle": degrees(angle), **part}
