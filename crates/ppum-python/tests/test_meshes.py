"""Meshes: the arrays that are made of them, by the independent reader, and what is refused."""

import sys

import numpy as np
import ppum
import pytest
from conftest import ROOT

h5py = pytest.importorskip("h5py")
sys.path.insert(0, str(ROOT / "tests/python"))
from mesh_files import write  # noqa: E402
from ppum_reader import Field  # noqa: E402

CORNERS = np.array([[(0, 0), (2, 0), (0, 1)], [(2, 0), (2, 1), (0, 1)]], float)


@pytest.fixture
def read(tmp_path):
    """The independent reader on the arrays of a state."""

    def opened(state, field=0):
        write(tmp_path / "mesh.h5", ppum.build.arrays(state))
        with h5py.File(tmp_path / "mesh.h5") as file:
            return Field(file, field=field)

    return opened


def values(field, points, side=1):
    return np.array([[jet[0] for jet in field.evaluate(x, y, side)] for x, y in points])


def test_triangles(read):
    """Fields of x and y on two triangles: P1 by the values at corners, barycentric coordinates are (1 + 2ξ)/3, …"""
    mesh = ppum.build.Mesh.from_nodes(CORNERS)
    corner = np.array([[1, -2, -2], [1, 2, 0], [1, 0, 2]]) / 3
    blocks = np.einsum("nvc,vm->nmc", CORNERS @ np.array([[1.0, 3.0], [2.0, -1.0]]), corner)
    field = read(ppum.build.State(mesh, ppum.build.Coefficients("v", {"one": blocks}, components=("a", "b"))))
    points = np.random.default_rng(1).uniform((0, 0), (2, 1), (50, 2))
    wanted = points @ np.array([[1.0, 3.0], [2.0, -1.0]])
    assert np.abs(values(field, points) - wanted).max() < 1e-14
    assert np.isnan(values(field, [(2.1, 0.5), (-1e-9, 0.5)])).all()


def test_curved_elements(read):
    """Nodes on a parabola below."""
    nodes = ppum.build.Mesh.lattice("square", 3)
    nodes[:, 1] += 0.25 * (nodes[:, 0] - 0.1) ** 2 * (1 - nodes[:, 1]) / 2
    mesh = ppum.build.Mesh.from_nodes([nodes])
    assert mesh.degree.tolist() == [3] and mesh.tensor.tolist() == [True]
    assert np.abs(mesh.domain - [(-1, -1), (1, 1)]).max() < 1e-15
    # y = η + (ξ − 0.1)² (1 − η)/8, so η = (y − s)/(1 − s) with s = (x − 0.1)²/8
    c = np.zeros((1, 9))
    c[0, 4] = 1
    field = read(ppum.build.State(mesh, ppum.build.Coefficients("u", {"one": c})))
    points = np.random.default_rng(2).uniform((-1, 0.2), (1, 1), (30, 2))
    s = (points[:, 0] - 0.1) ** 2 / 8
    wanted = points[:, 0] * (points[:, 1] - s) / (1 - s)
    assert np.abs(values(field, points)[:, 0] - wanted).max() < 1e-14


def test_the_box_of_an_arch():
    """It reaches the vertex, which is no node."""
    nodes = ppum.build.Mesh.lattice("square", 2)
    nodes[:, 1] += 0.3 * (1 - (nodes[:, 0] + 0.2) ** 2)
    mesh = ppum.build.Mesh.from_nodes([nodes])
    assert np.abs(mesh.domain - [(-1, -1 + 0.3 * (1 - 1.44)), (1, 1.3)]).max() < 1e-14


def test_nodes_in_any_order():
    """Reference places in another order give the same map."""
    nodes = ppum.build.Mesh.lattice("triangle", 3)
    bent = nodes + 0.05 * np.sin(3 * nodes[:, ::-1])
    order = np.random.default_rng(3).permutation(len(nodes))
    one, other = ppum.build.Mesh.from_nodes([bent]), ppum.build.Mesh.from_nodes([bent[order]], nodes[order])
    assert np.abs(one.map[0] - other.map[0]).max() < 1e-15
    assert np.abs(one.places(0, nodes) - bent).max() < 1e-15


def cut():
    """A square that y = x/2 cuts: 1 + x above, -2 below, a tip function of ψ = x − 0.2."""
    square = [np.eye(2)] * 2
    mesh = ppum.build.Mesh(
        "square", np.zeros((2, 2)), square, space="total", element=[7, 7], clips={0: [("phi", 1)], 1: [("phi", -1)]}
    )
    fields = [
        ppum.build.Coefficients("u", {"one": [[1.0, 1, 0], [-2.0]], "tip": {1: [3.0]}, "sign": {0: [0.5]}}, space="total"),
        ppum.build.Coefficients("phi", {"one": [[0, -0.5, 1]] * 2}, space="total"),
        ppum.build.Coefficients("psi", {"one": [[-0.2, 1, 0]] * 2}, space="total"),
    ]
    tip = ppum.build.Formula("sqrt(r)*sin(theta/2)", levels=("psi", "phi"))
    return ppum.build.State(mesh, fields, functions={"tip": tip, "sign": ppum.build.Level("phi")})


def test_a_cut_element(read):
    field = read(cut())
    points = np.random.default_rng(4).uniform(-1, 1, (60, 2))
    phi, psi = points[:, 1] - points[:, 0] / 2, points[:, 0] - 0.2
    tip = np.sqrt(np.hypot(phi, psi)) * np.sin(np.arctan2(phi, psi) / 2)
    wanted = np.where(phi >= 0, 1.5 + points[:, 0], -2 + 3 * tip)
    assert np.abs(values(field, points)[:, 0] - wanted).max() < 1e-14
    assert values(field, [(0.5, 0.25)])[0, 0] == 2 and values(field, [(0.5, 0.25)], -1)[0, 0] == -2


