"""Triangles and pages of a field, for programs and people that have no ppum."""

import hashlib
import os
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property
from pathlib import Path
from types import MappingProxyType
from typing import TYPE_CHECKING, Annotated, Any, Unpack

import numpy as np

from . import _core
from ._errors import require
from ._files import Drawn
from ._options import Option, passes, takes
from ._sample import names_of
from ._styles import HtmlOptions, checked_request, request
from ._units import Floats, positive
from ._views import ProgressOptions
from ._warnings import warn

if TYPE_CHECKING:
    from ._dataset import Dataset
    from ._field import Field

#: Degrees of the polynomials in triangles.
ORDERS = range(1, 5)

RADIUS = "radius about tips outside of which stresses are resolved; by default 1/50 of the crack, or of the distance to others"
ORDER = "degree of the polynomials on triangles, 1 to 4; higher ones take fewer triangles for fine tolerances"
AVERAGE = "average where stresses jump between patches or elements: triangles share points except at cracks and interfaces"


class TriangleOptions(ProgressOptions, total=False):
    """The accuracy of triangles."""

    tolerance: Annotated[float, Option(1e-3, "largest difference from the field, in parts of the range of each array")]
    tip_radius: Annotated[float | None, Option(None, RADIUS)]
    max_cells: Annotated[int, Option(1_000_000, "most triangles, of each step")]
    order: Annotated[int, Option(1, ORDER)]
    average: Annotated[bool, Option(False, AVERAGE)]


@dataclass(frozen=True)
class ArrayAccuracy:
    """The accuracy of an array on triangles.

    Attributes:
        range: Largest minus smallest value, outside of `TriangleMesh.tip_radii`.
        allowed: The tolerance times the range.
        largest: Largest difference from the field at 20,000 random points that had no part in making the triangles.
        share: The share of these points within the tolerance.
        is_singular: Whether the array is infinite somewhere.
    """

    range: float
    allowed: float
    largest: float
    share: float
    is_singular: bool


class TriangleMesh(Drawn):
    """Triangles on which values are linear, or polynomials of a higher order. Made by `field.export.triangles`.

    No triangle crosses a crack; a point on one is there twice, with the values of both sides. Files are ``vtu`` or ``vtkhdf``.

    Attributes:
        points: Shape (n, 2).
        cells: Numbers of points: shape (m, 3), counter-clockwise; of order n (m, (n + 1)(n + 2)/2), in VTK's order.
        values: Arrays at the points by name: shape (n,); vectors (n, 3); symmetric tensors (n, 6): XX, YY, ZZ, XY, YZ, XZ.
        accuracy: The accuracy of each array.
        singular: Points where arrays are infinite: shape (k, 2).
        tip_radii: The tolerance of such arrays holds outside of these radii about them: shape (k,).
        is_complete: False if the limit of triangles was reached before the tolerance.

    Example:
        >>> mesh = f.export.triangles(["displacement", "uy"], tolerance=0.01)
        >>> mesh.values["uy"].shape == (len(mesh.points),)
        True
        >>> mesh.save("plate.vtu")
    """

    _forms = ("vtu", "vtkhdf")

    def __init__(self, core: _core.Triangles) -> None:
        super().__init__()
        self._core = core
        self.points, self.cells, self.singular, self.tip_radii, self.is_complete = core.mesh()

    @cached_property
    def accuracy(self) -> Mapping[str, ArrayAccuracy]:
        """Accuracy of each array by its name."""
        return MappingProxyType({name: ArrayAccuracy(*numbers, infinite) for name, numbers, infinite in self._core.accuracy()})

    @cached_property
    def values(self) -> Mapping[str, Floats]:
        """Arrays at the points by their names."""
        arrays = {name: self._core.values(k) for k, name in enumerate(self.accuracy)}
        return MappingProxyType({name: rows[:, 0] if rows.shape[1] == 1 else rows for name, rows in arrays.items()})

    def to_pyvista(self) -> Any:
        """Return a `pyvista.UnstructuredGrid`."""
        pyvista = require("pyvista", "pyvista", "grids of PyVista")
        points = np.column_stack([self.points, np.zeros(len(self.points))])
        types = pyvista.CellType
        kind = types.TRIANGLE if self.cells.shape[1] == 3 else types.LAGRANGE_TRIANGLE
        sizes = np.full((len(self.cells), 1), self.cells.shape[1])
        cells = np.hstack([sizes, self.cells])
        grid = pyvista.UnstructuredGrid(cells.ravel(), np.full(len(cells), kind, np.uint8), points)
        for name, rows in self.values.items():
            grid.point_data[name] = rows
        for name, found in self.accuracy.items():
            grid.field_data[f"{name} largest difference"] = np.array([found.largest])
        return grid

    def _draw(self, form: str) -> bytes:
        return self._core.vtu() if form == "vtu" else _core.vtkhdf([self._core])

    def __reduce__(self) -> tuple[Any, ...]:
        raise TypeError("triangles cannot be pickled; pickle the field, or save them")

    def __repr__(self) -> str:
        return f"<ppum.TriangleMesh {len(self.cells)} on {len(self.points)} points, {', '.join(self.accuracy)}>"


