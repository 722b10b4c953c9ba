"""Logs of a rig: their one form, and what they say."""
