"""Quantities as formulas: named inputs, stresses, strains, displacements."""

from cases import named

STRESS = "sxx syy sxy szz"
S = [(1.5, -0.75, 0.5, 0.25), (210.0, 205.0, -3.0, 120.0), (-1e-3, 2e-3, 5e-4, 3e-4)]
PLANE = [(1.5, -0.75, 0.5), (210.0, 205.0, -3.0), (-1e-3, 2e-3, 5e-4)]
GRADIENT = "dux_dx dux_dy duy_dx duy_dy"
G = [(1e-3, -2e-3, 5e-4, 3e-4), (0.25, 0.5, -0.75, 1.0)]
STEEL = dict(young=210000, poisson=0.3)
TRESCA = (
    "let m = (sxx + syy)/2; let d = hypot((sxx - syy)/2, sxy);"
    " max(2*d, max(abs(m + d - szz), abs(m - d - szz)))"
)

CASES = [
    *named("ux uy", "sqrt(ux^2 + uy^2)", (3, 4), (-0.125, 1e-3)),
    *named("ux uy", "hypot(ux, uy)", (3, 4), (-0.125, 1e-3)),
    *named("ux uy", "atan2(uy, ux)", (3, 4), (-0.125, 1e-3)),
    *named(STRESS, "sqrt(((sxx - syy)^2 + (syy - szz)^2 + (szz - sxx)^2)/2 + 3*sxy^2)", *S),
    *named(STRESS, "(sxx + syy + szz)/3", *S[:2]),
    *named("sxx syy sxy", "(sxx + syy)/2 + hypot((sxx - syy)/2, sxy)", *PLANE),
    *named("sxx syy sxy", "(sxx + syy)/2 - hypot((sxx - syy)/2, sxy)", *PLANE[:2]),
    *named("sxx syy sxy", "atan2(2*sxy, sxx - syy)/2", *PLANE),
    # at the first the in-plane difference is the largest, at the second that of s1 and szz
    *named(STRESS, TRESCA, S[0], meaning="2*sqrt(((sxx - syy)/2)**2 + sxy**2)"),
    *named(STRESS, TRESCA, S[1], meaning="(sxx + syy)/2 + sqrt(((sxx - syy)/2)**2 + sxy**2) - szz"),
    *named(GRADIENT, "(dux_dy + duy_dx)/2", *G),
    *named(GRADIENT, "duy_dx - dux_dy", *G),
    *named(GRADIENT, "dux_dx + duy_dy", *G),
    *named(GRADIENT, "sqrt(dux_dx^2 + dux_dy^2 + duy_dx^2 + duy_dy^2)", *G),
    *named(GRADIENT, "(1 + dux_dx)*(1 + duy_dy) - dux_dy*duy_dx", *G),
    *named(GRADIENT, "dux_dx + (dux_dx^2 + duy_dx^2)/2", *G),
    *named(
        GRADIENT,
        "let l = young*poisson/((1 + poisson)*(1 - 2*poisson)); let m = young/(2 + 2*poisson); l*(dux_dx + duy_dy) + 2*m*dux_dx",
        *G,
        meaning="young*poisson/((1 + poisson)*(1 - 2*poisson))*(dux_dx + duy_dy) + young/(1 + poisson)*dux_dx",
        **STEEL,
    ),
    *named(
        "exx eyy exy sxx syy sxy",
        "(sxx*exx + syy*eyy + 2*sxy*exy)/2",
        (1e-3, -5e-4, 2e-4, 200, -80, 30),
    ),
    *named(
        "s1 s2",
        "if(s1*s2 < 0, s1 - s2, max(abs(s1), abs(s2)))",
        (3, -1),
        (3, 1),
        (-1, -3),
        meaning="choose(s1*s2 < 0, s1 - s2, max(abs(s1), abs(s2)))",
    ),
    *named("temperature", "1/(1 + exp(-(temperature - 293.15)/12))", (300,), (250,)),
]
