"""How the wall acts on the wire."""

from magwire.contact.barrier import Barrier
from magwire.contact.friction import Friction
from magwire.contact.motion import WallMotion

__all__ = ["Barrier", "Friction", "WallMotion"]
