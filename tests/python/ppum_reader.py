"""Reads datasets and evaluates their fields, written from FORMAT.md alone.

    with h5py.File("plate.h5") as file:
        field = Field(file)
        field.evaluate(0.3, 0.1)                value and gradient of each component
        field.quantity("von-mises", 0.3, 0.1)

The arithmetic is that of `Double` or of `Extended` (ppum_formulas.py), so the same code is an evaluator
in double and in extended precision. Gradients come from jets.
"""

import functools
import hashlib
import math
import re

import h5py
import numpy as np
from ppum_formulas import Double, Formula, Jet, Table, polar, total
from ppum_meshes import Mesh, block


def text(value):
    """A string of the file, fixed or variable in length, alone or in an array."""
    value = value[0] if isinstance(value, np.ndarray) else value
    return value.decode() if isinstance(value, bytes) else str(value)


def texts(dataset):
    return [text(v) for v in dataset[()]]


def content(file):
    """All items of an open file by their names, section "Checksum"."""
    items = {"@" + k: v for k, v in file.attrs.items()}

    def collect(name, node):
        if name.split("/")[0] == "user":
            return
        if isinstance(node, h5py.Dataset):
            items[name] = node[()]
        else:
            items.update({f"{name}@{k}": v for k, v in node.attrs.items()})

    file.visititems(collect)
    return items


def digest(items):
    """SHA-256 over items."""
    digest = hashlib.sha256()
    for name in sorted(items, key=str.encode):
        value = np.asarray(items[name])
        shape = "x".join(map(str, value.shape))
        if value.dtype.kind in "SOU":
            kind, data = "str", b"".join(text(v).encode() + b"\0" for v in value.flat)
        else:
            kind = f"{value.dtype.kind}{8 * value.dtype.itemsize}"
            data = value.astype(value.dtype.newbyteorder("<")).tobytes()
        digest.update(f"{name} {kind} {shape}\n".encode() + data)
    return digest.hexdigest()


STEP = re.compile("(steps/[0-9]+)(/|(?=@))")


def checksums(file):
    """The checksums that an open file has, each by the name of its attribute, as they should be."""
    items, found = content(file), {}
    for name in items:
        group, _, attribute = name.partition("@")
        if name == "@sha256":
            of = items.items()
        elif name == "@sha256_rest":
            of = ((k, v) for k, v in items.items() if not STEP.match(k))
        elif attribute == "sha256" and re.fullmatch("steps/[0-9]+", group):
            of = ((k[STEP.match(k).end():], v) for k, v in items.items() if re.match(group + "[/@]", k))
            name = "@sha256"
        else:
            continue
        found[f"{group}@{attribute}"] = digest({k: v for k, v in of if k != name})
    return found


def is_right(file):
    """True if an open file has checksums, and right ones."""
    stored, right = content(file), checksums(file)
    return bool(right) and all(text(stored[name]) == sum for name, sum in right.items())


def seal(file):
    """Makes the checksums of an open file right."""
    for name, sum in checksums(file).items():
        group, _, attribute = name.partition("@")
        file[group or "/"].attrs[attribute] = sum


PLANE = ("x", "y")

