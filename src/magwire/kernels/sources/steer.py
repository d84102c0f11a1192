"""An actuator as the wire's kernels ask it: by a tuple that holds its sources, or is empty.

Empty stands for three components of a uniform flux density. The length of a tuple is part of its
type: kernels for uniform fields are compiled without all the sources, which would double the time
that compiling takes.
"""

from __future__ import annotations

from magwire.kernels._jit import kernel
from magwire.kernels.sources.drive import drive
from magwire.kernels.sources.jet import jet


@kernel
def steer(sources, inputs, strength):
    """Bring the actuator's state to its inputs."""
    if len(sources) == 0:
        for c in range(3):
            strength[c] = inputs[c]
    else:
        drive(sources[0], inputs, strength)


@kernel
def field_of(sources, strength, x, wanted):
    """Flux density (3), gradient (9) and, if wanted, second derivatives (18) at a point."""
    if len(sources) == 0:
        return (strength[0], strength[1], strength[2]), (0.0,) * 9, (0.0,) * 18
    else:
        return jet(sources[0], strength, x, wanted)
