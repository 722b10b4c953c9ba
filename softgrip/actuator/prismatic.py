"""A hollow finger of constant section in linear elasticity: what is exact of it, in closed form."""

from softgrip.actuator.section import Section, torque


def prismatic_torque(section: Section, pressure: float, poisson_ratio: float) -> float:
    """Return the torque of a long finger of constant section, N m: exact in linear elasticity.

    It is ``(1 - 2 nu) T`` with T of Eq. (3.4): nothing, if the rubber keeps its volume. Held
    straight, the wall's axial stress is ``s_x = E e + nu (s_y + s_z)``. The section's equilibrium,
    by virtual work with the displacements ``(y, z)`` and ``((y**2 - z**2) / 2, y z)``, gives
    ``int (s_y + s_z) dA_w = 2 P A_c`` and ``int y (s_y + s_z) dA_w = 2 P int y dA_c``, whatever the
    shape of the section. So the stress around the chamber takes 2 nu of the push on its end, and
    of its moment; the models have it take nothing.

    Args:
        section: Its dimensions, m.
        pressure: P, Pa.
        poisson_ratio: nu.

    >>> design_1 = Section(0.020, 0.004, 0.030, 0.0015)
    >>> round(prismatic_torque(design_1, 0.25e6, 0.49), 4)
    0.0102
    """
    return float((1 - 2 * poisson_ratio) * torque(section, pressure))
