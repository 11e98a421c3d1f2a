"""A session of the workbench, opened in Python and by the command."""

from __future__ import annotations

import hashlib
import json
import pickle
from pathlib import Path

import pytest

import hexbench
from conftest import Command, case


def saved(folder: Path) -> Path:
    """Write a session as the workbench does."""
    files = case("mujoco-foundation")
    inputs = [{"file": path.name, "sha256": hashlib.sha256(path.read_bytes()).hexdigest()} for path in files]
    shown = {"terms": ["base-compliance", "load-offset"], "own": [], "exclude": [3, 7]}
    steps = [{"selection": {}, "times_noise": 1.49}, {"selection": shown, "times_noise": 1.12}]
    kept = {"format": "session/1", "program": "hexbench", "inputs": inputs, "steps": steps, "at": 1, "notes": "door open"}
    path = folder / "session.json"
    path.write_text(json.dumps(kept))
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
