"""Tables of numbers and the C² splines through them, in exact arithmetic.

A table of one variable is interpolated by the cubic spline with the not-a-knot condition: the third
derivative is continuous at the second and at the last but one node (de Boor, A Practical Guide to
Splines, 2001, chapter IV). With three nodes that is their parabola, with two their line. A table of
two variables is interpolated by the tensor product of these splines. Outside the range of a variable
the spline continues constantly in it; on the ends of the range its derivatives are those of the inside.
"""

from bisect import bisect_right
from fractions import Fraction

from mpmath import mpf


def solve(matrix, right):
    """Gauss' elimination with fractions; `right` has one row of right-hand sides an equation."""
    rows = [list(map(Fraction, row)) + list(map(Fraction, r)) for row, r in zip(matrix, right)]
    for i in range(len(rows)):
        pivot = next(k for k in range(i, len(rows)) if rows[k][i])
        rows[i], rows[pivot] = rows[pivot], rows[i]
        rows[i] = [v / rows[i][i] for v in rows[i]]
        for k in range(len(rows)):
            if k != i and rows[k][i]:
                rows[k] = [v - rows[k][i] * w for v, w in zip(rows[k], rows[i])]
    return [row[len(matrix) :] for row in rows]


def pieces(nodes, values):
    """For each interval the coefficients of (x − left node)^0 … ^3, found from all conditions at once:
    values at both ends, continuous first and second derivatives, third derivatives at the two ends."""
    n = len(nodes) - 1
    if n < 3:
        return [shifted(polynomial(nodes, values), node) for node in nodes[:-1]]
    h = [b - a for a, b in zip(nodes, nodes[1:])]
    matrix, right = [], []

    def equation(entries, value):
        row = [Fraction(0)] * (4 * n)
        for i, k, entry in entries:
            row[4 * i + k] += entry
        matrix.append(row)
        right.append([value])

    for i in range(n):
        equation([(i, 0, 1)], values[i])
        equation([(i, k, h[i] ** k) for k in range(4)], values[i + 1])
    for i in range(n - 1):
        equation([(i, 1, 1), (i, 2, 2 * h[i]), (i, 3, 3 * h[i] ** 2), (i + 1, 1, -1)], 0)
        equation([(i, 2, 1), (i, 3, 3 * h[i]), (i + 1, 2, -1)], 0)
    equation([(0, 3, 1), (1, 3, -1)], 0)
    equation([(n - 2, 3, 1), (n - 1, 3, -1)], 0)
    found = [row[0] for row in solve(matrix, right)]
    return [found[4 * i : 4 * i + 4] for i in range(n)]


def polynomial(nodes, values):
    """Coefficients of x^0 … of the polynomial through all nodes."""
    powers = [[node**k for k in range(len(nodes))] for node in nodes]
    return [row[0] for row in solve(powers, [[v] for v in values])]


def shifted(coefficients, x):
    """Coefficients of (· − x)^0 … ^3 of a polynomial of degree 2 or less."""
    c = [*coefficients, 0, 0, 0, 0][:4]
    return [c[0] + x * (c[1] + x * c[2]), c[1] + 2 * x * c[2], c[2], Fraction(0)]


class Cardinal:
    """The splines that are 1 at one node and 0 at the others."""

    def __init__(self, nodes):
        self.nodes = nodes
        unit = lambda j: [Fraction(int(i == j)) for i in range(len(nodes))]
        self.pieces = [pieces(nodes, unit(j)) for j in range(len(nodes))]

    def values(self, x, order):
        """All of them, or their derivatives, at one place."""
        if order > 3:
            return [mpf(0)] * len(self.nodes)
        nodes = [fraction(node) for node in self.nodes]
        if not nodes[0] <= x <= nodes[-1]:
            end = 0 if x < nodes[0] else len(nodes) - 1
            return [mpf(int(i == end and order == 0)) for i in range(len(self.nodes))]
        i = min(bisect_right(nodes, x), len(nodes) - 1) - 1
        s = x - nodes[i]
        falling = lambda k: [1, k, k * (k - 1), k * (k - 1) * (k - 2)][order]
        terms = lambda c: (falling(k) * fraction(c[k]) * s ** (k - order) for k in range(order, 4))
        return [sum(terms(piece[i]), mpf(0)) for piece in self.pieces]


def fraction(v):
    return mpf(v.numerator) / v.denominator


class Table:
    """A table of one variable (one list of nodes, a list of values) or of two (rows of values, one a
    node of y)."""

    # rounding of a spline's derivatives of order 0, 1, 2, 3 in units of |values|/h^order: the second
    # derivatives solve a system with right-hand sides 6 Δ(Δv/h)/h whose inverse is below 1/2
    ROUNDINGS = (8, 12, 32, 64, 0, 0)

    def __init__(self, name, *nodes, values):
        self.name, self.given, self.values = name, nodes, values
        self.nodes = [[Fraction(v) for v in row] for row in nodes]
        self.cardinals = [Cardinal(row) for row in self.nodes]

    def value(self, x, orders=(0, 0)):
        """The spline, or its partial derivatives, at a place."""
        weights = [c.values(a, o) for c, a, o in zip(self.cardinals, x, orders)]
        rows = self.values if len(x) == 2 else [self.values]
        across = [sum((w * mpf(v) for w, v in zip(weights[0], row)), mpf(0)) for row in rows]
        if len(x) == 1:
            return across[0]
        return sum((w * v for w, v in zip(weights[1], across)), mpf(0))

    def size(self, orders):
        """What the rounding of a derivative is relative to, roundings included."""
        rows = self.values if len(self.nodes) == 2 else [self.values]
        size = mpf(max(abs(v) for row in rows for v in row))
        for row, order in zip(self.nodes, orders):
            step = min(b - a for a, b in zip(row, row[1:]))
            size *= self.ROUNDINGS[order] / fraction(step) ** order
        return size

    def text(self):
        """The table as a record of tables.txt."""
        numbers = lambda row: " ".join(map(repr, map(float, row)))
        lines = [f"table: {self.name}", f"x: {numbers(self.given[0])}"]
        if len(self.given) == 2:
            lines += [f"y: {numbers(self.given[1])}"]
            lines += [f"values: {numbers(row)}" for row in self.values]
        else:
            lines.append(f"values: {numbers(self.values)}")
        return "\n".join(lines) + "\n"
