"""Fields of scikit-fem."""

from typing import Any, Unpack

import numpy as np

from .._checks import real
from .._errors import BuildError
from .._options import takes
from .._shapes import SQUARE, TRIANGLE
from .._state import State
from .._units import Floats
from ._elements import Group, ImportOptions, Places, Sampler, compared, importer, smooth, to_unit

__all__ = ["from_skfem", "state"]


@takes(ImportOptions, "from_skfem()")
def state(basis: Any, u: Any, order: int | None = None, **options: Unpack[ImportOptions]) -> State:
    """Import a field of scikit-fem: degrees of freedom times the shape functions of the elements.

    Args:
        basis: A Basis on triangles or quadrilaterals.
        u: The degrees of freedom.
        order: Degree of the polynomials, on squares in each variable; by default the one of the element.
    """
    shape = shape_of(basis.mesh)
    order = _degree(basis.elem, shape) if order is None else order
    sample = sampler(basis, u)
    return smooth(sample, options, order, _degree(basis.mesh.elem(), shape), compared(sample, options["verify"]))


from_skfem = importer(state, "from_skfem", "scikit-fem", "skfem")


def shape_of(mesh: Any) -> int:
    known = {"RefTri": TRIANGLE, "RefQuad": SQUARE}
    name = getattr(mesh.elem.refdom, "__name__", "")
    if name not in known:
        raise BuildError(f"basis: its mesh has elements of the kind {name}, expected triangles or quadrilaterals")
    return known[name]


def _degree(element: Any, shape: int) -> int:
    """Return the degree of an element; that of quadrilaterals counts both variables."""
    degree = int(element.maxdeg)
    return (degree + 1) // 2 if shape == SQUARE else degree


def _dofs(basis: Any, u: Any) -> Floats:
    values = real("u", u)
    if values.shape != (basis.N,):
        raise BuildError(
            f"u: has the shape {values.shape}, but the basis has {int(basis.N)} degrees of freedom; give both of one basis"
        )
    return values


def sampler(basis: Any, u: Any) -> Sampler:
    shape, dofs = shape_of(basis.mesh), _dofs(basis, u)[basis.element_dofs]

    def values(at: Floats) -> Floats:
        total: Any = 0.0
        for k, row in enumerate(dofs):
            function = np.asarray(basis.elem.gbasis(basis.mapping, at, k)[0])
            total = total + row[:, None] * function
        total = np.broadcast_to(total, (*np.shape(total)[:-2], dofs.shape[1], at.shape[1]))
        return np.moveaxis(total.reshape(-1, *total.shape[-2:]), 0, -1)

    def sample(places: Places) -> list[Group]:
        at = to_unit(shape, places[shape]).T
        points = np.moveaxis(np.asarray(basis.mapping.F(at)), 0, -1)
        return [Group(shape, np.arange(dofs.shape[1]), points, values(at), places[shape])]

    return sample
