"""Random valid set-ups: does every point of the wire stay inside, and does every run complete?

    python tests/campaigns/random_setups.py [--count 600] [--first 0] [--workers 2]

Each seed makes a wire (20 to 500 mm, 0.1 to 1.5 mm thick, 1 MPa to 200 GPa), a lumen of any shape,
a time step of 1 to 100 ms, a course with or without retraction, and a field: none, one that turns
as the wire is fed, or one that jumps by 200 mT. What comes out is checked with a routine of its own
for the gap, at 25 points on every edge of every record. Prints a line for each set-up that is not
in order, and counts; exit status 1 if a point is outside, a run that is not complete says it is, or
fewer than 97 percent are.
"""

from __future__ import annotations

import argparse
import sys
import time
from concurrent.futures import ProcessPoolExecutor
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

import magwire as mw
from magwire.lumen import synthetic

Array = NDArray[np.float64]

POINTS = 25
STEPS = 1500  # time steps of a run, at most
ROUND_OFF = 1e-9  # of the lumen's radius


@dataclass(frozen=True)
class Answer:
    """What came of a seed."""

    seed: int
    text: str
    status: str
    outside: float  # depth of the deepest point, over the lumen's radius; 0 if there is none
    seconds: float


def log_uniform(rng: np.random.Generator, low: float, high: float) -> float:
    """A number whose logarithm is uniform."""
    return float(np.exp(rng.uniform(np.log(low), np.log(high))))


def lumen(rng: np.random.Generator, length: float, thick: float) -> tuple[str, mw.Lumen]:
    """A lumen of any shape in which a wire of this length and radius [m] fits."""
    radius = thick * (1.0 + log_uniform(rng, 0.3, 10.0))
    bend = radius * log_uniform(rng, 1.5, 12.0)
    kinds = ["straight", "half-circle", "sinusoid", "helix", "cone", "bends", "tree", "tortuous"]
    kind = str(rng.choice(kinds))
    if kind == "straight":
        return kind, mw.Lumen.straight(length, radius)
    if kind == "half-circle":
        return kind, mw.Lumen.half_circle(bend, radius)
    if kind == "sinusoid":
        period = 4.0 * bend
        amplitude = period**2 / (8.0 * np.pi**2 * bend)  # largest curvature: half of 1/bend
        return kind, mw.Lumen.sinusoid(amplitude, period, 3.0 * period, radius)
    if kind == "helix":
        return kind, mw.Lumen.helix(1.2 * bend, 2.0 * bend + 3.0 * radius, 12.0 * bend, radius)
    if kind == "cone":
        s = np.linspace(0.0, np.pi, 60)
        points = bend * np.column_stack([np.sin(s), 1.0 - np.cos(s), 0.0 * s])
        end = thick + (radius - thick) * rng.uniform(0.4, 1.0)
        return kind, mw.Lumen.through(points, np.linspace(radius, end, 60))
    if kind == "bends":
        arcs = np.cumsum(rng.uniform(1.0, 4.0, 8)) * bend
        curvature = rng.uniform(-0.8, 0.8, (8, 2)) / bend
        rows = np.column_stack([np.append(0.0, arcs), np.vstack([[0.0, 0.0], curvature])])
        return kind, mw.Lumen.bends(rows, radius)
    if kind == "tree":
        size = 2.0 * radius
        return kind, synthetic.carotid_bifurcation(
            radius=size, common=15.0 * size, length=14.0 * size
        )
    return kind, synthetic.tortuous(
        length=40.0 * radius,
        radius=1.3 * radius,
        end_radius=radius,
        amplitude=2.0 * radius,
        seed=int(rng.integers(1000)),
    )


