"""The page of `ppum export` in Chromium, opened from disk, against `ppum render` and `ppum probe`.

    python3 tests/page/test_page.py [NAME …]

PPUM_PROGRAMS names the folder of the program, by default target/release; PPUM_SCREENSHOTS one for what was seen.
"""

import base64
import json
import math
import os
import pathlib
import shlex
import subprocess
import sys
import tempfile
import time

from browser import Browser, program

ROOT = pathlib.Path(__file__).parents[2]
PPUM = ROOT / os.environ.get("PPUM_PROGRAMS", "target/release") / "ppum"

#: Pixels that may differ in colour from those of the program: the evaluator of the page multiplies and adds in two
#: roundings, the processor in one, so that a value at the border of two shades may fall on its other side.
DIFFERING = 0.002
#: By how much, of 255.
LEVELS = 2
#: The relative difference of values for the same reason, of the size of a stress near a crack.
ROUNDING = 1e-9

HOSTILE = "</script></title><img src=x onerror=\"document.title='taken'\"> {{script}} &lt;b&gt;"


def run(*words):
    """What a command prints."""
    done = subprocess.run([PPUM, *map(str, words)], capture_output=True, text=True, cwd=FOLDER)
    assert done.returncode == 0, f"{words}: {done.stderr}"
    return done.stdout


def export(name, dataset, *options):
    """A page."""
    run("export", dataset, "-o", name, *options)
    return FOLDER / name


#: Counts the pixels of the plot whose colours differ from those of a PNG file, and says by how much, of 255. A browser
#: keeps colours multiplied by their opacity.
COMPARE = """async text => {
  const bytes = Uint8Array.from(atob(text), c => c.charCodeAt(0));
  const bitmap = await createImageBitmap(new Blob([bytes]), {colorSpaceConversion: "none"});
  const canvas = document.getElementById("image");
  const layer = new OffscreenCanvas(bitmap.width, bitmap.height).getContext("2d");
  layer.drawImage(bitmap, 0, 0);
  const pixels = context => context.getImageData(0, 0, canvas.width, canvas.height).data;
  const [found, expected] = [canvas.getContext("2d"), layer].map(pixels);
  let [differing, largest, colors] = [0, 0, new Set()];
  for (let k = 0; k < found.length; k += 4) {
    const distance = channel => Math.abs(found[k + channel] * found[k + 3] - expected[k + channel] * expected[k + 3]) / 255;
    const most = Math.max(...[0, 1, 2].map(distance), Math.abs(found[k + 3] - expected[k + 3]));
    if (most > 0) differing++;
    largest = Math.max(largest, most);
    colors.add(found[k] + 256 * (found[k + 1] + 256 * found[k + 2]));
  }
  const sizes = [canvas.width, canvas.height, bitmap.width, bitmap.height];
  return {sizes, share: differing / (canvas.width * canvas.height), largest, colors: colors.size};
}"""


def compared(page):
    """Asserts that the plot has the pixels of the command that the page shows beside it."""
    words = shlex.split(page.run("document.getElementById('command').value"))
    assert words[:2] == ["ppum", "render"], words
    words[words.index("-o") + 1] = "image.png"
    run(*words[1:])
    text = base64.b64encode((FOLDER / "image.png").read_bytes()).decode()
    found = page.run(f"({COMPARE})('{text}')")
    if "PPUM_VERBOSE" in os.environ:
        print(found)
    assert found["sizes"][:2] == found["sizes"][2:], found
    assert found["share"] <= DIFFERING and found["largest"] <= LEVELS, found
    assert found["colors"] > 50, "an image has many colours"


def opened(path, **options):
    page = BROWSER.page(path, **options)
    PAGES.append(page)
    return page


def seen(page, name):
    if "PPUM_SCREENSHOTS" in os.environ:
        page.screenshot(pathlib.Path(os.environ["PPUM_SCREENSHOTS"]) / f"{name}.png")


