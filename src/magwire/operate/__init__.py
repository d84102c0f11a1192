"""Who moves a plant, and who watches: scripts, navigators, and the loop that asks them."""

from magwire.operate.assist import Assist
from magwire.operate.march import March
from magwire.operate.steering import steered_records
from magwire.operate.watch import Ending, ForceLimit, Until, Watcher, inside, stable

__all__ = [
    "Assist",
    "Ending",
    "ForceLimit",
    "March",
    "Until",
    "Watcher",
    "inside",
    "stable",
    "steered_records",
]
