"""PyElastica in a process and an environment of its own, and the rods that it is given."""

import json
import subprocess
import sys
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path
from tempfile import TemporaryFile
from typing import Any

import numpy as np
from scipy.optimize import curve_fit
from uv import find_uv_bin

from softgrip.actuator.bending import Finger, modified_moment
from softgrip.actuator.frequency import spring_constant
from softgrip.actuator.section import Section

SCRIPT = Path(__file__).parent / "elastica_rod.py"
VERSION = "1.0.0"
SECONDS, SAMPLES = 3.0, 301
FREQUENCY, DAMPING_RATIO = 2.86, 0.7
"""Of Design 1, rad/s, and Section 3.2."""
RUBBER = 1080.0
"""Density of Dragon Skin, kg/m^3."""
COURANT = 0.9
"""Step as a part of the time that a wave takes through an element; at 1 the rods blow up."""
SMALL = 0.1
"""A tip angle by Eq. (3.13), rad."""

FINGER = Finger(Section(0.020, 0.004, 0.030, 0.0015))
BENDING = FINGER.young_modulus * modified_moment(1.0, 0.030, 0.024)
LENGTH = FINGER.length
RADIUS = float((4 * BENDING / FINGER.young_modulus / np.pi) ** 0.25)
AREA = float(np.pi * RADIUS**2)
FIRST_ROOT = 1.8751040687
"""Of ``cos(x) cosh(x) = -1``: Euler and Bernoulli's first mode of a uniform cantilever."""


@dataclass(frozen=True)
class Rod:
    """What the rod weighs, kg/m^3 and kg."""

    density: float
    tip_mass: float = 0.0

    def step(self, elements: int, courant: float = COURANT) -> float:
        """Return the time step, s."""
        return courant * LENGTH / elements * (self.density / FINGER.young_modulus) ** 0.5


UNIFORM = Rod(BENDING / AREA * (FIRST_ROOT / LENGTH) ** 4 / FREQUENCY**2)
# Rayleigh's quotient of a tip mass: 33/140 of the rod moves with it.
TIPPED = Rod(RUBBER, 3 * BENDING / LENGTH**3 / FREQUENCY**2 - 33 / 140 * RUBBER * AREA * LENGTH)


class Elastica:
    """A running PyElastica: runs in its own process, one after the other."""

    def __init__(self, process: "subprocess.Popen[str]") -> None:
        self.process = process

    def run(
        self,
        rod: Rod,
        elements: int,
        angle: float = SMALL,
        *,
        damping_ratio: float = DAMPING_RATIO,
        seconds: float = SECONDS,
        courant: float = COURANT,
    ) -> dict[str, Any]:
        """Return seconds taken, times and tip angles of a step response."""
        asked = {
            "elements": elements, "length": LENGTH, "radius": RADIUS,
            "young_modulus": FINGER.young_modulus, "density": rod.density,
            "tip_mass": rod.tip_mass, "force": angle * spring_constant(FINGER),
            "damping": 2 * damping_ratio * FREQUENCY, "step": rod.step(elements, courant),
            "seconds": seconds, "kept": SAMPLES,
        }  # fmt: skip
        assert self.process.stdin is not None
        assert self.process.stdout is not None
        print(json.dumps(asked), file=self.process.stdin, flush=True)
        return json.loads(self.process.stdout.readline())

    def frequency(self, rod: Rod, elements: int) -> float:
        """Return the first frequency without damping, rad/s, by a fit to 12 s of the tip angle."""
        # At ten times the angle 20 undamped elements with a mass at the tip blow up after 8 s, with
        # half the step too.
        angle = SMALL / 10
        found = self.run(rod, elements, angle, damping_ratio=0.0, seconds=12.0)

        def swing(t, w, mean, c, s):
            return mean + c * np.cos(w * t) + s * np.sin(w * t)

        start = (FREQUENCY, angle, -angle, 0.0)
        return float(curve_fit(swing, found["times"], found["angles"], p0=start)[0][0])


@contextmanager
def elastica() -> Iterator[Elastica | str]:
    """Start PyElastica; give it, or the reason why it does not run."""
    command = [
        find_uv_bin(), "run", "--no-project", "--isolated", "--python", sys.executable,
        "--with", f"pyelastica=={VERSION}", "python", "-P", str(SCRIPT),
    ]  # fmt: skip
    pipe = subprocess.PIPE
    with (
        TemporaryFile("w+") as log,
        subprocess.Popen(command, stdin=pipe, stdout=pipe, stderr=log, text=True) as process,
    ):
        started = Elastica(process)
        try:
            started.run(UNIFORM, 5, seconds=0.1)  # compiles what is run
        except (OSError, ValueError):
            process.wait()
            log.seek(0)
            yield (log.read().strip().splitlines() or ["no reason given"])[-1].strip()
        else:
            yield started
