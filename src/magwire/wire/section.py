"""A stretch of wire of one make: the same all along, or tapered (P-4, P-6)."""

from __future__ import annotations

import math
from dataclasses import dataclass, replace

from magwire.errors import InputError, array, finite, positive, refuse

Vector3 = tuple[float, float, float]
MU_0 = 1.25663706127e-6
"""Magnetic constant [T m/A], CODATA 2022."""


MOST = 1e100
"""Largest stiffness of a section [N m^2], [N], and one over the smallest."""


@dataclass(frozen=True)
class Stiffness:
    """What a section resists with, as measured, whatever it is made of.

    Parameters
    ----------
    bending, twisting
        EI and GJ [N m^2].
    stretching
        EA [N].

    Raises
    ------
    InputError
        If a value is not positive.
    """

    bending: float
    twisting: float
    stretching: float

    def __post_init__(self) -> None:
        for name, unit in (("bending", "N m^2"), ("twisting", "N m^2"), ("stretching", "N")):
            object.__setattr__(self, name, positive("Stiffness", name, getattr(self, name), unit))


@dataclass(frozen=True)
class Section:
    """A stretch of wire of round cross-section; ``Make`` describes one in other words.

    Parameters
    ----------
    length
        Length along the wire [m].
    youngs_modulus, shear_modulus
        Elastic moduli E and G [Pa]; None if the stiffness is given.
    radius
        Outer radius [m], of a tapered section at its proximal end.
    density
        Mass per volume [kg/m^3].
    inner_radius
        Radius of a bore [m]; 0 for a solid wire. It tapers in proportion.
    magnetization
        Remanent magnetisation [A/m], shape (3,), best written ``mw.axial(128e3)`` or
        ``mw.across(128e3)``: the components are (m1, m2, tangent), the *last* one along the wire.
    rest_curvature
        Curvature of the unloaded wire towards m1 and towards m2, shape (2,) [1/m].
    rest_twist
        Angle per length by which m1 and m2 turn about the tangent of the unloaded wire [rad/m].
    end_radius
        Outer radius at the distal end of a tapered section [m], linear between; None if the
        section is not tapered.
    stiffness
        In place of the moduli.

    Raises
    ------
    InputError
        If a value is not finite, not positive where it must be, the bore is no bore, or moduli
        and stiffness are both given, or neither is.

    Notes
    -----
    The properties are those of a uniform section that weighs as much and, as lengths of wire act
    in series, gives way as much.
    """

    length: float
    youngs_modulus: float | None
    shear_modulus: float | None
    radius: float
    density: float
    inner_radius: float = 0.0
    magnetization: Vector3 = (0.0, 0.0, 0.0)
    rest_curvature: tuple[float, float] = (0.0, 0.0)
    rest_twist: float = 0.0
    end_radius: float | None = None
    stiffness: Stiffness | None = None

    def __post_init__(self) -> None:
        self._check_stiffness()
        for name, unit in (
            ("length", "m"),
            ("youngs_modulus", "Pa"),
            ("shear_modulus", "Pa"),
            ("radius", "m"),
            ("density", "kg/m^3"),
            ("end_radius", "m"),
        ):
            value = getattr(self, name)
            if value is not None or name in ("length", "radius", "density"):
                object.__setattr__(self, name, positive("Section", name, value, unit))
        inner = finite("Section", "inner_radius", self.inner_radius, "m")
        if not 0.0 <= inner < self.radius:
            expected = f"at least 0 and below the radius {self.radius:.10g} m"
            raise refuse("Section", "inner_radius", expected, inner, "m")
        magnetization = array("Section", "magnetization", self.magnetization, (3,), "A/m")
        curvature = array("Section", "rest_curvature", self.rest_curvature, (2,), "1/m")
        object.__setattr__(self, "magnetization", tuple(magnetization.tolist()))
        object.__setattr__(self, "rest_curvature", tuple(curvature.tolist()))
        twist = finite("Section", "rest_twist", self.rest_twist, "rad/m")
        object.__setattr__(self, "rest_twist", twist)
        self._check_size()

    def _check_size(self) -> None:
        """Its stiffnesses are numbers that can be divided by."""
        for name, unit in (("bending_stiffness", "N m^2"), ("stretching_stiffness", "N")):
            value = getattr(self, name)
            if not 1.0 / MOST <= value <= MOST:
                expected = f"such that {name} is between {1.0 / MOST:g} and {MOST:g} {unit}"
                unit = f"m, which makes it {value:g}"
                raise refuse("Section", "radius", expected, self.radius, unit)

    def _check_stiffness(self) -> None:
        """Either moduli or a stiffness."""
        moduli = [value is not None for value in (self.youngs_modulus, self.shear_modulus)]
        if all(moduli) if self.stiffness is None else not any(moduli):
            if self.stiffness is not None and self.end_radius is not None:
                raise InputError(
                    "Input end_radius of Section cannot stand next to a stiffness, which is that "
                    f"of a uniform section; received {self.end_radius} m."
                )
            return
        raise InputError(
            "Input stiffness of Section must stand in place of youngs_modulus and shear_modulus; "
            f"received {self.stiffness}, {self.youngs_modulus} Pa and {self.shear_modulus} Pa."
        )

    def cut(self, first: float, last: float) -> Section:
        """The part between two distances from its proximal end [m]."""
        if self.end_radius is None:
            return replace(self, length=last - first)
        slope = (self.end_radius - self.radius) / self.length
        near, far = self.radius + slope * first, self.radius + slope * last
        inner = self.inner_radius * near / self.radius
        return replace(self, length=last - first, radius=near, inner_radius=inner, end_radius=far)

    def describe(self) -> str:
        """What it is, in one line: diameters, stiffness, and magnetisation with its remanence."""
        words = f"{2e3 * self.radius:.4g} mm"
        if self.end_radius is not None:
            words += f" to {2e3 * self.end_radius:.4g} mm"
        words = f"diameter {words}"
        if self.inner_radius:
            words += f", bore {2e3 * self.inner_radius:.4g} mm"
        words += f", EI {self.bending_stiffness:.4g} N m^2, GJ {self.twisting_stiffness:.4g} N m^2"
        words += f", EA {self.stretching_stiffness:.4g} N"
        size = math.hypot(*self.magnetization)
        if size > 0.0:
            words += f", magnetised {1e-3 * size:.6g} kA/m{self._slant(size)}"
            words += f" (remanence {MU_0 * size:.4g} T)"
        return words

    def _slant(self, size: float) -> str:
        """How the magnetisation lies to the axis, if it is not along it."""
        slant = math.degrees(math.acos(min(abs(self.magnetization[2]) / size, 1.0)))
        if slant < 0.01:
            return ""
        return " across the axis" if slant > 89.99 else f" at {slant:.4g} deg to the axis"

    @property
    def ratio(self) -> float:
        """Radius at the distal end over that at the proximal one."""
        return 1.0 if self.end_radius is None else self.end_radius / self.radius

    @property
    def largest_radius(self) -> float:
        """Outer radius where it is widest [m]."""
        return max(self.radius, self.ratio * self.radius)

    @property
    def area(self) -> float:
        """Cross-section A [m^2], mean."""
        q = self.ratio
        return self._proximal_area * ((1.0 + q + q**2) / 3.0)

    @property
    def second_moment(self) -> float:
        """Second moment of area I [m^4], in series; the polar one is J = 2 I."""
        q = self.ratio
        proximal = math.pi * (self.radius**4 - self.inner_radius**4) / 4.0
        return proximal * (3.0 * q**3 / (1.0 + q + q**2))

    @property
    def bending_stiffness(self) -> float:
        """EI [N m^2]."""
        if self.stiffness is not None:
            return self.stiffness.bending
        assert self.youngs_modulus is not None
        return self.youngs_modulus * self.second_moment

    @property
    def twisting_stiffness(self) -> float:
        """GJ [N m^2]."""
        if self.stiffness is not None:
            return self.stiffness.twisting
        assert self.shear_modulus is not None
        return self.shear_modulus * 2.0 * self.second_moment

    @property
    def stretching_stiffness(self) -> float:
        """EA [N]."""
        if self.stiffness is not None:
            return self.stiffness.stretching
        assert self.youngs_modulus is not None
        return self.youngs_modulus * (self._proximal_area * self.ratio)

    @property
    def bending_modulus(self) -> float:
        """Young's modulus [Pa]; if it is not given, of a solid that bends like this section."""
        if self.youngs_modulus is not None:
            return self.youngs_modulus
        return self.bending_stiffness / self.second_moment

    @property
    def axial_inertia(self) -> float:
        """Moment of inertia about the axis per length [kg m], mean."""
        q = self.ratio
        proximal = (
            0.5 * self.density * self._proximal_area * (self.radius**2 + self.inner_radius**2)
        )
        return proximal * ((1.0 + q + q**2 + q**3 + q**4) / 5.0)

    @property
    def moment_per_length(self) -> Vector3:
        """Magnetic moment per unit length in the material frame, shape (3,) [A m] (P-6)."""
        m1, m2, m3 = self.magnetization
        return (m1 * self.area, m2 * self.area, m3 * self.area)

    @property
    def _proximal_area(self) -> float:
        return math.pi * (self.radius**2 - self.inner_radius**2)
