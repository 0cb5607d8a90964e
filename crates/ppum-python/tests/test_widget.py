"""Views in notebooks, their Python half: messages of a browser in, frames out, without one."""

import io
import math
import re

import numpy as np
import ppum
import pytest

pytest.importorskip("anywidget")
pytest.importorskip("matplotlib")
import matplotlib.image
import traitlets

SIZE = (160, 120)


class Browser:
    """The other end of a view's comm."""

    def __init__(self, view):
        self.view, self.sent = view, []
        view.comm.send = lambda data=None, metadata=None, buffers=None: self.sent.append((data, buffers))

    def ask(self, size=list(SIZE), **content):
        """The answer to a message, of which there is one."""
        self.sent.clear()
        message = {"from": "me", "size": size, **content}
        self.view._handle_msg({"content": {"data": {"method": "custom", "content": message}}, "buffers": []})
        (answer,) = [(d["content"], b) for d, b in self.sent if d["method"] == "custom"]
        assert answer[0]["to"] == "me"
        # nothing else is said, but by views that are linked
        assert len(self.sent) == 1
        return answer


def pixels(buffers):
    image = matplotlib.image.imread(io.BytesIO(buffers[0]))
    rgba = np.full((*image.shape[:2], 4), 255, np.uint8)
    rgba[..., : image.shape[2]] = np.round(255 * image)
    return rgba


def same(buffers, expected):
    found = pixels(buffers)
    assert found.shape == expected.shape
    assert np.array_equal(found[..., 3], expected[..., 3])
    return np.array_equal(found[expected[..., 3] > 0], expected[expected[..., 3] > 0])


@pytest.fixture
def view(ds):
    return ds.view("von_mises")


@pytest.fixture
def browser(view):
    return Browser(view)


def test_frames_are_pictures_of_the_field(view, browser, f):
    content, buffers = browser.ask()
    assert content["kind"] == "frame" and not view.error
    assert same(buffers, f.draw.image("von_mises", center=view.center, width=view.width, size=SIZE, overlays=["cracks"]))
    cells = f.draw.image("ux", center=(0.1, 0.2), width=0.3, size=(64, 48), norm="symlog", cmap="vik", clim=(-2, 3), overlays=["cracks"])
    view.center, view.width, view.cmap = (0.1, 0.2), 0.3, "vik"
    content, buffers = browser.ask(size=(64, 48), set={"quantity": "ux", "norm": "symlog", "clim": [-2, 3]})
    assert same(buffers, cells) and content["state"]["quantity"] == "ux"
    assert content["bar"]["range"] == (-2.0, 3.0) and len(buffers[1]) == 3 * 256
    at, labels = zip(*content["bar"]["ticks"])
    assert list(at) == sorted(at) and "0" in labels


def test_a_move_keeps_the_point_under_the_mouse(view, browser):
    mouse = np.array([31.0, 77.0])

    def under():
        side = view.width / SIZE[0]
        return np.array(view.center) + np.array([mouse[0] - 80, 60 - mouse[1]]) * side

    before = under()
    for k in (2.0, 3.0, 0.7):
        browser.ask(move=[k, *(mouse * (1 - k))])
        assert np.allclose(under(), before, atol=1e-15)
    browser.ask(move=[1, 10, -20])
    mouse += (10, -20)
    assert np.allclose(under(), before, atol=1e-15)


def test_no_digit_is_lost(ds, view, browser, f):
    """Down about a point by the wheel and up again: the views are where exact arithmetic has them."""
    view.center, view.width = ds.tips[1].xy, 2.0
    mouse = np.array([100.0, 40.0])
    start = np.array(view.center) + np.array([20.0, 20.0]) * view.width / SIZE[0]
    for _ in range(100):
        browser.ask(move=[2.0**0.4, *(mouse * (1 - 2.0**0.4))], size=SIZE, moving=True)
    side = view.width / SIZE[0]
    assert view.width == pytest.approx(2.0 * 2.0**-40, rel=1e-12)
    under = np.array(view.center) + view._rest + np.array([20.0, 20.0]) * side
    assert np.abs(under - start).max() < 1e-15
    # pans far smaller than what double precision has beside the center add up
    view.center, view.width = (1.0, 0.5), 1e-13
    for _ in range(1000):
        browser.ask(probe=[0, 0])
        view._move(1.0, 0.01, 0.0, SIZE)
    moved = (view.center[0] - 1.0) + view._rest[0]
    assert moved == pytest.approx(-10 * 1e-13 / SIZE[0], rel=1e-9)


def test_depth_has_an_end(ds, view, browser):
    view.go_to_tip(1)
    for _ in range(60):
        content, _ = browser.ask(size=(16, 12), move=[4.0, 8 * (1 - 4.0), 6 * (1 - 4.0)])
        assert content["kind"] == "frame"
    assert 1e-16 < view.width < 1e-14
    view.center = (0.0, 0.0)
    for _ in range(600):
        view._move(4.0, 8 * (1 - 4.0), 6 * (1 - 4.0), (16, 12))
    assert view.width == pytest.approx(1e-300)
    assert browser.ask(size=(16, 12))[0]["kind"] == "frame"
    for _ in range(700):
        view._move(0.25, 6.0, 4.5, (16, 12))
    assert view.width < 1e8 and browser.ask()[0]["kind"] == "frame"
    view.center, view.width = (0.3, 0.3), 1e-300
    content, _ = browser.ask()
    assert content["kind"] == "error" and "widen it" in content["error"]
    browser.ask(home=True)
    assert view.error == "" and view.center == (0.0, 0.0)


