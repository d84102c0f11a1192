"""Random vessels planned by two builds: python -m campaigns.planner_vessels OLD [COUNT] [FIRST].

OLD is a checkout of another build. In vessels with the seeds FIRST, FIRST + 1, ... it plans in
three settings, with a ``tip_clearance`` of 0.4, 0.6 and 0.2, and what it says is reached is
replayed with inertia by this build. This build plans by default. A row for each vessel, and how
many of those that any setting reaches, and holds on replay, are reached; the exit status is 1 below
97 percent. Vessels are tubes that turn and swell at random, half of them with a side branch.
"""

from __future__ import annotations

import json
import os
import subprocess
import sys
import time
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

import magwire as mw

CLEARANCES = (0.4, 0.6, 0.2)
ENOUGH = 0.97
TURNS = 5  # pieces of a vessel's line, each with a curvature of its own
POINTS = 60
Array = NDArray[np.float64]


def line(chance: np.random.Generator, start: Array, ahead: Array, radius: float) -> mw.Lumen:
    """A tube from a point in a direction, 20 to 35 radii long."""
    length = radius * chance.uniform(20.0, 35.0)
    s = np.linspace(0.0, 1.0, POINTS)
    knots = np.linspace(0.0, 1.0, TURNS + 2)
    bends = chance.uniform(-0.3, 0.3, (TURNS + 2, 3)) / radius
    bends[0] = 0.0
    turn = np.stack([np.interp(s, knots, bend) for bend in bends.T], axis=1)
    direction, points = ahead / np.linalg.norm(ahead), [start]
    for here in turn[1:]:
        direction = direction + np.cross(here, direction) * length / (POINTS - 1)
        direction /= np.linalg.norm(direction)
        points.append(points[-1] + direction * length / (POINTS - 1))
    swell = np.interp(s, knots, np.append(0.0, chance.uniform(-0.2, 0.2, TURNS + 1)))
    radii = radius * (1.0 + swell) * (1.0 - 0.3 * s)
    return mw.Lumen.through(np.array(points), radii)


def vessel(seed: int) -> tuple[mw.Lumen, mw.Wire]:
    """The vessel of a seed, towards one outlet, and a wire."""
    chance = np.random.default_rng(seed)
    radius = chance.uniform(1.0e-3, 2.5e-3)
    main = line(chance, np.zeros(3), np.array([1.0, 0.0, 0.0]), radius)
    lumen = main
    if chance.random() < 0.5:
        tube = main.branches[0]
        s = np.array([chance.uniform(0.25, 0.5) * tube.length])
        ball, along = tube.curve.at(s)[0], tube.curve.at(s, 1)[0, :3]
        across = np.cross(along, chance.normal(size=3))
        lean = np.radians(chance.uniform(20.0, 60.0))
        ahead = np.cos(lean) * along + np.sin(lean) * across / np.linalg.norm(across)
        side = line(chance, ball[:3], ahead, 0.75 * ball[3])
        target = str(chance.choice(["main", "side"]))
        tree = mw.Lumen.tree({"main": main, "side": side}, target=target)
        lumen = replace(tree, paths={target: tree.paths[target]}, target=target)
    narrowest = lumen.path().narrowest
    thick = narrowest * chance.uniform(0.25, 0.5)
    edge = max(thick, 0.2 * narrowest)
    edges = max(round(50.0 * thick / edge), 10)
    wire = mw.Wire.uniform(
        length=edges * edge,
        radius=thick,
        youngs_modulus=3e6,
        shear_modulus=1e6,
        density=2000.0,
        nodes=edges + 1,
        magnetized_tip=10.0 * thick,
        magnetization=128e3,
    )
    return lumen, wire


def planned(seed: int, clearance: float) -> dict[str, Any]:
    """What a build says of a vessel in a setting, and its course; in any build."""
    kept: list[Any] = []
    run = mw.Simulation.run

    def keep(*args: Any, **options: Any) -> Any:
        kept.append(run(*args, **options))
        return kept[-1]

    lumen, wire = vessel(seed)
    mw.Simulation.run = keep  # type: ignore[method-assign]
    began = time.process_time()
    try:
        (found,) = mw.plan(lumen, wire, demands=mw.Demands(tip_clearance=clearance))
    finally:
        mw.Simulation.run = run  # type: ignore[method-assign]
    return {
        "reached": bool(found.reached),
        "peak": float(found.peak_field),
        "reason": found.reason,
        "seconds": time.process_time() - began,
        "feed": kept[-1].feed.tolist() if kept else [],
        "field": kept[-1].field.tolist() if kept else [],
    }


def holds(seed: int, course: dict[str, Any]) -> bool:
    """Whether a course gets there on replay with inertia."""
    from magwire.navigate.schedule import last_tries
    from magwire.planning.route import route_to

    lumen, wire = vessel(seed)
    way = route_to(lumen, wire)
    feed, field = np.array(course["feed"]), np.array(course["field"])
    tried = last_tries(feed)
    schedule = mw.Schedule(feed[tried], field[tried])
    result = way.run(float(schedule.feed[-1]), mw.Prescribed(schedule))
    return bool(way.replayed.tip_arc(result.position[-1]) >= way.goal)


def answers(seeds: list[int]) -> None:
    """What the build that runs says of vessels in all settings, a line of JSON each."""
    for seed in seeds:
        for clearance in CLEARANCES:
            try:
                found = planned(seed, clearance)
            except mw.MagwireError as error:
                found = {"reached": False, "peak": 0.0, "reason": f"{error}", "seconds": 0.0}
            print(json.dumps(found), flush=True)


def word(found: dict[str, Any]) -> str:
    """A cell of the table."""
    return f"{1e3 * found['peak']:.1f}" if found["reached"] else "no"


def main(old: str, count: int = 200, first: int = 0) -> int:
    """Plan in both builds."""
    seeds = []
    seed = first
    while len(seeds) < count:
        try:
            lumen, wire = vessel(seed)
            mw.Simulation(wire, lumen)
            seeds.append(seed)
        except mw.InputError:
            pass
        seed += 1
    paths = [str(Path(old) / "src"), str(Path(__file__).parents[1])]
    other = subprocess.Popen(
        [sys.executable, "-m", "campaigns.planner_vessels", "--answers", *map(str, seeds)],
        stdout=subprocess.PIPE,
        env=os.environ | {"PYTHONPATH": os.pathsep.join(paths)},
    )
    assert other.stdout is not None
    print("| seed | by default [mT] | before: 0.4, 0.6, 0.2 [mT] | held on replay | CPU [s] |")
    both = missed = 0
    try:
        for done, seed in enumerate(seeds, start=1):
            before = [json.loads(other.stdout.readline()) for _ in CLEARANCES]
            held = [found["reached"] and holds(seed, found) for found in before]
            now = planned(seed, CLEARANCES[0])
            times = ", ".join(f"{one['seconds']:.1f}" for one in (now, before[0]))
            print(
                f"| {seed} | {word(now)} | {', '.join(map(word, before))} "
                f"| {', '.join('yes' if one else 'no' for one in held)} | {times} |"
            )
            both += any(held)
            if any(held) and not now["reached"]:
                missed += 1
                print(f"  missed: {now['reason']}")
            print(f"  {done} vessels: {both - missed} of {both} reached.", flush=True)
    finally:
        other.kill()
    return int(both - missed < ENOUGH * both)


if __name__ == "__main__":
    if sys.argv[1] == "--answers":
        answers([int(seed) for seed in sys.argv[2:]])
    else:
        sys.exit(main(sys.argv[1], *map(int, sys.argv[2:])))
