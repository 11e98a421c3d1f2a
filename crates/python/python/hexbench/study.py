"""Studies: how accuracy depends on the choices of an experiment, swept on this machine or on a Dask cluster.

A study is a list of shards. What is in a shard depends on the study file and on the number of the shard alone, because every
trial draws from a random stream of its own. So the results are the same bytes on one thread, on many machines, after an
interruption, or after a worker was killed::

    from dask.distributed import Client
    from hexbench import study

    with Client("tcp://scheduler:8786") as client:
        done = study.run(client, "study.toml", "results")
    print(done.summary)

The workers need the package ``hexbench`` in the same version, and nothing else: no common disk, no copy of the study.
"""

from __future__ import annotations

import contextlib
import hashlib
import os
import posixpath
import sys
import tempfile
import threading
import time
from concurrent.futures import CancelledError
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any

from hexbench import _native
from hexbench.errors import HexbenchError, InputOutput, UsageError

if TYPE_CHECKING:
    from collections.abc import Callable, Generator, Iterator, Sequence

    import pandas as pd
    from distributed import Client, Future

__all__ = ["Results", "merge", "plan", "run", "run_part"]

#: Tasks that every thread of a cluster gets: enough to even out unequal shards, few enough to cost nothing.
TASKS_PER_THREAD = 8
#: Most shards of a task: its records travel and wait in memory together.
MOST_SHARDS = 64
#: How often the cluster is asked whether anybody is still there, s.
HEARTBEAT = 5.0

StrPath = str | os.PathLike[str]


@dataclass(frozen=True)
class Results:
    """Where the results of a study are, and what they say.

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
        """Return one row per trial (needs pyarrow); null where a trial has no such result."""
        import pandas

        return pandas.read_parquet(self.folder / "trials.parquet")


def plan(study: StrPath, parts: int = 1) -> dict[str, Any]:
    """Report how a study divides: shards, trials, the files it reads, and its parts.

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
    """Compute one part of a study into a folder of its own, as ``hexbench study run --shard`` does.

    Args:
        study: the study file.
        part: ``"i/n"``, i from 1 to n.
        folder: the part's folder; what is in it already is not computed again.

    Returns:
        ``part``, ``folder``, ``trials``, ``computed_shards``, ``computed_trials``, ``damaged``.

    Raises:
        BadInput: the study cannot be used, or the folder belongs to another one.
        InputOutput: the folder cannot be written, or another run works in it.
    """
    said: dict[str, Any] = _native.study_run_part(os.fspath(study), part, os.fspath(folder))
    return said


