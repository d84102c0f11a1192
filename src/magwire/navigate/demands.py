"""What a field schedule must keep to (P-22, P-23)."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from magwire.errors import InputError, positive, refuse, within
from magwire.navigate.navigator import NavigationError

ROUND_OFF = 1e-12  # part of a limit that is kept free for the rounding of what comes after


@dataclass(frozen=True)
class Demands:
    """What a field schedule must keep to.

    Parameters
    ----------
    tip_clearance
        Clearance of the tip to the wall over that on the centreline, between 0 and 1.
    stability_margin
        Smallest eigenvalue of the tangent stiffness against the lumped mass [rad^2/s^2].
    field_tolerance
        Part by which the field may be off without harm.
    gain_tolerance
        Part by which the field of each coil may be off by itself, in all combinations of signs;
        where there are no coils, each component of the field.
    max_field
        Largest flux density [T]; no planned field is larger, not by a rounding error.
    max_field_rate
        Largest change of the flux density per insertion length [T/m].
    """

    tip_clearance: float = 0.4
    stability_margin: float = 1.0
    field_tolerance: float = 0.05
    max_field: float = float("inf")
    max_field_rate: float = float("inf")
    gain_tolerance: float = 0.0

    def __post_init__(self) -> None:
        within("Demands", "tip_clearance", self.tip_clearance, low=0.0, high=1.0)
        positive("Demands", "stability_margin", self.stability_margin, "rad^2/s^2")
        within("Demands", "field_tolerance", self.field_tolerance, low=0.0, high=0.5)
        within("Demands", "gain_tolerance", self.gain_tolerance, low=0.0, high=0.5)
        for name, unit in (("max_field", "T"), ("max_field_rate", "T/m")):
            value = getattr(self, name)
            if isinstance(value, bool) or not isinstance(value, (int, float, np.floating)):
                raise refuse("Demands", name, "a number", value)
            if not value > 0.0:
                raise InputError(
                    f"Input {name} of Demands must be positive; received {value} {unit}."
                )

    @property
    def weakening(self) -> float:
        """The weakest field that there may be, over the planned one."""
        return 1.0 - self.field_tolerance

    @property
    def largest_weakest(self) -> float:
        """What the weakest field may be at most, for the planned one to keep to its limit [T]."""
        return self.max_field * self.weakening * (1.0 - ROUND_OFF)

    def exceeded(self, where: str, needed: float) -> NavigationError:
        """The refusal of a field [T] above the limit, with digits enough to tell the two apart."""
        digits = 3
        while f"{1e3 * needed:.{digits}g}" == f"{1e3 * self.max_field:.{digits}g}" and digits < 17:
            digits += 1
        return NavigationError(
            f"{where} the tip needs {1e3 * needed:.{digits}g} mT; the limit is "
            f"{1e3 * self.max_field:.{digits}g} mT."
        )
