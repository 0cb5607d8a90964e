"""The program's answers to the random problems, held against their values.

    cargo build -p ppum-bench --example answers
    python tests/random/compare.py target/release/examples/answers [NUMBER …]

A line a problem: the largest error of K at its tips, |ΔK|/|K| with K = (K_I, K_II), where weak tips are measured against a
fifth of the problem's scale of K; the error of the energy; unknowns, seconds, warnings. FAIL is what is wrong
and silent: K by more than 0.5 % or the energy by more than 0.1 %. `warned` is what is wrong and says so, with a place where
something is, and an estimate within a factor of ten of the error. Sums by kind stand at the end.
"""

import argparse
import json
import math
import pathlib
import subprocess
import tempfile
import tomllib
from collections import Counter, defaultdict

import generate
import shapes

HERE = pathlib.Path(__file__).parent
K_LIMIT, ENERGY_LIMIT, FACTOR = 5e-3, 1e-3, 10.0
WEAK = 0.2  # of the problem's scale of K: smaller K are measured against this
# Their numbers are no errors, but lengths, ratios and differences.
NO_ESTIMATES = {"faces-overlap", "negative-k1", "no-room", "little-room", "spread", "tip-near-border", "coarse",
                "imbalance", "residual", "cut-off", "nitsche", "crossed-twice"}
NEAR = 0.15  # of the plate's longer side: within about two cells of the coarsest mesh


def size(tip):
    return math.hypot(tip["k1"], tip["k2"])


def k_error(tip, found, scale):
    """|ΔK|/|K| at a tip."""
    if found["k1"] is None or found["k2"] is None:
        return math.inf
    away = math.hypot(tip["k1"] - found["k1"], tip["k2"] - found["k2"])
    return away / max(size(tip), WEAK * scale)


def errors(known, answer):
    """The errors of K at the tips, and that of the energy."""
    found = {(t["crack"], t["end"]): t for t in answer["tips"]}
    at_tips = {(t["crack"], t["end"]): k_error(t, found[t["crack"], t["end"]], known["k_scale"])
               if (t["crack"], t["end"]) in found else math.inf for t in known["tips"]}
    energy = math.inf if answer["energy"] is None else answer["energy"]
    return at_tips, abs(energy / known["energy"] - 1)


def special_parts(data):
    """Segments on which something is: cracks, rims of holes, the border, where pieces of edges end and corners are."""
    low, high = data["domain"]["min"], data["domain"]["max"]
    box = [low, [high[0], low[1]], high, [low[0], high[1]]]
    for crack in data.get("crack", []):
        yield from shapes.segments(crack["points"])
    for hole in data.get("hole", []):
        around = hole.get("points") or [shapes.moved(hole["center"], k * math.pi / 12, hole["radius"]) for k in range(24)]
        yield from shapes.segments(around, closed=True)
    yield from shapes.segments(box, closed=True)


def names_a_place(data, warning):
    """Whether a warning is about an error at a place where something is; interfaces of materials may be anywhere."""
    if warning["at"] is None or warning["kind"] in NO_ESTIMATES:
        return False
    near = NEAR * max(b - a for a, b in zip(data["domain"]["min"], data["domain"]["max"]))
    varied = any("if(" in str(value) for value in data.get("material", {}).values())
    return varied or min(shapes.to_segment(warning["at"], part) for part in special_parts(data)) < near


def verdict(data, worst_k, energy, warnings):
    if worst_k <= K_LIMIT and energy <= ENERGY_LIMIT:
        return "ok"
    error = max(worst_k if worst_k > K_LIMIT else 0.0, energy if energy > ENERGY_LIMIT else 0.0)
    good = any(names_a_place(data, w) and error / FACTOR <= w["value"] <= error * FACTOR for w in warnings)
    return "warned" if good else "FAIL"


def answers(program, files, seconds):
    """The program's answer to each file."""
    for file in files:
        try:
            done = subprocess.run([program, file], capture_output=True, text=True, timeout=seconds)
            yield json.loads(done.stdout) if done.stdout.strip() else {"error": done.stderr.strip()[-200:]}
        except subprocess.TimeoutExpired:
            yield {"error": f"more than {seconds} s"}


def row(number, file, known, answer, totals):
    data = tomllib.loads(file.read_text())
    words = data["title"].split(" ", 1)[1]
    if "error" in answer:
        totals[words.split(":")[0]]["FAIL"] += 1
        return f"{number} {'FAIL':6} refused: {answer['error']} | {words}"
    at_tips, energy = errors(known, answer)
    worst = max(at_tips.values(), default=0.0)
    found = verdict(data, worst, energy, answer["warnings"])
    totals[words.split(":")[0]][found] += 1
    said = Counter(w["kind"] for w in answer["warnings"])
    values = {w["kind"]: w["value"] for w in answer["warnings"] if w["at"]}
    said = ", ".join(f"{n}× {kind} {values.get(kind, math.nan):.1e}" for kind, n in said.items())
    k = f"{worst:9.1e}" if at_tips else " " * 9
    return f"{number} {found:6} {k} {energy:9.1e} {answer['unknowns']:7.0f} {answer['seconds']:6.1f} s  {words}  [{said}]"


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("program")
    parser.add_argument("numbers", nargs="*", type=int)
    parser.add_argument("--folder", type=pathlib.Path, help="where the files are written")
    parser.add_argument("--seconds", type=float, default=300.0, help="time for a problem")
    options = parser.parse_args()
    values = json.loads((HERE / "values.json").read_text())["problems"]
    names = [f"{n:03}" for n in options.numbers] or sorted(values)
    totals = defaultdict(Counter)
    print("no. verdict   K error    energy  unknowns seconds")
    with tempfile.TemporaryDirectory() as temporary:
        folder = options.folder or pathlib.Path(temporary)
        folder.mkdir(parents=True, exist_ok=True)
        files = [folder / f"{name}.toml" for name in names]
        for name, file in zip(names, files):
            file.write_text(generate.problem(int(name)))
        for name, file, answer in zip(names, files, answers(options.program, files, options.seconds)):
            print(row(name, file, values[name], answer, totals), flush=True)
    for kind, counts in sorted(totals.items()):
        print(f"{kind:22}", *(f"{counts[v]:4} {v}" for v in ("ok", "warned", "FAIL")))
    print(f"{'all':22}", *(f"{sum(c[v] for c in totals.values()):4} {v}" for v in ("ok", "warned", "FAIL")))


if __name__ == "__main__":
    main()
