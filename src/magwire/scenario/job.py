"""A scenario turned into models, ready to run."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING

from magwire.errors import InputError, ScenarioError
from magwire.scenario.kind import refusals
from magwire.simulation import Simulation

if TYPE_CHECKING:
    from magwire.actuate import Hardware
    from magwire.engine.feed import Feed
    from magwire.engine.record import Record
    from magwire.results import Result
    from magwire.scenario.model import Scenario


@dataclass(frozen=True)
class Job:
    """What a scenario asks for.

    Attributes
    ----------
    scenario
        Where it comes from.
    simulation
        Wire, lumen, field, contact and surroundings.
    feed
        How the wire is fed.
    time_step
        [s].
    record_every
        Fed length between two records [m].
    """

    scenario: Scenario
    simulation: Simulation
    feed: Feed
    time_step: float
    record_every: float

    @classmethod
    def of(cls, scenario: Scenario) -> Job:
        """Build the models.

        Raises
        ------
        ScenarioError
            If a model refuses what the scenario describes.
        """
        tables = ("wire", "lumen", "field", "contact", "feed")
        wall, table = scenario.contact, scenario.actuator
        faults = [text for name in tables for text in refusals(name, getattr(scenario, name).build)]
        faults += refusals("contact.friction", wall.friction.build)
        faults += refusals("actuator", table.build) if table is not None else ()
        for name in ("breathing", "pulsation"):
            motion = getattr(wall, name)
            if motion is not None:
                faults += refusals(f"contact.{name}", motion.build)
        if not faults:
            sections = len(scenario.wire.build().sections)
            faults += refusals(
                "contact.friction", lambda: wall.friction.build().of_sections(sections)
            )
        if faults:
            raise ScenarioError(faults)
        actuator = None if table is None else table.build()
        try:
            simulation = Simulation(
                scenario.wire.build(),
                scenario.lumen.build(),
                field=scenario.field.build(),
                actuator=actuator,
                contact=wall.build(),
                friction=wall.friction.build(),
                wall_motion=wall.motion(),
                damping=scenario.solver.damping,
                gravity=scenario.environment.gravity,
                fluid_density=scenario.environment.fluid_density,
                tip_load=scenario.environment.tip_load,
                release=scenario.solver.release,
            )
            feed = scenario.feed.build()
        except InputError as error:
            raise ScenarioError(str(error)) from error
        faults = list(refusals("navigate", lambda: scenario.navigate.build(simulation)))
        if faults:
            raise ScenarioError(faults)
        return cls(
            scenario=scenario,
            simulation=simulation,
            feed=feed,
            time_step=scenario.solver.time_step,
            record_every=scenario.output.record_every,
        )

    def run(
        self,
        out: Path | None = None,
        *,
        watch: Callable[[Record], None] | None = None,
        hardware: Hardware | None = None,
    ) -> Result:
        """Run it.

        Parameters
        ----------
        out
            NetCDF file to write as the run goes; none if left out.
        watch
            Called with every record.
        hardware
            How the actuator departs from its model; see ``Simulation.run``.
        """
        navigate = self.scenario.navigate
        return self.simulation.run(
            self.feed,
            navigate.build(self.simulation),
            motion=self.scenario.solver.motion,
            update_every=navigate.interval,
            time_step=self.time_step,
            record_every=self.record_every,
            out=out,
            scenario=self.scenario.to_toml(),
            hardware=hardware,
            watch=watch,
        )
