"""Files that are drawn when they are asked for."""

import os
from pathlib import Path
from typing import ClassVar

from . import _core
from ._warnings import warn


class Drawn:
    """A file that is drawn when its bytes are asked for, once for each form.

    Attributes:
        warnings: Messages about what was drawn, such as pixels without a value; each is also warned of once.
    """

    #: The forms that there are; the first one is drawn if none is asked for.
    _forms: ClassVar[tuple[str, ...]]

    def __init__(self) -> None:
        self._known: dict[str, bytes] = {}
        self.warnings: tuple[str, ...] = ()

    def _with_warnings(self, made: tuple[bytes, list[str]]) -> bytes:
        data, texts = made
        new = [text for text in dict.fromkeys(texts) if text not in self.warnings]
        self.warnings += tuple(new)
        warn(*new)
        return data

    def _draw(self, form: str) -> bytes:
        raise NotImplementedError

    def to_bytes(self, form: str | None = None) -> bytes:
        """Return the bytes of a file.

        Args:
            form: The end of the file's name, such as ``png``; by default the first form that the class names.

        Raises:
            QuantityError, RenderError: The content cannot be drawn.
            ValueError: The form is unknown, or the size leaves no room.
        """
        form = self._forms[0] if form is None else form
        if form not in self._forms:
            raise ValueError(f"cannot draw {form!r}: {self._known_forms()}")
        if form not in self._known:
            self._known[form] = self._draw(form)
        return self._known[form]

    def save(self, path: str | os.PathLike[str]) -> None:
        """Write a file in the form that its name ends in. An existing file is replaced only by a complete one."""
        path = Path(path)
        form = path.suffix[1:].lower()
        if not form:
            raise ValueError(f"the name {path.name!r} has no end that says a form: {self._known_forms()}")
        _core.check_target(path)
        _core.replace(path, self.to_bytes(form))

    def _known_forms(self) -> str:
        return f"the forms of {type(self).__name__} are {', '.join(self._forms)}"


class Page(Drawn):
    """A page, as ``png``, the default, ``svg`` or ``pdf``."""

    _forms = ("png", "svg", "pdf")

    def png(self) -> bytes:
        """Return the bytes of an image in pixels."""
        return self.to_bytes("png")

    def svg(self) -> str:
        """Return the text of a vector image for the web."""
        return self.to_bytes("svg").decode()

    def pdf(self) -> bytes:
        """Return the bytes of a vector image for papers."""
        return self.to_bytes("pdf")

    def _repr_png_(self) -> bytes:
        return self.png()
