"""Sensors chosen by hexbench beside those of PySensors, out of the same candidates: D and A of both. `scripts/sensors_peer.sh` calls this.

The rows of the candidates are computed here from the joints of the machine, by another route than the program's:

    y = u . (v + w x R p),   [v; w] = J e,   e_i = c_i f_i

so that the values it states are checked, too. Joints, loads and sensors count as exact on both sides, for PySensors knows no tolerances.
PySensors takes one row for each sensor: with several conditions it gets the direction in which the sensor tells most.
"""

import argparse
import json
import subprocess
import sys
import tomllib
import warnings
from pathlib import Path

import numpy as np
from pysensors.basis import Custom
from pysensors.optimizers import QR, TPGR
from pysensors.reconstruction import SSPOR

ROOT = Path(__file__).resolve().parent.parent
MACHINE = ROOT / "scenes/paper/hexapod.toml"
STIFFNESS_N_PER_M = 4e6
# Relative difference of values that are the same but for the linearization about the deflected pose.
SAME = 5e-3
# Fits of PySensors that leave sensors beyond the number of parameters to chance.
SHUFFLES = 100
# Noise that TPGR is told, over that of the sensors: what it chooses depends on it, and the best counts.
NOISES = [1.0, 10.0, 100.0, 1e3, 1e4]
EXACT = "\n[tolerances]\n" + "".join(
    f"{key} = 1e-9\n"
    for key in (
        "joints_mm",
        "load_gain",
        "load_direction_deg",
        "load_point_mm",
        "frame_deg",
        "noise",
        "sensor_point_mm",
        "sensor_direction_deg",
        "sensor_gain",
    )
)
ONE_LOAD = [([0.0] * 6, [60.0, -40.0, -220.0, 8.0, -5.0, 6.0])]
SEVERAL = [
    ([4.0, -3.0, -2.0, 1.0, -2.0, 9.0], [0.0, 0.0, -220.0, 0.0, 0.0, 0.0]),
    ([-6.0, 5.0, 1.0, -2.0, 1.0, -8.0], [80.0, 0.0, -60.0, 0.0, 6.0, 0.0]),
    ([0.0, 0.0, 3.0, 3.0, 2.0, 0.0], [0.0, -70.0, -90.0, 5.0, 0.0, 9.0]),
    ([2.0, 7.0, 0.0, 0.0, -3.0, 4.0], [40.0, 60.0, 0.0, -9.0, 4.0, -7.0]),
]


def candidates() -> list[tuple[str, np.ndarray, np.ndarray, float]]:
    """Name, point (m), direction and standard deviation (m) of gauges on two rings."""
    gauges = []
    for name, radius, height, count in (("rim", 0.14, 0.03, 10), ("top", 0.07, 0.06, 6)):
        for k in range(count):
            angle = 2 * np.pi * k / count + 0.2
            c, s = np.cos(angle), np.sin(angle)
            point = np.array([radius * c, radius * s, height])
            for letter, direction in (("r", [c, s, 0]), ("t", [-s, c, 0]), ("z", [0, 0, 1]), ("o", [c, s, 1])):
                unit = np.array(direction, dtype=float)
                sigma = 0.3e-6 if letter != "o" else 0.25e-6
                gauges.append((f"{name}{k}{letter}", point, unit / np.linalg.norm(unit), sigma))
    return gauges


def rotation(degrees: list[float]) -> np.ndarray:
    """Rz(gamma) Ry(beta) Rx(alpha)."""
    (ca, cb, cg), (sa, sb, sg) = np.cos(np.radians(degrees)), np.sin(np.radians(degrees))
    about_x = np.array([[1, 0, 0], [0, ca, -sa], [0, sa, ca]])
    about_y = np.array([[cb, 0, sb], [0, 1, 0], [-sb, 0, cb]])
    return np.array([[cg, -sg, 0], [sg, cg, 0], [0, 0, 1]]) @ about_y @ about_x


def rows(conditions: list[tuple[list[float], list[float]]]) -> np.ndarray:
    """Whitened rows: candidates x conditions x six relative changes of compliance."""
    geometry = tomllib.loads(MACHINE.read_text())["geometry"]
    base, platform = (np.array(geometry[f"{side}_joints_mm"]) * 1e-3 for side in ("base", "platform"))
    blocks = []
    for pose, wrench in conditions:
        turn = rotation(pose[3:])
        arms = platform @ turn.T
        spans = np.array(pose[:3]) * 1e-3 + arms - base
        n = spans / np.linalg.norm(spans, axis=1)[:, None]
        inverse = np.linalg.inv(np.hstack([n, np.cross(arms, n)]))
        stretch = inverse.T @ np.array(wrench) / STIFFNESS_N_PER_M
        motion = inverse * stretch
        read = [np.concatenate([u, np.cross(turn @ p, u)]) @ motion / sigma for _, p, u, sigma in candidates()]
        blocks.append(np.array(read))
    return np.stack(blocks, axis=1)


