"""A machine with its measurements."""

from __future__ import annotations

from os import PathLike, fspath
from typing import TYPE_CHECKING, Any, TypeAlias

import numpy as np
from numpy.typing import ArrayLike

from hexbench import _native
from hexbench._tables import (
    ABSOLUTE,
    DEFLECTION,
    POSE,
    REFERENCE,
    SIGMA,
    WRENCH,
    Floats,
    Table,
    columns_of,
    one_per_row,
    rows,
    spread,
)
from hexbench._warn import warn
from hexbench.errors import UsageError
from hexbench.machine import Hexapod

if TYPE_CHECKING:
    import pandas as pd

#: Measurements: a path of measurements.csv, a table with its column names, or a campaign.
Data: TypeAlias = "str | PathLike[str] | Table | Campaign"


class Campaign:
    """Measurements of one machine: poses, loads and readings, as in ``measurements.csv``.

    Created by :func:`load`, :meth:`from_arrays` or :func:`hexbench.simulate`; immutable.
    """

    _made: _native.Campaign
    hexapod: Hexapod

    def __init__(self, native: _native.Campaign, hexapod: Hexapod) -> None:
        """Wrap the result of the readers; use :func:`load` or :meth:`from_arrays`."""
        self._made = native
        self.hexapod = hexapod

    @classmethod
    def from_arrays(
        cls,
        hexapod: Hexapod,
        poses: ArrayLike,
        wrenches: ArrayLike,
        measured: ArrayLike,
        *,
        reference: ArrayLike | None = None,
        approach: ArrayLike | None = None,
        delta_T_K: ArrayLike | None = None,
        elapsed_s: ArrayLike | None = None,
        ref_age_s: ArrayLike | None = None,
        overload: ArrayLike | None = None,
        ref_record: ArrayLike | None = None,
        order: ArrayLike | None = None,
        sigma: ArrayLike | None = None,
        pose: ArrayLike | None = None,
        repeat: ArrayLike | None = None,
        absolute: bool = False,
        name: str = "data",
    ) -> Campaign:
        """Create a campaign from arrays, one row per reading.

        Parameters
        ----------
        hexapod : Hexapod
            The machine.
        poses : array (n, 6)
            Commanded poses [a, b, c] in mm, [alpha, beta, gamma] in deg (extrinsic X-Y-Z), fixed frame.
        wrenches : array (n, 6)
            Load on the platform at the mobile origin, fixed axes: [fx, fy, fz] in N, [mx, my, mz] in N m.
        measured : array (n, 6)
            Deflections, loaded minus reference: [da, db, dc] in um, differences of the Euler angles in urad. With
            ``absolute=True`` poses as measured, in mm and deg.
        reference : array (n, 6), optional
            Load in the reference state, in N and N m; no load by default.
        approach : array (n,), optional
            +1: the load was approached from below; -1: it was first exceeded.
        delta_T_K, elapsed_s : array (n,), optional
            Temperature relative to the reference reading, and time since then.
        ref_age_s : array (n,), optional
            How long the reference load had been applied when the reference was read; omit it if unknown.
        overload : array (n,), optional
            With ``approach`` -1: factor by which the change of load was first exceeded; default 1.4.
        ref_record : array (n,), optional
            Number of the reference reading of a row; rows with the same number share its error.
        order : array (n,), optional
            Position in the sequence of loads: consecutive readings at one pose form one load path.
        sigma : array (n, 6), optional
            Standard deviation of each measured value, um and urad.
        pose, repeat : array (n,), optional
            Number of the pose and of the repeat, whole numbers.
        absolute : bool
            True if absolute poses were measured.
        name : str
            Name of the data in messages.

        Raises
        ------
        BadInput
            A shape, a type, a number that is not finite, an angle beyond a turn, ...
        """
        first = rows(poses, 6, "poses")
        count = len(first)
        table = {
            **spread(POSE, first),
            **spread(WRENCH, rows(wrenches, 6, "wrenches", count)),
            **spread(ABSOLUTE if absolute else DEFLECTION, rows(measured, 6, "measured", count)),
        }
        for names, values, what in ((REFERENCE, reference, "reference"), (SIGMA, sigma, "sigma")):
            if values is not None:
                table |= spread(names, rows(values, 6, what, count))
        single = {
            "approach": approach,
            "delta_T_K": delta_T_K,
            "elapsed_s": elapsed_s,
            "ref_age_s": ref_age_s,
            "overload": overload,
            "ref_record": ref_record,
            "order": order,
            "pose": pose,
            "repeat": repeat,
        }
        table |= {key: one_per_row(value, key, count) for key, value in single.items() if value is not None}
        return _of_table(hexapod, table, name)

    @property
    def absolute(self) -> bool:
        """True if absolute poses were measured, False for deflections."""
        return self._made.absolute

    @property
    def name(self) -> str:
        """Name of the data in messages: that of the file, if there is one."""
        return self._made.name

    def __len__(self) -> int:
        """Return the number of readings."""
        return self._made.readings

    def to_columns(self) -> dict[str, Floats]:
        """Return every column of ``measurements.csv`` under its name, each of shape (n,)."""
        return dict(self._made.columns())

    def to_pandas(self) -> pd.DataFrame:
        """Return the measurements as a DataFrame with the columns of ``measurements.csv`` (needs pandas)."""
        import pandas as pd

        frame = pd.DataFrame(self.to_columns())
        return frame.astype({"pose": "int64", "repeat": "int64"})

    def to_xarray(self) -> Any:
        """Return the measurements as an xarray Dataset over ``reading`` (needs xarray).

        Poses and loads are coordinates, measured values are data; every variable has its unit in ``attrs["units"]``.
        """
        import xarray as xr

        columns = self.to_columns()
        read = {name for name in columns if name.startswith(("measured_", "d"))} - {"delta_T_K"}
        variables = {name: ("reading", values, _unit(name)) for name, values in columns.items()}
        data = {name: variable for name, variable in variables.items() if name in read}
        rest = {name: variable for name, variable in variables.items() if name not in read}
        return xr.Dataset(data, rest, {"source": self.name, "machine": self.hexapod.name})

    def to_csv(self) -> str:
        """Return the text of ``measurements.csv``, in the units of the format."""
        return self._made.to_csv()

    def save(self, path: str | PathLike[str]) -> None:
        """Write ``measurements.csv``, completely or not at all."""
        _native.write_text(fspath(path), self.to_csv())

    @property
    def poses(self) -> Floats:
        """Commanded poses, shape (n, 6): mm and deg, fixed frame."""
        return self._stacked(POSE)

    @property
    def wrenches(self) -> Floats:
        """Loads, shape (n, 6): N and N m, at the mobile origin, fixed axes."""
        return self._stacked(WRENCH)

    @property
    def measured(self) -> Floats:
        """Measured values, shape (n, 6): deflections in um and urad, or poses in mm and deg."""
        columns = list(self.to_columns().items())
        names = [name for name, _ in columns if name.startswith("measured_") or name in _DEFLECTIONS]
        return self._stacked(names)

    def _stacked(self, names: tuple[str, ...] | list[str]) -> Floats:
        columns = self.to_columns()
        return np.column_stack([columns[name] for name in names])

    def __repr__(self) -> str:
        """Return machine, kind and number of readings."""
        kind = "absolute poses" if self.absolute else "deflections"
        return f"Campaign({self.hexapod.name!r}, {self.name!r}, {len(self)} {kind})"

    def __reduce__(self) -> tuple[Any, ...]:
        """Pickle as the texts of the files."""
        return (_restored, (self.hexapod, self.to_csv(), self.name, self._made.origin))


