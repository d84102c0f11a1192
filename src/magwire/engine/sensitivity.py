"""First-order sensitivities of an equilibrium, from its tangent stiffness (P-21).

At an equilibrium the gradient g of the energy vanishes, so an input u moves the unknowns q by
K dq/du = -dg/du. The gradient is linear in the field, and the mouth's element linear in the
inverse of its part, so the right-hand sides come from differences of gradients without error.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Literal, get_args

import numpy as np
from numpy.typing import NDArray

from magwire.engine.parameters import parameter_loads
from magwire.engine.point import Point
from magwire.engine.tip import tip_direction_moves
from magwire.errors import one_of
from magwire.kernels.arrays import Field, Mouth, Work
from magwire.kernels.assembly import FIRST
from magwire.kernels.band import WIDTH, factor, solve
from magwire.kernels.sources.steer import steer
from magwire.wire import Parameter

Array = NDArray[np.float64]
Output = Literal["tip", "positions", "tip_direction"]
Input = Literal["field", "inputs", "gradient", "feed", "twist", Parameter]

Response = Callable[[Point, Array], Array]

INPUT_STEP = 1e-5  # of an input, over itself or one, in the difference that stands for its effect


def derivative(point: Point, output: Output, wrt: Input, respond: Response | None = None) -> Array:
    """Derivative of an output of an equilibrium by an input; see ``Equilibrium.sensitivity``.

    ``respond`` says how the unknowns move under loads, both scaled and of the shape [inputs,
    nodes + 1, 4]; by the tangent stiffness if left out.
    """
    one_of("sensitivity", "output", output, get_args(Output))
    one_of("sensitivity", "wrt", wrt, get_args(Input))
    system, held = point.system, point.mouth.held
    length = system.wire.length
    loads, shape, unit = _loads(point, wrt)
    moved = (respond or _solve)(point, loads)  # [inputs, nodes + 1, 4], scaled
    if wrt == "feed":
        moved[:, : held + 1, :3] = system.guide.direction
    elif wrt == "twist":
        moved[:, :held, 3] = 1.0
    positions = moved[:, 1:, :3] * (length / unit)
    if output == "positions":
        result = np.moveaxis(positions, 0, -1)
    elif output == "tip":
        result = positions[:, -1].T
    else:
        result = tip_direction_moves(system, point.state, held, moved / unit)
    return result.reshape(*result.shape[:-1], *shape)


def _loads(point: Point, wrt: Input) -> tuple[Array, tuple[int, ...], float]:
    """Derivatives of the gradient by the inputs, shape [inputs, nodes + 1, 4]; their shape; unit.

    The unit is what one scaled input is worth in SI.
    """
    system, state = point.system, point.state
    work = system.new_work()
    if wrt == "field":
        base = point.field.flux_density
        fields = [point.field._replace(flux_density=base + axis) for axis in np.eye(3)]
        return _differences(point, fields, work), (3,), 1.0
    if wrt == "gradient":
        middle = 0.5 * (state.q[1:, :3] + state.q[:-1, :3])
        fields = []
        for i, j in np.ndindex(3, 3):
            unit = np.zeros((3, 3))
            unit[i, j] = 1.0
            here = _here(point.field, middle)
            fields.append(
                Field(
                    flux_density=here + middle @ unit.T,
                    gradient=point.field.gradient + unit.ravel(),
                    origin=middle,
                    uniform=np.array([False]),
                    sources=point.field.sources,
                    strength=point.field.strength,
                )
            )
        return _differences(point, fields, work), (3, 3), 1.0 / system.wire.length
    if wrt == "inputs":
        return _by_inputs(point, work), (system.inputs,), 1.0
    if wrt != "feed" and wrt != "twist":
        return *parameter_loads(point, wrt, work), 1.0
    band = point.stiffness(work)
    lead = np.zeros(FIRST)
    if wrt == "twist":
        lead[3] = 1.0
        return _coupling(band, lead, point)[None], (), 1.0
    lead[0:3] = lead[4:7] = system.guide.direction
    load = _coupling(band, lead, point)
    if system.release == "sliding":
        load += _by_part(point, work) / system.rod.cell[point.mouth.held]
    return load[None], (), system.wire.length


def _by_inputs(point: Point, work: Work) -> Array:
    """Derivative of the gradient by each of the actuator's inputs, from central differences."""
    field, inputs, rows = point.field, point.state.inputs, []
    for k in range(len(inputs)):
        step = INPUT_STEP * max(1.0, abs(inputs[k]))
        ends = []
        for sign in (1.0, -1.0):
            moved, strength = inputs.copy(), field.strength.copy()
            moved[k] += sign * step
            steer(field.sources, moved, strength)
            ends.append(point.gradient(work, field=field._replace(strength=strength)))
        rows.append((ends[0] - ends[1]) / (2.0 * step))
    return np.stack(rows)


