"""The result of a run."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from magwire.errors import ResultError
from magwire.files import successor
from magwire.results import disk, loading

if TYPE_CHECKING:
    import xarray as xr
    from matplotlib.figure import Figure

Array = NDArray[np.float64]
FILE = "result.nc"


class Result:
    """What a run recorded.

    Parameters
    ----------
    dataset
        Variables and attributes as in a result file.
    """

    def __init__(self, dataset: xr.Dataset) -> None:
        self.dataset = dataset

    @classmethod
    def load(cls, path: str | Path) -> Result:
        """Read a result file; all of it, so that the file is free afterwards.

        Parameters
        ----------
        path
            The file, or the folder that holds ``result.nc``.

        Raises
        ------
        ResultError
            If it is no result file.
        """
        path = Path(path)
        if path.is_dir():
            if not (path / FILE).exists():
                raise ResultError(f"Folder '{path}' holds no {FILE}.")
            path = path / FILE
        if not path.exists():
            raise ResultError(f"Result file '{path}' does not exist.")
        return cls(loading.load(path))

    def save(self, path: str | Path) -> Path:
        """Write a result file; an existing one is overwritten.

        Raises
        ------
        ResultError
            If the file cannot be written.
        """
        path = Path(path)
        try:
            disk.save(self.dataset, path, ("time",))
        except OSError as error:
            reason = (error.strerror or str(error)).lower()
            raise ResultError(f"Result file '{path}' cannot be written: {reason}.") from error
        return path

    def plot(self, path: str | Path | None = None) -> Figure:
        """Draw the paper's panels: shapes, tip force, field and clearance.

        Parameters
        ----------
        path
            Image file to write, PNG, SVG or PDF by its suffix; none if left out.
        """
        from magwire.plot import draw

        figure = draw(self.dataset)
        if path is not None:
            with successor(Path(path)) as draft:
                figure.savefig(draft)
        return figure

    @property
    def status(self) -> str:
        """How it ended, or "running".

        "complete", "not converged", "unstable", "no field", "interrupted", "terminated" or
        "failed".
        """
        return str(self.dataset.attrs["status"])

    @property
    def message(self) -> str:
        """Why it ended so; of a complete run, what was tried more than once, or ""."""
        return str(self.dataset.attrs["message"])

    @property
    def motion(self) -> str:
        """How the wire moved: in time, "dynamic"; or by equilibria, "quasi-static"."""
        return str(self.dataset.attrs["motion"])

    @property
    def converged(self) -> bool:
        """Whether the run went to its end with every step converged."""
        return self.status == "complete"

    @property
    def scenario(self) -> str:
        """The scenario as TOML; "" for a run that was set up in Python."""
        return str(self.dataset.attrs["scenario"])

    @property
    def max_tip_force(self) -> float:
        """Largest force of the wall on the tip over all steps [N]."""
        return self._number("max_tip_force")

    @property
    def mean_tip_force(self) -> float:
        """Mean force of the wall on the tip over all steps [N]."""
        return self._number("mean_tip_force")

    @property
    def smallest_clearance(self) -> float:
        """Smallest distance to the wall at nodes and midway between them [m]; NaN without a wall.

        It is the distance that the scenario's wall convention counts (P-12).
        """
        found = [
            self._number("smallest_clearance"),
            *self.clearance.ravel(),
            *self.dataset["clearance_midpoint"].values,
        ]
        finite = np.array(found)[np.isfinite(found)]
        return float(finite.min()) if finite.size else float("nan")

    @property
    def first_contact(self) -> float | None:
        """Fed length at which some node first felt the wall [m]; None if none did."""
        feed = self._number("first_contact_feed")
        return None if np.isnan(feed) else feed

    @property
    def contact_free(self) -> bool:
        """Whether the tip never felt the wall in any step; the body of the wire may have."""
        return self.max_tip_force == 0.0

    @property
    def largest_tip_offset(self) -> float:
        """Largest distance of the tip from the centreline over all records [m]."""
        return float(np.max(self.tip_offset, initial=0.0))

    @property
    def largest_tip_departure(self) -> float:
        """Largest distance of the tip from where the navigator's model has it [m].

        NaN if nobody steered, or the navigator has no model.
        """
        known = self.tip_departure[np.isfinite(self.tip_departure)]
        return float(known.max()) if known.size else float("nan")

    @property
    def largest_move(self) -> float:
        """Largest way of a node from one record to the next, beyond what was fed [m].

        In quasi-static motion much of it in one go is a wire that snaps: where it ends is one
        equilibrium of several, and only dynamic motion tells which a wire finds.
        """
        moves = np.linalg.norm(np.diff(self.position, axis=0), axis=2).max(axis=1, initial=0.0)
        return float(np.max(moves - np.abs(np.diff(self.feed)), initial=0.0))

    @property
    def peak_field(self) -> float:
        """Largest magnitude of the flux density at the tip [T]."""
        return float(np.max(np.linalg.norm(self.field, axis=1), initial=0.0))

    @property
    def force_scale(self) -> float:
        """EI / L^2, the force that makes a normalised force of one [N]."""
        return self._number("force_scale")

    @property
    def steps(self) -> int:
        """Number of time steps."""
        return int(self._number("steps"))

    @property
    def newton_iterations_per_step(self) -> float:
        """Newton iterations per step, mean over the run; NaN without a step."""
        total = self._number("newton_iterations_total")
        return total / self.steps if self.steps else float("nan")

    @property
    def wall_time(self) -> float:
        """Time the run took [s]."""
        return self._number("wall_time_total")

    @property
    def time(self) -> Array:
        """Simulated time, shape (t,) [s]."""
        return self._array("time")

    @property
    def feed(self) -> Array:
        """Length of wire fed into the lumen, shape (t,) [m]."""
        return self._array("feed")

    @property
    def position(self) -> Array:
        """Positions of the nodes, shape (t, nodes, 3) [m]."""
        return self._array("position")

    @property
    def field(self) -> Array:
        """Flux density at the tip, shape (t, 3) [T]."""
        return self._array("field")

    @property
    def contact_force(self) -> Array:
        """Force of the wall on the nodes, shape (t, nodes, 3) [N]."""
        return self._array("contact_force")

    @property
    def clearance(self) -> Array:
        """Distance of the nodes to the wall, shape (t, nodes) [m]; NaN on the guide."""
        return self._array("clearance")

    @property
    def tip_force(self) -> Array:
        """Magnitude of the force of the wall on the tip, shape (t,) [N]."""
        return self._array("tip_force")

    @property
    def tip_offset(self) -> Array:
        """Distance of the tip from the centreline, shape (t,) [m]."""
        return self._array("tip_offset")

    @property
    def tip_departure(self) -> Array:
        """Distance of the tip from where the navigator's model has it, shape (t,) [m].

        The largest since the record before; NaN where nobody compared.
        """
        return self._array("tip_departure")

    @property
    def stable(self) -> NDArray[np.bool_]:
        """Whether the tangent stiffness is positive definite, shape (t,)."""
        return self._array("stable") > 0.0

    @property
    def normalized_push(self) -> Array:
        """Fed length over length of the wire, shape (t,)."""
        return self._array("normalized_push")

    @property
    def normalized_tip_force(self) -> Array:
        """Tip force times L^2 / EI, shape (t,)."""
        return self._array("normalized_tip_force")

    def __repr__(self) -> str:
        title = self.dataset.attrs.get("title", "")
        of = f" of {title!r}" if title else ""
        return f"<magwire result{of}: {self.status}, {self.time.size} records>"

    def _array(self, name: str) -> Array:
        return np.asarray(self.dataset[name].values, dtype=np.float64)

    def _number(self, name: str) -> float:
        value: Any = self.dataset.attrs[name]
        return float(np.asarray(value).reshape(()))
