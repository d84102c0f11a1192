"""The shipped scenarios, and plans of vessels' files: is every point of every edge inside the wall?

    python -m campaigns.inside [FILE ...]

Every scenario of the library runs as it is and without a field, and for every outlet of the files
(in millimetres, unless they say) a plan is made and replayed. The depth of 25 points on every edge
is taken with the routine of ``random_setups``, not with magwire's. Exit status 1 if one is outside.
"""

from __future__ import annotations

import sys
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import magwire as mw
from campaigns.random_setups import deepest
from magwire.scenario import names

WIRE = 0.45e-3


def scenarios() -> Iterator[tuple[str, mw.Simulation, mw.Result]]:
    """Runs of the library."""
    for name in names():
        for settings in ((), ("navigate.method=none",)):
            scenario = mw.load_scenario(name, settings)
            if scenario.navigate.method == "none" and not settings:
                continue  # it is not steered, and comes with the others
            label = f"{name}, {scenario.navigate.method}"
            yield label, scenario.build().simulation, scenario.run()


def replays(file: Path) -> Iterator[tuple[str, mw.Simulation, mw.Result]]:
    """Replays with inertia of what is planned for a file's outlets."""
    kept: list[tuple[mw.Simulation, mw.Result]] = []
    run = mw.Simulation.run

    def watched(self: mw.Simulation, *args: Any, **options: Any) -> mw.Result:
        result = run(self, *args, **options)
        if result.motion != "quasi-static":
            kept.append((self, result))
        return result

    mw.Simulation.run = watched  # type: ignore[method-assign]
    try:
        lumen = mw.Lumen.read(file, units="mm")
        radius = min(WIRE, 0.4 * min(b.radius.min() for b in lumen.branches))
        wire = mw.Wire.uniform(
            0.1, radius, 3e6, 1e6, 2000.0, 201,
            magnetized_tip=10.0 * radius, magnetization=128e3,
        )  # fmt: skip
        prospects = mw.plan(lumen, wire)
    finally:
        mw.Simulation.run = run  # type: ignore[method-assign]
    for prospect, (simulation, result) in zip(prospects, kept, strict=False):
        label = f"{file.name}, {prospect.outlet}, {'' if prospect.reached else 'not '}reached"
        yield label, simulation, result


def main() -> int:
    """Run as a script."""
    wrong = 0
    for runs in (scenarios(), *(replays(Path(name)) for name in sys.argv[1:])):
        for label, simulation, result in runs:
            outside = deepest(simulation, result)
            false = outside > 0.0 and result.status == "complete"
            wrong += outside > 0.0
            sys.stdout.write(
                f"{label:44}{result.status:16}{1e6 * result.smallest_clearance:10.3f} um"
                f"{outside:12.3g} R outside{', AND SAYS IT IS COMPLETE' if false else ''}\n"
            )
            sys.stdout.flush()
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(main())
