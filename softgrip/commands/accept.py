"""Judge the log of a step against the printed numbers; 1 if a band failed.

Example::

  softgrip accept lqr.csv --experiment lqr
  softgrip accept lqr.csv --experiment lqr --json
"""

from softgrip.rig.accept import add_accept_arguments as add_arguments
from softgrip.rig.accept import run_accept as run

__all__ = ["add_arguments", "run"]