def middle(page):
    left, top, width, height = page.box()
    return left + width / 2, top + height / 2


def size(page):
    return page.run("page.view.width")


def test_pixels():
    page = opened(export("pixels.html", "plate.h5", "--isolines", "auto"))
    compared(page)
    seen(page, "pixels")
    for action in (
        "document.getElementById('quantity').value = 'uy'",
        "document.getElementById('colormap').value = 'coolwarm'",
        "document.getElementById('cells').checked = true",
    ):
        identifier = action.split("'")[1]
        page.run(f"{action}; document.getElementById('{identifier}').dispatchEvent(new Event('change'))")
        page.rest()
        compared(page)
    left, top, _, _ = page.box()
    x, y = middle(page)
    before = page.run("page.view.center")
    page.mouse("mouseMoved", x, y)
    page.mouse("mousePressed", x, y, button="left", buttons=1, clickCount=1)
    page.mouse("mouseMoved", x + 100, y + 40, button="left", buttons=1)
    page.mouse("mouseReleased", x + 100, y + 40, button="left", clickCount=1)
    page.rest()
    after = page.run("page.view.center")
    pixel = size(page) / page.box()[2]
    assert math.isclose(before[0] - after[0], 100 * pixel) and math.isclose(after[1] - before[1], 40 * pixel)
    compared(page)
    seen(page, "moved")


def probed(page, quantity):
    """What the page reads, beside what `ppum probe` prints of the same point."""
    hover = page.run("page.hover")
    (ax, ay), (dx, dy) = hover["anchor"], hover["offset"]
    words = ["probe", "plate.h5", f"--at={ax!r},{ay!r}", "-q", quantity, "--json"]
    points = json.loads(run(*words, f"--offset={dx!r},{dy!r}"))["points"]
    return hover, [(point["side"], point["values"][quantity]) for point in points]


def test_values_under_the_pointer():
    page = opened(export("values.html", "plate.h5"))
    left, top, width, height = page.box()
    for u, v in [(0.31, 0.22), (0.52, 0.71), (0.61, 0.43)]:
        page.mouse("mouseMoved", left + u * width, top + v * height)
        page.rest()
        hover, [(side, value)] = probed(page, "von-mises")
        assert side is None and len(hover["sides"]) == 1
        assert math.isclose(float(hover["sides"][0]["exact"]), value, rel_tol=ROUNDING)
        assert hover["sides"][0]["value"] in page.text("reading") and "gradient" in page.text("reading")
    # beside the crack, which runs from (-0.5, 0) to (0.5, 0)
    x, y = middle(page)
    page.mouse("mouseMoved", x + 20, y + 3)
    page.rest()
    hover, both = probed(page, "von-mises")
    assert [side for side, _ in both] == ["above", "below"] == [side["name"] for side in hover["sides"]]
    for (_, value), side in zip(both, hover["sides"]):
        assert math.isclose(float(side["exact"]), value, rel_tol=ROUNDING)
    assert "above" in page.text("reading") and "jump" in page.text("reading")
    seen(page, "values")
    page.mouse("mouseMoved", left + 2, top + 2)
    page.rest()
    assert "outside the domain" in page.text("reading")


def test_the_tip_a_million_million_times_enlarged():
    page = opened(export("deep.html", "plate.h5", "--scale", "log"))
    whole = size(page)
    x, y = page.run(
        """(() => {
          const {left, top, width, height} = document.getElementById("image").getBoundingClientRect();
          const {center, width: seen} = page.view;
          return [left + width / 2 + ((0.5 - center[0]) / seen) * width, top + height / 2];
        })()"""
    )
    page.mouse("mouseMoved", x + 2, y - 2)
    page.rest()
    assert page.run("page.hover.tip") == 1 and "∞" in page.text("reading")
    while size(page) > 2e-12:
        before = size(page)
        page.mouse("mouseWheel", x + 2, y - 2, deltaX=0, deltaY=-600)
        page.until(f"page.view.width < {before!r}")
    page.mouse("mouseWheel", x + 2, y - 2, deltaX=0, deltaY=-600)
    page.mouse("mouseWheel", x + 2, y - 2, deltaX=0, deltaY=-600)
    page.rest()
    assert size(page) == 2e-12 < whole / 1e12, "the deepest view"
    assert page.run("page.hover.tip") == 1, "the tip has stayed under the pointer"
    compared(page)
    seen(page, "deep")
    page.mouse("mouseMoved", x + 60, y - 60)
    page.rest()
    assert page.text("reading").startswith("tip 1 + (")
    hover, [(_, value)] = probed(page, "von-mises")
    assert math.isclose(float(hover["sides"][0]["exact"]), value, rel_tol=1e-6)


