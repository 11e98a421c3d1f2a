"""Exceptions. Their text is that of the command: the message, and below it the next step."""

from __future__ import annotations


class HexbenchError(Exception):
    """Anything hexbench refuses or cannot do.

    ``message`` says what is wrong and where, ``next_step`` what to do about it (may be empty).
    """

    message: str
    next_step: str

    def __init__(self, message: str = "", next_step: str | None = None) -> None:
        super().__init__(message, next_step or "")
        self.message = message
        self.next_step = next_step or ""

    def __str__(self) -> str:
        """Return the text that the command prints after ``error:``."""
        return f"{self.message}\n  next: {self.next_step}" if self.next_step else self.message


class BadInput(HexbenchError, ValueError):
    """A file, table or array says something that cannot be used (exit code 3 of the command)."""


class UsageError(HexbenchError, ValueError):
    """An argument that makes no sense: an unknown term, a plan of no poses (exit code 2 of the command)."""


class NotDetermined(HexbenchError):
    """The data do not determine the requested result (exit code 4 of the command)."""


class InputOutput(HexbenchError, OSError):
    """A file that cannot be read or written (exit code 5 of the command)."""


class HexbenchWarning(UserWarning):
    """Something in the data that was accepted but should be checked."""
