"""Plans of experiments: the poses, loads and sensors that determine the parameters best."""

from __future__ import annotations

from collections.abc import Sequence
from copy import deepcopy
from os import PathLike, fspath
from types import SimpleNamespace
from typing import TYPE_CHECKING, Any

import numpy as np

from hexbench import _native
from hexbench._bounds import whole
from hexbench._html import pre
from hexbench._tables import POSE, WRENCH, Floats
from hexbench.errors import UsageError
from hexbench.machine import Hexapod

if TYPE_CHECKING:
    import pandas as pd


class Plan:
    """Readings to take."""

    def __init__(self, native: _native.Plan) -> None:
        """Wrap the result of :func:`design`."""
        self._made = native

    @property
    def criterion(self) -> str:
        """Criterion of the plan."""
        return self._made.criterion

    @property
    def value(self) -> float:
        """Value of the criterion for the plan, whose poses (um, 0.001 deg) and chosen loads are rounded; larger is better."""
        return self._made.value

    @property
    def efficiency(self) -> float | None:
        """Smallest share of the budget with which the best plan over the candidates could achieve the same; None if no bound is
        known.
        """
        return self._made.efficiency

    def to_columns(self) -> dict[str, Floats]:
        """Return the columns of ``measurements.csv`` without the measured columns, each of shape (n,)."""
        return dict(self._made.columns())

    def to_pandas(self) -> pd.DataFrame:
        """Return the readings to take as a DataFrame, one row each (needs pandas)."""
        import pandas as pd

        return pd.DataFrame(self.to_columns()).astype({"pose": "int64", "repeat": "int64"})

    @property
    def poses(self) -> Floats:
        """The different poses, shape (p, 6): mm and deg, fixed frame."""
        columns = self.to_columns()
        _, first = np.unique(columns["pose"], return_index=True)
        return np.column_stack([columns[name] for name in POSE])[np.sort(first)]

    @property
    def loads(self) -> Floats:
        """The different loads in the order of the plan, listed and chosen ones, shape (m, 6): N and N m, fixed axes."""
        columns = self.to_columns()
        wrenches = np.column_stack([columns[name] for name in WRENCH])
        _, first = np.unique(wrenches, axis=0, return_index=True)
        return wrenches[np.sort(first)]

    def __len__(self) -> int:
        """Return the number of readings."""
        return len(self.to_columns()["pose"])

    def __str__(self) -> str:
        """Return the page of ``hexbench design``."""
        return self._made.text

    def __repr__(self) -> str:
        """Return size, criterion and value."""
        return f"Plan({len(self)} readings at {len(self.poses)} poses, {self.criterion} = {self.value:.6g})"

    def to_csv(self) -> str:
        """Return the text of ``plan.csv``: ``measurements.csv`` without the measured columns."""
        columns = self.to_columns()
        cells = zip(*(values.tolist() for values in columns.values()), strict=True)
        whole_numbers = [name in ("pose", "repeat") for name in columns]
        lines = (",".join(repr(int(x) if w else x) for x, w in zip(row, whole_numbers, strict=True)) for row in cells)
        return "\n".join([",".join(columns), *lines]) + "\n"

    def _repr_html_(self) -> str:
        return pre(str(self))

    def __reduce__(self) -> tuple[Any, ...]:
        """Pickle the readings and the report."""
        said = {"criterion": self.criterion, "value": self.value, "efficiency": self.efficiency, "text": str(self)}
        return (_kept_plan, (self.to_columns(), said))


def design(
    hexapod: Hexapod,
    space: str | PathLike[str],
    *,
    poses: int | None = None,
    repeats: int = 3,
    readings: int | None = None,
    hours: float | None = None,
    candidates: int = 256,
    criterion: str | None = None,
    add: Sequence[str] = (),
    starts: int | None = None,
    seed: int = 1,
) -> Plan:
    """Choose the poses and loads that best determine stiffnesses (and effects): ``hexbench design``.

    Parameters
    ----------
    hexapod : Hexapod
        The machine.
    space : path
        Allowed poses, and available loads or their bounds: space.toml.
    poses : int, optional
        Number of poses (1 to 60), each measured under every load and condition; default 3.
    repeats : int
        Readings per pose, load and condition.
    readings : int, optional
        Choose this many readings (1 to 2000) instead of poses that all share the same loads and conditions.
    hours : float, optional
        Choose readings that fit into this many hours.
    candidates : int
        Number of candidate poses from which to choose readings.
    criterion : str, optional
        o1 ... o5, d, a, e or i; by default o1 for poses, d for readings and hours.
    add : sequence of str
        Terms that the plan must also determine.
    starts : int, optional
        Number of searches from different starts: default 16, or 128 for poses whose inputs are taken as exact.
    seed : int
        Seed of the starts.

    Raises
    ------
    BadInput, UsageError, NotDetermined
        With the text of the command.
    """
    if sum(x is not None for x in (poses, readings, hours)) > 1:
        raise UsageError("poses, readings and hours are mutually exclusive", "Use one of them.")
    wanted = {
        "poses": whole(poses, "poses", 1, 60),
        "repeats": whole(repeats, "repeats", 1, 1000),
        "readings": whole(readings, "readings", 1, 2000),
        "hours": None if hours is None else float(hours),
        "candidates": whole(candidates, "candidates", 1, 8192),
        "criterion": criterion,
        "terms": [add] if isinstance(add, str) else list(add),
        "starts": whole(starts, "starts", 1, 4096),
        "seed": whole(seed, "seed", 0, 2**32 - 1),
    }
    return Plan(_native.design(hexapod._made, fspath(space), wanted))


