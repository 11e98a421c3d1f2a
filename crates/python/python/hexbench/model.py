"""Fitting, saving and using a model."""

from __future__ import annotations

from collections.abc import Sequence
from html import escape
from os import PathLike, fspath
from typing import TYPE_CHECKING, Any, Literal, NamedTuple, overload

import numpy as np
from numpy.typing import ArrayLike

from hexbench import _native
from hexbench._html import table as html_table
from hexbench._tables import POSE, REFERENCE, WRENCH, Floats, one_per_row, rows, spread
from hexbench.campaign import Campaign, Data, held_out
from hexbench.machine import Hexapod
from hexbench.own_term import OwnTerm, Term, native_terms, own_terms

if TYPE_CHECKING:
    import pandas as pd


class PlatformStiffness(NamedTuple):
    """Cartesian stiffness at n poses, (n, 6, 6) each, SI: motions [x, y, z, rx, ry, rz], loads [fx, fy, fz, mx, my, mz]."""

    stiffness: Floats
    """K: load per motion of the point."""
    stiffness_std: Floats
    """Standard uncertainty (k = 1) of each number of K."""
    compliance: Floats
    """C = K^-1: motion of the point per load."""
    compliance_std: Floats
    """Standard uncertainty (k = 1) of each number of C."""


class Correction(NamedTuple):
    """Commands that bring the loaded platform to n desired poses."""

    commands: Floats
    """Poses to command, (n, 6), mm and deg."""
    remaining: Floats
    """What remains by the model's own prediction, (n, 6), um and urad."""
    std: Floats
    """Standard uncertainty (k = 1) of the pose reached, (n, 6), um and urad."""
    uncorrected: Floats
    """The error without correction, (n, 6), um and urad."""


