"""Comparisons, `and`, `or`, `not`, `if`: which branch gives value and derivatives."""

from cases import line, plane

P, Q = (1, 2), (2, -1)

CASES = [
    *plane("if(x < y, x^2, y^3)", P, Q, meaning="choose(x < y, x**2, y**3)"),
    *plane("if(x <= 1, x*y, 0)", P, Q, (0.5, 3), meaning="choose(x <= 1, x*y, 0)"),
    *plane("if(x < 1, x*y, x^2*y)", P, meaning="x**2*y"),
    *plane("if(x > y, sin(x), cos(y))", P, Q, meaning="choose(x > y, sin(x), cos(y))"),
    *plane("if(y >= 2, x^3, x)", P, Q, meaning="choose(y >= 2, x**3, x)"),
    *plane("if(y > 2, x^3, x*y)", P, meaning="x*y"),
    *plane("if(x == 1, x^2, y)", P, Q, meaning="choose(Eq(x, 1), x**2, y)"),
    *plane("if(x != 1, x^2, y)", P, Q, meaning="choose(Ne(x, 1), x**2, y)"),
    *plane("if(x + 1 < y*3, x*y, -x*y)", P, Q, meaning="choose(x + 1 < 3*y, x*y, -x*y)"),
    *plane("if(not x < y, x^2, y^2)", P, Q, meaning="choose(x >= y, x**2, y**2)"),
    # `not` binds weaker than a comparison, tighter than `and`; `and` tighter than `or`
    *plane(
        "if(not x < y or y > 0, x^2, y^2)",
        P,
        Q,
        meaning="choose(Or(Not(x < y), y > 0), x**2, y**2)",
    ),
    *plane(
        "if(not x < y and y > 0, x^2, y^2)",
        P,
        Q,
        meaning="choose(And(Not(x < y), y > 0), x**2, y**2)",
    ),
    *plane(
        "if(x == 1 or x == 5 and y == 5, x^2, y^2)",
        P,
        Q,
        meaning="choose(Or(Eq(x, 1), And(Eq(x, 5), Eq(y, 5))), x**2, y**2)",
    ),
    *plane(
        "if((x == 1 or x == 5) and y == 5, x^2, y^2)",
        P,
        Q,
        meaning="choose(And(Or(Eq(x, 1), Eq(x, 5)), Eq(y, 5)), x**2, y**2)",
    ),
    *plane(
        "if(not (x == 1 and y == 5), x^2, y^2)",
        P,
        Q,
        meaning="choose(Not(And(Eq(x, 1), Eq(y, 5))), x**2, y**2)",
    ),
    *plane("if(not not x < y, x^2, y^2)", P, Q, meaning="choose(x < y, x**2, y**2)"),
    *plane(
        "let inside = x^2 + y^2 < 4.5; if(inside, x*y^2, 1)",
        P,
        (1, 1.5),
        (3, 0),
        meaning="choose(x**2 + y**2 < 4.5, x*y**2, 1)",
    ),
    *plane(
        "if(x < y, if(x < 0, -x, x)*y, if(y < 0, -y, y)*x)",
        P,
        Q,
        (-1, 1),
        meaning="choose(x < y, choose(x < 0, -x, x)*y, choose(y < 0, -y, y)*x)",
    ),
    *plane(
        "if(x > 0 and y > 0, sqrt(x*y), 0)", P, Q, meaning="choose(And(x > 0, y > 0), sqrt(x*y), 0)"
    ),
    *plane(
        "x*if(y > 0, 1, -1) + if(x > 0, y^2, 0)",
        P,
        Q,
        meaning="x*choose(y > 0, 1, -1) + choose(x > 0, y**2, 0)",
    ),
    *plane("if(1 < 2, x, y)", P, meaning="x"),
    *plane("if(2 <= 1, x, x*y)", P, meaning="x*y"),
    *plane("exp(if(x > y, x, y))", P, Q, meaning="choose(x > y, exp(x), exp(y))"),
    *line(
        "if(t < 0, 0, if(t < 1, t^2*(3 - 2*t), 1))",
        -0.5,
        0,
        0.25,
        1,
        2,
        meaning="Piecewise((0, t < 0), (t**2*(3 - 2*t), t < 1), (1, True))",
    ),
    *line(
        "if(t <= 0.5 and t >= -0.5, 1 + cos(pi*t), 0)",
        0.25,
        0.5,
        0.75,
        meaning="choose(And(t <= 0.5, t >= -0.5), 1 + cos(pi*t), 0)",
    ),
    # a selected branch is the only one whose trouble counts
    *line("if(t > 0, exp(-1/t), 0)", -1, 0, 0.25, meaning="choose(t > 0, exp(-1/t), 0)"),
    *line("if(t < 1, sqrt(1 - t), 0)", 0.75, 2, meaning="choose(t < 1, sqrt(1 - t), 0)"),
    *line("if(t > 0, log(t), t)", 2, -2, meaning="choose(t > 0, log(t), t)"),
    *line("if(t != 0, sin(t)/t, 1)", 1, 0.5, meaning="sin(t)/t"),
    *line("if(t != 0, sin(t)/t, 1)", 0, meaning="1 + 0*t"),
    *line(
        "if(abs(t) < 0.5, t, sign(t)*(abs(t) - 0.25))",
        0.25,
        3,
        -3,
        meaning="choose(abs(t) < 0.5, t, sign(t)*(abs(t) - 0.25))",
    ),
]
