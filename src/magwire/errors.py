"""The errors magwire raises, and the checks that raise them.

Every message is one sentence that names the input, what was expected and what was received:
``Input radius of Section must be positive; received -0.1 m.``
"""

from __future__ import annotations

import math
from collections.abc import Iterable
from numbers import Integral, Real

import numpy as np
from numpy.typing import ArrayLike, NDArray

LONGEST = 200
"""Characters of a value that messages show."""


class MagwireError(Exception):
    """Any error that magwire raises on purpose."""


class InputError(MagwireError, ValueError):
    """A value that cannot be used; the message is one sentence."""


class ScenarioError(MagwireError):
    """A scenario that cannot be run.

    Parameters
    ----------
    faults
        One sentence each; all that are wrong with the scenario, not only the first.

    Attributes
    ----------
    faults
        The same sentences as a tuple.
    """

    def __init__(self, faults: str | Iterable[str]) -> None:
        self.faults: tuple[str, ...] = (faults,) if isinstance(faults, str) else tuple(faults)
        super().__init__("\n".join(self.faults))


class ResultError(MagwireError):
    """A result file that cannot be read or written."""


class ConvergenceError(MagwireError):
    """An equilibrium that was not found; the message names a remedy to try.

    Attributes
    ----------
    positions
        The last iterate, shape (nodes, 3) [m]. It is no equilibrium: its forces mean nothing.
    """

    def __init__(self, message: str, positions: NDArray[np.float64]) -> None:
        self.positions = positions
        super().__init__(message)


def shortened(value: object, *, quoted: bool = False) -> str:
    """A value as text, cut where it gets too long for a message."""
    try:
        text = repr(value) if quoted else str(value)
    except (ValueError, RecursionError):  # an integer of thousands of digits, a list that is deep
        return f"a very long {type(value).__name__}"
    return text if len(text) <= LONGEST else f"{text[: LONGEST // 2]} ... {text[-LONGEST // 4 :]}"


def received(value: object, unit: str = "") -> str:
    """A value as messages show it: short, with its unit."""
    if isinstance(value, bool) or not isinstance(value, (Real, np.ndarray)):
        return shortened(value, quoted=True)
    if isinstance(value, np.ndarray):
        text = np.array2string(value, precision=6, threshold=8, separator=", ").replace("\n", "")
    else:
        text = f"{value:.10g}" if isinstance(value, float) else shortened(value)
    return f"{text} {unit}".rstrip()


def refuse(owner: str, name: str, expected: str, value: object, unit: str = "") -> InputError:
    """The error for an input that is not what was expected, to be raised by the caller."""
    return InputError(
        f"Input {name} of {owner} must be {expected}; received {received(value, unit)}."
    )


def described(value: object) -> str:
    """A value as messages on kinds show it: plain values as they are, others by what they are."""
    if isinstance(value, type):
        return f"the class {value.__name__} itself"
    if value is None or isinstance(value, (str, bytes, Real, list, tuple, dict, np.ndarray)):
        return received(value)
    name = type(value).__name__
    return f"{'an' if name[0] in 'AEIOaeio' else 'a'} {name}"


def instance(owner: str, name: str, value: object, kind: type, *, or_none: bool = False) -> None:
    """Refuse what is not of a kind: swapped inputs, a class in place of one of it, a number.

    Parameters
    ----------
    owner, name
        Whose input, and which.
    value
        What was given.
    kind
        What it has to be.
    or_none
        Whether it may be left out.
    """
    if isinstance(value, kind) or (or_none and value is None):
        return
    article = "an" if kind.__name__[0] in "AEIO" else "a"
    raise InputError(
        f"Input {name} of {owner} must be {article} {kind.__name__}; received {described(value)}."
    )


