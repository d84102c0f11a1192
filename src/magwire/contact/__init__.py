"""How the wall acts on the wire."""

from magwire.contact.barrier import Barrier

__all__ = ["Barrier"]
