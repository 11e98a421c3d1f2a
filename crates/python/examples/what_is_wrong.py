"""A metrologist's question: what_is_wrong.py HEXAPOD MEASUREMENTS.csv REPORT.html [HOLDOUT.csv].

Prints the verdict and the numbers, and writes the page with charts.
"""

from __future__ import annotations

import sys
import warnings

import hexbench


def main(hexapod: str, data: str, report: str, holdout: str | None = None) -> None:
    """Diagnose a file of measurements."""
    campaign = hexbench.load(hexapod, data)
    diagnosis = hexbench.diagnose(campaign, holdout=holdout)
    print(f"{len(campaign)} readings of {campaign.hexapod.name}: {diagnosis.verdict} {' '.join(diagnosis.added)}".rstrip())
    for step in diagnosis.steps:
        held = step["holdout"] or step
        print(f"  springs {' '.join(step['terms']):30} held-out error {held['rms']['translation_um']:.3f} um")
    for number in diagnosis.parameters:
        print(f"  {number['name']:34} {number['value']:10.4g} +- {number['std']:.2g} {number['unit']}")
    for proposal in diagnosis.next[:3]:
        print(f"  measure next: {proposal['text']}")
    diagnosis.to_html(report)
    print(f"The page with charts is in {report}.")


if __name__ == "__main__":
    warnings.simplefilter("default", hexbench.HexbenchWarning)
    try:
        main(*sys.argv[1:])
    except hexbench.HexbenchError as error:
        sys.exit(f"error: {error}")
