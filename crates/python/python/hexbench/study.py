"""Studies: how accuracy depends on the choices of an experiment, swept on this machine or on a Dask cluster.

A study is a list of shards. A shard depends only on the study file and on its number, because every trial has its own random
stream. The results are therefore the same bytes on one thread, on many machines, after an interruption, or after a worker was
killed::

    from dask.distributed import Client
    from hexbench import study

    with Client("tcp://scheduler:8786") as client:
        done = study.run(client, "study.toml", "results")
    print(done.summary)

The workers need the package ``hexbench`` in the same version, and nothing else: no shared disk and no copy of the study.
"""

from __future__ import annotations

import contextlib
import os
import posixpath
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any

from hexbench import _cluster, _native
from hexbench.errors import UsageError

if TYPE_CHECKING:
    from collections.abc import Callable, Generator, Sequence

    import pandas as pd
    from distributed import Client

__all__ = ["Results", "merge", "plan", "run", "run_part"]

StrPath = str | os.PathLike[str]


@dataclass(frozen=True)
class Results:
    """The results of a study.

    ``folder`` has ``cells.csv`` (one row per cell), ``trials.parquet`` (one row per trial), ``study.md`` and ``charts``;
    ``summary`` is the page as text.
    """

    folder: Path
    summary: str

    def cells(self) -> pd.DataFrame:
        """Return one row per cell: the value on every axis, counts, errors, coverage; units are in the names."""
        import pandas

        return pandas.read_csv(self.folder / "cells.csv")

    def trials(self) -> pd.DataFrame:
        """Return one row per trial (needs pyarrow); null if a trial has no such result."""
        import pandas

        return pandas.read_parquet(self.folder / "trials.parquet")


def plan(study: StrPath, parts: int = 1) -> dict[str, Any]:
    """Report how a study is divided: shards, trials, input files, and parts.

    Args:
        study: the study file (study.toml).
        parts: number of parts.

    Returns:
        ``title``, ``shards``, ``trials``, ``inputs`` (SHA-256 of every file), ``files``, and ``parts``, a list of ``part``
        (``"i/n"``), ``shards``, ``trials``.

    Raises:
        BadInput: the study file, or a file it names, cannot be used.
    """
    said: dict[str, Any] = _native.study_plan(os.fspath(study), parts)
    return said


def run_part(study: StrPath, part: str, folder: StrPath) -> dict[str, Any]:
    """Compute one part of a study in its own folder, as ``hexbench study run --shard`` does.

    Args:
        study: the study file.
        part: ``"i/n"``, i from 1 to n.
        folder: the folder of the part; shards already in it are not computed again.

    Returns:
        ``part``, ``folder``, ``trials``, ``computed_shards``, ``computed_trials``, ``damaged``.

    Raises:
        BadInput: the study cannot be used, or the folder belongs to another one.
        InputOutput: the folder cannot be written, or another run is using it.
    """
    said: dict[str, Any] = _native.study_run_part(os.fspath(study), part, os.fspath(folder))
    return said


def merge(study: StrPath, parts: Sequence[StrPath], folder: StrPath, *, markdown: StrPath | None = None) -> Results:
    """Merge parts and write the results: the same bytes as on one machine.

    Args:
        study: the study file.
        parts: folders of the parts, in any order.
        folder: folder for the merged study.
        markdown: also write the page to this file.

    Raises:
        BadInput: shards are missing, or a folder belongs to another study or version.
    """
    said = _native.study_merge(os.fspath(study), [os.fspath(p) for p in parts], os.fspath(folder), _path(markdown))
    return _results(said)


def run(
    client: Client | None,
    study: StrPath,
    folder: StrPath,
    *,
    retries: int = 3,
    patience: float = 600.0,
    progress: Callable[[int, int], None] | None = None,
    markdown: StrPath | None = None,
) -> Results:
    """Run a study on a Dask cluster, or here, and write its results.

    Every shard that arrives is saved in ``folder/journal``. After an interruption, the same call resumes the run. If a worker
    is killed, another one repeats its task. The results do not depend on any of this: they are the bytes of ``hexbench study
    STUDY -o FOLDER``.

    Args:
        client: client of a cluster whose workers have this version of hexbench; None computes on this machine's threads.
        study: the study file; the files it names are sent along, and must be named relative to it.
        folder: folder of the results; new, empty, or of an earlier run of this study.
        retries: how often a failed task is retried.
        patience: seconds without any worker after which the run stops.
        progress: called with the number of finished shards and of all shards; by default a line on a terminal.
        markdown: also write the page to this file.

    Raises:
        BadInput: the study cannot be used, or the folder belongs to another one.
        InputOutput: the folder cannot be written, the cluster is gone, or there was no worker for too long.
    """
    with contextlib.closing(_native.StudyWork(os.fspath(study), os.fspath(folder))) as work:
        report = progress or _cluster.line("shards")
        done = None
        # Where cells stop when they are decided, one round follows another.
        while True:
            todo = work.todo()
            pending, shards = todo["pending_shards"], todo["shards"]
            known, done = done, shards - len(pending)
            if done != known:
                report(done, shards)
            if not pending:
                break
            files = todo["files"]
            with contextlib.closing(_records(client, Path(study), files, pending, retries, patience)) as records:
                for number, record in records:
                    work.keep(number, record)
                    done += 1
                    report(done, shards)
        return _results(work.write(_path(markdown)))


def _records(
    client: Client | None, study: Path, files: list[str], pending: list[int], retries: int, patience: float
) -> Generator[tuple[int, bytes]]:
    """Yield the number and the record of every pending shard, in the order in which they are done."""
    if client is not None:
        yield from _cluster.records(client, _Source.read(study, files), pending, retries, patience)
        return
    threads = os.cpu_count() or 1
    runner = _native.ShardRunner.of_study(os.fspath(study), threads)
    for some in _cluster.chunks(pending, 4 * threads):
        yield from zip(some, runner.run(some), strict=True)


@dataclass(frozen=True)
class _Source:
    """A study with every file it names, as it travels to a worker."""

    #: `..` is resolved.
    files: _cluster.Files
    #: Place of the study file among them.
    study: str

    @classmethod
    def read(cls, study: Path, named: list[str]) -> _Source:
        for name in named:
            if posixpath.isabs(name) or Path(name).is_absolute():
                next_step = "Name files relative to the study file: workers on other machines get copies of them."
                raise UsageError(f"{study} names {name} by an absolute path", next_step)
        # As many folders above the study as its names climb.
        climbs = max((posixpath.normpath(n).split("/").count("..") for n in named), default=0)
        base = "/".join(["up"] * climbs)
        places = {posixpath.normpath(posixpath.join(base, name)): study.parent / name for name in named}
        place = posixpath.join(base, study.name)
        files = {place: study.read_bytes()} | {to: path.read_bytes() for to, path in places.items()}
        return cls(_cluster.Files(files), place)

    @property
    def digest(self) -> str:
        return self.files.digest

    def ready(self, threads: int) -> _cluster.Ready:
        return _cluster.Ready(self.files, lambda folder: _native.ShardRunner.of_study(folder / self.study, threads))


def _results(said: dict[str, Any]) -> Results:
    return Results(folder=Path(said["folder"]), summary=said["summary"])


def _path(path: StrPath | None) -> str | None:
    return None if path is None else os.fspath(path)
