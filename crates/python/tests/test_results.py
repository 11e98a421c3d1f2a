"""Results are those of the command, to the byte or the last digit that it prints."""

import json
import re
import tomllib
from pathlib import Path

import numpy as np
import pandas as pd
import pytest
from conftest import ROOT, SCENES, Command, case

import hexbench

KEYS = {
    "format", "verdict", "added", "model", "small", "richer", "add", "candidates", "present",
    "gaussian_checks", "credible_set", "steps", "nested", "holdout", "noise",
    "parameters", "not_determined", "untestable", "detectable", "next", "separation", "absorbed", "suspects", "outside",
    "law", "remainder", "warnings", "findings", "excluded", "keep_all", "read_as", "alternative", "other_reading", "run",
}  # fmt: skip


@pytest.mark.parametrize("name", ["mujoco-foundation", "mujoco-clean"])
def test_a_diagnosis_is_that_of_the_command_byte_for_byte(name: str, command: Command, tmp_path: Path) -> None:
    hexapod, data, holdout = case(name)
    told = command("diagnose", hexapod, data, "--holdout", holdout, "--json", "-").stdout
    diagnosis = hexbench.diagnose(hexbench.load(hexapod, data), holdout=holdout)
    assert diagnosis.to_json() == told
    assert diagnosis.to_dict() == json.loads(told)
    assert {key: getattr(diagnosis, key) for key in KEYS} == diagnosis.to_dict()
    assert set(hexbench.Diagnosis.__annotations__) - {"_made"} == KEYS
    # Where the command saves the model, its page does not tell how to.
    saved = tmp_path / "model.toml"
    page = command("diagnose", hexapod, data, "--holdout", holdout, "--color", "never", "-o", saved).stdout
    assert str(diagnosis) == page
    assert diagnosis.verdict in repr(diagnosis) and len(repr(diagnosis)) < 200
    assert diagnosis.verdict in diagnosis._repr_html_()


def test_which_readings_count_is_chosen_as_with_the_command(tmp_path: Path, command: Command) -> None:
    hexapod, data, _ = case("mujoco-clean")
    frame = pd.read_csv(data, comment="#")
    frame.loc[17, "db_um"] += 20.0
    wrong = tmp_path / "measurements.csv"
    frame.to_csv(wrong, index=False)
    campaign = hexbench.load(hexapod, wrong)
    kept = hexbench.diagnose(campaign, exclude=["2-3", np.int64(5)], keep_all=True)
    told = command("diagnose", hexapod, wrong, "--exclude", "2-3", "--exclude", "5", "--keep-all", "--json", "-").stdout
    assert kept.to_json() == told
    assert kept.excluded == [2, 3, 5] and kept.keep_all
    assert kept.alternative is not None and kept.alternative["rows"] == [19]
    assert [leg["unit"] for leg in kept.alternative["stiffness"]] == ["N/um"] * 6
    assert hexbench.diagnose(campaign, exclude="19").alternative is None
    for line in (0, 1.5, "x", -3):
        with pytest.raises(hexbench.UsageError):
            hexbench.diagnose(campaign, exclude=[line])


def test_a_table_in_memory_is_diagnosed_as_its_file() -> None:
    hexapod, data, holdout = case("mujoco-foundation")
    of_file = hexbench.diagnose(hexbench.load(hexapod, data), holdout=holdout).to_dict()
    frame = pd.read_csv(data, comment="#")
    held = pd.read_csv(holdout, comment="#")
    of_frame = hexbench.diagnose(hexbench.load(hexapod, frame), holdout=held).to_dict()
    of_file.pop("run"), of_frame.pop("run")
    assert of_frame == of_file


