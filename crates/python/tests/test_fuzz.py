"""Whatever is handed over: a result, or one of hexbench's own exceptions; never a panic, never a crash."""

from collections.abc import Callable
from typing import Any

import numpy as np
import pytest
from conftest import case

import hexbench

HEXAPOD = hexbench.Hexapod.read(case("mujoco-foundation")[0])
CAMPAIGN = hexbench.load(HEXAPOD, case("mujoco-foundation")[1])
MODEL = hexbench.fit(CAMPAIGN, ["base-compliance"])
ROUNDS = 400


def _strange(rng: np.random.Generator, count: int) -> Any:
    """Return something that may or may not be an array of numbers."""
    shapes = [(count, 6), (count, 6), (count, 5), (count, 0), (0, 6), (6,), (), (count, 6, 1), (1, 6), (6, count)]
    scale = 10.0 ** float(rng.integers(-300, 300))
    array = np.asarray(rng.normal(size=shapes[rng.integers(len(shapes))]) * scale)
    kinds: list[Callable[[np.ndarray], Any]] = [
        lambda a: a,
        lambda a: np.asfortranarray(a),
        lambda a: a[..., ::-1] if a.ndim else a,
        lambda a: a[::2] if a.ndim else a,
        lambda a: np.repeat(a, 2, axis=-1)[..., ::2] if a.ndim else a,
        lambda a: _readonly(a),
        lambda a: a.astype(np.float32),
        lambda a: np.zeros(a.shape, np.int64),
        lambda a: np.zeros(a.shape, np.float16),
        lambda a: a.astype(">f8"),
        lambda a: a.astype(complex),
        lambda a: a.astype(str),
        lambda a: a.astype(object),
        lambda a: a > 0,
        lambda a: a.tolist(),
        lambda a: np.where(rng.random(a.shape) < 0.05, np.nan, a),
        lambda a: np.where(rng.random(a.shape) < 0.05, np.inf, a),
        lambda a: np.ma.masked_less(a, 0.0),
        lambda a: None,
        lambda a: "poses",
        lambda a: [[1.0], [2.0, 3.0]],
        lambda a: {1: 2},
        lambda a: np.zeros(a.shape, "datetime64[s]"),
        lambda a: np.zeros(max(count, 1), dtype=[("a_mm", float), ("b_mm", float)]),
    ]
    with np.errstate(all="ignore"):
        return kinds[rng.integers(len(kinds))](array)


def _readonly(array: np.ndarray) -> np.ndarray:
    array = np.array(array)
    array.flags.writeable = False
    return array


def _tried(call: Callable[[], Any]) -> bool:
    try:
        call()
    except hexbench.HexbenchError as refused:
        assert refused.message and not refused.message.startswith("the computation stopped"), refused
        return False
    return True


@pytest.mark.filterwarnings("ignore")
def test_strange_arrays_are_used_or_refused() -> None:
    rng = np.random.default_rng(20261121)
    accepted = 0
    for _ in range(ROUNDS):
        poses, wrenches, third = (_strange(rng, int(rng.integers(0, 4))) for _ in range(3))
        accepted += _tried(lambda: MODEL.predict(poses, wrenches, covariance=True))  # noqa: B023
        accepted += _tried(lambda: hexbench.fit(hexbench.Campaign.from_arrays(HEXAPOD, poses, wrenches, third)))  # noqa: B023
        _tried(lambda: hexbench.Hexapod(poses, wrenches))  # noqa: B023
        _tried(lambda: hexbench.HexapodModel(HEXAPOD).fit(poses, third))  # noqa: B023
    assert accepted > 5, accepted


