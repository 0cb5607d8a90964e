"""Modules of the package import in one direction: from their own layer, without a circle, and from those before it."""

import ast
import graphlib
import pathlib

import ppum

#: From the compiled part upwards; the package itself, which imports all, is above them.
LAYERS = {
    "compiled": ["_core"],
    "command": ["_command", "__main__"],
    "errors, units, text": ["_warnings", "_errors", "_units", "_text", "_options", "_files"],
    "data": ["_edges", "_tables", "_facts"],
    "field": ["_views", "_values", "_styles", "_field"],
    "accessors": ["_sample", "_compare", "_axes", "_draw", "_export"],
    "datasets": ["_dataset", "results"],
    "problem": ["_sections", "_problem", "_sweep", "_weights"],
    "arrays": [
        "_checks", "_arrays", "_shapes", "_blocks", "_functions", "_cover", "_mesh", "_state", "_stiffness", "_head",
        "_verify", "build", "basis",
    ],
    "libraries": [
        "meshes._elements", "meshes.dolfinx", "meshes.getfem", "meshes.mfem", "meshes.ngsolve", "meshes.ngsxfem",
        "meshes.skfem", "meshes.vtk", "meshes",
    ],
    "plots": ["plots"],
    "widget": ["_links", "_widget"],
    "package": [""],
}  # fmt: skip


def modules(folder):
    """The modules of a package and the paths of their files; the package itself has no name."""
    paths = [path for end in ("py", "pyi") for path in sorted(folder.rglob(f"*.{end}"))]
    parts = [path.relative_to(folder).with_suffix("").parts for path in paths]
    return {".".join(part for part in names if part != "__init__"): path for names, path in zip(parts, paths)}


def nodes_run(tree):
    """All that is run of a module: names for type checkers alone are not."""
    for node in ast.iter_child_nodes(tree):
        if not (isinstance(node, ast.If) and ast.unparse(node.test) == "TYPE_CHECKING"):
            yield node
            yield from nodes_run(node)


def imports_of(name, path, known):
    """The modules of the package that one imports, also inside of functions."""
    package = name.split(".") if path.name == "__init__.py" else name.split(".")[:-1]
    for node in nodes_run(ast.parse(path.read_text())):
        if isinstance(node, ast.Import):
            assert all(alias.name.split(".")[0] != "ppum" for alias in node.names), f"{name}: give imports a relative form"
        if isinstance(node, ast.ImportFrom) and node.level:
            above = package[: len(package) - node.level + 1]
            of = ".".join([part for part in above if part] + (node.module.split(".") if node.module else []))
            inner = [f"{of}.{alias.name}".lstrip(".") for alias in node.names]
            yield from (one if one in known else of for one in inner)


def graph(folder):
    known = modules(folder)
    return {name: set(imports_of(name, path, known)) - {name} for name, path in known.items()}


def violations(found, layers):
    """Imports from layers above, and circles."""
    rank = {name: k for k, names in enumerate(layers.values()) for name in names}
    upward = [f"{name} imports {other}" for name, others in found.items() for other in others if rank[other] > rank[name]]
    try:
        graphlib.TopologicalSorter(found).prepare()
    except graphlib.CycleError as error:
        upward.append(f"circle {' -> '.join(error.args[1])}")
    return upward


def test_imports_go_down():
    found = graph(pathlib.Path(ppum.__file__).parent)
    assert sorted(found) == sorted(name for names in LAYERS.values() for name in names)
    assert len(found["_dataset"]) > 4 and "_widget" in found[""]
    assert violations(found, LAYERS) == []


def test_upward_imports_and_circles_are_found(tmp_path):
    """Imports in functions count, and those of types do not."""
    (tmp_path / "__init__.py").write_text("from .a import one\n")
    (tmp_path / "a.py").write_text("def one():\n    from . import b\n")
    (tmp_path / "b.py").write_text("if TYPE_CHECKING:\n    from .c import two\n")
    (tmp_path / "c.py").write_text("from .b import three\n")
    layers = {"low": ["a"], "high": ["b", "c"], "package": [""]}
    assert violations(graph(tmp_path), layers) == ["a imports b"]
    (tmp_path / "b.py").write_text("from .c import two\n")
    assert violations(graph(tmp_path), layers)[0] == "a imports b" and "circle" in violations(graph(tmp_path), layers)[1]
