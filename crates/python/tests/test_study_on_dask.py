"""A study on a Dask cluster on loopback: a scheduler and two workers, processes of their own."""

from __future__ import annotations

import signal
import threading
from pathlib import Path
from typing import Any

import pytest
from cluster import Cluster, wait_until
from conftest import SCENES

from hexbench import _cluster, errors, study

pytest.importorskip("distributed")

RESULTS = ["trials.parquet", "cells.csv", "study.md"]
# A machine of the user's own: a file beside the study that has to travel with it.
STUDY = """
format = "study/1"
title = "springs on a cluster"
seed = 5
trials = 2900
task = "springs"
[axes]
geometry = ["../machines/own.toml", "ring_a"]
plan = ["random"]
poses = [3, 6]
noise_scale = [1, 2]
"""


def written(folder: Path) -> Path:
    """Write a study whose machine is in another folder."""
    for name in ["machines", "studies"]:
        (folder / name).mkdir()
    (folder / "machines" / "own.toml").write_bytes((SCENES / "paper" / "hexapod.toml").read_bytes())
    path = folder / "studies" / "study.toml"
    path.write_text(STUDY)
    return path


@pytest.fixture
def study_file(tmp_path: Path) -> Path:
    """Return a study of 24 shards."""
    return written(tmp_path)


@pytest.fixture(scope="module")
def here(tmp_path_factory: pytest.TempPathFactory) -> dict[str, bytes]:
    """Return the results of this machine."""
    folder = tmp_path_factory.mktemp("here")
    return bytes_of(study.run(None, written(folder), folder / "results").folder)


def bytes_of(folder: Path) -> dict[str, bytes]:
    return {name: (folder / name).read_bytes() for name in RESULTS}


def test_two_workers_give_the_bytes_of_one_machine(
    cluster: Cluster, study_file: Path, here: dict[str, bytes], tmp_path: Path
) -> None:
    told: list[tuple[int, int]] = []
    done = study.run(cluster.client, study_file, tmp_path / "dask", progress=lambda *at: told.append(at))
    assert bytes_of(done.folder) == here
    shards = study.plan(study_file)["shards"]
    assert told == [(n, shards) for n in range(shards + 1)]
    assert "cells" in done.summary


def test_a_worker_that_is_killed_changes_nothing(
    cluster: Cluster, study_file: Path, here: dict[str, bytes], tmp_path: Path
) -> None:
    killed = threading.Event()

    def kill_one(done: int, _: int) -> None:
        if done >= 5 and not killed.is_set():
            cluster.workers[0].send_signal(signal.SIGKILL)
            killed.set()

    done = study.run(cluster.client, study_file, tmp_path / "dask", progress=kill_one)
    assert killed.is_set()
    assert cluster.workers[0].wait() == -signal.SIGKILL
    wait_until(lambda: len(cluster.client.nthreads()) == 1, "the scheduler misses the worker")
    assert bytes_of(done.folder) == here


def test_a_run_that_was_stopped_goes_on_and_computes_nothing_twice(
    cluster: Cluster, study_file: Path, here: dict[str, bytes], tmp_path: Path
) -> None:
    class Stop(Exception):
        pass

    def stop(done: int, _: int) -> None:
        if done == 7:
            raise Stop

    with pytest.raises(Stop):
        study.run(cluster.client, study_file, tmp_path / "dask", progress=stop)
    records = tmp_path / "dask" / "journal"
    before = {path.name: path.stat().st_mtime_ns for path in records.glob("*.shard")}
    assert len(before) == 7
    told: list[int] = []
    done = study.run(cluster.client, study_file, tmp_path / "dask", progress=lambda n, _: told.append(n))
    assert told[0] == 7
    after = {path.name: path.stat().st_mtime_ns for path in records.glob("*.shard")}
    assert all(after[name] == when for name, when in before.items())
    assert bytes_of(done.folder) == here


def test_without_workers_the_run_gives_up_and_keeps_what_is_done(
    cluster: Cluster, study_file: Path, here: dict[str, bytes], tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(_cluster, "HEARTBEAT", 0.2)

    def kill_all(done: int, _: int) -> None:
        if done == 5:
            for worker in cluster.workers:
                worker.kill()

    with pytest.raises(errors.InputOutput, match="no worker") as raised:
        study.run(cluster.client, study_file, tmp_path / "dask", progress=kill_all, patience=1)
    assert "saved" in raised.value.next_step
    cluster.add_worker()
    told: list[int] = []
    done = study.run(cluster.client, study_file, tmp_path / "dask", progress=lambda n, _: told.append(n))
    assert told[0] >= 5
    assert bytes_of(done.folder) == here


def test_records_that_are_lost_with_the_last_worker_do_not_hold_the_run(
    cluster: Cluster, study_file: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(_cluster, "HEARTBEAT", 0.2)
    some_done = _cluster.some_done

    def done_and_lost(client: Any, futures: list[Any], patience: float) -> list[Any]:
        ended = some_done(client, futures, patience)
        for worker in cluster.workers:
            worker.kill()
        wait_until(lambda: not cluster.client.nthreads(), "the scheduler misses the workers")
        return ended

    monkeypatch.setattr(_cluster, "some_done", done_and_lost)
    with pytest.raises(errors.InputOutput, match="no worker"):
        study.run(cluster.client, study_file, tmp_path / "dask", patience=1)


def test_an_error_of_a_worker_reaches_the_caller_with_its_text(
    cluster: Cluster, study_file: Path, tmp_path: Path
) -> None:
    # The worker reads another machine than the caller: a file that changed in between.
    source = study._Source.read(study_file, study.plan(study_file)["files"])
    broken = study._Source(_cluster.Files({**source.files.content, source.study: b"format = 1"}), source.study)
    future = cluster.client.submit(_cluster.compute, broken, [0], pure=False)
    with pytest.raises(errors.BadInput, match="format"):
        future.result()


def test_a_file_named_absolutely_is_refused_before_anything_is_sent(
    cluster: Cluster, study_file: Path, tmp_path: Path
) -> None:
    machine = (SCENES / "paper" / "hexapod.toml").resolve()
    study_file.write_text(STUDY.replace("../machines/own.toml", machine.as_posix()))
    with pytest.raises(errors.UsageError, match="absolute"):
        study.run(cluster.client, study_file, tmp_path / "dask")


def test_a_record_that_was_changed_on_the_way_is_not_kept(study_file: Path, tmp_path: Path) -> None:
    from hexbench import _native

    runner = _native.ShardRunner.of_study(str(study_file), 1)
    work = _native.StudyWork(str(study_file), str(tmp_path / "whole"))
    [record] = runner.run([3])
    changed = bytearray(record)
    changed[100] ^= 1
    for wrong, number in [(bytes(changed), 3), (record[:-1], 3), (record, 4), (record, 10**9), (b"", 3)]:
        with pytest.raises(errors.BadInput, match=f"shard {number}"):
            work.keep(number, wrong)
    work.keep(3, record)
    work.keep(3, record)
    assert 3 not in work.todo()["pending_shards"]


def test_here_parts_and_merge_give_the_same(study_file: Path, here: dict[str, bytes], tmp_path: Path) -> None:
    parts = [tmp_path / f"part-{n}" for n in (1, 2, 3)]
    for n, folder in enumerate(parts, start=1):
        study.run_part(study_file, f"{n}/3", folder)
    assert bytes_of(study.merge(study_file, parts, tmp_path / "merged").folder) == here
