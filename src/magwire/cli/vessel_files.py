"""Files and pictures of a vessel that ``magwire lumen`` writes."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Any, Literal

from magwire.cli.words import CommandError
from magwire.files import write_whole
from magwire.units import parse
from magwire.vessel import Spot, Vessel
from magwire.vessel.files import Line, netcdf, vtp
from magwire.vessel.files.drawing import NO_WAY

if TYPE_CHECKING:
    from magwire.lumen import Lumen

WRITTEN = (".vtp", ".nc", ".toml")
MM = 1e3


def write(
    vessel: Vessel,
    target: Spot | None,
    out: Path,
    *,
    wall: Literal["balls", "surface"],
    force: bool,
) -> None:
    """Write a vessel as .vtp in millimetres, as .nc in metres, or as a scenario's table in .toml.

    Parameters
    ----------
    vessel
        The vessel.
    target
        That of the scenario's table.
    out
        The file to write.
    wall
        As of ``Vessel.lumen``; the surface goes into a scenario's table only.
    force
        Whether it may be there already.
    """
    if wall == "surface" and out.suffix in (".vtp", ".nc"):
        raise CommandError(
            f"Option --wall must be 'balls' for a file of tubes such as '{out}'; received "
            "'surface', which a .toml can hold."
        )
    if out.suffix not in WRITTEN:
        raise CommandError(
            f"Output file '{out}' must end in one of {', '.join(WRITTEN)}; received {out.suffix!r}."
        )
    if out.exists() and not force:
        raise CommandError(f"Output file '{out}' exists already; use --force to overwrite it.")
    lumen = vessel.lumen(target, wall=wall)  # refuses what could not be used
    factor = MM if out.suffix == ".vtp" else 1.0
    tubes = vessel.tubes.items()
    lines = [Line(name, factor * tube.points, factor * tube.radius) for name, tube in tubes]
    lines += [Line(NO_WAY, factor * balls[:, :3], factor * balls[:, 3]) for balls in vessel.trunks]
    ends = (vessel.entrance, *(line.name for line in lines))
    try:
        if out.suffix == ".vtp":
            vtp.write(out, lines, ends)
        elif out.suffix == ".nc":
            netcdf.write(out, lines, ends)
        else:
            write_whole(out, _toml(vessel, lumen))
    except OSError as error:
        reason = (error.strerror or "unknown reason").lower()
        raise CommandError(f"Output file '{out}' cannot be written: {reason}.") from None


def draw(vessel: Vessel, path: Path, wire: str | None) -> None:
    """Draw a vessel into a file, with a wire of this diameter to compare its radius with."""
    from magwire.plot import vessels

    tubes = {name: tube.centreline() for name, tube in vessel.tubes.items()}
    radius = None if wire is None else 0.5 * parse(wire, "diameter", "--wire")
    try:
        trunks = [(balls[:, :3], balls[:, 3]) for balls in vessel.trunks]
        vessels.save(tubes, path, radius, vessel.surface, trunks=trunks)
    except OSError as error:
        raise CommandError(
            f"Picture '{path}' cannot be written: {(error.strerror or str(error)).lower()}."
        ) from None
    except ValueError as error:
        why = str(error).splitlines()[0].rstrip(".")
        raise CommandError(f"Picture '{path}' cannot be written: {why}.") from None


def _toml(vessel: Vessel, lumen: Lumen) -> str:
    import tomli_w

    from magwire.scenario.kinds.lumen.vessel import rows_of, surface_of, trunks_of

    table: dict[str, Any] = {
        "shape": "vessel",
        "target": str(lumen.target),
        "branches": rows_of(vessel),
    }
    if vessel.trunks:
        table |= {"trunks": trunks_of(vessel)}
    if lumen.sheet is not None:
        table |= {"wall": "surface", "surface": surface_of(lumen.sheet)}
    return tomli_w.dumps({"lumen": table})
