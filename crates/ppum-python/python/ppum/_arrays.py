"""Arrays as the file format has them: types, shapes, texts."""

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
    """Path, shape and values, row-major."""
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
