"""Time and peak memory of one study: one process, two processes, and a Dask cluster of two workers; all must give the same bytes.

    scripts/study_times.sh [STUDY]          writes docs/study-times.md
"""

from __future__ import annotations

import hashlib
import os
import shutil
import subprocess
import sys
import tempfile
import threading
import time
from collections.abc import Callable
from dataclasses import dataclass, field
from pathlib import Path

import distributed

from hexbench import study

RESULTS = ["trials.parquet", "cells.csv", "study.md"]
WORKERS = 2


@dataclass
class Run:
    """What a way of running took: s, and the peak memory of every process, MB."""

    name: str
    seconds: float
    memory: dict[str, float]
    folder: Path
    merge: float = 0.0
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
    words = [program, "study", str(path), "-o", str(folder)]
    seconds, memory = together({"process": words})
    return Run("one process", seconds, memory, folder)


def two(program: str, path: Path, folder: Path) -> Run:
    parts = {f"part {n}": folder.with_name(f"part-{n}") for n in (1, 2)}
    commands = {
        name: [program, "study", "run", str(path), "-o", str(part), "--shard", f"{name[-1]}/2"]
        for name, part in parts.items()
    }
    seconds, memory = together(commands)
    merge = [program, "study", "merge", str(path), *map(str, parts.values()), "-o", str(folder)]
    merging, of_merge = together({"merge": merge})
    return Run("two processes, then merge", seconds + merging, memory | of_merge, folder, merging)


def cluster(path: Path, folder: Path) -> Run:
    """Two workers of one thread; the time begins when they are there."""
    local = distributed.LocalCluster(
        n_workers=WORKERS, threads_per_worker=1, processes=True, host="127.0.0.1", dashboard_address=None
    )
    with local, distributed.Client(local) as client:
        client.wait_for_workers(WORKERS)
        pids = client.run(os.getpid)
        names = {f"worker {n}": pid for n, pid in enumerate(pids.values(), start=1)}
        before = {name: peak(pid) for name, pid in names.items()}
        watch = Watch(names | {"caller and scheduler": os.getpid()})
        start = time.perf_counter()
        study.run(client, path, folder)
        seconds = time.perf_counter() - start
        memory = watch.end()
    idle = ", ".join(f"{mb:.0f}" for mb in before.values())
    return Run(f"Dask, two workers (idle: {idle} MB)", seconds, memory, folder)


def row(run: Run, alone: float) -> str:
    ideal = alone if run.name == "one process" else alone / 2
    memory = ", ".join(f"{name} {mb:.0f}" for name, mb in run.memory.items())
    return f"| {run.name} | {run.seconds:.1f} | {run.seconds / ideal:.2f} | {memory} | `{run.digest}` |"


def document(path: Path, runs: list[Run]) -> str:
    trials = study.plan(path)["trials"]
    alone = runs[0].seconds
    same = len({run.digest for run in runs}) == 1
    lines = [
        "# One study on one process, on two, and on a cluster",
        "",
        f"`{path}`, {trials} trials, every process and every worker on one thread, {os.cpu_count()} cores. Written by",
        "`scripts/study_times.sh`. Times include reading the study, finding its designed plans (in every process) and writing the",
        "results. The ideal of two is half the time of one. Memory is the peak of the resident set.",
        "",
        "| | time, s | of the ideal | peak memory, MB | SHA-256 of the results |",
        "|---|---:|---:|---|---|",
        *(row(run, alone) for run in runs),
        "",
        "All results are the same bytes." if same else "**The results differ.**",
        "",
    ]
    if not same:
        print("\n".join(lines))
        sys.exit("the results differ")
    return "\n".join(lines)


def main() -> None:
    path, program, target = Path(sys.argv[1]), sys.argv[2], Path(sys.argv[3])
    scratch = Path(tempfile.mkdtemp(prefix="hexbench-study-"))
    ways: list[Callable[[], Run]] = [
        lambda: one(program, path, scratch / "one"),
        lambda: two(program, path, scratch / "two" / "whole"),
        lambda: cluster(path, scratch / "dask"),
    ]
    (scratch / "two").mkdir()
    try:
        target.write_text(document(path, [way() for way in ways]))
    finally:
        shutil.rmtree(scratch)
    print(target.read_text())


if __name__ == "__main__":
    main()
