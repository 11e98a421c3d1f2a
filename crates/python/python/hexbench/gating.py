"""A gate for the accuracy of your own function: its scores are recorded once, then compared case by case."""

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
    """Save the scores of a function as a baseline: ``hexbench gate record`` without a program.

    Parameters
    ----------
    suite : str or path
        A bundled suite (``springs-and-effects``), a suite file, or the folder of a challenge with its sealed part.
    baseline : path
        The file to write. It is small; commit it.
    algorithm : function, or sequence of str
        Function from a :class:`Case` to an :class:`Answer`, as for :func:`answer_challenge`. An exception fails one case. With
        ``client`` also a program with its arguments.
    seed : int, optional
        A seed other than that of the suite.
    repeats : int
        Number of runs over all cases (1 to 100): their scatter determines how small a change can be detected.
    depends : sequence of paths
        Files and folders that the function depends on, in addition to the file that defines it.
    work : path, optional
        Folder in which to keep cases and answers; by default a temporary one. The function always answers again.
    reason : str, optional
        Reason for the baseline; stored in it.
    client : distributed.Client, optional
        A cluster whose workers answer the cases, as for :func:`answer_challenge`.

    Notes
    -----
    Cases run one after the other in this process, without limits of time and memory. The baseline contains the SHA-256 of the
    file that defines the function; for a function in a notebook or at a prompt, that of its source, or of its code if Python
    does not keep the source. Nothing else is checked: imported modules (name them in ``depends``), captured values, arguments
    of a ``functools.partial``, other versions of packages. Scores are compared whether the digests agree or not; digests only
    show which file changed.

    Raises
    ------
    UsageError, BadInput, InputOutput
        With the text of the command, for example if the baseline exists.
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
    """Run the current function over the cases of a baseline, and compare: ``hexbench gate check`` without a program.

    Parameters
    ----------
    baseline : path
        File that :func:`gate_record` wrote; one that ``hexbench gate record`` wrote for a program is accepted too.
    algorithm : function, or sequence of str
        Function from a :class:`Case` to an :class:`Answer`; with ``client`` also a program with its arguments.
    challenge : path, optional
        The challenge, if the baseline was recorded on an existing one.
    repeats : int, optional
        Number of runs over all cases, if the runs of the baseline differ; by default as many as it has.
    work : path, optional
        Folder in which to keep cases and answers; by default a temporary one.
    junit, markdown : paths, optional
        Write the limits as JUnit XML, or a short Markdown page.
    update : bool
        Replace the baseline with the scores of the current function; ``reason`` says why.
    reason : str, optional
        Stored in the baseline.
    client : distributed.Client, optional
        A cluster whose workers answer the cases, as for :func:`answer_challenge`.

    Returns
    -------
    Outcome
        ``passed`` is False if scores are significantly worse; ``data`` has all figures, format ``gate/1``, and is None with
        ``update``.

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