def merge(
    study: StrPath, parts: Sequence[StrPath], folder: StrPath, *, markdown: StrPath | None = None
) -> Results:
    """Put parts together and write the results: the bytes that one machine gives.

    Args:
        study: the study file.
        parts: folders of the parts, in any order.
        folder: folder of the whole.
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

    Every shard that arrives is kept in ``folder/journal``. A run that was stopped or killed goes on where it was when it is
    called again. A task whose worker was killed is done again by another one. The results do not depend on any of this: they
    are the bytes of ``hexbench study STUDY -o FOLDER``.

    Args:
        client: client of a cluster whose workers have this version of hexbench; None computes on this machine's threads.
        study: the study file; the files it names are sent along, and have to be named relative to it.
        folder: folder of the results; new, empty, or of an earlier run of this study.
        retries: how often a task that failed is tried again.
        patience: seconds without any worker after which the run gives up.
        progress: called with the number of shards done and of all; by default a line on a terminal.
        markdown: also write the page to this file.

    Raises:
        BadInput: the study cannot be used, or the folder belongs to another one.
        InputOutput: the folder cannot be written, the cluster is gone, or no worker has been there for too long.
    """
    with contextlib.closing(_native.StudyWork(os.fspath(study), os.fspath(folder))) as work:
        report = progress or _line
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
    if not pending:
        return
    if client is None:
        threads = os.cpu_count() or 1
        runner = _native.StudyRunner(os.fspath(study), threads)
        for some in _chunks(pending, 4 * threads):
            yield from zip(some, runner.run(some), strict=True)
        return
    source = _Source.read(study, files)
    threads = max(1, sum(client.nthreads().values()))
    size = min(MOST_SHARDS, max(1, len(pending) // (TASKS_PER_THREAD * threads)))
    tasks: dict[Future, list[int]] = {}
    try:
        for some in _chunks(pending, size):
            tasks[client.submit(_compute, source, some, pure=False, retries=retries)] = some
        while tasks:
            for future in _some_done(client, list(tasks), patience):
                if (records := _result(future)) is not None:
                    yield from zip(tasks.pop(future), records, strict=True)
    finally:
        client.cancel(list(tasks))


def _some_done(client: Client, futures: list[Future], patience: float) -> list[Future]:
    """Wait until a task has ended, however; give up when there is no worker for too long."""
    import distributed

    seen = time.monotonic()
    while True:
        try:
            return list(distributed.wait(futures, timeout=HEARTBEAT, return_when="FIRST_COMPLETED").done)
        except distributed.TimeoutError:
            if client.nthreads():
                seen = time.monotonic()
            elif time.monotonic() - seen > patience:
                message = f"no worker has been there for {patience:g} s"
                raise InputOutput(message, "Start workers and run again: what is done is kept.") from None
        except (CancelledError, OSError) as cause:
            raise InputOutput(f"the cluster is gone: {cause}", "Run again: what is done is kept.") from cause


def _result(future: Future) -> list[bytes] | None:
    """Return the records of a task that has ended; what it raised is raised here.

    None where they were lost with their worker: without any worker, nobody computes them again, and waiting would not end.
    """
    import distributed

    try:
        records: list[bytes] = future.result(timeout=HEARTBEAT)
    except distributed.TimeoutError:
        return None
    except distributed.KilledWorker as cause:
        message = f"a task ended with its worker again and again: {cause}"
        next_step = "See the logs of the workers; memory is the usual reason. What is done is kept: run again."
        raise HexbenchError(message, next_step) from cause
    except CancelledError as cause:
        raise InputOutput("the cluster is gone", "Run again: what is done is kept.") from cause
    future.release()
    return records


@dataclass(frozen=True)
class _Source:
    """A study with every file it names, as it travels to a worker."""

    #: Content by place, relative to a folder of the worker; `..` is resolved.
    files: dict[str, bytes]
    #: Place of the study file among them.
    study: str
    digest: str

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
        digest = hashlib.sha256()
        for to, content in sorted(files.items()):
            digest.update(f"{to}\0{len(content)}\0".encode() + content)
        return cls(files, place, digest.hexdigest())

    def runner(self, threads: int) -> _native.StudyRunner:
        """Write the files into a folder for a moment and read the study."""
        with tempfile.TemporaryDirectory(prefix="hexbench-") as folder:
            for to, content in self.files.items():
                path = Path(folder, to)
                path.parent.mkdir(parents=True, exist_ok=True)
                path.write_bytes(content)
            return _native.StudyRunner(os.fspath(Path(folder, self.study)), threads)


_runners: dict[tuple[str, int], _native.StudyRunner] = {}
_preparing = threading.Lock()


def _compute(source: _Source, shards: list[int]) -> list[bytes]:
    """Compute shards on a worker. The study is made ready once in a process; its tasks share the threads of the worker."""
    import distributed

    threads = distributed.get_worker().state.nthreads
    with _preparing:
        key = (source.digest, threads)
        if key not in _runners:
            # One study at a time runs in a process.
            _runners.clear()
            _runners[key] = source.runner(threads)
        runner = _runners[key]
    records: list[bytes] = runner.run(shards)
    return records


def _chunks(shards: list[int], size: int) -> Iterator[list[int]]:
    return (shards[at : at + size] for at in range(0, len(shards), size))


def _line(done: int, shards: int) -> None:
    """Show the progress on a terminal, and nowhere else."""
    if sys.stderr.isatty():
        end = "\n" if done == shards else ""
        print(f"\r{done} of {shards} shards", end=end, file=sys.stderr, flush=True)


def _results(said: dict[str, Any]) -> Results:
    return Results(folder=Path(said["folder"]), summary=said["summary"])


def _path(path: StrPath | None) -> str | None:
    return None if path is None else os.fspath(path)