def test_colours_rest_while_views_move(view, browser, f):
    first = browser.ask()[0]["bar"]["range"]
    moving, _ = browser.ask(move=[4.0, -60, -300], moving=True)
    assert moving["bar"]["range"] == first
    at = dict(center=view.center, width=view.width, size=SIZE, overlays=["cracks"])
    rested, buffers = browser.ask()
    assert rested["bar"]["range"] != first and same(buffers, f.draw.image("von_mises", **at))
    other, _ = browser.ask(set={"quantity": "ux"}, moving=True)
    assert other["bar"]["range"] not in (first, rested["bar"]["range"])


@pytest.mark.parametrize("quantity", ["nothing", "sxx +", "", "1/0*", "ux" * 5000])
def test_mistakes_are_told(view, browser, quantity):
    content, buffers = browser.ask(set={"quantity": quantity})
    if quantity == "":  # that which is drawn where nothing is said
        return
    assert content["kind"] == "error" and content["error"] == view.error != ""
    assert browser.ask(set={"quantity": "uy"})[0]["kind"] == "frame" and view.error == ""


@pytest.mark.parametrize(
    "message",
    [
        {"size": [0, 5]},
        {"size": [1e6, 1e6]},
        {"size": "many"},
        {"size": None},
        {"move": [0, 1, 1]},
        {"move": [math.nan, 1, 1]},
        {"move": [1, math.inf, 1]},
        {"move": ["a", 1, 1]},
        {"move": [1]},
        {"tip": 17},
        {"tip": "x"},
        {"set": 3},
        {"set": {"clim": [1, 0]}},
        {"set": {"clim": [None, None]}},
        {"set": {"cmap": "no"}},
        {"set": {"norm": "no"}},
        {"set": {"step": 5}},
        {"set": {"deformed": "a lot"}},
        {"probe": "here"},
        {"probe": [1, 2], "size": [0, 0]},
    ],
)
def test_bad_messages_are_answered(view, browser, message):
    content, _ = browser.ask(**message)
    assert content["kind"] == "error" and content["error"]
    view.cmap, view.norm, view.deformed = "auto", "linear", None
    assert browser.ask()[0]["kind"] == "frame"


def test_what_is_no_message_is_not_answered(view, browser):
    for content in (None, 3, "a", [], {}):
        view._handle_msg({"content": {"data": {"method": "custom", "content": content}}, "buffers": []})
    assert browser.sent == []


def test_traits_refuse_what_cannot_be(view):
    before = view.center, view.width
    for name, value in [
        ("center", (math.nan, 0)),
        ("center", (0, math.inf)),
        ("center", 3),
        ("width", 0),
        ("width", -1),
        ("width", math.nan),
        ("step", 1),
        ("norm", "cubic"),
        ("clim", "most"),
        ("clim", (1, 1)),
        ("clim", (0, math.nan)),
    ]:
        with pytest.raises(traitlets.TraitError):
            setattr(view, name, value)
    assert (view.center, view.width) == before


def test_the_mouse_reads_both_faces(ds, view, browser, f):
    view.center, view.width = (0.1, 0.1), 1e-6
    side = view.width / SIZE[0]
    text = browser.ask(probe=[80, 60 + 3])[0]["text"]
    assert "above" in text and "below" in text
    # the mouse is 3 pixels below a point of the crack, whose nearest point is half as far to the lower left
    at = 0.1 - 1.5 * side
    above, below = f.at(at, at, side="both")["von_mises"]
    found = [float(part.split()[-2]) for part in text.split(": ")[1].replace(" the crack", "").split(",")]
    assert found == pytest.approx([above, below], rel=1e-6)
    view.width = 1.0
    text = browser.ask(probe=[140.5, 20.25])[0]["text"]
    x, y = 0.1 + 60.5 / 160, 0.1 + 39.75 / 160
    assert float(text.split(": ")[1]) == pytest.approx(float(f.at(x, y).von_mises), rel=1e-8)
    assert "nan" in browser.ask(probe=[1e6, 0])[0]["text"]


def test_views_are_linked(ds, f):
    left, right = ds.view("ux"), f.view("uy")
    links = ppum.link(left, right)
    Browser(left).ask(move=[2.0, 3.0, -7.0])
    assert (left.center, left.width) == (right.center, right.width) and right.quantity == "uy"
    version = right._version
    links.close()
    left.width = 0.125
    assert right.width != 0.125 and right._version == version


def test_what_python_changes_is_told(view, browser):
    browser.sent.clear()
    view.quantity, view.width = "ux", 0.5
    told = [d["content"] for d, _ in browser.sent if d["method"] == "custom"]
    assert [t["version"] for t in told] == [view._version - 1, view._version]
    assert browser.ask()[0]["version"] == view._version


