"""Magnetic sources: flux density and its first and second derivatives in space (P-24, P-25)."""
