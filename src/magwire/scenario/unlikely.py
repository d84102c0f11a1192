"""Values that a scenario may have, and that no material or magnet has: most often a wrong unit."""

from __future__ import annotations

import math
from collections.abc import Iterator
from typing import TYPE_CHECKING, Any, NamedTuple

from magwire.scenario.table import Table
from magwire.units import show

if TYPE_CHECKING:
    from magwire.scenario.model import Scenario


class _Known(NamedTuple):
    """What is known to exist: from least to most [SI], and examples of both."""

    dimension: str
    least: float
    most: float
    examples: str


KNOWN = {
    "youngs_modulus": _Known("pressure", 1e3, 1e12, "gels have some kPa, tungsten 410 GPa"),
    "shear_modulus": _Known("pressure", 3e2, 5e11, "gels have some 100 Pa, tungsten 160 GPa"),
    "density": _Known("density", 100.0, 23e3, "foams have some 100 kg/m^3, platinum 21450 kg/m^3"),
    "magnetization": _Known(
        "magnetization", 100.0, 2e6, "soft composites have some kA/m, iron 1710 kA/m at most"
    ),
    "remanence": _Known(
        "flux_density", 1e-4, 2.0, "soft composites have some mT, the strongest magnets 1.5 T"
    ),
    "flux_density": _Known(
        "flux_density", 0.0, 12.0, "laboratories' coils make some 100 mT, MRI scanners up to 11.7 T"
    ),
}
"""By the name that a value has in a table of the file. Of vectors it is the size that counts."""


def unlikely(scenario: Scenario) -> tuple[str, ...]:
    """A sentence for each value that is far from all that is known; zero is none of them."""
    return tuple(
        f"{key} is {show(size, known.dimension)}; {known.examples}: is its unit right?"
        for key, name, value in _values(scenario, "")
        if (known := KNOWN.get(name)) is not None
        for size in _sizes(value)
        if size != 0.0 and not known.least <= size <= known.most
    )


def _values(table: Table, path: str) -> Iterator[tuple[str, str, Any]]:
    """The values in a table and in those that it holds: key, last word of it, value."""
    for name in type(table).model_fields:
        value, key = getattr(table, name), f"{path}{name}"
        if isinstance(value, Table):
            yield from _values(value, f"{key}.")
        elif isinstance(value, (tuple, list)) and value and isinstance(value[0], Table):
            for i, one in enumerate(value):
                yield from _values(one, f"{key}[{i}].")
        else:
            yield key, name, value


def _sizes(value: Any) -> Iterator[float]:
    """The size of a number or of a vector; nothing of words."""
    if isinstance(value, (int, float)) and not isinstance(value, bool):
        yield abs(float(value))
    elif isinstance(value, tuple) and all(isinstance(part, (int, float)) for part in value):
        yield math.hypot(*value)
