"""An algorithm of one's own as an entrant of a challenge: a group lasso on the building blocks.

In this process and as a program, scored side by side with their times: group_lasso.py CHALLENGE ANSWERS. As a program for
``hexbench challenge run``: group_lasso.py CASE OUT.
"""

from __future__ import annotations

import sys
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

import hexbench
from hexbench import Answer, Case, blocks, commands

Array = NDArray[np.float64]
EFFECTS = ("base-compliance", "platform-compliance", "leg-asymmetry", "leg-coupling", "load-offset", "load-tilt")


def columns(machine: hexbench.Hexapod, conditions: dict[str, Array], effects: tuple[str, ...]) -> list[Array]:
    """Return the columns of springs and of each effect, rows (6 n, ...), um and urad."""
    at, reference = (conditions["poses"], conditions["wrenches"]), conditions.get("reference")
    found = [blocks.signatures(machine, effect, *at, reference=reference).readings for effect in effects]
    return [a.reshape(-1, a.shape[2]) for a in (blocks.regressor(machine, *at, reference), *found)]


def active_effects(springs: Array, groups: list[Array], y: Array) -> tuple[str, ...]:
    """Return the effects that block coordinate descent leaves on, at the penalty that noise alone does not pass."""
    basis = np.linalg.qr(springs)[0]
    free = [a - basis @ (basis.T @ a) for a in (*groups, y[:, None])]
    bases = []
    for a in free[:-1]:
        u, s, _ = np.linalg.svd(a, full_matrices=False)
        bases.append(u[:, s > 1e-6 * max(s.max(), 1e-300)])
    rest, sizes = free[-1][:, 0], [np.zeros(q.shape[1]) for q in bases]
    for _ in range(50):
        for k, q in enumerate(bases):
            wish = sizes[k] + q.T @ rest
            new = wish * max(0.0, 1.0 - (np.sqrt(q.shape[1]) + 4.0) / max(float(np.linalg.norm(wish)), 1e-300))
            rest, sizes[k] = rest - q @ (new - sizes[k]), new
    return tuple(effect for effect, x in zip(EFFECTS, sizes, strict=True) if x.any())


def told(values: Array) -> Array:
    """Return numbers to nine digits: beyond these, sums differ with the processor and the threads that take part."""
    return np.array([float(f"{value:.9g}") for value in values])


def group_lasso(case: Case) -> Answer:
    """Switch effects on as a whole or not at all, then fit springs and what is on by least squares."""
    machine, readings = case.campaign.hexapod, case.campaign
    read = readings.to_columns()
    if "da_um" not in read:
        raise ValueError("this algorithm reads deflections alone")
    seen = {"poses": readings.poses, "wrenches": readings.wrenches}
    if "ref_fx_N" in read:
        seen["reference"] = np.column_stack([values for name, values in read.items() if name.startswith("ref_")])
    sigma = np.repeat([machine.sigma_translation_um or 1.0, machine.sigma_rotation_urad or 1.0], 3)
    weight = 1.0 / np.tile(sigma, len(readings))
    all_, y = columns(machine, seen, EFFECTS), weight * readings.measured.ravel()
    on = active_effects(weight[:, None] * all_[0], [weight[:, None] * a for a in all_[1:]], y)
    a = np.hstack([all_[0], *(all_[1 + EFFECTS.index(effect)] for effect in on)])
    inverse = np.linalg.pinv(weight[:, None] * a, rcond=1e-9)
    x, spread = inverse @ y, inverse @ inverse.T
    ahead = np.hstack(columns(machine, case.conditions, on))
    std = np.sqrt(np.einsum("ij,jk,ik->i", ahead, spread, ahead).clip(0.0))
    legs = {f"leg-{n + 1}.stiffness": tuple(told(np.array([1 / x[n], np.sqrt(spread[n, n]) / x[n] ** 2]))) for n in range(6)}
    said = {"verdict": "named" if on else "adequate", "added": list(on), "credible_set": list(on) or ["none"]}
    return Answer(told(ahead @ x).reshape(-1, 6), told(std).reshape(-1, 6), legs, diagnosis=said)


def main(challenge: str, answers: str) -> None:
    """Answer in this process and as a program, and print the scores side by side."""
    print(hexbench.answer_challenge(challenge, Path(answers, "function"), "function", group_lasso), end="")
    # Of the surroundings a program gets the PATH alone; it finds the package that is used here.
    program = ["env", f"PYTHONPATH={Path(hexbench.__file__).parents[1]}", sys.executable, str(Path(__file__).resolve())]
    print(commands.challenge_run(challenge, Path(answers, "program"), "program", program))
    print(commands.challenge_score(challenge, [Path(answers, "function"), Path(answers, "program")]))


if __name__ == "__main__":
    if Path(sys.argv[1], "predict.csv").exists():
        one = Case(Path(sys.argv[1]))
        group_lasso(one).write(one, sys.argv[2])
    else:
        main(*sys.argv[1:])
