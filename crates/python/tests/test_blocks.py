"""The building blocks against differences, closed forms and the fit itself."""

import numpy as np
import pytest
from conftest import case

import hexbench
from hexbench import blocks

POSES = np.array([[0.0, 0, 0, 0, 0, 0], [8.0, -5, 4, 3, -2, 15], [-6.0, 9, 2, -4, 5, -10]])
WRENCHES = np.array([[0.0, 0, -200, 0, 0, 0], [50.0, 20, -100, 3, -2, 1], [0.0, 80, 10, 0, 4, -6]])


def _rotation(angles_deg: np.ndarray) -> np.ndarray:
    """Extrinsic X-Y-Z."""
    (sa, sb, sg), (ca, cb, cg) = np.sin(np.deg2rad(angles_deg)), np.cos(np.deg2rad(angles_deg))
    x = np.array([[1, 0, 0], [0, ca, -sa], [0, sa, ca]])
    y = np.array([[cb, 0, sb], [0, 1, 0], [-sb, 0, cb]])
    z = np.array([[cg, -sg, 0], [sg, cg, 0], [0, 0, 1]])
    return z @ y @ x


def _machine() -> hexbench.Hexapod:
    return hexbench.Hexapod.read(case("mujoco-foundation")[0])


def _cubic(height_mm: float) -> hexbench.Hexapod:
    """Six edges of a cube standing on a corner; the mobile origin is its centre."""
    edge = height_mm * np.sqrt(3.0)
    axes = np.array([[2.0, -1, -1], [0, np.sqrt(3.0), -np.sqrt(3.0)], [np.sqrt(2.0)] * 3]) / np.sqrt(6.0)
    low = np.array([[0, 0, 1], [1, 0, 0], [1, 0, 0], [0, 1, 0], [0, 1, 0], [0, 0, 1]])
    high = np.array([[1, 0, 1], [1, 0, 1], [1, 1, 0], [1, 1, 0], [0, 1, 1], [0, 1, 1]])
    base, platform = (edge * (corners - 0.5) @ axes.T for corners in (low, high))
    return hexbench.Hexapod(base, platform)


def test_lengths_are_the_distances_between_the_joints() -> None:
    machine = _machine()
    spans = [p[:3] + machine.platform_joints_mm @ _rotation(p[3:]).T - machine.base_joints_mm for p in POSES]
    assert blocks.leg_lengths(machine, POSES) == pytest.approx(np.linalg.norm(spans, axis=2), rel=1e-14)
    assert blocks.leg_lengths(machine, np.empty((0, 6))).shape == (0, 6)


def test_the_leg_jacobian_is_the_slope_of_the_lengths() -> None:
    machine, step = _machine(), 1e-3
    jacobian = blocks.leg_jacobian(machine, POSES)
    for axis in range(3):
        moved = np.eye(6)[axis] * step
        slope = (blocks.leg_lengths(machine, POSES + moved) - blocks.leg_lengths(machine, POSES - moved)) / (2 * step)
        assert np.abs(jacobian[:, :, axis] - slope).max() < 1e-9
    # A turn about fixed z changes gamma alone.
    turn = np.eye(6)[5] * 1e-3
    rates = blocks.leg_lengths(machine, POSES + turn) - blocks.leg_lengths(machine, POSES - turn)
    assert np.abs(jacobian[:, :, 5] - 1e-3 * rates / np.deg2rad(2e-3)).max() < 1e-9


def test_leg_forces_balance_the_wrench() -> None:
    machine = _machine()
    forces = blocks.leg_forces(machine, POSES, WRENCHES)
    for pose, wrench, force in zip(POSES, WRENCHES, forces, strict=True):
        arms = machine.platform_joints_mm @ _rotation(pose[3:]).T
        along = pose[:3] + arms - machine.base_joints_mm
        pull = along / np.linalg.norm(along, axis=1)[:, None] * force[:, None]
        total = np.concatenate([pull.sum(axis=0), np.cross(arms, pull).sum(axis=0) * 1e-3])
        assert total == pytest.approx(wrench, abs=1e-9)


