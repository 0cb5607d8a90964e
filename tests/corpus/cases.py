"""Cases: how themes state them, how they are computed and printed."""

import dataclasses
import math

import mpmath
import sympy
from mpmath import mp, mpf

import exact
import rounding
from language import parse
from rounding import Evaluation, Jet, Number, given, pairs

HALF_ANGLES = ("cos(theta/2)", "sin(theta/2)")
UNIT = {"double": mpf(2) ** -53, "single": mpf(2) ** -24}
# numbers met on the way in single precision: far enough from its ends for another order of operations
SINGLE_RANGE = (mpf(2) ** -100, mpf(2) ** 100)
LARGEST = mpf(2) ** 1000


@dataclasses.dataclass
class Case:
    """One formula at one place. `at` holds doubles; `order` is the highest derivative that is compared."""

    formula: str
    scope: str
    at: dict
    meaning: object = None
    order: int = 2
    parameters: dict = dataclasses.field(default_factory=dict)
    tables: tuple = ()
    turns: int = 0
    # k: +1 or −1
    sides: dict = dataclasses.field(default_factory=dict)
    # by the rules of IEEE 754: value and gradient as texts
    special: tuple = None

    def variables(self):
        return {"cartesian": ["x", "y"], "polar": ["x", "y"]}.get(self.scope, self.scope.split())


def plane(formula, *points, meaning=None, order=2, tables=(), **parameters):
    """Cases of the scope `cartesian`."""
    make = lambda p: Case(
        formula, "cartesian", dict(x=p[0], y=p[1]), meaning, order, parameters, tables
    )
    return [make(p) for p in points]


def frame(formula, *points, meaning=None, order=2, turns=0, sides=None, **parameters):
    """Cases of the scope `polar`. Behind the origin, at y = 0, θ = π; whole turns are added to it."""
    at = lambda p: dict(x=p[0], y=p[1])
    make = lambda p: Case(formula, "polar", at(p), meaning, order, parameters, (), turns, sides or {})
    return [make(p) for p in points]


def line(formula, *places, meaning=None, order=2, tables=(), **parameters):
    """Cases of one variable t."""
    return [Case(formula, "t", {"t": t}, meaning, order, parameters, tables) for t in places]


def named(scope, formula, *points, meaning=None, order=2, **parameters):
    """Cases of a scope of other variables, their names divided by blanks."""
    names = scope.split()
    return [Case(formula, scope, dict(zip(names, p)), meaning, order, parameters) for p in points]


def special(scope, formula, point, value, gradient=None):
    """A case that arithmetic of doubles decides, and real numbers do not."""
    names = {"cartesian": ["x", "y"], "polar": ["x", "y", "r", "theta", *HALF_ANGLES]}.get(
        scope, scope.split()
    )
    return [Case(formula, scope, dict(zip(names, point)), special=(value, gradient))]


