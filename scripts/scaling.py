"""What files of more and more rows cost: CPU time and memory of the commands, beside pandas and NumPy.

`scripts/scaling.sh` calls this. Every figure is one run of a process of its own; times are CPU times of all its threads, memory is the
largest it held.
"""

import argparse
import csv
import math
import os
import shutil
import subprocess
import sys
import tomllib
from dataclasses import dataclass
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
SCENES = {"deflections": "hidden-1", "absolute poses": "hidden-8"}
# Of deflections twelve (six loads, read twice), of absolute poses four (unloaded and under a load, read twice).
ROWS_OF_A_POSE = {"deflections": 12, "absolute poses": 4}
COMMANDS = ("fit", "diagnose", "diagnose --html", "compare")
MOST_CONTRADICTORY = 3_000
PEER = "pandas, NumPy"


@dataclass
class Cost:
    """CPU time and largest memory of one run."""

    seconds: float
    megabytes: float


def run(words: list[str], work: Path) -> Cost:
    """One process to its end."""
    with (work / "out.txt").open("wb") as out, (work / "err.txt").open("wb") as err:
        process = subprocess.Popen(words, stdout=out, stderr=err)
        _, status, usage = os.wait4(process.pid, 0)
    code = os.waitstatus_to_exitcode(status)
    if code not in (0, 1):
        raise SystemExit(f"{' '.join(words)} ended with {code}: {(work / 'err.txt').read_text()}")
    return Cost(usage.ru_utime + usage.ru_stime, usage.ru_maxrss / 1024)


def simulated(program: str, kind: str, rows: int, work: Path) -> Path:
    """A folder with a campaign of so many rows."""
    folder = work / f"{SCENES[kind]}-{rows}"
    if not (folder / "measurements.csv").exists():
        shutil.rmtree(folder, ignore_errors=True)
        poses = rows // ROWS_OF_A_POSE[kind]
        scene = str(ROOT / "scenes" / SCENES[kind])
        run([program, "simulate", scene, "--poses", str(poses), "-o", str(folder), "--force"], work)
    return folder


def contradictory(folder: Path) -> Path:
    """The same, but for a coordinate that changes its sign in the middle of the file."""
    other = folder.with_name(folder.name + "-contradictory")
    if (other / "measurements.csv").exists():
        return other
    other.mkdir(exist_ok=True)
    shutil.copy(folder / "hexapod.toml", other)
    with (folder / "measurements.csv").open(newline="") as file:
        count = sum(1 for _ in file) - 1
    # Row by row: what this program holds counts as held by those that it starts.
    with (folder / "measurements.csv").open(newline="") as file, (other / "measurements.csv").open("w", newline="") as out:
        rows, write = csv.reader(file), csv.writer(out)
        names = next(rows)
        write.writerow(names)
        turned = [k for k, name in enumerate(names) if name in ("da_um", "measured_alpha_deg")]
        for n, row in enumerate(rows):
            for k in turned if n >= count // 2 else []:
                row[k] = repr(-float(row[k]))
            write.writerow(row)
    return other


def peer(folder: Path) -> None:
    """Six springs by least squares, as a user would write it with pandas and NumPy."""
    import numpy as np
    import pandas as pd

    geometry = tomllib.loads((folder / "hexapod.toml").read_text())["geometry"]
    base, platform = (np.array(geometry[f"{name}_joints_mm"]) * 1e-3 for name in ("base", "platform"))
    data = pd.read_csv(folder / "measurements.csv", comment="#")
    place = data[["a_mm", "b_mm", "c_mm"]].to_numpy() * 1e-3
    alpha, beta, gamma = np.radians(data[["alpha_deg", "beta_deg", "gamma_deg"]].to_numpy()).T
    (sa, sb, sg), (ca, cb, cg) = (np.array([f(alpha), f(beta), f(gamma)]) for f in (np.sin, np.cos))
    turn = np.array([
        [cg * cb, cg * sb * sa - sg * ca, cg * sb * ca + sg * sa],
        [sg * cb, sg * sb * sa + cg * ca, sg * sb * ca - cg * sa],
        [-sb, cb * sa, cb * ca],
    ]).transpose(2, 0, 1)
    arms = np.einsum("nij,lj->nli", turn, platform)
    spans = place[:, None] + arms - base
    along = spans / np.linalg.norm(spans, axis=2, keepdims=True)
    jacobian = np.linalg.inv(np.concatenate([along, np.cross(arms, along)], axis=2))
    names = ["fx_N", "fy_N", "fz_N", "mx_Nm", "my_Nm", "mz_Nm"]
    change = data[names].to_numpy() - data[[f"ref_{name}" for name in names]].to_numpy()
    forces = np.einsum("nij,ni->nj", jacobian, change)
    weights = 1 / np.array([0.5e-6] * 3 + [3e-6] * 3)
    regressor = (jacobian * forces[:, None, :] * weights[:, None]).reshape(-1, 6)
    measured = data[["da_um", "db_um", "dc_um", "dalpha_urad", "dbeta_urad", "dgamma_urad"]].to_numpy() * 1e-6 * weights
    print(1 / np.linalg.lstsq(regressor, measured.reshape(-1), rcond=None)[0])


