"""What a log of the pad says: its own calibration, known weights, and the contacts.

What is done with the pad is said by events, each for the stretch of time up to the next of them:

``rest``
    Nothing touches the pad.
``press: element 3``
    This element alone is pressed, up to its full range; each of the eight once.
``weight: 20 gf``
    A known weight lies on the pad (in gf, mN or N).
``line: small carrot``
    A contact of a known kind (point, line or surface), and what touches.
``contact: small carrot``
    A contact whose kind is to be told.

Other words say nothing of the pad. Of a stretch counts what is held still for half a second; in one
with contacts each press that is counts as one. What was not said while the log was written can be
said afterwards, as labels: begin and end, s, and the words.
"""

from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from numpy.lib.stride_tricks import sliding_window_view
from numpy.typing import NDArray

from softgrip.arrays import Floats
from softgrip.errors import DataFileError, InvalidInputError
from softgrip.files import path_of
from softgrip.logs.gaps import period_of
from softgrip.logs.reader import read_log
from softgrip.logs.schema import MORE_COLUMNS, PAD_CHANNELS, Log
from softgrip.quantities import in_si
from softgrip.tactile.contact_pose import FELT
from softgrip.tactile.contacts import ELEMENTS, KINDS, Contacts
from softgrip.tactile.own_pad import PadReadings

TRUTH = {name: MORE_COLUMNS[name] for name in ("contact_x", "contact_y", "contact_angle")}
"""Columns that a simulated log may have beside those of the set-up: middle of the contact, angle of
a line (else 0). The command is then the contact force."""
REST, PRESS, WEIGHT, CONTACT = "rest", "press: element ", "weight: ", "contact"
"""Words of events, or their beginnings."""
LARGEST_COUNT = 1023
SATURATED = 0.1
"""Share of the contacts in which an element may be at the end of the
converter: in more of them its wire is broken, or it is pressed too hard (assumed)."""
HELD = 0.5
"""s that a press must be held for."""
STILL = 0.05
"""Largest movement of a channel that is held still, V: ten steps of the converter (assumed)."""

Label = tuple[float, float, str]
"""Begin and end of a stretch of time, s, and its words."""
Rows = NDArray[np.intp]


def weight_of(words: str) -> float:
    """Return the force of an event, N.

    Raises:
        InvalidInputError: If the words are not such.

    >>> weight_of("weight: 0.2 N")
    0.2
    """
    try:
        return in_si("weight", words.removeprefix(WEIGHT), "N")
    except InvalidInputError as error:
        expected = f"such as 'weight: 20 gf', {error.expected}"
        raise InvalidInputError("weight", expected=expected, got=words) from None


def _known(words: str) -> bool:
    kind = words.partition(": ")[0]
    return words == REST or words.startswith((PRESS, WEIGHT)) or kind in (*KINDS, CONTACT)


