"""A figure with sliders that a kernel draws again at each change."""

import gc
import html
from base64 import b64encode
from collections.abc import Callable, Mapping, Sequence

import ipywidgets as widgets
from matplotlib.figure import Figure

from book.explore.frames import Frame, render
from book.explore.sliders import Slider, Value


def _image(frame: Frame, alt: str, sliders: Sequence[Slider], values: Sequence[Value]) -> str:
    """Return the HTML of a frame.

    Not a widget `Image`: it has no alt text, and with a tooltip its view fails in a built page.
    Width and height keep the frame's place, so that the page does not jump when it is exchanged.
    """
    state = (f"{s.label} {s.written(v)}" for s, v in zip(sliders, values, strict=True))
    text = html.escape("; ".join(filter(None, [alt, *state, frame.told])))
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


def redrawn(draw: Callable[..., Figure], sliders: Mapping[str, Slider], alt: str) -> widgets.Widget:
    """Return the widget: its sliders, what went wrong if anything did, and the picture."""
    controls = {name: _control(slider) for name, slider in sliders.items()}
    picture, complaint = widgets.HTML(), widgets.HTML()

    def redraw() -> None:
        values = {name: control.value for name, control in controls.items()}
        frame = render(draw, values, small=False)
        picture.value = _image(frame, alt, [*sliders.values()], [*values.values()])

    def answer(_change: object) -> None:
        try:
            redraw()
            complaint.value = ""
        except Exception as error:
            text = html.escape(f"{type(error).__name__}: {error}")
            complaint.value = f'<div role="alert" style="white-space: pre-wrap">{text}</div>'

    redraw()
    # What is there now stays: else some redraws wait while all that was imported is looked through.
    gc.collect()
    gc.freeze()
    for control in controls.values():
        control.observe(answer, names="index")
    return _arrange([*controls.values()], complaint, picture)
