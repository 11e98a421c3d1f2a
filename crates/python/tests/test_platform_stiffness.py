"""The Cartesian stiffness against the true world: finite differences, and coverage of its intervals by simulation."""

import json
import shutil
from pathlib import Path

import numpy as np
import pytest
from conftest import SCENES

import hexbench
from hexbench import blocks

CAMPAIGNS = 200
POSES = np.array([[0.0, 0, 0, 0, 0, 0], [10.0, -5, 5, 2, -3, 10]])


@pytest.fixture(scope="module")
def scene(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Return the cubic machine of the scenes with springs alone."""
    folder = tmp_path_factory.mktemp("scene") / "cubic"
    shutil.copytree(SCENES / "cubic", folder)
    truth = folder / "sealed" / "truth.toml"
    truth.write_text(truth.read_text().split("[[effect]]")[0])
    return folder


def test_it_is_the_slope_of_the_true_world(scene: Path) -> None:
    found = hexbench.simulate(scene, noise_free=True)
    campaign, true = found.campaign, found.truth["leg_stiffness_N_per_um"]
    columns = campaign.to_columns()
    reference = np.column_stack([columns[name] for name in hexbench._tables.REFERENCE])
    stiffness = blocks.stiffness_matrix(campaign.hexapod, campaign.poses, true)
    twists = np.linalg.solve(stiffness, (campaign.wrenches - reference)[..., None])[..., 0]
    shift = campaign.measured[:, :3]
    error = np.abs(twists[:, :3] * 1e6 - shift).max() / np.abs(shift).max()
    # The world turns the legs under the load: a share of load / (stiffness * leg length), some 1e-4.
    assert error < 2e-3, error


def test_intervals_of_the_stiffness_cover_the_truth(scene: Path) -> None:
    inside, diagonal = [], np.arange(6)
    for seed in range(1, CAMPAIGNS + 1):
        found = hexbench.simulate(scene, seed=seed)
        told = hexbench.fit(found.campaign).stiffness(POSES)
        true = blocks.stiffness_matrix(found.campaign.hexapod, POSES, found.truth["leg_stiffness_N_per_um"])
        z = (told.stiffness - true) / told.stiffness_std
        inside.append(np.abs(z[:, diagonal, diagonal]) < 1.96)
    share = np.mean(inside)
    # Twelve numbers of a campaign hang together: six springs, 1200 independent numbers; three standard deviations are 2 percent.
    assert 0.93 < share < 0.97, share


def test_a_map_is_a_table_for_pandas_with_units(scene: Path, tmp_path: Path) -> None:
    pandas = pytest.importorskip("pandas")
    parquet = pytest.importorskip("pyarrow.parquet")
    model = hexbench.fit(hexbench.simulate(scene).campaign)
    for name in ("map.csv", "map.parquet"):
        hexbench.commands.command("stiffness", model, map=20, load="0,0,-200,0,0,0", output=tmp_path / name)
    table, text = pandas.read_parquet(tmp_path / "map.parquet"), pandas.read_csv(tmp_path / "map.csv")
    assert len(table) == 81 and list(table.columns) == list(text.columns)
    assert np.allclose(table, text, rtol=1e-15, atol=0)
    told = model.stiffness(table[list(hexbench._tables.POSE)].to_numpy(), table[list(hexbench._tables.WRENCH)].to_numpy())
    assert np.allclose(table["K_fz_z_SI"], told.stiffness[:, 2, 2]) and np.allclose(table["C_x_fy_SI"], told.compliance[:, 0, 1])
    schema = parquet.read_schema(tmp_path / "map.parquet")
    assert schema.metadata[b"format"] == b"stiffness-table/1" and b"sha256:model-0.toml" in schema.metadata
    fields = json.loads(schema.metadata[b"fields"])
    units = {name: fields[name]["unit"] for name in ("a_mm", "fz_N", "k_force_1_N_per_m", "sigma_k_moment_1_Nm_per_rad")}
    assert units == {"a_mm": "mm", "fz_N": "N", "k_force_1_N_per_m": "N/m", "sigma_k_moment_1_Nm_per_rad": "N m/rad"}
