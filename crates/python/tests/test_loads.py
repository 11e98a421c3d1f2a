"""Loads that are chosen together with the poses: the numbers of the command, within their bounds."""

from pathlib import Path

import numpy as np
from conftest import ROOT, Command

import hexbench

MACHINE = ROOT / "scenes" / "paper" / "hexapod.toml"
SPACE = """
format = "space/1"
[poses]
a_mm = [-40, 40]
b_mm = [-40, 40]
gamma_deg = [-30, 30]
[loads]
reference_kg = 12.2
[[loads.between]]
mass_kg = [12.2, 34.5]
fx_N = [-60, 45.25]
[[loads.between]]
pull_N = [0, 80]
along = [0, 3, 4]
"""


def test_chosen_loads_are_those_of_the_command_and_keep_their_bounds(command: Command, tmp_path: Path) -> None:
    space = tmp_path / "space.toml"
    space.write_text(SPACE)
    plan = hexbench.design(hexbench.Hexapod.read(MACHINE), space, starts=8)
    assert command("design", MACHINE, space, "--starts", "8", "-o", tmp_path / "plan.csv").stdout == str(plan)
    table = np.genfromtxt(tmp_path / "plan.csv", delimiter=",", names=True)
    written = np.array([[row[name] for name in ("fx_N", "fy_N", "fz_N", "mx_Nm", "my_Nm", "mz_Nm")] for row in table])
    assert all((load == written).all(axis=1).any() for load in plan.loads) and len(np.unique(written, axis=0)) == 2
    assert plan.loads.shape == (2, 6)
    gravity = 9.80665
    mass, pull = plan.loads
    assert -34.5 * gravity <= mass[2] <= -12.2 * gravity and -60 <= mass[0] <= 45.25
    along = pull - [0, 0, -12.2 * gravity, 0, 0, 0]
    assert np.allclose(along, np.linalg.norm(along) * np.array([0, 0.6, 0.8, 0, 0, 0])) and np.linalg.norm(along) <= 80 * (1 + 1e-12)
    assert "is chosen:" in str(plan)
