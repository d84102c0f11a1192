"""A stretch of wire that is the same all along (P-4, P-6)."""

from __future__ import annotations

import math
from dataclasses import dataclass

from magwire.errors import array, finite, positive, refuse

Vector3 = tuple[float, float, float]


@dataclass(frozen=True)
class Section:
    """A stretch of wire of round cross-section, the same all along.

    Parameters
    ----------
    length
        Length along the wire [m].
    youngs_modulus, shear_modulus
        Elastic moduli E and G [Pa].
    radius
        Outer radius [m].
    density
        Mass per volume [kg/m^3].
    inner_radius
        Radius of a bore [m]; 0 for a solid wire.
    magnetization
        Remanent magnetisation in the material frame (m1, m2, tangent), shape (3,) [A/m].
    rest_curvature
        Curvature of the unloaded wire towards m1 and towards m2, shape (2,) [1/m].

    Raises
    ------
    InputError
        If a value is not finite, not positive where it must be, or the bore is no bore.
    """

    length: float
    youngs_modulus: float
    shear_modulus: float
    radius: float
    density: float
    inner_radius: float = 0.0
    magnetization: Vector3 = (0.0, 0.0, 0.0)
    rest_curvature: tuple[float, float] = (0.0, 0.0)

    def __post_init__(self) -> None:
        for name, unit in (
            ("length", "m"),
            ("youngs_modulus", "Pa"),
            ("shear_modulus", "Pa"),
            ("radius", "m"),
            ("density", "kg/m^3"),
        ):
            object.__setattr__(self, name, positive("Section", name, getattr(self, name), unit))
        inner = finite("Section", "inner_radius", self.inner_radius, "m")
        if not 0.0 <= inner < self.radius:
            expected = f"at least 0 and below the radius {self.radius:.10g} m"
            raise refuse("Section", "inner_radius", expected, inner, "m")
        magnetization = array("Section", "magnetization", self.magnetization, (3,), "A/m")
        curvature = array("Section", "rest_curvature", self.rest_curvature, (2,), "1/m")
        object.__setattr__(self, "magnetization", tuple(magnetization.tolist()))
        object.__setattr__(self, "rest_curvature", tuple(curvature.tolist()))

    @property
    def area(self) -> float:
        """Cross-section A [m^2]."""
        return math.pi * (self.radius**2 - self.inner_radius**2)

    @property
    def second_moment(self) -> float:
        """Second moment of area I [m^4]; the polar one is J = 2 I."""
        return math.pi * (self.radius**4 - self.inner_radius**4) / 4.0

    @property
    def bending_stiffness(self) -> float:
        """EI [N m^2]."""
        return self.youngs_modulus * self.second_moment

    @property
    def twisting_stiffness(self) -> float:
        """GJ [N m^2]."""
        return self.shear_modulus * 2.0 * self.second_moment

    @property
    def stretching_stiffness(self) -> float:
        """EA [N]."""
        return self.youngs_modulus * self.area

    @property
    def moment_per_length(self) -> Vector3:
        """Magnetic moment per unit length in the material frame, shape (3,) [A m] (P-6)."""
        m1, m2, m3 = self.magnetization
        return (m1 * self.area, m2 * self.area, m3 * self.area)
