"""The command ``ppum``: the program without graphics cards and window."""

import sys

from . import _core


def main() -> int:
    """Run the program with the arguments of this process.

    Returns:
        The exit status.
    """
    return _core.command(["ppum", *sys.argv[1:]])
