"""Weight functions of the partition of unity, in t = |ξ|, and bumps."""

from cases import line, plane

QUADRATIC = "if(t < 1/3, 1 - 3*t^2, if(t < 1, 1.5*(1 - t)^2, 0))"
QUADRATIC_MEANING = (
    "Piecewise((1 - 3*t**2, t < Rational(1, 3)), (Rational(3, 2)*(1 - t)**2, t < 1), (0, True))"
)
CUBIC = "if(t < 0.5, 1 - 6*t^2 + 6*t^3, if(t < 1, 2*(1 - t)^3, 0))"
CUBIC_MEANING = (
    "Piecewise((1 - 6*t**2 + 6*t**3, t < Rational(1, 2)), (2*(1 - t)**3, t < 1), (0, True))"
)
BUMP = "if(t < 1, exp(1 - 1/(1 - t^2)), 0)"
BUMP_MEANING = "choose(t < 1, exp(1 - 1/(1 - t**2)), 0)"
U = "2*t - 0.5"

CASES = [
    *line("max(1 - t, 0)", 0, 0.25, 0.9375, 2, meaning="choose(t < 1, 1 - t, 0)"),
    *line(QUADRATIC, 0, 0.25, 0.375, 0.75, 1, 3, meaning=QUADRATIC_MEANING),
    *line(CUBIC, 0, 0.25, 0.5, 0.75, 1, 3, meaning=CUBIC_MEANING),
    *line(BUMP, 0, 0.25, 0.75, 0.9375, 1, 2, meaning=BUMP_MEANING),
    *line("max(1 - t^2, 0)^4", 0, 0.5, 0.875, 1.5, meaning="choose(t < 1, (1 - t**2)**4, 0)"),
    *line(
        "max(1 - t^2, 0)^2.5",
        0,
        0.5,
        0.875,
        1.5,
        meaning="choose(t < 1, (1 - t**2)**Rational(5, 2), 0)",
    ),
    *line(
        "if(t < 1, (1 - t)^4*(1 + 4*t), 0)",
        0,
        0.5,
        1,
        meaning="choose(t < 1, (1 - t)**4*(1 + 4*t), 0)",
    ),
    *line(
        "(1 + cos(pi*min(t, 1)))/2", 0, 0.25, 0.75, 2, meaning="choose(t < 1, (1 + cos(pi*t))/2, 0)"
    ),
    *line(
        "max(1 - t, 0)^3 - 4*max(0.5 - t, 0)^3",
        0.25,
        0.75,
        meaning="choose(t < Rational(1, 2), (1 - t)**3 - 4*(Rational(1, 2) - t)**3, (1 - t)**3)",
    ),
    *line(
        "let u = clamp((t - 0.25)/0.5, 0, 1); 1 - u^3*(10 - 15*u + 6*u^2)",
        0,
        0.375,
        0.5,
        0.8125,
        meaning=f"Piecewise((1, t < 0.25), (1 - ({U})**3*(10 - 15*({U}) + 6*({U})**2), t < 0.75), (0, True))",
    ),
    *plane("max(1 - abs(x), 0)*max(1 - abs(y), 0)", (0.25, -0.5), (-0.75, 0.125), (2, 0.5)),
    *plane(
        "let q = x^2 + y^2; if(q < 1, exp(-1/(1 - q)), 0)",
        (0.25, -0.5),
        (0.75, 0.5),
        (0.75, 0.75),
        meaning="choose(x**2 + y**2 < 1, exp(-1/(1 - x**2 - y**2)), 0)",
    ),
]
