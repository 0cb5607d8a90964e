"""Options: known to editors and type checkers, refused with a remedy where they are not known, and those of the libraries."""

import inspect
import io
import os
import pathlib
import re
import subprocess
import sys
from typing import get_args

import numpy as np
import ppum
import pytest
from conftest import ROOT
from ppum import _core
from ppum import _sections as sections
from ppum import _styles as styles
from ppum._draw import Draw
from ppum._options import UNSET, options_of

pytest.importorskip("matplotlib").use("agg")

FUNCTIONS = [
    (Draw.figure, styles.FigureOptions),
    (Draw.image, styles.ImageOptions),
    (Draw.animate, styles.SeriesOptions),
    (Draw.plot, styles.PlotOptions),
    (ppum.Field.view, styles.ViewerOptions),
    (ppum.Dataset.view, styles.ViewerOptions),
    (ppum.Problem.hole, sections.HoleOptions),
    (ppum.Problem.crack, sections.CrackOptions),
    (ppum.Problem.boundary, sections.BoundaryOptions),
    (ppum.Problem.discretization, sections.DiscretizationOptions),
    (ppum.Problem.accuracy, sections.SpaceOptions),
    (ppum.Problem.growth, sections.GrowthOptions),
    (ppum.Problem.adaptivity, sections.AdaptivityOptions),
]


@pytest.mark.parametrize("function, kind", FUNCTIONS, ids=lambda thing: getattr(thing, "__qualname__", None))
def test_options_are_in_signatures_and_help(function, kind):
    parameters = inspect.signature(function).parameters
    assert all(p.kind is not p.VAR_KEYWORD for p in parameters.values())
    for name, (_, option) in options_of(kind).items():
        assert parameters[name].default == option.default
        assert f"{name}: {option.text}" in function.__doc__


@pytest.mark.parametrize("_, kind", FUNCTIONS, ids=lambda thing: getattr(thing, "__qualname__", None))
def test_options_have_the_texts_of_the_program(_, kind):
    """By Python's names; what the program does not have has a text of its own."""
    names = {"cmap": "colormap", "clim": "range", "norm": "scale", "overlays": "overlay", "contrast": "extremes", "colorbar": "bar"}
    theirs = _core.option_texts()
    for name, (_, option) in options_of(kind).items():
        assert option.text[0] in "`[4" or option.text[0].isupper(), name
        assert len(option.text) > 4 and "--" not in option.text, name
        shared = theirs.get(names.get(name, name), "")
        if kind is styles.ImageOptions and name not in ("view", "vmin", "vmax", "size"):
            assert shared and option.text.startswith(re.split("--| \\[default", shared)[0]), name


def test_defaults_of_keys_are_those_of_problem_files():
    """The texts say the defaults of the tables of docs/problem, which are those of the solver."""
    pages = ROOT.joinpath("docs/problem").glob("*.md")
    tables = dict(re.findall(r"<!-- keys: (.*?) -->\n((?:\|.*\n)+)", "".join(page.read_text() for page in pages)))
    kinds = {
        "crack": sections.CrackOptions, "discretization": sections.DiscretizationOptions,
        "growth": sections.GrowthOptions, "adaptivity": sections.AdaptivityOptions,
    }  # fmt: skip
    found = 0
    for table, kind in kinds.items():
        rows = {cells[1].strip(" `"): cells[3].strip(' `"') for cells in (row.split(" | ") for row in _rows(tables[table]))}
        for name, (_, option) in options_of(kind).items():
            default = re.search(r"\[default: (.*)\]", option.text)
            if default and name != "enrichment_radius":
                words = re.split(r"[,;]", default[1])[0], re.split(r"[,;]| of the patch", rows[name])[0]
                assert words[0].lower() == words[1].lower(), name
                found += 1
    assert found > 15


def _rows(table):
    """The rows of a table of Markdown without its head, cells with a column in front."""
    return [f"| {row}" for row in table.splitlines()[2:]]


def test_consoles_complete_options(f, problem):
    shell = pytest.importorskip("IPython.core.completer").IPCompleter(namespace={"f": f, "plate": problem})
    for line, option in {
        "f.draw.figure('ux', cli": "clim=",
        "f.draw.plot('ux', vmi": "vmin=",
        "f.draw.render('ux', zo": "zoom=",
        "plate.boundary('top', trac": "traction=",
        "plate.discretization(overl": "overlap=",
    }.items():
        shell.use_jedi = False
        _, found = shell.complete(line_buffer=line, cursor_pos=len(line))
        assert option in found, line


