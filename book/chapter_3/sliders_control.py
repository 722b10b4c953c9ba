"""What the sliders of Chapter 3 on control draw."""

from functools import lru_cache

from matplotlib.figure import Figure

from book.chapter_3.regulators import designed_on
from book.chapter_4.identified_model import IdentifiedModel, identified_model
from book.companion.style import GREY, LINEAR, PRINTED, still, style
from softgrip.control.limited_lqr import limited_loop
from softgrip.control.loop import SPEED_LIMIT
from softgrip.control.lqr import Weights, lqr_gain
from softgrip.control.step_metrics import settling_time
from softgrip.units import DEG

DURATION = 4.0


@lru_cache(maxsize=1)
def _model() -> IdentifiedModel:
    # To identify it takes as long as all else that a frame may take.
    return identified_model()


def draw_lqr(p: float, q2: float, step: float) -> Figure:
    """Draw a step of the regulator on the printed model, with the motor's limit.

    Parameters
    ----------
    p, q2
        Of Eq. (3.29); q_1 = 1, q_3 = 0 and R = 1.
    step
        deg.
    """
    model = _model()
    finger, _ = designed_on("printed", model)
    gain = lqr_gain(finger, Weights(p=p, q=(1.0, q2, 0.0)))
    found = limited_loop(finger, model.pump_gain, gain, step * DEG, duration=DURATION)
    settled = float(settling_time(found.time, found.measured, final=step * DEG, band=0.05))
    share = found.command / SPEED_LIMIT
    with style():
        drawn, axes = still(3.0)
        axes.axhspan(0.95, 1.05, color=PRINTED, alpha=0.2, lw=0)
        axes.plot(found.time, found.measured / (step * DEG), color=LINEAR, label="angle / step")
        axes.step(found.time, share, color=GREY, ls="--", lw=1, where="post", label="command u")
        axes.axvline(0.8, color=PRINTED, ls=":", lw=1)
        within = settled < DURATION
        words = f"within 5 % after {settled:.2f} s" if within else "not within 5 % in 4 s"
        axes.set(xlabel="time (s)", ylabel="share", xlim=(0, DURATION), ylim=(-1.1, 1.4))
        axes.set_title(words)
        axes.legend(loc="lower right")
    return drawn