def test_the_regressor_gives_the_stiffnesses_of_the_papers_estimator() -> None:
    hexapod, data, _ = case("paper-protocol")
    campaign = hexbench.load(hexapod, data)
    columns = campaign.to_columns()
    reference = np.column_stack([values for name, values in columns.items() if name.startswith("ref_f") or name.startswith("ref_m")])
    a = blocks.regressor(campaign.hexapod, campaign.poses, campaign.wrenches, reference)
    assert a.shape == (len(campaign), 6, 6)
    found = np.linalg.lstsq(a.reshape(-1, 6), campaign.measured.ravel(), rcond=None)[0]
    model = hexbench.fit(campaign, estimator="paper")
    expected = [model.values[f"leg-{leg}.stiffness"] for leg in range(1, 7)]
    assert 1 / found == pytest.approx(expected, rel=1e-6)


def test_a_cubic_machine_has_the_stiffness_of_the_closed_form() -> None:
    k, height = 3.0, 100.0
    found = blocks.stiffness_matrix(_cubic(height), np.zeros((1, 6)), k)[0]
    turn = 1.5 * k * 1e6 * (height * 1e-3) ** 2
    expected = np.diag([2e6 * k] * 3 + [turn, turn, 4 * turn])
    assert np.abs(found - expected).max() < 1e-9 * np.abs(expected).max()


def test_the_stiffness_matrix_is_that_of_a_model_of_springs_without_load() -> None:
    hexapod, data, _ = case("mujoco-clean")
    model = hexbench.fit(hexbench.load(hexapod, data))
    legs = [model.values[f"leg-{leg}.stiffness"] for leg in range(1, 7)]
    of_model = model.stiffness(POSES).stiffness
    found = blocks.stiffness_matrix(model.hexapod, POSES, legs)
    assert np.abs(found / of_model - 1)[:, 2, 2].max() < 1e-3, np.abs(found / of_model - 1)[:, 2, 2]


def test_a_signature_is_the_slope_of_the_prediction() -> None:
    machine = _machine()
    signature = blocks.signatures(machine, "base-compliance", POSES, WRENCHES)
    assert signature.readings.shape == (3, 6, len(signature.names)) and signature.shape is None
    assert len(signature.units) == len(signature.names) == 6
    # At the zero pose a force of -200 N along z moves a base of 1 nm/N along z by -0.2 um.
    along = signature.readings[0, 2] * np.array([u == "nm/N" for u in signature.units])
    assert along.min() == pytest.approx(-0.2, rel=1e-9) and np.sum(np.abs(along) > 1e-9) == 1
    again = blocks.signatures(machine, "base-compliance", np.vstack([POSES, POSES]), np.vstack([WRENCHES, WRENCHES]))
    assert np.array_equal(again.readings[3:], signature.readings)
    creep = blocks.signatures(machine, "creep", POSES, WRENCHES, elapsed_s=100.0, stiffness_N_per_um=5.0)
    assert creep.shape is not None and np.abs(creep.readings).max() > 0
    with pytest.raises(hexbench.HexbenchError, match="base-compliance"):
        blocks.signatures(machine, "base-complianc", POSES, WRENCHES)


def test_the_likelihood_is_the_product_of_normal_densities() -> None:
    rng = np.random.default_rng(1)
    y, guess, sigma = rng.normal(size=(4, 6)), rng.normal(size=(4, 6)), np.array([0.5] * 3 + [3.0] * 3)
    density = np.exp(-0.5 * ((y - guess) / sigma) ** 2) / (sigma * np.sqrt(2 * np.pi))
    assert blocks.log_likelihood(y, guess, sigma) == pytest.approx(np.log(density).sum(), rel=1e-12)
    assert blocks.residuals(y, guess, sigma) == pytest.approx((y - guess) / sigma)
    with pytest.raises(hexbench.BadInput, match="predicted: expected shape"):
        blocks.residuals(y, guess[1:])
    with pytest.raises(hexbench.BadInput, match="stiffness_N_per_um"):
        blocks.stiffness_matrix(_machine(), POSES, -1.0)
