"""The law of an anisotropic material as the constants of the file format: a stiffness along its axes."""

import math
from typing import Any

from ._checks import scalar, sequence, text
from ._errors import BuildError
from ._problem import Anisotropic

PLANE = ("c11", "c12", "c16", "c22", "c26", "c66")
THROUGH = ("c13", "c23", "c36", "c33")

# compliances of the plane: a_ij = S_ij - E3 p_i p_j, where E3 is zero in plane stress
COMPLIANCE = (
    "let p_1 = nu_13/young_1; let p_2 = nu_23/young_2; let a_11 = 1/young_1 - young_3*p_1*p_1; "
    "let a_12 = -nu_12/young_1 - young_3*p_1*p_2; let a_22 = 1/young_2 - young_3*p_2*p_2; let det = a_11*a_22 - a_12*a_12; "
)
MODULI = {
    "c11": "a_22/det",
    "c12": "-a_12/det",
    "c22": "a_11/det",
    "c13": "young_3*(p_1*a_22 - p_2*a_12)/det",
    "c23": "young_3*(p_2*a_11 - p_1*a_12)/det",
    "c33": "young_3 + young_3^2*(p_1*(p_1*a_22 - p_2*a_12) + p_2*(p_2*a_11 - p_1*a_12))/det",
}


def constant(name: str, value: Any) -> float | str:
    """Return a constant of the equation: a formula, or a number."""
    return value if isinstance(value, str) else scalar(f"equation.{name}", value)


def stiffness(material: Anisotropic) -> dict[str, float | str]:
    """Return the stiffness and the angle of the axes, each a number or a formula."""
    if material.expansion is not None:
        raise BuildError("equation.expansion: anisotropic datasets have no temperature; give `eigenstrain` in its place")
    state = text("equation.state", material.state)
    if state not in ("plane-strain", "plane-stress"):
        raise BuildError(f"equation.state: is {state!r}, but anisotropic bodies are plane; give 'plane-strain' or 'plane-stress'")
    is_strain = state == "plane-strain"
    of = _engineering if material.stiffness is None else _given
    return {**of(material, is_strain), "axis": _radians(material.axis)}


def _radians(degrees: float | str) -> float | str:
    return f"({degrees})*(pi/180)" if isinstance(degrees, str) else math.radians(scalar("equation.axis", degrees))


def _given(material: Anisotropic, is_strain: bool) -> dict[str, float | str]:
    for name in ("young", "poisson", "shear"):
        if getattr(material, name) is not None:
            raise BuildError(f"equation.{name}: contradicts `stiffness`; give one of them")
    rows = [_constants(f"stiffness[{k}]", row, 3) for k, row in enumerate(_entries("stiffness", material.stiffness, 3))]
    if any(rows[i][j] != rows[j][i] for i, j in ((0, 1), (0, 2), (1, 2))):
        raise BuildError("equation.stiffness: is not symmetric; write each modulus off the diagonal twice")
    plane = dict(zip(PLANE, [value for k, row in enumerate(rows) for value in row[k:]]))
    return plane | (dict(zip(THROUGH, _constants("out_of_plane", material.out_of_plane, 4))) if is_strain else {})


def _engineering(material: Anisotropic, is_strain: bool) -> dict[str, float | str]:
    young = _constants("young", material.young, 3 if is_strain else 2)
    poisson = _constants("poisson", material.poisson, 3 if is_strain else 1)
    third = [young[2], *poisson[1:]] if is_strain else [0.0] * 3
    names = ("young_1", "young_2", "nu_12", "young_3", "nu_13", "nu_23")
    lets = "".join(f"let {name} = ({value}); " for name, value in zip(names, [*young[:2], poisson[0], *third]))
    known = PLANE + THROUGH if is_strain else PLANE
    moduli: dict[str, float | str] = {name: f"({lets}{COMPLIANCE}{MODULI[name]})" for name in known if name in MODULI}
    return dict.fromkeys(known, 0.0) | moduli | {"c66": constant("shear", material.shear)}


def _entries(name: str, given: Any, count: int) -> list[Any]:
    entries = list(sequence(f"equation.{name}", given, f"{count} numbers or formulas"))
    if len(entries) != count:
        raise BuildError(f"equation.{name}: has {len(entries)} entries; give {count}")
    return entries


def _constants(name: str, given: Any, count: int) -> list[float | str]:
    return [constant(f"{name}[{k}]", value) for k, value in enumerate(_entries(name, given, count))]
