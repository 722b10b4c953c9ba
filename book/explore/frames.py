"""Figures as small pictures, and how many of them a page may carry."""

import io
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import matplotlib.pyplot as plt
import numpy as np
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.figure import Figure
from PIL import Image

from softgrip.errors import InvalidInputError

DPI = 120
COARSE = [max(255 - 8 * round((255 - level) / 8), 0) for level in range(256)]
"""32 levels a channel, white kept: a smooth edge needs no more, and the file shrinks by a third."""
MAX_FRAMES = 125
"""Frames of one explorer: all are drawn while the book is built."""
MAX_PAGE = 3_000_000
"""Characters of base64 that the frames of one page may take: all are loaded with it."""


@dataclass(frozen=True)
class Frame:
    """A figure as WebP, its size in pixels, and what its titles say."""

    webp: bytes
    width: int
    height: int
    told: str = ""

    @property
    def size(self) -> int:
        """Characters of base64 that the frame takes in a page."""
        return 4 * -(-len(self.webp) // 3)


def _encode(figure: Figure, *, small: bool) -> Frame:
    # Not savefig: its result depends on settings of the notebook, such as a tight bounding box.
    figure.set_dpi(DPI)
    canvas: Any = FigureCanvasAgg(figure)  # has no types
    canvas.draw()
    picture = Image.fromarray(np.asarray(canvas.buffer_rgba())).convert("RGB")
    file = io.BytesIO()
    effort: dict[str, Any] = {"method": 2, "quality": 50} if small else {"method": 0, "quality": 0}
    picture.point(COARSE * 3).save(file, format="webp", lossless=True, **effort)
    titles = [*(axes.get_title() for axes in figure.axes), *(t.get_text() for t in figure.texts)]
    told = "; ".join(" ".join(title.split()) for title in titles if title)
    return Frame(file.getvalue(), *picture.size, told)


def render(
    draw: Callable[..., Figure], parameters: Mapping[str, Any], *, small: bool = True
) -> Frame:
    """Draw one frame, and leave no pyplot figure open that was not open before.

    Args:
        draw: Returns a matplotlib Figure.
        parameters: What it is called with.
        small: Whether to take three times as long to encode it, for a file of a third.

    Raises:
        InvalidInputError: If it returns something else. What it raises itself passes, with the
            parameters noted.
    """
    before = set(plt.get_fignums())
    try:
        figure = draw(**parameters)
        if not isinstance(figure, Figure):
            raise InvalidInputError("draw", expected="a function that returns a Figure", got=figure)
        return _encode(figure, small=small)
    except Exception as error:
        error.add_note(f"while drawing with {dict(parameters)}")
        raise
    finally:
        for number in set(plt.get_fignums()) - before:
            plt.close(number)


def check_count(count: int) -> None:
    """Raise `InvalidInputError` if an explorer has more frames than one may have."""
    if count > MAX_FRAMES:
        expected = f"at most {MAX_FRAMES} combinations of values (give the sliders fewer steps)"
        raise InvalidInputError("number of frames", expected=expected, got=count)


class Budget:
    """What the frames of a page take together: a page has a process of its own."""

    def __init__(self, limit: int = MAX_PAGE) -> None:
        self.limit = limit
        self.spent = 0

    def spend(self, frames: Sequence[Frame]) -> None:
        """Count the frames of one explorer in.

        Raises:
            InvalidInputError: If the page's frames are now larger than the limit; these are then
                not counted.
        """
        asked = sum(frame.size for frame in frames)
        total = self.spent + asked
        if total > self.limit:
            expected = (
                f"at most {self.limit / 1e6:.2f} MB in base64 (take fewer steps or a smaller "
                f"figure; these {len(frames)} frames take {asked / 1e6:.2f} MB)"
            )
            got = f"{total / 1e6:.2f} MB"
            raise InvalidInputError("the frames of this page", expected=expected, got=got)
        self.spent = total


PAGE = Budget()
