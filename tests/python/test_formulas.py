"""Compares the reader's evaluator of formulas with the conformance corpus (tests/corpus/README.md).

    python tests/python/test_formulas.py        (from the repository's root; or: pytest tests/python)

Cases of real numbers in extended precision, so that values and gradients agree to the digits of the
corpus whatever their condition; cases that the arithmetic of doubles decides in doubles.
"""

import math
import pathlib
import sys

import mpmath

sys.path.insert(0, str(pathlib.Path(__file__).parent))
from ppum_formulas import Double, Extended, Formula, Table, polar

CORPUS = pathlib.Path(__file__).parents[1] / "corpus"
mpmath.mp.dps = 700  # the largest argument of a sine has 300 digits


def blocks(path):
    """The records of a file, each a list of (key, value)."""
    for block in path.read_text().split("\n\n"):
        yield [line.split(": ", 1) for line in block.splitlines()]


def records():
    """All cases of the corpus as dictionaries, with their place."""
    for path in sorted((CORPUS / "formulas").glob("*.txt")):
        for record in blocks(path):
            yield f"{path.stem}: {record[0][1]}", dict(record)


def numbers(text, n):
    """`name = number, …` as numbers, doubles taken as they are."""
    pairs = [item.split(" = ") for item in text.split(", ")] if text else []
    return {name: n.real(float(value)) for name, value in pairs}


def tables(n):
    """The tables of the corpus by their names."""
    found = {}
    for record in blocks(CORPUS / "tables.txt"):
        knots = {key: list(map(float, value.split())) for key, value in record if key in "xy"}
        rows = [list(map(float, value.split())) for key, value in record if key == "values"]
        values = rows if "y" in knots else rows[0]
        found[record[0][1]] = Table(knots["x"], knots.get("y"), values, n)
    return found


def names(record, n):
    """What the formula may use: a frame's polar coordinates are those of the point, not rounded."""
    known = numbers(record["at"], n) | numbers(record.get("parameters", ""), n)
    if record["scope"] == "polar":
        theta = known["theta"]
        if n is Extended:
            angle = mpmath.atan2(known["y"], known["x"])
            theta = angle + 2 * mpmath.pi * mpmath.nint((theta - angle) / (2 * mpmath.pi))
        known |= polar(known["x"], known["y"], theta, n)
    return known


def compute(record, tables, n):
    """Value and gradient of a case."""
    variables = {"cartesian": "x y", "polar": "x y"}.get(record["scope"], record["scope"]).split()
    text = record["formula"].replace("\\n", "\n").replace("\\r", "\r").replace("\\t", "\t")
    jet = Formula(text, variables, tables, n).evaluate(names(record, n))
    return [jet.v, *(jet.slopes.get(variable, 0) for variable in variables)]


def expected(record, real):
    """As many of them as the corpus promises."""
    return [real(number) for key in ("value", "gradient") for number in record.get(key, "").split()]


def test_cases_of_real_numbers():
    known, compared, worst = tables(Extended), 0, 0
    for place, record in records():
        if "arithmetic" not in record:
            continue
        for found, exact in zip(compute(record, known, Extended), expected(record, mpmath.mpf)):
            error = abs(found - exact) / (abs(exact) + mpmath.mpf(10) ** -400)
            assert error < 1e-24, f"{place} at {record['at']}: {mpmath.nstr(found, 25)}"
            compared, worst = compared + 1, max(worst, error)
    print(f"    {compared} numbers compared, largest relative difference {float(worst):.1e}")
    assert compared > 2000


def test_cases_of_doubles():
    known, compared = tables(Double), 0
    for place, record in records():
        if "arithmetic" in record:
            continue
        for found, exact in zip(compute(record, known, Double), expected(record, float)):
            same = found == exact or (found != found and exact != exact)
            assert same or math.isclose(found, exact, rel_tol=1e-15), f"{place} at {record['at']}: {found}"
            compared += 1
    print(f"    {compared} numbers compared")
    assert compared > 70


if __name__ == "__main__":
    for name, test in list(globals().items()):
        if name.startswith("test_"):
            test()
            print(f"ok  {name[5:].replace('_', ' ')}")
