"""How a contact force is shared among the elements of the simulated pad.

Each pyramid bears the square of the cover above its top, as a bed of springs: the cover and, in
series, the object, both as mattresses. Between the elements the cover is taken to bear nothing: as
a plate, a sheet of 1 mm that spans the 11 mm between two elements is ten times softer than they
are. So the elements are independent of each other, as Section 2.2 wants them, but for the object
that joins them.
"""

import numpy as np
from scipy.optimize.elementwise import find_root

from softgrip.arrays import Floats
from softgrip.errors import InvalidInputError
from softgrip.simulator.pad_parameters import PadParameters

SIDE = 5
"""Springs along each side of an element's square."""


def bed_points(pad: PadParameters) -> Floats:
    """Return where the springs of the bed stand, m, shape (elements, springs, 2)."""
    along = (np.arange(SIDE) - (SIDE - 1) / 2) * (2 * pad.spread / SIDE)
    square = np.stack(np.meshgrid(along, along), axis=-1).reshape(-1, 2)
    found: Floats = pad.layout.places[:, None] + square
    return found


def spring_stiffness(pad: PadParameters, softness: float) -> float:
    """Return the stiffness of one spring, N/m, with an object of a softness in m/Pa."""
    pressed = pad.cover / pad.young_modulus + softness
    if not pressed > 0:
        raise InvalidInputError("cover", expected="a thickness > 0, or a soft object", got=pressed)
    return (2 * pad.spread / SIDE) ** 2 / pressed


def force_at_depth(depth: Floats, gaps: Floats, stiffness: Floats, compliance: Floats) -> Floats:
    """Return the force on elements whose object has come down by a depth, N.

    With m springs touching, whose gaps sum up to S, springs and element in series give
    ``k (m d - S) / (1 + c k m)``. The true m is the one that gives the largest force, as the
    force over depth is convex, and each of these lines is one of its tangents.

    Args:
        depth: d, m, shape (...).
        gaps: Of the springs, m, in rising order, shape (..., springs).
        stiffness: k of a spring, N/m, shape (...).
        compliance: c of the element, m/N, shape (...).
    """
    m = np.arange(1, gaps.shape[-1] + 1)
    k, c = stiffness[..., None], compliance[..., None]
    lines = k * (m * depth[..., None] - np.cumsum(gaps, axis=-1)) / (1 + c * k * m)
    found: Floats = np.maximum(lines.max(axis=-1), 0.0)
    return found


def element_forces(gaps: Floats, stiffness: Floats, compliance: Floats, force: Floats) -> Floats:
    """Return how contact forces are shared among the elements.

    Args:
        gaps: Between object and springs, m, shape (N, elements, springs).
        stiffness: Of a spring in each contact, N/m, shape (N,).
        compliance: Of the elements, m/N, shape (elements,).
        force: Contact force, N, >= 0, shape (N,).

    Returns:
        Floats: N, shape (N, elements); the elements of a contact add up to its force.

    Raises:
        InvalidInputError: If an object meets no element, or a force is not >= 0.
    """
    ordered = np.sort(gaps, axis=-1)
    if not np.isfinite(ordered[..., 0].min(axis=-1)).all():
        raise InvalidInputError("gaps", expected="objects that meet an element", got="one beside")
    if not np.all(force >= 0):
        raise InvalidInputError("force", expected="N, >= 0", got=float(np.min(force)))

    shape = gaps.shape[:2]
    k, c = np.broadcast_to(stiffness[:, None], shape), np.broadcast_to(compliance, shape)

    def forces(depth: Floats, contact: Floats) -> Floats:
        # The solver asks for those contacts only that are still open: by number, as a float.
        chosen = contact.astype(np.int64)
        reached = np.broadcast_to(depth[:, None], k[chosen].shape)
        return force_at_depth(reached, ordered[chosen], k[chosen], c[chosen])

    def excess(depth: Floats, contact: Floats) -> Floats:
        over: Floats = forces(depth, contact).sum(axis=-1) - force[contact.astype(np.int64)]
        return over

    # One spring that had to bear all alone would come down further than all of them.
    low = ordered[..., 0].min(axis=-1)
    high = (ordered[..., 0] + force[:, None] * (1 / k + c)).min(axis=-1)
    contacts = np.arange(len(force), dtype=np.float64)
    solved = find_root(excess, (low, high + 1e-9), args=(contacts,))
    if not np.all(solved.success):
        raise InvalidInputError("force", expected="contacts that can be solved", got=force.tolist())
    return forces(solved.x, contacts)
