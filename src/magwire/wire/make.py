"""What a wire is made of, in the words that people have for it (P-4)."""

from __future__ import annotations

from collections.abc import Callable, Collection, Iterator, Sequence
from dataclasses import dataclass, fields, replace
from numbers import Real

from magwire.errors import InputError, array, finite, nonnegative, positive, within
from magwire.wire.section import MU_0, Section, Stiffness, Vector3

REQUIRED = (
    ("radius", "diameter"),
    ("youngs_modulus", "bending_stiffness"),
    ("density", "mass_per_length"),
)
EXCLUSIVE = (
    *REQUIRED,
    ("inner_radius", "inner_diameter"),
    ("magnetization", "remanence"),
    ("shear_modulus", "poisson_ratio"),
    ("twisting_stiffness", "poisson_ratio"),
    ("shear_modulus", "bending_stiffness"),
    ("twisting_stiffness", "youngs_modulus"),
    ("stretching_stiffness", "youngs_modulus"),
    ("taper_to", "bending_stiffness"),
    ("taper_to", "mass_per_length"),
)
"""Pairs of which one at least must be given, and pairs of which one at most may be."""

UNITS = {
    "diameter": "m",
    "radius": "m",
    "taper_to": "m",
    "youngs_modulus": "Pa",
    "shear_modulus": "Pa",
    "bending_stiffness": "N m^2",
    "twisting_stiffness": "N m^2",
    "stretching_stiffness": "N",
    "density": "kg/m^3",
    "mass_per_length": "kg/m",
}
"""What has to be positive."""


def contradictions(given: Collection[str], spell: Callable[[str], str]) -> Iterator[str]:
    """What is missing among the inputs that are given, and what is said twice, a sentence each."""
    for first, second in EXCLUSIVE:
        if first in given and second in given:
            yield f"Input {spell(first)} cannot stand next to {spell(second)}; remove one of them."
    twisting = "twisting_stiffness" if "bending_stiffness" in given else "shear_modulus"
    other = {"twisting_stiffness", "shear_modulus"} - {twisting}
    for first, second in (*REQUIRED, (twisting, "poisson_ratio")):
        doubled = first == twisting and other & set(given)  # which has its own sentence
        if first not in given and second not in given and not doubled:
            yield f"Input {spell(first)} is missing; give it, or {spell(second)}."


