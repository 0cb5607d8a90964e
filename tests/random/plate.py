"""The geometry of random plates: box, holes, cracks."""

import math

import shapes

EDGES = ("left", "right", "bottom", "top")
DEGREE = math.pi / 180


class Misfit(Exception):
    """What was drawn does not fit together; draw again."""


def demand(condition):
    if not condition:
        raise Misfit


class Plate:
    """A box with holes and cracks, in units of its shorter side, the lower left corner at 0.

    `scale` and `origin` place it; `blocked` are the edges that a crack or a notch opens: they are not held.
    """

    def __init__(self, draw, kind):
        self.draw, self.kind = draw, kind
        self.margin = 0.04 if draw.chance(0.08) else 0.08
        self.holes, self.cracks, self.blocked, self.cut, self.notched = [], [], set(), False, False
        self.place()
        getattr(self, BUILDERS.get(kind, "any_crack"))()
        if kind in ("anything", "face pressure", "balanced", "poisson") and draw.chance(0.5):
            self.add_crack(self.straight(0.2, 0.45))
        if kind in ("anything", "body force", "graded and loaded") and draw.chance(0.4):
            self.add_hole(self.circle())
        if draw.chance(0.5):
            self.cracks = [points[::-1] for points in self.cracks]

    # ---- the box

    def place(self):
        draw = self.draw
        shape = draw.random()
        ratio = draw.pick(1.5, 2.0) if shape < 0.3 else 1.0
        self.size = [ratio, 1.0] if draw.chance(0.4) else [1.0, ratio]
        self.scale = draw.pick(2.0, 2.0, 2.0, 1.0, 1.0, 0.1, 10.0, 100.0)
        self.origin = [-s * self.scale / 2 for s in self.size]
        if draw.chance(0.4):
            self.origin = [draw.pick(0.0, 1.0, draw.between(-3, 3)) * self.scale for _ in (0, 1)]
        self.digits = 4 - math.floor(math.log10(self.scale))

    def at(self, point):
        """A point of the file."""
        return [round(self.origin[i] + self.scale * point[i], self.digits) for i in (0, 1)]

    def coordinate(self, value, axis):
        return self.at([value, value])[axis]

    def length(self, value):
        return round(self.scale * value, self.digits)

    def border(self):
        w, h = self.size
        return shapes.segments([(0.0, 0.0), (w, 0.0), (w, h), (0.0, h)], closed=True)

    def inside(self, point, margin):
        return all(margin <= point[i] <= self.size[i] - margin for i in (0, 1))

    def anywhere(self, margin):
        return tuple(self.draw.between(margin, s - margin) for s in self.size)

    # ---- cracks

    def straight(self, low, high):
        length, angle = self.draw.between(low, high), self.draw.between(0, 360) * DEGREE
        if self.draw.chance(0.15):
            angle = self.draw.pick(0.0, 90.0, 180.0) * DEGREE
        centre = self.anywhere(0.15)
        return [shapes.moved(centre, angle, -length / 2), shapes.moved(centre, angle, length / 2)]

    def kinked(self, start, angle, count, low, high):
        """A polyline from a point, with kinks between two angles."""
        points = [start, shapes.moved(start, angle, self.draw.between(0.14, 0.32))]
        for _ in range(count):
            angle += self.draw.sign() * self.draw.between(low, high) * DEGREE
            points.append(shapes.moved(points[-1], angle, self.draw.between(0.12, 0.28)))
        return points

    def crack_with_kinks(self, low, high):
        count = self.draw.pick(1, 1, 2, 3) if high < 60 else self.draw.pick(1, 1, 2)
        return self.kinked(self.anywhere(0.1), self.draw.between(0, 360) * DEGREE, count, low, high)

    def mouth(self):
        """A point of the border, its edge and the direction inwards."""
        edge = self.draw.pick(*EDGES)
        along = self.draw.between(0.25, 0.75)
        w, h = self.size
        return edge, *{"left": ((0.0, along * h), 0.0), "right": ((w, along * h), math.pi),
                       "bottom": ((along * w, 0.0), math.pi / 2), "top": ((along * w, h), -math.pi / 2)}[edge]

    def edge_crack(self, kinks=0):
        edge, start, angle = self.mouth()
        if self.draw.chance(0.6):
            angle += self.draw.between(-50, 50) * DEGREE
        points = [start, shapes.moved(start, angle, self.draw.between(0.2, 0.55))]
        if kinks:
            points = self.kinked(start, angle, kinks, 10, self.draw.pick(45, 90))
        self.blocked.add(edge)
        self.add_crack(points, mouths=1)

    def add_crack(self, points, mouths=0, hole=None):
        """Adds a crack if it lies clear of all else; `mouths` ends lie on the border, and it may start in a hole."""
        inner = points[:] if mouths == 0 else points[1:] if mouths == 1 else points[1:-1]
        parts, margin = shapes.segments(points), self.margin
        demand(all(self.inside(p, margin) for p in (inner if hole is None else points[1:])))
        demand(not shapes.hooked(points))
        for i, part in enumerate(parts):
            demand(all(shapes.between_segments(part, other) > 0.06 for other in parts[i + 2:]))
        for other in self.cracks:
            demand(shapes.apart(parts, shapes.segments(other)) > margin)
        for k, other in enumerate(self.holes):
            demand(k == hole or gap(other, parts) > margin)
        self.cracks.append(points)

    # ---- holes

    def circle(self, low=0.08, high=0.2):
        radius = self.draw.between(low, high)
        return {"center": self.anywhere(radius + self.margin), "radius": radius}

    def polygon(self, low=0.1, high=0.24):
        count, radius = self.draw.pick(3, 4, 5, 6, 7), self.draw.between(low, high)
        least = self.draw.pick(1.0, 0.8, 0.5)
        centre, start = self.anywhere(radius + self.margin), self.draw.between(0, 360)
        points = [shapes.moved(centre, (start + 360 * (k + self.draw.between(-0.15, 0.15)) / count) * DEGREE,
                               radius * self.draw.between(least, 1.0)) for k in range(count)]
        demand(min(shapes.corner_angles(points)) > 30 * DEGREE)
        demand(min(math.dist(a, b) for a, b in rim(points)) > 0.06)
        return {"center": centre, "points": points}

    def add_hole(self, hole):
        parts = outline(hole)
        demand(shapes.apart(parts, self.border()) > self.margin)
        self.add_rim(hole, parts)

    def add_rim(self, hole, parts):
        demand(all(shapes.apart(parts, outline(other)) > self.margin for other in self.holes))
        demand(all(gap(hole, shapes.segments(crack)) > self.margin for crack in self.cracks))
        self.holes.append(hole)

    def add_notch(self):
        """A hole over an edge: a circle, a wedge, a slot, or a quarter of a circle over a corner."""
        draw, (edge, at, angle) = self.draw, self.mouth()
        form = draw.pick("circle", "circle", "wedge", "slot", "corner")
        wide, deep = draw.between(0.06, 0.14), draw.between(0.1, 0.25)
        side = angle + math.pi / 2
        if form == "circle":
            hole = {"center": shapes.moved(at, angle, draw.pick(0.0, draw.between(-0.5, 0.5) * wide)), "radius": 1.3 * wide}
        elif form == "wedge":
            bases = [shapes.moved(shapes.moved(at, angle, -0.05), side, s * wide) for s in (-1, 1)]
            hole = {"points": [*bases, shapes.moved(shapes.moved(at, angle, deep), side, draw.between(-1, 1) * wide)]}
        elif form == "slot":
            low, high = (shapes.moved(at, angle, d) for d in (-0.05, deep))
            hole = {"points": [shapes.moved(p, side, s * wide) for p, s in ((low, -1), (low, 1), (high, 1), (high, -1))]}
        else:
            corner = [draw.pick(0.0, s) for s in self.size]
            hole = {"center": tuple(corner), "radius": draw.between(0.12, 0.3)}
        self.notched = True
        if form != "corner":
            self.blocked.add(edge)
        self.add_rim(hole, outline(hole))

    # ---- kinds

    def straight_crack(self):
        self.add_crack(self.straight(0.2, 0.7))

    def several_cracks(self):
        for _ in range(self.draw.pick(2, 2, 3)):
            self.draw.pick(self.edge_crack, lambda: self.add_crack(self.straight(0.16, 0.45)),
                           lambda: self.add_crack(self.straight(0.16, 0.45)),
                           lambda: self.add_crack(self.crack_with_kinks(10, 50)))()

    def kinked_crack(self):
        self.add_crack(self.crack_with_kinks(10, 60))

    def sharp_kink(self):
        self.add_crack(self.crack_with_kinks(60, 120))

    def kinked_edge_crack(self):
        self.edge_crack(self.draw.pick(1, 2))

    def cut_plate(self):
        """A crack from border to border, and mostly another in one of the pieces."""
        across = self.draw.pick(0, 1)
        self.across, self.cut = across, True
        self.blocked |= {EDGES[2 * across], EDGES[2 * across + 1]}
        length, height = self.size[across], self.size[1 - across]
        level = self.draw.between(0.3, 0.7) * height
        self.level = self.draw.chance(0.5)
        steps = [0.0, 1.0] if self.level else [0.0, *([self.draw.between(0.35, 0.65)] * self.draw.pick(0, 1)), 1.0]
        points = [(t * length, level if self.level else level + self.draw.between(-0.15, 0.15)) for t in steps]
        self.add_crack([(p[across], p[1 - across]) for p in points], mouths=2)
        if self.draw.chance(0.85):
            self.add_crack(self.straight(0.16, 0.4))

    def any_crack(self):
        self.draw.pick(self.straight_crack, self.straight_crack, self.edge_crack, self.kinked_crack)()

    def crack_from_a_hole(self):
        hole = self.circle(0.1, 0.2) if self.draw.chance(0.75) else self.polygon(0.12, 0.22)
        self.add_hole(hole)
        angle = self.draw.between(0, 360) * DEGREE
        for turn in self.draw.pick((0,), (0,), (180,), (0, self.draw.between(120, 240))):
            self.crack_out_of(hole, angle + turn * DEGREE)

    def crack_out_of(self, hole, angle):
        parts, centre = outline(hole), hole["center"]
        # cracks out of one hole start at points of their own in it
        points = [shapes.moved(centre, angle, d) for d in (0.03, self.draw.between(0.3, 0.5))]
        if self.draw.chance(0.3):
            angle += self.draw.sign() * self.draw.between(10, 50) * DEGREE
            points.append(shapes.moved(points[-1], angle, self.draw.between(0.12, 0.2)))
        crossed = [part for part in parts if any(shapes.intersect(part, other) for other in shapes.segments(points))]
        demand(len(crossed) == 1 and min(min(shapes.to_segment(p, part) for part in parts) for p in points[1:]) > 0.12)
        if "points" in hole:
            demand(min(shapes.to_segment(p, points[:2]) for p in hole["points"]) > 0.04)
        for other in self.cracks:
            demand(shapes.apart(shapes.segments(points)[1:], shapes.segments(other)) > self.margin)
            demand(min(shapes.to_segment(p, s) for p in points[1:] for s in shapes.segments(other)) > 0.15)
        others, self.cracks = self.cracks, []
        # what was demanded above keeps cracks out of one hole apart
        self.add_crack(points, hole=self.holes.index(hole))
        self.cracks = others + self.cracks

    def crack_beside_a_hole(self):
        for _ in range(self.draw.pick(1, 1, 2)):
            self.add_hole(self.circle(0.08, 0.22))
        self.any_crack()

    def polygon_hole(self):
        self.add_hole(self.polygon())
        self.any_crack()

    def notch(self):
        self.add_notch()
        if self.draw.chance(0.8):
            self.any_crack()

    def rim_pressure(self):
        self.add_hole(self.circle(0.1, 0.25) if self.draw.chance(0.75) else self.polygon())
        if self.draw.chance(0.8):
            self.any_crack()

    def hole_alone(self):
        for _ in range(self.draw.pick(1, 1, 2)):
            self.add_hole(self.circle(0.1, 0.3) if self.draw.chance(0.7) else self.polygon(0.12, 0.3))
        if self.draw.chance(0.25) and "radius" in self.holes[0]:
            first = self.holes[0]
            second = {"center": shapes.moved(first["center"], self.draw.between(0, 6.3), first["radius"]),
                      "radius": first["radius"] * self.draw.between(0.6, 1.0)}
            demand(len(self.holes) == 1 and shapes.apart(outline(second), self.border()) > self.margin)
            self.holes.append(second)

    def poisson_hole(self):
        self.draw.pick(self.hole_alone, self.polygon_hole, self.add_notch, self.crack_from_a_hole)()

    # ---- text

    def words(self):
        cracks, holes = (f"{len(items)} {name}{'s' * (len(items) != 1)}"
                         for items, name in ((self.cracks, "crack"), (self.holes, "hole")))
        return f"{cracks}, {holes}" if self.holes else cracks

    def text_of_domain(self):
        return f"[domain]\nmin = {self.at((0.0, 0.0))}\nmax = {self.at(self.size)}\n"

    def text(self):
        parts = [self.text_of_hole(hole) for hole in self.holes]
        parts += [f"[[crack]]\npoints = {[self.at(p) for p in points]}\n" for points in self.cracks]
        return "\n".join(parts)

    def text_of_hole(self, hole):
        if "radius" in hole:
            return f"[[hole]]\ncenter = {self.at(hole['center'])}\nradius = {self.length(hole['radius'])}\n"
        points = [self.at(p) for p in hole["points"]]
        # either direction is allowed
        return f"[[hole]]\npoints = {points if len(points) % 2 else points[::-1]}\n"


def rim(points):
    return shapes.segments(points, closed=True)


def outline(hole):
    """The rim of a hole as segments; of a circle, 48 chords."""
    if "points" in hole:
        return rim(hole["points"])
    return rim([shapes.moved(hole["center"], k * 7.5 * DEGREE, hole["radius"]) for k in range(48)])


def gap(hole, parts):
    """The distance of a hole from segments, 0 if one lies inside."""
    edge = outline(hole)
    inside = shapes.contains([a for a, _ in edge], parts[0][0])
    return 0.0 if inside else shapes.apart(edge, parts)


BUILDERS = {kind: kind.replace(" ", "_") for kind in (
    "straight crack", "several cracks", "kinked crack", "sharp kink", "edge crack", "kinked edge crack", "cut plate",
    "crack from a hole", "crack beside a hole", "polygon hole", "notch", "rim pressure", "hole alone", "poisson hole")}
