"""Bounds of a CasADi function over boxes: its instructions, done with intervals.

Interval arithmetic (R. E. Moore, 1966): from between what its arguments lie, each step says between
what its result lies, and so does the function. An argument that is used twice is taken to be two
that vary apart, so that the bounds are wide for a wide box; they close in as it shrinks. The steps
are rounded as others are, and not outwards: the bounds hold to about 1e-15 of their parts.
"""

from collections.abc import Callable
from dataclasses import dataclass

import casadi as ca

from softgrip.errors import InvalidInputError


@dataclass(frozen=True)
class Ends:
    """Least and largest value; one object twice if it is a number that is known.

    Attributes:
        low, high: The ends.
        positive: Whether both are known to be above zero.
    """

    low: ca.SX
    high: ca.SX
    positive: bool = False

    @property
    def known(self) -> bool:
        """Whether it is one number."""
        return self.low is self.high


def enclosed(function: ca.Function, within: int, *, positive: int = 0) -> ca.Function:
    """Return a function of the ends of a box that bounds another one.

    Args:
        function: Of symbols; it uses ``+ - * /``, squares, roots, powers, exp and log. Where it
            takes a power that is not whole, the bounds are those of what is above zero.
        within: Number of its first arguments that lie between ends; others are known.
        positive: Number of its first arguments that are above zero: products of such numbers take
            a fifth of the steps.

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
    held: dict[int, Ends] = {}
    found = [
        (ca.SX(flat.sparsity_out(k)), ca.SX(flat.sparsity_out(k))) for k in range(flat.n_out())
    ]
    for k in range(flat.n_instructions()):
        code, out = flat.instruction_id(k), flat.instruction_output(k)
        given = flat.instruction_input(k)
        if code == ca.OP_CONST:
            constant = ca.SX(flat.instruction_constant(k))
            held[out[0]] = Ends(constant, constant, flat.instruction_constant(k) > 0)
        elif code == ca.OP_INPUT and given[0] < within:
            first, last = (ends[given[0]].nz[given[1]] for ends in (low, high))
            held[out[0]] = Ends(first, last, given[0] < positive)
        elif code == ca.OP_INPUT:
            number = known[given[0] - within].nz[given[1]]
            held[out[0]] = Ends(number, number, given[0] < positive)
        elif code == ca.OP_OUTPUT:
            end = held[given[0]]
            found[out[0]][0].nz[out[1]], found[out[0]][1].nz[out[1]] = end.low, end.high
        else:
            held[out[0]] = _step(code, *(held[place] for place in given))
    outputs = [end for pair in found for end in pair]
    return ca.Function("enclosed", [*low, *high, *known], outputs)


def _step(code: int, x: Ends, y: Ends | None = None) -> Ends:
    """Return the ends of what an instruction gives."""
    if code == ca.OP_ASSIGN:
        return x
    if code == ca.OP_EXP:
        return _each(ca.exp, x, positive=True)
    if code == ca.OP_SQRT:
        return _each(ca.sqrt, x, positive=x.positive)
    if code == ca.OP_LOG:
        return _logarithm(x)
    if code == ca.OP_TWICE:
        return _each(lambda end: 2 * end, x, positive=x.positive)
    if code == ca.OP_NEG:
        low = -x.high
        return Ends(low, low if x.known else -x.low)
    if code == ca.OP_INV:
        return _inverse(x)
    if code == ca.OP_SQ:
        return _square(x)
    if y is not None:
        if code == ca.OP_ADD:
            low = x.low + y.low
            high = low if x.known and y.known else x.high + y.high
            return Ends(low, high, x.positive and y.positive)
        if code == ca.OP_SUB:
            low = x.low - y.high
            return Ends(low, low if x.known and y.known else x.high - y.low)
        if code == ca.OP_MUL:
            return _product(x, y)
        if code == ca.OP_DIV:
            return _product(x, _inverse(y))
        if code in (ca.OP_POW, ca.OP_CONSTPOW):
            return _each(ca.exp, _product(y, _logarithm(x)), positive=True)
    raise InvalidInputError("function", expected="sums, products, powers", got=f"CasADi's {code}")


def _each(rising: Callable[[ca.SX], ca.SX], x: Ends, *, positive: bool) -> Ends:
    low = rising(x.low)
    return Ends(low, low if x.known else rising(x.high), positive)


def _logarithm(x: Ends) -> Ends:
    """Return log x; where x may be zero or less, it is bounded from above alone, or not at all."""
    if x.positive:
        return _each(ca.log, x, positive=False)
    low = ca.if_else(x.low > 0, ca.log(x.low), -ca.inf)
    return Ends(low, low if x.known else ca.if_else(x.high > 0, ca.log(x.high), ca.inf))


def _inverse(x: Ends) -> Ends:
    """Return 1/x; all numbers where x may be zero."""
    if x.known or x.positive:
        low = 1 / x.high
        return Ends(low, low if x.known else 1 / x.low, x.positive)
    apart = x.low * x.high > 0
    return Ends(ca.if_else(apart, 1 / x.high, -ca.inf), ca.if_else(apart, 1 / x.low, ca.inf))


def _square(x: Ends) -> Ends:
    if x.known or x.positive:
        return _each(lambda end: end**2, x, positive=x.positive)
    first, last = x.low**2, x.high**2
    nothing = ca.if_else(x.low * x.high > 0, ca.fmin(first, last), 0)
    return Ends(nothing, ca.fmax(first, last))


def _product(x: Ends, y: Ends) -> Ends:
    if x.positive and y.positive:
        low = x.low * y.low
        return Ends(low, low if x.known and y.known else x.high * y.high, positive=True)
    if x.known and y.known:
        low = x.low * y.low
        return Ends(low, low)
    if x.positive:
        x, y = y, x
    if y.positive or x.known or y.known:
        if x.known and not y.positive:
            x, y = y, x
        # One of them has one sign: two corners at each end.
        if y.positive:
            return Ends(
                ca.fmin(x.low * y.low, x.low * y.high), ca.fmax(x.high * y.low, x.high * y.high)
            )
        one, other = x.low * y.low, x.high * y.low
        return Ends(ca.fmin(one, other), ca.fmax(one, other))
    corners = [a * b for a in (x.low, x.high) for b in (y.low, y.high)]
    pairs = (corners[:2], corners[2:])
    return Ends(
        ca.fmin(*(ca.fmin(*pair) for pair in pairs)),
        ca.fmax(*(ca.fmax(*pair) for pair in pairs)),
    )
