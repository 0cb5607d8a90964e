"""The command that comes with the package is the program, but for graphics cards and the window."""

import os
import signal
import subprocess
import sys
import time

import ppum


def ppum_command(folder, *arguments):
    """The exit status of the command, what it printed, and its messages."""
    words = [sys.executable, "-m", "ppum", *map(str, arguments)]
    done = subprocess.run(words, cwd=folder, capture_output=True, text=True)
    return done.returncode, done.stdout, done.stderr


def test_files_and_output_are_those_of_the_program(program, problem, tmp_path):
    (tmp_path / "plate.toml").write_text(problem.to_toml())
    options = ["--size", "64x48"]
    for kind, run in {"here": lambda *words: ppum_command(tmp_path, *words)[1], "there": program}.items():
        dataset, image = tmp_path / f"{kind}.h5", tmp_path / f"{kind}.png"
        run("solve", tmp_path / "plate.toml", "-o", dataset)
        run("render", tmp_path / "here.h5", "-o", image, *options)
    # but for the seconds that the solver took
    assert ppum.open(tmp_path / "here.h5") == ppum.open(tmp_path / "there.h5")
    here, there = (ppum_command(tmp_path, "probe", f"{kind}.h5", "--at", "0,0.1") for kind in ("here", "there"))
    assert here == there and here[0] == 0 and "von-mises" in here[1]
    assert (tmp_path / "here.png").read_bytes() == (tmp_path / "there.png").read_bytes()


def test_exit_statuses(tmp_path):
    assert ppum_command(tmp_path, "--version") == (0, f"ppum {ppum.__version__}\n", "")
    status, _, message = ppum_command(tmp_path, "info", "none.h5")
    assert status == 1 and message.startswith("error: cannot read none.h5")
    status, _, message = ppum_command(tmp_path, "sovle")
    assert status == 2 and "solve" in message
    status, _, message = ppum_command(tmp_path, "view")
    assert status == 1 and "without the window" in message


def test_the_demonstration(tmp_path):
    status, told, message = ppum_command(tmp_path, "demo", "-o", "out")
    assert status == 0, message
    assert {path.suffix for path in (tmp_path / "out").iterdir()} == {".toml", ".h5", ".png"}
    # commands to go on with name the program, not the interpreter
    assert "python" not in told


def test_a_signal_ends_it_and_leaves_no_part(tmp_path, problem):
    large = problem.discretization(cells=(256, 512), order=3)
    (tmp_path / "large.toml").write_text(large.to_toml())
    words = [sys.executable, "-m", "ppum", "solve", "large.toml"]
    process = subprocess.Popen(words, cwd=tmp_path, stdout=subprocess.PIPE, stderr=subprocess.PIPE)
    time.sleep(2)
    process.send_signal(signal.SIGINT)
    assert process.wait(timeout=60) == -signal.SIGINT
    assert os.listdir(tmp_path) == ["large.toml"]
