"""Warnings at the line outside of the package that led to them; old names, which warn for one version and say the new one."""

import operator
import os
import sys
import warnings
from typing import Any, TypeVar

_T = TypeVar("_T")

#: The folder of the package, which warnings are never located in.
PACKAGE = os.path.join(os.path.dirname(__file__), "")

_BUILD = "Coefficients Component Cover Formula Jump Level Mesh State arrays from_arrays tip_functions"
_MESHES = "from_dolfinx from_getfem from_meshio from_mfem from_ngsolve from_ngsxfem from_skfem from_vtu"
_RESULTS = (
    "Advance ArrayAccuracy Comparison Extremum Growth History Needed Norms Quantity Reaction Resampling Table Values Warning"
)
_MOVED = {"build": _BUILD, "meshes": _MESHES, "results": _RESULTS}
_ACCESSORS = {
    "sample": "line circle around ray grid extrema",
    "draw": "render figure animate plot",
    "export": "triangles to_pyvista to_html",
}


def _listed(places: dict[str, str]) -> dict[str, str]:
    return {name: f"{place}.{name}" for place, names in places.items() for name in names.split()}


#: The new names by the old ones, of the package and of its classes.
NAMES = {
    "ppum": _listed(_MOVED) | {"Finding": "Diagnostic", "Triangles": "TriangleMesh", "from_bytes": "open"},
    "Field": _listed(_ACCESSORS) | {"along": "sample.crack", "rgba": "draw.image", "resampled": "compare.resample"},
    "ProblemError": {"findings": "diagnostics"},
}


def renamed(owner: str, name: str, thing: Any) -> Any:
    """Return the attribute of a thing that an old name stands for."""
    if name not in NAMES[owner]:
        raise AttributeError(f"{owner} has no attribute {name!r}", name=name, obj=thing)
    new = NAMES[owner][name]
    warn(f"{owner}.{name} is now {owner}.{new}; the old name goes with the next version", kind=DeprecationWarning)
    return operator.attrgetter(new)(thing)


class _Renamed:

    def __init__(self, owner: str, name: str) -> None:
        self._owner, self._name = owner, name

    def __get__(self, thing: Any, kind: type) -> Any:
        return renamed(self._owner, self._name, kind if thing is None else thing)


def with_old_names(kind: type[_T]) -> type[_T]:
    """Give the attributes of a class their old names too, which completion does not offer."""
    names = NAMES[kind.__name__]
    for name in names:
        setattr(kind, name, _Renamed(kind.__name__, name))
    kind.__dir__ = lambda self: [name for name in object.__dir__(self) if name not in names]  # type: ignore[method-assign]
    return kind


def warn(*texts: str, kind: type[Warning] = UserWarning) -> None:
    """Warn at the line outside of the package that led here."""
    level, frame = 1, sys._getframe()
    while frame.f_code.co_filename.startswith(PACKAGE) and frame.f_back:
        level, frame = level + 1, frame.f_back
    for text in texts:
        warnings.warn(text, kind, stacklevel=level)
