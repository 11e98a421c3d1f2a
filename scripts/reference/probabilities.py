"""Reference probabilities for crates/model/tests/model/evidence.rs.

Usage: pip install -r scripts/requirements/scipy.txt && python scripts/reference/probabilities.py
Writes noncentral_chi_square.csv and bivariate_orthant.csv into crates/model/tests/reference/.
"""

from itertools import product
from pathlib import Path

import scipy
from scipy.integrate import quad
from scipy.stats import ncx2, norm

TABLES = Path(__file__).resolve().parents[2] / "crates" / "model" / "tests" / "reference"
HEADER = f"# SciPy {scipy.__version__}, scripts/reference/probabilities.py\n"


def noncentral_chi_square() -> str:
    """Distribution function over degrees of freedom, noncentrality and argument."""
    lines = ["dof,lambda,x,cdf"]
    for dof, noncentrality in product([1, 2, 6, 15, 36], [0.5, 4.0, 14.879, 60.0]):
        for x in [0.5 * dof, dof + noncentrality, 1.8 * (dof + noncentrality)]:
            lines.append(f"{dof},{noncentrality!r},{x!r},{ncx2.cdf(x, dof, noncentrality):.13e}")
    return HEADER + "\n".join(lines) + "\n"


def orthant(mean_1: float, mean_2: float, correlation: float) -> float:
    """P(x1 > 0, x2 > 0) of unit normals, as one integral over the conditional distribution."""
    rest = (1.0 - correlation**2) ** 0.5

    def integrand(x: float) -> float:
        return norm.pdf(x - mean_1) * norm.cdf((mean_2 + correlation * (x - mean_1)) / rest)

    low, high = max(0.0, mean_1 - 12.0), max(0.0, mean_1) + 12.0
    return quad(integrand, low, high, epsabs=1e-15, epsrel=1e-13, limit=400)[0]


def bivariate_orthant() -> str:
    """Probability that both components are positive, over means and correlation."""
    lines = ["mean_1,mean_2,correlation,probability"]
    for m1, m2 in [(0.0, 0.0), (1.0, 0.5), (-1.0, 0.5), (-1.5, -1.0), (3.0, -2.0), (-3.0, -3.0)]:
        for correlation in [-0.8, -0.3, 0.0, 0.5, 0.9]:
            lines.append(f"{m1!r},{m2!r},{correlation!r},{orthant(m1, m2, correlation):.13e}")
    return HEADER + "\n".join(lines) + "\n"


if __name__ == "__main__":
    (TABLES / "noncentral_chi_square.csv").write_text(noncentral_chi_square())
    (TABLES / "bivariate_orthant.csv").write_text(bivariate_orthant())