def values(all_rows: np.ndarray, members: list[int]) -> dict[str, float]:
    """D and A of a set, as the program states them; larger is better."""
    block = all_rows[members].reshape(-1, 6)
    information = block.T @ block
    sign, log = np.linalg.slogdet(information)
    if sign <= 0 or np.linalg.cond(information) > 1e12:
        return {"d": 0.0, "a": 0.0}
    return {"d": float(np.exp(log / 6)), "a": float(6 / np.trace(np.linalg.inv(information)))}


def peers(all_rows: np.ndarray, count: int) -> dict[str, dict[str, float]]:
    """D and A of what the optimizers of PySensors choose, by their names; the best of many shuffles of what QR leaves open."""
    u, s, vt = np.linalg.svd(all_rows, full_matrices=False)
    features = s[:, :1] * vt[:, 0, :] * np.sign(u[:, :1, 0])
    best = {}
    for name in ("QR", "TPGR"):
        reached = []
        tries = [(seed, 1.0) for seed in range(SHUFFLES if count > 6 else 1)] if name == "QR" else [(0, x) for x in NOISES]
        for seed, noise in tries:
            optimizer = QR() if name == "QR" else TPGR(n_sensors=count, noise=noise, prior=np.ones(6))
            model = SSPOR(basis=Custom(U=features, n_basis_modes=6), optimizer=optimizer, n_sensors=count)
            with warnings.catch_warnings():
                warnings.simplefilter("ignore")
                model.fit(features.T, quiet=True, seed=seed)
            reached.append(values(all_rows, [int(k) for k in model.get_selected_sensors()[:count]]))
        best[name] = {criterion: max(r[criterion] for r in reached) for criterion in ("d", "a")}
    return best


def write_files(folder: Path, conditions: list[tuple[list[float], list[float]]]) -> list[Path]:
    """Machine, plan and candidates as files."""
    machine, plan, sensors = (folder / name for name in ("machine.toml", "plan.csv", "candidates.toml"))
    machine.write_text(MACHINE.read_text() + EXACT)
    header = "a_mm,b_mm,c_mm,alpha_deg,beta_deg,gamma_deg,fx_N,fy_N,fz_N,mx_Nm,my_Nm,mz_Nm"
    plan.write_text("\n".join([header] + [",".join(map(str, pose + wrench)) for pose, wrench in conditions]) + "\n")
    tables = ['format = "sensor-candidates/1"']
    for name, point, direction, sigma in candidates():
        tables.append(
            f'[[sensor]]\nname = "{name}"\nkind = "distance"\npoint_mm = {(point * 1e3).tolist()}\n'
            f"direction = {direction.tolist()}\nsigma_um = {sigma * 1e6}"
        )
    sensors.write_text("\n".join(tables) + "\n")
    return [machine, plan, sensors]


def ours(program: Path, files: list[Path], count: int, criterion: str) -> tuple[list[int], float]:
    """The set that the program chooses, and the value it states."""
    machine, plan, sensors = files
    command = [program, "design", machine, plan, "--sensors", sensors, "--choose", count, "--criterion", criterion, "--json", "-"]
    out = subprocess.run([str(word) for word in command], check=True, capture_output=True, text=True).stdout
    said = json.loads(out)
    names = [c[0] for c in candidates()]
    value = next(n["value"] for n in said["numbers"] if n["number"] == count)
    return [names.index(s["name"]) for s in said["sensors"]], value


def main() -> int:
    """Compare, tell, and fail where the program is worse."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program", type=Path)
    parser.add_argument("--work", type=Path, required=True)
    arguments = parser.parse_args()
    worse = 0
    print("| conditions | sensors | criterion | hexbench | PySensors QR | PySensors TPGR | computed here |")
    print("|---|---|---|---|---|---|---|")
    for conditions in (ONE_LOAD, SEVERAL):
        all_rows = rows(conditions)
        files = write_files(arguments.work, conditions)
        for count in (6, 7, 8, 10) if len(conditions) == 1 else (3, 4, 6, 8):
            rivals = peers(all_rows, count)
            for criterion in ("d", "a"):
                members, stated = ours(arguments.program, files, count, criterion)
                own = values(all_rows, members)[criterion]
                fails = abs(stated / own - 1) > SAME or any(own < r[criterion] * (1 - 1e-9) for r in rivals.values())
                worse += fails
                others = " | ".join(f"{r[criterion]:.5g}" for r in rivals.values())
                mark = "  worse, or not what is stated" if fails else ""
                print(f"| {len(conditions)} | {count} | {criterion.upper()} | {stated:.5g} | {others} | {own:.5g} |{mark}")
    return 1 if worse else 0


if __name__ == "__main__":
    sys.exit(main())
