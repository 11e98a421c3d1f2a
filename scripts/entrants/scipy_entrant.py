"""An entrant in NumPy and SciPy: six springs by least squares, and one effect beside them chosen by BIC.

Kinematics, effects and statistics are written from the published equations, linear at the commanded pose. Probabilities are BIC
weights over "none", each effect alone, and "outside": a model nobody knows that would explain everything with a dozen numbers.
Deflections only. Called as: scipy_entrant.py CASE OUT
"""

import csv
import json
import sys
import tomllib
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from scipy.optimize import least_squares

Array = np.ndarray
DEFLECTIONS = ["da_um", "db_um", "dc_um", "dalpha_urad", "dbeta_urad", "dgamma_urad"]
WRENCH = ["fx_N", "fy_N", "fz_N", "mx_Nm", "my_Nm", "mz_Nm"]
# Numbers that "outside" would need to explain everything.
UNKNOWN_PARAMETERS = 12
NAMED = 0.95
# Start of every spring, m/N, and the unit in which compliances are sought.
USUAL_COMPLIANCE = 2.5e-7


class Declined(Exception):
    """A case that this entrant does not cover."""


@dataclass
class Machine:
    """Joints in m (six rows each), noise of one reading in m and rad."""

    base: Array
    platform: Array
    sigma: Array


@dataclass
class Rows:
    """Everything that is known of some readings before they are made; n rows, six legs."""

    rotation: Array  # n x 3 x 3
    lengths: Array  # n x 6, m
    home: Array  # 6, m
    to_forces: Array  # n x 6 x 6: leg forces of a wrench
    to_reading: Array  # n x 6 x 6: Euler deflections of elongations
    from_twist: Array  # n x 6 x 6: Euler deflections of a twist at the mobile origin
    arm: Array  # n x 3: mobile origin from the centre of the base joints, m
    wrench: Array  # n x 6
    reference: Array  # n x 6
    approach: Array
    delta_t: Array
    elapsed: Array

    @property
    def force(self) -> Array:
        """Leg forces under load, N."""
        return np.einsum("nij,nj->ni", self.to_forces, self.wrench)

    @property
    def reference_force(self) -> Array:
        """Leg forces in the reference state, N."""
        return np.einsum("nij,nj->ni", self.to_forces, self.reference)

    def moved(self, elongations: Array) -> Array:
        """Deflections of elongations."""
        return np.einsum("nij,nj->ni", self.to_reading, elongations)

    def shifted(self, velocity: Array, turn: Array) -> Array:
        """Deflections of a small motion of the platform."""
        return np.einsum("nij,nj->ni", self.from_twist, np.hstack([velocity, turn]))


def machine(path: Path) -> Machine:
    """Read hexapod.toml."""
    with path.open("rb") as file:
        content = tomllib.load(file)
    geometry, noise = content["geometry"], content["metrology"]
    sigma = [noise["sigma_translation_um"] * 1e-6] * 3 + [noise["sigma_rotation_urad"] * 1e-6] * 3
    joints = [np.array(geometry[f"{side}_joints_mm"], dtype=float) * 1e-3 for side in ("base", "platform")]
    return Machine(*joints, np.array(sigma))


def table(path: Path) -> dict[str, Array]:
    """Columns of a table by name."""
    with path.open(newline="") as file:
        rows = list(csv.DictReader(file))
    return {name: np.array([float(row[name]) for row in rows]) for name in rows[0]}


def rotations(angles: Array) -> tuple[Array, Array]:
    """Rotation matrices Rz Ry Rx, and the matrices that turn rates of the angles into a rotation vector."""
    (sx, sy, sz), (cx, cy, cz) = np.sin(angles).T, np.cos(angles).T
    zero, one = np.zeros_like(sx), np.ones_like(sx)
    rz = np.moveaxis(np.array([[cz, -sz, zero], [sz, cz, zero], [zero, zero, one]]), 2, 0)
    ry = np.moveaxis(np.array([[cy, zero, sy], [zero, one, zero], [-sy, zero, cy]]), 2, 0)
    rx = np.moveaxis(np.array([[one, zero, zero], [zero, cx, -sx], [zero, sx, cx]]), 2, 0)
    rates = np.moveaxis(np.array([[cz * cy, -sz, zero], [sz * cy, cz, zero], [-sy, zero, one]]), 2, 0)
    return rz @ ry @ rx, rates


