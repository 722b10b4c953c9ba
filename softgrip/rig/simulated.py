"""The simulated rig behind the interface of a board; it refuses what the board refuses."""

from pathlib import Path

from numpy.typing import ArrayLike

from softgrip.errors import InvalidInputError
from softgrip.gripper.internal_model import PERIOD
from softgrip.logs.schema import LogHeader
from softgrip.provenance import Provenance
from softgrip.rig.interface import StandIn
from softgrip.simulator.fitted_rigs import DESIGN_1, GRIPPER, design_1, printed_gripper
from softgrip.simulator.rig_file import read_rig
from softgrip.simulator.sensors import Measurement
from softgrip.simulator.simulation import Simulation
from softgrip.simulator.statics import FULL_PRESSURE


def simulated_finger(*, seed: int = 0) -> "SimulatedRig":
    """Return the finger of Chapters 3 to 5, sampled each 25 ms."""
    return SimulatedRig(Simulation(design_1(), seed=seed), f"data/{DESIGN_1}", seed)


def simulated_gripper(*, seed: int = 0) -> "SimulatedRig":
    """Return the two fingers of Section 6.4, sampled each 100 ms, left finger first."""
    rig = Simulation(printed_gripper(), seed=seed, period=PERIOD)
    return SimulatedRig(rig, f"data/{GRIPPER}", seed)


def fitted_rig(path: Path | str, *, seed: int = 0) -> "SimulatedRig":
    """Return a rig of a reader's own, from the file that a fit wrote, sampled as its logs were."""
    own = read_rig(path)
    return SimulatedRig(Simulation(own.rig, seed=seed, period=own.period), Path(path).name, seed)


class SimulatedRig(StandIn):
    """A simulated rig of one run as a `Rig`.

    Args:
        rig: Which; it stays at hand as `rig`, with its truth.
        calibration, seed: For the header of logs.
        pressure_limit: Gauge, Pa.

    >>> with simulated_finger() as finger:
    ...     finger.home()
    ...     finger.advance(5.0).angle.shape
    (1, 1)
    """

    def __init__(
        self,
        rig: Simulation,
        calibration: str = "none",
        seed: int = 0,
        *,
        pressure_limit: float = FULL_PRESSURE,
    ) -> None:
        if rig.runs != 1:
            raise InvalidInputError("rig", expected="one run", got=rig.runs)
        super().__init__("simulated rig", pressure_limit)
        self.rig, self.period = rig, rig.period
        self.fingers = len(rig.parameters.fingers)
        self._calibration, self._seed = calibration, seed
        self._last = rig.measure()

    def measure(self) -> Measurement:
        """Return the last sample: a rig that is sampled knows nothing in between."""
        return self._last

    def advance(self, command: ArrayLike) -> Measurement:
        """Hold a motor speed for one period; see `Rig.advance`."""
        speed = self.permitted(command, float(self._last.pressure[0]))
        self._last = self.rig.advance(speed)
        return self._last

    def stop(self) -> None:
        """Bring the motor to rest, which takes a period."""
        self._last = self.rig.advance(0.0)

    def home(self) -> None:
        """Draw the plunger out to its end; a plunger that is there does not move."""
        limit = self.rig.parameters.pump.speed_limit
        while self.rig.truth.plunger[0] > 0:
            self._last = self.rig.advance(-limit)
        super().home()

    def header(self) -> LogHeader:
        """Return what a log says of this rig."""
        pump = self.rig.parameters.pump
        return LogHeader(
            provenance=Provenance.SIMULATED,
            source="softgrip.rig.simulated",
            back_end="simulated rig",
            period=self.period,
            calibration=self._calibration,
            seed=str(self._seed),
            notes={"area": f"{pump.area!r} m^2", "lead": f"{pump.lead!r} m"},
        )
