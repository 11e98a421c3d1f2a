"""The accuracy of your own function, guarded: its scores recorded once, then compared case by case."""

from __future__ import annotations

import json
from collections.abc import Iterator, Sequence
from os import PathLike, fspath
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import TYPE_CHECKING, Any

from hexbench import _native
from hexbench._bounds import whole
from hexbench.commands import Outcome
from hexbench.entrants import Algorithm, _own

if TYPE_CHECKING:
    from distributed import Client

_Path = str | PathLike[str]


def gate_record(
    suite: _Path,
    baseline: _Path,
    algorithm: Algorithm | Sequence[str],
    *,
    seed: int | None = None,
    repeats: int = 5,
    depends: Sequence[_Path] = (),
    work: _Path | None = None,
    reason: str | None = None,
    client: Client | None = None,
) -> Outcome:
    """Keep the scores of a function as the baseline to compare with: ``hexbench gate record`` without a program.

    Parameters
    ----------
    suite : str or path
        A bundled suite (``springs-and-effects``), a suite file, or the folder of a challenge with its sealed part.
    baseline : path
        The file to write. It is small: commit it.
    algorithm : function, or sequence of str
        Of a :class:`Case`, to an :class:`Answer`, as for :func:`answer_challenge`. What it raises is the failure of one case.
        With ``client`` also a program with its arguments.
    seed : int, optional
        Another seed of the cases than that of the suite.
    repeats : int
        Runs over all cases (1 to 100): how much they differ decides how small a change is noticed.
    depends : sequence of paths
        Files and folders that the function depends on, beside the file in which it stands.
    work : path, optional
        Folder for cases and answers, which stay there; a temporary one otherwise. The function always answers anew.
    reason : str, optional
        Why there is a baseline; kept in it.
    client : distributed.Client, optional
        A cluster whose workers answer the cases, as for :func:`answer_challenge`.

    Notes
    -----
    One case after the other in this process, without limits of time and memory. The baseline keeps the SHA-256 of the file in
    which the function stands; of a function in a notebook or on a prompt, that of its source, or of its code where Python does
    not keep the source. Nothing else of the function is seen: modules that it imports (name them in ``depends``), values that
    it takes from outside itself, arguments of a ``functools.partial``, other versions of packages. Scores are compared whether
    the digests are the same or not; digests say only which file changed.

    Raises
    ------
    UsageError, BadInput, InputOutput
        With the text of the command: a baseline that exists.
    """
    options = {"seed": seed, "repeats": whole(repeats, "repeats", 1, 100), "work": work, "reason": reason, "depends": depends}
    text, passed = _gate(["record", fspath(suite)], {"baseline": baseline, **options}, algorithm, client)
    return Outcome(text, None, passed)


def gate_check(
    baseline: _Path,
    algorithm: Algorithm | Sequence[str],
    *,
    challenge: _Path | None = None,
    repeats: int | None = None,
    work: _Path | None = None,
    junit: _Path | None = None,
    markdown: _Path | None = None,
    update: bool = False,
    reason: str | None = None,
    client: Client | None = None,
) -> Outcome:
    """Let a function answer the cases of a baseline as it is now, and compare: ``hexbench gate check`` without a program.

    Parameters
    ----------
    baseline : path
        What :func:`gate_record` wrote; one that ``hexbench gate record`` wrote of a program serves too.
    algorithm : function, or sequence of str
        Of a :class:`Case`, to an :class:`Answer`; with ``client`` also a program with its arguments.
    challenge : path, optional
        The challenge, where the baseline was recorded on one that was made before.
    repeats : int, optional
        Runs over all cases where those of the baseline differ; as many as it has otherwise.
    work : path, optional
        Folder for cases and answers, which stay there; a temporary one otherwise.
    junit, markdown : paths, optional
        Write the limits as JUnit XML, a short page of Markdown.
    update : bool
        Make the scores of the function as it is now the baseline; ``reason`` says why.
    reason : str, optional
        Kept in the baseline.
    client : distributed.Client, optional
        A cluster whose workers answer the cases, as for :func:`answer_challenge`.

    Returns
    -------
    Outcome
        ``passed`` is False where scores are worse; ``data`` has all figures, format ``gate/1``, and is None with ``update``.

    Raises
    ------
    UsageError, BadInput, InputOutput
        With the text of the command.
    """
    options: dict[str, Any] = {
        "baseline": baseline, "challenge": challenge, "repeats": whole(repeats, "repeats", 1, 100), "work": work,
        "junit": junit, "markdown": markdown, "update": update, "reason": reason,
    }  # fmt: skip
    with TemporaryDirectory() as folder:
        path = Path(folder) / "gate.json"
        text, passed = _gate(["check"], options | ({} if update else {"json": path}), algorithm, client)
        data = json.loads(path.read_text(encoding="utf-8")) if path.exists() else None
    return Outcome(text, data, passed)


def _gate(
    words: list[str], options: dict[str, Any], algorithm: Algorithm | Sequence[str], client: Client | None
) -> tuple[str, bool]:
    own = _own(algorithm, (), client)
    return _native.gate([*("gate", *words), *_line(options), "--", *(own["line"] or [own["called"]])], own)


def _line(options: dict[str, Any]) -> Iterator[str]:
    """Return options as words, each with its value in one word: a value may begin with a dash."""
    for name, value in options.items():
        for one in value if isinstance(value, (list, tuple)) else [value]:
            if one is True:
                yield f"--{name}"
            elif one is not None and one is not False:
                yield f"--{name}={fspath(one) if isinstance(one, PathLike) else one}"
