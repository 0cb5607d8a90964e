"""The estimated errors of K over the errors of K, order by order.

    cargo build --release
    python tests/random/estimates.py target/release/ppum

Solves the first problems of `values.json` that have cracks on 8 × 8 cells, which are not refined, at orders 1 to 8, and
prints the table of docs/validation.md. Errors that are not five times those of the reference are left out.
"""

import json
import math
import pathlib
import subprocess
import sys
import tempfile

import generate

PROBLEMS, LARGE = 25, 5.0
HEAD = "| order | tips | median error | 5 % | median | 95 % | from 1 to 30 |\n| --- | --- | --- | --- | --- | --- | --- |"


def factors(program, text, folder):
    """(K_I, K_II, estimated error) of the tips; none if the program refuses."""
    problem, dataset = folder / "plate.toml", folder / "plate.h5"
    problem.write_text(text)
    solve = subprocess.run([program, "solve", problem, "-o", dataset], capture_output=True)
    if solve.returncode:
        return []
    found = subprocess.run([program, "sif", "--json", dataset], capture_output=True, check=True)
    return [(tip["k1"], tip["k2"], tip["error"]) for tip in json.loads(found.stdout)["tips"]]


def ratios(program, number, known, order, folder):
    """(relative error, estimate over error) of the tips of a problem whose errors are known."""
    cells = f"level = 3\norder = {order}\nrefine = false"
    tips = factors(program, generate.problem(number).replace("level = 4", cells), folder)
    if len(tips) != len(known):
        return
    for (k1, k2, estimate), tip in zip(tips, known):
        error = math.hypot(k1 - tip["k1"], k2 - tip["k2"])
        if error > LARGE * math.hypot(tip["k1_error"], tip["k2_error"]):
            yield error / math.hypot(tip["k1"], tip["k2"]), estimate / error


def row(order, found):
    errors, parts = sorted(error for error, _ in found), sorted(part for _, part in found)
    at = lambda values, share: values[round(share * (len(values) - 1))]
    inside = sum(1 <= part <= 30 for part in parts)
    shares = " | ".join(f"{at(parts, share):.2g}" for share in (0.05, 0.5, 0.95))
    return f"| {order} | {len(parts)} | {at(errors, 0.5):.1e} | {shares} | {inside} |"


def main():
    values = json.loads((generate.HERE / "values.json").read_text())["problems"]
    chosen = [(int(number), entry["tips"]) for number, entry in values.items() if entry.get("tips")][:PROBLEMS]
    print(HEAD)
    with tempfile.TemporaryDirectory() as folder:
        for order in range(1, 9):
            all_tips = [ratios(sys.argv[1], *problem, order, pathlib.Path(folder)) for problem in chosen]
            print(row(order, [tip for tips in all_tips for tip in tips]), flush=True)


if __name__ == "__main__":
    main()
