"""A wire, its lumen and its wall as scaled arrays for the kernels (P-17)."""

from __future__ import annotations

import math
from dataclasses import dataclass, replace
from functools import cached_property
from typing import Any, Literal

import numpy as np
from numpy.typing import NDArray

from magwire.actuate import Actuator
from magwire.contact import Barrier, Friction, WallMotion
from magwire.contact.motion import STRAIN
from magwire.engine.record import UNIFORM_INPUTS, Scales, patch_length
from magwire.engine.wall import (
    DEEPEST,
    NOWHERE,
    Firmness,
    by_place,
    divide,
    divide_bed,
    fit,
    in_units,
)
from magwire.errors import InputError, array, instance, nonnegative, one_of
from magwire.field import FieldSource, UniformField, as_field
from magwire.kernels.arrays import (
    JET,
    Bed,
    BulgeGrid,
    Bulges,
    Field,
    Guide,
    Rod,
    State,
    Terms,
    Tube,
    Wall,
    Work,
)
from magwire.kernels.arrays import Friction as FrictionArrays
from magwire.kernels.band import WIDTH
from magwire.kernels.centreline import LumenArrays, Moving
from magwire.kernels.newton import Limits
from magwire.kernels.sources.steer import steer
from magwire.kernels.sources.table import Sources, new_strength
from magwire.kernels.wall.onward import FULL
from magwire.kernels.wall.traction import CONTACT
from magwire.lumen import Lumen
from magwire.lumen.bulge import Bulge, largest, sheet_bulges
from magwire.units import show
from magwire.wire import Mesh, Wire, lay_out

Array = NDArray[np.float64]
Release = Literal["sliding", "node"]

TOLERANCE = 1e-6  # force residual of a time step, in EI/L^2
LAST_STEP = 1e-7  # a Newton step of a time step that needs no further one, in wire lengths
LAST_SLIP = 0.03  # the same under friction, over the elastic slip at the cone
UNEVEN = 10.0  # ratio of bending stiffnesses from which on time steps, too, let edges turn
SHARP_TOLERANCE = 1e-9  # force residual of an equilibrium, in EI/L^2
ITERATIONS = 60  # of a time step
MANY_ITERATIONS = 2000  # of an equilibrium, which may be far from its start
NO_FIELD = UniformField()
ELASTIC_SLIP = 1e-4  # at the cone, over the lumen's smallest radius (P-30)
FIRST_SHIFT = 10.0  # first regularisation, in EI/(rho A L^4)


