"""Blocks of fields: coefficients by function and patch, as the compressed rows of the file format."""

from __future__ import annotations

import difflib
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from .errors import BuildError

Floats = NDArray[np.float64]
Block = NDArray[Any] | Sequence[ArrayLike | None] | Mapping[int, ArrayLike]

MAX_DEGREE = 8
#: Degree of a polynomial by the number of its coefficients.
DEGREES = {(d + 1) * (d + 2) // 2: d for d in range(MAX_DEGREE + 1)}


@dataclass(frozen=True)
class Blocks:
    """The arrays of a field."""

    patch_blocks: NDArray[Any]
    block_function: NDArray[Any]
    block_degree: NDArray[Any]
    block_offset: NDArray[Any]
    coefficients: Floats

    def arrays(self) -> dict[str, NDArray[Any]]:
        return dict(vars(self))


@dataclass(frozen=True)
class _Part:
    """The blocks of one function: the patches that have it, and their coefficients one after the other, shape (m, c)."""

    patches: NDArray[np.int64]
    sizes: NDArray[np.int64]
    values: Floats


def arranged(place: str, blocks: Mapping[str, Block], patches: int, functions: list[str]) -> Blocks:
    """The arrays of blocks, patch by patch, in each one in the order of the functions."""
    if not blocks:
        raise BuildError(f"{place}.blocks: is empty; give the coefficients of a function, such as 'one'")
    for name in blocks:
        if name not in functions:
            close = difflib.get_close_matches(name, functions, 1)
            hint = f"did you mean {close[0]!r}? " if close else ""
            raise BuildError(f"{place}.blocks[{name!r}]: {hint}there are the functions {', '.join(functions)}")
    parts = [_part(f"{place}.blocks[{name!r}]", block, patches) for name, block in blocks.items()]
    counts = {part.values.shape[1]: name for part, name in zip(parts, blocks)}
    if len(counts) > 1:
        told = ", ".join(f"{count} in {name!r}" for count, name in counts.items())
        raise BuildError(f"{place}.blocks: differ in the number of components: {told}")
    return _merged(parts, [functions.index(name) for name in blocks], patches)


def _merged(parts: list[_Part], functions: list[int], patches: int) -> Blocks:
    patch = np.concatenate([part.patches for part in parts])
    function = np.repeat(functions, [len(part.patches) for part in parts])
    sizes = np.concatenate([part.sizes for part in parts])
    starts = np.cumsum(sizes) - sizes
    order = np.lexsort((function, patch))
    sizes, starts = sizes[order], starts[order]
    offsets = np.cumsum(sizes) - sizes
    gather = np.repeat(starts - offsets, sizes) + np.arange(sizes.sum())
    values = np.concatenate([part.values for part in parts])
    return Blocks(
        patch_blocks=np.searchsorted(patch[order], np.arange(patches + 1)),
        block_function=function[order],
        block_degree=np.array([DEGREES[int(size)] for size in sizes], np.uint8),
        block_offset=offsets,
        coefficients=values[gather].T,
    )


def _part(place: str, block: Block, patches: int) -> _Part:
    if isinstance(block, np.ndarray) and block.dtype != object:
        return _dense(place, block, patches)
    if isinstance(block, Mapping):
        given = sorted((_patch(place, k, patches), values) for k, values in block.items())
    elif len(block) == patches:
        given = [(k, values) for k, values in enumerate(block) if values is not None]
    else:
        raise BuildError(f"{place}: has {len(block)} entries, but the cover has {patches} patches; give one for each")
    return _ragged(place, given)


def _patch(place: str, number: Any, patches: int) -> int:
    if not 0 <= int(number) < patches or int(number) != number:
        raise BuildError(f"{place}[{number}]: there is no such patch; the cover has {patches}, counted from 0")
    return int(number)


def _dense(place: str, block: NDArray[Any], patches: int) -> _Part:
    if block.ndim not in (2, 3) or len(block) != patches:
        raise BuildError(
            f"{place}: has the shape {block.shape}, expected ({patches}, m) or ({patches}, m, c): "
            "a row of m coefficients for each patch, of c components"
        )
    size = block.shape[1]
    _degree(place, size)
    values = block.reshape(patches * size, -1).astype(float)
    _finite(place, values, np.arange(patches), np.full(patches, size))
    return _Part(np.arange(patches), np.full(patches, size), values)


def _ragged(place: str, given: Iterable[tuple[int, Any]]) -> _Part:
    patches, rows = [], []
    for patch, values in given:
        try:
            row = np.asarray(values, float)
        except (TypeError, ValueError) as error:
            raise BuildError(f"{place}[{patch}]: is no array of numbers ({error})") from None
        if row.ndim not in (1, 2):
            raise BuildError(f"{place}[{patch}]: has the shape {row.shape}, expected (m,) or (m, c)")
        _degree(f"{place}[{patch}]", len(row))
        patches.append(patch)
        rows.append(row.reshape(len(row), -1))
        if rows[-1].shape[1] != rows[0].shape[1]:
            counts = f"{rows[-1].shape[1]} components, patch {patches[0]} {rows[0].shape[1]}"
            raise BuildError(f"{place}[{patch}]: has {counts}; give all patches the same number")
    if not rows:
        raise BuildError(f"{place}: has no coefficients on any patch; leave it out")
    sizes = np.array([len(row) for row in rows])
    values, of = np.concatenate(rows), np.array(patches)
    _finite(place, values, of, sizes)
    return _Part(of, sizes, values)


def _degree(place: str, size: int) -> None:
    if size in DEGREES:
        return
    known = list(DEGREES)
    below = max((k for k in known if k < size), default=0)
    near = [k for k in known if k > size][:1]
    fits = " or ".join(str(k) for k in ([below] if below else []) + near)
    raise BuildError(
        f"{place}: has {size} coefficients; a polynomial of degree d, at most {MAX_DEGREE}, has (d + 1)(d + 2)/2, "
        f"here {fits}: fill up with zeros"
    )


def _finite(place: str, values: Floats, patches: NDArray[Any], sizes: NDArray[Any]) -> None:
    wrong = np.argwhere(~np.isfinite(values))
    if not len(wrong):
        return
    row, component = wrong[0]
    block = int(np.searchsorted(np.cumsum(sizes), row, side="right"))
    k = row - (np.cumsum(sizes)[block] - sizes[block])
    of = f" of component {component}" if values.shape[1] > 1 else ""
    raise BuildError(
        f"{place}: coefficient {k}{of} on patch {patches[block]} is {values[row, component]}; give finite numbers"
    )