def test_steps():
    grows = ppum.solve(
        ppum.Problem(domain=((-1, -1), (1, 1)), material=ppum.Elastic(1.0, 0.3))
        .crack((-1, 0), (-0.5, 0))
        .boundary("bottom", traction=(0, -1))
        .boundary("top", traction=(0, 1))
        .discretization(level=3)
        .section("growth", steps=2, increment=0.1)
    )
    view = grows.view("uy", step=0)
    browser = Browser(view)
    for step in range(len(grows.steps)):
        content, buffers = browser.ask(set={"step": step})
        assert same(buffers, grows.steps[step].field.draw.image("uy", center=view.center, width=view.width, size=SIZE, overlays=["cracks"]))
    assert view._offers["steps"] == len(grows.steps) > 1
    part = grows.field.part("jump").view("uy")
    part.step = 0
    expected = grows.steps[0].field.part("jump").draw.image("uy", center=part.center, width=part.width, size=SIZE, overlays=["cracks"])
    assert same(Browser(part).ask()[1], expected)


def test_a_saved_notebook_has_a_picture(view):
    data, _ = view._repr_mimebundle_()
    assert "application/vnd.jupyter.widget-view+json" in data and data["image/png"].startswith("iVBOR")
    view.quantity = "nothing"
    data, _ = view._repr_mimebundle_()
    assert "image/png" not in data and view.error


def test_two_views_and_closed_ones(ds, view, browser):
    other = Browser(ds.view("ux"))
    browser.ask(move=[2.0, 0.0, 0.0])
    assert other.view.width != view.width and other.ask()[0]["kind"] == "frame"
    view.close()
    view.width = 0.5
    view._hear(view, {"from": "me", "size": SIZE}, [])
    assert other.ask()[0]["kind"] == "frame"


def test_potentials_and_cells(potential, holed):
    for field, quantity in ((potential.field, None), (holed.field, "level"), (holed.field, "safety")):
        browser = Browser(field.view(quantity))
        content, buffers = browser.ask()
        assert content["kind"] == "frame" and content["bar"]["symbol"]
    assert browser.ask(set={"deformed": "auto"})[0]["kind"] == "frame"
    assert "the deformed plate is not here" in browser.ask(probe=[3, 4])[0]["text"]


def test_values_of_cells_are_told_too(holed):
    """On cracks as well: they have no sides."""
    view = holed.field.view("level")
    browser = Browser(view)
    (x, y), columns = holed.field.step.cracks[0].points[1], SIZE[0]
    browser.ask(set={}), view.set_trait("width", 1.0), view.set_trait("center", (x, y))
    for pixel in ([columns / 2, SIZE[1] / 2], [10, 20]):
        text = browser.ask(probe=pixel)[0]["text"]
        at = [float(part.split(" = ")[1]) for part in text.split(": ")[0].split(", ")]
        assert float(text.split(": ")[1]) == holed.field.draw.render("level", center=at, width=1e-9, size=(1, 1))[0, 0]


@pytest.mark.parametrize("factor", [-2.0, 0.0, 0.25, "auto"])
def test_a_deformed_view_tells_the_values_of_points_of_the_plate(f, factor):
    """A point is moved by its displacement, and what lies there is that point, on its side of the crack."""
    view = f.view("von_mises", deformed=factor)
    browser = Browser(view)
    browser.ask()
    times = factor if factor != "auto" else told_factor(f)
    # in the plate, and beside the faces of the crack
    for x, y in [(0.6, 1.1), (-0.7, -0.4), (0.1, 0.1 + 1e-6), (0.1, 0.1 - 1e-6)]:
        moved = np.array([x, y]) + times * f.evaluate(x, y, ["ux", "uy"])
        view.center, view.width = tuple(moved), 1e-7 * SIZE[0]
        text = browser.ask(probe=[SIZE[0] / 2, SIZE[1] / 2])[0]["text"]
        value, was = text.split(": ")[1].split(", moved from ")
        found = [float(part.split(" = ")[1]) for part in was.split(", over")[0].split(", ")[:2]]
        assert found == pytest.approx((x, y), abs=2e-7), text
        assert float(value) == pytest.approx(float(f.at(*found).von_mises), rel=1e-6)
    view.center = (1e3, 0.0)
    assert browser.ask(probe=[0, 0])[0]["text"].endswith("the deformed plate is not here")


def told_factor(f):
    """What `auto` is, of a figure's title."""
    title = re.search(r"deformed ×([0-9.e-]+)", f.draw.figure("ux", deformed="auto").svg())
    return float(title[1])


def test_the_remedy_is_named(f, monkeypatch):
    monkeypatch.setitem(__import__("sys").modules, "anywidget", None)
    monkeypatch.delitem(__import__("sys").modules, "ppum._widget")
    monkeypatch.delattr(ppum, "_widget")
    with pytest.raises(ImportError, match="need anywidget: pip install anywidget"):
        f.view()
