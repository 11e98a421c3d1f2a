"""The examples do what they say."""

import re
import subprocess
import sys
from pathlib import Path

import pandas as pd
from conftest import ROOT, SCENES, Command, case

from hexbench import commands

EXAMPLES = Path(__file__).parents[1] / "examples"


def _run(name: str, *words: object, code: int = 0) -> str:
    done = subprocess.run([sys.executable, EXAMPLES / name, *map(str, words)], capture_output=True, text=True, check=False)
    assert done.returncode == code, done.stderr
    return done.stdout + done.stderr


def test_every_example_is_run_here() -> None:
    tested = set(re.findall(r'"(\w+\.py)"', Path(__file__).read_text()))
    assert {path.name for path in EXAMPLES.glob("*.py")} <= tested


def test_an_algorithm_of_ones_own_is_judged_by_the_truth() -> None:
    told = _run("develop_algorithm.py", SCENES / "cubic", 2).splitlines()[2:]
    errors = [[float(x) for x in line.split()[1:4]] for line in told]
    assert len(errors) == 2
    for own, springs, full in errors:
        # Both forget that legs pull softer; small turns cost the simple one little. Naming the effect must pay.
        assert abs(own - springs) < 0.2 * springs and full < 0.5 * springs, told


def test_a_group_lasso_answers_as_a_function_and_as_a_program(tmp_path: Path) -> None:
    suite = 'format = "challenge-suite/1"\nname = "two"\nversion = 1\ntitle = "Two"\nseed = 7\n[cases.clean]\nkind = "clean"\ncount = 2\n'
    (tmp_path / "suite.toml").write_text(suite)
    commands.challenge_make(tmp_path / "suite.toml", tmp_path / "cases")
    told = _run("group_lasso.py", tmp_path / "cases", tmp_path / "answers")
    assert "function: 2 cases answered, 0 failed" in told and "program: 2 cases answered, 0 failed" in told
    assert re.search(r"right / honest .*?(\d / \d / \d) +\1\b", told), told


def test_a_check_passes_with_its_model_and_fails_without(tmp_path: Path, command: Command) -> None:
    hexapod, data, holdout = case("mujoco-foundation")
    command("fit", hexapod, data, "--add", "base-compliance", "-o", tmp_path / "good.toml")
    command("fit", hexapod, data, "-o", tmp_path / "bad.toml")
    assert _run("check_in_ci.py", tmp_path / "good.toml", hexapod, holdout, 2.0).startswith("passed")
    assert _run("check_in_ci.py", tmp_path / "bad.toml", hexapod, holdout, 2.0, code=1).startswith("FAILED")
    told = _run("check_in_ci.py", tmp_path / "none.toml", hexapod, holdout, 2.0, code=1)
    assert told.startswith("error: ") and "none.toml" in told


def test_more_poses_are_worth_more(tmp_path: Path) -> None:
    space = ROOT / "data" / "designs" / "paper-space.toml"
    told = _run("plan_experiment.py", SCENES / "paper" / "hexapod.toml", space, tmp_path / "plan.csv")
    values = [float(v) for v in re.findall(r"= ([\d.e+-]+)", told)]
    assert len(values) == 3 and values == sorted(values), told
    assert len(pd.read_csv(tmp_path / "plan.csv")) == int(re.findall(r"9 poses, (\d+) readings", told)[0])


def test_a_metrologist_is_told_what_is_wrong(tmp_path: Path) -> None:
    told = _run("what_is_wrong.py", *case("mujoco-foundation")[:2], tmp_path / "report.html", case("mujoco-foundation")[2])
    assert "named base-compliance" in told
    assert "</html>" in (tmp_path / "report.html").read_text()
    wrong = _run("what_is_wrong.py", case("mujoco-foundation")[0], __file__, tmp_path / "report.html", code=1)
    assert wrong.startswith("error: ") and "next: " in wrong


def test_a_sweep_on_threads_counts_what_is_named() -> None:
    told = _run("sweep_repeats.py", SCENES / "cubic", "leg-asymmetry", 3)
    shares = dict(re.findall(r"^(\d)\s+([\d.]+)$", told, re.MULTILINE))
    assert set(shares) == {"1", "2", "4"} and float(shares["4"]) == 1.0, told
