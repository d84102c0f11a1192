"""The paper's cases in the fields of coils and a magnet: amperes, watts, fields, and replays.

``python -m campaigns.actuators [CASE ...]`` prints the rows of the table in docs/coils.md.
Calibration files of real systems are not part of magwire; MAGWIRE_SHARED_DATA says where they are.
"""

from __future__ import annotations

import itertools
import sys
from collections.abc import Iterator, Sequence

import numpy as np

from actuate.handed import FOLDER
from magwire import MagwireError, Result
from magwire.navigate.inputs import InputSchedule
from magwire.scenario import Scenario, inputs_of, load, parse
from magwire.scenario.columns import NamedColumns
from magwire.scenario.courses import columns_of
from magwire.scenario.schedules import replayed

CASES = ("half-circle", "sinusoid", "helix", "left-branch", "middle-branch", "right-branch")
BY_MAGNET = {
    "half-circle": [],
    "sinusoid": ["actuator.parked=['10 mm','0 mm','93 mm']"],
}
COARSE = ["output.record_every=0.5 mm"]
QUANTUM, DELAY, GAIN = 0.01, 0.05, 0.03  # [A], [s], part


def described(case: str, hardware: str, overrides: Sequence[str]) -> Scenario:
    """A case with the actuator of a scenario of the library around the middle of its way."""
    import tomli_w

    from magwire.files import parse_toml
    from magwire.scenario.reader import text_of

    raw = parse_toml(text_of(case)[0])
    raw["actuator"] = parse_toml(text_of(hardware)[0])["actuator"]
    raw["navigate"] = {"method": "stable"}
    if raw["actuator"]["kind"] != "magnet":
        way = load(case).lumen.build().path().centreline()[0]
        middle = 0.5 * (way.min(axis=0) + way.max(axis=0))
        raw["actuator"]["pose"] = {"translation": [f"{x!r} m" for x in middle.tolist()]}
    return parse(tomli_w.dumps(raw), [*COARSE, *overrides])


def row(case: str, hardware: str, result: Result) -> str:
    """A row of the table."""
    if result.status != "complete":
        return f"| `{case}` | {hardware} | {result.message} |"
    names = result.input_names
    amperes = [k for k, (_, unit) in enumerate(names) if unit == "A"]
    if amperes:
        most = np.abs(result.inputs[:, amperes]).max()
        cost = f"{most:.1f} A | {result.power.max():.0f} W | {result.power.mean():.0f} W"
    else:
        way = np.linalg.norm(np.diff(result.inputs[:, :3], axis=0), axis=1).sum()
        cost = f"{1e3 * way:.0f} mm of way | |"
    replay = replayed(result).run()
    free = "free" if replay.status == "complete" and replay.max_tip_force == 0.0 else "touches"
    return f"| `{case}` | {hardware} | {cost} | {1e3 * result.peak_field:.1f} mT | {free} |"


def disturbed(result: Result) -> Iterator[tuple[tuple[float, ...], Result]]:
    """Replays with currents in quanta, late, and off by a gain of each coil in all signs."""
    scenario = replayed(result)
    course, speed = inputs_of(result), float(result.feed[-1] / result.time[-1])
    for signs in itertools.product((-1.0, 1.0), repeat=len(course.names)):
        late = course.at(course.feed - DELAY * speed)
        made = QUANTUM * np.round(late / QUANTUM) * (1.0 + GAIN * np.array(signs))
        moved = InputSchedule(course.feed, made, course.names)
        table = NamedColumns().write(columns_of(moved))
        steered = {"navigate": {"method": "inputs", "table": table}}
        import tomli_w

        from magwire.files import parse_toml

        raw = {**parse_toml(scenario.to_toml()), **steered}
        yield signs, parse(tomli_w.dumps(raw)).run()


def main(cases: Sequence[str]) -> None:
    """Print the rows of some cases."""
    for case in cases or CASES:
        for objective in ("field", "power"):
            scenario = described(
                case, "half-circle-helmholtz", [f"navigate.objective={objective}", *STEADY]
            )
            result = scenario.run()
            print(row(case, f"Helmholtz, {objective}", result), flush=True)
        if result.status == "complete":
            pressed = [run.max_tip_force for _, run in disturbed(result)]
            print(
                f"  disturbed: {sum(f == 0.0 for f in pressed)} of {len(pressed)} free of tip "
                f"contact, at most {1e3 * max(pressed):.3g} mN",
                flush=True,
            )
        if case in BY_MAGNET:
            margin = ["navigate.stability_margin=150 1/s^2"]
            try:
                result = described(case, "half-circle-magnet", [*margin, *BY_MAGNET[case]]).run()
                print(row(case, "magnet", result), flush=True)
            except MagwireError as error:
                print(f"| `{case}` | magnet | {error} |", flush=True)
    if FOLDER.is_dir() and not cases:
        calibrated()


STEADY = ["navigate.stability_margin=10 1/s^2"]


def calibrated() -> None:
    """Navion 2 on the half-circle, and OctoMag on a sinusoid in its box."""
    navion = (
        f"actuator={{kind='mpem', calibration='{FOLDER}/navion_2_calibration.yaml', "
        f"limits='{FOLDER}/navion_2_limits.yaml', extrapolate=true, "
        "pose={translation=['12.5 mm','25 mm','0 mm']}}"
    )
    result = load("half-circle", [navion, *COARSE, *STEADY]).run()
    print(row("half-circle", "Navion 2", result), flush=True)
    for objective in ("field", "power"):
        result = load("sinusoid", [octomag(), *SMALL, f"navigate.objective={objective}"]).run()
        print(row("sinusoid / 5", f"OctoMag, {objective}", result), flush=True)


def octomag() -> str:
    """Eight coils, 20 A and an ohm each, around a small sinusoid."""
    return (
        f"actuator={{kind='mpem', calibration='{FOLDER}/octomag_calibration.yaml', "
        "max_current='20 A', resistance='1 ohm', pose={translation=['8 mm', '0 mm', '0 mm']}}"
    )


SMALL = [
    *("wire.length=20 mm", "wire.radius=0.12 mm", "wire.magnetized_tip=1 mm"),
    *("lumen.amplitude=3 mm", "lumen.period=16 mm", "lumen.length=16 mm", "lumen.radius=0.6 mm"),
    *("contact.activation_gap=0.02 mm", "feed.distance=13.6 mm", "feed.speed=0.2 mm/s"),
    *("navigate.update_every=0.1 mm", "navigate.stability_margin=250 1/s^2"),
    "output.record_every=0.1 mm",
]
"""The sinusoid at a fifth of its size, in the same fields."""

if __name__ == "__main__":
    main(sys.argv[1:])
