"""The paper's cases in the fields of coils and a magnet: amperes, watts, fields, and replays.

``python -m campaigns.actuators [--rows FILE] [CASE ...]`` writes the table of docs/coils.md anew:
rows of the cases that are named, or of all. Rows go into the file as they are made, and those that
are in it already are taken from there: a run that was ended goes on so. Calibration files of real
systems are not part of magwire; MAGWIRE_SHARED_DATA says where they are.
"""

from __future__ import annotations

import argparse
import re
from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
import tomli_w

from actuate.handed import FOLDER
from magwire import MagwireError, Result
from magwire.actuate import Actuator
from magwire.files import parse_toml
from magwire.navigate.least_cost import prices_of
from magwire.navigate.schedule import last_tries
from magwire.scenario import load, parse
from magwire.scenario.reader import text_of
from magwire.scenario.replays import replayed

PAGE = Path(__file__).parents[2] / "docs/coils.md"
HEAD = (
    "| case | actuator | margin | largest current | peak power | mean power | peak field | "
    "torque alone | replay |\n| --- | --- | --- | --- | --- | --- | --- | --- | --- |\n"
)
CASES = ("half-circle", "sinusoid", "helix", "left-branch", "middle-branch", "right-branch")
MARGINS = (20.0, 50.0, 120.0)  # tried one after the other [rad^2/s^2]; for a case at full size
TOLERANCE = 0.03  # of the gains
DISTANCES = (60.0, 50.0)  # that a magnet keeps from the vessel [mm]
LENGTHS = re.compile(r"^(\S+) (mm|mm/s|1/m)$")


@dataclass(frozen=True)
class Rig:
    """An actuator around a case.

    Attributes
    ----------
    name
        As in the table.
    table
        Of the scenario.
    part
        Size of the case, over the paper's.
    centre
        Where in the actuator's own axes the middle of the way is to be [mm].
    """

    name: str
    table: Mapping[str, Any]
    part: float = 1.0
    centre: tuple[float, float, float] = (0.0, 0.0, 0.0)


def helmholtz() -> Rig:
    """The coils of half-circle-helmholtz, with supplies that hold the helix, too."""
    table = parse_toml(text_of("half-circle-helmholtz")[0])["actuator"]
    for pair in table["pairs"]:
        pair.update(max_current="48 A", supply="200 V")
    return Rig("Helmholtz", {**table, "max_power": "10 kW"})


def rigs() -> list[Rig]:
    """All of coils."""
    omnimagnet = {
        "kind": "omnimagnet",
        "moments": ["200 A m^2"] * 3,
        "position": ["0 mm", "0 mm", "-200 mm"],
        "max_current": "20 A",
        "resistance": "1 ohm",
    }
    octomag = {
        "kind": "mpem",
        "calibration": f"{FOLDER}/octomag_calibration.yaml",
        "max_current": "20 A",
        "resistance": "1 ohm",
    }
    cardiomag = {
        "kind": "mpem",
        "calibration": f"{FOLDER}/cardiomag_2019_calibration.yaml",
        "saturation": f"{FOLDER}/cardiomag_2019_saturation.yaml",
        "max_current": "35 A",
        "resistance": "1 ohm",
    }
    navion = {
        "kind": "mpem",
        "calibration": f"{FOLDER}/navion_2_calibration.yaml",
        "limits": f"{FOLDER}/navion_2_limits.yaml",
        "extrapolate": True,
    }
    found = [helmholtz(), Rig("Omnimagnet, case / 5", omnimagnet, 0.2)]
    if FOLDER.is_dir():
        found += [
            Rig("OctoMag, case / 5", octomag, 0.2),
            Rig("CardioMag", cardiomag, 1.0, (0.0, 21.0, 120.0)),
            Rig("Navion 2", navion),
        ]
    return found


def scaled(value: Any, part: float) -> Any:
    """A table with all of its lengths and speeds times a factor, and curvatures over it."""
    if isinstance(value, dict):
        return {key: scaled(each, part) for key, each in value.items()}
    if isinstance(value, list):
        return [scaled(each, part) for each in value]
    found = LENGTHS.match(value) if isinstance(value, str) else None
    if found is None:
        return value
    number, unit = float(found[1]), found[2]
    return f"{number / part if unit == '1/m' else number * part!r} {unit}"


def steered(case: str, rig: Rig, objective: str, margin: float) -> Result:
    """A case at a rig's size, steered by its inputs."""
    raw = {
        key: scaled(value, rig.part) if key in ("wire", "lumen", "contact", "feed") else value
        for key, value in parse_toml(text_of(case)[0]).items()
    }
    way = rig.part * load(case).lumen.build().path().centreline()[0]
    middle = 1e3 * 0.5 * (way.min(axis=0) + way.max(axis=0)) - np.array(rig.centre)
    pose = {"translation": [f"{x!r} mm" for x in middle.tolist()]}
    raw["actuator"] = {**rig.table, "pose": pose}
    raw["navigate"] = {
        "method": "stable",
        "stability_margin": f"{margin / rig.part**2!r} 1/s^2",
        "gain_tolerance": TOLERANCE,
        "objective": objective,
        "update_every": f"{rig.part!r} mm",
    }
    raw["solver"]["time_step"] = "20 ms"
    raw["output"] = {"record_every": f"{0.5 * rig.part!r} mm"}
    return parse(tomli_w.dumps(raw)).run()


