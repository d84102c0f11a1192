"""Sources of the outside magnetic field: flux density and its gradient at points (P-7)."""

from magwire.field.given import as_field
from magwire.field.gradient import GradientField
from magwire.field.source import FieldSource
from magwire.field.uniform import UniformField

__all__ = ["FieldSource", "GradientField", "UniformField", "as_field"]
