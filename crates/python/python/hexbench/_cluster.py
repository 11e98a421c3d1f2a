"""Shards of experiments on a Dask cluster: sent out, collected, and retried if a worker is killed."""

from __future__ import annotations

import hashlib
import shutil
import sys
import tempfile
import threading
import time
import weakref
from collections.abc import Callable, Generator, Iterable, Iterator
from concurrent.futures import CancelledError
from contextlib import closing
from dataclasses import dataclass, field
from pathlib import Path
from typing import TYPE_CHECKING, Any, Protocol, TypeVar

from hexbench.errors import HexbenchError, InputOutput

if TYPE_CHECKING:
    from distributed import Client, Future

    from hexbench import _native

K = TypeVar("K")
T = TypeVar("T")

#: Tasks that every thread of a cluster gets: enough to even out unequal shards, few enough to cost nothing.
TASKS_PER_THREAD = 8
#: Most shards of a task: its records travel and wait in memory together.
MOST_SHARDS = 64
#: How often the cluster is asked whether anybody is still there, s.
HEARTBEAT = 5.0


class Source(Protocol):
    """An experiment as it travels to a worker."""

    @property
    def digest(self) -> str:
        """Whether a worker has it ready."""

    def ready(self, threads: int) -> Ready:
        """Make it ready on so many threads."""


@dataclass(frozen=True)
class Files:
    """Files as they travel: content by place, relative to a folder of the worker."""

    content: dict[str, bytes]
    digest: str = field(init=False)

    def __post_init__(self) -> None:
        """Say what is in them."""
        digest = hashlib.sha256()
        for to, content in sorted(self.content.items()):
            digest.update(f"{to}\0{len(content)}\0".encode() + content)
        object.__setattr__(self, "digest", digest.hexdigest())

    @classmethod
    def of_folder(cls, folder: Path) -> Files:
        """Read all files of a folder."""
        files = sorted(path for path in folder.rglob("*") if path.is_file())
        return cls({path.relative_to(folder).as_posix(): path.read_bytes() for path in files})

    def unpack(self, folder: Path) -> None:
        """Write them into a folder."""
        for to, content in self.content.items():
            path = folder / to
            path.parent.mkdir(parents=True, exist_ok=True)
            path.write_bytes(content)


class Ready:
    """An experiment with copies of its files, which are deleted when it is no longer needed."""

    def __init__(self, files: Files, read: Callable[[Path], _native.ShardRunner]) -> None:
        """Write the files into a folder of their own and read the experiment."""
        folder = Path(tempfile.mkdtemp(prefix="hexbench-"))
        weakref.finalize(self, shutil.rmtree, folder, ignore_errors=True)
        files.unpack(folder)
        self.runner = read(folder)


def records(client: Client, source: Source, pending: list[int], retries: int, patience: float) -> Generator[tuple[int, bytes]]:
    """Yield the number and the record of every pending shard, in the order in which they are done."""
    if not pending:
        return
    threads = max(1, sum(client.nthreads().values()))
    size = min(MOST_SHARDS, max(1, len(pending) // (TASKS_PER_THREAD * threads)))
    calls = [(some, (compute, source, some)) for some in chunks(pending, size)]
    with closing(results(client, calls, retries, patience)) as done:
        for some, found in done:
            yield from zip(some, found, strict=True)


def results(
    client: Client, calls: Iterable[tuple[K, tuple[Any, ...]]], retries: int, patience: float
) -> Generator[tuple[K, Any]]:
    """Make calls, each a function with its arguments, on the workers; yield their results as soon as they arrive."""
    tasks: dict[Future, K] = {}
    try:
        for key, (function, *arguments) in calls:
            tasks[client.submit(function, *arguments, pure=False, retries=retries)] = key
        while tasks:
            for future in some_done(client, list(tasks), patience):
                if (found := _result(future)) is not None:
                    yield tasks.pop(future), found
    finally:
        client.cancel(list(tasks))


def some_done(client: Client, futures: list[Future], patience: float) -> list[Future]:
    """Wait until a task has ended, successfully or not; give up if there is no worker for too long."""
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
                raise InputOutput(message, "Start workers and run again; finished work is saved.") from None
        except (CancelledError, OSError) as cause:
            raise InputOutput(f"the cluster is gone: {cause}", "Run again; finished work is saved.") from cause


def _result(future: Future) -> Any:
    """Return the result of a finished task, or raise what it raised.

    None where it was lost with its worker: without any worker, nobody computes it again, and waiting would not end.
    """
    import distributed

    try:
        found = future.result(timeout=HEARTBEAT)
    except distributed.TimeoutError:
        return None
    except distributed.KilledWorker as cause:
        message = f"a task ended with its worker again and again: {cause}"
        next_step = "See the logs of the workers; memory is the usual reason. What is done is kept: run again."
        raise HexbenchError(message, next_step) from cause
    except CancelledError as cause:
        raise InputOutput("the cluster is gone", "Run again; finished work is saved.") from cause
    future.release()
    return found


_all_ready: dict[tuple[str, int], Ready] = {}
_preparing = threading.Lock()


def compute(source: Source, shards: list[int]) -> list[bytes]:
    """Compute shards on a worker. The experiment is made ready once in a process; its tasks share the threads of the worker."""
    import distributed

    threads = distributed.get_worker().state.nthreads
    with _preparing:
        key = (source.digest, threads)
        if key not in _all_ready:
            # One experiment at a time runs in a process.
            _all_ready.clear()
            _all_ready[key] = source.ready(threads)
        ready = _all_ready[key]
    return ready.runner.run(shards)


def chunks(all_: list[T], size: int) -> Iterator[list[T]]:
    """Return the items in lists of limited length."""
    return (all_[at : at + size] for at in range(0, len(all_), size))


def line(what: str) -> Callable[[int, int], None]:
    """Return a progress display for terminals; elsewhere it shows nothing."""

    def shown(done: int, of: int) -> None:
        if sys.stderr.isatty():
            end = "\n" if done == of else ""
            print(f"\r{done} of {of} {what}", end=end, file=sys.stderr, flush=True)

    return shown
