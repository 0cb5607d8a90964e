"""Edges between points, segments and arcs of circles: an arc has a bulge, tan(sweep / 4), positive where it turns left."""

import math

import numpy as np
from numpy.typing import NDArray

#: Sweep of the chords that arcs are drawn by: off by 2e-6 of the radius.
CHORD = math.radians(0.25)

Points = NDArray[np.float64]


def length(points: Points, bulges: Points | None) -> float:
    """Return the length of a chain of edges."""
    return float(lengths(points, bulges).sum())


def lengths(points: Points, bulges: Points | None) -> Points:
    """Return the lengths of edges."""
    chords = np.asarray(np.hypot(*np.diff(points, axis=0).T))
    if bulges is None:
        return chords
    curved = np.where(bulges == 0, 1, bulges)
    return np.asarray(chords * np.where(bulges == 0, 1, (1 + curved**2) * np.arctan(curved) / curved))


def polyline(points: Points, bulges: Points | None) -> Points:
    """Return points of a chain of edges that are close enough on arcs to draw them by chords."""
    if bulges is None:
        return points
    lines = [_flat(a, b, float(bulge)) for a, b, bulge in zip(points, points[1:], bulges)]
    return np.concatenate([points[:1], *lines])


def _flat(a: Points, b: Points, bulge: float) -> Points:
    """Return points of an edge, without the first."""
    count = max(1, math.ceil(abs(4 * math.atan(bulge)) / CHORD))
    parts = np.arange(1, count) / count
    way, _ = along(np.broadcast_to(b - a, (count - 1, 2)), np.full(count - 1, bulge), parts)
    return np.concatenate([a + way, b[None]])


def along(chords: Points, bulges: Points, parts: Points) -> tuple[Points, Points]:
    """Return the way from the first end of edges to parts of their lengths, and the unit tangents there; shapes (k, 2)."""
    half = 2 * np.arctan(bulges)
    # the chord of a part of the arc is turned by half of what the arc turns less
    size = np.where(half == 0, parts, np.sin(half * parts) / np.where(half == 0, 1, np.sin(half)))
    tangents = _turned(chords / np.hypot(*chords.T)[:, None], half * (2 * parts - 1))
    return _turned(chords, half * (parts - 1)) * size[:, None], tangents


def _turned(vectors: Points, angles: Points) -> Points:
    (x, y), cos, sin = vectors.T, np.cos(angles), np.sin(angles)
    return np.column_stack([cos * x - sin * y, sin * x + cos * y])


def distance(p: Points, points: Points, bulges: Points | None) -> float:
    """Return the distance from a point to a chain of edges."""
    chords = np.diff(points, axis=0)
    given = np.zeros(len(chords)) if bulges is None else bulges
    left = np.column_stack([-chords[:, 1], chords[:, 0]])
    # the way from the middle, along the chord and across it, in chords
    way = p - (points[:-1] + points[1:] - left * given[:, None]) / 2
    size = (chords**2).sum(axis=1)
    t, n = (way * chords).sum(axis=1) / size, (way * left).sum(axis=1) / size
    bend, sweep = 4 * given / (1 + given**2), 4 * np.arctan(given)
    parts = np.where(given == 0, t, np.arctan2(bend * t, 1 - bend * n) / np.where(given == 0, 1, sweep)) + 0.5
    closest, _ = along(chords, given, np.clip(parts, 0, 1))
    return float(np.hypot(*(points[:-1] + closest - p).T).min())
