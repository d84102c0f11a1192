"""The report as one HTML file, plots and all, that can be sent to a reviewer."""

from __future__ import annotations

import base64
import io
from html import escape
from itertools import cycle, groupby
from pathlib import Path
from typing import Any

from magwire.evidence.verify.evidence import NODES, ORDER_TOLERANCE, Curve, Line
from magwire.evidence.verify.report import Entry, Group, Report, numbers, to_json
from magwire.files import write_whole

STYLE = """
body { font: 14px/1.5 system-ui, sans-serif; color: #22303c; margin: 2em auto; max-width: 1200px;
       padding: 0 1.5em; }
h1 { font-size: 1.6em; margin-bottom: 0.2em; } h2 { font-size: 1.2em; margin-top: 2em; }
table { border-collapse: collapse; width: 100%; font-size: 12.5px; }
th { text-align: left; border-bottom: 1.5px solid #6b7a87; }
th, td { padding: 0.25em 0.7em 0.25em 0; vertical-align: top; }
tr + tr td { border-top: 1px solid #e3e8ec; }
td.number, th.number { text-align: right; white-space: nowrap; font-variant-numeric: tabular-nums; }
td.source { color: #6b7a87; min-width: 16em; } dt { color: #6b7a87; } dd { margin: 0; }
dl { display: grid; grid-template-columns: max-content 1fr; gap: 0.1em 1em; }
.pass { color: #00704f; } .fail { color: #b3261e; font-weight: bold; } .skipped { color: #8a6100; }
.plots { display: flex; flex-wrap: wrap; gap: 1em; margin-top: 1em; } .plots img { width: 370px; }
@media print { body { max-width: none; } tr, img { break-inside: avoid; } }
"""
HEADINGS = ("case", "quantity", "reference", "source", "magwire", "error", "tolerance", "order")
NUMBERS = ("reference", "magwire", "error", "tolerance", "order")
POINTS = {"ms": 3.0, "mfc": "none", "mew": 0.8}
WIDTH, HEIGHT = 95.0, 66.0
"""Of a plot [mm]."""


def save(report: Report, folder: Path) -> list[Path]:
    """Write ``verify.html`` and ``verify.json`` into a folder that is there; the files."""
    contents = {"verify.html": to_html(report), "verify.json": to_json(report)}
    for name, text in contents.items():
        write_whole(folder / name, text)
    return [folder / name for name in contents]


def to_html(report: Report) -> str:
    """The report as a page: header, contents, a table and plots for each group."""
    facts = {
        "magwire": report.version,
        "date": report.date,
        "machine": report.machine,
        "set": "full" if report.full else "fast",
        "mesh": f"{NODES} nodes, unless a case says otherwise",
        "lines": report.verdict,
    }
    listed = "".join(f"<dt>{escape(k)}</dt><dd>{escape(v)}</dd>" for k, v in facts.items())
    passed = "pass" if report.passed else "fail"
    words = "All lines pass." if report.passed else "Not all lines pass."
    if report.passed and report.counts["skipped"]:
        words = "All lines that could be run pass."
    body = "".join(_section(group) for group in report.groups)
    return (
        '<!DOCTYPE html>\n<html lang="en"><head><meta charset="utf-8">'
        f"<title>magwire verify</title><style>{STYLE}</style></head><body>"
        f'<h1>magwire verify</h1><p class="{passed}">{words}</p><dl>{listed}</dl>'
        "<p>Each line compares a number that magwire computes with one that does not come from "
        "magwire. The error is the difference to the reference, in the unit given or, with a "
        "percent sign, relative to it. A line passes if the error is within the tolerance and "
        f"the order of convergence, where one is given, within {ORDER_TOLERANCE:g} of the one "
        "that theory has. In plots, lines are references and points are magwire.</p>"
        f"{body}</body></html>\n"
    )


def _section(group: Group) -> str:
    heads = "".join(_cell("th", name, name in NUMBERS) for name in (*HEADINGS, "verdict"))
    cases = [list(entries) for _, entries in groupby(group.entries, key=lambda e: e.case)]
    rows = "".join(_row(e, len(case) if e is case[0] else 0) for case in cases for e in case)
    plots = "".join(_image(curve) for curve in group.curves)
    return (
        f"<h2>{escape(group.title)}</h2><table><thead><tr>{heads}</tr></thead>"
        f'<tbody>{rows}</tbody></table><div class="plots">{plots}</div>'
    )


def _row(entry: Entry, rows: int) -> str:
    """A row; the case is named once for all ``rows`` that it has, in the first of them."""
    name = f'<td rowspan="{rows}">{escape(entry.case)}</td>' if rows else ""
    verdict = f'<td class="{entry.verdict}">{entry.verdict}</td>'
    if not isinstance(entry, Line):
        return (
            f'<tr>{name}<td colspan="{len(HEADINGS) - 1}">{escape(entry.reason)}</td>{verdict}</tr>'
        )
    reference, *others = numbers(entry)
    quantity = entry.quantity + (f" [{entry.unit}]" if entry.unit else "")
    cells = name + _cell("td", quantity) + _cell("td", reference, True)
    cells += f'<td class="source">{escape(entry.source)}</td>'
    cells += "".join(_cell("td", text, True) for text in others)
    return f"<tr>{cells}{verdict}</tr>"


def _cell(tag: str, text: str, number: bool = False) -> str:
    attribute = ' class="number"' if number else ""
    return f"<{tag}{attribute}>{escape(text)}</{tag}>"


def _image(curve: Curve) -> str:
    picture = base64.b64encode(_draw(curve)).decode("ascii")
    return f'<img alt="{escape(curve.title)}" src="data:image/svg+xml;base64,{picture}">'


def _draw(curve: Curve) -> bytes:
    """A curve as SVG."""
    import matplotlib as mpl
    from matplotlib.figure import Figure

    from magwire.plot import style

    colours = (*style.COMPONENTS, style.TIP, style.PASSIVE, "#cc79a7", style.INK)
    with mpl.rc_context(style.RC):
        figure = Figure(figsize=(WIDTH * style.MM, HEIGHT * style.MM), layout="constrained")
        ax = figure.subplots()
        marks: dict[str, Any] = {"line": {}, "points": {"marker": "o", "ls": "", **POINTS}}
        palettes = {how: cycle(colours) for how in marks}  # points have the colours of their lines
        for name, (x, y, how) in curve.series.items():
            ax.plot(x, y, color=next(palettes[how]), label=name, **marks[how])
        ax.set(title=curve.title, xlabel=curve.x_label, ylabel=curve.y_label)
        if curve.equal:
            ax.set_aspect("equal", adjustable="datalim")
        if len(curve.series) > 1:
            ax.legend()
        memory = io.BytesIO()
        figure.savefig(memory, format="svg", metadata={"Date": None})
    return memory.getvalue()
