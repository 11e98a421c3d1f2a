"""Cases of a challenge, answered by workers of a Dask cluster, with a function sent to them or a program there."""

from __future__ import annotations

import time
from collections.abc import Iterator
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import TYPE_CHECKING, Any

from hexbench import _native
from hexbench._cluster import Files, results

if TYPE_CHECKING:
    from distributed import Client

    from hexbench.entrants import Algorithm

#: A program with arguments, what it depends on, its limits, the digest of its files.
_Program = tuple[list[str], list[Path], tuple[float, int, int], str]


class OnCluster:
    """Cases sent to the workers at the start of a run; each answer is awaited when it is needed."""

    def __init__(self, client: Client, algorithm: Algorithm | None, retries: int, patience: float) -> None:
        """Take a function; without one, the program of the run is answered by."""
        self._client = client
        self._algorithm = None if algorithm is None else _pickled(algorithm)
        self._retries = retries
        self._patience = patience
        self._waiting: Iterator[int] = iter(())
        self._done: dict[int, bytes] = {}
        self._answers: Iterator[tuple[int, Any]] = iter(())

    def begin(self, cases: list[Path], program: _Program) -> None:
        """Send all cases."""
        self._done = {}
        self._waiting = iter(range(len(cases)))
        calls = [(number, self._call(Files.of_folder(case), program)) for number, case in enumerate(cases)]
        self._answers = results(self._client, calls, self._retries, self._patience)

    def answer(self, _case: Path, _answer: Path) -> bytes:
        """Wait for the answer of the next case."""
        number = next(self._waiting)
        while number not in self._done:
            key, answer = next(self._answers)
            self._done[key] = answer
        return self._done.pop(number)

    def _call(self, case: Files, program: _Program) -> tuple[Any, ...]:
        if self._algorithm is None:
            return (_by_program, case, program)
        return (_by_function, case, self._algorithm)


def _by_program(case: Files, program: _Program) -> bytes:
    """Run a program over a case on a worker, under its limits."""
    with TemporaryDirectory(prefix="hexbench-case-of-cluster-") as folder:
        case.unpack(Path(folder))
        return _native.answer_case(folder, program)


def _pickled(algorithm: Algorithm) -> bytes:
    """Return a function with what it is made of, where its module says so or cannot be imported."""
    import cloudpickle

    return bytes(cloudpickle.dumps(algorithm))


def _by_function(case: Files, pickled: bytes) -> bytes:
    """Let a function answer a case on a worker."""
    import pickle

    from hexbench.entrants import Case

    algorithm = pickle.loads(pickled)

    with TemporaryDirectory(prefix="hexbench-case-of-cluster-") as folder:
        public, out = Path(folder) / "case", Path(folder) / "out"
        public.mkdir()
        out.mkdir()
        case.unpack(public)
        begun, said = time.perf_counter(), None
        try:
            seen = Case(public)
            algorithm(seen).write(seen, out)
        except Exception as wrong:  # What it raises is the failure of this case.
            said = f"{type(wrong).__qualname__}: {wrong}"
        return _native.answer_of_function(str(out), said, time.perf_counter() - begun)
