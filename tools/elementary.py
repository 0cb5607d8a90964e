"""Finds the polynomials of crates/ppum-formula/src/elementary: python tools/elementary.py (needs mpmath).

Each is the best approximation of a function on an interval [0, b] in the sense of w |p − f|, w being what the
polynomial is multiplied with where it is used (Remez's exchange of extremes, 50 digits). Printed are the
coefficients, constant first, as the doubles nearest to them, and the error that these have.
"""

from mpmath import asin, atan, cbrt, cos, cosh, log, lu_solve, matrix, mp, mpf, pi, polyval, sign, sin, sinh, sqrt

mp.dps = 50
POINTS = 600
ROUNDS = 6


def grid(a, b, n):
    """n + 1 places, dense at both ends."""
    return [a + (b - a) * (1 - cos(pi * k / mpf(n))) / 2 for k in range(n + 1)]


def leveled(f, w, places):
    """The polynomial whose weighted errors at the places are of one size, with signs in turn."""
    n = len(places) - 1
    system, right = matrix(n + 1, n + 1), matrix(n + 1, 1)
    for i, z in enumerate(places):
        for j in range(n):
            system[i, j] = z**j
        system[i, n], right[i] = (-1) ** i / w(z), f(z)
    return list(lu_solve(system, right))[:n]


def extremes(errors, count):
    """The places of the largest errors between changes of sign."""
    found = []
    for k, error in enumerate(errors):
        if found and sign(error) == sign(errors[found[-1]]):
            if abs(error) > abs(errors[found[-1]]):
                found[-1] = k
        else:
            found.append(k)
    while len(found) > count:
        found.pop(0 if abs(errors[found[0]]) < abs(errors[found[-1]]) else -1)
    return found


def best(f, w, a, b, n):
    places, dense = grid(a, b, n), grid(a, b, POINTS)
    exact, weights = [f(z) for z in dense], [w(z) for z in dense]
    for _ in range(ROUNDS):
        p = leveled(f, w, places)
        errors = [u * (polyval(p[::-1], z) - v) for u, z, v in zip(weights, dense, exact)]
        places = [dense[k] for k in extremes(errors, n + 1)]
        if len(places) <= n:
            break
    return p


def artanh(s):
    return log((1 + s) / (1 - s)) / 2


HALF_LN_2, QUARTER = mpf("0.3466"), mpf("0.7855")
LOG, EIGHTH = mpf("0.17158"), mpf("0.41422")
POLYNOMIALS = {
    "SINH": (lambda z: (sinh(sqrt(z)) / sqrt(z) - 1) / z, lambda z: z, 0, HALF_LN_2**2, 5),
    "COSH": (lambda z: (cosh(sqrt(z)) - 1 - z / 2) / z**2, lambda z: z**2, 0, HALF_LN_2**2, 5),
    "SIN": (lambda z: (sin(sqrt(z)) / sqrt(z) - 1) / z, lambda z: z, 0, QUARTER**2, 6),
    "COS": (lambda z: (cos(sqrt(z)) - 1 + z / 2) / z**2, lambda z: z**2, 0, QUARTER**2, 6),
    "LOG": (lambda z: (2 * artanh(sqrt(z)) / sqrt(z) - 2) / z, lambda z: z, 0, LOG**2, 7),
    "ARTANH": (lambda z: (artanh(sqrt(z)) / sqrt(z) - 1 - z / 3) / z**2, lambda z: z**2, 0, LOG**2, 7),
    "ARCTAN": (lambda z: (atan(sqrt(z)) / sqrt(z) - 1) / z, lambda z: z, 0, EIGHTH**2, 11),
    "ARCSIN": (lambda z: (asin(sqrt(z)) / sqrt(z) - 1) / z, lambda z: z, 0, mpf("0.25"), 13),
    "ROUGH": (cbrt, lambda z: 1 / cbrt(z), 1, 2, 5),
}

for name, (f, w, a, b, n) in POLYNOMIALS.items():
    a, b = mpf(a), mpf(b)
    start = a + (b - a) / 10**6
    doubles = [float(c) for c in best(f, w, start, b, n)]
    places = [start + (b - start) * k / POINTS for k in range(POINTS + 1)]
    error = max(w(z) * abs(polyval([mpf(c) for c in doubles[::-1]], z) - f(z)) for z in places)
    print(f"{name}: 2^{float(log(error, 2)):.1f}\n    " + ",\n    ".join(map(repr, doubles)))
