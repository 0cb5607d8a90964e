"""Chromium without a screen, by the pipe of its debugging protocol: pages, input, pixels."""

import base64
import fcntl
import json
import os
import shutil
import subprocess
import tempfile
import time

#: Keeps a browser to itself, and to what machines without a graphics card have.
ARGUMENTS = [
    "--headless",
    "--no-sandbox",
    "--disable-gpu",
    "--disable-quic",
    "--no-first-run",
    "--disable-background-networking",
    "--disable-component-update",
    "--disable-sync",
    "--remote-debugging-pipe",
]

#: The longest wait for a state in seconds. Only a test that hangs waits so long.
TIME_LIMIT = 120


def program():
    """The path of Chromium, or None."""
    names = ("chromium", "chromium-browser", "google-chrome")
    return next((path for path in map(shutil.which, names) if path), None)


def _pipe():
    """A pipe whose ends do not have the numbers 3 and 4, which the protocol takes."""
    ends = os.pipe()
    high = [fcntl.fcntl(end, fcntl.F_DUPFD, 10) for end in ends]
    for end in ends:
        os.close(end)
    return high


class Browser:
    """A browser with a folder of its own."""

    def __init__(self):
        self.folder = tempfile.TemporaryDirectory(ignore_cleanup_errors=True)
        theirs_in, ours_out = _pipe()
        ours_in, theirs_out = _pipe()
        command = [program(), *ARGUMENTS, f"--user-data-dir={self.folder.name}", "about:blank"]
        self.process = subprocess.Popen(
            ["bash", "-c", f'exec "$@" 3<&{theirs_in} 4>&{theirs_out}', "bash", *command],
            pass_fds=(theirs_in, theirs_out),
            stdout=subprocess.DEVNULL,
            stderr=subprocess.DEVNULL,
        )
        for end in (theirs_in, theirs_out):
            os.close(end)
        self.writer, self.reader = os.fdopen(ours_out, "wb"), os.fdopen(ours_in, "rb")
        self.count, self.rest, self.events = 0, b"", []

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self.process.kill()
        self.process.wait()
        self.writer.close()
        self.reader.close()
        self.folder.cleanup()

    def ask(self, method, session=None, **parameters):
        """The answer to a command; events that come before it are kept."""
        self.count += 1
        message = {"id": self.count, "method": method, "params": parameters}
        if session:
            message["sessionId"] = session
        self.writer.write(json.dumps(message).encode() + b"\0")
        self.writer.flush()
        while True:
            answer = self._message()
            if answer.get("id") == self.count:
                if "error" in answer:
                    raise RuntimeError(f"{method}: {answer['error']}")
                return answer["result"]
            self.events.append(answer)

    def _message(self):
        while b"\0" not in self.rest:
            more = os.read(self.reader.fileno(), 1 << 20)
            if not more:
                raise RuntimeError("the browser has ended")
            self.rest += more
        message, self.rest = self.rest.split(b"\0", 1)
        return json.loads(message)

    def page(self, path, size=(1000, 720), density=1, touch=False, dark=False, before=""):
        """The page of a file, once it has drawn its first image."""
        return Page(self, path, size, density, touch, dark, before)


