"""Every command of hexbench has its function in Python, and they tell the same."""

import json
import os
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from conftest import ROOT, SCENES, Command, case

import hexbench
from hexbench import _native, commands, study

#: Functions of the commands; what stands in the package as something else is named too.
FUNCTIONS = {
    "init": commands.init,
    "simulate": hexbench.simulate,
    "poses": commands.poses,
    "campaign": commands.campaign,
    "check": commands.check,
    "compare": hexbench.compare,
    "diagnose": hexbench.diagnose,
    "discover": hexbench.discover,
    "runs": commands.runs,
    "fit": hexbench.fit,
    "predict": hexbench.predict,
    "compensate": hexbench.Model.compensate,
    "stiffness": hexbench.Model.stiffness,
    "export": commands.export,
    "witness": commands.witness,
    "design": hexbench.design,
    "discriminate": commands.discriminate,
    "power": commands.power,
    "study plan": study.plan,
    "study run": study.run,
    "study merge": study.merge,
    "regress": commands.regress,
    "terms": hexbench.terms,
    "challenge make": commands.challenge_make,
    "challenge run": commands.challenge_run,
    "challenge lint": commands.challenge_lint,
    "challenge score": commands.challenge_score,
    "challenge answer": commands.challenge_answer,
    "gate record": commands.gate_record,
    "gate check": commands.gate_check,
}
#: Commands without a function of their own, and why; `hexbench.commands.command` runs them all the same.
WITHOUT = {
    "demo": "a tour for the terminal; the notebook of the loop is its like",
    "transient": "shows one example of the second world, nothing to compute with",
    "workbench": "a server that lives as long as its process",
    "completions": "for a shell",
    "man": "for a shell",
}


def test_every_command_has_a_function_or_a_reason() -> None:
    names = {n for n in _native.command_names() if not n.startswith("validate ")}
    assert names == set(FUNCTIONS) | set(WITHOUT)
    assert all(function.__doc__ for function in FUNCTIONS.values())


def _table() -> str:
    """Return the table of commands in the README."""
    lines = ["| command | in Python | |", "|---|---|---|"]
    for name in sorted(set(FUNCTIONS) | set(WITHOUT)):
        if name in FUNCTIONS:
            function = FUNCTIONS[name]
            lines.append(f"| `{name}` | {_called(function)} | {_first_sentence(function.__doc__ or '')} |")
        else:
            lines.append(f'| `{name}` | `commands.command("{name}")` | {WITHOUT[name]} |')
    return "\n".join(lines) + "\n"


def _called(function: Any) -> str:
    module = function.__module__.removeprefix("hexbench.")
    return f"`{module}.{function.__name__}`" if module in {"commands", "study"} else f"`{function.__qualname__}`"


def _first_sentence(text: str) -> str:
    line = " ".join(text.split("\n\n")[0].split())
    for mark in (":class:", ":meth:", ":func:"):
        line = line.replace(mark, "")
    return line.replace("``", "`").split(": `hexbench ")[0].rstrip(".").replace("|", "/")


def test_the_readme_has_the_table_of_commands() -> None:
    path = Path(__file__).resolve().parents[1] / "README.md"
    text = path.read_text(encoding="utf-8")
    head, rest = text.split("<!-- commands -->\n", 1)
    _, tail = rest.split("<!-- end of commands -->\n", 1)
    wanted = f"{head}<!-- commands -->\n{_table()}<!-- end of commands -->\n{tail}"
    if os.environ.get("HEXBENCH_BLESS"):
        path.write_text(wanted, encoding="utf-8")
    assert path.read_text(encoding="utf-8") == wanted, "HEXBENCH_BLESS=1 writes it"


def test_check_and_power_tell_what_the_command_tells(command: Command) -> None:
    hexapod, data, _ = case("mujoco-clean")
    campaign = hexbench.load(hexapod, data)
    found = commands.check(campaign.hexapod, campaign)
    assert found.passed and found.data == json.loads(command("check", hexapod, data, "--json", "-").stdout)  | {
        key: found.data[key] for key in ("machine", "measurements") if found.data
    }
    told = commands.power(hexapod, data, effect="joint-friction", seed=3)
    assert told.text == command("power", hexapod, data, "--effect", "joint-friction", "--seed", "3").stdout
    assert told.data is not None and told.data["format"].startswith("power/")
    assert "<pre" in told._repr_html_() and str(told) == told.text


