"""Compare states of rest of the simulated world with MuJoCo's.

    hexbench export SCENE --mjcf --states 36 -o STATES/NAME      (once for each set)
    python scripts/mujoco_check.py STATES/*

Each folder holds models, `states.csv` and `hexapod.toml`. Every model is brought to rest in MuJoCo under the load of its row;
pose, leg forces and what sensors read must agree with the row within LIMIT of the deflection, and no warning may be raised.
The table goes to standard output and to `mujoco-differences.csv` in the artefact folder. Exit code 1 when a set fails.

Where MuJoCo comes to rest goes to `rest-mujoco.json` in each folder, for the page on which all worlds stand beside each other:

    hexbench witness SCENE --states 36 --mujoco STATES/NAME/rest-mujoco.json --html worlds.html
"""

from __future__ import annotations

import argparse
import csv
import json
import os
import sys
import time
import tomllib
from dataclasses import dataclass
from pathlib import Path

import mujoco
import numpy as np

from mujoco_bench import MOTORS, Machine, NoRestError, State, quaternion

# Largest difference allowed, as a share of the deflection (poses) or of the largest leg force. The two programs treat large
# rotations of a foundation differently (rotation vector against three hinges), by half its angle: some 1e-6.
LIMIT = 1e-5
# A state reached by letting time run agrees with the one where accelerations vanish up to the softness of the closures,
# which the time step limits.
LIMIT_OF_MOTION = 3e-5
SLOWEST = 1e-10
MOST_TIME_STEPS = 40_000
QUANTITIES = ("translation", "rotation", "force", "sensors")


@dataclass(frozen=True)
class Result:
    """Relative differences of the states of one set: one row per state, one column per quantity."""

    name: str
    differences: np.ndarray
    motion: float
    seconds: float

    def passed(self) -> bool:
        """True when every difference is a number within its limit."""
        return bool((self.differences <= LIMIT).all() and self.motion <= LIMIT_OF_MOTION)

    def cells(self) -> list[str]:
        """Name, states, q75, q99 and largest of each quantity, motion."""
        levels = [np.quantile(column, [0.75, 0.99, 1.0]) for column in self.differences.T]
        numbers = [f"{x:.1e}" for x in np.concatenate(levels)]
        return [self.name, str(len(self.differences)), *numbers, f"{self.motion:.1e}"]


def compare(folder: Path, arguments: argparse.Namespace) -> Result:
    """All states of a folder."""
    begin = time.monotonic()
    with (folder / "states.csv").open(newline="", encoding="utf-8") as file:
        rows = list(csv.DictReader(file))
    if not rows:
        raise NoRestError("states.csv has no rows")
    sensors = tomllib.loads((folder / "hexapod.toml").read_text(encoding="utf-8")).get("sensor", [])
    rests: list[dict[str, object]] = []
    differences = np.array([state_differences(folder, row, sensors, arguments, rests) for row in rows])
    told = {"format": "rest/1", "program": f"MuJoCo {mujoco.__version__}", "states": rests}
    (folder / "rest-mujoco.json").write_text(json.dumps(told, indent=1) + "\n", encoding="utf-8")
    motion = motion_difference(folder / rows[0]["model"])
    return Result(folder.name, differences, motion, time.monotonic() - begin)


def state_differences(
    folder: Path, row: dict[str, str], sensors: list[dict], arguments: argparse.Namespace, rests: list[dict[str, object]]
) -> list[float]:
    """Differences of one state: translation, rotation and sensors in units of the deflection, forces of the largest one.

    Its rest is added to `rests`: load (N, N m), mobile origin (m), orientation (quaternion, scalar first), leg forces (N).
    """
    machine = prepared(folder / row["model"], arguments)
    load, reference = (wrench(row, before) for before in ("", "ref_"))
    if not np.array_equal(load, machine.keyframe_load()):
        raise NoRestError(f"{row['model']}: its keyframe holds another load than its row")
    if arguments.inject_nan:
        load[0] = np.nan
    unloaded, loaded = machine.rest(np.zeros(6)), machine.rest(load)
    place = {"position_m": loaded.position, "orientation": loaded.orientation, "forces_N": loaded.forces}
    numbers = {"load_N_Nm": load, **place}
    rests.append({"model": row["model"], **{key: values.tolist() for key, values in numbers.items()}})
    angles = np.radians([float(row[f"rest_{k}_deg"]) for k in ("alpha", "beta", "gamma")])
    place = np.array([float(row[f"rest_{k}_mm"]) * 1e-3 for k in "abc"])
    forces = np.array([float(row[f"force_{leg}_N"]) for leg in range(1, 7)])
    radius = platform_radius(machine)
    moved = np.linalg.norm(loaded.position - unloaded.position)
    size = max(moved, radius * np.linalg.norm(loaded.turn_from(unloaded.orientation)))
    return [
        float(np.linalg.norm(loaded.position - place) / size),
        float(radius * np.linalg.norm(loaded.turn_from(quaternion(angles))) / size),
        float(np.abs(loaded.forces - forces).max() / np.abs(forces).max()),
        sensor_difference([machine.rest(reference), loaded], row, sensors, radius) / size if sensors else 0.0,
    ]