def focused(page):
    return page.run("document.activeElement?.id")


def test_keys_alone():
    page = opened(export("keys.html", "plate.h5"))
    for _ in range(20):
        page.key("Tab")
        if focused(page) == "image":
            break
    assert focused(page) == "image"
    whole = size(page)
    page.key("+")
    page.rest()
    assert math.isclose(size(page), whole / 1.5)
    center = page.run("page.view.center")
    page.key("ArrowRight")
    page.rest()
    assert page.run("page.view.center")[0] > center[0]
    page.key("t")
    page.rest()
    assert page.run("page.view.center") == [-0.5, 0] and size(page) < 0.2 * whole
    page.key("ArrowUp", shift=True)
    page.rest()
    assert "von-mises = " in page.text("reading") and not page.run("document.getElementById('mark').hidden")
    page.key("0")
    page.rest()
    assert size(page) == whole
    # each control is reached, has a name, and says so to those who do not see it
    names = []
    for _ in range(40):
        page.key("Tab")
        if focused(page) in ("", None, "theme"):
            break
        names.append(focused(page))
    for identifier in ("quantity", "formula", "colormap", "color-scale", "range", "cracks", "isolines", "whole", "tip"):
        assert identifier in names, f"{identifier} among {names}"
    nodes = page.ask("Accessibility.getFullAXTree")["nodes"]
    roles = ("button", "combobox", "textbox", "checkbox", "slider")
    for node in nodes:
        if node.get("role", {}).get("value") in roles and not node.get("ignored"):
            assert node["name"]["value"].strip(), node
    page.run("document.getElementById('formula').focus()")
    for letter in "sxx+syy":
        page.key(letter)
    page.key("Enter")
    page.rest()
    assert page.run("page.scene.quantity") == "sxx+syy" and page.text("bar-label").startswith("sxx+syy")
    compared(page)


def test_touch():
    page = opened(export("touch.html", "plate.h5"), size=(420, 800), density=2, touch=True)
    x, y = middle(page)
    whole = size(page)
    page.touch("touchStart", (x - 40, y), (x + 40, y))
    for k in range(1, 5):
        page.touch("touchMove", (x - 40 - 10 * k, y), (x + 40 + 10 * k, y))
    page.touch("touchEnd")
    page.rest()
    assert math.isclose(size(page), whole / 2, rel_tol=1e-6)
    center = page.run("page.view.center")
    page.touch("touchStart", (x, y - 60))
    page.touch("touchMove", (x + 30, y - 60))
    page.touch("touchEnd")
    page.rest()
    assert page.run("page.view.center")[0] < center[0]
    page.touch("touchStart", (x, y - 60))
    page.touch("touchEnd")
    page.rest()
    assert "von-mises = " in page.text("reading"), "a tap reads"
    columns = page.pixels()[0]
    assert columns == round(2 * page.box()[2]), "as many pixels as the screen has"
    assert page.run("document.documentElement.scrollWidth <= innerWidth"), "nothing lies beside the screen"
    small = """[...document.querySelectorAll("button, select, input[type=text], input[type=range], label.check, summary")]
      .map(element => [element.id || element.textContent.trim(), element.getBoundingClientRect()])
      .filter(([, {width, height}]) => height > 0 && (width < 40 || height < 40)).map(([name]) => name)"""
    assert page.run(small) == [], "fingers find all controls"
    compared(page)
    seen(page, "touch")