def by_magnet(case: str, distance: float, margin: float) -> Result:
    """A case steered by the magnet of half-circle-magnet, at least so far [mm] from the vessel."""
    raw = parse_toml(text_of(case)[0])
    magnet = parse_toml(text_of("half-circle-magnet")[0])["actuator"]
    raw["actuator"] = {**magnet, "keep_out": f"{distance!r} mm"}
    raw["navigate"] = {"method": "stable", "stability_margin": f"{margin!r} 1/s^2"}
    raw["solver"]["time_step"] = "50 ms"
    raw["feed"]["speed"] = "2 mm/s"
    raw["output"] = {"record_every": "0.5 mm"}
    return parse(tomli_w.dumps(raw)).run()


def torque_alone(result: Result, actuator: Actuator) -> float:
    """Part of the field's energy that is saved where only its torque on the magnet is made.

    The flux density along the tip is free then, without regard to stability: a bound.
    """
    inverse = 1.0 / prices_of(actuator.inputs)
    spent = saved = 0.0
    for wire, flux in zip(result.position, result.field, strict=True):
        tip = wire[-1]
        along = tip - wire[-2]
        along = along / np.linalg.norm(along)
        _, _, rows = np.linalg.svd(along[None])
        made = actuator.response(tip[None], actuator.idle)[0][0].T
        by_flux = (made * inverse) @ made.T
        across = rows[1:]
        field = float(flux @ np.linalg.solve(by_flux, flux))
        torque = across @ flux
        spent += field
        saved += field - float(torque @ np.linalg.solve(across @ by_flux @ across.T, torque))
    return saved / spent


def stays_free(result: Result) -> str:
    """What a replay shows."""
    replay = replayed(result).run()
    done = replay.status == "complete" and replay.max_tip_force == 0.0
    return "free" if done else f"touches, {1e6 * replay.max_tip_force:.2g} µN"


def brief(why: str) -> str:
    """The first sentence of a refusal, without advice."""
    said = why.splitlines()[0].split(" It was tried again")[0]
    return said.split("; ask for")[0].replace(
        ": its gradient pulls, or the wire is about to buckle", ""
    )


def row(case: str, rig: Rig) -> str:
    """A row: of the planned field and, after an arrow, of the currents of least power."""
    refused = ""
    for margin in MARGINS:
        try:
            field, power = (steered(case, rig, which, margin) for which in ("field", "power"))
        except MagwireError as error:
            return f"| {case} | {rig.name} | | {error} | | | | | |"
        said = [result.message for result in (field, power) if result.status != "complete"]
        if not said:
            break
        refused = min(refused or said[-1], *said, key=lambda why: "at its limit" not in why)
    else:
        return f"| {case} | {rig.name} | all | {brief(refused)} | | | | | |"

    def cell(of: Any, digits: str, unit: str) -> str:
        return f"{of(field):{digits}} → {of(power):{digits}} {unit}"

    actuator = replayed(power).actuator.build()
    return " | ".join(
        [
            f"| {case} | {rig.name} | {margin:g}",
            cell(lambda result: np.abs(result.inputs).max(), ".1f", "A"),
            cell(lambda result: result.power.max(), ".1f", "W"),
            cell(lambda result: result.power[last_tries(result.feed)].mean(), ".1f", "W"),
            cell(lambda result: 1e3 * result.peak_field, ".1f", "mT"),
            f"{-100.0 * torque_alone(power, actuator):.0f} %",
            f"{stays_free(field)} → {stays_free(power)} |",
        ]
    )


def magnet_row(case: str, name: str, distance: float) -> str:
    """A row of the magnet on an arm."""
    refused = ""
    for margin in MARGINS:
        try:
            result = by_magnet(case, distance, margin)
        except MagwireError as error:
            return f"| {case} | {name} | | {error} | | | | | |"
        if result.status == "complete":
            break
        refused = refused or result.message
    else:
        return f"| {case} | {name} | all | {brief(refused)} | | | | | |"
    way = 1e3 * np.linalg.norm(np.diff(result.inputs[:, :3], axis=0), axis=1).sum()
    peak = 1e3 * result.peak_field
    said = f"{way:.0f} mm of way | | | {peak:.1f} mT | | {stays_free(result)}"
    return f"| {case} | {name} | {margin:g} | {said} |"


def made(case: str, rows: Mapping[str, str]) -> Iterator[tuple[str, str]]:
    """The rows of a case, by what they begin with; those that are there already as they are."""
    for rig in rigs():
        begins = f"| {case} | {rig.name} |"
        yield begins, rows.get(begins) or row(case, rig)
    for distance in DISTANCES:
        name = f"magnet, {distance:g} mm"
        begins = f"| {case} | {name} |"
        yield begins, rows.get(begins) or magnet_row(case, name, distance)


def main(cases: tuple[str, ...], kept: Path | None) -> None:
    """Write the table, row by row."""
    page = PAGE.read_text()
    before, rest = page.split("<!-- campaigns.actuators -->\n", maxsplit=1)
    _, after = rest.split("<!-- end -->\n", maxsplit=1)
    lines = kept.read_text().splitlines() if kept is not None and kept.exists() else []
    rows = {"|".join(line.split("|")[:3]) + "|": line for line in lines}
    table = HEAD
    for case in cases:
        for begins, line in made(case, rows):
            table += f"{line}\n"
            if begins not in rows:
                print(line, flush=True)
                if kept is not None:
                    with kept.open("a") as file:
                        file.write(f"{line}\n")
    PAGE.write_text(f"{before}<!-- campaigns.actuators -->\n{table}<!-- end -->\n{after}")


if __name__ == "__main__":
    words = argparse.ArgumentParser()
    words.add_argument("cases", nargs="*", default=CASES)
    words.add_argument("--rows", type=Path)
    told = words.parse_args()
    main(tuple(told.cases), told.rows)
