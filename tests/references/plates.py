"""Stress intensity factors of plates with one straight crack, by complex potentials.

    python plates.py              prints the table of README.md; needs numpy

The method shares nothing with `ppum`. In the frame of the crack, which lies on the real axis with free faces, Muskhelishvili's
potentials are (1953, chapter 18)

    Φ = P/s + Q,   Ω = P/s − Q,   P and Q polynomials,   s = √(z² − a²), or √(z − a) for an edge crack,

    σ_yy − i σ_xy = Φ(z) + Ω(z̄) + (z − z̄) Φ′(z)*,     σ_xx + σ_yy = 4 Re Φ.

They satisfy all equations and leave the faces free. The coefficients follow from the tractions on the border by least
squares, with the polynomials made orthogonal on the border (Vandermonde with Arnoldi). For an edge crack, P and Q also
have poles that cluster outside of the mouth, whose corners have weak singularities. Around an inner crack displacements
return if ∫ P/√(a² − x²) dx over the crack vanishes. K_I − i K_II = 2 P(a) √(π/a), for an edge crack 2 P(a) √(2π).
"""

import numpy as np


def arnoldi(z, degree):
    """Polynomials up to a degree, orthonormal on the points z: their values there, and their recurrence."""
    basis, recurrence = np.ones((len(z), 1), complex), np.zeros((degree + 1, degree), complex)
    for k in range(degree):
        new = z * basis[:, k]
        for _ in range(2):
            share = basis.conj().T @ new / len(z)
            recurrence[: k + 1, k] += share
            new = new - basis @ share
        recurrence[k + 1, k] = np.linalg.norm(new) / np.sqrt(len(z))
        basis = np.hstack([basis, (new / recurrence[k + 1, k])[:, None]])
    return recurrence


def functions(z, recurrence, poles):
    """Values and derivatives of the polynomials, and of (−p)/(z − p) for poles p, at points."""
    degree = recurrence.shape[1]
    value, slope = np.ones((len(z), degree + 1), complex), np.zeros((len(z), degree + 1), complex)
    for k in range(degree):
        share, norm = recurrence[: k + 1, k], recurrence[k + 1, k]
        value[:, k + 1] = (z * value[:, k] - value[:, : k + 1] @ share) / norm
        slope[:, k + 1] = (value[:, k] + z * slope[:, k] - slope[:, : k + 1] @ share) / norm
    simple = -poles / (z[:, None] - poles)
    return np.hstack([value, simple]), np.hstack([slope, -simple / (z[:, None] - poles)])


def potentials(z, recurrence, poles, a):
    """Φ, Φ′ and Ω at points, for each coefficient: first those of P, then those of Q."""
    value, slope = functions(z, recurrence, poles)
    edge = len(poles) > 0
    s = np.sqrt(z - a) if edge else np.sqrt(z - a) * np.sqrt(z + a)
    ds = 0.5 / s if edge else z / s
    p, dp = value / s[:, None], (slope - value * (ds / s)[:, None]) / s[:, None]
    return np.hstack([p, value]), np.hstack([dp, slope]), np.hstack([p, -value])


def border(corners, count):
    """Points of the border, denser at corners, with normals and the number of the side."""
    t = (1 - np.cos(np.pi * (np.arange(count) + 0.5) / count)) / 2
    sides = list(zip(corners, corners[1:] + corners[:1], strict=True))
    points = np.concatenate([start + (end - start) * t for start, end in sides])
    normals = np.repeat([-1j * (end - start) / abs(end - start) for start, end in sides], count)
    return points, normals, np.repeat(np.arange(len(sides)), count)


