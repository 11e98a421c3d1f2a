"""Whole numbers within bounds."""

from __future__ import annotations

from operator import index

from hexbench.errors import UsageError


def whole(value: int | None, name: str, smallest: int, largest: int) -> int | None:
    """Return a whole number within bounds, or None for None."""
    if value is None:
        return None
    try:
        number = index(value)
    except TypeError:
        raise UsageError(f"{name}: expected a whole number, found {value!r}") from None
    if not smallest <= number <= largest:
        raise UsageError(f"{name}: {number} is not between {smallest} and {largest}")
    return number
