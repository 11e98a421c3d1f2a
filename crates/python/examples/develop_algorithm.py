"""An identification of one's own, tried against a truth that it cannot see: develop_algorithm.py SCENE [SEEDS].

The algorithm is plain NumPy: six leg compliances by least squares, rows weighed by the stated noise. It gets what a
laboratory would get; the truth is opened only to judge it, beside the fit of hexbench.
"""

from __future__ import annotations

import sys

import numpy as np
from numpy.typing import NDArray

import hexbench

Array = NDArray[np.float64]


def rotation(angles_deg: Array) -> Array:
    """Return R = Rz(gamma) Ry(beta) Rx(alpha)."""
    (sa, sb, sg), (ca, cb, cg) = np.sin(np.radians(angles_deg)), np.cos(np.radians(angles_deg))
    about_x = np.array([[1, 0, 0], [0, ca, -sa], [0, sa, ca]])
    about_y = np.array([[cb, 0, sb], [0, 1, 0], [-sb, 0, cb]])
    about_z = np.array([[cg, -sg, 0], [sg, cg, 0], [0, 0, 1]])
    return np.asarray(about_z @ about_y @ about_x)


def leg_jacobian(hexapod: hexbench.Hexapod, pose: Array) -> Array:
    """Return leg rates from twist, (6, 6): rows [n', (R B x n)'], m and rad."""
    arms = 1e-3 * hexapod.platform_joints_mm @ rotation(pose[3:]).T
    legs = 1e-3 * pose[:3] + arms - 1e-3 * hexapod.base_joints_mm
    directions = legs / np.linalg.norm(legs, axis=1, keepdims=True)
    return np.hstack([directions, np.cross(arms, directions)])


def identify(campaign: hexbench.Campaign) -> Array:
    """Return six leg stiffnesses, N/um, from deflections under small turns."""
    columns = campaign.to_columns()
    reference = np.column_stack([v for name, v in columns.items() if name.startswith("ref_")])
    noise = campaign.hexapod.sigma_translation_um or 1.0, campaign.hexapod.sigma_rotation_urad or 1.0
    weight = 1e6 / np.repeat(noise, 3)
    rows, values = [], []
    for pose, change, read in zip(campaign.poses, campaign.wrenches - reference, campaign.measured, strict=True):
        motion_of_legs = np.linalg.inv(leg_jacobian(campaign.hexapod, pose))
        # Elongation c f of every leg moves the platform; rotation vectors count as Euler differences near the zero pose.
        rows.append(weight[:, None] * motion_of_legs * (motion_of_legs.T @ change))
        values.append(weight * 1e-6 * read)
    compliance = np.linalg.lstsq(np.vstack(rows), np.concatenate(values), rcond=None)[0]
    return np.asarray(1e-6 / compliance)


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
            stiffnesses(hexbench.fit(measured.campaign, diagnosis.added)),
        )
        true = np.array(measured.truth["leg_stiffness_N_per_um"])
        own, springs, full = (100 * np.max(np.abs(stiffness / true - 1)) for stiffness in found)
        print(f"{seed:4}   {own:13.3f}   {springs:12.3f}   {full:12.3f}  {' '.join(diagnosis.added)}")


if __name__ == "__main__":
    main(sys.argv[1], int(sys.argv[2]) if len(sys.argv) > 2 else 5)
