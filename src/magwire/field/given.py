"""A field as people give it: a source, or three components."""

from __future__ import annotations

from numbers import Real

import numpy as np
from numpy.typing import ArrayLike

from magwire.errors import array, offering
from magwire.field.source import FieldSource
from magwire.field.uniform import UniformField


def as_field(owner: str, value: FieldSource | ArrayLike) -> FieldSource:
    """The source that is meant.

    Parameters
    ----------
    owner
        Whose input ``field`` it is, for messages.
    value
        A source, or the three components of a uniform flux density, shape (3,) [T].

    Raises
    ------
    InputError
        If it is neither.
    """
    if isinstance(value, (list, tuple, np.ndarray, Real)):
        flux = array(owner, "field", value, (3,), "T")
        return UniformField((float(flux[0]), float(flux[1]), float(flux[2])))
    expected = "three components [T] or a field with at(points) and affine, such as UniformField()"
    offering(owner, "field", value, [("at", "affine")], expected)
    assert isinstance(value, FieldSource)
    return value
