"""What half and twice of every tuned number do: python -m campaigns.planner_numbers [NAME ...].

Prints, for each number, peak fields in EI/(M L^2) of plans through ready lumens, and where the tip
touches on replays with inertia, as planned and 3 percent off; "no" where there is no plan. Of
numbers of a plan to outlets, peak fields in mT in the coronary tree of the examples.
"""

from __future__ import annotations

import sys
from collections.abc import Iterator
from dataclasses import fields, replace
from functools import cache
from pathlib import Path

import numpy as np

import magwire as mw
from magwire.cli.errand import _wire
from magwire.navigate import NavigationError, tuned
from magwire.navigate.stable import StableNavigator
from navigate.test_stable import observation, replay
from wires import paper_wire, simulation

PLANAR = ("half-circle", "sinusoid")
CASES = {
    "PILOT": PLANAR,
    "PROGRAMME": PLANAR,
    "COURSE": PLANAR,
    "SWING": ("helix",),
    "OUTLET": ("end-2", "end-3"),
}
CORONARY = Path(__file__).parents[2] / "examples/data/coronary_lca_centerlines_multimoda.vtp"
WHOLE = {"programmes", "halvings", "beyond", "tries", "halves", "stride"}


def changed(name: str, value: float) -> Iterator[tuple[float, object]]:
    """A number's half and its double, and the group with each."""
    group = getattr(tuned, name.split(".", maxsplit=1)[0])
    for factor in (0.5, 2.0):
        other = factor * value
        if name.split(".")[1] in WHOLE:
            other = max(1, round(other))
        yield other, replace(group, **{name.split(".")[1]: other})


@cache
def tree() -> tuple[mw.Lumen, mw.Wire]:
    """The coronary tree from its left main artery, and the wire that ``plan`` makes for it."""
    lumen = mw.Vessel.read(CORONARY, "mm", entrance=(19.2e-3, -188.6e-3, 1751.9e-3)).lumen()
    words = {"diameter": "0.6 mm", "magnet": None, "modulus": None, "magnetization": None}
    return lumen, _wire(words, lumen)


def outlet(name: str) -> str:
    """Peak field on the way to an outlet."""
    (prospect,) = mw.plan(*tree(), outlets=(name,))
    touch = " (touches)" if prospect.tip_force > 0.0 else ""
    return f"{1e3 * prospect.peak_field:.3g}{touch}" if prospect.reached else "no"


def answer(case: str) -> str:
    """Peak of a plan, and how its replays go."""
    if case.startswith("end-"):
        return outlet(case)
    system = simulation(case, paper_wire()).system
    try:
        course = StableNavigator(system).plan(observation(0.0), 0.072)
    except NavigationError:
        return "no"
    peak = np.linalg.norm(course.flux_density, axis=1).max() / system.scales.flux_density
    touched = [
        scale
        for scale in (1.0, 0.97, 1.03)
        if replay(case, course.scaled(scale)).max_tip_force != 0.0
    ]
    return f"{peak:.1f}" + (f" (touches at {', '.join(map(str, touched))})" if touched else "")


def main(names: list[str]) -> None:
    """Print a row of the table for each number."""
    for group, cases in CASES.items():
        kept = getattr(tuned, group)
        for one in fields(kept):
            if isinstance(getattr(kept, one.name), tuple):
                continue
            name = f"{group}.{one.name}"
            if names and name not in names and group not in names:
                continue
            cells = []
            for _, other in changed(name, getattr(kept, one.name)):
                setattr(tuned, group, other)
                cells.append(", ".join(answer(case) for case in cases))
                setattr(tuned, group, kept)
            print(f"| `{name}` | {getattr(kept, one.name):g} | {' | '.join(cells)} |", flush=True)


if __name__ == "__main__":
    main(sys.argv[1:])
