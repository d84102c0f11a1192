"""The live simulator in a real browser: from a key to a changed picture.

A server in a process of its own, a headless Chromium, the half-circle. The wire is at rest and the
picture stands; then the key is pressed. From the time stamp of the event to the picture at which
any pixel of the 3D view is another: that is there and back through the server, one step of the
engine, and the painting. What the screen takes to show it comes on top.
"""

from __future__ import annotations

import re
import shutil
import signal
import subprocess
import sys
import tempfile
import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from importlib.util import find_spec
from typing import Any

PROGRAMS = ("chromium", "chromium-browser", "google-chrome")
FLAGS = {
    "WebGL, if it is quick": (
        "--no-sandbox",
        "--use-angle=swiftshader",
        "--enable-unsafe-swiftshader",
    ),
    "plain strokes": ("--no-sandbox", "--disable-3d-apis"),
}
"""A headless Chromium without a graphics processor, with WebGL in software and without."""
PRESSES = 8
HELD = 3.0  # time for which pictures are counted [s]
WAIT = 60.0  # longest time for anything [s]

WATCH = """() => {
  const shown = document.querySelector('.scene canvas');
  const copy = new OffscreenCanvas(shown.width, shown.height);
  const pen = copy.getContext('2d', { willReadFrequently: true });
  const look = () => {
    pen.clearRect(0, 0, copy.width, copy.height);
    pen.drawImage(shown, 0, 0);
    return new Uint32Array(pen.getImageData(0, 0, copy.width, copy.height).data.buffer);
  };
  const before = look();
  window.changedAfter = null;
  addEventListener('keydown', (event) => {
    const turn = () => {
      if (look().every((pixel, k) => pixel === before[k])) requestAnimationFrame(turn);
      else window.changedAfter = performance.now() - event.timeStamp;
    };
    requestAnimationFrame(turn);
  }, { once: true, capture: true });
}"""


def run_driving(tell: Callable[[str], None]) -> list[dict[str, Any]]:
    """Rows of the table: painter, latencies [s], pictures a second, rate of the clock.

    None where the packages or the browser are missing.
    """
    program = next(filter(None, map(shutil.which, PROGRAMS)), None)
    if program is None or find_spec("playwright") is None or find_spec("websockets") is None:
        return []
    tell("keys and pictures")
    with served() as address:
        return [one(program, address, name, PRESSES) for name in FLAGS]


@contextmanager
def served() -> Iterator[str]:
    """The address of a server that is ended afterwards."""
    words = [sys.executable, "-m", "magwire", "drive", "half-circle", "--port", "0"]
    with (
        tempfile.TemporaryDirectory(prefix="magwire-bench-") as folder,
        subprocess.Popen(words, cwd=folder, stdout=subprocess.PIPE, text=True) as process,
    ):
        assert process.stdout is not None
        try:
            for line in iter(process.stdout.readline, ""):
                found = re.match(r"open (http\S+)", line)
                if found:
                    yield found[1]
                    break
        finally:
            process.send_signal(signal.SIGINT)
            process.communicate(timeout=WAIT)


def one(program: str, address: str, name: str, presses: int) -> dict[str, Any]:
    """Latencies with one way of painting."""
    from playwright.sync_api import sync_playwright

    with sync_playwright() as playwright:
        browser = playwright.chromium.launch(executable_path=program, args=list(FLAGS[name]))
        page = browser.new_page(viewport={"width": 1280, "height": 800})
        page.goto(address)
        until(page, "window.magwire && magwire.pictures > 0")
        page.keyboard.down("ArrowUp")  # it finds out how quick the painter is
        until(page, "magwire.pictures > 20")
        page.keyboard.up("ArrowUp")
        latencies = []
        for _ in range(presses):
            until(page, "magwire.picture.rate === 0 && !magwire.cockpit.fresh")
            page.evaluate(WATCH)
            page.keyboard.down("ArrowUp")
            until(page, "window.changedAfter !== null")
            latencies.append(1e-3 * page.evaluate("window.changedAfter"))
            page.keyboard.up("ArrowUp")
        page.keyboard.down("ArrowDown")
        until(page, "magwire.picture.rate > 0")
        before, began = page.evaluate("magwire.pictures"), time.perf_counter()
        page.wait_for_timeout(1e3 * HELD)
        pictures = page.evaluate("magwire.pictures") - before
        seconds, rate = time.perf_counter() - began, page.evaluate("magwire.picture.rate")
        page.keyboard.up("ArrowDown")
        mode = page.evaluate("magwire.mode")
        browser.close()
    row = {"what": name, "painter": mode, "latencies": latencies, "clock": rate}
    return row | {"pictures": pictures / seconds}


def until(page: Any, expression: str) -> None:
    """Wait until a page says yes."""
    end = time.monotonic() + WAIT
    while not page.evaluate(f"!!({expression})"):
        if time.monotonic() > end:
            raise TimeoutError(f"The page does not come to {expression}.")
        page.wait_for_timeout(15)
