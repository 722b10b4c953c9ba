"""Pages side by side: those whose outputs are not kept run before Sphinx reads them, some at once.

MyST-NB runs a page when it is read, one after the other. What jupyter-cache keeps by then it takes
from there. A page that fails is left to it: it runs again, and the error is told as ever.
"""

import asyncio
import os
import time
from collections.abc import Callable, Iterable
from pathlib import Path
from typing import Any

from jupyter_cache import get_cache
from jupyter_cache.base import CacheBundleIn
from myst_nb.core.read import create_nb_reader
from nbclient import NotebookClient
from nbclient.exceptions import CellExecutionError, CellTimeoutError
from nbformat import NotebookNode

from book.build import forked, judging

MOST = 4
"""Pages at a time, or as many as there are cores: a kernel takes up to a gigabyte."""


def waiting(env: Any, pages: Iterable[str]) -> dict[str, NotebookNode]:
    """Return the notebooks among some pages whose outputs are not kept, by page."""
    cache, found = get_cache(env.mystnb_config.execution_cache_path), {}
    for page in pages:
        path = Path(env.doc2path(page))
        text = path.read_text(encoding="utf-8")
        if reader := create_nb_reader(str(path), env.myst_config, env.mystnb_config, text):
            notebook = reader.read(text)
            try:
                cache.match_cache_notebook(notebook)
            except KeyError:
                found[page] = notebook
    return found


def execute(
    env: Any,
    pages: Iterable[str],
    variables: Callable[[str], dict[str, str]],
    verdicts: Path,
) -> None:
    """Run pages and keep their outputs; those that fail are left out.

    The verdicts that they tell are judged before, and the longest pages run first.

    Args:
        env: Of Sphinx, with the settings of MyST-NB.
        pages: By name; those whose outputs are kept, or that have no code, are skipped.
        variables: Gives the environment of a page's kernel.
        verdicts: Folder of what is judged.
    """
    left = waiting(env, pages)
    texts = {page: "\n".join(cell.source for cell in left[page].cells) for page in left}
    chapters = judging.missing(texts.values(), verdicts)
    cache = get_cache(env.mystnb_config.execution_cache_path)
    cores = len(os.sched_getaffinity(0)) if hasattr(os, "sched_getaffinity") else os.cpu_count()
    at_a_time = asyncio.Semaphore(min(MOST, cores or 1))

    async def run(page: str) -> None:
        path, notebook = Path(env.doc2path(page)), left[page]
        async with at_a_time:
            begun = time.monotonic()
            client = NotebookClient(
                notebook,
                timeout=env.mystnb_config.execution_timeout,
                record_timing=False,  # it would stand in the cells, by which outputs are found
                resources={"metadata": {"path": str(path.parent)}},
                kernel_manager_class=forked.KERNELS,
            )
            try:
                await client.async_execute(env=os.environ | variables(page))
            except (CellExecutionError, CellTimeoutError):
                return
            took = time.monotonic() - begun
        print(f"ran: {page} in {took:.0f} s", flush=True)
        bundle = CacheBundleIn(notebook, str(path), data={"execution_seconds": took})
        cache.cache_notebook_bundle(bundle, check_validity=False, overwrite=True)

    async def judge(chapter: int) -> None:
        async with at_a_time:
            await asyncio.to_thread(judging.judge_apart, verdicts, chapter)

    async def run_all() -> None:
        await asyncio.gather(*map(judge, chapters))
        await asyncio.gather(*map(run, sorted(left, key=lambda page: -len(texts[page]))))

    asyncio.run(run_all())
