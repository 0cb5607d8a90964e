"""The formula language of datasets, written from FORMAT.md ("Formulas") alone.

    formula = Formula("let d = x - y; d^2/2", ["x", "y"])
    formula.evaluate({"x": 5.0, "y": 1.0})        8.0, and derivatives 4.0, -4.0

The arithmetic is that of `Double` or of `Extended`, so the same code is an evaluator in double and in
extended precision.
"""

import math
import re
import sys

import mpmath
import numpy as np

# A formula may be nested 200 deep, which takes five calls a level.
sys.setrecursionlimit(max(sys.getrecursionlimit(), 10_000))


class Double:
    """IEEE doubles: nothing is an error, 1/0 is infinite and 0/0 not a number."""

    real, pi, e = float, math.pi, math.e

    @staticmethod
    def call(name, *arguments):
        with np.errstate(all="ignore"):
            # names that numpy has had before 2
            name = name.replace("a", "arc", 1) if name.startswith(("asin", "acos", "atan")) else name
            return float(getattr(np, name)(*map(np.float64, arguments)))

    @staticmethod
    def solve(rows, right):
        return list(np.linalg.solve(np.array(rows), np.array(right)))


class Extended:
    """The numbers of mpmath, with as many digits as `mpmath.mp.dps` says."""

    real = mpmath.mpf
    pi, e = mpmath.pi, mpmath.e

    @staticmethod
    def call(name, *arguments):
        if name == "cbrt" and arguments[0] < 0:
            return -mpmath.cbrt(-arguments[0])
        try:
            value = getattr(mpmath, {"pow": "power"}.get(name, name))(*arguments)
        except ZeroDivisionError:
            return mpmath.inf
        return value if isinstance(value, mpmath.mpf) else mpmath.nan

    @staticmethod
    def solve(rows, right):
        return list(mpmath.lu_solve(mpmath.matrix(rows), mpmath.matrix(right)))


def quotient(a, b):
    """a/b, infinite or not a number where b is 0."""
    return a / b if b else a * math.copysign(math.inf, b)


class Jet:
    """A value with its slopes: {variable: derivative}.

    What does not depend on a variable has no slope there, which is more than a slope that happens to be
    zero: in √max(x, 0) at x < 0 it makes the product with 1/(2√0) vanish.
    """

    def __init__(self, value, slopes=None):
        self.v, self.slopes = value, slopes or {}

    @staticmethod
    def of(a):
        return a if isinstance(a, Jet) else Jet(a)

    def scaled(self, factor):
        return {k: factor * slope for k, slope in self.slopes.items()}

    def chain(self, value, slope):
        """f(a), from f and its derivative at a."""
        return Jet(value, self.scaled(slope))

    def is_zero(self):
        return self.v == 0 and not self.slopes

    def __add__(self, b):
        b = Jet.of(b)
        return Jet(self.v + b.v, total(self.slopes, b.slopes))

    def __mul__(self, b):
        b = Jet.of(b)
        if self.is_zero() or b.is_zero():
            return Jet(self.v * b.v)
        return Jet(self.v * b.v, total(self.scaled(b.v), b.scaled(self.v)))

    def __truediv__(self, b):
        b = Jet.of(b)
        value = quotient(self.v, b.v)
        # 1/b has the slope 0 where b overflows, not 0 · ∞
        slopes = total(self.slopes, {} if abs(b.v) == math.inf else b.scaled(-value))
        return Jet(value, {k: quotient(slope, b.v) for k, slope in slopes.items()})

    def __neg__(self):
        return Jet(-self.v, self.scaled(-1))

    def __sub__(self, b):
        return self + -Jet.of(b)

    __radd__, __rmul__ = __add__, __mul__
    __rsub__ = lambda self, b: -self + b
    __rtruediv__ = lambda self, b: Jet.of(b) / self


def total(a, b):
    return {k: a[k] + b[k] if k in a and k in b else a.get(k, b.get(k)) for k in a | b}


def polar(x, y, theta, n):
    """The names of a frame's coordinates; `theta` is the polar angle on its branch."""
    r = n.call("hypot", x, y)
    # at the origin r has the derivative from the right, and theta none
    cos, sin = (quotient(x, r), quotient(y, r)) if r else (n.real(1), n.real(0))
    return {
        "x": Jet(x, {"x": n.real(1)}),
        "y": Jet(y, {"y": n.real(1)}),
        "r": Jet(r, {"x": cos, "y": sin}),
        "theta": Jet(theta, {"x": -quotient(sin, r), "y": quotient(cos, r)}),
    }


