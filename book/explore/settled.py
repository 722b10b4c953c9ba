"""When an output settles, told within a loop: a sample at a time."""

from softgrip.arrays import Number, chosen


def entered(time: Number, period: float, before: Number, excess: Number, found: Number) -> Number:
    """Return when an output last came into its band, by a straight line between two samples.

    After the last sample that is what `step_metrics.settling_time` returns of the whole record, if
    the last sample is within the band.

    Args:
        time: Of this sample, s.
        period: Since the one before, s.
        before, excess: By how much the output was, and is, beyond its band; below 0 within it, and
            not above 0 before the first sample.
        found: What was returned for the sample before; 0 for the first.

    >>> round(float(entered(0.2, 0.1, 1.0, -1.0, 0.0)), 9)
    0.15
    """
    came = (before > 0) * (excess <= 0)
    # Where it did not come in, the quotient is not taken, and must not divide by zero.
    fall = chosen(came, before - excess, 1.0)
    return chosen(came, time - period + period * before / fall, found)
