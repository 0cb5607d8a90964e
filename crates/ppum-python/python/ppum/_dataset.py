"""Datasets: solved problems, or fields from elsewhere in the same representation."""

from __future__ import annotations

import html
import operator
import os
from collections.abc import Callable, Mapping, Sequence
from functools import cached_property, lru_cache, partial
from pathlib import Path
from typing import IO, TYPE_CHECKING, Any, ClassVar, Unpack, cast

import numpy as np
from numpy.typing import NDArray

from . import _core
from ._export import TriangleOptions, save_triangles
from ._facts import Advance, Crack, Growth, Hole, Point, Reaction, Tip, Warning, bulges, number, points, row, tips_of
from ._field import KEPT, Field
from ._options import passes
from ._styles import ViewerOptions
from ._tables import History, Numbered, Table
from ._text import plural
from ._values import Values
from ._warnings import NAMES

if TYPE_CHECKING:
    from ._compare import Compare
    from ._draw import Draw
    from ._export import Export
    from ._problem import Problem
    from ._sample import Sample
    from ._weights import Weight
    from ._widget import Viewer


def _fact(name: str, doc: str, kind: Callable[[Any], Any] = lambda value: value) -> Any:
    return property(lambda self: kind(self._facts[name]), doc=doc)


def _of_last_step(name: str) -> Any:
    return property(lambda self: operator.attrgetter(name)(self.steps[-1]), doc=f"`Step.{name}` of the last step.")


def _of_field(name: str) -> Any:
    return property(lambda self: getattr(self.field, name), doc=f"`Field.{name}` of the field of the last step.")


class _Closed:
    """Takes the place of the data of a dataset that is closed."""

    def __getattr__(self, name: str) -> Any:
        raise ValueError("the dataset is closed; open it again with `ppum.open`")

    def __len__(self) -> int:
        return int(self.steps)

    def __call__(self, number: int) -> Field:
        return cast(Field, self.field)


class Step:
    """One state of a series. Made by `Dataset.steps`.

    Example:
        >>> step = ds.steps[-1]
        >>> step.patches, step.unknowns
        (512, 6600)
        >>> sorted(step.history)[:2]
        ['assembly', 'basis']
    """

    def __init__(self, dataset: Dataset, number: int) -> None:
        self.dataset = dataset
        #: Number of the step, from 0.
        self.number = number

    @cached_property
    def _facts(self) -> dict[str, Any]:
        return self.dataset._core.step(self.number)

    load: float = _fact("load", "Load factor or pseudo-time.", float)
    patches: int = _fact("patches", "Number of patches.")
    unknowns: int = _fact("unknowns", "Number of unknowns of the solution.")
    functions: tuple[str, ...] = _fact("functions", "Names of functions, which `Field.with_function` takes.", tuple)

    @cached_property
    def cracks(self) -> tuple[Crack, ...]:
        """Cracks of the step."""
        cracks = enumerate(zip(self._facts["cracks"], self._facts["bulges"]))
        made = (Crack(k, points(c["points"]), tuple(c["ends"]), bulges(b)) for k, (c, b) in cracks)
        return Numbered(made, "crack")

    @cached_property
    def tips(self) -> Table[Tip]:
        """Crack tips with the factors that the solver found, in the order of cracks and ends."""
        return tips_of(self._facts["tips"], self._facts["ends"])

    @cached_property
    def history(self) -> History:
        """Report of the solver."""
        records = self._facts["history"]
        return History([(r["name"], number(r["value"]), r["unit"]) for r in records])

    @cached_property
    def warnings(self) -> Table[Warning]:
        """Findings of the diagnostics."""
        return Table((row(Warning, w) for w in self._facts["warnings"]), "warning")

    @cached_property
    def reactions(self) -> Table[Reaction]:
        """Resultants of what the supports exert on the plate."""
        facts, names = self._facts["reactions"], self._facts["components"]
        rows = (row(Reaction, r, held=[n in r["held"] for n in names], moment=r["moment"] or 0.0) for r in facts)
        return Table(rows, "reaction")

    @cached_property
    def growth(self) -> Growth | None:
        """Growth of the cracks after this step; None without growth."""
        facts = self._facts["growth"]
        if facts is None:
            return None
        arcs = zip(facts["tips"], self._facts["arcs"])
        tips = (row(Advance, t, curvature=curvature, path=points(path)) for t, (curvature, path) in arcs)
        return Growth(facts["cycles"], facts["stop"], Table(tips, "tip"))

    @cached_property
    def attributes(self) -> dict[str, NDArray[np.float64]]:
        """Stored values of the cover's cells by name, each of shape (patches,)."""
        return dict(self.dataset._core.attributes(self.number))

    @property
    def field(self) -> Field:
        """Field of the step.

        Raises:
            FormatError: The step has none, or a function that cannot be compiled.
        """
        return self.dataset._field(self.number)

    def __repr__(self) -> str:
        return f"<ppum.Step {self.number}, {plural(self.patches, 'patch', 'patches')}, {plural(len(self.tips), 'tip')}>"