@dataclass(frozen=True, eq=False)
class _PadLog:
    """A log, the voltages of its channels, shape (rows, 9), and what is said of which rows."""

    path: Path
    log: Log
    volts: Floats
    stretches: tuple[tuple[str, Rows], ...]

    def refusal(self, expected: str, got: str) -> DataFileError:
        """Return the error of this log."""
        return DataFileError(self.path, expected=expected, got=got)

    def held(
        self,
        words: str,
        rows: Rows,
        channels: list[int],
        sign: float = 1.0,
        *,
        saturated: bool = False,
    ) -> Rows:
        """Return rows that are held still, those in which the sum of some channels is largest.

        `saturated`: elements may be at the upper end of the converter's range.

        Raises:
            DataFileError: If none are, or a channel is at the end of the converter's range.
        """
        count = max(1, round(HELD / period_of(self.log)))
        if len(rows) >= count:
            windows = sliding_window_view(self.volts[rows], count, axis=0)
            still = np.ptp(windows, axis=-1).max(axis=-1) <= STILL
            if still.any():
                strength = sign * windows[:, channels].mean(axis=-1).sum(axis=-1)
                first = int(np.where(still, strength, -np.inf).argmax())
                self._check(rows[first : first + count], saturated)
                return rows[first : first + count]
        raise self.refusal(
            f"{HELD:g} s after {words!r} in which no channel moves by more than {1e3 * STILL:g} mV",
            f"none from {self.log['time'][rows[0]]:g} s on: take longer, and hold still",
        )

    def _check(self, rows: Rows, saturated: bool) -> None:
        element, layer = (1, LARGEST_COUNT + saturated), (0, LARGEST_COUNT)
        for name, (least, end) in zip(PAD_CHANNELS, (element,) * ELEMENTS + (layer,), strict=True):
            counts = self.log[f"{name}_counts"][rows]
            bad = (counts < least) | (counts >= end)
            if bad.any():
                raise self.refusal(
                    f"{name}_counts between {least} and {end - 1}",
                    f"{counts[bad][0]:g} at {self.log['time'][rows][bad][0]:g} s: saturated, "
                    "or a broken wire",
                )

    def check_saturated(self, contacts: Sequence[Rows]) -> None:
        """Refuse an element that is at the end of the converter's range in too many contacts.

        In a few it is at its ceiling, beyond its response of one, and nothing is lost.
        """
        for name in PAD_CHANNELS[:ELEMENTS]:
            counts = self.log[f"{name}_counts"]
            times = sum(bool((counts[rows] >= LARGEST_COUNT).any()) for rows in contacts)
            if times > (most := int(SATURATED * len(contacts))):
                raise self.refusal(
                    f"{name}_counts of {LARGEST_COUNT} in {most} of {len(contacts)} contacts or "
                    "less",
                    f"in {times}: saturated, or a broken wire",
                )

    def mean(self, rows: Rows) -> Floats:
        """Return the mean voltages of rows, shape (9,)."""
        found: Floats = self.volts[rows].mean(axis=0)
        return found

    def at_rest(self) -> Floats:
        """Return the voltages at rest, shape (9,).

        Raises:
            DataFileError: If nothing is said to be at rest.
        """
        for words, rows in self.stretches:
            if words == REST:
                return self.mean(self.held(words, rows, [*range(ELEMENTS)], -1.0))
        raise self.refusal(
            f"the event {REST!r}",
            "none: begin a log with the steps of softgrip.rig.record_pad.calibration_steps",
        )

    def responses(self) -> Floats:
        """Return the responses of the elements in each row, 0 at rest to 1 pressed, (rows, 8).

        Raises:
            DataFileError: If the log has no rows of its calibration, or an element does not rise
                when pressed.
        """
        rest = self.at_rest()[:ELEMENTS]
        wanted = [f"{PRESS}{k + 1}" for k in range(ELEMENTS)]
        pressed = {words: rows for words, rows in reversed(self.stretches) if words in wanted}
        if missing := [words for words in wanted if words not in pressed]:
            raise self.refusal(
                f"each element pressed once, events {wanted[0]!r} to {wanted[-1]!r}",
                f"no {missing}: see softgrip.rig.record_pad.calibration_steps",
            )
        full = np.array([self.mean(self.held(w, pressed[w], [k]))[k] for k, w in enumerate(wanted)])
        for name, change in zip(PAD_CHANNELS, full - rest, strict=False):
            if not change > 0:
                raise self.refusal(f"{name} to rise when pressed", f"a change of {change:g} V")
        found: Floats = np.clip((self.volts[:, :ELEMENTS] - rest) / (full - rest), 0, 1)
        return found


def _open(path: Path | str, labels: Sequence[Label]) -> _PadLog:
    """Read a log and what is said of its rows."""
    file = path_of(path)
    log = read_log(file)
    if log.header.set_up != "pad":
        raise DataFileError(file, expected="the set-up pad", got=log.header.set_up)
    told = [(time, words) for time, event in log.events for words in event.split("; ")]
    told = [(time, words) for time, words in told if _known(words)]
    ends = [*(time for time, _ in told[1:]), np.inf]
    spans = [(start, end, words) for (start, words), end in zip(told, ends, strict=False)]
    stretches = []
    for start, end, words in (*spans, *labels):
        rows = np.arange(*np.searchsorted(log["time"], (start, end)))
        if not (_known(words) and rows.size):
            raise InvalidInputError(
                "labels", expected="begin, end within the log, words such as 'line: small carrot'",
                got=(start, end, words),
            )  # fmt: skip
        stretches.append((words, rows))
    volts = np.stack([log[name] for name in PAD_CHANNELS], axis=1)
    return _PadLog(file, log, volts, tuple(stretches))


