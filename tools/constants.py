"""Asks how much stress intensity factors owe to the solver's tuned constants.

    python tools/constants.py --program target/release/ppum --work /tmp/constants 1 2 3     (needs h5py)
    python tools/constants.py --list

For each seed all constants are multiplied by 0.8 or 1.2 at random in a copy of the tree, and examples are solved by
the program built there and by the unchanged one. Printed is for each the largest movement of (K_I, K_II) of a tip, as
a part of its size and of its estimated error.

A constant is tuned if it is a scalar f64 of ppum-solve or ppum-fracture that stands as a decimal number between 1e-5
and 100 in its declaration: smaller ones are roundoff and accuracies of exact arithmetic, larger ones limits of memory.
Exponents are mathematics, and constants whose comment speaks of bytes, memory or rounding are what it says.
"""

import argparse
import pathlib
import random
import re
import subprocess
import tarfile

ROOT = pathlib.Path(__file__).parents[1]
CRATES = ("ppum-solve", "ppum-fracture")
EXAMPLES = """centre-crack centre-crack-tension edge-crack edge-shear compact-tension slanted-crack kinked-crack
    arc-crack cracked-hole insulated-crack meeting-cracks many-cracks three-point-bending pressed-crack""".split()
CONSTANT = re.compile(r"((?:^ *//.*\n)*)^(.*\bconst ([A-Z0-9_]+): f64 = )([0-9][0-9_.e-]*);", re.M)
FOREIGN = re.compile(r"\b(bytes?|memory|exponent|rounding|roundings)\b", re.I)


def sources(tree):
    """The source files of the crates in a tree, in order."""
    return [path for crate in CRATES for path in sorted((tree / "crates" / crate / "src").rglob("*.rs"))]


def is_tuned(match):
    """True of a declaration whose number was chosen by trials."""
    comment, _, name, number = match.groups()
    return 1e-5 <= float(number.replace("_", "")) <= 100.0 and not FOREIGN.search(f"{comment} {name}")


def perturbed(text, choose):
    """A text with its tuned constants multiplied by what `choose` returns, and their names."""
    names = []

    def replacement(match):
        if not is_tuned(match):
            return match.group(0)
        names.append(match.group(3))
        return f"{match.group(1)}{match.group(2)}{float(match.group(4).replace('_', '')) * choose()!r};"

    return CONSTANT.sub(replacement, text), names


def copied(tree, seed):
    """Writes the committed tree with other constants to a folder, and returns how many were changed."""
    tree.mkdir(parents=True, exist_ok=True)
    with subprocess.Popen(["git", "archive", "HEAD"], cwd=ROOT, stdout=subprocess.PIPE) as archive:
        with tarfile.open(fileobj=archive.stdout, mode="r|") as tar:
            tar.extractall(tree, filter="data")
    choose, count = random.Random(seed), 0
    for path in sources(tree):
        text, names = perturbed(path.read_text(), lambda: choose.choice((0.8, 1.2)))
        path.write_text(text)
        count += len(names)
    return count


def factors(program, example, file):
    """K_I, K_II and the estimated error of the tips of the last step; none if the problem is not solved."""
    import h5py

    command = [str(program), "solve", str(ROOT / "examples" / f"{example}.toml"), "-o", str(file)]
    if subprocess.run(command, capture_output=True, check=False).returncode != 0:
        return None
    with h5py.File(file) as data:
        tips = data["steps"][max(data["steps"])]["intensities"]
        errors = tips["error"][()] if "error" in tips else len(tips["k1"]) * [float("nan")]
        return list(zip(tips["k1"][()], tips["k2"][()], errors))


def movement(known, found):
    """The largest movement of K of a tip, as a part of its size, and of its estimated error."""
    if not known or not found or len(known) != len(found):
        return float("nan"), float("nan")
    moves = [((a - x) ** 2 + (b - y) ** 2) ** 0.5 for (a, b, _), (x, y, _) in zip(known, found)]
    sizes = [(a * a + b * b) ** 0.5 for a, b, _ in known]
    return max(m / s for m, s in zip(moves, sizes)), max(m / e for m, (_, _, e) in zip(moves, known))


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("seeds", nargs="*", type=int)
    parser.add_argument("--list", action="store_true", help="print the tuned constants and stop")
    parser.add_argument("--program", type=pathlib.Path, default=ROOT / "target/release/ppum")
    parser.add_argument("--work", type=pathlib.Path, default=pathlib.Path("/tmp/constants"))
    args = parser.parse_args()
    if args.list:
        for path in sources(ROOT):
            for name in perturbed(path.read_text(), lambda: 1.0)[1]:
                print(f"{path.relative_to(ROOT)}: {name}")
        return
    args.work.mkdir(parents=True, exist_ok=True)
    known = {example: factors(args.program, example, args.work / "known.h5") for example in EXAMPLES}
    for seed in args.seeds:
        count = copied(args.work / "tree", seed)
        build = [*"cargo build --release --locked -p ppum-cli --target-dir".split(), str(args.work / "target")]
        subprocess.run(build, cwd=args.work / "tree", check=True)
        program = args.work / "target/release/ppum"
        print(f"seed {seed}, {count} constants\nexample                    of K  of its error")
        for example in EXAMPLES:
            part, errors = movement(known[example], factors(program, example, args.work / "found.h5"))
            print(f"{example:<24} {part:7.1e} {errors:13.2f}", flush=True)


if __name__ == "__main__":
    main()