def measured(program: str, rows: list[int], work: Path) -> dict[tuple[str, bool], dict[str, dict[int, Cost]]]:
    """Costs by kind of data, soundness, command and number of rows."""
    found: dict[tuple[str, bool], dict[str, dict[int, Cost]]] = {}
    for kind in SCENES:
        for is_sound in (True, False):
            table = found.setdefault((kind, is_sound), {})
            for count in rows:
                folder = simulated(program, kind, count, work)
                folder = folder if is_sound else contradictory(folder)
                files = [str(folder / name) for name in ("hexapod.toml", "measurements.csv")]
                for command in COMMANDS:
                    if count > MOST_CONTRADICTORY and not is_sound:
                        continue
                    page = ["--html", str(work / "page.html")] if "--html" in command else []
                    table.setdefault(command, {})[count] = run([program, command.split()[0], *files, *page], work)
                if kind == "deflections" and is_sound:
                    words = [sys.executable, __file__, program, "--peer", str(folder)]
                    table.setdefault(PEER, {})[count] = run(words, work)
                print(kind, "sound" if is_sound else "contradictory", count, "rows", file=sys.stderr)
    return found


def short(seconds: float) -> str:
    """Seconds in two digits."""
    return f"{seconds:.2f}" if seconds < 1 else f"{seconds:.1f}" if seconds < 10 else f"{seconds:.0f}"


def exponent(costs: dict[int, Cost]) -> str:
    """By which power of the rows the time grows between the last two sizes."""
    if len(costs) < 2:
        return ""
    (a, before), (b, last) = sorted(costs.items())[-2:]
    return f"{math.log(last.seconds / before.seconds) / math.log(b / a):.2f}"


def document(found: dict[tuple[str, bool], dict[str, dict[int, Cost]]], rows: list[int]) -> str:
    """The page."""
    lines = [
        "# What more rows cost",
        "",
        "Written by `scripts/scaling.sh`; do not edit.",
        "",
        f"{os.cpu_count()} cores. Every figure is one run: CPU time of all threads in seconds, and the largest memory in megabytes. The",
        "exponent is the power of the rows with which the time grows between the last two sizes. Every condition is read twice; no poses are",
        "held out, so that `diagnose` chooses its terms anew for poses left out. *Contradictory*: from the middle of the file on da (deflections) or",
        "the measured alpha (absolute poses) has the other sign. The line of pandas and NumPy reads the file and fits six springs, without",
        "noise levels, tolerances, checks or second-order terms; on all data `fit` does all of these. Of more than 50 000 rows, `diagnose` and",
        "`compare` read all and use 50 000, of poses drawn at random.",
    ]
    for (kind, is_sound), table in found.items():
        lines += ["", f"## {kind.capitalize()}, {'sound' if is_sound else 'contradictory'}", ""]
        lines.append("| | " + " | ".join(f"{count} rows" for count in rows) + " | exponent |")
        lines.append("|---" * (len(rows) + 2) + "|")
        for command, costs in table.items():
            name = command if command == PEER else f"`{command}`"
            cells = [f"{short(costs[n].seconds)} s, {costs[n].megabytes:.0f} MB" if n in costs else "not run" for n in rows]
            lines.append(f"| {name} | " + " | ".join(cells) + f" | {exponent(costs)} |")
    return "\n".join(lines) + "\n"


def main() -> None:
    """Measures, and writes the page."""
    arguments = argparse.ArgumentParser()
    arguments.add_argument("program")
    arguments.add_argument("--work", type=Path)
    arguments.add_argument("--page", type=Path)
    arguments.add_argument("--peer", type=Path)
    arguments.add_argument("--rows", type=int, nargs="+", default=[240, 2_400, 24_000, 240_000, 1_000_000])
    given = arguments.parse_args()
    if given.peer:
        peer(given.peer)
        return
    given.page.write_text(document(measured(given.program, given.rows, given.work), given.rows))


if __name__ == "__main__":
    main()
