"""Tables and arrays as input: anything but tables of numbers is refused here; the numbers are checked natively."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from typing import TYPE_CHECKING, Any, TypeAlias

import numpy as np
from numpy.typing import ArrayLike, NDArray

from hexbench.errors import BadInput, UsageError

if TYPE_CHECKING:
    import pandas as pd

Floats: TypeAlias = NDArray[np.float64]
#: A table with named columns: a pandas or polars DataFrame, a mapping of names to one-dimensional arrays, a structured array.
Table: TypeAlias = "pd.DataFrame | Mapping[str, ArrayLike] | NDArray[Any]"

POSE = ("a_mm", "b_mm", "c_mm", "alpha_deg", "beta_deg", "gamma_deg")
WRENCH = ("fx_N", "fy_N", "fz_N", "mx_Nm", "my_Nm", "mz_Nm")
REFERENCE = tuple(f"ref_{name}" for name in WRENCH)
DEFLECTION = ("da_um", "db_um", "dc_um", "dalpha_urad", "dbeta_urad", "dgamma_urad")
ABSOLUTE = tuple(f"measured_{name}" for name in POSE)
SIGMA = ("sigma_a_um", "sigma_b_um", "sigma_c_um", "sigma_alpha_urad", "sigma_beta_urad", "sigma_gamma_urad")


def is_table(data: object) -> bool:
    """Return whether something has named columns."""
    structured = isinstance(data, np.ndarray) and data.dtype.names is not None
    return isinstance(data, Mapping) or structured or (hasattr(data, "columns") and hasattr(data, "__getitem__"))


def columns_of(data: Any, name: str) -> tuple[list[str], list[Floats | list[str]]]:
    """Return the names of a table's columns, and their cells: numbers, or texts where a cell is no number."""
    if not is_table(data):
        kind = type(data).__name__
        raise UsageError(
            f"{name}: expected a path or a table with named columns, found {kind}",
            "Give the name of a measurements.csv, a DataFrame, or a mapping of column names to arrays.",
        )
    names, columns = _named(data)
    return [str(n) for n in names], [_cells(column, f"{name}: {n}") for n, column in zip(names, columns, strict=True)]


def _named(data: Any) -> tuple[list[Any], list[Any]]:
    if isinstance(data, Mapping):
        return list(data.keys()), list(data.values())
    if isinstance(data, np.ndarray):
        names = list(data.dtype.names or ())
        return names, [data[n] for n in names]
    names = list(data.columns)
    # By position where there is one: two columns may have one name.
    by_position = getattr(data, "iloc", None)
    return names, [data[n] if by_position is None else by_position[:, k] for k, n in enumerate(names)]


def _cells(column: Any, place: str) -> Floats | list[str]:
    array = as_array(column, place)
    if array.ndim != 1:
        raise BadInput(f"{place}: expected one value per reading, found shape {array.shape}", "Use one-dimensional columns.")
    if array.dtype.kind in "fiu":
        return np.ascontiguousarray(array, dtype=np.float64)
    return [_text(value) for value in array.tolist()]


def _text(value: Any) -> str:
    missing = value is None or type(value).__name__ in ("NAType", "NaTType") or (isinstance(value, float) and value != value)
    return "" if missing else str(value)


def as_array(value: Any, place: str) -> NDArray[Any]:
    """Return a value as a NumPy array."""
    if isinstance(value, np.ma.MaskedArray):
        return np.asarray(np.ma.filled(value.astype(np.float64), np.nan))
    try:
        return np.asarray(value)
    except (TypeError, ValueError) as cause:
        raise BadInput(f"{place}: this is not an array of numbers ({cause})", "Use rows of equal length.") from None


def rows(value: Any, width: int, name: str, count: int | None = None) -> Floats:
    """Return an array of shape (n, width), whatever its type, order and strides were."""
    array = _numbers(value, name)
    if array.ndim != 2 or array.shape[1] != width or count not in (None, array.shape[0]):
        expected = f"({'n' if count is None else count}, {width})"
        next_step = f"Give one row of {width} numbers per reading."
        raise BadInput(f"{name}: expected shape {expected}, found {array.shape}", next_step)
    return np.ascontiguousarray(array, dtype=np.float64)


def one_per_row(value: Any, name: str, count: int) -> Floats:
    """Return an array of shape (count,); one number stands for all rows."""
    array = _numbers(value, name)
    if array.ndim == 0:
        return np.full(count, float(array))
    if array.shape != (count,):
        next_step = "Give one number per reading, or one for all."
        raise BadInput(f"{name}: expected shape ({count},), found {array.shape}", next_step)
    return np.ascontiguousarray(array, dtype=np.float64)


def _numbers(value: Any, name: str) -> NDArray[Any]:
    array = as_array(value, name)
    if array.dtype.kind == "O":
        try:
            array = array.astype(np.float64)
        except (TypeError, ValueError) as cause:
            raise BadInput(f"{name}: this is not an array of numbers ({cause})", "Use an array of floats.") from None
    if array.dtype.kind not in "fiu":
        raise BadInput(f"{name}: expected numbers, found the type {array.dtype}", "Use an array of floats.")
    return array


def spread(names: Iterable[str], array: Floats) -> dict[str, Floats]:
    """Return the columns of an array under their names."""
    return {name: np.ascontiguousarray(array[:, k]) for k, name in enumerate(names)}
