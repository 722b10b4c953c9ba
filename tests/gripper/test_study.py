"""Studies in parts: the same numbers serially, on threads and on a cluster."""

import warnings

import distributed
import joblib
import numpy as np
import pytest

from softgrip.errors import InvalidInputError
from softgrip.gripper.internal_model import controller_matrices
from softgrip.gripper.inversion import mean_inverse
from softgrip.gripper.plant import PRINTED
from softgrip.gripper.shaping_filter import SLOW, filter_state_space
from softgrip.gripper.study import study
from softgrip.gripper.trial import Trial

LOOP = controller_matrices(PRINTED, mean_inverse(PRINTED), filter_state_space(*SLOW))
TRIAL = Trial((0.714, 0.842), limit=5.0, noise=0.01)


def run(**how):
    return study(PRINTED, 60, LOOP, TRIAL, seed=11, **how)


def assert_same(found, true):
    for name in ("settling", "overshoot", "synchronisation", "peak_command"):
        np.testing.assert_allclose(getattr(found, name), getattr(true, name), rtol=1e-9)


def test_parts_on_threads_give_the_serial_numbers():
    assert_same(run(parts=7), run())
    with joblib.parallel_config(backend="threading", n_jobs=2):
        assert_same(run(parts=7), run())


def test_a_dask_cluster_gives_the_serial_numbers():
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")  # the cluster's own, on its way up and down
        with (
            distributed.LocalCluster(
                n_workers=2, threads_per_worker=1, processes=False, protocol="tcp",
                host="127.0.0.1", dashboard_address="127.0.0.1:0",
            ) as cluster,
            distributed.Client(cluster) as client,
        ):  # fmt: skip
            assert len(client.scheduler_info()["workers"]) == 2
            with joblib.parallel_config(backend="dask"):
                found = run(parts=6)
    assert_same(found, run())


def test_more_parts_than_grippers_are_refused():
    with pytest.raises(InvalidInputError, match="1 to 60"):
        run(parts=61)