def test_results_of_python_are_put_beside_each_other() -> None:
    hexapod, data, _ = case("mujoco-foundation")
    campaign = hexbench.load(hexapod, data)
    first = hexbench.compare(campaign)
    other = hexbench.compare(campaign, hexbench.fit(campaign, ["base-compliance"]))
    assert commands.runs(first, first, check=True).passed
    assert not commands.runs(first, other, check=True).passed


def test_results_of_many_campaigns_become_a_book() -> None:
    hexapod, data, _ = case("mujoco-foundation")
    campaign = hexbench.load(hexapod, data)
    found = hexbench.diagnose(campaign)
    book = commands.runs(found, found, found, dates="2026-01-01,2026-02-01,2026-03-01", check=True)
    assert book.passed and book.data is not None and book.data["format"] == "book/1"
    assert [c["date"] for c in book.data["campaigns"]] == ["2026-01-01", "2026-02-01", "2026-03-01"]
    assert "therefore count twice" in " ".join(book.text.split())


def test_a_machine_is_made_of_a_few_numbers_and_exported(tmp_path: Path) -> None:
    rings = {"base_radius": 160, "base_gap": 20, "platform_radius": 120, "platform_gap": 30, "height": 165}
    commands.init(tmp_path / "hexapod.toml", **rings)
    assert hexbench.Hexapod.read(tmp_path / "hexapod.toml").base_joints_mm.shape == (6, 3)
    commands.export(SCENES / "paper-rich", tmp_path / "machine.xml", pose="0,0,0,0,0,0")
    assert (tmp_path / "machine.xml").read_text().lstrip().startswith("<")
    worlds = commands.witness(SCENES / "paper", states=2, html=tmp_path / "worlds.html")
    assert worlds.passed and "The worlds agree" in worlds.text and "<svg" in (tmp_path / "worlds.html").read_text()


def test_wrong_words_are_exceptions_with_the_text_of_the_command(tmp_path: Path) -> None:
    hexapod, data, _ = case("mujoco-clean")
    with pytest.raises(hexbench.UsageError, match="unexpected argument '--efect'"):
        commands.power(hexapod, data, efect="creep")
    with pytest.raises(hexbench.InputOutput, match=r"none\.csv"):
        commands.power(hexapod, tmp_path / "none.csv")
    with pytest.raises(hexbench.UsageError, match="expected a path"):
        commands.power(hexapod, object())


def test_balls_become_poses_and_a_campaign_that_is_diagnosed(tmp_path: Path, command: Command) -> None:
    scene = tmp_path / "scene"
    made = hexbench.simulate(SCENES / "paper-rich", folder=scene)
    told = commands.poses(scene / "balls.csv", relative_to=1)
    assert told.data is None and told.text == command("poses", scene / "balls.csv", "--relative-to", "1").stdout
    heads = told.text.splitlines()[0].split(",")
    assert heads[:3] == ["record", "measured_a_mm", "measured_b_mm"] and "sigma_a_um" in heads
    assert len(told.text.splitlines()) == 1 + len({line.split(",")[0] for line in (scene / "balls.csv").read_text().splitlines()[1:]})
    commands.poses(scene / "balls.csv", balls=scene / "balls.toml", output=tmp_path / "poses.csv")
    assert (tmp_path / "poses.csv").read_text().startswith("record,")
    found = commands.campaign(scene / "balls.csv", scene / "loads.csv", tmp_path / "out", hexapod=scene / "hexapod.toml")
    assert found.data is not None and found.data["readings"] == len(made.campaign) and "written" in found.text
    campaign = hexbench.load(made.hexapod, tmp_path / "out" / "measurements.csv")
    assert np.abs(campaign.measured - made.campaign.measured)[:, :3].max() < 10
    first, again = (hexbench.diagnose(c) for c in (made.campaign, campaign))
    assert first.verdict == again.verdict and first.added == again.added
    # A file that is there is never replaced.
    with pytest.raises(hexbench.HexbenchError, match=r"measurements\.csv"):
        commands.campaign(scene / "balls.csv", scene / "loads.csv", tmp_path / "out")


def test_readings_that_tell_effects_apart_are_those_of_the_command_and_can_be_read(tmp_path: Path, command: Command) -> None:
    hexapod, space = case("paper-protocol")[0], ROOT / "data" / "designs" / "effects-space.toml"
    between = ["base-compliance", "leg-coupling"]
    plan = tmp_path / "plan.csv"
    told = commands.discriminate(hexbench.Hexapod.read(hexapod), space, between, readings=9, output=plan)
    words = ["discriminate", hexapod, space, "--between", between[0], "--between", between[1], "--readings", 9]
    assert told.data is not None and told.data["pairs"] == json.loads(command(*words, "--json", "-").stdout)["pairs"]
    assert sum(r["repeats"] for r in told.data["readings"]) == 9 == len(plan.read_text().splitlines()) - 1
    # What the plan is for: it shows both effects better than it leaves them open.
    power = commands.power(hexapod, plan, effect=between)
    assert power.data is not None and {e["term"] for e in power.data["effects"]} >= set(between)
    with pytest.raises(hexbench.UsageError, match="between"):
        commands.discriminate(hexapod, space, between[:1])


