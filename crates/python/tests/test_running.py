"""Python goes on while hexbench computes."""

import multiprocessing
import signal
import threading
import time
from pathlib import Path

import pytest
from conftest import case

import hexbench
from hexbench import _native

#: Ticks of another thread that tell a released interpreter from the few around a held one.
TICKS = 30
STUDY = (
    'format = "study/1"\ntitle = "long"\nseed = 3\ntrials = {trials}\ntask = "springs"\n'
    '[axes]\ngeometry = ["ring_a"]\nplan = ["random"]\nposes = [12]\n'
)


def _study(folder: Path, trials: int) -> Path:
    path = folder / "study.toml"
    path.write_text(STUDY.format(trials=trials))
    return path


def test_another_thread_runs_meanwhile(tmp_path: Path) -> None:
    study = _study(tmp_path, 10_000)
    ticks, over = [0], threading.Event()

    def tick() -> None:
        while not over.wait(0.001):
            ticks[0] += 1

    beside = threading.Thread(target=tick)
    beside.start()
    before = ticks[0]
    _native.study_run_part(study, "1/1", tmp_path / "out")
    during = ticks[0] - before
    over.set()
    beside.join()
    assert during > TICKS, during


def test_threads_get_the_results_of_one_thread() -> None:
    hexapod, data, _ = case("mujoco-foundation")
    campaign = hexbench.load(hexapod, data)
    expected, found = hexbench.diagnose(campaign).to_json(), []
    threads = [threading.Thread(target=lambda: found.append(hexbench.diagnose(campaign).to_json())) for _ in range(4)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    assert found == [expected] * 4


def test_an_interrupt_ends_a_long_study_which_then_goes_on(tmp_path: Path) -> None:
    # At most 512 records, so that each has a file of its own.
    study, out = _study(tmp_path, 500_000), tmp_path / "out"
    journal = out / "journal"

    def press() -> None:
        while not (journal.exists() and any(journal.glob("*.shard"))):
            time.sleep(0.01)
        signal.raise_signal(signal.SIGINT)

    threading.Thread(target=press).start()
    with pytest.raises(KeyboardInterrupt):
        _native.study_run_part(study, "1/1", out)
    kept = len(list(journal.glob("*.shard")))
    assert 0 < kept < _native.study_plan(study, 1)["shards"]


def _in_child(folder: str) -> str:
    hexapod, data, _ = case("mujoco-foundation")
    return repr(hexbench.diagnose(hexbench.load(hexapod, data))) + _run_study(Path(folder))


def _run_study(folder: Path) -> str:
    return str(_native.study_run_part(_study(folder, 1500), "1/1", folder / "out")["computed_trials"])


@pytest.mark.parametrize("way", ["fork", "spawn"])
def test_a_process_made_after_a_computation_computes_too(way: str, tmp_path: Path) -> None:
    (tmp_path / "own").mkdir()
    (tmp_path / "child").mkdir()
    own = _in_child(str(tmp_path / "own"))
    with multiprocessing.get_context(way).Pool(1) as pool:
        assert pool.apply_async(_in_child, [str(tmp_path / "child")]).get(timeout=120) == own
