"""Goes through the tutorial of the live simulator in a real browser, and takes its pictures.

``python -m campaigns.drive_pictures FOLDER``: a picture of each step, an animation of the
way through the half-circle with the navigator's help, and the time from the command to the outlet.
"""

from __future__ import annotations

import io
import re
import signal
import subprocess
import sys
import tempfile
import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any

from PIL import Image

from browsers import DRAWN, FLAT, started

SIZE = {"width": 1180, "height": 740}
LARGEST = 150_000  # bytes of a picture
THROUGH = "magwire.picture.feed > 0.0765"
SHADED = "magwire.cockpit.pace.slow = () => {}, document.querySelector('.way').click()"
"""Has a page paint with WebGL, however slow it is here."""
WAIT = 300.0  # longest time for anything [s]


@contextmanager
def served(*words: str) -> Iterator[str]:
    """The address of a simulator that is ended afterwards."""
    command = [sys.executable, "-m", "magwire", "drive", *words, "--port", "0"]
    with (
        tempfile.TemporaryDirectory() as folder,
        subprocess.Popen(command, cwd=folder, stdout=subprocess.PIPE, text=True) as process,
    ):
        assert process.stdout is not None
        try:
            lines = iter(process.stdout.readline, "")
            yield next(line for line in lines if re.match(r"open http", line)).split()[1]
        finally:
            process.send_signal(signal.SIGINT)
            print(process.communicate(timeout=60)[0])


class Visitor:
    """Somebody who looks at the page and has hands."""

    def __init__(self, browser: Any, address: str, folder: Path, *, shaded: bool = True) -> None:
        self.page = browser.new_page(viewport=SIZE)
        self.folder = folder
        self.page.goto(address)
        self.until("window.magwire && magwire.pictures > 0")
        if shaded:
            self.page.evaluate(SHADED)

    def until(self, expression: str, meanwhile: Callable[[], None] = lambda: None) -> None:
        """Wait until the page says yes."""
        end = time.monotonic() + WAIT
        while not self.page.evaluate(f"!!({expression})"):
            assert time.monotonic() < end, expression
            meanwhile()
            self.page.wait_for_timeout(50)

    def shot(self) -> Image.Image:
        """The page as it is."""
        return Image.open(io.BytesIO(self.page.screenshot())).convert("RGB")

    def keep(self, name: str) -> None:
        """Write a picture of the page."""
        self.page.wait_for_timeout(400)
        file = self.folder / f"drive-{name}.webp"
        for quality in (85, 75, 60, 45):
            self.shot().save(file, quality=quality, method=6)
            if file.stat().st_size <= LARGEST:
                break
        print(f"{file.name}: {file.stat().st_size / 1e3:.0f} kB")


def half_circle(browser: Any, folder: Path, *, shaded: bool) -> None:
    """Push until the wall says no, go back, and through with help.

    shaded: with WebGL, or as the page paints by itself on this computer.
    """
    began = time.monotonic()
    with served("half-circle", "--limit", "0.5 mN") as address:
        visitor = Visitor(browser, address, folder, shaded=shaded)
        visitor.keep("start")
        page = visitor.page
        page.keyboard.down("ArrowUp")
        visitor.until("magwire.picture.message.includes('limit')")
        visitor.keep("limit")
        page.keyboard.up("ArrowUp")
        page.click("[data-rewind='10']")
        page.click("[data-help=assist]")
        visitor.until("magwire.picture.help == 'assist'")
        tip_forces = []

        def listen() -> None:
            tip_forces.append(page.evaluate("magwire.picture.tipForce"))

        page.keyboard.down("ArrowUp")
        visitor.until("magwire.picture.feed > 0.045", listen)
        visitor.keep("assist")
        visitor.until(THROUGH, listen)
        page.keyboard.up("ArrowUp")
        simulated = page.evaluate("magwire.picture.time")
        how = "shaded" if shaded else "as it comes"
        wall = time.monotonic() - began
        print(f"from the command to the outlet, {how}: {wall:.0f} s, {simulated:.0f} simulated")
        print(f"largest force on the tip with help: {max(tip_forces[5:]):.3g} N")
        page.click(".end")
        visitor.until("magwire.cockpit.done")
        visitor.keep("report")
        page.close()


def film(browser: Any, folder: Path) -> None:
    """The way through the half-circle with help, as an animation."""
    with served("half-circle") as address:
        visitor = Visitor(browser, address, folder)
        frames = [visitor.shot()]
        visitor.page.click("[data-help=assist]")
        visitor.page.keyboard.down("ArrowUp")
        due = 0.002

        def take() -> None:
            nonlocal due
            if visitor.page.evaluate("magwire.picture.feed") >= due:
                frames.append(visitor.shot())
                due += 0.004

        visitor.until(THROUGH, take)
        visitor.page.close()
    small = [frame.resize((480, 301), Image.Resampling.LANCZOS) for frame in frames]
    file = folder / "drive.webp"
    for quality in (60, 45, 30, 20, 10):
        options = {"save_all": True, "append_images": small[1:], "duration": 160, "loop": 0}
        small[0].save(file, quality=quality, method=6, **options)
        if file.stat().st_size <= LARGEST:
            break
    print(f"{file.name}: {file.stat().st_size / 1e3:.0f} kB, {len(small)} frames")


def tree(browser: Any, folder: Path) -> None:
    """Choose another outlet."""
    with served("middle-branch") as address:
        visitor = Visitor(browser, address, folder)
        visitor.page.click(".outlet >> text=right")
        visitor.page.click("[data-help=suggest]")
        visitor.page.keyboard.down("w")
        visitor.until("magwire.picture.feed > 0.027")
        visitor.page.keyboard.up("w")
        visitor.keep("target")
        visitor.page.close()


def main(folder: Path) -> None:
    """Take all pictures; the film with plain strokes, which are quicker than WebGL in software."""
    browsers = started()
    start = next(browsers)
    with tempfile.TemporaryDirectory() as aside:
        half_circle(start(DRAWN), Path(aside), shaded=False)  # as a newcomer has it
    half_circle(start(DRAWN), folder, shaded=True)
    tree(start(DRAWN), folder)
    film(start(FLAT), folder)
    next(browsers, None)


if __name__ == "__main__":
    main(Path(sys.argv[1]))