def test_accuracy_is_tested_against_a_baseline_and_a_worse_program_does_not_pass(tmp_path: Path) -> None:
    baseline = tmp_path / "baseline.json"
    made = commands.regress(quick=True, baseline=baseline, update=True, reason="the first", runs=2)
    assert made.data is None and baseline.exists()
    same = commands.regress(quick=True, baseline=baseline)
    assert same.passed and same.data is not None and "no significant change" in same.text
    assert all(finding["same_values"] for finding in same.data["findings"])
    # Leg stiffnesses a hundred times as accurate before.
    kept = json.loads(baseline.read_text())
    error, shift = kept["limits"]["stiffness-error"], np.log(100.0)
    error["squares"] += -2 * shift * error["sum"] + error["n"] * shift**2
    error["sum"] -= error["n"] * shift
    baseline.write_text(json.dumps(kept))
    worse = commands.regress(quick=True, baseline=baseline)
    assert not worse.passed and "leg stiffness: relative error" in worse.text
    with pytest.raises(hexbench.UsageError, match="reason"):
        commands.regress(quick=True, baseline=baseline, update=True)
    with pytest.raises(hexbench.InputOutput, match=r"none\.json"):
        commands.regress(quick=True, baseline=tmp_path / "none.json")


def test_corrections_are_those_of_the_command_and_reach_the_wanted_pose(tmp_path: Path, command: Command) -> None:
    hexapod, data, _ = case("mujoco-foundation")
    campaign = hexbench.load(hexapod, data)
    model = hexbench.fit(campaign, ["base-compliance"])
    model.save(tmp_path / "model.toml")
    found = model.compensate(campaign.poses[:4], campaign.wrenches[:4])
    names = (*hexbench._tables.POSE, *hexbench._tables.WRENCH)
    table = np.hstack([campaign.poses[:4], campaign.wrenches[:4]])
    lines = [",".join(names), *(",".join(map(repr, row)) for row in table.tolist())]
    (tmp_path / "wanted.csv").write_text("\n".join(lines) + "\n")
    told = command("compensate", tmp_path / "model.toml", tmp_path / "wanted.csv").stdout.splitlines()
    heads = told[0].split(",")
    rows = np.array([[float(row.split(",")[heads.index(n)]) for n in names[:6]] for row in told[1:]])
    assert found.commands == pytest.approx(rows, abs=1e-8)
    reached = found.commands[:, :3] * 1e3 + model.predict(found.commands, campaign.wrenches[:4])[:, :3]
    assert np.abs(reached - campaign.poses[:4, :3] * 1e3 - found.remaining[:, :3]).max() < 1e-3
    assert np.abs(found.remaining).max() < 0.01 * np.abs(found.uncorrected).max() and (found.std > 0).all()


SUITE = """
format = "challenge-suite/1"
name = "two"
version = 1
title = "Two cases"
seed = 7

[cases.clean]
kind = "clean"
count = 2
"""


def test_a_challenge_is_made_answered_looked_at_and_scored_and_a_program_guarded(tmp_path: Path) -> None:
    suite = tmp_path / "suite.toml"
    suite.write_text(SUITE)
    challenge, answers = tmp_path / "challenge", tmp_path / "answers"
    commands.challenge_make(suite, challenge)
    first = challenge / "cases" / "case-001"
    (tmp_path / "one").mkdir()
    commands.challenge_answer(first, tmp_path / "one")
    assert commands.challenge_lint(tmp_path / "one", case=first).passed
    (tmp_path / "one" / "parameters.json").write_text("{")
    assert not commands.challenge_lint(tmp_path / "one", case=first).passed
    program = [os.environ["HEXBENCH_BINARY"], "challenge", "answer"]
    commands.challenge_run(challenge, answers, "ours", program)
    scored = commands.challenge_score(challenge, [answers])
    assert scored.data is not None and "ours" in scored.text
    commands.gate_record(suite, program, baseline=tmp_path / "gate.json", repeats=2)
    assert commands.gate_check(baseline=tmp_path / "gate.json").passed
    # One that says nothing is worse.
    assert not commands.gate_check(["true"], baseline=tmp_path / "gate.json").passed
