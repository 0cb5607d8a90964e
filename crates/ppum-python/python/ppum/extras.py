"""Packages that parts of ppum need beyond numpy."""

from __future__ import annotations

import importlib
from typing import Any


def needed(package: str, remedy: str, what: str, by: str = "pip install") -> Any:
    """A package that `what` needs; without it an `ImportError` that says how to get it."""
    try:
        return importlib.import_module(package)
    except ImportError as error:
        raise ImportError(f"{what} need {package.split('.')[0]}: {by} {remedy}") from error
