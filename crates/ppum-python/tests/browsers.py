"""Notebooks in a real browser without a screen: servers, pages, and what is read from them."""

import base64
import contextlib
import io
import json
import os
import pathlib
import shutil
import socket
import subprocess
import sys
import time
import urllib.request
import uuid

import numpy as np
import pytest

#: Keeps a browser to itself, and to what machines without a graphics card have.
ARGUMENTS = [
    "--no-sandbox",
    "--disable-gpu",
    "--disable-quic",
    "--no-first-run",
    "--disable-background-networking",
    "--disable-component-update",
    "--disable-sync",
]

#: The first cells of all notebooks.
SETUP = """\
import ppum
ds = ppum.open("plate.h5")
view = ds.view("von_mises", height=600)
"""


#: The longest wait for a state in seconds. Only a test that hangs waits so long.
TIME_LIMIT = 300


def needed(*modules):
    """Skips where something is not installed."""
    for module in modules:
        if not shutil.which(module) and not _has(module):
            pytest.skip(f"{module} is not installed")


def _has(module):
    import importlib.util

    return importlib.util.find_spec(module) is not None


@contextlib.contextmanager
def chromium(**options):
    """A page of the system's Chromium, 1,100 pixels wide and so high that nothing has to be scrolled."""
    from playwright.sync_api import sync_playwright

    path = shutil.which("chromium") or shutil.which("chromium-browser") or shutil.which("google-chrome")
    if path is None:
        pytest.skip("chromium is not installed")
    with sync_playwright() as playwright:
        browser = playwright.chromium.launch(executable_path=path, args=ARGUMENTS)
        page = browser.new_page(viewport={"width": 1100, "height": 1900}, **options)
        page.set_default_timeout(1000 * TIME_LIMIT)
        yield page
        browser.close()


def free_port():
    with socket.socket() as one:
        one.bind(("127.0.0.1", 0))
        return one.getsockname()[1]


@contextlib.contextmanager
def server(command, url, folder):
    """A server that answers at `url`, in a process of its own."""
    home = {"JUPYTER_CONFIG_DIR": "config", "JUPYTER_DATA_DIR": "data", "IPYTHONDIR": "ipython", "HOME": "home", "XDG_CONFIG_HOME": "home"}
    places = {name: str(folder / path) for name, path in home.items()}
    for path in places.values():
        pathlib.Path(path).mkdir(exist_ok=True)
    environment = {**os.environ, **places, "PYTHONWARNINGS": "ignore"}
    with open(folder / "server.log", "w") as log:
        process = subprocess.Popen(command, cwd=folder, env=environment, stdout=log, stderr=log)
        try:
            _wait(process, url, folder / "server.log")
            yield
        finally:
            process.terminate()
            try:
                process.wait(10)
            except subprocess.TimeoutExpired:
                process.kill()


def _wait(process, url, log):
    end = time.monotonic() + TIME_LIMIT
    while time.monotonic() < end:
        assert process.poll() is None, log.read_text()
        with contextlib.suppress(OSError):
            urllib.request.urlopen(url, timeout=60).close()
            return
        time.sleep(0.1)
    raise AssertionError(f"{url} does not answer:\n{log.read_text()}")


@contextlib.contextmanager
def jupyterlab(folder, cells):
    """The address of a notebook in JupyterLab."""
    port = free_port()
    (folder / "a.ipynb").write_text(json.dumps(notebook(cells)))
    # it would ask whether it may fetch news
    (folder / "config/labconfig").mkdir(parents=True, exist_ok=True)
    no_news = {"disabledExtensions": {"@jupyterlab/apputils-extension:announcements": True}}
    (folder / "config/labconfig/page_config.json").write_text(json.dumps(no_news))
    command = [sys.executable, "-m", "jupyterlab", "--no-browser", "--allow-root", f"--port={port}", "--ServerApp.port_retries=0"]
    quiet = ["--IdentityProvider.token=", "--LabApp.news_url="]
    base = f"http://127.0.0.1:{port}"
    with server([*command, *quiet, f"--ServerApp.root_dir={folder}"], f"{base}/api", folder):
        yield f"{base}/lab/workspaces/{uuid.uuid4().hex}/tree/a.ipynb"


def notebook(cells):
    return {
        "cells": [
            {"cell_type": "code", "id": f"c{k}", "execution_count": None, "metadata": {}, "outputs": [], "source": cell}
            for k, cell in enumerate(cells)
        ],
        "metadata": {"kernelspec": {"display_name": "Python 3", "language": "python", "name": "python3"}},
        "nbformat": 4,
        "nbformat_minor": 5,
    }


@contextlib.contextmanager
def marimo(folder, cells):
    """The address of an application of marimo."""
    port = free_port()
    body = "\n\n".join(f"@app.cell\ndef _():\n" + "".join(f"    {line}\n" for line in cell.splitlines()) for cell in cells)
    (folder / "a.py").write_text(f"import marimo\n\napp = marimo.App(width='full')\n\n{body}")
    command = [sys.executable, "-m", "marimo", "-q", "run", "a.py", "--headless", f"--port={port}", "--host=127.0.0.1", "--no-token"]
    with server(command, f"http://127.0.0.1:{port}/health", folder):
        yield f"http://127.0.0.1:{port}"


def frames(canvas):
    return int(canvas.get_attribute("data-frames") or 0)


def rested(canvas, after, quiet=0.6):
    """Waits for a frame more than `after`, and until no more follow."""
    end = time.monotonic() + TIME_LIMIT
    while frames(canvas) <= after:
        assert time.monotonic() < end, "no frame came"
        canvas.page.wait_for_timeout(20)
    seen, since = frames(canvas), time.monotonic()
    while time.monotonic() - since < quiet:
        canvas.page.wait_for_timeout(40)
        if frames(canvas) != seen:
            seen, since = frames(canvas), time.monotonic()


def pixels(canvas):
    """The pixels of a canvas, shape (rows, columns, 4)."""
    script = """canvas => {
        const data = canvas.getContext("2d").getImageData(0, 0, canvas.width, canvas.height).data;
        let text = "";
        for (let k = 0; k < data.length; k += 32768) text += String.fromCharCode(...data.subarray(k, k + 32768));
        return [canvas.width, canvas.height, btoa(text)];
    }"""
    columns, rows, data = canvas.evaluate(script)
    return np.frombuffer(base64.b64decode(data), np.uint8).reshape(rows, columns, 4)


#: Moves one pixel to and fro, each time when the last frame has been drawn; gives the milliseconds that took.
ROUND_TRIPS = """async (canvas, count) => {
    const times = [], box = canvas.getBoundingClientRect();
    const at = (x) => ({ clientX: box.left + x, clientY: box.top + 50, button: 0, pointerId: 1, bubbles: true });
    canvas.setPointerCapture = () => {};
    canvas.onpointerdown(at(100));
    for (let k = 0; k < count; k += 1) {
        const before = canvas.dataset.frames, start = performance.now();
        canvas.onpointermove(at(100 + (k + 1) % 2));
        while (canvas.dataset.frames === before) await new Promise((next) => { const c = new MessageChannel(); c.port1.onmessage = next; c.port2.postMessage(0); });
        times.push(performance.now() - start);
    }
    canvas.onpointerup(at(100));
    return times;
}"""
