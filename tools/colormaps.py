#!/usr/bin/env python3
"""Write the colour tables in crates/ppum-render/data: lines of sRGB bytes, 256 or, of twilight, 510.

    python3 -m venv venv && venv/bin/pip install matplotlib cmcrameri
    venv/bin/python tools/colormaps.py

The viridis family, cividis, turbo and twilight are the published tables as matplotlib carries them,
batlow, vik and roma as cmcrameri does; coolwarm is computed here from its definition.
"""

from math import acos, atan2, cos, hypot, sin, sqrt
from pathlib import Path

import cmcrameri.cm
import matplotlib

ENTRIES = 256
DATA = Path(__file__).resolve().parent.parent / "crates" / "ppum-render" / "data"

SOURCES = {
    "viridis": "S. van der Walt, N. Smith and E. Firing, matplotlib; CC0",
    "plasma": "S. van der Walt, N. Smith and E. Firing, matplotlib; CC0",
    "inferno": "S. van der Walt, N. Smith and E. Firing, matplotlib; CC0",
    "magma": "S. van der Walt, N. Smith and E. Firing, matplotlib; CC0",
    "cividis": "J. Nunez, C. Anderton and R. Renslow, PLOS ONE 13 (2018) e0199239; CC0",
    "twilight": "B. Bechtold, matplotlib; CC0",
    "batlow": "F. Crameri, Scientific colour maps; MIT, see LICENSE_CRAMERI",
    "vik": "F. Crameri, Scientific colour maps; MIT, see LICENSE_CRAMERI",
    "roma": "F. Crameri, Scientific colour maps; MIT, see LICENSE_CRAMERI",
    "turbo": "Copyright 2019 Google LLC, author A. Mikhailov; SPDX-License-Identifier: Apache-2.0",
}

# Moreland's diverging map, cool to warm: its two ends in sRGB bytes, and D65's reference white.
COOL, WARM = (59, 76, 192), (180, 4, 38)
WHITE = (0.95047, 1.0, 1.08883)


def main():
    for name, source in SOURCES.items():
        colours = getattr(cmcrameri.cm, name, None) or matplotlib.colormaps[name]
        table = [colours(i)[:3] for i in range(colours.N)]
        write(name, source, table)
    table = [coolwarm(i / (ENTRIES - 1)) for i in range(ENTRIES)]
    write("coolwarm", "computed from K. Moreland, Diverging color maps for scientific "
          "visualization, ISVC 2009", table)


def write(name, source, table):
    rows = (" ".join(str(round(255 * min(max(c, 0.0), 1.0))) for c in rgb) for rgb in table)
    head = f"# {name}: {source}\n# sRGB bytes, low to high values; written by tools/colormaps.py\n"
    (DATA / f"{name}.txt").write_text(head + "\n".join(rows) + "\n")


def coolwarm(t):
    """The map at t in [0, 1]: linear in Moreland's Msh space, through a white of M = 88."""
    cool, warm = msh(COOL), msh(WARM)
    middle = max(cool[0], warm[0], 88.0)
    if t < 0.5:
        start, end, t = cool, (middle, 0.0, spun_hue(cool, middle)), 2 * t
    else:
        start, end, t = (middle, 0.0, spun_hue(warm, middle)), warm, 2 * t - 1
    return srgb([(1 - t) * a + t * b for a, b in zip(start, end)])


def spun_hue(colour, middle):
    """Hue of the unsaturated end that keeps the steps of the map even."""
    m, s, h = colour
    if m >= middle:
        return h
    spin = s * sqrt(middle**2 - m**2) / (m * sin(s))
    return h + spin if h > -1.0471975511965976 else h - spin


def msh(rgb):
    """sRGB bytes to the polar form of CIELAB: magnitude, saturation, hue."""
    red, green, blue = (expand(c / 255) for c in rgb)
    xyz = (0.4124 * red + 0.3576 * green + 0.1805 * blue,
           0.2126 * red + 0.7152 * green + 0.0722 * blue,
           0.0193 * red + 0.1192 * green + 0.9505 * blue)
    x, y, z = (lab_curve(c / w) for c, w in zip(xyz, WHITE))
    lightness, a, b = 116 * y - 16, 500 * (x - y), 200 * (y - z)
    m = hypot(lightness, a, b)
    return m, acos(lightness / m), atan2(b, a)


def srgb(polar):
    m, s, h = polar
    lightness, a, b = m * cos(s), m * sin(s) * cos(h), m * sin(s) * sin(h)
    y = (lightness + 16) / 116
    x, y, z = (w * lab_inverse(c) for w, c in zip(WHITE, (y + a / 500, y, y - b / 200)))
    return [compress(c) for c in (3.2406 * x - 1.5372 * y - 0.4986 * z,
                                  -0.9689 * x + 1.8758 * y + 0.0415 * z,
                                  0.0557 * x - 0.2040 * y + 1.0570 * z)]


def expand(c):
    return c / 12.92 if c <= 0.04045 else ((c + 0.055) / 1.055) ** 2.4


def compress(c):
    return 12.92 * c if c <= 0.0031308 else 1.055 * c ** (1 / 2.4) - 0.055


def lab_curve(t):
    return t ** (1 / 3) if t > 0.008856 else 7.787 * t + 16 / 116


def lab_inverse(t):
    return t**3 if t > 0.206893 else (t - 16 / 116) / 7.787


if __name__ == "__main__":
    main()
