"""Results that travel: what a result says, without the computation behind it; its page for a browser is computed again."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any


class Kept:
    """What a result says, in the place of the native result that said it."""

    def __init__(
        self, json: str, pages: tuple[str, str], term: str | None, again: tuple[Callable[..., Any], tuple[Any, ...]]
    ) -> None:
        """Hold texts, and how the result is computed again."""
        self._json = json
        self._pages = pages
        self._term = term
        self._again = again

    def json(self) -> str:
        """Return the text of the JSON file."""
        return self._json

    def text(self, verbose: bool = False) -> str:
        """Return the page of the command."""
        return self._pages[verbose]

    def term(self) -> str | None:
        """Return the term file of a law."""
        return self._term

    def html(self) -> str:
        """Return the page for a browser."""
        function, inputs = self._again
        page: str = function(*inputs)._made.html()
        return page

    @property
    def state(self) -> tuple[Any, ...]:
        """What makes it again."""
        return (self._json, self._pages, self._term, self._again)
