"""The tables of a scenario, but for the lumen's; each knows how to build what it describes."""

from __future__ import annotations

import itertools
from typing import TYPE_CHECKING, Annotated, Any, Literal

import numpy as np
from pydantic import ConfigDict, Field, model_validator

from magwire.scenario.devices import schema as device_schema
from magwire.scenario.friction import FrictionTable
from magwire.scenario.quantity import (
    Acceleration,
    Angle,
    BendingStiffness,
    Density,
    DensityOrZero,
    Diameter,
    DiameterOrZero,
    FluxDensity,
    Force,
    Length,
    LengthOrZero,
    Magnetization,
    MassPerLength,
    Place,
    PoissonRatio,
    Pressure,
    Quantity,
    Rate,
    Remanence,
    RestCurvature,
    RestTwist,
    Row,
    Rows,
    Speed,
    StretchingStiffness,
    Time,
    Vector3,
    Whole,
    at_least_one,
)
from magwire.scenario.table import Table, preset

if TYPE_CHECKING:
    from magwire.contact import Barrier
    from magwire.engine.feed import Feed
    from magwire.field import GradientField, UniformField
    from magwire.wire import Make, Section, Wire

NO_FLUX = ["0 mT", "0 mT", "0 mT"]
NO_MAGNETIZATION = ["0 kA/m", "0 kA/m", "0 kA/m"]
STRAIGHT = ["0 1/m", "0 1/m"]


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


class MakeTable(Table):
    """What a length of wire is made of; ``checks.makes`` says what goes together."""

    length: Length
    diameter: Diameter | None = None
    radius: Length | None = None
    inner_diameter: DiameterOrZero | None = None
    inner_radius: LengthOrZero | None = None
    taper_to: Diameter | None = None
    youngs_modulus: Pressure | None = None
    shear_modulus: Pressure | None = None
    poisson_ratio: PoissonRatio | None = None
    bending_stiffness: BendingStiffness | None = None
    twisting_stiffness: BendingStiffness | None = None
    stretching_stiffness: StretchingStiffness | None = None
    density: Density | None = None
    mass_per_length: MassPerLength | None = None
    magnetization: Magnetization | None = None
    remanence: Remanence | None = None
    rest_curvature: RestCurvature = preset(STRAIGHT)
    rest_twist: RestTwist = preset("0 rad/m")

    @model_validator(mode="before")
    @classmethod
    def _fill(cls, given: Any) -> Any:
        """Solid and not magnetised, if nothing else is said."""
        if not isinstance(given, dict):
            return given
        filled = dict(given)
        if not {"inner_radius", "inner_diameter"} & set(given):
            filled["inner_radius"] = "0 mm"
        if not {"magnetization", "remanence"} & set(given):
            filled["magnetization"] = NO_MAGNETIZATION
        return filled

    @property
    def outer_radius(self) -> float:
        """Outer radius [m], at the proximal end."""
        return self.radius if self.radius is not None else 0.5 * (self.diameter or 0.0)

    @property
    def bore(self) -> float:
        """Inner radius [m]."""
        inner = self.inner_radius
        return inner if inner is not None else 0.5 * (self.inner_diameter or 0.0)

    @property
    def largest_radius(self) -> float:
        """Outer radius where it is widest [m]."""
        return max(self.outer_radius, 0.5 * (self.taper_to or 0.0))

    @property
    def magnetized(self) -> bool:
        """Whether any of it is."""
        return any((*(self.magnetization or ()), *(self.remanence or ())))

    def make(self) -> Make:
        """The same as a model."""
        from magwire.wire import Make

        return Make(**{name: getattr(self, name) for name in Make.__dataclass_fields__})


class UniformWire(MakeTable):
    """A wire of one make with, if wanted, its distal end magnetised."""

    nodes: Nodes
    magnetized_tip: LengthOrZero = preset("0 mm")

    @property
    def total_length(self) -> float:
        """Length of the wire [m]."""
        return self.length

    def build(self) -> Wire:
        """The wire as a model."""
        from magwire.wire import Wire

        return Wire.of(self.make(), self.length, self.nodes, magnetized_tip=self.magnetized_tip)


class SectionTable(MakeTable):
    """A stretch of wire of one make."""

    def build(self) -> Section:
        """The section as a model."""
        return self.make().section(self.length)


class SectionedWire(Table):
    """A wire of several sections, the proximal one first; ``device`` says where they are from."""

    model_config = ConfigDict(json_schema_extra=device_schema)

    device: str = ""
    nodes: Nodes
    sections: Annotated[tuple[SectionTable, ...], at_least_one("section")]

    @property
    def total_length(self) -> float:
        """Length of the wire [m]."""
        return sum(section.length for section in self.sections)

    @property
    def largest_radius(self) -> float:
        """Largest outer radius [m]."""
        return max(section.largest_radius for section in self.sections)

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

    stiffness: Pressure | Literal["auto"] = "auto"
    activation_gap: Length | Literal["auto"] = "auto"
    wall: Literal["surface", "centreline"] = "surface"
    friction: FrictionTable = Field(default={})  # type: ignore[assignment]

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
    tip_load: Force = preset(["0 mN", "0 mN", "0 mN"])


class OutputTable(Table):
    """What is recorded."""

    record_every: Length = preset("0.1 mm")