class SensorChoice:
    """Sensors chosen from candidates."""

    def __init__(self, native: _native.SensorChoice) -> None:
        """Wrap the result of :func:`choose_sensors`."""
        self._made = native

    @property
    def names(self) -> list[str]:
        """Names of the chosen sensors."""
        return [sensor["name"] for sensor in self.to_dict()["sensors"]]

    @property
    def hexapod(self) -> Hexapod:
        """The machine with its own and the chosen sensors."""
        return Hexapod._of(self._made.hexapod())

    def to_dict(self) -> dict[str, Any]:
        """Return what ``hexbench design --sensors --json`` writes, format ``sensor-choice/1``."""
        return self._made.to_dict()

    def __str__(self) -> str:
        """Return the page of ``hexbench design --sensors``."""
        return self._made.text

    def __repr__(self) -> str:
        """Return the names."""
        return f"SensorChoice({', '.join(self.names)})"

    def _repr_html_(self) -> str:
        return pre(str(self))

    def __reduce__(self) -> tuple[Any, ...]:
        """Pickle the sensors, the machine and the report."""
        return (_kept_choice, (self.to_dict(), self.hexapod, str(self)))


def choose_sensors(
    hexapod: Hexapod,
    plan: str | PathLike[str],
    candidates: str | PathLike[str],
    *,
    choose: int | None = None,
    budget: float | None = None,
    see: str | None = None,
    criterion: str | None = None,
    add: Sequence[str] = (),
    starts: int | None = None,
    seed: int = 1,
) -> SensorChoice:
    """Choose the sensors that read the rows of a plan best: ``hexbench design --sensors``.

    Parameters
    ----------
    hexapod : Hexapod
        The machine; its own sensors remain.
    plan : path
        Poses and loads: plan.csv or measurements.csv.
    candidates : path
        Candidate sensors: ``sensor-candidates/1``.
    choose : int, optional
        Number of sensors (1 to 500); with a budget, the largest number.
    budget : float, optional
        Highest total cost, in the unit of ``cost`` of the candidates.
    see : str, optional
        Choose the sensors that best separate this effect from the springs, instead of using a criterion.
    criterion : str, optional
        o1 ... o5, d, a, e or i; default d.
    add : sequence of str
        Terms that the sensors must also determine.
    starts : int, optional
        Number of searches from different starts, if there are too many sets to try all; default 32.
    seed : int
        Seed of the starts.

    Raises
    ------
    BadInput, UsageError, NotDetermined
        With the text of the command.
    """
    if see is not None and (criterion is not None or add):
        raise UsageError("see cannot be combined with criterion or add", "Use one of them.")
    wanted = {
        "choose": whole(choose, "choose", 1, 500),
        "budget": None if budget is None else float(budget),
        "see": see,
        "criterion": criterion,
        "terms": [add] if isinstance(add, str) else list(add),
        "starts": whole(starts, "starts", 1, 4096),
        "seed": whole(seed, "seed", 0, 2**32 - 1),
    }
    return SensorChoice(_native.choose_sensors(hexapod._made, fspath(plan), fspath(candidates), wanted))


def _kept_plan(columns: dict[str, Floats], said: dict[str, Any]) -> Plan:
    made: Any = SimpleNamespace(columns=lambda: [(name, values.copy()) for name, values in columns.items()], **said)
    return Plan(made)


def _kept_choice(said: dict[str, Any], hexapod: Hexapod, text: str) -> SensorChoice:
    made: Any = SimpleNamespace(to_dict=lambda: deepcopy(said), hexapod=lambda: hexapod._made, text=text)
    return SensorChoice(made)