def prepared(hexapod: Machine, columns: dict[str, Array]) -> Rows:
    """Kinematics of every row at its commanded pose."""
    n = len(columns["a_mm"])
    origin = np.stack([columns[f"{axis}_mm"] for axis in "abc"], axis=1) * 1e-3
    rotation, rates = rotations(np.radians(np.stack([columns[f"{a}_deg"] for a in ("alpha", "beta", "gamma")], axis=1)))
    ends = np.einsum("nij,lj->nli", rotation, hexapod.platform)
    legs = origin[:, None, :] + ends - hexapod.base
    lengths = np.linalg.norm(legs, axis=2)
    directions = legs / lengths[:, :, None]
    jacobian = np.concatenate([directions, np.cross(ends, directions)], axis=2)
    from_twist = np.zeros((n, 6, 6))
    from_twist[:, :3, :3] = np.eye(3)
    from_twist[:, 3:, 3:] = np.linalg.inv(rates)
    inverse = np.linalg.inv(jacobian)
    of = lambda name, usual: columns.get(name, np.full(n, usual))  # noqa: E731
    return Rows(
        rotation=rotation,
        lengths=lengths,
        home=np.linalg.norm(hexapod.platform - hexapod.base, axis=1),
        to_forces=np.transpose(inverse, (0, 2, 1)),
        to_reading=from_twist @ inverse,
        from_twist=from_twist,
        arm=origin - hexapod.base.mean(axis=0),
        wrench=np.stack([columns[name] for name in WRENCH], axis=1),
        reference=np.stack([of(f"ref_{name}", 0.0) for name in WRENCH], axis=1),
        approach=of("approach", 1.0),
        delta_t=of("delta_T_K", 0.0),
        elapsed=of("elapsed_s", 0.0),
    )


# An effect takes rows, compliances (m/N) and its own numbers, each of the order of one, and gives deflections (m, rad).
Effect = Callable[[Rows, Array, Array], Array]


def springs(rows: Rows, compliance: Array, _: Array) -> Array:
    """Six leg springs."""
    return rows.moved(compliance * (rows.force - rows.reference_force))


def leg_length_compliance(rows: Rows, _: Array, x: Array) -> Array:
    """Compliance grows with the free length."""
    return rows.moved(1e-6 * x[0] * (rows.lengths - rows.home) * (rows.force - rows.reference_force))


def leg_nonlinearity(rows: Rows, _: Array, x: Array) -> Array:
    """Elongation as a power of the force."""
    power = lambda f: np.sign(f) * np.abs(f / 100.0) ** np.clip(x[1], 0.4, 3.0)  # noqa: E731
    return rows.moved(1e-5 * x[0] * (power(rows.force) - power(rows.reference_force)))


def leg_asymmetry(rows: Rows, _: Array, x: Array) -> Array:
    """A leg is more compliant in tension."""
    return rows.moved(1e-7 * x[0] * (np.maximum(rows.force, 0.0) - np.maximum(rows.reference_force, 0.0)))


def leg_backlash(rows: Rows, _: Array, x: Array) -> Array:
    """Play that opens when the force reverses."""
    return rows.moved(0.5e-5 * x[0] * (np.sign(rows.force) - np.sign(rows.reference_force)))


def joint_friction(rows: Rows, compliance: Array, x: Array) -> Array:
    """The force in the spring lags behind the last motion."""
    last = rows.approach[:, None] * np.sign(rows.force - rows.reference_force)
    return rows.moved(compliance * 3.0 * x[0] * (np.sign(rows.reference_force) - last))


def bracket_compliance(rows: Rows, _: Array, x: Array) -> Array:
    """Joint mounts are softer sideways."""
    direction = np.linalg.inv(np.transpose(rows.to_forces, (0, 2, 1)))[:, :, :3]
    sideways = direction[:, :, 0] ** 2 + direction[:, :, 1] ** 2
    return rows.moved(1e-7 * x[0] * sideways * (rows.force - rows.reference_force))


def base_compliance(rows: Rows, _: Array, x: Array) -> Array:
    """The foundation yields about the centre of the base joints."""
    change = rows.wrench - rows.reference
    force, moment = change[:, :3], change[:, 3:] + np.cross(rows.arm, change[:, :3])
    turn = 1e-7 * x[3:] * moment
    return rows.shifted(1e-8 * x[:3] * force + np.cross(turn, rows.arm), turn)


