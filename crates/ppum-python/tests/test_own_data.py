"""What goes wrong with own data is said where it is, in the words of the arguments, with what to look at."""

import itertools
import re
import time
import warnings

import numpy as np
import ppum
import pytest
from ppum._blocks import exponents
from ppum._options import defaults
from ppum._shapes import TRIANGLE, vandermonde
from ppum.meshes._elements import Group, ImportOptions, compared, smooth

COVER = ppum.build.Cover.uniform([(0, 0), (2, 1)], (8, 4))
ONE = np.ones((32, 1))
TIP = np.array([1.0, 0.5])
NEAR = [k for k in range(32) if np.abs(COVER.center[k] - TIP).max() < 0.3]
CORNER = "sqrt(r)*sin(theta/2)"


def state(name="u", blocks=None, cover=COVER, **more):
    components = more.pop("components", None)
    verify = more.pop("verify", None)
    field = ppum.build.Coefficients(name, {"one": ONE} if blocks is None else blocks, components=components, verify=verify)
    return ppum.build.State(cover, field, **more)


def enriched(x, y):
    """1 + Σ φ √r sin θ/2 over the patches near the tip."""
    weights = np.array([
        np.maximum(1 - np.abs(x - c[0]) / h[0], 0) * np.maximum(1 - np.abs(y - c[1]) / h[1], 0)
        for c, h in zip(COVER.center, COVER.half)
    ])  # fmt: skip
    r, theta = np.hypot(x - TIP[0], y - TIP[1]), np.arctan2(y - TIP[1], x - TIP[0])
    return 1 + (weights / weights.sum(axis=0))[NEAR].sum(axis=0) * np.sqrt(r) * np.sin(theta / 2)


def with_corner(f, verify=enriched, **more):
    blocks = {"one": ONE, "corner": {k: [1.0] for k in NEAR}}
    return state(blocks=blocks, functions={"corner": f}, verify=verify, **more)


def test_hints_name_functions_and_patches():
    ppum.build.dataset(with_corner(ppum.build.Formula(CORNER, origin=TIP)))
    for wrong in (
        ppum.build.Formula(CORNER, origin=TIP, angle=0.5),
        ppum.build.Formula("2*" + CORNER, origin=TIP),
        ppum.build.Formula(CORNER.replace("theta/2", "(theta + pi)/2"), origin=TIP),
        ppum.build.Formula(CORNER, origin=TIP + 0.01),
    ):
        with pytest.raises(ppum.BuildError) as error:
            ppum.build.dataset(with_corner(wrong))
        said = str(error.value)
        assert "on patches with 'corner'" in said and "radians" in said and "order of the coeff" not in said
        named = re.search(r"such as ([\d, ]+)", said)[1].strip(", ").split(", ")
        assert set(map(int, named)) <= set(NEAR)
    with pytest.raises(ppum.BuildError, match=r"angle: 45 is more than a turn; angles are in radians"):
        ppum.build.dataset(with_corner(ppum.build.Formula(CORNER, origin=TIP, angle=45)))
    # a Heaviside function, taken for a jump
    blocks, crack = {"one": ONE, "across": {k: [0.5] for k in NEAR}}, [[(0, 0.5), (2, 0.5)]]
    jump = state(blocks=blocks, functions={"across": ppum.build.Jump(0)}, cracks=crack, verify=lambda x, y: 1 + 0 * x)
    with pytest.raises(ppum.BuildError, match=r"on patches with 'across', .* look at the direction of its crack.*\(1 \+ jump\)/2$"):
        ppum.build.dataset(jump)
    # everywhere wrong: the polynomials are, and the function may be
    with pytest.raises(ppum.BuildError, match=r"Look at the order of the coefficients.*; and of 'corner' at"):
        ppum.build.dataset(with_corner(ppum.build.Formula(CORNER, origin=TIP), lambda x, y: enriched(x, y) + x))


def test_ends_of_cracks_have_one_vocabulary():
    solved = ppum.Problem(((0, 0), (2, 1)), ppum.Elastic(1.0, 0.3)).crack((0.6, 0.5), (1.0, 0.5))
    solved = solved.boundary("top", traction=(0, 1)).boundary("bottom", traction=(0, -1)).discretization(level=2, order=1).solve()
    crack, built = [[(0.6, 0.5), TIP]], {}
    assert [tip.end for tip in solved.tips] == ["start", "end"]
    for end in ["last", *(tip.end for tip in solved.tips)]:
        functions = ppum.build.tip_functions(0, end)
        blocks = {"one": ONE} | {name: {k: [1.0] for k in NEAR} for name in functions}
        built[end] = ppum.build.dataset(state(blocks=blocks, functions=functions, cracks=crack))
    assert built["last"] == built["end"] != built["start"]
    assert ppum.build.arrays(with_corner(ppum.build.Formula(CORNER, tip=(0, "end")), cracks=crack))["steps/0000/functions/frame_end"][1] == "last"


