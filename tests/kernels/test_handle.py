"""Arrays behind one address."""

from __future__ import annotations

import numpy as np

from magwire.kernels._handle import Handle, parts_of, resolved
from magwire.kernels._jit import entry
from magwire.kernels.arrays import Motion


@entry
def weigh(handle, share):
    """Something to do with a number and an array: in a type of magwire's own, which are cached."""
    motion = parts_of(handle)
    total = 0.0
    for i in range(motion.target.shape[0]):
        total += motion.factor * motion.target[i]
        motion.target[i] = share * motion.target[i]
    return total


def test_what_lies_behind_a_handle_is_not_a_copy() -> None:
    numbers = np.array([1.0, 2.0, 4.0])
    handle = Handle(Motion(3.0, numbers))
    assert weigh(handle, 0.5) == 21.0
    assert numbers.tolist() == [0.5, 1.0, 2.0]


def test_a_handle_keeps_alive_what_lies_behind_it() -> None:
    handle = Handle(Motion(1.0, np.arange(1e6)))
    for _ in range(10):
        np.full(1_000_000, np.nan)  # takes the memory if it is free
    assert weigh(handle, 1.0) == 499999500000.0


def test_code_that_is_looked_up_once_serves_all_handles_of_a_kind() -> None:
    first, second = Handle(Motion(1.0, np.ones(2))), Handle(Motion(2.0, np.ones(5)))
    assert first.kind == second.kind
    assert Handle(Motion(1.0, np.ones((2, 2)))).kind != first.kind
    code = resolved(weigh, first, 1.0)
    assert (code(first, 1.0), code(second, 1.0)) == (2.0, 10.0)


@entry
def read_mixed(handle):
    """Each part of such a tuple as that below."""
    flag, (motion, (first, second)), other, count, flags, _, last = parts_of(handle)
    weights = motion.factor, motion.target[1], float(count), last
    return (flag, first, second, other, flags[0], flags[1]), weights


def test_compiled_code_finds_what_python_laid_out() -> None:
    """Flags take a byte and numbers eight, with gaps in front of them."""
    inner = Motion(1.5, np.array([0.0, 2.5])), (False, True)
    mixed = Handle((True, inner, True, -7, np.array([False, True]), (), 4.5))
    assert read_mixed(mixed) == (
        (True, False, True, True, False, True),
        (1.5, 2.5, -7.0, 4.5),
    )
