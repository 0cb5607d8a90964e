"""The programs that the tests run.

Cargo builds them, alone: with other features of foreign crates than all tests together, so nearly everything is compiled again.
Where PPUM_PROGRAMS names a folder, such as `target/release` after `cargo test --release --workspace`, they are taken as they lie there.
"""

import os
import pathlib

ROOT = pathlib.Path(__file__).parents[2]
BUILT = os.environ.get("PPUM_PROGRAMS")


def ppum(*arguments):
    """A command of the program."""
    start = [ROOT / BUILT / "ppum"] if BUILT else ["cargo", "run", "-q", "--release", "--"]
    return [str(word) for word in (*start, *arguments)]


def fixture(*arguments):
    """A command of the example `fixture` of `ppum-bench`."""
    cargo = ["cargo", "run", "-q", "--release", "-p", "ppum-bench", "--example", "fixture", "--"]
    start = [ROOT / BUILT / "examples" / "fixture"] if BUILT else cargo
    return [str(word) for word in (*start, *arguments)]
