"""Actuators: coils and magnets with their inputs and limits (P-24 to P-28)."""

from magwire.actuate.actuator import Actuator
from magwire.actuate.advancer import Advancer
from magwire.actuate.coils import Coil, Helmholtz, Loops, Maxwell, Pair
from magwire.actuate.dry_run import Violation, dry_run
from magwire.actuate.extremes import Extremes, extremes
from magwire.actuate.grids import FieldGrid
from magwire.actuate.hardware import Hardware
from magwire.actuate.inputs import Box, Circuit, Input
from magwire.actuate.magnet import Magnet
from magwire.actuate.map import Map
from magwire.actuate.misaligned import Misaligned
from magwire.actuate.mpem import MPEM
from magwire.actuate.omnimagnet import Omnimagnet
from magwire.actuate.pose import Pose
from magwire.actuate.retime import retime
from magwire.actuate.sampled import sampled, write_grid
from magwire.actuate.tables import Saturation
from magwire.actuate.timetable import Timetable
from magwire.actuate.together import Held, Together
from magwire.actuate.uniform import Uniform, UniformGradient

__all__ = [
    "MPEM",
    "Actuator",
    "Advancer",
    "Box",
    "Circuit",
    "Coil",
    "Extremes",
    "FieldGrid",
    "Hardware",
    "Held",
    "Helmholtz",
    "Input",
    "Loops",
    "Magnet",
    "Map",
    "Maxwell",
    "Misaligned",
    "Omnimagnet",
    "Pair",
    "Pose",
    "Saturation",
    "Timetable",
    "Together",
    "Uniform",
    "UniformGradient",
    "Violation",
    "dry_run",
    "extremes",
    "retime",
    "sampled",
    "write_grid",
]
