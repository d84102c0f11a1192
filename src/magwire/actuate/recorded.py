"""What a result's attributes and inputs say of the actuator that made its field."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]
Names = tuple[tuple[str, str], ...]

FIELD = ("T", "T", "T")
"""Units of inputs that are the field itself, which is recorded anyway."""


def names_of(attributes: Mapping[str, Any]) -> Names:
    """Name and SI unit of each input; none of a result of a version that had no inputs."""
    names, units = (str(attributes.get(f"input_{w}", "")).split(" ") for w in ("names", "units"))
    return tuple(zip(names, units, strict=True)) if names != [""] else ()


def of_hardware(attributes: Mapping[str, Any]) -> Names:
    """The inputs, if they are any but a uniform field's components."""
    names = names_of(attributes)
    return () if tuple(unit for _, unit in names) == FIELD else names


def power_of(attributes: Mapping[str, Any], inputs: Array) -> Array | None:
    """Heat of the coils, sum of R u^2, shape (t,) [W]; None if no resistance is known."""
    texts = str(attributes.get("input_resistances", "")).split()
    heat: Array | None = inputs**2 @ np.array(texts, dtype=np.float64) if texts else None
    return heat
