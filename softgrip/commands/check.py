"""Say what a log of a rig or a pad holds, what it lacks, and what it can serve.

Example::

  softgrip check run.csv
  softgrip check --json run-*.csv
"""

from softgrip.logs.__main__ import add_check_arguments as add_arguments
from softgrip.logs.__main__ import run_check as run

__all__ = ["add_arguments", "run"]
