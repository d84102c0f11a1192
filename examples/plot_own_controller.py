"""
A controller of your own
========================

The wire is stepped from outside: a controller sees the tip late and with noise, as a camera would
show it, and points the field at a place on the centreline ahead of the tip. It knows nothing of the
wire's mechanics.
"""

from collections import deque

import matplotlib.pyplot as plt
import numpy as np

import magwire as mw

wire = mw.Wire.uniform(
    length=0.1,
    radius=0.6e-3,
    youngs_modulus=3e6,
    shear_modulus=1e6,
    density=2000.0,
    nodes=60,
    magnetized_tip=5e-3,
    magnetization=128e3,
)
lumen = mw.Lumen.half_circle(centreline_radius=0.025, radius=3e-3)
simulation = mw.Simulation(wire, lumen)
line, _ = lumen.centreline(0)

STRENGTH, AHEAD = 25e-3, 8e-3  # flux density [T]; distance at which the field aims [m]
RATE, DELAY, NOISE = 0.1, 2, 0.2e-3  # time between pictures [s]; pictures of delay; blur [m]


def aim(tip):
    """Uniform flux density towards the centreline ahead of the tip, shape (3,) [T]."""
    nearest = np.argmin(np.linalg.norm(line - tip, axis=1))
    spacing = np.linalg.norm(line[1] - line[0])
    target = line[min(nearest + round(AHEAD / spacing), len(line) - 1)]
    return STRENGTH * (target - tip) / np.linalg.norm(target - tip)


def push(steered):
    """Insertion [m], force on the tip and sum of all wall forces [N]."""
    chance, rows = np.random.default_rng(1), []
    with simulation.session() as robot:
        seen = robot.observe()
        pictures = deque([seen.tip] * DELAY, maxlen=DELAY)
        while seen.feed < 0.07:
            late = pictures[0] + chance.normal(0.0, NOISE, 3)
            robot.step(feed_speed=2e-3, inputs=aim(late) if steered else None, duration=RATE)
            seen = robot.observe()
            pictures.append(seen.tip)
            rows.append((seen.feed, seen.tip_force, seen.wall_force))
    return np.array(rows).T


largest = {}
for steered, colour in ((False, "tab:grey"), (True, "tab:blue")):
    feed, tip, wall = push(steered)
    name = "steered" if steered else "pushed"
    largest[name] = tip.max()
    plt.plot(1e3 * feed, 1e3 * tip, color=colour, label=f"{name}: tip")
    plt.plot(1e3 * feed, 1e3 * wall, color=colour, linestyle=":", label=f"{name}: wire")
    print(
        f"{name}: at most {1e3 * tip.max():.3f} mN on the tip, {1e3 * wall.max():.3f} on the wire"
    )

plt.xlabel("insertion [mm]")
plt.ylabel("force of the wall [mN]")
plt.legend()
plt.show()
