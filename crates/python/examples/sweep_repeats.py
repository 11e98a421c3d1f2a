"""A study in a few lines: sweep_repeats.py SCENE EFFECT [SEEDS].

How often is the hidden effect named when each condition is read once, twice, four times? Diagnoses run on threads: hexbench
computes without holding the interpreter. ``hexbench study`` is the tool for large sweeps.
"""

from __future__ import annotations

import sys
from concurrent.futures import ThreadPoolExecutor

import pandas as pd

import hexbench

REPEATS = (1, 2, 4)


def named(scene: str, effect: str, repeats: int, seed: int) -> dict[str, object]:
    """Measure and diagnose once."""
    measured = hexbench.simulate(scene, seed=seed, repeats=repeats)
    diagnosis = hexbench.diagnose(measured.campaign, holdout=measured.holdout)
    return {"repeats": repeats, "seed": seed, "verdict": diagnosis.verdict, "named": effect in diagnosis.added}


def main(scene: str, effect: str, seeds: int = 6) -> None:
    """Print the share of campaigns in which the effect is named."""
    wanted = [(scene, effect, repeats, seed) for repeats in REPEATS for seed in range(1, seeds + 1)]
    with ThreadPoolExecutor() as threads:
        table = pd.DataFrame(threads.map(lambda w: named(*w), wanted))
    print(table.groupby("repeats")["named"].mean().to_string())


if __name__ == "__main__":
    main(sys.argv[1], sys.argv[2], int(sys.argv[3]) if len(sys.argv) > 3 else 6)
