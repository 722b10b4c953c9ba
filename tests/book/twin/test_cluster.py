"""Rigs on a cluster of which a worker dies half-way: nothing is lost, nothing counted twice."""

import os
import signal
from functools import partial

import distributed
import joblib
import numpy as np

from book.twin import misfit as module
from book.twin.misfit import misfit
from book.twin.space import space

CHANCE = np.random.default_rng(7)
ROWS = np.transpose([one.at(CHANCE.random(8)) for one in space().values()])
HOW = {"experiments": ("statics", "volume", "lifts", "weights"), "rigs_at_a_time": 1}


def fatal(mark, rows, wanted, progress, part):
    """Work on a part, but kill the process that is the first to come to the second half."""
    if part.start >= len(rows) // 2:
        try:
            with mark.open("x") as file:
                file.write(str(os.getpid()))
        except FileExistsError:
            pass
        else:
            os.kill(os.getpid(), signal.SIGKILL)
    # On a worker, which is another process, this is what the test has replaced.
    return module._part(rows, wanted, progress, part)


def test_a_worker_that_dies_half_way_changes_nothing(tmp_path, monkeypatch):
    whole = misfit(ROWS, **HOW, jobs=1)
    mark = tmp_path / "died"
    monkeypatch.setattr(module, "_part", partial(fatal, mark))
    with (
        distributed.LocalCluster(
            n_workers=2, threads_per_worker=1, host="127.0.0.1", dashboard_address=None
        ) as cluster,
        distributed.Client(cluster),
    ):
        workers = [worker.pid for worker in cluster.workers.values()]
        with joblib.parallel_config(backend="dask"):
            found = misfit(ROWS, **HOW)
    assert int(mark.read_text()) in workers
    np.testing.assert_array_equal(found, whole)
