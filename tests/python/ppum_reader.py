"""Reads datasets and evaluates their fields, written from FORMAT.md alone.

The arithmetic is that of a number module: `math` (with `float`) or `mpmath` (with `mpf`), so the
same code is an evaluator in double and in extended precision. Gradients come from jets.
"""

import ast
import hashlib
import math
import operator
import re

import h5py
import numpy as np


def text(value):
    """A string of the file, fixed or variable in length."""
    return value.decode() if isinstance(value, bytes) else str(value)


def texts(dataset):
    return [text(v) for v in dataset[()]]


def checksum(file):
    """SHA-256 over the content of an open file, section "Checksum"."""
    items = {"@" + k: v for k, v in file.attrs.items() if k != "sha256"}

    def collect(name, node):
        if name.split("/")[0] == "user":
            return
        if isinstance(node, h5py.Dataset):
            items[name] = node[()]
        else:
            items.update({f"{name}@{k}": v for k, v in node.attrs.items()})

    file.visititems(collect)
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


class Jet:
    """A value with its derivatives by x and y."""

    def __init__(self, v, x=0, y=0):
        self.v, self.x, self.y = v, x, y

    @staticmethod
    def of(a):
        return a if isinstance(a, Jet) else Jet(a)

    def chain(self, value, slope):
        return Jet(value, slope * self.x, slope * self.y)

    def __add__(self, b):
        b = Jet.of(b)
        return Jet(self.v + b.v, self.x + b.x, self.y + b.y)

    def __mul__(self, b):
        b = Jet.of(b)
        return Jet(self.v * b.v, self.x * b.v + self.v * b.x, self.y * b.v + self.v * b.y)

    def __neg__(self):
        return Jet(-self.v, -self.x, -self.y)

    def __truediv__(self, b):
        b = Jet.of(b)
        return self * b.chain(1 / b.v, -1 / (b.v * b.v))

    def __pow__(self, n):
        return self.chain(self.v**n, n * self.v ** (n - 1) if n else 0)

    def __abs__(self):
        return self if self.v >= 0 else -self

    def __sub__(self, b):
        return self + -Jet.of(b)

    __radd__, __rmul__ = __add__, __mul__
    __rsub__ = lambda self, b: -self + b
    __rtruediv__ = lambda self, b: Jet.of(b) / self


class Formulas:
    """Formulas over jets: section "Formulas"."""

    def __init__(self, numbers):
        n = numbers
        slope = lambda f, df: lambda a: a.chain(f(a.v), df(a.v))
        safe = lambda a: 1 / a if a else n.inf
        self.functions = {
            "sqrt": slope(n.sqrt, lambda v: safe(2 * n.sqrt(v))),
            "exp": slope(n.exp, n.exp),
            "log": slope(n.log, lambda v: 1 / v),
            "sin": slope(n.sin, n.cos),
            "cos": slope(n.cos, lambda v: -n.sin(v)),
            "tan": slope(n.tan, lambda v: 1 + n.tan(v) ** 2),
            "abs": abs,
            "sign": lambda a: Jet((a.v > 0) - (a.v < 0)),
            "min": lambda a, b: a if a.v <= b.v else b,
            "max": lambda a, b: a if a.v >= b.v else b,
            "where": lambda c, a, b: a if c else b,
        }
        self.operators = {
            ast.Add: operator.add, ast.Sub: operator.sub, ast.Mult: operator.mul,
            ast.Div: operator.truediv, ast.Lt: operator.lt, ast.LtE: operator.le,
            ast.Gt: operator.gt, ast.GtE: operator.ge,
        }  # fmt: skip
        self.real = n.mpf if hasattr(n, "mpf") else float

    def parse(self, formula):
        return ast.parse(re.sub(r"\bif\b", "where", formula).replace("^", "**"), mode="eval").body

    def evaluate(self, node, names):
        value = lambda a: self.evaluate(a, names)
        match node:
            case ast.Constant():
                return Jet(self.real(node.value))
            case ast.Name():
                return Jet.of(names[node.id])
            case ast.UnaryOp(op=ast.USub()):
                return -value(node.operand)
            case ast.BinOp(op=ast.Pow()):
                return value(node.left) ** self.evaluate(node.right, names).v
            case ast.BinOp():
                return self.operators[type(node.op)](value(node.left), value(node.right))
            case ast.Compare(ops=[op], comparators=[right]):
                return self.operators[type(op)](value(node.left).v, value(right).v)
            case ast.Call():
                return self.functions[node.func.id](*map(value, node.args))
        raise ValueError(f"not a formula: {ast.dump(node)}")


