"""A simulation and an equilibrium in a few lines."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

import numpy as np

from magwire.units import show

if TYPE_CHECKING:
    from magwire.engine.statics import Equilibrium
    from magwire.engine.system import System


def system_words(system: System, name: str) -> str:
    """What is simulated: wire, lumen, and what acts on the wire.

    Parameters
    ----------
    system
        What is simulated.
    name
        What the whole is called.
    """
    acting = [f"damping {show(system.damping, 'rate')}"]
    if any(system.gravity):
        acting.append(f"gravity {show(math.hypot(*system.gravity), 'acceleration')}")
    if any(system.tip_load):
        acting.append(f"tip load {show(math.hypot(*system.tip_load), 'force')}")
    if system.friction is not None:
        acting.append(repr(system.friction))
    acting += [repr(one) for one in system.wall_motion]
    wire = repr(system.wire).replace("\n", "\n  ")
    return "\n".join(
        [
            f"{name} of",
            f"  {wire}",
            f"  {system.lumen!r}",
            f"  {system.contact!r}",
            f"  background {system.background!r}",
            f"  inputs {', '.join(f'{name} [{unit}]' for name, unit in system.input_names)}",
            f"  {', '.join(acting)}",
        ]
    )


def equilibrium_words(state: Equilibrium) -> str:
    """Where the wire is, whether it stays there, and what the wall does to it."""
    x, y, z = (1e3 * state.tip).tolist()
    clearance = state.clearance[np.isfinite(state.clearance)]
    least = show(float(clearance.min()), "length") if len(clearance) else "none to tell"
    force = float(np.linalg.norm(state.wall_force, axis=1).sum())
    kind = "stable" if state.stable else "unstable"
    return (
        f"<Equilibrium: {kind}, {show(state.feed, 'length')} inserted, tip at "
        f"({x:.4g}, {y:.4g}, {z:.4g}) mm, smallest clearance {least}, force of the wall "
        f"{show(force, 'force')} on the wire and {show(state.tip_force, 'force')} on the tip>"
    )
