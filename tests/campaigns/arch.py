"""Femoral access to an aortic arch as a surface, whose triangles are the wall.

    python -m campaigns.arch [CELL]

The synthetic arch becomes triangles with edges of about CELL millimetres (1.2 if left out), is read
from an STL file, entered at the descending aorta, and a wire of 1.8 mm in up to 80 mT is planned to
every outlet. Prints a row each: reached or not and why; exit status 1 if an artery of the arch is
not reached, or the other one is refused without a reason. About two minutes.
"""

from __future__ import annotations

import sys
import tempfile
from collections.abc import Iterator, Sequence
from pathlib import Path
from typing import Literal

import numpy as np

import magwire as mw
import surfaces
from magwire.cli.errand import _wire
from magwire.planning import Prospect
from magwire.vessel.synthetic import aortic_arch

WIRE = {"diameter": "1.8 mm", "magnet": None, "modulus": None, "magnetization": None}
DEMANDS = mw.Demands(max_field=80e-3)


def entered(cell: float) -> tuple[mw.Vessel, dict[str, str]]:
    """The arch from a file of triangles, and what its outlets are called in the file.

    Parameters
    ----------
    cell
        About the length of an edge [m].
    """
    arch = aortic_arch()
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / "arch.stl"
        points, triangles = surfaces.of_lumen(arch, cell)
        surfaces.write_stl(path, 1e3 * points, triangles)
        vessel = mw.Vessel.read(path, "mm", entrance=arch.entrance.tolist())
    called = {}
    for name in arch.outlets:
        end = arch.path(name).branches[0].points[-1]
        called[name] = min(vessel.ends, key=lambda e: float(np.linalg.norm(vessel.ends[e] - end)))
    return vessel, called


def plans(
    vessel: mw.Vessel, outlets: Sequence[str], wall: Literal["balls", "surface"] = "surface"
) -> Iterator[Prospect]:
    """Plans to outlets, with the triangles for a wall or with balls."""
    lumen = vessel.lumen(wall=wall)
    wire = _wire(WIRE, lumen)
    for name in outlets:
        yield from mw.plan(lumen.towards(name), wire, demands=DEMANDS, outlets=(name,))


def main() -> int:
    """Run as a script."""
    vessel, called = entered(1e-3 * float(sys.argv[1] if len(sys.argv) > 1 else 1.2))
    print(*vessel.record("surface"), sep="\n")
    wrong = set(called) - {name for name, end in called.items() if end in vessel.balls}
    names = [name for name in called if name not in wrong]
    for name, plan in zip(names, plans(vessel, [called[n] for n in names]), strict=True):
        came = f"{1e3 * plan.came:.1f} of {1e3 * plan.length:.1f} mm, fed {1e3 * plan.fed:.1f} mm"
        forces = f"tip {1e3 * plan.tip_force:.2g} mN, wall {1e3 * plan.wall_force:.2f} mN"
        print(
            f"{name}: {'reached' if plan.reached else 'not reached'}, {came}, "
            f"{1e3 * plan.peak_field:.1f} mT, {forces}, clearance {1e6 * plan.clearance:.2f} um. "
            f"{plan.reason}",
            flush=True,
        )
        if not plan.reached and (name != "ascending aorta" or not plan.reason):
            wrong.add(name)
    print(f"wrong: {', '.join(sorted(wrong)) or 'none'}")
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(main())
