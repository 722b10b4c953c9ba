"""Chapter 1, the whole machine: its drawing."""
