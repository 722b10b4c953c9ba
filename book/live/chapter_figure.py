"""A chapter's figure from logs of one's own, on a page that is not the chapter's."""

import html
import re
from base64 import b64encode
from collections.abc import Sequence
from pathlib import Path

from IPython.display import HTML
from matplotlib.figure import Figure

from book.companion.exhibit import exhibit, with_logs
from book.companion.save import make, svg
from softgrip.errors import InvalidInputError

EMPHASIS = re.compile(r"\*([^*]+)\*")


def image(data: bytes, kind: str, alt: str) -> str:
    """Return the HTML of a picture that lies within the page.

    Parameters
    ----------
    data, kind
        Content, and its type: png or svg+xml.
    alt
        The picture in words.
    """
    return (
        f'<img src="data:image/{kind};base64,{b64encode(data).decode()}" '
        f'alt="{html.escape(alt)}" style="width: 100%; max-width: 640px; background: #fff">'
    )


def chapter_figure(title: str, logs: Sequence[Path | str] = ()) -> HTML:
    """Make a figure as `show` does, but leave the chapter's own, and its number, alone.

    Parameters
    ----------
    title
        Such as ``Figure 4.7``.
    logs
        To draw; none for those of the book.

    Raises
    ------
    InvalidInputError
        If it is no figure, or not drawn from logs though some are given.
    """
    item = with_logs(exhibit(title), logs) if logs else exhibit(title)
    drawn, _ = make(item)
    if not isinstance(drawn, Figure):
        raise InvalidInputError("title", expected="a figure", got=title)
    words = EMPHASIS.sub(r"<em>\1</em>", html.escape(item.caption))
    files = ", ".join(file.path.name for file in item.data)
    told = " · ".join([f"data: {files}", *item.repairs])
    text = (
        f"{image(svg(drawn), 'svg+xml', item.alt)}<p>As {item.title}: {words}</p>"
        f"<p><small>shown: <b>{item.provenance}</b> · {html.escape(told)}</small></p>"
    )
    return HTML(text)  # type: ignore[no-untyped-call]