# Quantities as formulas: section "Quantities". Each may use those before it.
ELASTICITY = {
    "magnitude": "sqrt(ux^2 + uy^2)",
    "gradient": "sqrt(dux_dx^2 + dux_dy^2 + duy_dx^2 + duy_dy^2)",
    "divergence": "dux_dx + duy_dy",
    "curl": "duy_dx - dux_dy",
    "exx": "dux_dx",
    "eyy": "duy_dy",
    "exy": "(dux_dy + duy_dx)/2",
    "sxx": "2*mu*exx + lambda*(exx + eyy)",
    "syy": "2*mu*eyy + lambda*(exx + eyy)",
    "sxy": "2*mu*exy",
    "szz": "out_of_plane*(sxx + syy)",
    "von_mises": "hypot(sqrt(3)*mu*hypot(exx - eyy, 2*exy), (lambda + mu)*(1 - 2*out_of_plane)*(exx + eyy))",
    "s1": "(lambda + mu)*(exx + eyy) + mu*hypot(exx - eyy, 2*exy)",
    "s2": "(lambda + mu)*(exx + eyy) - mu*hypot(exx - eyy, 2*exy)",
    "tresca": "mu*hypot(exx - eyy, 2*exy) + max(mu*hypot(exx - eyy, 2*exy), abs((lambda + mu)*(1 - 2*out_of_plane)*(exx + eyy)))",
    "direction": "if(exy == 0, if(exx >= eyy, 0, pi/2), atan2(2*exy, exx - eyy)/2)",
    "hydrostatic": "(sxx + syy + szz)/3",
    "energy": "((lambda + mu)*(exx + eyy)^2 + mu*((exx - eyy)^2 + 4*exy^2))/2",
}
# Those of given strains, in place of the ones of stresses.
EIGENSTRAIN = dict(list(ELASTICITY.items())[:7]) | {
    "elastic_xx": "exx - (eigenstrain_xx + out_of_plane*eigenstrain_zz)",
    "elastic_yy": "eyy - (eigenstrain_yy + out_of_plane*eigenstrain_zz)",
    "elastic_xy": "exy - eigenstrain_xy",
    "sxx": "2*mu*elastic_xx + lambda*(elastic_xx + elastic_yy)",
    "syy": "2*mu*elastic_yy + lambda*(elastic_xx + elastic_yy)",
    "sxy": "2*mu*elastic_xy",
    "szz": "out_of_plane*(sxx + syy) - young*eigenstrain_zz",
    "von_mises": "hypot(sqrt(3)*mu*hypot(elastic_xx - elastic_yy, 2*elastic_xy), (sxx + syy)/2 - szz)",
    "s1": "(lambda + mu)*(elastic_xx + elastic_yy) + mu*hypot(elastic_xx - elastic_yy, 2*elastic_xy)",
    "s2": "(lambda + mu)*(elastic_xx + elastic_yy) - mu*hypot(elastic_xx - elastic_yy, 2*elastic_xy)",
    "tresca": "(s1 - s2)/2 + max((s1 - s2)/2, abs((sxx + syy)/2 - szz))",
    "direction": "if(sxy == 0, if(sxx >= syy, 0, pi/2), atan2(2*sxy, sxx - syy)/2)",
    "hydrostatic": "(sxx + syy + szz)/3",
    "energy": "(sxx*elastic_xx + syy*elastic_yy + 2*sxy*elastic_xy + young*eigenstrain_zz^2)/2",
}
# Those of anisotropic bodies: constants of the third direction are zero in plane stress.
STIFFNESS = ("c11", "c12", "c16", "c22", "c26", "c66", "c13", "c23", "c36", "c33")
ANISOTROPY = dict(list(ELASTICITY.items())[:7]) | {
    "elastic_xx": "exx - eigenstrain_xx",
    "elastic_yy": "eyy - eigenstrain_yy",
    "elastic_xy": "exy - eigenstrain_xy",
    "e11": "elastic_xx*cos(axis)^2 + elastic_yy*sin(axis)^2 + elastic_xy*sin(2*axis)",
    "e22": "elastic_xx*sin(axis)^2 + elastic_yy*cos(axis)^2 - elastic_xy*sin(2*axis)",
    "e12": "(elastic_yy - elastic_xx)*sin(2*axis)/2 + elastic_xy*cos(2*axis)",
    "s11": "c11*e11 + c12*e22 + 2*c16*e12 - c13*eigenstrain_zz",
    "s22": "c12*e11 + c22*e22 + 2*c26*e12 - c23*eigenstrain_zz",
    "s12": "c16*e11 + c26*e22 + 2*c66*e12 - c36*eigenstrain_zz",
    "sxx": "s11*cos(axis)^2 + s22*sin(axis)^2 - s12*sin(2*axis)",
    "syy": "s11*sin(axis)^2 + s22*cos(axis)^2 + s12*sin(2*axis)",
    "sxy": "(s11 - s22)*sin(2*axis)/2 + s12*cos(2*axis)",
    "szz": "c13*e11 + c23*e22 + 2*c36*e12 - c33*eigenstrain_zz",
    "von_mises": "hypot(sqrt(3)*hypot((s11 - s22)/2, s12), (s11 + s22)/2 - szz)",
    "s1": "(s11 + s22)/2 + hypot((s11 - s22)/2, s12)",
    "s2": "(s11 + s22)/2 - hypot((s11 - s22)/2, s12)",
    "tresca": "(s1 - s2)/2 + max((s1 - s2)/2, abs((s11 + s22)/2 - szz))",
    "direction": "if(sxy == 0, if(sxx >= syy, 0, pi/2), atan2(2*sxy, sxx - syy)/2)",
    "hydrostatic": "(s11 + s22 + szz)/3",
    "energy": "(s11*e11 + s22*e22 + 2*s12*e12 - szz*eigenstrain_zz)/2",
}
# Those of bodies of revolution: the strain of the third direction is taken off, and its stress has another name.
HOOP = "if(x == 0, dux_dx, ux/x)"
REVOLUTION = {"ehoop": HOOP, "eigenstrain_zz": f"eigenstrain_zz - {HOOP}"} | {
    name.replace("szz", "shoop"): (f"{text} + {HOOP}" if name == "divergence" else text).replace("szz", "shoop")
    for name, text in EIGENSTRAIN.items()
}
POISSON = {
    "magnitude": "abs(u)",
    "gradient": "sqrt(du_dx^2 + du_dy^2)",
    "energy": "conductivity*(du_dx^2 + du_dy^2)/2",
    "temperature": "u",
    "qx": "-conductivity*du_dx",
    "qy": "-conductivity*du_dy",
    "flux": "conductivity*sqrt(du_dx^2 + du_dy^2)",
}


