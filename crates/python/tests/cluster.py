"""A Dask cluster on loopback: a scheduler and workers, processes of their own."""

from __future__ import annotations

import subprocess
import sys
import time
from collections.abc import Callable
from pathlib import Path


class Cluster:
    """A scheduler and workers on loopback; everything ends with the test."""

    def __init__(self, folder: Path) -> None:
        import distributed

        self.folder = folder
        self.workers: list[subprocess.Popen[bytes]] = []
        address = folder / "scheduler.json"
        self.scheduler = self._start(
            "scheduler", "--host", "127.0.0.1", "--port", "0", "--no-dashboard", "--scheduler-file", str(address)
        )
        wait_until(address.is_file, "the scheduler tells its address")
        self.client = distributed.Client(scheduler_file=str(address), timeout=60)

    def _start(self, what: str, *arguments: str) -> subprocess.Popen[bytes]:
        # A file, not a pipe: nobody reads while the test goes on.
        log = (self.folder / f"{what}-{len(self.workers)}.log").open("wb")
        command = [sys.executable, "-m", "distributed.cli.dask_" + what, *arguments]
        return subprocess.Popen(command, stdout=log, stderr=log, cwd=self.folder)

    def add_worker(self) -> subprocess.Popen[bytes]:
        """Start a worker of one thread, with nobody to start it again."""
        name = f"worker-{len(self.workers)}"
        local = self.folder / name
        more = ["--nthreads", "1", "--no-nanny", "--no-dashboard", "--name", name, "--local-directory", str(local)]
        worker = self._start("worker", self.client.scheduler.address, *more)
        self.workers.append(worker)
        self.client.wait_for_workers(len([w for w in self.workers if w.poll() is None]), timeout=60)
        return worker

    def close(self) -> None:
        self.client.close()
        for process in [*self.workers, self.scheduler]:
            process.kill()
            process.wait()


def wait_until(true: Callable[[], bool], what: str) -> None:
    end = time.monotonic() + 60
    while not true():
        assert time.monotonic() < end, f"waited for a minute until {what}"
        time.sleep(0.02)