def test_jedi_completes_options(f, problem):
    """What IPython asks by itself, and editors that see the objects."""
    jedi = pytest.importorskip("jedi")
    for line, option in {
        "f.draw.figure('ux', cli": "clim=",
        "f.draw.plot('ux', vmi": "vmin=",
        "f.draw.render('ux', zo": "zoom=",
        "plate.boundary('top', trac": "traction=",
        "plate.discretization(overl": "overlap=",
    }.items():
        found = jedi.Interpreter(line, [{"f": f, "plate": problem}]).complete()
        assert option in [completion.name for completion in found], line


@pytest.mark.parametrize(
    "use, meant",
    [
        (lambda f, p: f.draw.figure("ux", centre=(0, 0)), "center"),
        (lambda f, p: f.draw.figure("ux", colormap="magma"), "cmap"),
        (lambda f, p: f.draw.image("ux", overlay=["cells"]), "overlays"),
        (lambda f, p: f.draw.render("ux", zom=3), "zoom"),
        (lambda f, p: f.sample.extrema("ux", widht=3), "width"),
        (lambda f, p: f.draw.animate("ux", figsize=(3, 3)), "inches"),
        (lambda f, p: f.draw.figure("ux", contour=5), "isolines"),
        (lambda f, p: f.draw.figure("ux", palette="magma"), "cmap"),
        (lambda f, p: f.draw.plot("ux", cbar_kwargs={}), "colorbar"),
        (lambda f, p: f.view("ux", range=(0, 1)), "clim"),
        (lambda f, p: f.dataset.view("ux", clim=(0, 1), colormap="magma"), "cmap"),
        (lambda f, p: f.view("ux").figure(them="dark"), "theme"),
        (lambda f, p: f.draw.figure("ux", labels={"titel": "a"}), "title"),
        (lambda f, p: p.hole(centre=(0, 0), radius=1), "center"),
        (lambda f, p: p.boundary("top", tracton=(0, 1)), "traction"),
        (lambda f, p: p.discretization(ordr=3), "order"),
        (lambda f, p: p.growth(3, incremet=0.1), "increment"),
        (lambda f, p: p.accuracy(1e-3, oder=3), "order"),
        (lambda f, p: p.crack(splin=[(0, 0)]), "spline"),
    ],
)
def test_unknown_options_are_refused_at_the_call(f, problem, use, meant):
    pytest.importorskip("anywidget")
    with pytest.raises(TypeError, match=f"did you mean `{meant}`"):
        use(f, problem)


@pytest.mark.parametrize(
    "options, message",
    [
        ({"norm": "Log"}, "norm: 'Log' is not one of .*; did you mean 'log'"),
        ({"overlays": ["cell"]}, "overlays: 'cell' is not one of .*; did you mean 'cells'"),
        ({"overlays": "clouds"}, "overlays: 'clouds' is not one of 'cracks', 'cells'"),
        ({"deformed": "x"}, "deformed: 'x' is not one of 'auto' or a number"),
        ({"isolines": "many"}, "isolines: 'many' is not one of 'auto' or a number"),
        ({"clim": "foo"}, "clim: 'foo' is not a range; give 'auto', 'full'"),
        ({"clim": (3, 1)}, "give the smaller value first"),
        ({"clim": (0, float("nan"))}, "give finite values"),
        ({"clim": 3}, "give the lower and the upper value"),
        ({"clim": ("2%", "x")}, "is no range; write auto"),
        ({"cmap": "virids"}, "did you mean `viridis`"),
        ({"samples": 900}, "a number from 1 to 16"),
        ({"theme": "pink"}, "theme: 'pink' is not one of 'light', 'dark'"),
        ({"colorbar": "left"}, "colorbar: 'left' is not one of 'right', 'bottom'"),
        ({"tip": 0, "zoom": 0}, "zoom: 0 does not enlarge"),
        ({"size": (-1, 5)}, "size: -1x5 cannot be drawn"),
    ],
)
def test_wrong_values_are_refused_at_the_call(f, options, message):
    """Without a place in a text that nobody wrote."""
    with pytest.raises(ValueError, match=message) as info:
        f.draw.figure("ux", **options)
    assert "column" not in str(info.value)