def test_the_page_of_a_diagnosis_is_that_of_the_command_but_for_who_made_it(tmp_path: Path, command: Command) -> None:
    hexapod, data, _ = case("paper-protocol")
    command("compare", hexapod, data, "--html", tmp_path / "command.html")
    hexbench.compare(hexbench.load(hexapod, data)).to_html(tmp_path / "python.html")
    ours, theirs = ((tmp_path / f"{who}.html").read_text().splitlines() for who in ("python", "command"))
    different = [(a, b) for a, b in zip(ours, theirs, strict=True) if a != b]
    assert len(different) == 1 and "hexbench.compare in Python" in different[0][0], different
    hexbench.diagnose(hexbench.load(hexapod, data)).to_html(tmp_path / "diagnosis.html")
    assert "hexbench.diagnose in Python" in (tmp_path / "diagnosis.html").read_text()


def test_a_comparison_is_that_of_the_command_byte_for_byte(command: Command, tmp_path: Path) -> None:
    hexapod, data, holdout = case("mujoco-foundation")
    command("fit", hexapod, data, "-o", tmp_path / "model.toml")
    campaign = hexbench.load(hexapod, data)
    told = command("compare", hexapod, data, "--holdout", holdout, "--json", "-").stdout
    found = hexbench.compare(campaign, holdout=holdout)
    assert found.to_json() == told
    assert found.holdout == json.loads(told)["holdout"]
    told = command("compare", hexapod, data, "--model", tmp_path / "model.toml", "--json", "-").stdout
    assert hexbench.compare(campaign, hexbench.Model.load(tmp_path / "model.toml")).to_json() == told
    assert str(found) == command("compare", hexapod, data, "--holdout", holdout, "--color", "never").stdout


@pytest.mark.parametrize(("name", "add"), [("mujoco-foundation", ["base-compliance"]), ("absolute-pitch", ["leg-offset"])])
def test_a_fit_and_its_predictions_are_those_of_the_command(
    name: str, add: list[str], command: Command, tmp_path: Path
) -> None:
    hexapod, data, holdout = case(name)
    wanted = [word for term in add for word in ("--add", term)]
    path = tmp_path / "model.toml"
    page = command("fit", hexapod, data, *wanted, "--holdout", holdout, "-o", path, "--color", "never").stdout
    model = hexbench.fit(hexbench.load(hexapod, data), add, holdout=holdout)
    assert model.to_toml() == path.read_text()
    assert model.summary == page
    assert model.terms == add
    kept = hexbench.Model.load(path)
    assert kept.to_toml() == path.read_text() and kept.values == model.values
    _same_predictions(model, holdout, command, path, tmp_path)


def test_a_model_changed_by_hand_is_refused_unless_it_is_trusted(tmp_path: Path) -> None:
    hexapod, data, _ = case("paper-protocol")
    path = tmp_path / "model.toml"
    hexbench.fit(hexbench.load(hexapod, data)).save(path)
    first, _, rest = path.read_text().partition("[seal]")
    assert rest, "the digest has another place"
    path.write_text(first)
    with pytest.raises(hexbench.BadInput):
        hexbench.Model.load(path)
    assert len(hexbench.Model.load(path, trust=True).values) >= 6


def test_the_stiffness_of_the_platform_is_that_of_the_command(command: Command, tmp_path: Path) -> None:
    hexapod, data, holdout = case("mujoco-foundation")
    model = hexbench.fit(hexbench.load(hexapod, data), ["base-compliance"])
    model.save(tmp_path / "model.toml")
    words = ("--poses", holdout, "--point", "0,0,80", "--axes", "mobile", "--json", "-")
    told = json.loads(command("stiffness", tmp_path / "model.toml", *words).stdout)["states"]
    held = hexbench.load(model.hexapod, holdout)
    found = model.stiffness(held.poses, held.wrenches, point_mm=[0, 0, 80], axes="mobile")
    for name, matrices in found._asdict().items():
        expected = np.array([state[name] for state in told])
        assert np.allclose(matrices, expected, rtol=1e-9, atol=0), name
    alone = model.stiffness(held.poses[:1])
    assert np.allclose(alone.stiffness @ alone.compliance, np.eye(6), atol=1e-9)
    assert model.stiffness(np.empty((0, 6))).stiffness.shape == (0, 6, 6)
    with pytest.raises(hexbench.BadInput):
        model.stiffness(held.poses[:1], point_mm=[0, 0])
    with pytest.raises(hexbench.UsageError):
        model.stiffness(held.poses[:1], amplitude_N=-1)


