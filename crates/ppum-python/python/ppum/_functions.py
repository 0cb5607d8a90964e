"""Functions that polynomials are multiplied with, as arrays of the file format."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from itertools import accumulate
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ._checks import check_shape, check_type, index, numbers, rows, scalar, sequence, short
from ._errors import BuildError
from ._text import plural


@dataclass(frozen=True)
class Jump:
    """The function +1 on the left of a crack's direction, -1 on its right. A Heaviside function is (1 + jump)/2."""

    crack: int


@dataclass(frozen=True)
class Level:
    """On meshes, the function +1 where a level field is ≥ 0, -1 where it is < 0: a field of one component, by its name."""

    field: str


@dataclass(frozen=True, eq=False)
class Component:
    """The function 1 on one connected part of what cracks leave of a patch, 0 on the others: a tree of cuts.

    Attributes:
        cuts: Rows of crack, segment, and the next cut on the left and the right, -1 for 0, -2 for 1; shape (k, 4).
    """

    cuts: ArrayLike


@dataclass(frozen=True, eq=False)
class Formula:
    """A function by a formula of x, y, r and theta in a frame: the world, a fixed one, that of a tip or of two level fields.

    Attributes:
        text: The formula, e.g. ``sqrt(r)*cos(theta/2)``; ``table(name, x)`` reads a table of the dataset.
        tip: Crack and end, ``start`` or ``end``, of a frame with x in the direction of growth; theta jumps on the crack.
        origin, angle: A fixed frame: its origin, and the angle of its x axis.
        levels: On meshes, names of the level fields ψ and φ that are x and y; theta jumps where φ = 0, ψ < 0.
        parameters: Constants that the formula may use, by name.
        kinks: Segments x0, y0, x1, y1 in the frame across which it or a derivative jumps; values do not depend on them.
        singular: Points in the frame where it or a derivative is infinite; values do not depend on them.
        role: Its purpose: ``tip``, ``corner``, ``force``, ``interface`` or ``user``; values do not depend on it.

    Example:
        >>> ppum.build.Formula("r^a*sin(a*theta)", tip=(0, "end"), parameters={"a": 0.7}).tip
        (0, 'end')
    """

    text: str
    tip: tuple[int, str] | None = None
    origin: tuple[float, float] | None = None
    angle: float = 0.0
    levels: tuple[str, str] | None = None
    parameters: Mapping[str, float] = field(default_factory=dict)
    kinks: ArrayLike = ()
    singular: ArrayLike = ()
    role: str = "user"


Function = Jump | Component | Level | Formula | str

#: The ends of a crack in the file format; `last` is taken too.
ENDS = {"start": "start", "end": "last", "last": "last"}

#: The square-root functions of a crack tip, r and theta in its frame.
TIP = {
    "sqrt(r) cos": "sqrt(r)*cos(theta/2)",
    "sqrt(r) sin": "sqrt(r)*sin(theta/2)",
    "sqrt(r) sin sin": "sqrt(r)*sin(theta)*sin(theta/2)",
    "sqrt(r) sin cos": "sqrt(r)*sin(theta)*cos(theta/2)",
}


def tip_functions(crack: int = 0, end: str = "end") -> dict[str, Formula]:
    """Return √r cos θ/2, √r sin θ/2, √r sin θ sin θ/2, √r sin θ cos θ/2 of a tip, by names that tell the tip.

    The tip is the ``start`` or ``end`` of a crack, as `Tip.end` has it.

    Example:
        >>> list(ppum.build.tip_functions(0, "end"))[0]
        'sqrt(r) cos of crack 0 end'
    """
    if str(end) not in ENDS:
        raise BuildError(f"end: {short(end)} is no end of a crack; give 'start' or 'end'")
    end = "end" if end == "last" else end
    return {f"{name} of crack {crack} {end}": Formula(text, (crack, end), role="tip") for name, text in TIP.items()}


def columns(functions: Mapping[str, Function], cracks: Sequence[int], fields: Sequence[str] = ()) -> dict[str, Any]:
    """Return the group `functions`; `cracks` has the number of segments of each crack, `fields` names of fields."""
    known = [_row(f"functions[{name!r}]", name, f, cracks, fields) for name, f in functions.items()]
    plain = ("name", "kind", "crack", "formula", "frame", "frame_end", "frame_origin", "frame_angle")
    arrays: dict[str, Any] = {key: [row[key] for row in known] for key in plain}
    arrays["frame_origin"] = np.array(arrays["frame_origin"], float).reshape(-1, 2)
    arrays["parameter_offsets"] = _offsets([row["parameters"] for row in known])
    arrays["parameter_name"] = [k for row in known for k in row["parameters"]]
    arrays["parameter_value"] = [float(v) for row in known for v in row["parameters"].values()]
    for name, offsets in (("cuts", "cut_offsets"), ("kinks", "kink_offsets"), ("singular", "singular_offsets")):
        if any(len(row[name]) for row in known):
            arrays[offsets] = _offsets([row[name] for row in known])
            arrays[name] = np.concatenate([row[name] for row in known])
    if any(row["levels"] != (-1, -1) for row in known):
        arrays["levels"] = [row["levels"] for row in known]
    if any(row["role"] for row in known):
        arrays["role"] = [row["role"] for row in known]
    return arrays


