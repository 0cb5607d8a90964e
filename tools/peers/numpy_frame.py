"""The field itself, evaluated by numpy at every pixel: exact, vectorised over all pairs of a pixel and a patch.

    numpy_frame.py FOLDER FRAMES        reads FOLDER/plate.h5, writes FOLDER/numpy-VIEW.png

Written from FORMAT.md for datasets with one straight crack along x whose functions are one, its sides and Westergaard's.
"""

import h5py
import numpy as np

from common import PIXELS, VIEWS, folder, milliseconds, moved, report, viridis


class Plate:
    def __init__(self, path):
        with h5py.File(path) as file:
            step = file["steps/0000"]
            part, field = step["partition"], step["fields/0000"]
            self.center, self.half, self.scale = (part[k][()] for k in ("center", "half", "scale"))
            assert part.attrs["weight"] == b"linear" and (part["origin"][()] == self.center).all()
            self.tips = step["cracks/points"][()]
            kinds = [k.decode() for k in step["functions/kind"][()]]
            components = len(kinds) - 10
            assert kinds == ["one", "side"] + ["formula"] * 8 + ["component"] * components
            assert (self.tips[:, 1] == 0).all()
            # each has one cut: what it is above and below the crack
            cuts = step["functions/cuts"][()] if components else np.zeros((0, 4))
            assert len(cuts) == components
            self.sides = {1: (1.0, -1.0)} | {10 + k: tuple(cut[2:] == -2) for k, cut in enumerate(cuts)}
            self.count = len(kinds)
            self.read_blocks({k: field[k][()] for k in field})
            material = file["equation"].attrs
            young, poisson = material["young"], material["poisson"]
            self.poisson, self.mu = poisson, young / (2 * (1 + poisson))
            self.lam = young * poisson / ((1 + poisson) * (1 - 2 * poisson))

    def read_blocks(self, data):
        """Polynomials of each patch: of a component and function six coefficients, zero where it has none."""
        blocks, n = data["patch_blocks"].astype(int), len(self.center)
        patch = np.repeat(np.arange(n), np.diff(blocks))
        assert (data["block_degree"] == 2).all()
        at = data["block_offset"].astype(int)[:, None] + np.arange(6)
        self.blocks = np.zeros((2, self.count, 6, n))
        self.blocks[:, data["block_function"], :, patch] = data["coefficients"][:, at].swapaxes(0, 1)
        self.has = self.blocks.any(axis=(0, 2))

    def stress(self, xs, ys):
        """The von Mises stress at all points of a grid."""
        shape = len(ys), len(xs)
        patch, i, j = self.pairs(xs, ys)
        pixel = j * len(xs) + i
        x, y = xs[i], ys[j]
        to = 1 / self.half[patch]
        xi, eta = ((x, y) - self.center[patch].T) * to.T
        wx, wy = 1 - np.abs(xi), 1 - np.abs(eta)
        w, wdx, wdy = wx * wy, -np.sign(xi) * to[:, 0] * wy, -np.sign(eta) * to[:, 1] * wx
        total = lambda v: np.bincount(pixel, v, minlength=shape[0] * shape[1])
        s, sx, sy = total(w), total(wdx), total(wdy)
        slopes = []
        for c in range(2):
            v, vx, vy = self.local(patch, c, x, y, xi, eta)
            u = total(w * v) / s
            slopes += [(total(wdx * v + w * vx) - u * sx) / s, (total(wdy * v + w * vy) - u * sy) / s]
        return self.mises(*slopes).reshape(shape)

    def pairs(self, xs, ys):
        """Patch, column and row of all points that a patch covers."""
        lo, hi = self.center - self.half, self.center + self.half
        (i0, i1), (j0, j1) = (
            [np.searchsorted(at, bound[:, k]) for bound in (lo, hi)] for k, at in enumerate((xs, ys))
        )
        width, count = i1 - i0, (i1 - i0) * (j1 - j0)
        patch = np.repeat(np.arange(len(count)), count)
        k = np.arange(count.sum()) - np.repeat(np.cumsum(count) - count, count)
        return patch, i0[patch] + k % width[patch], j0[patch] + k // width[patch]

    def local(self, patch, c, x, y, xi, eta):
        """A component of the patches' own fields, with its gradient."""
        to = 1 / self.scale[patch].T
        total = [np.zeros(len(patch)) for _ in range(3)]
        for function in range(self.count):
            here = np.flatnonzero(self.has[function][patch])
            p, px, py = polynomial(self.blocks[c, function][:, patch[here]], xi[here], eta[here])
            f, fx, fy = self.function(function, x[here], y[here])
            parts = f * p, fx * p + f * px * to[0, here], fy * p + f * py * to[1, here]
            for sum, part in zip(total, parts):
                sum[here] += part
        return total

    def function(self, function, x, y):
        """A function of the table, with its gradient."""
        if function == 0:
            return 1.0, 0.0, 0.0
        if function in self.sides:
            return np.where(y >= 0, *map(float, self.sides[function])), 0.0, 0.0
        tip, which = divmod(function - 2, 4)
        return westergaard(x, y, self.tips[tip], (-1, 1)[tip], which)

    def mises(self, dux_dx, dux_dy, duy_dx, duy_dy):
        shear = np.hypot(dux_dx - duy_dy, dux_dy + duy_dx)
        mean = (self.lam + self.mu) * (1 - 2 * self.poisson) * (dux_dx + duy_dy)
        return np.hypot(np.sqrt(3) * self.mu * shear, mean)


