"""Tasks of hexbench against what its users would write in Python: the paper's search for poses and simulated campaigns.

Both sides run the same task on one thread; times are CPU times. `scripts/benchmark.sh` calls this.
"""

import argparse
import csv
import os
import platform
import resource
import subprocess
import time
import tomllib
from collections.abc import Callable
from pathlib import Path

import numpy as np
import scipy
from scipy.optimize import minimize

ROOT = Path(__file__).resolve().parent.parent
MACHINE = ROOT / "scenes/paper/hexapod.toml"
SPACE = ROOT / "data/designs/paper-space.toml"
GRAVITY_M_PER_S2 = 9.80665
POSES = 3
FREE = [0, 1, 2, 5]
# As in crates/design/examples/benchmark.rs.
STIFFNESS = np.array([4.1981e6, 3.7898e6, 2.7503e6, 4.32e6, 3.6716e6, 3.7288e6])
SIGMA = np.array([0.8165e-6] * 3 + [9.6225e-6] * 2 + [6.8041e-6])
PLAN_MM_DEG = np.array([[2.616, 0.832, -0.666, 15.756], [10.017, -3.434, -0.764, -11.007], [-7.784, -3.21, 1.76, -11.266]])
REPEATS = 3
TOLERANCE_UM = 50.0
# Machines of other shapes, and their travel and stroke as shares of the legs, for level poses as in the paper.
OTHER_MACHINES = [ROOT / f"scenes/{name}/hexapod.toml" for name in ("cubic", "granite", "hidden-1")]
TRAVEL, STROKE = 0.2, 0.08
# Two values of the criterion within this share count as the same optimum.
SAME = 1e-4


def machine(file: Path = MACHINE) -> tuple[np.ndarray, np.ndarray]:
    """Base and platform joints, m (6x3 each)."""
    geometry = tomllib.loads(file.read_text())["geometry"]
    return np.array(geometry["base_joints_mm"]) * 1e-3, np.array(geometry["platform_joints_mm"]) * 1e-3


