"""Pictures: values at pixels, figures, extreme values, against the values themselves and the program."""

import io

import numpy as np
import ppum
import pytest

pytest.importorskip("matplotlib")
import matplotlib

matplotlib.use("agg")
import matplotlib.image
import matplotlib.pyplot as plt


def centers(view):
    columns, rows = view.size
    x = view.center[0] + ((np.arange(columns) + 0.5) / columns - 0.5) * view.width
    y = view.center[1] - ((np.arange(rows) + 0.5) / rows - 0.5) * view.height
    return x[None, :], y[:, None]


@pytest.mark.filterwarnings("ignore:invalid value")
@pytest.mark.parametrize("name", ["ux", "von_mises", "sxx + syy"])
def test_pixels_are_values(f, name):
    for seen in ({}, {"tip": 1, "zoom": 50}, {"center": (0.1, 0.2), "width": 0.7}):
        view = f.view_at(size=(61, 47), **seen)
        found = f.draw.render(name, view=view)
        expected = f.at(*centers(view))[name]
        assert found.shape == (47, 61) and found.dtype == np.float64
        assert np.array_equal(np.isnan(found), np.isnan(expected))
        size = np.nanmax(np.abs(expected))
        # on the crack a picture takes the side that rounding finds
        off = np.ptp(f.at(*centers(view), side="both")[name], axis=-1) == 0
        assert off[np.isfinite(found)].mean() > 0.8 and np.abs(found - expected)[off].max() < 1e-11 * size
        single = f.draw.render(name, view=view, dtype=np.float32)
        assert single.dtype == np.float32
        # pixels beside a crack may be on its other side in single precision
        assert np.nanquantile(np.abs(single - expected), 0.99) < 1e-4 * size


def test_values_of_cells(f):
    level = f.draw.render("level", size=(40, 80))
    assert set(np.unique(level[np.isfinite(level)])) <= set(range(20))


def test_pictures_are_those_of_the_program(ds, f, program, tmp_path):
    ds.save(tmp_path / "plate.h5")
    figure = f.draw.figure("von_mises", size=(640, 480))
    figure.save(tmp_path / "python.png")
    program("render", tmp_path / "plate.h5", "-o", tmp_path / "program.png", "--figure", "-q", "von-mises", "--size", "640x480")
    ours, theirs = (matplotlib.image.imread(tmp_path / f"{name}.png") for name in ("python", "program"))
    assert ours.shape[:2] == (480, 640) and np.array_equal(ours, theirs)


def test_what_is_said_of_a_figure_is_what_the_program_says(ds, f, program, tmp_path):
    """One request: equal pixels, equal warnings."""
    ds.save(tmp_path / "plate.h5")
    options = ["--figure", "-q", "sqrt(x)", "--size", "500x400", "--samples", "2", "--isolines", "1e9,", "--labels", "title=\u2603"]
    program("render", tmp_path / "plate.h5", "-o", tmp_path / "theirs.png", *options)
    figure = f.draw.figure("sqrt(x)", size=(500, 400), samples=2, isolines=[1e9], labels={"title": "\u2603"})
    with pytest.warns(UserWarning) as caught:
        figure.save(tmp_path / "ours.png")
    ours, theirs = (matplotlib.image.imread(tmp_path / f"{name}.png") for name in ("ours", "theirs"))
    assert np.array_equal(ours, theirs)
    assert len(figure.warnings) == 3
    assert list(figure.warnings) == [str(warning.message) for warning in caught] == program.warnings