def platform_compliance(rows: Rows, _: Array, x: Array) -> Array:
    """The plate between legs and targets yields, in its own axes."""
    own = lambda v: np.einsum("nji,nj->ni", rows.rotation, v)  # noqa: E731
    fixed = lambda v: np.einsum("nij,nj->ni", rows.rotation, v)  # noqa: E731
    change = rows.wrench - rows.reference
    return rows.shifted(fixed(1e-8 * x[:3] * own(change[:, :3])), fixed(1e-6 * x[3:] * own(change[:, 3:])))


def load_offset(rows: Rows, compliance: Array, x: Array) -> Array:
    """The load acts away from the mobile origin."""
    change = rows.wrench[:, :3] - rows.reference[:, :3]
    moment = np.cross(rows.rotation @ (1e-3 * x), change)
    return rows.moved(compliance * np.einsum("nij,nj->ni", rows.to_forces[:, :, 3:], moment))


def load_tilt(rows: Rows, compliance: Array, x: Array) -> Array:
    """The directions of the load are tilted."""
    change = rows.wrench[:, :3] - rows.reference[:, :3]
    sideways = np.cross(np.array([1e-2 * x[0], 1e-2 * x[1], 0.0]), change)
    return rows.moved(compliance * np.einsum("nij,nj->ni", rows.to_forces[:, :, :3], sideways))


def thermal_expansion(rows: Rows, _: Array, x: Array) -> Array:
    """Legs grow with temperature."""
    return rows.moved(1e-5 * x[0] * rows.lengths * rows.delta_t[:, None])


def metrology_drift(rows: Rows, _: Array, x: Array) -> Array:
    """The readings drift with time."""
    return np.array([1e-8] * 3 + [1e-7] * 3) * x * rows.elapsed[:, None]


def creep(rows: Rows, compliance: Array, x: Array) -> Array:
    """Compliance grows under load."""
    share = 0.1 * x[0] * (1.0 - np.exp(-rows.elapsed / np.exp(np.clip(x[1], 0.0, 8.0))))
    return rows.moved(compliance * share[:, None] * (rows.force - rows.reference_force))


EFFECTS: dict[str, tuple[Effect | None, list[float]]] = {
    "none": (None, []),
    "leg-length-compliance": (leg_length_compliance, [0.0]),
    "leg-nonlinearity": (leg_nonlinearity, [0.0, 0.7]),
    "leg-asymmetry": (leg_asymmetry, [0.0]),
    "leg-backlash": (leg_backlash, [0.0]),
    "joint-friction": (joint_friction, [0.0]),
    "bracket-compliance": (bracket_compliance, [0.0]),
    "base-compliance": (base_compliance, [0.0] * 6),
    "platform-compliance": (platform_compliance, [0.0] * 6),
    "load-offset": (load_offset, [0.0] * 3),
    "load-tilt": (load_tilt, [0.0] * 2),
    "thermal-expansion": (thermal_expansion, [0.0]),
    "metrology-drift": (metrology_drift, [0.0] * 6),
    "creep": (creep, [0.0, 4.0]),
}


@dataclass
class Fit:
    """A fitted model: numbers, their covariance, chi-square and BIC."""

    effect: Effect | None
    x: Array
    covariance: Array
    bic: float

    def predicted(self, rows: Rows, x: Array) -> Array:
        """Deflections of the model with these numbers, m and rad."""
        compliance = USUAL_COMPLIANCE * x[:6]
        plain = springs(rows, compliance, x)
        return plain if self.effect is None else plain + self.effect(rows, compliance, x[6:])

    def with_sigma(self, rows: Rows) -> tuple[Array, Array]:
        """Predictions and their standard uncertainty."""
        step = 1e-5
        columns = [
            (self.predicted(rows, self.x + d) - self.predicted(rows, self.x - d)) / (2 * step)
            for d in step * np.eye(len(self.x))
        ]
        slope = np.stack(columns, axis=2)
        variance = np.einsum("nki,ij,nkj->nk", slope, self.covariance, slope)
        return self.predicted(rows, self.x), np.sqrt(np.maximum(variance, 1e-30))


