"""Texts: words that are near others, counts, labels; problems as the text of problem files."""

import difflib
import html
import json
import os
import re
import sys
from collections.abc import Iterable, Mapping, Sequence
from typing import Any

import numpy as np


def nearest(name: str, known: Iterable[str]) -> str | None:
    """Return the known word that a word is most like, if there is one."""
    by_lower = {word.lower(): word for word in known}
    found = difflib.get_close_matches(name.lower(), by_lower, n=1, cutoff=0.7)
    return by_lower[found[0]] if found else None


def hint(name: str, known: Iterable[str]) -> str:
    """Suggest a name in place of an unknown one."""
    known = list(known)
    near = nearest(name, known)
    return f"did you mean `{near}`?" if near else f"there are {', '.join(known)}"


def one_of(name: str, value: str, words: Sequence[str], others: str = "") -> None:
    if value in words:
        return
    known = ", ".join(repr(word) for word in words)
    near = nearest(value, words)
    meant = f"; did you mean {near!r}?" if near else ""
    raise ValueError(f"{name}: {value!r} is not one of {known}{others}{meant}")


def plural(count: int, one: str, more: str | None = None) -> str:
    return f"{count} {one if count == 1 else more or one + 's'}"


def math_text(symbol: str) -> str:
    """Return a symbol with its subscripts as matplotlib's mathtext; words stay words."""
    return re.sub(r"_\{(.*?)\}", r"$_{\1}$", symbol)


def plain(value: Any, place: str = "a problem") -> Any:
    """Copy data as types that TOML and JSON have; `place` is that of the value, for messages."""
    if isinstance(value, Mapping):
        return {str(k): plain(v, f"{place}.{k}".removeprefix("a problem.")) for k, v in value.items() if v is not None}
    if isinstance(value, (np.ndarray, np.generic)):
        return plain(value.tolist(), place)
    if isinstance(value, (bool, int, float, str)):
        return value
    if isinstance(value, os.PathLike):
        return os.fspath(value)
    if isinstance(value, Iterable):
        return [plain(v, f"{place}[{k}]") for k, v in enumerate(value)]
    raise TypeError(f"{place}: is {type(value).__name__}; give real numbers, texts, lists or dictionaries")


def toml_lines(spec: Mapping[str, Any]) -> tuple[str, list[str]]:
    """Return the text of a problem file, and the key of each of its lines."""
    lines: list[tuple[str, str]] = []
    for name, value in spec.items():
        if not isinstance(value, dict) and not _is_tables(value):
            lines.append((f"{_key(name)} = {_value(value)}", name))
    for name, value in spec.items():
        if isinstance(value, dict):
            _section(lines, f"[{_key(name)}]", name, value)
        elif _is_tables(value):
            for k, one in enumerate(value):
                _section(lines, f"[[{_key(name)}]]", f"{name}[{k}]", one)
    text = "".join(line + "\n" for line, _ in lines)
    return text, [key for _, key in lines]


def _section(lines: list[tuple[str, str]], head: str, place: str, keys: dict[str, Any]) -> None:
    lines.append((head, place))
    lines.extend((f"{_key(k)} = {_value(v)}", f"{place}.{k}") for k, v in keys.items())


def _is_tables(value: Any) -> bool:
    return isinstance(value, list) and bool(value) and all(isinstance(v, dict) for v in value)


def _key(name: str) -> str:
    return name if re.fullmatch(r"[A-Za-z0-9_-]+", name) else _text(name)


def _value(value: Any) -> str:
    if isinstance(value, dict):
        return "{" + ", ".join(f"{_key(k)} = {_value(v)}" for k, v in value.items()) + "}"
    if isinstance(value, list):
        return "[" + ", ".join(_value(v) for v in value) + "]"
    return repr(value) if isinstance(value, float) else _text(value)


class ProgressLine:
    """A line of standard error that is written again and again."""

    def __init__(self) -> None:
        self._width = 0

    def write(self, text: str, end: str = "") -> None:
        sys.stderr.write("\r" + text.ljust(self._width) + end)
        sys.stderr.flush()
        self._width = len(text)

    def solving(self, phase: str, done: int, total: int, step: int) -> None:
        of = f" {100 * done // max(total, 1):3d} %" if total > 1 else ""
        self.write(f"{f'step {step}  ' if step else ''}{phase}{of}")

    def solved(self, done: int, total: int) -> None:
        self.write(f"{done} of {total} solved", "\n" if done == total else "")

    def clear(self) -> None:
        self.write("", "\r")


def html_row(cells: Iterable[str], kind: str = "td") -> str:
    return f"<tr>{''.join(f'<{kind}>{html.escape(cell)}</{kind}>' for cell in cells)}</tr>"


def _text(value: Any) -> str:
    """Return a basic string, integer or truth value: that of JSON, which leaves one character of control as it is."""
    return json.dumps(value, ensure_ascii=False).replace("\x7f", "\\u007f")
