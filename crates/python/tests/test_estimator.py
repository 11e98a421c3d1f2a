"""The estimator behaves as scikit-learn's do."""

import pickle
from copy import deepcopy

import numpy as np
import pandas as pd
import pytest
from conftest import case

import hexbench


def _data(name: str = "mujoco-foundation") -> tuple[hexbench.Campaign, np.ndarray, np.ndarray]:
    hexapod, data, _ = case(name)
    campaign = hexbench.load(hexapod, data)
    columns = campaign.to_columns()
    reference = np.column_stack([values for key, values in columns.items() if key.startswith("ref_")])
    return campaign, np.hstack([campaign.poses, campaign.wrenches, reference]), campaign.measured


def _clone(estimator: hexbench.HexapodModel) -> hexbench.HexapodModel:
    """Copy as sklearn.base.clone does: the constructor on copies of the parameters, which it must keep as they are."""
    parameters = {key: deepcopy(value) for key, value in estimator.get_params(deep=False).items()}
    copy = type(estimator)(**parameters)
    assert all(copy.get_params(deep=False)[key] is value for key, value in parameters.items())
    return copy


def test_it_fits_what_fit_fits() -> None:
    campaign, X, y = _data()
    estimator = hexbench.HexapodModel(campaign.hexapod, terms=["base-compliance"])
    assert estimator.fit(X, y) is estimator
    assert estimator.model_.values == hexbench.fit(campaign, ["base-compliance"]).values
    table = campaign.to_pandas()
    of_table = hexbench.HexapodModel(campaign.hexapod, ["base-compliance"]).fit(table, y)
    assert of_table.model_.values == estimator.model_.values
    assert np.array_equal(of_table.predict(table), estimator.predict(X))
    whole = hexbench.HexapodModel(campaign.hexapod, ["base-compliance"]).fit_campaign(campaign)
    assert whole.model_.to_toml() == hexbench.fit(campaign, ["base-compliance"]).to_toml()


def test_the_score_is_a_coefficient_of_determination_in_units_of_the_noise() -> None:
    campaign, X, y = _data()
    estimator = hexbench.HexapodModel(campaign.hexapod).fit(X, y)
    translation, rotation = campaign.hexapod.sigma_translation_um, campaign.hexapod.sigma_rotation_urad
    assert translation is not None and rotation is not None
    sigma = np.array([translation] * 3 + [rotation] * 3)
    z, guess = y / sigma, estimator.predict(X) / sigma
    expected = 1 - ((z - guess) ** 2).sum() / ((z - z.mean(axis=0)) ** 2).sum()
    assert estimator.score(X, y) == pytest.approx(expected, rel=1e-12)
    assert estimator.score(X, estimator.predict(X)) == 1.0
    better = hexbench.HexapodModel(campaign.hexapod, ["base-compliance"]).fit(X, y)
    assert better.score(X, y) > estimator.score(X, y)


def test_held_out_folds_prefer_the_effect_that_is_there() -> None:
    campaign, X, y = _data()
    pose = campaign.to_columns()["pose"]
    scores = {}
    for terms in ((), ("base-compliance",), ("leg-backlash",)):
        estimator = hexbench.HexapodModel(campaign.hexapod, terms)
        held = [pose % 3 == k for k in range(3)]
        scores[terms] = np.mean([_clone(estimator).fit(X[~h], y[~h]).score(X[h], y[h]) for h in held])
    assert max(scores, key=lambda terms: scores[terms]) == ("base-compliance",), scores


def test_parameters_are_kept_set_and_cloned() -> None:
    campaign, X, y = _data()
    estimator = hexbench.HexapodModel(campaign.hexapod, terms=["base-compliance"])
    assert set(estimator.get_params()) == {"hexapod", "terms"}
    assert estimator.set_params(terms=["leg-backlash"]) is estimator and estimator.terms == ["leg-backlash"]
    with pytest.raises(hexbench.UsageError, match="no parameter 'alpha'"):
        estimator.set_params(alpha=1)
    copy = _clone(estimator.set_params(terms=[]).fit(X, y))
    assert not hasattr(copy, "model_")
    with pytest.raises(hexbench.UsageError, match="not fitted"):
        copy.predict(X)
    kept = pickle.loads(pickle.dumps(estimator))
    assert np.array_equal(kept.predict(X), estimator.predict(X))


def test_conditions_that_are_none_are_refused() -> None:
    campaign, X, y = _data()
    estimator = hexbench.HexapodModel(campaign.hexapod)
    with pytest.raises(hexbench.BadInput, match=r"X: expected shape \(n, 12\)"):
        estimator.fit(X[:, :11], y)
    with pytest.raises(hexbench.BadInput, match=r"measured: expected shape \(168, 6\)"):
        estimator.fit(X, y[:-1])
    with pytest.raises(hexbench.UsageError, match="required columns are missing: fz_N"):
        estimator.fit(campaign.to_pandas().drop(columns="fz_N"), y)
    X[3, 8] = np.nan
    with pytest.raises(hexbench.BadInput, match=r"row 3 \(fz_N\)"):
        estimator.fit(pd.DataFrame(X).to_numpy(), y)