def test_both_sides_share_their_map():
    made = ppum.build.arrays(cut())
    step = {k.removeprefix("steps/0000/partition"): v for k, v in made.items() if "partition" in k}
    assert list(step["/map_offset"]) == [0, 0] and step["/map"].tolist() == [[1, 0], [0, 1]]
    assert step["@kind"] == "mesh" and made["domain@kind"] == "mesh"
    assert step["/clip_offsets"].tolist() == [0, 1, 2] and step["/clip_side"].tolist() == [1, 0]
    assert made["steps/0000/functions/levels"] == [(-1, -1), (2, 1), (-1, 1)]


def test_build(read):
    """The package's own evaluation, compared with the state's reference."""
    mesh = ppum.build.Mesh.from_nodes(CORNERS)
    corner = np.array([[1, -2, -2], [1, 2, 0], [1, 0, 2]]) / 3
    blocks = {"one": np.einsum("nv,vm->nm", CORNERS @ [1.0, 2.0], corner)}
    state = ppum.build.State(mesh, ppum.build.Coefficients("u", blocks, verify=lambda x, y: x + 2 * y))
    try:
        made = ppum.build.dataset(state)
    except ppum.BuildError as error:
        assert "mesh" in str(error)
        pytest.skip("the compiled module of this build knows no meshes")
    assert abs(made.field.at(0.3, 0.4).u - 1.1) < 1e-14
    ppum.build.dataset(cut())


LEVEL = ppum.build.Coefficients("phi", {"one": [[1.0]] * 2})
MISTAKES = {
    "shape": (lambda: ppum.build.Mesh("disc", [(0, 0)], [np.eye(2)]), "shape: 'disc' is neither 'triangle' nor 'square'"),
    "map": (lambda: ppum.build.Mesh("square", [(0, 0)], [np.ones((4, 2))]), r"map\[0\]: has 4 coefficients.*here 3 or 8"),
    "count": (lambda: ppum.build.Mesh("square", [(0, 0)], []), "map: has 0 entries"),
    "nodes": (lambda: ppum.build.Mesh.from_nodes(np.zeros((1, 5, 2))), r"nodes: has the shape \(1, 5, 2\)"),
    "flipped": (lambda: ppum.build.Mesh.from_nodes(CORNERS[:, ::-1]), r"map\[0\]: the element is flipped or flat"),
    "at": (lambda: ppum.build.Mesh.from_nodes(CORNERS, np.zeros((3, 2))), "at: 3 places do not fix"),
    "side": (lambda: ppum.build.Mesh.from_nodes(CORNERS, clips={0: [("phi", 0)]}), r"clips\[0\]\[0\]: the side 0"),
    "patch": (lambda: ppum.build.Mesh.from_nodes(CORNERS, clips={5: [("phi", 1)]}), r"clips\[5\]: there is no such patch"),
    "field": (lambda: with_clip("psi"), r"clips\[0\]: names 'psi', which is no field after the first; there are 'phi'"),
    "first": (lambda: with_clip("u"), r"clips\[0\]: names 'u', which is no field after the first"),
    "level": (lambda: with_function(ppum.build.Level("psi")), r"functions\['f'\]: names 'psi'"),
    "frames": (
        lambda: with_function(ppum.build.Formula("x", levels=("phi", "phi"), angle=1.0)),
        r"functions\['f'\]: has several frames",
    ),
    "space": (
        lambda: ppum.build.Coefficients("u", {"one": [[1.0, 2, 3, 4]] * 2}),
        r"\['one'\]\[0\]: has 4 coefficients; a polynomial.*here 3 or 6",
    ),
    "holes": (lambda: with_hole(), "holes: the domain of a mesh"),
}


def with_clip(name):
    mesh = ppum.build.Mesh.from_nodes(CORNERS, clips={0: [(name, 1)]})
    return ppum.build.arrays(ppum.build.State(mesh, [ppum.build.Coefficients("u", {"one": [[1.0]] * 2}), LEVEL]))


def with_function(function):
    fields = [ppum.build.Coefficients("u", {"one": [[1.0]] * 2, "f": {0: [1.0]}}), LEVEL]
    return ppum.build.arrays(ppum.build.State(ppum.build.Mesh.from_nodes(CORNERS), fields, functions={"f": function}))


def with_hole():
    hole = ppum.Hole(center=(0.5, 0.2), radius=0.1, points=None)
    state = ppum.build.State(ppum.build.Mesh.from_nodes(CORNERS), ppum.build.Coefficients("u", {"one": [[1.0]] * 2}))
    return ppum.build.arrays(state, holes=[hole])


@pytest.mark.parametrize("name", MISTAKES)
def test_mistakes(name):
    make, said = MISTAKES[name]
    with pytest.raises(ppum.BuildError, match=said):
        made = make()
        if isinstance(made, ppum.build.Coefficients):
            ppum.build.arrays(ppum.build.State(ppum.build.Mesh.from_nodes(CORNERS), made))


def test_tensor_products_are_for_meshes():
    cover = ppum.build.Cover.uniform([(0, 0), (1, 1)], cells=(1, 1))
    with pytest.raises(ppum.BuildError, match="polynomials on covers are of total degree"):
        ppum.build.arrays(ppum.build.State(cover, ppum.build.Coefficients("u", {"one": [[1.0]]}, space="tensor")))

