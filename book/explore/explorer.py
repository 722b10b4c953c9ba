"""A figure with sliders: computed by the page, chosen among frames, or redrawn by a kernel."""

import hashlib
import inspect
import os
from base64 import b64encode
from collections.abc import Callable, Mapping, Sequence
from itertools import product
from pathlib import Path
from typing import Any, Literal

from book.explore.frames import PAGE, Frame, check_count, render
from book.explore.law import recorded
from book.explore.page import Explorer
from book.explore.plot import Plot
from book.explore.sliders import Range, Slider, Value
from softgrip.errors import InvalidInputError

Mode = Literal["live", "static"]
MODE_VARIABLE = "SOFTGRIP_BOOK"
FRAMES_VARIABLE = "SOFTGRIP_FRAMES"
"""Folder of the frames that are drawn ahead for the pages."""
MOST = 4
"""Sliders of one figure."""


def _sliders(given: Mapping[str, Slider | Range | Sequence[Value]]) -> dict[str, Slider | Range]:
    if not 1 <= len(given) <= MOST:
        raise InvalidInputError("explore", expected=f"one to {MOST} sliders", got=list(given))
    return {
        name: item if isinstance(item, Slider | Range) else Slider(item, label=name)
        for name, item in given.items()
    }


def _check_takes(function: Callable[..., Any], names: Sequence[str]) -> None:
    signature = inspect.signature(function)
    try:
        signature.bind(**dict.fromkeys(names))
    except TypeError as error:
        expected = f"sliders that fit {function.__name__}{signature}: {error}"
        raise InvalidInputError("explore", expected=expected, got=list(names)) from None


def _mode(asked: Mode | None) -> Mode:
    if asked not in (None, "live", "static"):
        raise InvalidInputError("mode", expected="'live', 'static' or None", got=asked)
    return asked or ("static" if os.environ.get(MODE_VARIABLE) == "static" else "live")


def _laws(law: Callable[..., Any], sliders: Mapping[str, Slider | Range]) -> dict[str, str]:
    """Return the law in JavaScript for each choice among words, which are joined by a stroke."""
    words = {n: s.values for n, s in sliders.items() if isinstance(s, Slider) and s.words}
    numbers = [name for name in sliders if name not in words]
    return {
        "|".join(map(str, chosen)): recorded(
            law, numbers, **dict(zip(words, map(str, chosen), strict=True))
        ).javascript()
        for chosen in product(*words.values())
    }


def _frames(draw: Callable[..., Any], sliders: Mapping[str, Slider | Range]) -> list[Frame]:
    values = [slider.values for slider in sliders.values() if isinstance(slider, Slider)]
    if len(values) < len(sliders):
        raise InvalidInputError("explore", expected="a Plot, or sliders of values", got=[*sliders])
    combinations = list(product(*values))
    check_count(len(combinations))
    frames = [render(draw, dict(zip(sliders, chosen, strict=True))) for chosen in combinations]
    PAGE.spend(frames)
    return frames


def _address(frame: Frame) -> str:
    """Return where a page finds a frame: in a file beside it, or, without a folder, in itself."""
    if folder := os.environ.get(FRAMES_VARIABLE):
        file = Path(folder) / f"{hashlib.sha256(frame.webp).hexdigest()[:20]}.webp"
        file.write_bytes(frame.webp)
        return f"_static/frames/{file.name}"
    return f"data:image/webp;base64,{b64encode(frame.webp).decode()}"


def explore(
    function: Callable[..., Any],
    plot: Plot | None = None,
    /,
    *,
    mode: Mode | None = None,
    alt: str = "",
    **sliders: Slider | Range | Sequence[Value],
) -> Any:
    """Return a figure with one to four sliders, to be the last expression of a cell.

    With a plot, `function` is a law that runs on floats and on symbols of CasADi alike. It is
    translated, and the page computes it, with any value between a slider's ends; so does a
    notebook. Without one, `function` draws by matplotlib: in the built book all combinations of
    values are drawn ahead, in a notebook the kernel draws at each change.

    Args:
        function: A pure function, called with one keyword a slider: a law, which returns curves and
            numbers by name, or one that returns a Figure.
        plot: What is shown of a law.
        mode: ``"live"`` or ``"static"``. Without it, static where the environment variable
            ``SOFTGRIP_BOOK`` is ``static``, else live.
        alt: The picture in words, for those who do not see it; the sliders' values are added.
        **sliders: From a parameter of `function` (not named ``mode`` or ``alt``) to a `Range`, to a
            `Slider`, to what `slider` returns, or to the values alone (numbers or strings).

    Raises:
        InvalidInputError: If there are no or too many sliders, if they do not fit the parameters,
            if the plot names what the law does not return, or if static frames are too many (125 a
            call) or too large (3 MB of base64 a page).

    >>> from book.explore.plot import Line, Panel
    >>> def line(slope):
    ...     return {"x": [0.0, 1.0], "y": [0.0, slope]}
    >>> shown = explore(line, Plot([Panel([Line("x", "y")], x=(0, 1), y=(0, 2))]), mode="static",
    ...                 slope=Range(0, 2, 1, "Slope"))
    >>> shown.name
    'explore-line'
    """
    chosen = _sliders(sliders)
    _check_takes(function, list(chosen))
    live = _mode(mode) == "live"
    called = function.__name__
    name = "explore-" + called.removeprefix("draw_").replace("_", "-")
    if plot is None:
        fixed = {n: s for n, s in chosen.items() if isinstance(s, Slider)}
        if live and len(fixed) == len(chosen):
            from book.explore.redrawn import redrawn

            return redrawn(function, fixed, alt)
        frames = _frames(function, chosen)
        addresses, told = [_address(frame) for frame in frames], [frame.told for frame in frames]
        return Explorer(name, chosen, alt, called, frames=addresses, told=told)
    found = function(**{n: s.values[s.start] if isinstance(s, Slider) else s.start
                        for n, s in chosen.items()})  # fmt: skip
    if lacking := plot.names() - found.keys() - chosen.keys():
        raise InvalidInputError("plot", expected=f"some of {sorted(found)}", got=sorted(lacking))
    return Explorer(name, chosen, alt, called, plot=plot, laws=_laws(function, chosen), alone=live)