class Dataset:
    """A solved problem: all that is needed to evaluate its fields exactly. It never changes.

    Datasets are equal if all their numbers and texts are, except for the seconds that solving took; they can be pickled.

    Example:
        >>> ds
        <ppum.Dataset 'Slanted crack', elasticity, 1 step, 512 patches, 2 tips>
        >>> ds.tips[0]
        <ppum.Tip at (-0.353553, -0.353553), K_I = 0.766738, K_II = 0.684074>
        >>> ppum.open(ds.to_bytes()) == ds
        True
    """

    #: Makes problems of their texts, which are of an upper layer; bound by the package.
    _parsed: ClassVar[Any]
    #: Computes the weight functions of a tip, `Weight`; bound by the package.
    weight: ClassVar[Callable[..., Weight]]

    def __init__(self, core: _core.Dataset) -> None:
        if not isinstance(core, _core.Dataset):
            kind = type(core).__name__
            raise TypeError(f"a dataset is not made of {kind}: `ppum.open` opens files, `ppum.build.dataset` takes arrays")
        self._core = core
        # a field holds the data of its step, which those of a file need not
        most = KEPT if core.is_stored() else None
        self._field = lru_cache(most)(partial(Field, self))

    @cached_property
    def _facts(self) -> dict[str, Any]:
        return self._core.about()

    title: str = _fact("title", "One line that names the problem.")
    program: str = _fact("program", "Name and version of the program that made it.")

    @property
    def equation(self) -> str:
        """Kind of the equation: ``elasticity``, ``eigenstrain`` (given strains or a temperature), ``poisson`` or ``none``."""
        return str(self._facts["equation"]["kind"])

    @property
    def domain(self) -> tuple[Point, Point]:
        """Lower left and upper right corner of the box; `holes` are cut out of it."""
        domain = self._facts["domain"]
        return tuple(domain["min"]), tuple(domain["max"])

    @cached_property
    def holes(self) -> tuple[Hole, ...]:
        """Holes of the domain."""
        def hole(facts: dict[str, Any], of_sides: list[float]) -> Hole:
            if facts["kind"] == "circle":
                return Hole(tuple(facts["center"]), facts["radius"])
            is_outside = facts["kind"] == "outside"
            return Hole(points=points(facts["points"]), is_outside=is_outside, bulges=bulges(of_sides))

        holes = map(hole, self._facts["domain"]["holes"], self._facts["bulges"])
        return Numbered(holes, "hole")

    @property
    def problem(self) -> Problem | None:
        """Solved problem, by its text; None without one. Files that it names have to be where they were."""
        text = self._facts["problem"]
        problem: Problem | None = None if text is None else self._parsed(text)
        return problem

    @cached_property
    def steps(self) -> tuple[Step, ...]:
        """Steps of the series, one or more."""
        return Numbered((Step(self, k) for k in range(len(self._core))), "step")

    @property
    def field(self) -> Field:
        """Field of the last step."""
        return self.steps[-1].field

    cracks: tuple[Crack, ...] = _of_last_step("cracks")
    tips: Table[Tip] = _of_last_step("tips")
    warnings: Table[Warning] = _of_last_step("warnings")
    history: History = _of_last_step("history")
    quantities: Mapping[str, Any] = _of_last_step("field.quantities")
    at: Callable[..., Values] = _of_field("at")
    evaluate: Callable[..., Any] = _of_field("evaluate")
    intensities: Callable[..., Any] = _of_field("intensities")
    sample: Sample = _of_field("sample")
    draw: Draw = _of_field("draw")
    export: Export = _of_field("export")
    compare: Compare = _of_field("compare")

    @passes(ViewerOptions)
    def view(self, quantity: str | None = None, *, step: int = -1, **options: Unpack[ViewerOptions]) -> Viewer:
        """Show a step in a notebook, with a slider for the others; further options as in `Field.view`.

        Example:
            >>> ds.view("von_mises", tip=1, zoom=100).step
            0
        """
        return self.steps[step].field.view(quantity, **options)

    def save(
        self, path: str | os.PathLike[str], quantities: Sequence[str] | None = None, **options: Unpack[TriangleOptions]
    ) -> None:
        """Write a file. An existing one is replaced only by a complete one.

        A name that ends in ``.vtkhdf``, or in ``.vtu`` for a single step, makes a file for programs that interpolate, such as
        ParaView: the triangles of all steps, with the arguments of `field.export.triangles`.

        Raises:
            OSError: The system refuses; `FileNotFoundError` without the folder.
            ValueError: The name is that of another kind of file, such as ``.png``.
            TypeError: Arguments of triangles are given for another file.

        Example:
            >>> ds.save("plate.vtkhdf", ["displacement"], tolerance=0.01)
        """
        path = Path(path)
        if path.suffix.lower() in (".vtu", ".vtkhdf"):
            return save_triangles(self, path, quantities, **options)
        if quantities is not None or options:
            given = ", ".join(["quantities"] * (quantities is not None) + [*options])
            raise TypeError(f"{given}: for names that end in .vtkhdf or .vtu, not {path.name}")
        if remedy := _OTHER_FILES.get(path.suffix.lower()):
            raise ValueError(f"{path.name}: a dataset is an HDF5 file, end its name in .h5; {remedy}")
        self._core.save(path)

    def close(self) -> None:
        """Close the file of a series, of which no more steps can be read; ``with`` does this at its end.

        Fields that are in use keep what they need, and the file open, until they are gone.

        Example:
            >>> ds.save("plate.h5")
            >>> with ppum.open("plate.h5") as again:
            ...     print(again.title)
            Slanted crack
        """
        self._core = self._field = cast(Any, _Closed())

    def __enter__(self) -> Dataset:
        return self

    def __exit__(self, *error: object) -> None:
        self.close()

    if not TYPE_CHECKING:

        def __getattr__(self, name: str) -> Any:
            place = NAMES["Field"].get(name)
            meant = f"; there is `{place}`" if place else ""
            raise AttributeError(f"Dataset has no attribute {name!r}{meant}", name=name, obj=self)

    def to_bytes(self) -> bytes:
        """Return the bytes of a file."""
        return self._core.to_bytes()

    def __reduce__(self) -> tuple[Any, ...]:
        return open, (self.to_bytes(),)

    def __eq__(self, other: object) -> bool:
        return self._core == other._core if isinstance(other, Dataset) else NotImplemented

    def __hash__(self) -> int:
        numbers = [(s.patches, s.unknowns, s.history.get("energy", 0.0)) for s in self.steps]
        # what is not a number is not equal to itself
        plain = tuple((p, u, energy if energy == energy else None) for p, u, energy in numbers)
        return hash((self.title, self.equation, plain))

    def __repr__(self) -> str:
        if isinstance(self._core, _Closed):
            return "<ppum.Dataset, closed>"
        last = self.steps[-1]
        counts = plural(len(self.steps), "step"), plural(last.patches, "patch", "patches"), plural(len(last.tips), "tip")
        return f"<ppum.Dataset {self.title!r}, {self.equation}, {', '.join(counts)}>"

    def _repr_html_(self) -> str:
        (x0, y0), (x1, y1) = self.domain
        last = self.steps[-1]
        rows = {
            "equation": self.equation,
            "domain": f"({x0:g}, {y0:g}) to ({x1:g}, {y1:g}), {plural(len(self.holes), 'hole')}",
            "steps": str(len(self.steps)),
            "patches, unknowns": f"{last.patches}, {last.unknowns}",
            "cracks": str(len(last.cracks)),
            "warnings": "; ".join(w.message for w in last.warnings) or "none",
        }
        body = "".join(f"<tr><th>{html.escape(k)}</th><td>{html.escape(v)}</td></tr>" for k, v in rows.items())
        tips = last.tips._repr_html_() if last.tips else ""
        return f"<p><b>{html.escape(self.title)}</b></p><table><tbody>{body}</tbody></table>{tips}"


