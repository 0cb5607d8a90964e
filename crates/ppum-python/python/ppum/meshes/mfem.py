"""Fields of MFEM, by PyMFEM."""

from __future__ import annotations

from typing import Any

import numpy as np

from ..building import State
from ..dataset import Dataset
from ..errors import BuildError
from ..extras import needed
from ..interpolating import SQUARE, TRIANGLE
from .importing import Floats, Group, Labels, Places, Sampler, built, compared, smooth, to_unit

__all__ = ["from_mfem", "state"]


def from_mfem(
    gf: Any,
    order: int | None = None,
    *,
    name: str = "u",
    components: list[str] | None = None,
    unit: str = "",
    verify: int = 1000,
    **options: Any,
) -> Dataset:
    """The dataset of a GridFunction of MFEM, sampled at reference points of each element: H1 and L2 of any order on
    straight and curved meshes, with hanging nodes too.

    Args:
        gf: A GridFunction of PyMFEM.
        order: Degree of the polynomials, on squares in each variable; by default the highest of the space.
        name, components, unit, verify, options: As of `from_ngsolve`.
    """
    package = needed("mfem", "mfem", "fields of MFEM")
    made = state(gf, order, labels=Labels(name, components, unit), verify=verify)
    return built(made, "MFEM", getattr(package, "__version__", ""), options)


def state(gf: Any, order: int | None = None, *, labels: Labels = Labels("u"), verify: int = 1000) -> State:
    """The state of `from_mfem`."""
    space = gf.FESpace()
    mesh = space.GetMesh()
    if mesh.Dimension() != 2 or mesh.SpaceDimension() != 2:
        raise BuildError(f"gf: its mesh has {mesh.SpaceDimension()} dimensions, expected 2")
    curve = mesh.GetNodes()
    geometry = int(curve.FESpace().GetMaxElementOrder()) if curve is not None else 1
    order = int(space.GetMaxElementOrder()) if order is None else order
    sample = sampler(gf, mesh)
    return smooth(sample, labels, order, geometry, compared(sample, verify))


def sampler(gf: Any, mesh: Any) -> Sampler:
    mfem = needed("mfem.ser", "mfem", "fields of MFEM")
    shapes = {mfem.Geometry.TRIANGLE: TRIANGLE, mfem.Geometry.SQUARE: SQUARE}
    shape = np.array([shapes[mesh.GetElementGeometry(k)] for k in range(mesh.GetNE())])
    # a space of vectors is not the same as a vector of spaces
    count = int(gf.VectorDim())

    def at(element: int, rule: list[Any]) -> tuple[Floats, Floats]:
        transformation, points, values = mesh.GetElementTransformation(element), [], []
        for place in rule:
            transformation.SetIntPoint(place)
            points.append([float(v) for v in transformation.Transform(place)])
            values.append(_value(mfem, gf, element, place, count))
        return np.array(points)[:, :2], np.array(values)

    def sample(places: Places) -> list[Group]:
        groups = []
        for k in (TRIANGLE, SQUARE):
            elements = np.flatnonzero(shape == k)
            rule = _rule(mfem, to_unit(k, places[k]))
            found = [at(int(element), rule) for element in elements]
            if found:
                points, values = (np.array(part) for part in zip(*found))
                groups.append(Group(k, elements, points, values, places[k]))
        return groups

    return sample


def _rule(mfem: Any, places: Floats) -> list[Any]:
    rule = []
    for x, y in places.tolist():
        rule.append(mfem.IntegrationPoint())
        rule[-1].Set2(x, y)
    return rule


def _value(mfem: Any, gf: Any, element: int, place: Any, count: int) -> list[float]:
    if count == 1:
        return [float(gf.GetValue(element, place))]
    vector = mfem.Vector(count)
    gf.GetVectorValue(element, place, vector)
    return [float(vector[k]) for k in range(count)]
