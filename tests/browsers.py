"""A real browser without a screen, for tests that look at pages."""

from __future__ import annotations

import shutil
from collections.abc import Iterator
from typing import Any

import pytest

BROWSERS = ("chromium", "chromium-browser", "google-chrome")
DRAWN = ("--no-sandbox", "--use-angle=swiftshader", "--enable-unsafe-swiftshader")
FLAT = ("--no-sandbox", "--disable-3d-apis")


def started() -> Iterator[Any]:
    """What starts a browser, by its arguments; each is started once. To be yielded by a fixture."""
    sync = pytest.importorskip("playwright.sync_api", reason="playwright is not installed")
    program = next(filter(None, map(shutil.which, BROWSERS)), None)
    if program is None:
        pytest.skip("there is no Chromium here to look at pages with")
    with sync.sync_playwright() as playwright:
        running: dict[Any, Any] = {}

        def start(arguments: tuple[str, ...] = DRAWN) -> Any:
            if arguments not in running:
                running[arguments] = playwright.chromium.launch(
                    executable_path=program, args=list(arguments)
                )
            return running[arguments]

        yield start
        for browser in running.values():
            browser.close()
