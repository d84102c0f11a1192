"""Who moves a plant: scripts, navigators, and the loop that asks them."""

from magwire.operate.march import March
from magwire.operate.steering import steered_records

__all__ = ["March", "steered_records"]
