#!/usr/bin/env bash
# python-control 0.10.2 with NumPy 2.5: warnings taken as errors change what feedback() returns.
#
# Guess: a test suite that turns warnings into errors either sees the error or gets the same loop.
# Seen:  making a bare gain a state-space system sets the shape of empty arrays, which NumPy 2.5
#        deprecates. ss([], [], [], 2) raises it; but feedback() of a state-space system takes the
#        error for a sign that the other operand is none, and returns an InterconnectedSystem: a
#        nonlinear system that has no poles() and no zeros(). Nothing is raised or printed, and the
#        AttributeError comes much later, in code that has nothing to do with it.
# Meets: who runs tests with -W error and closes loops with python-control. Ignore this one warning by
#        its message; on Python 3.11, which NumPy 2.5 has left, all is as guessed.
set -euo pipefail
python=${PYTHON:-python3}
"$python" -c 'import sys; sys.exit(sys.version_info < (3, 12))' || {
  echo "NumPy 2.5 needs Python 3.12 or newer: PYTHON=python3.12 $0"; exit 1
}
folder=$(mktemp -d); trap 'rm -rf "$folder"' EXIT
"$python" -m venv "$folder/venv"
"$folder/venv/bin/pip" install -q --disable-pip-version-check \
  control==0.10.2 numpy==2.5.5 scipy==1.18.1
"$folder/venv/bin/python" - <<'PY'
import sys
import warnings

import control

plant = control.ss([[-1.0]], [[1.0]], [[1.0]], [[0.0]])
found = []
for action in ("ignore", "error"):
    with warnings.catch_warnings():
        warnings.simplefilter(action)
        loop = control.feedback(plant)
        try:
            gain = type(control.ss([], [], [], 2.0)).__name__
        except DeprecationWarning as error:
            gain = f"raises {type(error).__name__}"
    found.append((type(loop).__name__, hasattr(loop, "poles"), gain))
    print(f"warnings {action}: feedback() gives {found[-1][0]}, poles: {found[-1][1]}; a gain: {gain}")
sys.exit(
    found
    != [
        ("StateSpace", True, "StateSpace"),
        ("InterconnectedSystem", False, "raises DeprecationWarning"),
    ]
)
PY