class Computed:
    """What a case must give, and what rounding may do to it."""

    def __init__(self, case, tables):
        self.case, self.tables = case, {name: tables[name] for name in case.tables}
        self.tree = parse(case.formula)
        self.variables = case.variables()
        self.orders = self.exact_orders()
        with mp.workdps(700):
            evaluation = Evaluation(self.names(), len(self.variables), self.tables, case.order)
            self.jet = evaluation.jet(self.tree)
            self.decisions, self.sizes = (
                evaluation.decisions,
                [abs(v) for v in evaluation.sizes if v],
            )
            self.check()

    # sympy

    def exact_orders(self):
        case, symbols = self.case, self.symbols()
        meaning = case.formula if case.meaning is None else case.meaning
        if isinstance(meaning, str):
            meaning = exact.meaning(meaning, symbols)
        variables = tuple(symbols[v] for v in self.variables)
        inputs = [*variables, exact.turns]
        values = [*(case.at[v] for v in self.variables), case.turns]
        evaluate = lambda e: exact.settled(exact.compiled(e, inputs, self.tables), values)
        rows = exact.derivatives(sympy.sympify(meaning), variables)
        return [[evaluate(e) for e in row] for row in rows[: case.order + 1]]

    def symbols(self):
        names = {v: sympy.Symbol(v, real=True) for v in self.variables}
        names |= {
            k: sympy.Rational(*float(v).as_integer_ratio()) for k, v in self.case.parameters.items()
        }
        if self.case.scope == "polar":
            names |= {"r": exact.r, "theta": exact.theta}
        tables = {name: sympy.Symbol(name) for name in self.case.tables}
        table = lambda name, *at: exact.Spline(name, 0, 0, *at)
        dtable = lambda name, *rest: exact.Spline(
            name, *(rest[: len(rest) // 2] + (0,))[:2], *rest[len(rest) // 2 :]
        )
        side = lambda k: sympy.Integer(self.case.sides[int(k)])
        return names | tables | {"table": table, "dtable": dtable, "side": side}

    # running errors

    def names(self):
        n = len(self.variables)
        names = {k: Jet.constant(given(v), n) for k, v in self.case.parameters.items()}
        names |= {f"side({k})": Jet.constant(given(v), n) for k, v in self.case.sides.items()}
        for i, v in enumerate(self.variables):
            names[v] = Jet.constant(given(self.case.at[v]), n)
            names[v].gradient[i] = rounding.ONE
        return names | (self.polar() if self.case.scope == "polar" else {})

    def polar(self):
        """r and θ with their derivatives, as a caller knows them: rounded, and so are the derivatives."""
        x, y = mpf(self.case.at["x"]), mpf(self.case.at["y"])
        r = mpmath.hypot(x, y)
        c, s = x / r, y / r
        n = lambda v, roundings, size: Number(v).rounded(roundings, 0, size)
        jet = lambda v, g, h, size: Jet(
            Number(v).rounded(),
            [n(a, 3, size) for a in g],
            dict(zip(pairs(2), (n(a, 8, size / r) for a in h))),
        )
        theta = mpmath.atan2(y, x) + 2 * mp.pi * self.case.turns
        return {
            "r": jet(r, [c, s], [s * s / r, -s * c / r, c * c / r], mpf(1)),
            "theta": jet(
                theta,
                [-s / r, c / r],
                [2 * s * c / r**2, (s * s - c * c) / r**2, -2 * s * c / r**2],
                1 / r,
            ),
        }

    def bounds(self):
        """For each order the three parts of the largest error bound."""
        rows = self.jet.orders()[: self.case.order + 1]
        return [[max(a.errors[part] for a in row) for part in range(3)] for row in rows]

    # checks

    def check(self):
        for order, (row, other) in enumerate(zip(self.orders, self.jet.orders())):
            size = max(a.total() + abs(a.v) for a in other)
            for v, a in zip(row, other, strict=True):
                assert abs(v - a.v) <= mpf(10) ** -38 * size, (
                    f"{self.case}: order {order}: {v} is not {a.v}"
                )
        assert not self.undecided("double"), f"{self.case}: undecided in double precision"
        assert max(self.sizes, default=0) < LARGEST, f"{self.case}: leaves the range of doubles"
        for row, bound in zip(self.orders, self.bounds()):
            size = max(map(abs, row))
            lost = (
                0 < rounding.LEAST_NORMAL <= size < 100 * UNIT["double"] * (bound[0] + 4 * bound[1])
            )
            assert not lost, f"{self.case}: no digits are left"

    def undecided(self, precision):
        """Whether rounding may decide a comparison or a kink."""
        weights = (16, 64, 16 if precision == "single" else 0)
        return any(
            gap <= UNIT[precision] * sum(w * e for w, e in zip(weights, error))
            for gap, error in self.decisions
            if any(w * e for w, e in zip(weights, error))
        )

    def single(self):
        """Why single precision cannot be asked, if so."""
        if any(not SINGLE_RANGE[0] < v < SINGLE_RANGE[1] for v in self.sizes):
            return "a number leaves its range"
        if self.undecided("single"):
            return "rounding decides a comparison or a kink"
        for row, bound in zip(self.orders, self.bounds()):
            size = max(map(abs, row))
            if size and UNIT["single"] * sum(bound) > size / 20:
                return "few digits are left"
        return None

    # text

    def inputs(self):
        """All inputs as doubles: for a frame the doubles nearest to r, θ and the half angles."""
        at = {k: float(v) for k, v in self.case.at.items()}
        sides = {f"side({k})": float(v) for k, v in self.case.sides.items()}
        if self.case.scope != "polar":
            return at | sides
        with mp.workdps(700):
            x, y = mpf(at["x"]), mpf(at["y"])
            theta = mpmath.atan2(y, x) + 2 * mp.pi * self.case.turns
            numbers = [mpmath.hypot(x, y), theta, mpmath.cos(theta / 2), mpmath.sin(theta / 2)]
            if y == 0 and x < 0:
                numbers[2] = 0
            return at | dict(zip(("r", "theta", *HALF_ANGLES), map(float, numbers))) | sides

    def record(self):
        lines = head(self.case, self.inputs())
        for name, row in zip(("value", "gradient", "hessian"), self.orders):
            lines.append(f"{name}: {' '.join(map(decimal, row))}")
        for part, name in enumerate(rounding.PARTS):
            lines.append(f"{name}: {' '.join(upwards(bound[part]) for bound in self.bounds())}")
        if self.single():
            lines.append(f"single: no, {self.single()}")
        return "\n".join(lines) + "\n"


def head(case, inputs):
    listed = lambda pairs: ", ".join(f"{k} = {v!r}" for k, v in pairs.items())
    text = case.formula.replace("\r", "\\r").replace("\n", "\\n").replace("\t", "\\t")
    lines = [f"formula: {text}", f"scope: {case.scope}"]
    if case.parameters:
        lines.append(f"parameters: {listed({k: float(v) for k, v in case.parameters.items()})}")
    if case.tables:
        lines.append(f"tables: {' '.join(case.tables)}")
    return lines + [f"at: {listed(inputs)}"]


def special_record(case):
    lines = head(case, {k: float(v) for k, v in case.at.items()})
    value, gradient = case.special
    lines.append(f"value: {value}")
    if gradient:
        lines.append(f"gradient: {gradient}")
    if not all(map(fits_single, [*case.at.values(), value, *(gradient or "").split()])):
        lines.append("single: no, a number leaves its range")
    return "\n".join(lines) + "\n"


def fits_single(v):
    size = abs(float(v))
    return size in (0, math.inf) or math.isnan(size) or SINGLE_RANGE[0] < size < SINGLE_RANGE[1]


def decimal(v):
    """25 digits."""
    with mp.workdps(60):
        text = mpmath.nstr(mpf(v), 25, min_fixed=-5, max_fixed=8)
    return text.removesuffix(".0").replace("e+", "e")


def upwards(v):
    """Two digits, not less."""
    if v == 0:
        return "0"
    with mp.workdps(30):
        exponent = int(mpmath.floor(mpmath.log10(v))) - 1
        digits = int(mpmath.ceil(mpf(v) / mpf(10) ** exponent))
    return repr(float(f"{digits}e{exponent}")) if abs(exponent) < 300 else f"{digits}e{exponent}"