@pytest.mark.parametrize(
    "options, wanted",
    [
        ("-q ux,uy,s1 --layout 3x1", {"quantity": ["ux", "uy", "s1"], "layout": (3, 1)}),
        ("-q von-mises,level --shared-range --size 700x500", {"quantity": ["von_mises", "level"], "shared_range": True, "size": (700, 500)}),
        ("-q uy --part all,smooth,jump,tip --shared-range", {"quantity": "uy", "parts": ["all", "smooth", "jump", "tip"], "shared_range": True}),
        ("-q ux,s1 --part all,jump --ticks x=3 --ticks y=-1,0.5", {"quantity": ["ux", "s1"], "parts": ["all", "jump"], "ticks": {"x": 3, "y": [-1, 0.5]}}),
        ("--layout 1x1 --tip 1 --zoom 40 --overlay cracks,rings", {"layout": (1, 1), "tip": 1, "zoom": 40, "overlays": ["cracks", "rings"]}),
        ("--figure -q uy --ticks 3 --overlay supports,loads", {"quantity": "uy", "ticks": {"colorbar": 3}, "overlays": ["supports", "loads"]}),
        ("--figure -q uy --mirror=left,top:antisymmetric", {"quantity": "uy", "mirror": "left,top:antisymmetric"}),
        ("--figure -q s1 --tip 0 --zoom 3 --deformed 0.1 --outline", {"quantity": "s1", "tip": 0, "zoom": 3, "deformed": 0.1, "outline": True}),
    ],
)
def test_panels_marks_and_places_are_those_of_the_program(ds, f, program, tmp_path, options, wanted):
    ds.save(tmp_path / "plate.h5")
    program("render", tmp_path / "plate.h5", "-o", tmp_path / "theirs.png", *options.split())
    figure = f.draw.figure(**wanted)
    figure.save(tmp_path / "ours.png")
    ours, theirs = (matplotlib.image.imread(tmp_path / f"{name}.png") for name in ("ours", "theirs"))
    assert np.array_equal(ours, theirs)
    assert list(figure.warnings) == program.warnings


def test_panels_that_there_are_not(f):
    for wrong, error, message in [
        ({"quantity": ["ux", "uy"], "layout": (1, 1)}, ppum.RenderError, "1x1 has fewer panels than there are pictures, 2"),
        ({"quantity": ["ux", "uy"], "layout": (0, 1)}, ppum.RenderError, "layout: 0x1 cannot be drawn"),
        ({"quantity": "ux", "shared_range": True}, ppum.RenderError, "is for panels"),
        ({"quantity": "ux", "parts": ["all", "jump"], "deformed": 1.0}, ppum.RenderError, "do not go together"),
        ({"quantity": "ux", "parts": ["all", "nothing"]}, ppum.QuantityError, "nothing"),
        ({"quantity": ["ux", "nonsense"]}, ppum.QuantityError, "nonsense"),
        ({"quantity": "ux", "parts": ["jump"]}, ValueError, "Field.part"),
        ({"quantity": ["ux", "uy"], "vmin": 0.0}, ValueError, "both vmin and vmax"),
        ({"quantity": "ux", "ticks": {"z": 3}}, TypeError, "ticks has no option `z`"),
        ({"quantity": "ux", "ticks": {"x": 0}}, ValueError, "1 to 100"),
    ]:
        with pytest.raises(error, match=message):
            f.draw.figure(**wrong).png()
    assert repr(f.draw.figure(["ux", "uy"])) == "<ppum.Figure ux, uy, panels>"
    assert repr(f.draw.figure("ux", parts=["all", "tip"], size=(700, 500))) == "<ppum.Figure ux, all, tip, 700x500>"


def test_figures(f, tmp_path):
    figure = f.draw.figure("uy", cmap="coolwarm", isolines=7, overlays=["cells"], deformed="auto", outline=True, size=(400, 500))
    assert figure._repr_png_() == figure.png() and figure.png()[:4] == b"\x89PNG"
    assert figure.svg().startswith("<") and figure.pdf()[:5] == b"%PDF-"
    for end, start in (("png", b"\x89PNG"), ("svg", b"<"), ("pdf", b"%PDF")):
        figure.save(tmp_path / f"a.{end}")
        assert (tmp_path / f"a.{end}").read_bytes().startswith(start)
    assert sorted(p.name for p in tmp_path.iterdir()) == ["a.pdf", "a.png", "a.svg"]
    paper = f.draw.figure("s1", inches=(3.4, 2.6), dpi=100, clim=("2%", "98%"), norm="symlog", theme="dark", colorbar="bottom")
    assert matplotlib.image.imread(io.BytesIO(paper.png())).shape[:2] == (260, 340)
    deep = f.draw.figure("von_mises", tip=1, zoom=1e12, norm="log", size=(400, 300))
    assert len(deep.png()) > 1000


