"""Problems as the text of problem files."""

from __future__ import annotations

import os
from collections.abc import Iterable, Mapping
from typing import Any

import numpy as np

__all__ = ["plain", "written"]


def plain(value: Any, place: str = "a problem") -> Any:
    """Values that TOML has; frozen data are copied. `place` is that of the value, for messages."""
    if isinstance(value, Mapping):
        return {str(k): plain(v, f"{place}.{k}".removeprefix("a problem.")) for k, v in value.items() if v is not None}
    if isinstance(value, np.ndarray):
        return plain(value.tolist(), place)
    if isinstance(value, np.generic):
        return plain(value.item(), place)
    if isinstance(value, (bool, int, float, str)):
        return value
    if isinstance(value, os.PathLike):
        return os.fspath(value)
    if isinstance(value, Iterable):
        return [plain(v, f"{place}[{k}]") for k, v in enumerate(value)]
    raise TypeError(f"{place}: is {type(value).__name__}; give real numbers, texts, lists or dictionaries")


def written(spec: Mapping[str, Any]) -> tuple[str, list[str]]:
    """The text of a problem file, and the key of each of its lines."""
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
    plain = name and all(c.isascii() and (c.isalnum() or c in "_-") for c in name)
    return name if plain else _text(name)


def _value(value: Any) -> str:
    if isinstance(value, bool):
        return "true" if value else "false"
    if isinstance(value, (int, float)):
        return repr(value)
    if isinstance(value, str):
        return _text(value)
    if isinstance(value, dict):
        return "{" + ", ".join(f"{_key(k)} = {_value(v)}" for k, v in value.items()) + "}"
    return "[" + ", ".join(_value(v) for v in value) + "]"


_ESCAPES = {'"': '\\"', "\\": "\\\\", "\n": "\\n", "\t": "\\t", "\r": "\\r"}


def _text(text: str) -> str:
    escaped = (
        _ESCAPES.get(c) or (f"\\u{ord(c):04x}" if ord(c) < 32 or ord(c) == 127 else c) for c in text
    )
    return '"' + "".join(escaped) + '"'
