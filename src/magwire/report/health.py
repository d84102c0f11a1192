"""What magwire runs on, and whether it computes right there."""

from __future__ import annotations

import os
import platform
import sys
from collections.abc import Iterator
from dataclasses import dataclass
from math import atan2, pi
from pathlib import Path

import magwire
from magwire.results.provenance import PACKAGES, versions

COLUMN = 20
"""Width of the names."""
LENGTH, RADIUS = 0.1, 0.6e-3
"""Of the paper's wire [m]."""
FACES = ("matplotlib", "pydantic", "cyclopts", "rich", "tomli-w")
EXTRAS = {
    "bench": ("mujoco", "pyelastica"),
    "cluster": ("distributed",),
    "drive": ("websockets",),
    "export": ("mcap", "mcap-ros2-support"),
    "movie": ("imageio-ffmpeg",),
    "vessels": ("trimesh", "vmtk"),
}
"""Packages that some commands use where they are installed."""


@dataclass(frozen=True)
class Check:
    """A number that is known, next to what comes out here.

    Attributes
    ----------
    name
        What it is.
    value, reference
        What came out and what is right.
    tolerance
        How far they may be apart, over the reference.
    """

    name: str
    value: float
    reference: float
    tolerance: float

    @property
    def right(self) -> bool:
        """Whether it came out; what is not a number did not."""
        return abs(self.value - self.reference) <= self.tolerance * abs(self.reference)

    @property
    def sentence(self) -> str:
        """The verdict."""
        verdict = "right" if self.right else "WRONG"
        return f"{verdict}: {self.value:.6g}, expected {self.reference:.6g}"


def facts() -> dict[str, str]:
    """Versions, machine, cache and extras, by name."""
    found = versions((*PACKAGES, *FACES))
    python = found.pop("python")
    extras = {}
    for extra, names in EXTRAS.items():
        there = list(versions(names).items())[1:]
        extras[f"extra {extra}"] = ", ".join(f"{name} {number}" for name, number in there)
    return {
        "magwire": f"{magwire.__version__}, in {Path(magwire.__file__).parent}",
        "python": f"{python}, {sys.executable}",
        "packages": ", ".join(f"{name} {number}" for name, number in found.items()),
        **extras,
        "system": platform.platform(),
        "processor": _processor(),
        "kernels' cache": _cache(),
    }


def _processor() -> str:
    """What numba compiles for, and how many cores there are."""
    import llvmlite.binding as llvm

    return f"{llvm.get_host_cpu_name()}, {platform.machine()}, {os.cpu_count()} cores"


def _cache() -> str:
    """Where machine code is kept, and what is there."""
    from magwire.kernels._jit import CACHE, compiled_before

    if CACHE is None:
        return "none: no folder can be written to, and every process compiles"
    size = sum(file.stat().st_size for file in CACHE.rglob("*") if file.is_file())
    state = "compiled" if compiled_before() else "nothing compiled yet"
    return f"{CACHE}, {state}, {size / 1e6:.1f} MB"


def checks() -> Iterator[Check]:
    """Three numbers that are known without magwire: a bend, a sensitivity, a push."""
    yield Check("tip angle [rad]", _tip_angle(), 1.215368118, 1e-3)
    magnet, stiffness = 5e-3, 3e6 * pi * RADIUS**4 / 4.0
    moment = magnet * (LENGTH**2 - magnet**2) / 2.0 + magnet**3 / 3.0
    exact = 128e3 * pi * RADIUS**2 / stiffness * moment  # of a beam, for small bends
    yield Check("tip by field [m/T]", _by_field(magnet), exact, 1e-3)
    yield Check("push [EI/L^2]", _push(), 20.75, 0.01)


def _wire(magnet: float) -> magwire.Wire:
    return magwire.Wire.uniform(
        length=LENGTH,
        radius=RADIUS,
        youngs_modulus=3e6,
        shear_modulus=1e6,
        density=2000.0,
        nodes=101,
        magnetized_tip=magnet,
        magnetization=128e3,
    )


def _tip_angle() -> float:
    """Of a wire that is a magnet all along, in a field across of M B L^2 / EI = 5."""
    simulation = magwire.Simulation(_wire(LENGTH), magwire.Lumen.open_space())
    field = 5.0 * simulation.system.scales.flux_density
    bent = simulation.equilibrium(LENGTH, (0.0, field, 0.0))
    x, y, _ = bent.positions[-1] - bent.positions[-2]
    return atan2(y, x)


def _by_field(magnet: float) -> float:
    """Sideways motion of the tip by a field across, of a wire that is straight."""
    simulation = magwire.Simulation(_wire(magnet), magwire.Lumen.open_space())
    straight = simulation.equilibrium(LENGTH, (0.0, 0.0, 0.0))
    return float(straight.sensitivity("tip", wrt="field")[1, 1])


def _push() -> float:
    """Peak tip force, pushed through the paper's half-circle; known from hard walls."""
    steps = ("navigate.method=none", "solver.time_step=100 ms")
    result = magwire.load_scenario("half-circle", steps).run()
    return result.max_tip_force / result.force_scale
