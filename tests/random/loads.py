"""Random supports and loads."""

import math

from materials import number, quoted, shifted
from plate import EDGES, demand

OPPOSITE = {"left": "right", "right": "left", "bottom": "top", "top": "bottom"}
AXIS = {"left": 0, "right": 0, "bottom": 1, "top": 1}
OUTWARDS = {"left": -1.0, "right": 1.0, "bottom": -1.0, "top": 1.0}


def given(components):
    """A pair of components as it stands in the file."""
    return "[" + ", ".join('"free"' if c is None else quoted(c) for c in components) + "]"


class Loads:
    """The conditions of a problem, as they are drawn."""

    def __init__(self, draw, plate, made):
        self.draw, self.plate = draw, plate
        self.stress = draw.pick(1.0, 1.0, 20.0) * draw.between(0.5, 1.5)
        if made.stiffness > 1e4:
            self.stress *= 50.0
        self.moved = self.stress / made.stiffness * plate.scale
        self.entries, self.force, self.said = [], "", []
        self.loaded = set()

    def add(self, on, **conditions):
        self.entries.append("[[boundary]]\non = " + on + "\n" + "".join(f"{k} = {v}\n" for k, v in conditions.items()))

    def edge(self, edge, **conditions):
        """Conditions on a whole edge."""
        self.loaded.add(edge)
        self.add(f'"{edge}"', **conditions)

    def piece(self, edge, low, high, **conditions):
        """Conditions on a piece of an edge, from and to in parts of its length."""
        axis = 1 - AXIS[edge]
        ends = [self.plate.coordinate(t * self.plate.size[axis], axis) for t in (low, high)]
        self.add(f'{{ edge = "{edge}", from = {ends[0]}, to = {ends[1]} }}', **conditions)

    def text(self):
        return "\n".join([*self.entries, self.force] if self.force else self.entries)

    @property
    def words(self):
        return ", ".join(self.said)

    def centred(self, axis):
        """`(x - middle)/length` along an axis."""
        plate = self.plate
        low, high = (plate.coordinate(v, axis) for v in (0.0, plate.size[axis]))
        return f"{shifted('xy'[axis], round((low + high) / 2, 6))}/{number(high - low)}"

    def varied(self, value, edge):
        """A value, or a linear formula along an edge."""
        if self.draw.chance(0.65):
            return value
        return f"{number(value)} + {number(value * self.draw.between(-1.5, 1.5))}*{self.centred(1 - AXIS[edge])}"

    def pull(self, edge, shear=True):
        """A traction on a whole edge, mostly pulling."""
        normal = self.stress * OUTWARDS[edge] * self.draw.pick(1.0, 1.0, self.draw.between(-1, 1))
        across = self.stress * self.draw.pick(0.0, self.draw.between(-0.6, 0.6)) if shear else 0.0
        pair = [self.varied(normal, edge), self.varied(across, edge) if across else 0.0]
        self.edge(edge, traction=given(pair if AXIS[edge] == 0 else pair[::-1]))

    def free_edge(self):
        """An edge that a crack or a notch does not open, to be held."""
        choices = [edge for edge in EDGES if edge not in self.plate.blocked]
        demand(choices)
        return self.draw.pick(*choices)

    # ---- supports with loads

    def rollers(self):
        """Two edges slide, the others are pulled."""
        first = self.free_edge()
        second = self.free_edge()
        demand(AXIS[first] != AXIS[second])
        for edge in (first, second):
            self.edge(edge, symmetry="true")
        others = [OPPOSITE[first], OPPOSITE[second]]
        self.pull(others[0])
        if self.draw.chance(0.5):
            self.pull(others[1], shear=self.draw.chance(0.3))
        self.said.append("rollers")

    def balanced(self):
        """Tractions of a stress field that is linear and in equilibrium, on all edges; nothing is held."""
        draw, s = self.draw, self.stress
        demand(not self.plate.notched)
        xx, yy, xy = s * draw.pick(0.0, draw.between(-0.5, 1)), s, s * draw.pick(0.0, draw.between(-0.6, 0.6))
        a, b, c, d = (s * draw.between(-0.8, 0.8) / self.plate.scale * draw.pick(0, 1) for _ in range(4))
        middle = self.plate.at([v / 2 for v in self.plate.size])
        x, y = (shifted(n, m) for n, m in zip("xy", middle))

        def field(constant, of_x, of_y):
            terms = [number(constant)] + [f"{number(k)}*{v}" for k, v in ((of_x, x), (of_y, y)) if k]
            return " + ".join(terms).replace("+ -", "- ") if len(terms) > 1 else constant

        stress = [[(xx, c, d), (xy, -b, -c)], [(xy, -b, -c), (yy, a, b)]]
        for edge in EDGES:
            sign = OUTWARDS[edge]
            row = stress[AXIS[edge]]
            self.edge(edge, traction=given([field(*(sign * v if v else 0.0 for v in entry)) for entry in row]))
        self.said.append("balanced tractions")

    def pulled(self):
        """Two opposite edges are moved apart and slide; nothing holds the motion along them."""
        edge = self.free_edge()
        demand(OPPOSITE[edge] not in self.plate.blocked)
        for side, value in ((edge, 0.0), (OPPOSITE[edge], self.moved * OUTWARDS[OPPOSITE[edge]])):
            if value and self.draw.chance(0.3):
                value = f"{number(value)}*(1 + {number(self.draw.between(-0.8, 0.8))}*{self.centred(1 - AXIS[edge])})"
            pair = [None, None]
            pair[AXIS[edge]] = value
            self.edge(side, displacement=given(pair))
        if self.draw.chance(0.3):
            along = self.stress * self.draw.between(-0.5, 0.8)
            for side in EDGES:
                if AXIS[side] != AXIS[edge] and not self.plate.notched:
                    pair = [0.0, 0.0]
                    pair[AXIS[side]] = along * OUTWARDS[side]
                    self.edge(side, traction=given(pair))
        self.said.append("moved edges that slide")

    def clamped(self):
        """One edge is clamped, the others pulled."""
        edge = self.free_edge()
        self.edge(edge, displacement="[0, 0]")
        self.pull(OPPOSITE[edge])
        if self.draw.chance(0.3):
            self.pull(self.draw.pick(*(e for e in EDGES if AXIS[e] != AXIS[edge])), shear=False)
        self.said.append("a clamped edge")

    def gripped(self):
        """Two opposite edges are clamped, and one is moved."""
        edge = self.free_edge()
        demand(OPPOSITE[edge] not in self.plate.blocked)
        self.edge(edge, displacement="[0, 0]")
        motion = [self.moved * self.draw.between(-0.6, 0.6), self.moved * OUTWARDS[OPPOSITE[edge]]]
        self.edge(OPPOSITE[edge], displacement=given(motion if AXIS[edge] else motion[::-1]))
        self.said.append("two clamped edges")

    def enclosed(self):
        """A smooth displacement is given on the whole border."""
        demand(not self.plate.blocked and not self.plate.notched)
        rate = self.moved / self.plate.scale
        x, y = (shifted(n, c) for n, c in zip("xy", self.plate.at((0.0, 0.0))))
        k = [number(rate * self.draw.between(-0.5, 1.0)) for _ in range(4)]
        bend = number(rate / self.plate.scale * self.draw.between(-1, 1))
        field = given([f"{k[0]}*{x} + {k[1]}*{y}", f"{k[2]}*{x} + {k[3]}*{y} + {bend}*{x}*{y}"])
        for edge in EDGES:
            self.edge(edge, displacement=field)
        self.said.append("a displacement all round")

    def held_pieces(self):
        """Pieces of edges are held, others pulled."""
        edge = self.free_edge()
        low = self.draw.between(0.1, 0.5)
        form = self.draw.pick("clamped", "clamped", "two", "slides")
        if form == "two":
            self.piece(edge, 0.0, round(low / 2 + 0.1, 2), displacement="[0, 0]")
            self.piece(edge, round(low / 2 + 0.5, 2), 1.0, displacement="[0, 0]")
        else:
            slides = [None, None]
            slides[AXIS[edge]] = 0.0
            self.piece(edge, low, low + self.draw.between(0.2, 0.4),
                       displacement=given(slides) if form == "slides" else "[0, 0]")
        if form == "slides":
            others = [e for e in EDGES if AXIS[e] != AXIS[edge] and e not in self.plate.blocked]
            demand(others)
            self.edge(self.draw.pick(*others), symmetry="true")
        self.pull(OPPOSITE[edge])
        self.said.append("held pieces of edges")

    def loaded_pieces(self):
        """Pieces of edges are loaded, two edges slide."""
        first, second = self.free_edge(), self.free_edge()
        demand(AXIS[first] != AXIS[second])
        for edge in (first, second):
            self.edge(edge, symmetry="true")
        for edge in (OPPOSITE[first], OPPOSITE[second])[: self.draw.pick(1, 1, 2)]:
            low = self.draw.between(0.1, 0.5)
            high = low + self.draw.between(0.2, 0.4)
            pair = [self.varied(self.stress * OUTWARDS[edge], edge), self.stress * self.draw.pick(0.0, 0.3)]
            condition = dict(traction=given(pair if AXIS[edge] == 0 else pair[::-1]))
            if self.draw.chance(0.3):
                condition = dict(pressure=number(-self.stress))
            self.piece(edge, low, high, **condition)
        self.said.append("loads on pieces of edges")

    def pieces_of_a_cut_plate(self):
        """Supports for both pieces of a plate cut through, with loads that each piece bears."""
        plate, draw = self.plate, self.draw
        for edge in EDGES:
            if AXIS[edge] == 1 - plate.across:
                self.edge(edge, **(dict(symmetry="true") if plate.level else dict(displacement="[0, 0]")))
        self.said.append("both pieces held")
        if draw.chance(0.6):
            self.add("{ crack = %d }" % self.through(), pressure=quoted(self.along_crack(self.stress)))
            self.said.append("face pressure")
        else:
            force = [0.0, 0.0]
            force[1 - plate.across] = self.stress / plate.scale * draw.sign()
            if not plate.level:
                force[plate.across] = force[1 - plate.across] * draw.between(-0.5, 0.5)
            self.force = f"[body_force]\nvalue = {given(force)}\n"
            self.said.append("body force")
        inner = [k for k in range(len(plate.cracks)) if k != self.through()]
        if inner:
            self.add("{ crack = %d }" % inner[0], pressure=number(self.stress * draw.between(0.5, 1.0)))

    def through(self):
        w, h = self.plate.size
        return next(k for k, c in enumerate(self.plate.cracks)
                    if all(p[0] in (0.0, w) or p[1] in (0.0, h) for p in (c[0], c[-1])))

    # ---- further loads

    def along_crack(self, value):
        """A value, or a smooth formula of the place."""
        draw = self.draw
        if draw.chance(0.5):
            return value
        x, y = (self.centred(i) for i in (0, 1))
        return draw.pick(f"{number(value)}*(1 + {number(draw.between(-0.8, 0.8))}*{x})",
                         f"{number(value)}*(1 + {number(draw.between(-0.8, 0.8))}*{x} - {number(draw.between(0, 0.5))}*{y})",
                         f"{number(value)}*exp({number(draw.between(-1, 1))}*{y})",
                         f"{number(value)}*cos({number(draw.between(1, 3))}*{x})")

    def on_faces(self, pressure):
        """Loads on the faces of all cracks."""
        for k in range(len(self.plate.cracks)):
            if pressure:
                self.add("{ crack = %d }" % k, pressure=quoted(self.along_crack(self.stress)))
                continue
            for face in self.draw.pick(("above",), ("below",), ("above", "below")):
                pair = [self.along_crack(self.stress * self.draw.between(-1, 1)) for _ in (0, 1)]
                self.add('{ crack = %d, face = "%s" }' % (k, face), traction=given(pair))
        self.said.append("face pressure" if pressure else "face traction")

    def on_rims(self):
        for k in range(len(self.plate.holes)):
            self.add("{ hole = %d }" % k, pressure=quoted(self.along_crack(self.stress)))
        self.said.append("rim pressure")

    def body_force(self):
        rate = self.stress / self.plate.scale
        pair = [self.along_crack(rate * self.draw.between(-1, 1)) for _ in (0, 1)]
        self.force = f"[body_force]\nvalue = {given(pair)}\n"
        self.said.append("body force")