def test_colours(f):
    rgba = f.draw.image("ux", size=(30, 20), cmap="viridis", clim="full")
    assert rgba.shape == (20, 30, 4) and rgba.dtype == np.uint8
    values = f.draw.render("ux", size=(30, 20))
    assert np.array_equal(rgba[..., 3] == 0, np.isnan(values))
    inside = np.isfinite(values)
    order = np.argsort(values[inside])
    # viridis grows lighter
    light = rgba[..., :3] @ [0.2126, 0.7152, 0.0722]
    assert (np.diff(light[inside][order]) >= -1).all()
    assert len(ppum.COLORMAPS) > 5


def test_extrema(ds, f):
    low, high = f.sample.extrema("von_mises")
    assert high.value == np.inf and high.on == "singular"
    assert min(np.hypot(*np.subtract(high.xy, tip.xy)) for tip in ds.tips) < 1e-12
    assert 0 < low.value < np.nanmin(f.draw.render("von_mises")) * 1.001
    view = f.view_at(center=(0.6, -0.9), width=0.3)
    low, high = f.sample.extrema("ux", view=view)
    values = f.draw.render("ux", view=view)
    assert low.value <= np.nanmin(values) + 1e-9 and high.value >= np.nanmax(values) - 1e-9
    assert f.at(*high.xy).ux == pytest.approx(high.value, rel=1e-6)


def drawn(f, name, dpi, limits=None, **options):
    """The pixels of axes that fill the figure, from the top, and their values."""
    figure = plt.figure(figsize=(1, 2), dpi=dpi)
    ax = figure.add_axes((0, 0, 1, 2 / 2))
    ax.set_axis_off()
    artist = f.draw.plot(name, ax=ax, colorbar=False, cracks=False, cmap="gray", clim="full", **options)
    ax.set_xlim(limits[0] if limits else (-1, 1))
    ax.set_ylim(limits[1] if limits else (-2, 2))
    file = io.BytesIO()
    figure.savefig(file, dpi=dpi)
    plt.close(figure)
    file.seek(0)
    return matplotlib.image.imread(file), artist


@pytest.mark.parametrize("dpi", [40, 90])
@pytest.mark.parametrize("limits", [None, ((0.1, 0.4), (0.2, 0.8))])
def test_matplotlib_shows_exact_values(f, dpi, limits):
    image, artist = drawn(f, "uy", dpi, limits)
    (x0, x1), (y0, y1) = limits or ((-1, 1), (-2, 2))
    rows, columns = image.shape[:2]
    view = ppum.View(((x0 + x1) / 2, (y0 + y1) / 2), x1 - x0, (columns, rows))
    values = f.at(*centers(view)).uy
    expected = artist.norm(values) if False else artist.to_rgba(values, bytes=True)
    assert (np.abs(image * 255 - expected).max(axis=2) <= 1).mean() > 0.995


def test_matplotlib_around_a_tip(ds, f):
    x, y = ds.tips[1].xy
    image, _ = drawn(f, "von_mises", 60, ((x - 1e-7, x + 1e-7), (y - 2e-7, y + 2e-7)), norm="log")
    assert image[..., 0].std() >= 0.0 and image.shape == (120, 60, 4)


def test_matplotlib_axes(f, tmp_path):
    figure, ax = plt.subplots()
    artist = f.draw.plot("von_mises", ax=ax, alpha=0.5)
    assert ax.get_aspect() == 1.0 and ax.get_xlim()[0] <= -1 and ax.get_ylim()[1] >= 2
    assert len(figure.axes) == 2 and figure.axes[1].get_ylabel() == "von Mises stress"
    figure.savefig(tmp_path / "a.pdf")
    figure.savefig(tmp_path / "a.svg")
    figure.savefig(tmp_path / "a.png", bbox_inches="tight", dpi=37)
    # a logarithmic axis shows the right values as well
    ax.set_aspect("auto")
    ax.set_xlim(0.01, 1)
    ax.set_xscale("log")
    figure.savefig(tmp_path / "b.png")
    artist.set_clim(0, 2)
    figure.savefig(tmp_path / "c.png")
    ax.set_xlim(50, 60)
    figure.savefig(tmp_path / "d.png")
    plt.close(figure)
    with pytest.raises(ppum.QuantityError):
        f.draw.plot("nothing")
    with pytest.raises(ValueError):
        f.draw.plot("ux", clim="most")
    plt.close("all")
