"""Values and derivatives of cases by sympy and extended precision.

A meaning is a sympy expression, or a text in Python's notation with the names below; the derivatives
are sympy's own. It is evaluated with more and more digits until 45 of them no longer change.
"""

import functools
import itertools
import keyword
import re

import mpmath
import sympy
from mpmath import mp, mpf
from sympy import Piecewise, Rational

x, y, t = sympy.symbols("x y t", real=True)
r = sympy.sqrt(x**2 + y**2)
turns = sympy.Symbol("turns", real=True)
theta = sympy.atan2(y, x) + 2 * sympy.pi * turns


class Floor(sympy.Function):
    """The largest integer below; its derivative is 0."""

    def fdiff(self, argindex=1):
        return sympy.Integer(0)


class Sign(Floor):
    """−1, 0 or 1; its derivative is 0."""


class Spline(sympy.Function):
    """Spline(table, order in x, order in y, x[, y])."""

    def fdiff(self, argindex):
        table, m, n, *at = self.args
        return Spline(table, m + (argindex == 4), n + (argindex == 5), *at)


def number(text):
    """The double nearest to a decimal, as a fraction."""
    return Rational(*float(text).as_integer_ratio())


def cbrt(u):
    third = Rational(1, 3)
    return Piecewise((u**third, u >= 0), (-((-u) ** third), True))


def choose(condition, a, b):
    return Piecewise((a, condition), (b, True))


MEANINGS = {
    "sqrt": sympy.sqrt, "cbrt": cbrt, "exp": sympy.exp, "log": sympy.log,
    "log10": lambda u: sympy.log(u) / sympy.log(10),
    "sin": sympy.sin, "cos": sympy.cos, "tan": sympy.tan, "asin": sympy.asin, "acos": sympy.acos,
    "atan": sympy.atan, "atan2": sympy.atan2, "sinh": sympy.sinh, "cosh": sympy.cosh,
    "tanh": sympy.tanh, "hypot": lambda a, b: sympy.sqrt(a**2 + b**2),
    "abs": lambda u: choose(u >= 0, u, -u), "sign": Sign, "floor": Floor,
    "min": lambda a, b: choose(a < b, a, b), "max": lambda a, b: choose(a > b, a, b),
    "clamp": lambda u, low, high: MEANINGS["min"](MEANINGS["max"](u, low), high),
    "choose": choose, "Piecewise": Piecewise, "And": sympy.And, "Or": sympy.Or, "Not": sympy.Not,
    "Eq": sympy.Eq, "Ne": sympy.Ne, "pi": sympy.pi, "e": sympy.E, "number": number, "Rational": Rational,
    "x": x, "y": y, "t": t,
}  # fmt: skip
NUMBER = re.compile(r"(?<![\w.])(\d+\.?\d*|\.\d+)([eE][+-]?\d+)?")


def meaning(text, names):
    """A text in Python's notation (or that of formulas, where they agree) as an expression."""
    text = re.sub(r"\bif\(", "choose(", text).replace("^", "**")
    text = re.sub(r"[A-Za-z_]\w*", lambda found: python_name(found[0]), text)
    text = NUMBER.sub(lambda found: f"number('{found[0]}')", text)
    names = {python_name(name): value for name, value in names.items()}
    return sympy.sympify(eval(text, {"__builtins__": {}}, MEANINGS | names))


def python_name(name):
    """`lambda` and `yield` are names in formulas."""
    return name + "_" if keyword.iskeyword(name) and name.islower() else name


@functools.cache
def derivatives(expression, variables):
    """The expression, its gradient, its Hessian (i ≤ j)."""
    first = [sympy.diff(expression, v) for v in variables]
    pairs = itertools.combinations_with_replacement(range(len(variables)), 2)
    return [[expression], first, [sympy.diff(first[i], variables[j]) for i, j in pairs]]


def spline(tables):
    def evaluate(table, m, n, *at):
        return tables[str(table)].value([mpf(a) for a in at], [int(m), int(n)])

    return evaluate


def compiled(expression, symbols, tables):
    """A function of numbers."""
    own = {
        "Floor": mpmath.floor, "Sign": mpmath.sign, "Spline": spline(tables),
        # of |u|, away from u = 0
        "DiracDelta": lambda *_: mpf(0),
    }  # fmt: skip
    own |= {name: name for name in tables}
    return sympy.lambdify(symbols, expression, [own, "mpmath"])


def settled(function, values):
    """The value of a function with 45 digits, or 0 if it vanishes to 300 of them."""
    digits, before = 60, None
    while digits < 4000:
        with mp.workdps(digits):
            now = mpmath.mpmathify(function(*[mpf(v) for v in values]))
            assert not isinstance(now, mpmath.mpc) or now.imag == 0, "not real"
            now = mpf(now.real)
            if now and before is not None and abs(now - before) <= mpf(10) ** -45 * abs(now):
                return now
            if digits > 600 and abs(now) < mpf(10) ** -500:
                return mpf(0)
        digits, before = 2 * digits, now
    raise ArithmeticError(f"does not settle: {before}, {now}")
