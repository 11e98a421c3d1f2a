"""The Cartesian stiffness against the true world: finite differences, and coverage of its intervals by simulation."""

import shutil
from pathlib import Path

import numpy as np
import pytest
from conftest import SCENES

import hexbench
from hexbench import blocks

CAMPAIGNS = 80
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
    # Twelve numbers of a campaign hang together: six springs, 480 independent numbers; three standard deviations are 3 percent.
    assert 0.92 < share < 0.98, share
