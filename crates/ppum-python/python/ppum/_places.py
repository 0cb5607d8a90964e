"""Places of mistakes: those in the arrays of the file format as the arguments that `build` makes them of."""

import re
from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np

from ._checks import indexed

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
    "cuts": "cut_offsets", "kinks": "kink_offsets", "singular": "singular_offsets", "points": "offsets",
    "parameter_name": "parameter_offsets", "parameter_value": "parameter_offsets",
}  # fmt: skip


def in_arguments(message: str, arrays: Mapping[str, Any], is_series: bool) -> str:
    """A message of the format about `arrays`, a line for each mistake, with the places of arguments."""

    def argument(found: re.Match[str]) -> str:
        step, path, indices, name = found.groups()
        root = f"steps/{step}/" if step else ""
        of = f"states[{int(step)}]." if step and is_series else ""
        numbers = [int(k) for k in re.findall(r"\d+", indices)]
        return of + _argument(path, numbers, name, lambda key: arrays[root + key])

    return "\n".join(line if line.startswith(" ") else PLACE.sub(argument, line, count=1) for line in message.split("\n"))


def _argument(path: str, numbers: Sequence[int], name: str | None, array: Any) -> str:
    """The argument of a path, where it has one."""
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
    """An entry of a dictionary: a function, an attribute, a quantity."""
    inner: list[int] = []
    if name is None:
        k, inner = _part(group, key, numbers, array)
        name = str(array(f"{group}/name")[k])
    place, ours = f"{group}[{name!r}]", ARGUMENTS.get(key, key)
    is_plain = group != "functions" or key in ("", "name", "kind", "levels") or ours == "parameters"
    return place if is_plain else indexed(f"{place}.{ours}", inner if key in OFFSETS else [])


def _part(group: str, key: str, numbers: list[int], array: Any) -> tuple[int, list[int]]:
    """The entry that a row belongs to, and the indices in it."""
    if key not in OFFSETS:
        return numbers[0], numbers[1:]
    offsets = np.asarray(array(f"{group}/{OFFSETS[key]}"))
    k = int(np.searchsorted(offsets, numbers[0], side="right")) - 1
    return k, [numbers[0] - int(offsets[k]), *numbers[1:]]
