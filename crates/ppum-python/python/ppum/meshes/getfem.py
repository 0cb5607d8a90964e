"""Fields of GetFEM, also of its extended finite elements."""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any, Unpack

import numpy as np
from numpy.typing import NDArray

from .._blocks import MAX_DEGREE, exponents
from .._checks import check_type, real
from .._errors import BuildError
from .._functions import TIP, Formula
from .._options import takes
from .._shapes import SQUARE, TRIANGLE, random_places
from .._state import Coefficients, State
from .._units import Floats
from ._elements import Elements, Group, ImportOptions, Places, compared, imported, importer, labelled, off_level, to_unit

__all__ = ["Crack", "from_getfem", "state"]

#: GetFEM's global functions ``crack`` 0 to 3.
TIPS = tuple(TIP[name] for name in ("sqrt(r) sin", "sqrt(r) cos", "sqrt(r) sin sin", "sqrt(r) sin cos"))
#: Places at which a side of a cut element is looked for.
TRIED = 4000


@dataclass(frozen=True)
class Crack:
    """The parts of an extended space, which its sum does not tell.

    Attributes:
        levelset: The LevelSet of the crack, with a secondary one if there is `tip`.
        base: The MeshFem from which `jump` was made.
        jump: The MeshFem ``levelset``, the first part of the sum, which is doubled where the crack cuts elements.
        tip: The MeshFem that multiplies the tip functions, and its enriched degrees of freedom; the second part.
        functions: Formulas of the tip functions in r and theta; by default those of ``crack`` 0 to 3.
    """

    levelset: Any
    base: Any
    jump: Any
    tip: tuple[Any, Sequence[int]] | None = None
    functions: Sequence[str] = TIPS


@takes(ImportOptions, "from_getfem()")
def state(mf: Any, u: Any, crack: Crack | None = None, **options: Unpack[ImportOptions]) -> State:
    """Import a field of GetFEM: degrees of freedom times shape functions, tip functions in the frame of level sets.

    Level sets are interpolated; cut elements are two patches.

    Args:
        mf: The MeshFem of the field.
        u: Its basic degrees of freedom.
        crack: The parts of an extended space.
    """
    check_type("mf", mf, hasattr(mf, "linked_mesh"), "a MeshFem of GetFEM")
    source = _Source(mf, real("u", u).ravel(), crack)
    elements = Elements(source.sample, source.order, source.geometry)
    known = compared(source.evaluate, options["verify"], source.off)
    if known is not None:
        known = known._replace(values=known.values[:, : source.count])
    smooth = elements.polynomials(source.order, source.columns(0))
    if crack is None:
        return State(elements.mesh(), labelled(options, {"one": smooth}, known))
    sides = np.array(source.sides)[elements.order]
    clips = {k: [("phi", int(side))] for k, side in enumerate(sides) if side}
    blocks: dict[str, Any] = {"one": smooth}
    functions = {}
    enriched = np.flatnonzero(np.array(source.enriched)[elements.order])
    for k, text in enumerate(crack.functions if crack.tip else ()):
        found = elements.polynomials(source.hats, source.columns(k + 1))
        functions[f"tip {k}"] = Formula(text, levels=("psi", "phi"))
        blocks[f"tip {k}"] = {patch: found[patch] for patch in enriched.tolist()}
    levels = [
        Coefficients(level, {"one": elements.polynomials(source.level, slice(at, at + 1))})
        for level, at in source.levels()
    ]
    return State(elements.mesh(None, clips), [labelled(options, blocks, known), *levels], functions=functions)


from_getfem = importer(state, "from_getfem", "GetFEM", "getfem")


class _Space:
    """The elements and degrees of freedom of a MeshFem's cells, asked for once."""

    def __init__(self, mf: Any, cells: NDArray[np.int64]) -> None:
        self.fems, self.kinds = _several(mf.fem(cells))
        dofs, self._starts = (np.ravel(part).astype(np.int64) for part in mf.basic_dof_from_cvid(cells))
        self._dofs = dofs

    def dofs(self, k: int) -> NDArray[np.int64]:
        return self._dofs[self._starts[k] : self._starts[k + 1]]

    def order(self, shapes: NDArray[np.int64]) -> int:
        pairs = np.unique(np.column_stack([self.kinds, shapes]), axis=0).tolist()
        return max(_degree(self.fems[kind], shape) for kind, shape in pairs)


