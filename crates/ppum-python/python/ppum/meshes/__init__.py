"""Fields of finite element libraries as datasets: a module for each, which needs the library only when it is called."""

from .dolfinx import from_dolfinx
from .getfem import from_getfem
from .mfem import from_mfem
from .ngsolve import from_ngsolve
from .ngsxfem import from_ngsxfem
from .skfem import from_skfem
from .vtk import from_meshio, from_vtu

__all__ = [
    "from_dolfinx", "from_getfem", "from_meshio", "from_mfem", "from_ngsolve", "from_ngsxfem", "from_skfem", "from_vtu",
]  # fmt: skip