class Functions:
    """The functions and operators on jets, with the derivatives of section "Derivatives"."""

    # the derivative of f at v, where f(v) = f
    SLOPES = {
        "sqrt": lambda n, v, f: quotient(1, 2 * f),
        "cbrt": lambda n, v, f: quotient(1, 3 * f * f),
        "exp": lambda n, v, f: f,
        "log": lambda n, v, f: quotient(1, v),
        "log10": lambda n, v, f: quotient(1, v * n.call("log", n.real(10))),
        "sin": lambda n, v, f: n.call("cos", v),
        "cos": lambda n, v, f: -n.call("sin", v),
        "tan": lambda n, v, f: quotient(1, n.call("cos", v) ** 2),
        "asin": lambda n, v, f: quotient(1, n.call("sqrt", (1 - v) * (1 + v))),
        "acos": lambda n, v, f: quotient(-1, n.call("sqrt", (1 - v) * (1 + v))),
        "atan": lambda n, v, f: 1 / (1 + v * v),
        "sinh": lambda n, v, f: n.call("cosh", v),
        "cosh": lambda n, v, f: n.call("sinh", v),
        "tanh": lambda n, v, f: quotient(1, n.call("cosh", v)) ** 2,
    }

    def __init__(self, numbers, variables):
        self.n, self.variables = numbers, variables

    def named(self, name):
        """The function of a name and the number of its arguments."""
        if name in self.SLOPES:
            return (lambda a: self.smooth(name, a)), 1
        own = {"abs": 1, "sign": 1, "floor": 1, "min": 2, "max": 2, "hypot": 2, "atan2": 2, "clamp": 3}
        return (getattr(self, name), own[name]) if name in own else (None, 0)

    def smooth(self, name, a):
        value = self.n.call(name, a.v)
        return Jet(value, a.slopes and a.scaled(self.SLOPES[name](self.n, a.v, value)))

    def is_upper(self, a):
        """a > 0, or a = 0 and the function grows to the right, or does not change and grows upwards."""
        if a.v == 0:
            for variable in self.variables:
                if a.slopes.get(variable, 0) != 0:
                    return a.slopes[variable] > 0
            return True
        return a.v > 0

    def abs(self, a):
        return Jet(abs(a.v), (a if self.is_upper(a) else -a).slopes)

    def sign(self, a):
        return Jet(self.n.real((a.v > 0) - (a.v < 0)) if a.v == a.v else a.v)

    def floor(self, a):
        return Jet(self.n.call("floor", a.v))

    def max(self, a, b):
        # `a != a`: not a number
        value = a.v if a.v > b.v or a.v != a.v else b.v
        return Jet(value, (a if self.exceeds(a, b) else b).slopes)

    def min(self, a, b):
        value = a.v if a.v < b.v or a.v != a.v else b.v
        return Jet(value, (b if self.exceeds(a, b) else a).slopes)

    def exceeds(self, a, b):
        return self.is_upper(a - b) if a.v == b.v else a.v > b.v

    def clamp(self, a, low, high):
        return self.min(self.max(a, low), high)

    def hypot(self, a, b):
        value = self.n.call("hypot", a.v, b.v)
        return Jet(value, total(a.scaled(quotient(a.v, value)), b.scaled(quotient(b.v, value))))

    def atan2(self, y, x):
        radius = self.n.call("hypot", y.v, x.v)
        turn = total(y.scaled(quotient(x.v, radius)), x.scaled(-quotient(y.v, radius)))
        slopes = {k: quotient(slope, radius) for k, slope in turn.items()}
        return Jet(self.n.call("atan2", y.v, x.v), slopes)

    def power(self, a, b):
        if not b.slopes and b.v == 0.5:
            return self.smooth("sqrt", a)
        value = self.n.call("pow", a.v, b.v)
        # what does not depend on a variable adds no term, whatever its factor is
        of_base = a.slopes and b.v != 0 and a.scaled(b.v * self.n.call("pow", a.v, b.v - 1))
        of_exponent = b.slopes and b.scaled(value * self.n.call("log", a.v))
        return Jet(value, total(of_base or {}, of_exponent or {}))