def chosen(page, identifier, value):
    """Sets a control, a check box by True or False."""
    name = "checked" if isinstance(value, bool) else "value"
    page.run(
        f"(control => {{ control.{name} = {json.dumps(value)}; control.dispatchEvent(new Event('change')); }})"
        f"(document.getElementById({json.dumps(identifier)}))"
    )
    page.rest()


def test_what_is_no_range_is_said():
    page = opened(export("range.html", "plate.h5"))
    before = page.pixels()[2]
    chosen(page, "from", "1e9")
    chosen(page, "to", "2")
    assert "less than" in page.text("range-error")
    assert page.run("page.scene.colors.range") == "auto"
    assert page.run("['from', 'to', 'range'].map(id => document.getElementById(id).value)") == ["1e9", "2", "fixed"]
    assert page.pixels()[2] == before
    chosen(page, "to", "")
    assert "two numbers" in page.text("range-error")
    chosen(page, "to", "2")
    chosen(page, "from", "1")
    assert page.run("page.scene.colors.range") == "1,2" and page.run("document.getElementById('range-error').hidden")
    compared(page)
    chosen(page, "from", "4")
    chosen(page, "range", "auto")
    assert page.run("page.scene.colors.range") == "auto" and page.run("document.getElementById('range-error').hidden")
    assert page.pixels()[2] == before


def test_what_cannot_be_drawn_is_said():
    page = opened(export("nothing.html", "plate.h5"))
    for formula in ("1/0", "log(ux)"):
        chosen(page, "formula", formula)
        warned = subprocess.run(
            [PPUM, "render", "plate.h5", "-o", "nothing.png", "-q", formula], capture_output=True, text=True, cwd=FOLDER
        )
        words = warned.stderr.split("warning: ")[1].split(" at ")[0].split(" in ")[0].strip()
        assert words in page.text("message"), (words, page.text("message"))
        seen(page, f"notice-{formula[0]}")
    chosen(page, "formula", "ux")
    assert not page.text("message")


def test_overlays_of_the_export_can_be_switched_off():
    page = opened(export("overlays.html", "plate.h5", "--overlay", "boxes,rings", "--arrows", "--crosses=50"))
    compared(page)
    seen(page, "overlays")
    for name in ("boxes", "rings", "arrows", "crosses"):
        for value in (False, True, False):
            before = page.pixels()[2]
            chosen(page, name, value)
            assert page.pixels()[2] != before, name
            compared(page)
    assert page.run("page.scene.overlays.shown") == ["cracks"]
    plain = opened(export("plain.html", "plate.h5"))
    assert not plain.run("['boxes', 'arrows'].some(id => document.getElementById(id))")


def test_hostile_texts_are_texts():
    problem = (FOLDER / "plate.toml").read_text()
    title = next(line for line in problem.splitlines() if line.startswith("title"))
    (FOLDER / "hostile.toml").write_text(problem.replace(title, f"title = {json.dumps(HOSTILE)}"))
    run("solve", "hostile.toml")
    page = opened(export("hostile.html", "hostile.h5"))
    assert page.run("document.getElementById('title').textContent") == HOSTILE
    assert page.run("document.title") == HOSTILE
    assert page.run("document.images.length") == 0
    page.run("document.getElementById('formula').value = '<img src=x onerror=alert(1)>'")
    page.run("document.getElementById('formula').dispatchEvent(new Event('change'))")
    page.rest()
    assert page.run("document.images.length") == 0 and page.text("message")
    page.run("document.getElementById('quantity').value = 'ux'")
    page.run("document.getElementById('quantity').dispatchEvent(new Event('change'))")
    page.rest()
    assert not page.text("message"), "a good quantity takes the message away"


