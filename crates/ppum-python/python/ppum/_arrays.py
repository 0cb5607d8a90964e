"""Arrays of the file format: types, shapes, texts; and the arguments of `ppum.build` that they are made of."""

import re
from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ._checks import indexed, known
from ._errors import BuildError

#: Types of arrays that are not f64 or texts, by the last part of their paths.
TYPES = {
    "block_degree": "u1", "block_space": "u1", "clip_side": "u1", "level": "u1", "map_degree": "u1", "map_space": "u1",
    "shape": "u1", "block_function": "u4", "clip_field": "u4", "element": "u4", "patch_blocks": "u4", "block_offset": "u8",
    "clip_offsets": "u8", "map_offset": "u8", "levels": "i8",
    "offsets": "u8", "cut_offsets": "u8", "kink_offsets": "u8", "parameter_offsets": "u8", "path_offsets": "u8",
    "ring_offsets": "u8", "singular_offsets": "u8", "cuts": "i8", "other": "i8", "point": "i8",
    "functions/crack": "i8", "crack": "u4",
}  # fmt: skip

#: Arrays of texts, also if they are empty.
TEXTS = {
    "components", "end", "ends", "exact", "fate", "formula", "frame", "frame_end", "kind", "message", "name", "on",
    "parameter_name", "role", "unit",
}  # fmt: skip


def packed(path: str, value: Any) -> tuple[str, list[int], NDArray[Any] | list[str]]:
    """Return path, shape and row-major values."""
    parts = path.split("/")
    name = parts[-1]
    if name in TEXTS or "@" not in name and _is_text(value) or isinstance(value, str):
        return _texts(path, value)
    kind = TYPES.get("/".join(parts[-2:])) or TYPES.get(name, "f8")
    given = known(path, value)
    with np.errstate(invalid="ignore", over="ignore"):
        array = np.ascontiguousarray(given, kind)
    wrong = np.argwhere(array != given) if kind != "f8" else np.empty((0, 0))
    if len(wrong):
        at = tuple(wrong[0])
        raise BuildError(f"{indexed(path, at)}: is {given[at]}, which is no number of the type {np.dtype(kind)}")
    return path, list(given.shape), array.reshape(-1)


def _is_text(value: Any) -> bool:
    try:
        return np.asarray(value).dtype.kind in "US"
    except ValueError:
        return False


def _texts(path: str, value: Any) -> tuple[str, list[int], list[str]]:
    array = np.asarray(value, object)
    texts = [v.decode(errors="replace") if isinstance(v, bytes) else v for v in array.reshape(-1).tolist()]
    for k, text in enumerate(texts):
        if not isinstance(text, str):
            raise BuildError(f"{path}[{k}]: is {text!r}, expected a text")
        if "\0" in text or "\ufffd" in text:
            raise BuildError(f"{path}[{k}]: {text!r} has the characters NUL or U+FFFD, which files cannot hold")
    return path, list(array.shape), [str(text) for text in texts]


#: A path in the file format, indices in its array, and a name between back ticks.
PLACE = re.compile(r"(?:steps/(\d{4})[/@]?)?([\w/@]*)((?:\[\d+\])*)(?: `([^`]*)`)?(?=: )")
#: Arguments by what comes of them, where their names differ.
ARGUMENTS = {
    "weight_formula": "weight", "weight_breakpoints": "breakpoints", "map_degree": "map", "map_offset": "map",
    "map_space": "space", "clip_field": "clips", "clip_side": "clips", "clip_offsets": "clips",
    "frame_origin": "origin", "frame_angle": "angle", "frame_end": "tip", "formula": "text", "crack": "crack",
    "parameter_name": "parameters", "parameter_value": "parameters",
}  # fmt: skip
#: Offsets by the array whose rows they part.
OFFSETS = {
    "cuts": "cut_offsets", "kinks": "kink_offsets", "singular": "singular_offsets", "points": "offsets", "bulges": "offsets",
    "parameter_name": "parameter_offsets", "parameter_value": "parameter_offsets",
}  # fmt: skip


def in_arguments(message: str, arrays: Mapping[str, Any], is_series: bool) -> str:
    """Rewrite a message of the format about `arrays`, line by line, with the places of arguments."""

    def argument(found: re.Match[str]) -> str:
        step, path, indices, name = found.groups()
        root = f"steps/{step}/" if step else ""
        of = f"states[{int(step)}]." if step and is_series else ""
        numbers = [int(k) for k in re.findall(r"\d+", indices)]
        return of + _argument(path, numbers, name, lambda key: arrays[root + key])

    return "\n".join(line if line.startswith(" ") else PLACE.sub(argument, line, count=1) for line in message.split("\n"))


def _argument(path: str, numbers: Sequence[int], name: str | None, array: Any) -> str:
    """Return the argument of a path, or the path if it has none."""
    group, *rest = re.split("[/@]", path.lstrip("@"))
    key = rest[-1] if rest else ""
    ours = ARGUMENTS.get(key, key)
    if group == "partition":
        return indexed(f"cover.{ours}".rstrip("."), [] if ours != key else numbers)
    if group == "domain" and rest[:1] != ["holes"]:
        return "cover.domain"
    if group == "equation":
        return f"equation.{key}".rstrip(".").split("_")[0]
    if group == "fields" and rest:
        place = f"fields[{array(f'fields/{rest[0]}@name')!r}]"
        is_given = key in ("components", "exact", "unit")
        return indexed(f"{place}.{key}", numbers) if is_given else place if key in (rest[0], "name") else f"{place}.blocks"
    if group == "tables" and rest:
        return indexed(f"tables[{array(f'tables/{rest[0]}@name')!r}]" + (f".{key}" if len(rest) > 1 else ""), numbers)
    if group in ("attributes", "functions", "quantities") and (name or numbers):
        return _entry(group, key, list(numbers), name, array)
    if group in ("cracks", "domain") and numbers:
        place, list_ = ("cracks", "cracks") if group == "cracks" else ("domain/holes", "holes")
        k, inner = _part(place, key, list(numbers), array)
        return indexed(f"{list_}[{k}]" + (f".{ours}" if key and (list_, key) != ("cracks", "points") else ""), inner)
    return indexed(path, numbers) + (f" `{name}`" if name else "")


def _entry(group: str, key: str, numbers: list[int], name: str | None, array: Any) -> str:
    """Return an entry of a dictionary: a function, an attribute, a quantity."""
    inner: list[int] = []
    if name is None:
        k, inner = _part(group, key, numbers, array)
        name = str(array(f"{group}/name")[k])
    place, ours = f"{group}[{name!r}]", ARGUMENTS.get(key, key)
    is_plain = group != "functions" or key in ("", "name", "kind", "levels") or ours == "parameters"
    return place if is_plain else indexed(f"{place}.{ours}", inner if key in OFFSETS else [])


def _part(group: str, key: str, numbers: list[int], array: Any) -> tuple[int, list[int]]:
    """Return the entry that a row belongs to, and the indices in it."""
    if key not in OFFSETS:
        return numbers[0], numbers[1:]
    offsets = np.asarray(array(f"{group}/{OFFSETS[key]}"))
    k = int(np.searchsorted(offsets, numbers[0], side="right")) - 1
    return k, [numbers[0] - int(offsets[k]), *numbers[1:]]
