"""Types of results: what fields, datasets and comparisons give, which nobody makes."""

from ._compare import Comparison, Needed, Norms, Resampling
from ._export import ArrayAccuracy
from ._facts import Advance, Growth, Reaction, Warning
from ._sample import Extremum
from ._tables import History, Table
from ._values import Quantity, Values

__all__ = [
    "Advance", "ArrayAccuracy", "Comparison", "Extremum", "Growth", "History", "Needed", "Norms", "Quantity", "Reaction",
    "Resampling", "Table", "Values", "Warning",
]  # fmt: skip