def _same_predictions(model: hexbench.Model, rows: Path, command: Command, path: Path, folder: Path) -> None:
    command("predict", path, rows, "-o", folder / "predicted.csv")
    expected = pd.read_csv(folder / "predicted.csv")
    held = hexbench.load(model.hexapod, rows)
    columns = held.to_columns()
    more = {key: columns[key] for key in ("approach", "delta_T_K", "elapsed_s") if key in columns}
    if "ref_fx_N" in columns:
        more["reference"] = np.column_stack([columns[n] for n in columns if n.startswith("ref_")])
    values, covariance = model.predict(held.poses, held.wrenches, covariance=True, **more)
    names = [n for n in expected.columns if n.startswith("predicted_")] or [
        "da_um", "db_um", "dc_um", "dalpha_urad", "dbeta_urad", "dgamma_urad",
    ]  # fmt: skip
    # The command prints six decimals of um and urad, nine of mm, eleven of deg: half of the last one.
    last_digit = np.array([0.51e-9] * 3 + [0.51e-11] * 3) if model.absolute else 0.51e-6
    assert np.all(np.abs(values - expected[names].to_numpy()) <= last_digit)
    sigma = np.sqrt(np.diagonal(covariance, axis1=1, axis2=2))
    stated = expected[[n for n in expected.columns if n.startswith("sigma_")]].to_numpy()
    assert np.all(np.abs(sigma - stated) <= 0.51e-6)
    assert np.array_equal(model.predict(held.poses, held.wrenches, **more), values)


def test_predicted_sensors_are_those_of_the_command(command: Command, tmp_path: Path) -> None:
    bench, path = tmp_path / "bench", tmp_path / "model.toml"
    command("simulate", ROOT / "scenes" / "granite", "-o", bench)
    campaign = hexbench.load(bench / "hexapod.toml", bench / "measurements.csv")
    model = hexbench.fit(campaign)
    model.save(path)
    command("predict", path, bench / "measurements.csv", "-o", tmp_path / "predicted.csv")
    expected = pd.read_csv(tmp_path / "predicted.csv")
    columns = campaign.to_columns()
    more = {key: columns[key] for key in ("approach", "delta_T_K", "elapsed_s") if key in columns}
    if "ref_fx_N" in columns:
        more["reference"] = np.column_stack([columns[n] for n in columns if n.startswith(("ref_f", "ref_m"))])
    values, stds = model.predict_sensors(campaign.poses, campaign.wrenches, **more)
    assert model.sensor_columns == ["z1_um", "z2_um", "z3_um", "t1_um", "t2_um", "t3_um"]
    assert np.all(np.abs(values - expected[model.sensor_columns].to_numpy()) <= 0.51e-6)
    assert np.all(np.abs(stds - expected[[f"sigma_{n}" for n in model.sensor_columns]].to_numpy()) <= 0.51e-6)
    again, _, covariance = model.predict_sensors(campaign.poses, campaign.wrenches, **more, covariance=True)
    assert np.array_equal(again, values) and covariance.shape == (len(values), 6, 6)
    assert np.array_equal(np.sqrt(np.diagonal(covariance, axis1=1, axis2=2)), stds)
    assert np.allclose(covariance, covariance.transpose(0, 2, 1))
    nothing = np.empty((0, 6))
    parts = model.predict_sensors(nothing, nothing, covariance=True)
    assert [part.shape for part in parts] == [(0, 6), (0, 6), (0, 6, 6)]


