"""Commands that read and write files, as functions with the options of the command line.

Every function takes paths or objects of this package (:class:`Hexapod`, :class:`Campaign`, :class:`Plan`, :class:`Model`, a
result), and options under the names of the command line: ``--noise-from-repeats`` is ``noise_from_repeats=True``, a list
repeats an option. ``hexbench COMMAND --help`` lists them all. The result is an :class:`Outcome`.
"""

from __future__ import annotations

import json as reader
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from os import PathLike, fspath
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Any

from hexbench import _native
from hexbench._html import pre
from hexbench.errors import UsageError


@dataclass(frozen=True)
class Outcome:
    """The result of a command."""

    #: The page, as on the terminal; a table if the command writes one to standard output.
    text: str
    #: The keys of the JSON file if the command has one; otherwise None.
    data: dict[str, Any] | None
    #: False if a requested check failed: exit code 1 of the command.
    passed: bool

    def __str__(self) -> str:
        """Return the page."""
        return self.text

    def _repr_html_(self) -> str:
        return pre(self.text)


def command(*words: object, **options: Any) -> Outcome:
    """Run any command of hexbench in this process.

    Parameters
    ----------
    *words
        The name of the command, then its files: paths or objects of this package.
    **options
        Options under the names of the command line, ``_`` for ``-``. True sets a switch, False and None omit an option, a list
        repeats it.

    Raises
    ------
    UsageError, BadInput, NotDetermined, InputOutput
        With the text of the command.
    """
    with TemporaryDirectory() as folder:
        place = Path(folder)
        line = [_word(word, place) for word in words] + list(_options(options, place))
        text, passed = _native.command(line)
    return Outcome(text, None, passed)


def _with_json(*words: object, **options: Any) -> Outcome:
    """Run a command that also writes a JSON file."""
    with TemporaryDirectory() as folder:
        path = Path(folder) / "result.json"
        said = command(*words, json=path, **options)
        data = reader.loads(path.read_text(encoding="utf-8")) if path.exists() else None
    return Outcome(said.text, data, said.passed)


def check(hexapod: object, data: object = None, holdout: object = None, **options: Any) -> Outcome:
    """Check machine and files: ``hexbench check``; ``passed`` is False if something is wrong."""
    given = [x for x in (hexapod, data, holdout) if x is not None]
    return _with_json("check", *given, **options)


def power(hexapod: object, plan: object, **options: Any) -> Outcome:
    """Report which effects a plan can detect, and how large they must be: ``hexbench power``; ``data["effects"]`` has the
    units.
    """
    return _with_json("power", hexapod, plan, **options)


def discriminate(hexapod: object, space: object, between: Sequence[str], **options: Any) -> Outcome:
    """Choose the readings that separate effects: ``hexbench discriminate``."""
    return _with_json("discriminate", hexapod, space, between=list(between), **options)


def poses(balls_measured: object, **options: Any) -> Outcome:
    """Compute poses from ball centers measured on a CMM: ``hexbench poses``; ``text`` is the table, mm, deg, um, urad."""
    return command("poses", balls_measured, **options)


def campaign(data: object, loads: object, output: object, **options: Any) -> Outcome:
    """Compute a campaign from ball centers, loads and commanded poses: ``hexbench campaign``, into the folder ``output``."""
    return _with_json("campaign", data, loads, output=output, **options)


def init(output: object, **options: Any) -> Outcome:
    """Write hexapod.toml from the dimensions of a machine: ``hexbench init``, mm and deg."""
    return command("init", output=output, **options)


def runs(first: object, second: object, *more: object, **options: Any) -> Outcome:
    """Compare two results, or make a campaign book of three or more (``dates="2026-01-12,2026-02-09,..."``): ``hexbench runs``.

    ``passed`` is False with ``check=True`` if anything changed.
    """
    return _with_json("runs", first, second, *more, **options)