class Table:
    """Data as a smooth function of one or two numbers: section "Tables"."""

    def __init__(self, x, y, values, numbers=Double):
        self.n = numbers
        real = lambda knots: [numbers.real(float(knot)) for knot in knots]
        self.x, self.y = real(x), None if y is None else real(y)
        rows = [values] if y is None else values
        self.rows = [Spline(self.x, real(row), numbers) for row in rows]

    def derivative(self, orders, x, y=None):
        across = [row.derivative(orders[0], x) for row in self.rows]
        if self.y is None:
            return across[0]
        return Spline(self.y, across, self.n).derivative(orders[1], y)

    def evaluate(self, orders, *arguments):
        """The derivative of these orders at jets."""
        at, slopes = [a.v for a in arguments], {}
        for k, a in enumerate(arguments):
            raised = [order + (k == axis) for axis, order in enumerate(orders)]
            slope = self.derivative(raised, *at) if a.slopes and raised[k] <= 3 else None
            slopes = total(slopes, {} if slope is None else a.scaled(slope))
        return Jet(self.derivative(orders, *at), slopes)


class Spline:
    """The cubic spline through values at knots, with the not-a-knot conditions, constant outside.

    On a cell of width h, with c the slope of its chord and m, m' those of the spline at its ends, it is
    v + m t + (3c − 2m − m')/h t² + (m + m' − 2c)/h² t³.
    """

    def __init__(self, knots, values, n):
        self.knots, self.values = knots, values
        self.h = [b - a for a, b in zip(knots, knots[1:])]
        self.chords = [(b - a) / h for a, b, h in zip(values, values[1:], self.h)]
        self.slopes = self.solve(n)

    def solve(self, n):
        """The slopes at the knots: one equation a knot."""
        h, cells = self.h, len(self.h)

        def equation(*terms):
            """Σ factor (a m_i + b m_{i+1} − c chord_i) = 0 as a row and a right-hand side."""
            row, right = [n.real(0)] * (cells + 1), n.real(0)
            for factor, i, a, b, c in terms:
                row[i] += factor * a
                row[i + 1] += factor * b
                right += factor * c * self.chords[i]
            return row, right

        # the second and the third derivative are the same on both sides of the knot after cell i
        second = lambda i: equation((1 / h[i], i, 1, 2, 3), (1 / h[i + 1], i + 1, 2, 1, 3))
        third = lambda i: equation((1 / h[i] ** 2, i, 1, 1, 2), (-1 / h[i + 1] ** 2, i + 1, 1, 1, 2))
        no_third = lambda i: equation((1, i, 1, 1, 2))
        if cells == 1:
            return self.chords * 2
        ends = [no_third(0), no_third(1)] if cells == 2 else [third(0), third(cells - 2)]
        rows, right = zip(*ends, *(second(i) for i in range(cells - 1)))
        return n.solve(list(rows), list(right))

    def derivative(self, order, x):
        inside = min(max(x, self.knots[0]), self.knots[-1]) if x == x else x
        if order > 3 or (order > 0 and inside != x and x == x):
            return 0 * self.values[0]
        i = sum(knot <= inside for knot in self.knots[1:-1])
        t, h, c = inside - self.knots[i], self.h[i], self.chords[i]
        m, m1 = self.slopes[i : i + 2]
        cubic = [self.values[i], m, (3 * c - 2 * m - m1) / h, (m + m1 - 2 * c) / h**2]
        for _ in range(order):
            cubic = [k * a for k, a in enumerate(cubic)][1:]
        return sum(a * t**k for k, a in enumerate(cubic))


TOKEN = re.compile(
    r"(?P<number>(?:[0-9]+\.?[0-9]*|\.[0-9]+)(?:[eE][+-]?[0-9]+)?)"
    r"|(?P<name>[A-Za-z_][A-Za-z0-9_]*)|(?P<sign>[<>=!]=|[-+*/^<>=(),;−·])"
)
BLANK = re.compile(r"(?:\s|#[^\n]*)*")
LEVELS = [["or"], ["and"], ["not"], ["<", "<=", ">", ">=", "==", "!="], ["+", "-"], ["*", "/"], ["^"]]
STRENGTH = {sign: level for level, signs in enumerate(LEVELS) for sign in signs}
COMPARISONS = {
    "<": lambda a, b: a < b, "<=": lambda a, b: a <= b, ">": lambda a, b: a > b,
    ">=": lambda a, b: a >= b, "==": lambda a, b: a == b, "!=": lambda a, b: a != b,
}  # fmt: skip


def tokens(text):
    """(kind, text) of each token; the last is ("end", "")."""
    position, found = BLANK.match(text).end(), []
    while position < len(text):
        match = TOKEN.match(text, position)
        if not match:
            raise SyntaxError(f"no formula at character {position}: {text!r}")
        found.append((match.lastgroup, {"−": "-", "·": "*"}.get(match[0], match[0])))
        position = BLANK.match(text, match.end()).end()
    return [*found, ("end", "")]


