"""Two-dimensional fracture by the particle-partition of unity method: solve, evaluate exactly, draw.

Numbers go in and come out as numpy arrays. Long calls work on all processors without Python's lock, and Ctrl-C ends them.

Example:
    >>> f = ds.field
    >>> f.at([0.0, 0.5], 0.25).von_mises.shape
    (2,)
"""

from . import _core, basis, plots
from .errors import (
    BuildError,
    Finding,
    FormatError,
    InternalError,
    PpumError,
    ProblemError,
    QuantityError,
    RenderError,
    SolveError,
)
from .building import Coefficients, State, arrays, build, from_arrays
from .comparing import Comparison, Needed, Norms, Resampling
from .cover import Cover
from .curves import arc, ellipse
from .dataset import (
    Advance,
    Crack,
    Dataset,
    Growth,
    Hole,
    Reaction,
    Step,
    Tip,
    from_bytes,
)

# both are of `ppum.` alone: `from ppum import *` leaves Python's own as they are
from .dataset import Warning as Warning
from .dataset import open as open
from .enriching import Component, Formula, Jump, Level, tip_functions
from .exporting import ArrayAccuracy, Triangles
from .field import Field
from .linking import link
from .mesh import Mesh
from .meshes import (
    from_dolfinx,
    from_getfem,
    from_meshio,
    from_mfem,
    from_ngsolve,
    from_ngsxfem,
    from_skfem,
    from_vtu,
)
from .pictures import Animation, Extremum, Figure
from .problem import Elastic, Poisson, Problem, solve
from .sweeping import Sweep, sweep
from .tables import History, Table
from .values import Quantity, Values
from .views import View

__version__ = _core.VERSION

#: Names of the colour maps of figures; with ``_r`` at the end they are reversed.
COLORMAPS: tuple[str, ...] = tuple(_core.colormaps())

__all__ = [
    "COLORMAPS",
    "Advance",
    "Animation",
    "ArrayAccuracy",
    "BuildError",
    "Coefficients",
    "Comparison",
    "Component",
    "Cover",
    "Crack",
    "Dataset",
    "Elastic",
    "Extremum",
    "Field",
    "Figure",
    "Finding",
    "FormatError",
    "Formula",
    "Growth",
    "History",
    "Hole",
    "InternalError",
    "Jump",
    "Level",
    "Mesh",
    "Needed",
    "Norms",
    "Poisson",
    "PpumError",
    "Problem",
    "ProblemError",
    "Quantity",
    "QuantityError",
    "Reaction",
    "RenderError",
    "Resampling",
    "SolveError",
    "State",
    "Step",
    "Sweep",
    "Table",
    "Tip",
    "Triangles",
    "Values",
    "View",
    "arc",
    "arrays",
    "basis",
    "build",
    "ellipse",
    "from_arrays",
    "from_bytes",
    "from_dolfinx",
    "from_getfem",
    "from_meshio",
    "from_mfem",
    "from_ngsolve",
    "from_ngsxfem",
    "from_skfem",
    "from_vtu",
    "link",
    "plots",
    "solve",
    "sweep",
    "tip_functions",
]