@pytest.mark.parametrize("name", ["order", "level", "blocks", "functions", "element", "u", "du_dx", "magnitude", "x", "pi"])
def test_attributes_have_names_of_their_own(name):
    with pytest.raises(ppum.BuildError, match=re.escape(f"attributes['{name}']: is the name of a quantity") + ".*give another"):
        ppum.build.dataset(state(attributes={name: np.arange(32.0)}))
    ds = ppum.build.dataset(state(attributes={f"my {name}": np.arange(32.0)}))
    assert ds.field.draw.render(f"my {name}", size=(8, 4))[::-1].ravel().tolist() == list(range(32))


def test_attributes_of_equations():
    displacement = ppum.build.State(COVER, ppum.build.Coefficients("displacement", {"one": np.zeros((32, 1, 2))}), attributes={"von-mises": np.ones(32)})
    with pytest.raises(ppum.BuildError, match=r"attributes\['von-mises'\]: is the name"):
        ppum.build.dataset(displacement, equation=ppum.Elastic(1.0, 0.3))


@pytest.mark.parametrize("names", [("v x", "1v"), ("sin", "exp"), ("x", "y"), ("vx-1", "vx"), ("let", "u"), ("pi", "u"), ("", "u"), ("u;v", "u")])
def test_components_have_names_of_formulas(names):
    blocks = {"one": np.ones((32, 1, 2))}
    with pytest.raises(ppum.BuildError, match=r"^fields\['u'\]\.components\[0\]: .*give another one, of letters, digits"):
        ppum.build.dataset(state(blocks=blocks, components=names))
    assert ppum.build.dataset(state("v-1 x", blocks=blocks)).field.components == ("v_1_x0", "v_1_x1")
    with pytest.raises(ppum.BuildError, match=r"'sxx' has a meaning in formulas already"):
        field = ppum.build.Coefficients("displacement", blocks, components=["u", "sxx"])
        ppum.build.dataset(ppum.build.State(COVER, field), equation=ppum.Elastic(1.0, 0.3))


def test_what_lies_outside_or_is_there_twice():
    for outside in ([(3, 0.5), (4, 0.5)], [(-1, -1), (-0.5, 2)], [(0, 2), (1, 3), (2, 2)]):
        with pytest.raises(ppum.BuildError, match=r"cracks\[0\]: lies outside of the domain, \(0, 0\) to \(2, 1\)"):
            ppum.build.dataset(state(cracks=[outside]))
    ppum.build.dataset(state(cracks=[[(-1, 0.5), (3, 0.5)]]))
    again = [*range(32), 5]
    with pytest.warns(UserWarning, match=r"center\[32\]: the support is that of patch 5 again"):
        ppum.build.Cover(COVER.domain, COVER.center[again], COVER.half[again])
    corners = np.array([[(0, 0), (1, 0), (0, 1)], [(1, 0), (1, 1), (0, 1)]])
    with pytest.raises(ppum.BuildError, match=r"map\[2\]: the element is that of patch 1; leave one out"):
        ppum.build.Mesh.from_nodes(corners[[0, 1, 1]])
    halves = {0: [("phi", 1)], 1: [("phi", -1)]}
    assert len(ppum.build.Mesh.from_nodes(corners[[0, 0]], element=[0, 0], clips=halves)) == 2


def test_series_name_the_state():
    good, functions = state(), {"f": "sin(z)"}
    bad = state(blocks={"one": ONE, "f": ONE}, functions=functions)
    for states, prefix in (([good, bad], r"states\[1\]\."), (bad, "")):
        with pytest.raises(ppum.BuildError, match=rf"^{prefix}functions\['f'\]\.text: line 1"):
            ppum.build.dataset(states)
    ragged = state(blocks={"one": np.ones((32, 2))})
    wrong = state(verify=lambda x, y: 2 + 0 * x)
    for one, place in ((ragged, "blocks"), (wrong, "verify")):
        with pytest.raises(ppum.BuildError, match=rf"^states\[1\]\.fields\['u'\]\.{place}"):
            ppum.build.dataset([good, one])