def test_values_of_wrong_types_are_refused(f):
    for options in ({"arrows": "x"}, {"bands": 1.5}, {"symmetric": "yes"}, {"width": "wide"}):
        with pytest.raises(TypeError, match=f"{next(iter(options))}: .* is needed, not"):
            f.draw.figure("ux", **options)
    assert f.draw.figure("ux", bands=np.int64(3), arrows=np.float32(40), symmetric=np.True_, size=np.array([90, 90]))


@pytest.mark.parametrize(
    "use, message",
    [
        (lambda f: f.draw.figure("ux", ticks=3), "ticks: a dictionary of x, y, colorbar is needed, not 3"),
        (lambda f: f.draw.figure("ux", labels="A"), "labels: a dictionary of title, x, y, colorbar is needed, not 'A'"),
        (lambda f: f.draw.figure("ux", layout=2), "layout: 2 is not two whole numbers, columns and rows"),
        (lambda f: f.draw.figure("ux", layout=(0, 1)), "layout: 0x1 cannot be drawn"),
        (lambda f: f.draw.figure("ux", dpi=1e9), "dpi: give 1 to 100000 pixels per inch"),
        (lambda f: f.draw.figure("ux", inches=1e9), "inches|write a width above zero, up to 1000"),
        (lambda f: f.draw.animate(["ux", "uy"]), "quantity: an animation shows one"),
        (lambda f: f.part(3), "part: 'smooth', .* is needed, not 3"),
        (lambda f: f.with_weight(3), "weight: a name or a formula of t is needed, not 3"),
        (lambda f: f.with_function({0: 3}), "0: a formula is needed, such as 'r\\*theta', not 3"),
        (lambda f: f.with_function({99: "r"}), "99"),
    ],
)
def test_what_is_wrong_is_said_in_words(f, use, message):
    with pytest.raises((TypeError, ValueError), match=message) as info:
        use(f)
    assert "invalid type" not in str(info.value) and "object" not in str(info.value)


def test_functions_are_replaced_by_number(f):
    names = f.dataset.steps[-1].functions
    number = next(k for k, name in enumerate(names) if name.startswith("westergaard 1"))
    values = [f.with_function({which: "r"}).at(x, x).uy for which in (number, names[number]) for x in (-0.36, 0.36)]
    assert values[:2] == values[2:] != [f.at(x, x).uy for x in (-0.36, 0.36)]


def test_empty_rows_of_a_layout_are_told(f):
    figure = f.draw.figure(["ux", "uy", "sxx"], layout=(2, 2), size=(700, 900))
    figure.png()
    assert figure.warnings == ()
    with pytest.warns(UserWarning, match="the layout 2x2 has rows or columns that 1 image does not fill"):
        f.draw.figure("ux", layout=(2, 2), size=(700, 900)).png()


def test_one_end_of_a_range(f):
    """The other one is that of an automatic range."""
    facts = _core.frame(f._core, styles.request(f, "ux", {}, None), ppum.View((0.0, 0.0), 4.0, (64, 64)))[1]
    low, high = facts["range"]
    view = ppum.View((0, 0), 4.0, (64, 64))
    assert not np.array_equal(f.draw.image("ux", view=view), f.draw.image("ux", view=view, vmin=0.0))
    assert np.array_equal(f.draw.image("ux", view=view, vmin=low, vmax=0.1), f.draw.image("ux", view=view, clim=(low, 0.1)))
    made = styles.request(f, "ux", {"vmin": 0.0}, ppum.View((0.0, 0.0), 4.0))
    assert made["colors"]["range"].startswith("0.0,")
    assert float(made["colors"]["range"].split(",")[1]) == pytest.approx(high, rel=1e-2)
    for options in ({"vmin": 0, "clim": (0, 1)}, {"vmax": 0, "clim": "full"}):
        with pytest.raises(TypeError, match="not both"):
            f.draw.figure("ux", **options)
    with pytest.raises(ValueError, match="give both vmin and vmax"):
        f.draw.animate("ux", vmin=0)


