"""Files that are drawn when they are asked for, and how files are replaced."""

import errno
import os
import secrets
from pathlib import Path
from typing import ClassVar

from ._warnings import warn


class Drawn:
    """Drawn when its bytes are asked for, once for each form of file.

    Attributes:
        warnings: What is to be known of what was drawn, such as pixels without a value; each is warned of once too.
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
        """The bytes of its file.

        Args:
            form: The end of the file's name, such as ``png``; by default that of the first form that the class names.

        Raises:
            QuantityError, RenderError: What cannot be drawn.
            ValueError: A form that there is not; a size without room.
        """
        form = self._forms[0] if form is None else form
        if form not in self._forms:
            raise ValueError(f"cannot draw {form!r}: {self._known_forms()}")
        if form not in self._known:
            self._known[form] = self._draw(form)
        return self._known[form]

    def save(self, path: str | os.PathLike[str]) -> None:
        """Writes a file, of the form that its name ends in. What was there stays until it is complete."""
        path = Path(path)
        folder_of(path)
        form = path.suffix[1:].lower()
        if not form:
            raise ValueError(f"the name {path.name!r} has no end that says a form: {self._known_forms()}")
        replace(path, self.to_bytes(form))

    def _known_forms(self) -> str:
        return f"the forms of {type(self).__name__} are {', '.join(self._forms)}"


class Page(Drawn):
    """A page, as ``png``, the default, ``svg`` or ``pdf``."""

    _forms = ("png", "svg", "pdf")

    def png(self) -> bytes:
        """Pixels."""
        return self.to_bytes("png")

    def svg(self) -> str:
        """Vector lines and text, for the web."""
        return self.to_bytes("svg").decode()

    def pdf(self) -> bytes:
        """Vector lines and text, for papers."""
        return self.to_bytes("pdf")

    def _repr_png_(self) -> bytes:
        return self.png()


def folder_of(path: Path) -> Path:
    """The folder that a file is to lie in."""
    if not path.parent.is_dir():
        raise FileNotFoundError(errno.ENOENT, "there is no such folder", str(path.parent))
    return path.parent


def replace(path: Path, data: bytes) -> None:
    """Puts bytes in the place of a file: what was there stays until they are all written."""
    part = folder_of(path) / f"{path.name}.{secrets.token_hex(4)}"
    try:
        part.write_bytes(data)
        os.replace(part, path)
    except BaseException:
        part.unlink(missing_ok=True)
        raise
