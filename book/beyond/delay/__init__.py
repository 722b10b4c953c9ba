"""Delay, and fingers that stay together: Section 7.2's third open problem."""
