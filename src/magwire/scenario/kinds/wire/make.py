"""What a length of wire is made of, as a scenario says it."""

from __future__ import annotations

from typing import Any

from pydantic import model_validator

from magwire.scenario.kind import Faults
from magwire.scenario.quantity import (
    BendingStiffness,
    Density,
    Diameter,
    DiameterOrZero,
    Length,
    LengthOrZero,
    Magnetization,
    MassPerLength,
    PoissonRatio,
    Pressure,
    Remanence,
    RestCurvature,
    RestTwist,
    StretchingStiffness,
)
from magwire.scenario.table import Table, preset
from magwire.units import show
from magwire.wire.make import Make, contradictions

NO_MAGNETIZATION = ["0 kA/m", "0 kA/m", "0 kA/m"]
STRAIGHT = ["0 1/m", "0 1/m"]


class MakeTable(Table):
    """What a length of wire is made of; ``contradictions`` says what goes together."""

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
        return Make(**{name: getattr(self, name) for name in Make.__dataclass_fields__})

    @property
    def magnet(self) -> str:
        """The key that magnetises it."""
        return "magnetization" if self.remanence is None else "remanence"

    def contradictions(self, where: str) -> Faults:
        """What is said twice or left out; ``where`` is what messages call the table."""
        given = {name for name in Make.__dataclass_fields__ if vars(self).get(name, 0) is not None}
        yield from contradictions(given, (where + ".{}").format)

    def thin_walls(self, where: str) -> Faults:
        """A hollow wire has some wall; ``where`` is what messages call the table."""
        if self.bore >= self.outer_radius:
            inner = "inner_radius" if self.inner_radius is not None else "inner_diameter"
            outer = "radius" if self.radius is not None else "diameter"
            has = self.bore if inner == "inner_radius" else self.inner_diameter
            limit = self.outer_radius if outer == "radius" else self.diameter
            yield (
                f"Input {where}.{inner} must be smaller than {where}.{outer}, "
                f"{show(limit or 0.0, 'length')}; received {show(has or 0.0, 'length')}."
            )
