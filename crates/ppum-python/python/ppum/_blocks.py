"""Blocks of fields: coefficients by function and patch, as the compressed rows of the file format."""

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ._checks import Ragged, gathered, index, known, real, sequence, short
from ._errors import BuildError
from ._text import hint
from ._units import Floats

Block = NDArray[Any] | Sequence[ArrayLike | None] | Mapping[int, ArrayLike] | Ragged

MAX_DEGREE = 8
#: Degree of a polynomial by the number of its coefficients: of total degree, and of a tensor product.
DEGREES = {(d + 1) * (d + 2) // 2: d for d in range(MAX_DEGREE + 1)}
TENSOR = {(d + 1) ** 2: d for d in range(MAX_DEGREE + 1)}


def exponents(degree: int, tensor: bool = False) -> list[tuple[int, int]]:
    """Return the exponents of the monomials up to a degree, or of a tensor product, in the format's order."""
    if tensor:
        return [(i, j) for j in range(degree + 1) for i in range(degree + 1)]
    return [(d - k, k) for d in range(degree + 1) for k in range(d + 1)]


@dataclass(frozen=True)
class _Part:
    """The blocks of one function: the patches that have it, and their coefficients one after the other, shape (m, c)."""

    patches: NDArray[np.int64]
    sizes: NDArray[np.int64]
    degrees: NDArray[np.int64]
    tensor: NDArray[np.bool_]
    values: Floats


def arranged(
    place: str, blocks: Mapping[str, Block], tensor: Mapping[str, NDArray[np.bool_]], functions: list[str]
) -> dict[str, NDArray[Any]]:
    """Return the arrays of blocks, patch by patch, in the order of the functions.

    `tensor` tells on which patches the polynomials of each block are tensor products.
    """
    if not blocks:
        raise BuildError(f"{place}.blocks: is empty; give the coefficients of a function, such as 'one'")
    for name in blocks:
        if name not in functions:
            raise BuildError(f"{place}.blocks[{name!r}]: is no function of the state; {hint(name, functions)}")
    parts = [_part(f"{place}.blocks[{name!r}]", block, tensor[name]) for name, block in blocks.items()]
    counts = {part.values.shape[1]: name for part, name in zip(parts, blocks)}
    if len(counts) > 1:
        listed = ", ".join(f"{count} in {name!r}" for count, name in counts.items())
        raise BuildError(f"{place}.blocks: differ in the number of components: {listed}")
    return _merged(parts, [functions.index(name) for name in blocks], len(next(iter(tensor.values()))))


def _merged(parts: list[_Part], functions: list[int], patches: int) -> dict[str, NDArray[Any]]:
    patch, sizes, degrees, tensor = (
        np.concatenate([getattr(part, name) for part in parts]) for name in ("patches", "sizes", "degrees", "tensor")
    )
    function = np.repeat(functions, [len(part.patches) for part in parts])
    order = np.lexsort((function, patch))
    starts, sizes = (np.cumsum(sizes) - sizes)[order], sizes[order]
    arrays = {
        "patch_blocks": np.searchsorted(patch[order], np.arange(patches + 1)),
        "block_function": function[order],
        "block_degree": degrees[order],
        "block_offset": np.cumsum(sizes) - sizes,
        "coefficients": np.concatenate([part.values for part in parts])[gathered(starts, sizes)].T,
    }
    return arrays | ({"block_space": tensor[order]} if tensor.any() else {})


def _part(place: str, block: Any, tensor: NDArray[np.bool_]) -> _Part:
    patches = len(tensor)
    if isinstance(block, Mapping):
        given = sorted((_patch(place, k, patches), values) for k, values in block.items())
        return _listed(place, given, tensor)
    if not isinstance(block, Ragged) and hasattr(block, "__array__") and getattr(block, "dtype", None) != object:
        return _dense(place, known(place, block), tensor)
    if not isinstance(block, Ragged):
        block = sequence(place, block, "an array for each patch")
    if len(block) != patches:
        raise BuildError(f"{place}: has {len(block)} entries, but the cover has {patches} patches; give one for each")
    if isinstance(block, Ragged):
        return _made(place, np.arange(patches), block, tensor)
    return _listed(place, ((k, values) for k, values in enumerate(block) if values is not None), tensor)


def _patch(place: str, number: Any, patches: int) -> int:
    found = index(number, patches)
    if found is None:
        raise BuildError(f"{place}[{short(number)}]: there is no such patch; the cover has {patches}, counted from 0")
    return found


def _dense(place: str, block: NDArray[Any], tensor: NDArray[np.bool_]) -> _Part:
    patches = len(tensor)
    if block.ndim not in (2, 3) or len(block) != patches:
        raise BuildError(
            f"{place}: has the shape {block.shape}, expected ({patches}, m) or ({patches}, m, c): "
            "a row of m coefficients for each patch, of c components"
        )
    size = block.shape[1]
    values = Ragged(block.reshape(patches * size, -1).astype(float), np.full(patches, size))
    return _made(place, np.arange(patches), values, tensor, is_dense=True)


def _listed(place: str, given: Iterable[tuple[int, Any]], tensor: NDArray[np.bool_]) -> _Part:
    patches, rows = [], []
    for patch, values in given:
        row = real(f"{place}[{patch}]", values)
        if row.ndim not in (1, 2):
            raise BuildError(f"{place}[{patch}]: has the shape {row.shape}, expected (m,) or (m, c)")
        patches.append(patch)
        rows.append(row.reshape(len(row), -1))
        if rows[-1].shape[1] != rows[0].shape[1]:
            counts = f"{rows[-1].shape[1]} components, patch {patches[0]} {rows[0].shape[1]}"
            raise BuildError(f"{place}[{patch}]: has {counts}; give all patches the same number")
    if not rows:
        raise BuildError(f"{place}: has no coefficients on any patch; leave it out")
    sizes = np.array([len(row) for row in rows])
    return _made(place, np.array(patches), Ragged(np.concatenate(rows), sizes), tensor)


def _made(
    place: str, patches: NDArray[np.int64], rows: Ragged, tensor: NDArray[np.bool_], is_dense: bool = False
) -> _Part:
    found = degrees(place, rows.sizes, tensor[patches], None if is_dense else patches)
    _finite(place, rows.values, patches, rows.sizes)
    return _Part(patches, rows.sizes, found, tensor[patches], rows.values)


def degrees(
    place: str,
    sizes: NDArray[np.int64],
    tensor: NDArray[np.bool_],
    patches: NDArray[np.int64] | None = None,
    least: int = 0,
) -> NDArray[np.int64]:
    found = np.full(len(sizes), -1)
    for is_tensor, known in ((False, DEGREES), (True, TENSOR)):
        for size, degree in known.items():
            found[(sizes == size) & (tensor == is_tensor)] = degree
    wrong = np.flatnonzero(found < least)
    if len(wrong):
        k = int(wrong[0])
        where = place if patches is None else f"{place}[{patches[k]}]"
        raise BuildError(_unfit(where, int(sizes[k]), TENSOR if tensor[k] else DEGREES, least))
    return found


def _unfit(place: str, size: int, known: Mapping[int, int], least: int) -> str:
    """Describe what is wrong with a number of coefficients; those of maps have no constant."""
    missing = least and 1
    sizes = [k - missing for k, degree in known.items() if degree >= least]
    size -= missing
    near = [k for k in sizes if k < size][-1:] + [k for k in sizes if k > size][:1]
    law = "(d + 1)²" if known is TENSOR else "(d + 1)(d + 2)/2"
    kind = "tensor product" if known is TENSOR else "polynomial"
    return (
        f"{place}: has {size} coefficients; a {kind} of degree d, at most {MAX_DEGREE}, has {law}{' - 1' * missing}, "
        f"here {' or '.join(map(str, near))}: fill up with zeros"
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
