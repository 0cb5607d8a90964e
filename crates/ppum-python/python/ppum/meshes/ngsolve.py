"""Fields of NGSolve."""

from typing import Any, Unpack

import numpy as np

from .._checks import check_type, real
from .._errors import BuildError
from .._options import takes
from .._shapes import SQUARE, TRIANGLE
from .._state import State
from ._elements import Group, ImportOptions, Places, Sampler, compared, imported, importer, smooth, to_unit

__all__ = ["from_ngsolve", "state"]


@takes(ImportOptions, "from_ngsolve()")
def state(gf: Any, order: int | None = None, *, mesh: Any = None, **options: Unpack[ImportOptions]) -> State:
    """Import a field of NGSolve, exact for any space whose functions are polynomials on elements.

    These are H1, L2, VectorH1, facet bubbles, hp; H(div) and H(curl) on straight elements.

    Args:
        gf: A GridFunction, or a CoefficientFunction that is polynomial on each element.
        order: Degree of the polynomials, on squares in each variable; by default the order of the space.
        mesh: The mesh of a CoefficientFunction.
    """
    mesh = mesh_of(gf, mesh)
    order = order_of(gf) if order is None else order
    sample = sampler(mesh, [gf])
    return smooth(sample, options, order, int(mesh.GetCurveOrder()), compared(sample, options["verify"]))


from_ngsolve = importer(state, "from_ngsolve", "NGSolve", "ngsolve")


def mesh_of(gf: Any, mesh: Any) -> Any:
    check_type("gf", gf, callable(gf), "a GridFunction or a CoefficientFunction of NGSolve")
    # a vector has as many dimensions as components, a compound field one
    if int(gf.dim) < len(getattr(gf, "components", ())):
        raise BuildError("gf: is compound; give one of its parts, such as gf.components[0]")
    if mesh is None:
        if not hasattr(gf, "space"):
            raise BuildError("mesh: a CoefficientFunction knows no mesh; give mesh=")
        mesh = gf.space.mesh
    if mesh.dim != 2:
        raise BuildError(f"mesh: has {mesh.dim} dimensions, expected 2")
    return mesh


def order_of(gf: Any) -> int:
    if not hasattr(gf, "space"):
        raise BuildError("order: a CoefficientFunction knows no order; give order=")
    return max(int(part.space.globalorder) for part in (gf.components or [gf]))


def sampler(mesh: Any, fields: list[Any]) -> Sampler:
    """Sample several fields, one after the other."""
    ngs = imported("ngsolve")
    shapes = {ngs.ET.TRIG: TRIANGLE, ngs.ET.QUAD: SQUARE}
    shape = np.array([shapes[element.type] for element in mesh.Elements(ngs.VOL)])

    def sample(places: Places) -> list[Group]:
        rules = {
            kind: ngs.IntegrationRule([tuple(p) for p in to_unit(k, places[k]).tolist()], [0.0] * len(places[k]))
            for kind, k in shapes.items()
        }
        mapped = mesh.MapToAllElements(rules, ngs.VOL)
        points = np.asarray(ngs.CF((ngs.x, ngs.y))(mapped))
        values = np.hstack([real("gf", field(mapped)).reshape(len(points), -1) for field in fields])
        # points stand element by element
        of = np.repeat(shape, [len(places[k]) for k in shape])
        present = [k for k in (TRIANGLE, SQUARE) if (shape == k).any()]
        cut = [[a[of == k].reshape(-1, len(places[k]), a.shape[1]) for a in (points, values)] for k in present]
        return [Group(k, np.flatnonzero(shape == k), a, b, places[k]) for k, (a, b) in zip(present, cut)]

    return sample
