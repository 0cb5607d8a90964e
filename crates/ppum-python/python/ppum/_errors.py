"""The exceptions of ppum.

Each is a `PpumError` and, beside that, one of the classes that people catch. All can be pickled.
"""

import importlib
from dataclasses import dataclass
from typing import Any

from ._warnings import with_old_names

class PpumError(Exception):
    """The base of all exceptions of ppum, except for files (`OSError`) and numbers of steps, cracks and tips (`IndexError`)."""


class BuildError(PpumError, ValueError):
    """Arrays that make no dataset, or another field than the one that was meant."""


class FormatError(PpumError, ValueError):
    """A file that is no dataset, or a damaged one."""


class QuantityError(PpumError, ValueError):
    """An unknown quantity, a wrong formula, a part or a replacement that the field cannot have."""


class RenderError(PpumError, ValueError):
    """An image that cannot be drawn: a view without width, a range that does not fit."""


class SolveError(PpumError, RuntimeError):
    """A problem that cannot be solved, with the reason and a remedy."""


class InternalError(PpumError, RuntimeError):
    """A bug in ppum; please report it."""


class MissingKey(KeyError):
    """A key that a mapping does not have, with those that it has."""

    def __str__(self) -> str:
        return str(self.args[0])


@dataclass(frozen=True)
class Diagnostic:
    """An error in a problem.

    Attributes:
        place: The file, or the key of a problem made in Python, e.g. ``crack[0]``.
        line: Line in the file, from 1; none where there is no file.
        column: Column in characters, from 1.
        message: The error, and the remedy.
    """

    place: str
    line: int | None
    column: int | None
    message: str

    def __str__(self) -> str:
        where = [self.place, *(str(n) for n in (self.line, self.column) if n is not None)]
        return f"{':'.join(where)}: {self.message}"


@with_old_names
class ProblemError(PpumError, ValueError):
    """A problem with errors, all of which are in `diagnostics`."""

    def __init__(self, message: str, diagnostics: list[Any] | None = None) -> None:
        #: The mistakes, in the order of the problem.
        self.diagnostics: list[Diagnostic] = [f if isinstance(f, Diagnostic) else Diagnostic(*f) for f in diagnostics or []]
        super().__init__(message, self.diagnostics)

    __str__ = MissingKey.__str__


def require(package: str, remedy: str, what: str, by: str = "pip install") -> Any:
    """Import a package that `what` needs; without it raise an `ImportError` that says how to get it."""
    try:
        return importlib.import_module(package)
    except ImportError as error:
        raise ImportError(f"{what} need {package.split('.')[0]}: {by} {remedy}") from error
