"""A session of the workbench, opened in Python and by the command."""

from __future__ import annotations

import hashlib
import json
import pickle
from pathlib import Path

import pytest

import hexbench
from conftest import Command, case


def saved(folder: Path, files: tuple[Path, Path, Path] | None = None, read_as: list[str] | None = None) -> Path:
    """Write a session as the workbench does."""
    files = files or case("mujoco-foundation")
    inputs = [{"file": path.name, "sha256": hashlib.sha256(path.read_bytes()).hexdigest()} for path in files]
    shown = {"terms": ["base-compliance", "load-offset"], "own": [], "exclude": [3, 7]}
    steps = [{"selection": {}, "times_noise": 1.49}, {"selection": shown, "times_noise": 1.12}]
    kept = {"format": "session/1", "program": "hexbench", "inputs": inputs, "steps": steps, "at": 1, "notes": "door open"}
    path = folder / "session.json"
    path.write_text(json.dumps(kept | ({"read_as": read_as} if read_as else {})))
    return path


def test_a_session_gives_the_numbers_of_the_command(tmp_path: Path, command: Command) -> None:
    path = saved(tmp_path)
    session = hexbench.load_session(path)
    assert (session.notes, session.shown.exclude, len(session.steps)) == ("door open", [3, 7], 2)
    hexapod, data, holdout = case("mujoco-foundation")
    model = session.fit(hexbench.load(hexapod, data), holdout=holdout)
    told = json.loads(command("fit", hexapod, data, "--holdout", holdout, "--session", path, "--json", "-").stdout)
    assert model.values == {one["name"]: one["value"] for one in told["parameters"]}
    assert model.stds == {one["name"]: one["std"] for one in told["parameters"]}
    assert "excluded = [" in model.to_toml()
    assert "2 readings are left out of the fit, as requested: lines 3 and 7." in " ".join(model.summary.split())
    assert repr(pickle.loads(pickle.dumps(session))) == repr(session)


def turned(folder: Path) -> tuple[Path, Path, Path]:
    """Write the files with every deflection of the other sign."""
    hexapod, *tables = case("mujoco-foundation")
    made = []
    for table in tables:
        header, *rows = [row.split(",") for row in table.read_text().splitlines()]
        read = [name.startswith("d") and not name.startswith("delta") for name in header]
        flip = [[f"-{cell}".replace("--", "") if turn else cell for cell, turn in zip(row, read)] for row in rows]
        made.append(folder / table.name)
        made[-1].write_text("\n".join(",".join(row) for row in [header, *flip]) + "\n")
    return hexapod, made[0], made[1]


def test_a_session_of_files_read_differently_gives_the_numbers_of_the_command_and_of_the_files_as_meant(
    tmp_path: Path, command: Command
) -> None:
    files = turned(tmp_path)
    way = ["deflection-sign=reversed"]
    path = saved(tmp_path, files, way)
    session = hexbench.load_session(path)
    assert session.read_as == way
    hexapod, data, holdout = files
    model = session.fit(hexbench.load(hexapod, data), holdout=holdout)
    told = json.loads(command("fit", hexapod, data, "--holdout", holdout, "--session", path, "--json", "-").stdout)
    assert model.values == {one["name"]: one["value"] for one in told["parameters"]}
    assert 'read_as = ["deflection-sign=reversed"]' in model.to_toml()
    meant = hexbench.load_session(saved(tmp_path))
    hexapod, data, holdout = case("mujoco-foundation")
    sound = meant.fit(hexbench.load(hexapod, data), holdout=holdout)
    assert meant.read_as == []
    assert model.values == pytest.approx(sound.values, rel=1e-9)


def test_a_session_with_an_unknown_way_to_read_its_files_is_refused(tmp_path: Path) -> None:
    with pytest.raises(hexbench.BadInput, match="which is no way to read files"):
        hexbench.load_session(saved(tmp_path, None, ["deflection-sign=sideways"]))


def test_a_session_beside_another_file_is_refused_with_its_name(tmp_path: Path) -> None:
    session = hexbench.load_session(saved(tmp_path))
    hexapod, data, holdout = case("mujoco-foundation")
    campaign = hexbench.load(hexapod, data)
    with pytest.raises(hexbench.BadInput, match="holdout.csv is not the file of the session"):
        session.fit(campaign, holdout=data)
    with pytest.raises(hexbench.BadInput, match="with held-out measurements, but now there are none"):
        session.fit(campaign)
    with pytest.raises(hexbench.BadInput, match="this is not a session file"):
        hexbench.load_session(data)