def fitted(effect: Effect | None, start: list[float], rows: Rows, readings: Array, sigma: Array) -> Fit:
    """Least squares of springs and one effect."""
    fit = Fit(effect, np.array([1.0] * 6 + start), np.zeros((0, 0)), 0.0)
    found = least_squares(lambda x: ((fit.predicted(rows, x) - readings) / sigma).ravel(), fit.x, x_scale="jac", method="trf")
    fit.x = found.x
    fit.covariance = np.linalg.pinv(found.jac.T @ found.jac, rcond=1e-12)
    fit.bic = 2.0 * found.cost + len(found.x) * np.log(readings.size)
    return fit


def probabilities(fits: dict[str, Fit], numbers: int) -> dict[str, float]:
    """BIC weights, "outside" among them; all effects together count as much as "none" beforehand."""
    bic = {name: fit.bic + (0.0 if name == "none" else 2.0 * np.log(len(fits) - 1)) for name, fit in fits.items()}
    bic["outside"] = numbers + (6 + UNKNOWN_PARAMETERS) * np.log(numbers)
    least = min(bic.values())
    weights = {name: float(np.exp(-0.5 * (value - least))) for name, value in bic.items()}
    total = sum(weights.values())
    return {name: weight / total for name, weight in sorted(weights.items(), key=lambda item: -item[1])}


def diagnosis(probability: dict[str, float]) -> dict:
    """Verdict, effects kept and probabilities."""
    best, share = next(iter(probability.items()))
    kept, held = [], 0.0
    for name, p in probability.items():
        if held < NAMED:
            kept.append(name)
            held += p
    sure = {"none": ("adequate", 0.5), "outside": ("outside", 0.5)}.get(best, ("named", NAMED))
    verdict = sure[0] if share >= sure[1] else "ambiguous"
    return {
        "format": "diagnosis/1",
        "verdict": verdict,
        "added": [best] if verdict == "named" else [],
        "credible_set": kept,
        "candidates": [{"term": name, "probability": p} for name, p in probability.items()],
    }


def stiffnesses(fit: Fit) -> list[dict]:
    """Stiffness of each leg with its standard uncertainty, N/um."""
    compliance = USUAL_COMPLIANCE * fit.x[:6] * 1e6
    std = USUAL_COMPLIANCE * np.sqrt(np.diag(fit.covariance)[:6]) * 1e6
    return [
        {"name": f"leg-{leg + 1}.stiffness", "value": 1.0 / c, "std": s / c**2, "unit": "N/um"}
        for leg, (c, s) in enumerate(zip(compliance, std, strict=True))
        if 0.0 < s < 0.5 * c
    ]


def write_predictions(path: Path, value: Array, sigma: Array) -> None:
    """One row for each of predict.csv."""
    with path.open("w", newline="") as file:
        writer = csv.writer(file, lineterminator="\n")
        writer.writerow(["row", *DEFLECTIONS, *(f"sigma_{name}" for name in DEFLECTIONS)])
        for number, (v, s) in enumerate(zip(value * 1e6, sigma * 1e6, strict=True), start=1):
            writer.writerow([number, *(f"{x:.9g}" for x in (*v, *s))])


def answer(case: Path, out: Path) -> None:
    """Answer one case."""
    hexapod, measured = machine(case / "hexapod.toml"), table(case / "measurements.csv")
    if not all(name in measured for name in DEFLECTIONS):
        raise Declined("this entrant covers deflections only")
    rows, asked = prepared(hexapod, measured), prepared(hexapod, table(case / "predict.csv"))
    readings = np.stack([measured[name] for name in DEFLECTIONS], axis=1) * 1e-6
    fits = {name: fitted(effect, start, rows, readings, hexapod.sigma) for name, (effect, start) in EFFECTS.items()}
    probability = probabilities(fits, readings.size)
    best = fits[max(fits, key=lambda name: probability[name])]
    write_predictions(out / "predictions.csv", *best.with_sigma(asked))
    (out / "parameters.json").write_text(json.dumps({"format": "parameters/1", "parameters": stiffnesses(best)}, indent=1))
    (out / "diagnosis.json").write_text(json.dumps(diagnosis(probability), indent=1))


if __name__ == "__main__":
    try:
        answer(Path(sys.argv[1]), Path(sys.argv[2]))
    except Declined as why:
        sys.exit(str(why))
