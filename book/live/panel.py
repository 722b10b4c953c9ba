"""The control panel of a rig: buttons that drive and stop it, and a plot of what it does."""

import atexit
import html
import os
import shutil
import threading
from collections.abc import Mapping
from pathlib import Path
from tempfile import mkdtemp
from typing import Any

import ipywidgets as widgets

from book.companion.save import svg
from book.companion.show import image
from book.live.experiments import experiments
from book.live.plot import LivePlot
from softgrip.errors import InvalidInputError, SoftgripError
from softgrip.rig.interface import Rig
from softgrip.rig.live import LiveRun, check_period

REDRAW_EVERY = 0.25
"""s."""
REST = 3.0
"""s between homing and a run: a finger that was bent comes to rest."""
FOLDER = Path.home() / "softgrip-runs"
"""Of logs, unless another one is named: outside a checkout, where nothing cleans it away."""


class ControlPanel:
    """Buttons that drive a rig and a plot of what it does; see `control_panel`.

    Attributes:
        logs: Of finished runs, by experiment.
        run: The last; None before the first.
    """

    def __init__(
        self, rig: Rig, folder: Path | str, *, real_time: bool = True, rest: float = REST
    ) -> None:
        check_period(rig)
        self.rig, self.folder = rig, Path(folder)
        self.logs: dict[str, list[Path]] = {name: [] for name in experiments()}
        self.run: LiveRun | None = None
        self._real_time, self._rest = real_time, rest
        self.experiment = widgets.Dropdown(options=[*self.logs], description="Experiment")
        self.start = widgets.Button(description="Home and start", icon="play")
        self.stop = widgets.Button(
            description="EMERGENCY STOP", button_style="danger", layout={"width": "14rem"}
        )
        self.clear = widgets.Button(description="Clear the stop")
        self.words, self.picture = widgets.HTML(), widgets.HTML()
        self.start.on_click(lambda _: self._try(self._start))
        self.stop.on_click(lambda _: self._try(self._stop))
        self.clear.on_click(lambda _: self._try(self._clear))
        buttons = widgets.HBox([self.experiment, self.start, self.stop, self.clear])
        buttons.layout.flex_flow = "row wrap"
        self.widget = widgets.VBox([buttons, self.words, self.picture])
        self._say("nothing moves before a click")

    def _say(self, words: str) -> None:
        self.words.value = f'<div role="status">{html.escape(words)}</div>'

    def _try(self, action: Any) -> None:
        try:
            action()
        except (SoftgripError, OSError) as error:
            self._say(str(error))

    @property
    def _busy(self) -> bool:
        return self.run is not None and self.run.is_alive()

    def _start(self) -> None:
        if self._busy:
            return
        experiment = experiments()[self.experiment.value]
        run = LiveRun(
            self.rig,
            experiment,
            experiment.log_path(self.folder),
            rest=self._rest,
            real_time=self._real_time,
        )
        plot = LivePlot(experiment, self.rig.fingers, self.rig.header().back_end)
        run.start()
        self.run = run
        self.start.disabled = self.clear.disabled = True
        # Not in the kernel's thread, which must be free for the button that stops.
        threading.Thread(target=self._follow, args=(run, plot), daemon=True).start()

    def _stop(self) -> None:
        if self.run is not None and self._busy:
            self.run.emergency_stop()
        else:
            self.rig.emergency_stop()
            self._say("stopped; clear the stop to go on")

    def _clear(self) -> None:
        if not self._busy:
            self.rig.clear()
            self._say("cleared")

    def _follow(self, run: LiveRun, plot: LivePlot) -> None:
        try:
            while run.is_alive():
                self._draw(run, plot)
                run.join(REDRAW_EVERY)
            self._draw(run, plot)
        finally:
            run.join()
            if run.recording is not None:
                self.logs[run.experiment.name].append(run.path)
            reason = "" if run.error is None else f": {run.error}"
            self._say(f"{run.state}{reason}; log: {run.path}")
            self.start.disabled = self.clear.disabled = False

    def _draw(self, run: LiveRun, plot: LivePlot) -> None:
        samples = [*run.samples]  # the run appends meanwhile
        plot.update(samples)
        self.picture.value = image(plot.png(), "png", plot.alt(samples))
        done = samples[-1].time if samples else 0.0
        self._say(f"{run.state}, {done:.1f} of {run.experiment.duration:.1f} s")

    def close(self) -> None:
        """End a run that is on, bring the rig to rest, and give its port up."""
        if self.run is not None and self._busy:
            # Else the run would take the closed line for a lost one, and find it again.
            self.run.emergency_stop()
            self.run.join()
        with self.rig:
            pass

    def _repr_mimebundle_(self, **options: Any) -> Mapping[str, Any]:
        return self.widget._repr_mimebundle_(**options)  # type: ignore[no-any-return]


class FinishedRun:
    """A run of the simulated rig as a still picture, for a page that no kernel serves.

    Attributes:
        logs: As of `ControlPanel`.
        run: What was run.
    """

    def __init__(self, rig: Rig, folder: Path | str, name: str) -> None:
        if (found := rig.header().back_end) != "simulated rig":
            raise InvalidInputError("rig", expected="the simulated rig", got=found)
        self._rig = rig
        run = LiveRun(rig, experiments()[name], Path(folder) / f"{name}.csv", real_time=False)
        run.start()
        run.wait()
        self.run, self._made = run, LivePlot(run.experiment, rig.fingers, found)
        self._made.update(run.samples)
        self.logs = {one: [run.path] if one == name else [] for one in experiments()}

    def close(self) -> None:
        """Give the rig up."""
        with self._rig:
            pass

    def _repr_mimebundle_(self, **_: Any) -> dict[str, str]:
        picture = image(svg(self._made.figure), "svg+xml", self._made.alt(self.run.samples))
        words = (
            f"This page has no kernel. What stands here is a finished {self.run.experiment.name} "
            "of the <b>simulated</b> rig. Opened as a notebook, here are the buttons and the plot "
            "of a run while it goes on."
        )
        return {"text/html": f"{picture}<p><small>{words}</small></p>"}


def control_panel(
    rig: Rig, folder: Path | str | None = None, *, shown: str = "staircase", real_time: bool = True
) -> ControlPanel | FinishedRun:
    """Return the panel of a rig, to be the last expression of a cell.

    Nothing moves before its start button is clicked; the plunger is then drawn out, and the
    experiment runs in a thread of its own, so that the emergency stop is heard. In the built book
    (``SOFTGRIP_BOOK=static``) it is a finished run of the simulated rig, and any other rig is
    refused.

    Args:
        rig: Sampled each 25 ms.
        folder: Of the logs; None for `FOLDER`, or, in the built book, one that is thrown away.
        shown: The experiment that the built book shows.
        real_time: Whether the simulated rig keeps the pace of a clock.
    """
    if os.environ.get("SOFTGRIP_BOOK") == "static":
        if folder is None:
            folder = mkdtemp()
            atexit.register(shutil.rmtree, folder, ignore_errors=True)
        return FinishedRun(rig, folder, shown)
    return ControlPanel(rig, FOLDER if folder is None else folder, real_time=real_time)
