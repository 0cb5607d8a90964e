"""Things of one kind in tables, and numbers by name."""

import operator
from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import fields
from typing import Any, Generic, Self, SupportsIndex, TypeVar, overload

import numpy as np

from ._errors import MissingKey, require
from ._text import hint, html_row, plural

_Row = TypeVar("_Row")


class Numbered(tuple[_Row, ...], Generic[_Row]):
    """A tuple of things numbered from 0; errors tell how many there are."""

    #: What one of them is called, and several.
    _called: tuple[str, str]

    def __new__(cls, things: Iterable[_Row] = (), one: str = "row", more: str | None = None) -> Self:
        made = super().__new__(cls, things)
        made._called = one, more or one + "s"
        return made

    @overload
    def __getitem__(self, key: SupportsIndex, /) -> _Row: ...

    @overload
    def __getitem__(self, key: slice, /) -> tuple[_Row, ...]: ...

    def __getitem__(self, key: SupportsIndex | slice, /) -> _Row | tuple[_Row, ...]:
        return super().__getitem__(key if isinstance(key, slice) else self._number(key))

    def _number(self, key: SupportsIndex) -> int:
        """Return a number counted from the first one."""
        number, count = operator.index(key), len(self)
        if not -count <= number < count:
            one, more = self._called
            there = f"there {'is' if count == 1 else 'are'} {plural(count, one, more)}"
            raise IndexError(f"there is no {one} {number}: {there}, numbered from 0")
        return number % count


class Table(Numbered[_Row]):
    """A tuple of rows of one kind, which pandas and notebooks show as a table.

    Example:
        >>> [tip.end for tip in ds.tips]
        ['start', 'end']
    """

    def to_pandas(self) -> Any:
        """Return the rows as a `pandas.DataFrame`, without attributes that are arrays."""
        pandas = require("pandas", "pandas", "tables")
        return pandas.DataFrame(self._records(), columns=self._columns() or None)

    def _columns(self) -> list[str]:
        plain = ((f.name, first) for first in self[:1] for f in fields(first))  # type: ignore[arg-type]
        return [n for n, first in plain if not isinstance(getattr(first, n), (np.ndarray, Table))]

    def _records(self) -> list[dict[str, Any]]:
        columns = self._columns()
        return [{name: getattr(row, name) for name in columns} for row in self]

    def _repr_html_(self) -> str:
        columns = self._columns()
        body = "".join(html_row(_short(row[c]) for c in columns) for row in self._records())
        return f"<table><thead>{html_row(columns, 'th')}</thead><tbody>{body}</tbody></table>"


def _short(value: Any) -> str:
    if isinstance(value, tuple):
        return "(" + ", ".join(_short(v) for v in value) + ")"
    return f"{value:.6g}" if isinstance(value, float) else str(value)


class History(Mapping[str, float]):
    """The numbers of the solver's report by name: unknowns, residual, energy, seconds of each phase.

    `unit` has their units. Of several numbers with one name the first one counts; `records` has all.
    """

    def __init__(self, records: Sequence[tuple[str, float, str]]) -> None:
        self.records = tuple(records)
        self._first = {name: (value, unit) for name, value, unit in reversed(self.records)}

    def __getitem__(self, name: str) -> float:
        return self._of(name)[0]

    def __iter__(self) -> Iterator[str]:
        return iter(dict.fromkeys(name for name, _, _ in self.records))

    def __len__(self) -> int:
        return len(self._first)

    def unit(self, name: str) -> str:
        """Return the unit of a number, e.g. ``s``; empty for plain numbers."""
        return self._of(name)[1]

    def _of(self, name: str) -> tuple[float, str]:
        if name not in self._first:
            raise MissingKey(f"the history has no `{name}`; {hint(name, self._first)}")
        return self._first[name]

    def __repr__(self) -> str:
        return f"<ppum.History {', '.join(f'{name} {self[name]:.6g}' for name in self)}>"

    def _repr_html_(self) -> str:
        rows = (html_row((name, f"{value:.6g}", unit)) for name, value, unit in self.records)
        return f"<table><tbody>{''.join(rows)}</tbody></table>"
