"""What the slider of Chapter 2 on the contact force draws."""

import numpy as np
from matplotlib.figure import Figure

from book.chapter_2.figures_force import draw_points
from book.chapter_2.forces import weight_points
from book.companion.style import BLUE, still, style
from softgrip.tactile.nadaraya_watson import NadarayaWatson, left_out_error
from softgrip.units import GRAM_FORCE


def draw_bandwidth(bandwidth: float) -> Figure:
    """Draw the Nadaraya-Watson regressor on the simulated layer's 69 points.

    The title says its error on points, and on whole weights, that are left out.

    Parameters
    ----------
    bandwidth
        sigma of Eq. (2.7), V, > 0.
    """
    voltage, force = weight_points()
    model = NadarayaWatson(bandwidth).fit(voltage[:, None], force)
    grid = np.linspace(-0.5, 4.5, 1001)
    points, weights = (
        left_out_error(voltage[:, None], force, bandwidth, groups=groups) / GRAM_FORCE
        for groups in (None, force)
    )
    with style():
        drawn, axes = still(3.2)
        draw_points(axes)
        axes.plot(grid, model.predict(grid[:, None]) / GRAM_FORCE, color=BLUE, label="regressor")
        axes.set(
            xlabel="voltage (V)",
            ylabel="force (gf)",
            ylim=(-5, 80),
            title=f"left out: points {points:.1f} gf, weights {weights:.1f} gf",
        )
        axes.legend(loc="upper left")
    return drawn
