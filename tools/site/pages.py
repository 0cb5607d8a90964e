#!/usr/bin/env python3
"""Copies the pages of the project into a folder, in the form that the site's generator takes.

    tools/site/pages.py FOLDER

Pages keep their places and their links. What a page links to besides pages and images becomes a page as well: a file of
text is shown as it is, a notebook by its cells, a folder by its list. A link to something that is not there is left as it
is, and the generator refuses it.
"""

import json
import pathlib
import re
import shutil
import sys

ROOT = pathlib.Path(__file__).resolve().parents[2]
# where the walk through links begins; every page of the project is to be reached from here
START = "README.md"
IMAGES = {".gif", ".jpg", ".png", ".svg"}
LANGUAGES = {".bib": "bibtex", ".json": "json", ".py": "python", ".rs": "rust", ".toml": "toml", ".wgsl": "wgsl", "": "bash"}
LINK = re.compile(r"(\]\()([^)#\s]+)")
CODE = re.compile(r"`[^`]*`")


def links(text):
    """The targets of a page's links and images in the project, without those in blocks of code."""
    prose = re.sub(r"^```.*?^```", "", text, flags=re.DOTALL | re.MULTILINE)
    return [target for _, target in LINK.findall(prose) if "://" not in target]


def notebook(path):
    """A notebook as a page: its text, and its code in blocks."""
    def cell(one):
        text = "".join(one["source"])
        return text if one["cell_type"] == "markdown" else f"```python\n{text}\n```"

    return "\n\n".join(cell(one) for one in json.loads(path.read_text())["cells"]) + "\n"


def listing(folder):
    """A page for a folder: its pages by their headings, and its other files by their names."""
    def line(path):
        heading = path.read_text().split("\n", 1)[0].lstrip("# ") if path.suffix == ".md" else f"`{path.name}`"
        return f"- [{heading}]({path.name})"

    # what has a form of its own, or none, is not shown
    shown = [path for path in sorted(folder.iterdir()) if path.suffix in {".md", ".py", ".rs", ".sh", ".toml"}]
    return f"# {folder.name.capitalize()}\n\n" + "\n".join(map(line, shown)) + "\n"


def source(path):
    """A page that shows a file of text."""
    language = LANGUAGES.get(path.suffix, "text")
    return f"# {path.name}\n\n````{language}\n{path.read_text()}\n````\n"


def place(path):
    """Where the page of a file or a folder lies, without a dot in front, which generators pass over."""
    inner = path.relative_to(ROOT)
    parts = [part.lstrip(".") for part in inner.parts]
    if path.is_dir():
        return pathlib.Path(*parts, "README.md")
    return pathlib.Path(*parts) if path.suffix in IMAGES | {".md"} else pathlib.Path(*parts[:-1], parts[-1] + ".md")


def page(path):
    """The text of a page of the site."""
    if path.is_dir():
        return listing(path)
    if path.suffix == ".md":
        # words behind a language are for the project's tests; in code of tables the generator takes bars as they are
        text = re.sub(r"^```(\w+) .*$", r"```\1", path.read_text(), flags=re.MULTILINE)
        return re.sub(r"^\|.*", lambda row: CODE.sub(lambda code: code[0].replace("\\|", "|"), row[0]), text, flags=re.MULTILINE)
    return notebook(path) if path.suffix == ".ipynb" else source(path)


def relinked(text, path):
    """A page whose links to files and folders lead to their pages."""
    def link(found):
        target = path.parent / found[2] if path.is_file() else path / found[2]
        if "://" in found[2] or not target.exists():
            return found[0]
        there = place(target.resolve())
        if there == target.resolve().relative_to(ROOT):
            return found[0]
        up = len(place(path).parent.parts)
        return f"{found[1]}{'../' * up}{there.as_posix()}"

    return LINK.sub(link, text)


def write(folder):
    """Writes the start and all that is reached from there, and returns the pages."""
    waiting, seen = [ROOT / START], set()
    while waiting:
        path = waiting.pop().resolve()
        if path in seen or not path.exists():
            continue
        seen.add(path)
        out = folder / place(path)
        out.parent.mkdir(parents=True, exist_ok=True)
        if path.suffix in IMAGES:
            shutil.copyfile(path, out)
            continue
        text = page(path)
        base = path if path.is_dir() else path.parent
        waiting += [base / target for target in links(text)]
        out.write_text(relinked(text, path))
    return seen


def main():
    folder = pathlib.Path(sys.argv[1])
    shutil.rmtree(folder, ignore_errors=True)
    seen = write(folder)
    missing = [path for path in (ROOT / "docs").rglob("*.md") if path not in seen]
    assert not missing, f"no link leads to {missing}"
    print(f"{sum(path.suffix not in IMAGES for path in seen)} pages, {sum(path.suffix in IMAGES for path in seen)} images")


if __name__ == "__main__":
    main()