class Model:
    """A fitted model: leg springs, terms, their covariance, and their origin; the contents of ``model.toml``."""

    _made: _native.Model

    def __init__(self, native: _native.Model) -> None:
        """Wrap the result of a fit; use :func:`fit` or :meth:`load`."""
        self._made = native

    @classmethod
    def load(cls, path: str | PathLike[str], *, trust: bool = False) -> Model:
        """Read ``model.toml``.

        Parameters
        ----------
        path
            The file.
        trust
            Use the model even if its file was changed after a fit wrote it, or has no digest.

        Raises
        ------
        BadInput
            A key that breaks a rule, or a file that was changed since a fit wrote it.
        InputOutput
            The file cannot be read.
        """
        return cls(_native.Model.read(fspath(path), trust))

    def save(self, path: str | PathLike[str]) -> None:
        """Write ``model.toml``, completely or not at all."""
        _native.write_text(fspath(path), self.to_toml())

    def to_toml(self) -> str:
        """Return the text of ``model.toml``."""
        return self._made.to_toml()

    @property
    def hexapod(self) -> Hexapod:
        """The machine."""
        return Hexapod._of(self._made.hexapod)

    @property
    def terms(self) -> list[str]:
        """Terms in addition to the leg springs, as ``fit`` takes them."""
        return self._made.terms

    @property
    def absolute(self) -> bool:
        """True for a model of absolute poses."""
        return self._made.absolute

    @property
    def values(self) -> dict[str, float]:
        """Every number that the data determine, in the unit of :attr:`units`: ``leg-1.stiffness`` and so on."""
        return {name: value for name, value, _, _ in self._made.estimates()}

    @property
    def units(self) -> dict[str, str]:
        """The unit of every number."""
        return {name: unit for name, _, _, unit in self._made.estimates()}

    @property
    def stds(self) -> dict[str, float]:
        """Standard uncertainty (k = 1) of every number, in its unit."""
        return {name: std for name, _, std, _ in self._made.estimates()}

    @property
    def not_determined(self) -> list[str]:
        """Names of parameters that the data do not determine."""
        return self._made.not_determined

    @property
    def parameters(self) -> pd.DataFrame:
        """Every number that the data determine: index ``name``, columns ``value``, ``std`` (k = 1), ``unit`` (needs pandas)."""
        import pandas as pd

        rows = [{"name": n, "value": value, "std": std, "unit": unit} for n, value, std, unit in self._made.estimates()]
        return pd.DataFrame(rows, columns=["name", "value", "std", "unit"]).set_index("name")

    @property
    def covariance(self) -> Floats:
        """Covariance of the fitted numbers in SI units, shape (p, p), in the order of :attr:`covariance_names`.

        Springs appear as compliances (m/N), shapes as logarithms.
        """
        return self._made.covariance

    @property
    def covariance_names(self) -> list[str]:
        """Names of the rows and columns of :attr:`covariance`."""
        return self._made.covariance_names

    @property
    def chi2(self) -> float:
        """Chi-square of the fit."""
        return self._made.chi2

    @property
    def degrees_of_freedom(self) -> float:
        """Degrees of freedom of the fit."""
        return self._made.degrees_of_freedom

    @property
    def sigma(self) -> Floats:
        """Noise of one reading used as weights in the fit, shape (6,): um and urad."""
        translation, rotation = self._made.noise
        return np.array([translation] * 3 + [rotation] * 3)

    @property
    def noise_source(self) -> str:
        """Where the noise comes from: ``metrology``, ``sigma columns``, ``repeats``, ``residuals``."""
        return self._made.noise_source

    @property
    def summary(self) -> str:
        """What ``hexbench fit`` prints; empty for a model from a file."""
        return self._made.summary

    @overload
    def predict(
        self,
        poses: ArrayLike,
        wrenches: ArrayLike,
        *,
        reference: ArrayLike | None = ...,
        approach: ArrayLike | None = ...,
        delta_T_K: ArrayLike | None = ...,
        elapsed_s: ArrayLike | None = ...,
        ref_age_s: ArrayLike | None = ...,
        covariance: Literal[False] = ...,
    ) -> Floats: ...

    @overload
    def predict(
        self,
        poses: ArrayLike,
        wrenches: ArrayLike,
        *,
        reference: ArrayLike | None = ...,
        approach: ArrayLike | None = ...,
        delta_T_K: ArrayLike | None = ...,
        elapsed_s: ArrayLike | None = ...,
        ref_age_s: ArrayLike | None = ...,
        covariance: Literal[True],
    ) -> tuple[Floats, Floats]: ...

    def predict(
        self,
        poses: ArrayLike,
        wrenches: ArrayLike,
        *,
        reference: ArrayLike | None = None,
        approach: ArrayLike | None = None,
        delta_T_K: ArrayLike | None = None,
        elapsed_s: ArrayLike | None = None,
        ref_age_s: ArrayLike | None = None,
        covariance: bool = False,
    ) -> Floats | tuple[Floats, Floats]:
        """Predict readings.

        Parameters
        ----------
        poses : array (n, 6)
            Commanded poses: mm and deg (extrinsic X-Y-Z), fixed frame.
        wrenches : array (n, 6)
            Loads on the platform at the mobile origin, fixed axes: N and N m.
        reference : array (n, 6), optional
            Loads in the reference state; none by default.
        approach, delta_T_K, elapsed_s : array (n,) or number, optional
            Direction of approach (+1, -1), temperature (K) and time (s) relative to the reference reading.
        ref_age_s : array (n,) or number, optional
            How long the reference load had been applied at the reference reading, s.
        covariance : bool
            Also return the covariance of the prediction: that of the model, without the noise of a future reading.

        Returns
        -------
        array (n, 6)
            Deflections, loaded minus reference: um and urad. For a model of absolute poses: poses in mm and deg.
        array (n, 6, 6)
            With ``covariance=True``: covariance of each row in um and urad.

        Raises
        ------
        BadInput
            A shape, a number that is not finite, a singular pose: with the row, counted from 0.
        """
        single = {"approach": approach, "delta_T_K": delta_T_K, "elapsed_s": elapsed_s, "ref_age_s": ref_age_s}
        count, table = _conditions(poses, wrenches, reference, single)
        if count == 0:
            values, spreads = np.empty((0, 6)), np.empty((0, 6, 6))
        else:
            values, spreads = self._made.predict(list(table), list(table.values()))
        return (values, spreads) if covariance else values

    @property
    def sensor_columns(self) -> list[str]:
        """Columns that the sensors of the machine fill, with units: ``g1_um``, ``ball_x_um``, ``level_urad``."""
        return self._made.sensor_columns

    @overload
    def predict_sensors(
        self,
        poses: ArrayLike,
        wrenches: ArrayLike,
        *,
        reference: ArrayLike | None = ...,
        approach: ArrayLike | None = ...,
        delta_T_K: ArrayLike | None = ...,
        elapsed_s: ArrayLike | None = ...,
        ref_age_s: ArrayLike | None = ...,
        covariance: Literal[False] = ...,
    ) -> tuple[Floats, Floats]: ...

    @overload
    def predict_sensors(
        self,
        poses: ArrayLike,
        wrenches: ArrayLike,
        *,
        reference: ArrayLike | None = ...,
        approach: ArrayLike | None = ...,
        delta_T_K: ArrayLike | None = ...,
        elapsed_s: ArrayLike | None = ...,
        ref_age_s: ArrayLike | None = ...,
        covariance: Literal[True],
    ) -> tuple[Floats, Floats, Floats]: ...

    def predict_sensors(
        self,
        poses: ArrayLike,
        wrenches: ArrayLike,
        *,
        reference: ArrayLike | None = None,
        approach: ArrayLike | None = None,
        delta_T_K: ArrayLike | None = None,
        elapsed_s: ArrayLike | None = None,
        ref_age_s: ArrayLike | None = None,
        covariance: bool = False,
    ) -> tuple[Floats, Floats] | tuple[Floats, Floats, Floats]:
        """Predict the readings of the sensors of the machine.

        Parameters
        ----------
        poses, wrenches, reference, approach, delta_T_K, elapsed_s, ref_age_s
            As of :meth:`predict`.
        covariance : bool
            Also return the covariance of all readings of a row.

        Returns
        -------
        array (n, m)
            Readings, loaded minus reference, in the order and units of :attr:`sensor_columns`; m = 0 without sensors.
        array (n, m)
            Their standard uncertainties (k = 1) from the model, without the noise of a future reading.
        array (n, m, m)
            With ``covariance=True``: covariance of each row in um and urad; predictions of one model are correlated.

        Raises
        ------
        BadInput
            As :meth:`predict`.
        """
        single = {"approach": approach, "delta_T_K": delta_T_K, "elapsed_s": elapsed_s, "ref_age_s": ref_age_s}
        count, table = _conditions(poses, wrenches, reference, single)
        if count == 0:
            many = len(self.sensor_columns)
            values, spreads = np.empty((0, many)), np.empty((0, many, many))
        else:
            values, spreads = self._made.predict_sensors(list(table), list(table.values()))
        stds = np.sqrt(np.diagonal(spreads, axis1=1, axis2=2).clip(0.0))
        return (values, stds, spreads) if covariance else (values, stds)

    def stiffness(
        self,
        poses: ArrayLike,
        wrenches: ArrayLike | None = None,
        *,
        point_mm: ArrayLike = (0.0, 0.0, 0.0),
        axes: Literal["fixed", "mobile"] = "fixed",
        amplitude_N: float = 1.0,  # noqa: N803
    ) -> PlatformStiffness:
        """Return the stiffness of the platform: Cartesian stiffness and compliance matrices with uncertainty.

        Parameters
        ----------
        poses : array (n, 6)
            Commanded poses: mm and deg (extrinsic X-Y-Z), fixed frame.
        wrenches : array (n, 6), optional
            Loads on the platform at the mobile origin, fixed axes: N and N m; none by default.
        point_mm : array (3,)
            Point of the platform where forces act and motions are stated, mobile frame, mm.
        axes : "fixed" or "mobile"
            Axes of motions and loads.
        amplitude_N : float
            Size of the small forces, N; choose it larger than any play or friction that you want to ignore.

        Returns
        -------
        PlatformStiffness
            Matrices (n, 6, 6), SI.

        Raises
        ------
        BadInput
            As :meth:`predict`.
        """
        count = len(rows(poses, 6, "poses"))
        loads = np.zeros((count, 6)) if wrenches is None else wrenches
        count, table = _conditions(poses, loads, None, {})
        point = [float(x) for x in rows([point_mm], 3, "point_mm")[0]]
        if count == 0:
            return PlatformStiffness(*(np.empty((0, 6, 6)) for _ in range(4)))
        return PlatformStiffness(*self._made.stiffness(list(table), list(table.values()), point, axes, amplitude_N))

    def compensate(self, poses: ArrayLike, wrenches: ArrayLike, **conditions: ArrayLike) -> Correction:
        """Return the commands that bring the loaded platform to the desired poses: ``hexbench compensate``.

        Parameters
        ----------
        poses : array (n, 6)
            Desired poses: mm and deg (extrinsic X-Y-Z), fixed frame.
        wrenches : array (n, 6)
            Total loads at the mobile origin, fixed axes: N and N m.
        **conditions : array (n,)
            ``approach``, ``delta_T_K``, ``elapsed_s``, ``ref_age_s``, as of :meth:`predict`.

        Raises
        ------
        BadInput
            As :meth:`predict`.
        """
        count, table = _conditions(poses, wrenches, None, dict(conditions))
        if count == 0:
            return Correction(*(np.empty((0, 6)) for _ in range(4)))
        return Correction(*self._made.compensate(list(table), list(table.values())))

    def _repr_html_(self) -> str:
        rows = [(name, f"{value:.6g}", f"{std:.2g}", unit) for name, value, std, unit in self._made.estimates()]
        return f"<p>{escape(repr(self))}</p>{html_table(['parameter', 'value', 'std', 'unit'], rows)}"

    def __eq__(self, other: object) -> bool:
        """Compare by file contents."""
        return isinstance(other, Model) and self.to_toml() == other.to_toml()

    def __hash__(self) -> int:
        """Hash what is compared."""
        return hash(self.to_toml())

    def __repr__(self) -> str:
        """Return machine, terms and chi-square."""
        added = "".join(f" + {term}" for term in self.terms)
        return f"Model({self.hexapod.name!r}: springs{added}, chi2/dof {self.chi2 / max(self.degrees_of_freedom, 1.0):.3g})"

    def __reduce__(self) -> tuple[Any, ...]:
        """Pickle as the text of the file."""
        return (_restored, (self.to_toml(), self.summary))