def test_series():
    problem = (ROOT / "examples" / "edge-shear-growth.toml").read_text()
    (FOLDER / "growth.toml").write_text(problem)
    run("solve", "growth.toml")
    count = len(json.loads(run("info", "growth.h5", "--json", "--steps"))["series"])
    page = opened(export("growth.html", "growth.h5"))
    assert page.run("page.scene.subject.step") == count - 1 and count > 3
    compared(page)
    tip = page.run("document.getElementById('tip').options.length")
    last = page.pixels()[2]
    page.run("(step => { step.value = 0; step.dispatchEvent(new Event('input')); })(document.getElementById('step'))")
    page.until("page.scene.subject.step === 0")
    page.rest()
    assert page.pixels()[2] != last and tip >= 2
    compared(page)
    page.run("document.getElementById('play').click()")
    page.until("page.scene.subject.step >= 2")
    page.run("document.getElementById('play').click()")
    page.rest()
    compared(page)
    seen(page, "series")


SPLINE = """title = "Crack along a spline"
[domain]
min = [-1.0, -1.0]
max = [1.0, 1.0]
[material]
young = 1.0
poisson = 0.3
state = "plane-strain"
[[crack]]
spline = [[-0.6, -0.1], [-0.3, 0.12], [0.0, -0.05], [0.3, 0.1], [0.6, -0.12]]
[[boundary]]
on = "bottom"
traction = [0.0, -1.0]
[[boundary]]
on = "top"
traction = [0.0, 1.0]
[discretization]
level = 4
"""


def solved(name, text=None):
    """The dataset of an example, or of the text of a problem."""
    (FOLDER / f"{name}.toml").write_text(text or (ROOT / "examples" / f"{name}.toml").read_text())
    run("solve", f"{name}.toml")
    return f"{name}.h5"


def drawn(name, dataset, center, width, *quantities):
    """A page whose pixels were compared: a place of the given width, and quantities of the whole body."""
    page = opened(export(f"{name}.html", dataset))
    compared(page)
    seen(page, name)
    page.run(f"page.move({{center: {json.dumps(center)}, width: {width}}})")
    page.rest()
    compared(page)
    seen(page, f"{name}-near")
    page.run("document.getElementById('whole').click()")
    for quantity in quantities:
        chosen(page, "quantity", quantity)
        assert page.run("page.scene.quantity") == quantity
        compared(page)
    return page


def test_anisotropic_bodies():
    drawn("anisotropic", solved("orthotropic-plate"), [0.5, 0], 1e-9, "s11", "tsai-hill")


def test_bodies_of_revolution():
    names = ["von-mises", "shoop", "sxx", "energy"]
    page = drawn("revolution", solved("penny-crack"), [0.5, 0], 1e-9, *names)
    # the axis, where u_x / x is a limit
    page.run("page.move({center: [0, 1], width: 1e-6})")
    page.rest()
    compared(page)


def test_cracks_along_arcs():
    page = drawn("arc", solved("arc-crack"), [math.sin(0.75), math.cos(0.75)], 1e-9, "uy")
    page.run("page.move({center: [0, 1], width: 0.1})")
    page.rest()
    compared(page)
    x, y = middle(page)
    page.mouse("mouseMoved", x, y + 2)
    page.rest()
    assert [side["name"] for side in page.run("page.hover.sides")] == ["above", "below"]


def test_cracks_along_splines():
    page = drawn("spline", solved("spline", SPLINE), [0.6, -0.12], 1e-9, "uy")
    page.run("page.move({center: [0, -0.05], width: 0.1})")
    page.rest()
    compared(page)


def test_rims_of_arcs():
    drawn("ellipse", solved("elliptic-hole"), [0.1, 0], 0.01, "uy")


#: Calls `onRows` with the columns of an image whose rows have been asked for.
ROWS_ASKED = """(post => {
  Worker.prototype.postMessage = function (message, ...more) {
    post.call(this, message, ...more);
    if (message.task === "rows") globalThis.onRows?.(message.rows.frame.view.pixels[0]);
  };
})(Worker.prototype.postMessage)"""

