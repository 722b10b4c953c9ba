"""Drawings of Chapter 6: the gripper with its signals, and what its models are built on."""

from matplotlib.figure import Figure

from book.companion.claims import printed
from book.companion.exhibit import figure
from book.companion.finger_drawing import six_chambers
from book.companion.machine import (
    callout,
    canvas,
    device,
    gauge,
    gripper,
    hose,
    pointer,
    pump,
    words,
)
from book.companion.machine_drawings import approximation, bending, pump_with_symbols
from book.companion.style import BLUE, GREEN
from softgrip.provenance import Provenance
from softgrip.pump.parts import SYRINGES, Syringe
from softgrip.units import DEG, ML


@figure("6.1", Provenance.PRINTED, drawing=True)
def figure_6_1() -> Figure:
    """Draw the gripper on its pump, and the way of the signals."""
    drawn, axes = canvas((-58, 346), (-200, 92))
    volume, wide = printed("6.3-volume-of-the-syringe-in-ml") * ML, SYRINGES[1]
    driven = pump(axes, made=Syringe("", volume, wide.area))
    length = float(printed("6.3-length-of-a-finger-in-mm"))
    held = gripper(axes, 244 - 84j, (46 * DEG, 39 * DEG), length=length, gap=108)
    tee = 278 - 24j
    hose(axes, driven.nozzle, driven.nozzle + 44, tee + 84, tee)
    hose(axes, tee, tee - 24, held.inlet + 18j, held.inlet)
    gauge(axes, tee)
    words(axes, tee + 12 - 16j, "pressure", ha="left")

    driver, board, host = -18 - 34j, 60 - 96j, 60 - 164j
    device(axes, driver, "stepper\ndriver", 62 + 34j, "#E6E8EC")
    device(axes, board, "Arduino", 76 + 26j)
    device(axes, host, "Simulink", 76 + 26j, "#E6E8EC")
    pointer(axes, driver + 17j + 6, driver + 6 + 55j, 0 + 21j, colour=BLUE)
    pointer(axes, board - 38, -18 - 96j, driver - 17j, colour=BLUE)
    words(axes, -14 - 72j, "PWM", ha="left")
    pointer(axes, host - 12 + 13j, board - 12 - 13j, colour=BLUE)
    pointer(axes, board + 12 - 13j, host + 12 + 13j, colour=GREEN)
    pointer(axes, tee - 8, 70 - 24j, board + 10 + 13j, colour=GREEN)
    pointer(axes, 166 - 74j, 116 - 74j, 116 - 96j, 98 - 96j, colour=GREEN)
    words(axes, 140 - 66j, "angles")
    callout(axes, held.roots[0] + 6.5 - 38j, "flex\nsensors", 244 - 136j)
    callout(axes, held.roots[1] - 6 - 38j, "", 266 - 132j)
    for tip, side, name in zip(held.tips, (-1, 1), ("left", "right"), strict=True):
        words(axes, tip + side * 20 - 22j, name)
    return drawn


@figure("6.2", Provenance.PRINTED, drawing=True)
def figure_6_2() -> Figure:
    """Draw the beam, the angle, and the pump with its symbols."""
    drawn, axes = canvas((-16, 308), (-220, 52))
    approximation(axes, 0j)
    bending(axes, six_chambers(), 60 * DEG, 178 + 0j)
    pump_with_symbols(axes, 8 - 206j)
    for place, name in ((-8 + 44j, "(d)"), (174 + 44j, "(e)"), (-8 - 126j, "(f)")):
        words(axes, place, name)
    return drawn
