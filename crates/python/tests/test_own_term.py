"""A Python function as a term does what the same law does as a formula, and is asked for all conditions at once."""

import copy
import pickle
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from conftest import case

import hexbench
from hexbench import Parameter, ShapeParameter, Term, blocks

FORMULA = """
format = "term/1"
id = "square-spring"
title = "Legs that soften with the square of the force"
elongation = "size * (f*abs(f) - f0*abs(f0)) / 100"
[[parameters]]
name = "size"
unit = "nm/N"
scale = 20
"""
SIZE = (Parameter("size", "nm/N", 20),)


def square(f: Any, f0: Any, size: float) -> Any:
    """Soften with the square of the force."""
    return size * (f * np.abs(f) - f0 * np.abs(f0)) / 100


class Counted:
    """A law that notes for how many conditions it was asked."""

    def __init__(self, law: Callable[..., Any]) -> None:
        self.law = law
        self.asked: list[int] = []

    def __call__(self, f: Any, f0: Any, size: float) -> Any:
        self.asked.append(len(f))
        return self.law(f, f0, size)


def _campaign(name: str = "two-effects") -> hexbench.Campaign:
    return hexbench.load(*case(name)[:2])


def _both(tmp_path: Path, text: str, term: Term) -> tuple[hexbench.Model, hexbench.Model]:
    (tmp_path / "term.toml").write_text(text)
    campaign = _campaign()
    formula, function = (hexbench.fit(campaign, [term.id], terms=[own]) for own in (tmp_path / "term.toml", term))
    return formula, function


def test_a_function_is_fitted_compared_predicted_and_diagnosed_as_its_formula(tmp_path: Path) -> None:
    term = Term(square, id="square-spring", parameters=SIZE)
    formula, function = _both(tmp_path, FORMULA, term)
    assert function.terms == ["square-spring"]
    assert hexbench.fit(_campaign(), [term]).parameters.equals(function.parameters)
    assert np.allclose(function.parameters[["value", "std"]], formula.parameters[["value", "std"]], rtol=1e-9)
    campaign = _campaign()
    errors = [hexbench.compare(campaign, model).error["chi2_reduced"] for model in (formula, function)]
    assert np.isclose(*errors, rtol=1e-12)
    # Poses and loads that no fit has seen.
    poses, loads = campaign.poses[:5] + 1.0, 0.7 * campaign.wrenches[:5]
    assert np.allclose(formula.predict(poses, loads), function.predict(poses, loads), rtol=1e-12)
    assert np.allclose(formula.stiffness(poses, loads).stiffness, function.stiffness(poses, loads).stiffness, rtol=1e-9)
    told = [hexbench.diagnose(campaign, terms=[own]) for own in (tmp_path / "term.toml", term)]
    shares = [{c["term"]: c["probability"] for c in d.candidates} for d in told]
    assert "square-spring" in shares[1] and shares[0] == pytest.approx(shares[1], abs=1e-9)
    assert told[0].added == told[1].added


def test_a_law_is_asked_for_all_conditions_at_once_and_never_twice() -> None:
    law = Counted(square)
    campaign = _campaign("mujoco-clean")
    term = Term(law, id="square-spring", parameters=SIZE)
    law.asked.clear()
    hexbench.fit(campaign, [term.id], terms=[term])
    conditions = len({tuple(row) for row in np.hstack([campaign.poses, campaign.wrenches]).tolist()})
    assert max(law.asked) >= conditions > 20
    # A handful of questions for every step of the fit, not one for every condition.
    assert len(law.asked) < 80 and sum(n == 1 for n in law.asked) < len(law.asked) / 2, law.asked
    law.asked.clear()
    hexbench.fit(campaign, [term.id], terms=[term])
    assert law.asked == []


