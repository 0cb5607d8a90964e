"""Fields of finite element libraries, where these are installed: their arrays by the independent reader, against the
library's own values; and the page docs/meshes.md."""

import importlib.util
import re
import subprocess
import sys

import numpy as np
import ppum
import pytest
from conftest import ROOT

h5py = pytest.importorskip("h5py")
sys.path.insert(0, str(ROOT / "tests/python"))
from mesh_cases import LIBRARIES, reference  # noqa: E402
from mesh_files import write  # noqa: E402
from ppum_reader import Field  # noqa: E402

PAGE = ROOT / "docs/meshes.md"
#: Largest differences; DOLFINx and GetFEM search reference points to a tolerance, Argyris elements cancel.
TOLERANCES = {"dolfinx": 1e-12, "getfem": 1e-12, "skfem": 2e-11}
POINTS = 60


def has(library):
    return importlib.util.find_spec(library) is not None


def knows_meshes():
    mesh = ppum.build.Mesh.from_nodes([[(0, 0), (1, 0), (0, 1)]])
    try:
        ppum.build.dataset(ppum.build.State(mesh, ppum.build.Coefficients("u", {"one": [[1.0]]})))
    except ppum.BuildError:
        return False
    return True


@pytest.mark.parametrize("library", LIBRARIES)
def test_libraries(library, tmp_path):
    if not has(library):
        pytest.skip(f"{library} is not installed")
    for name, state in LIBRARIES[library]():
        write(tmp_path / "mesh.h5", ppum.build.arrays(state))
        with h5py.File(tmp_path / "mesh.h5") as file:
            field = Field(file)
        points, values = (part[:POINTS] for part in reference(state))
        found = np.array([[jet[0] for jet in field.evaluate(*p)] for p in points])
        difference = np.abs(found - values).max() / np.abs(values).max()
        assert difference < TOLERANCES.get(library, 1e-13), (name, difference)


MISSING = {
    "dolfinx": (lambda: ppum.meshes.from_dolfinx(None), "fields of DOLFINx need dolfinx: conda install -c conda-forge fenics"),
    "meshio": (lambda: ppum.meshes.from_meshio(None), "meshes of meshio need meshio: pip install meshio"),
    "skfem": (lambda: ppum.meshes.from_skfem(None, None), "fields of scikit-fem need skfem: pip install scikit-fem"),
    "vtk": (lambda: ppum.meshes.from_vtu("none.vtkhdf"), "files of VTK need vtk: pip install vtk"),
}


@pytest.mark.parametrize("library", MISSING)
def test_missing_libraries(library):
    call, said = MISSING[library]
    if has(library):
        pytest.skip(f"{library} is installed")
    with pytest.raises(ImportError, match=said):
        call()


def test_nothing_is_imported_before_it_is_called():
    names = ", ".join(repr(name) for name in [*LIBRARIES, "meshio"])
    code = f"import sys, ppum; print([name for name in ({names}) if name in sys.modules])"
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    assert done.stdout.strip() == "[]"


BLOCKS = re.findall(r"```python ?(\w*)\n(.*?)```", PAGE.read_text(), re.DOTALL)


def test_the_page_names_all_libraries():
    assert {"ngsolve", "xfem", "skfem", "dolfinx", "mfem", "getfem", "meshio", ""} == {library for library, _ in BLOCKS}


@pytest.mark.parametrize("library", sorted({library for library, _ in BLOCKS}))
def test_the_page_runs(library, tmp_path):
    if library and not has(library):
        pytest.skip(f"{library} is not installed")
    if library and not knows_meshes():
        pytest.skip("the compiled module of this build knows no meshes")
    code = "\n".join(block for of, block in BLOCKS if of == library)
    done = subprocess.run([sys.executable, "-c", code], cwd=tmp_path, capture_output=True, text=True)
    assert done.returncode == 0, done.stderr