def _several(found: tuple[Any, Any]) -> tuple[list[Any], NDArray[np.int64]]:
    """Return the objects that cells have, and which one each has; GetFEM gives a single object without a list."""
    objects, which = found
    return list(objects) if isinstance(objects, (list, tuple)) else [objects], np.ravel(which).astype(np.int64)


class _Source:
    """The field by patches: values of its smooth part, of the factors of tip functions, and of the level sets."""

    def __init__(self, mf: Any, u: Floats, crack: Crack | None) -> None:
        self.mf, self.u, self.crack, self.mesh = mf, u, crack, mf.linked_mesh()
        if self.mesh.dim() != 2:
            raise BuildError(f"mf: its mesh has {int(self.mesh.dim())} dimensions, expected 2")
        if len(u) != mf.nb_basic_dof():
            raise BuildError(f"u: has {len(u)} entries, but mf has {int(mf.nb_basic_dof())} basic degrees of freedom")
        self.count, self.base = int(mf.qdim()), crack.base if crack else mf
        numbers = np.ravel(self.mesh.cvid()).astype(np.int64)
        self.cells = numbers.tolist()
        self.place = {cell: k for k, cell in enumerate(self.cells)}
        self.maps, self.kinds = _several(self.mesh.geotrans(numbers))
        nodes, starts = self.mesh.pts_from_cvid(numbers)
        self.nodes, self.starts = np.asarray(nodes).T, np.ravel(starts).astype(np.int64)
        shapes = np.array([_shape(one) for one in self.maps])[self.kinds]
        self.shape = dict(zip(self.cells, shapes.tolist()))
        self.spaces: dict[int, _Space] = {}
        self.order = self._space(self.base).order(shapes)
        self.geometry = max(_geometry(one, _shape(one)) for one in self.maps)
        self.tables: dict[tuple[str, bytes], Floats] = {}
        self.parts = self._parts(crack) if crack else [(k, 0, self._dofs(mf, k)) for k in self.cells]
        tip = crack.tip if crack else None
        self.near = set(map(int, tip[1])) if tip else set()
        self.hats = self._space(tip[0]).order(shapes) if tip else 0
        self.level = self._space(crack.levelset.mf()).order(shapes) if crack else 0
        # of the patches, in the order of `sample`
        self.sides: list[int] = []
        self.enriched: list[bool] = []

    def _space(self, mf: Any) -> _Space:
        if mf.id not in self.spaces:
            self.spaces[mf.id] = _Space(mf, np.array(self.cells))
        return self.spaces[mf.id]

    def _dofs(self, mf: Any, cell: int) -> NDArray[np.int64]:
        return self._space(mf).dofs(self.place[cell])

    def columns(self, part: int) -> slice:
        """Return the columns of the smooth part, 0, or of a tip function."""
        return slice(part * self.count, (part + 1) * self.count)

    def levels(self) -> list[tuple[str, int]]:
        """Return names and columns of the level fields."""
        assert self.crack
        tips = len(self.crack.functions) if self.crack.tip else 0
        at = (1 + tips) * self.count
        return [("phi", at), *([("psi", at + 1)] if self.crack.tip else [])]

    def table(self, mf: Any, cell: int, at: Floats) -> Floats:
        """Return shape functions of a cell at places of GetFEM's element, (k, functions)."""
        space = self._space(mf)
        fem = space.fems[space.kinds[self.place[cell]]]
        key = fem.char(), at.tobytes()
        if key not in self.tables:
            self.tables[key] = np.array([np.ravel(fem.base_value(place)) for place in at])
        return self.tables[key]

    def points(self, cells: Sequence[int], at: Floats) -> Floats:
        """Return the points of places in cells, (n, k, 2); maps are linear in the nodes."""
        of = np.array([self.place[cell] for cell in cells])
        found = np.empty((len(of), len(at), 2))
        for kind in np.unique(self.kinds[of]).tolist():
            map_, those = self.maps[kind], np.flatnonzero(self.kinds[of] == kind)
            count = int(map_.nbpts())
            table = [np.asarray(map_.transform(np.outer([1.0, 0.0], row), at.T))[0] for row in np.eye(count)]
            nodes = self.nodes[self.starts[of[those]][:, None] + np.arange(count)]
            found[those] = np.einsum("jk,njc->nkc", table, nodes)
        return found

    def sample(self, places: Places) -> list[Group]:
        self.sides, self.enriched, groups = [], [], []
        for shape in (TRIANGLE, SQUARE):
            at = to_unit(shape, places[shape])
            parts = [part for part in self.parts if self.shape[part[0]] == shape]
            if parts:
                cells = [cell for cell, *_ in parts]
                values = self._smooth(cells, [dofs for *_, dofs in parts], at)
                if self.crack:
                    values = np.concatenate([values, [self._others(cell, at) for cell in cells]], axis=2)
                groups.append(Group(shape, np.array(cells), self.points(cells, at), values, places[shape]))
                self.sides += [side for _, side, _ in parts]
                self.enriched += [bool(self._vertices(cell)) for cell in cells]
        return groups

    def _smooth(self, cells: Sequence[int], dofs: Sequence[NDArray[np.int64]], at: Floats) -> Floats:
        """Return the smooth part by its degrees of freedom on each patch, (n, k, c)."""
        kinds = self._space(self.base).kinds[[self.place[cell] for cell in cells]]
        found = np.empty((len(cells), len(at), self.count))
        for kind in np.unique(kinds).tolist():
            of = np.flatnonzero(kinds == kind)
            own = self.u[np.array([dofs[k] for k in of.tolist()])].reshape(len(of), -1, self.count)
            found[of] = np.einsum("kd,ndc->nkc", self.table(self.base, cells[of[0]], at), own)
        return found

    def _others(self, cell: int, at: Floats) -> Floats:
        """Return the columns of tip functions and of level sets on a patch."""
        assert self.crack
        columns = self._tips(cell, at) if self.crack.tip else []
        levelset = self.crack.levelset
        of = self._dofs(levelset.mf(), cell)
        table = self.table(levelset.mf(), cell, at)
        for number in range(2 if self.crack.tip else 1):
            columns.append(table @ np.ravel(levelset.values(number))[of][:, None])
        return np.hstack(columns)

    def _vertices(self, cell: int) -> list[int]:
        """Return the local numbers of the enriched degrees of freedom."""
        if not self.crack or not self.crack.tip:
            return []
        return [i for i, dof in enumerate(self._dofs(self.crack.tip[0], cell)) if int(dof) in self.near]

    def _tips(self, cell: int, at: Floats) -> list[Floats]:
        """Return the factors of the tip functions, which stand behind the degrees of freedom of `jump`, vertex by vertex."""
        assert self.crack and self.crack.tip
        count, vertices = len(self.crack.functions), self._vertices(cell)
        if not vertices:
            return [np.zeros((len(at), count * self.count))]
        first = len(self._dofs(self.crack.jump, cell))
        own = self.u[self._dofs(self.mf, cell)].reshape(-1, self.count)[first:]
        if len(own) != len(vertices) * count:
            raise BuildError(
                f"crack: cell {cell} has {len(own)} degrees of freedom of tip functions, expected {len(vertices)} × {count}: "
                "mf must be the sum of `jump` and the product with `functions`, in this order"
            )
        hats = self.table(self.crack.tip[0], cell, at)[:, vertices]
        return [hats @ own[k::count] for k in range(count)]

    def _parts(self, crack: Crack) -> list[tuple[int, int, NDArray[np.int64]]]:
        """Return cell, side (0 for both) and degrees of freedom of each patch."""
        count = {k: len(self._dofs(self.base, k)) for k in self.cells}
        doubled = [k for k in self.cells if len(self._dofs(crack.jump, k)) > count[k]]
        zones = self._zones(crack, doubled)
        parts = []
        for cell in self.cells:
            own = self._dofs(crack.jump, cell)
            seen = [(side, zones[cell, side]) for side in (1, -1) if (cell, side) in zones]
            for side, zone in seen or [(0, set(own.tolist()))]:
                # cells beside the cut ones have doubled degrees of freedom, too
                local = [k for k, dof in enumerate(own.tolist()) if dof in zone]
                if len(local) != count[cell]:
                    raise BuildError(f"crack: cell {cell} has {len(local)} functions on a side, expected {count[cell]}")
                parts.append((cell, side if len(seen) > 1 else 0, self._of_sum(cell, local)))
        return parts

    def _of_sum(self, cell: int, local: list[int]) -> NDArray[np.int64]:
        """Return the degrees of freedom of the sum for some of `jump`, with their components."""
        return self._dofs(self.mf, cell).reshape(-1, self.count)[local].ravel()

    def _zones(self, crack: Crack, cells: list[int]) -> dict[tuple[int, int], set[int]]:
        """Return the degrees of freedom of `jump` that are felt on each side of doubled cells, by one point on each side."""
        asked, points, random = [], [], np.random.default_rng(0)
        for cell in cells:
            at = to_unit(self.shape[cell], random_places(random, self.shape[cell], TRIED))
            own = np.ravel(crack.levelset.values(0))[self._dofs(crack.levelset.mf(), cell)]
            level = self.table(crack.levelset.mf(), cell, at) @ own
            for side in (1, -1):
                k = int(np.argmax(side * level))
                if side * level[k] > 1e-13:
                    asked.append((cell, side))
                    points.append(self.points([cell], at[k : k + 1])[0, 0])
        if not asked:
            return {}
        matrix = imported("getfem").asm("interpolation matrix", crack.jump, np.array(points).T)
        zones: dict[tuple[int, int], set[int]] = {key: set() for key in asked}
        starts, row = map(np.ravel, matrix.csc_ind())
        column, felt = np.repeat(np.arange(len(starts) - 1), np.diff(starts)), np.ravel(matrix.csc_val()) != 0
        for dof, k in zip(column[felt].tolist(), row[felt].tolist()):
            zones[asked[k]].add(dof)
        return zones

    def evaluate(self, places: Places) -> list[Group]:
        """Return GetFEM's own values at the points of places, before the columns of the level sets."""
        interpolate, groups = imported("getfem").compute_interpolate_on, []
        for group in self.sample(places):
            flat = group.points.reshape(-1, 2)
            found = np.asarray(interpolate(self.mf, self.u, flat.T)).reshape(self.count, -1)
            own = found.T.reshape(*group.points.shape[:2], self.count)
            levels = group.values[:, :, [at for _, at in self.levels()]] if self.crack else own[:, :, :0]
            values = np.concatenate([own, levels], axis=2)
            groups.append(Group(group.shape, group.elements, group.points, values, group.places))
        return groups

    def off(self, values: Floats) -> Any:
        """Return True for points that do not lie on the crack or its extension."""
        if self.crack is None:
            return np.ones(len(values), bool)
        return off_level(values[:, self.count])


