"""Value, gradient and Hessian of a formula with bounds of the rounding errors, operation by operation.

This is running error analysis (Higham, Accuracy and Stability of Numerical Algorithms, 2002, section 3.3)
in extended precision: every number carries to first order the error that an evaluation of the formula
as it is written may have, in units of the unit roundoff u, in three parts:

    arithmetic  what + - * / sqrt, integer powers and the rounding of pi, e, r, theta contribute
    functions   what one rounding of each function (sin, exp, pow …) contributes
    inputs      what rounding inputs and literals to single precision contributes

Derivatives are carried along by the chain rule (jets), so this is also a second evaluation of the
cases, which shares nothing with sympy's differentiation of the other text.
"""

import functools
import itertools
import struct
from fractions import Fraction

import mpmath
import sympy
from mpmath import mp, mpf

PARTS = ("arithmetic", "functions", "inputs")


LEAST_NORMAL = mpf(2) ** -1022
SMALLEST = mpf(10) ** -600  # of sin and cos that are not zero
UNDERFLOW = mpf(2) ** (-1074 + 53)  # the least double in units of u


class Number:
    """A number and bounds of its error, one for each of PARTS."""

    __slots__ = ("v", "errors")

    def __init__(self, v, errors=(0, 0, 0)):
        self.v, self.errors = mpf(v), errors

    def is_zero(self):
        return self.v == 0 and not any(self.errors)

    def rounded(self, arithmetic=1, functions=0, scale=None):
        """The number after further operations with results of size `scale`. What doubles have exactly
        is not rounded."""
        a, f, i = self.errors
        if not (functions or scale or any(self.errors)) and float(self.v) == self.v:
            return given(self.v)
        size = abs(self.v) if scale is None else scale
        if 0 < abs(self.v) < LEAST_NORMAL:
            a += UNDERFLOW
        return Number(self.v, (a + arithmetic * size, f + functions * size, i))

    def total(self):
        return sum(self.errors)


ZERO, ONE = Number(0), Number(1)


def is_single(v):
    """Whether single precision has the number."""
    try:
        return struct.unpack("f", struct.pack("f", v))[0] == v
    except OverflowError:
        return False


def given(v):
    """An input or a literal: exact in double precision, rounded in single."""
    return Number(v, (0, 0, 0 if is_single(float(v)) else abs(mpf(v))))


def plus(a, b):
    if a.is_zero() or b.is_zero():
        return b if a.is_zero() else a
    return Number(a.v + b.v, tuple(x + y for x, y in zip(a.errors, b.errors))).rounded()


def times(a, b):
    if a.is_zero() or b.is_zero():
        return ZERO
    for one, other in ((a, b), (b, a)):
        if abs(one.v) == 1 and not any(one.errors):
            return Number(one.v * other.v, other.errors)
    errors = tuple(abs(a.v) * y + abs(b.v) * x for x, y in zip(a.errors, b.errors))
    return Number(a.v * b.v, errors).rounded()


class Jet:
    """Value, gradient, and the Hessian as a dictionary of pairs i ≤ j."""

    def __init__(self, v, gradient, hessian):
        self.v, self.gradient, self.hessian = v, gradient, hessian

    @staticmethod
    def constant(v, n):
        return Jet(v, [ZERO] * n, {pair: ZERO for pair in pairs(n)})

    def orders(self):
        """The numbers by order of derivative."""
        return [[self.v], self.gradient, list(self.hessian.values())]

    def negative(self):
        minus = lambda a: Number(-a.v, a.errors)
        hessian = {pair: minus(a) for pair, a in self.hessian.items()}
        return Jet(minus(self.v), [minus(a) for a in self.gradient], hessian)


def pairs(n):
    return list(itertools.combinations_with_replacement(range(n), 2))


