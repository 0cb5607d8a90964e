"""One request, drawn by the command line, by Python and as the window saves it: equal bytes, equal warnings."""

import json
import os
import pathlib
import random
import re
import shlex
import struct
import subprocess

import pytest
from ppum import _core

ROOT = pathlib.Path(__file__).parents[3]


@pytest.fixture(scope="module")
def window():
    """Saves a request as the window does, and says which command draws it."""
    path = pathlib.Path(os.environ.get("PPUM_PROGRAMS", ROOT / "target/release")) / "examples/export"
    if not path.exists():
        pytest.skip("the window's export has not been built: cargo build --release --workspace --examples")

    def run(*args):
        done = subprocess.run([path, *map(str, args)], capture_output=True, text=True)
        assert done.returncode == 0, done.stderr
        return shlex.split(done.stdout), [line.removeprefix("warning: ") for line in done.stderr.splitlines()]

    return run


def pixels(png):
    """The chunks of a PNG but for its texts, which name files and commands."""
    chunks, at = [], 8
    while at < len(png):
        (length,) = struct.unpack(">I", png[at : at + 4])
        if png[at + 4 : at + 8] not in (b"tEXt", b"zTXt", b"iTXt"):
            chunks.append(png[at : at + 12 + length])
        at += 12 + length
    assert len(chunks) > 2
    return b"".join(chunks)


def requests(seed, count):
    """Requests of everything that a window can ask of an image."""
    chance = random.Random(seed)
    maybe = lambda *values: chance.choice((None, *values))
    for number in range(count):
        deformed = maybe("auto", "0.05") if number % 3 else None
        shown = ["cells", "cracks"] if deformed else ["cells", "patches", "rings", "cracks", "supports", "loads"]
        overlays = chance.sample(shown, chance.randrange(len(shown)))
        tip = chance.choice([(-0.35, -0.35), (0.35, 0.35), (0.0, 0.9)])
        yield {
            "figure": number % 2 == 0,
            "look": {"size": [chance.randrange(300, 420), chance.randrange(260, 400)]},
            "place": {"center": tip, "width": 10 ** chance.uniform(-3, 0.6)},
            "subject": {"part": maybe("jump", "smooth"), "step": None},
            "quantity": chance.choice(["ux", "von-mises", "sqrt(x)", "1/(x - x)", "s1 - s2", "level", None]),
            "colors": {
                "colormap": maybe("vik", "magma_r"),
                "range": chance.choice(["auto", "full", "0.25,3.0", "5%,95%"]),
                "scale": chance.choice(["linear", "linear", "symlog"]),
                "contrast": chance.random() < 0.3,
                "bands": maybe(7),
                "symmetric": chance.random() < 0.3,
            },
            "overlays": {
                "shown": overlays,
                "no_cracks": "cracks" not in overlays,
                "isolines": maybe("auto", "5", "1e9,"),
                "level_labels": chance.random() < 0.5,
                "arrows": maybe(30.0),
                "crosses": maybe(36.0),
            },
            "deformed": deformed,
            "outline": chance.random() < 0.5,
            "mirror": None if deformed else maybe("top:antisymmetric", "left,bottom"),
        }


def test_one_request_has_one_image(ds, program, window, tmp_path):
    """Bytes are those of pixels and lines: texts of files name commands and folders."""
    ds.save(tmp_path / "plate.h5")
    warned = figures = 0
    for number, request in enumerate(requests(37, 40)):
        part = request["subject"]["part"]
        field = ds.field.part(part) if part else ds.field
        form = "svg" if number % 4 == 2 else "png"
        (tmp_path / "request.json").write_text(json.dumps(request))
        names = [tmp_path / f"{name}.{form}" for name in ("window", "program")]
        command, notices = window(tmp_path / "plate.h5", tmp_path / "request.json", names[0])
        assert command[:4] == ["ppum", "render", str(tmp_path / "plate.h5"), "-o"]
        program(*command[1:4], names[1], *command[5:], "--backend=cpu")
        ours, told = _core.figure(field._core, {**request, "backend": "cpu"}, form)
        window_s, theirs = (name.read_bytes() for name in names)
        what = shlex.join(command)
        if form == "png":
            assert pixels(ours) == pixels(theirs) == pixels(window_s), what
        else:
            assert drawn(ours) == drawn(theirs) == drawn(window_s), what
        assert notices == program.warnings == told, what
        warned += bool(told)
        figures += request["figure"]
    assert warned > 5 and figures > 15


def drawn(page):
    """An SVG page without the texts of its file."""
    return re.sub(rb"<(title|desc|metadata)>.*?</\1>", b"", page, flags=re.DOTALL)
