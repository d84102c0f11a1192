"""Copies of a state: of its configuration, which Newton's method changes, and of all history."""

from __future__ import annotations

from magwire.kernels._jit import kernel, short
from magwire.kernels.lanes import copy_rows


@short
def copy_configuration(source, target, held):
    """Copy where the wire is, from the guide's last edge to the tip."""
    begin, nodes = held - 1, source.q.shape[0]
    copy_rows(source.q, target.q, begin, nodes)
    copy_rows(source.twist, target.twist, begin, nodes)
    copy_rows(source.length, target.length, begin, nodes - 1)
    copy_rows(source.tangent, target.tangent, begin, nodes - 1)
    copy_rows(source.director, target.director, begin, nodes - 1)


@kernel
def copy_state(source, target):
    """Copy all that a wire carries from one step to the next."""
    copy_configuration(source, target, 1)
    copy_rows(source.velocity, target.velocity, 0, source.velocity.shape[0])
    for c in range(2):
        target.guide[c] = source.guide[c]
    target.held[0] = source.held[0]
    for k in range(source.inputs.shape[0]):
        target.inputs[k] = source.inputs[k]
    copy_rows(source.contact, target.contact, 0, source.contact.shape[0])
    for c in range(2):
        target.spent[c] = source.spent[c]
    target.clock[0] = source.clock[0]
