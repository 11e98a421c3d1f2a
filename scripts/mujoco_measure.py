"""Make measurement files with a hidden effect from MuJoCo models, and see whether hexbench names the effect.

    hexbench export SCENE --mjcf --states 100000 -o STATES/SCENE         (the whole plan)
    python scripts/mujoco_measure.py make STATES/SCENE --machine hexapod.toml --hidden base-compliance -o CASE
    python scripts/mujoco_measure.py diagnose CASE... --hexbench target/debug/hexbench

`make` reads the plan from states.csv and the machine from the models; the static states in that table are not looked at. An
effect named by --hidden is either in the models already (written there by hexbench as springs, sites and angles), or is one of
those that MuJoCo has by itself and that only this script puts in: `leg-backlash` (a tendon with a dead band in place of the leg
spring), `joint-friction` (frictionloss of the slide joints), `leg-nonlinearity` (a cubic spring). For the first two time runs
along the whole path: unloaded machine, reference, exceeded load where the approach asks for it, load.

`diagnose` exits with 1 unless every case is called by its name: exactly the hidden effect is added and `named`, or the verdict
is `adequate` where nothing is hidden.
"""

from __future__ import annotations

import argparse
import csv
import json
import subprocess
import sys
from dataclasses import dataclass
from pathlib import Path

import mujoco
import numpy as np

from mujoco_bench import MOTORS, Machine, State

# Standard deviation of one reading, m and rad.
SIGMA = np.repeat([0.5e-6, 3e-6], 3)
OVERSHOOT = 1.4
# About that of the legs; sets the damping.
LEG_STIFFNESS_N_PER_M = 4e6
PLAY_M = 3e-6
FRICTION_N = 3.0
# Three percent more force than the linear spring at 30 um.
CUBIC_STIFFNESS = 1.3e14
# Loading that is slow against the machine's own motion. A rotor on each slide joint makes the machine slow, but lets dry
# friction hold: in MuJoCo it creeps, the less the heavier what it holds (here some 1e-8 m/s).
TIME_STEP_S = 1e-4
ROTOR_KG = 10.0
OVER_CRITICAL = 4.0
RAMP_STEPS = 1000
# Speed below which the machine counts as resting, m/s and rad/s, and steps that it may take.
SLOWEST = 2e-7
MOST_HOLD_STEPS = 20_000
CONDITIONS = [
    "pose", "repeat", "a_mm", "b_mm", "c_mm", "alpha_deg", "beta_deg", "gamma_deg",
    "fx_N", "fy_N", "fz_N", "mx_Nm", "my_Nm", "mz_Nm",
    "ref_fx_N", "ref_fy_N", "ref_fz_N", "ref_mx_Nm", "ref_my_Nm", "ref_mz_Nm", "approach", "delta_T_K", "elapsed_s",
]  # fmt: skip
MEASURED = ["da_um", "db_um", "dc_um", "dalpha_urad", "dbeta_urad", "dgamma_urad"]


@dataclass(frozen=True)
class Load:
    """Wrenches on the path of one row, N and N m."""

    reference: np.ndarray
    loaded: np.ndarray
    exceeded: bool

    @classmethod
    def of(cls, row: dict[str, str]) -> Load:
        """From the columns of a row."""
        units = ["N" if motor[0] == "f" else "Nm" for motor in MOTORS]
        wrench = lambda before: np.array([float(row[f"{before}{m}_{u}"]) for m, u in zip(MOTORS, units, strict=True)])  # noqa: E731
        if "order" in row:
            raise SystemExit("The column order is not followed here: every row begins at the unloaded machine.")
        return cls(wrench("ref_"), wrench(""), float(row["approach"]) < 0)

    def path(self) -> list[np.ndarray]:
        """From the reference to the load."""
        over = self.reference + OVERSHOOT * (self.loaded - self.reference)
        return [over, self.loaded] if self.exceeded else [self.loaded]


