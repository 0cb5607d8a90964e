"""Operators, their precedence, numbers, constants, `let`, blanks and comments."""

from cases import line, plane

P, Q = (0.75, -1.5), (-2.25, 0.625)

CASES = [
    # precedence and grouping
    *plane("x + y*3", P, Q),
    *plane("(x + y)*3", P),
    *plane("x - y - 2", P, Q),
    *plane("x - (y - 2)", P),
    *plane("x/y/4", P, Q, meaning="x/(4*y)"),
    *plane("x/(y/4)", P, meaning="4*x/y"),
    *plane("x/y*4", P, meaning="4*x/y"),
    *plane("6/2*3 + x", P, meaning="9 + x"),
    *plane("-x^2", P, Q, meaning="-(x**2)"),
    *plane("(-x)^2", P, meaning="x**2"),
    *plane("-x^2*y", P, meaning="-(x**2*y)"),
    *plane("2^3^2 + x", P, meaning="512 + x"),
    *plane("x^2^3", P, meaning="x**8"),
    *plane("(x^2)^3", P, Q, meaning="x**6"),
    *plane("2^-x", P, Q, meaning="1/2**x"),
    *plane("x^-2*y", P, meaning="y/x**2"),
    *plane("--x - -y", P, meaning="x + y"),
    *plane("+x*-y", P, meaning="-x*y"),
    *plane("2 - -3*x", P, meaning="2 + 3*x"),
    *plane("x·y − 2", P, meaning="x*y - 2"),
    # numbers
    *plane("1e2*x + .5 - 5.", P, meaning="100*x - 4.5"),
    *plane("0.1*x + 0.2*y", P, Q),
    *plane("1.5E-3*x^2 + 2e+1*y", P, meaning="0.0015*x**2 + 20*y"),
    *plane("9007199254740993*x", P, meaning="9007199254740992*x"),
    *plane("123456789.125*x - y", P),
    *plane("0.30000000000000004*x", P),
    # constants
    *plane("pi*x + e*y", P, Q),
    *plane("sin(pi/3*x)*e^y", P, meaning="sin(pi*x/3)*exp(y)"),
    *plane("cos(2*pi*x)", (0.125, 0), (0.5, 0), (1, 1)),
    *plane("pi^2/6 - x", P),
    # polynomials and rational functions
    *plane("x^3*y - 2*x*y^2 + 7", P, Q),
    *plane("(x + y)^4", P, Q),
    *plane("(1 + x)*(1 - x)*(1 + y^2)", P, Q),
    *plane("x*y*(1 - x)*(1 - y)*16", (0.25, 0.5), (0.5, 0.75)),
    *plane("1/(1 + 25*x^2)", P, (0, 0), (0.1875, 2)),
    *plane("(x^2 - y^2)/(x^2 + y^2)", P, Q),
    *plane("x*y/(x^2 + y^2)^2", P, Q),
    *plane("1/x - (3*x - 1)/(x + 9)", P, Q),
    *plane("((((x))))*(((y)))", P, meaning="x*y"),
    *plane("(x - 1)^5*(y + 2)^3", P, Q),
    *plane("x^16 - y^15", P, Q),
    *plane("x^17*y", P, Q),
    *plane("x^-16", P),
    *plane("(x/y)^7", P, Q),
    *plane("3", P),
    *plane("y", P),
    # let
    *plane("let a = x + 1; let b = a*a; b - a", P, Q, meaning="(x + 1)**2 - (x + 1)"),
    *plane("2*(let a = x; a*a) + (let a = y; a)", P, meaning="2*x**2 + y"),
    *plane("max(let a = x; a*a, y)", P, meaning="x**2"),
    *plane("let unused = 1/0; x*y", P, meaning="x*y"),
    *plane("let c1 = 2*y; let c2 = (let c3 = c1^2; c3*x); c2 - c1", P, Q, meaning="4*y**2*x - 2*y"),
    *plane(
        "let q = 1 - x^2 - y^2/4; q*q*q + q",
        P,
        Q,
        meaning="(1 - x**2 - y**2/4)**3 + 1 - x**2 - y**2/4",
    ),
    # blanks and comments
    *plane("# a parabola\n  x^2 # in x\n\t+ y  # and a line", P, meaning="x**2 + y"),
    *plane("x   *y\r\n-1", P, meaning="x*y - 1"),
    *plane("x+y-x*y/x^y", P, meaning="x + y - x*y/x**y"),
    # parameters, other variables
    *plane("k*x^n + y", P, k=2.5, n=3),
    *plane("amplitude*(1 - x/length)^2", P, Q, amplitude=1e-3, length=4),
    *line("t^3 - 2*t + 1", 0.5, -1.25, 3),
    *line("(1 - t)^2*(1 + 2*t)", 0, 0.375, 1),
]
