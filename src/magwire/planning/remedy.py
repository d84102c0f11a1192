"""What to do about a wire that does not get on."""

from __future__ import annotations

import numpy as np

from magwire.engine.system import System

WIDE = 10.0  # lumen's radius over the wire's, in which a wire has nothing to lean on
MOUTH = 0.5  # of that lumen's radius: from there down it counts as narrow


def remedy(system: System, came: float) -> str:
    """What to do about a wire that stopped in a wide vessel before a narrow one; "" elsewhere.

    Parameters
    ----------
    system
        Wire and lumen.
    came
        How far along the path the tip came [m].
    """
    way = system.path.branches[0]
    knots = way.curve.knots()
    radii = way.curve.at(knots)[:, 3]
    here = float(np.interp(came, knots, radii))
    ahead = np.flatnonzero((knots > came) & (radii < MOUTH * here))
    if here < WIDE * system.wire.radius or len(ahead) == 0:
        return ""
    mouth = float(knots[ahead[0]])
    x, y, z = 1e3 * way.curve.at(knots[ahead[:1]])[0, :3]
    return (
        f"There the lumen is {2e3 * here:.3g} mm wide, {1e3 * (mouth - came):.3g} mm before it "
        "narrows to half of that, and the wire has nothing to lean on: enter where it narrows, "
        f'with the entrance "{x:.1f} mm, {y:.1f} mm, {z:.1f} mm", or use a stiffer wire.'
    )
