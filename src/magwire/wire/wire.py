"""A wire: sections from the proximal end to the tip, and the number of nodes on it."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, replace
from functools import cached_property
from numbers import Real

from magwire.errors import (
    InputError,
    array,
    described,
    instance,
    nonnegative,
    positive,
    refuse,
    whole,
)
from magwire.wire.make import Make
from magwire.wire.section import Section

SHOWN = 4  # sections that a wire lists of itself


@dataclass(frozen=True)
class Wire:
    """A magnetic soft continuum robot: a thin wire made of sections (P-1, P-4).

    Parameters
    ----------
    sections
        From the proximal end to the tip.
    nodes
        Number of nodes, evenly spaced; the wire has one edge fewer.

    Raises
    ------
    InputError
        If there is no section, there are fewer than 5 nodes, or a section is shorter than an edge.
    """

    sections: tuple[Section, ...]
    nodes: int

    def __post_init__(self) -> None:
        if isinstance(self.sections, (str, bytes)) or not isinstance(self.sections, Sequence):
            raise InputError(
                "Input sections of Wire must be a list of Section; received "
                f"{described(self.sections)}."
            )
        if not self.sections or not all(isinstance(s, Section) for s in self.sections):
            raise refuse("Wire", "sections", "at least one Section", self.sections)
        object.__setattr__(self, "sections", tuple(self.sections))
        object.__setattr__(self, "nodes", whole("Wire", "nodes", self.nodes, minimum=5))
        shortest = min(section.length for section in self.sections)
        if shortest < self.edge_length * (1.0 - 1e-9):
            needed = math.ceil(self.length / shortest) + 1
            raise InputError(
                f"Input nodes of Wire must be at least {needed}, so that the section of "
                f"{shortest:.6g} m spans an edge; received {self.nodes}."
            )

    def __repr__(self) -> str:
        lines = [
            f"{1e3 * section.length:.6g} mm: {section.describe()}" for section in self.sections
        ]
        if len(lines) > SHOWN:
            lines = [*lines[: SHOWN - 1], f"{len(lines) - SHOWN} more", lines[-1]]
        plural = "" if len(self.sections) == 1 else "s"
        head = f"Wire of {1e3 * self.length:.6g} mm, {len(self.sections)} section{plural}"
        return "\n  ".join([f"{head}, {self.nodes} nodes, proximal first:", *lines])

    @classmethod
    def uniform(
        cls,
        length: float,
        radius: float,
        youngs_modulus: float,
        shear_modulus: float,
        density: float,
        nodes: int,
        *,
        magnetized_tip: float = 0.0,
        magnetization: float | Sequence[float] = 0.0,
        inner_radius: float = 0.0,
        rest_curvature: Sequence[float] = (0.0, 0.0),
    ) -> Wire:
        """A wire of one material, of which the distal part is magnetised.

        Parameters
        ----------
        length, radius, inner_radius
            Length, outer radius and bore [m].
        youngs_modulus, shear_modulus
            Elastic moduli E and G [Pa].
        density
            Mass per volume [kg/m^3].
        nodes
            Number of nodes.
        magnetized_tip
            Length of the magnetised distal part [m]; the whole length magnetises all of it.
        magnetization
            Remanent magnetisation of that part [A/m]: one number along the axis, or three
            components, best written ``mw.across(128e3)`` or ``mw.axial(128e3)``: their order is
            (m1, m2, tangent), and the *last* one is along the wire.
        rest_curvature
            Curvature of the unloaded wire towards m1 and m2, shape (2,) [1/m].

        Examples
        --------
        >>> import magwire as mw
        >>> wire = mw.Wire.uniform(
        ...     length=0.1, radius=0.6e-3, youngs_modulus=3e6, shear_modulus=1e6, density=2000.0,
        ...     nodes=100, magnetized_tip=5e-3, magnetization=128e3,
        ... )
        >>> wire.magnet
        (0.095, 0.1)
        """
        positive("Wire", "length", length, "m")
        tip = nonnegative("Wire", "magnetized_tip", magnetized_tip, "m")
        if tip > length:
            raise refuse("Wire", "magnetized_tip", f"at most the length {length:.10g} m", tip, "m")
        lone = isinstance(magnetization, Real)
        magnet = (0.0, 0.0, magnetization) if lone else magnetization
        moment = array("Wire", "magnetization", magnet, (3,), "A/m").tolist()
        curved = array("Wire", "rest_curvature", rest_curvature, (2,), "1/m").tolist()

        def section(part: float, moments: Sequence[float]) -> Section:
            return Section(
                length=part,
                youngs_modulus=youngs_modulus,
                shear_modulus=shear_modulus,
                radius=radius,
                density=density,
                inner_radius=inner_radius,
                magnetization=tuple(moments),  # type: ignore[arg-type]
                rest_curvature=(curved[0], curved[1]),
            )

        parts = []
        if tip < length or tip == 0.0:
            parts.append(section(length - tip, (0.0, 0.0, 0.0)))
        if tip > 0.0:
            parts.append(section(tip, moment))
        return cls(sections=tuple(parts), nodes=nodes)

    @classmethod
    def of(cls, make: Make, length: float, nodes: int, *, magnetized_tip: float = 0.0) -> Wire:
        """A wire of one make, of which the distal part is magnetised.

        Parameters
        ----------
        make
            What it is made of; a taper goes over the whole length.
        length
            Length [m].
        nodes
            Number of nodes.
        magnetized_tip
            Length of the magnetised distal part [m]; the whole length magnetises all of it.

        Raises
        ------
        InputError
            If a value is out of its range.

        Examples
        --------
        >>> import magwire as mw
        >>> make = mw.Make(diameter=0.36e-3, youngs_modulus=60e9, poisson_ratio=0.3, density=6450.0)
        >>> mw.Wire.of(make, length=0.1, nodes=51)
        Wire of 100 mm, 1 section, 51 nodes, proximal first:
          100 mm: diameter 0.36 mm, EI 4.947e-05 N m^2, GJ 3.805e-05 N m^2, EA 6107 N
        """
        instance("Wire", "make", make, Make)
        tip = nonnegative("Wire", "magnetized_tip", magnetized_tip, "m")
        whole = make.section(length)
        if tip > length:
            raise refuse("Wire", "magnetized_tip", f"at most the length {length:.10g} m", tip, "m")
        bare = replace(whole, magnetization=(0.0, 0.0, 0.0))
        if tip in (0.0, length):
            return cls((whole if tip else bare,), nodes)
        body, magnet = bare.cut(0.0, length - tip), whole.cut(length - tip, length)
        return cls((body, replace(magnet, length=tip)), nodes)

    @cached_property
    def length(self) -> float:
        """Length L [m]."""
        return math.fsum(section.length for section in self.sections)

    @property
    def edge_length(self) -> float:
        """Distance between nodes along the wire [m]."""
        return self.length / (self.nodes - 1)

    @property
    def radius(self) -> float:
        """Largest outer radius [m]."""
        return max(section.largest_radius for section in self.sections)

    @property
    def body(self) -> Section:
        """The longest section: its stiffness is the scale of the paper's numbers (P-18)."""
        return max(self.sections, key=lambda section: section.length)

    @property
    def bending_stiffness(self) -> float:
        """EI of the longest section [N m^2] (P-18)."""
        return self.body.bending_stiffness

    @property
    def moment_per_length(self) -> float:
        """Largest magnetic moment per unit length [A m]; 0 without magnetisation (P-6)."""
        return max(math.hypot(*section.moment_per_length) for section in self.sections)

    @property
    def magnet(self) -> tuple[float, float]:
        """Where the most distal magnet begins and ends, from the proximal end [m]; NaN if none.

        Sections that are magnetised and follow each other are one magnet.
        """
        begin = end = math.nan
        place = self.length
        for section in reversed(self.sections):
            if math.hypot(*section.moment_per_length) > 0.0:
                end = place if math.isnan(end) else end
                begin = max(place - section.length, 0.0)
            elif not math.isnan(end):
                break
            place -= section.length
        return begin, end