@pytest.mark.filterwarnings("ignore")
def test_strange_tables_are_used_or_refused() -> None:
    rng = np.random.default_rng(20261122)
    whole = CAMPAIGN.to_columns()
    for _ in range(ROUNDS):
        table: dict[Any, Any] = dict(whole)
        for name in rng.choice(list(whole), size=rng.integers(1, 4), replace=False):
            change = rng.integers(7)
            if change == 0:
                del table[name]
            elif change == 1:
                table[name] = _strange(rng, len(CAMPAIGN))
            elif change == 2:
                table[name] = np.where(rng.random(len(CAMPAIGN)) < 0.02, np.nan, table[name])
            elif change == 3:
                table[int(rng.integers(9))] = table.pop(name)
            elif change == 4:
                table[f'{name}"\n\x1f'] = table.pop(name)
            elif change == 5:
                table[name] = [*table[name][:-1].tolist(), "x\x00y"]
            else:
                table[name] = table[name][:-1]
        _tried(lambda: hexbench.load(HEXAPOD, table))  # noqa: B023


def test_any_layout_of_the_same_numbers_gives_the_same_bytes() -> None:
    poses, wrenches = CAMPAIGN.poses, CAMPAIGN.wrenches
    expected = MODEL.predict(poses, wrenches)
    wide = np.zeros((len(poses), 12))
    wide[:, ::2] = poses
    layouts = [np.asfortranarray(poses), wide[:, ::2], poses[::-1][::-1], _readonly(poses.copy()), poses.tolist()]
    layouts += [poses.astype(">f8"), poses.astype(object), np.ma.array(poses)]
    for layout in layouts:
        assert np.array_equal(MODEL.predict(layout, wrenches), expected)
    single = poses.astype(np.float32)
    assert np.array_equal(MODEL.predict(single, wrenches), MODEL.predict(single.astype(float), wrenches))


def test_results_are_arrays_of_their_own() -> None:
    first = MODEL.covariance
    first[:] = 0.0
    assert MODEL.covariance[0, 0] > 0.0
    columns = CAMPAIGN.to_columns()
    columns["fz_N"][:] = 0.0
    assert CAMPAIGN.to_columns()["fz_N"].any()


def test_no_rows_are_a_prediction_of_no_rows_and_no_campaign() -> None:
    values, covariance = MODEL.predict(np.empty((0, 6)), np.empty((0, 6)), covariance=True)
    assert values.shape == (0, 6) and covariance.shape == (0, 6, 6)
    with pytest.raises(hexbench.BadInput, match="no row of measurements"):
        hexbench.Campaign.from_arrays(HEXAPOD, *[np.empty((0, 6))] * 3)


@pytest.mark.parametrize("wrong", [None, 3, b"x", object(), "no-such-file.csv", "\0", ""])
def test_data_of_the_wrong_kind_are_refused(wrong: object) -> None:
    with pytest.raises(hexbench.HexbenchError):
        hexbench.load(HEXAPOD, wrong)  # type: ignore[arg-type]


@pytest.mark.parametrize(
    "choice", [{"seed": -1}, {"seed": 1.5}, {"seed": 2**64}, {"poses": -3}, {"repeats": 10**30}, {"poses": 0}]
)
def test_choices_out_of_bounds_are_refused(choice: dict[str, Any]) -> None:
    from conftest import SCENES

    with pytest.raises(hexbench.UsageError):
        hexbench.simulate(SCENES / "paper-rich", **choice)


@pytest.mark.filterwarnings("ignore")
def test_campaigns_of_any_size_are_computed_or_refused() -> None:
    rng = np.random.default_rng(20261123)
    used = [0, 0]
    for _ in range(30):
        chosen = rng.choice(len(CAMPAIGN), size=rng.integers(2, 40))
        scales = [float(10.0 ** rng.choice([0, 0, 0, -200, -9, 3, 9, 200, 300])) for _ in range(3)]
        arrays = [a[chosen] * s for a, s in zip((CAMPAIGN.poses, CAMPAIGN.wrenches, CAMPAIGN.measured), scales, strict=True)]

        def campaign() -> hexbench.Campaign:
            return hexbench.Campaign.from_arrays(HEXAPOD, *arrays)  # noqa: B023

        used[0] += _tried(lambda: hexbench.fit(campaign(), ["leg-backlash"]))  # noqa: B023
        used[1] += _tried(lambda: (hexbench.diagnose(campaign()), hexbench.compare(campaign())))  # noqa: B023
    assert min(used) > 5, used