def test_a_hidden_law_is_found_by_the_function_that_states_it(tmp_path: Path) -> None:
    campaign = _campaign("mujoco-clean")
    true = 40e-9 * 1e-2
    machine = campaign.hexapod
    columns = campaign.to_columns()
    reference = np.column_stack([v for name, v in columns.items() if name.startswith("ref_")])
    f = blocks.leg_forces(machine, campaign.poses, campaign.wrenches)
    f0 = blocks.leg_forces(machine, campaign.poses, reference)
    moved = np.linalg.solve(blocks.leg_jacobian(machine, campaign.poses), (true * (f * np.abs(f) - f0 * np.abs(f0)))[..., None])[..., 0]
    # Deflections are Euler differences; turns are small here and poses near zero.
    hidden = dict(columns)
    for k, name in enumerate(("da_um", "db_um", "dc_um")):
        hidden[name] = columns[name] + 1e6 * moved[:, k]
    spins = [_euler_rates(pose) @ turn for pose, turn in zip(campaign.poses, moved[:, 3:], strict=True)]
    for k, name in enumerate(("dalpha_urad", "dbeta_urad", "dgamma_urad")):
        hidden[name] = columns[name] + 1e6 * np.array(spins)[:, k]
    term = Term(square, id="square-spring", parameters=SIZE)
    altered = hexbench.load(machine, hidden)
    diagnosis = hexbench.diagnose(altered, terms=[term])
    # A law of the catalogue that bends alike may stand beside it.
    assert {"square-spring"} <= {*diagnosis.credible_set, *diagnosis.added}, diagnosis.candidates[:3]
    found = hexbench.fit(altered, ["square-spring"], terms=[term]).parameters.loc["square-spring.size"]
    assert abs(found["value"] - 40) < 4 * found["std"] < 20


def _euler_rates(pose: np.ndarray) -> np.ndarray:
    """Rates of extrinsic X-Y-Z angles from the angular velocity about fixed axes."""
    _, beta, gamma = np.deg2rad(pose[3:])
    (sb, cb), (sg, cg) = (np.sin(beta), np.cos(beta)), (np.sin(gamma), np.cos(gamma))
    return np.linalg.inv(np.array([[cg * cb, -sg, 0], [sg * cb, cg, 0], [-sb, 0, 1]]))


SHAPED = """
format = "term/1"
id = "power-spring"
title = "Legs that soften with a power of the force"
elongation = "size * (sign(f)*abs(f/100)^exponent - sign(f0)*abs(f0/100)^exponent)"
[[parameters]]
name = "size"
unit = "um"
scale = 1
[shape]
name = "exponent"
unit = "1"
bounds = [0.3, 3]
grid = [0.5, 0.7, 1.5, 2, 2.5]
"""


def test_a_law_bends_with_its_shape(tmp_path: Path) -> None:
    def law(f: Any, f0: Any, size: float, exponent: float) -> Any:
        return size * (np.sign(f) * np.abs(f / 100) ** exponent - np.sign(f0) * np.abs(f0 / 100) ** exponent)

    shape = ShapeParameter("exponent", "1", (0.3, 3), (0.5, 0.7, 1.5, 2, 2.5))
    term = Term(law, id="power-spring", parameters=[Parameter("size", "um", 1)], shape=shape)
    formula, function = _both(tmp_path, SHAPED, term)
    assert np.allclose(function.parameters[["value", "std"]], formula.parameters[["value", "std"]], rtol=1e-6)


@pytest.mark.parametrize(
    ("acts", "key"), [("wrench", "N m"), ("base_motion", "rad"), ("platform_motion", "rad")], ids=["wrench", "base", "platform"]
)
def test_six_numbers_act_as_those_of_a_file(tmp_path: Path, acts: Any, key: str) -> None:
    text = f"""
format = "term/1"
id = "own-body"
title = "Turns with the load"
{acts} = ["", "shift * fz / 1000", "", "turn * fz * cos(alpha) / 1000", "", ""]
[[parameters]]
name = "shift"
unit = "{"N" if key == "N m" else "um"}"
scale = 2
[[parameters]]
name = "turn"
unit = "{"N m" if key == "N m" else "urad"}"
scale = 2
"""

    def law(fz: Any, alpha: Any, shift: float, turn: float) -> Any:
        return [0, shift * fz / 1000, 0, turn * fz * np.cos(alpha) / 1000, 0, 0]

    units = ("N", "N m") if key == "N m" else ("um", "urad")
    term = Term(law, id="own-body", acts=acts, parameters=[Parameter("shift", units[0], 2), Parameter("turn", units[1], 2)])
    formula, function = _both(tmp_path, text, term)
    assert np.allclose(function.parameters[["value", "std"]], formula.parameters[["value", "std"]], rtol=1e-9)


def test_a_signature_of_a_function_is_its_law() -> None:
    poses, loads = np.zeros((2, 6)), np.array([[0, 0, -200.0, 0, 0, 0], [0, 0, 100.0, 0, 0, 0]])
    term = Term(lambda df, size: size * df, id="more-spring", parameters=[Parameter("size", "nm/N", 10)])
    machine = _campaign().hexapod
    found = blocks.signatures(machine, "more-spring", poses, loads, terms=[term])
    expected = blocks.regressor(machine, poses, loads) @ np.full(6, 1e-3)
    assert found.readings[:, :, 0] == pytest.approx(expected, rel=1e-9)
    per_leg = Term(lambda df, size: size * df, id="six-springs", parameters=[Parameter("size", "nm/N", 10, per_leg=True)])
    each = blocks.signatures(machine, "six-springs", poses, loads, terms=[per_leg])
    assert each.names == [f"size-leg-{leg}" for leg in range(1, 7)]
    assert each.readings == pytest.approx(blocks.regressor(machine, poses, loads) * 1e-3, rel=1e-9, abs=1e-15)


