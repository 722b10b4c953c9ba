"""The rig: logs, and what makes them."""
