"""Processes that start with the libraries loaded: forked from one that imported them once.

A page's kernel, or what judges a chapter, takes two to four seconds of computing to import what it
stands on, which is the same for all; a fork takes none, and shares the memory. Modules of ours are
not among it: what a process imports of those is what it depends on (`book.build.tracing`).
"""

import multiprocessing
import os
import sys
from collections.abc import Callable
from typing import Any

from jupyter_client.manager import AsyncKernelManager

LIBRARIES = (
    "casadi",
    "control",
    "filterpy.kalman",
    "ipykernel.ipkernel",
    "ipykernel.kernelapp",
    "IPython.display",
    "matplotlib.backends.backend_svg",
    "matplotlib.figure",
    "pandas",
    "pint",
    "scipy.optimize",
    "scipy.signal",
    "scipy.stats",
    "sklearn.model_selection",
    "sklearn.neighbors",
    "sklearn.svm",
)

SAFE = sys.platform == "linux"
"""Elsewhere no process can be forked, or not one that has used the system's libraries."""


def process(target: Callable[..., None], *arguments: object) -> Any:
    """Return a process that is yet to start, as of `multiprocessing`."""
    context: Any = multiprocessing.get_context("forkserver" if SAFE else "spawn")
    if SAFE:
        # matplotlib reads it when it is imported; a kernel sets it before that.
        os.environ.setdefault("MPLBACKEND", "module://matplotlib_inline.backend_inline")
        context.set_forkserver_preload(["__main__", *LIBRARIES])
    return context.Process(target=target, args=arguments)


def _serve(arguments: list[str], variables: dict[str, str], folder: str) -> None:
    os.setsid()  # as jupyter_client starts a kernel: a signal to the build is none to it
    os.environ.clear()
    os.environ.update(variables)
    os.chdir(folder)
    from ipykernel.kernelapp import launch_new_instance

    # Read from the environment when it was imported: the kernel ends with this parent.
    launch_new_instance(argv=[*arguments, f"--IPKernelApp.parent_handle={os.getppid()}"])


class _Popen:
    """A forked process, to be handled as `subprocess.Popen`."""

    stdin = stdout = stderr = None

    def __init__(self, process: Any) -> None:
        self.process, self.kill, self.terminate = process, process.kill, process.terminate
        self.pid = process.pid

    def poll(self) -> int | None:
        return self.process.exitcode  # type: ignore[no-any-return]

    def wait(self) -> int | None:
        self.process.join()
        return self.poll()

    def send_signal(self, number: int) -> None:
        os.kill(self.pid, number)


class ForkedKernelManager(AsyncKernelManager):
    """Starts a kernel as a fork."""

    async def _async_launch_kernel(self, kernel_cmd: list[str], **options: Any) -> None:
        provisioner: Any = self.provisioner
        arguments = kernel_cmd[kernel_cmd.index("-f") :]
        started = process(_serve, arguments, options["env"], options.get("cwd") or ".")
        started.start()
        provisioner.process, provisioner.pid = _Popen(started), started.pid


KERNELS = ForkedKernelManager if SAFE else AsyncKernelManager
"""What starts the kernels of pages."""
