"""The whole page: runs, chapters, tables, files."""

from __future__ import annotations

import os
import platform
import time
from collections import Counter
from collections.abc import Callable, Sequence
from pathlib import Path
from typing import Literal

import magwire
from magwire.errors import InputError
from magwire.evidence.reproduce import passive, speed, steering, tables
from magwire.evidence.reproduce.chapter import Chapter, Part
from magwire.evidence.reproduce.page import Block, Heading, claims_table, to_html, to_markdown
from magwire.evidence.reproduce.runs import Ask, make_all
from magwire.files import write_whole

Name = Literal[
    "setup", "passive", "half-circle", "sinusoid", "helix", "branches", "authors", "speed"
]
PARTS: dict[Name, Part] = {
    "setup": passive.SETUP,
    "passive": passive.PASSIVE,
    "half-circle": steering.HALF_CIRCLE,
    "sinusoid": steering.SINUSOID,
    "helix": steering.HELIX,
    "branches": steering.BRANCHING,
    "authors": passive.AUTHORS,
    "speed": speed.PART,
}
TITLE = "The paper's results, computed with magwire"
PAGE, TEXT, IMAGES = "reproduce.html", "reproduce.md", "images"


def chosen(only: Sequence[str] | None) -> list[Name]:
    """Parts of the page by their names, in the page's order; all if none are named.

    Raises
    ------
    InputError
        If there is no part of a name.
    """
    unknown = [name for name in only or () if name not in PARTS]
    if unknown:
        raise InputError(f"Input --only must be among {', '.join(PARTS)}; received '{unknown[0]}'.")
    return [name for name in PARTS if not only or name in only]


def asks(names: Sequence[Name]) -> list[Ask]:
    """The runs that parts of the page need, in order, each once."""
    return list(dict.fromkeys(ask for name in names for ask in PARTS[name].asks))


def reproduce(
    folder: Path,
    names: Sequence[Name] = tuple(PARTS),
    *,
    common: Sequence[str] = (),
    watch: Callable[[str], None] = lambda name: None,
) -> list[Chapter]:
    """Run the paper's cases and write the page about them.

    Parameters
    ----------
    folder
        Existing folder for ``reproduce.html``, ``reproduce.md`` and ``images/``.
    names
        Parts of the page.
    common
        Keys to set in all scenarios, ``key=value`` each.
    watch
        Called with the name of each run, and before the pictures of each part.

    Returns
    -------
    list
        The chapters; ``broken`` in them says what did not come out.
    """
    began = time.perf_counter()
    images = folder / IMAGES
    images.mkdir(exist_ok=True)
    runs = make_all(asks(names), watch, common)
    chapters = []
    for name in names:
        watch(f"pictures, {name}")
        chapters.append(PARTS[name].write(runs, images))
    blocks = compose(chapters, whole=len(names) == len(PARTS), seconds=time.perf_counter() - began)
    write_whole(folder / PAGE, to_html(TITLE, blocks))
    write_whole(folder / TEXT, to_markdown(TITLE, blocks))
    return chapters


def compose(chapters: Sequence[Chapter], *, whole: bool, seconds: float) -> list[Block]:
    """The page's blocks: first what it comes to, then chapter by chapter."""
    claims = [claim for chapter in chapters for claim in chapter.claims]
    broken = [text for chapter in chapters for text in chapter.broken]
    count = Counter(claim.agrees for claim in claims)
    machine = f"{platform.system()} {platform.machine()}, {os.cpu_count()} cores, one used"
    blocks: list[Block] = [
        "Tong, Hao, Li, Sun, Liu, Wang, Huang: Real-time simulation enabled navigation control of "
        "magnetic soft continuum robots in confined lumens. Its Results, computed again: the "
        "figures, and every claim next to what magwire finds. X is the insertion over the wire's "
        "length L, F* is force times L²/EI, B* is field times |M| L²/EI.",
        f"magwire {magwire.__version__}, {machine}; {seconds:.0f} s."
        + ("" if whole else " This is only a part of the page."),
    ]
    if broken:
        blocks += [Heading("What did not come out"), *broken]
    blocks += [
        Heading("Claims"),
        f"{len(claims)} claims: {count['yes']} agree, {count['partly']} partly, {count['no']} do "
        f"not, {count['not checked']} cannot be checked by a simulation. Each verdict follows "
        "from the numbers of these runs by the rule in the last column.",
        claims_table(claims),
    ]
    blocks += number_tables(chapters)
    for chapter in chapters:
        if chapter.blocks:
            blocks += [Heading(chapter.title), *chapter.blocks]
    return blocks


def number_tables(chapters: Sequence[Chapter]) -> list[Block]:
    """The tables of wall forces and of replays, if there is anything in them."""
    blocks: list[Block] = []
    reductions = [row for chapter in chapters for row in chapter.reductions]
    replays = [row for chapter in chapters for row in chapter.replays]
    if reductions:
        blocks += [
            Heading("Wall forces, passive against active"),
            "Each cell: without a field → with a field. Forces of the wall on the tip node, and "
            "sizes of the forces on all nodes added up. The wire that is simulated never has a "
            "virtual tube; the column says whether the navigator's own model has one. A run that "
            "stops is compared up to there.",
            tables.reduction_table(reductions),
        ]
    if replays:
        blocks += [
            Heading("Schedules replayed without help"),
            "The field of the least-field navigator, recorded every 0.1 mm and applied open loop, "
            "without navigator or virtual tube: as it is, with only its values every 2 mm, and too "
            "weak or too strong as a whole.",
            tables.replay_table(replays),
        ]
    return blocks
