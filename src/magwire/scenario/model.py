"""The whole scenario: what a TOML file describes, validated."""

from __future__ import annotations

from typing import TYPE_CHECKING, Annotated, Any, ClassVar

import tomli_w
from pydantic import BaseModel, Discriminator, Field, Tag

from magwire.scenario.lumens import (
    HalfCircleLumen,
    HelixLumen,
    PointsLumen,
    SinusoidLumen,
    StraightLumen,
    TreeLumen,
)
from magwire.scenario.navigators import (
    NewtonSteering,
    NoSteering,
    PaperSteering,
    ScheduledSteering,
    StableSteering,
)
from magwire.scenario.synthetic import (
    AorticArchLumen,
    CarotidBifurcationLumen,
    CoronaryTreeLumen,
    TortuousLumen,
)
from magwire.scenario.table import Table
from magwire.scenario.tables import (
    ConstantFeed,
    ContactTable,
    EnvironmentTable,
    GradientFieldTable,
    OutputTable,
    SectionedWire,
    SolverTable,
    TabledFeed,
    UniformFieldTable,
    UniformWire,
)
from magwire.scenario.vessels import VesselLumen

if TYPE_CHECKING:
    from collections.abc import Callable
    from pathlib import Path

    from magwire.engine.record import Record
    from magwire.results import Result
    from magwire.scenario.job import Job


def _which_wire(value: Any) -> str:
    given = value if isinstance(value, dict) else vars(value) if _is_model(value) else {}
    return "sections" if {"sections", "device"} & set(given) else "uniform"


def _which_feed(value: Any) -> str:
    given = value if isinstance(value, dict) else vars(value) if _is_model(value) else {}
    return "table" if "table" in given or "twist_table" in given else "constant"


def _is_model(value: object) -> bool:
    return isinstance(value, BaseModel)


Wire = Annotated[
    Annotated[UniformWire, Tag("uniform")] | Annotated[SectionedWire, Tag("sections")],
    Discriminator(_which_wire),
]
Lumen = Annotated[
    StraightLumen
    | HalfCircleLumen
    | SinusoidLumen
    | HelixLumen
    | TreeLumen
    | AorticArchLumen
    | CarotidBifurcationLumen
    | CoronaryTreeLumen
    | TortuousLumen
    | PointsLumen
    | VesselLumen,
    Field(discriminator="shape"),
]
FieldOfTheMagnet = Annotated[UniformFieldTable | GradientFieldTable, Field(discriminator="kind")]
Feed = Annotated[
    Annotated[ConstantFeed, Tag("constant")] | Annotated[TabledFeed, Tag("table")],
    Discriminator(_which_feed),
]
Navigate = Annotated[
    NoSteering | StableSteering | NewtonSteering | PaperSteering | ScheduledSteering,
    Field(discriminator="method"),
]

CHOICES: dict[str, tuple[str, dict[str, type[Table]]]] = {
    "wire": ("", {"uniform": UniformWire, "sections": SectionedWire}),
    "lumen": (
        "shape",
        {
            "straight": StraightLumen,
            "half-circle": HalfCircleLumen,
            "sinusoid": SinusoidLumen,
            "helix": HelixLumen,
            "tree": TreeLumen,
            "aortic-arch": AorticArchLumen,
            "carotid-bifurcation": CarotidBifurcationLumen,
            "coronary-tree": CoronaryTreeLumen,
            "tortuous": TortuousLumen,
            "points": PointsLumen,
            "vessel": VesselLumen,
        },
    ),
    "field": ("kind", {"uniform": UniformFieldTable, "gradient": GradientFieldTable}),
    "feed": ("", {"constant": ConstantFeed, "table": TabledFeed}),
    "navigate": (
        "method",
        {
            "none": NoSteering,
            "stable": StableSteering,
            "newton": NewtonSteering,
            "paper": PaperSteering,
            "schedule": ScheduledSteering,
        },
    ),
}
"""Tables that come in several makes: the key that tells which ("" if the others tell)."""


class Scenario(Table):
    """A run, described completely.

    Every quantity is in SI; the file and ``to_toml`` have units. Get one with
    ``magwire.load_scenario``.
    """

    notes: ClassVar[tuple[str, ...]] = ()
    """What was done to the vessel's file that it was read from, a sentence each."""

    title: str = ""
    description: str = ""
    wire: Wire
    lumen: Lumen
    field: FieldOfTheMagnet = Field(default={"kind": "uniform"})  # type: ignore[assignment]
    contact: ContactTable = Field(default={})  # type: ignore[assignment]
    feed: Feed
    navigate: Navigate = Field(default={"method": "none"})  # type: ignore[assignment]
    solver: SolverTable = Field(default={})  # type: ignore[assignment]
    environment: EnvironmentTable = Field(default={})  # type: ignore[assignment]
    output: OutputTable = Field(default={})  # type: ignore[assignment]

    def to_toml(self) -> str:
        """The scenario as TOML: complete, with every default written out, and re-runnable."""
        tables = _lists(self.model_dump(exclude_none=True))
        for name, (selector, _) in CHOICES.items():
            if selector:  # what a table is comes first in it
                tables[name] = {selector: tables[name][selector], **tables[name]}
        return tomli_w.dumps(tables)

    def with_notes(self, notes: tuple[str, ...]) -> Scenario:
        """The scenario with a record of what it was read from, which is no part of it."""
        object.__setattr__(self, "notes", notes)
        return self

    def unsteered(self) -> Scenario:
        """The same scenario with nobody steering."""
        return self.model_copy(update={"navigate": NoSteering(method="none")})

    def build(self) -> Job:
        """The simulation, the feed and the settings of the run.

        Raises
        ------
        ScenarioError
            If a model refuses what the scenario describes.
        """
        from magwire.scenario.job import Job

        return Job.of(self)

    def run(
        self, out: Path | None = None, *, watch: Callable[[Record], None] | None = None
    ) -> Result:
        """Build it and run it.

        Parameters
        ----------
        out
            NetCDF file to write as the run goes; none if left out.
        watch
            Called with every record.

        Raises
        ------
        ScenarioError
            If a model refuses what the scenario describes.
        """
        return self.build().run(out, watch=watch)


def _lists(value: Any) -> Any:
    """The same with lists in place of tuples, as TOML has them."""
    if isinstance(value, dict):
        return {key: _lists(entry) for key, entry in value.items()}
    if isinstance(value, (list, tuple)):
        return [_lists(entry) for entry in value]
    return value
