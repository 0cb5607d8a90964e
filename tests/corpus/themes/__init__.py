"""The themes of the corpus: one module each, with a list CASES."""

import importlib

from themes.tables import TABLES

NAMES = [
    "arithmetic", "functions", "comparisons", "kinks", "half_angle", "westergaard", "williams",
    "weights", "quantities", "tables", "spicy",
]  # fmt: skip


def all():
    """Name and cases of each theme."""
    for name in NAMES:
        yield name, importlib.import_module(f"themes.{name}").CASES
