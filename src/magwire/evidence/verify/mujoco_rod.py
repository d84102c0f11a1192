"""The wire as MuJoCo's elastic rod: a one-dimensional flex, a discrete elastic rod (group 8).

MuJoCo 4 integrates its bending implicitly (``integrator="discrete"``) and keeps the lengths of
edges by constraints. Those are springs with the mass of a node over the square of the time step:
they hold only if the time step is short against the waves along the wire that they stand for.
"""

from __future__ import annotations

import time
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]
DAMPING = 5.0  # of what settles, against the velocities [1/s]
AT_REST = 1e-5  # largest speed that may be left over [m/s]


@dataclass(frozen=True)
class Rod:
    """A round wire of one material, clamped at the origin along x.

    The first edge is fixed and reaches half its length in front of the origin, since a rod whose
    first edge is held is clamped at the middle of that edge.
    """

    length: float
    nodes: int
    radius: float
    youngs_modulus: float
    shear_modulus: float
    density: float

    @property
    def edge(self) -> float:
        """Length of an edge [m]."""
        return self.length / (self.nodes - 1.5)

    @property
    def start(self) -> Array:
        """Nodes of the straight rod, shape (nodes, 3) [m]."""
        x = self.edge * (np.arange(self.nodes) - 0.5)
        return np.column_stack((x, np.zeros((self.nodes, 2))))

    def model(self, time_step: float, *, flat: bool = False, walls: str = "") -> Any:
        """As MuJoCo's model; ``flat`` keeps the rod in the xy plane."""
        import mujoco

        points = " ".join(f"{x:.12g} 0 0" for x in self.start[:, 0])
        pairs = " ".join(f"{i} {i + 1}" for i in range(self.nodes - 1))
        mass = self.density * np.pi * self.radius**2 * self.edge * self.nodes
        spring = f'solref="{-0.5 / time_step**2} {-1.0 / time_step}"'
        edge, wall = (f'{spring} solimp="{least} 0.9999 1e-6"' for least in (0.999, 0.99))
        return mujoco.MjModel.from_xml_string(f"""<mujoco>
          <option timestep="{time_step}" integrator="discrete" gravity="0 0 0"
            tolerance="1e-14" iterations="100"/>
          <default><geom condim="1" {wall}/></default>
          <worldbody>{walls}
            <flexcomp name="rod" type="direct" dim="1" dof="{"2d" if flat else "full"}"
              mass="{mass}" radius="{self.radius}" point="{points}" element="{pairs}">
              <edge equality="true" {edge}/>
              <contact selfcollide="none" condim="1" {wall}/>
              <elasticity young="{self.youngs_modulus}" shear="{self.shear_modulus}"/>
              <pin id="0 1"/>
            </flexcomp>
          </worldbody></mujoco>""")


@dataclass(frozen=True)
class Settled:
    """A rod that has come to rest.

    Attributes
    ----------
    nodes
        Shape (nodes, 3) [m].
    wall_force
        Sum of the sizes of the walls' forces [N].
    step_seconds, steps
        Time that a step of MuJoCo took, without the forces of the field, and their number.
    """

    nodes: Array
    wall_force: float
    step_seconds: float
    steps: int


def half_circle_walls(bend: float, radius: float, facets: int) -> str:
    """A channel around (0, bend): the outer wall of facets, the inner one a cylinder."""
    walls = []
    for angle in np.linspace(-0.5 * np.pi, 0.5 * np.pi, facets):
        x, y = np.cos(angle), np.sin(angle)
        place = f"{(bend + radius) * x:.12g} {(bend + radius) * y + bend:.12g} 0"
        walls.append(
            f'<geom type="plane" size="0 0 1" pos="{place}" zaxis="{-x:.12g} {-y:.12g} 0"/>'
        )
    walls.append(f'<geom type="capsule" size="{bend - radius} 0.05" pos="0 {bend} 0"/>')
    return "".join(walls)


def settle(
    model: Any,
    duration: float,
    *,
    begin: Array | None = None,
    couple: tuple[float, Array] | None = None,
) -> Settled:
    """Step a rod to rest, from where it is straight or from ``begin``, shape (nodes, 3) [m].

    ``couple``: magnetic moment of an edge [A m^2] and flux density [T]. The torque on an edge is a
    pair of forces on its nodes.
    """
    import mujoco

    data = mujoco.MjData(model)
    mujoco.mj_forward(model, data)
    bodies = model.flex_vertbodyid
    free = np.flatnonzero(bodies > 0)
    axes = 3 if model.body_jntnum[bodies[free[0]]] == 3 else 2
    joints = model.body_jntadr[bodies[free]][:, None] + np.arange(axes)
    speeds, places = model.jnt_dofadr[joints], model.jnt_qposadr[joints]
    if begin is not None:
        data.qpos[places] = (begin - data.flexvert_xpos)[free, :axes]
        mujoco.mj_forward(model, data)
    mass = model.body_mass[bodies[free]][:, None]
    steps = round(duration / model.opt.timestep)
    seconds = 0.0  # of MuJoCo's own steps
    for _ in range(steps):
        push = np.zeros((len(free), 3))
        push[:, :axes] = -DAMPING * mass * data.qvel[speeds]
        if couple is not None:
            push += _couples(data.flexvert_xpos, *couple)[free]
        data.xfrc_applied[bodies[free], :3] = push
        clock = time.perf_counter()
        mujoco.mj_step(model, data)
        seconds += time.perf_counter() - clock
    mujoco.mj_forward(model, data)
    if not np.abs(data.qvel).max() < AT_REST:
        raise RuntimeError("MuJoCo's rod has not come to rest.")
    return Settled(data.flexvert_xpos.copy(), _wall_force(model, data), seconds / steps, steps)


def _wall_force(model: Any, data: Any) -> float:
    """Sum of the sizes of the normal forces of all contacts [N]."""
    import mujoco

    force, total = np.zeros(6), 0.0
    for i in range(data.ncon):
        mujoco.mj_contactForce(model, data, i, force)
        total += abs(float(force[0]))
    return total


def _couples(nodes: Array, moment: float, flux: Array) -> Array:
    """Forces on the nodes of edges of energy -m t.B."""
    edges = np.diff(nodes, axis=0)
    length = np.linalg.norm(edges, axis=1, keepdims=True)
    tangent = edges / length
    pull = moment * (flux - (tangent @ flux)[:, None] * tangent) / length
    result = np.zeros_like(nodes)
    result[1:] += pull
    result[:-1] -= pull
    return result