#: Mistakes that only the compiled part finds, and their places.
COMPILED = {
    "equation.poisson: ": lambda: ppum.build.dataset(
        state("displacement", {"one": np.zeros((32, 1, 2))}), equation=ppum.Elastic(1.0, 0.7)
    ),
    "equation.young: ": lambda: ppum.build.dataset(
        state("displacement", {"one": np.zeros((32, 1, 2))}), equation=ppum.Elastic("1 + q", 0.3)
    ),
    "quantities['q']: ": lambda: ppum.build.dataset(state(), quantities={"q": "v + 1"}),
    "functions['f'].text: ": lambda: ppum.build.dataset(with_corner("1") and state(functions={"f": "r^"})),
    "functions['g'].cuts[1][2]: ": lambda: ppum.build.dataset(
        state(
            functions={"f": ppum.build.Component([(0, 0, -1, -2)]), "g": ppum.build.Component([(0, 0, 1, -2), (0, 0, 9, -1)])},
            cracks=[[(0, 0.5), (1, 0.5)]],
        )
    ),
    "cover.weight: ": lambda: ppum.build.dataset(
        state(cover=ppum.build.Cover(COVER.domain, COVER.center, COVER.half, "1 - t/2"))
    ),
    "fields['u'].exact[0]: ": lambda: ppum.build.dataset(ppum.build.State(COVER, ppum.build.Coefficients("u", {"one": ONE}, exact=["q"]))),
    "holes[1].radius: ": lambda: ppum.build.dataset(state(), holes=[ppum.Hole((1, 0.5), 0.1), ppum.Hole((1, 0.2), -0.1)]),
}


@pytest.mark.parametrize("place", COMPILED)
def test_places_are_arguments(place):
    with pytest.raises(ppum.BuildError) as error:
        COMPILED[place]()
    assert str(error.value).startswith(place) and "steps/" not in str(error.value)


def test_python_in_formulas():
    with pytest.raises(ppum.BuildError, match=r"`np.sqrt`: names have no module before them; write `sqrt`"):
        ppum.build.dataset(with_corner(ppum.build.Formula("np.sqrt(r)", origin=TIP)))


def test_files_without_cells(tmp_path):
    """Both arrays of cells may be taken out of a file; of one alone the error says that the other goes too."""
    h5py = pytest.importorskip("h5py")
    for gone in (("cell", "level"), ("cell",), ("level",)):
        ppum.build.dataset(state()).save(tmp_path / "own.h5")
        with h5py.File(tmp_path / "own.h5", "r+") as file:
            for name in gone:
                del file[f"steps/0000/partition/{name}"]
            for name in [name for name in file.attrs if "sha256" in name]:
                del file.attrs[name]
        if len(gone) == 2:
            assert float(ppum.open(tmp_path / "own.h5").field.at(0.3, 0.3).u) == 1
            continue
        left = ({"cell", "level"} - set(gone)).pop()
        with pytest.raises(ppum.FormatError, match=rf"{gone[0]}: is missing; .* has no `{left}` either, leave it out"):
            ppum.open(tmp_path / "own.h5")


def test_options_that_are_no_switches():
    field = ppum.build.dataset(state()).field
    for name in ("arrows", "isolines", "deformed", "crosses", "bands"):
        with pytest.raises(TypeError, match=rf"^{name}: .*number.* is needed, not True"):
            field.draw.figure("u", **{name: True})
    with pytest.raises(TypeError, match="^cmap: a name such as 'viridis', a map of matplotlib, .* is needed, not int"):
        field.draw.figure("u", cmap=3)
    with pytest.raises(TypeError, match=r"`ppum.open` opens files"):
        ppum.Dataset("plate.h5")


