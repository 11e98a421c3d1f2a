"""Messages of the readers, as Python warnings."""

from __future__ import annotations

import warnings
from collections.abc import Iterable

from hexbench.errors import HexbenchWarning


def warn(noticed: Iterable[tuple[str, str]], stacklevel: int = 3) -> None:
    """Warn of each message, with its next step below it."""
    for message, next_step in noticed:
        warnings.warn(f"{message}\n  next: {next_step}", HexbenchWarning, stacklevel=stacklevel + 1)