_IMAGES = "`field.draw.figure` draws images, `field.draw.animate` animations"
_MESHES = "`Dataset.save` makes .vtkhdf and .vtu files, with the triangles of `field.export.triangles`"
_TABLES = "`field.sample.line` and others make tables"
#: Ends of the names of other files, and what makes these.
_OTHER_FILES = {
    **dict.fromkeys((".png", ".svg", ".pdf", ".jpg", ".gif", ".apng"), _IMAGES),
    **dict.fromkeys((".pvd", ".vtk", ".vtp"), _MESHES),
    **dict.fromkeys((".csv", ".npy", ".npz", ".txt"), _TABLES),
    **dict.fromkeys((".html", ".htm"), "`field.export.to_html` makes pages"),
    **dict.fromkeys((".toml",), "`Problem.to_toml` is the text of a problem file"),
}


def open(source: str | os.PathLike[str] | bytes | IO[bytes]) -> Dataset:
    """Open a dataset.

    A file with the steps of a series stays open, and each step is read when it is asked for; any other is read whole.

    Args:
        source: A path, the bytes of a file, or a file that is open for reading bytes.

    Raises:
        OSError: The file cannot be read; `FileNotFoundError` if there is none.
        FormatError: The file is no dataset, or a damaged one.
        TypeError: The source is something else, or a file that is open for text.

    Example:
        >>> ds.save("plate.h5")
        >>> ppum.open("plate.h5") == ds
        True
    """
    if isinstance(source, (bytes, bytearray, memoryview)):
        return Dataset(_core.from_bytes(bytes(source)))
    if isinstance(source, (str, os.PathLike)):
        return Dataset(_core.read(Path(source)))
    if not hasattr(source, "read"):
        raise TypeError(f"a dataset is opened by a path, bytes or an open file{_remedy(source)}")
    data = source.read()
    if not isinstance(data, bytes):
        raise TypeError("the file is open for text: open it with mode 'rb', or give its path")
    return Dataset(_core.from_bytes(data))


def _remedy(source: Any) -> str:
    name = getattr(source, "filename", None)
    if isinstance(name, str):
        return f", not by a {type(source).__name__} of h5py; close it, and give {name!r}"
    return f", not by {type(source).__name__!r}"
