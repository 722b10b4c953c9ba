#!/usr/bin/env bash
# filterpy 2.0.0: a missing measurement scores as the best one that there could be.
#
# Guess: update(None), which is there for gaps, leaves the likelihood alone: a sum of
#        log_likelihood over a record with gaps is that of the measurements that came.
# Seen:  the state is right, but log_likelihood is that of a residual of exactly 0 with the last S.
#        The more measurements are lost, the better a model looks; and of two models the one that is
#        surer of itself gains more from each gap, so that gaps can choose the wrong model. When the
#        first measurement is missing S is still 0, and that one gap makes the sum -inf.
# Meets: who fits noise or compares models by likelihood on telemetry with lost frames. Skip the
#        steps without a measurement when summing.
set -euo pipefail
folder=$(mktemp -d); trap 'rm -rf "$folder"' EXIT
"${PYTHON:-python3}" -m venv "$folder/venv"
"$folder/venv/bin/pip" install -q --disable-pip-version-check \
  filterpy==2.0.0 numpy==2.4.6 scipy==1.17.1
"$folder/venv/bin/python" - <<'PY'
import sys

import numpy as np
from filterpy.kalman import KalmanFilter

MEASURED = np.random.default_rng(0).normal(0, 1.0, 200)  # of a constant, noise of variance 1


def score(variance, lost, first=0):
    """Sum the log likelihoods of the filter, and those of the steps with a measurement alone."""
    one = KalmanFilter(dim_x=1, dim_z=1)
    one.F, one.H, one.Q, one.R = np.eye(1), np.eye(1), np.zeros((1, 1)), variance * np.eye(1)
    every, came = 0.0, 0.0
    for k, z in enumerate(MEASURED):
        one.predict()
        gap = k < first or k % 10 >= 10 - lost
        one.update(None if gap else z)
        every += one.log_likelihood
        came += 0.0 if gap else one.log_likelihood
    return every, came


chosen = []
for lost in (0, 7):
    (true, fair), (sure, strict) = score(1.0, lost), score(0.5, lost)
    print(f"{lost} of 10 lost: the true noise {true:.0f}, half of it {sure:.0f};"
          f" measurements alone {fair:.0f}, {strict:.0f}")
    chosen.append((true > sure, fair > strict))
start = score(1.0, 0, first=1)[0]
print(f"the first one missing: {start}")
sys.exit(not (chosen == [(True, True), (False, True)] and start == -np.inf))
PY
