"""An algorithm as a Python function: over the cases of a challenge and the trials of a study, in this process."""

import json
import sys
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from conftest import SCENES

import hexbench
from hexbench import Answer, Case, commands, study

EXAMPLE = Path(__file__).resolve().parents[1] / "examples" / "group_lasso.py"
SUITE = """
format = "challenge-suite/1"
name = "few"
version = 1
title = "A few cases"
seed = 25

[cases.clean]
kind = "clean"
count = 1

[cases.hidden]
kind = "single"
count = 2
distance = [12, 60]
effects = ["platform-compliance", "base-compliance"]
"""
STUDY = """
format = "study/1"
title = "Two cells"
seed = 3
trials = 3
task = "diagnose"
redraw = 2

[axes]
geometry = ["ring_a"]
plan = ["random"]
poses = [6]
repeats = [1, 2]
effect = ["base-compliance"]
"""


@pytest.fixture(scope="module")
def challenge(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Make a challenge of three cases."""
    folder = tmp_path_factory.mktemp("challenge")
    (folder / "suite.toml").write_text(SUITE)
    commands.challenge_make(folder / "suite.toml", folder / "cases")
    return folder / "cases"


def springs(case: Case) -> Answer:
    """Fit springs alone."""
    model = hexbench.fit(case.campaign)
    values, covariance = model.predict(**case.conditions, covariance=True)
    legs = {str(name): (row["value"], row["std"]) for name, row in model.parameters.iterrows()}
    return Answer(values, np.sqrt(np.diagonal(covariance, axis1=1, axis2=2)), legs)


def diagnosed(case: Case) -> Answer:
    """Say what hexbench says."""
    said = hexbench.diagnose(case.campaign)
    return Answer(hexbench.fit(case.campaign, said.added).predict(**case.conditions), diagnosis=said)


def _figures(scores: commands.Outcome, name: str) -> dict[str, Any]:
    assert scores.data is not None
    return next(dict(e) for e in scores.data["entrants"] if e["name"] == name)


def test_a_function_answers_a_challenge_as_the_program_made_of_it_does(challenge: Path, tmp_path: Path) -> None:
    sys.path.insert(0, str(EXAMPLE.parent))
    try:
        from group_lasso import group_lasso
    finally:
        sys.path.pop(0)
    inside = hexbench.answer_challenge(challenge, tmp_path / "function", "function", group_lasso)
    assert (inside.answered, inside.failures, inside.known) == (3, {}, 0)
    package = Path(hexbench.__file__).parents[1]
    commands.challenge_run(
        challenge, tmp_path / "program", "program", ["env", f"PYTHONPATH={package}", sys.executable, str(EXAMPLE)]
    )
    files = sorted(path.relative_to(tmp_path / "function") for path in (tmp_path / "function" / "cases").rglob("p*.[cj]s*"))
    assert len(files) == 6
    for file in files:
        assert (tmp_path / "function" / file).read_bytes() == (tmp_path / "program" / file).read_bytes(), file
    scores = commands.challenge_score(challenge, [tmp_path / "function", tmp_path / "program"])
    assert "in its own process without limits" in " ".join(scores.text.split())
    # Starting an interpreter and NumPy for each case is what a function saves.
    times = [_times(tmp_path / name) for name in ("function", "program")]
    assert sum(times[0]) < sum(times[1]), times


def _times(answers: Path) -> list[float]:
    return [json.loads(path.read_text())["wall_s"] for path in answers.rglob("run.json")]


def test_numbers_and_diagnoses_of_functions_are_scored(challenge: Path, tmp_path: Path) -> None:
    for name, algorithm in {"springs": springs, "diagnosed": diagnosed}.items():
        assert str(hexbench.answer_challenge(challenge, tmp_path / name, name, algorithm)).startswith(f"{name}: 3 cases answered, 0")
        for case in (tmp_path / name / "cases").iterdir():
            assert commands.challenge_lint(case, case=challenge / "cases" / case.name).passed
    scores = commands.challenge_score(challenge, [tmp_path / "diagnosed", tmp_path / "springs"])
    assert "3 / 0 / 0" in scores.text, scores.text


def test_a_run_goes_on_and_is_bound_to_its_function(challenge: Path, tmp_path: Path) -> None:
    broken = ["case-002"]

    def picky(case: Case) -> Answer:
        if case.campaign.hexapod.name in broken:
            raise ValueError("not this one")
        return springs(case)

    first = hexbench.answer_challenge(challenge, tmp_path / "picky", "picky", picky)
    assert (first.answered, first.failures) == (2, {"case-002": "raised ValueError: not this one"})
    assert "case-002: raised ValueError" in str(first)
    broken.clear()
    again = hexbench.answer_challenge(challenge, tmp_path / "picky", "picky", picky)
    assert (again.answered, again.known) == (0, 3)
    assert hexbench.answer_challenge(challenge, tmp_path / "picky", "picky", picky, again=True).answered == 3
    with pytest.raises(hexbench.UsageError, match=r"there the program is Python function .*picky"):
        hexbench.answer_challenge(challenge, tmp_path / "picky", "picky", springs)
    depends = tmp_path / "table.csv"
    depends.write_text("1")
    hexbench.answer_challenge(challenge, tmp_path / "bound", "bound", springs, depends=[depends])
    depends.write_text("2")
    with pytest.raises(hexbench.UsageError, match=r"table\.csv was edited"):
        hexbench.answer_challenge(challenge, tmp_path / "bound", "bound", springs, depends=[depends])


def test_an_interrupt_ends_a_run_and_keeps_what_was_answered(challenge: Path, tmp_path: Path) -> None:
    seen: list[str] = []

    def interrupted(case: Case) -> Answer:
        seen.append(case.campaign.hexapod.name)
        if len(seen) == 2:
            raise KeyboardInterrupt
        return springs(case)

    with pytest.raises(KeyboardInterrupt):
        hexbench.answer_challenge(challenge, tmp_path / "stopped", "stopped", interrupted)
    rest = hexbench.answer_challenge(challenge, tmp_path / "stopped", "stopped", interrupted)
    assert (rest.answered, rest.known, len(seen)) == (2, 1, 4)


def test_predictions_of_another_shape_are_a_failure_with_the_reason(challenge: Path, tmp_path: Path) -> None:
    run = hexbench.answer_challenge(challenge, tmp_path / "short", "short", lambda _: Answer(np.zeros((1, 6))))
    assert len(run.failures) == 3 and "predictions: expected shape" in run.failures["case-001"]


def test_conditions_of_a_case_are_what_is_to_be_predicted(challenge: Path) -> None:
    case = Case(challenge / "cases" / "case-001")
    lines = (case.folder / "predict.csv").read_text().splitlines()
    head, first = (line.split(",") for line in lines[:2])
    assert {k: v.shape for k, v in case.conditions.items()} == {
        "poses": (len(lines) - 1, 6), "wrenches": (len(lines) - 1, 6), "reference": (len(lines) - 1, 6),
        "approach": (len(lines) - 1,), "delta_T_K": (len(lines) - 1,), "elapsed_s": (len(lines) - 1,),
    }  # fmt: skip
    assert case.conditions["wrenches"][0, 2] == float(first[head.index("fz_N")])


def test_an_algorithm_is_a_column_of_a_study(tmp_path: Path) -> None:
    (tmp_path / "study.toml").write_text(STUDY)

    def own(trial: hexbench.StudyTrial) -> dict[str, Any]:
        said = hexbench.diagnose(trial.campaign, holdout=trial.holdout)
        model = hexbench.fit(trial.campaign, ["base-compliance"])
        legs = np.array([model.values[f"leg-{leg}.stiffness"] for leg in range(1, 7)])
        error = 100 * np.abs(legs / trial.truth["leg_stiffness_N_per_um"] - 1).max()
        exact = hexbench.compare(trial.ideal, model).error["chi2_reduced"]
        return {
            "verdict": said.verdict, "first": said.candidates[0]["term"], "probability": said.candidates[0]["probability"],
            "true": trial.truth["size"], "error_percent": error, "ideal": exact,
        }  # fmt: skip

    found = hexbench.study_columns(tmp_path / "study.toml", own)
    assert list(found.columns[:9]) == ["effect", "geometry", "noise_scale", "plan", "poses", "repeats", "trial", "status", "verdict"]
    assert len(found) == 6 and set(found["status"]) == {"done"} and set(found["repeats"]) == {1, 2}
    # The very campaigns that the study diagnoses.
    trials = study.run(None, tmp_path / "study.toml", tmp_path / "out").trials()
    assert list(found["verdict"]) == list(trials["verdict"]) and list(found["first"]) == list(trials["first"])
    assert np.allclose(found["probability"], trials["first_probability"])
    assert np.allclose(found["true"], trials["true_size_nm_per_N"])
    assert found["error_percent"].max() < 10 and found["ideal"].max() < 1
    assert len(hexbench.study_columns(tmp_path / "study.toml", lambda t: {"n": len(t.campaign)}, trials=1)) == 2
    with pytest.raises(hexbench.BadInput, match="scene"):
        hexbench.study_columns(SCENES / "paper" / "scene.toml", own)