class Page:
    """A page that was opened from disk."""

    def __init__(self, browser, path, size, density, touch, dark, before):
        self.browser = browser
        target = browser.ask("Target.createTarget", url="about:blank")["targetId"]
        self.session = browser.ask("Target.attachToTarget", targetId=target, flatten=True)["sessionId"]
        for domain in ("Page", "Runtime", "Log", "Network"):
            self.ask(f"{domain}.enable")
        width, height = size
        metrics = {"width": width, "height": height, "deviceScaleFactor": density, "mobile": touch}
        self.ask("Emulation.setDeviceMetricsOverride", **metrics)
        if touch:
            self.ask("Emulation.setTouchEmulationEnabled", enabled=True, maxTouchPoints=5)
        scheme = {"name": "prefers-color-scheme", "value": "dark" if dark else "light"}
        self.ask("Emulation.setEmulatedMedia", features=[scheme])
        if before:
            self.ask("Page.addScriptToEvaluateOnNewDocument", source=before)
        self.ask("Page.navigate", url=path.resolve().as_uri())
        self.until("globalThis.page !== undefined")
        self.rest()

    def ask(self, method, **parameters):
        """The answer to a command of this page."""
        return self.browser.ask(method, self.session, **parameters)

    def run(self, script):
        """The value of an expression in the page, awaited if it is a promise."""
        found = self.ask("Runtime.evaluate", expression=script, awaitPromise=True, returnByValue=True)
        if "exceptionDetails" in found:
            raise RuntimeError(found["exceptionDetails"]["exception"]["description"])
        return found["result"].get("value")

    def until(self, condition):
        """Waits for a condition."""
        end = time.monotonic() + TIME_LIMIT
        while not self.run(f"Boolean({condition})"):
            assert time.monotonic() < end, f"waited for {condition}: {self.run('document.body.innerText')}"
            time.sleep(0.02)

    def rest(self):
        """Waits until the exact image of the view is shown and nothing moves any more."""
        self.until("globalThis.page.isAtRest")

    def text(self, identifier):
        """The text of an element, with one blank in place of several."""
        return " ".join(self.run(f"document.getElementById('{identifier}').textContent").split())

    def box(self, identifier="image"):
        """Left, top, width and height of an element in CSS pixels."""
        script = "(({left, top, width, height}) => [left, top, width, height])"
        return self.run(f"{script}(document.getElementById('{identifier}').getBoundingClientRect())")

    def pixels(self):
        """Columns, rows and RGBA of the plot."""
        columns, rows, text = self.run(
            """(() => {
              const canvas = document.getElementById("image");
              const {data} = canvas.getContext("2d").getImageData(0, 0, canvas.width, canvas.height);
              let text = "";
              for (let k = 0; k < data.length; k += 32768) text += String.fromCharCode(...data.subarray(k, k + 32768));
              return [canvas.width, canvas.height, btoa(text)];
            })()"""
        )
        return columns, rows, base64.b64decode(text)

    def screenshot(self, path):
        """Keeps what is seen."""
        path.write_bytes(base64.b64decode(self.ask("Page.captureScreenshot")["data"]))

    def mouse(self, kind, x, y, **more):
        """A mouse event: mouseMoved, mousePressed, mouseReleased, mouseWheel."""
        self.ask("Input.dispatchMouseEvent", type=kind, x=x, y=y, **more)

    def touch(self, kind, *points):
        """A touch event: touchStart, touchMove, touchEnd."""
        self.ask("Input.dispatchTouchEvent", type=kind, touchPoints=[{"x": x, "y": y} for x, y in points])

    def key(self, key, shift=False):
        """Presses and lifts a key."""
        codes = {"Tab": 9, "Enter": 13, "ArrowLeft": 37, "ArrowUp": 38, "ArrowRight": 39, "ArrowDown": 40}
        event = {"key": key, "code": key, "windowsVirtualKeyCode": codes.get(key, ord(key[0].upper()))}
        text = {"text": key} if len(key) == 1 else {"text": "\r"} if key == "Enter" else {}
        modifiers = 8 if shift else 0
        self.ask("Input.dispatchKeyEvent", type="keyDown", modifiers=modifiers, **event, **text)
        self.ask("Input.dispatchKeyEvent", type="keyUp", modifiers=modifiers, **event)

    def events(self, method):
        """Parameters of the events of a kind so far."""
        self.run("0")
        mine = (e for e in self.browser.events if e.get("sessionId") == self.session)
        return [event["params"] for event in mine if event.get("method") == method]

    def errors(self):
        """Exceptions and errors on the console."""
        logged = [e["entry"] for e in self.events("Log.entryAdded") if e["entry"]["level"] == "error"]
        called = [e for e in self.events("Runtime.consoleAPICalled") if e["type"] in ("error", "assert")]
        return self.events("Runtime.exceptionThrown") + logged + called