def wrench(row: dict[str, str], before: str) -> np.ndarray:
    """Load of a row, N and N m; `before`: what the names of its columns begin with."""
    return np.array([float(row[f"{before}{motor}_{'N' if motor[0] == 'f' else 'Nm'}"]) for motor in MOTORS])


def sensor_difference(states: list[State], row: dict[str, str], sensors: list[dict], radius: float) -> float:
    """Largest difference of what sensors read from the reference to the loaded state, m; of angles times the radius."""
    before, loaded = states
    largest = 0.0
    for sensor in sensors:
        name = sensor["name"]
        if sensor["kind"] == "inclination":
            axis = np.array(sensor["axis"], dtype=float)
            turn = loaded.turn_about_fixed_axes(before) @ axis / np.linalg.norm(axis)
            off = radius * abs(turn - float(row[f"{name}_urad"]) * 1e-6)
        else:
            shift = loaded.points[f"sensor-{name}"] - before.points[f"sensor-{name}"]
            if sensor["kind"] == "point":
                read = np.array([float(row[f"{name}_{k}_um"]) for k in "xyz"]) * 1e-6
                off = np.linalg.norm(shift - read)
            else:
                direction = np.array(sensor["direction"], dtype=float)
                off = abs(shift @ direction / np.linalg.norm(direction) - float(row[f"{name}_um"]) * 1e-6)
        largest = max(largest, float(off))
    return largest


def prepared(path: Path, arguments: argparse.Namespace) -> Machine:
    """The model with hard closures, and with whatever fault was asked for."""
    machine = Machine.load(path)
    machine.harden_closures()
    machine.model.jnt_stiffness[machine.slides()] *= arguments.inject_stiffness
    return machine


def platform_radius(machine: Machine) -> float:
    """Mean distance of the platform joints from the mobile origin, m: turns angles into distances."""
    sites = [machine.model.site(f"leg-{leg}-platform-joint").pos for leg in range(1, 7)]
    return float(np.mean([np.linalg.norm(site) for site in sites]))


def motion_difference(path: Path) -> float:
    """How far rest by letting time run, in the model as written, is from rest by vanishing accelerations; relative."""
    still = Machine.load(path)
    still.harden_closures()
    load = still.keyframe_load()
    unloaded, expected = still.rest(np.zeros(6)), still.rest(load)
    moving = Machine.load(path)
    moving.data.ctrl[:] = load
    reached = moving.hold(SLOWEST, MOST_TIME_STEPS)
    size = np.linalg.norm(expected.position - unloaded.position)
    return float(np.linalg.norm(reached.position - expected.position) / size)


def header() -> list[str]:
    """Names of the columns of the table."""
    levels = [f"{q} {level}" for q in QUANTITIES for level in ("q75", "q99", "max")]
    return ["set", "states", *levels, "motion"]


def publish(results: list[Result]) -> None:
    """The table as text, and as a file in the artefact folder."""
    table = [header(), *(result.cells() for result in results)]
    folder = Path(os.environ.get("HEXBENCH_ARTEFACTS", "target/artefacts"))
    folder.mkdir(parents=True, exist_ok=True)
    with (folder / "mujoco-differences.csv").open("w", newline="", encoding="utf-8") as file:
        csv.writer(file, lineterminator="\n").writerows(table)
    short = [[c.replace("translation", "trans").replace("rotation", "rot") for c in line] for line in table]
    widths = [max(len(line[k]) for line in short) for k in range(len(short[0]))]
    for line in short:
        print("  ".join(cell.rjust(width) for cell, width in zip(line, widths, strict=True)))


def parse() -> argparse.Namespace:
    """The command line."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("folders", nargs="+", type=Path, help="folders with models and states.csv")
    parser.add_argument("--inject-nan", action="store_true", help="make the first load no number: the check must fail")
    parser.add_argument(
        "--inject-stiffness",
        type=float,
        default=1.0,
        metavar="FACTOR",
        help="multiply every leg stiffness: the check must fail",
    )
    return parser.parse_args()


def main() -> int:
    """Compare every folder; 0 when all agree."""
    arguments = parse()
    results, broken = [], []
    for folder in arguments.folders:
        try:
            results.append(compare(folder, arguments))
        except NoRestError as cause:
            broken.append(f"{folder.name}: {cause}")
    if results:
        publish(results)
    failed = broken + [f"{r.name}: beyond {LIMIT:.0e} of the deflection" for r in results if not r.passed()]
    count = sum(len(result.differences) for result in results)
    seconds = sum(result.seconds for result in results)
    print(f"MuJoCo {mujoco.__version__}: {count} states in {seconds:.1f} s, limit {LIMIT:.0e}")
    for line in failed:
        print(f"FAILED {line}", file=sys.stderr)
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main())