def set_up(seed: int) -> tuple[str, mw.Simulation, mw.Feed, mw.Prescribed | None, float]:
    """Simulation, feed, field and time step of a seed."""
    rng = np.random.default_rng(seed)
    length = log_uniform(rng, 0.02, 0.5)
    thick = min(0.5 * log_uniform(rng, 0.1e-3, 1.5e-3), length / 40.0)
    modulus = log_uniform(rng, 1e6, 200e9)
    kind, where = lumen(rng, length, thick)
    bend = min(b.radius for b in where.bend_radius())
    narrowest = where.path().narrowest
    edge = min(0.5 * np.sqrt(8.0 * min(bend, length) * (narrowest - thick)), length / 15.0)
    nodes = int(np.clip(length / (edge * rng.uniform(0.2, 0.9)), 16, 320)) + 1
    wire = mw.Wire.uniform(
        length=length,
        radius=thick,
        youngs_modulus=modulus,
        shear_modulus=modulus / 3.0,
        density=2000.0 if modulus < 1e8 else 6500.0,
        nodes=nodes,
        magnetized_tip=length * rng.uniform(0.02, 0.1),
        magnetization=log_uniform(rng, 10e3, 300e3),
    )
    way = min(length, 0.95 * where.path().branches[0].length) * rng.uniform(0.3, 0.95)
    time_step = log_uniform(rng, 1e-3, 0.1)
    feed_per_step = max(log_uniform(rng, 1e-3, 0.3) * length / (nodes - 1), 1.5 * way / STEPS)
    speed = feed_per_step / time_step
    duration = way / speed
    feed = mw.Feed(speed, way)
    turned = rng.random() < 0.3
    if turned:
        feed = mw.Feed.table(
            [0.0, duration, 1.001 * duration, 1.45 * duration], [speed, speed, -speed, -speed]
        )
    field = rng.choice(["none", "turning", "jumps"])
    navigator = None
    if field == "turning":
        knots = np.linspace(0.0, way, 6)
        navigator = mw.Prescribed(mw.Schedule(knots, rng.normal(0.0, 0.03, (6, 3))))
    elif field == "jumps":
        knots = np.sort(
            np.concatenate([at + np.array([-1e-9, 1e-9]) for at in way * rng.uniform(0.1, 0.9, 4)])
        )
        values = rng.normal(size=(5, 3))
        values *= 0.1 / np.linalg.norm(values, axis=1)[:, None]
        values[2], values[4] = -values[1], -values[3]
        navigator = mw.Prescribed(mw.Schedule(knots, np.repeat(values, 2, axis=0)[1:-1]))
    text = (
        f"{kind} R={1e3 * narrowest:.3g} mm, bend {1e3 * bend:.3g} mm; wire {1e3 * length:.3g} mm, "
        f"r={1e3 * thick:.3g} mm, E={modulus:.2g} Pa, {nodes} nodes; feed {1e3 * way:.3g} mm, "
        f"{1e3 * speed:.3g} mm/s, dt={1e3 * time_step:.3g} ms"
        f"{', back' if turned else ''}; field {field}"
    )
    simulation = mw.Simulation(wire, where, damping=log_uniform(rng, 1e-3, 10.0))
    return text, simulation, feed, navigator, time_step


