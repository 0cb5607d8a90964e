"""Values of the random problems by an independent reference solver.

    python tests/random/reference.py HPFEM.py [--count 200] [NUMBER …]

HPFEM.py reads a problem file and prints its energy and stress intensity factors as JSON, each with an estimate of its
error; this has to run with the Python that it needs. What is new goes into values.json, where the problems whose reference
is too inaccurate to judge by, even with higher orders and finer meshes, stand as left out.
"""

import argparse
import hashlib
import importlib.metadata
import json
import math
import os
import pathlib
import subprocess
import sys
import tempfile
import tomllib

import generate
import shapes

VALUES = pathlib.Path(__file__).parent / "values.json"
# A reference has to be ten times as accurate as what it judges: K to 5e-3, energy to 1e-3.
K_LIMIT, ENERGY_LIMIT = 5e-4, 1e-4
# Tried one after the other, until the limits are kept.
ACCURACIES = ("", "--order 12", "--order 14 --levels 14")
SECONDS = 120
NAMES = {name: getattr(math, name) for name in ("exp", "sin", "cos", "pi")}


def counterclockwise(text, data):
    """The file with the polygons of holes in this direction: the reference does not cut out others."""
    for points in (hole["points"] for hole in data.get("hole", []) if "points" in hole):
        if sum(a[0] * b[1] - a[1] * b[0] for a, b in shapes.segments(points, closed=True)) < 0:
            text = text.replace(f"points = {points}", f"points = {points[::-1]}")
    return text


def run(program, file, options):
    """The reference's JSON, or what went wrong as a text."""
    environment = os.environ | {"OMP_NUM_THREADS": "1", "NGS_NUM_THREADS": "1"}
    command = [sys.executable, str(program), str(file), *options.split()]
    try:
        done = subprocess.run(command, capture_output=True, text=True, timeout=SECONDS, env=environment)
    except subprocess.TimeoutExpired:
        return f"more than {SECONDS} s"
    try:
        return json.loads(done.stdout)
    except ValueError:
        return (done.stderr.strip().splitlines() or ["no output"])[-1]


def value_at(entry, place):
    """A constant of the material at a place."""
    if not isinstance(entry, str):
        return entry
    text = entry.replace("^", "**").replace("if(", "choose(")
    return eval(text, NAMES | {"choose": lambda c, a, b: a if c else b, "x": place[0], "y": place[1]})


def scale(data, found):
    """The size of K to measure weak tips against: the strongest tip's, or sigma sqrt(pi a) of the mean stress."""
    if "material" not in data or "young" not in data["material"]:
        return None
    low, high = data["domain"]["min"], data["domain"]["max"]
    area = math.prod(b - a for a, b in zip(low, high))
    lengths = [sum(math.dist(a, b) for a, b in zip(c["points"], c["points"][1:])) for c in data.get("crack", [])]
    nominal = [math.sqrt(2 * found["energy"] * value_at(data["material"]["young"], t["at"]) / area
                         * math.pi * lengths[t["crack"]] / 2) for t in found["tips"]]
    return max([size(t) for t in found["tips"]] + nominal, default=None)


def size(tip, suffix=""):
    return math.hypot(tip["k1" + suffix], tip["k2" + suffix])


def doubt(found, k_scale):
    """How far the reference's own estimates are beyond the limits: at most 1 if it can judge."""
    k = [size(t, "_error") / max(size(t), 0.2 * k_scale) / K_LIMIT for t in found["tips"] if "k1" in t]
    return max([*k, found["energy_error"] / found["energy"] / ENERGY_LIMIT])


def values(program, number, folder):
    """The values of a problem, or the reason to leave it out."""
    text = generate.problem(number)
    data = tomllib.loads(text)
    file = pathlib.Path(folder) / f"{number:03}.toml"
    file.write_text(counterclockwise(text, data))
    first = text.splitlines()[0]
    told = first.removeprefix("# reference:").strip() if first.startswith("# reference:") else ""
    reason = ""
    for accuracy in ACCURACIES:
        found = run(program, file, f"{told} {accuracy}")
        if isinstance(found, str):
            reason = found
        elif not found["energy"] > 0:
            return "no energy"
        elif (k_scale := scale(data, found), beyond := doubt(found, k_scale))[1] <= 1:
            return entry(found, k_scale, f"{told} {accuracy}".strip())
        else:
            reason = f"its error is {beyond:.1f} times the limit"
    return reason


def entry(found, k_scale, options):
    tips = [{key: t[key] for key in ("crack", "end", "k1", "k2", "k1_error", "k2_error")}
            for t in found["tips"] if "k1" in t]
    return {key: found[key] for key in ("energy", "energy_error")} | {"k_scale": k_scale, "options": options, "tips": tips}


def version(program):
    """What made the values."""
    digest = hashlib.sha256(program.read_bytes()).hexdigest()[:12]
    return f"{program.stem} {digest}, NGSolve {importlib.metadata.version('ngsolve')}"


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("program", type=pathlib.Path)
    parser.add_argument("numbers", type=int, nargs="*", help="problems to be done (again)")
    parser.add_argument("--count", type=int, default=200, help="how many problems shall have values")
    options = parser.parse_args()
    known = json.loads(VALUES.read_text()) if VALUES.exists() else {"reference": "", "problems": {}, "left_out": {}}
    known["reference"] = version(options.program)
    todo = iter(options.numbers or (n for n in range(10**6) if f"{n:03}" not in known["problems"] | known["left_out"]))
    with tempfile.TemporaryDirectory() as folder:
        for number in todo:
            if not options.numbers and len(known["problems"]) >= options.count:
                break
            found, name = values(options.program, number, folder), f"{number:03}"
            for group in ("problems", "left_out"):
                known[group].pop(name, None)
            known["left_out" if isinstance(found, str) else "problems"][name] = found
            print(name, found if isinstance(found, str) else found["options"] or "ok", flush=True)
            save(known)


def save(known):
    """Writes values.json, one line per problem."""
    groups = []
    for group in ("problems", "left_out"):
        lines = [f'  "{name}": {json.dumps(found)}' for name, found in sorted(known[group].items())]
        groups.append(f' "{group}": {{\n' + ",\n".join(lines) + "\n }")
    VALUES.write_text(f'{{\n "reference": {json.dumps(known["reference"])},\n' + ",\n".join(groups) + "\n}\n")


if __name__ == "__main__":
    main()
