"""Files of electromagnetic systems: sources, limits and saturation."""
