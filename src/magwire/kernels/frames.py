"""Tangents, frames and reference twist of a configuration, carried along its path (P-2)."""

from __future__ import annotations

from math import cos, floor, pi, sin

from magwire.kernels._jit import kernel, short
from magwire.kernels.angles import FARTHEST, arctan_series, sine_cosine
from magwire.kernels.groups import (
    group,
    largest_of,
    numbers,
    put_numbers,
    put_vectors,
    rows,
    vectors,
)
from magwire.kernels.hinge import angle_between, transport
from magwire.kernels.lanes import first, following, four, fourth, second, splat, third
from magwire.kernels.vectors import combine, cross, dot, norm, scale, sub

SMALL = 0.2  # sine over one plus cosine up to which an angle is taken from its series


@short
def update_frames(base, state, held):
    """Tangents and frames of ``state``, transported from ``base`` along time (P-2)."""
    last = state.length.shape[0] - 1
    t_e = d1_e = (splat(0.0), splat(0.0), splat(0.0))
    for j in range(held - 1, last + 1, 4):
        g = group(j, last)
        count = min(4, last + 1 - j)
        x, y, z, _ = rows(state.q, g)
        x_, y_, z_, _ = rows(state.q, (g[0] + 1, g[1] + 1, g[2] + 1, g[3] + 1))
        e = sub((x_, y_, z_), (x, y, z))
        length = norm(e)
        t = scale(1.0 / length, e)
        d1 = transport(vectors(base.director, g), vectors(base.tangent, g), t)
        put_numbers(state.length, j, count, length)
        put_vectors(state.tangent, j, count, t)
        put_vectors(state.director, j, count, d1)
        if j == held - 1:
            t_e, d1_e = t, d1  # the first edge has none before it
        kept = first(numbers(state.twist, g))
        put_numbers(
            state.twist,
            j,
            count,
            twist_between(after(d1_e, d1), after(t_e, t), d1, t, numbers(base.twist, g)),
        )
        if j == held - 1:
            state.twist[j] = kept
        t_e, d1_e = t, d1


@kernel
def after(before, v):
    """What each of four vectors comes after; see ``lanes.following``."""
    return following(before[0], v[0]), following(before[1], v[1]), following(before[2], v[2])


@kernel
def material_frames(d1, t, theta):
    """Material directors of four edges; see ``hinge.material_frame`` (P-2)."""
    if largest_of(abs(theta)) < FARTHEST:
        s, c = sine_cosine(theta)
    else:
        s = four(sin(first(theta)), sin(second(theta)), sin(third(theta)), sin(fourth(theta)))
        c = four(cos(first(theta)), cos(second(theta)), cos(third(theta)), cos(fourth(theta)))
    d2 = cross(t, d1)
    return combine(c, d1, s, d2), combine(c, d2, -s, d1)


@kernel
def twist_between(d1_e, te, d1_f, tf, before):
    """Reference twist of four hinges; see ``hinge.reference_twist``."""
    carried = transport(d1_e, te, tf)
    sine, cosine = dot(cross(carried, d1_f), tf), dot(carried, d1_f)
    half = sine / (1.0 + cosine)
    if largest_of(abs(half)) <= SMALL:
        angle = 2.0 * arctan_series(half)
    else:
        angle = four(
            angle_between(first(sine), first(cosine)),
            angle_between(second(sine), second(cosine)),
            angle_between(third(sine), third(cosine)),
            angle_between(fourth(sine), fourth(cosine)),
        )
    turns = floor((angle - before) * (0.5 / pi) + 0.5)
    return before + (angle - before - 2.0 * pi * turns)
