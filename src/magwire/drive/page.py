"""The page of the live simulator: one file, made of parts, that talks to its server only."""

from __future__ import annotations

from html import escape
from importlib.resources import files

from magwire.view.page import DATA, SCENE, filled
from magwire.view.page import part as shared

OWN = ("live.js", "fluoroscopy.js", "gauge.js", "steering.js", "hands.js", "pace.js", "cockpit.js")
"""What drives with it, each after those that it needs."""


def page(title: str) -> str:
    """The page, as HTML."""
    filling = {
        "title": escape(title),
        "style": part("drive.css"),
        "scripts": "\n".join([*map(shared, (*SCENE, DATA)), *map(part, OWN)]),
    }
    return filled(part("drive.html"), filling)


def part(name: str) -> str:
    """The text of one of the page's own parts."""
    return (files("magwire.drive") / "page" / name).read_text(encoding="utf-8")
