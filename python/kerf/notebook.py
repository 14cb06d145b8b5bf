"""What notebooks show of objects: a table of counts, and a picture where kerf-view is."""

from __future__ import annotations

import base64
import html
from typing import Mapping, Optional, Union

from . import _kerf
from .drawing import draw
from .errors import Error

#: What there are pictures of, or its folder.
Drawn = Union[_kerf.Surface, _kerf.Mesh, str]
#: Triangles or tetrahedra: what has more is shown without a picture.
MOST_ELEMENTS_OF_PICTURE = 300_000
_SECONDS_OF_PICTURE = 5


def html_of(what: Drawn, title: str, rows: Mapping[str, object], elements: int, **options: object) -> str:
    """For a notebook: `rows` as a table and, unless the elements are too many, a picture with the options."""
    right = "style='text-align:right'"
    cells = "".join(f"<tr><td>{html.escape(name)}</td><td {right}>{html.escape(_text(value))}</td></tr>"
                    for name, value in rows.items())
    page = f"<b>{html.escape(title)}</b><table>{cells}</table>"
    picture = _picture(what, options) if elements <= MOST_ELEMENTS_OF_PICTURE else None
    if picture is None:
        return page
    data = base64.b64encode(picture).decode("ascii")
    return f"<div style='display:flex'><div>{page}</div><img width='480' src='data:image/png;base64,{data}'></div>"


def _text(value: object) -> str:
    return f"{value:,}" if isinstance(value, int) else f"{value:.6g}" if isinstance(value, float) else str(value)


def _picture(what: Drawn, options: Mapping[str, object]) -> Optional[bytes]:
    try:
        return draw(what, options, (720, 540), _SECONDS_OF_PICTURE)
    except Error:  # no program, no time, nothing to be seen: there is the table
        return None
