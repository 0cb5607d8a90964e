"""Writes the conformance corpus of the formula language: tests/corpus/formulas/*.txt and tables.txt.

    python3 -m venv .venv && .venv/bin/pip install -r tests/corpus/requirements.txt
    .venv/bin/python tests/corpus/formulas.py            writes
    .venv/bin/python tests/corpus/formulas.py --check    fails if what it would write is not there

What a record means is in README.md beside this file. Every number is computed twice in extended
precision, from two statements of the formula: sympy differentiates one (exact.py), jets carry
derivatives through the tree of the other (language.py, rounding.py); they agree or the script fails.
"""

import pathlib
import sys
import time

import themes
from cases import Computed, special_record

HERE = pathlib.Path(__file__).parent


def texts():
    """Path → content of all files."""
    tables = {table.name: table for table in themes.TABLES}
    files = {"tables.txt": "\n".join(table.text() for table in themes.TABLES)}
    for name, cases in themes.all():
        start, skipped = time.monotonic(), 0
        records = []
        for case in cases:
            if case.special:
                records.append(special_record(case))
                continue
            computed = Computed(case, tables)
            skipped += computed.single() is not None
            records.append(computed.record())
        assert len(set(records)) == len(records), f"{name}: a case stands twice"
        files[f"formulas/{name}.txt"] = "\n".join(records)
        print(
            f"{name}: {len(cases)} cases, {skipped} not for single precision, {time.monotonic() - start:.0f} s"
        )
    return files


def main():
    check, total = "--check" in sys.argv[1:], 0
    (HERE / "formulas").mkdir(exist_ok=True)
    for name, text in texts().items():
        path = HERE / name
        total += text.count("formula: ")
        if not check:
            path.write_text(text)
        elif not path.exists() or path.read_text() != text:
            sys.exit(f"{path} is not what this script writes")
    print(f"{total} cases")


if __name__ == "__main__":
    main()