def _here(field: Field, middle: Array) -> Array:
    """The affine field at the middle of each edge [T]."""
    slope = field.gradient.reshape(-1, 3, 3)
    result: Array = field.flux_density + np.einsum("eij,ej->ei", slope, middle - field.origin)
    return result


def _differences(point: Point, fields: list[Field], work: Work) -> Array:
    base = point.gradient(work)
    return np.stack([point.gradient(work, field=field) - base for field in fields])


def _by_part(point: Point, work: Work) -> Array:
    """Derivative of the gradient by the part of the mouth's cell; it is linear in its inverse."""
    part = point.mouth.fraction
    there = point.gradient(work, mouth=Mouth(point.mouth.held, 2.0 * part))
    return (there - point.gradient(work)) * 2.0 / part


def _coupling(band: Array, lead: Array, point: Point) -> Array:
    """Load of the guide's displacements on the free unknowns, shape [nodes + 1, 4]."""
    nodes, held = len(point.state.q), point.mouth.held
    count = 4 * (nodes - held + 1)
    rows = np.zeros(count + WIDTH)  # the columns of a short wire end in zeros past its last row
    for column, value in enumerate(lead):
        rows[column : column + WIDTH] += value * band[column]
    rows[:FIRST] = 0.0
    load = np.zeros((nodes, 4))
    load[held - 1 :] = rows[:count].reshape(-1, 4)
    return load


def _solve(point: Point, loads: Array) -> Array:
    """Displacements -K^-1 load for every load, shape [inputs, nodes + 1, 4]."""
    nodes, held = len(point.state.q), point.mouth.held
    last = point.last
    moved = np.zeros_like(loads)
    if held == nodes - 1:
        return moved
    band = point.stiffness(point.system.new_work())
    whole = _both_triangles(band[FIRST:last])
    used = 4 * (nodes - held + 1)
    rows = np.zeros((len(loads), len(band)))
    rows[:, :used] = -loads[:, held - 1 :].reshape(len(loads), -1)
    if factor(band, FIRST, last) < 0:
        for row in rows:
            solve(band, row, FIRST, last)
    else:  # an unstable equilibrium has sensitivities, too
        from scipy.linalg import solve_banded

        half = WIDTH - 1
        rows[:, FIRST:last] = solve_banded((half, half), whole, rows[:, FIRST:last].T).T
    rows[:, :FIRST] = 0.0
    rows[:, last:] = 0.0
    moved[:, held - 1 :] = rows[:, :used].reshape(len(loads), -1, 4)
    return moved


def _both_triangles(lower: Array) -> Array:
    """A symmetric band, columns of its lower triangle as rows, as ``solve_banded`` wants it."""
    count = len(lower)
    whole = np.zeros((2 * WIDTH - 1, count))
    for k in range(min(WIDTH, count)):
        whole[WIDTH - 1 + k, : count - k] = lower[: count - k, k]
        whole[WIDTH - 1 - k, k:] = lower[: count - k, k]
    return whole
