"""Experiments on a Dask cluster: every command with ``--journal``, with the same files as on one machine.

An experiment is a list of shards, whatever it is about: a shard depends only on the words of the command, on the files they
name and on its number. The results are therefore the same bytes on one thread, on many machines, after an interruption, or
after a worker was killed::

    from dask.distributed import Client
    from hexbench import experiment

    with Client("tcp://scheduler:8786") as client:
        said = experiment.run(client, "validate", "robustness", trials=100, out="robustness", journal="trials")
    print(said)

The workers need the package ``hexbench`` in the same version, and nothing else. Studies have their own functions:
:mod:`hexbench.study`.
"""

from __future__ import annotations

import contextlib
import hashlib
from dataclasses import dataclass
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import TYPE_CHECKING, Any

from hexbench import _native
from hexbench._cluster import Files, Ready, line, records
from hexbench.commands import Outcome, _options, _word

if TYPE_CHECKING:
    from collections.abc import Callable, Sequence

    from distributed import Client

__all__ = ["run"]


def run(
    client: Client | None,
    *words: object,
    retries: int = 3,
    patience: float = 600.0,
    progress: Callable[[int, int], None] | None = None,
    **options: Any,
) -> Outcome:
    """Compute the trials of a command on a Dask cluster, then run the command here on the saved records.

    Every shard that arrives is saved in the folder ``journal``. After an interruption, the same call, or the command itself,
    resumes the run. If a worker is killed, another one repeats its task.

    Args:
        client: client of a cluster whose workers have this version of hexbench; None computes on this machine's threads.
        *words: name of the command, then its files: ``"validate", "calibration"`` and the like, ``"regress"``, ``"power"``.
        retries: how often a failed task is retried.
        patience: seconds without any worker after which the run stops.
        progress: called with the number of finished shards and of all shards; by default a line on a terminal.
        **options: options under the names of the command line, including ``journal``; files and folders that trials depend on
        are sent to the workers.

    Raises:
        UsageError: not a command with experiments, or no ``journal``.
        BadInput: a file cannot be used, or the folder belongs to another experiment.
        InputOutput: the folder cannot be written, the cluster is gone, or there was no worker for too long.
    """
    with TemporaryDirectory() as folder:
        place = Path(folder)
        command = [*(_word(word, place) for word in words), *_options(options, place)]
        if client is not None:
            _compute(client, command, retries, patience, progress or line("shards"))
        text, passed = _native.command(command)
    return Outcome(text, None, passed)


def _compute(client: Client, command: list[str], retries: int, patience: float, report: Callable[[int, int], None]) -> None:
    """Compute on the cluster the shards that the journals lack."""
    with contextlib.closing(_native.ExperimentWork(command)) as work:
        todo = work.todo()
        shards = sum(one["shards"] for one in todo)
        done = shards - sum(len(one["pending_shards"]) for one in todo)
        report(done, shards)
        for which, one in enumerate(todo):
            source = _Source.of(command, work.files, which)
            with contextlib.closing(records(client, source, one["pending_shards"], retries, patience)) as found:
                for number, record in found:
                    work.keep(which, number, record)
                    done += 1
                    report(done, shards)


@dataclass(frozen=True)
class _Source:
    """An experiment of a command, with every file that its trials depend on, as it travels to a worker."""

    command: tuple[str, ...]
    which: int
    files: Files
    #: Places of what the command names, in its order.
    places: tuple[str, ...]

    @classmethod
    def of(cls, command: list[str], named: Sequence[Path], which: int) -> _Source:
        content: dict[str, bytes] = {}
        places = []
        for number, path in enumerate(named):
            # The name of a folder is that of its scene.
            place = f"{number}/{path.resolve().name}"
            places.append(place)
            if path.is_dir():
                content |= {f"{place}/{name}": data for name, data in Files.of_folder(path).content.items()}
            else:
                content[place] = path.read_bytes()
        return cls(tuple(command), which, Files(content), tuple(places))

    @property
    def digest(self) -> str:
        words = "\0".join([*self.command, str(self.which), self.files.digest])
        return hashlib.sha256(words.encode()).hexdigest()

    def ready(self, threads: int) -> Ready:
        def read(folder: Path) -> _native.ShardRunner:
            files = [str(folder / place) for place in self.places]
            return _native.ShardRunner.of_command(self.command, files, self.which, threads)

        return Ready(self.files, read)
