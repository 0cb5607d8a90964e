"""Trigonometric functions of multiples of θ/2: nothing is lost near θ = ±π, on either side."""

from cases import frame

# all around, then close to the negative axis from both sides, and on it
AROUND = [(0.75, 1.0), (-1.25, 0.5), (-0.5, -2.0), (1.5, -0.25)]
BEHIND = [(-1.0, 1e-12), (-2.0, -3e-13), (-0.5, 1e-100)]
AHEAD = [(1.0, 1e-12), (3.0, -1e-30), (2.0, 0.0)]
CUT = [(-1.0, 0.0)]

CASES = [
    *frame("cos(theta/2)", *AROUND, *BEHIND, *AHEAD, *CUT),
    *frame("sin(theta/2)", *AROUND, *BEHIND, *AHEAD, *CUT),
    *frame("cos(theta/2)", *CUT, turns=-1),
    *frame("sin(theta/2)", *CUT, turns=-1),
    *frame("sin(theta)", AROUND[1], *BEHIND, *AHEAD, *CUT),
    *frame("cos(theta)", AROUND[1], *BEHIND, *AHEAD, *CUT),
    *frame("sin(3*theta/2)", AROUND[2], *BEHIND, *AHEAD[:2], *CUT),
    *frame("cos(3*theta/2)", AROUND[2], *BEHIND, *AHEAD[:2], *CUT),
    *frame("cos(1.5*theta)", AROUND[0], *BEHIND[:1]),
    *frame("sin(0.5*theta)", AROUND[0], *BEHIND[:1]),
    *frame("sin(theta*0.5)", AROUND[3], *BEHIND[:1]),
    *frame("cos(-theta/2)", AROUND[3], *BEHIND[:1]),
    *frame("sin(-5*theta/2)", AROUND[1], *BEHIND[:2]),
    *frame("cos(5*theta/2)", AROUND[1], *BEHIND[:2]),
    *frame("sin(2*theta)", AROUND[0], *BEHIND[:2]),
    *frame("cos(2*theta)", AROUND[0], *BEHIND[:2]),
    *frame("sin(7*theta/2)", AROUND[3], *BEHIND[:1]),
    *frame("cos(4*theta)", AROUND[3], *BEHIND[:1]),
    *frame(
        "let h = theta/2; sin(h)*cos(3*h)",
        AROUND[1],
        *BEHIND,
        meaning="sin(theta/2)*cos(3*theta/2)",
    ),
    *frame("sin(theta)*sin(theta/2)", AROUND[0], *BEHIND, *AHEAD[:1]),
    *frame("cos(theta/2)*(1 - sin(theta/2)*sin(3*theta/2))", AROUND[0], *BEHIND),
    *frame("sin(theta/2)^2 + cos(theta/2)^2", AROUND[2], BEHIND[0]),
    *frame("tan(theta/2)", AROUND[1], AHEAD[0]),
    # another branch: behind a kinked crack
    *frame("cos(theta/2)", AROUND[1], (-0.5, 0.25), turns=-1),
    *frame("sin(theta/2)*x", AROUND[1], (-0.5, 0.25), turns=-1),
    *frame("sin(3*theta/2)", AROUND[2], turns=1),
    # many turns, and tangents
    *frame("cos(8*theta)", AROUND[1], *BEHIND[:1]),
    *frame("sin(21*theta/2)", AROUND[0], *BEHIND[:1]),
    *frame("cos(32*theta)*sin(-31.5*theta)", AROUND[3]),
    *frame("tan(theta)*tan(theta/2)", AROUND[0], AHEAD[0]),
    # sides of cracks
    *frame("side(0)*r^2*cos(2*theta)", AROUND[1], sides={0: 1}),
    *frame("side(0)*side(1)*x*y + side(1)", AROUND[2], sides={0: 1, 1: -1}),
    *frame("if(side(0) > 0, x^2, y^2)", AROUND[2], sides={0: -1}, meaning="y^2"),
    # plain angles
    *frame("theta", *AROUND, BEHIND[0], AHEAD[0], *CUT),
    *frame("theta", *CUT, turns=-1),
    *frame("theta", AROUND[2], turns=1),
    *frame("r*theta^2", *AROUND[:2]),
    *frame("theta*(pi - theta)*(pi + theta)", AROUND[0], AROUND[2]),
    *frame("sin(0.7*theta)", *AROUND[:3]),
    *frame("sin(theta/2 + 0.25)", *AROUND[:2]),
    *frame("cos(2*theta/3)", *AROUND[1:3]),
    *frame("exp(-theta^2)", *AROUND[:2]),
]
