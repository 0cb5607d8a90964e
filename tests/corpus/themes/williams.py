"""Williams' series: r^{n/2} times trigonometric functions of θ, and corner functions r^λ."""

from cases import frame

POINTS = [(0.75, 1.0), (-1.25, -0.5), (-1.0, 1e-12), (-3e-9, 4e-9)]
SHORT = [POINTS[1], POINTS[2]]


def potential(n):
    """Harmonic functions with a free or a fixed crack."""
    return f"r^({n}/2)*{'sin' if n % 2 else 'cos'}({n}*theta/2)"


def mode(n, kind, component):
    """The displacement of order n of mode I or II (Williams 1957), mode II up to its sign."""
    sign, other = "+-" if component == "x" else "-+"
    parity = sign if kind == 1 else other
    function = "cos" if (component == "x") == (kind == 1) else "sin"
    constant = f"(kappa {sign} {n}/2 {parity} (-1)^{n})"
    second = f"{n}/2*{function}(({n} - 4)*theta/2)"
    return f"r^({n}/2)/(2*mu)*({constant}*{function}({n}*theta/2) {other} {second})"


MATERIAL = dict(kappa=1.8, mu=0.375)
# a corner with the angle ω of material: λ = π/ω
CORNER = "r^lambda*sin(lambda*theta)"

CASES = [
    *(case for n in (1, 2, 3, 4, 5, 7) for case in frame(potential(n), *POINTS)),
    *(
        case
        for n in (1, 2, 3, 4, 5)
        for c in "xy"
        for case in frame(mode(n, 1, c), *SHORT, **MATERIAL)
    ),
    *(
        case
        for n in (1, 2, 3, 4, 5)
        for c in "xy"
        for case in frame(mode(n, 2, c), SHORT[0], **MATERIAL)
    ),
    *frame("sqrt(r)^3*cos(3*theta/2)", *POINTS),
    *frame("r*sqrt(r)*sin(3*theta/2)", *POINTS),
    *frame("r^1.5*sin(theta)*cos(theta/2)", *POINTS[:3]),
    *frame(CORNER, POINTS[0], (0.5, -2.0), POINTS[3], **{"lambda": 2 / 3}),
    *frame(CORNER, POINTS[0], POINTS[1], **{"lambda": 0.5444837367824622}),
    *frame("r^(2/3)*sin(2*theta/3)", POINTS[0], (0.5, -2.0), POINTS[3]),
    *frame("r^lambda*cos(lambda*(theta - pi/4))", *POINTS[:2], **{"lambda": 0.75}),
    *frame("log(r)", *POINTS[:2], POINTS[3], (-3e-100, 4e-100)),
    *frame("r^0.3*log(r)*cos(theta)", POINTS[0], POINTS[3]),
    *frame("exp(-r^2)*cos(2*theta)", *POINTS[:3]),
    *frame("(1 - r^2/4)^6", POINTS[0], POINTS[1]),
]