def test_a_width_on_paper_has_the_height_of_the_picture(f):
    """A plate of 2 by 4 in a column of a journal, and what is beside it."""
    plt = pytest.importorskip("matplotlib.pyplot")
    image = plt.imread(io.BytesIO(f.draw.figure("ux", inches=3.4, dpi=100, cmap="magma").png()))
    dark = np.abs(image[..., :3] - image[..., :1]).max(axis=-1) > 0.1
    rows, columns = (np.flatnonzero(dark.mean(axis=axis) > 0.3) for axis in (1, 0))
    assert image.shape[1] == 340 and len(columns) >= 0.6 * 340 and len(rows) >= 1.9 * len(columns)
    beside = f.draw.figure("ux", inches=3.4, dpi=100, colorbar="right")
    assert "3.4 inches" in repr(beside) and plt.imread(io.BytesIO(beside.png())).shape[0] < image.shape[0]


def test_a_view_is_taken_by_all_that_draw(f):
    pytest.importorskip("anywidget")
    view = ppum.View((0.1, 0.2), 0.5, (80, 60))
    assert f.draw.figure("ux", view=view).png() == f.draw.figure("ux", center=(0.1, 0.2), width=0.5).png()
    assert f.view("ux", view=view).view.width == 0.5 and f.view("ux", view=view).center == (0.1, 0.2)
    assert np.array_equal(f.draw.render("ux", view=view), f.draw.render("ux", center=(0.1, 0.2), width=0.5, size=(80, 60)), equal_nan=True)
    assert f.draw.render("ux", view=view, size=(20, 10)).shape == (10, 20)
    with pytest.raises(TypeError, match="leave out width"):
        f.draw.render("ux", view=view, width=1.0)


KEYS = {
    "[[hole]]\n": sections.HoleOptions,
    "[[crack]]\n": sections.CrackOptions,
    '[[boundary]]\non = "top"\n': sections.BoundaryOptions,
    "[discretization]\nlevel = 2\n": sections.DiscretizationOptions,
    "[growth]\nsteps = 2\n": sections.GrowthOptions,
    "[adaptivity]\n": sections.AdaptivityOptions,
}


@pytest.mark.parametrize("head, kind", KEYS.items())
def test_options_are_the_keys_of_problem_files(head, kind):
    known = set()
    for text in (
        '[material]\nyoung = 1\npoisson = 0.3\nstate = "plane-strain"\n',
        '[equation]\nkind = "poisson"\n',
    ):
        box = "[domain]\nmin = [0, 0]\nmax = [1, 1]\n" + text
        box += "" if "discretization" in head else "[discretization]\nlevel = 2\n"
        found = _core.check(f"{box}{head}qqqq = 1\n", "text", pathlib.Path())
        texts = [text for *_, text in found if "unknown key `qqqq`" in text and "known are" in text]
        known |= {key for message in texts for key in re.split(r", | and ", message.split("known are ")[1])}
    of_methods = {"points"} if kind is sections.CrackOptions else {"on"} if "boundary" in head else {"steps"} if "growth" in head else set()
    assert known - of_methods == set(options_of(kind)) and known
    assert all(option.default is UNSET for _, option in options_of(kind).values())


def paths(asked, at=""):
    """The fields of a request, by their ways through its objects."""
    if not isinstance(asked, dict) or at == "labels":
        return {at}
    return set().union(*(paths(value, f"{at}.{name}".strip(".")) for name, value in asked.items()))


def test_figures_have_all_options_of_requests(f):
    """What the command line, which is a request too, can ask of an image, and a figure asks for nothing else."""
    given = {name: option.default for name, (_, option) in options_of(styles.FigureOptions).items()}
    given |= dict(cmap="magma", bands=3, nan_color="red", isolines=[1.0], arrows=40, crosses=40, mirror="left")
    given |= dict(precision="f64", dpi=100, font_size=9, colorbar="right", labels={"title": "t"})
    panels, alone = dict(parts=["all", "jump"], layout=(2, 1), size=(900, 600)), dict(deformed=2.0, inches=4)
    made = [{**given, **panels, "center": (0, 0), "width": 1.0}, {**given, **alone, "tip": 0, "zoom": 4.0}]
    asked = set().union(*(paths(f.draw.figure("ux", **options)._made_of[1]) for options in made))
    every = paths(_core.default_request())
    elsewhere = {path for path in every if path.startswith("subject.")} | {"place.view", "backend", "look.cm"}
    assert every - asked == elsewhere
    # a colour that is not given stands nowhere in a request
    assert asked <= every | {"colors.nan_color"}


