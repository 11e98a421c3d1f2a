"""An identification of one's own, tried against a truth that it cannot see: develop_algorithm.py SCENE [SEEDS].

The algorithm is NumPy on the building blocks of hexbench: six leg compliances by least squares, rows weighed by the stated
noise. It gets what a laboratory would get; the truth is opened only to judge it, beside the fit of hexbench.
"""

from __future__ import annotations

import sys

import numpy as np
from numpy.typing import NDArray

import hexbench
from hexbench import blocks

Array = NDArray[np.float64]


def identify(campaign: hexbench.Campaign) -> Array:
    """Return six leg stiffnesses, N/um, by the paper's regressor."""
    columns = campaign.to_columns()
    reference = np.column_stack([v for name, v in columns.items() if name.startswith("ref_")])
    noise = campaign.hexapod.sigma_translation_um or 1.0, campaign.hexapod.sigma_rotation_urad or 1.0
    weight = 1.0 / np.repeat(noise, 3)
    a = blocks.regressor(campaign.hexapod, campaign.poses, campaign.wrenches, reference)
    rows = (weight[:, None] * a).reshape(-1, 6)
    compliance = np.linalg.lstsq(rows, (weight * campaign.measured).ravel(), rcond=None)[0]
    return np.asarray(1.0 / compliance)


def stiffnesses(model: hexbench.Model) -> Array:
    """Return the six leg stiffnesses of a model, N/um."""
    return np.array([model.values[f"leg-{leg}.stiffness"] for leg in range(1, 7)])


def main(scene: str, seeds: int = 5) -> None:
    """Print the largest error of a leg stiffness, in percent, of three algorithms."""
    print("largest error of a leg stiffness, %")
    print("seed   own algorithm   hexbench.fit   hexbench.fit with what diagnose adds")
    for seed in range(1, seeds + 1):
        measured = hexbench.simulate(scene, seed=seed)
        diagnosis = hexbench.diagnose(measured.campaign, holdout=measured.holdout)
        found = (
            identify(measured.campaign),
            stiffnesses(hexbench.fit(measured.campaign)),
            stiffnesses(hexbench.fit(measured.campaign, diagnosis.add)),
        )
        true = np.array(measured.truth["leg_stiffness_N_per_um"])
        own, springs, full = (100 * np.max(np.abs(stiffness / true - 1)) for stiffness in found)
        print(f"{seed:4}   {own:13.3f}   {springs:12.3f}   {full:12.3f}  {' '.join(diagnosis.added)}")


if __name__ == "__main__":
    main(sys.argv[1], int(sys.argv[2]) if len(sys.argv) > 2 else 5)