def factors(a, corners, tractions, angle=0.0, degree=128, poles=()):
    """K_I and K_II at the tip at the end of the crack.

    `corners` are counterclockwise from the lower left one, as complex numbers, for a crack from −a to a, or, with poles,
    from 0 to a; `tractions` are t_x + i t_y on bottom, right, top, left. The crack has an angle to the x axis.
    """
    poles = np.array(poles, complex)
    turn = np.exp(-1j * angle)
    x, normal, side = border(corners, 4 * degree)
    z, normal = x * turn, normal * turn
    wanted = np.array(tractions)[side] * turn
    recurrence = arnoldi(np.concatenate([z, z.conj()]), degree)
    phi, slope, _ = potentials(z, recurrence, poles, a)
    omega = potentials(z.conj(), recurrence, poles, a)[2]

    def traction(unit):
        across = unit * (phi + omega) + 2j * z.imag[:, None] * (unit * slope).conj()
        syy, sxy = across.real, -across.imag
        sxx = 4 * (unit * phi).real - syy
        n = normal[:, None]
        return np.vstack([sxx * n.real + sxy * n.imag, sxy * n.real + syy * n.imag])

    matrix, right = np.hstack([traction(1), traction(1j)]), np.concatenate([wanted.real, wanted.imag])
    if not len(poles):
        nodes = a * np.cos(np.pi * (np.arange(2 * degree) + 0.5) / (2 * degree))
        mean = functions(nodes.astype(complex), recurrence, poles)[0].mean(axis=0)
        closed = np.concatenate([mean, np.zeros(degree + 1)])
        rows = 1e3 * np.array([np.concatenate([closed.real, -closed.imag]), np.concatenate([closed.imag, closed.real])])
        matrix, right = np.vstack([matrix, rows]), np.concatenate([right, [0, 0]])
    half = matrix.shape[1] // 2
    matrix[:, half + half // 2] = 0  # a rotation, which has no tractions
    scale = np.linalg.norm(matrix, axis=0)
    scale[scale == 0] = 1
    solution = np.linalg.lstsq(matrix / scale, right, rcond=1e-14)[0] / scale
    count = degree + 1 + len(poles)
    coefficients = (solution[:half] + 1j * solution[half:])[:count]
    tip = functions(np.array([a + 0j]), recurrence, poles)[0][0] @ coefficients
    k = 2 * tip * np.sqrt(2 * np.pi if len(poles) else np.pi / a)
    return k.real, -k.imag


PULL = (-1j, 0, 1j, 0, 0)


def centre(a, h, angle=0.0, degree=128):
    """F_I and F_II of a centre crack in a plate −1 … 1, −h … h, pulled at both ends."""
    corners = [-1 - 1j * h, 1 - 1j * h, 1 + 1j * h, -1 + 1j * h]
    return [k / np.sqrt(np.pi * a) for k in factors(a, corners, PULL, angle, degree)]


def edge(a, h, degree=128):
    """F_I and F_II of an edge crack in a plate 0 … 1, −h … h, pulled at both ends, which may rotate."""
    corners = [-1j * h, 1 - 1j * h, 1 + 1j * h, 1j * h, 0]
    poles = -np.exp(1.2 * (np.sqrt(np.arange(1, 13)) - np.sqrt(12)))
    return [k / np.sqrt(np.pi * a) for k in factors(a, corners, PULL, 0.0, degree, poles)]


def digits(compute):
    """The value at degree 128, and its largest difference from those of 96 and 112."""
    values = [np.array(compute(degree)) for degree in (96, 112, 128)]
    return values[-1], max(abs(value - values[-1]).max() for value in values[:-1])


ROWS = (
    [(f"centre crack, a/W = {a}, H/W = {h}", lambda n, a=a, h=h: centre(a, h, 0.0, n)) for a in (0.3, 0.5, 0.7) for h in (0.5, 1, 2, 3)]
    + [(f"edge crack, a/W = {a}, H/W = {h}", lambda n, a=a, h=h: edge(a, h, n)) for a in (0.3, 0.5) for h in (0.5, 1, 1.5)]
    + [(f"slanted crack, {t}°", lambda n, t=t: centre(0.5, 2, np.radians(t), n)) for t in (15, 45)]
)

if __name__ == "__main__":
    for name, compute in ROWS:
        (first, second), change = digits(compute)
        print(f"| {name} | {first:.9f} | {second:.9f} | {change:.0e} |")