@dataclass(frozen=True, kw_only=True)
class Make:
    """What a wire, or a section of one, is made of, as people describe it.

    Parameters
    ----------
    diameter, radius
        Outer diameter or radius [m]; one of them.
    inner_diameter, inner_radius
        Diameter or radius of a bore [m]; at most one of them.
    taper_to
        Diameter at the distal end [m] of a make that tapers evenly; a bore does in proportion.
    youngs_modulus
        E [Pa]; with ``shear_modulus`` [Pa] or ``poisson_ratio``.
    poisson_ratio
        From 0 to 0.5: G = E/(2 (1 + nu)), and GJ = EI/(1 + nu).
    bending_stiffness
        EI [N m^2] in place of the modulus; with ``twisting_stiffness``, GJ [N m^2], or
        ``poisson_ratio``.
    stretching_stiffness
        EA [N] next to it; if left out, that of a uniform material of these diameters with this EI.
    density, mass_per_length
        [kg/m^3] or [kg/m]; one of them.
    magnetization, remanence
        Remanent magnetisation [A/m], or flux density [T] of mu_0 times as much: one number along
        the axis, or three components, best written ``mw.across(128e3)`` or ``mw.axial(128e3)``:
        their order is (m1, m2, tangent), and the *last* one is along the wire.
    rest_curvature
        Curvature of the unloaded wire towards m1 and m2, shape (2,) [1/m].
    rest_twist
        Angle per length by which m1 and m2 turn about the tangent of the unloaded wire [rad/m].

    Raises
    ------
    InputError
        With a sentence for everything that is out of range, missing or said twice.
    """

    diameter: float | None = None
    radius: float | None = None
    inner_diameter: float | None = None
    inner_radius: float | None = None
    taper_to: float | None = None
    youngs_modulus: float | None = None
    shear_modulus: float | None = None
    poisson_ratio: float | None = None
    bending_stiffness: float | None = None
    twisting_stiffness: float | None = None
    stretching_stiffness: float | None = None
    density: float | None = None
    mass_per_length: float | None = None
    magnetization: float | Sequence[float] | None = None
    remanence: float | Sequence[float] | None = None
    rest_curvature: Sequence[float] = (0.0, 0.0)
    rest_twist: float = 0.0

    def __post_init__(self) -> None:
        given = {field.name for field in fields(self) if getattr(self, field.name) is not None}
        faults = list(contradictions(given, "{} of Make".format))
        checks: list[Callable[[], object]] = [
            *(self._positive(name) for name in UNITS if name in given),
            lambda: within("Make", "poisson_ratio", self.poisson_ratio or 0.0, low=0.0, high=0.5),
            lambda: nonnegative("Make", "inner_radius", self.inner_radius or 0.0, "m"),
            lambda: nonnegative("Make", "inner_diameter", self.inner_diameter or 0.0, "m"),
            lambda: array("Make", "rest_curvature", self.rest_curvature, (2,), "1/m"),
            lambda: finite("Make", "rest_twist", self.rest_twist, "rad/m"),
            lambda: _vector("magnetization", self.magnetization, "A/m"),
            lambda: _vector("remanence", self.remanence, "T"),
        ]
        for check in checks:
            try:
                check()
            except InputError as error:
                faults.append(str(error))
        if faults:
            raise InputError(" ".join(faults))

    def section(self, length: float) -> Section:
        """A section of this make.

        Parameters
        ----------
        length
            Along the wire [m].
        """
        young, density = self.youngs_modulus, self.density
        bare = Section(
            length=length,
            youngs_modulus=1.0,  # until the cross-section is known
            shear_modulus=1.0,
            radius=_either(self.radius, self.diameter),
            density=1.0 if density is None else density,
            inner_radius=_either(self.inner_radius, self.inner_diameter),
            magnetization=self._magnetization(),
            rest_curvature=tuple(self.rest_curvature),  # type: ignore[arg-type]
            rest_twist=self.rest_twist,
            end_radius=None if self.taper_to is None else 0.5 * self.taper_to,
        )
        if self.mass_per_length is not None:
            bare = replace(bare, density=self.mass_per_length / bare.area)
        if young is not None:
            shear = self.shear_modulus
            if shear is None:
                assert self.poisson_ratio is not None
                shear = young / (2.0 * (1.0 + self.poisson_ratio))
            return replace(bare, youngs_modulus=young, shear_modulus=shear)
        stiffness = self._stiffness(bare.area / bare.second_moment)
        return replace(bare, youngs_modulus=None, shear_modulus=None, stiffness=stiffness)

    def _stiffness(self, area_by_moment: float) -> Stiffness:
        """EI, GJ and EA that are given, or follow from those that are."""
        bending, twisting = self.bending_stiffness, self.twisting_stiffness
        assert bending is not None
        if twisting is None:
            assert self.poisson_ratio is not None
            twisting = bending / (1.0 + self.poisson_ratio)
        stretching = self.stretching_stiffness
        return Stiffness(
            bending, twisting, bending * area_by_moment if stretching is None else stretching
        )

    def _magnetization(self) -> Vector3:
        m = _vector("magnetization", self.magnetization, "A/m")
        if self.remanence is None:
            return m
        b1, b2, b3 = _vector("remanence", self.remanence, "T")
        return (b1 / MU_0, b2 / MU_0, b3 / MU_0)

    def _positive(self, name: str) -> Callable[[], object]:
        return lambda: positive("Make", name, getattr(self, name), UNITS[name])


def _either(radius: float | None, diameter: float | None) -> float:
    """The radius, of the two that may be given; 0 if neither is."""
    return radius if radius is not None else 0.5 * (diameter or 0.0)


def _vector(name: str, value: float | Sequence[float] | None, unit: str) -> Vector3:
    """Three components, of which a lone number is the one along the axis."""
    if value is None:
        return (0.0, 0.0, 0.0)
    whole = (0.0, 0.0, float(value)) if isinstance(value, Real) else value
    x, y, z = array("Make", name, whole, (3,), unit).tolist()
    return (x, y, z)
