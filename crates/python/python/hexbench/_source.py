"""The source to which the answers of a function are bound, as far as it is available."""

from __future__ import annotations

import functools
import inspect
from collections.abc import Callable
from pathlib import Path
from types import CodeType
from typing import Any


def called(algorithm: Callable[..., Any]) -> str:
    """Return what a function is called: module and name."""
    name = getattr(algorithm, "__qualname__", None) or type(algorithm).__qualname__
    return f"{getattr(algorithm, '__module__', '')}.{name}"


def bound_to(algorithm: Callable[..., Any]) -> tuple[list[str], list[tuple[str, str]]]:
    """Return files and named texts: the file in which a function stands; where there is none, its source, or else its code."""
    written = _written(algorithm)
    try:
        path = inspect.getsourcefile(written)
    except TypeError:
        # A function of another language.
        path = None
    if path is not None and Path(path).is_file():
        return [path], []
    text = _text(written)
    return [], [] if text is None else [(f"source of {called(algorithm)}", text)]


def _written(algorithm: Callable[..., Any]) -> Any:
    """Return what was written of a function: what is wrapped or given arguments, the class of an object that is called."""
    thing: Any = algorithm
    while isinstance(thing, functools.partial) or hasattr(thing, "__wrapped__"):
        thing = thing.func if isinstance(thing, functools.partial) else thing.__wrapped__
    return thing if inspect.isroutine(thing) or inspect.isclass(thing) else type(thing)


def _text(written: Any) -> str | None:
    """Return the source of a cell or a prompt; where Python does not keep it, the code."""
    try:
        return inspect.getsource(written)
    except (OSError, TypeError):
        code = getattr(vars(written).get("__call__", written) if inspect.isclass(written) else written, "__code__", None)
        return None if code is None else _code(code)


def _code(code: CodeType) -> str:
    """Return the instructions, names and constants of code, the same in every process of one version of Python."""
    constants = [_code(c) if isinstance(c, CodeType) else repr(c) for c in code.co_consts]
    return "\n".join([code.co_code.hex(), *code.co_names, *code.co_varnames, *code.co_freevars, *constants])
