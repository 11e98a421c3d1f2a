"""The identification as an estimator: fit, predict, score."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from hexbench._tables import POSE, REFERENCE, WRENCH, Floats, as_array, columns_of, is_table, rows
from hexbench.campaign import Campaign, load
from hexbench.errors import BadInput, UsageError
from hexbench.machine import Hexapod
from hexbench.model import Model, fit
from hexbench.own_term import Term

_COVARIATES = ("approach", "delta_T_K", "elapsed_s", "ref_age_s")


class HexapodModel:
    """Leg springs and named effects as a regressor of scikit-learn: ``fit``, ``predict``, ``score``, and its tags.

    scikit-learn itself is optional.

    ``X`` is an array (n, 12), poses (mm, deg) then wrenches (N, N m), or (n, 18) with reference wrenches appended; or a table
    whose columns are named as in ``measurements.csv``, with ``approach``, ``delta_T_K``, ``elapsed_s`` and ``ref_age_s`` if
    present. ``y`` is an array (n, 6): deflections, loaded minus reference, in um and urad. Poses are in the fixed frame, loads
    at the mobile origin in fixed axes.

    Parameters
    ----------
    hexapod : Hexapod
        The machine.
    terms : sequence of str or Term
        Effects fitted in addition to the springs, as :func:`hexbench.fit` takes them.

    Attributes
    ----------
    model_ : Model
        Result of :meth:`fit`.
    n_features_in_ : int
        Number of columns of ``X`` in the fit.
    feature_names_in_ : array of str
        Names of these columns, if ``X`` was a table.
    """

    model_: Model
    n_features_in_: int
    feature_names_in_: NDArray[np.object_]
    #: What scikit-learn asks to know a regressor.
    _estimator_type = "regressor"

    def __init__(self, hexapod: Hexapod, terms: Sequence[str | Term] = ()) -> None:
        """Keep the parameters as they are; nothing is checked before :meth:`fit`."""
        self.hexapod = hexapod
        self.terms = terms

    def fit(self, X: Any, y: ArrayLike | None = None) -> HexapodModel:
        """Fit springs and terms to deflections ``y`` (n, 6) under the conditions ``X``."""
        if y is None:
            raise UsageError("requires y to be passed, but the target y is None", "Pass the deflections, (n, 6).")
        conditions = _conditions(X)
        campaign = Campaign.from_arrays(self.hexapod, measured=_plain(y, "y"), **conditions)
        self.model_ = fit(campaign, self.terms)
        self.n_features_in_ = len(X.columns) if hasattr(X, "columns") else _width(X)
        self.__dict__.pop("feature_names_in_", None)
        if hasattr(X, "columns") and not _is_unnamed(X):
            self.feature_names_in_ = np.asarray([str(name) for name in X.columns], dtype=object)
        return self

    def fit_campaign(self, campaign: Campaign) -> HexapodModel:
        """Fit springs and terms to a campaign, with all its columns."""
        self.model_ = fit(load(self.hexapod, campaign), self.terms)
        return self

    def predict(self, X: Any) -> Floats:
        """Return the deflections (n, 6) under the conditions ``X``, um and urad."""
        model = self._fitted()
        self._refuse_other_width(X)
        return model.predict(**_conditions(X), covariance=False)

    def score(self, X: Any, y: ArrayLike, sample_weight: None = None) -> float:
        """Return the share of the weighted variance of ``y`` that is predicted: 1 is perfect, 0 is no better than the mean.

        ``1 - sum(((y - predict(X)) / sigma)^2) / sum(((y - mean(y)) / sigma)^2)`` over all rows and columns, with the noise
        ``sigma`` of the fit (:attr:`Model.sigma`): a coefficient of determination in units of the noise.
        """
        measured = rows(y, 6, "y")
        sigma = self._fitted().sigma
        error = (measured - self.predict(X)) / sigma
        spread = (measured - measured.mean(axis=0)) / sigma
        return float(1.0 - np.sum(error**2) / np.sum(spread**2))

    def get_params(self, deep: bool = True) -> dict[str, Any]:
        """Return the parameters of the constructor."""
        return {"hexapod": self.hexapod, "terms": self.terms}

    def set_params(self, **params: Any) -> HexapodModel:
        """Set parameters of the constructor."""
        known = self.get_params()
        for name, value in params.items():
            if name not in known:
                raise UsageError(f"HexapodModel has no parameter {name!r}", f"It has {', '.join(known)}.")
            setattr(self, name, value)
        return self

    def _fitted(self) -> Model:
        if not hasattr(self, "model_"):
            raise _not_fitted()
        return self.model_

    def _refuse_other_width(self, X: Any) -> None:
        """Refuse finite numbers with more or fewer columns than the fit had."""
        expected = self.__dict__.get("n_features_in_")
        array = np.empty(0) if is_table(_plain(X, "X")) else as_array(X, "X")
        if expected is None or array.ndim != 2 or array.shape[1] == expected or not _is_finite(array):
            return
        raise BadInput(f"X has {array.shape[1]} features, but HexapodModel is expecting {expected} features as input")

    def __sklearn_is_fitted__(self) -> bool:
        """Return whether there is a model, for scikit-learn."""
        return hasattr(self, "model_")

    def __sklearn_tags__(self) -> Any:
        """Return what this is, for scikit-learn: a regressor of six numbers on conditions whose columns are fixed."""
        from sklearn.utils import InputTags, RegressorTags, Tags, TargetTags

        return Tags(
            estimator_type="regressor",
            target_tags=TargetTags(required=True, multi_output=True, single_output=False),
            regressor_tags=RegressorTags(poor_score=True),
            input_tags=InputTags(two_d_array=True, allow_nan=False),
        )

    def __repr__(self) -> str:
        """Return the parameters."""
        return f"HexapodModel({self.hexapod!r}, terms={self.terms!r})"


def _not_fitted() -> UsageError:
    """Return the exception of an estimator without a model; of scikit-learn's kind too where that is installed."""
    message, next_step = "this HexapodModel is not fitted", "Call fit(X, y) first."
    try:
        from sklearn.exceptions import NotFittedError
    except ImportError:
        return UsageError(message, next_step)
    both = type("NotFitted", (UsageError, NotFittedError), {"__doc__": "An estimator without a model."})
    made: UsageError = both(message, next_step)
    return made


