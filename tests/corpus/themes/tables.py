"""Tables of one and two variables: cubic splines between the nodes, constant outside."""

from cases import line, plane
from splines import Table

TABLES = [
    Table("line", [-1.0, 3.0], values=[2.0, -6.0]),
    Table("parabola", [0.0, 1.0, 4.0], values=[1.0, 0.0, 9.0]),
    Table("cubic", [-2.0, -1.0, 1.0, 2.5], values=[-8.0, -1.0, 1.0, 15.625]),
    # Young's modulus of a steel over temperature, in GPa and °C, uneven and with decimals
    Table("modulus", [20.0, 100.0, 200.0, 300.0, 400.0, 450.0, 600.0], values=[210.0, 205.2, 197.8, 188.9, 177.1, 169.5, 142.3]),
    Table("wave", [0.0, 0.5, 1.25, 1.5, 2.0, 3.0, 3.25, 4.0], values=[0.0, 0.5, 1.0, 0.875, 0.25, -1.0, -0.9375, -0.125]),
    # geometry factor F(a/W, h/W): rows of constant y
    Table(
        "factor",
        [0.0, 0.125, 0.25, 0.5, 0.75],
        [0.5, 1.0, 1.5, 3.0],
        values=[
            [1.12, 1.45, 1.9, 3.6, 9.1],
            [1.12, 1.31, 1.61, 2.95, 6.7],
            [1.12, 1.25, 1.52, 2.84, 6.4],
            [1.12, 1.22, 1.5, 2.83, 6.36],
        ],
    ),
    # 3 × 2 nodes: a parabola times a line
    Table("sheet", [-1.0, 0.0, 2.0], [0.0, 1.0], values=[[1.0, 0.0, 4.0], [2.0, 0.5, -1.0]]),
]  # fmt: skip

WAVE = dict(tables=("wave",))
FACTOR = dict(tables=("factor",))

CASES = [
    *line("table(line, t)", 0, 2.5, -4, tables=("line",)),
    *line("table(parabola, t)", 0.5, 2, 10, tables=("parabola",)),
    *line("table(cubic, t)", -1.5, 0.25, 2, tables=("cubic",), meaning="t**3"),
    *line("table(cubic, t)", -1, 2.5, tables=("cubic",), meaning="t**3"),
    *line("table(modulus, t)", 21.5, 150, 300, 425, 599, 700, -40, tables=("modulus",)),
    *line("table(wave, t)", 0.25, 0.75, 1.25, 1.375, 1.75, 2.5, 3.125, 3.5, **WAVE),
    # on the ends the derivatives are those of the inside
    *line("table(wave, t)", 0, 4, **WAVE),
    *line("table(wave, t)", 4.5, -1, 1e9, **WAVE),
    *line("dtable(wave, 1, t)", 0.25, 1.375, 3.5, -1, **WAVE),
    *line("dtable(wave, 2, t)", 0.25, 1.375, 5, order=1, **WAVE),
    *line("exp(table(wave, t^2))", 0.5, 1.5, **WAVE),
    *line("table(wave, 2*t)*t + table(wave, t)^2", 0.375, 1.125, **WAVE),
    *line("table(wave, table(modulus, t)/100)", 150, 420, tables=("wave", "modulus")),
    *plane("table(wave, x + y)*y", (0.25, 0.5), (2, 1.125), **WAVE),
    *plane("table(wave, hypot(x, y))", (0.75, 1), (-2, 1.5), **WAVE),
    *plane(
        "if(x < 1, table(wave, x), table(wave, y))",
        (0.25, 0.75),
        (2, 1.375),
        meaning="choose(x < 1, table(wave, x), table(wave, y))",
        **WAVE,
    ),
    *plane(
        "table(factor, x, y)",
        (0.0625, 0.75),
        (0.1875, 1.25),
        (0.25, 1),
        (0.375, 2),
        (0.625, 2.5),
        **FACTOR,
    ),
    *plane("table(factor, x, y)", (0, 0.5), (0.75, 3), (0.5, 3), **FACTOR),
    *plane("table(factor, x, y)", (1, 1.25), (0.3125, 5), (-1, -1), (0.3125, 0.25), **FACTOR),
    *plane("table(factor, y/4, 1 + x^2)*sqrt(pi*y)", (0.5, 1), (-1.25, 2.5), **FACTOR),
    *plane("dtable(factor, 1, 0, x, y)", (0.1875, 1.25), (0.625, 2.5), **FACTOR),
    *plane("dtable(factor, 1, 1, x, y)", (0.1875, 1.25), (0.625, 2.5), order=1, **FACTOR),
    *plane("table(sheet, x, y)", (-0.5, 0.25), (1, 0.75), (3, 0.5), tables=("sheet",)),
]
