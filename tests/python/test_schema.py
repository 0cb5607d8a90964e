"""docs/problem-file.schema.json against good and bad problem files, by another library than the program's reader.

    .venv/bin/pip install -r tests/python/requirements.txt
    .venv/bin/python tests/python/test_schema.py
"""

import json
import re
import tomllib
from pathlib import Path

from jsonschema import Draft7Validator

ROOT = Path(__file__).resolve().parents[2]
BAD = ROOT / "crates/ppum-problem/tests/bad_files"
# What a schema can see: keys, types, words and ranges of plain numbers.
SEEN = re.compile(
    r"unknown key|is missing in (`|\[[a-z])|does not fit|must be (true|a text|a list|one table|two |four |an array|a whole|a table)"
    r"|must be [-0-9.e]+ to [-0-9.e]+(?! after)|must be (above|at least) [-0-9.e]+|must be positive and finite$"
    r"|cannot be .*, only \"|out of range"
)


def schema():
    definition = json.loads((ROOT / "docs/problem-file.schema.json").read_text())
    Draft7Validator.check_schema(definition)
    return Draft7Validator(definition)


def cases(name):
    """The texts with a mistake in them, and what the reader says of it."""
    good = (BAD / f"{name}.toml").read_text()
    for case in (BAD / f"{name}.txt").read_text().split("\n== ")[1:]:
        title, *lines = case.split("\n")
        old, new = ("\n".join(line[1:] for line in lines if line.startswith(sign)) for sign in "-+")
        messages = [line for line in lines if line and line[0] not in "-+"]
        yield title, good.replace(old, new), messages


def test_good_files():
    files = [*ROOT.glob("examples/*.toml"), *BAD.glob("*.toml")]
    assert len(files) > 30
    for file in files:
        errors = [error.message for error in schema().iter_errors(tomllib.loads(file.read_text()))]
        assert not errors, f"{file.name}: {errors}"


def test_heat_without_a_body():
    missing = [f"'{key}' is a required property" for key in ("domain", "discretization")]
    for kind, expected in (("poisson", []), ("elasticity", missing)):
        document = {"equation": {"kind": kind}, "boundary": [{"on": "top"}]}
        messages = [error.message for error in schema().iter_errors(document) if not error.path]
        assert messages == expected, f"{kind}: {messages}"


def test_bad_files():
    validator, refused, missed = schema(), 0, []
    for file in sorted(BAD.glob("*.toml")):
        for title, text, messages in cases(file.stem):
            try:
                document = tomllib.loads(text)
            except tomllib.TOMLDecodeError:
                continue
            is_valid = validator.is_valid(document)
            refused += not is_valid
            if is_valid and all(SEEN.search(message) for message in messages):
                missed.append(f"{file.stem}: {title}: {messages}")
    print(f"{refused} bad files are refused")
    assert refused > 90
    assert not missed, "\n".join(missed)


if __name__ == "__main__":
    test_good_files()
    test_heat_without_a_body()
    test_bad_files()
