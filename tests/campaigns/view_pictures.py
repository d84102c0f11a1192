"""Runs the cases of the library, and takes a picture of each one's page in a real browser.

``python -m campaigns.view_pictures FOLDER [CASE ...]``: ``view-CASE.webp`` at two thirds of the
run, with WebGL. Look at each of them before it is committed.
"""

from __future__ import annotations

import io
import sys
import tempfile
from pathlib import Path
from typing import Any

from PIL import Image

from browsers import DRAWN, started
from magwire.scenario import load

CASES = (
    *("half-circle", "sinusoid", "helix", "left-branch", "middle-branch", "right-branch"),
    *("carotid", "aortic-arch", "coronary", "tortuous"),
    *("half-circle-helmholtz", "half-circle-magnet"),
)
SIZE = {"width": 1180, "height": 740}
KEPT = (786, 493)  # pixels of a picture
SHARE = 2.0 / 3.0  # of the time


def take(browser: Any, name: str, folder: Path) -> None:
    """Run a case and write the picture of its page."""
    result = load(name).run()
    with tempfile.TemporaryDirectory() as made:
        page = browser.new_page(viewport=SIZE)
        page.goto(result.view().save(Path(made) / "page.html").as_uri())
        while not page.evaluate("!!window.magwire"):
            page.wait_for_timeout(50)
        page.evaluate(f"magwire.seek({SHARE * float(result.time[-1])})")
        page.wait_for_timeout(500)
        shot = Image.open(io.BytesIO(page.screenshot())).convert("RGB")
        page.close()
    file = folder / f"view-{name}.webp"
    shot.resize(KEPT, Image.Resampling.LANCZOS).save(file, quality=80, method=6)
    print(f"{file.name}: {file.stat().st_size / 1e3:.0f} kB, {result.status}", flush=True)


def main(folder: Path, names: tuple[str, ...]) -> None:
    """Take all pictures."""
    browsers = started()
    browser = next(browsers)(DRAWN)
    for name in names or CASES:
        take(browser, name, folder)
    next(browsers, None)


if __name__ == "__main__":
    main(Path(sys.argv[1]), tuple(sys.argv[2:]))
