"""The simulated pad at the end of an imagined line: heard as that of a board is."""

from softgrip.board.protocol import CHANNELS, TELEMETRY_PERIOD, Flag
from softgrip.board.session import Telemetry
from softgrip.logs.schema import LogHeader
from softgrip.provenance import Provenance
from softgrip.simulator.chance import SEED
from softgrip.simulator.pad_hand import PadHand


class SimulatedPad:
    """A pad, and a hand that obeys: hand `obey` to `record_pad` as what the steps are said to.

    Time is simulated: nobody waits for it.

    Args:
        seed, pad_seed: As of `PadHand`.

    Attributes:
        hand: What presses the pad; it remembers what it did.
    """

    def __init__(self, *, seed: int = 0, pad_seed: int = SEED) -> None:
        self.hand = PadHand(seed=seed, pad_seed=pad_seed)
        self._seeds, self._number = f"{seed} and pad {pad_seed}", 0

    def obey(self, words: str) -> None:
        """Do what words say, from the next sample on."""
        self.hand.obey(words, (self._number + 1) * TELEMETRY_PERIOD)

    def listen(self) -> Telemetry:
        """Return the next telemetry: a period later."""
        self._number += 1
        time = self._number * TELEMETRY_PERIOD
        told = tuple(int(count) for count in self.hand.counts(time))
        silent = (0,) * (len(CHANNELS) - len(told))
        return Telemetry(self._number, time, told + silent, position=0, speed=0, flags=Flag(0))

    def take_event(self) -> str:
        """Return words on what happened since the last call: nothing ever does."""
        return ""

    def header(self) -> LogHeader:
        """Return what a log says of this pad."""
        return LogHeader(
            provenance=Provenance.SIMULATED,
            source="softgrip.rig.simulated_pad",
            back_end="simulated rig",
            period=TELEMETRY_PERIOD,
            calibration="data/calibration/pad.csv",
            seed=self._seeds,
            set_up="pad",
        )
