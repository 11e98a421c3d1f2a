"""Experiments of commands on a Dask cluster on loopback: a scheduler and two workers, processes of their own."""

from __future__ import annotations

import functools
import signal
import threading
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest
from cluster import Cluster, wait_until
from conftest import CASES, SCENES

from hexbench import _native, commands, errors, experiment

pytest.importorskip("distributed")

#: One of each kind: a protocol, several in one command, trials that depend on files, trials that another experiment decides.
COMMANDS: dict[str, tuple[list[object], dict[str, Any]]] = {
    "robustness": (["validate", "robustness"], {"trials": 1, "fault": "drift-1", "out": "files"}),
    "sensors": (["validate", "sensors"], {"trials": 1, "alike": 1, "out": "files"}),
    "recovery": (["validate", "recovery"], {"campaigns": 4, "diagnoses": 0, "json": "all.json"}),
    "calibration": (["validate", "calibration"], {"trials": 7, "out": "files"}),
    "discover": (["validate", "discover"], {"outside": 1, "listed": 1, "clean": 1, "out": "files"}),
    "discriminate": (["validate", "discriminate"], {"trials": 1, "markdown": "page.md"}),
    "misread": (
        ["validate", "misread"],
        {"trials": 1, "sound": 2, "misstatement": "fz-negated", "scenes": SCENES / "cubic", "out": "files"},
    ),
    "power": (
        ["power", SCENES / "paper" / "hexapod.toml", CASES / "paper-protocol" / "measurements.csv"],
        {"simulate": 3, "effect": "joint-friction", "sigma": "0.5,3", "json": "all.json"},
    ),
    "regress": (["regress"], {"quick": True, "update": True, "reason": "shared", "runs": 1, "baseline": "all.json"}),
}  # fmt: skip


#: What a command gives without a cluster.
Alone = Callable[[str], tuple[str, Any]]


def files_in(folder: Path) -> dict[str, bytes]:
    """Return what a command has written, without journals."""
    written = [path for path in folder.rglob("*") if path.is_file() and "kept" not in path.parts]
    return {str(path.relative_to(folder)): path.read_bytes() for path in written}


@pytest.fixture(scope="module")
def alone(tmp_path_factory: pytest.TempPathFactory) -> Alone:
    """What a command gives without a cluster; each is run once."""

    @functools.cache
    def ran(name: str) -> tuple[str, Any]:
        with pytest.MonkeyPatch.context() as monkeypatch:
            return run(name, tmp_path_factory.mktemp(name) / "here", None, monkeypatch)

    return ran


def run(name: str, folder: Path, cluster: Cluster | None, monkeypatch: pytest.MonkeyPatch, **more: Any) -> tuple[str, Any]:
    """Run a command in a folder of its own, whose name stands in no file; on a cluster where there is one."""
    words, options = COMMANDS[name]
    folder.mkdir()
    monkeypatch.chdir(folder)
    if cluster is None:
        said = commands.command(*words, **options)
    else:
        said = experiment.run(cluster.client, *words, **options, journal="kept", **more)
    return said.text, files_in(folder)


@pytest.mark.parametrize("name", COMMANDS)
def test_every_experiment_gives_the_bytes_of_one_machine(
    name: str, cluster: Cluster, alone: Alone, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    told: list[tuple[int, int]] = []
    there = run(name, tmp_path / "there", cluster, monkeypatch, progress=lambda *at: told.append(at))
    assert there == alone(name)
    shards = told[-1][1]
    assert told == [(n, shards) for n in range(shards + 1)] and shards > 0


def test_a_worker_that_is_killed_changes_nothing(
    cluster: Cluster, alone: Alone, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    killed = threading.Event()

    def kill_one(done: int, _: int) -> None:
        if done >= 2 and not killed.is_set():
            cluster.workers[0].send_signal(signal.SIGKILL)
            killed.set()

    there = run("sensors", tmp_path / "there", cluster, monkeypatch, progress=kill_one)
    assert killed.is_set() and cluster.workers[0].wait() == -signal.SIGKILL
    wait_until(lambda: len(cluster.client.nthreads()) == 1, "the scheduler misses the worker")
    assert there == alone("sensors")


def test_a_run_that_was_stopped_is_finished_by_the_command_itself(
    cluster: Cluster, alone: Alone, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    class Stop(Exception):
        pass

    def stop(done: int, _: int) -> None:
        if done == 2:
            raise Stop

    with pytest.raises(Stop):
        run("sensors", tmp_path / "stopped", cluster, monkeypatch, progress=stop)
    kept = {path: path.stat().st_mtime_ns for path in (tmp_path / "stopped").rglob("*.shard")}
    assert len(kept) == 2
    words, options = COMMANDS["sensors"]
    said = commands.command(*words, **options, journal="kept")
    assert {path: path.stat().st_mtime_ns for path in kept} == kept
    assert (said.text, files_in(tmp_path / "stopped")) == alone("sensors")


def test_without_a_journal_or_an_experiment_nothing_is_sent(cluster: Cluster) -> None:
    with pytest.raises(errors.UsageError, match="no journal"):
        experiment.run(cluster.client, "validate", "recovery")
    with pytest.raises(errors.UsageError, match="no experiment"):
        experiment.run(cluster.client, "terms")


def test_records_are_kept_only_where_they_belong(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)
    words = ["validate", "sensors", "--trials=1", "--alike=1", "--out=files", "--journal=kept"]
    [record] = _native.ShardRunner.of_command(words, [], 1, 1).run([0])
    work = _native.ExperimentWork(words)
    with pytest.raises(errors.BadInput, match="shard 0"):
        work.keep(0, 0, record)
    work.keep(1, 0, record)
    with pytest.raises(errors.UsageError, match="no experiment 2"):
        work.keep(2, 0, record)
    work.close()
    with pytest.raises(errors.UsageError, match="closed"):
        work.todo()
