#!/usr/bin/env python3
"""What a wheel and a source distribution of the Python package must be: small, licensed, for Python 3.11 and later.

    tools/wheel.py FOLDER MODULE      a wheel and a source distribution that were built, and the module that is measured
    tools/wheel.py --release FOLDER [TARGET]      builds there what is published, with zig, and checks it; skipped where zig
                                      is not. TARGET is another processor, such as aarch64-unknown-linux-gnu.

With zig (`pip install ziglang`) wheels are linked against an old C library, so that they run on clusters of 2012 and later.
"""

import importlib.util
import pathlib
import platform
import re
import subprocess
import sys
import tarfile
import zipfile
import zlib

#: Longest compressed module of the build for tests, in bytes: a little more than it has. A sixth of it are kernels, once for each set of
#: vector instructions, 1.5 MB the evaluator of pages, 2 MB the command `ppum`, 2 % generic code that both crates of the solver have, and a
#: quarter of one clap, which knows the texts of options; foreign crates that compute nothing are not optimised there, which makes them longer.
LONGEST = 13_000_000
#: Longest published wheel: the whole program is optimised at once, so generic code is there once.
LONGEST_RELEASE = 12_000_000
#: The C library that published wheels need, that of CentOS 7.
OLDEST = (2, 17)
LICENSES = ("LICENSE-MIT", "LICENSE-APACHE")
RELEASE = ("maturin", "build", "--profile", "wheel", "--locked", "--zig", "--compression-level", "9")


def check_size(name, size, longest):
    assert size <= longest, f"{name} has {size} bytes, more than {longest}"


def check(folder):
    (wheel,) = folder.glob("*.whl")
    (source,) = folder.glob("*.tar.gz")
    assert "-cp311-abi3-" in wheel.name, f"{wheel.name} is for one Python alone"
    inside = zipfile.ZipFile(wheel).namelist()
    outside = tarfile.open(source).getnames()
    for license in LICENSES:
        for names in (inside, outside):
            assert any(name.endswith(license) for name in names), f"{license} is missing"
    for name in ("ppum/py.typed", "ppum/_core.pyi", "ppum/__init__.py"):
        assert name in inside, f"{name} is not in the wheel"
    print(f"ok  {wheel.name}; {source.name}: {source.stat().st_size / 1e6:.1f} MB")
    return wheel


def check_platform(folder, processor):
    """The name of the wheel says an old C library, and its code asks for nothing newer."""
    (wheel,) = folder.glob("*.whl")
    tag = "manylinux_{}_{}_".format(*OLDEST) + processor
    assert tag in wheel.name, f"{wheel.name} is not for {tag}"
    archive = zipfile.ZipFile(wheel)
    (library,) = (name for name in archive.namelist() if name.endswith(".so"))
    versions = re.findall(rb"\bGLIBC_(\d+)\.(\d+)", archive.read(library))
    newest = max((int(major), int(minor)) for major, minor in versions)
    assert newest <= OLDEST, f"{wheel.name} needs glibc {newest}"
    print(f"ok  {wheel.name}: needs glibc {newest[0]}.{newest[1]}")


def release(folder, target=f"{platform.machine()}-unknown-linux-gnu"):
    if importlib.util.find_spec("ziglang") is None:
        print("skipped  the wheel that is published: no zig (pip install ziglang)")
        return
    compatible = "manylinux_{}_{}".format(*OLDEST)
    subprocess.run([*RELEASE, "--target", target, "--compatibility", compatible, "--out", folder], check=True)
    subprocess.run(["maturin", "sdist", "--out", folder], check=True)
    wheel = check(folder)
    check_size(wheel.name, wheel.stat().st_size, LONGEST_RELEASE)
    check_platform(folder, target.split("-")[0])


if __name__ == "__main__":
    if sys.argv[1] == "--release":
        release(pathlib.Path(sys.argv[2]), *sys.argv[3:])
    else:
        folder, module = map(pathlib.Path, sys.argv[1:])
        check(folder)
        check_size(module.name, len(zlib.compress(module.read_bytes(), 9)), LONGEST)
