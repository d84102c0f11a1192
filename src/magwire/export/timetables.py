"""Inputs against time in files, for the laboratory: CSV and NetCDF, written and read."""

from __future__ import annotations

import csv
import math
import re
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from magwire.actuate import Advancer, Timetable
from magwire.errors import InputError
from magwire.files import LARGEST_TEXT, read_text, successor

if TYPE_CHECKING:
    import xarray as xr

Array = NDArray[np.float64]
TABLE, DATA = "inputs.csv", "inputs.nc"
OWN = ("time", "feed", "tip_x", "tip_y", "tip_z", "field_x", "field_y", "field_z")
"""Columns of every table; those of its inputs have the inputs' names."""
FOLLOWING = ("feed_speed", "advancer", "advancer_speed")
"""Columns that are there for the laboratory; steps, too, are read."""
LEAD = "schedule of inputs against time"
_HEAD = re.compile(r"\s*([^\s\[]+)\s*\[([^\]]*)\]\s*")


def plan_of(data: xr.Dataset, background: Array | None = None) -> Timetable:
    """The course of a result: its inputs, where the tip was, and the field of the actuator there.

    Parameters
    ----------
    data
        A result file's variables and attributes.
    background
        Flux density at the tip that is not the actuator's, shape (t, 3) [T]; none if left out.

    Raises
    ------
    InputError
        If there are less than two records, or no inputs.
    """
    names = tuple(str(data.attrs.get("input_names", "")).split())
    units = tuple(str(data.attrs.get("input_units", "")).split(" "))
    if not names or data.sizes["time"] < 2:
        raise InputError(
            "The result must hold at least two records and the inputs of an actuator; received "
            f"{data.sizes['time']} records and {len(names)} inputs."
        )
    field = data["field"].values
    known = "centreline" in data  # not in open space
    return Timetable(
        time=data["time"].values,
        feed=data["feed"].values,
        inputs=data["inputs"].values,
        names=names,
        units=units,
        tip=data["position"].values[:, -1],
        flux_density=field if background is None else field - background,
        centreline=data["centreline"].values if known else np.zeros((0, 3)),
        lumen_radius=data["lumen_radius"].values if known else np.zeros(0),
    )


def write_timetable(table: Timetable, folder: Path) -> list[Path]:
    """Write ``inputs.csv`` and ``inputs.nc``, in SI units; both read back to the same numbers.

    Parameters
    ----------
    table
        The timetable.
    folder
        Where to.
    """
    columns = _columns(table)
    path = folder / TABLE
    with successor(path) as draft, draft.open("w", newline="", encoding="utf-8") as file:
        writer = csv.writer(file, lineterminator="\n")
        writer.writerow(columns)
        writer.writerows(zip(*(column.tolist() for column in columns.values()), strict=True))
    data = _dataset(table)
    with successor(folder / DATA) as draft:
        data.to_netcdf(draft, engine="h5netcdf")
    return [path, folder / DATA]


def read_timetable(path: str | Path) -> Timetable:
    """A timetable from a file.

    Parameters
    ----------
    path
        ``inputs.nc`` or ``inputs.csv``, or the folder that holds the former. A CSV table knows
        neither the lumen nor the advancer.

    Raises
    ------
    InputError
        If the file is no such schedule.
    """
    path = Path(path)
    path = path / DATA if path.is_dir() else path
    try:
        if path.suffix == ".nc":
            return _of_dataset(path)
        return _of_rows(path, read_text(path, LARGEST_TEXT))
    except OSError as error:
        reason = (error.strerror or "it is no such file").lower()
        raise InputError(f"Schedule file '{path}' cannot be read: {reason}.") from None
    except UnicodeDecodeError:
        raise InputError(f"Schedule file '{path}' is not a text file.") from None


def _columns(table: Timetable) -> dict[str, NDArray[Any]]:
    found: dict[str, NDArray[Any]] = {"time [s]": table.time, "feed [m]": table.feed}
    for name, unit, values in zip(table.names, table.units, table.inputs.T, strict=True):
        found[f"{name} [{unit}]"] = values
    for name, unit, vectors in (("tip", "m", table.tip), ("field", "T", table.flux_density)):
        found |= {f"{name}_{axis} [{unit}]": vectors[:, i] for i, axis in enumerate("xyz")}
    found["feed_speed [m/s]"] = table.feed_speed
    rate = table.step_rate
    if table.steps is not None and rate is not None:
        found["advancer [steps]"] = table.steps
        found["advancer_speed [steps/s]"] = rate
    return found


