"""Copies of a state: of its configuration, which Newton's method changes, and of all history."""

from __future__ import annotations

from magwire.kernels._jit import kernel


@kernel
def copy_configuration(source, target, held):
    """Copy where the wire is, from the guide's last edge to the tip."""
    nodes = source.q.shape[0]
    for i in range(held - 1, nodes):
        target.twist[i] = source.twist[i]
        for c in range(4):
            target.q[i, c] = source.q[i, c]
        if i < nodes - 1:
            target.length[i] = source.length[i]
            for c in range(3):
                target.tangent[i, c] = source.tangent[i, c]
                target.director[i, c] = source.director[i, c]


@kernel
def copy_state(source, target):
    """Copy all that a wire carries from one step to the next."""
    copy_configuration(source, target, 1)
    for i in range(source.q.shape[0]):
        for c in range(4):
            target.velocity[i, c] = source.velocity[i, c]
    for c in range(2):
        target.guide[c] = source.guide[c]
    target.held[0] = source.held[0]
    for k in range(source.inputs.shape[0]):
        target.inputs[k] = source.inputs[k]
    for i in range(source.contact.shape[0]):
        for c in range(source.contact.shape[1]):
            target.contact[i, c] = source.contact[i, c]
    for c in range(2):
        target.spent[c] = source.spent[c]
    target.clock[0] = source.clock[0]
