"""The tables of a scenario, but for the lumen's; each knows how to build what it describes."""

from __future__ import annotations

import itertools
from typing import TYPE_CHECKING, Annotated, Any, Literal

import numpy as np
from pydantic import BaseModel, ConfigDict, Field

from magwire.scenario.quantity import (
    Acceleration,
    Angle,
    Density,
    DensityOrZero,
    FluxDensity,
    Force,
    Length,
    LengthOrZero,
    Magnetization,
    Place,
    Pressure,
    Quantity,
    Rate,
    RestCurvature,
    Row,
    Rows,
    Speed,
    Time,
    Vector3,
    Whole,
    at_least_one,
)

if TYPE_CHECKING:
    from magwire.contact import Barrier
    from magwire.engine.feed import Feed
    from magwire.field import GradientField, UniformField
    from magwire.wire import Section, Wire

NO_FLUX = ["0 mT", "0 mT", "0 mT"]
NO_MAGNETIZATION = ["0 kA/m", "0 kA/m", "0 kA/m"]
STRAIGHT = ["0 1/m", "0 1/m"]


class Table(BaseModel):
    """A table of the file: keys it does not know are faults, and it does not change."""

    model_config = ConfigDict(extra="forbid", frozen=True, validate_default=True)


def preset(text: Any) -> Any:
    """A default, written as it would be in the file."""
    return Field(default=text)


Nodes = Annotated[int, Whole(4, 100_000)]
SpeedTable = Annotated[
    tuple[tuple[float, float], ...],
    Rows(Row((Quantity("time", "nonnegative"), Quantity("speed"))), least=2),
]
TwistTable = Annotated[
    tuple[tuple[float, float], ...],
    Rows(Row((Quantity("time", "nonnegative"), Quantity("angle"))), least=2),
]
FluxGradient = Annotated[
    tuple[Vector3, Vector3, Vector3],
    Rows(Row((Quantity("flux_gradient"),) * 3), least=3, most=3),
]


class UniformWire(Table):
    """A wire of one material with, if wanted, its distal end magnetised."""

    length: Length
    nodes: Nodes
    radius: Length
    inner_radius: LengthOrZero = preset("0 mm")
    youngs_modulus: Pressure
    shear_modulus: Pressure
    density: Density
    magnetized_tip: LengthOrZero = preset("0 mm")
    magnetization: Magnetization = preset(NO_MAGNETIZATION)
    rest_curvature: RestCurvature = preset(STRAIGHT)

    @property
    def total_length(self) -> float:
        """Length of the wire [m]."""
        return self.length

    @property
    def largest_radius(self) -> float:
        """Outer radius [m]."""
        return self.radius

    def build(self) -> Wire:
        """The wire as a model."""
        from magwire.wire import Wire

        return Wire.uniform(
            length=self.length,
            radius=self.radius,
            youngs_modulus=self.youngs_modulus,
            shear_modulus=self.shear_modulus,
            density=self.density,
            nodes=self.nodes,
            magnetized_tip=self.magnetized_tip,
            magnetization=self.magnetization,
            inner_radius=self.inner_radius,
            rest_curvature=self.rest_curvature,
        )


class SectionTable(Table):
    """A stretch of wire of one make."""

    length: Length
    radius: Length
    inner_radius: LengthOrZero = preset("0 mm")
    youngs_modulus: Pressure
    shear_modulus: Pressure
    density: Density
    magnetization: Magnetization = preset(NO_MAGNETIZATION)
    rest_curvature: RestCurvature = preset(STRAIGHT)

    def build(self) -> Section:
        """The section as a model."""
        from magwire.wire import Section

        return Section(
            length=self.length,
            youngs_modulus=self.youngs_modulus,
            shear_modulus=self.shear_modulus,
            radius=self.radius,
            density=self.density,
            inner_radius=self.inner_radius,
            magnetization=self.magnetization,
            rest_curvature=self.rest_curvature,
        )