_UNITS = {"mm": "mm", "deg": "degree", "um": "um", "urad": "urad", "N": "N", "Nm": "N m", "K": "K", "s": "s"}


def _unit(column: str) -> dict[str, str]:
    """Return the unit at the end of the name of a column, as attributes of xarray."""
    unit = _UNITS.get(column.rpartition("_")[2])
    return {} if unit is None else {"units": unit}


_DEFLECTIONS = {*DEFLECTION, "drx_urad", "dry_urad", "drz_urad"}


def load(hexapod: Hexapod | str | PathLike[str], data: Data) -> Campaign:
    """Load the measurements of a machine.

    Parameters
    ----------
    hexapod : Hexapod or path
        The machine, or its ``hexapod.toml``.
    data : path or table
        ``measurements.csv``, or a table with its columns: a pandas or polars DataFrame, a mapping of names to arrays, a
        structured array. Units are in the names (``da_um``, ``da_mm``, ...).

    Returns
    -------
    Campaign

    Raises
    ------
    BadInput
        The error with place, value, rule and next step: the text of the CSV reader, with the row of a table counted from 0.
    InputOutput
        A file cannot be read.

    Warns
    -----
    HexbenchWarning
        Input that was accepted but should be checked: an unknown column, a copied row, ...
    """
    machine = hexapod if isinstance(hexapod, Hexapod) else Hexapod.read(hexapod)
    return _loaded(machine, data, "data")


def held_out(campaign: Campaign, holdout: Data | None) -> _native.Campaign | None:
    """Return held-out readings for the campaign's machine."""
    return None if holdout is None else _loaded(campaign.hexapod, holdout, "holdout")._made


def _loaded(hexapod: Hexapod, data: Data, name: str) -> Campaign:
    if isinstance(data, Campaign):
        same = data.hexapod == hexapod
        return data if same else _restored(hexapod, data.to_csv(), data.name, data._made.origin)
    if not isinstance(data, (str, PathLike)):
        return _of_table(hexapod, data, name)
    native, noticed = _native.Campaign.read(hexapod._made, fspath(data))
    warn(noticed, stacklevel=4)
    return Campaign(native, hexapod)


def _of_table(hexapod: Hexapod, table: Any, name: str) -> Campaign:
    if not isinstance(hexapod, Hexapod):
        raise UsageError(f"expected a Hexapod, found {type(hexapod).__name__}", "Hexapod.read(path) creates one.")
    names, columns = columns_of(table, name)
    native, noticed = _native.Campaign.of_columns(hexapod._made, names, columns, name)
    warn(noticed, stacklevel=4)
    return Campaign(native, hexapod)


def _restored(hexapod: Hexapod, text: str, name: str, origin: tuple[str, str]) -> Campaign:
    return Campaign(_native.Campaign.of_text(hexapod._made, text, name, origin), hexapod)
