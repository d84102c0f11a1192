"""The options of commands that have to do with a laboratory's hardware."""

from __future__ import annotations

from dataclasses import dataclass, fields
from typing import TYPE_CHECKING, Annotated

from cyclopts import Parameter

from magwire.cli.options import Flag
from magwire.cli.reading import Points, triple
from magwire.cli.words import CommandError
from magwire.units import parse

if TYPE_CHECKING:
    from magwire.actuate import Actuator, Advancer, Hardware, Timetable
    from magwire.results import Result

RATE = 50.0

Numbers = Annotated[tuple[float, ...], Parameter(consume_multiple=True, negative="")]


@Parameter(name="*")
@dataclass(frozen=True)
class Playing:
    """How a schedule of inputs is made.

    Parameters
    ----------
    rate
        Samples per second, for --to inputs; 50 if left out.
    actuator
        TOML file, or scenario of the library, with the actuator, for --to inputs; that of the
        result's scenario if left out.
    resolution
        Feed of one step of the advancer's stepper, such as "5 um"; no steps are written without it.
    backlash
        Play of the advancer where it turns round, such as "50 um".
    max_speed
        Largest speed of the advancer, such as "5 mm/s".
    """

    rate: float | None = None
    actuator: str | None = None
    resolution: str | None = None
    backlash: str | None = None
    max_speed: str | None = None

    def refuse_any(self) -> None:
        """Refuse what is given, where no schedule is made."""
        for one in fields(self):
            value = getattr(self, one.name)
            if value is not None:
                name = one.name.replace("_", "-")
                raise CommandError(f"Option --{name} is for --to inputs; received {str(value)!r}.")

    def advancer(self) -> Advancer | None:
        """The stepper; None if its resolution is not given."""
        from magwire.actuate import Advancer

        if self.resolution is None:
            for name, value in (("backlash", self.backlash), ("max-speed", self.max_speed)):
                if value is not None:
                    raise CommandError(
                        f"Option --{name} needs --resolution, the feed of one step of the "
                        "advancer; received none."
                    )
            return None
        return Advancer(
            parse(self.resolution, "length", "--resolution"),
            0.0 if self.backlash is None else parse(self.backlash, "length", "--backlash"),
            float("inf")
            if self.max_speed is None
            else parse(self.max_speed, "speed", "--max-speed"),
        )


ALONE = Playing()
"""Nothing given."""


@Parameter(name="*")
@dataclass(frozen=True)
class Departures:
    """How the hardware departs from the actuator of the scenario.

    Parameters
    ----------
    quantum
        Least difference between two settings of an input, such as "10 mA".
    delay
        From a command to the answer, such as "50 ms".
    gain_error
        By which part each input is too large, such as 0.03 -0.03 0.03; one for each, or for all.
    tilt
        Turn of the field of each input about the actuator's origin, such as "1 deg, 0 deg, 0 deg";
        once for each.
    ramps
        Let inputs change no faster than slew, inductance and supply allow; so they do, too, with
        any other of these options.
    """

    quantum: str | None = None
    delay: str | None = None
    gain_error: Numbers = ()
    tilt: Points = ()
    ramps: Flag = False

    def hardware(self, actuator: Actuator | None) -> Hardware | None:
        """The hardware; None if nothing is said of it.

        Parameters
        ----------
        actuator
            What the options are about.
        """
        from magwire.actuate import Hardware

        if self == EXACT:
            return None
        if actuator is None:
            raise CommandError(
                "Options on the hardware need a scenario with an [actuator]; received one without."
            )
        made = Hardware(
            quantum=0.0 if self.quantum is None else _quantum(self.quantum, actuator),
            delay=0.0 if self.delay is None else parse(self.delay, "time", "--delay"),
            gain_errors=self.gain_error,
            tilts=tuple(_vector(triple(text, "angle", "--tilt")) for text in self.tilt),
        )
        made.built(actuator)  # refuses a number of errors that is not the inputs'
        return made


EXACT = Departures()
"""Hardware that does what its model does."""


def _quantum(text: str, actuator: Actuator) -> float:
    units = {one.unit for one in actuator.inputs}
    kinds = {"A": "current", "T": "flux_density", "T/m": "flux_gradient"}
    if len(units) != 1 or not units <= kinds.keys():
        raise CommandError(
            "Option --quantum is for inputs that are all currents or all fields; received one for "
            f"inputs {', '.join(one.name for one in actuator.inputs)}."
        )
    return parse(text, kinds[units.pop()], "--quantum")


def _vector(values: list[float]) -> tuple[float, float, float]:
    x, y, z = values
    return x, y, z


def played(result: Result, playing: Playing) -> Timetable:
    """The timetable of a result."""
    from magwire.actuate import Uniform, retime
    from magwire.errors import InputError
    from magwire.export import plan_of
    from magwire.scenario import load_actuator
    from magwire.scenario.reader import parse as scenario_of

    advancer, actuator, background = playing.advancer(), None, None
    if result.scenario:
        described = scenario_of(result.scenario, source="of the result")
        own = described.actuator
        actuator = Uniform() if own is None else own.build()
        background = described.field.build().at(result.position[:, -1])[0]
    if playing.actuator is not None:
        actuator = load_actuator(playing.actuator)
    if actuator is None:
        raise InputError(
            "The result is of a run that was set up in Python: option --actuator must name a file "
            "with its actuator; received none."
        )
    rate = RATE if playing.rate is None else playing.rate
    return retime(plan_of(result.dataset, background), actuator, rate=rate, advancer=advancer)