def polynomial(c, x, y):
    """Σ c x^a y^b of degree 2 with its derivatives by x and y."""
    v = c[0] + x * (c[1] + c[3] * x + c[4] * y) + y * (c[2] + c[5] * y)
    return v, c[1] + 2 * c[3] * x + c[4] * y, c[2] + c[4] * x + 2 * c[5] * y


def westergaard(x, y, tip, direction, which):
    """One of the four functions of a tip, with its gradient, by half-angle algebra."""
    x, y = direction * (x - tip[0]), direction * (y - tip[1])
    r = np.hypot(x, y)
    # √r cos(θ/2) and √r sin(θ/2), as values, d/dx and d/dy
    c, s = np.sqrt((r + x) / 2), np.where(direction * y >= 0, 1.0, -1.0) * direction * np.sqrt((r - x) / 2)
    root = (c, c / (2 * r), s / (2 * r)) if which in (0, 3) else (s, -s / (2 * r), c / (2 * r))
    value, dx, dy = root
    if which >= 2:
        sine, sine_x, sine_y = y / r, -x * y / r**3, x * x / r**3
        value, dx, dy = sine * value, sine_x * value + sine * dx, sine_y * value + sine * dy
    return value, direction * dx, direction * dy


def frame(plate, view, k):
    """A frame of a view in colours, its centre moved."""
    _, height, most = VIEWS[view]
    (cx, cy), (columns, rows) = (moved(view, k) if k else VIEWS[view][0]), PIXELS
    pixel = height / rows
    xs = cx + pixel * (np.arange(columns) + 0.5 - columns / 2)
    ys = cy + pixel * (np.arange(rows) + 0.5 - rows / 2)
    with np.errstate(invalid="ignore", divide="ignore"):
        values = plate.stress(xs, ys)[::-1]
    entry = np.clip(np.nan_to_num(values / most) * 255 + 0.5, 0, 255).astype(np.uint8)
    return np.where(np.isnan(values)[..., None], np.uint8(255), viridis()[entry])


def main():
    from PIL import Image

    at, frames = folder()
    plate, pictures = Plate(at / "plate.h5"), {}
    for view in VIEWS:
        pictures[view] = f"numpy-{view}.png"
        Image.fromarray(frame(plate, view, 0)).save(at / pictures[view])
    # every frame evaluates everything, whether the data are new or the view
    times = milliseconds(lambda k: frame(plate, "whole", k), max(3, frames // 3))
    versions = {"numpy": np.__version__, "h5py": h5py.__version__}
    report("numpy, the field itself", versions, pictures, times, times)


main()
