"""The page: one file with everything in it, that sends for nothing."""

from __future__ import annotations

import json
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from html import escape
from importlib.resources import files
from pathlib import Path
from typing import TYPE_CHECKING

from magwire.errors import InputError, shortened
from magwire.files import write_whole
from magwire.view import content, looks

if TYPE_CHECKING:
    import xarray as xr

SCENE = ("algebra.js", "colours.js", "camera.js", "geometry.js", "webgl.js", "flat.js", "scene.js")
"""What draws a wire in its lumen from arrays, each after those that it needs."""
DATA = "data.js"
"""What unpacks arrays."""
PLAYBACK = (DATA, "curves.js", "player.js")
"""What replays a result with it."""
MOST = 2
"""Results that fit side by side."""
NOTEBOOK_HEIGHT = 660
"""Height of the page in a notebook [pixels]."""


@dataclass(frozen=True)
class Page:
    """A page that shows results; notebooks show it where it is the last line of a cell.

    Attributes
    ----------
    html
        All of it, to be written to a file.
    """

    html: str

    def save(self, path: str | Path) -> Path:
        """Write the page to a file; an existing one is overwritten."""
        path = Path(path)
        write_whole(path, self.html)
        return path

    def _repr_html_(self) -> str:
        return (
            f'<iframe srcdoc="{escape(self.html)}" title="magwire" allowfullscreen '
            f'style="width: 100%; height: {NOTEBOOK_HEIGHT}px; border: 0"></iframe>'
        )

    def __repr__(self) -> str:
        return f"<magwire page of {len(self.html) / 1e3:.0f} kB; .save('page.html') writes it>"


def page(results: Sequence[tuple[str | Path, xr.Dataset]]) -> Page:
    """The page of one result, or of two side by side.

    Parameters
    ----------
    results
        What each is called where it has no title, and its variables and attributes.

    Raises
    ------
    InputError
        If there are none or more than two, or one cannot be shown.
    """
    if not 0 < len(results) <= MOST:
        raise InputError(f"Input results of view must be one or two; received {len(results)}.")
    runs = [content.run(data, str(name)) for name, data in results]
    titles = [run["title"] or run["name"] for run in runs]
    filling = {
        "title": escape(" and ".join(dict.fromkeys(titles)) + " - magwire"),
        "style": part("page.css"),
        "note": escape(_note([data for _, data in results])),
        "scripts": "\n".join(part(name) for name in (*SCENE, *PLAYBACK)),
        # "<" could end the script; as an escape it means the same to JSON.
        "data": json.dumps({"runs": runs}, allow_nan=False).replace("<", "\\u003c"),
    }
    return Page(filled(part("page.html"), filling))


def filled(template: str, filling: Mapping[str, str]) -> str:
    """A template whose {{names}} are replaced; what they are replaced by is not looked through."""
    pieces = template.split("{{")
    whole = [pieces[0]]
    for piece in pieces[1:]:
        name, rest = piece.split("}}", 1)
        whole += [filling[name], rest]
    return "".join(whole)


def part(name: str) -> str:
    """The text of one of the page's parts, such as "scene.js"."""
    return (files("magwire.view") / "page" / name).read_text(encoding="utf-8")


def _note(results: Sequence[xr.Dataset]) -> str:
    """What a reader has to know about the picture."""
    version = shortened(results[0].attrs.get("magwire_version", ""))
    words = [
        "Drag to turn, shift-drag to move, wheel to come closer. Numbers are those of the records.",
        "Pressure: forces on nodes, spread over discs of 0.8 lumen radii.",
    ]
    if any(looks.on_axis(data) for data in results):
        words.append("The wall holds the wire's centreline: the wire is drawn slim.")
    if any(looks.radius(data) is None for data in results):
        words.append("The file does not say the wire's radius: a fifth of the lumen's is drawn.")
    return " ".join([*words, f"magwire {version}"])