def test_overlays_are_those_of_the_libraries(f):
    scene = {"overlays": {"shown": ["clouds"]}}
    with pytest.raises(ValueError) as info:
        _core.rgba(f._core, scene, ppum.View((0.0, 0.0), 1.0, (2, 2)))
    assert set(re.findall(r"`(\w+)`", str(info.value))) - {"clouds"} == set(get_args(styles.Overlay))
    for norm in get_args(styles.Norm):
        f.draw.figure("von_mises", norm=norm)


RIGHT = """
import numpy as np
import ppum

plate = (
    ppum.Problem(domain=((0, 0), (1, 1)), material=ppum.Elastic(1.0, 0.3))
    .crack((0.2, 0.5), (0.5, 0.5))
    .crack(np.array([[0.2, 0.8], [0.5, 0.8]]))
    .hole(center=(0.7, 0.2), radius=0.1)
    .boundary("top", traction=(0, 1))
    .discretization(cells=(8, 8), order=2)
    .growth(3, criterion="hoop")
)
ds: ppum.Dataset = ppum.open("plate.h5")
f = ds.field
f.draw.figure("ux", tip=0, zoom=10, norm="log", vmin=0, overlays=["cracks"], colorbar="right").save("a.png")
f.draw.plot("ux", vmin=0, vmax=1, cmap="batlow")
ds.view("ux", clim=(0, 1), cmap="magma")
k1: float = f.intensities(0).k1
tips: ppum.results.Table[ppum.Tip] = f.intensities()
"""

WRONG = {
    'f.draw.figure("ux", centre=(0, 0))': "call-arg",
    'f.draw.figure("ux", norm="Log")': "arg-type",
    'f.draw.figure("ux", overlays=["cell"])': "list-item",
    'f.draw.plot("ux", colormap="magma")': "call-arg",
    'ds.view("ux", range=(0, 1))': "call-arg",
    'f.draw.render("ux", zom=3)': "call-arg",
    'plate.boundary("top", tracton=(0, 1))': "call-arg",
    "plate.hole(centre=(0, 0))": "call-arg",
    "plate.discretization(order=2.5)": "arg-type",
    'plate.growth(2, criterion="hop")': "arg-type",
    "plate.accuracy(1e-3, oder=3)": "call-arg",
    "ppum.Problem((0, 0), (1, 1))": "arg-type",
}


def test_mypy_finds_wrong_options(tmp_path):
    pytest.importorskip("mypy")
    script = tmp_path / "script.py"
    script.write_text(RIGHT + "\n".join(WRONG) + "\n")
    run = [sys.executable, "-m", "mypy", "--strict", "--config-file", ROOT / "pyproject.toml", "--cache-dir", tmp_path / "cache", script]
    folder = pathlib.Path(ppum.__file__).parents[1]
    # mypy finds installed packages by itself, and refuses to be told of them
    path = {} if folder.name == "site-packages" else {"MYPYPATH": str(folder)}
    environment = {**os.environ, **path}
    done = subprocess.run(run, cwd=tmp_path, capture_output=True, text=True, env=environment)
    found = re.findall(r"script\.py:(\d+): error: .*\[([\w-]+)\]", done.stdout)
    first = RIGHT.count("\n") + 1
    expected = {str(first + k): code for k, code in enumerate(WRONG.values())}
    assert dict(found) == expected, done.stdout + done.stderr


@pytest.mark.parametrize("inches", [0, -1, float("nan"), float("inf"), (3, 0), (1, 2, 3), ()])
def test_sizes_on_paper_are_checked_at_the_call(f, inches):
    with pytest.raises(ValueError, match="inches: .* give a width"):
        f.draw.figure("ux", inches=inches)


def test_what_figures_cannot_be_is_said_at_the_call(f):
    with pytest.raises(TypeError, match="not both"):
        f.draw.figure("ux", inches=2.2, size=(300, 300))
    with pytest.raises(ValueError, match="give one at least"):
        f.draw.figure([])


def test_panels_are_as_high_as_they_need(f):
    """Two plates twice as high as wide beside each other: no more above and below than labels need."""
    plt = pytest.importorskip("matplotlib.pyplot")
    image = plt.imread(io.BytesIO(f.draw.figure(["ux", "uy"], inches=7, layout=(2, 1), dpi=100).png()))
    high, wide = image.shape[:2]
    drawn = np.flatnonzero((image[:, :, :3] < 0.9).any(axis=(1, 2)))
    assert wide == 700 and drawn[0] < 0.1 * high and drawn[-1] > 0.9 * high
