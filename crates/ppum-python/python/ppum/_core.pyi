"""The compiled part of ppum; import ppum instead."""

from collections.abc import Callable
from pathlib import Path
from typing import Any, Final, final

import numpy as np
from numpy.typing import NDArray

_Floats = NDArray[np.float64]
_Spot = tuple[tuple[float, float], float]
_Progress = Callable[[str, int, int, int], object]

__all__ = [
    "VERSION",
    "Curves",
    "Dataset",
    "Field",
    "Triangles",
    "_panic",
    "animation",
    "build",
    "check",
    "check_request",
    "colormap",
    "colormaps",
    "default_request",
    "compare",
    "extrema",
    "figure",
    "frame",
    "from_bytes",
    "intensities",
    "material",
    "option_texts",
    "page",
    "profiles",
    "read",
    "render",
    "resample",
    "rgba",
    "scattered",
    "solve",
    "told",
    "triangles",
    "vtkhdf",
]

VERSION: Final[str]

@final
class Dataset:
    def save(self, path: Path) -> None: ...
    def to_bytes(self) -> bytes: ...
    def about(self) -> str: ...
    def is_stored(self) -> bool: ...
    def step(self, number: int) -> str: ...
    def attributes(self, number: int) -> list[tuple[str, _Floats]]: ...
    def __len__(self) -> int: ...
    def __eq__(self, other: object, /) -> bool: ...
    __hash__ = None  # type: ignore[assignment]

@final
class Triangles:
    def points(self) -> _Floats: ...
    def singular(self) -> _Floats: ...
    def cells(self) -> NDArray[np.uint32]: ...
    def values(self, number: int) -> _Floats: ...
    def accuracy(self) -> list[dict[str, Any]]: ...
    def radii(self) -> _Floats: ...
    def complaint(self) -> str | None: ...
    def is_complete(self) -> bool: ...
    def vtu(self) -> bytes: ...

@final
class Field:
    def __new__(cls, dataset: Dataset, step: int, subject: str) -> Field: ...
    def value(self, name: str, x: float, y: float, is_below: bool) -> float: ...
    def evaluate(
        self,
        names: list[str],
        x: _Floats,
        y: _Floats,
        is_below: bool,
        anchor: tuple[float, float] | None,
        gradient: bool,
        out: _Floats | None = None,
    ) -> _Floats | None: ...
    def check(self, name: str) -> None: ...
    def known(self) -> list[dict[str, Any]]: ...
    def words(self, name: str) -> tuple[str, str]: ...
    def default_quantity(self) -> str: ...
    def single_precision_warning(self) -> str | None: ...
    def components(self) -> list[str]: ...
    def table(
        self, along: str, count: int, names: list[str]
    ) -> tuple[list[tuple[str, str]], _Floats]: ...

@final
class Curves:
    def bytes(self, size: tuple[int, int], name: str) -> bytes: ...
    def curves(self) -> list[tuple[str, list[list[float]]]]: ...
    def warnings(self) -> list[str]: ...

def profiles(
    named: list[tuple[str, Field]],
    along: str,
    count: int,
    quantities: list[str] | None,
    log: str,
) -> Curves: ...
def told(named: list[tuple[str, Dataset]], kind: str, log: str) -> Curves: ...
def read(path: Path) -> Dataset: ...
def from_bytes(bytes: bytes) -> Dataset: ...
def build(given: list[tuple[str, list[int], NDArray[Any] | list[str]]]) -> Dataset: ...
def scattered(
    domain: tuple[float, float, float, float],
    cells: tuple[int, int],
    points: list[tuple[float, float]],
) -> tuple[_Floats, NDArray[np.uint8], NDArray[np.int64]]: ...
def check(text: str, name: str, folder: Path) -> list[dict[str, Any]]: ...
def solve(
    text: str,
    name: str,
    folder: Path,
    memory: int | None = None,
    threads: int | None = None,
    progress: _Progress | None = None,
) -> Dataset: ...
def render(
    this: Field,
    name: str,
    spot: _Spot,
    size: tuple[int, int],
    single: bool,
    progress: _Progress | None,
) -> NDArray[Any]: ...
def rgba(
    this: Field, request: str, spot: _Spot, size: tuple[int, int]
) -> tuple[NDArray[np.uint8], list[str]]: ...
def frame(
    this: Field, request: str, spot: _Spot, size: tuple[int, int]
) -> tuple[bytes, dict[str, Any]]: ...
def figure(
    this: Field, request: str, form: str
) -> tuple[bytes, list[str]]: ...
def compare(
    this: Field,
    other: Field,
    name: str,
    spot: _Spot,
    size: tuple[int, int],
    progress: _Progress | None,
) -> tuple[_Floats, dict[str, Any], list[str]]: ...
def resample(
    this: Field,
    name: str,
    way: dict[str, Any],
    spot: _Spot,
    size: tuple[int, int],
    progress: _Progress | None,
) -> tuple[_Floats, _Floats, dict[str, Any], dict[str, Any]]: ...
def material(this: Field, factor: str, spot: _Spot) -> dict[str, Any] | None: ...
def animation(
    this: Field,
    dataset: Dataset,
    changes: str,
    request: str,
    steps: list[int],
    milliseconds: int,
    form: str,
    progress: _Progress | None,
) -> tuple[bytes, list[str]]: ...
def extrema(
    this: Field, name: str, spot: _Spot, size: tuple[int, int]
) -> tuple[dict[str, Any], dict[str, Any]] | None: ...
def intensities(
    this: Field, on: tuple[int, float] | None, progress: _Progress | None
) -> tuple[str, list[str], list[str]]: ...
def vtkhdf(steps: list[Triangles]) -> bytes: ...
def triangles(
    this: Field,
    names: list[str] | None,
    tolerance: float,
    radius: float | None,
    most: int,
    order: int,
    average: bool,
    hash: str,
    progress: _Progress | None,
) -> Triangles: ...
def page(
    this: Field, dataset: Dataset, request: str, at: _Spot | None, file: str
) -> str: ...
def check_request(this: Field, request: str) -> None: ...
def default_request() -> str: ...
def option_texts() -> dict[str, str]: ...
def colormap(name: str) -> list[tuple[int, int, int]]: ...
def colormaps() -> list[str]: ...
def _panic(on_pool: bool) -> None: ...
