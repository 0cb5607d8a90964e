"""Runs the Python of README.md and docs/tour.md as printed, on the dataset of the README's problem, and compares the
output that the README prints with that of the program, and the numbers of docs/from-other-programs.md with those of
its examples.

    pip install -r tests/python/requirements.txt
    python tests/python/test_readme.py          (from the repository's root; or: pytest tests/python)

Needs cargo: the problem is solved by the program (see programs.py). What imports the package `ppum` runs where that is installed.
"""

import importlib.util
import json
import math
import pathlib
import re
import subprocess
import sys
import tempfile

sys.path.insert(0, str(pathlib.Path(__file__).parent))
import programs

ROOT = pathlib.Path(__file__).parents[2]
README = (ROOT / "README.md").read_text()
TOUR = (ROOT / "docs/tour.md").read_text()
OTHERS = (ROOT / "docs/from-other-programs.md").read_text()


def blocks(page, language):
    return re.findall(rf"```{language}\n(.*?)```", page, re.DOTALL)


def solve(folder):
    """Solves the README's problem in a folder, and returns the command's output."""
    (folder / "plate.toml").write_text(blocks(README, "toml")[0])
    return run(folder, "solve", "plate.toml")


def run(folder, *arguments):
    """Runs a command on the files of a folder, and returns its output as if it had run there; cargo runs at the root."""
    paths = [folder / word if word.startswith("plate.") else word for word in arguments]
    done = subprocess.run(programs.ppum(*paths), cwd=ROOT, check=True, capture_output=True, text=True)
    return done.stdout.replace(f"{folder}/", "")


def words(output):
    """The words of an output with numbers as numbers; the seconds of a run are left out."""

    def value(word):
        try:
            return float(word.strip("(),;°"))
        except ValueError:
            return word

    return [value(word) for word in re.sub(r"[0-9.]+ s;", "", output).split()]


def test_readme_prints_the_output_of_its_first_commands():
    with tempfile.TemporaryDirectory(prefix="ppum-") as name:
        folder = pathlib.Path(name)
        solved = solve(folder)
        command = re.search(r"^ppum (probe [^#]+)", README, re.MULTILINE)[1]
        printed, computed = words(blocks(README, "text")[0]), words(solved + run(folder, *command.split()))
    assert len(printed) == len(computed) > 50
    for expected, value in zip(printed, computed, strict=True):
        same = math.isclose(expected, value, rel_tol=1e-6) if isinstance(expected, float) else expected == value
        assert same, f"README: {expected}, the program: {value}"


def test_readme_snippets_run():
    with tempfile.TemporaryDirectory(prefix="ppum-") as name:
        folder = pathlib.Path(name)
        solve(folder)
        (folder / "tests").symlink_to(ROOT / "tests")
        snippets = blocks(README, "python") + blocks(TOUR, "python")
        assert len(snippets) == 3
        for snippet in snippets:
            if re.search(r"import .*\bppum\b", snippet) and importlib.util.find_spec("ppum") is None:
                print("SKIPPED 1 (so far): README's use of the package: it is not installed")
                continue
            done = subprocess.run([sys.executable, "-c", snippet], cwd=folder, capture_output=True, text=True)
            assert done.returncode == 0, done.stderr
            assert done.stdout and not done.stderr, done.stderr
        assert "Slanted crack" in subprocess.run(
            [sys.executable, "-c", snippets[1]], cwd=folder, capture_output=True, text=True
        ).stdout


def test_examples_for_users_of_other_programs_give_the_stated_values():
    stated = [("1583.65", "2e-5", 0), ("62.119", "7e-3", -1), ("0.1157", "5e-4", 0), ("121.9", None, -1)]
    with tempfile.TemporaryDirectory(prefix="ppum-") as name:
        folder = pathlib.Path(name)
        for problem, (number, estimate, tip) in zip(blocks(OTHERS, "toml"), stated, strict=True):
            (folder / "plate.toml").write_text(problem)
            run(folder, "solve", "plate.toml")
            tips = json.loads(run(folder, "sif", "plate.h5", "--json"))["tips"]
            key = "k2" if "contact" in problem else "k1"
            assert math.isclose(abs(tips[tip][key]), float(number), rel_tol=5e-4), (number, tips[tip])
            assert number in OTHERS
            relative = tips[tip]["error"] / math.hypot(tips[tip]["k1"], tips[tip]["k2"])
            error = f"{relative:.0e}".replace("e-0", "e-")
            assert estimate is None or (error == estimate and f"error of {error}" in OTHERS), error


def test_citation_has_the_version_of_the_workspace():
    version = re.search(r'^version = "(.*)"', (ROOT / "Cargo.toml").read_text(), re.MULTILINE)[1]
    assert f"\nversion: {version}\n" in (ROOT / "CITATION.cff").read_text()


if __name__ == "__main__":
    for test in [
        test_readme_snippets_run,
        test_readme_prints_the_output_of_its_first_commands,
        test_examples_for_users_of_other_programs_give_the_stated_values,
        test_citation_has_the_version_of_the_workspace,
    ]:
        test()
        print(f"ok  {test.__name__}")
