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
from ._files import Drawn, folder_of, replace
from ._options import Option, passes, takes
from ._styles import HtmlOptions, request, request_text
from ._units import Floats, positive
from ._views import SIZE, ProgressOptions
from ._warnings import warn

if TYPE_CHECKING:
    from ._dataset import Dataset
    from ._field import Field

#: Degrees of the polynomials in triangles.
ORDERS = range(1, 5)


RADIUS = (
    "the radius about tips outside of which stresses are resolved; by default 1/50 of the crack, of half of it if both ends "
    "are tips, or of the distance from other borders and cracks if that is less. A smaller one means a larger range"
)
ORDER = (
    "degree of the polynomials between the points of a triangle, 1 to 4; higher ones take fewer triangles for fine "
    "tolerances"
)
AVERAGE = (
    "average where stresses jump between patches or elements, so that triangles share their points but for cracks and "
    "interfaces"
)


class TriangleOptions(ProgressOptions, total=False):
    """How fine triangles are."""

    tolerance: Annotated[float, Option(1e-3, "largest difference from the field, in parts of the range of each array")]
    tip_radius: Annotated[float | None, Option(None, RADIUS)]
    max_cells: Annotated[int, Option(1_000_000, "most triangles, of each step")]
    order: Annotated[int, Option(1, ORDER)]
    average: Annotated[bool, Option(False, AVERAGE)]


@dataclass(frozen=True)
class ArrayAccuracy:
    """How well an array is resolved by triangles.

    Attributes:
        range: Largest minus smallest value, where the array is infinite outside of the radius about such points.
        allowed: The tolerance times the range.
        largest: Largest difference from the field at 20,000 random points that had no part in making the triangles.
        share: The share of these points that are within what is allowed.
        is_singular: Whether the array is infinite somewhere.
    """

    range: float
    allowed: float
    largest: float
    share: float
    is_singular: bool


class TriangleMesh(Drawn):
    """Triangles that resolve a field to a tolerance: between points values are linear, or polynomials of a higher order. Made
    by `field.export.triangles`.

    No triangle crosses a crack; a point on one is there twice, with the values of both sides. They are saved as ``vtu``
    or ``vtkhdf``.

    Attributes:
        points: Shape (n, 2).
        cells: Numbers of the points of each: shape (m, 3), counter-clockwise; of order n (m, (n + 1)(n + 2)/2), in VTK's
            order: corners, points on edges, points inside.
        values: Arrays at the points by their names: shape (n,); vectors (n, 3); symmetric tensors (n, 6), as VTK has them:
            XX, YY, ZZ, XY, YZ, XZ.
        accuracy: How well each of them is resolved.
        singular: Points where arrays are infinite: shape (k, 2).
        tip_radii: The tolerance of such arrays holds outside of these radii about them: shape (k,).
        is_complete: Whether the work was not ended by the limit of triangles.

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
        self.points = core.points()
        self.cells = core.cells()
        self.singular = core.singular()
        self.tip_radii = core.radii()
        self.is_complete = core.is_complete()

    @cached_property
    def accuracy(self) -> Mapping[str, ArrayAccuracy]:
        """How well each array is resolved."""
        return MappingProxyType({one.pop("name"): ArrayAccuracy(**one) for one in self._core.accuracy()})

    @cached_property
    def values(self) -> Mapping[str, Floats]:
        """The arrays by their names."""
        arrays = {name: self._core.values(k) for k, name in enumerate(self.accuracy)}
        return MappingProxyType({name: rows[:, 0] if rows.shape[1] == 1 else rows for name, rows in arrays.items()})

    def to_pyvista(self) -> Any:
        """The same as a `pyvista.UnstructuredGrid`."""
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
    """A field for programs and people that have no ppum."""

    _field: "Field"

    @takes(TriangleOptions)
    def triangles(self, quantities: Sequence[str] | None = None, **options: Unpack[TriangleOptions]) -> TriangleMesh:
        """Triangles for programs that interpolate, fine enough for a tolerance. Warns where the tolerance is not kept.

        Quantities are names and formulas, ``displacement`` and ``stress`` among them; by default the displacement, the stress
        tensor and von Mises' stress, of a potential itself and its gradient.

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
        if isinstance(quantities, str):
            raise TypeError(f"quantities: give a list, [{quantities!r}]")
        if quantities is not None and not quantities:
            raise ValueError("quantities: give one at least, or none for those that suit")
        made = _core.triangles(
            self._field._core,
            None if quantities is None else list(quantities),
            float(options["tolerance"]),
            options["tip_radius"],
            int(options["max_cells"]),
            int(options["order"]),
            bool(options["average"]),
            hashed,
            options["progress"],
        )
        if text := made.complaint():
            warn(text + ("" if made.is_complete() else "; raise max_cells or tolerance"))
        return TriangleMesh(made)

    @passes(TriangleOptions)
    def to_pyvista(self, quantities: Sequence[str] | None = None, **options: Unpack[TriangleOptions]) -> Any:
        """The field as a `pyvista.UnstructuredGrid`, to a tolerance: `triangles`, whose arguments these are."""
        require("pyvista", "pyvista", "grids of PyVista")
        return self.triangles(quantities, **options).to_pyvista()

    @takes(HtmlOptions)
    def to_html(
        self, path: str | os.PathLike[str] | None = None, quantity: str | None = None, **options: Unpack[HtmlOptions]
    ) -> str | None:
        """A page that shows and explores the field exactly in a browser of 2024 or later: one file, without network and
        server, or its text if there is no path. Quantity and options say what is seen first; people change it in the page.

        Example:
            >>> f.export.to_html("plate.html", "uy", tip=0, zoom=100)
            >>> f.export.to_html()[:15]
            '<!doctype html>'
        """
        if quantity is not None and not isinstance(quantity, str):
            raise TypeError("quantity: a page shows one first; give its name")
        field, target = self._field, None if path is None else Path(path)
        if target is not None:
            folder_of(target)
        at = field._place(options, SIZE)
        asked = request_text(field, request(field, quantity, options, at))
        page = _core.page(field._core, field.dataset._core, asked, at, f"{target.stem if target else 'dataset'}.h5")
        if target is None:
            return page
        replace(target, page.encode())
        return None


def hash_of(dataset: "Dataset") -> str:
    """SHA-256 of a dataset's file, in hexadecimal digits."""
    return hashlib.sha256(dataset.to_bytes()).hexdigest()


@takes(TriangleOptions)
def save_triangles(
    dataset: "Dataset", path: Path, quantities: Sequence[str] | None = None, **options: Unpack[TriangleOptions]
) -> None:
    """Writes the triangles of all steps to a ``.vtkhdf`` file, or of the only one to a ``.vtu`` file: `Dataset.save`."""
    steps = list(dataset.steps)
    if path.suffix.lower() == ".vtu" and len(steps) > 1:
        words = "end its name in .vtkhdf, or save `field.export.triangles` of one"
        raise ValueError(f"{path.name}: a .vtu file has one step, this dataset has {len(steps)}; {words}")
    folder_of(path)
    hashed = hash_of(dataset)
    meshes = [step.field.export._triangles(quantities, hashed, options) for step in steps]
    if path.suffix.lower() == ".vtu":
        meshes[0].save(path)
    else:
        replace(path, _core.vtkhdf([mesh._core for mesh in meshes]))
