"""Building blocks of an identification, for many poses: legs, forces, regressor, signatures, residuals, likelihood, stiffness.

Poses are (n, 6), mm and deg (extrinsic X-Y-Z), fixed frame; wrenches are (n, 6), N and N m, at the mobile origin in fixed axes;
deflections are (n, 6), um and urad. Matrices are SI. Equations are those of Kalas et al. 2018.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike

from hexbench import _native
from hexbench._tables import POSE, REFERENCE, WRENCH, Floats, rows, spread
from hexbench.errors import BadInput
from hexbench.machine import Hexapod
from hexbench.own_term import OwnTerm, native_terms, own_terms


class Signature(NamedTuple):
    """The change of the readings per unit of each parameter of an effect."""

    readings: Floats
    """(n, 6, p): um and urad per unit of the parameter."""
    names: list[str]
    """Names of the p parameters."""
    units: list[str]
    """Their units."""
    shape: float | None
    """The shape it was taken at, in the unit of the catalogue; None for effects without one."""


def leg_lengths(hexapod: Hexapod, poses: ArrayLike) -> Floats:
    """Return the lengths of the legs, mm, (n, 6): ``q_i = |t + R B_i - A_i|``."""
    lengths, _ = _legs(hexapod, poses)
    return lengths * 1e3


def leg_jacobian(hexapod: Hexapod, poses: ArrayLike) -> Floats:
    """Return the geometric leg Jacobian L, SI, (n, 6, 6): leg rates are ``L [v; omega]``, fixed axes, at the mobile origin.

    Row i is ``[n_i', (R B_i x n_i)']`` with the unit vector ``n_i`` from base joint to platform joint; columns 0-2 have no
    unit, 3-5 are m. The platform Jacobian J of the paper (Kalas et al. 2018, eq. 8) is its inverse.
    """
    _, jacobian = _legs(hexapod, poses)
    return jacobian


def leg_forces(hexapod: Hexapod, poses: ArrayLike, wrenches: ArrayLike) -> Floats:
    """Return the forces in the legs, N, tension positive, (n, 6): ``f = L^-T W`` (eq. 3)."""
    jacobian = leg_jacobian(hexapod, poses)
    loads = rows(wrenches, 6, "wrenches", len(jacobian))
    return _floats(np.linalg.solve(np.swapaxes(jacobian, 1, 2), loads[..., None])[..., 0])


def regressor(hexapod: Hexapod, poses: ArrayLike, wrenches: ArrayLike, reference: ArrayLike | None = None) -> Floats:
    """Return the regressor A, (n, 6, 6): deflections are ``A[k] @ c`` for leg compliances c (eq. 11-13).

    ``A_ij = Jbar_ij f_j`` with the change of the leg forces f from reference to load. With c in um/N deflections are in um and
    urad (c = 1/k, k in N/um). ``A.reshape(-1, 6)`` is the matrix of the whole campaign.
    """
    names, columns = _conditions(poses, wrenches, reference)
    return _native.regressor(hexapod._made, names, columns) if len(columns[0]) else np.empty((0, 6, 6))


def signatures(
    hexapod: Hexapod,
    term: str,
    poses: ArrayLike,
    wrenches: ArrayLike,
    *,
    reference: ArrayLike | None = None,
    terms: Sequence[OwnTerm] = (),
    shape: float | None = None,
    stiffness_N_per_um: ArrayLike | None = None,  # noqa: N803
    **covariates: ArrayLike,
) -> Signature:
    """Return the change of the readings per unit of each parameter of an effect, to first order.

    Parameters
    ----------
    term : str
        Id of the catalogue (:func:`hexbench.terms`), or of a term of your own in ``terms``: a file or a :class:`hexbench.Term`.
    shape : float, optional
        Exponent, period or time constant, in the unit of the catalogue; by default the middle of the grid.
    stiffness_N_per_um : float or (6,), optional
        Stiffness of the legs in addition to which the effect acts; rigid by default.
    **covariates : (n,)
        ``approach``, ``delta_T_K``, ``elapsed_s``, ``ref_age_s``, if the effect depends on it.
    """
    names, columns = _conditions(poses, wrenches, reference)
    for name, values in covariates.items():
        names.append(name)
        columns.append(np.ascontiguousarray(np.broadcast_to(np.asarray(values, dtype=float), (len(columns[0]),))))
    compliances = np.zeros(6) if stiffness_N_per_um is None else 1.0 / _six(stiffness_N_per_um)
    own = native_terms(own_terms(terms))
    found, named, at = _native.signatures(hexapod._made, names, columns, term, own, shape, compliances.tolist())
    return Signature(found.reshape(-1, 6, len(named)), [n for n, _ in named], [u for _, u in named], at)


def residuals(measured: ArrayLike, predicted: ArrayLike, sigma: ArrayLike = 1.0) -> Floats:
    """Return ``(measured - predicted) / sigma``, (n, 6): in um and urad, or whitened with ``sigma`` (6,) or (n, 6)."""
    first = rows(measured, 6, "measured")
    return _floats((first - rows(predicted, 6, "predicted", len(first))) / np.asarray(sigma, dtype=float))


def log_likelihood(measured: ArrayLike, predicted: ArrayLike, sigma: ArrayLike) -> float:
    """Return the Gaussian log-likelihood of readings with independent noise ``sigma``, (6,) or (n, 6), um and urad.

    ``-sum(z^2)/2 - sum(log(sigma)) - 6 n log(2 pi)/2``; units of the density are per um and urad.
    """
    z = residuals(measured, predicted, sigma)
    widths = np.broadcast_to(np.asarray(sigma, dtype=float), z.shape)
    return float(-0.5 * np.sum(z**2) - np.sum(np.log(widths)) - 0.5 * z.size * np.log(2.0 * np.pi))


def stiffness_matrix(hexapod: Hexapod, poses: ArrayLike, stiffness_N_per_um: ArrayLike) -> Floats:  # noqa: N803
    """Return the Cartesian stiffness K_C, SI, (n, 6, 6): ``K_C = L' diag(k) L = J^-T diag(k) J^-1`` (eq. 8-10).

    It maps twists of the mobile origin (m, rad) to wrenches there (N, N m), in fixed axes, for the leg stiffnesses alone and
    without load;
    :meth:`hexbench.Model.stiffness` includes effects, load and uncertainty.
    """
    jacobian = leg_jacobian(hexapod, poses)
    found: Floats = np.einsum("nki,k,nkj->nij", jacobian, _six(stiffness_N_per_um) * 1e6, jacobian)
    return found


def _legs(hexapod: Hexapod, poses: ArrayLike) -> tuple[Floats, Floats]:
    count = len(rows(poses, 6, "poses"))
    if count == 0:
        return np.empty((0, 6)), np.empty((0, 6, 6))
    return _native.legs(hexapod._made, *_conditions(poses, np.zeros((count, 6)), None))


def _conditions(poses: ArrayLike, wrenches: ArrayLike, reference: ArrayLike | None) -> tuple[list[str], list[Floats]]:
    first = rows(poses, 6, "poses")
    table = {**spread(POSE, first), **spread(WRENCH, rows(wrenches, 6, "wrenches", len(first)))}
    if reference is not None:
        table |= spread(REFERENCE, rows(reference, 6, "reference", len(first)))
    return list(table), list(table.values())


def _floats(values: ArrayLike) -> Floats:
    return np.asarray(values, dtype=np.float64)


def _six(values: ArrayLike) -> Floats:
    array = np.asarray(values, dtype=float)
    if array.shape not in ((), (6,)) or not np.all(np.isfinite(array)) or np.any(array <= 0.0):
        raise BadInput("stiffness_N_per_um: expected one positive number or six", "Use N/um for each leg.")
    return np.broadcast_to(array, (6,)).copy()
