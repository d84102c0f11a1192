"""How the wall acts on the wire."""

from magwire.contact.barrier import Barrier
from magwire.contact.friction import Friction

__all__ = ["Barrier", "Friction"]