class Field:
    """One field of one step. `evaluate` gives value and gradient at a point."""

    def __init__(self, file, step=0, field=0, numbers=math):
        assert text(file.attrs["format"]) == "ppum" and file.attrs["format_version"][0] == 1
        self.n, self.formulas = numbers, Formulas(numbers)
        self.real = self.formulas.real
        group = file[f"steps/{step:04}"]
        self.partition = {k: v[()] for k, v in group["partition"].items()}
        self.weight = text(group["partition"].attrs["weight"])
        assert text(group["partition"].attrs["kind"]) == "shepard-box"
        self.min, self.max = file["domain"].attrs["min"], file["domain"].attrs["max"]
        points, offsets = group["cracks/points"][()], group["cracks/offsets"][()]
        self.cracks = [points[a:b] for a, b in zip(offsets, offsets[1:])]
        plain = lambda d: texts(d) if d.dtype.kind in "SO" else d[()]
        table = {k: plain(v) for k, v in group["functions"].items()}
        columns = [k for k in table if not k.startswith("parameter_")]
        self.table = [dict(zip(columns, row)) for row in zip(*(table[k] for k in columns))]
        rows = table["parameter_offsets"]
        for row, a, b in zip(self.table, rows, rows[1:]):
            row["parameters"] = dict(zip(table["parameter_name"][a:b], table["parameter_value"][a:b]))
            row["tree"] = self.formulas.parse(row["formula"]) if row["kind"] == "formula" else None
        data = group[f"fields/{field:04}"]
        self.components = texts(data["components"])
        self.blocks = {k: v[()] for k, v in data.items() if v.dtype.kind in "uf"}

    def evaluate(self, x, y, side=1):
        """[(value, d/dx, d/dy), …], one a component; `side` is +1 or -1 and decides on a crack."""
        p, inside = (self.real(x), self.real(y)), True
        for k in range(2):
            inside &= self.real(self.min[k]) <= p[k] <= self.real(self.max[k])
        if not inside:
            return [(math.nan,) * 3] * len(self.components)
        self.side, self.cache = side, {}
        total, values = Jet(0), [Jet(0)] * len(self.components)
        close = np.abs(self.partition["center"] - [float(x), float(y)])
        for i in np.flatnonzero((close <= self.partition["half"] * (1 + 1e-9)).all(axis=1)):
            xi = self.scaled(p, self.partition["center"][i], self.partition["half"][i])
            if all(-1 <= c.v < 1 for c in xi):
                weight = self.spline(xi[0]) * self.spline(xi[1])
                total += weight
                values = [v + weight * local for v, local in zip(values, self.local(p, i))]
        quotients = [v / total for v in values]
        return [(q.v, q.x, q.y) for q in quotients]

    def scaled(self, p, origin, scale):
        (ox, oy), (sx, sy) = map(self.real, origin), map(self.real, scale)
        return Jet((p[0] - ox) / sx, 1 / sx, 0), Jet((p[1] - oy) / sy, 0, 1 / sy)

    def spline(self, xi):
        t = abs(xi)
        u = 1 - t
        if self.weight == "linear":
            return u
        if self.weight == "quadratic":
            return 1 - 3 * t * t if 3 * t.v < 1 else u * u * 3 / 2
        assert self.weight == "cubic"
        return 1 - 6 * t * t * u if 2 * t.v < 1 else 2 * u * u * u

    def local(self, p, i):
        """Σ_b f_b Σ_k c_{b,k} ξ^k of patch i, one jet a component."""
        xi, eta = self.scaled(p, self.partition["origin"][i], self.partition["scale"][i])
        sums = [Jet(0)] * len(self.components)
        for b in range(*self.blocks["patch_blocks"][i : i + 2]):
            f = self.function(p, self.blocks["block_function"][b])
            at = int(self.blocks["block_offset"][b])
            for degree in range(self.blocks["block_degree"][b] + 1):
                for k in range(degree + 1):
                    term = f * xi ** (degree - k) * eta**k
                    values = self.blocks["coefficients"][:, at]
                    sums = [s + term * self.real(c) for s, c in zip(sums, values)]
                    at += 1
        return sums

    def function(self, p, b):
        if b not in self.cache:
            row = self.table[b]
            if row["kind"] == "one":
                self.cache[b] = Jet(self.real(1))
            elif row["kind"] == "side":
                self.cache[b] = Jet(self.real(self.sign(self.nearest(p, row["crack"]))))
            else:
                self.cache[b] = self.formulas.evaluate(row["tree"], self.names(p, row))
        return self.cache[b]

    def sign(self, distance):
        return 1 if distance > 0 or (distance == 0 and self.side > 0) else -1

    def segments(self, p, crack):
        """Unit tangent, along, distance and squared distance for each segment of a crack."""
        points = [tuple(map(self.real, q)) for q in self.cracks[crack]]
        last = len(points) - 2
        for k, (a, b) in enumerate(zip(points, points[1:])):
            dx, dy = b[0] - a[0], b[1] - a[1]
            length = self.n.sqrt(dx * dx + dy * dy)
            tx, ty = dx / length, dy / length
            px, py = p[0] - a[0], p[1] - a[1]
            along, distance = tx * px + ty * py, (dx * py - dy * px) / length
            before = -along if along < 0 and k > 0 else 0
            beyond = along - length if along > length and k < last else 0
            yield (tx, ty), along, distance, distance**2 + before**2 + beyond**2, length

    def nearest(self, p, crack):
        """Signed line distance of the nearest segment; of equally near ones the largest."""
        segments = [(square, distance) for _, _, distance, square, _ in self.segments(p, crack)]
        limit = min(segments)[0] * (1 + self.real(1e-6))
        return max((d for square, d in segments if square <= limit), key=abs)

    def names(self, p, row):
        """What a formula may use: x, y, r, theta of its frame, parameters, pi."""
        shift = sign = 0
        if row["frame"] == "tip":
            segments, start = list(self.segments(p, row["crack"])), row["frame_end"] == "start"
            (tx, ty), along, distance, _, length = segments[0 if start else -1]
            o = -1 if start else 1
            x = Jet(along if start else along - length, tx, ty) * o
            y = Jet(distance, -ty, tx) * o
            sign = o * self.sign(distance)
            if self.sign(distance) != self.sign(self.nearest(p, row["crack"])):
                shift = -2 * self.n.pi * sign
        else:
            fixed = row["frame"] == "fixed"
            (ox, oy), angle = map(self.real, row["frame_origin"]), self.real(row["frame_angle"])
            c, s = (self.n.cos(angle), self.n.sin(angle)) if fixed else (1, 0)
            ox, oy = (ox, oy) if fixed else (0, 0)
            x = Jet(c * (p[0] - ox) + s * (p[1] - oy), c, s)
            y = Jet(c * (p[1] - oy) - s * (p[0] - ox), -s, c)
            sign = 1 if y.v >= 0 else -1
        r = self.formulas.functions["sqrt"](x * x + y * y)
        theta = Jet(sign * self.n.atan2(abs(y.v), x.v) + shift)
        if r.v:
            square = x.v * x.v + y.v * y.v
            theta.x, theta.y = ((x.v * b - y.v * a) / square for a, b in ((x.x, y.x), (x.y, y.y)))
        return {"x": x, "y": y, "r": r, "theta": theta, "pi": +self.n.pi} | {
            k: self.real(v) for k, v in row["parameters"].items()
        }
