#!/usr/bin/env python3
"""Draws the frame of a centre crack by peers and by ppum, and writes what each takes as a table.

    python3 -m venv target/peers/venv && target/peers/venv/bin/pip install -r tools/peers/requirements.txt
    cargo build --release
    target/peers/venv/bin/python tools/peers/run.py                                  prints JSON and the table
    target/peers/venv/bin/python tools/peers/run.py --page docs/performance.md       puts the table there

ParaView is in no registry of Python packages; where `pvpython` and `xvfb-run` are installed (on Debian the packages
python3-paraview and xvfb) it is measured too.
"""

import argparse
import json
import shutil
import subprocess
import sys
from pathlib import Path

import numpy as np
from PIL import Image
from sampled import GRID, cell_points

from common import PIXELS, VIEWS

HERE = Path(__file__).resolve().parent
ROOT = HERE.parent.parent
MARKS = "<!-- begin tools/peers/run.py -->", "<!-- end tools/peers/run.py -->"


def arguments():
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("--ppum", type=Path, default=ROOT / "target/release/ppum", help="the program")
    parser.add_argument("--folder", type=Path, default=ROOT / "target/peers", help="for datasets and pictures")
    parser.add_argument("--frames", type=int, default=15, help="frames that are drawn of each kind")
    parser.add_argument("--page", type=Path, help="page in Markdown that takes the table")
    return parser.parse_args()


def called(*words):
    """What a command prints."""
    return subprocess.run([*map(str, words)], check=True, capture_output=True, text=True).stdout


def prepare(ppum, folder):
    """The dataset, the right pictures, and what is sampled for those that cannot evaluate it."""
    call = lambda *words: called(ppum, *words)
    plate = folder / "plate.h5"
    call("solve", ROOT / "examples/centre-crack.toml", "-o", plate)
    drawn(ppum, folder, "cpu f64")
    call("sample", plate, "--grid", f"{GRID}x{GRID}", "-q", "von-mises", "-o", folder / "grid.npy")
    np.savetxt(folder / "cells.csv", cell_points().reshape(-1, 2), delimiter=",", fmt="%.17g")
    call("sample", plate, "--points", folder / "cells.csv", "-q", "von-mises", "-o", folder / "cells.npy")


# The options of `ppum render` for the methods of `ppum-bench`.
METHODS = {
    "cpu f64": ["--backend", "cpu"],
    "cpu f32": ["--backend", "cpu", "--precision", "f32"],
    "gather": ["--backend", "gpu"],
    "splat": ["--backend", "splat"],
}


def drawn(ppum, folder, method):
    """Draws both views; the names of the pictures."""
    pictures = {view: f"ppum-{method.replace(' ', '-')}-{view}.png" for view in VIEWS}
    for view, ((x, y), height, most) in VIEWS.items():
        columns, rows = PIXELS
        half = height / 2 * columns / rows, height / 2
        box = ",".join(map(repr, (x - half[0], y - half[1], x + half[0], y + half[1])))
        how = ["--size", f"{columns}x{rows}", f"--view={box}", "--range", f"0,{most}", *METHODS[method]]
        called(ppum, "render", folder / "plate.h5", "-o", folder / pictures[view], *how)
    return pictures


def own(ppum, folder, frames):
    """Frames of ppum: by every method on all threads, and by the CPU on one."""
    versions = {"ppum": called(ppum, "--version").split()[-1]}
    bench = Path(ppum).with_name("ppum-bench")
    result = json.loads(called(bench, "frames", folder / "plate.h5", "--frames", frames, "--json"))
    machine = result["machine"]
    for threads, number in (("one", 1), ("all", machine["threads"])):
        for timed in result["methods"]:
            method, spent = timed["method"], timed[threads]
            by = f"threads: {number}" if method.startswith("cpu") else machine["adapter"]["name"]
            if spent:
                yield {
                    "name": f"ppum, the field itself, {method}; {by}",
                    "versions": versions,
                    "pictures": drawn(ppum, folder, method),
                    "data": spent,
                    "view": spent,
                }


def peers(folder, frames):
    """What the scripts report, each a program of its own."""
    commands = [[sys.executable, HERE / "numpy_frame.py"], [sys.executable, HERE / "vtk_frames.py"]]
    if shutil.which("pvpython") and shutil.which("xvfb-run"):
        commands.append(["xvfb-run", "-a", "pvpython", HERE / "paraview_frames.py"])
    else:
        print("without ParaView: pvpython or xvfb-run is missing", file=sys.stderr)
    for command in commands:
        lines = called(*command, folder, frames).splitlines()
        yield from (json.loads(line) for line in lines if line.startswith("{"))


def differs(path, right):
    """Share of the plate's pixels of which a colour is more than 16 of 255 off."""
    found, expected = (np.asarray(Image.open(p).convert("RGB")).astype(int) for p in (path, right))
    columns, rows = PIXELS
    plate = slice((columns - rows) // 2 + 2, (columns + rows) // 2 - 2)
    return float((np.abs(found - expected).max(axis=2) > 16)[:, plate].mean())


def table(rows):
    lines = ["| what draws | data new [ms] | view new [ms] | processor [ms] | wrong, whole | wrong, tip | versions |"]
    lines.append("| --- | ---: | ---: | ---: | ---: | ---: | --- |")
    for row in rows:
        ms = lambda key, time: "{:.1f} / {:.1f}".format(*(row[key][time][k] for k in ("least", "median")))
        core = ms("data", "core_ms") if row["data"]["core_ms"] else ""
        wrong = [share(row["differs"][view]) for view in VIEWS]
        versions = ", ".join(f"{k} {v}" for k, v in row["versions"].items())
        cells = [row["name"], ms("data", "wall_ms"), ms("view", "wall_ms"), core, *wrong, versions]
        lines.append("| " + " | ".join(cells) + " |")
    return "\n".join(lines)


def share(part):
    """A part as per cent, with two digits."""
    return "0" if part == 0 else f"{100 * part:.2g} %" if part >= 1e-4 else "< 0.01 %"


def put(page, text):
    """Replaces what stands between the marks of a page."""
    before, rest = page.read_text().split(MARKS[0])
    _, after = rest.split(MARKS[1])
    page.write_text(f"{before}{MARKS[0]}\n\n{text}\n\n{MARKS[1]}{after}")


def main():
    given = arguments()
    given.folder.mkdir(parents=True, exist_ok=True)
    prepare(given.ppum, given.folder)
    rows = [*own(given.ppum, given.folder, given.frames), *peers(given.folder, given.frames)]
    for row in rows:
        pictures = row["pictures"].items()
        row["differs"] = {v: differs(given.folder / p, given.folder / f"ppum-cpu-f64-{v}.png") for v, p in pictures}
    json.dump(rows, sys.stdout, indent=2)
    print("\n\n" + table(rows))
    if given.page:
        put(given.page, table(rows))


main()
