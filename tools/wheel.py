#!/usr/bin/env python3
"""What a wheel and a source distribution of the Python package must be: small, licensed, for Python 3.11 and later.

    tools/wheel.py FOLDER
"""

import pathlib
import sys
import tarfile
import zipfile

#: Longest wheel, in bytes: a little more than it has. A sixth of it are kernels, once for each set of vector instructions.
LONGEST = 6_600_000
LICENSES = ("LICENSE-MIT", "LICENSE-APACHE")


def check(folder):
    (wheel,) = folder.glob("*.whl")
    (source,) = folder.glob("*.tar.gz")
    size = wheel.stat().st_size
    assert size <= LONGEST, f"{wheel.name} has {size} bytes, more than {LONGEST}"
    assert "-cp311-abi3-" in wheel.name, f"{wheel.name} is for one Python alone"
    inside = zipfile.ZipFile(wheel).namelist()
    outside = tarfile.open(source).getnames()
    for license in LICENSES:
        for names in (inside, outside):
            assert any(name.endswith(license) for name in names), f"{license} is missing"
    for name in ("ppum/py.typed", "ppum/_core.pyi", "ppum/__init__.py"):
        assert name in inside, f"{name} is not in the wheel"
    print(f"ok  {wheel.name}: {size / 1e6:.1f} MB; {source.name}: {source.stat().st_size / 1e6:.1f} MB")


if __name__ == "__main__":
    check(pathlib.Path(sys.argv[1]))
