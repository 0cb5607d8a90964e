"""Random materials: constant, graded, of two parts, nearly incompressible."""

import math
from dataclasses import dataclass

import shapes
from plate import Misfit, demand, gap


@dataclass
class Material:
    """The lines of the file, what they say, the scale of the stiffness, and options of the reference."""

    text: str
    words: str
    stiffness: float
    options: str = ""


def number(value):
    return f"{value:.6g}"


def shifted(name, origin):
    """`x - 3`, or `x` where the origin is 0."""
    return f"({name} {'-' if origin > 0 else '+'} {number(abs(origin))})" if origin else name


def graded(draw, plate, base):
    """A smooth positive formula whose values lie around a base."""
    axis = draw.pick(0, 1)
    low, high = (plate.coordinate(v, axis) for v in (0.0, plate.size[axis]))
    along = f"{shifted('xy'[axis], low)}/{number(high - low)}"
    centre = plate.at([s / 2 for s in plate.size])
    form = draw.pick("exp", "exp", "linear", "wave", "bowl")
    if form == "exp":
        return f"{number(base)}*exp({number(draw.sign() * draw.between(0.5, 2.0))}*{along})"
    if form == "linear":
        return f"{number(base)}*(1 + {number(draw.between(0.5, 3.0))}*{along})"
    if form == "wave":
        return f"{number(base)}*(1 + {number(draw.between(0.2, 0.4))}*sin({number(draw.between(2.0, 4.0))}*{along}))"
    square = " + ".join(f"{shifted(n, c)}^2" for n, c in zip("xy", centre))
    return f"{number(base)}*(1 + {number(draw.between(0.5, 2.0) / plate.scale**2)}*({square}))"


def ratio_formula(draw, plate):
    """Poisson's ratio that varies smoothly between 0.1 and 0.4."""
    axis = draw.pick(0, 1)
    low, high = (plate.coordinate(v, axis) for v in (0.0, plate.size[axis]))
    along = f"{shifted('xy'[axis], low)}/{number(high - low)}"
    return draw.pick(f"0.1 + {number(draw.between(0.1, 0.28))}*{along}", f"0.35 - {number(draw.between(0.1, 0.2))}*{along}^2")


def line(draw, plate):
    """A straight interface clear of all else: the condition of one side, and the reference's option."""
    axis, slope = draw.pick(0, 1), draw.pick(0.0, draw.between(-0.6, 0.6))
    length, height = plate.size[axis], plate.size[1 - axis]
    level = draw.between(0.15, 0.85) * height
    ends = [(t * length, level + (t - 0.5) * length * slope) for t in (-0.1, 1.1)]
    demand(all(0.1 * height < level + t * length * slope < 0.9 * height for t in (-0.5, 0.5)))
    ends = [(p[axis], p[1 - axis]) for p in ends]
    clear_of_all(plate, [tuple(ends)], lambda hole: gap(hole, [tuple(ends)]))
    (ax, ay), (bx, by) = (plate.at(p) for p in ends)
    names = "xy" if axis == 0 else "yx"
    a, b = ((ax, ay), (bx, by)) if axis == 0 else ((ay, ax), (by, bx))
    incline = (b[1] - a[1]) / (b[0] - a[0])
    # the printed condition and the option state the same line to all digits
    rise = f" + {incline!r}*({names[0]} - {a[0]!r})".replace("- -", "+ ") if incline else ""
    option = f"--interface {ax!r},{ay!r} {bx!r},{by!r}"
    return f"{names[1]} > {a[1]!r}{rise}", option, "straight interface"


def circle(draw, plate):
    """A circular interface clear of all else."""
    hole = plate.circle(0.1, 0.3)
    clear_of_all(plate, [], lambda other: shapes.apart(*(ring(h) for h in (hole, other))))
    demand(all(gap(hole, shapes.segments(crack)) > plate.margin for crack in plate.cracks))
    (x, y), radius = plate.at(hole["center"]), plate.length(hole["radius"])
    square = " + ".join(f"{shifted(n, c)}^2" for n, c in (("x", x), ("y", y)))
    return f"{square} < {radius!r}^2", f"--interface-circle {x!r},{y!r},{radius!r}", "round inclusion"


def ring(hole):
    from plate import outline
    return outline(hole)


def clear_of_all(plate, parts, distance):
    for crack in plate.cracks:
        demand(not parts or shapes.apart(parts, shapes.segments(crack)) > plate.margin)
    demand(all(distance(hole) > plate.margin for hole in plate.holes))


def two_parts(draw, plate, base, curved):
    condition, option, words = tried(draw, plate, circle if curved else line)
    factor = draw.pick(0.1, 0.3, 2.0, 5.0, 10.0)
    inner = base * factor
    if draw.chance(0.25):
        inner = graded(draw, plate, inner)
    return f"if({condition}, {inner if isinstance(inner, str) else number(inner)}, {number(base)})", condition, option, words


def tried(draw, plate, make):
    """Twenty attempts at what has to fit."""
    for _ in range(20):
        try:
            return make(draw, plate)
        except Misfit:
            pass
    raise Misfit


def quoted(value):
    return f'"{value}"' if isinstance(value, str) else number(value)


def material(draw, plate, kind):
    """A material of elasticity."""
    state = draw.pick("plane-strain", "plane-stress")
    base, ratio = draw.pick(1.0, 1.0, 70.0, 1000.0, 210000.0), draw.pick(0.3, 0.0, round(draw.between(0.1, 0.42), 3))
    young, options, words, sort = base, "", "constant", draw.random()
    if kind.startswith("graded") or kind == "anything" and sort < 0.4 or sort < 0.03:
        words = "graded"
        choice = draw.pick("young", "young", "poisson", "both")
        young = graded(draw, plate, base) if choice != "poisson" else base
        ratio = ratio_formula(draw, plate) if choice != "young" else ratio
    elif kind in ("two materials", "inclusion") or kind == "anything" and sort < 0.6:
        curved = kind == "inclusion" or kind == "anything" and draw.chance(0.5)
        young, condition, options, words = two_parts(draw, plate, base, curved)
        if draw.chance(0.4):
            ratio = f"if({condition}, {number(draw.between(0.1, 0.4))}, {number(ratio)})"
    elif kind == "near-incompressible" or sort > 0.97:
        ratio, state, words = draw.pick(0.49, 0.495, 0.499, 0.4999), "plane-strain", "nearly incompressible"
    text = f'[material]\nyoung = {quoted(young)}\npoisson = {quoted(ratio)}\nstate = "{state}"\n'
    return Material(text, f"{words}, {state}", base, options)


def conductivity(draw, plate):
    """A material of Poisson's equation."""
    base, sort = draw.pick(1.0, 5.0, 100.0), draw.random()
    if sort < 0.4:
        return Material("", "conductivity 1", 1.0)
    value, options, words = base, "", "constant"
    if sort < 0.7:
        value, words = graded(draw, plate, base), "graded"
    elif sort < 0.85:
        value, _, options, words = two_parts(draw, plate, base, draw.chance(0.5))
    return Material(f"[material]\nconductivity = {quoted(value)}\n", words, base, options)
