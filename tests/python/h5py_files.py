"""Rewrites a dataset with h5py, in all the ways in which HDF5 can store it.

    python tests/python/h5py_files.py       (from the repository's root)

makes the files of crates/ppum-format/tests/data/h5py from version-1.1.h5 beside them. All hold the same dataset.
Some hold more, in a group `more` that the format does not describe: arrays that need the larger forms of
the indexes of chunks, links and attributes. The checksum covers them.
"""

import math
import pathlib

import h5py
import numpy as np
from h5py import h5d, h5p
from ppum_reader import seal, text

DATA = pathlib.Path(__file__).parents[2] / "crates/ppum-format/tests/data"
LIBVERS = ["earliest", "v108", "v110", "v112", "v114", "v200"]
GZIP = {"compression": "gzip"}
ALL_FILTERS = {"compression": "gzip", "shuffle": True, "fletcher32": True}


def small(shape):
    return tuple(max(1, min(n, 3)) for n in shape)


def whole(shape):
    return tuple(max(1, n) for n in shape)


def beyond(shape):
    rest = [n + 1 for n in shape[1:]]
    return (max(1, (1 << 16) // math.prod(rest)) + shape[0], *rest)


def fixed(shape, chunk):
    """Can grow, but not for ever."""
    return tuple(max(2 * n, k) for n, k in zip(shape, chunk))


def first(shape, chunk):
    return (None, *(max(n, k) for n, k in zip(shape[1:], chunk[1:])))


def last(shape, chunk):
    return (*(max(n, k) for n, k in zip(shape[:-1], chunk)), None)


def every(shape, chunk):
    return (None,) * len(shape)


# Chunks, what they can grow to, filters: name, then arguments of `rewrite`.
LAYOUTS = {
    "contiguous": {},
    "compact": {"compact": True},
    "single": {"chunks": whole, **ALL_FILTERS},
    "fixed": {"chunks": small, "grow": fixed, **ALL_FILTERS},
    "beyond": {"chunks": beyond, "grow": fixed, "compression": "gzip", "shuffle": True},
    "beyond-plain": {"chunks": beyond, "grow": first, **GZIP},
    "implicit": {"chunks": small, "grow": fixed, "early": True},
    "first": {"chunks": small, "grow": first, **GZIP},
    "last": {"chunks": small, "grow": last, "compression": "lzf"},
    "every": {"chunks": small, "grow": every, **ALL_FILTERS},
    "every-plain": {"chunks": small, "grow": every},
    "packed": {"chunks": small, "scaleoffset": 0, "shuffle": True},
}


def put(parent, name, node, strings, compact=False, chunks=None, least=-1, grow=None, early=False, **filters):
    """One array again, in chunks if it has more than `least` elements. Scalars have no chunks, floating-point
    numbers are not packed, places of texts have no checksum."""
    data, dtype, how = node[()], node.dtype, {}
    if dtype.kind in "SO" and strings == "variable":
        data, dtype = node.asstr()[()], h5py.string_dtype()
    if compact or early:
        how["dcpl"] = h5p.create(h5p.DATASET_CREATE)
    if compact and node.nbytes < 1 << 15 and dtype.kind != "O":
        how["dcpl"].set_layout(h5d.COMPACT)
    if early:
        how["dcpl"].set_alloc_time(h5d.ALLOC_TIME_EARLY)
    if chunks and node.size > least and node.shape:
        how["chunks"] = chunks(node.shape)
        how["maxshape"] = (grow or fixed)(node.shape, how["chunks"]) if grow or not node.size else None
        if dtype.kind not in "ui":
            filters.pop("scaleoffset", None)
        if dtype.kind == "O":
            filters.pop("fletcher32", None)
        how.update(filters)
    parent.create_dataset(name, data=data, dtype=dtype, **how)


def recreate(source, target, strings, **layout):
    for name, value in source.attrs.items():
        target.attrs[name] = text(value) if isinstance(value, bytes) and strings == "variable" else value
    for name, node in source.items():
        if isinstance(node, h5py.Group):
            recreate(node, target.create_group(name), strings, **layout)
        else:
            put(target, name, node, strings, **layout)


def rewrite(source, target, libver, more=None, strings="fixed", file={}, **layout):
    """Writes a dataset again, with other things added by `more`."""
    with h5py.File(source) as old, h5py.File(target, "w", libver=libver, **file) as new:
        recreate(old, new, strings, **layout)
        if more:
            more(new.create_group("more"))
    if more:
        with h5py.File(target, "a", libver=libver) as new:
            seal(new)


def many_chunks(group, pages=1100, length=290):
    """Pages of a fixed array, super blocks of one that grows, trees of two levels; chunks not written,
    cut off, and given up."""
    group.create_dataset("pages", data=np.arange(pages, dtype="u1") % 7, chunks=(1,), fillvalue=7)
    sparse = group.create_dataset("sparse", (3, pages), "u1", chunks=(3, 1), maxshape=(4, pages + 9), fillvalue=7)
    sparse[1, pages - 20 : pages - 10] = 9
    group.create_dataset("growing", data=np.arange(length, dtype="u1"), chunks=(1,), maxshape=(None,))
    wide = group.create_dataset("wide", (3, length), "i8", chunks=(2, 1), maxshape=(6, None), fillvalue=-3)
    wide[1, length - 80 : length - 10] = np.arange(70)
    tree = group.create_dataset("tree", (20, 20), "u4", chunks=(2, 2), maxshape=(None, None), fillvalue=5)
    tree[:, :15] = np.arange(300).reshape(20, 15)
    cut = group.create_dataset("cut", (70, 110), "f8", chunks=(30, 40), maxshape=(None, None), **GZIP)
    cut[...] = 1
    cut.resize((33, 44))
    early = h5p.create(h5p.DATASET_CREATE)
    early.set_alloc_time(h5d.ALLOC_TIME_EARLY)
    early = group.create_dataset("early", (7, 10), "u4", chunks=(2, 3), maxshape=(9, 12), fillvalue=5, dcpl=early)
    early[:, :5] = np.arange(35).reshape(7, 5)
    group.create_dataset("never written", (5, 7), "f8", fillvalue=2.5)
    group.create_dataset("texts never written", (5,), h5py.string_dtype())


def many_names(group, count=60):
    """Links and attributes that do not fit into a header, and attributes that fit into no block."""
    shared = group.create_group("shared")
    for k in range(count):
        group.attrs[f"attribute {k}"] = np.arange(k % 4.0) if k % 2 else f"Übung {k}"
        group[f"link {k}"] = shared
    group.create_group("long").attrs["rows"] = np.arange(600.0).reshape(200, 3)
    for k in range(9):
        group["long"].attrs[f"other {k}"] = np.arange(k)


def kinds(group):
    """Named types (their names are in `user`), hard links, shapes of attributes, empty texts."""
    group.file["user/number"], group.file["user/word"] = np.dtype("f8"), h5py.string_dtype()
    group.create_dataset("number", data=[1.0, 2.0], dtype=group.file["user/number"])
    group.create_dataset("words", data=["a", "", "öü"], dtype=group.file["user/word"])
    group.attrs.create("number", [3.0], dtype=group.file["user/number"])
    group.attrs["words"] = np.array([["a", "bb"], ["", "ü"]], dtype=h5py.string_dtype())
    group.file["user/again"] = group["number"]


# Name of a file, and how it is made.
FILES = {
    "v108-first-lzf": dict(libver="v108", **LAYOUTS["last"]),
    "earliest-many-chunks": dict(libver="earliest", more=lambda group: many_chunks(group, 68, 85)),
    "earliest-names": dict(libver="earliest", more=lambda group: many_names(group, 20)),
    "v110-fixed": dict(libver="v110", **LAYOUTS["fixed"]),
    "v110-beyond": dict(libver="v110", **LAYOUTS["beyond"]),
    "v110-many-chunks": dict(libver="v110", more=many_chunks, **LAYOUTS["compact"]),
    "v112-packed": dict(libver="v112", least=3, **LAYOUTS["packed"]),
    "v114-every": dict(libver="v114", **LAYOUTS["every"]),
    "v114-names": dict(
        libver="v114", more=many_names, strings="variable", file={"userblock_size": 512, "track_order": True}
    ),
    "v114-kinds": dict(libver="v114", more=kinds, file={"fs_strategy": "page"}),
    "v200-first": dict(libver="v200", least=7, strings="variable", **LAYOUTS["first"]),
    "v200-every": dict(libver="v200", **LAYOUTS["every"]),
}


if __name__ == "__main__":
    for name, how in FILES.items():
        # files stay small if only a few arrays have chunks
        how = {"least": 9} | how
        rewrite(DATA / "version-1.1.h5", DATA / "h5py" / f"{name}.h5", **how)
