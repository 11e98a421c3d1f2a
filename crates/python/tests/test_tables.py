"""Campaigns from files, arrays and tables are one and the same."""

import math
import pickle
from pathlib import Path

import numpy as np
import pandas as pd
import pytest
from conftest import CASES, Command, case

import hexbench

ALL = sorted(folder.name for folder in CASES.iterdir() if folder.is_dir())


@pytest.mark.parametrize("name", ALL)
def test_a_case_read_by_pandas_is_the_case_read_from_its_file(name: str) -> None:
    hexapod, data, _ = case(name)
    of_file = hexbench.load(hexapod, data)
    frame = pd.read_csv(data, comment="#")
    of_frame = hexbench.load(hexapod, frame)
    assert of_frame.to_csv() == of_file.to_csv()
    pd.testing.assert_frame_equal(of_file.to_pandas(), of_frame.to_pandas(), check_exact=True)
    again = hexbench.load(hexapod, of_file.to_pandas())
    assert again.to_csv() == of_file.to_csv()


@pytest.mark.parametrize("name", ["contact", "absolute-pitch"])
def test_arrays_and_columns_hold_the_numbers_of_the_file(name: str) -> None:
    hexapod, data, _ = case(name)
    campaign = hexbench.load(hexapod, data)
    frame = pd.read_csv(data, comment="#")
    for column, values in campaign.to_columns().items():
        assert np.array_equal(values, frame[column].to_numpy(dtype=float)), column
    columns = campaign.to_columns()
    keys = {key: columns[key] for key in ("approach", "delta_T_K", "elapsed_s", "pose", "repeat") if key in columns}
    reference = (
        np.column_stack([columns[f"ref_{n}"] for n in ("fx_N", "fy_N", "fz_N", "mx_Nm", "my_Nm", "mz_Nm")])
        if ("ref_fx_N" in columns)
        else None
    )
    made = hexbench.Campaign.from_arrays(
        campaign.hexapod,
        campaign.poses,
        campaign.wrenches,
        campaign.measured,
        reference=reference,
        absolute=campaign.absolute,
        **keys,
    )
    assert made.to_csv() == campaign.to_csv()


def test_units_in_the_names_are_understood_in_tables_too() -> None:
    hexapod, data, _ = case("contact")
    frame = pd.read_csv(data, comment="#")
    metres = frame.drop(columns="a_mm").assign(a_m=frame["a_mm"] / 1e3)
    read = hexbench.load(hexapod, metres).poses
    assert np.allclose(read, hexbench.load(hexapod, frame).poses, rtol=4 * np.finfo(float).eps, atol=0)


def _as_csv(frame: pd.DataFrame, folder: Path) -> Path:
    path = folder / "measurements.csv"
    frame.to_csv(path, index=False, na_rep="nan")
    return path


def _break(frame: pd.DataFrame, fault: str) -> pd.DataFrame:
    row = 5
    match fault:
        case "nan":
            frame.loc[row, "fz_N"] = math.nan
        case "infinite":
            frame.loc[row, "da_um"] = math.inf
        case "word":
            frame["mx_Nm"] = frame["mx_Nm"].astype(object)
            frame.loc[row, "mx_Nm"] = "ten"
        case "empty":
            frame["mx_Nm"] = frame["mx_Nm"].astype(object)
            frame.loc[row, "mx_Nm"] = ""
        case "half pose":
            frame["pose"] = frame["pose"].astype(float)
            frame.loc[row, "pose"] = 1.5
        case "approach":
            frame.loc[row, "approach"] = 2
        case "angle":
            frame.loc[row, "beta_deg"] = 400.0
        case "missing":
            return frame.drop(columns=["fz_N", "mx_Nm"])
        case "group":
            return frame.drop(columns=["ref_fz_N"])
        case "unit":
            return frame.rename(columns={"fz_N": "fz_mm"})
        case "misspelt":
            return frame.rename(columns={"alpha_deg": "alfa_deg"})
        case "nothing measured":
            return frame.iloc[:, :14]
        case "no rows":
            return frame.iloc[:0]
    return frame


FAULTS = "nan infinite word empty half-pose approach angle missing group unit misspelt nothing-measured no-rows"


