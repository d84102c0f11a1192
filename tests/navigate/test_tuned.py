"""The planner's tuned numbers: the theory page says what they are."""

from __future__ import annotations

from dataclasses import fields
from pathlib import Path

import pytest

from magwire.navigate.tuned import COURSE, OUTLET, PILOT, PROGRAMME, RETRY, SPIKE, SWING

PAGE = " ".join((Path(__file__).parents[2] / "docs/theory/steering.md").read_text().split())
ALL = {
    "PILOT": PILOT,
    "PROGRAMME": PROGRAMME,
    "SWING": SWING,
    "COURSE": COURSE,
    "RETRY": RETRY,
    "SPIKE": SPIKE,
    "OUTLET": OUTLET,
}
COUNTS = {3: "three", 8: "eight", 12: "twelve"}
SENTENCES = {
    "inertia": rf"\sigma = {PILOT.inertia:g}\,L/\Delta",
    "wedged": rf"\lambda \le {PILOT.wedged:g}\,\lambda_{{\min}}",
    "firm": rf"> {PILOT.firm:g}\,\lambda_{{\min}}",
    "stiffer": f"by {100 * (PILOT.stiffer - 1):.0f} percent where the wall makes the wire stiff",
    "stiffer than lost": f"at least to {PILOT.stiffer:g} times the eigenvalue",
    "relaxing": f"falls by {100 * (1 - PILOT.relaxing):.0f} percent from one planned feed",
    "programmes": f"until the field settles, {COUNTS[PILOT.programmes]} times at most",
    "beyond": f"up to {COUNTS[PILOT.beyond]} programmes on from there",
    "tries": f"the wire fed on again, up to {COUNTS[PILOT.tries]} times",
    "missed": {0.1: "by more than a tenth of the lumen's radius"}[PILOT.missed],
    "penalty": f"($p = {PROGRAMME.penalty:g}$)",
    "off_room": f"it is {PROGRAMME.off_room:g} times as large",
    "most_room": f"at most {PROGRAMME.most_room:g} of the distance to the wall",
    "reference": rf"Fields are in units of ${COURSE.reference:g}\,EI/(|M| L^2)$",
    "ahead": f"The plan runs {COURSE.ahead:g} L ahead of the wire",
    "scout": f"until the wall holds the wire, for {COURSE.scout:g} L at most",
    "span": f"within the last {COURSE.span:g} L of the plan",
    "growth": {2.0: "the field has doubled"}[COURSE.growth],
    "support": rf"holds the wire if $\lambda > {SWING.support:g}\,\lambda_{{\min}}$",
    "length": f"The swing takes {SWING.length:g} L of feed",
    "spacing": f"of a grid with the spacing {SWING.spacing:g} R across its room",
    "lead": f"within another {SWING.lead:g} L",
    "coarse": f"of a grid with the spacing {SWING.coarse:g} R",
    "press": f"The field is {SWING.press:g} times the least one there",
    "sparse": f"with only its values every {SWING.sparse:g} L",
    "off": f"and with {SWING.off:g} of the `field_tolerance` weaker and stronger",
    "bound": f"has to stay within {SWING.bound:g} R all the way",
}


@pytest.mark.parametrize("name", SENTENCES)
def test_the_page_says_the_number(name: str) -> None:
    assert SENTENCES[name] in PAGE


@pytest.mark.parametrize("group", ALL)
def test_the_table_has_all_of_them_as_they_are(group: str) -> None:
    for one in fields(ALL[group]):
        value = getattr(ALL[group], one.name)
        values = value if isinstance(value, tuple) else (value,)
        said = ", ".join(f"{each:g}" for each in values)
        assert f"| `{group}.{one.name}` | {said} |" in PAGE