class SectionedWire(Table):
    """A wire of several sections, the proximal one first."""

    nodes: Nodes
    sections: Annotated[tuple[SectionTable, ...], at_least_one("section")]

    @property
    def total_length(self) -> float:
        """Length of the wire [m]."""
        return sum(section.length for section in self.sections)

    @property
    def largest_radius(self) -> float:
        """Largest outer radius [m]."""
        return max(section.radius for section in self.sections)

    def build(self) -> Wire:
        """The wire as a model."""
        from magwire.wire import Wire

        return Wire(tuple(section.build() for section in self.sections), self.nodes)


class UniformFieldTable(Table):
    """The same flux density everywhere."""

    kind: Literal["uniform"]
    flux_density: FluxDensity = preset(NO_FLUX)

    def build(self) -> UniformField:
        """The field as a model."""
        from magwire.field import UniformField

        return UniformField(self.flux_density)


class GradientFieldTable(Table):
    """A flux density that grows linearly from a place."""

    kind: Literal["gradient"]
    flux_density: FluxDensity = preset(NO_FLUX)
    gradient: FluxGradient
    origin: Place = preset(["0 mm", "0 mm", "0 mm"])

    def build(self) -> GradientField:
        """The field as a model."""
        from magwire.field import GradientField

        return GradientField(self.flux_density, self.gradient, self.origin)


class ContactTable(Table):
    """How the wall acts on the wire."""

    stiffness: Pressure = preset("1 kPa")
    activation_gap: Length = preset("0.1 mm")
    wall: Literal["surface", "centreline"] = "surface"

    def build(self) -> Barrier:
        """The contact as a model."""
        from magwire.contact import Barrier

        return Barrier(stiffness=self.stiffness, activation_gap=self.activation_gap, wall=self.wall)


class ConstantFeed(Table):
    """Feeding at one speed."""

    speed: Speed
    distance: Length
    twist: Angle = preset("0 deg")

    @property
    def duration(self) -> float:
        """How long feeding takes [s]."""
        return self.distance / self.speed

    def build(self) -> Feed:
        """The feed as a model."""
        from magwire.engine.feed import Feed

        return Feed(speed=self.speed, distance=self.distance, twist=self.twist)


class TabledFeed(Table):
    """Feeding at a speed that is given at times, and linear between them."""

    table: SpeedTable
    twist_table: TwistTable | None = None

    @property
    def duration(self) -> float:
        """How long feeding takes [s]."""
        return self.table[-1][0]

    @property
    def extremes(self) -> tuple[float, float]:
        """Smallest and largest fed length [m]; between rows the speed is linear in time."""
        fed, seen = 0.0, [0.0]
        for (t0, v0), (t1, v1) in itertools.pairwise(self.table):
            if v0 * v1 < 0.0:
                seen.append(fed + 0.5 * v0 * (t1 - t0) * v0 / (v0 - v1))
            fed += 0.5 * (v0 + v1) * (t1 - t0)
            seen.append(fed)
        return min(seen), max(seen)

    def build(self) -> Feed:
        """The feed as a model; both tables are brought to the same times."""
        from magwire.engine.feed import Feed

        times, speeds = zip(*self.table, strict=True)
        if self.twist_table is None:
            return Feed.table(times, speeds)
        twist_times, twists = zip(*self.twist_table, strict=True)
        both = sorted({*times, *(t for t in twist_times if t <= times[-1])})
        return Feed.table(
            both,
            np.interp(both, times, speeds).tolist(),
            np.interp(both, twist_times, twists).tolist(),
        )


class SolverTable(Table):
    """How the motion is computed."""

    motion: Literal["dynamic", "quasi-static"] = "dynamic"
    time_step: Time = preset("10 ms")
    damping: Rate = preset("0.01 1/s")
    release: Literal["sliding", "node"] = "sliding"


class EnvironmentTable(Table):
    """What surrounds the wire, and what pulls at it."""

    gravity: Acceleration = preset(["0 m/s^2", "0 m/s^2", "0 m/s^2"])
    fluid_density: DensityOrZero = preset("0 kg/m^3")
    tip_force: Force = preset(["0 mN", "0 mN", "0 mN"])


class OutputTable(Table):
    """What is recorded."""

    record_every: Length = preset("0.1 mm")