def test_parameters_and_covariance_belong_together() -> None:
    hexapod, data, _ = case("mujoco-foundation")
    model = hexbench.fit(hexbench.load(hexapod, data), ["base-compliance"])
    table = model.parameters
    assert list(table.columns) == ["value", "std", "unit"] and table.loc["leg-1.stiffness", "unit"] == "N/um"
    assert dict(table["value"]) == model.values and dict(table["std"]) == model.stds
    covariance = model.covariance
    assert covariance.shape == (len(model.covariance_names),) * 2
    kept = tomllib.loads(model.to_toml())["covariance"]
    assert kept["order"] == model.covariance_names and np.array_equal(kept["matrix"], covariance)
    # c = 1/k: std(c) = std(k) / k^2, in m/N.
    for leg in range(6):
        k, std = 1e6 * table.loc[f"leg-{leg + 1}.stiffness", ["value", "std"]].to_numpy(dtype=float)
        assert np.isclose(np.sqrt(covariance[leg, leg]), std / k**2, rtol=1e-12)


def test_the_papers_estimator_is_that_of_the_command(command: Command, tmp_path: Path) -> None:
    hexapod, data, _ = case("paper-protocol")
    command("fit", hexapod, data, "--estimator", "paper", "-o", tmp_path / "model.toml")
    assert hexbench.fit(hexbench.load(hexapod, data), estimator="paper").to_toml() == (tmp_path / "model.toml").read_text()


@pytest.mark.parametrize("scene", ["paper", "cubic"])
def test_a_simulation_writes_the_bytes_of_the_command(scene: str, command: Command, tmp_path: Path) -> None:
    ours, theirs = tmp_path / "ours" / "x", tmp_path / "theirs" / "x"
    command("simulate", SCENES / scene, "-o", theirs, "--seed", 11)
    made = hexbench.simulate(SCENES / scene, seed=11, folder=ours)
    files = sorted(p.relative_to(theirs) for p in theirs.rglob("*") if p.is_file())
    assert files == sorted(p.relative_to(ours) for p in ours.rglob("*") if p.is_file())
    for file in files:
        assert (ours / file).read_bytes() == (theirs / file).read_bytes(), file
    assert made.truth == json.loads((theirs / "sealed" / "truth.json").read_text())
    nowhere = hexbench.Scene(SCENES / scene).simulate(seed=11)
    assert nowhere.campaign.to_csv() == made.campaign.to_csv()
    assert "truth" not in repr(made)
    with pytest.raises(hexbench.UsageError, match="the folder is not empty"):
        hexbench.simulate(SCENES / scene, folder=ours)


def test_a_plan_is_that_of_the_command(command: Command, tmp_path: Path) -> None:
    hexapod, space = SCENES / "paper" / "hexapod.toml", ROOT / "data" / "designs" / "paper-space.toml"
    path = tmp_path / "plan.csv"
    page = command("design", hexapod, space, "--starts", 4, "--seed", 2, "-o", path, "--color", "never").stdout
    plan = hexbench.design(hexbench.Hexapod.read(hexapod), space, starts=4, seed=2)
    assert str(plan) == page
    expected = pd.read_csv(path)
    assert list(plan.to_columns()) == list(expected.columns)
    # Rounding to um and 0.001 deg, then the digits of the file.
    assert np.allclose(plan.to_pandas().to_numpy(dtype=float), expected.to_numpy(dtype=float), rtol=0, atol=1e-9)
    assert plan.poses.shape == (expected["pose"].nunique(), 6) and len(plan) == len(expected)


def test_sensors_are_those_of_the_command(command: Command, tmp_path: Path) -> None:
    case, sensors = ROOT / "data" / "cases" / "mujoco-clean", ROOT / "data" / "designs" / "gauges.toml"
    files = [case / "hexapod.toml", case / "measurements.csv"]
    machine, choice = tmp_path / "machine.toml", tmp_path / "choice.json"
    options = ["--sensors", sensors, "--choose", 4, "--starts", 4, "--seed", 2]
    page = command("design", *files, *options, "-o", machine, "--color", "never").stdout
    command("design", *files, *options, "--json", choice)
    chosen = hexbench.choose_sensors(hexbench.Hexapod.read(files[0]), files[1], sensors, choose=4, starts=4, seed=2)
    assert str(chosen) == page
    assert chosen.to_dict() == json.loads(choice.read_text())
    assert len(chosen.names) == 4
    read = hexbench.Hexapod.read(machine)
    assert np.allclose(chosen.hexapod.base_joints_mm, read.base_joints_mm)
    with pytest.raises(hexbench.UsageError, match="how many sensors"):
        hexbench.choose_sensors(hexbench.Hexapod.read(files[0]), files[1], sensors)


