"""A CasADi function as JavaScript: a straight list of instructions stays one.

The page then runs the very law that the package tests. Where only ``+ - * /`` and the square root
are used, each step is rounded as in Python, and so the result has the same bits.
"""

import casadi as ca

from softgrip.errors import InvalidInputError

SAME = {
    ca.OP_ASSIGN: "{0}", ca.OP_ADD: "{0}+{1}", ca.OP_SUB: "{0}-{1}", ca.OP_MUL: "{0}*{1}",
    ca.OP_DIV: "{0}/{1}", ca.OP_NEG: "-{0}", ca.OP_SQ: "{0}*{0}", ca.OP_TWICE: "2*{0}",
    ca.OP_INV: "1/{0}", ca.OP_POW: "Math.pow({0},{1})", ca.OP_CONSTPOW: "Math.pow({0},{1})",
    ca.OP_SQRT: "Math.sqrt({0})", ca.OP_EXP: "Math.exp({0})", ca.OP_LOG: "Math.log({0})",
    ca.OP_EXPM1: "Math.expm1({0})", ca.OP_LOG1P: "Math.log1p({0})",
    ca.OP_SIN: "Math.sin({0})", ca.OP_COS: "Math.cos({0})", ca.OP_TAN: "Math.tan({0})",
    ca.OP_ASIN: "Math.asin({0})", ca.OP_ACOS: "Math.acos({0})", ca.OP_ATAN: "Math.atan({0})",
    ca.OP_ATAN2: "Math.atan2({0},{1})", ca.OP_HYPOT: "Math.hypot({0},{1})",
    ca.OP_SINH: "Math.sinh({0})", ca.OP_COSH: "Math.cosh({0})", ca.OP_TANH: "Math.tanh({0})",
    ca.OP_ASINH: "Math.asinh({0})", ca.OP_ACOSH: "Math.acosh({0})", ca.OP_ATANH: "Math.atanh({0})",
    ca.OP_FABS: "Math.abs({0})", ca.OP_SIGN: "Math.sign({0})",
    ca.OP_FLOOR: "Math.floor({0})", ca.OP_CEIL: "Math.ceil({0})",
    # As C's fmin and fmax, these take the other number where one is NaN; JavaScript's do not.
    ca.OP_FMIN: "({0}<={1}||{1}!=={1}?{0}:{1})", ca.OP_FMAX: "({0}>={1}||{1}!=={1}?{0}:{1})",
    ca.OP_LT: "+({0}<{1})", ca.OP_LE: "+({0}<={1})", ca.OP_EQ: "+({0}==={1})",
    ca.OP_NE: "+({0}!=={1})", ca.OP_NOT: "+!{0}", ca.OP_AND: "+({0}&&{1}?1:0)",
    ca.OP_OR: "+({0}||{1}?1:0)", ca.OP_IF_ELSE_ZERO: "({0}?{1}:0)",
}  # fmt: skip
"""JavaScript for an instruction, with the places of its arguments."""


def number(value: float) -> str:
    """Return a number as JavaScript writes it, to the bit.

    >>> number(0.1), number(float("inf"))
    ('0.1', 'Infinity')
    """
    if value != value:
        return "NaN"
    if abs(value) == float("inf"):
        return "Infinity" if value > 0 else "-Infinity"
    return repr(int(value)) if value == int(value) and abs(value) < 1e15 else repr(value)


TWICE = {ca.OP_FMIN, ca.OP_FMAX, ca.OP_SQ}
"""Instructions that name an argument more than once."""
MOST = 400
"""Characters of a nested expression: beyond them a value is kept by itself."""


def javascript(function: ca.Function) -> str:
    """Return a JavaScript function ``(arguments, results) => void``, both lists of arrays.

    What is used once stands where it is used; all else is kept in an array, as CasADi keeps it.

    Args:
        function: Of symbols; its outputs dense.

    Raises:
        InvalidInputError: If an instruction is not in `SAME`.

    >>> x = ca.SX.sym("x")
    >>> javascript(ca.Function("f", [x], [2 * x + 1]))
    '(()=>{const w=new Float64Array(2);return(a,r)=>{w[0]=((2*a[0][0])+1);r[0][0]=w[0];}})()'
    """
    flat = function.expand()
    steps = [
        (flat.instruction_id(k), flat.instruction_output(k), flat.instruction_input(k))
        for k in range(flat.n_instructions())
    ]
    uses = _uses(steps)
    held: dict[int, str] = {}
    lines = []
    for k, (code, out, given) in enumerate(steps):
        if code == ca.OP_CONST:
            made, atom = number(flat.instruction_constant(k)), True
            made = f"({made})" if made.startswith("-") else made
        elif code == ca.OP_INPUT:
            made, atom = f"a[{given[0]}][{given[1]}]", True
        elif code == ca.OP_OUTPUT:
            lines.append(f"r[{out[0]}][{out[1]}]={held[given[0]]}")
            continue
        elif code in SAME:
            made, atom = f"({SAME[code].format(*(held[i] for i in given))})", False
        else:
            raise InvalidInputError("law", expected="operations of numbers", got=f"CasADi's {code}")
        times, doubled = uses[k]
        if atom or (times == 1 and not doubled and len(made) < MOST):
            held[out[0]] = made
        else:
            lines.append(f"w[{out[0]}]={made}")
            held[out[0]] = f"w[{out[0]}]"
    body = "".join(f"{line};" for line in lines)
    return f"(()=>{{const w=new Float64Array({flat.sz_w()});return(a,r)=>{{{body}}}}})()"


Steps = list[tuple[int, list[int], list[int]]]


def _uses(steps: Steps) -> list[tuple[int, bool]]:
    """Return how often the result of each step is used, and whether by one that names it twice.

    A nested expression is read where it is used, perhaps after a place that it reads was written
    anew: such a result counts as used twice.
    """
    born: dict[int, int] = {}
    count, doubled = [0] * len(steps), [False] * len(steps)
    reads: list[set[tuple[int, int]]] = [set() for _ in steps]
    for k, (code, out, given) in enumerate(steps):
        if code not in (ca.OP_CONST, ca.OP_INPUT):
            for place in given:
                made = born[place]
                count[made] += 1
                doubled[made] |= code in TWICE
                # What it reads, directly or through what may be nested in it. A number or an
                # argument is no place that could be written anew.
                reads[k] |= reads[made]
                if steps[made][0] not in (ca.OP_CONST, ca.OP_INPUT):
                    reads[k].add((place, made))
                if any(born[p] != m for p, m in reads[made]):
                    doubled[made] = True
        if code != ca.OP_OUTPUT:
            born[out[0]] = k
    return list(zip(count, doubled, strict=True))
