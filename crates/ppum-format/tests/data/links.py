"""Makes the small files in `links/`: version-1.0.h5, written by h5py with something that the format refuses.

    python crates/ppum-format/tests/data/links.py        (from the repository's root)
"""

import pathlib

import h5py
import numpy as np

HERE = pathlib.Path(__file__).parent
STEP = "steps/0000"


def soft(file):
    file[f"{STEP}/warnings"] = h5py.SoftLink(f"/{STEP}/history")


def dangling(file):
    file["steps/0001"] = h5py.SoftLink("/nowhere")


def external(file):
    file["steps/0001"] = h5py.ExternalLink("another.h5", "/steps/0000")


def named_type(file):
    del file["problem"]
    file["problem"] = np.dtype("f8")


def dense(file):
    """So many links that they are in an index."""
    for k in range(20):
        file.create_group(f"{STEP}/more-{k}")
    soft(file)


def enumeration(file):
    file["equation"].attrs["isotropic"] = np.bool_(True)
    file.attrs["sha256"] = 64 * "0"


def reference(file):
    file["equation"].attrs["of"] = file[STEP].ref
    file.attrs["sha256"] = 64 * "0"


def text_with_nul(file):
    kind = h5py.string_dtype("utf-8", 3)
    file["domain"].attrs.create("note", np.array(b"a\0b", dtype="S3"), dtype=kind)


def user(file):
    """Not read: this one is fine."""
    file["user/theirs"] = h5py.SoftLink("/nowhere")
    file["user/other"] = h5py.ExternalLink("another.h5", "/")


def big_endian(file):
    """Numbers in the other byte order: this one is fine too."""
    swapped = lambda array: np.asarray(array, dtype=np.asarray(array).dtype.newbyteorder(">"))
    for name in ["partition/center", "fields/0000/coefficients", "functions/crack"]:
        values = file[f"{STEP}/{name}"][()]
        del file[f"{STEP}/{name}"]
        file[f"{STEP}/{name}"] = swapped(values)
    load = file[STEP].attrs["load"]
    file[STEP].attrs.create("load", swapped(load), dtype=">f8")


CHANGES = [soft, dangling, external, named_type, dense, enumeration, reference, text_with_nul, user, big_endian]


def fill(group, source):
    """Copies what is in a group, into groups of this file's own form."""
    group.attrs.update({k: v for k, v in source.attrs.items() if k != "sha256"})
    for name, node in source.items():
        if isinstance(node, h5py.Group):
            fill(group.create_group(name), node)
        else:
            source.copy(name, group)


def copy(change, libver, name):
    path = HERE / "links" / f"{name}.h5"
    with h5py.File(HERE / "version-1.0.h5") as source, h5py.File(path, "w", libver=libver) as file:
        fill(file, source)
        change(file)


(HERE / "links").mkdir(exist_ok=True)
for change in CHANGES:
    copy(change, ("v110", "v110"), change.__name__)
for change in [soft, external, named_type]:
    copy(change, ("earliest", "v110"), f"{change.__name__}-earliest")