#: Moves on while the image of a view is evaluated, and gives all messages until the page is at rest.
LEAVE = """(async (width, next) => {
  const said = [];
  const element = document.getElementById("message");
  const observer = new MutationObserver(() => said.push(element.textContent));
  observer.observe(element, {childList: true});
  const {center} = page.view;
  globalThis.onRows = columns => {
    if (columns < document.getElementById("image").width) return;
    globalThis.onRows = null;
    page.move({center, width: next});
  };
  page.move({center, width});
  do await new Promise(done => setTimeout(done, 10)); while (!page.isAtRest);
  observer.disconnect();
  return [said.filter(text => text), globalThis.onRows === null];
})"""


def test_a_view_that_is_left_leaves_no_values():
    page = opened(export("left.html", "plate.h5"), before=ROWS_ASKED)
    whole = size(page)
    # first after a coarse image of the same view, then without one
    for width, following in [(0.5, 0.5), (0.4, 0.5), (0.3, 0.3)]:
        assert page.run(f"{LEAVE}({width * whole}, {following * whole})") == [[], True]
        compared(page)


def test_nothing_is_fetched():
    page = opened(export("offline.html", "plate.h5"))
    page.ask("Network.emulateNetworkConditions", offline=True, latency=0, downloadThroughput=0, uploadThroughput=0)
    page.run("page.move({center: [0.1, 0.1], width: 0.3})")
    page.rest()
    requests = [event["request"]["url"] for event in page.events("Network.requestWillBeSent")]
    assert requests, "the page itself"
    assert all(url.startswith(("file:", "blob:")) for url in requests), requests
    # what its policy allows, whatever a script asks for
    refused = "fetch('https://example.org').then(() => 'fetched', () => 'refused')"
    assert page.run(refused) == "refused"
    PAGES.remove(page)  # the browser logs that


def test_light_and_dark():
    path = export("theme.html", "plate.h5")
    light, dark = opened(path), opened(path, dark=True)
    ground = "getComputedStyle(document.body).backgroundColor"
    assert light.run(ground) == "rgb(255, 255, 255)" != dark.run(ground)
    assert light.pixels()[2] == dark.pixels()[2], "values have the same colours"
    seen(dark, "dark")
    for _ in range(2):
        before = dark.run(ground)
        dark.run("document.getElementById('theme').click()")
        assert dark.run(ground) != before
    seen(light, "light")


def test_without_workers():
    page = opened(export("alone.html", "plate.h5"), before="delete globalThis.Worker;")
    assert page.run("page.workers") == 1
    compared(page)


def test_rough_before_whole():
    """A slow evaluator shows a coarse image first; a view that is left is not completed."""
    page = opened(export("slow.html", "plate.h5"))
    for k in range(20):
        page.run(f"page.move({{center: [{0.01 * k}, 0], width: {1.5 - 0.05 * k}}})")
    page.rest()
    compared(page)


TESTS = [test for name, test in list(globals().items()) if name.startswith("test_")]


def main(names):
    for test in TESTS:
        if names and test.__name__ not in names:
            continue
        begin = time.monotonic()
        PAGES.clear()
        test()
        for page in PAGES:
            errors = page.errors()
            assert not errors, errors
            assert not page.text("message"), page.text("message")
        print(f"ok  {test.__name__}  {time.monotonic() - begin:.1f} s", flush=True)


if __name__ == "__main__":
    if program() is None:
        print("SKIPPED 1 (so far): pages in a browser: chromium is not installed")
        print("ok  pages in a browser")
        sys.exit(0)
    PAGES = []
    with tempfile.TemporaryDirectory(prefix="ppum-") as folder, Browser() as BROWSER:
        FOLDER = pathlib.Path(folder)
        (FOLDER / "plate.toml").write_text((ROOT / "examples" / "centre-crack.toml").read_text())
        run("solve", "plate.toml")
        main(sys.argv[1:])
