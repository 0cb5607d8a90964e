"""Random problem files, each determined by its number.

    python tests/random/generate.py FOLDER [NUMBER …]

Writes NNN.toml for each number (without numbers: for those in values.json). The number decides the kind, in turn through
`KINDS`, and seeds the rest. Lengths are drawn in units of the plate's shorter side, then scaled and rounded.
Interfaces of materials, which the reference has to be told, stand in a comment on the first line.
"""

import json
import math
import pathlib
import random
import sys

from loads import elastic_loads, poisson_loads
from materials import conductivity, material
from plate import Misfit, Plate

HERE = pathlib.Path(__file__).parent
# What a problem is about. All else is drawn too, mostly plain.
KINDS = (
    "straight crack", "several cracks", "kinked crack", "sharp kink", "edge crack", "kinked edge crack",
    "cut plate", "crack from a hole", "crack beside a hole", "polygon hole", "notch", "graded", "graded and loaded",
    "two materials", "inclusion", "near-incompressible", "face pressure", "face traction", "rim pressure",
    "held pieces", "loads on pieces", "body force", "hole alone", "balanced", "anything", "poisson", "poisson hole",
)


class Draw(random.Random):
    """Random choices, by `random()` alone: the same numbers in every version of Python."""

    def between(self, low, high):
        return low + (high - low) * self.random()

    def chance(self, probability):
        return self.random() < probability

    def pick(self, *options):
        return options[int(self.random() * len(options))]

    def sign(self):
        return self.pick(-1.0, 1.0)


def problem(number):
    """The text of a problem file."""
    kind = KINDS[number % len(KINDS)]
    draw = Draw(number)
    while True:
        try:
            return written(number, kind, draw)
        except Misfit:
            pass


def written(number, kind, draw):
    """The text of a problem file; `Misfit` if what was drawn does not fit together."""
    plate = Plate(draw, kind)
    poisson = kind.startswith("poisson")
    made = conductivity(draw, plate) if poisson else material(draw, plate, kind)
    loads = poisson_loads(draw, plate, made) if poisson else elastic_loads(draw, plate, made, kind)
    head = f"# reference: {made.options}\n" if made.options else ""
    title = f'title = "{number:03} {kind}: {plate.words()}; {made.words}; {loads.words}"\n'
    equation = '\n[equation]\nkind = "poisson"\n' if poisson else ""
    parts = [head + title + equation, plate.text_of_domain(), made.text, plate.text(), loads.text()]
    return "\n".join(part for part in parts if part) + "\n[discretization]\nlevel = 4\n"


def kept():
    """The numbers of the problems that have values."""
    return [int(number) for number in json.loads((HERE / "values.json").read_text())["problems"]]


def main():
    folder = pathlib.Path(sys.argv[1])
    folder.mkdir(parents=True, exist_ok=True)
    for number in [int(word) for word in sys.argv[2:]] or kept():
        (folder / f"{number:03}.toml").write_text(problem(number))


if __name__ == "__main__":
    main()