@dataclass(frozen=True)
class Export:
    """Files and meshes of a field for other programs."""

    _field: "Field"

    @takes(TriangleOptions)
    def triangles(self, quantities: Sequence[str] | None = None, **options: Unpack[TriangleOptions]) -> TriangleMesh:
        """Make triangles for programs that interpolate, fine enough for a tolerance. Warns where the tolerance is not kept.

        Quantities are names and formulas, ``displacement`` and ``stress`` among them; the default is the displacement, the
        stress tensor and von Mises' stress, or a potential and its gradient.

        Raises:
            RenderError: More triangles are needed along cracks and borders alone.

        Example:
            >>> f.export.triangles(["uy"], tolerance=0.01).accuracy["uy"].largest < 0.05
            True
        """
        return self._triangles(quantities, hash_of(self._field.dataset), options)

    def _triangles(self, quantities: Sequence[str] | None, hashed: str, options: TriangleOptions) -> TriangleMesh:
        for name in ("tolerance", "tip_radius"):
            positive(name, options[name])
        if options["order"] not in ORDERS:
            raise ValueError(f"order: {options['order']} is not one of 1, 2, 3 and 4")
        names = None if quantities is None else names_of(quantities)
        if names == []:
            raise ValueError("quantities: give one at least, or none for those that suit")
        accuracy = float(options["tolerance"]), options["tip_radius"], int(options["max_cells"]), int(options["order"])
        average, progress = bool(options["average"]), options["progress"]
        made = _core.triangles(self._field._core, names, *accuracy, average, hashed, progress)
        mesh = TriangleMesh(made)
        if text := made.complaint():
            warn(text + ("" if mesh.is_complete else "; raise max_cells or tolerance"))
        return mesh

    @passes(TriangleOptions)
    def to_pyvista(self, quantities: Sequence[str] | None = None, **options: Unpack[TriangleOptions]) -> Any:
        """Return a `pyvista.UnstructuredGrid` of `triangles`, whose arguments these are."""
        require("pyvista", "pyvista", "grids of PyVista")
        return self.triangles(quantities, **options).to_pyvista()

    @takes(HtmlOptions)
    def to_html(
        self, path: str | os.PathLike[str] | None = None, quantity: str | None = None, **options: Unpack[HtmlOptions]
    ) -> str | None:
        """Write a page that explores the field exactly in a browser of 2024 or later, or return its text without a path.

        It is one file, without network and server. Quantity and options are those of the first view.

        Example:
            >>> f.export.to_html("plate.html", "uy", tip=0, zoom=100)
            >>> f.export.to_html()[:15]
            '<!doctype html>'
        """
        if quantity is not None and not isinstance(quantity, str):
            raise TypeError("quantity: a page shows one first; give its name")
        field, target = self._field, None if path is None else Path(path)
        if target is not None:
            _core.check_target(target)
        at = field._place(options)
        asked = checked_request(field, request(field, quantity, options, at))
        page = _core.page(field._core, asked, at, f"{target.stem if target else 'dataset'}.h5")
        if target is None:
            return page
        _core.replace(target, page.encode())
        return None


def hash_of(dataset: "Dataset") -> str:
    """Return the SHA-256 of a dataset's file, in hexadecimal digits."""
    return hashlib.sha256(dataset.to_bytes()).hexdigest()


@takes(TriangleOptions)
def save_triangles(
    dataset: "Dataset", path: Path, quantities: Sequence[str] | None = None, **options: Unpack[TriangleOptions]
) -> None:
    """Write the triangles of all steps to a ``.vtkhdf`` file, or of the only one to a ``.vtu`` file."""
    steps = list(dataset.steps)
    if path.suffix.lower() == ".vtu" and len(steps) > 1:
        words = "end its name in .vtkhdf, or save `field.export.triangles` of one"
        raise ValueError(f"{path.name}: a .vtu file has one step, this dataset has {len(steps)}; {words}")
    _core.check_target(path)
    hashed = hash_of(dataset)
    meshes = [step.field.export._triangles(quantities, hashed, options) for step in steps]
    if path.suffix.lower() == ".vtu":
        meshes[0].save(path)
    else:
        _core.replace(path, _core.vtkhdf([mesh._core for mesh in meshes]))
