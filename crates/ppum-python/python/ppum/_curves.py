"""Curves of cracks and holes, with angles in radians as everywhere in Python; tables of problem files have degrees."""

from typing import Any

from numpy.typing import ArrayLike

from ._text import plain
from ._units import degrees, pair


def arc(center: ArrayLike, radius: float, start: float, end: float) -> dict[str, Any]:
    """An arc of a circle, for `Problem.crack`.

    Args:
        center: Of the circle.
        radius: Of the circle.
        start: The angle of the first point from the x axis, radians.
        end: That of the last point; the arc goes there counter-clockwise if it is larger, else clockwise.

    Example:
        >>> bent = plate.crack(arc=ppum.arc((0, 1), 0.4, np.pi, 1.5 * np.pi))
        >>> bent == plate.crack(arc={"center": (0, 1), "radius": 0.4, "from": 180, "to": 270})
        True
    """
    return {"center": pair(center), "radius": plain(radius), "from": degrees(start), "to": degrees(end)}


def ellipse(
    center: ArrayLike, axes: ArrayLike, angle: float = 0.0, *, start: float | None = None, end: float | None = None
) -> dict[str, Any]:
    """An ellipse, for `Problem.hole`; with `start` and `end` a part of one, for `Problem.crack`.

    Args:
        center: Its centre.
        axes: Its half axes.
        angle: Of the first axis to the x axis, radians.
        start: The angle t of the first point `center + a cos t + b sin t`, a and b the half axes, radians.
        end: That of the last one.

    Example:
        >>> plate.hole(ellipse=ppum.ellipse((0.5, 1.2), (0.2, 0.1), np.pi / 4)).check()
        ()
    """
    ends = {"from": start, "to": end}
    part = {name: degrees(value) for name, value in ends.items() if value is not None}
    return {"center": pair(center), "axes": pair(axes), "angle": degrees(angle), **part}