def test_complex_numbers_have_no_meaning_elsewhere():
    """In problems, points, views and curves."""
    empty, field = ppum.Problem(((0, 0), (2, 1)), ppum.Elastic(1.0, 0.3)), ppum.build.dataset(state()).field
    points = np.array([(0.5, 0.5), (1.0, 0.5)])
    masked = np.ma.array(points, mask=[(0, 0), (1, 0)])
    for use, said in (
        (lambda: empty.crack(points * 1j), r"^points\[0\]\[0\]: is complex; give real"),
        (lambda: empty.crack(masked), r"^points\[1\]\[0\]: is NoneType"),
        (lambda: empty.hole(center=(1j, 0.5), radius=0.1), r"^hole\[0\].center\[0\]: is complex"),
        (lambda: empty.boundary("top", traction=(0, 1j)), r"^boundary\[0\].traction\[1\]: is complex"),
        (lambda: ppum.Problem(((0, 0), (2, 1)), ppum.Elastic(1j, 0.3)), r"^material.young: is complex"),
        (lambda: field.sample.circle((0.5, 0.5), 1j), r"^curve.circle.radius: is complex"),
        (lambda: field.draw.render("u", view=ppum.View((1j, 0), 1)), "real numbers, not complex128"),
        (lambda: field.at([1j], 0.5).u, "real numbers, not complex128"),
        (lambda: field.sample.grid(x=[1j], y=[0.5]), "real numbers, not complex128"),
    ):
        with pytest.raises(TypeError, match=said):
            use()


def triangles(n, function):
    """What a library gives of n × n × 2 bent triangles."""
    i, j = (a.ravel() for a in np.meshgrid(np.arange(n), np.arange(n)))
    corners = [np.stack([i + a, j + b], axis=1) / n for a, b in ((0, 0), (1, 0), (1, 1), (0, 1))]
    nodes = np.concatenate([np.stack([corners[k] for k in of], axis=1) for of in ((0, 1, 3), (1, 2, 3))])

    def sample(places):
        at = places[TRIANGLE]
        flat = np.einsum("kj,njc->nkc", vandermonde(at, exponents(1)) @ [[1 / 3] * 3, [-2 / 3, 2 / 3, 0], [-2 / 3, 0, 2 / 3]], nodes)
        points = flat + 0.02 * np.stack([flat[..., 1] ** 2, flat[..., 0] ** 2], axis=-1)
        return [Group(TRIANGLE, np.arange(len(nodes)), points, function(flat), at)]

    return sample


def test_importers_take_little_time():
    """All that importers share, of 100,000 curved triangles: at most 3 s of the processor, as 32 in a loop's time."""
    sample = triangles(224, lambda p: p[..., :1] * p[..., 1:])
    start = time.process_time()
    ppum.build.dataset(smooth(sample, defaults(ImportOptions), 2, 2, compared(sample, 1000)))
    taken = time.process_time() - start
    print(f"{taken:.2f} s")
    assert taken <= 3


def test_hints_of_importers():
    sample = triangles(6, lambda p: np.sin(9 * p[..., :1]))
    with pytest.raises(ppum.BuildError, match="not a polynomial of this degree on elements; interpolate it into L2"):
        ppum.build.dataset(smooth(sample, defaults(ImportOptions), 3, 2, compared(sample, 100)))


def grid(**data):
    """A mesh of meshio with point data."""
    meshio = pytest.importorskip("meshio")
    points = np.array([(x, y, 0.0) for y in range(3) for x in range(3)]) / 2
    quads = [[k, k + 1, k + 4, k + 3] for k in (0, 1, 3, 4)]
    return meshio.Mesh(points, [("quad", quads)], point_data={k: v(points) for k, v in data.items()})


def test_vectors_of_vtk_have_three_components(tmp_path):
    plane = lambda p: p * [1.0, -0.3, 0.0]
    mesh = grid(U=plane, W=lambda p: plane(p) + [0, 0, 1.0], S=lambda p: p[:, :1] * np.arange(9.0))
    material = {"name": "displacement", "equation": ppum.Elastic(1.0, 0.3)}
    mesh.write(tmp_path / "u.vtu")
    for call, of in ((ppum.meshes.from_meshio, mesh), (ppum.meshes.from_vtu, tmp_path / "u.vtu")):
        assert float(call(of, "U", **material).field.at(0.3, 0.4).exx) == pytest.approx(1, abs=1e-12)
        assert call(of, "W").field.components == ("W0", "W1", "W2")
        assert call(of, "U", components=["a", "b", "c"]).field.components == ("a", "b", "c")
        assert float(call(of, "S", columns=[4, 1]).field.at(0.5, 0.5).S0) == pytest.approx(2)
        with pytest.raises(ppum.BuildError, match=r"data: has 3 columns, .* ux, uy; choose by columns=\[0, 1\]"):
            call(of, "W", **material)
        assert call(of, "W", columns=[0, 1], **material).field.components == ("ux", "uy")
        with pytest.raises(ppum.BuildError, match=r"columns: \[0, 9\], but data 'S' has 9"):
            call(of, "S", columns=[0, 9])


