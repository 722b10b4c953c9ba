"""Drawings of Chapter 4: the rig, the pump with its symbols, and the loop around both."""

from matplotlib.figure import Figure

from book.companion.block_diagram import arrow, block, finish, sum_point
from book.companion.block_diagram import words as signals
from book.companion.exhibit import figure
from book.companion.machine import callout, canvas, dimension, hose, words
from book.companion.machine_drawings import on_its_pump, pump_with_symbols
from book.companion.style import BLUE, GREEN, GREY, VERMILION, sheet
from softgrip.provenance import Provenance
from softgrip.units import DEG


@figure("4.1", Provenance.PRINTED, drawing=True)
def figure_4_1() -> Figure:
    """Draw the pump, the finger and the sensors, with a scale bar."""
    drawn, axes = canvas((-12, 316), (-150, 92))
    _, root, _ = on_its_pump(axes, 70 * DEG)
    callout(axes, root + 24 - 5j, "flex sensor", root + 16 - 48j)
    callout(axes, root + 34 + 10j, "soft actuator", root + 112 - 8j)
    dimension(axes, 250 - 134j, 300 - 134j, "50 mm", aside=-1)
    return drawn


@figure("4.2", Provenance.PRINTED, drawing=True)
def figure_4_2() -> Figure:
    """Draw the pump with the parameters of its equation."""
    drawn, axes = canvas((-10, 330), (-26, 96))
    ports = pump_with_symbols(axes, 0j)
    end = 308 + 14j
    hose(axes, ports.nozzle, ports.nozzle + 30, end + 34j, end)
    words(axes, end - 8j, "$P$, $C_i$", fontsize=11)
    words(axes, end - 22j, "finger")
    words(axes, 21 - 8j, "motor")
    words(axes, 140 - 8j, "linear actuator: screw and slider")
    words(axes, ports.nozzle - 60 + 30j, "syringe")
    return drawn


@figure("4.6", Provenance.PRINTED, drawing=True)
def figure_4_6() -> Figure:
    """Draw the loop with the filter."""
    drawn, axes = sheet(2.3)
    arrow(axes, (-0.3, 2), (0.66, 2), colour=BLUE)
    sum_point(axes, 0.8, 2)
    arrow(axes, (0.94, 2), (1.4, 2))
    block(axes, 1.95, 2, "PID", BLUE, width=1.1)
    arrow(axes, (2.5, 2), (3.1, 2))
    block(axes, 4.0, 2, "motor,\nsyringe", GREY, width=1.8, height=0.9)
    arrow(axes, (4.9, 2), (5.5, 2))
    block(axes, 6.3, 2, "finger", GREY, width=1.6)
    arrow(axes, (7.1, 2), (8.3, 2))
    arrow(axes, (7.6, 2), (7.6, 0.4), (7.05, 0.4), colour=GREEN)
    block(axes, 6.15, 0.4, "flex sensor", GREEN, width=1.8)
    arrow(axes, (5.25, 0.4), (0.8, 0.4), (0.8, 1.86), colour=GREEN)
    arrow(axes, (4.6, 0.4), (4.6, 0.85), colour=GREEN)
    block(axes, 4.0, 1.1, "Kalman filter", VERMILION, width=2.2, height=0.5)
    arrow(axes, (2.9, 1.1), (1.95, 1.1), (1.95, 1.65), colour=VERMILION)
    signals(axes, (
        (0.0, 2.25, "$\\theta_d$"), (2.8, 2.25, "$\\omega_m$"), (5.2, 2.25, "$P$"),
        (8.0, 2.25, "$\\theta$"), (2.4, 1.35, "$\\hat C_i$"), (0.55, 1.68, "$-$"),
    ))  # fmt: skip
    finish(axes, (-0.4, 8.4), (-0.1, 2.6))
    return drawn
