"""Meshes: elements as images of a triangle or a square, whole or cut by level fields."""

from collections.abc import Iterator, Mapping, Sequence
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ._blocks import DEGREES, MAX_DEGREE, TENSOR, degrees, exponents
from ._checks import Ragged, check_shape, check_type, index, integers, known, numbers, repeated, rows, sequence, short
from ._errors import BuildError
from ._functions import level_field
from ._shapes import CORNERS, SQUARE, TRIANGLE, Powers, interpolated, lattice, random_places, vandermonde
from ._text import plural
from ._units import Floats

#: A level field by its name, and the side of it that a patch keeps: 1 where it is ≥ 0, -1 where it is < 0.
Clip = tuple[str, int]


class Mesh:
    """The elements of a mesh, in the place of a `Cover`, each with functions times polynomials of its own coordinates ξ.

    A patch is an element, p = origin + M(ξ), with ξ in the triangle (−½, −½), (1, −½), (−½, 1) or in the square [−1, 1]²,
    both about 0. An element that a level field cuts is two patches with the same map and opposite clips.

    Attributes:
        shape: ``triangle`` or ``square``, one for all or one per patch; or 0 and 1.
        origin: Images of ξ = 0, shape (n, 2).
        map: Coefficients of M from ξ on, it has no constant: an array (n, m, 2), or a list of n arrays (m, 2).
        space: Polynomials of M, for all or per patch: ``total`` degree with (d + 1)(d + 2)/2 − 1 coefficients of ξ, η, ξ², ξη, …;
            ``tensor`` products with (d + 1)² − 1, powers of ξ fastest; or ``shape``: tensor products on squares alone.
        element: Number of each patch's element, for reports; by default they are counted.
        clips: Pairs of a level field and a side by the number of the patch: (name, 1) keeps values ≥ 0, (name, -1) values < 0.
            A level field is a field of one component of the state, after the first.

    Example:
        >>> corners = np.array([[(0, 0), (1, 0), (0, 1)], [(1, 0), (1, 1), (0, 1)]])
        >>> mesh = ppum.build.Mesh.from_nodes(corners)
        >>> mesh, mesh.domain.tolist()
        (<ppum.build.Mesh, 2 triangles>, [[0.0, 0.0], [1.0, 1.0]])
    """

    #: What places polynomials, in the words of messages.
    FRAME = "the map, the space"

    def __init__(
        self,
        shape: str | ArrayLike,
        origin: ArrayLike,
        map: NDArray[Any] | Sequence[ArrayLike] | Ragged,
        *,
        space: str | Sequence[str] = "shape",
        element: ArrayLike | None = None,
        clips: Mapping[int, Sequence[Clip]] | None = None,
    ) -> None:
        self.origin = rows("origin", origin, 2)
        n = len(self.origin)
        if n == 0:
            raise BuildError("origin: a mesh needs at least one element")
        self.shape = _shapes(shape, n)
        self.map = _maps(map, n)
        self.tensor = self.in_space("space", space)
        self.degree = degrees("map", self.map.sizes + 1, self.tensor, np.arange(n), least=1)
        self._orientation()
        self.element = np.arange(n) if element is None else _elements(element, n)
        self.clips = _clips({} if clips is None else clips, n)
        self._repetition()
        self.domain = np.array(self._box())

    @classmethod
    def from_nodes(
        cls,
        nodes: ArrayLike,
        at: ArrayLike | None = None,
        *,
        element: ArrayLike | None = None,
        clips: Mapping[int, Sequence[Clip]] | None = None,
    ) -> "Mesh":
        """Make elements from nodes: 3, 6, 10, … nodes for triangles of order 1, 2, 3, …, 4, 9, 16, … for squares.

        Args:
            nodes: Shape (n, k, 2). Nodes of order 1 go around the element, others stand in the order of `at`.
            at: Reference places of the nodes, shape (k, 2); by default `Mesh.lattice`.
            element, clips: As in `Mesh`.

        Example:
            >>> bent = ppum.build.Mesh.lattice("square", 2)
            >>> bent[:, 1] += 0.1 * bent[:, 0] ** 2
            >>> ppum.build.Mesh.from_nodes([bent]).degree.tolist()
            [2]
        """
        given = numbers("nodes", nodes)
        count = given.shape[1] if given.ndim == 3 else 0
        shape, order = _kind(given.shape, count)
        places = lattice(shape, order) if at is None else rows("at", at, 2, count)
        if at is None and count == 4:
            places = places[[0, 1, 3, 2]]
        found = interpolated(given, places, exponents(order, shape == SQUARE))
        return cls(np.full(len(given), shape), found[:, 0], found[:, 1:], element=element, clips=clips)

    @staticmethod
    def lattice(shape: str, order: int) -> Floats:
        """Return reference places of equally spaced nodes, row by row from below, in a row from the left: shape (k, 2)."""
        (count,) = integers("order", [order], 1)
        if not 1 <= count <= MAX_DEGREE:
            raise BuildError(f"order: is {count}, expected 1 to {MAX_DEGREE}")
        return lattice(int(_shapes(shape, 1)[0]), count)

    def in_space(self, place: str, space: str | Sequence[str]) -> NDArray[np.bool_]:
        """Return True for the patches on which polynomials of a space are tensor products."""
        words = [space] * len(self) if isinstance(space, str) else [*map(str, sequence(place, space, "words"))]
        known = {"total": (False, False), "tensor": (True, True), "shape": (False, True)}
        unknown = [word for word in words if word not in known]
        if unknown or len(words) != len(self):
            wrong = f"{unknown[0]!r} is none of {', '.join(known)}" if unknown else f"expected {len(self)} words"
            raise BuildError(f"{place}: {wrong}")
        return np.array([known[word][shape] for word, shape in zip(words, self.shape.tolist())])

    def places(self, patch: int, xi: ArrayLike) -> Floats:
        """Return the points of reference places (k, 2) of a patch."""
        powers = exponents(int(self.degree[patch]), bool(self.tensor[patch]))[1:]
        result: Floats = self.origin[patch] + vandermonde(rows("xi", xi, 2), powers) @ self.map[patch]
        return result

    def arrays(self, fields: Sequence[str] = ()) -> dict[str, Any]:
        """Return the group `partition` of the file format; `fields` are the names of the state's fields."""
        starts, shared = self._shared()
        arrays: dict[str, Any] = {
            "shape": self.shape,
            "origin": self.origin,
            "map_degree": self.degree,
            "map_space": self.tensor.astype(np.uint8),
            "map_offset": starts,
            "map": shared.T,
            "element": self.element,
        }
        if any(self.clips):
            pairs = [(k, name, side) for k, of in enumerate(self.clips) for name, side in of]
            clips = [(level_field(f"cover.clips[{k}]", name, fields), side > 0) for k, name, side in pairs]
            arrays["clip_offsets"] = np.cumsum([0, *(len(of) for of in self.clips)])
            arrays["clip_field"], arrays["clip_side"] = np.array(clips, int).T
        return arrays

    def around(self, points: Floats) -> list[int]:
        """Return the patches whose boxes hold some of the points."""
        found: set[int] = set()
        for of, _, c in self._alike():
            reach = np.abs(c).sum(axis=1)
            found.update(k for p in points for k in of[(np.abs(p - self.origin[of]) <= reach).all(axis=1)].tolist())
        return sorted(found)

    def spread(self, random: np.random.Generator, count: int) -> Floats:
        """Return random points of the patches, which are taken in turn; those of cut elements on either side."""
        points = []
        for patch in np.resize(random.permutation(len(self))[:count], count).tolist():
            points.append(self.places(patch, random_places(random, int(self.shape[patch]), 1)))
        return np.concatenate(points)

    def _alike(self) -> Iterator[tuple[NDArray[np.int64], Powers, Floats]]:
        """Yield patches whose maps have the same powers, these, and the coefficients (k, m, 2)."""
        kinds = 2 * self.degree + self.tensor
        for kind in np.unique(kinds).tolist():
            of = np.flatnonzero(kinds == kind)
            powers = exponents(kind // 2, bool(kind % 2))[1:]
            yield of, powers, self.map.at(of).values.reshape(len(of), len(powers), 2)

    def _orientation(self) -> None:
        """Refuse elements that are flipped or flat at ξ = 0."""
        for of, powers, c in self._alike():
            x, y = c[:, powers.index((1, 0))].T, c[:, powers.index((0, 1))].T
            wrong = of[~(x[0] * y[1] > x[1] * y[0])]
            if len(wrong):
                raise BuildError(
                    f"map[{wrong[0]}]: the element is flipped or flat; its nodes must go counter-clockwise, around it"
                )

    def _repetition(self) -> None:
        """Refuse repeated elements, except for the sides of a cut."""
        for of, _, c in self._alike():
            rows = np.column_stack([self.shape[of], self.origin[of], c.reshape(len(of), -1)]) + 0.0
            for k, first in repeated(rows):
                patch, other = int(of[k]), int(of[first])
                if self.clips[patch] == self.clips[other]:
                    raise BuildError(
                        f"map[{patch}]: the element is that of patch {other}; leave one out, or give both the sides of a "
                        "cut by `clips`"
                    )

    def _shared(self) -> tuple[NDArray[np.int64], Floats]:
        """Return first columns of the patches' maps, and the maps; both sides of a cut share theirs."""
        own, known = np.arange(len(self)), dict[Any, int]()
        _, which, counts = np.unique(self.element, return_inverse=True, return_counts=True)
        for k in np.flatnonzero(counts[which] > 1).tolist():
            own[k] = known.setdefault((int(self.element[k]), self.map[k].tobytes()), k)
        kept = np.flatnonzero(own == np.arange(len(self)))
        shared = self.map.at(kept)
        return shared.starts[np.searchsorted(kept, own)], shared.values

    def _box(self) -> list[Floats]:
        """Return the corners of the box around the images of all borders."""
        box = [np.full(2, np.inf), np.full(2, -np.inf)]
        for of, powers, c in self._alike():
            for shape in np.unique(self.shape[of]).tolist():
                those = self.shape[of] == shape
                images = self.origin[of][those][:, None] + vandermonde(CORNERS[shape], powers) @ c[those]
                box = _around(box, images.reshape(-1, 2))
        for of, _, c in self._alike():
            reach = np.abs(c).sum(axis=1)
            beyond = (self.origin[of] - reach < box[0]) | (self.origin[of] + reach > box[1])
            for k in of[beyond.any(axis=1) & (self.degree[of] > 1)].tolist():
                box = _around(box, np.concatenate([self.places(k, places) for places in self._turning(k)]))
        return box

    def _turning(self, patch: int) -> list[Floats]:
        """Return the corner and the places on each edge of a patch where x or y turns."""
        corners, degree = CORNERS[int(self.shape[patch])], int(self.degree[patch])
        at, found = (1 - np.cos(np.pi * np.arange(degree + 1) / degree)) / 2, []
        for a, b in zip(corners, np.roll(corners, -1, axis=0)):
            images = self.places(patch, a + at[:, None] * (b - a))
            turning = [np.clip(_extremes(at, x), 0, 1) for x in images.T]
            found.append(a + np.concatenate([[0.0], *turning])[:, None] * (b - a))
        return found

    def __len__(self) -> int:
        return len(self.origin)

    def __repr__(self) -> str:
        counts = [(int((self.shape == k).sum()), name) for name, k in SHAPES.items()]
        words = [plural(count, name) for count, name in counts if count]
        cut = sum(map(bool, self.clips))
        return f"<ppum.build.Mesh, {', '.join(words)}{f', {cut} cut' if cut else ''}>"


def _around(box: list[Floats], points: Floats) -> list[Floats]:
    return [np.minimum(box[0], points.min(axis=0)), np.maximum(box[1], points.max(axis=0))]


def _extremes(at: Floats, values: Floats) -> Floats:
    """Return the places where a polynomial, by its values, has no slope."""
    slope = np.polynomial.Polynomial.fit(at, values, len(at) - 1).deriv()
    # roots of a polynomial whose highest coefficient is rounding have no digits
    result: Floats = slope.trim(1e-12 * float(np.abs(slope.coef).max())).roots().real
    return result


SHAPES = {"triangle": TRIANGLE, "square": SQUARE}


def _shapes(shape: str | ArrayLike, n: int) -> NDArray[np.int64]:
    given: Any = [shape] * n if isinstance(shape, str) else sequence("shape", shape, "words")
    if any(isinstance(word, str) for word in given):
        unknown = [word for word in given if word not in SHAPES]
        if unknown:
            raise BuildError(f"shape: {unknown[0]!r} is neither 'triangle' nor 'square'")
        given = [SHAPES[word] for word in given]
    given = known("shape", given)
    if given.shape != (n,) or not np.isin(given, (TRIANGLE, SQUARE)).all():
        raise BuildError(f"shape: expected {n} entries, 'triangle' or 'square' for each patch")
    return np.asarray(given, np.int64)


def _maps(map: Any, n: int) -> Ragged:
    if isinstance(map, Ragged):
        return map
    if not hasattr(map, "__len__") or len(map) != n:
        count = f"has {len(map)} entries" if hasattr(map, "__len__") else f"is {type(map).__name__}"
        raise BuildError(f"map: {count}, but there are {n} origins; give one for each patch")
    if isinstance(map, np.ndarray) and map.ndim == 3:
        check_shape("map", map, map.shape[2] == 2, f"({n}, m, 2)")
        return Ragged.joined([numbers("map", map)])
    parts = [rows(f"map[{k}]", c, 2) for k, c in enumerate(map)]
    return Ragged(np.concatenate(parts), np.array([len(part) for part in parts]))


def _kind(shape: tuple[int, ...], count: int) -> tuple[int, int]:
    for kind, known in ((SQUARE, TENSOR), (TRIANGLE, DEGREES)):
        if order := known.get(count):
            return kind, order
    raise BuildError(
        f"nodes: has the shape {shape}, expected (n, k, 2) with k = 3, 6, 10, … nodes of a triangle or 4, 9, 16, … of a "
        f"square, of orders 1 to {MAX_DEGREE}"
    )


def _elements(element: ArrayLike, n: int) -> NDArray[np.int64]:
    given = known("element", element)
    if given.shape != (n,) or given.dtype.kind not in "iu" or (given < 0).any():
        raise BuildError(f"element: expected {n} whole numbers, one for each patch")
    return given.astype(np.int64)


def _clips(clips: Mapping[int, Sequence[Clip]], n: int) -> list[list[Clip]]:
    check_type("clips", clips, isinstance(clips, Mapping), "a dictionary by the number of the patch")
    for patch, of in clips.items():
        if index(patch, n) is None:
            raise BuildError(f"clips[{short(patch)}]: there is no such patch; the mesh has {n}, counted from 0")
        for k, clip in enumerate(sequence(f"clips[{patch}]", of, "pairs of a level field and a side")):
            if not isinstance(clip, (tuple, list)) or len(clip) != 2:
                remedy = "give pairs of a level field and a side, such as ('phi', 1)"
                raise BuildError(f"clips[{patch}][{k}]: is {short(clip)}; {remedy}")
            if clip[1] not in (1, -1):
                raise BuildError(f"clips[{patch}][{k}]: the side {clip[1]!r} is neither 1 (≥ 0) nor -1 (< 0)")
    return [list(clips.get(patch, ())) for patch in range(n)]
