"""A figure with sliders: redrawn by a kernel, or chosen among frames drawn ahead."""

import html
import inspect
import os
from base64 import b64encode
from collections.abc import Callable, Mapping, Sequence
from itertools import product
from typing import Any, Literal

import ipywidgets as widgets
from matplotlib.figure import Figure

from book.companion.frames import PAGE, Frame, check_count, render
from book.companion.sliders import Slider, Value
from softgrip.errors import InvalidInputError

Mode = Literal["live", "static"]
MODE_VARIABLE = "SOFTGRIP_BOOK"


def _sliders(given: Mapping[str, Slider | Sequence[Value]]) -> dict[str, Slider]:
    if not 1 <= len(given) <= 3:
        raise InvalidInputError("explore", expected="one to three sliders", got=list(given))
    return {
        name: item if isinstance(item, Slider) else Slider(item, label=name)
        for name, item in given.items()
    }


def _check_takes(draw: Callable[..., Figure], names: Sequence[str]) -> None:
    signature = inspect.signature(draw)
    try:
        signature.bind(**dict.fromkeys(names))
    except TypeError as error:
        expected = f"sliders that fit draw{signature}: {error}"
        raise InvalidInputError("explore", expected=expected, got=list(names)) from None


def _mode(asked: Mode | None) -> Mode:
    if asked not in (None, "live", "static"):
        raise InvalidInputError("mode", expected="'live', 'static' or None", got=asked)
    return asked or ("static" if os.environ.get(MODE_VARIABLE) == "static" else "live")


def _image(frame: Frame, alt: str, sliders: Sequence[Slider], values: Sequence[Value]) -> str:
    """Return the HTML of a frame.

    Not a widget `Image`: it has no alt text, and with a tooltip its view fails in a built page.
    Width and height keep the frame's place, so that the page does not jump when it is exchanged.
    """
    state = (f"{s.label} {s.written(v)}" for s, v in zip(sliders, values, strict=True))
    text = html.escape("; ".join([*filter(None, [alt]), *state]))
    data = b64encode(frame.webp).decode()
    return (
        f'<img src="data:image/webp;base64,{data}" alt="{text}" decoding="sync" '
        f'width="{frame.width}" height="{frame.height}" '
        f'style="width: 100%; max-width: {frame.width}px; height: auto; object-fit: contain">'
    )


def _control(slider: Slider) -> widgets.SelectionSlider:
    return widgets.SelectionSlider(
        options=[(slider.written(value), value) for value in slider.values],
        index=slider.start,
        description=slider.label,
        tooltip=slider.label,  # without one the label's tooltip is the word "null"
        style={"description_width": "initial"},
        layout={"flex": "1 1 24rem", "width": "auto", "max_width": "36rem", "min_width": "0"},
    )


def _arrange(controls: Sequence[widgets.Widget], *below: widgets.Widget) -> widgets.Widget:
    row = {"flex_flow": "row wrap", "width": "100%", "overflow": "visible", "grid_gap": "0 1rem"}
    column = {"width": "100%", "overflow": "visible"}
    return widgets.VBox([widgets.Box(controls, layout=row), *below], layout=column)


def _live(draw: Callable[..., Figure], sliders: Mapping[str, Slider], alt: str) -> widgets.Widget:
    fine = {name: slider.finer() for name, slider in sliders.items()}
    controls = {name: _control(slider) for name, slider in fine.items()}
    picture, complaint = widgets.HTML(), widgets.HTML()

    def redraw() -> None:
        values = {name: control.value for name, control in controls.items()}
        frame = render(draw, values)
        picture.value = _image(frame, alt, [*fine.values()], [*values.values()])

    def answer(_change: object) -> None:
        try:
            redraw()
            complaint.value = ""
        except Exception as error:
            text = html.escape(f"{type(error).__name__}: {error}")
            complaint.value = f'<div role="alert" style="white-space: pre-wrap">{text}</div>'

    redraw()
    for control in controls.values():
        control.observe(answer, names="index")
    return _arrange([*controls.values()], complaint, picture)


def _static(draw: Callable[..., Figure], sliders: Mapping[str, Slider], alt: str) -> widgets.Widget:
    combinations = list(product(*(slider.values for slider in sliders.values())))
    check_count(len(combinations))
    frames = [render(draw, dict(zip(sliders, values, strict=True))) for values in combinations]
    PAGE.spend(frames)
    shown = [*sliders.values()]
    level: list[Any] = [
        widgets.HTML(_image(frame, alt, shown, values))
        for frame, values in zip(frames, combinations, strict=True)
    ]
    controls: list[Any] = []
    for slider in reversed(shown):
        control, count = _control(slider), len(slider.values)
        level = [
            widgets.Stack(level[i : i + count], selected_index=slider.start)
            for i in range(0, len(level), count)
        ]
        # All of them, not only the visible one: the others must be right when they are shown.
        for stack in level:
            widgets.jslink((control, "index"), (stack, "selected_index"))
        controls.insert(0, control)
    return _arrange(controls, level[0])


def explore(
    draw: Callable[..., Figure],
    /,
    *,
    mode: Mode | None = None,
    alt: str = "",
    **sliders: Slider | Sequence[Value],
) -> widgets.Widget:
    """Return a figure with one to three sliders, to be the last expression of a cell.

    Live, the figure is drawn again at each change, and an error is shown above the last good
    picture. Static, as in the built book, all combinations of values are drawn ahead and the page
    needs no kernel.

    Args:
        draw: A pure function that returns a matplotlib Figure; called with one keyword a slider.
        mode: ``"live"`` or ``"static"``. Without it, static where the environment variable
            ``SOFTGRIP_BOOK`` is ``static``, else live.
        alt: The picture in words, for those who do not see it; the sliders' values are added.
        **sliders: From a parameter of ``draw`` (not named ``mode`` or ``alt``) to a `Slider`, to
            what `slider` returns, or to the values alone (numbers or strings).

    Raises:
        InvalidInputError: If there are no or more than three sliders, if they do not fit the
            parameters of ``draw``, if ``draw`` does not return a Figure, or if static frames are
            too many (125 a call) or too large (3 MB of base64 a page).

    >>> from matplotlib.figure import Figure
    >>> def draw(law: str) -> Figure:
    ...     figure = Figure(figsize=(1, 1))
    ...     figure.suptitle(law)
    ...     return figure
    >>> widget = explore(draw, law=["linear", "Ludwick"], mode="live")
    >>> widget.children[0].children[0].options
    (('linear', 'linear'), ('Ludwick', 'Ludwick'))
    """
    chosen = _sliders(sliders)
    _check_takes(draw, list(chosen))
    return (_static if _mode(mode) == "static" else _live)(draw, chosen, alt)
