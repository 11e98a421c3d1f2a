"""Challenges and gates on a Dask cluster on loopback: functions that travel, programs that are there."""

from __future__ import annotations

import json
import signal
import sys
from pathlib import Path
from typing import Any

import cloudpickle
import pytest
import test_entrants
from cluster import Cluster
from test_entrants import SUITE, challenge, springs  # noqa: F401 (a fixture)

import hexbench
from hexbench import Answer, Case, commands, errors

pytest.importorskip("distributed")
# The workers do not have the tests.
cloudpickle.register_pickle_by_value(test_entrants)
cloudpickle.register_pickle_by_value(sys.modules[__name__])

#: A program without hexbench: zeros for every row, and what it is killed over.
PROGRAM = """
import os, signal, sys, time
case, out = sys.argv[1:]
rows = open(case + "/predict.csv").read().splitlines()[1:]
print("asked for", len(rows))
if "case-002" in open(case + "/hexapod.toml").read():
    sys.exit("not this one")
with open(out + "/predictions.csv", "w") as file:
    file.write("row,da_um,db_um,dc_um,dalpha_urad,dbeta_urad,dgamma_urad\\n")
    file.writelines(row.split(",")[0] + ",0,0,0,0,0,0\\n" for row in rows)
"""


def picky(case: Case) -> Answer:
    """Fit springs, but of one case."""
    if case.campaign.hexapod.name == "case-002":
        raise ValueError("not this one")
    return springs(case)


def answers(folder: Path) -> dict[str, Any]:
    """Return every file of the answers, without what a clock measures."""
    found: dict[str, Any] = {}
    for path in sorted(folder.rglob("*")):
        if path.is_file() and path.name != ".lock":
            found[str(path.relative_to(folder))] = path.read_bytes()
        if path.name == "run.json":
            record = json.loads(path.read_text())
            found[str(path.relative_to(folder))] = {k: v for k, v in record.items() if k not in {"wall_s", "peak_memory_MB"}}
    return found


def program_in(folder: Path) -> list[str]:
    """Write a program and return how it is called."""
    path = folder / "zeros.py"
    path.write_text(PROGRAM)
    return [sys.executable, str(path)]


def test_a_function_on_two_workers_gives_the_answers_of_one_process(cluster: Cluster, challenge: Path, tmp_path: Path) -> None:
    here = hexbench.answer_challenge(challenge, tmp_path / "here", "picky", picky)
    there = hexbench.answer_challenge(challenge, tmp_path / "there", "picky", picky, client=cluster.client)
    assert here == there and here.answered == 2
    assert there.failures == {"case-002": "raised ValueError: not this one"}
    assert answers(tmp_path / "there") == answers(tmp_path / "here")
    again = hexbench.answer_challenge(challenge, tmp_path / "there", "picky", picky, client=cluster.client)
    assert (again.answered, again.known) == (0, 3)


def test_a_program_on_workers_gives_the_answers_of_the_command(cluster: Cluster, challenge: Path, tmp_path: Path) -> None:
    line = program_in(tmp_path)
    commands.challenge_run(challenge, tmp_path / "here", "zeros", line)
    there = hexbench.answer_challenge(challenge, tmp_path / "there", "zeros", line, client=cluster.client)
    assert (there.answered, list(there.failures)) == (2, ["case-002"])
    assert "exit code 1: not this one" in there.failures["case-002"]
    assert answers(tmp_path / "there") == answers(tmp_path / "here")
    # The command goes on with the folder, and finds nothing to do.
    assert "3 answered before" in commands.challenge_run(challenge, tmp_path / "there", "zeros", line).text


def test_a_worker_that_is_killed_changes_nothing(cluster: Cluster, challenge: Path, tmp_path: Path) -> None:
    mark = tmp_path / "killed"

    def deadly(case: Case) -> Answer:
        import os

        # The first worker that comes here ends, once.
        try:
            mark.touch(exist_ok=False)
        except FileExistsError:
            return springs(case)
        os.kill(os.getpid(), signal.SIGKILL)
        raise AssertionError

    there = hexbench.answer_challenge(challenge, tmp_path / "there", "name", deadly, client=cluster.client)
    assert mark.exists() and (there.answered, there.failures) == (3, {})
    assert sorted(worker.poll() is None for worker in cluster.workers) == [False, True]
    hexbench.answer_challenge(challenge, tmp_path / "here", "name", deadly)
    assert answers(tmp_path / "there") == answers(tmp_path / "here")


def test_a_gate_on_a_cluster_has_the_figures_of_one_process(cluster: Cluster, tmp_path: Path) -> None:
    (tmp_path / "suite.toml").write_text(SUITE)
    for name, client in {"here": None, "there": cluster.client}.items():
        hexbench.gate_record(tmp_path / "suite.toml", tmp_path / f"{name}.json", springs, repeats=2, client=client)
    here, there = (json.loads((tmp_path / f"{name}.json").read_text()) for name in ("here", "there"))
    assert here == there
    same = hexbench.gate_check(tmp_path / "here.json", springs, client=cluster.client)
    assert same.passed and same.data is not None and same.data["same"]
    changed = hexbench.gate_check(tmp_path / "here.json", picky, client=cluster.client)
    assert not changed.passed
    # A program, too: recorded by the command, checked on the cluster.
    line = program_in(tmp_path)
    commands.gate_record(tmp_path / "suite.toml", line, baseline=tmp_path / "program.json", repeats=2)
    assert hexbench.gate_check(tmp_path / "program.json", line, client=cluster.client).passed


def test_what_is_wrong_with_the_cluster_is_no_answer(cluster: Cluster, challenge: Path, tmp_path: Path) -> None:
    line = program_in(tmp_path)
    with pytest.raises(errors.UsageError, match="no client"):
        hexbench.answer_challenge(challenge, tmp_path / "a", "zeros", line)
    for worker in cluster.workers:
        worker.kill()
    with pytest.raises(errors.InputOutput, match="no worker"):
        hexbench.answer_challenge(challenge, tmp_path / "a", "zeros", line, client=cluster.client, patience=1)
    assert not list((tmp_path / "a" / "cases").iterdir())