A, B = sympy.symbols("a b", real=True)
RADIUS = sympy.sqrt(A * A + B * B)
# name: the function; how often its value is rounded by arithmetic and by functions; sizes from which its
# partial derivatives are rounded where these are larger than the derivatives themselves
OPERATIONS = {
    "+": (A + B, 1, 0, {}), "*": (A * B, 1, 0, {}), "/": (A / B, 1, 0, {}),
    "sqrt": (sympy.sqrt(A), 1, 0, {}), "exp": (sympy.exp(A), 0, 1, {}),
    "log": (sympy.log(A), 0, 1, {}), "log10": (sympy.log(A) / sympy.log(10), 0, 1, {}),
    "sin": (sympy.sin(A), 0, 1, {}), "cos": (sympy.cos(A), 0, 1, {}), "tan": (sympy.tan(A), 0, 1, {}),
    # the slope of (1 − a)(1 + a), a difference
    "asin": (sympy.asin(A), 0, 1, {(0, 0): (1 - A**2) ** sympy.Rational(-3, 2)}),
    "acos": (sympy.acos(A), 0, 1, {(0, 0): (1 - A**2) ** sympy.Rational(-3, 2)}),
    "atan": (sympy.atan(A), 0, 1, {}), "sinh": (sympy.sinh(A), 0, 1, {}),
    "cosh": (sympy.cosh(A), 0, 1, {}), "tanh": (sympy.tanh(A), 0, 1, {}),
    # exponents b − 1, b − 2 are rounded; 1 + b log a cancels
    "pow": (A**B, 0, 1, {
        (0,): B * A ** (B - 1) * (1 + sympy.Abs((B - 1) * sympy.log(A))),
        (0, 0): B * (B - 1) * A ** (B - 2) * (1 + sympy.Abs((B - 2) * sympy.log(A))),
        (0, 1): A ** (B - 1) * (1 + sympy.Abs(B * sympy.log(A))),
    }),
    # second derivatives are differences such as (1 − cos²)/r
    "hypot": (RADIUS, 0, 1, {k: 1 / RADIUS for k in pairs(2)}),
    "atan2": (sympy.atan2(A, B), 0, 1, {k: 1 / RADIUS**2 for k in pairs(2)}),
}  # fmt: skip
DERIVATIVE_ROUNDINGS = 4  # a partial derivative is a handful of operations


@functools.cache
def compiled(name, k):
    """The partial derivative of an operation by the arguments `k`, and the size that it is rounded from."""
    function, _, _, sizes = OPERATIONS[name]
    symbols = (A, B)
    for i in k:
        function = sympy.diff(function, symbols[i])
    size = sizes.get(k)
    number = lambda f: sympy.lambdify(symbols, f, "mpmath")
    return number(function), number(size) if size is not None else None


@functools.cache
def integer_power(n):
    return [sympy.lambdify(A, sympy.diff(A**n, A, k), "mpmath") for k in range(4)]


