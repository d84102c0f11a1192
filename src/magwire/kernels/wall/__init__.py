"""Contact with the wall: gap, barrier, push, collision (P-8 to P-13)."""
