"""The table of a sweep: a row for each run, in a NetCDF file that is whole at any time."""

from __future__ import annotations

import time
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np

import magwire
from magwire.errors import ResultError
from magwire.many.outcome import QUANTITIES, Outcome
from magwire.many.sampling import column
from magwire.many.sweep import Sweep
from magwire.results import disk, provenance

if TYPE_CHECKING:
    import xarray as xr

SECONDS = 2.0
"""Wall time between two savings [s]."""
PENDING = "pending"
"""Status of a run that has not been done."""


def blank(sweep: Sweep) -> xr.Dataset:
    """The table before any run: the parameters, and no outcomes."""
    import xarray as xr

    runs = len(sweep.values)
    data: dict[str, tuple[str, object, dict[str, str]]] = {}
    for place, varied in enumerate(sweep.ranges):
        values, units = column([row[place] for row in sweep.values])
        notes = {"long_name": varied.key} | ({"units": units} if units else {})
        data[varied.key] = ("run", values, notes)
    texts = {"status": "how the run ended", "message": "why it ended so"}
    for name, long_name in texts.items():
        word = PENDING if name == "status" else ""
        data[name] = ("run", np.full(runs, word, dtype=object), {"long_name": long_name})
    for name, quantity in QUANTITIES.items():
        notes = {"units": quantity.units, "long_name": quantity.long_name}
        data[name] = ("run", np.full(runs, np.nan), notes)
    attributes = {
        "Conventions": "CF-1.11",
        "source": f"magwire {magwire.__version__}",
        **provenance.attributes(),
        "sweep": sweep.text,
        "parameters": ", ".join(varied.key for varied in sweep.ranges),
    }
    return xr.Dataset(data, coords={"run": np.arange(runs)}, attrs=attributes)


def load(path: str | Path) -> xr.Dataset:
    """A table from its file.

    Raises
    ------
    ResultError
        If it is none.
    """
    import xarray as xr

    try:
        dataset = xr.load_dataset(path, engine="h5netcdf")
    except (OSError, ValueError, KeyError) as error:
        raise ResultError(f"File '{path}' is not a readable table of a sweep: {error}.") from None
    if "sweep" not in dataset.attrs or "status" not in dataset:
        raise ResultError(f"File '{path}' is not the table of a sweep.")
    for name in ("status", "message"):  # as wide as any text that is still to come
        dataset[name] = dataset[name].astype(object)
    return dataset


class Table:
    """The table while the runs are done; as a context manager it is saved whatever happens.

    Parameters
    ----------
    dataset
        The rows so far.
    path
        File to write.
    """

    def __init__(self, dataset: xr.Dataset, path: Path) -> None:
        self.dataset = dataset
        self.path = path
        self._due = 0.0

    @property
    def pending(self) -> list[int]:
        """Numbers of the runs to do."""
        return [int(n) for n in np.flatnonzero(self.dataset["status"].values == PENDING)]

    def take(self, outcome: Outcome) -> None:
        """Fill in the row of a run."""
        row = outcome.number
        self.dataset["status"].values[row] = outcome.status
        self.dataset["message"].values[row] = outcome.message
        for name, value in outcome.numbers.items():
            self.dataset[name].values[row] = value
        if time.monotonic() >= self._due:
            self.save()

    def save(self) -> None:
        """Write the file; the former one is there until the new one is whole."""
        try:
            disk.save(self.dataset, self.path)
        except OSError as error:
            reason = (error.strerror or str(error)).lower()
            raise ResultError(f"Table '{self.path}' cannot be written: {reason}.") from None
        self._due = time.monotonic() + SECONDS

    def __enter__(self) -> Table:
        self.save()
        return self

    def __exit__(self, *error: object) -> None:
        self.save()
