"""Compares the reader's evaluator of formulas with the conformance corpus (tests/corpus/README.md).

    python tests/python/test_formulas.py        (from the repository's root; or: pytest tests/python)

In extended precision, so that values agree to the digits of the corpus whatever their condition.
"""

import collections
import pathlib
import re
import sys

import mpmath

sys.path.insert(0, str(pathlib.Path(__file__).parent))
from ppum_reader import Formulas

CORPUS = pathlib.Path(__file__).parents[1] / "corpus"
# the reader's language is smaller than the whole: raise this when it learns more
AT_LEAST = 600
# where the reader differs from FORMAT.md
DIFFERENT = {"9007199254740993*x": "whole numbers beyond 2^53 are not rounded to doubles"}
mpmath.mp.dps = 700  # the largest argument of a sine has 300 digits


def records():
    """All records of the corpus as dictionaries, with their place."""
    for path in sorted((CORPUS / "formulas").glob("*.txt")):
        for block in path.read_text().split("\n\n"):
            lines = [line.split(": ", 1) for line in block.splitlines()]
            yield f"{path.stem}: {lines[0][1]}", dict(lines)


def numbers(text):
    """`name = number, …` as numbers, doubles taken as they are."""
    pairs = [item.split(" = ") for item in text.split(", ")] if text else []
    return {name: mpmath.mpf(float(value)) for name, value in pairs}


def names(record):
    """What the formula may use: a frame's polar coordinates are those of the point, not rounded."""
    known = numbers(record["at"]) | numbers(record.get("parameters", "")) | {"pi": +mpmath.mp.pi}
    if record["scope"] == "polar":
        x, y = known["x"], known["y"]
        angle = mpmath.atan2(y, x)
        turns = mpmath.nint((known["theta"] - angle) / (2 * mpmath.pi))
        known |= {"r": mpmath.hypot(x, y), "theta": angle + 2 * mpmath.pi * turns}
    return known


def value(formulas, record):
    """The value of a case, or why the reader has none."""
    text = re.sub(r"\\[nrt]", " ", record["formula"])
    try:
        result = formulas.evaluate(formulas.parse(text), names(record)).v
    except (SyntaxError, AttributeError):
        return "grammar not known"
    except KeyError as error:
        return f"{error} not known"
    except ValueError:
        return "operator not known"
    except ZeroDivisionError:
        return "a branch that is not taken divides by zero"
    return result


def test_values_of_the_corpus():
    formulas, compared, skipped, worst = Formulas(mpmath), 0, collections.Counter(), 0
    for place, record in records():
        if "arithmetic" not in record:
            skipped["decided by doubles, not by real numbers"] += 1
            continue
        if record["formula"] in DIFFERENT:
            skipped[DIFFERENT[record["formula"]]] += 1
            continue
        found, expected = value(formulas, record), mpmath.mpf(record["value"])
        if isinstance(found, str):
            skipped[found] += 1
            continue
        error = abs(found - expected) / (abs(expected) + mpmath.mpf(10) ** -400)
        assert error < 1e-24, f"{place} at {record['at']}: {mpmath.nstr(found, 25)}"
        compared, worst = compared + 1, max(worst, error)
    print(f"    {compared} values compared, largest relative difference {float(worst):.1e}")
    for reason, count in sorted(skipped.items()):
        print(f"    {count} skipped: {reason}")
    assert compared >= AT_LEAST


if __name__ == "__main__":
    for name, test in list(globals().items()):
        if name.startswith("test_"):
            test()
            print(f"ok  {name[5:].replace('_', ' ')}")
