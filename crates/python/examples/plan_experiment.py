"""How many poses are worth it: plan_experiment.py HEXAPOD SPACE PLAN.csv.

Plans with more and more poses for the leg stiffnesses and one effect; the last one goes into a file that names what to measure.
"""

from __future__ import annotations

import sys

import hexbench

EFFECT = "leg-length-compliance"


def main(hexapod: str, space: str, output: str) -> None:
    """Print what each plan is worth, and write the last one."""
    machine = hexbench.Hexapod.read(hexapod)
    for poses in (3, 6, 9):
        plan = hexbench.design(machine, space, poses=poses, criterion="d", add=[EFFECT], starts=4)
        print(f"{poses} poses, {len(plan)} readings: {plan.criterion} = {plan.value:.4g}")
    plan.to_pandas().to_csv(output, index=False)
    print(f"The last one is in {output}.")


if __name__ == "__main__":
    main(*sys.argv[1:4])