def _offsets(lists: Sequence[Any]) -> list[int]:
    return [0, *accumulate(len(one) for one in lists)]


def _row(place: str, name: str, function: Function, cracks: Sequence[int], fields: Sequence[str]) -> dict[str, Any]:
    row = {
        "name": name, "kind": "one", "crack": -1, "formula": "", "frame": "", "frame_end": "",
        "frame_origin": (0.0, 0.0), "frame_angle": 0.0, "parameters": {},
        "cuts": np.empty((0, 4), np.int64), "kinks": np.empty((0, 4)), "singular": np.empty((0, 2)),
        "levels": (-1, -1), "role": "",
    }  # fmt: skip
    if isinstance(function, str):
        function = Formula(function)
    if isinstance(function, Jump):
        return row | {"kind": "side", "crack": _crack(place, function.crack, cracks)}
    if isinstance(function, Component):
        return row | {"kind": "component", "cuts": _cuts(place, function, cracks)}
    if isinstance(function, Level):
        return row | {"kind": "level", "levels": (-1, level_field(place, function.field, fields))}
    if isinstance(function, Formula):
        return row | {"kind": "formula", "formula": function.text} | _frame(place, function, cracks, fields)
    if function is None and name == "one":
        return row
    raise BuildError(f"{place}: is {type(function).__name__}; give a Jump, a Component, a Level, a Formula or its text")


def _frame(place: str, f: Formula, cracks: Sequence[int], fields: Sequence[str]) -> dict[str, Any]:
    check_type(f"{place}.text", f.text, isinstance(f.text, str), "a formula as text, such as 'sqrt(r)*cos(theta/2)'")
    check_type(f"{place}.parameters", f.parameters, isinstance(f.parameters, Mapping), "a dictionary of names and numbers")
    row: dict[str, Any] = {
        "frame": "world",
        "role": f.role,
        "parameters": {str(k): scalar(f"{place}.parameters[{k!r}]", v) for k, v in f.parameters.items()},
        "kinks": rows(f"{place}.kinks", f.kinks, 4),
        "singular": rows(f"{place}.singular", f.singular, 2),
    }
    angle = scalar(f"{place}.angle", f.angle)
    frames = [f.tip is not None, f.levels is not None, f.origin is not None or bool(angle)]
    if sum(frames) > 1:
        raise BuildError(f"{place}: has several frames; leave out all but one of `tip`, `levels`, or `origin` and `angle`")
    if f.levels is not None:
        names = sequence(f"{place}.levels", f.levels, "two level fields")
        if len(names) != 2:
            raise BuildError(f"{place}.levels: has {len(names)} names; give two, of ψ and φ")
        levels = tuple(level_field(f"{place}.levels", name, fields) for name in names)
        return row | {"frame": "levels", "levels": levels}
    if f.tip is not None:
        crack, end = [*sequence(f"{place}.tip", f.tip, "crack and end"), "", ""][:2]
        if len(list(f.tip)) != 2 or str(end) not in ENDS:
            raise BuildError(f"{place}.tip: {short(f.tip)} is no tip; give the number of a crack, and 'start' or 'end'")
        return row | {"frame": "tip", "frame_end": ENDS[str(end)], "crack": _crack(f"{place}.tip", crack, cracks)}
    if f.origin is not None or angle:
        origin = numbers(f"{place}.origin", (0, 0) if f.origin is None else f.origin)
        check_shape(f"{place}.origin", origin, origin.shape == (2,), "(2,): a point")
        if not abs(angle) <= 2 * np.pi:
            raise BuildError(f"{place}.angle: {angle:g} is more than a turn; angles are in radians, see math.radians")
        row |= {"frame": "fixed", "frame_origin": tuple(origin), "frame_angle": angle}
    return row


def level_field(place: str, name: str, fields: Sequence[str]) -> int:
    if name not in fields[1:]:
        known = ", ".join(map(repr, fields[1:])) or "none"
        raise BuildError(f"{place}: names {short(name)}, which is no field after the first; there are {known}")
    return list(fields).index(name)


def _crack(place: str, crack: int, cracks: Sequence[int]) -> int:
    found = index(crack, len(cracks))
    if found is None:
        there = f"there {'is' if len(cracks) == 1 else 'are'} {plural(len(cracks), 'crack')}"
        raise BuildError(f"{place}: names crack {short(crack)}, but {there}, counted from 0")
    return found


def _cuts(place: str, component: Component, cracks: Sequence[int]) -> NDArray[np.int64]:
    given = rows(f"{place}.cuts", component.cuts, 4)
    cuts = given.astype(np.int64)
    if (cuts != given).any():
        raise BuildError(f"{place}.cuts: expected whole numbers, rows of crack, segment, left and right")
    for k, (crack, segment, *_) in enumerate(cuts.tolist()):
        count = cracks[_crack(f"{place}.cuts[{k}]", crack, cracks)]
        if not 0 <= segment < count:
            raise BuildError(f"{place}.cuts[{k}]: names segment {segment}, but crack {crack} has {count}")
    return cuts
