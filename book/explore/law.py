"""A law of a page: the function of Python, and the same in JavaScript."""

import json
from collections.abc import Callable, Mapping, Sequence
from typing import Any

import casadi as ca
import numpy as np

from book.explore.javascript import javascript, number
from book.explore.scan import Recorder, Scan, column, recording
from softgrip.errors import InvalidInputError

Law = Callable[..., Mapping[str, Any]]
"""From one keyword a slider to curves and numbers by name; on floats and on symbols alike."""

# What the loops of a page have in common: both states change places, so that none is read after
# it was written.
_SCAN = (
    "const scan=(before,step,rows,s,g,o)=>m=>{const n=rows.length,r=new Float64Array(n*o),"
    "q=new Float64Array(g),u=new Float64Array(o);let x=new Float64Array(s),y=new Float64Array(s);"
    "before(m,[x,q]);for(let k=0;k<n;k++){step([x,rows[k],q],[y,u]);[x,y]=[y,x];"
    "for(let j=0;j<o;j++)r[j*n+k]=u[j];}return r;};"
)


def _loop(scan: Scan) -> str:
    rows = ",".join(f"[{','.join(map(number, row))}]" for row in scan.rows.tolist())
    sizes = scan.before.numel_out(0), scan.before.numel_out(1), scan.step.numel_out(1)
    before, step = javascript(scan.before), javascript(scan.step)
    return f"scan({before},{step},[{rows}],{','.join(map(str, sizes))})"


def translated(law: Law, names: Sequence[str], **chosen: str) -> str:
    """Return a law as a JavaScript function, from a list of numbers to arrays by name.

    Args:
        law: A pure function. It is called once, with symbols.
        names: Of its parameters that are numbers, in the order of the list.
        **chosen: Its parameters that are words.

    Raises:
        InvalidInputError: If it does with a symbol what only a number can do, such as to compare
            it in an ``if``; what it raises itself passes.
    """
    symbols = ca.SX.sym("p", len(names))
    with recording(symbols) as recorder:
        found = law(**dict(zip(names, ca.vertsplit(symbols), strict=True)), **chosen)
    outputs = {name: column(value) for name, value in found.items()}
    ready = {name: _ready(value, recorder) for name, value in outputs.items()}
    left = {name: value for name, value in outputs.items() if not ready[name]}
    last = ca.Function("law", recorder.known, [*left.values()])
    if last.has_free():
        raise InvalidInputError("law", expected="what is given", got=f"{last.get_free()} free")
    loops = ",".join(map(_loop, recorder.scans))
    sizes = json.dumps({name: value.numel() for name, value in left.items()})
    rest = ",".join(f"{json.dumps(name)}:{source}" for name, source in ready.items() if source)
    return (
        f"(()=>{{{_SCAN if loops else ''}const loops=[{loops}],last={javascript(last)},"
        f"sizes={sizes};return p=>{{const m=[p];for(const f of loops)m.push(f(m));const r={{}};"
        "for(const k in sizes)r[k]=new Float64Array(sizes[k]);last(m,Object.values(r));"
        f"return Object.assign(r,{{{rest}}});}};}})()"
    )


def _ready(value: ca.SX, recorder: Recorder) -> str:
    """Return what stands in JavaScript for numbers that are known, or came out of a loop as is."""
    if value.is_constant():
        return f"[{','.join(number(x) for x in np.array(ca.DM(value)).ravel().tolist())}]"
    for k, known in enumerate(recorder.known[1:], 1):
        rows = known.shape[0]
        for j in range(known.shape[1]) if rows == value.numel() else ():
            if ca.is_equal(value, known[:, j], 0):
                return f"m[{k}].subarray({j * rows},{(j + 1) * rows})"
    return ""