def test_the_catalogue_is_that_of_the_command(command: Command) -> None:
    listed = command("terms").stdout
    told = hexbench.terms()
    assert len(told) >= 20
    for term in told:
        assert term["id"] in listed
        assert all(set(p) == {"name", "unit"} for p in term["parameters"])


def test_a_study_in_parts_has_the_bytes_of_the_command(command: Command, tmp_path: Path) -> None:
    from hexbench import _native

    study = tmp_path / "study.toml"
    study.write_text(
        'format = "study/1"\ntitle = "shared"\nseed = 3\ntrials = 2900\ntask = "springs"\n'
        '[axes]\ngeometry = ["ring_a"]\nplan = ["random"]\nposes = [3]\nnoise_scale = [1, 2]\n'
    )
    command("study", study, "-o", tmp_path / "whole")
    plan = _native.study_plan(study, 2)
    assert [p["part"] for p in plan["parts"]] == ["1/2", "2/2"]
    folders = [tmp_path / "part-1", tmp_path / "part-2"]
    done = [_native.study_run_part(study, p["part"], f) for p, f in zip(plan["parts"], folders, strict=True)]
    assert sum(d["computed_trials"] for d in done) == plan["trials"] == 5800
    assert _native.study_run_part(study, "1/2", folders[0])["computed_shards"] == 0
    merged = _native.study_merge(study, folders, tmp_path / "merged")
    assert merged["taken"] == plan["shards"]
    for file in ("trials.parquet", "cells.csv", "study.md"):
        assert (tmp_path / "merged" / file).read_bytes() == (tmp_path / "whole" / file).read_bytes(), file


def test_a_discovery_is_that_of_the_command_byte_for_byte(tmp_path: Path, command: Command) -> None:
    hexapod, data, holdout = case("not-in-catalogue")
    told = command("discover", hexapod, data, "--holdout", holdout, "--json", "-").stdout
    campaign = hexbench.load(hexapod, data)
    found = hexbench.discover(campaign, holdout=holdout)
    assert found.to_json() == told
    keys = set(hexbench.Discovery.__annotations__) - {"_made"}
    assert {key: getattr(found, key) for key in keys} == found.to_dict()
    assert str(found) == command("discover", hexapod, data, "--holdout", holdout, "--color", "never").stdout
    assert found.found and "period" in repr(found)
    found.to_html(tmp_path / "python.html")
    page = (tmp_path / "python.html").read_text(encoding="utf-8")
    command("discover", hexapod, data, "--holdout", holdout, "--html", tmp_path / "command.html")
    body = re.compile(r"<svg.*?</svg>", re.DOTALL)
    assert body.findall(page) == body.findall((tmp_path / "command.html").read_text(encoding="utf-8")) != []
    found.save(tmp_path / "term.toml")
    diagnosis = hexbench.diagnose(campaign, holdout=holdout, terms=[tmp_path / "term.toml"])
    assert (diagnosis.verdict, diagnosis.added) == ("named", [found.laws[0]["term"]])


def test_nothing_is_discovered_on_a_sound_machine(tmp_path: Path) -> None:
    hexapod, data, holdout = case("mujoco-clean")
    nothing = hexbench.discover(hexbench.load(hexapod, data), holdout=holdout)
    assert (nothing.found, nothing.reason, nothing.laws, nothing.term()) == (False, "nothing-missing", [], None)
    with pytest.raises(ValueError, match="nothing is missing"):
        nothing.save(tmp_path / "term.toml")
