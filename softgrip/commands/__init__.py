"""The command ``softgrip``: what the package does to files and rigs, from a shell."""
