"""Two-dimensional fracture by the particle-partition of unity method: solve, evaluate exactly, draw.

Numbers go in and come out as numpy arrays. Long calls work on all processors without Python's lock, and Ctrl-C ends them.

Example:
    >>> f = ds.field
    >>> f.at([0.0, 0.5], 0.25).von_mises.shape
    (2,)
"""

from typing import Any as _Any

from . import _core, basis, plots
from ._build import arrays, build, from_arrays
from ._compare import Comparison, Needed, Norms, Resampling
from ._cover import Cover
from ._curves import arc, ellipse
from ._dataset import Dataset, Step, from_bytes
from ._errors import (
    BuildError, Finding, FormatError, InternalError, PpumError, ProblemError, QuantityError, RenderError, SolveError,
)  # fmt: skip
from ._export import ArrayAccuracy, Triangles
from ._facts import Advance, Crack, Growth, Hole, Reaction, Tip
from ._field import Field
from ._functions import Component, Formula, Jump, Level, tip_functions
from ._links import link
from ._mesh import Mesh
from ._pictures import Animation, Extremum, Figure
from ._problem import Elastic, Poisson, Problem, solve
from ._state import Coefficients, State
from ._sweep import Sweep, sweep
from ._tables import History, Table
from ._values import Quantity, Values
from ._views import View
from .meshes import (
    from_dolfinx, from_getfem, from_meshio, from_mfem, from_ngsolve, from_ngsxfem, from_skfem, from_vtu,
)  # fmt: skip

# both are of `ppum.` alone: `from ppum import *` leaves Python's own as they are
from ._facts import Warning as Warning
from ._dataset import open as open

__version__ = _core.VERSION

#: Names of the colour maps of figures; with ``_r`` at the end they are reversed.
COLORMAPS: tuple[str, ...] = tuple(_core.colormaps())

__all__ = [
    "COLORMAPS", "Advance", "Animation", "ArrayAccuracy", "BuildError", "Coefficients", "Comparison", "Component",
    "Cover", "Crack", "Dataset", "Elastic", "Extremum", "Field", "Figure", "Finding", "FormatError", "Formula",
    "Growth", "History", "Hole", "InternalError", "Jump", "Level", "Mesh", "Needed", "Norms", "Poisson", "PpumError",
    "Problem", "ProblemError", "Quantity", "QuantityError", "Reaction", "RenderError", "Resampling", "SolveError",
    "State", "Step", "Sweep", "Table", "Tip", "Triangles", "Values", "View", "arc", "arrays", "basis", "build",
    "ellipse", "from_arrays", "from_bytes", "from_dolfinx", "from_getfem", "from_meshio", "from_mfem", "from_ngsolve",
    "from_ngsxfem", "from_skfem", "from_vtu", "link", "plots", "solve", "sweep", "tip_functions",
]  # fmt: skip


def _viewer(*args: _Any, **options: _Any) -> _Any:
    from ._widget import Viewer

    return Viewer(*args, **options)


# methods of lower layers that make things of upper ones
Dataset._parsed, Field._viewer = staticmethod(Problem.parse), staticmethod(_viewer)

# people and pickles find all that is public here
for _name in (*__all__, "Warning", "open"):
    if getattr(globals()[_name], "__module__", "").startswith("ppum._"):
        globals()[_name].__module__ = "ppum"
