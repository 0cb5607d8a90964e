"""Points, segments and polygons of the plate: distances, and what lies inside."""

import math


def moved(point, angle, length):
    """The point at a distance in a direction."""
    return point[0] + length * math.cos(angle), point[1] + length * math.sin(angle)


def segments(points, closed=False):
    """The segments of a polyline, or of a polygon."""
    ends = points[1:] + points[:1] if closed else points[1:]
    return list(zip(points, ends))


def cross(a, b, c):
    """Twice the area of a triangle, positive if it is counterclockwise."""
    return (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])


def intersect(first, second):
    """Whether two segments cross."""
    (a, b), (c, d) = first, second
    return cross(a, b, c) * cross(a, b, d) < 0 and cross(c, d, a) * cross(c, d, b) < 0


def to_segment(point, segment):
    """The distance of a point from a segment."""
    (ax, ay), (bx, by) = segment
    dx, dy = bx - ax, by - ay
    t = ((point[0] - ax) * dx + (point[1] - ay) * dy) / (dx * dx + dy * dy)
    t = min(1.0, max(0.0, t))
    return math.dist(point, (ax + t * dx, ay + t * dy))


def between_segments(first, second):
    """The distance of two segments."""
    if intersect(first, second):
        return 0.0
    return min(*(to_segment(p, second) for p in first), *(to_segment(p, first) for p in second))


def apart(first, second):
    """The distance of two lists of segments."""
    return min((between_segments(a, b) for a in first for b in second), default=math.inf)


def contains(polygon, point):
    """Whether a point lies in a polygon."""
    inside = False
    for (ax, ay), (bx, by) in segments(polygon, closed=True):
        if (ay > point[1]) != (by > point[1]):
            inside ^= point[0] < ax + (point[1] - ay) / (by - ay) * (bx - ax)
    return inside


def corner_angles(polygon):
    """The angles at the corners, each between 0 and pi."""
    around = zip(polygon[-1:] + polygon[:-1], polygon, polygon[1:] + polygon[:1])
    for before, at, after in around:
        turn = math.atan2(before[1] - at[1], before[0] - at[0]) - math.atan2(after[1] - at[1], after[0] - at[0])
        yield abs((turn + math.pi) % (2 * math.pi) - math.pi)


def hooked(points):
    """Whether the straight extension of an end meets the polyline."""
    for way in (points, points[::-1]):
        tip, before = way[0], way[1]
        angle = math.atan2(tip[1] - before[1], tip[0] - before[0])
        ray = (tip, moved(tip, angle, 100.0))
        if any(intersect(ray, part) for part in segments(way)[1:]):
            return True
    return False
