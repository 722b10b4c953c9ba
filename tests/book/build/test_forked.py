"""A kernel that is forked: its own environment, no module of ours, and an end."""

import asyncio
from concurrent.futures import ThreadPoolExecutor

import pytest
from nbclient import NotebookClient
from nbformat.v4 import new_code_cell, new_notebook

from book.build import forked

CELL = """\
import os, sys
print(os.environ["WHOSE"], os.getcwd(), os.getsid(0) == os.getpid())
print("numpy" in sys.modules, sorted({m for m in sys.modules if m.startswith("softgrip")}))
"""


@pytest.mark.skipif(not forked.SAFE, reason="kernels are forked on Linux alone")
def test_a_forked_kernel_is_one_of_its_own(tmp_path):
    notebook = new_notebook(cells=[new_code_cell(CELL)])
    client = NotebookClient(
        notebook,
        resources={"metadata": {"path": str(tmp_path)}},
        kernel_manager_class=forked.ForkedKernelManager,
    )
    run = client.async_execute(env={"WHOSE": "mine", "HOME": str(tmp_path)})
    with ThreadPoolExecutor() as threads:  # a browser of other tests may have a loop in this one
        threads.submit(asyncio.run, run).result()
    (said,) = [output.text for output in notebook.cells[0].outputs]
    assert said.split("\n")[:2] == [f"mine {tmp_path} True", "True []"]


def _leave(code):
    raise SystemExit(code)


def test_a_process_tells_how_it_ended():
    process = forked.process(_leave, 3)
    process.start()
    process.join()
    assert process.exitcode == 3
