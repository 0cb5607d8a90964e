"""The Westergaard functions and the leading field of a crack tip, all around it and close to it."""

from cases import frame, special

POINTS = [
    (0.75, 1.0), (-1.25, -0.5), (-1.0, 1e-12), (-0.25, -1e-13), (3e-12, -4e-12), (-6e-150, 8e-150),
    (-1.0, 0.0),
]  # fmt: skip
FUNCTIONS = [
    "sqrt(r)*cos(theta/2)", "sqrt(r)*sin(theta/2)", "sqrt(r)*sin(theta)*sin(theta/2)",
    "sqrt(r)*sin(theta)*cos(theta/2)",
]  # fmt: skip
CRACK = dict(mu=0.375, kappa=1.75, k1=1.25, k2=-0.5)

# displacements of both modes, u 2μ √(2π) = …
UX = (
    "sqrt(r/(2*pi))/(2*mu)*(k1*cos(theta/2)*(kappa - 1 + 2*sin(theta/2)^2)"
    " + k2*sin(theta/2)*(kappa + 1 + 2*cos(theta/2)^2))"
)
UY = (
    "sqrt(r/(2*pi))/(2*mu)*(k1*sin(theta/2)*(kappa + 1 - 2*cos(theta/2)^2)"
    " - k2*cos(theta/2)*(kappa - 1 - 2*sin(theta/2)^2))"
)
# stresses of mode I
SXX = "k1/sqrt(2*pi*r)*cos(theta/2)*(1 - sin(theta/2)*sin(3*theta/2))"
SYY = "k1/sqrt(2*pi*r)*cos(theta/2)*(1 + sin(theta/2)*sin(3*theta/2))"
SXY = "k1/sqrt(2*pi*r)*sin(theta/2)*cos(theta/2)*cos(3*theta/2)"
TIP = (0.0, 0.0, 0.0, 0.0, 1.0, 0.0)

CASES = [
    *(case for text in FUNCTIONS for case in frame(text, *POINTS)),
    *frame(FUNCTIONS[0], (-1.0, 0.0), turns=-1),
    *frame(FUNCTIONS[1], (-1.0, 0.0), turns=-1),
    *frame(FUNCTIONS[2], (-0.5, 0.25), turns=-1),
    *frame(FUNCTIONS[3], (-0.5, -0.25), turns=1),
    *(case for text in (UX, UY) for case in frame(text, *POINTS[:4], POINTS[5], **CRACK)),
    *(case for text in (SXX, SXY) for case in frame(text, *POINTS[:3], POINTS[4], k1=1.25)),
    # 1 + sin(θ/2) sin(3θ/2) cancels behind the tip
    *frame(SYY, *POINTS[:2], (-1.0, 0.0625), POINTS[4], k1=1.25),
    *(case for text in FUNCTIONS for case in special("polar", text, TIP, "0")),
]
