"""Files shared with other programs: pandas, polars and xarray read what hexbench writes without options, and it reads what they write."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pandas as pd
import polars as pl
import pytest
from conftest import Command, case

from hexbench import study

AXES = ["geometry", "poses", "noise_scale"]
STUDY = """
format = "study/1"
title = "two axes"
seed = 2
trials = 20
task = "springs"
[axes]
geometry = ["ring_a", "ring_b"]
plan = ["random"]
poses = [2, 3, 6]
noise_scale = [0.5, 1]
"""


@pytest.fixture(scope="module")
def readings(command: Command, tmp_path_factory: pytest.TempPathFactory) -> dict[str, Path]:
    """Return the table of `compare` in both formats."""
    folder = tmp_path_factory.mktemp("tables")
    paths = {kind: folder / f"readings.{kind}" for kind in ("csv", "parquet")}
    hexapod, data, holdout = case("contact")
    for path in paths.values():
        command("compare", hexapod, data, "--holdout", holdout, "--table", path)
    return paths


@pytest.fixture(scope="module")
def swept(tmp_path_factory: pytest.TempPathFactory) -> study.Results:
    """Return the results of a small study."""
    folder = tmp_path_factory.mktemp("study")
    path = folder / "study.toml"
    path.write_text(STUDY)
    return study.run(None, path, folder / "results")


def test_pandas_and_polars_read_the_readings_from_both_formats_alike(readings: dict[str, Path]) -> None:
    frames = {
        "pandas csv": pd.read_csv(readings["csv"]),
        "pandas parquet": pd.read_parquet(readings["parquet"]),
        "polars csv": pl.read_csv(readings["csv"]).to_pandas(),
        "polars parquet": pl.read_parquet(readings["parquet"]).to_pandas(),
    }
    first = frames["pandas parquet"]
    for name, frame in frames.items():
        assert list(frame.columns) == list(first.columns), name
        for column in first.columns:
            if column == "part":
                assert set(frame[column]) == {"measurements", "holdout"}, name
            else:
                assert np.issubdtype(frame[column].dtype, np.number), f"{name}: {column} is {frame[column].dtype}"
                np.testing.assert_array_equal(frame[column], first[column], err_msg=f"{name}: {column}")
    left = first["da_um"] - first["predicted_da_um"]
    np.testing.assert_allclose(first["residual_da_um"], left, atol=1e-9)


def test_the_parquet_file_carries_units_and_meanings(readings: dict[str, Path]) -> None:
    import json

    notes = pl.read_parquet_metadata(readings["parquet"])
    fields = json.loads(notes["fields"])
    assert set(fields) == set(pl.read_parquet(readings["parquet"]).columns)
    assert fields["leg_1_force_N"]["unit"] == "N"
    assert notes["format"] == "readings/1"
    assert len(notes["sha256:measurements.csv"]) == 64


def test_cells_of_a_study_are_a_cube_of_xarray(swept: study.Results) -> None:
    cells = pd.read_csv(swept.folder / "cells.csv")
    cube = cells.set_index(AXES).to_xarray()
    assert dict(cube.sizes) == {"geometry": 2, "poses": 3, "noise_scale": 2}
    error = cube["stiffness_error_rms_percent"]
    # Twice the noise, twice the error, up to the chance of twenty trials: each error is sure to about 10 %.
    ratio = error.sel(noise_scale=1.0) / error.sel(noise_scale=0.5)
    assert ((ratio > 1.4) & (ratio < 2.8)).all(), ratio
    assert not cells.isna().all().any(), "a column without a single value"


def test_trials_of_a_study_are_read_alike_by_pandas_and_polars(swept: study.Results) -> None:
    by_pandas, by_polars = swept.trials(), pl.read_parquet(swept.folder / "trials.parquet")
    assert len(by_pandas) == 12 * 20 == len(by_polars)
    assert list(by_pandas.columns) == by_polars.columns
    errors = [name for name in by_pandas if name.startswith("error_")]
    assert by_pandas["poses"].dtype.kind in "if"
    for name in errors:
        np.testing.assert_array_equal(by_pandas[name], by_polars[name].to_numpy())
    counted = by_pandas.groupby("cell").size()
    assert list(counted) == [20] * 12


def test_parquet_of_pandas_and_polars_is_read_however_they_compress_it(command: Command, tmp_path: Path) -> None:
    hexapod, data, _ = case("contact")
    path = tmp_path / "kept.parquet"
    expected = command("check", hexapod, data).stdout.replace(data.name, path.name)
    table = pd.read_csv(data, comment="#")
    for compression in ("snappy", "zstd", "gzip", "lz4", None):
        table.to_parquet(path, compression=compression)
        assert command("check", hexapod, path).stdout == expected, compression
    pl.from_pandas(table).write_parquet(path)
    assert command("check", hexapod, path).stdout == expected, "polars"
    table.to_parquet(path, compression="brotli")
    refused = command("check", hexapod, path, code=3).stderr
    assert "compressed with brotli" in refused and "snappy" in refused