class Evaluation:
    """Evaluates trees at one point. Collects the largest and smallest numbers met, and how close
    decisions are."""

    def __init__(self, names, n, tables=(), order=2):
        self.names, self.n, self.tables, self.order = names, n, dict(tables), order
        self.memo, self.decisions, self.sizes = {}, [], []

    def jet(self, node):
        """The jet of a tree that is a number."""
        key = id(node)
        if key not in self.memo:
            jet = self.fresh(node)
            if self.order < 2:
                jet.hessian = {pair: ZERO for pair in pairs(self.n)}
            if self.order < 1:
                jet.gradient = [ZERO] * self.n
            self.sizes += [a.v for row in jet.orders() for a in row]
            self.memo[key] = (jet, node)
        return self.memo[key][0]

    def fresh(self, node):
        angle = half_angles(node) if "theta" in self.names else None
        if angle is not None:
            return self.trigonometric(node[1], angle)
        match node:
            case ("number", value):
                return Jet.constant(given(value), self.n)
            case ("name", "pi"):
                return Jet.constant(Number(mp.pi, (mp.pi, 0, 0)), self.n)
            case ("name", "e"):
                return Jet.constant(Number(mp.e, (mp.e, 0, 0)), self.n)
            case ("name", name):
                return self.names[name]
            case ("-", a):
                return self.jet(a).negative()
            case ("-", a, b):
                return self.apply("+", self.jet(a), self.jet(b).negative())
            case ("^", a, b):
                return self.power(self.jet(a), self.jet(b))
            case (operator, a, b) if operator in "+*/":
                return self.apply(operator, self.jet(a), self.jet(b))
            case ("call", name, arguments):
                return self.call(name, arguments)
        raise ValueError(f"no number: {node}")

    def call(self, name, arguments):
        if name == "if":
            return self.jet(arguments[1] if self.holds(arguments[0]) else arguments[2])
        if name == "side":
            return self.names[f"side({int(arguments[0][1])})"]
        if name == "table":
            return self.table(arguments[0][1], [0, 0], [self.jet(a) for a in arguments[1:]])
        if name == "dtable":
            n = (len(arguments) - 1) // 2
            orders = [int(value) for _, value in arguments[1 : 1 + n]] + [0]
            return self.table(arguments[0][1], orders, [self.jet(a) for a in arguments[1 + n :]])
        jets = [self.jet(a) for a in arguments]
        if name in ("min", "max"):
            return self.extremum(name, *jets)
        if name == "clamp":
            return self.extremum("min", self.extremum("max", jets[0], jets[1]), jets[2])
        if name == "abs":
            return jets[0] if self.rises(jets[0]) else jets[0].negative()
        if name in ("sign", "floor"):
            return self.step(name, jets[0])
        if name == "cbrt":
            return self.cube_root(jets[0])
        return self.apply(name, *jets)

    # decisions

    def decide(self, a, b):
        """The sign of a − b; how close that is."""
        gap, error = abs(a.v - b.v), [x + y for x, y in zip(a.errors, b.errors)]
        if any(error):
            self.decisions.append((gap, error))
        return (a.v > b.v) - (a.v < b.v)

    def rises(self, jet):
        """Whether a number is positive, or zero and its piece to the right, then above, is."""
        signs = (self.decide(a, ZERO) for a in [jet.v, *jet.gradient])
        return next((sign for sign in signs if sign), 1) > 0

    def extremum(self, name, a, b):
        difference = self.apply("+", a, b.negative())
        self.decide(a.v, b.v)
        return a if self.rises(difference) == (name == "max") else b

    def step(self, name, a):
        if name == "sign":
            return Jet.constant(Number(self.decide(a.v, ZERO)), self.n)
        floor = mpmath.floor(a.v.v)
        self.decide(a.v, Number(floor))
        self.decide(a.v, Number(floor + 1))
        return Jet.constant(Number(floor), self.n)

    def holds(self, node):
        match node:
            case ("not", a):
                return not self.holds(a)
            case ("and", a, b):
                return self.holds(a) & self.holds(b)
            case ("or", a, b):
                return self.holds(a) | self.holds(b)
            case (operator, a, b):
                sign = self.decide(self.jet(a).v, self.jet(b).v)
                accepted = {
                    "<": [-1],
                    "<=": [-1, 0],
                    ">": [1],
                    ">=": [0, 1],
                    "==": [0],
                    "!=": [-1, 1],
                }
                return sign in accepted[operator]

    # operations

    def apply(self, name, *arguments):
        """An operation of OPERATIONS on jets."""
        _, arithmetic, functions, _ = OPERATIONS[name]
        values = [a.v for a in arguments] + [ZERO] * (2 - len(arguments))
        numbers, places = [a.v for a in values], range(len(arguments))

        @functools.cache
        def partial(k):
            function, size = compiled(name, k)
            value = Number(function(*numbers))
            for i in places:
                if any(values[i].errors) and not (name == "pow" and numbers[0] == 0):
                    slope = abs(compiled(name, tuple(sorted((*k, i))))[0](*numbers))
                    more = (slope * e for e in values[i].errors)
                    value.errors = tuple(e + m for e, m in zip(value.errors, more))
            if not k:
                return value.rounded(arithmetic, functions)
            if name in ("+", "*"):
                return value
            return value.rounded(DERIVATIVE_ROUNDINGS, 1, size and abs(size(*numbers)))

        return self.chain(partial, arguments)

    def chain(self, partial, arguments):
        """The chain rule. `partial(k)` is the partial derivative by the arguments k."""
        places = range(len(arguments))

        def first(derivative):
            terms = [(i, derivative(arguments[i])) for i in places]
            return total(times(partial((i,)), d) for i, d in terms if not d.is_zero())

        def second(p, q):
            terms = [first(lambda a: a.hessian[p, q])]
            for i, j in itertools.product(places, places):
                product = times(arguments[i].gradient[p], arguments[j].gradient[q])
                if not product.is_zero():
                    terms.append(times(partial(tuple(sorted((i, j)))), product))
            return total(terms)

        gradient = (
            [first(lambda a: a.gradient[p]) for p in range(self.n)]
            if self.order
            else [ZERO] * self.n
        )
        hessian = {(p, q): second(p, q) if self.order > 1 else ZERO for p, q in pairs(self.n)}
        return Jet(partial(()), gradient, hessian)

    def power(self, a, b):
        """aⁿ is n − 1 products, √a a root, any other power a function."""
        constant = not b.v.errors[0] and all(d.is_zero() for d in b.gradient)
        if constant and b.v.v == 0.5:
            return self.apply("sqrt", a)
        if not constant or b.v.v != int(b.v.v) or abs(b.v.v) > 16:
            return self.apply("pow", a, b)
        n = int(b.v.v)
        functions = integer_power(n)

        def partial(k):
            k = len(k)
            errors = tuple(abs(functions[k + 1](a.v.v)) * e if e else mpf(0) for e in a.v.errors)
            return Number(functions[k](a.v.v), errors).rounded(max(abs(n), 1))

        return self.chain(partial, [a])

    def cube_root(self, a):
        if a.v.v < 0:
            return self.cube_root(a.negative()).negative()
        return self.apply("pow", a, Jet.constant(Number(mpf(1) / 3), self.n))

    def table(self, name, taken, arguments):
        """The derivatives of the orders `taken` of a table."""
        table = self.tables[name]
        values = [a.v for a in arguments]

        def partial(k):
            orders = [taken[i] + k.count(i) for i in range(len(arguments))]
            at = lambda more: table.value(
                [a.v for a in values], [o + m for o, m in zip(orders, more)]
            )
            result = Number(at([0, 0]))
            for i, a in enumerate(values):
                if any(a.errors):
                    slope = abs(at([int(i == j) for j in range(2)]))
                    result.errors = tuple(e + slope * x for e, x in zip(result.errors, a.errors))
            for a, nodes in zip(values, table.nodes):
                for node in (nodes[0], nodes[-1]):
                    self.decide(a, Number(mpf(node.numerator) / node.denominator))
            return result.rounded(1, 0, table.size(orders))

        return self.chain(partial, arguments)

    def trigonometric(self, name, angle):
        """sin or cos of n θ/2. From c = cos(θ/2) and s = sin(θ/2) it is a polynomial with a factor c, s or
        s·c where it vanishes at θ = ±π or 0: so its error is relative to that factor."""
        n = angle * 2
        theta = self.names["theta"]
        # θ itself is not used: no error of it
        bare = Jet(Number(theta.v.v), theta.gradient, theta.hessian)
        half = theta.v.v / 2
        c, s = abs(mpmath.cos(half)), abs(mpmath.sin(half))
        c, s = (v if v > SMALLEST else mpf(0) for v in (c, s))
        whole = n.denominator == 1
        odd = whole and n.numerator % 2 == 1
        sizes = {"sin": s if odd else s * c, "cos": c if odd else mpf(1)}
        factor = abs(mpf(n.numerator) / n.denominator)

        def partial(k):
            order = len(k)
            function = name if order % 2 == 0 else {"sin": "cos", "cos": "sin"}[name]
            sign = -1 if (order == 2 or (order == 1 and name == "cos")) else 1
            slope = (mpf(angle.numerator) / angle.denominator) ** order
            value = getattr(mpmath, function)(theta.v.v * angle.numerator / angle.denominator)
            value = sign * slope * (value if abs(value) > SMALLEST else 0)
            size = abs(slope) * max(factor, 1) * sizes[function]
            return Number(value).rounded(4, 0, size)

        return self.chain(partial, [bare])


def total(terms):
    return functools.reduce(plus, terms, ZERO)


def half_angles(node):
    """k if the node is sin or cos of k·theta with 2k an integer."""
    match node:
        case ("call", "sin" | "cos", [argument]):
            k = multiple(argument)
            return k if k is not None and (2 * k).denominator == 1 else None
    return None


def multiple(node):
    """k if the node is k·theta, with numbers as factors and divisors."""
    match node:
        case ("name", "theta"):
            return Fraction(1)
        case ("-", a):
            k = multiple(a)
            return None if k is None else -k
        case ("*", ("number", factor), a) | ("*", a, ("number", factor)):
            k = multiple(a)
            return None if k is None else k * Fraction(factor)
        case ("/", a, ("number", factor)):
            k = multiple(a)
            return None if k is None else k / Fraction(factor)
    return None
