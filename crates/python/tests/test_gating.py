"""The gate by a Python function: the command's numbers, a change for the worse noticed, what the baseline is bound to."""

import functools
import json
import sys
import xml.etree.ElementTree as ElementTree
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from test_entrants import SUITE, springs

import hexbench
from hexbench import Answer, Case, commands
from hexbench._source import bound_to

PROGRAM = """
import sys
from hexbench import Case
from test_entrants import springs
case = Case(sys.argv[1])
springs(case).write(case, sys.argv[2])
"""


@pytest.fixture(scope="module")
def suite(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Write a suite of three cases."""
    path = tmp_path_factory.mktemp("suite") / "suite.toml"
    path.write_text(SUITE)
    return path


@pytest.fixture(scope="module")
def baseline(suite: Path) -> Path:
    """Record the function that fits springs."""
    path = suite.with_name("gate.json")
    said = hexbench.gate_record(suite, path, springs, repeats=2, reason="First.")
    assert said.passed and "All 2 runs gave the same scores" in said.text
    assert "modules that it imports" in " ".join(said.text.split()), said.text
    return path


def worse(case: Case) -> Answer:
    """Fit springs, but answer ten times what they say, and be sure of it."""
    answer = springs(case)
    return Answer(10 * np.asarray(answer.predictions), answer.std, {n: (3 * v, s) for n, (v, s) in _pairs(answer)})


def _pairs(answer: Answer) -> list[tuple[str, tuple[float, float]]]:
    return [(name, value) for name, value in answer.parameters.items() if isinstance(value, tuple)]


def test_the_function_itself_passes_and_its_figures_are_those_of_the_same_program(suite: Path, baseline: Path, tmp_path: Path) -> None:
    same = hexbench.gate_check(baseline, springs)
    assert same.passed and same.data is not None
    assert (same.data["format"], same.data["same"], same.data["inside"], same.data["changed_files"]) == ("gate/1", True, True, [])
    program = tmp_path / "program.py"
    program.write_text(PROGRAM)
    places = [str(Path(hexbench.__file__).parents[1]), str(Path(__file__).parent)]
    line = ["env", f"PYTHONPATH={':'.join(places)}", sys.executable, str(program)]
    commands.gate_record(suite, line, baseline=tmp_path / "program.json", repeats=1)
    figures = [json.loads(path.read_text())["figures"] for path in (baseline, tmp_path / "program.json")]
    assert figures[0] == figures[1]
    # A baseline of a program serves a function, and the other way round a program is named.
    assert hexbench.gate_check(tmp_path / "program.json", springs).passed
    assert commands.gate_check(line, baseline=baseline).passed


def test_a_function_that_is_worse_fails_with_its_cases_and_the_call_that_makes_it_the_baseline(baseline: Path, tmp_path: Path) -> None:
    said = hexbench.gate_check(baseline, worse, junit=tmp_path / "gate.xml", markdown=tmp_path / "gate.md")
    assert not said.passed and said.data is not None
    assert {change["case"] for change in said.data["changes"]} == {"case-001", "case-002", "case-003"}
    assert "hexbench.gate_check(BASELINE, function, update=True" in " ".join(said.text.split())
    assert ElementTree.parse(tmp_path / "gate.xml").find(".//failure") is not None
    assert "worse" in (tmp_path / "gate.md").read_text()


def test_an_update_is_kept_with_its_reason(baseline: Path, tmp_path: Path) -> None:
    own = tmp_path / "own.json"
    own.write_bytes(baseline.read_bytes())
    assert hexbench.gate_check(own, worse, update=True, reason="It is meant.").data is None
    assert [u["reason"] for u in json.loads(own.read_text())["history"]] == ["First.", "It is meant."]
    assert hexbench.gate_check(own, worse).passed
    with pytest.raises(hexbench.UsageError, match="exists already"):
        hexbench.gate_record("springs-and-effects", own, worse)
    with pytest.raises(hexbench.UsageError, match="reason"):
        hexbench.gate_check(own, worse, update=True)


def test_the_command_line_says_that_it_cannot_call_the_function(baseline: Path) -> None:
    with pytest.raises(hexbench.UsageError, match=r"a Python function \(Python function test_entrants\.springs\)") as raised:
        commands.gate_check(baseline=baseline)
    assert "hexbench.gate_check" in raised.value.next_step


def test_an_exception_is_a_case_without_an_answer_and_an_interrupt_ends_the_check(baseline: Path) -> None:
    def picky(case: Case) -> Answer:
        if case.campaign.hexapod.name == "case-002":
            raise ValueError("not this one")
        return springs(case)

    said = hexbench.gate_check(baseline, picky)
    assert not said.passed and "raised ValueError: not this one" in json.dumps(said.data)

    def interrupted(case: Case) -> Answer:
        raise KeyboardInterrupt

    with pytest.raises(KeyboardInterrupt):
        hexbench.gate_check(baseline, interrupted)


def _made(text: str) -> Any:
    """Return a function that stands in no file, as on a prompt."""
    space: dict[str, Any] = {"__name__": "prompt", "springs": springs, "Answer": Answer}
    exec(compile(text, "<prompt>", "exec"), space)
    return space["own"]


def test_a_function_without_a_file_is_bound_to_its_code(suite: Path, tmp_path: Path) -> None:
    text = "def own(case):\n    return [springs(case) for _ in range({})][0]\n"
    first, other = (_made(text.format(n)) for n in (1, 2))
    assert bound_to(first) == bound_to(_made(text.format(1))) != bound_to(other)
    path = tmp_path / "gate.json"
    hexbench.gate_record(suite, path, first, repeats=1)
    files = json.loads(path.read_text())["entrant"]["files"]
    assert list(files) == ["source of prompt.own"]
    edited = hexbench.gate_check(path, other)
    assert edited.data is not None and edited.data["changed_files"] == ["source of prompt.own"] and edited.passed
    commands.challenge_make(suite, tmp_path / "cases")
    hexbench.answer_challenge(tmp_path / "cases", tmp_path / "answers", "own", first)
    with pytest.raises(hexbench.UsageError, match=r"source of prompt\.own was edited"):
        hexbench.answer_challenge(tmp_path / "cases", tmp_path / "answers", "own", other)


def test_what_is_wrapped_given_arguments_or_called_as_an_object_is_bound_to_where_it_was_written() -> None:
    class Called:
        def __call__(self, case: Case) -> Answer:
            return springs(case)

    @functools.wraps(springs)
    def wrapped(case: Case) -> Answer:
        return springs(case)

    here, there = [__file__], [str(Path(__file__).with_name("test_entrants.py"))]
    assert bound_to(Called()) == (here, []) and bound_to(Called().__call__) == (here, [])
    assert bound_to(functools.partial(springs)) == (there, []) and bound_to(wrapped) == (there, [])
    assert bound_to(len) == ([], [])