def test_a_law_that_needs_a_column_is_not_tested_without_it() -> None:
    campaign = _campaign()
    columns = {name: values for name, values in campaign.to_columns().items() if name != "elapsed_s"}
    term = Term(lambda q, elapsed, rate: rate * q * elapsed, id="grows", parameters=[Parameter("rate", "um/s", 1)])
    found = hexbench.diagnose(hexbench.load(campaign.hexapod, columns), terms=[term])
    assert {u["term"]: u["why"] for u in found.untestable}["grows"] == "no elapsed_s column"


def test_laws_that_break_a_rule_are_refused_with_the_reason() -> None:
    def made(law: Callable[..., Any], **more: Any) -> Term:
        return Term(law, id=more.pop("id", "own-law"), parameters=more.pop("parameters", SIZE), **more)

    refused: list[tuple[str, Callable[..., Any], dict[str, Any]]] = [
        ("not linear in `size`", lambda f, size: size**2 * f, {}),
        ("not linear in `size`", lambda f, size: size * f + 1e-9, {}),
        ("another value where it is asked for fewer", lambda f, size: size * (f - f.mean()), {}),
        ("no finite value", lambda f, size: size * np.full_like(f, np.nan), {}),
        ("neither a parameter nor a variable of elongation", lambda ff, size: size * ff, {}),
        ("neither a parameter nor a variable of wrench", lambda q, size: [size * q] * 6, {"acts": "wrench"}),
        ("acts: `spin`", lambda f, size: size * f, {"acts": "spin"}),
        ("is a name of the catalogue", lambda f, size: size * f, {"id": "creep"}),
        ("kebab-case", lambda f, size: size * f, {"id": "Own Law"}),
        ("only an elongation", lambda fz, size: [size * fz] * 6, {"acts": "wrench", "parameters": [Parameter("size", "N", 1, per_leg=True)]}),
        ("state per_si", lambda f, size: size * f, {"parameters": [Parameter("size", "furlong", 1)]}),
    ]
    for why, law, more in refused:
        with pytest.raises(hexbench.BadInput, match=why):
            made(law, **more)
    with pytest.raises(hexbench.UsageError, match="no argument 'size'"):
        made(lambda f: f)
    with pytest.raises(hexbench.UsageError, match="what is not an array"):
        made(lambda f, size: size * f[:, :4])
    with pytest.raises(hexbench.UsageError, match="six arrays"):
        made(lambda fz, size: size * fz, acts="wrench")
    with pytest.raises(hexbench.UsageError, match="has no name of its own"):
        made(lambda *f, size: size)


def test_what_a_law_raises_reaches_the_caller() -> None:
    class NoLawError(Exception):
        pass

    broken = []

    def law(f: Any, size: float) -> Any:
        if broken:
            raise NoLawError("none here")
        return size * f

    term = Term(law, id="own-law", parameters=SIZE)
    broken.append(True)
    with pytest.raises(NoLawError, match="none here"):
        hexbench.fit(_campaign(), ["own-law"], terms=[term])
    broken.clear()
    assert hexbench.fit(_campaign(), ["own-law"], terms=[term]).terms == ["own-law"]


def test_terms_and_diagnoses_with_them_travel_and_models_say_that_no_file_holds_them(tmp_path: Path) -> None:
    term = Term(square, id="square-spring", parameters=SIZE)
    for again in (pickle.loads(pickle.dumps(term)), copy.deepcopy(term)):
        assert again == term and hash(again) == hash(term) and repr(again) == "Term('square-spring', square)"
    diagnosis = hexbench.diagnose(_campaign(), terms=[term])
    again = pickle.loads(pickle.dumps(diagnosis))
    assert again == diagnosis
    again.to_html(tmp_path / "again.html")
    diagnosis.to_html(tmp_path / "first.html")
    assert (tmp_path / "again.html").read_bytes() == (tmp_path / "first.html").read_bytes()
    model = hexbench.fit(_campaign(), ["square-spring"], terms=[term])
    with pytest.raises(hexbench.UsageError, match="square-spring is a Python function, which files cannot contain"):
        model.save(tmp_path / "model.toml")
    assert not (tmp_path / "model.toml").exists()
