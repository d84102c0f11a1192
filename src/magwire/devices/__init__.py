"""Real devices: a library of wires whose numbers have a source and a range each."""

from magwire.devices.device import Device, Number, Part
from magwire.devices.reading import load, names

__all__ = ["Device", "Number", "Part", "load", "names"]