@pytest.mark.parametrize("fault", FAULTS.split())
def test_a_table_is_refused_with_the_text_of_the_command(fault: str, tmp_path: Path, command: Command) -> None:
    hexapod, data, _ = case("contact")
    frame = _break(pd.read_csv(data, comment="#"), fault.replace("-", " "))
    path = _as_csv(frame, tmp_path)
    told = command("diagnose", hexapod, path, code=3).stderr
    with pytest.raises(hexbench.BadInput) as of_file:
        hexbench.load(hexapod, path)
    assert f"error: {of_file.value}\n" == told
    with pytest.raises(hexbench.BadInput) as of_frame:
        hexbench.load(hexapod, frame)
    # The same rule and the same next step; line and column become the row, which is in the message where there is one.
    rule = of_file.value.message.rsplit(": ", 1)[1]
    assert of_frame.value.message.startswith("data: ") and of_frame.value.message.endswith(rule), of_frame.value
    assert of_frame.value.next_step == of_file.value.next_step
    assert ("line 7" in of_file.value.message) == ("row 5" in of_frame.value.message), of_frame.value
    assert not of_frame.value.message.startswith("data: line")


def test_what_the_reader_notices_is_a_warning() -> None:
    hexapod, data, _ = case("contact")
    frame = pd.read_csv(data, comment="#")
    with pytest.warns(hexbench.HexbenchWarning, match="humidity.*unknown column, ignored"):
        hexbench.load(hexapod, frame.assign(humidity=1.0))
    doubled = pd.concat([frame, frame.iloc[[3]]])
    with pytest.warns(hexbench.HexbenchWarning, match="identical in every cell"):
        assert len(hexbench.load(hexapod, doubled)) == len(frame)


def test_nullable_object_and_polars_like_columns_are_read() -> None:
    hexapod, data, _ = case("contact")
    frame = pd.read_csv(data, comment="#")
    expected = hexbench.load(hexapod, frame).to_csv()
    for kind in ("Float64", object, "string"):
        assert hexbench.load(hexapod, frame.astype(kind)).to_csv() == expected, kind
    assert hexbench.load(hexapod, frame.to_dict("list")).to_csv() == expected
    assert hexbench.load(hexapod, frame.to_records(index=False).view(np.ndarray)).to_csv() == expected


def test_a_campaign_keeps_its_numbers_through_pickle_and_file(tmp_path: Path) -> None:
    hexapod, data, _ = case("mujoco-foundation")
    campaign = hexbench.load(hexapod, data)
    again = pickle.loads(pickle.dumps(campaign))
    assert again.to_csv() == campaign.to_csv()
    assert hexbench.diagnose(again).to_json() == hexbench.diagnose(campaign).to_json()
    campaign.save(tmp_path / "m.csv")
    assert hexbench.load(hexapod, tmp_path / "m.csv").to_csv() == campaign.to_csv()


def test_a_hexapod_from_arrays_is_that_of_its_file(tmp_path: Path) -> None:
    of_file = hexbench.Hexapod.read(SOURCE)
    made = hexbench.Hexapod(
        of_file.base_joints_mm,
        of_file.platform_joints_mm,
        name=of_file.name,
        sigma_translation_um=of_file.sigma_translation_um,
        sigma_rotation_urad=of_file.sigma_rotation_urad,
    )
    assert made.to_toml() == of_file.to_toml()
    assert pickle.loads(pickle.dumps(made)) == made
    made.save(tmp_path / "hexapod.toml")
    assert hexbench.Hexapod.read(tmp_path / "hexapod.toml") == made


SOURCE = case("mujoco-clean")[0]


def test_a_hexapod_that_is_none_is_refused_with_the_rule() -> None:
    base = hexbench.Hexapod.read(SOURCE).base_joints_mm
    platform = hexbench.Hexapod.read(SOURCE).platform_joints_mm
    same = base.copy()
    same[1] = same[0]
    for joints, rule in ((same, "base joints 1 and 2 are at the same point"), (base * np.nan, "NaN and infinity")):
        with pytest.raises(hexbench.BadInput, match=rule) as told:
            hexbench.Hexapod(joints, platform)
        assert "line" not in told.value.message
    with pytest.raises(hexbench.BadInput, match="greater than zero"):
        hexbench.Hexapod(base, platform, sigma_translation_um=0.0, sigma_rotation_urad=1.0)