def gaps(where: mw.Lumen, points: Array) -> Array:
    """Depth of points in the union of balls, from dense samples and a parabola between them.

    Past the plane of an open end there is no wall.
    """
    best = np.full(len(points), -np.inf)
    for branch in where.branches:
        count = int(np.clip(40.0 * branch.length / branch.radius.min(), 400, 20_000))
        s = np.linspace(0.0, branch.length, count)
        at, along = branch.curve.at(s), branch.curve.at(s, 1)
        for block in np.array_split(
            np.arange(len(points)), max(1, len(points) * count // 4_000_000)
        ):
            away = np.linalg.norm(points[block, None] - at[None, :, :3], axis=2)
            depth = at[None, :, 3] - away
            k = np.argmax(depth, axis=1)
            # Beside the axis of a thin tube depth is no parabola over a whole step: look closer.
            fine = np.clip(s[k][:, None] + s[1] * np.linspace(-1.0, 1.0, 17), 0.0, branch.length)
            near = branch.curve.at(fine.ravel()).reshape(*fine.shape, 4)
            depth = near[..., 3] - np.linalg.norm(points[block, None] - near[..., :3], axis=2)
            rows, top = np.arange(len(block)), np.argmax(depth, axis=1)
            low, mid, high = (depth[rows, np.clip(top, 1, 15) + o] for o in (-1, 0, 1))
            bent = np.maximum(2.0 * mid - low - high, 1e-300)
            peak = mid + np.clip((high - low) ** 2 / (8.0 * bent), 0.0, np.abs(high - low))
            inside = (k > 0) & (k < count - 1)
            value = np.where(inside, np.maximum(peak, depth[rows, top]), depth[rows, top])
            for end, sign in ((0, -1.0), (count - 1, 1.0)):
                past = sign * np.einsum("ij,j->i", points[block] - at[end, :3], along[end, :3])
                value = np.where((k == end) & (past > -0.01 * at[end, 3]), np.inf, value)
            best[block] = np.maximum(best[block], value)
    return best


def deepest(simulation: mw.Simulation, result: mw.Result) -> float:
    """How far the worst point of any edge lies outside, over the lumen's radius."""
    where = simulation.system.lumen
    thick = simulation.system.keep_off
    scale = where.path().narrowest
    blended = max((b.blend for b in where.branches), default=0.0)
    s = np.linspace(0.0, 1.0, POINTS)[None, :, None]
    worst = 0.0
    edge = simulation.system.wire.edge_length
    behind = edge * (len(result.position[0]) - 1 - np.arange(len(result.position[0]) - 1)[:, None])
    behind = (behind - edge * s[0, :, 0]).ravel()  # length of wire from each point to the tip
    every = max(1, len(result.position) // 12)
    for position, fed in zip(result.position[::every], result.feed[::every], strict=True):
        points = (position[:-1, None] * (1.0 - s) + position[1:, None] * s).reshape(-1, 3)
        points = points[behind <= fed]  # the guide may lead through another part of the lumen
        near = (
            where.gap(points) < thick + 0.3 * scale
        )  # only a filter: what is far is not looked at
        if not near.any():
            continue
        depth = gaps(where, points[near]) - thick
        if blended > 0.0:  # rounded carinas lie outside the union of balls
            depth = np.maximum(
                depth, np.minimum(where.gap(points[near]) - thick, depth + blended / 3.0)
            )
        worst = max(worst, float(-depth.min()))
    return worst / scale if worst > ROUND_OFF * scale else 0.0


def answer(seed: int) -> Answer:
    """Run a seed."""
    began = time.perf_counter()
    text = ""
    try:
        text, simulation, feed, navigator, time_step = set_up(seed)
        every = max(feed.largest / 40.0, 1e-6)
        result = simulation.run(
            feed, navigator, time_step=time_step, record_every=every, update_every=every
        )
        status, outside = result.status, deepest(simulation, result)
        if result.message:
            text += f"; {result.message}"
    except mw.InputError as error:
        status, outside, text = "refused", 0.0, f"{text} {error}"
    return Answer(seed, text, status, outside, time.perf_counter() - began)


def main() -> int:
    """Run the seeds asked for."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--count", type=int, default=600)
    parser.add_argument("--first", type=int, default=0)
    parser.add_argument("--workers", type=int, default=1)
    options = parser.parse_args()
    answers = []
    with ProcessPoolExecutor(options.workers) as pool:
        for found in pool.map(answer, range(options.first, options.first + options.count)):
            answers.append(found)
            if found.outside > 0.0 or found.status != "complete":
                print(
                    f"seed {found.seed}: {found.status}, outside by {found.outside:.3g} R, "
                    f"{found.seconds:.1f} s: {found.text}",
                    flush=True,
                )
    valid = [a for a in answers if a.status != "refused"]
    complete = [a for a in valid if a.status == "complete"]
    outside = [a for a in valid if a.outside > 0.0]
    false = [a for a in outside if a.status == "complete"]
    print(
        f"{len(valid)} valid set-ups of {len(answers)}: {len(complete)} complete "
        f"({100.0 * len(complete) / max(1, len(valid)):.1f} percent), {len(outside)} with a point "
        f"outside, {len(false)} of these complete"
    )
    return 1 if outside or len(complete) < 0.97 * len(valid) else 0


if __name__ == "__main__":
    sys.exit(main())
