"""A finished run of the simulated rig: what stands where the control panel would need a kernel."""

from pathlib import Path
from typing import Any

from book.companion.save import svg
from book.companion.show import image
from book.live.experiments import experiments
from book.live.plot import LivePlot
from softgrip.rig.interface import Connection
from softgrip.rig.live import LiveRun
from softgrip.rig.live_rig import check_simulated


class FinishedRun:
    """A run of the simulated rig as a still picture, for a page that no kernel serves.

    Attributes
    ----------
    logs
        As of `ControlPanel`.
    run
        What was run.
    """

    def __init__(self, connection: Connection, folder: Path | str, name: str) -> None:
        check_simulated(connection)
        self._connection = connection
        run = LiveRun(
            connection, experiments()[name], Path(folder) / f"{name}.csv", real_time=False
        )
        run.start()
        run.wait()
        self.run, self._made = run, LivePlot(run.experiment, connection.fingers, run.back_end)
        self._made.update(run.samples)
        self.logs = {one: [run.path] if one == name else [] for one in experiments()}

    def close(self) -> None:
        """Give the rig up."""
        with self._connection:
            pass

    def _repr_mimebundle_(self, **_: Any) -> dict[str, str]:
        picture = image(svg(self._made.figure), "svg+xml", self._made.alt(self.run.samples))
        words = (
            f"This page has no kernel. What stands here is a finished {self.run.experiment.name} "
            "of the <b>simulated</b> rig. Opened as a notebook, here are the buttons and the plot "
            "of a run while it goes on."
        )
        return {"text/html": f"{picture}<p><small>{words}</small></p>"}
