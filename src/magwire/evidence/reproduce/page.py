"""The page as HTML and as Markdown, from the same blocks."""

from __future__ import annotations

import html
from collections.abc import Sequence
from dataclasses import dataclass

from magwire.evidence.reproduce.claim import Claim

HEAD = ("where", "the paper says", "magwire finds", "agrees?", "because")


@dataclass(frozen=True)
class Picture:
    """A picture: its file, relative to the page, and what it shows."""

    file: str
    caption: str


@dataclass(frozen=True)
class Table:
    """A table of words."""

    head: tuple[str, ...]
    rows: tuple[tuple[str, ...], ...]


@dataclass(frozen=True)
class Heading:
    """A heading of the second order."""

    text: str


Block = str | Picture | Table | Heading
"""A plain string is a paragraph."""


def claims_table(claims: Sequence[Claim]) -> Table:
    """The claims, a line each."""
    return Table(HEAD, tuple((c.where, c.says, c.finds, c.agrees, c.because) for c in claims))


def to_markdown(title: str, blocks: Sequence[Block]) -> str:
    """The page as Markdown."""
    return "\n\n".join([f"# {title}", *map(_markdown, blocks)]) + "\n"


def to_html(title: str, blocks: Sequence[Block]) -> str:
    """The page as HTML; pictures stay files of their own."""
    name = html.escape(title)
    body = "\n".join(_html(block) for block in blocks)
    return (
        '<!doctype html>\n<html lang="en">\n<head>\n<meta charset="utf-8">\n'
        '<meta name="viewport" content="width=device-width, initial-scale=1">\n'
        f"<title>{name}</title>\n<style>{STYLE}</style>\n</head>\n"
        f"<body>\n<main>\n<h1>{name}</h1>\n{body}\n</main>\n</body>\n</html>\n"
    )


def _markdown(block: Block) -> str:
    if isinstance(block, Heading):
        return f"## {block.text}"
    if isinstance(block, Picture):
        return f"![{block.caption}]({block.file})\n\n*{block.caption}*"
    if isinstance(block, Table):
        rows = [block.head, ("---",) * len(block.head), *block.rows]
        return "\n".join("| " + " | ".join(map(_cell, row)) + " |" for row in rows)
    return block


def _cell(text: str) -> str:
    return text.replace("|", "\\|").replace("\n", " ")


def _html(block: Block) -> str:
    if isinstance(block, Heading):
        return f"<h2>{html.escape(block.text)}</h2>"
    if isinstance(block, Picture):
        caption, file = html.escape(block.caption), html.escape(block.file)
        return (
            f'<figure><img src="{file}" alt="{caption}" loading="lazy">'
            f"<figcaption>{caption}</figcaption></figure>"
        )
    if isinstance(block, Table):
        head = "".join(f"<th>{html.escape(word)}</th>" for word in block.head)
        rows = "\n".join(f"<tr>{''.join(map(_data, row))}</tr>" for row in block.rows)
        return (
            f'<div class="wide"><table>\n<thead><tr>{head}</tr></thead>\n'
            f"<tbody>\n{rows}\n</tbody></table></div>"
        )
    return f"<p>{html.escape(block)}</p>"


def _data(text: str) -> str:
    kind = VERDICTS.get(text)
    inside = html.escape(text)
    return f'<td><b class="{kind}">{inside}</b></td>' if kind else f"<td>{inside}</td>"


VERDICTS = {"yes": "yes", "partly": "partly", "no": "no", "not checked": "open"}

STYLE = """
body { margin: 0; background: #fff; color: #22303c; font: 16px/1.5 system-ui, sans-serif; }
main { max-width: 1120px; margin: 0 auto; padding: 24px 20px 64px; }
h1 { font-size: 1.7rem; line-height: 1.2; }
h2 { font-size: 1.25rem; margin: 2.4em 0 .6em; border-top: 1px solid #e3e8ec; padding-top: 1em; }
p { max-width: 46em; }
figure { margin: 1.4em 0; }
img { max-width: 100%; height: auto; display: block; }
figcaption { color: #4c5b68; font-size: .9rem; max-width: 52em; margin-top: .5em; }
.wide { overflow-x: auto; margin: 1em 0; }
table { border-collapse: collapse; font-size: .88rem; line-height: 1.4; width: 100%; }
th, td { text-align: left; vertical-align: top; padding: .45em .7em; }
tr { border-bottom: 1px solid #e3e8ec; }
th { background: #f4f6f8; white-space: nowrap; }
td b { font-weight: 600; white-space: nowrap; padding: .1em .5em; border-radius: .6em; }
.yes { background: #d9f0e6; color: #00573f; }
.partly { background: #fdf0d0; color: #6b4a00; }
.no { background: #fbe0d5; color: #8a2f00; }
.open { background: #e9edf0; color: #44525f; }
"""
