"""Charts, where matplotlib is installed."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from hexbench.diagnosing import Diagnosis


def diagnosis(of: Diagnosis, axes: Any = None) -> Any:
    """Draw probabilities and held-out errors of a diagnosis."""
    try:
        import matplotlib.pyplot as plt
    except ImportError:
        raise ImportError("charts need matplotlib\n  next: pip install matplotlib") from None
    left, right = plt.subplots(1, 2, figsize=(9, 3), layout="constrained")[1] if axes is None else axes
    likely = [c for c in of.candidates if c["probability"] >= 0.001][:8][::-1]
    left.barh([c["term"] for c in likely], [c["probability"] for c in likely], color="#2a6fb0")
    left.set(xlim=(0, 1), xlabel="probability of the first addition", title=of.verdict)
    steps = [step for step in of.steps if step["holdout"]]
    errors = [step["holdout"]["chi2_reduced"] ** 0.5 for step in steps]
    names = [f"+ {step['terms'][-1]}" if step["terms"] else "springs" for step in steps]
    right.plot(range(len(errors)), errors, "o-", color="#2a6fb0")
    right.axhline(1.0, color="0.5", linestyle=":", label="noise")
    right.set(ylabel="held-out error over the noise", xticks=range(len(errors)))
    right.set_xticklabels(names, rotation=20, ha="right")
    right.legend()
    return left, right