def export(scene: object, output: object, **options: Any) -> Outcome:
    """Write a scene as a model of MuJoCo: ``hexbench export --mjcf``."""
    return command("export", scene, output=output, mjcf=True, **options)


def witness(scene: object, **options: Any) -> Outcome:
    """Compare the rest states of a scene in independent simulations: ``hexbench witness``; ``passed``: they agree."""
    return command("witness", scene, **options)


def regress(**options: Any) -> Outcome:
    """Test hexbench against a baseline of its accuracy: ``hexbench regress``; ``passed`` is False if a limit is significantly
    worse.

    With ``update=True, reason="..."`` the figures of this program become the baseline, and ``data`` is None.
    """
    return command("regress", **options) if options.get("update") else _with_json("regress", **options)


def challenge_make(suite: object, out: object, **options: Any) -> Outcome:
    """Write the cases of a challenge: ``hexbench challenge make``."""
    return command("challenge", "make", suite, out=out, **options)


def challenge_run(challenge: object, out: object, name: str, program: Sequence[str], **options: Any) -> Outcome:
    """Run a program over the cases of a challenge: ``hexbench challenge run``; for a function:
    :func:`hexbench.answer_challenge`.
    """
    return _with_program(("challenge", "run", challenge), program, {"out": out, "name": name, **options})


def challenge_lint(answer: object, **options: Any) -> Outcome:
    """Report every error in one answer: ``hexbench challenge lint``; ``passed`` is False if there are any."""
    return command("challenge", "lint", answer, **options)


def gate_record(suite: object, program: Sequence[str], **options: Any) -> Outcome:
    """Save the scores of a program as a baseline: ``hexbench gate record``; for a function: :func:`hexbench.gate_record`."""
    return _with_program(("gate", "record", suite), program, options)


def gate_check(program: Sequence[str] = (), **options: Any) -> Outcome:
    """Compare a program with its baseline: ``hexbench gate check``; for a function: :func:`hexbench.gate_check`."""
    return _with_program(("gate", "check"), program, options)


def _with_program(words: Sequence[object], program: Sequence[str], options: dict[str, Any]) -> Outcome:
    """Run a command whose line ends with a program and its own arguments."""
    with TemporaryDirectory() as folder:
        place = Path(folder)
        line = [_word(word, place) for word in words] + list(_options(options, place))
        text, passed = _native.command([*line, *(["--", *map(str, program)] if program else [])])
    return Outcome(text, None, passed)


def challenge_answer(case: object, out: object, **options: Any) -> Outcome:
    """Answer one case as hexbench or the paper would: ``hexbench challenge answer``."""
    return command("challenge", "answer", case, out, **options)


def challenge_score(challenge: object, answers: Sequence[object], **options: Any) -> Outcome:
    """Score answers to a challenge: ``hexbench challenge score``."""
    return _with_json("challenge", "score", challenge, *answers, **options)


def _options(options: dict[str, Any], place: Path) -> Iterator[str]:
    for name, value in options.items():
        flag = f"--{name.replace('_', '-')}"
        for one in value if isinstance(value, (list, tuple)) else [value]:
            if one is True:
                yield flag
            elif one is not None and one is not False:
                yield f"{flag}={_word(one, place)}"


def _word(value: object, place: Path) -> str:
    """Return a word of the command line; objects in memory are first written to a file in the folder."""
    if isinstance(value, (str, PathLike)):
        return str(fspath(value))
    for method, ending in (("to_csv", "csv"), ("to_toml", "toml"), ("to_json", "json")):
        write = getattr(value, method, None)
        if write is not None:
            path = place / f"{type(value).__name__.lower()}-{len(list(place.iterdir()))}.{ending}"
            path.write_text(write(), encoding="utf-8")
            return str(path)
    if isinstance(value, (int, float)):
        return repr(value)
    raise UsageError(f"expected a path, a number, a text or an object of hexbench, found {type(value).__name__}")
