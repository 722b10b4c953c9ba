"""Left inverses of the gripper's plant, and what makes them proper: Theorem 2 of Section 6.3.

With one input, a left inverse is a row ``[w_1 / P_1, ..., w_n / P_n]`` whose weights sum to one:
each finger tells which input its angle asks for, and the weights say whom to believe. For a target
in the image of P all agree; they differ in what they make of targets and of errors outside it.
"""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass
from typing import TYPE_CHECKING, final

import numpy as np
from numpy.typing import ArrayLike

from softgrip.arrays import Floats, read_only
from softgrip.errors import InvalidInputError
from softgrip.gripper.plant import Gripper

if TYPE_CHECKING:
    import control


Complex = np.ndarray[tuple[int, ...], np.dtype[np.complex128]]


@final
@dataclass(frozen=True)
class LeftInverse:
    """A row that undoes P(s): a polynomial part and, where there is one, a strictly proper part.

    Attributes:
        polynomials: Coefficients of the powers 3, 2, 1, 0 of s, one row a finger, shape (fingers,
            4).
        remainder: State space with one input a finger and one output, D = 0; None if there is none.
    """

    polynomials: Floats
    remainder: control.StateSpace | None = None

    def __call__(self, s: ArrayLike) -> Complex:
        """Return the row at complex frequencies s of shape (N,) or (), shape (..., fingers)."""
        points = np.asarray(s, dtype=np.complex128)
        row = np.stack([np.polyval(p, points) for p in self.polynomials], axis=-1)
        if self.remainder is not None:
            flat = np.atleast_1d(points).ravel()
            extra = np.stack([np.asarray(self.remainder(z)).ravel() for z in flat])
            row = row + extra.reshape(row.shape)
        return np.asarray(row, dtype=np.complex128)

    @property
    def poles(self) -> Complex:
        """Finite poles, 1/s; none if the inverse is a polynomial."""
        found = [] if self.remainder is None else self.remainder.poles()
        return np.asarray(found, dtype=np.complex128)

    @property
    def stable(self) -> bool:
        """Whether all finite poles lie in the open left half plane."""
        return bool(np.all(self.poles.real < 0))


def mean_inverse(gripper: Gripper) -> LeftInverse:
    """Return the mean of the elements' inverses: the printed P-dagger, which solves Eq. (6.19).

    Section 6.4 prints it. It has no finite pole, so nothing in it can be unstable. It is a left
    inverse, but Theorem 2 names another one: see `moore_penrose_inverse`.

    >>> from softgrip.gripper.plant import PRINTED
    >>> row = mean_inverse(PRINTED).polynomials[0]
    >>> (row / row[0]).tolist(), round(1 / float(row[0]), 2)  # printed: 15.66
    ([1.0, 2.66, 3.61, 0.0], 15.66)
    """
    count = len(gripper.fingers)
    rows = [
        np.array([1.0, f.damping, f.stiffness, 0.0]) / (count * f.gain) for f in gripper.fingers
    ]
    return LeftInverse(read_only(rows))


def moore_penrose_inverse(gripper: Gripper, *, adjoint: bool = False) -> LeftInverse:
    """Return ``(P^T P)^-1 P^T`` over the rational functions, as Theorem 2 writes it.

    With unequal fingers its weights are ``P_i^2 / sum P_j^2``: rational, with 4 finite poles per
    finger beyond the first, which lie near those of the fingers.

    Args:
        gripper: Two or more fingers.
        adjoint: True for ``(P~ P)^-1 P~`` with ``P~(s) = P(-s)^T``, which is the orthogonal one in
            L2: at ``s = j omega`` its error is the least that any input can leave. Its poles lie
            mirrored about the imaginary axis, so no causal filter of it is stable.
    """
    # The pump's integrator cancels but for one s: what is left are the fingers' q = s^2 + a s + b.
    quadratics = [read_only([1.0, f.damping, f.stiffness]) for f in gripper.fingers]
    sign = -1.0 if adjoint else 1.0
    mirrored = [q * [1.0, sign, 1.0] for q in quadratics]
    gains = [f.gain for f in gripper.fingers]
    numerators: list[Floats] = []
    denominator: Floats = np.zeros(1)
    for k, gain in enumerate(gains):
        others = _product(p for j, q in enumerate(quadratics) if j != k for p in (q, mirrored[j]))
        denominator = read_only(np.polyadd(denominator, gain**2 * others))
        numerators.append(_product([np.array([gain, 0.0]), quadratics[k], others]))
    rows = [np.polydiv(numerator, denominator) for numerator in numerators]
    polynomials = read_only([quotient for quotient, _ in rows])
    remainder = _row_state_space([read_only(rest) for _, rest in rows], denominator)
    return LeftInverse(polynomials, remainder)


def filtered_inverse(inverse: LeftInverse, low_pass: control.StateSpace) -> control.StateSpace:
    """Return the filtered inverse ``H(s) P-dagger(s)``, Eq. (6.20), from angles [rad] to command.

    The powers of s act on the filter's input matrix, ``H s^k = C (s I - A)^-1 A^k B`` and, for
    k = 3, ``+ C A^2 B``: exact, and of the filter's order, where a product of transfer functions
    would keep what cancels.

    Args:
        inverse: The left inverse.
        low_pass: H(s): one input, one output, continuous, falling off as ``s^-3`` or faster.

    Raises:
        InvalidInputError: If the filter has another form or falls off too slowly: ``H P-dagger`` is
            then improper.
    """
    import control

    A, B, C = low_pass.A, low_pass.B, low_pass.C
    if low_pass.ninputs != 1 or low_pass.noutputs != 1 or low_pass.dt:
        raise InvalidInputError(
            "low_pass", expected="a continuous filter, one input, one output", got=low_pass
        )
    scale = np.abs(np.linalg.eigvals(A)).max() if len(A) else 1.0
    moments = [low_pass.D.item()] + [
        (C @ np.linalg.matrix_power(A / scale, k) @ B).item() for k in (0, 1)
    ]
    size = float(np.linalg.norm(C) * np.linalg.norm(B))
    if not np.allclose(moments, 0, atol=1e-9 * size):
        raise InvalidInputError(
            "low_pass", expected="a relative degree of 3 at least", got=f"moments {moments}"
        )
    columns = []
    for p in inverse.polynomials:
        column: Floats = np.zeros_like(B)
        for coefficient in p:
            column = A @ column + coefficient * B
        columns.append(column)
    inputs = np.hstack(columns)
    D = inverse.polynomials[:, 0] * (C @ A @ A @ B).item()
    if (rest := inverse.remainder) is None:
        return control.ss(A, inputs, C, D[None])
    return control.ss(
        np.block([[rest.A, np.zeros((len(rest.A), len(A)))], [B @ rest.C, A]]),
        np.vstack([rest.B, inputs]),
        np.hstack([np.zeros((1, len(rest.A))), C]),
        D[None],
    )


def _product(polynomials: Iterable[Floats]) -> Floats:
    found: Floats = np.ones(1)
    for p in polynomials:
        found = read_only(np.polymul(found, p))
    return found


def _row_state_space(numerators: list[Floats], denominator: Floats) -> control.StateSpace:
    """Return the strictly proper row ``numerators / denominator`` in observable form."""
    import control

    order = len(denominator) - 1
    A = np.eye(order, k=1)
    A[:, 0] = -denominator[1:] / denominator[0]
    B = np.stack([np.pad(n, (order - len(n), 0)) for n in numerators], axis=1) / denominator[0]
    return control.ss(A, B, np.eye(order)[:1], 0)
