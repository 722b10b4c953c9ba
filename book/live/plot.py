"""The live plot of a run: angles, pressure and command, drawn anew as samples come in."""

from collections.abc import Sequence
from io import BytesIO
from typing import Any

import numpy as np
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.figure import Figure

from book.companion.style import BLUE, GREEN, MEASURED, PRINTED, VERMILION, WIDTH, style
from softgrip.rig.live import LiveExperiment, Sample
from softgrip.units import DEG, REV

FINGERS = ((MEASURED, "-"), (BLUE, "--"))
"""Colour and dash of each finger's angle."""


class LivePlot:
    """A figure that is made once; later only its numbers change.

    So that a thread can draw while others do too: the settings of a style are the whole
    process's, and are needed when the figure is made.

    Args:
        experiment: Its reference is drawn ahead.
        fingers: 1 or 2.
        back_end: What is driven, in words: the title.
    """

    def __init__(self, experiment: LiveExperiment, fingers: int, back_end: str) -> None:
        self.experiment, self.back_end = experiment, back_end
        with style():
            self.figure = Figure(figsize=(WIDTH, 4.6))
            canvas: Any = FigureCanvasAgg  # has no types
            self._canvas = canvas(self.figure)
            self._make(fingers)
            self._canvas.draw()  # the layout is found once, and then kept
            self.figure.set_layout_engine("none")

    def _make(self, fingers: int) -> None:
        panels = self.figure.subplots(3, 1, sharex=True, height_ratios=(2, 1, 1))
        angle, self._pressures, motor = panels
        reference = self.experiment.reference / DEG
        angle.plot(self.experiment.time, reference, color=PRINTED, label="reference")
        self._angles = [
            angle.plot([], [], color=color, ls=dash, lw=1, label=f"finger {k}")[0]
            for k, (color, dash) in enumerate(FINGERS[:fingers], 1)
        ]
        (self._pressure,) = self._pressures.plot([], [], color=GREEN, lw=1.2)
        (self._command,) = motor.plot([], [], color=VERMILION, lw=1, drawstyle="steps-pre")
        angle.set(title=self.back_end, ylabel="angle (deg)", ylim=(-15, reference.max() + 35))
        angle.legend(loc="upper right", ncols=1 + fingers)
        self._pressures.set(ylabel="kPa", ylim=(-2, 15))
        motor.set(xlabel="time (s)", ylabel="rev/s", ylim=(-5.5, 5.5))
        motor.set_xlim(0, self.experiment.duration)
        self.figure.align_ylabels(panels)

    def update(self, samples: Sequence[Sample]) -> None:
        """Draw these samples; none are fine."""
        time = [one.time for one in samples]
        pressure = np.array([one.pressure for one in samples]) / 1e3
        for k, line in enumerate(self._angles):
            line.set_data(time, [one.angles[k] / DEG for one in samples])
        self._pressure.set_data(time, pressure)
        self._command.set_data(time, [one.command / REV for one in samples])
        # Grows only: a scale that jumps back and forth cannot be read.
        top = max(self._pressures.get_ylim()[1], 1.1 * float(pressure.max(initial=0.0)))
        self._pressures.set_ylim(-0.13 * top, top)

    def alt(self, samples: Sequence[Sample]) -> str:
        """Return the picture in words."""
        last = samples[-1].time if samples else 0.0
        return (
            f"The {self.experiment.name} on the {self.back_end} to {last:.1f} s: reference and "
            "angle, pressure, and speed of the motor over time."
        )

    def png(self) -> bytes:
        """Return the picture as PNG."""
        file = BytesIO()
        self._canvas.print_png(file)
        return file.getvalue()