class Edge:
    """A segment or an arc, seen from a point: section "Edges".

    `ends` has for each end how far the point lies along the tangent there, beside it, and away; `parts` is true if the
    edge of a polygon changes whether the point is inside: a ray crosses its chord, or an arc lies beyond it.
    """

    def __init__(self, p, a, b, bulge, field):
        a, b = (tuple(map(field.real, q)) for q in (a, b))
        self.bulge = beta = field.real(bulge)
        root = lambda value: field.n.call("sqrt", value)
        (ux, uy), (vx, vy), (dx, dy) = ([q[k] - c[k] for k in range(2)] for q, c in ((p, a), (p, b), (b, a)))
        length, weight, chord = root(dx * dx + dy * dy), 1 + beta * beta, dx * uy - dy * ux
        circle = (1 - beta * beta) * chord - 2 * beta * (ux * vx + uy * vy)
        s, kappa = 2 * circle / (weight * length), 4 * beta / (weight * length)
        self.distance = s / (1 + root(max(1 - kappa * s, field.real(0))))
        cos, sin = (1 - beta * beta) / weight, 2 * beta / weight
        tx, ty = dx / length, dy / length
        self.tangents = [(cos * tx + o * sin * ty, cos * ty - o * sin * tx) for o in (1, -1)]
        self.ends = [
            (tx * x + ty * y, tx * y - ty * x, root(x * x + y * y))
            for (tx, ty), (x, y) in zip(self.tangents, ((ux, uy), (vx, vy)))
        ]
        inside = (self.ends[0][0] >= 0, self.ends[1][0] <= 0)
        self.is_beside = any(inside) if abs(beta) > 1 else all(inside)
        crosses = (uy < 0) != (vy < 0) and (chord > 0) == (vy < 0)
        # points of the chord are with those on its right, and if it is level with those above
        right = chord < 0 or (chord == 0 and not (dy == 0 and dx > 0))
        if beta == 0:
            self.is_on, self.parts = chord == 0 and ux * vx + uy * vy <= 0, crosses
        else:
            beyond = right == (beta > 0)
            self.is_on = circle == 0 and (beyond or (ux, uy) == (0, 0) or (vx, vy) == (0, 0))
            self.parts = crosses != (beyond and (circle > 0) == (beta > 0))


