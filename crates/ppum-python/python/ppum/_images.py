"""Figures, animations and extreme values."""

import json
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

from . import _core
from ._files import Drawn, Page
from ._text import plural
from ._views import SIZE

if TYPE_CHECKING:
    from ._field import Field


@dataclass(frozen=True)
class Extremum:
    """An extreme value.

    Attributes:
        value: To about 1e-6 of its size; infinite at a singular point.
        xy: Its place.
        offset: The way there from the middle of the view, in all digits.
        on: What it lies on: ``inside``, ``border``, ``face``, ``rim``, ``interface``, ``singular``, ``pixel``,
            ``everywhere`` (one value but for rounding).
        side: Of a face, ``above`` or ``below``.
    """

    value: float
    xy: tuple[float, float]
    offset: tuple[float, float]
    on: str
    side: str | None


class Figure(Page):
    """A figure; drawn when its bytes are asked for. Made by `field.draw.figure`. Notebooks show it; it can be pickled."""

    def __init__(self, field: "Field", request: str) -> None:
        super().__init__()
        self._made_of = field, request

    def _draw(self, form: str) -> bytes:
        field, request = self._made_of
        return self._told(_core.figure(field._core, request, form))

    def __repr__(self) -> str:
        asked = json.loads(self._made_of[1])
        look, (quantities, parts) = asked["look"], (asked["panels"].get(name, []) for name in ("quantities", "parts"))
        names = [*(quantities or [asked.get("quantity") or "of a field"]), *parts]
        size = "panels" if quantities + parts and not {"size", "inches"} & look.keys() else _size(look)
        return f"<ppum.Figure {', '.join(names)}, {size}>"


#: Pixels in an inch of figures for paper where none are given, as the program has it.
PAPER_DPI = 300.0


def _size(look: dict[str, Any]) -> str:
    """Columns and rows of a page, in words."""
    if "inches" not in look:
        return "{}x{}".format(*look.get("size", SIZE))
    sides = [round(float(side) * look.get("dpi", PAPER_DPI)) for side in look["inches"].split("x")]
    return "x".join(map(str, sides)) if len(sides) == 2 else f"{sides[0]} pixels wide"


class Animation(Drawn):
    """An animation; drawn when its bytes are asked for. Made by `field.draw.animate`. Notebooks show it.

    Its forms are ``gif``, in 256 colours, which is the default, and ``apng``, without loss. It can be pickled, but for a
    function that is told of the progress.
    """

    _forms = ("gif", "apng")

    def __init__(self, field: "Field", what: tuple[str, list[int]], milliseconds: int, progress: Any) -> None:
        super().__init__()
        self._made_of = field, what, milliseconds, progress

    def _draw(self, form: str) -> bytes:
        field, what, time, progress = self._made_of
        core, changes = field.dataset._core, json.dumps(field._subject)
        return self._told(_core.animation(field._core, core, changes, *what, time, form, progress))

    def gif(self) -> bytes:
        """In 256 colours, for programs that know no other."""
        return self.to_bytes("gif")

    def apng(self) -> bytes:
        """Without loss."""
        return self.to_bytes("apng")

    def _repr_png_(self) -> bytes:
        return self.apng()

    def __getstate__(self) -> dict[str, Any]:
        field, what, time, _ = self._made_of
        return {**self.__dict__, "_made_of": (field, what, time, None)}

    def __repr__(self) -> str:
        request, numbers = self._made_of[1]
        asked = json.loads(request)
        quantity, steps = asked.get("quantity") or "a field", plural(len(numbers), "step")
        return f"<ppum.Animation of {quantity}, {steps}, {_size(asked['look'])}>"
