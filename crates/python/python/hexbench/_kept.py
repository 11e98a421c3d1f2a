"""Results that can be pickled: the contents of a result without its computation; its HTML page is computed again."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any


class Kept:
    """The contents of a result, in place of the native result."""

    def __init__(
        self, json: str, pages: tuple[str, str], term: str | None, again: tuple[Callable[..., Any], tuple[Any, ...]]
    ) -> None:
        """Keep the texts, and how to compute the result again."""
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


class Told:
    """A result compared, hashed and pickled by its contents."""

    #: What was asked.
    _again: tuple[Any, ...]

    def to_json(self) -> str:
        """Return the text of the JSON file."""
        raise NotImplementedError

    def __eq__(self, other: object) -> bool:
        """Compare all that is reported."""
        return isinstance(other, type(self)) and self.to_json() == other.to_json()

    def __hash__(self) -> int:
        """Hash what is compared."""
        return hash(self.to_json())

    def _kept_with(
        self, pages: tuple[str, str], term: str | None, function: Callable[..., Any]
    ) -> tuple[Callable[..., Any], tuple[Any, ...]]:
        """Return what pickles it: what is reported and what was asked; the page for a browser is computed again when wanted."""
        return (_restored, (type(self), self.to_json(), pages, term, (function, self._again)))


def _restored(
    kind: type[Any], json: str, pages: tuple[str, str], term: str | None, again: tuple[Callable[..., Any], tuple[Any, ...]]
) -> Any:
    return kind(Kept(json, pages, term, again), again[1])
