"""The estimated errors of K over the errors of K, order by order.

    cargo build --release
    python tests/random/estimates.py target/release/ppum

Solves the first problems of `values.json` that have tips on 8 × 8 cells, at orders 1 to 8 with these cells and at
orders 1 to 5 as they are refined by default, and prints the table of docs/validation.md; problems that are refused, on
standard error. Errors that are not five times those of the reference are left out, which are most of higher orders on
refined cells.
"""

import json
import math
import pathlib
import subprocess
import sys
import tempfile

import generate

PROBLEMS, LARGE = 25, 5.0
HEAD = "| cells | order | tips | median error | median | from 1 to 30 | below 1 | above 30 |\n|" + 8 * " --- |"


def factors(program, text, folder):
    """(K_I, K_II, estimated error) of the tips; none if the program refuses."""
    problem, dataset = folder / "plate.toml", folder / "plate.h5"
    problem.write_text(text)
    solve = subprocess.run([program, "solve", problem, "-o", dataset], capture_output=True, text=True)
    if solve.returncode:
        print(text.splitlines()[0], solve.stderr, sep="\n", file=sys.stderr)
        return []
    found = subprocess.run([program, "sif", "--json", dataset], capture_output=True, check=True)
    return [(tip["k1"], tip["k2"], tip["error"]) for tip in json.loads(found.stdout)["tips"]]


def ratios(program, number, known, cells, folder):
    """(relative error, estimate over error) of the tips of a problem whose errors are known."""
    tips = factors(program, generate.problem(number).replace("level = 4", cells), folder)
    if len(tips) != len(known):
        return
    for (k1, k2, estimate), tip in zip(tips, known):
        error = math.hypot(k1 - tip["k1"], k2 - tip["k2"])
        if error > LARGE * math.hypot(tip["k1_error"], tip["k2_error"]):
            yield error / math.hypot(tip["k1"], tip["k2"]), estimate / error


def row(head, found):
    errors, parts = sorted(error for error, _ in found), sorted(part for _, part in found)
    below, above = sum(part < 1 for part in parts), sum(part > 30 for part in parts)
    error, part = errors[len(errors) // 2], parts[len(parts) // 2]
    error = f"{error:.1e}".replace("e-0", "e-")
    return f"| {head} | {len(parts)} | {error} | {part:.2g} | {len(parts) - below - above} | {below} | {above} |"


def main():
    values = json.loads((generate.HERE / "values.json").read_text())["problems"]
    chosen = [(int(number), entry["tips"]) for number, entry in values.items() if entry.get("tips")][:PROBLEMS]
    print(HEAD)
    with tempfile.TemporaryDirectory() as folder:
        for refined, order in [(False, order) for order in range(1, 9)] + [(True, order) for order in range(1, 6)]:
            cells = f"level = 3\norder = {order}\nrefine = {str(refined).lower()}"
            all_tips = [ratios(sys.argv[1], *problem, cells, pathlib.Path(folder)) for problem in chosen]
            head = f"{'refined' if refined else '8 × 8'} | {order}"
            print(row(head, [tip for tips in all_tips for tip in tips]), flush=True)


if __name__ == "__main__":
    main()
