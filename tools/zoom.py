"""Draws a zoom from a body into one of its tips as a GIF: `zoom.py PPUM FILE.h5 -o OUT.gif TIP DECADES`.

`ppum render --figure` draws each frame. Needs pillow.
"""

import json
import pathlib
import subprocess
import sys
import tempfile

from PIL import Image

FRAMES_PER_DECADE = 3
MILLISECONDS = 140
SIZE = (480, 400)


def run(*words):
    return subprocess.run([ppum, *map(str, words)], check=True, capture_output=True, text=True).stdout


ppum, file, _, out, tip, decades = sys.argv[1:]
domain = json.loads(run("info", file, "--json"))["domain"]
end = json.loads(run("sif", file, "--json"))["tips"][int(tip)]["tip"]
middle = [(a + b) / 2 for a, b in zip(domain["min"], domain["max"], strict=True)]
whole = max(b - a for a, b in zip(domain["min"], domain["max"], strict=True))


def view(zoom):
    """The options of a view that moves from the body's middle to the tip, and is there from a zoom of 100 on."""
    if zoom > 100:
        return ["--tip", tip, "--zoom", zoom]
    center = [b + (a - b) / zoom**2 for a, b in zip(middle, end, strict=True)]
    return [f"--center={center[0]},{center[1]}", "--width", 1.05 * whole / zoom]


frames = []
with tempfile.TemporaryDirectory() as folder:
    for k in range(int(decades) * FRAMES_PER_DECADE + 1):
        zoom = 10 ** (k / FRAMES_PER_DECADE)
        path = pathlib.Path(folder, f"{k}.png")
        title = f"title=von Mises stress, zoom {zoom:.0e}".replace("e+0", "e").replace("e+", "e")
        look = ["--figure", "--isolines", "auto", "--size", f"{SIZE[0]}x{SIZE[1]}", "--font-size", 8, "--labels", title]
        run("render", file, "-o", path, *view(zoom), *look)
        frames.append(Image.open(path).convert("RGB"))
# one palette for all frames, so that colours do not flicker
palette = Image.new("RGB", (3 * SIZE[0], SIZE[1]))
for place, frame in enumerate([frames[0], frames[len(frames) // 2], frames[-1]]):
    palette.paste(frame, (place * SIZE[0], 0))
palette = palette.quantize(128, Image.Quantize.MAXCOVERAGE)
frames = [frame.quantize(palette=palette, dither=Image.Dither.NONE) for frame in frames]
pauses = [1200, *[MILLISECONDS] * (len(frames) - 2), 2000]
frames[0].save(out, save_all=True, append_images=frames[1:], duration=pauses, loop=0, optimize=True)