def _dataset(table: Timetable) -> xr.Dataset:
    import xarray as xr

    import magwire

    def noted(dims: str, values: Any, units: str, words: str) -> tuple[Any, ...]:
        return tuple(dims.split()), values, {"units": units, "long_name": words}

    data = {
        "feed": noted("time", table.feed, "m", "insertion: length of wire inside the lumen"),
        "inputs": noted(
            "time input",
            table.inputs,
            "see the attribute input_units",
            "inputs of the actuator, by the attribute input_names",
        ),
        "tip": noted("time xyz", table.tip, "m", "planned position of the tip"),
        "field": noted(
            "time xyz", table.flux_density, "T", "flux density of the actuator, planned at the tip"
        ),
        "feed_speed": noted("time", table.feed_speed, "m/s", "speed of the feed until the next"),
        "centreline": noted(
            "centreline_point xyz", table.centreline, "m", "centreline of the lumen"
        ),
        "lumen_radius": noted("centreline_point", table.lumen_radius, "m", "radius of the lumen"),
    }
    attrs: dict[str, Any] = {
        "Conventions": "CF-1.11",
        "title": LEAD,
        "source": f"magwire {magwire.__version__}",
        "input_names": " ".join(table.names),
        "input_units": " ".join(table.units),
    }
    advancer = table.advancer
    if table.steps is not None and advancer is not None:
        data["advancer"] = noted("time", table.steps, "1", "place of the advancer's stepper")
        data["advancer_speed"] = noted("time", table.step_rate, "1/s", "steps until the next")
        attrs["advancer_resolution"] = advancer.resolution
        attrs["advancer_backlash"] = advancer.backlash
        attrs["advancer_max_speed"] = advancer.max_speed
    time = noted("time", table.time, "s", "time")
    return xr.Dataset(data, coords={"time": time}, attrs=attrs)


def _of_dataset(path: Path) -> Timetable:
    import xarray as xr

    try:
        with xr.open_dataset(path, engine="h5netcdf", decode_times=False) as file:
            data = file.load()
    except (OSError, ValueError, KeyError) as error:
        if isinstance(error, FileNotFoundError):
            raise
        raise InputError(f"Schedule file '{path}' is no NetCDF file.") from None
    needed = ("time", "feed", "inputs", "tip", "field", "centreline", "lumen_radius")
    missing = [name for name in needed if name not in data]
    if missing or data.attrs.get("title") != LEAD:
        raise InputError(
            f"Schedule file '{path}' must be one that 'magwire export --to inputs' writes; "
            f"received one without {', '.join(missing) or 'its title'}."
        )
    attrs, advancer = data.attrs, None
    if "advancer" in data:
        three = ("resolution", "backlash", "max_speed")
        advancer = Advancer(*(float(attrs[f"advancer_{name}"]) for name in three))
    return Timetable(
        **{name: data[name].values for name in ("time", "feed", "inputs", "tip")},
        flux_density=data["field"].values,
        names=tuple(str(attrs["input_names"]).split()),
        units=tuple(str(attrs["input_units"]).split(" ")),
        steps=data["advancer"].values if advancer else None,
        advancer=advancer,
        centreline=data["centreline"].values,
        lumen_radius=data["lumen_radius"].values,
    )


def _of_rows(path: Path, text: str) -> Timetable:
    head, *rows = csv.reader(text.splitlines()) if text.strip() else [[]]
    heads = [match.groups() if (match := _HEAD.fullmatch(word)) else ("", "") for word in head]
    names = [name for name, _ in heads]
    missing = [name for name in OWN if name not in names]
    if missing or "" in names or len(set(names)) < len(names):
        raise InputError(
            f"Schedule file '{path}' must have the header of one that 'magwire export --to inputs' "
            f"writes; received '{','.join(head)}'."
        )
    values = np.empty((len(rows), len(head)))
    for number, row in enumerate(rows, start=1):
        _fill(values[number - 1], row, names, f"'{path}' in row {number}")
    column = {name: values[:, k] for k, name in enumerate(names)}
    own = [k for k, name in enumerate(names) if name not in (*OWN, *FOLLOWING)]
    if not rows or np.any(np.diff(column["time"]) <= 0.0):
        raise InputError(
            f"Schedule file '{path}' must have rows whose times rise; received {len(rows)} rows."
        )
    return Timetable(
        time=column["time"],
        feed=column["feed"],
        inputs=values[:, own],
        names=tuple(heads[k][0] for k in own),
        units=tuple(heads[k][1] for k in own),
        tip=np.stack([column[f"tip_{axis}"] for axis in "xyz"], axis=1),
        flux_density=np.stack([column[f"field_{axis}"] for axis in "xyz"], axis=1),
    )


def _fill(place: Array, row: list[str], names: list[str], where: str) -> None:
    """Read a row; only a field may be left open, as NaN."""
    if len(row) != len(names):
        raise InputError(
            f"Schedule file {where} must have {len(names)} numbers; received {len(row)}."
        )
    for k, (name, word) in enumerate(zip(names, row, strict=True)):
        try:
            place[k] = float(word)
        except ValueError:
            place[k] = math.inf
        open_field = name.startswith("field_") and math.isnan(place[k])
        if not (math.isfinite(place[k]) or open_field):
            raise InputError(
                f"Schedule file {where} must have a finite number as {name}; received '{word}'."
            )
