"""Runs the commands of docs/export.md, page.md, faq.md and trust.md in an empty folder with the README's problem, and
compares the tables of docs/trust.md and exact.md with what the program prints.

    python tests/python/test_pages.py          (from the repository's root; or: pytest tests/python)

Needs cargo, see programs.py.
"""

import json
import math
import pathlib
import re
import shlex
import subprocess
import sys
import tempfile

sys.path.insert(0, str(pathlib.Path(__file__).parent))
import programs

ROOT = pathlib.Path(__file__).parents[2]
README = (ROOT / "README.md").read_text()
PROBLEM = re.search(r"```toml\n(.*?)```", README, re.DOTALL)[1]
GROWTH = PROBLEM.replace("cells = [16, 32]", "cells = [8, 16]") + "\n[growth]\nsteps = 2\nincrement = 0.05\n"


def page(name):
    return (ROOT / "docs" / name).read_text()


def commands(text):
    """The commands of indented blocks, and those in a line that write a file."""
    inline = re.findall(r"`(ppum [^`]*)`", re.sub(r"\s*\n\s*", " ", text))
    return re.findall(r"^    (ppum .*)$", text, re.MULTILINE) + [line for line in inline if " -o " in line]


def run(folder, *words, codes=(0,)):
    """Runs a command on the files of a folder; cargo runs at the root, so names of files get the folder in front."""
    paths = [folder / word if re.search(r"\.\w+$", word) and not re.match(r"[-\d.]", word) else word for word in words]
    done = subprocess.run(programs.ppum(*paths), cwd=ROOT, capture_output=True, text=True)
    assert done.returncode in codes, (words, done.stderr)
    return done.stdout + done.stderr


def solve(folder, problem, name="plate"):
    (folder / f"{name}.toml").write_text(problem)
    return run(folder, "solve", f"{name}.toml")


def test_commands_of_guides_run():
    with tempfile.TemporaryDirectory(prefix="ppum-") as name:
        folder = pathlib.Path(name)
        solve(folder, PROBLEM)
        solve(folder, GROWTH, "growth")
        (folder / "out").mkdir()
        (folder / "out/centre-crack.h5").symlink_to(folder / "plate.h5")
        count, printed = 0, ""
        for text in map(page, ["export.md", "page.md", "faq.md", "trust.md"]):
            for command in commands(text):
                words = shlex.split(command)[1:]
                # 3: a mesh that does not keep its tolerance, which is written
                printed += run(folder, *words, codes=(0, 3))
                assert (folder / words[words.index("-o") + 1]).stat().st_size > 100, command
                count += 1
        assert count >= 11
        assert "slope −0.500" in printed


def test_the_worked_example_of_trust():
    text, heads = page("trust.md"), PROBLEM.index("[discretization]")
    rows = re.findall(r"^\| (`.*?`) \| ([\d,]+) \| ([\d.]+) \| ([\d.]+) \| .* \|$", text, re.MULTILINE)
    assert len(rows) == 7
    with tempfile.TemporaryDirectory(prefix="ppum-") as name:
        folder = pathlib.Path(name)
        for settings, unknowns, k1, k2 in rows:
            keys = "\n".join(re.findall(r"`(.*?)`", settings))
            solve(folder, f"{PROBLEM[:heads]}[discretization]\n{keys}\n")
            tips = json.loads(run(folder, "sif", "plate.h5", "--json"))["tips"]
            assert math.isclose(tips[0]["k1"], float(k1), rel_tol=2e-6), (settings, tips[0]["k1"])
            assert math.isclose(tips[0]["k2"], float(k2), rel_tol=2e-6), (settings, tips[0]["k2"])
            about = json.loads(run(folder, "info", "plate.h5", "--json"))
            assert about["steps"][-1]["unknowns"] == int(unknowns.replace(",", "")), settings


def test_the_covers_of_exact():
    rows = re.findall(r"^\| (\d+) × (\d+) \| ([\d.]+) \| .*? \| ([\d.]+) \| ([\d.]+) \|$", page("exact.md"), re.MULTILINE)
    assert len(rows) == 3
    with tempfile.TemporaryDirectory(prefix="ppum-") as name:
        folder = pathlib.Path(name)
        for columns, lines, k1, uy, stress in rows:
            solve(folder, PROBLEM.replace("[16, 32]", f"[{columns}, {lines}]"))
            values = json.loads(run(folder, "probe", "plate.h5", "--at", "0.5,0.25", "-q", "uy,von-mises", "--json"))
            found = values["points"][0]["values"]
            assert math.isclose(found["uy"], float(uy), rel_tol=1e-9), found
            assert math.isclose(found["von-mises"], float(stress), rel_tol=1e-9), found
            tips = json.loads(run(folder, "sif", "plate.h5", "--json"))["tips"]
            assert math.isclose(tips[1]["k1"], float(k1), rel_tol=2e-6)


if __name__ == "__main__":
    for test in [test_commands_of_guides_run, test_the_worked_example_of_trust, test_the_covers_of_exact]:
        test()
        print(f"ok  {test.__name__}")
