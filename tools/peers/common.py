"""What the peers' scripts have in common: views, timing, colours, the report."""

import json
import platform
import statistics
import sys
import time
from pathlib import Path

import numpy as np

PIXELS = (1024, 768)

# Centre, height and largest value of the colours of the two views: the whole plate, and the right tip 1000 times enlarged.
VIEWS = {"whole": ((0.0, 0.0), 2.0, 4.0), "tip": ((0.5, 0.0), 2e-3, 100.0)}


def milliseconds(draw, frames):
    """Least and median of the time that passes and of the processor time of all threads, for `draw(k)`."""
    draw(0)
    walls, cores = [], []
    for k in range(1, frames + 1):
        wall, core = time.perf_counter(), time.process_time()
        draw(k)
        walls.append(1e3 * (time.perf_counter() - wall))
        cores.append(1e3 * (time.process_time() - core))
    of = lambda all: {"least": round(min(all), 3), "median": round(statistics.median(all), 3)}
    return {"wall_ms": of(walls), "core_ms": of(cores)}


def moved(view, k):
    """The centre of frame k: another one each time, by a part of a pixel or some."""
    (x, y), height, _ = VIEWS[view]
    return x + 0.002 * height * ((0.618 * k) % 1 - 0.5), y + 0.002 * height * ((0.755 * k) % 1 - 0.5)


def viridis(n=256):
    """Colours of the map, n × 3, from 0 to 255."""
    import matplotlib

    return (matplotlib.colormaps["viridis"](np.linspace(0, 1, n))[:, :3] * 255 + 0.5).astype(np.uint8)


def report(name, versions, pictures, data, view):
    """Prints the result as JSON: the frame's times after the data have changed, and after the view alone has."""
    versions = {"python": platform.python_version()} | versions
    json.dump({"name": name, "versions": versions, "pictures": pictures, "data": data, "view": view}, sys.stdout)
    print()


def folder():
    """The folder of run.py's files, the first argument, and the number of frames, the second."""
    return Path(sys.argv[1]), int(sys.argv[2])
