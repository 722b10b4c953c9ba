"""A sweep that is killed goes on where it stopped, on threads as on a cluster."""

import signal
import subprocess
import sys
import textwrap
import warnings
from functools import partial
from pathlib import Path

import distributed
import joblib
import pytest

from softgrip.errors import DataFileError
from softgrip.journal import continued

QUESTIONS = [*range(9)]


def square(asked, question):
    """Answer, and leave a mark of it."""
    (asked / f"{question}").write_text("")
    return {"square": question**2}


def marks(folder):
    return sorted(int(mark.name) for mark in folder.iterdir())


def test_a_sweep_that_was_killed_asks_only_what_is_left(tmp_path):
    """The whole process dies in the middle, as by the kernel: a new one does the rest."""
    script = f"""
        import os, signal
        from pathlib import Path
        from softgrip.journal import continued
        def work(question):
            if question == 5:
                os.kill(os.getpid(), signal.SIGKILL)
            return {{"square": question**2}}
        continued(work, range(9), Path({str(tmp_path / "answers.jsonl")!r}), jobs=1)
    """
    died = subprocess.run([sys.executable, "-c", textwrap.dedent(script)], cwd=Path.cwd())
    assert died.returncode == -signal.SIGKILL
    asked = tmp_path / "asked"
    asked.mkdir()
    found = continued(partial(square, asked), QUESTIONS, tmp_path / "answers.jsonl", jobs=1)
    assert [one["square"] for one in found] == [k**2 for k in QUESTIONS]
    assert marks(asked) == [5, 6, 7, 8]


def test_a_torn_last_line_is_asked_again(tmp_path):
    file = tmp_path / "answers.jsonl"
    work = partial(square, tmp_path)
    first = continued(work, QUESTIONS, file, jobs=1)
    whole = file.read_bytes()
    file.write_bytes(whole[:-5])
    asked = tmp_path / "asked"
    asked.mkdir()
    assert continued(partial(square, asked), QUESTIONS, file, jobs=1) == first
    assert marks(asked) == [8]
    assert file.read_bytes() == whole


def test_a_torn_line_in_the_middle_is_no_journal(tmp_path):
    file = tmp_path / "answers.jsonl"
    file.write_text('["0", {"squ\n["1", {"square": 1}]\n')
    with pytest.raises(DataFileError, match="a question and its answer"):
        continued(partial(square, tmp_path), QUESTIONS, file)


def test_a_question_that_is_asked_twice_is_worked_on_once(tmp_path):
    asked = tmp_path / "asked"
    asked.mkdir()
    found = continued(partial(square, asked), [2, 2, 3], tmp_path / "answers.jsonl", jobs=1)
    assert found == [{"square": 4}, {"square": 4}, {"square": 9}]


def test_threads_and_a_dask_cluster_give_the_same(tmp_path):
    (tmp_path / "asked").mkdir()
    work = partial(square, tmp_path / "asked")
    alone = continued(work, QUESTIONS, tmp_path / "alone.jsonl", jobs=1)
    with joblib.parallel_config(backend="threading", n_jobs=2):
        assert continued(work, QUESTIONS, tmp_path / "threads.jsonl") == alone
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")  # the cluster's own, on its way up and down
        with (
            distributed.LocalCluster(
                n_workers=2, threads_per_worker=1, processes=False, protocol="tcp",
                host="127.0.0.1", dashboard_address="127.0.0.1:0",
            ) as cluster,
            distributed.Client(cluster),
            joblib.parallel_config(backend="dask"),
        ):  # fmt: skip
            assert continued(work, QUESTIONS, tmp_path / "dask.jsonl") == alone
