"""A hexapod model in MuJoCo: bringing it to rest, reading pose and leg forces.

Shared by mujoco_check.py and mujoco_measure.py. Nothing here knows how a hexapod works: rest is where MuJoCo's own
accelerations vanish, or where its motion ends. SI units.
"""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

import mujoco
import numpy as np

# Constraints close the legs. In MuJoCo they are springs, limited by the time step; at rest there is no time step, so they
# are made about a thousand times as stiff (1/s^2). What gives there then stays under 1e-7 of a deflection.
HARD_CLOSURE = 1e11
# Step of the differences that guide the search for rest, m and rad: rounding (1e-16 of 0.1 m) and curvature are both small.
DIFFERENCE = 1e-7
# Rest is reached when a step is shorter than this, m and rad: a picometre is 1e-8 of a deflection.
LAST_STEP = 1e-12
MOST_STEPS = 20
MOTORS = ("fx", "fy", "fz", "mx", "my", "mz")


class NoRestError(RuntimeError):
    """MuJoCo gave a warning, or did not come to rest: there is no number to compare."""


@dataclass(frozen=True)
class State:
    """A state of rest: mobile origin, its orientation (quaternion), leg forces (tension positive), points of sensors."""

    position: np.ndarray
    orientation: np.ndarray
    forces: np.ndarray
    points: dict[str, np.ndarray]

    def turn_from(self, orientation: np.ndarray) -> np.ndarray:
        """Rotation vector from another orientation to this one, rad."""
        vector = np.zeros(3)
        mujoco.mju_subQuat(vector, self.orientation, orientation)
        return vector

    def turn_about_fixed_axes(self, before: State) -> np.ndarray:
        """Rotation vector from another state to this one in fixed axes, rad."""
        matrix = np.zeros(9)
        mujoco.mju_quat2Mat(matrix, before.orientation)
        return matrix.reshape(3, 3) @ self.turn_from(before.orientation)

    def pose(self) -> np.ndarray:
        """[a, b, c, alpha, beta, gamma], extrinsic X-Y-Z angles."""
        matrix = np.zeros(9)
        mujoco.mju_quat2Mat(matrix, self.orientation)
        r = matrix.reshape(3, 3)
        beta = np.arctan2(-r[2, 0], np.hypot(r[0, 0], r[1, 0]))
        angles = [np.arctan2(r[2, 1], r[2, 2]), beta, np.arctan2(r[1, 0], r[0, 0])]
        return np.concatenate([self.position, angles])


def quaternion(angles: np.ndarray) -> np.ndarray:
    """Orientation of extrinsic X-Y-Z angles, by MuJoCo's own conversion."""
    quat = np.zeros(4)
    mujoco.mju_euler2Quat(quat, np.asarray(angles, dtype=float), "XYZ")
    return quat


class Machine:
    """One model with its state."""

    def __init__(self, model: mujoco.MjModel) -> None:
        self.model = model
        self.data = mujoco.MjData(model)
        names = [model.sensor(i).name for i in range(model.nsensor)]
        sites = [model.site(i).name for i in range(model.nsite)]
        self._points = [name for name in sites if name.startswith("sensor-")]
        self._forces = [[n for n in names if n.startswith(f"leg-{leg}-force-")] for leg in range(1, 7)]

    @classmethod
    def load(cls, path: Path) -> Machine:
        """The model of a file."""
        return cls(mujoco.MjModel.from_xml_path(str(path)))

    def harden_closures(self) -> None:
        """Make the closures as stiff as they can be where no time step limits them."""
        self.model.eq_solref[:] = [-HARD_CLOSURE, -2.0 * np.sqrt(HARD_CLOSURE)]

    def slides(self) -> list[int]:
        """Joints that hold the leg springs."""
        return [j for j in range(self.model.njnt) if "-slide-" in self.model.joint(j).name]

    def keyframe_load(self) -> np.ndarray:
        """Wrench in the keyframe of the file, N and N m."""
        return self.model.key_ctrl[0].copy()

    def rest(self, wrench: np.ndarray) -> State:
        """State where all accelerations vanish, by Newton's method on MuJoCo's accelerations from the commanded pose."""
        mujoco.mj_resetData(self.model, self.data)
        self.data.ctrl[:] = wrench
        place = self.data.qpos.copy()
        for _ in range(MOST_STEPS):
            step = self._step_to_rest(place)
            mujoco.mj_integratePos(self.model, place, step, 1.0)
            if np.abs(step).max() < LAST_STEP:
                self._acceleration(place)
                return self.state()
        raise NoRestError(f"no rest after {MOST_STEPS} steps, the last {np.abs(step).max():.1e} m or rad")

    def ramp(self, wrench: np.ndarray, steps: int) -> None:
        """Bring the load smoothly to a wrench while time runs."""
        start = self.data.ctrl.copy()
        for k in range(1, steps + 1):
            share = 0.5 - 0.5 * np.cos(np.pi * k / steps)
            self.data.ctrl[:] = start + share * (wrench - start)
            mujoco.mj_step(self.model, self.data)

    def hold(self, slowest: float, most_steps: int) -> State:
        """Let time run until nothing moves faster than `slowest` (m/s, rad/s)."""
        for _ in range(most_steps):
            mujoco.mj_step(self.model, self.data)
            if np.abs(self.data.qvel).max() < slowest:
                mujoco.mj_forward(self.model, self.data)
                return self.state()
        self._check_warnings()
        raise NoRestError(f"still moving after {most_steps} steps: {np.abs(self.data.qvel).max():.1e} m/s or rad/s")

    def state(self) -> State:
        """Pose and leg forces as the sensors give them; MuJoCo counts compression positive."""
        self._check_warnings()
        sensor = lambda name: self.data.sensor(name).data  # noqa: E731
        forces = [-np.mean([sensor(name)[2] for name in names]) for names in self._forces]
        points = {name: self.data.site(name).xpos.copy() for name in self._points}
        return State(sensor("position").copy(), sensor("orientation").copy(), np.array(forces), points)

    def _acceleration(self, place: np.ndarray) -> np.ndarray:
        self.data.qpos[:] = place
        self.data.qvel[:] = 0.0
        mujoco.mj_forward(self.model, self.data)
        return self.data.qacc.copy()

    def _step_to_rest(self, place: np.ndarray) -> np.ndarray:
        count = self.model.nv
        slope = np.empty((count, count))
        for k, direction in enumerate(np.eye(count)):
            ends = []
            for side in (DIFFERENCE, -DIFFERENCE):
                moved = place.copy()
                mujoco.mj_integratePos(self.model, moved, direction, side)
                ends.append(self._acceleration(moved))
            slope[:, k] = (ends[0] - ends[1]) / (2.0 * DIFFERENCE)
        acceleration = self._acceleration(place)
        self._check_warnings()
        try:
            step = np.linalg.solve(slope, -acceleration)
        except np.linalg.LinAlgError as cause:
            raise NoRestError("a direction without stiffness") from cause
        if not np.isfinite(step).all():
            raise NoRestError("accelerations that are no numbers")
        return step

    def _check_warnings(self) -> None:
        """A state with bad numbers is reset to a good one by MuJoCo: the warnings are the only trace."""
        for check in (mujoco.mj_checkPos, mujoco.mj_checkVel, mujoco.mj_checkAcc):
            check(self.model, self.data)
        for kind, warning in zip(mujoco.mjtWarning.__members__, self.data.warning, strict=False):
            if warning.number:
                raise NoRestError(f"MuJoCo warned {warning.number} times: {kind}")
