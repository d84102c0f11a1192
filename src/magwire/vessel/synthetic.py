"""Vessels with a formula: anatomically sensible shapes that need nobody's data.

Sizes are those of an adult and are parameters, in metres. Where there is chance in a shape, its
seed is a parameter, too.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from magwire.errors import InputError, nonnegative, positive, whole
from magwire.lumen.branch import Branch
from magwire.lumen.lumen import Lumen

Array = NDArray[np.float64]

POINTS = 60  # of a centreline
UP = np.array([0.0, 0.0, 1.0])
SUPRA_AORTIC = {  # angle along the arch [deg], radius and length [m], first direction
    "left subclavian": (58.0, 4.5e-3, 70e-3, (0.15, 0.35, 1.0)),
    "left carotid": (82.0, 3.5e-3, 90e-3, (0.35, 0.1, 1.0)),
    "brachiocephalic": (112.0, 6.0e-3, 50e-3, (0.45, -0.35, 1.0)),
}
WAVES = 3  # of a tortuous vessel, in each of two directions
STEM, LENGTHS, LEAN = 12e-3, (90e-3, 70e-3), 0.9  # of a coronary tree: trunk, arteries, and spread
MURRAY = 3.0  # exponent that links the radii at a bifurcation


def aortic_arch(
    *,
    arch_radius: float = 35e-3,
    radius: float = 11e-3,
    ascending_radius: float = 14e-3,
    descending: float = 60e-3,
    ascending: float = 50e-3,
    target: str = "left carotid",
) -> Lumen:
    """Aorta with its three supra-aortic branches, entered from the descending aorta.

    The wire comes from the femoral artery, upwards along z. The centreline goes straight for
    ``descending``, around half a circle, and straight down. The branches are on the arch's convex
    side, the left subclavian artery first.

    Parameters
    ----------
    arch_radius
        Radius of the arch's centreline [m].
    radius, ascending_radius
        Radius of the lumen in the descending and ascending aorta, linear between [m].
    descending, ascending
        Lengths of the straight parts [m].
    target
        "left carotid", "left subclavian", "brachiocephalic" or "ascending aorta".
    """
    owner = "aortic_arch"
    around = positive(owner, "arch_radius", arch_radius, "m")
    first = positive(owner, "radius", radius, "m")
    last = positive(owner, "ascending_radius", ascending_radius, "m")
    down = positive(owner, "descending", descending, "m")
    up = positive(owner, "ascending", ascending, "m")
    if around <= max(first, last):
        raise InputError(
            f"Input arch_radius of aortic_arch must be larger than the lumen's radius "
            f"{max(first, last):.6g} m; received {around:.6g} m."
        )
    whole_way = down + np.pi * around + up
    s = np.linspace(0.0, whole_way, 4 * POINTS)
    centre = arch_centreline(s, around, down)
    aorta = Lumen.through(centre, first + (last - first) * s / whole_way)
    branches = {"ascending aorta": aorta}
    for name, (angle, size, length, direction) in SUPRA_AORTIC.items():
        start = arch_centreline(np.array([down + np.radians(angle) * around]), around, down)[0]
        branches[name] = Lumen.through(turning(start, np.array(direction), UP, length), size)
    return Lumen.tree(branches, target=target)


def arch_centreline(s: Array, around: float, down: float) -> Array:
    """Points at arc lengths along a line up, half a circle and a line down, shape (n, 3)."""
    angle = np.clip((s - down) / around, 0.0, np.pi)
    height = np.minimum(s, down) - np.maximum(s - down - np.pi * around, 0.0)
    x, z = around * (1.0 - np.cos(angle)), height + around * np.sin(angle)
    return np.column_stack([x, np.zeros(len(s)), z])


def carotid_bifurcation(
    *,
    radius: float = 3.2e-3,
    common: float = 50e-3,
    length: float = 45e-3,
    angle: float = 0.45,
    target: str = "internal",
) -> Lumen:
    """Common carotid artery that parts into the internal one, with its bulb, and the external one.

    Parameters
    ----------
    radius
        Radius of the common artery [m]; the internal one has 0.72 of it past the bulb, the
        external one 0.6.
    common, length
        Lengths of the common artery and of each of the two [m].
    angle
        Between the internal artery's first direction and the common one's [rad]; the external one
        leaves by as much to the other side.
    target
        "internal" or "external".
    """
    owner = "carotid_bifurcation"
    wide = positive(owner, "radius", radius, "m")
    low = positive(owner, "common", common, "m")
    high = positive(owner, "length", length, "m")
    lean = positive(owner, "angle", angle, "rad")
    trunk = np.column_stack([np.zeros((POINTS, 2)), np.linspace(0.0, low, POINTS)])
    ends = {}
    for name, side, share in (("internal", 1.0, 0.72), ("external", -1.0, 0.6)):
        first = np.array([side * np.sin(lean), 0.0, np.cos(lean)])
        past = turning(trunk[-1], UP, first, 0.3 * high)
        past = np.concatenate([past[:-1], turning(past[-1], first, UP, 0.7 * high)])[1:]
        t = progress(past)
        bulb = 0.28 * np.exp(-(((t - 0.18) / 0.12) ** 2)) if side > 0.0 else 0.0
        size = wide * (share + (1.0 - share) * (1.0 - np.minimum(t / 0.2, 1.0)) ** 2 + bulb)
        points = np.concatenate([trunk, past])
        ends[name] = Lumen.through(
            points, np.concatenate([np.full(POINTS, wide), np.minimum(size, 1.04 * wide)])
        )
    return Lumen.tree(ends, target=target)


def tortuous(
    *,
    length: float = 120e-3,
    radius: float = 3e-3,
    end_radius: float = 1.5e-3,
    amplitude: float = 6e-3,
    seed: int = 0,
) -> Lumen:
    """A tapered vessel that winds in space, as chance has it.

    Parameters
    ----------
    length
        From end to end along x [m]; the vessel itself is longer.
    radius, end_radius
        Radius of the lumen at the entrance and at the end, linear between [m].
    amplitude
        Root mean square of its waves [m].
    seed
        Seed of their phases.
    """
    owner = "tortuous"
    far = positive(owner, "length", length, "m")
    first = positive(owner, "radius", radius, "m")
    last = positive(owner, "end_radius", end_radius, "m")
    high = nonnegative(owner, "amplitude", amplitude, "m")
    chance = np.random.default_rng(whole(owner, "seed", seed, minimum=0))
    t = np.linspace(0.0, 1.0, 4 * POINTS)
    sway = np.zeros((len(t), 2))
    for wave in range(1, WAVES + 1):
        phase = chance.uniform(0.0, 2.0 * np.pi, 2)
        sway += np.sin(2.0 * np.pi * wave * t[:, None] + phase) / wave**2
    sway *= high / max(
        float(np.sqrt(np.mean(np.sum((sway - sway.mean(axis=0)) ** 2, axis=1)))), 1e-12
    )
    fade = np.minimum(t / 0.2, 1.0)[:, None]
    sway = (sway - sway[0]) * fade**2 * (3.0 - 2.0 * fade)  # enters straight along x
    return Lumen.through(np.column_stack([far * t, sway]), first + (last - first) * t)


def coronary_tree(
    *, radius: float = 2.2e-3, diagonals: int = 2, seed: int = 0, target: str = "anterior"
) -> Lumen:
    """A left main artery that parts into two, the first of which has side branches.

    The radii at a bifurcation follow Murray's law, the cubes of two adding up to that of the
    third; the arteries taper to six tenths.

    Parameters
    ----------
    radius
        Radius of the left main artery [m].
    diagonals
        Number of side branches of the anterior artery, at most 3.
    seed
        Seed of directions and places.
    target
        "anterior", "circumflex", or "diagonal 1" and so on.
    """
    owner = "coronary_tree"
    wide = positive(owner, "radius", radius, "m")
    if not 0 <= whole(owner, "diagonals", diagonals, minimum=0) <= 3:
        raise InputError(
            f"Input diagonals of coronary_tree must be at most 3; received {diagonals}."
        )
    chance = np.random.default_rng(whole(owner, "seed", seed, minimum=0))
    trunk = np.column_stack([np.linspace(0.0, STEM, 12), np.zeros((12, 2))])
    size = wide * 0.5 ** (1.0 / MURRAY)
    branches = {}
    for name, side, length in zip(("anterior", "circumflex"), (1.0, -1.0), LENGTHS, strict=True):
        first = np.array([1.0, side * chance.uniform(0.5, 0.7), 0.1 * chance.normal()])
        last = np.array([0.55, side * LEAN, -0.5 + 0.1 * chance.normal()])
        past = turning(trunk[-1], np.array([1.0, 0.0, 0.0]), first, 0.25 * length)
        past = np.concatenate([past[:-1], turning(past[-1], first, last, 0.75 * length)])
        t = progress(past)
        narrowing = np.minimum(t / 0.1, 1.0)
        own = (wide + narrowing * (size - wide)) * (1.0 - 0.4 * t)
        points = np.concatenate([trunk, past[1:]])
        branches[name] = Lumen.through(points, np.concatenate([np.full(12, wide), own[1:]]))
    stem = branches["anterior"].branches[0]
    for k in range(diagonals):
        branches[f"diagonal {k + 1}"] = _diagonal(stem, (k + 1) / (diagonals + 1), k, chance)
    return Lumen.tree(branches, target=target)


def _diagonal(stem: Branch, place: float, number: int, chance: np.random.Generator) -> Lumen:
    """A side branch of an artery, at a part of its path."""
    s = np.array([STEM + (0.1 + 0.65 * place) * (stem.length - STEM)])
    ball, ahead = stem.curve.at(s)[0], stem.curve.at(s, 1)[0, :3]
    up = np.array([0.0, 0.0, 1.0 if number % 2 == 0 else -1.0])
    across = up - ahead * (up @ ahead)
    lean = np.radians(chance.uniform(35.0, 50.0))
    first = np.cos(lean) * ahead + np.sin(lean) * across / np.linalg.norm(across)
    length = chance.uniform(25e-3, 35e-3)
    points = turning(ball[:3], first, first + 0.3 * chance.normal(size=3), length)
    return Lumen.through(points, 0.62 * ball[3] * np.linspace(1.0, 0.8, len(points)))


def turning(start: Array, first: Array, last: Array, length: float) -> Array:
    """Points of a curve that turns from one direction into another, shape (n, 3).

    At both ends it is straight.
    """
    begin, end = first / np.linalg.norm(first), last / np.linalg.norm(last)
    t = np.linspace(0.0, 1.0, POINTS)[:, None]
    course = begin + t * t * (3.0 - 2.0 * t) * (end - begin)
    course /= np.linalg.norm(course, axis=1)[:, None]
    steps = 0.5 * (course[1:] + course[:-1]) * length / (POINTS - 1)
    return np.asarray(start + np.concatenate([np.zeros((1, 3)), np.cumsum(steps, axis=0)]))


def progress(points: Array) -> Array:
    """Arc length of points over that of all, shape (n,)."""
    steps = np.linalg.norm(np.diff(points, axis=0), axis=1)
    along = np.concatenate([[0.0], np.cumsum(steps)])
    part: Array = along / along[-1]
    return part