def offering(
    owner: str, name: str, value: object, choices: Iterable[Iterable[str]], expected: str
) -> None:
    """Refuse what has not all members of one of the ``choices``, and classes.

    Parameters
    ----------
    owner, name
        Whose input, and which.
    value
        What was given.
    choices
        Names of members: all those of one choice are needed.
    expected
        What it has to be, in words.
    """
    kind = isinstance(value, type)
    if not kind and any(all(hasattr(value, member) for member in some) for some in choices):
        return
    raise InputError(f"Input {name} of {owner} must be {expected}; received {described(value)}.")


def numbers(owner: str, name: str, value: object) -> NDArray[np.float64]:
    """Return ``value`` as an array of floats of any shape; refuse what is none."""
    try:
        return np.array(value, dtype=np.float64)
    except (TypeError, ValueError):
        raise refuse(owner, name, "numbers", value) from None


def finite(owner: str, name: str, value: object, unit: str = "") -> float:
    """Return ``value`` as a float; refuse what is no number, NaN and infinity."""
    if isinstance(value, bool) or not isinstance(value, Real):
        raise refuse(owner, name, "a number", value)
    try:
        number = float(value)
    except OverflowError:  # an integer larger than any float
        number = math.inf
    if not math.isfinite(number):
        raise refuse(owner, name, "a finite number", number, unit)
    return number


def positive(owner: str, name: str, value: object, unit: str = "") -> float:
    """Return ``value`` as a float; refuse what is not finite or not above zero."""
    number = finite(owner, name, value, unit)
    if number <= 0.0:
        raise refuse(owner, name, "positive", number, unit)
    return number


def nonnegative(owner: str, name: str, value: object, unit: str = "") -> float:
    """Return ``value`` as a float; refuse what is not finite or below zero."""
    number = finite(owner, name, value, unit)
    if number < 0.0:
        raise refuse(owner, name, "zero or positive", number, unit)
    return number


def within(
    owner: str, name: str, value: object, unit: str = "", *, low: float, high: float
) -> float:
    """Return ``value`` as a float; refuse what is not finite or outside [``low``, ``high``]."""
    number = finite(owner, name, value, unit)
    if not low <= number <= high:
        expected = f"between {received(float(low))} and {received(float(high), unit)}"
        raise refuse(owner, name, expected, number, unit)
    return number


def whole(owner: str, name: str, value: object, *, minimum: int) -> int:
    """Return ``value`` as an int; refuse what is no whole number or below ``minimum``."""
    if isinstance(value, bool) or not isinstance(value, Integral):
        raise refuse(owner, name, "a whole number", value)
    if value < minimum:
        raise refuse(owner, name, f"at least {minimum}", int(value))
    return int(value)


def array(
    owner: str, name: str, value: ArrayLike, shape: tuple[int | None, ...], unit: str = ""
) -> NDArray[np.float64]:
    """Return ``value`` as an array of floats; refuse wrong shapes, NaN and infinity.

    ``None`` in ``shape`` stands for any length.
    """
    wanted = "(" + ", ".join("n" if n is None else str(n) for n in shape)
    wanted += ",)" if len(shape) == 1 else ")"
    try:
        result = np.array(value, dtype=np.float64)
    except (TypeError, ValueError):
        raise refuse(owner, name, f"numbers of shape {wanted}", value) from None
    fits = result.ndim == len(shape) and all(
        want is None or have == want for have, want in zip(result.shape, shape, strict=True)
    )
    if not fits:
        raise InputError(
            f"Input {name} of {owner} must have shape {wanted}; received shape {result.shape}."
        )
    if not np.all(np.isfinite(result)):
        raise refuse(owner, name, "finite", result, unit)
    return result


def one_of(owner: str, name: str, value: object, allowed: Iterable[str]) -> str:
    """Return ``value``; refuse what is not among the ``allowed`` words."""
    words = tuple(allowed)
    if not isinstance(value, str) or value not in words:
        raise refuse(owner, name, " or ".join(repr(word) for word in words), value)
    return value
