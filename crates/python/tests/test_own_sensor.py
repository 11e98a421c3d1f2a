"""Sensors that are functions, beside the built-in kinds that they copy."""

import pickle
import re
from pathlib import Path

import numpy as np
import pandas as pd
import pytest
from conftest import ROOT, Command

import hexbench
from hexbench._tables import Floats

SENSOR = re.compile(
    r'name = "(?P<name>\w+)"\nkind = "distance"\npoint_mm = (?P<point>\[.*\])\n'
    r"direction = (?P<direction>\[.*\])\nsigma_um = (?P<sigma>.*)\n"
)


@pytest.fixture
def bench(command: Command, tmp_path: Path) -> Path:
    """The granite table, whose gauges stand exactly where they are said to stand."""
    folder = tmp_path / "bench"
    command("simulate", ROOT / "scenes" / "granite", "-o", folder)
    machine = folder / "hexapod.toml"
    exact = "[tolerances]\nsensor_point_mm = 1e-9\nsensor_direction_deg = 1e-9\nsensor_gain = 1e-9\n\n[[sensor]]"
    machine.write_text(machine.read_text().replace("[[sensor]]", exact, 1))
    return folder


def numbers(text: str) -> Floats:
    return np.array([float(x) for x in text.strip("[]").split(",")])


def copied(bench: Path) -> hexbench.Hexapod:
    """The machine with a function in the place of every gauge."""
    text = (bench / "hexapod.toml").read_text()
    bare = bench / "bare.toml"
    bare.write_text(text.split("[[sensor]]")[0])
    machine = hexbench.Hexapod.read(bare)
    for gauge in SENSOR.finditer(text):
        point, direction = numbers(gauge["point"]), numbers(gauge["direction"])

        def read(transform: Floats, point: Floats = point, direction: Floats = direction) -> float:
            return 1e3 * float(direction @ (transform[:3, :3] @ point + transform[:3, 3]))

        machine = machine.with_sensor(gauge["name"], read, sigma_um=float(gauge["sigma"]))
    return machine


def test_functions_are_diagnosed_compared_fitted_and_predicted_as_the_gauges_that_they_copy(bench: Path) -> None:
    half = pd.read_csv(bench / "measurements.csv").query("pose <= 9")
    built_in, own = hexbench.load(bench / "hexapod.toml", half), hexbench.load(copied(bench), half)
    expected, found = (hexbench.diagnose(campaign, holdout=bench / "holdout.csv") for campaign in (built_in, own))
    assert found.verdict == expected.verdict == "named" and found.added == expected.added
    for one, other in zip(expected.parameters, found.parameters, strict=True):
        assert np.isclose(one["value"], other["value"], rtol=1e-6), one["name"]
        assert np.isclose(one["std"], other["std"], rtol=1e-4), one["name"]
    for one, other in zip(expected.steps, found.steps, strict=True):
        assert np.isclose(one["holdout"]["chi2_reduced"], other["holdout"]["chi2_reduced"], rtol=1e-6)
    errors = [hexbench.compare(campaign).to_dict()["error"]["chi2_reduced"] for campaign in (built_in, own)]
    assert np.isclose(*errors, rtol=1e-6)
    fits = [hexbench.fit(campaign, expected.added) for campaign in (built_in, own)]
    values, stds = zip(*(fit.predict_sensors(own.poses, own.wrenches) for fit in fits), strict=True)
    assert np.allclose(*values, rtol=0, atol=1e-4) and np.allclose(*stds, rtol=1e-3)
    assert fits[0].sensor_columns == fits[1].sensor_columns


def test_a_function_is_not_asked_again_for_poses_that_it_was_asked_for(bench: Path) -> None:
    asked: list[bytes] = []

    def height(transform: Floats) -> float:
        asked.append(transform.tobytes())
        return 1e3 * float(transform[2, 3])

    bare = copied(bench)
    table = hexbench.load(bare, bench / "measurements.csv").to_columns()
    table["z9_um"] = np.zeros(len(table["z1_um"]))
    campaign = hexbench.load(bare.with_sensor("z9", height, sigma_um=0.2), table)
    first = hexbench.compare(campaign).to_json()
    calls = len(asked)
    assert calls > 0 and hexbench.compare(campaign).to_json() == first and len(asked) == calls


def test_what_a_function_raises_reaches_the_caller(bench: Path) -> None:
    class BrokenError(Exception):
        pass

    def broken(transform: Floats) -> float:
        if not np.allclose(transform[:3, :3], np.eye(3)):
            raise BrokenError("no such pose")
        return float(transform[2, 3])

    machine = copied(bench).with_sensor("z9", broken, sigma_um=0.2)
    table = hexbench.load(copied(bench), bench / "measurements.csv").to_columns()
    table["z9_um"] = np.zeros(len(table["z1_um"]))
    with pytest.raises(BrokenError, match="no such pose"):
        hexbench.compare(hexbench.load(machine, table))
    assert hexbench.compare(hexbench.load(copied(bench), bench / "measurements.csv")).to_dict()["error"]["count"] > 0


def test_a_sensor_that_makes_no_sense_is_refused(bench: Path) -> None:
    machine = copied(bench)
    with pytest.raises(hexbench.BadInput, match="z1"):
        machine.with_sensor("z1", lambda _: 0.0, sigma_um=0.2)
    with pytest.raises(hexbench.BadInput, match="small letter"):
        machine.with_sensor("Z 1", lambda _: 0.0, sigma_um=0.2)
    with pytest.raises(hexbench.BadInput, match="standard deviation"):
        machine.with_sensor("z9", lambda _: 0.0, sigma_um=-0.2)
    with pytest.raises(hexbench.UsageError, match="returned NaN"):
        machine.with_sensor("z9", lambda _: float("nan"), sigma_um=0.2)
    for more in ({}, {"sigma_um": 1.0, "sigma_urad": 1.0}):
        with pytest.raises(hexbench.UsageError, match="one standard deviation"):
            machine.with_sensor("z9", lambda _: 0.0, **more)


def test_no_file_holds_a_function(bench: Path) -> None:
    machine = copied(bench)
    model = hexbench.fit(hexbench.load(machine, bench / "measurements.csv"))
    for save in (machine.save, model.save):
        with pytest.raises(hexbench.UsageError, match="which files cannot contain"):
            save(bench / "saved.toml")
    with pytest.raises(hexbench.UsageError, match="which files cannot contain"):
        pickle.dumps(machine)
    assert not (bench / "saved.toml").exists()
    assert machine == machine and machine != copied(bench)
