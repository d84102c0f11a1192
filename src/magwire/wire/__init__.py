"""The wire: sections of round cross-section, laid out on a mesh."""

from magwire.wire.magnetization import across, axial
from magwire.wire.make import Make
from magwire.wire.mesh import Mesh, lay_out
from magwire.wire.rates import Parameter, mesh_rates
from magwire.wire.section import Section, Stiffness
from magwire.wire.wire import Wire

__all__ = [
    "Make",
    "Mesh",
    "Parameter",
    "Section",
    "Stiffness",
    "Wire",
    "across",
    "axial",
    "lay_out",
    "mesh_rates",
]