def _shape(geotrans: Any) -> int:
    name = str(geotrans.char())
    if "GT_PK(2" in name:
        return TRIANGLE
    if "GT_QK(2" in name or "PRODUCT(GT_PK(1" in name:
        return SQUARE
    raise BuildError(f"mf: its mesh has cells with the transformation {name}, expected triangles or quadrilaterals")


def _geometry(geotrans: Any, shape: int) -> int:
    """Return the degree of a transformation by its number of nodes."""
    count = int(geotrans.nbpts())
    for degree in range(1, MAX_DEGREE + 1):
        if len(exponents(degree, shape == SQUARE)) >= count:
            return degree
    raise BuildError(f"mf: its mesh has a transformation with {count} nodes, of a degree above {MAX_DEGREE}")


def _degree(fem: Any, shape: int) -> int:
    """Return the degree of an element; that of squares counts both variables."""
    name, total, count = str(fem.char()), int(fem.estimated_degree()), int(fem.nbdof())
    if not fem.is_equivalent() or not fem.is_polynomial() or int(fem.target_dim()) != 1:
        raise BuildError(f"mf: {name} has no polynomials that are the same on all elements; interpolate on a Lagrange element")
    if shape == SQUARE and total % 2 == 0 and count == (total // 2 + 1) ** 2:
        return total // 2
    return total
