"""Tables of the page *Delay, and fingers that stay together*."""

import pandas as pd

from book.beyond.delay import full_rig, step_time
from book.beyond.delay.kept import cell, delays_of_logs
from book.beyond.delay.methods import KNOW_DELAY, METHODS
from book.beyond.delay.sweep import DELAYS, FINGERS, WRONG, Cell
from softgrip.logs.delays import Delay

AT = 300
"""ms: the delay of the tables."""


def number(value: float) -> str:
    """Return a number as the tables have it."""
    return f"{value:.2f}" if abs(value) < 10 else f"{value:.1f}"


def with_interval(one: Cell) -> str:
    """Return a value with its interval."""
    return f"{number(one.value)} ({number(one.low)} to {number(one.high)})"


def gain(one: Cell) -> str:
    """Return a gain over the printed loop at 2/s with its interval."""
    return f"{one.gain:+.2f} ({one.gain_low:+.2f} to {one.gain_high:+.2f})"


def method_table() -> pd.DataFrame:
    """Tabulate what came of each method with two fingers and the longest delay, and its cost."""
    costs = {one.method: one for one in step_time.KEPT.read()}
    return pd.DataFrame(
        [
            {
                "method": name,
                "settled after (s)": with_interval(cell(name, "settling", AT)),
                "settles": f"{100 * cell(name, 'settled', AT).value:.0f} %",
                "apart (deg)": with_interval(cell(name, "apart", AT)),
                "less apart (deg)": gain(cell(name, "apart", AT)),
                "missed (s)": with_interval(cell(name, "missed", AT)),
                "travel (rev)": number(cell(name, "travel", AT).value),
                "a step (µs)": f"{costs[name].middle:.2g}",
            }
            for name in METHODS
        ]
    )


def none_table() -> pd.DataFrame:
    """Tabulate the gain over the printed loop by delay: where it is none, too."""
    return pd.DataFrame(
        [
            {"method": name} | {f"{d} ms": gain(cell(name, "apart", d)) for d in DELAYS}
            for name in METHODS
            if name != "printed, 2/s"
        ]
    )


def finger_table() -> pd.DataFrame:
    """Tabulate how far apart two to five fingers are at the longest delay."""
    return pd.DataFrame(
        [
            {"method": name}
            | {f"{n} fingers": with_interval(cell(name, "apart", AT, fingers=n)) for n in FINGERS}
            for name in METHODS
        ]
    )


def wrong_table() -> pd.DataFrame:
    """Tabulate what a delay that is taken wrongly costs."""
    rows = []
    for name in KNOW_DELAY:
        for wrong in (WRONG[0], 0, WRONG[1]):
            settled = cell(name, "settled", AT, wrong=wrong)
            rows.append(
                {
                    "method": name,
                    "taken": f"{wrong:+d} %" if wrong else "as it is",
                    "settled after (s)": with_interval(cell(name, "settling", AT, wrong=wrong)),
                    "settles": f"{100 * settled.value:.0f} %",
                    "apart (deg)": with_interval(cell(name, "apart", AT, wrong=wrong)),
                }
            )
    return pd.DataFrame(rows)


def own_table() -> pd.DataFrame:
    """Tabulate fingers whose delays differ beside fingers with one delay."""
    return pd.DataFrame(
        [
            {
                "method": name,
                "one delay (deg)": with_interval(cell(name, "apart", AT)),
                "delays of their own (deg)": with_interval(cell(name, "apart", AT, kind="own")),
            }
            for name in METHODS
        ]
    )


def full_table() -> pd.DataFrame:
    """Tabulate the same on the whole simulated rig."""
    return pd.DataFrame(
        [
            {
                "method": one.method,
                "settled after (s)": f"{number(one.settling)} ({number(one.settling_low)} to "
                f"{number(one.settling_high)})",
                "apart (deg)": f"{number(one.apart)} ({number(one.apart_low)} to "
                f"{number(one.apart_high)})",
                "less apart (deg)": f"{one.apart_gain:+.2f} ({one.apart_gain_low:+.2f} to "
                f"{one.apart_gain_high:+.2f})",
            }
            for one in full_rig.KEPT.read()
            if one.delay == AT
        ]
    )


def delay_table() -> pd.DataFrame:
    """Tabulate the delays that the logs of the simulated gripper tell."""
    found = delays_of_logs()
    rows = {"left finger, whole": found.whole[0], "right finger, whole": found.whole[1]}
    if found.transport is not None:
        rows["transport, both"] = found.transport
    if found.response is not None:
        rows |= {"left finger, response": found.response[0]}
        rows |= {"right finger, response": found.response[1]}
    return pd.DataFrame(
        [{"delay": name, "found (ms)": _ms(one.value), "95 % interval (ms)": _span(one)}
         for name, one in rows.items()]
    )  # fmt: skip


def _ms(value: float) -> str:
    return f"{1000 * value:.0f}"


def _span(one: Delay) -> str:
    return f"{_ms(one.low)} to {_ms(one.high)}"