def with_play(spec: mujoco.MjSpec) -> None:
    """A tendon along each leg spring takes its place: no force within the dead band."""
    for leg in range(1, 7):
        joint = spec.joint(f"leg-{leg}-slide-1")
        band = [joint.springref - 0.5 * PLAY_M, joint.springref + 0.5 * PLAY_M]
        tendon = spec.add_tendon(name=f"leg-{leg}-play", springlength=band, stiffness=joint.stiffness)
        tendon.wrap_joint(joint.name, 1.0)
        joint.stiffness = [0.0, 0.0, 0.0]


def with_hardening(spec: mujoco.MjSpec) -> None:
    """A cubic term in each leg spring."""
    for leg in range(1, 7):
        joint = spec.joint(f"leg-{leg}-slide-1")
        joint.stiffness = [joint.stiffness[0], 0.0, CUBIC_STIFFNESS]


def with_friction(spec: mujoco.MjSpec) -> None:
    """Dry friction beside each leg spring, as hard as the time step allows."""
    for leg in range(1, 7):
        joint = spec.joint(f"leg-{leg}-slide-1")
        joint.frictionloss = FRICTION_N
        joint.solref_friction = [2.0 * TIME_STEP_S, 1.0]
        joint.solimp_friction = [0.9999, 0.9999, 0.001, 0.5, 2.0]


def make_slow(spec: mujoco.MjSpec) -> None:
    """Rotors and damping, so that no leg ever turns back on its way under a growing load."""
    spec.option.timestep = TIME_STEP_S
    for leg in range(1, 7):
        joint = spec.joint(f"leg-{leg}-slide-1")
        joint.armature = ROTOR_KG
        joint.damping = OVER_CRITICAL * np.sqrt(LEG_STIFFNESS_N_PER_M * ROTOR_KG) * np.eye(1, np.size(joint.damping))[0]


BY_MUJOCO = {"leg-backlash": with_play, "joint-friction": with_friction, "leg-nonlinearity": with_hardening}
# A force cubic in the elongation is no power of the force, as the catalogue has it: `ambiguous` is an honest answer there, if
# the effect that is added is the right one.
FORM_OF_ITS_OWN = ("leg-nonlinearity",)
# Of these, the ones whose rest depends on the path or has no unique search direction: time runs.
ALONG_THE_PATH = ("leg-backlash", "joint-friction")


def machine_with(path: Path, hidden: str) -> Machine:
    """The model of a file, and the effect if it is one that MuJoCo makes."""
    spec = mujoco.MjSpec.from_file(str(path))
    if hidden in BY_MUJOCO:
        BY_MUJOCO[hidden](spec)
    if hidden in ALONG_THE_PATH:
        make_slow(spec)
    machine = Machine(spec.compile())
    if hidden not in ALONG_THE_PATH:
        machine.harden_closures()
    return machine


def deflection(path: Path, load: Load, hidden: str) -> np.ndarray:
    """Loaded minus reference: [da, db, dc, dalpha, dbeta, dgamma], m and rad."""
    machine = machine_with(path, hidden)
    if hidden in ALONG_THE_PATH:
        reference = moved(machine, load.reference)
        for wrench in load.path():
            loaded = moved(machine, wrench)
    else:
        reference, loaded = machine.rest(load.reference), machine.rest(load.loaded)
    return loaded.pose() - reference.pose()


def moved(machine: Machine, wrench: np.ndarray) -> State:
    """Slowly from the present load to another."""
    machine.ramp(wrench, RAMP_STEPS)
    return machine.hold(SLOWEST, MOST_HOLD_STEPS)


