"""How every figure looks: sizes for print, and colours that the colour-blind tell apart."""

from __future__ import annotations

from typing import Any

from matplotlib.colors import LinearSegmentedColormap

from magwire.errors import shortened

MM = 1.0 / 25.4
"""Inches in a millimetre: figures are sized in millimetres."""

WIDTH = 180.0
"""Width of a two-column figure [mm]."""

INK = "#22303c"
MUTED = "#6b7a87"
GRID = "#e3e8ec"
LUMEN_FILL = "#eceff2"
LUMEN_EDGE = "#9aa7b2"
FORCE = "#d55e00"
PASSIVE = "#56b4e9"
CLEARANCE = "#0072b2"
TIP = "#e69f00"
COMPONENTS = ("#0072b2", "#d55e00", "#009e73")
"""x, y, z; with the others from Okabe and Ito's palette."""

# Cividis-like, without its palest end, which would be lost on white.
PUSH = LinearSegmentedColormap.from_list(
    "push", ["#f0b429", "#d1793b", "#a0476a", "#5c3a86", "#1d2f6f"]
)
"""Colour of a wire by its feed: light when little is inserted, dark in the end."""

# From white, which is a wall that nothing presses on.
PRESSURE = LinearSegmentedColormap.from_list(
    "pressure", ["#ffffff", "#fbe0bd", "#f2a65a", "#d55e00", "#7c2d12", "#2b0f06"]
)
"""Colour of the lumen by the force on it."""

RC: Any = {
    "font.family": "DejaVu Sans",
    "font.size": 7.5,
    "mathtext.fontset": "dejavusans",
    "axes.titlesize": 8.0,
    "axes.labelsize": 7.5,
    "axes.labelcolor": INK,
    "axes.edgecolor": MUTED,
    "axes.linewidth": 0.6,
    "axes.spines.top": False,
    "axes.spines.right": False,
    "axes.axisbelow": True,
    "axes.grid": True,
    "grid.color": GRID,
    "grid.linewidth": 0.6,
    "xtick.color": MUTED,
    "ytick.color": MUTED,
    "xtick.labelcolor": INK,
    "ytick.labelcolor": INK,
    "xtick.labelsize": 7.0,
    "ytick.labelsize": 7.0,
    "xtick.major.width": 0.6,
    "ytick.major.width": 0.6,
    "xtick.major.size": 2.5,
    "ytick.major.size": 2.5,
    "xtick.minor.size": 1.5,
    "ytick.minor.size": 1.5,
    "lines.linewidth": 1.3,
    "lines.solid_capstyle": "round",
    "lines.solid_joinstyle": "round",
    "legend.frameon": False,
    "legend.fontsize": 7.0,
    "legend.handlelength": 1.4,
    "text.color": INK,
    "figure.dpi": 150,
    "figure.facecolor": "white",
    "savefig.dpi": 300,
    "svg.hashsalt": "magwire",
}


def plain(text: object) -> str:
    """A text of a user's as matplotlib shows it letter by letter: no mathematics, no line ends."""
    letters = (letter if letter.isprintable() else " " for letter in shortened(text))
    return "".join(letters).replace("$", r"\$")