def _presses(strongest: Floats) -> list[Rows]:
    """Return the rows of each press, felt and then released, from the strongest response."""
    released = strongest <= FELT / 2
    runs = np.split(np.arange(strongest.size), np.flatnonzero(np.diff(released)) + 1)
    felt = [run for run in runs if strongest[run].max() > FELT]
    return felt or [np.arange(strongest.size)]


def read_contacts(path: Path | str, labels: Sequence[Label] = ()) -> Contacts:
    """Read the contacts of a log of the pad, normalised by the log's own calibration.

    A press that is not held still is left out, if another one of its stretch is. An element that a
    contact brings to the end of the converter's range responds with one, as at the end of its own.

    Args:
        path: Of the log.
        labels: What was not said while it was written.

    Raises:
        DataFileError: If it is no log of a pad, has no calibration or no contact, nothing was held
            still after a word, a channel was saturated (an element in more contacts than
            `SATURATED`), or only some of the columns of `TRUTH` are
            there.
        InvalidInputError: If a label has no rows, or other words than an event.
    """
    pad = _open(path, labels)
    given = [name for name in TRUTH if name in pad.log.columns]
    if 0 < len(given) < len(TRUTH):
        raise pad.refusal(f"the columns {list(TRUTH)}", f"only {given}")
    responses = pad.responses()
    found: list[tuple[str, str, Rows]] = []
    for words, rows in pad.stretches:
        kind, _, name = words.partition(": ")
        if kind not in (*KINDS, CONTACT):
            continue
        before, failure = len(found), None
        for press in _presses(responses[rows].max(axis=1)):
            try:
                at = pad.held(words, rows[press], [*range(ELEMENTS)], saturated=True)
                found.append((kind, name, at))
            except DataFileError as error:
                failure = error
        if failure and len(found) == before:
            raise failure
    if not found:
        raise pad.refusal(
            "contacts: events, or labels, such as 'line: small carrot' or 'contact'",
            f"only {sorted({words for words, _ in pad.stretches})}",
        )
    pad.check_saturated([at for _, _, at in found])
    kinds = np.array([kind if kind in KINDS else "" for kind, _, _ in found])
    one = [int(at[len(at) // 2]) for _, _, at in found]
    log, unknown = pad.log, np.full(len(found), np.nan)
    return Contacts(
        responses=np.array([responses[at].mean(axis=0) for _, _, at in found]),
        layer=np.array([pad.mean(at)[ELEMENTS] for _, _, at in found]),
        times=log["time"][one],
        kinds=kinds,
        objects=np.array([name for _, name, _ in found]),
        places=np.stack(
            [log[name][one] if given else unknown for name in ("contact_x", "contact_y")], axis=1
        ),
        angles=np.where(kinds == "line", log["contact_angle"][one] if given else np.nan, np.nan),
        forces=log["command"][one] if given else unknown,
    )


def read_weights(path: Path | str, labels: Sequence[Label] = ()) -> PadReadings:
    """Read the known weights of a log: voltages of the force layer and forces, with that at rest.

    Parameters and errors are as of `read_contacts`.
    """
    pad = _open(path, labels)
    weights = [(words, rows) for words, rows in pad.stretches if words.startswith(WEIGHT)]
    if not weights:
        raise pad.refusal(
            "known weights: events, or labels, such as 'weight: 20 gf'",
            "none: see softgrip.rig.record_pad.weight_steps",
        )
    layer = [pad.at_rest()[ELEMENTS]]
    layer += [pad.mean(pad.held(w, rows, [ELEMENTS]))[ELEMENTS] for w, rows in weights]
    forces = [0.0, *(weight_of(words) for words, _ in weights)]
    return PadReadings(("layer",), np.array(layer)[:, None], np.array(forces))
