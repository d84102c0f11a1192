"""Calibrated electromagnets: the multipole electromagnet model, MPEM (P-25, P-26)."""

from __future__ import annotations

import math
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from magwire.actuate.actuator import Actuator
from magwire.actuate.calibration.limits import Limits, read_limits
from magwire.actuate.calibration.multipoles import Calibration, Source, read_calibration
from magwire.actuate.calibration.saturation import read_saturation
from magwire.actuate.inputs import UNLIMITED, Circuit, Input, current
from magwire.actuate.tables import Desk, Saturation
from magwire.errors import InputError


@dataclass(frozen=True, kw_only=True)
class MPEM(Actuator):
    """Coils as sums of point sources, each times the current of its coil.

    Parameters
    ----------
    calibration
        The coils' sources, and a constant field if there is one.
    max_currents
        Of each coil [A].
    circuits
        The electrical side of each coil.
    saturation
        The curve of each coil's iron core; None if it is linear. Its result takes the place of the
        current.

    Raises
    ------
    InputError
        If there are not as many of them as coils.
    """

    calibration: Calibration
    max_currents: tuple[float, ...] | None = None
    circuits: tuple[Circuit, ...] | None = None
    saturation: tuple[Saturation, ...] | None = None

    def __post_init__(self) -> None:
        count = len(self.calibration.coils)
        for name in ("max_currents", "circuits", "saturation"):
            given = getattr(self, name)
            if given is not None and len(given) != count:
                raise InputError(
                    f"Input {name} of MPEM must have one entry for each of {count} coils; "
                    f"received {len(given)}."
                )

    @classmethod
    def read(
        cls,
        calibration: str | Path,
        limits: str | Path | None = None,
        saturation: str | Path | None = None,
    ) -> MPEM:
        """Coils from their files; a file's fault is one sentence.

        Parameters
        ----------
        calibration
            Sources of each coil (.yaml).
        limits
            Currents, resistances and power.
        saturation
            Curves of the iron cores.

        Raises
        ------
        InputError
            If a file cannot be used.
        """
        coils = read_calibration(Path(calibration))
        allowed = Limits() if limits is None else read_limits(Path(limits), len(coils.coils))
        return cls(
            calibration=coils,
            workspace=coils.workspace,
            max_power=allowed.power,
            max_currents=allowed.currents,
            circuits=allowed.circuits,
            saturation=(
                None if saturation is None else read_saturation(Path(saturation), len(coils.coils))
            ),
        )

    @property
    def inputs(self) -> tuple[Input, ...]:
        """The current of each coil [A], by the coils' names."""
        coils = self.calibration.coils
        most = self.max_currents or (math.inf,) * len(coils)
        circuits = self.circuits or (UNLIMITED,) * len(coils)
        return tuple(
            current(coil.name, amperes, circuit)
            for coil, amperes, circuit in zip(coils, most, circuits, strict=True)
        )

    def lay(self, desk: Desk) -> None:
        """Lay all sources; one of the first order is a dipole."""
        for k, coil in enumerate(self.calibration.coils):
            if self.saturation is not None:
                desk.saturate(k, self.saturation[k])
            for source in coil.sources:
                _lay(desk, k, source)
        for source in self.calibration.offset:
            _lay(desk, None, source)


def _lay(desk: Desk, k: int | None, source: Source) -> None:
    if len(source.outward) == 1 and not source.inward:
        desk.dipole(k, source.position, source.outward[0] * np.array(source.direction))
        return
    place = (np.array(source.position), np.array(source.direction))
    desk.multipole(k, place, np.array(source.outward), np.array(source.inward))