class Formula:
    """A formula of variables, other inputs, parameters (all by name), and tables.

    Parsing makes a function of each part of the text; it takes the names' jets and gives a jet, or
    True or False if the part is a condition.
    """

    def __init__(self, text, variables, tables=None, numbers=Double):
        self.n, self.tables = numbers, tables or {}
        self.names, self.sides = set(), set()  # what it uses
        self.functions = Functions(numbers, variables)
        self.variables = variables
        self.tokens, self.next = tokens(text), 0
        self.value = self.block()
        self.take("")

    def evaluate(self, names):
        """The jet of the formula. `names` has jets or numbers; variables as numbers get the slope 1 in
        themselves."""
        one = lambda name: {name: self.n.real(1)} if name in self.variables else {}
        jet = lambda name, value: value if isinstance(value, Jet) else Jet(value, one(name))
        names = {name: jet(name, value) for name, value in names.items()}
        constants = {"pi": Jet(+self.n.pi), "e": Jet(+self.n.e)}
        return self.value(constants | names)

    def peek(self):
        return self.tokens[self.next][1]

    def take(self, expected=None):
        kind, text = self.tokens[self.next]
        if expected is not None and text != expected:
            raise SyntaxError(f"{text!r} instead of {expected!r}")
        self.next += 1
        return kind, text

    def block(self):
        """let name = expression; … expression"""
        lets = []
        while self.peek() == "let":
            self.take()
            name = self.take()[1]
            self.take("=")
            lets.append((name, self.expression()))
            self.take(";")
        result = self.expression()

        def value(names):
            for name, bound in lets:
                names = names | {name: bound(names)}
            return result(names)

        return value if lets else result

    def expression(self, weakest=0):
        """Operands joined by operators that bind at least as tightly as `weakest`."""
        left = self.operand()
        while self.peek() != "not" and STRENGTH.get(self.peek(), -1) >= weakest:
            sign = self.take()[1]
            # `^` groups from the right, all others from the left
            left = self.infix(sign, left, self.expression(STRENGTH[sign] + (sign != "^")))
            if sign in COMPARISONS and self.peek() in COMPARISONS:
                raise SyntaxError("comparisons do not chain")
        return left

    def infix(self, sign, a, b):
        if sign in COMPARISONS:
            return lambda names: COMPARISONS[sign](a(names).v, b(names).v)
        return {
            "or": lambda names: a(names) or b(names),
            "and": lambda names: a(names) and b(names),
            "+": lambda names: a(names) + b(names),
            "-": lambda names: a(names) - b(names),
            "*": lambda names: a(names) * b(names),
            "/": lambda names: a(names) / b(names),
            "^": lambda names: self.functions.power(a(names), b(names)),
        }[sign]

    def operand(self):
        kind, text = self.take()
        if text == "not":
            condition = self.expression(STRENGTH["<"])
            return lambda names: not condition(names)
        if text in ("-", "+"):
            operand = self.expression(STRENGTH["^"])
            return (lambda names: -operand(names)) if text == "-" else operand
        if text == "(":
            inner = self.block()
            self.take(")")
            return inner
        if kind == "number":
            # the double nearest to the decimal
            number = Jet(self.n.real(float(text)))
            return lambda names: number
        if kind != "name":
            raise SyntaxError(f"unexpected {text!r}")
        return self.call(text) if self.peek() == "(" else self.name(text)

    def name(self, name):
        self.names.add(name)
        return lambda names: names[name]

    def call(self, name):
        self.take("(")
        if name in ("table", "dtable"):
            return self.table(name == "dtable")
        arguments = self.arguments()
        if name == "side":
            crack = self.whole(arguments[0])
            self.sides.add(crack)
            return lambda names: names[f"side({crack})"]
        if name == "if":
            condition, a, b = arguments
            return lambda names: a(names) if condition(names) else b(names)
        function, count = self.functions.named(name)
        if function is None or len(arguments) != count:
            raise SyntaxError(f"no function {name!r} of {len(arguments)} arguments")
        return lambda names: function(*(argument(names) for argument in arguments))

    def arguments(self):
        arguments = [self.block()]
        while self.peek() == ",":
            self.take()
            arguments.append(self.block())
        self.take(")")
        return arguments

    def table(self, is_derivative):
        table = self.tables[self.take()[1]]
        self.take(",")
        arguments, orders = self.arguments(), [0] if table.y is None else [0, 0]
        if is_derivative:
            orders = [self.whole(order) for order in arguments[: len(orders)]]
            del arguments[: len(orders)]
        return lambda names: table.evaluate(orders, *(argument(names) for argument in arguments))

    def whole(self, argument):
        return int(argument({}).v)