def test_wrong_meshes_of_meshio(tmp_path):
    meshio = pytest.importorskip("meshio")
    good = grid(U=lambda p: p)
    with pytest.raises(ppum.BuildError, match="mesh: is str; give a meshio.Mesh, as by meshio.read"):
        ppum.meshes.from_meshio("u.vtu")
    far = meshio.Mesh(good.points, [("quad", good.cells[0].data + 1)], good.point_data)
    with pytest.raises(ppum.BuildError, match=r"cells\[3\]: has the nodes \[5, 6, 9, 8\], but there are 9 points"):
        ppum.meshes.from_meshio(far)
    with pytest.raises(ppum.BuildError, match="data 'U': is complex"):
        ppum.meshes.from_meshio(meshio.Mesh(good.points, good.cells, {"U": good.points * 1j}))


def test_wrong_files_of_vtk(tmp_path, capfd):
    pytest.importorskip("vtk")
    for name, said in (("a.vtp", "ends in neither .vtu nor .vtkhdf"), ("a.vtu", "holds no unstructured grid")):
        (tmp_path / name).write_text("<VTKFile>")
        with pytest.raises(ppum.BuildError, match=said):
            ppum.meshes.from_vtu(tmp_path / name)
    assert capfd.readouterr().err == ""


def test_degrees_of_freedom_of_another_basis():
    skfem = pytest.importorskip("skfem")
    mesh = skfem.MeshTri().refined(2)
    basis, other = skfem.Basis(mesh, skfem.ElementTriP2()), skfem.Basis(mesh, skfem.ElementTriP1())
    u = basis.project(lambda x: x[0])
    ppum.meshes.from_skfem(basis, u)
    for wrong in (other.project(lambda x: x[0]), np.append(u, 0.0)):
        with pytest.raises(ppum.BuildError, match=r"u: has the shape \(\d+,\), but the basis has 81 degrees of freedom"):
            ppum.meshes.from_skfem(basis, wrong)
    with pytest.raises(ppum.BuildError, match="u: is complex"):
        ppum.meshes.from_skfem(basis, u + 1j)


def test_compound_fields_of_ngsolve():
    ngs = pytest.importorskip("ngsolve")
    from ngsolve.meshes import MakeStructured2DMesh

    mesh = MakeStructured2DMesh(quads=False, nx=2, ny=2)
    both = ngs.GridFunction(ngs.H1(mesh, order=2) * ngs.L2(mesh, order=1))
    with pytest.raises(ppum.BuildError, match=r"gf: is compound; give one of its parts, such as gf.components\[0\]"):
        ppum.meshes.from_ngsolve(both)
    ppum.meshes.from_ngsolve(ngs.GridFunction(ngs.VectorH1(mesh, order=2)))
    with pytest.raises(ppum.BuildError, match="not a polynomial of this degree"):
        ppum.meshes.from_ngsolve(ngs.sin(3 * ngs.x), order=4, mesh=mesh)


def test_fields_of_mfem_by_their_degrees_of_freedom():
    mfem = pytest.importorskip("mfem.ser")
    rng = np.random.default_rng(4)
    kinds = (mfem.Element.TRIANGLE, mfem.Element.QUADRILATERAL)
    for kind, curve, count, order in itertools.product(kinds, (0, 3), (1, 2), (mfem.Ordering.byNODES, mfem.Ordering.byVDIM)):
        mesh = mfem.Mesh.MakeCartesian2D(3, 2, kind, True, 1.0, 1.0)
        if curve:
            mesh.SetCurvature(curve)
            mesh.GetNodes().GetDataArray()[:] += 2e-3 * rng.normal(size=mesh.GetNodes().Size())
        collection = mfem.H1_FECollection(3, 2)
        space = mfem.FiniteElementSpace(mesh, collection, count, order)
        gf = mfem.GridFunction(space)
        gf.Assign(rng.normal(size=gf.Size()))
        assert len(ppum.meshes.from_mfem(gf).field.components) == count


def test_nothing_is_warned_of_without_reason():
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        ds = ppum.build.dataset(state(load=k, verify=lambda x, y: 1 + 0 * x) for k in (1.0, 2.0))
    assert len(ds.steps) == 2 and all("verified u" in step.history for step in ds.steps)
