"""A check for continuous integration: check_in_ci.py MODEL HEXAPOD DATA LIMIT.

Exit code 1 when the model, as it was released, predicts new readings worse than LIMIT in chi-square per degree of freedom.
"""

from __future__ import annotations

import sys

import hexbench


def main(model: str, hexapod: str, data: str, limit: float) -> int:
    """Compare, say it in one line, return the exit code."""
    found = hexbench.compare(hexbench.load(hexapod, data), hexbench.Model.load(model))
    reached = found.error["chi2_reduced"]
    passed = reached < limit
    print(f"{'passed' if passed else 'FAILED'}: chi-square per degree of freedom {reached:.3f}, limit {limit}")
    return 0 if passed else 1


if __name__ == "__main__":
    try:
        code = main(sys.argv[1], sys.argv[2], sys.argv[3], float(sys.argv[4]))
    except hexbench.HexbenchError as error:
        sys.exit(f"error: {error}")
    sys.exit(code)
