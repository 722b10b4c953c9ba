"""Bounds of a CasADi function over boxes: its instructions, done with intervals.

Interval arithmetic (R. E. Moore, 1966): from between what its arguments lie, each step says between
what its result lies, and so does the function. An argument that is used twice is taken to be two
that vary apart, so that the bounds are wide for a wide box; they close in as it shrinks. The steps
are rounded as others are, and not outwards: the bounds hold to about 1e-15 of their parts.
"""

from collections.abc import Callable
from typing import Any

import casadi as ca

from softgrip.errors import InvalidInputError

Ends = tuple[ca.SX, ca.SX]
"""Least and largest value; one object twice if it is a number that is known."""


def enclosed(function: ca.Function, within: int) -> ca.Function:
    """Return a function of the ends of a box that bounds another one.

    Args:
        function: Of symbols; it uses ``+ - * /``, squares, roots, powers, exp and log. Where it
            takes a power that is not whole, the bounds are those of what is above zero.
        within: Number of its first arguments that lie between ends; others are known.

    Returns:
        From the least and the largest of the first arguments, then the others, to the least and the
        largest of each output.

    Raises:
        InvalidInputError: If it does something else.

    >>> x = ca.SX.sym("x")
    >>> bounds = enclosed(ca.Function("f", [x], [x * x - x]), 1)
    >>> [float(end) for end in bounds(1, 2)]
    [-1.0, 3.0]
    """
    flat = function.expand()
    shapes = [flat.sparsity_in(k) for k in range(flat.n_in())]
    low = [ca.SX.sym(f"low_{k}", shape) for k, shape in enumerate(shapes[:within])]
    high = [ca.SX.sym(f"high_{k}", shape) for k, shape in enumerate(shapes[:within])]
    known = [ca.SX.sym(f"p_{k}", shape) for k, shape in enumerate(shapes[within:])]
    ends = [*zip(low, high, strict=True), *((one, one) for one in known)]
    held: dict[int, Ends] = {}
    found = [
        (ca.SX(flat.sparsity_out(k)), ca.SX(flat.sparsity_out(k))) for k in range(flat.n_out())
    ]
    for k in range(flat.n_instructions()):
        code, out = flat.instruction_id(k), flat.instruction_output(k)
        given = flat.instruction_input(k)
        if code == ca.OP_CONST:
            constant = ca.SX(flat.instruction_constant(k))
            held[out[0]] = constant, constant
        elif code == ca.OP_INPUT:
            first, last = (end.nz[given[1]] for end in ends[given[0]])
            held[out[0]] = (first, first) if given[0] >= within else (first, last)
        elif code == ca.OP_OUTPUT:
            for side, end in zip(found[out[0]], held[given[0]], strict=True):
                side.nz[out[1]] = end
        else:
            held[out[0]] = _step(code, *(held[place] for place in given))
    outputs = [end for pair in found for end in pair]
    return ca.Function("enclosed", [*low, *high, *known], outputs)


def _step(code: int, x: Ends, y: Ends | None = None) -> Ends:
    """Return the ends of what an instruction gives."""
    rising: dict[int, Any] = {ca.OP_EXP: ca.exp, ca.OP_SQRT: ca.sqrt, ca.OP_ASSIGN: ca.SX}
    if code in rising:
        return _each(rising[code], x)
    if code == ca.OP_LOG:
        return _logarithm(x)
    if code == ca.OP_TWICE:
        return _each(lambda end: 2 * end, x)
    if code == ca.OP_NEG:
        return _turned(x)
    if code == ca.OP_INV:
        return _inverse(x)
    if code == ca.OP_SQ:
        low, high = _product(x, x)
        return (low, low) if x[0] is x[1] else (ca.fmax(low, _least_square(x)), high)
    if y is not None:
        if code == ca.OP_ADD:
            return _both(x[0] + y[0], x[1] + y[1], x, y)
        if code == ca.OP_SUB:
            return _both(x[0] - y[1], x[1] - y[0], x, y)
        if code == ca.OP_MUL:
            return _product(x, y)
        if code == ca.OP_DIV:
            return _product(x, _inverse(y))
        if code in (ca.OP_POW, ca.OP_CONSTPOW):
            return _each(ca.exp, _product(y, _logarithm(x)))
    raise InvalidInputError("function", expected="sums, products, powers", got=f"CasADi's {code}")


def _each(rising: Callable[[ca.SX], ca.SX], x: Ends) -> Ends:
    low = rising(x[0])
    return (low, low) if x[0] is x[1] else (low, rising(x[1]))


def _logarithm(x: Ends) -> Ends:
    """Return log x; where x may be zero or less, it is bounded from above alone, or not at all."""
    low = ca.if_else(x[0] > 0, ca.log(x[0]), -ca.inf)
    return (low, low) if x[0] is x[1] else (low, ca.if_else(x[1] > 0, ca.log(x[1]), ca.inf))


def _both(low: ca.SX, high: ca.SX, x: Ends, y: Ends) -> Ends:
    return (low, low) if x[0] is x[1] and y[0] is y[1] else (low, high)


def _turned(x: Ends) -> Ends:
    low = -x[1]
    return (low, low) if x[0] is x[1] else (low, -x[0])


def _inverse(x: Ends) -> Ends:
    """Return 1/x; all numbers where x may be zero."""
    if x[0] is x[1]:
        return (1 / x[0],) * 2
    apart = x[0] * x[1] > 0
    return ca.if_else(apart, 1 / x[1], -ca.inf), ca.if_else(apart, 1 / x[0], ca.inf)


def _product(x: Ends, y: Ends) -> Ends:
    if x[0] is x[1] and y[0] is y[1]:
        return (x[0] * y[0],) * 2
    if y[0] is y[1]:
        x, y = y, x
    if x[0] is x[1]:
        one, other = x[0] * y[0], x[0] * y[1]
        return ca.fmin(one, other), ca.fmax(one, other)
    corners = [a * b for a in x for b in y]
    pairs = (corners[:2], corners[2:])
    return (
        ca.fmin(*(ca.fmin(*pair) for pair in pairs)),
        ca.fmax(*(ca.fmax(*pair) for pair in pairs)),
    )


def _least_square(x: Ends) -> ca.SX:
    """Return the least square, zero if x may be zero."""
    nearest = ca.fmin(ca.fabs(x[0]), ca.fabs(x[1]))
    return ca.if_else(x[0] * x[1] > 0, nearest**2, 0)
