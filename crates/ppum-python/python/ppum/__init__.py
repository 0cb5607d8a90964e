"""Two-dimensional fracture by the particle-partition of unity method: solve, evaluate exactly, draw.

Numbers go in and come out as numpy arrays. Long calls work on all processors without Python's lock, and Ctrl-C ends them.

Example:
    >>> f = ds.field
    >>> f.at([0.0, 0.5], 0.25).von_mises.shape
    (2,)
"""

import sys as _sys
from typing import Any as _Any

from . import _core, basis, build, meshes, plots, results
from ._compare import Compare as _Compare
from ._dataset import Dataset, Step
from ._draw import Animation, Draw as _Draw, Figure
from ._errors import (
    BuildError, Diagnostic, FormatError, InternalError, PpumError, ProblemError, QuantityError, RenderError, SolveError,
)  # fmt: skip
from ._export import Export as _Export, TriangleMesh
from ._facts import Crack, Hole, Tip
from ._field import Field
from ._links import link
from ._problem import Anisotropic, Elastic, Poisson, Problem, solve
from ._sample import Sample as _Sample
from ._sections import arc, ellipse
from ._sweep import Sweep, sweep
from ._views import View
from ._weights import Weight, weight as _weight
from ._warnings import renamed as _renamed

# of `ppum.` alone: `from ppum import *` leaves Python's own as it is
from ._dataset import open as open

__version__ = _core.VERSION

#: Names of the colour maps of figures; with ``_r`` at the end they are reversed.
COLORMAPS: tuple[str, ...] = tuple(_core.colormaps())

__all__ = [
    "COLORMAPS", "Animation", "Anisotropic", "BuildError", "Crack", "Dataset", "Diagnostic", "Elastic", "Field", "Figure",
    "FormatError", "Hole", "InternalError", "Poisson", "PpumError", "Problem", "ProblemError", "QuantityError",
    "RenderError", "SolveError", "Step", "Sweep", "Tip", "TriangleMesh", "View", "Weight", "arc", "basis", "build", "ellipse",
    "link", "meshes",
    "plots", "results", "solve", "sweep",
]  # fmt: skip


def __getattr__(name: str) -> _Any:
    return _renamed("ppum", name, _sys.modules[__name__])


class _Accessor:
    """An attribute of fields that holds the field; the attribute of the class is the accessor's class."""

    def __init__(self, kind: type) -> None:
        self._kind, self.__doc__ = kind, kind.__doc__

    def __get__(self, field: Field | None, owner: type) -> _Any:
        return self._kind if field is None else self._kind(field)


def _viewer(*args: _Any, **options: _Any) -> _Any:
    from ._widget import Viewer

    return Viewer(*args, **options)


# attributes of lower layers that are of upper ones
Dataset.weight = _weight
Dataset._parsed, Field._viewer = staticmethod(Problem.parse), staticmethod(_viewer)
for _kind in (_Sample, _Draw, _Export, _Compare):
    setattr(Field, _kind.__name__.lower(), _Accessor(_kind))

# people and pickles find all that is public where it is offered
for _module in (results, build, _sys.modules[__name__]):
    for _name in (*_module.__all__, "open"):
        if getattr(_thing := getattr(_module, _name, None), "__module__", "").startswith("ppum."):
            _thing.__module__ = _module.__name__