def make(arguments: argparse.Namespace) -> int:
    """Write a case: hexapod.toml, measurements.csv, holdout.csv, truth.json."""
    with (arguments.states / "states.csv").open(newline="", encoding="utf-8") as file:
        rows = list(csv.DictReader(file))
    effects = [arguments.hidden] if arguments.hidden else []
    true = [deflection(arguments.states / row["model"], Load.of(row), arguments.hidden) for row in rows]
    form = "its own" if arguments.hidden in FORM_OF_ITS_OWN else "the catalogue's"
    for seed in arguments.seed:
        folder = arguments.output if len(arguments.seed) == 1 else Path(f"{arguments.output}-{seed}")
        folder.mkdir(parents=True, exist_ok=True)
        noise = np.random.default_rng(seed)
        for part, name, repeats in (("training", "measurements", 2), ("holdout", "holdout", 1)):
            chosen = [(row, value) for row, value in zip(rows, true, strict=True) if row["part"] == part]
            write_readings(folder / f"{name}.csv", chosen, repeats, noise)
        (folder / "hexapod.toml").write_text(hexapod_with_noise(arguments.machine), encoding="utf-8")
        truth = {"kind": "mujoco", "effects": effects, "form": form, "seed": seed, "mujoco": mujoco.__version__}
        (folder / "truth.json").write_text(json.dumps(truth, indent=1) + "\n", encoding="utf-8")
    return 0


def write_readings(path: Path, rows: list[tuple[dict[str, str], np.ndarray]], repeats: int, noise: np.random.Generator) -> None:
    """Each condition as often as it is read, with noise."""
    with path.open("w", newline="", encoding="utf-8") as file:
        table = csv.writer(file, lineterminator="\n")
        table.writerow(CONDITIONS + MEASURED)
        for row, value in rows:
            for repeat in range(1, repeats + 1):
                reading = value + SIGMA * noise.standard_normal(6)
                conditions = [str(repeat) if key == "repeat" else row[key] for key in CONDITIONS]
                table.writerow(conditions + [f"{x * 1e6:.6f}" for x in reading])


def hexapod_with_noise(path: Path) -> str:
    """The machine's file with the noise of this instrument in it."""
    text = path.read_text(encoding="utf-8")
    return text + "\n[metrology]\nsigma_translation_um = 0.5\nsigma_rotation_urad = 3\n"


def diagnose(arguments: argparse.Namespace) -> int:
    """Run hexbench on every case and compare its verdict with the truth."""
    wrong = 0
    for case in arguments.cases:
        truth = json.loads((case / "truth.json").read_text(encoding="utf-8"))
        files = [str(case / name) for name in ("hexapod.toml", "measurements.csv", "holdout.csv", "diagnosis.json")]
        command = [arguments.hexbench, "diagnose", *files[:2], "--holdout", files[2], "--json", files[3]]
        subprocess.run(command, check=True, stdout=subprocess.DEVNULL)
        found = json.loads(Path(files[3]).read_text(encoding="utf-8"))
        right = found["added"] == truth["effects"] and found["verdict"] in verdicts(truth)
        wrong += not right
        hidden = ", ".join(truth["effects"]) or "nothing"
        said = ", ".join(found["added"]) or "nothing added"
        print(f"{'right' if right else 'WRONG'}  {case.name:28}  hidden: {hidden:26}  {found['verdict']}: {said}", flush=True)
    print(f"{len(arguments.cases) - wrong} of {len(arguments.cases)} right")
    return 1 if wrong else 0


def verdicts(truth: dict) -> tuple[str, ...]:
    """What hexbench may say about a case."""
    if not truth["effects"]:
        return ("adequate",)
    return ("named", "ambiguous") if truth["form"] == "its own" else ("named",)


def parse() -> argparse.Namespace:
    """The command line."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    commands = parser.add_subparsers(required=True)
    making = commands.add_parser("make", help="write a case")
    making.add_argument("states", type=Path, help="folder with models and states.csv")
    making.add_argument("--machine", type=Path, required=True, help="hexapod.toml without [metrology]")
    making.add_argument("--hidden", default="", help="effect that is in the models, or one that MuJoCo makes")
    making.add_argument("--seed", type=int, nargs="+", default=[1], help="of the noise; several write OUTPUT-SEED each")
    making.add_argument("-o", "--output", type=Path, required=True, help="folder of the case")
    making.set_defaults(run=make)
    asking = commands.add_parser("diagnose", help="does hexbench name what is hidden?")
    asking.add_argument("cases", type=Path, nargs="+")
    asking.add_argument("--hexbench", required=True, help="the command")
    asking.set_defaults(run=diagnose)
    return parser.parse_args()


if __name__ == "__main__":
    parsed = parse()
    sys.exit(parsed.run(parsed))
