"""The result of a run."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from magwire.actuate.recorded import names_of, power_of
from magwire.errors import ResultError, offering, positive, refuse
from magwire.files import successor
from magwire.pieces import Plain, at, largest, piece, pieces, spans
from magwire.results import disk, forces, loading, plain
from magwire.results.courses import Courses
from magwire.results.older import completed
from magwire.status import RunStatus
from magwire.units import show

if TYPE_CHECKING:
    import xarray as xr
    from matplotlib.figure import Figure

    from magwire.view import Page

Array = NDArray[np.float64]
FILE = "result.nc"


class Result(Courses):
    """What a run recorded.

    Parameters
    ----------
    dataset
        Variables and attributes as in a result file. What files of earlier versions lack is added
        if it follows from what they hold.

    Attributes
    ----------
    held
        The same as ``dataset``, for summaries and figures, which do without xarray.

    Notes
    -----
    Largest and mean tip forces, first contact and so ``tip_contact_free`` and ``wire_contact_free``
    are of all steps; all other extremes are of the records.
    """

    def __init__(self, dataset: xr.Dataset) -> None:
        offering(
            "Result", "dataset", dataset, [("attrs", "sizes", "data_vars")], "an xarray Dataset"
        )
        self.held: Any = completed(dataset)

    @classmethod
    def of(cls, held: Plain | xr.Dataset) -> Result:
        """The result that holds something that has been read or recorded."""
        if not isinstance(held, Plain):
            return cls(held)
        made = cls.__new__(cls)
        made.held = held
        return made

    @property
    def dataset(self) -> xr.Dataset:
        """Variables and attributes as in a result file."""
        if isinstance(self.held, Plain):
            self.held = plain.dataset(self.held)
        found: xr.Dataset = self.held
        return found

    @classmethod
    def load(cls, path: str | Path) -> Result:
        """Read a result file.

        One of up to 16 MB is read whole, and free afterwards. A larger one stays open, and its
        variables are read as they are asked for: a long run need not fit into memory.
        ``result.dataset.load()`` reads all, ``result.dataset.close()`` lets go of the file.

        Parameters
        ----------
        path
            The file, or the folder that holds ``result.nc``.

        Raises
        ------
        ResultError
            If it is no result file.
        """
        if not isinstance(path, (str, Path)):
            raise refuse("Result.load", "path", "a file or folder", path)
        path = Path(path)
        if path.is_dir():
            if not (path / FILE).exists():
                raise ResultError(f"Folder '{path}' holds no {FILE}.")
            path = path / FILE
        if not path.exists():
            raise ResultError(f"Result file '{path}' does not exist.")
        return cls.of(loading.load(path))

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

        figure = draw(self.held)
        if path is not None:
            with successor(Path(path)) as draft:
                figure.savefig(draft)
        return figure

    def view(self, other: Result | None = None) -> Page:
        """A page that replays the run in a browser: wire, lumen, field, forces and curves.

        Notebooks show it; ``result.view().save("page.html")`` writes it as one file.

        Parameters
        ----------
        other
            A second result, to be shown beside this one.

        Raises
        ------
        InputError
            If a result has no records.
        """
        from magwire.view import page

        runs = [self] if other is None else [self, other]
        return page([("result", run.dataset) for run in runs])

    @property
    def status(self) -> str:
        """How it ended, a ``RunStatus``; or the word of the watcher that ended it."""
        return RunStatus.of(self.held.attrs["status"])

    @property
    def message(self) -> str:
        """Why it ended so; of a complete run, what was tried more than once, or ""."""
        return str(self.held.attrs["message"])

    @property
    def motion(self) -> str:
        """How the wire moved: in time, "dynamic"; or by equilibria, "quasi-static"."""
        return str(self.held.attrs["motion"])

    @property
    def converged(self) -> bool:
        """Whether the run went to its end with every step converged."""
        return self.status == RunStatus.COMPLETE

    @property
    def scenario(self) -> str:
        """The scenario as TOML; "" for a run that was set up in Python."""
        return str(self.held.attrs["scenario"])

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
        """Smallest distance to the wall anywhere along the wire [m]; NaN without a wall.

        It is the distance that the scenario's wall convention counts (P-12).
        """
        names = ("clearance", "clearance_midpoint", "clearance_along")
        known = [name for name in names if name in self.held]
        found = [self._number("smallest_clearance")]
        for values in pieces(self.held, *known):
            found += [float(np.min(v, initial=np.inf, where=np.isfinite(v))) for v in values]
        return min(filter(np.isfinite, found), default=float("nan"))

    @property
    def first_contact(self) -> float | None:
        """Insertion length at which some node first felt the wall [m]; None if none did."""
        feed = self._number("first_contact_feed")
        return None if np.isnan(feed) else feed

    @property
    def tip_contact_free(self) -> bool:
        """Whether the tip never felt the wall in any step; the wire behind it may have."""
        return self.max_tip_force == 0.0

    @property
    def wire_contact_free(self) -> bool:
        """Whether no part of the wire, tip or body, felt the wall in any step."""
        return self.first_contact is None

    @property
    def contact_free(self) -> bool:
        """Another name of ``tip_contact_free``: of the tip alone, the wire may touch the wall."""
        return self.tip_contact_free

    @property
    def max_wall_force(self) -> float:
        """Largest force of the wall on the wire, summed over its nodes [N].

        Over all records; no less than the largest force on the tip, which is over all steps.
        """
        return max(self._largest("wall_force"), self.max_tip_force)

    @property
    def force_patch(self) -> float:
        """Length of wire that patch forces are of, and over which others are smoothed [m]."""
        return self._number("force_patch")

    @property
    def max_patch_force(self) -> float:
        """Largest force of the wall on any ``force_patch`` of wire [N]; see ``max_wall_force``."""
        return max(self._largest("patch_force"), self.max_tip_force)

    @property
    def max_magnet_force(self) -> float:
        """Largest force of the wall on the distal magnet, over all records [N]; NaN without one."""
        return self._largest("magnet_force")

    @property
    def max_push_force(self) -> float:
        """Largest push at the guide over all records [N]; NaN if unknown (P-38)."""
        return self._largest("push_force")

    @property
    def max_insertion_force(self) -> float:
        """Largest force that feeds the wire, over all records [N]; NaN if unknown (P-38)."""
        return self._largest("insertion_force")

    @property
    def max_guide_torque(self) -> float:
        """Largest size of the torque at the guide over all records [N m]; NaN if unknown."""
        return largest(self.held, np.abs, "guide_torque")

    @property
    def largest_friction(self) -> float:
        """Largest friction of the wall on the wire over all records, sizes summed over it [N]."""

        def summed(force: Array) -> Array:
            return np.asarray(np.linalg.norm(force, axis=2).sum(axis=1))

        return largest(self.held, summed, "friction_force")

    @property
    def work_of_friction(self) -> float:
        """What friction took in all [J]; 0 without friction."""
        return self._largest("friction_work")

    @property
    def largest_indentation(self) -> float:
        """Deepest that any node pressed the wall in, over all records [m]; 0 at a rigid wall."""
        return self._largest("wall_indentation")

    @property
    def work_of_wall(self) -> float:
        """What the wall that moves has done to the wire in all [J]; 0 if it rests."""
        return float(at(self.held, "wall_work", -1)) if self.held.sizes["time"] else 0.0

    @property
    def largest_lag(self) -> float:
        """Largest difference of the twists of guide and tip, over all records [rad]."""
        return largest(self.held, lambda a, b: np.abs(a - b), "guide_twist", "tip_twist")

    @property
    def longest_contact(self) -> float:
        """Largest contact length over all records [m]."""
        return self._largest("contact_length")

    def largest_force_over(self, length: float) -> Array:
        """Largest force of the wall on any stretch of the wire of some length, shape (t,) [N].

        Parameters
        ----------
        length
            Length of the stretch [m]: an edge at least for a number that does not hang on the mesh.

        Raises
        ------
        InputError
            If the length is not positive.
        """
        positive("Result.largest_force_over", "length", length, "m")
        nodes = self.held.sizes["node"]
        whole = self._number("length_scale")
        wire = forces.Layout(whole, nodes, (np.nan, np.nan), np.zeros((0, 4)))
        found = [
            forces.largest_over(wire, forces.sizes(force), min(length, whole))
            for (force,) in pieces(self.held, "contact_force")
        ]
        return np.concatenate(found or [np.zeros(0)])

    @property
    def largest_tip_offset(self) -> float:
        """Largest distance of the tip from the centreline over all records [m]."""
        return self._largest("tip_offset")

    @property
    def largest_tip_departure(self) -> float:
        """Largest distance of the tip from where the navigator's model has it [m].

        NaN if nobody steered, or the navigator has no model.
        """
        known = [
            float(away[np.isfinite(away)].max())
            for (away,) in pieces(self.held, "tip_departure")
            if np.isfinite(away).any()
        ]
        return max(known, default=float("nan"))

    @property
    def largest_move(self) -> float:
        """Largest move of a node from one record to the next, beyond what was inserted [m].

        In quasi-static motion much of it in one go is a wire that snaps: where it ends is one
        equilibrium of several, and only dynamic motion tells which a wire finds.
        """
        found = 0.0
        for records in spans(self.held, "position"):
            on = slice(records.start, records.stop + 1)  # a move is between two records
            position, feed = (piece(self.held, name, on) for name in ("position", "feed"))
            moves = np.linalg.norm(np.diff(position, axis=0), axis=2).max(axis=1, initial=0.0)
            found = max(found, float(np.max(moves - np.abs(np.diff(feed)), initial=0.0)))
        return found

    @property
    def input_names(self) -> tuple[tuple[str, str], ...]:
        """Name and SI unit of each input."""
        return names_of(self.dataset.attrs)

    @property
    def power(self) -> Array:
        """What the coils turn into heat, sum of R u^2, shape (t,) [W]; zero if R is not known."""
        heat = power_of(self.dataset.attrs, self.inputs)
        return np.zeros(len(self.time)) if heat is None else heat

    @property
    def peak_field(self) -> float:
        """Largest magnitude of the flux density at the tip [T]."""
        return largest(self.held, lambda field: np.linalg.norm(field, axis=1), "field")

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

    def __repr__(self) -> str:
        title = self.held.attrs.get("title", "")
        of = f" of {title!r}" if title else ""
        records = self.held.sizes["time"]
        words = f"<Result{of}: {self.status}, {records} records"
        if records:
            words += f", {show(float(at(self.held, 'feed', -1)), 'length')} inserted in "
            words += f"{show(float(at(self.held, 'time', -1)), 'time')}; peak field "
            words += f"{show(self.peak_field, 'flux_density')}, largest tip force "
            words += f"{show(self.max_tip_force, 'force')}"
        return f"{words}>"

    def _largest(self, name: str) -> float:
        """Largest value over all records, no less than zero; NaN if unknown."""
        return largest(self.held, lambda values: values, name)

    def _number(self, name: str) -> float:
        value: Any = self.held.attrs[name]
        return float(np.asarray(value).reshape(()))
