"""Puts two images of one view side by side, with axes, a scale bar and a colour bar:

    beside.py LEFT.png RIGHT.png -o OUT.png CX,CY WIDTH LOW,HIGH LABEL LEFT_TITLE RIGHT_TITLE

Both images are bare and square, with the colours of viridis. The axes give distances from (CX, CY). Needs matplotlib.
"""

import math
import sys

import matplotlib

matplotlib.use("agg")
from matplotlib import pyplot as plt
from matplotlib.cm import ScalarMappable
from matplotlib.colors import Normalize

left, right, _, out, center, width, span, label, *titles = sys.argv[1:]
width = float(width)
power = math.floor(math.log10(width))
half = width / 2 / 10**power
plt.rcParams.update({"font.size": 10})
figure, panels = plt.subplots(1, 2, figsize=(10, 4.7), layout="constrained", sharey=True)
for panel, path, title in zip(panels, [left, right], titles, strict=True):
    panel.imshow(plt.imread(path), extent=(-half, half, -half, half), interpolation="nearest")
    panel.set_title(title)
    x, y, name = center.split(",")[0], center.split(",")[1], f"$10^{{{power}}}$"
    panel.set_xlabel(f"(x − {x}) / {name}")
    panel.plot([0.4 * half, 0.9 * half], [-0.85 * half] * 2, color="white", linewidth=3, solid_capstyle="butt")
    panel.text(0.65 * half, -0.8 * half, f"{half / 2:g} · {name}", color="white", ha="center", va="bottom")
panels[0].set_ylabel(f"(y − {y}) / {name}" if float(y) else f"y / {name}")
low, high = map(float, span.split(","))
bar = ScalarMappable(Normalize(low, high), "viridis")
figure.colorbar(bar, ax=panels, label=label, extend="max", pad=0.01)
figure.savefig(out, dpi=96, pil_kwargs={"optimize": True})