def fit(
    campaign: Campaign,
    add: Sequence[str | Term] = (),
    *,
    holdout: Data | None = None,
    terms: Sequence[OwnTerm] = (),
    estimator: Literal["gls", "paper"] = "gls",
) -> Model:
    """Fit leg stiffnesses and the named effects to a campaign.

    Parameters
    ----------
    campaign : Campaign
        The measurements.
    add : sequence of str or Term
        Terms of the catalogue to fit in addition to the springs; append ``:richer`` to a name for its richer form, or ``:``
        and a version that ``hexbench terms TERM`` lists. Also terms of your own.
    holdout : path, table or Campaign, optional
        Held-out readings to judge the fit (:attr:`Model.summary`).
    terms : sequence of paths or Term
        Terms of your own, added to the model: files (term/1), or functions (:class:`Term`).
    estimator : {"gls", "paper"}
        Generalized least squares, or the paper's unweighted minimum-norm least squares (springs and deflections only).

    Raises
    ------
    UsageError
        A term that does not exist or is named twice.
    NotDetermined
        The parameters that the data do not determine, in words.
    """
    added = [add] if isinstance(add, (str, Term)) else list(add)
    own = native_terms(own_terms([*terms, *(term for term in added if isinstance(term, Term))]))
    names = [term.id if isinstance(term, Term) else term for term in added]
    native = _native.fit(campaign._made, names, held_out(campaign, holdout), own, estimator)
    return Model(native)


def predict(model: Model, poses: ArrayLike, wrenches: ArrayLike, **conditions: Any) -> Any:
    """Predict readings: :meth:`Model.predict` as a function."""
    return model.predict(poses, wrenches, **conditions)


def _conditions(
    poses: ArrayLike, wrenches: ArrayLike, reference: ArrayLike | None, single: dict[str, ArrayLike | None]
) -> tuple[int, dict[str, Any]]:
    """Return the number of rows and the columns of the conditions to predict."""
    first = rows(poses, 6, "poses")
    count = len(first)
    table = {**spread(POSE, first), **spread(WRENCH, rows(wrenches, 6, "wrenches", count))}
    if reference is not None:
        table |= spread(REFERENCE, rows(reference, 6, "reference", count))
    table |= {key: one_per_row(value, key, count) for key, value in single.items() if value is not None}
    return count, table


def _restored(text: str, summary: str) -> Model:
    return Model(_native.Model.of_text(text, summary))