def elastic_loads(draw, plate, made, kind):
    """Supports and loads of a problem of elasticity."""
    loads = Loads(draw, plate, made)
    if plate.cut:
        loads.pieces_of_a_cut_plate()
        return loads
    extra = draw.random() if kind in ("anything", "graded and loaded") else 1.0
    faces = kind in ("face pressure", "face traction") or extra < 0.35
    pressure = kind == "face pressure" or kind != "face traction" and draw.chance(0.5)
    rims = kind == "rim pressure" or kind == "anything" and draw.chance(0.3)
    force = kind == "body force" or 0.2 < extra < 0.6
    plain = [loads.rollers, loads.rollers, loads.balanced, loads.balanced, loads.pulled, loads.pulled, loads.enclosed]
    holding = [loads.rollers, loads.rollers, loads.rollers, loads.enclosed, loads.clamped]
    special = {"held pieces": [loads.held_pieces, loads.held_pieces, loads.clamped, loads.gripped],
               "loads on pieces": [loads.loaded_pieces], "balanced": [loads.balanced],
               "anything": holding + [loads.gripped, loads.held_pieces, loads.loaded_pieces]}
    uneven = faces and not pressure or rims or force
    draw.pick(*special.get(kind, holding if uneven else plain))()
    if faces and plate.cracks:
        loads.on_faces(pressure)
    if rims and plate.holes:
        loads.on_rims()
    if force:
        loads.body_force()
    return loads


def poisson_loads(draw, plate, made):
    """Values and fluxes of a problem of Poisson's equation."""
    loads = Loads(draw, plate, made)
    edge = loads.free_edge()
    loads.edge(edge, value="0")
    other = OPPOSITE[edge]
    if draw.chance(0.5) and other not in plate.blocked:
        x, y = (loads.centred(i) for i in (0, 1))
        loads.edge(other, value=quoted(f"{number(loads.moved)}*(1 + {number(draw.between(-1, 1))}*{x}*{y})"))
        loads.said.append("values")
    else:
        loads.edge(other, flux=quoted(loads.varied(loads.stress, other)))
        loads.said.append("a value and a flux")
    if plate.cracks and draw.chance(0.5):
        loads.add("{ crack = 0%s }" % draw.pick("", ', face = "above"'), flux=quoted(loads.along_crack(loads.stress)))
        loads.said.append("face flux")
    if draw.chance(0.5):
        loads.force = f"[source]\nvalue = {quoted(loads.along_crack(loads.stress / plate.scale))}\n"
        loads.said.append("source")
    return loads
