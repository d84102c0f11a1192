"""What friction takes, and how far the tip turns behind the guide (P-30)."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from magwire.plot import style
from magwire.plot.curves import PUSH_LABEL

if TYPE_CHECKING:
    import xarray as xr
    from matplotlib.axes import Axes

TURNED = 1e-3
"""Twist of the guide from which on a wire counts as turned [rad]."""


def rubs(data: xr.Dataset) -> bool:
    """Whether friction took anything."""
    return "friction_work" in data and bool(np.any(data["friction_work"].values > 0.0))


def turned(data: xr.Dataset) -> bool:
    """Whether the guide turned the wire on its way."""
    if "guide_twist" not in data or not data.sizes["time"]:
        return False
    return bool(np.ptp(data["guide_twist"].values) > TURNED)


def draw_friction(ax: Axes, data: xr.Dataset) -> None:
    """Friction on the wire and the work that it took, over push."""
    push = data["normalized_push"].values
    sizes: NDArray[np.float64] = np.linalg.norm(data["friction_force"].values, axis=2).sum(axis=1)
    ax.plot(push, 1e3 * sizes, color=style.CLEARANCE, linewidth=1.3)
    ax.set_xlabel(PUSH_LABEL)
    ax.set_ylabel("friction [mN]", color=style.CLEARANCE)
    ax.set_ylim(0.0, 1.08 * float(1e3 * sizes.max(initial=0.0)) or 1.0)
    other = ax.twinx()
    other.plot(push, 1e6 * data["friction_work"].values, color=style.COMPONENTS[2], linewidth=1.1)
    other.set_ylabel("work of friction [µJ]", color=style.COMPONENTS[2])
    other.set_ylim(bottom=0.0)
    other.grid(visible=False)


def draw_slip(ax: Axes, data: xr.Dataset) -> None:
    """Twist of guide and tip over push if the guide turned; how far the tip slid if it did not."""
    push = data["normalized_push"].values
    ax.set_xlabel(PUSH_LABEL)
    if turned(data):
        for name, label, colour in (
            ("guide_twist", "guide", style.MUTED),
            ("tip_twist", "tip", style.TIP),
        ):
            ax.plot(push, np.degrees(data[name].values), color=colour, linewidth=1.3, label=label)
        ax.set_ylabel("twist [deg]")
        ax.legend(loc="best")
        return
    slip = 1e3 * data["slip"].values
    ax.plot(push, slip.max(axis=1), color=style.CLEARANCE, linewidth=1.3, label="farthest")
    ax.plot(push, slip[:, -1], color=style.TIP, linewidth=1.1, label="tip")
    ax.set_ylabel("slid on the wall [mm]")
    ax.legend(loc="upper left")
