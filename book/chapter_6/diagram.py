"""Block diagram of Chapter 6."""

from matplotlib.figure import Figure

from book.companion.block_diagram import arrow, block, finish, sum_point, words
from book.companion.exhibit import figure
from book.companion.style import BLUE, GREY, VERMILION, sheet
from softgrip.provenance import Provenance


@figure("6.3", Provenance.PRINTED, drawing=True)
def figure_6_3() -> Figure:
    """Draw the scheme of feedforward and feedback."""
    drawn, axes = sheet(2.5)
    arrow(axes, (0.0, 2.0), (0.75, 2.0), colour=BLUE)
    block(axes, 1.4, 2.0, "$H P^\\dagger$", BLUE, width=1.3, height=0.6)
    arrow(axes, (2.05, 2.0), (2.86, 2.0), colour=BLUE)
    sum_point(axes, 3.0, 2.0)
    arrow(axes, (3.14, 2.0), (4.65, 2.0))
    block(axes, 5.3, 2.0, "fingers", GREY, width=1.3, height=0.6)
    arrow(axes, (5.95, 2.0), (8.0, 2.0))
    arrow(axes, (3.9, 2.0), (3.9, 1.0), (4.65, 1.0))
    block(axes, 5.3, 1.0, "$P(s)$", GREY, width=1.3, height=0.6)
    arrow(axes, (5.95, 1.0), (6.86, 1.0))
    sum_point(axes, 7.0, 1.0)
    arrow(axes, (7.0, 2.0), (7.0, 1.14))
    arrow(axes, (7.0, 0.86), (7.0, 0.0), (5.95, 0.0), colour=VERMILION)
    block(axes, 5.3, 0.0, "$H P^\\dagger$", VERMILION, width=1.3, height=0.6)
    arrow(axes, (4.65, 0.0), (3.0, 0.0), (3.0, 1.86), colour=VERMILION)
    words(axes, (
        (0.3, 2.2, "$Y_d$"), (2.45, 2.2, "$u_{ff}$"), (3.5, 2.2, "$u_c$"),
        (7.6, 2.2, "$\\tilde y$"), (6.4, 1.2, "$y$"), (7.3, 0.4, "$y_\\Delta$"),
        (3.3, 0.2, "$u_{fb}$"), (2.8, 1.7, "$-$"), (6.72, 0.72, "$-$"), (7.2, 1.28, "+"),
    ))  # fmt: skip
    finish(axes, (-0.1, 8.1), (-0.4, 2.5))
    return drawn
