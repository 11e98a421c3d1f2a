"""Time and peak memory of one study on one process, on two, and on a Dask cluster; all must give the same bytes.

    scripts/study_times.sh [STUDY]          writes docs/results/cluster-times.md
"""

from __future__ import annotations

import hashlib
import os
import shutil
import statistics
import subprocess
import sys
import tempfile
import threading
import time
from dataclasses import dataclass, field
from pathlib import Path

import distributed
from hexbench import study

ONE = "one process"
RESULTS = ["trials.parquet", "cells.csv", "study.md"]
WORKERS = 2
#: Rounds over all ways; the page tells the median time and the largest memory.
ROUNDS = 3


@dataclass
class Run:
    """What a way of running took: s, and the peak memory of every process, MB."""

    name: str
    seconds: float
    memory: dict[str, float]
    folder: Path
    digest: str = field(init=False)

    def __post_init__(self) -> None:
        """Take the digest of the results."""
        content = b"".join((self.folder / name).read_bytes() for name in RESULTS)
        self.digest = hashlib.sha256(content).hexdigest()[:12]


def peak(pid: int) -> float:
    """Return the largest resident set that a process has had, MB."""
    lines = Path(f"/proc/{pid}/status").read_text().splitlines()
    return next(int(line.split()[1]) for line in lines if line.startswith("VmHWM")) / 1024


class Watch:
    """Reads the peaks of processes until they end."""

    def __init__(self, processes: dict[str, int]) -> None:
        self.processes = processes
        self.peaks = dict.fromkeys(processes, 0.0)
        self.over = threading.Event()
        self.thread = threading.Thread(target=self._look, daemon=True)
        self.thread.start()

    def _look(self) -> None:
        while not self.over.wait(0.05):
            for name, pid in self.processes.items():
                try:
                    self.peaks[name] = max(self.peaks[name], peak(pid))
                except (OSError, StopIteration):
                    continue

    def end(self) -> dict[str, float]:
        """Stop and return the peaks."""
        self.over.set()
        self.thread.join()
        return self.peaks


def together(commands: dict[str, list[str]]) -> tuple[float, dict[str, float]]:
    """Run commands side by side, each on one thread."""
    alone = {**os.environ, "RAYON_NUM_THREADS": "1"}
    start = time.perf_counter()
    started = {name: subprocess.Popen(words, env=alone, stdout=subprocess.DEVNULL) for name, words in commands.items()}
    watch = Watch({name: process.pid for name, process in started.items()})
    for name, process in started.items():
        if process.wait() != 0:
            sys.exit(f"{name} ended with {process.returncode}")
    return time.perf_counter() - start, watch.end()


def one(program: str, path: Path, folder: Path) -> Run:
    """Run the whole study in one process."""
    words = [program, "study", str(path), "-o", str(folder)]
    seconds, memory = together({"process": words})
    return Run(ONE, seconds, memory, folder)


def two(program: str, path: Path, folder: Path) -> Run:
    """Run two parts side by side, then merge them."""
    parts = {f"part {n}": folder.with_name(f"part-{n}") for n in (1, 2)}
    commands = {
        name: [program, "study", "run", str(path), "-o", str(part), "--shard", f"{name[-1]}/2"]
        for name, part in parts.items()
    }
    seconds, memory = together(commands)
    merge = [program, "study", "merge", str(path), *map(str, parts.values()), "-o", str(folder)]
    merging, of_merge = together({"merge": merge})
    return Run("two processes, then merge", seconds + merging, memory | of_merge, folder)


def cluster(path: Path, folder: Path) -> Run:
    """Two workers of one thread; the time begins when they are there."""
    local = distributed.LocalCluster(
        n_workers=WORKERS, threads_per_worker=1, processes=True, host="127.0.0.1", dashboard_address=None
    )
    with local, distributed.Client(local) as client:
        client.wait_for_workers(WORKERS)
        pids = client.run(os.getpid)
        names = {f"worker {n}": pid for n, pid in enumerate(pids.values(), start=1)}
        watch = Watch(names | {"caller and scheduler": os.getpid()})
        start = time.perf_counter()
        study.run(client, path, folder)
        seconds = time.perf_counter() - start
        memory = watch.end()
    return Run("Dask, two workers", seconds, memory, folder)


def row(runs: list[Run], alone: float) -> str:
    """Return a row of the table from the rounds of one way; `alone` is the time of one process, s."""
    seconds = [run.seconds for run in runs]
    middle = statistics.median(seconds)
    ideal = alone if runs[0].name == ONE else alone / 2
    memory = ", ".join(f"{name} {max(run.memory[name] for run in runs):.0f}" for name in runs[0].memory)
    spread = f"{min(seconds):.1f} .. {max(seconds):.1f}"
    return f"| {runs[0].name} | {middle:.1f} ({spread}) | {middle / ideal:.2f} | {memory} | `{runs[0].digest}` |"


def document(path: Path, ways: list[list[Run]]) -> str:
    """Return the page; results that differ end the program."""
    if len({run.digest for runs in ways for run in runs}) > 1:
        sys.exit(f"the results differ: {[[run.digest for run in runs] for runs in ways]}")
    trials = study.plan(path)["trials"]
    alone = statistics.median(run.seconds for run in ways[0])
    lines = [
        "# One study on one process, on two, and on a cluster",
        "",
        "Written by `scripts/study_times.sh`; do not edit.",
        "",
        f"`{path}`, {trials} trials, every process and every worker on one thread, {os.cpu_count()} cores:",
        f"median (least .. most) of {ROUNDS} rounds, with reading the study and writing the results.",
        "The ideal of two is half the time of one; a few percent are the machine's. Memory is the peak of the resident set.",
        "",
        "| | time, s | of the ideal | peak memory, MB | SHA-256 of the results |",
        "|---|---:|---:|---|---|",
        *(row(runs, alone) for runs in ways),
        "",
        "All results of all rounds are the same bytes.",
        "",
    ]
    return "\n".join(lines)


def main() -> None:
    """Measure all ways in turn and write the page."""
    path, program, target = Path(sys.argv[1]), sys.argv[2], Path(sys.argv[3])
    scratch = Path(tempfile.mkdtemp(prefix="hexbench-study-"))
    runs: list[list[Run]] = [[], [], []]
    try:
        for number in range(ROUNDS):
            folder = scratch / str(number)
            (folder / "two").mkdir(parents=True)
            runs[0].append(one(program, path, folder / "one"))
            runs[1].append(two(program, path, folder / "two" / "whole"))
            runs[2].append(cluster(path, folder / "dask"))
        target.write_text(document(path, runs))
    finally:
        shutil.rmtree(scratch)
    print(target.read_text())


if __name__ == "__main__":
    main()
