"""A law of a page: the function of Python, and the same in JavaScript."""

import json
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import casadi as ca
import numpy as np
from numpy.typing import ArrayLike

from book.explore.javascript import javascript, number
from book.explore.scan import Scan, column, recording
from softgrip.arrays import Floats
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


@dataclass(frozen=True)
class Recorded:
    """What a law does, as it was seen with symbols.

    Attributes:
        known: The parameters, then what came out of each loop, shape (N, outputs).
        scans: The loops, in order.
        outputs: What the law returns, by name, from all that is known.
    """

    known: Sequence[ca.SX]
    scans: Sequence[Scan]
    outputs: Mapping[str, ca.SX]

    def __call__(self, values: ArrayLike) -> dict[str, Floats]:
        """Return what CasADi computes of it, from the parameters in their order."""
        known: list[Any] = [np.asarray(values, dtype=np.float64)]
        for scan in self.scans:
            state, given = scan.before(*known)
            run = scan.step.mapaccum("run", len(scan.rows))
            _, found = run(state, scan.rows.T, ca.repmat(given, 1, len(scan.rows)))
            known.append(found.T)
        last = ca.Function("law", list(self.known), [*self.outputs.values()])
        found = last.call(known)
        return {
            name: np.array(value).ravel() for name, value in zip(self.outputs, found, strict=True)
        }

    def javascript(self) -> str:
        """Return it as a JavaScript function, from a list of numbers to arrays by name."""
        ready = {name: self._ready(value) for name, value in self.outputs.items()}
        left = {name: value for name, value in self.outputs.items() if not ready[name]}
        last = ca.Function("law", list(self.known), [*left.values()])
        loops = ",".join(map(_loop, self.scans))
        sizes = json.dumps({name: value.numel() for name, value in left.items()})
        rest = ",".join(f"{json.dumps(name)}:{source}" for name, source in ready.items() if source)
        return (
            f"(()=>{{{_SCAN if loops else ''}const loops=[{loops}],last={javascript(last)},"
            f"sizes={sizes};return p=>{{const m=[p];for(const f of loops)m.push(f(m));const r={{}};"
            "for(const k in sizes)r[k]=new Float64Array(sizes[k]);last(m,Object.values(r));"
            f"return Object.assign(r,{{{rest}}});}};}})()"
        )

    def _ready(self, value: ca.SX) -> str:
        """Return what stands for numbers that are known, or came out of a loop as they are."""
        if value.is_constant():
            return f"[{','.join(map(number, np.array(ca.DM(value)).ravel().tolist()))}]"
        for k, known in enumerate(self.known[1:], 1):
            rows = known.shape[0]
            for j in range(known.shape[1]) if rows == value.numel() else ():
                if ca.is_equal(value, known[:, j], 0):
                    return f"m[{k}].subarray({j * rows},{(j + 1) * rows})"
        return ""


def recorded(law: Law, names: Sequence[str], **chosen: str) -> Recorded:
    """Record a law.

    Args:
        law: A pure function. It is called once, with symbols.
        names: Of its parameters that are numbers.
        **chosen: Its parameters that are words.

    Raises:
        InvalidInputError: If it returns what it was not given; what it raises itself passes, such
            as where it compares a symbol in an ``if``.

    >>> double = recorded(lambda x: {"y": [x, 2 * x]}, ["x"])
    >>> double([1.5])["y"].tolist()
    [1.5, 3.0]
    """
    symbols = ca.SX.sym("p", len(names))
    with recording(symbols) as recorder:
        found = law(**dict(zip(names, ca.vertsplit(symbols), strict=True)), **chosen)
    outputs = {name: column(value) for name, value in found.items()}
    free = ca.Function("law", recorder.known, [*outputs.values()], {"allow_free": True})
    if free.has_free():
        raise InvalidInputError("law", expected="what is given", got=f"{free.get_free()} free")
    return Recorded(recorder.known, recorder.scans, outputs)


def _loop(scan: Scan) -> str:
    rows = ",".join(f"[{','.join(map(number, row))}]" for row in scan.rows.tolist())
    sizes = scan.before.numel_out(0), scan.before.numel_out(1), scan.step.numel_out(1)
    before, step = javascript(scan.before), javascript(scan.step)
    return f"scan({before},{step},[{rows}],{','.join(map(str, sizes))})"
