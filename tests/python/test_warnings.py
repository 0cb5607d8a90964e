"""Compares docs/warnings.md with the warnings of the sources: every kind has a section, and every quoted text is one of theirs.

    python tests/python/test_warnings.py          (or: pytest tests/python; needs nothing but Python)
"""

import difflib
import pathlib
import re

ROOT = pathlib.Path(__file__).parents[2]
PAGE = (ROOT / "docs/warnings.md").read_text()
# where warnings are made: the solver, and the command that finds factors again
FOLDERS = [ROOT / f"crates/{crate}/src" for crate in ("ppum-problem", "ppum-solve", "ppum-fracture")]
SOURCES = [*(path for folder in FOLDERS for path in folder.rglob("*.rs")), ROOT / "crates/ppum-cli/src/commands/sif.rs"]
TEXTS = [path.read_text() for path in SOURCES]

# the table of all kinds: a name and its code in files
KIND = re.compile(r'^    [A-Z]\w+ "([a-z0-9-]+)",$', re.MULTILINE)


def kinds():
    """The kinds of warnings in the table of the sources."""
    found = set(KIND.findall((ROOT / "crates/ppum/src/dataset/warning.rs").read_text()))
    assert len(found) > 20, found
    return found


def literals():
    """The string literals of the sources, each on one line."""
    joined = [re.sub(r"\\\n\s*", "", text) for text in TEXTS]
    return [text for source in joined for text in re.findall(r'"((?:[^"\\]|\\.)*)"', source)]


def quotes():
    """The texts that the page quotes, without its line ends."""
    blocks = re.findall(r"(?:^> .*\n)+", PAGE, re.MULTILINE)
    return [" ".join(block.replace("> ", "", 1).replace("\n> ", " ").split()) for block in blocks]


def test_every_kind_has_a_section():
    sections = set(re.findall(r"^### `([a-z0-9-]+)`$", PAGE, re.MULTILINE))
    assert sections == kinds(), sections ^ kinds()


def test_quoted_texts_are_those_of_the_sources():
    known = [text.replace('\\"', '"') for text in literals()]
    found = quotes()
    assert len(found) >= 28, found
    for quote in found:
        for fragment in filter(None, (part.strip(" :;,()") for part in quote.split("…"))):
            if not any(fragment in text for text in known):
                near = difflib.get_close_matches(fragment, known, 1, 0.3)
                raise AssertionError(f"{fragment!r} is not in the sources; nearest: {near}")


if __name__ == "__main__":
    for test in [test_every_kind_has_a_section, test_quoted_texts_are_those_of_the_sources]:
        test()
        print(f"ok  {test.__name__}")
