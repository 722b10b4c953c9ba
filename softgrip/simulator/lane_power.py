"""A power of a number >= 0 that a compiler can work out for several numbers at once.

The library's own is a call for each number, and most of what a step of the simulated rig costs.
"""

from typing import Any

import numpy as np
from llvmlite import ir
from numba import types
from numba.extending import intrinsic

_ROOT_HALF = 0x3FE6A09E667F3BCD  # the bits of sqrt(1 / 2)
_LOG2_E, _LN_2 = 1.4426950408889634, 0.6931471805599453


def _same_bits(given: Any, wanted: Any, kind: ir.Type) -> Any:
    """Return what takes the bits of a number of one type as one of another."""

    def typed(_typing: Any, _value: Any) -> Any:
        return wanted(given), lambda _context, builder, _signature, values: builder.bitcast(
            values[0], kind
        )

    return intrinsic(typed)


_bits = _same_bits(types.float64, types.int64, ir.IntType(64))
_float = _same_bits(types.int64, types.float64, ir.DoubleType())


def power(base: float, exponent: float) -> float:
    """Return ``base**exponent`` for a base >= 0, compiled only; within 1e-13 of its value.

    With ``base = 2**e m`` and m between the roots of 1/2 and 2, ``log m`` is the series of
    ``2 artanh((m - 1) / (m + 1))``; the power of two is the exponent of a float times a series of
    ``exp`` within ln 2 / 2 of 0. Powers below 2e-308 give that, so ``power(0, p)`` is nearly 0.

    Args:
        base: >= 0.
        exponent: >= 0, such that the power is below 1e308.
    """
    bits = _bits(base)
    e = (bits - _ROOT_HALF) >> 52
    m = _float(bits - (e << 52))
    s = (m - 1) / (m + 1)
    q = s * s
    t = 1 / 19 + q * (1 / 21)
    t = 1 / 13 + q * (1 / 15 + q * (1 / 17 + q * t))
    t = 1 / 3 + q * (1 / 5 + q * (1 / 7 + q * (1 / 9 + q * (1 / 11 + q * t))))
    y = max(exponent * (e + 2 * _LOG2_E * (s + s * q * t)), -1022.0)
    n = np.rint(y)
    f = (y - n) * _LN_2
    r = 1 / 479001600 + f * (1 / 6227020800)
    r = 1 / 362880 + f * (1 / 3628800 + f * (1 / 39916800 + f * r))
    r = 1 / 120 + f * (1 / 720 + f * (1 / 5040 + f * (1 / 40320 + f * r)))
    r = 1 + f * (1 + f * (1 / 2 + f * (1 / 6 + f * (1 / 24 + f * r))))
    result: float = r * _float((np.int64(n) + 1023) << 52)
    return result