class Field:
    """One field of one step. `evaluate` gives value and gradient at a point, `quantity` what is made of
    them."""

    def __init__(self, file, step=0, field=0, numbers=Double):
        assert text(file.attrs["format"]) == "ppum" and file.attrs["format_version"][0] == 1
        self.n, self.real = numbers, numbers.real
        self.read_domain(file["domain"])
        self.tables = self.read_tables(file)
        self.read_equation(file)
        group = file[f"steps/{step:04}"]
        fields = [{k: v[()] for k, v in g.items() if v.dtype.kind in "uf"} for g in group["fields"].values()]
        self.read_partition(group["partition"], fields)
        points, offsets = group["cracks/points"][()], group["cracks/offsets"][()]
        self.cracks = [points[a:b] for a, b in zip(offsets, offsets[1:])]
        self.bulges = self.read_bulges(group["cracks"])
        self.read_functions(group["functions"])
        data = group[f"fields/{field:04}"]
        self.components = texts(data["components"])
        self.blocks = fields[field]
        self.exact = [self.formula(f, PLANE) for f in texts(data["exact"])] if "exact" in data else []
        self.read_quantities(file)

    def formula(self, formula, variables):
        return Formula(formula, variables, self.tables, self.n)

    def read_domain(self, group):
        self.min, self.max = group.attrs["min"], group.attrs["max"]
        self.holes, kind = [], text(group.attrs["kind"])
        assert kind in ("box", "box-with-holes", "mesh")
        if kind == "box-with-holes":
            holes = group["holes"]
            offsets, points = holes["offsets"][()], holes["points"][()]
            parts = [points[a:b] for a, b in zip(offsets, offsets[1:])]
            self.holes = list(zip(texts(holes["kind"]), parts, holes["radius"][()], self.read_bulges(holes)))

    @staticmethod
    def read_bulges(group):
        """The bulges of the edges behind the points of each crack or hole."""
        offsets = group["offsets"][()]
        bulges = group["bulges"][()] if "bulges" in group else np.zeros(len(group["points"]))
        return [bulges[a:b] for a, b in zip(offsets, offsets[1:])]

    def contains(self, p):
        """True if a point, given by numbers of the field, lies in the domain."""
        if self.mesh:
            return self.mesh.owner(p, 1) is not None
        box = all(self.real(self.min[k]) <= p[k] <= self.real(self.max[k]) for k in range(2))
        return box and not any(self.in_hole(p, *hole) for hole in self.holes)

    def in_hole(self, p, kind, points, radius, bulges):
        if kind == "circle":
            (center,) = points
            x, y = (p[k] - self.real(center[k]) for k in range(2))
            return x * x + y * y < self.real(radius) ** 2
        assert kind.removeprefix("curved-") in ("polygon", "outside")
        inside = kind.endswith("outside")
        for a, b, bulge in zip(points, np.roll(points, -1, axis=0), bulges):
            edge = Edge(p, a, b, bulge, self)
            if edge.is_on:
                return False
            inside ^= edge.parts
        return inside

    def read_tables(self, file):
        tables = file.get("tables", {}).values()
        data = lambda group, name: group[name][()] if name in group else None
        return {
            text(group.attrs["name"]): Table(*(data(group, k) for k in ("x", "y", "values")), self.n)
            for group in tables
        }

    def read_equation(self, file):
        """The constants of the equation, each a number or a formula."""
        equation = dict(file["equation"].attrs)
        self.kind, self.state = text(equation.pop("kind")), text(equation.pop("state", ""))
        repeated = lambda value: repr(float(value)) if isinstance(value, float) else text(value)
        self.constants = {k: self.formula(repeated(v), PLANE) for k, v in equation.items()}

    def read_partition(self, group, fields):
        kind = text(group.attrs["kind"])
        self.mesh = Mesh(group, fields, self.n) if kind == "mesh" else None
        if self.mesh:
            return
        assert kind == "shepard-box"
        self.partition = {k: v[()] for k, v in group.items()}
        assert self.covers_cells(), "the supports do not cover the cells"
        self.weight = text(group.attrs["weight"])
        if self.weight == "formula":
            self.weight = self.formula(text(group.attrs["weight_formula"]), ("t",))

    def covers_cells(self):
        """True if each point of each cell, without cells of the domain, has |s| <= 0.991 in a support: rule 12 of
        section 7.

        Cells that their own supports do not cover are cut by the borders of all others.
        """
        center, half = self.partition["center"], self.partition["half"]
        low, high = center - 0.991 * half, center + 0.991 * half
        if "cell" in self.partition:
            cells = self.partition["cell"]
            cells = cells[(low > cells[:, :2]).any(axis=1) | (high < cells[:, 2:]).any(axis=1)]
        else:
            cells = np.array([[*self.min, *self.max]])
        for min, max in zip(cells[:, :2], cells[:, 2:]):
            near = np.flatnonzero((low < max).all(axis=1) & (high > min).all(axis=1))
            cuts = [np.unique(np.clip([*low[near, d], *high[near, d], min[d], max[d]], min[d], max[d])) for d in (0, 1)]
            for p in np.stack(np.meshgrid(*((c[1:] + c[:-1]) / 2 for c in cuts)), -1).reshape(-1, 2):
                if not ((low[near] <= p) & (p <= high[near])).all(axis=1).any():
                    in_hole = "cell" not in self.partition and any(self.in_hole([self.real(c) for c in p], *h) for h in self.holes)
                    if not in_hole:
                        return False
        return True

    def read_functions(self, group):
        plain = lambda d: texts(d) if d.dtype.kind in "SO" else d[()]
        rows = ("parameter_", "cut", "kink", "singular")
        columns = {k: plain(v) for k, v in group.items() if not k.startswith(rows)}
        self.table = [dict(zip(columns, row)) for row in zip(*columns.values())]
        names, values = texts(group["parameter_name"]), group["parameter_value"][()]
        offsets = group["parameter_offsets"][()]
        for row, a, b in zip(self.table, offsets, offsets[1:]):
            row["parameters"] = {k: self.real(v) for k, v in zip(names[a:b], values[a:b])}
            if row["kind"] == "formula":
                row["formula"] = self.formula(row["formula"], PLANE)
        if "cuts" in group:
            cuts, offsets = group["cuts"][()], group["cut_offsets"][()]
            for row, a, b in zip(self.table, offsets, offsets[1:]):
                row["cuts"] = cuts[a:b]

    def read_quantities(self, file):
        """Formulas of quantities, in the order in which they are defined."""
        strained = ["ux", "uy"] + ["temperature"] * ("expansion" in self.constants)
        library = {"elasticity": (["ux", "uy"], ELASTICITY), "eigenstrain": (strained, EIGENSTRAIN),
                   "anisotropic": (["ux", "uy"], ANISOTROPY), "poisson": (["u"], POISSON), "axisymmetric-poisson": (["u"], POISSON)}
        components, library = library.get(self.kind, ([], {}))
        if self.state == "axisymmetric":
            components, library = strained, REVOLUTION
        library = library if components == self.components else {}
        named = file.get("quantities")
        own = dict(zip(texts(named["name"]), texts(named["formula"]))) if named else {}
        self.quantities = {k: self.formula(v, ()) for k, v in (library | own).items()}

    def evaluate(self, x, y, side=1):
        """[(value, d/dx, d/dy), …], one per component; `side` is +1 or -1 and decides on a crack."""
        p = self.real(x), self.real(y)
        self.side, self.cache, self.has_gradient = side, {}, True
        self.owned = self.mesh.owner(p, side) if self.mesh else None
        if not (self.owned if self.mesh else self.contains(p)):
            return [(math.nan,) * 3] * len(self.components)
        values = self.local(p, *self.owned) if self.mesh else self.glued(p)
        if not self.has_gradient:
            return [(v.v, math.nan, math.nan) for v in values]
        return [(v.v, v.slopes.get("x", 0), v.slopes.get("y", 0)) for v in values]

    def glued(self, p):
        """Σ_i φ_i v_i by Shepard's functions of boxes."""
        total, values = Jet(0), [Jet(0)] * len(self.components)
        close = np.abs(self.partition["center"] - [float(c) for c in p])
        for i in np.flatnonzero((close <= self.partition["half"] * (1 + 1e-9)).all(axis=1)):
            s = self.scaled(p, self.partition["center"][i], self.partition["half"][i])
            if all(-1 <= c.v < 1 for c in s):
                weight = self.spline(s[0]) * self.spline(s[1])
                total += weight
                place = self.scaled(p, self.partition["origin"][i], self.partition["scale"][i])
                values = [v + weight * local for v, local in zip(values, self.local(p, i, place))]
        return [v / total for v in values]

    def scaled(self, p, origin, scale):
        (ox, oy), (sx, sy) = map(self.real, origin), map(self.real, scale)
        return Jet((p[0] - ox) / sx, {"x": 1 / sx}), Jet((p[1] - oy) / sy, {"y": 1 / sy})

    def spline(self, s):
        """The weight w(|s|)."""
        t = s if s.v >= 0 else -s
        if isinstance(self.weight, Formula):
            w = self.weight.evaluate({"t": t.v})
            slope = w.slopes.get("t", 0)
            # at the end of the support a formula may have limits only
            finite = lambda v: v if t.v < 1 or abs(v) < math.inf else self.real(0)
            return t.chain(finite(w.v), finite(slope))
        u = 1 - t
        if self.weight == "linear":
            return u
        if self.weight == "quadratic":
            return 1 - 3 * t * t if 3 * t.v < 1 else u * u * 3 / 2
        assert self.weight == "cubic"
        return 1 - 6 * t * t * u if 2 * t.v < 1 else 2 * u * u * u

    def local(self, p, i, place):
        """Σ_b f_b Σ_k c_{b,k} ξ^k of patch i, one jet a component."""
        sums = [Jet(0)] * len(self.components)
        for b in range(*map(int, self.blocks["patch_blocks"][i : i + 2])):
            f = self.function(p, self.blocks["block_function"][b])
            sums = [s + f * q for s, q in zip(sums, block(self.blocks, b, *place, self.real))]
        return sums

    def function(self, p, b):
        if b not in self.cache:
            row = self.table[b]
            if row["kind"] == "one":
                self.cache[b] = Jet(self.real(1))
            elif row["kind"] == "side":
                self.cache[b] = Jet(self.side_of(p, row["crack"]))
            elif row["kind"] == "level":
                self.cache[b] = Jet(self.real(self.sign(self.level(row["levels"][1]).v)))
            elif row["kind"] == "component":
                self.cache[b] = Jet(self.indicator(p, row["cuts"]))
            else:
                assert row["kind"] == "formula"
                self.cache[b] = self.in_frame(p, row)
            # whatever its coefficients are
            self.has_gradient &= all(abs(slope) < math.inf for slope in self.cache[b].slopes.values())
        return self.cache[b]

    def indicator(self, p, cuts):
        """1 in the component of a tree of cuts, 0 outside."""
        part = 0
        while part >= 0:
            crack, segment, left, right = cuts[part]
            distance = self.edges(p, crack)[segment].distance
            part = left if self.sign(distance) > 0 else right
        return self.real(1 if part == -2 else 0)

    def side_of(self, p, crack):
        return self.real(self.sign(self.nearest(p, crack)))

    def sign(self, distance):
        return 1 if distance > 0 or (distance == 0 and self.side > 0) else -1

    def edges(self, p, crack):
        """The edges of a crack, seen from a point."""
        points = self.cracks[crack]
        return [Edge(p, *edge, self) for edge in zip(points, points[1:], self.bulges[crack])]

    def nearest(self, p, crack):
        """The number whose sign is the side of the point: that of the nearest edge."""
        edges = self.edges(p, crack)
        candidates = []
        for k, edge in enumerate(edges):
            if edge.is_beside:
                candidates.append((abs(edge.distance), edge.distance))
                continue
            for end, other, way in ((0, k - 1, -1), (1, k + 1, 1)):
                along, across, away = edge.ends[end]
                if 0 <= other < len(edges):
                    candidates.append((away, max(across, edges[other].ends[1 - end][1], key=abs)))
                elif way * along > 0:
                    candidates.append((abs(across), across))
        return min(candidates, key=lambda candidate: candidate[0])[1]

    def in_frame(self, p, row):
        """A formula of x, y, r, theta of its frame, with derivatives in the world."""
        if row["frame"] == "levels":
            return self.in_levels(row)
        x, y, theta, (c, s) = self.tip(p, row) if row["frame"] == "tip" else self.fixed(p, row)
        sides = {f"side({crack})": self.side_of(p, crack) for crack in row["formula"].sides}
        f = row["formula"].evaluate(polar(x, y, theta, self.n) | row["parameters"] | sides)
        fx, fy = f.slopes.get("x", 0), f.slopes.get("y", 0)
        return Jet(f.v, {"x": c * fx - s * fy, "y": s * fx + c * fy})

    def in_levels(self, row):
        """A formula in the frame whose x and y are level fields."""
        x, y = map(self.level, row["levels"])
        theta = self.sign(y.v) * self.angle(x.v, y.v)
        f = row["formula"].evaluate(polar(x.v, y.v, theta, self.n) | row["parameters"])
        chained = [axis.scaled(f.slopes[k]) for k, axis in (("x", x), ("y", y)) if k in f.slopes]
        return Jet(f.v, functools.reduce(total, chained, {}))

    def level(self, field):
        """A level field on the patch that holds the point."""
        return self.mesh.level(int(field), *self.owned)

    def fixed(self, p, row):
        """x, y, theta, and the x axis in the world of the frames `world` and `fixed`."""
        if row["frame"] == "world":
            (ox, oy), (c, s) = (0, 0), (self.real(1), self.real(0))
        else:
            (ox, oy), angle = map(self.real, row["frame_origin"]), self.real(row["frame_angle"])
            c, s = self.n.call("cos", angle), self.n.call("sin", angle)
        x, y = c * (p[0] - ox) + s * (p[1] - oy), c * (p[1] - oy) - s * (p[0] - ox)
        return x, y, (1 if y >= 0 else -1) * self.angle(x, y), (c, s)

    def angle(self, x, y):
        """The angle from the x axis, 0 at the origin whatever signs its zeros have."""
        return self.n.call("atan2", abs(y), x) if x != 0 or y != 0 else self.real(0)

    def tip(self, p, row):
        start = row["frame_end"] == "start"
        edge = self.edges(p, row["crack"])[0 if start else -1]
        (along, across, _), (tx, ty) = (values[0 if start else 1] for values in (edge.ends, edge.tangents))
        o, distance = -1 if start else 1, edge.distance if edge.bulge == 0 else across
        x, y = o * along, o * distance
        line = self.sign(distance)
        theta = o * line * self.angle(x, y)
        if self.sign(self.nearest(p, row["crack"])) != line:
            theta -= 2 * self.n.pi * o * line
        return x, y, theta, (o * tx, o * ty)

    def quantity(self, name, x, y, side=1):
        """A quantity of the library or of the dataset by its name, or a formula of quantities."""
        jets = self.evaluate(x, y, side)
        values, slopes = {"x": self.real(x), "y": self.real(y)} | self.material(x, y), {}
        for component, (value, dx, dy) in zip(self.components, jets):
            values[component] = value
            slopes |= {f"d{component}_dx": dx, f"d{component}_dy": dy}
        if {"expansion", "temperature"} <= set(values):
            for direction in ["xx", "yy", "zz"][: 2 if self.state == "plane-stress" else 3]:
                values[f"eigenstrain_{direction}"] += values["expansion"] * values["temperature"]
        values |= slopes
        of_slopes = set(slopes)
        for known, formula in (self.quantities | {name: self.quantity_named(name)}).items():
            value = formula.evaluate(values).v
            if not formula.names.isdisjoint(of_slopes):
                of_slopes.add(known.replace("-", "_"))
                # where there is no gradient, as at a tip, it is infinite
                value = value if all(abs(slope) < math.inf for slope in slopes.values()) else math.inf
            if known == name:
                return value
            values[known.replace("-", "_")] = value
        raise KeyError(name)

    def quantity_named(self, name):
        known = {k.replace("_", "-"): formula for k, formula in self.quantities.items()}
        return self.quantities.get(name) or known.get(name) or self.formula(name, ())

    def material(self, x, y):
        """The constants of the equation at a point."""
        at = {"x": self.real(x), "y": self.real(y)}
        known = {name: formula.evaluate(at).v for name, formula in self.constants.items()}
        if self.kind in ("elasticity", "eigenstrain"):
            young, poisson = known["young"], known["poisson"]
            strain = self.state != "plane-stress"
            mu = young / (2 * (1 + poisson))
            divisor = (1 + poisson) * (1 - 2 * poisson) if strain else 1 - poisson**2
            known |= {"mu": mu, "lambda": young * poisson / divisor}
            known["out_of_plane"] = poisson if strain else self.real(0)
            if self.kind == "eigenstrain" and not strain:
                known["eigenstrain_zz"] = self.real(0)
            if self.state == "axisymmetric":
                known = dict.fromkeys([f"eigenstrain_{d}" for d in ("xx", "yy", "xy", "zz")], self.real(0)) | known
        if self.kind == "anisotropic":
            zeros = [*STIFFNESS, *(f"eigenstrain_{d}" for d in ("xx", "yy", "xy", "zz"))]
            known = dict.fromkeys(zeros, self.real(0)) | known
        return known