class PoseSearch:
    """-ln O1 of three level poses and the strokes of their legs, with derivatives; twelve variables scaled to 0..1."""

    def __init__(self, hexapod: Path = MACHINE, space_file: Path = SPACE) -> None:
        self.base, self.platform = machine(hexapod)
        space = tomllib.loads(space_file.read_text())
        ranges = [np.array(space["poses"][f"{name}_mm"]) * 1e-3 for name in "abc"]
        ranges.append(np.radians(space["poses"]["gamma_deg"]))
        self.low, self.span = np.array([r[0] for r in ranges]), np.array([r[1] - r[0] for r in ranges])
        limits = space["limits"]
        self.shortest, self.longest = limits["min_length_mm"] * 1e-3, limits["max_length_mm"] * 1e-3
        mass = space["loads"]["masses_kg"][0] - space["loads"]["reference_kg"]
        self.wrench = np.array([0.0, 0.0, -mass * GRAVITY_M_PER_S2, 0.0, 0.0, 0.0])

    def legs(self, x: np.ndarray) -> tuple[np.ndarray, ...]:
        """Rotation, arms, lengths and directions of all poses at once."""
        pose = self.low + x.reshape(POSES, 4) * self.span
        cos, sin = np.cos(pose[:, 3]), np.sin(pose[:, 3])
        turn = np.zeros((POSES, 3, 3))
        turn[:, 0, 0], turn[:, 0, 1], turn[:, 1, 0], turn[:, 1, 1], turn[:, 2, 2] = cos, -sin, sin, cos, 1.0
        arms = self.platform @ turn.transpose(0, 2, 1)
        spans = pose[:, None, :3] + arms - self.base
        lengths = np.sqrt((spans * spans).sum(axis=2))
        return turn, arms, lengths, spans / lengths[:, :, None]

    def regressor(self, x: np.ndarray) -> tuple[np.ndarray, ...]:
        """Rows of the regressor (3x6x6) and what its derivative needs."""
        turn, arms, lengths, n = self.legs(x)
        jacobian = np.concatenate([n, np.cross(arms, n)], axis=2)
        inverse = np.linalg.inv(jacobian)
        forces = np.einsum("pij,i->pj", inverse, self.wrench)
        # At level poses Euler rates are angular velocities turned back about Z.
        euler = np.zeros((POSES, 6, 6))
        euler[:, :3, :3], euler[:, 3:, 3:] = np.eye(3), turn.transpose(0, 2, 1)
        return euler, inverse, forces, arms, lengths, n

    def value(self, x: np.ndarray) -> float:
        """-ln O1."""
        euler, inverse, forces, *_ = self.regressor(x)
        rows = ((euler @ inverse) * forces[:, None, :]).reshape(-1, 6)
        return -np.linalg.slogdet(rows.T @ rows)[1] / 12 + 0.5 * np.log(POSES)

    def value_and_gradient(self, x: np.ndarray) -> tuple[float, np.ndarray]:
        """-ln O1 and its exact gradient."""
        euler, inverse, forces, arms, lengths, n = self.regressor(x)
        blocks = euler @ inverse
        rows = blocks * forces[:, None, :]
        information = np.einsum("pij,pik->jk", rows, rows)
        value = -np.linalg.slogdet(information)[1] / 12 + 0.5 * np.log(POSES)
        weighted = rows @ np.linalg.inv(information)
        darms, dspans = self.motions(arms)
        dn = (dspans - n[:, None] * (n[:, None] * dspans).sum(axis=3, keepdims=True)) / lengths[:, None, :, None]
        dmoments = np.cross(darms, n[:, None]) + np.cross(arms[:, None], dn)
        djacobian = np.concatenate([dn, dmoments], axis=3)
        dinverse = -inverse[:, None] @ djacobian @ inverse[:, None]
        dforces = -np.einsum("pki,pckj,pj->pci", inverse, djacobian.transpose(0, 1, 3, 2), forces)
        drows = euler[:, None] @ dinverse * forces[:, None, None, :] + blocks[:, None] * dforces[:, :, None, :]
        # The turn of the Euler axes leaves rows' rows as they are up to a rotation that cancels in the trace.
        slope = -np.einsum("pij,pcij->pc", weighted, drows) / 6
        return value, (slope * self.span).ravel()

    def motions(self, arms: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """How arms and spans move with the four coordinates of each pose (3x4x6x3)."""
        darms, dspans = np.zeros((POSES, 4, 6, 3)), np.zeros((POSES, 4, 6, 3))
        darms[:, 3, :, 0], darms[:, 3, :, 1] = -arms[:, :, 1], arms[:, :, 0]
        dspans[:, :3] = np.eye(3)[None, :, None, :]
        dspans[:, 3] = darms[:, 3]
        return darms, dspans

    def strokes(self, x: np.ndarray) -> np.ndarray:
        """What is left of the stroke, mm (36)."""
        lengths = self.legs(x)[2].ravel()
        return 1e3 * np.concatenate([lengths - self.shortest, self.longest - lengths])

    def strokes_slope(self, x: np.ndarray) -> np.ndarray:
        """Derivative of the strokes (36x12)."""
        _, arms, _, n = self.legs(x)
        _, dspans = self.motions(arms)
        slope = np.zeros((POSES, 6, POSES, 4))
        for pose in range(POSES):
            slope[pose, :, pose] = 1e3 * np.einsum("li,cli->lc", n[pose], dspans[pose]) * self.span
        slope = slope.reshape(6 * POSES, 4 * POSES)
        return np.concatenate([slope, -slope])

    def scaled(self, start: np.ndarray) -> np.ndarray:
        """Twelve variables of three poses."""
        return ((start.reshape(POSES, 6)[:, FREE] - self.low) / self.span).ravel()

    def climb(self, start: np.ndarray, exact: bool) -> float:
        """O1 at the end of one start; zero outside the limits."""
        slack_mm = 1e-4
        constraint = {"type": "ineq", "fun": self.strokes} | ({"jac": self.strokes_slope} if exact else {})
        end = minimize(
            self.value_and_gradient if exact else self.value,
            self.scaled(start),
            jac=exact or None,
            method="SLSQP",
            bounds=[(0, 1)] * (4 * POSES),
            constraints=[constraint],
            options={"ftol": 1e-9, "maxiter": 300},
        )
        return float(np.exp(-self.value(end.x))) if self.strokes(end.x).min() > -slack_mm else 0.0


class Campaigns:
    """Campaigns of the paper's plan: linear world, noise on every number, least squares in batches."""

    def __init__(self) -> None:
        self.base, self.platform = machine()
        self.wrench = np.array([0.0, 0.0, -22.3 * 9.81, 0.0, 0.0, 0.0])
        self.translation, self.gamma = PLAN_MM_DEG[:, :3] * 1e-3, np.radians(PLAN_MM_DEG[:, 3])
        cos, sin, zero, one = np.cos(self.gamma), np.sin(self.gamma), np.zeros(3), np.ones(3)
        self.turn = np.array([[cos, -sin, zero], [sin, cos, zero], [zero, zero, one]]).transpose(2, 0, 1)

    def rows(self, base: np.ndarray, platform: np.ndarray) -> np.ndarray:
        """Whitened regressors (n x 18 x 6) of machines (n x 6 x 3), columns in units of the true compliances."""
        arms = np.einsum("pij,nlj->npli", self.turn, platform)
        spans = self.translation[:, None] + arms - base[:, None]
        n = spans / np.sqrt((spans * spans).sum(axis=3, keepdims=True))
        inverse = np.linalg.inv(np.concatenate([n, np.cross(arms, n)], axis=3))
        forces = np.einsum("npij,i->npj", inverse, self.wrench)
        inverse[:, :, 3:] = self.turn.transpose(0, 2, 1) @ inverse[:, :, 3:]
        inverse *= (forces / STIFFNESS)[:, :, None, :]
        inverse /= SIGMA[:, None]
        return inverse.reshape(-1, 18, 6)

    def same_machine(self, count: int, rng: np.random.Generator) -> np.ndarray:
        """Fitted stiffnesses; one inverse serves all campaigns."""
        once = self.rows(self.base[None], self.platform[None])[0].reshape(POSES, 6, 6)
        rows = np.repeat(once, REPEATS, axis=0).reshape(-1, 6)
        readings = rng.standard_normal((count, 6 * POSES * REPEATS))
        readings += rows.sum(axis=1)
        return STIFFNESS / (readings @ np.linalg.pinv(rows).T)

    def own_machines(self, count: int, rng: np.random.Generator) -> np.ndarray:
        """Fitted stiffnesses; every campaign has joints and a regressor of its own."""
        off = TOLERANCE_UM * 1e-6
        base = self.base + off * rng.standard_normal((count, 6, 3))
        platform = self.platform + off * rng.standard_normal((count, 6, 3))
        rows = self.rows(base, platform)
        noise = rng.standard_normal((count, POSES, REPEATS, 6)).mean(axis=2).reshape(-1, 18)
        readings = rows.sum(axis=2) + noise
        across = rows.transpose(0, 2, 1)
        return STIFFNESS / np.linalg.solve(across @ rows, across @ readings[:, :, None])[:, :, 0]

    def run(self, make: Callable[[int, np.random.Generator], np.ndarray], count: int, batch: int) -> tuple[float, np.ndarray]:
        """CPU time per campaign and the stiffnesses."""
        rng = np.random.Generator(np.random.PCG64(1))
        make(batch, rng)
        begun = time.process_time()
        fitted = [make(batch, rng) for _ in range(count // batch)]
        return (time.process_time() - begun) / (count // batch * batch), np.concatenate(fitted)


def ours(program: Path, *words: object) -> tuple[float, str]:
    """CPU time and output of our side on one thread."""
    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    one_thread = os.environ | {"RAYON_NUM_THREADS": "1"}
    done = subprocess.run([program, *map(str, words)], check=True, capture_output=True, text=True, env=one_thread)
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    return after.ru_utime - before.ru_utime + after.ru_stime - before.ru_stime, done.stdout


def short(seconds: float) -> str:
    """A time with three digits and its unit."""
    for unit, size in [("s", 1.0), ("ms", 1e-3), ("us", 1e-6)]:
        if seconds >= size:
            return f"{seconds / size:.3g} {unit}"
    return f"{seconds * 1e9:.3g} ns"


def check_gradients(search: PoseSearch, x: np.ndarray) -> None:
    """The exact gradient is one, so that SciPy is not slowed by a mistake of ours."""
    step, tolerance = 1e-6, 1e-5
    unit = np.eye(len(x)) * step
    differences = np.array([search.value(x + d) - search.value(x - d) for d in unit]) / (2 * step)
    off = np.abs(differences - search.value_and_gradient(x)[1]).max() / np.abs(differences).max()
    assert off < tolerance, f"the gradient is off by {off:.1e}"
    strokes = np.array([search.strokes(x + d) - search.strokes(x - d) for d in unit]).T / (2 * step)
    assert np.abs(strokes - search.strokes_slope(x)).max() < tolerance * np.abs(strokes).max()


def benchmark_search(programs: dict[str, Path], work: Path, count: int) -> list[str]:
    """The paper's search from the same starts on both sides."""
    file = work / "starts.csv"
    file.write_text(ours(next(iter(programs.values())), "starts", MACHINE, SPACE, count)[1])
    starts = np.loadtxt(file, delimiter=",")
    search = PoseSearch()
    check_gradients(search, search.scaled(starts[0]))
    results = {}
    for name, program in programs.items():
        seconds, values = ours(program, "search", MACHINE, SPACE, file)
        results[name] = (seconds / count, np.array(values.split(), dtype=float))
    for name, exact, some in [("SciPy, exact gradient", True, count), ("SciPy, numerical gradient", False, count // 10)]:
        begun = time.process_time()
        values = np.array([search.climb(start, exact) for start in starts[:some]])
        results[name] = ((time.process_time() - begun) / some, values)
    best = max(values.max() for _, values in results.values())
    lines = ["| | starts | CPU time per start | best O1 | reach the best of all | times faster |", "|---|---|---|---|---|---|"]
    for name, (seconds, values) in results.items():
        reach = 100 * np.count_nonzero(values >= (1 - SAME) * best) / len(values)
        faster = results["SciPy, exact gradient"][0] / seconds
        lines.append(f"| {name} | {len(values)} | {short(seconds)} | {values.max():.6f} | {reach:.1f} % | {faster:.1f} |")
    return lines


def level_space(hexapod: Path, work: Path) -> Path:
    """A design problem as the paper's on another machine: its travel and stroke in proportion to the legs at the zero pose."""
    base, platform_joints = machine(hexapod)
    lengths = np.linalg.norm(platform_joints - base, axis=1) * 1e3
    reach = TRAVEL * lengths.mean()
    file = work / f"{hexapod.parent.name}-space.toml"
    file.write_text(
        f"""format = "space/1"
[poses]
a_mm = [{-reach}, {reach}]
b_mm = [{-reach}, {reach}]
c_mm = [{-reach / 2}, {reach / 2}]
gamma_deg = [-30, 30]
[limits]
min_length_mm = {lengths.min() * (1 - STROKE)}
max_length_mm = {lengths.max() * (1 + STROKE)}
[loads]
reference_kg = 12.2
masses_kg = [34.5]
"""
    )
    return file


def compare_optima(program: Path, work: Path, count: int) -> list[str]:
    """The best of many starts on both sides, on several machines; fails where ours is worse."""
    names = [
        "machine",
        "best O1, hexbench",
        "best O1, SciPy",
        "reach the best: hexbench",
        "SciPy",
        "CPU time per start: hexbench",
        "SciPy",
    ]
    lines = [f"| {' | '.join(names)} |", "|---|---|---|---|---|---|---|"]
    problems = [(MACHINE, SPACE)] + [(m, level_space(m, work)) for m in OTHER_MACHINES]
    for hexapod, space in problems:
        file = work / "starts.csv"
        file.write_text(ours(program, "starts", hexapod, space, count)[1])
        starts = np.loadtxt(file, delimiter=",")
        seconds, values = ours(program, "search", hexapod, space, file)
        own = np.array(values.split(), dtype=float)
        search = PoseSearch(hexapod, space)
        check_gradients(search, search.scaled(starts[0]))
        begun = time.process_time()
        theirs = np.array([search.climb(start, exact=True) for start in starts])
        their_seconds = time.process_time() - begun
        name, best = hexapod.parent.name, max(own.max(), theirs.max())
        reach = [f"{100 * np.count_nonzero(v >= (1 - SAME) * best) / count:.1f} %" for v in (own, theirs)]
        times = [short(s / count) for s in (seconds, their_seconds)]
        lines.append(f"| {' | '.join([name, f'{own.max():.6g}', f'{theirs.max():.6g}', *reach, *times])} |")
        assert own.max() >= (1 - SAME) * theirs.max(), f"{name}: SciPy finds {theirs.max()}, hexbench {own.max()}"
    return lines


def benchmark_campaigns(programs: dict[str, Path], work: Path, count: int) -> list[str]:
    """Simulated campaigns on both sides."""
    plan = work / "plan.csv"
    with plan.open("w", newline="") as file:
        table = csv.writer(file)
        names = ["fx_N", "fy_N", "fz_N", "mx_Nm", "my_Nm", "mz_Nm"]
        angles = ["alpha_deg", "beta_deg", "gamma_deg"]
        table.writerow(["pose", "repeat", "a_mm", "b_mm", "c_mm", *angles, *names, *["ref_" + name for name in names]])
        for pose, (a, b, c, gamma) in enumerate(PLAN_MM_DEG, 1):
            for repeat in range(1, REPEATS + 1):
                table.writerow([pose, repeat, a, b, c, 0, 0, gamma, 0, 0, -34.5 * 9.81, 0, 0, 0, 0, 0, -12.2 * 9.81, 0, 0, 0])
    campaigns = Campaigns()
    lines = [
        "| campaigns | | CPU time per campaign | times faster | largest difference of a mean | of a standard deviation |",
        "|---|---|---|---|---|---|",
    ]
    tasks = [
        ("one machine, noise anew", campaigns.same_machine, 0.0, count),
        ("machine and noise anew", campaigns.own_machines, TOLERANCE_UM, count // 4),
    ]
    for name, make, tolerance, some in tasks:
        timed = [campaigns.run(make, some, batch) for batch in (500, 2000, 10000)]
        theirs_time, theirs = min(timed, key=lambda t: t[0])
        lines.append(f"| {name} | NumPy | {short(theirs_time)} | 1.0 | | |")
        for ours_name, program in programs.items():
            seconds, own = ours(program, "campaigns", MACHINE, plan, some, tolerance)
            off = differences(own, theirs)
            assert max(off) < 5, f"{name}: the two sides differ by {off[0]:.1f} and {off[1]:.1f} sigma"
            faster = theirs_time * some / seconds
            figures = " | ".join(f"{x:.1f} sigma" for x in off)
            lines.append(f"| {name} | {ours_name} | {short(seconds / some)} | {faster:.1f} | {figures} |")
    return lines


def differences(own: str, theirs: np.ndarray) -> tuple[float, float]:
    """Largest differences of means and standard deviations, in standard deviations of such a difference."""
    mean, deviation = np.array([line.split(",") for line in own.split()], dtype=float).T * 1e6
    spread, count = theirs.std(axis=0, ddof=1), len(theirs)
    off_mean = np.abs((mean - theirs.mean(axis=0)) / spread * np.sqrt(count / 2)).max()
    return off_mean, np.abs((deviation / spread - 1) * np.sqrt(count)).max()


def processor() -> str:
    """Name of the processor."""
    lines = Path("/proc/cpuinfo").read_text().splitlines() if Path("/proc/cpuinfo").exists() else []
    return next((line.split(":")[1].strip() for line in lines if line.startswith("model name")), platform.processor())


PAGE = """# Benchmarks

Written by `scripts/benchmark.sh`; do not edit.

Both sides on one thread of the same machine ({processor}), CPU time. hexbench is built as
`cargo build --release` builds it, for any x86-64, and once more with `-C target-cpu=native` for this processor, as NumPy picks
its kernels. Python {python}, NumPy {numpy}, SciPy {scipy}. How it is done: `scripts/benchmark.py`,
`crates/design/examples/benchmark.rs`.

## The paper's search for poses

Three poses, twelve variables, the largest O1 within the stroke: the machine of `scenes/paper/hexapod.toml` in
`data/designs/paper-space.toml`. Both sides begin at the same starts and use SLSQP with the strokes as smooth constraints and
the same tolerance. SciPy gets an objective that handles all poses at once, and in the first of its lines exact derivatives of
everything; an end counts when it is within the stroke, and as the best when O1 agrees to {same:.0e}. Our quadratic
subproblems are solved by the library `basin`.

{search}

The same on machines of other shapes, their travel and stroke in proportion to their legs; the run fails where SciPy finds
a better optimum:

{optima}

## Simulated campaigns

The paper's plan, three readings at each of three poses; a linear world, noise on each of the 54 numbers, six compliances by
weighted least squares. *One machine*: the regressor is the same in all campaigns; both sides invert it once, and what is left
is mostly the drawing of random numbers (both with PCG64 and a ziggurat). *Machine anew*: the joints of every campaign lie off
by {tolerance:.0f} um, as after a calibration, and every campaign has a regressor and a solution of its own; NumPy handles
hundreds or thousands of them at once, in the fastest of three batch sizes. {count} campaigns, of the second kind a quarter;
the last columns compare mean and standard deviation of the fitted stiffnesses, in standard deviations of their difference.

{campaigns}
"""


def main() -> None:
    """Runs everything and writes the page."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("program", type=Path)
    parser.add_argument("--native", type=Path, required=True, help="the same built for this processor")
    parser.add_argument("--work", type=Path, required=True)
    parser.add_argument("--page", type=Path, required=True)
    parser.add_argument("--starts", type=int, default=1000)
    parser.add_argument("--campaigns", type=int, default=2_000_000)
    given = parser.parse_args()
    programs = {"hexbench": given.program, "hexbench, for this processor": given.native}
    page = PAGE.format(
        processor=processor(),
        python=platform.python_version(),
        numpy=np.__version__,
        scipy=scipy.__version__,
        same=SAME,
        tolerance=TOLERANCE_UM,
        count=f"{given.campaigns:,}".replace(",", " "),
        search="\n".join(benchmark_search(programs, given.work, given.starts)),
        optima="\n".join(compare_optima(given.program, given.work, given.starts // 4)),
        campaigns="\n".join(benchmark_campaigns(programs, given.work, given.campaigns)),
    )
    given.page.write_text(page)
    print(page)


if __name__ == "__main__":
    main()
