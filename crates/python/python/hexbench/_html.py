"""Small pieces of HTML for notebooks."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from html import escape


def pre(text: str) -> str:
    """Return a page of the terminal as it is."""
    return f'<pre style="font-family:monospace;line-height:1.25;overflow-x:auto">{escape(text)}</pre>'


def table(heads: Sequence[str], rows: Iterable[Sequence[object]]) -> str:
    """Return a table."""
    head = "".join(f"<th>{escape(h)}</th>" for h in heads)
    body = "".join("<tr>" + "".join(f"<td>{escape(str(cell))}</td>" for cell in row) + "</tr>" for row in rows)
    return f"<table><thead><tr>{head}</tr></thead><tbody>{body}</tbody></table>"


def bar(share: float) -> str:
    """Return a bar of a share from 0 to 1."""
    width = round(100 * min(max(share, 0.0), 1.0))
    return f'<div style="background:#2a6fb0;height:.8em;width:{width}px" title="{share:.3f}"></div>'