@dataclass(frozen=True)
class System:
    """What is simulated, apart from what drives it.

    Parameters
    ----------
    wire, lumen, contact
        The wire, the lumen and the wall's barrier.
    damping
        mu [1/s] (P-14).
    gravity
        Acceleration, shape (3,) [m/s^2].
    fluid_density
        Density of what fills the lumen [kg/m^3]; its buoyancy acts against gravity.
    tip_load
        Dead force on the tip, fixed in space, shape (3,) [N].
    background
        The outside field that is there without any input.
    friction
        Friction of the wall; none if None.
    wall_motion
        How the wall moves; it rests if there is none.
    actuator
        What makes a field from inputs; three components of a uniform flux density [T] if None.
    release
        ``"sliding"``: the bending element at the guide's mouth counts with the part that is past
        the entrance; ``"node"``: node by node, as in the paper (P-15).
    brisk
        Whether time steps are for large feeds along a hard wall: a wire that is fed by an edge is
        guessed to follow itself, and a step that takes a point between two nodes into the wall is
        halved, instead of asking how far each point may go. Far less work where hundreds of edges
        lie on the wall, and another way to the same end, but for the tolerance.
    """

    wire: Wire
    lumen: Lumen
    contact: Barrier
    damping: float = 0.01
    gravity: tuple[float, float, float] = (0.0, 0.0, 0.0)
    fluid_density: float = 0.0
    release: Release = "sliding"
    tip_load: tuple[float, float, float] = (0.0, 0.0, 0.0)
    background: FieldSource = NO_FIELD
    friction: Friction | None = None
    actuator: Actuator | None = None
    wall_motion: tuple[WallMotion, ...] = ()
    brisk: bool = False

    def __post_init__(self) -> None:
        instance("Simulation", "wire", self.wire, Wire)
        instance("Simulation", "lumen", self.lumen, Lumen)
        instance("Simulation", "contact", self.contact, Barrier)
        instance("Simulation", "friction", self.friction, Friction, or_none=True)
        instance("Simulation", "actuator", self.actuator, Actuator, or_none=True)
        for one in self.wall_motion:
            instance("Simulation", "wall_motion", one, WallMotion)
        self._check_strain()
        object.__setattr__(self, "background", as_field("Simulation", self.background))
        nonnegative("Simulation", "damping", self.damping, "1/s")
        nonnegative("Simulation", "fluid_density", self.fluid_density, "kg/m^3")
        gravity = array("Simulation", "gravity", self.gravity, (3,), "m/s^2")
        tip_load = array("Simulation", "tip_load", self.tip_load, (3,), "N")
        object.__setattr__(self, "gravity", tuple(gravity.tolist()))
        object.__setattr__(self, "tip_load", tuple(tip_load.tolist()))
        one_of("Simulation", "release", self.release, ("sliding", "node"))
        if self.friction is not None:
            self.friction.of_sections(len(self.wire.sections))
        self._check_edges()

    def __repr__(self) -> str:
        return self.called("System")

    def called(self, name: str) -> str:
        """Wire, lumen and what acts on the wire, as text of a few lines that begins with a name."""
        acting = [f"damping {show(self.damping, 'rate')}"]
        if any(self.gravity):
            acting.append(f"gravity {show(math.hypot(*self.gravity), 'acceleration')}")
        if any(self.tip_load):
            acting.append(f"tip load {show(math.hypot(*self.tip_load), 'force')}")
        acting += [repr(one) for one in (self.friction, *self.wall_motion) if one is not None]
        wire = repr(self.wire).replace("\n", "\n  ")
        inputs = ", ".join(f"{name} [{unit}]" for name, unit in self.input_names)
        lines = [wire, repr(self.lumen), repr(self.contact), f"background {self.background!r}"]
        lines += [f"inputs {inputs}", ", ".join(acting)]
        return "\n  ".join([f"{name} of", *lines])

    def _check_strain(self) -> None:
        """Refuse displacements of the tissue that together would fold it."""
        strain = sum(one.strain for one in self.wall_motion)
        if strain > STRAIN:
            raise InputError(
                f"Input wall_motion of Simulation must strain the tissue by at most {STRAIN:g} in "
                f"all; received displacements that strain it by {strain:.4g}: longer ramps help."
            )

    def _check_edges(self) -> None:
        """Refuse edges that, as chords, are too long for a bend that the wire can reach.

        The middle of an edge of length l lies kappa l^2/8 nearer to a bend's inside than its ends.
        """
        if not self.lumen.branches:
            return
        branch = self.path.branches[0]
        curvature, arc = branch.curve.sharpest_bends()
        room = branch.curve.at(arc)[:, 3] - self.keep_off
        reached = (arc <= self.wire.length) & (room > 0.0)
        dip = np.where(reached, curvature, 0.0) * self.wire.edge_length**2 / 8.0
        worst = int(np.argmax(dip / np.where(reached, room, np.inf)))
        if reached[worst] and dip[worst] > room[worst]:
            longest = float(np.sqrt(8.0 * room[worst] / curvature[worst]))
            raise InputError(
                f"Input nodes of Wire must be at least {math.ceil(self.wire.length / longest) + 1} "
                f"for the lumen's bend of radius {1.0 / curvature[worst]:.4g} m at arc length "
                f"{arc[worst]:.4g} m, where the wire has {room[worst]:.4g} m of room: the edges "
                f"cut through it otherwise; received {self.wire.nodes}."
            )

    @cached_property
    def scales(self) -> Scales:
        """Length L, force EI/L^2 and flux density EI/(M L^2)."""
        length, stiffness = self.wire.length, self.wire.bending_stiffness
        moment = self.wire.moment_per_length
        flux = stiffness / (moment * length**2) if moment > 0.0 else float("nan")
        return Scales(length=length, force=stiffness / length**2, flux_density=flux)

    @cached_property
    def mesh(self) -> Mesh:
        """The wire on its nodes, in SI units."""
        return lay_out(self.wire)

    @cached_property
    def rod(self) -> Rod:
        """The wire for the kernels, with the ghost node in front."""
        mesh, length = self.mesh, self.wire.length
        energy = self.wire.bending_stiffness / length
        inertia = length**2 / energy
        pull = (mesh.mass - self.fluid_density * mesh.volume)[:, None] * np.array(self.gravity)
        pull[-1] += self.tip_load
        cell = np.diff(np.concatenate(([0.0], mesh.cell_end)))
        radius = self.contact.keep_off(mesh.radius)
        return Rod(
            station=_ghost(mesh.station, -mesh.edge_length[0]) / length,
            cell_end=_ghost(mesh.cell_end) / length,
            rest=_ghost(mesh.edge_length, mesh.edge_length[0]) / length,
            stretch=_ghost(mesh.stretching_stiffness) * length / energy,
            bend=_ghost(mesh.bending_stiffness) / energy,
            twist=_ghost(mesh.twisting_stiffness) / energy,
            rest_curvature=_ghost(mesh.rest_curvature),
            moment=_ghost(mesh.moment) / energy,
            mass=_ghost(mesh.mass) * inertia,
            inertia=_ghost(mesh.axial_inertia) / energy,
            weight=_ghost(pull) * length / energy,
            cell=_ghost(cell) / length,
            offset=_ghost(radius) / length,
        )

    @cached_property
    def guide(self) -> Guide:
        """The guide line in front of the entrance."""
        direction = np.asarray(self.lumen.direction, dtype=np.float64)
        axis = np.zeros(3)
        axis[np.argmin(np.abs(direction))] = 1.0
        director = np.cross(direction, axis)
        return Guide(
            entrance=np.asarray(self.lumen.entrance, dtype=np.float64) / self.wire.length,
            direction=direction,
            director=director / np.linalg.norm(director),
            sliding=self.release == "sliding",
        )

    @cached_property
    def path(self) -> Lumen:
        """The path from the entrance to the lumen's target, as a single tube."""
        return self.lumen.path()

    @cached_property
    def sources(self) -> tuple[()] | tuple[Sources]:
        """The actuator for the kernels, in units of the wire's length and tesla."""
        if self.actuator is None:
            return ()
        return (self.actuator.arrays(self.wire.length),)

    @cached_property
    def idle_strength(self) -> Array:
        """State of the actuator before anybody sets its inputs."""
        strength = new_strength(self.sources[0]) if self.sources else np.zeros(3)
        steer(self.sources, self.idle_inputs, strength)
        return strength

    @property
    def idle_inputs(self) -> Array:
        """Of the actuator before anybody sets them, shape (m,)."""
        return np.zeros(3) if self.actuator is None else self.actuator.idle

    @property
    def input_names(self) -> tuple[tuple[str, str], ...]:
        """Names and units of the actuator's inputs."""
        if self.actuator is None:
            return UNIFORM_INPUTS
        return tuple((one.name, one.unit) for one in self.actuator.inputs)

    @property
    def resistances(self) -> tuple[float, ...]:
        """Of the coils whose currents are inputs [ohm]; 0 for others."""
        if self.actuator is None:
            return ()
        return tuple(float(one.resistance) for one in self.actuator.inputs)

    @property
    def inputs(self) -> int:
        """Number of the actuator's inputs."""
        return len(self.sources[0].curve) if self.sources else 3

    @cached_property
    def path_arrays(self) -> LumenArrays:
        """The path for the gap kernels, in units of the wire's length."""
        return self.path.arrays(self.wire.length)

    @property
    def keep_off(self) -> float:
        """What the wall keeps from the wire's axis, where the wire is widest [m] (P-12)."""
        return self.contact.keep_off(self.wire.radius)

    @cached_property
    def walls(self) -> LumenArrays:
        """The lumen for the gap kernels, in units of the wire's length."""
        return self.lumen.arrays(self.wire.length)

    def step_limits(self) -> Limits:
        """When Newton's method stops in a time step."""
        stiffnesses = [section.bending_stiffness for section in self.wire.sections]
        turn = 1.0 if max(stiffnesses) > UNEVEN * min(stiffnesses) else 0.0
        step = min(LAST_STEP, LAST_SLIP * self.elastic_slip) if self.rubs else LAST_STEP
        return self._limits(TOLERANCE, ITERATIONS)._replace(step=step, turn=turn, brisk=self.brisk)

    def sharp_limits(self) -> Limits:
        """When Newton's method stops at an equilibrium."""
        return self._limits(SHARP_TOLERANCE, MANY_ITERATIONS)

    def _limits(self, tolerance: float, iterations: int) -> Limits:
        """Limits, with a tolerance that is not below what round-off allows on this mesh.

        Round-off grows with the coordinates: a lumen may lie far from the origin.
        """
        body = self.wire.body
        inertia = body.density * body.area * self.wire.length**4 / body.bending_stiffness
        return Limits(max(tolerance, self._round_off), iterations, FIRST_SHIFT / inertia)

    @cached_property
    def _round_off(self) -> float:
        """Of the forces, in EI/L^2: it grows with the coordinates."""
        rod = self.rod
        stiffest = max(float((rod.stretch / rod.rest).max()), 1.0 / self.shortest_edge**3)
        points = [branch.points for branch in self.lumen.branches]
        far = max([1.0, *(float(np.abs(p).max()) / self.wire.length for p in points)])
        return 4.0 * float(np.finfo(np.float64).eps) * far * stiffest

    @cached_property
    def shortest_edge(self) -> float:
        """In wire lengths."""
        return float(self.rod.rest.min())

    @cached_property
    def idle(self) -> list[Any]:
        """Plants of this system that one equilibrium leaves to the next."""
        return []

    @cached_property
    def firmness(self) -> Firmness:
        """Stiffness and activation gap of the wall's barrier [Pa, m]."""
        return fit(self.contact, self.wire, self.path)

    @property
    def absent(self) -> frozenset[str]:
        """Arrays that records are without: zero throughout, for want of what makes them."""
        rubs = self.friction is not None and self.rubs
        made = {
            "friction_force": rubs,
            "slip": rubs,
            "wall_indentation": self.contact.foundation is not None,
            "wall_displacement": bool(self.wall_motion),
        }
        return frozenset(name for name, there in made.items() if not there)

    @cached_property
    def patch(self) -> float:
        """Length of wire over which forces are summed [m]."""
        return patch_length(self.wire.length, self.wire.nodes)

    @cached_property
    def bulge(self) -> float:
        """Largest curvature with which the wall bulges towards the wire's axis [1/m]."""
        if self.walls.sheet:
            return self.lumen.bulge(self.keep_off)
        return largest(self._bulges, self.lumen.branches)

    @cached_property
    def _bulges(self) -> list[Bulge]:
        return self.lumen.bulges(self.keep_off)

    @cached_property
    def _bulges_by_place(self) -> Bulges | BulgeGrid:
        """The same by place, for the kernels."""
        edge = float(self.mesh.edge_length.max())
        lumen = self.lumen
        if lumen.sheet is not None:
            grid = sheet_bulges(lumen.arrays(), lumen.sheet, lumen.branches, self.keep_off, edge)
            return in_units(grid, self.wire.length)
        return by_place(self._bulges, edge, self.wire.length)

    def new_terms(
        self,
        field: Field,
        *,
        rod: Rod | None = None,
        wall: Wall | None = None,
        tube: Tube | None = None,
    ) -> Terms:
        """What the wire's energy is made of in a field, with rod and wall as they are unless given.

        A virtual tube is the navigator's that adds it.
        """
        return Terms(
            rod=self.rod if rod is None else rod,
            field=field,
            wall=self.new_wall() if wall is None else wall,
            lumen=self.walls,
            tube=self._no_tube if tube is None else tube,
        )

    def new_wall(self) -> Wall:
        """The barrier, with nothing known yet of the gap near any point."""
        length, stiffness = self.wire.length, self.wire.bending_stiffness
        unit = stiffness / length**4  # of a barrier's stiffness
        edge = float(self.mesh.edge_length.max())
        bed = self._new_bed()
        gives = bed.deepest > 0.0
        made = divide_bed if gives else divide
        between = made(self.firmness, edge, self.bulge, length, self.wire.nodes)
        if between.parts > 1:
            between = between._replace(bulges=self._bulges_by_place)
        elif self.walls.sheet:
            between = between._replace(bulges=NOWHERE)
        share = between.parts if gives else 1  # of its cell's wall that a node stands for
        return Wall(
            stiffness=self.firmness.stiffness / share / unit,
            gap=self.firmness.activation_gap / length,
            known=np.full((self.wire.nodes + 1, 4), -np.inf),
            jet=np.zeros((self.wire.nodes + 1, JET)),
            easy=np.zeros(1),
            between=between._replace(stiffness=between.stiffness / unit),
            friction=self._new_friction(),
            bed=bed,
        )

    def _new_bed(self) -> Bed:
        """The wall's elastic foundation for the kernels."""
        if self.contact.foundation is None:
            return Bed(np.zeros(self.wire.nodes + 1), 0.0)
        width = _ghost(2.0 * self.mesh.radius, 2.0 * float(self.mesh.radius[0]))
        ratio = self.firmness.stiffness / (self.contact.foundation * width)
        room = self.path.narrowest if self.lumen.branches else self.wire.length
        return Bed(ratio, DEEPEST * room / self.wire.length)

    def new_moving(self) -> tuple[()] | tuple[Moving]:
        """The wall's motion for the kernels, if there is any, at the start."""
        if not self.wall_motion:
            return ()
        length, count = self.wire.length, len(self.wall_motion)
        moving = Moving(
            origin=np.asarray(self.guide.entrance)[None].copy(),
            amplitude=np.array([one.amplitude for one in self.wall_motion]) / length,
            ramp=np.array([one.ramp for one in self.wall_motion]) / length,
            rate=np.array([1.0 / one.period for one in self.wall_motion]),
            now=np.zeros(count),
            before=np.zeros(count),
            pace=1.0 + sum(one.strain for one in self.wall_motion),
        )
        return (moving,)

    def _new_friction(self) -> tuple[()] | tuple[FrictionArrays]:
        """Friction of the wall for the kernels, if there is any, with nothing known of a step."""
        if self.friction is None or not self.rubs:
            return ()
        nodes, length, friction = self.wire.nodes + 1, self.wire.length, self.friction
        static, kinetic = (
            _ghost(self.mesh.shares @ values)
            for values in friction.of_sections(len(self.wire.sections))
        )
        table = np.array(friction.along, dtype=np.float64).reshape(-1, 2) / (length, 1.0)
        arrays = FrictionArrays(
            static=static,
            kinetic=kinetic,
            radius=_ghost(self.mesh.radius) / length,
            slip=self.elastic_slip,
            drag=friction.drag * length**4 / self.wire.bending_stiffness,
            table=table,
            path=self.path_arrays,
            rate=np.zeros(1),
            start=np.zeros((nodes, 4)),
            load=np.zeros((nodes, 4)),
            anchor=np.zeros((nodes, 3)),
            turning=np.zeros((nodes, 3)),
            leaning=np.zeros((nodes, 3)),
            factor=np.ones(nodes),
            slides=np.zeros(nodes, dtype=np.bool_),
            begun=np.zeros(nodes),
            ended=np.zeros(nodes),
            pushed=np.zeros((nodes, 4)),
            tangent=np.zeros((4 * (nodes + 1), FULL)),
        )
        return (arrays,)

    @property
    def elastic_slip(self) -> float:
        """How far a contact that sticks gives way at its static cone, in wire lengths (P-30)."""
        if not self.lumen.branches:
            return 1.0
        return ELASTIC_SLIP * self.path.narrowest / self.wire.length

    @property
    def rubs(self) -> bool:
        """Whether the wall takes anything of the wire that slides on it."""
        friction = Friction() if self.friction is None else self.friction
        return bool(np.any(np.asarray(friction.static) > 0.0)) or friction.drag > 0.0

    @cached_property
    def smooth(self) -> System:
        """The same without friction, and with the wall at rest."""
        if self.friction is None and not self.wall_motion:
            return self
        return replace(self, friction=None, wall_motion=())

    @cached_property
    def still(self) -> System:
        """The same with the wall at rest."""
        return replace(self, wall_motion=()) if self.wall_motion else self

    @cached_property
    def _no_tube(self) -> Tube:
        balls = self.walls._replace(sheet=())
        return Tube(0.0, 0.0, 0.0, balls, np.full((1, 4), -np.inf), np.zeros((1, JET)))

    def new_tube(self, path: Lumen, radius: float) -> Tube:
        """The virtual tube of a radius [m] around the centreline of a path (P-19).

        The path must be as wide everywhere as at its narrowest; its barrier has the contact's
        stiffness and reaches to the centreline.
        """
        length = self.wire.length
        return Tube(
            stiffness=self.firmness.stiffness * length**4 / self.wire.bending_stiffness,
            gap=radius / length,
            offset=(path.narrowest - radius) / length,
            path=path.arrays(length),
            known=np.full((1, 4), -np.inf),
            jet=np.zeros((1, JET)),
        )

    def new_state(self) -> State:
        """A state with all arrays allocated and the wire behind the entrance."""
        return State._make(values.copy() for values in self._blank)

    @cached_property
    def _blank(self) -> State:
        nodes = self.wire.nodes + 1
        return State(
            q=np.zeros((nodes, 4)),
            tangent=np.tile(self.guide.direction, (nodes - 1, 1)),
            length=self.rod.rest.copy(),
            director=np.tile(self.guide.director, (nodes - 1, 1)),
            twist=np.zeros(nodes),
            velocity=np.zeros((nodes, 4)),
            guide=np.zeros(2),
            held=np.array([nodes - 1]),
            inputs=self.idle_inputs,
            contact=np.zeros((nodes, CONTACT)),
            spent=np.zeros(2),
            clock=np.zeros(1),
        )

    def new_work(self) -> Work:
        """Scratch arrays of the solver."""
        nodes = self.wire.nodes + 1
        rows = 4 * (nodes + 1) + WIDTH
        return Work(
            gradient=np.zeros((nodes, 4)),
            band=np.zeros((rows, WIDTH)),
            kept=np.zeros((rows, WIDTH)),
            no_band=np.zeros((0, WIDTH)),
            step=np.zeros(rows),
            way=np.zeros(rows),
            trial=self.new_state(),
            spare=self.new_state(),
            ahead=self.new_state(),
            before=self.new_state(),
            inputs=np.zeros(self.inputs),
            target=np.zeros((nodes, 4)),
        )


def _ghost(values: Array, first: float = 0.0) -> Array:
    """Values with the ghost's own in front."""
    head = np.full((1, *values.shape[1:]), first)
    return np.ascontiguousarray(np.concatenate((head, values)))
