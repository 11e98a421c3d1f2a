"""The estimator is one of scikit-learn's: its own checks, cross-validation, grid search."""

from typing import Any

import numpy as np
import pytest
from conftest import case

import hexbench
from hexbench import blocks

pytest.importorskip("sklearn")
from sklearn.base import clone, is_regressor  # noqa: E402
from sklearn.model_selection import GridSearchCV, cross_val_score  # noqa: E402
from sklearn.utils import estimator_checks  # noqa: E402

#: Checks whose data no fit of a hexapod can take, or that ask for another kind of exception; everything else has to pass.
NOT_MEANT = {
    "check_positive_only_tag_during_fit": "its data are not made into conditions; they leave springs open",
    "check_dtype_object": "a dict among the numbers is BadInput, a ValueError, as everywhere in hexbench; a TypeError is asked for",
    "check_regressor_multioutput": "it gives five outputs; a pose has six",
}


def _data() -> tuple[hexbench.Hexapod, np.ndarray, np.ndarray, np.ndarray]:
    hexapod, data, _ = case("mujoco-foundation")
    campaign = hexbench.load(hexapod, data)
    columns = campaign.to_columns()
    reference = np.column_stack([values for key, values in columns.items() if key.startswith("ref_")])
    return campaign.hexapod, np.hstack([campaign.poses, campaign.wrenches, reference]), campaign.measured, columns["pose"]


class _Conditions:
    """Poses and loads in the place of the data of scikit-learn's checks, as its tags do for data that are positive or labels."""

    def __init__(self, hexapod: hexbench.Hexapod) -> None:
        self.hexapod = hexapod
        self.last = np.empty((0, 12))

    def _of(self, data: Any) -> Any:
        array = np.asarray(data)
        if array.dtype.kind not in "fiu" or array.ndim != 2 or array.shape[1] < 2:
            return data
        width = array.shape[1]
        spread = [np.roll(array[:, j % width].astype(float), j // width) * (1 + j) for j in range(12)]
        return 5 * np.sin(3 * np.column_stack(spread) + np.arange(12)) * np.array([1] * 6 + [20] * 3 + [1] * 3)

    def x(self, _: object, data: Any, test: Any = None, kernel: object = None) -> Any:
        self.last = self._of(data)
        return self.last if test is None else (self.last, self._of(test))

    def y(self, _: object, data: Any) -> Any:
        if np.ndim(self.last) != 2 or np.shape(self.last)[1] != 12 or len(self.last) != len(data):
            return np.ones((len(data), 6))
        return blocks.regressor(self.hexapod, self.last[:, :6], self.last[:, 6:]) @ np.linspace(0.2, 0.3, 6)


@pytest.mark.filterwarnings("ignore")
def test_it_passes_the_checks_of_scikit_learn(monkeypatch: pytest.MonkeyPatch) -> None:
    hexapod = _data()[0]
    conditions = _Conditions(hexapod)
    monkeypatch.setattr(estimator_checks, "_enforce_estimator_tags_X", conditions.x)
    monkeypatch.setattr(estimator_checks, "_enforce_estimator_tags_y", conditions.y)
    found = estimator_checks.check_estimator(
        hexbench.HexapodModel(hexapod), expected_failed_checks=NOT_MEANT, on_fail=None, on_skip=None
    )
    status = {(r["check_name"], r["status"]): str(r["exception"]) for r in found}
    failed = {name: why for (name, how), why in status.items() if how == "failed"}
    assert not failed, failed
    assert {name for name, how in status if how == "xfail"} == set(NOT_MEANT)
    assert sum(how == "passed" for _, how in status) > 40, len(status)


def test_a_function_is_a_term_of_the_estimator() -> None:
    hexapod, x, y, _ = _data()
    term = hexbench.Term(lambda df, size: size * df**3, id="cubic-spring", parameters=[hexbench.Parameter("size", "nm/N", 1)])
    model = clone(hexbench.HexapodModel(hexapod, [term])).fit(x, y)
    assert model.model_.terms == ["cubic-spring"] and model.terms == [term]
    assert model.model_.chi2 <= hexbench.HexapodModel(hexapod).fit(x, y).model_.chi2 * (1 + 1e-9)


def test_cross_validation_prefers_the_effect_that_is_there() -> None:
    hexapod, X, y, pose = _data()
    estimator = hexbench.HexapodModel(hexapod)
    assert is_regressor(estimator) and clone(estimator).hexapod == hexapod
    held = [(np.flatnonzero(pose % 3 != k), np.flatnonzero(pose % 3 == k)) for k in range(3)]
    springs = cross_val_score(estimator, X, y, cv=held)
    better = cross_val_score(hexbench.HexapodModel(hexapod, ["base-compliance"]), X, y, cv=held)
    assert springs.shape == (3,) and better.mean() > springs.mean()
    search = GridSearchCV(estimator, {"terms": [[], ["base-compliance"], ["leg-backlash"]]}, cv=held).fit(X, y)
    assert search.best_params_ == {"terms": ["base-compliance"]}
    assert search.best_estimator_.n_features_in_ == 18