def _plain(values: Any, name: str) -> Any:
    """Return values that are dense and real."""
    if hasattr(values, "toarray"):
        raise BadInput(f"{name}: sparse data is not supported", "Use toarray() to make it dense.")
    return values


def _of_other_shape(array: NDArray[Any]) -> BadInput:
    """Return the refusal of an array of another shape, with the words that scientific libraries share."""
    found = f"X: expected shape (n, 12), found {array.shape}"
    if array.ndim != 2:
        return BadInput(found, "Expected 2D array: Reshape your data, one row of 12 numbers per reading.")
    count, width = array.shape
    said = f"{width} feature(s) (shape=({count}, {width})) while a minimum of 12 is required."
    odd = "" if _is_finite(array) else " It contains NaN or inf."
    return BadInput(f"{found}: {said}{odd}", "Pass one row of 12 numbers per reading.")


def _is_unnamed(X: Any) -> bool:
    """Return whether the columns of a table are only counted: it is an array then."""
    return hasattr(X, "columns") and all(not isinstance(name, str) for name in X.columns)


def _is_finite(array: NDArray[Any]) -> bool:
    return array.dtype.kind != "f" or bool(np.isfinite(array).all())


def _width(X: Any) -> int:
    return int(as_array(X, "X").shape[1])


def _conditions(X: Any) -> dict[str, Any]:
    if is_table(_plain(X, "X")) and not _is_unnamed(X):
        return _of_table(X)
    array = as_array(X, "X")
    width = 18 if array.ndim == 2 and array.shape[1] == 18 else 12
    if array.dtype.kind == "c":
        raise BadInput("X: Complex data not supported", "Use an array of floats.")
    if array.ndim != 2 or array.shape[1] != width:
        raise _of_other_shape(array)
    checked = rows(X, width, "X")
    parts = {"poses": checked[:, :6], "wrenches": checked[:, 6:12], "reference": checked[:, 12:]}
    return {name: part for name, part in parts.items() if part.shape[1]}


def _of_table(X: Any) -> dict[str, Any]:
    names, columns = columns_of(X, "X")
    table = dict(zip(names, columns, strict=True))
    missing = [name for name in (*POSE, *WRENCH) if name not in table]
    if missing:
        raise UsageError(f"X: required columns are missing: {', '.join(missing)}", "Name the columns as in measurements.csv.")
    has_reference = all(name in table for name in REFERENCE)
    groups = {"poses": POSE, "wrenches": WRENCH} | ({"reference": REFERENCE} if has_reference else {})
    conditions = {key: rows(np.column_stack([table[n] for n in group]), 6, key) for key, group in groups.items()}
    return conditions | {name: np.asarray(table[name]) for name in _COVARIATES if name in table}
