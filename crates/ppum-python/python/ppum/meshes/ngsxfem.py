"""Fields of ngsxfem: two fields of NGSolve on the sides of a level set."""

from typing import Any, Unpack

import numpy as np

from .._options import takes
from .._state import Coefficients, Sampled, State
from ._elements import Elements, ImportOptions, compared, imported, importer, labelled, off_level
from .ngsolve import mesh_of, order_of, sampler

__all__ = ["from_ngsxfem", "state"]


@takes(ImportOptions, "from_ngsxfem()")
def state(
    negative: Any, positive: Any, levelset: Any, order: int | None = None, **options: Unpack[ImportOptions]
) -> State:
    """Import a field of ngsxfem: one field of NGSolve where a level set is negative, another where it is positive.

    Cut elements are two patches, on each side with the field's own polynomial.

    Args:
        negative, positive: GridFunctions, such as the components of a compound one.
        levelset: The interpolant that was integrated with, a GridFunction of H1, order 1; the dataset's field ``level``.
        order: Degree of the polynomials; by default the higher one of the spaces.
    """
    mesh = mesh_of(negative, None)
    order = max(order_of(negative), order_of(positive)) if order is None else order
    level_order, count = order_of(levelset), int(negative.dim)
    sides = sampler(mesh, [negative, positive, levelset])
    elements = Elements(sides, max(order, level_order), int(mesh.GetCurveOrder()))
    fields = [elements.polynomials(order, slice(k * count, (k + 1) * count)) for k in (0, 1)]
    level = elements.polynomials(level_order, slice(2 * count, None))
    patches = _patches(_signs(mesh, levelset))
    clips = {k: [("level", 1 if side else -1)] for k, (_, side, cut) in enumerate(patches) if cut}
    of = [element for element, *_ in patches]
    known = compared(sides, options["verify"], lambda values: off_level(values[:, -1]))
    blocks = {"one": [fields[side][element] for element, side, _ in patches]}
    field = labelled(options, blocks, known and _halves(known, count))
    levels = Coefficients("level", {"one": level.at(of)})
    return State(elements.mesh(of, clips), [field, levels])


from_ngsxfem = importer(state, "from_ngsxfem", "ngsxfem, NGSolve", "ngsolve")


def _signs(mesh: Any, levelset: Any) -> list[tuple[bool, bool]]:
    """Return whether each element has a negative and a positive side, as ngsxfem decides it."""
    xfem = imported("xfem")
    cuts = xfem.CutInfo(mesh, levelset)
    has = [cuts.GetElementsOfType(kind) for kind in (xfem.HASNEG, xfem.HASPOS)]
    return [(bool(has[0][k]), bool(has[1][k])) for k in range(mesh.ne)]


def _patches(signs: list[tuple[bool, bool]]) -> list[tuple[int, int, bool]]:
    """Return element, side and whether it is cut, for each patch."""
    return [(k, side, all(has)) for k, has in enumerate(signs) for side in (0, 1) if has[side]]


def _halves(known: Sampled, count: int) -> Sampled:
    """Return the values of the side on which each point lies."""
    lower, upper = known.values[:, :count], known.values[:, count : 2 * count]
    return known._replace(values=np.where(known.values[:, -1:] > 0, upper, lower))
