#!/usr/bin/env bash
# SciPy 1.17.1: milp(..., options={"disp": False}) writes lines of the solver's source to descriptor 1.
#
# Guess: with disp off, which is the default too, a solver is silent; if not, redirect_stdout catches it.
# Seen:  for some programs, with big-M constraints here, HiGHS writes "HighsMipSolverData::..." once or
#        more. It writes to the process's descriptor 1, past sys.stdout: redirect_stdout sees nothing,
#        and a command whose output is read by another program gives it these lines among the data.
#        The answer itself is right.
# Meets: who solves mixed-integer programs in a command that prints CSV or JSON. Write the data to a file,
#        or solve in a process of its own.
set -euo pipefail
python=${PYTHON:-python3}
folder=$(mktemp -d); trap 'rm -rf "$folder"' EXIT
"$python" -m venv "$folder/venv"
"$folder/venv/bin/pip" install -q --disable-pip-version-check scipy==1.17.1 numpy==2.4.6
cat > "$folder/solve.py" <<'PY'
import contextlib
import io
import sys

import numpy as np
from scipy.optimize import Bounds, LinearConstraint, milp

COUNT, FREE, SEEDS = 8, 2, 10


def fewest(seed):
    """How few of 8 wishes must be given up, by 2 variables within -2 and 2."""
    rng = np.random.default_rng(seed)
    slopes = np.round(3 * rng.normal(size=(COUNT, FREE)), 2)
    missed = np.round(4 * rng.normal(size=COUNT), 2)
    large = np.diag(np.abs(missed) + 2 * np.abs(slopes).sum(axis=1) + 1)
    sides = np.vstack([np.hstack([slopes, -large]), np.hstack([-slopes, -large])])
    kinds = np.append(np.zeros(FREE), np.ones(COUNT))
    return milp(
        kinds,
        constraints=LinearConstraint(sides, ub=np.concatenate([1 - missed, 1 + missed])),
        bounds=Bounds(np.append([-2.0, -2.0], 0 * missed), np.append([2.0, 2.0], 1 + 0 * missed)),
        integrality=kinds,
        options={"disp": False},
    )


caught = io.StringIO()
with contextlib.redirect_stdout(caught):
    found = [fewest(seed) for seed in range(SEEDS)]
print(f"solved: {sum(one.success for one in found)} of {SEEDS}", file=sys.stderr)
print(f"caught by redirect_stdout: {caught.getvalue()!r}", file=sys.stderr)
sys.exit(bool(caught.getvalue()) or not all(one.success for one in found))
PY
"$folder/venv/bin/python" "$folder/solve.py" > "$folder/out"
echo "on descriptor 1, where nothing was printed:"
cat "$folder/out"
grep -q HighsMipSolverData "$folder/out"
