"""Times, counts and ratios, measured side by side: ``magwire bench``."""
