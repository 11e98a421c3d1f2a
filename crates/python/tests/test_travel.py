"""Results travel between processes and are copied; what arrives tells the same."""

import copy
import pickle
from pathlib import Path

import pytest
from conftest import SCENES, case

import hexbench


def _diagnosed(name: str) -> hexbench.Diagnosis:
    hexapod, data, holdout = case(name)
    return hexbench.diagnose(hexbench.load(hexapod, data), holdout=holdout)


def _results(tmp_path: Path) -> list[object]:
    hexapod, data, _ = case("mujoco-foundation")
    campaign = hexbench.load(hexapod, data)
    return [
        _diagnosed("mujoco-foundation"),
        hexbench.compare(campaign),
        hexbench.discover(hexbench.load(*case("mujoco-clean")[:2])),
        hexbench.fit(campaign, ["base-compliance"]),
        hexbench.commands.check(hexapod, data),
        campaign.hexapod,
    ]


def test_every_result_is_equal_after_pickle_and_copy(tmp_path: Path) -> None:
    for result in _results(tmp_path):
        for again in (pickle.loads(pickle.dumps(result)), copy.deepcopy(result), copy.copy(result)):
            assert type(again) is type(result) and again == result and str(again) == str(result)


def test_a_kept_diagnosis_draws_its_page_again(tmp_path: Path) -> None:
    first = _diagnosed("mujoco-foundation")
    again = pickle.loads(pickle.dumps(pickle.loads(pickle.dumps(first))))
    first.to_html(tmp_path / "first.html")
    again.to_html(tmp_path / "again.html")
    assert (tmp_path / "first.html").read_bytes() == (tmp_path / "again.html").read_bytes()
    assert again.text(verbose=True) == first.text(verbose=True) and again.added == ["base-compliance"]


def test_a_kept_plan_has_its_readings() -> None:
    plan = hexbench.design(hexbench.Hexapod.read(case("paper-protocol")[0]), SCENES.parent / "data" / "designs" / "paper-space.toml")
    again = pickle.loads(pickle.dumps(plan))
    assert str(again) == str(plan) and again.value == plan.value and again.to_csv() == plan.to_csv()


def test_a_cluster_diagnoses_many_campaigns() -> None:
    distributed = pytest.importorskip("distributed")
    campaigns = [hexbench.load(*case(name)[:2]) for name in ("mujoco-foundation", "mujoco-clean")]
    with distributed.LocalCluster(n_workers=2, threads_per_worker=1, dashboard_address=None) as cluster:
        with distributed.Client(cluster) as client:
            found = client.gather(client.map(hexbench.diagnose, campaigns))
    assert found == [hexbench.diagnose(campaign) for campaign in campaigns]


def test_results_are_shown_in_a_notebook(tmp_path: Path) -> None:
    for result in _results(tmp_path)[:-1]:
        assert "<" in result._repr_html_()  # type: ignore[attr-defined]


def test_a_diagnosis_is_drawn() -> None:
    matplotlib = pytest.importorskip("matplotlib")
    matplotlib.use("Agg")
    left, right = _diagnosed("mujoco-foundation").plot()
    assert [t.get_text() for t in left.get_yticklabels()][-1] == "base-compliance"
    assert [t.get_text() for t in right.get_xticklabels()] == ["springs", "+ base-compliance"]


def test_a_campaign_is_a_dataset_with_coordinates_and_units() -> None:
    pytest.importorskip("xarray")
    campaign = hexbench.load(*case("mujoco-foundation")[:2])
    found = campaign.to_xarray()
    assert list(found.data_vars) == ["da_um", "db_um", "dc_um", "dalpha_urad", "dbeta_urad", "dgamma_urad"]
    units = {name: found[name].attrs.get("units") for name in ("da_um", "dgamma_urad", "alpha_deg", "mx_Nm", "a_mm", "pose")}
    assert units == {"da_um": "um", "dgamma_urad": "urad", "alpha_deg": "degree", "mx_Nm": "N m", "a_mm": "mm", "pose": None}
    assert "a_mm" in found.coords and found.sizes == {"reading": len(campaign)}
