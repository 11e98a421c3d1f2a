"""An algorithm written as a Python function, for the cases of a challenge or the trials of a study, in this process."""

from __future__ import annotations

import csv
import json
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from functools import cached_property
from itertools import islice
from os import PathLike, fspath
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import ArrayLike

from hexbench import _native
from hexbench._entrants_on_cluster import OnCluster
from hexbench._source import bound_to, called
from hexbench._tables import DEFLECTION, POSE, REFERENCE, WRENCH, Floats, rows
from hexbench.campaign import Campaign, load
from hexbench.diagnosing import Diagnosis
from hexbench.errors import UsageError
from hexbench.machine import Hexapod

if TYPE_CHECKING:
    import pandas as pd
    from distributed import Client

#: Columns of conditions in addition to poses and wrenches, under the names of :meth:`Model.predict`.
_SINGLE = ("approach", "delta_T_K", "elapsed_s", "ref_age_s")
_ROTATION_VECTOR = ("drx_urad", "dry_urad", "drz_urad")


@dataclass(frozen=True)
class Case:
    """One case of a challenge, as an entrant gets it."""

    #: With hexapod.toml, measurements.csv, predict.csv.
    folder: Path

    def __post_init__(self) -> None:
        """Take a path of any kind."""
        object.__setattr__(self, "folder", Path(self.folder))

    @cached_property
    def campaign(self) -> Campaign:
        """The readings to fit; ``campaign.hexapod`` is the machine."""
        return load(self.folder / "hexapod.toml", self.folder / "measurements.csv")

    @cached_property
    def conditions(self) -> dict[str, Floats]:
        """The conditions to predict, as :meth:`Model.predict` takes them: ``poses`` (n, 6), ``wrenches`` (n, 6), and more."""
        with (self.folder / "predict.csv").open(encoding="utf-8", newline="") as file:
            table = list(csv.DictReader(file))
        named = {name: np.array([float(row[name]) for row in table]) for name in (table[0] if table else {})}
        six = {"poses": POSE, "wrenches": WRENCH, "reference": REFERENCE}
        found = {key: np.column_stack([named[n] for n in names]) for key, names in six.items() if names[0] in named}
        return found | {key: named[key] for key in _SINGLE if key in named}

    def _header(self) -> tuple[list[str], list[str]]:
        """Return the names of the columns of predictions, and of their uncertainties."""
        measured = set(self.campaign.to_columns())
        if "measured_a_mm" in measured:
            values = [f"predicted_{name}" for name in POSE]
            return values, [f"sigma_{name.rsplit('_', 1)[0]}_{'um' if k < 3 else 'urad'}" for k, name in enumerate(POSE)]
        values = [*DEFLECTION[:3], *_ROTATION_VECTOR] if _ROTATION_VECTOR[0] in measured else list(DEFLECTION)
        return values, [f"sigma_{name}" for name in values]


@dataclass(frozen=True)
class Answer:
    """The answer of an entrant to a case."""

    #: (n, 6), for each row of ``case.conditions``: um and urad; mm and deg for absolute poses.
    predictions: ArrayLike
    #: Their standard uncertainties (n, 6), um and urad, without the noise of a future reading.
    std: ArrayLike | None = None
    #: Numbers with names, ``leg-1.stiffness`` (N/um) and those of effects: value, or value and standard uncertainty.
    parameters: Mapping[str, float | tuple[float, float]] = field(default_factory=dict)
    #: Units of parameters, if they are not N/um.
    units: Mapping[str, str] = field(default_factory=dict)
    #: ``verdict``, ``added``, ``credible_set``, ``candidates``, as in diagnosis.json; or a whole diagnosis.
    diagnosis: Mapping[str, Any] | Diagnosis | None = None

    def write(self, case: Case, folder: str | PathLike[str]) -> None:
        """Write the files of the answer into a folder: the files that a program called with ``CASE OUT`` must write to ``OUT``.

        Raises
        ------
        BadInput
            Predictions that are not (n, 6) for the n conditions of the case.
        """
        place, count = Path(folder), len(case.conditions["poses"])
        names, sigmas = case._header()
        table = [rows(self.predictions, 6, "predictions", count)]
        if self.std is not None:
            table.append(rows(self.std, 6, "std", count))
            names += sigmas
        with (place / "predictions.csv").open("w", encoding="utf-8", newline="") as file:
            writer = csv.writer(file, lineterminator="\n")
            writer.writerow(["row", *names])
            writer.writerows([n, *map(repr, row)] for n, row in enumerate(np.hstack(table).tolist(), start=1))
        if self.parameters:
            stated = [_parameter(n, v, self.units) for n, v in self.parameters.items()]
            _write_json(place / "parameters.json", {"format": "parameters/1", "parameters": stated})
        if self.diagnosis is not None:
            said = self.diagnosis.to_dict() if isinstance(self.diagnosis, Diagnosis) else self.diagnosis
            _write_json(place / "diagnosis.json", {"format": "diagnosis/1", **said})


#: An algorithm: from a case to its answer.
Algorithm = Callable[[Case], Answer]


@dataclass(frozen=True)
class ChallengeRun:
    """The result of a run over the cases of a challenge."""

    #: Name in the tables.
    name: str
    #: Cases answered by this run.
    answered: int
    #: Cases without an answer, and why; those of a run before among them, which are not run again.
    failures: dict[str, str]
    #: Cases answered before, with or without success.
    known: int

    def __str__(self) -> str:
        """Return what the command reports."""
        lines = [f"  {case}: {why}\n" for case, why in self.failures.items()]
        head = f"{self.name}: {self.answered} cases answered, {len(self.failures)} failed, {self.known} answered before.\n"
        return head + "".join(lines)


#: Limits of a program: wall time of a case (s), memory and output (MB), as ``hexbench challenge run`` has them.
LIMITS = (60.0, 4096, 64)


def answer_challenge(
    challenge: str | PathLike[str],
    out: str | PathLike[str],
    name: str,
    algorithm: Algorithm | Sequence[str],
    *,
    depends: Sequence[str | PathLike[str]] = (),
    again: bool = False,
    client: Client | None = None,
    limits: tuple[float, int, int] = LIMITS,
    retries: int = 3,
    patience: float = 600.0,
) -> ChallengeRun:
    """Answer a challenge with a function in this process, or with a function or program on a Dask cluster.

    Parameters
    ----------
    challenge : path
        The challenge.
    out : path
        Folder for the answers, which :func:`hexbench.commands.challenge_score` scores together with those of programs.
    name : str
        Name in the tables.
    algorithm : function, or sequence of str
        Function from a :class:`Case` to an :class:`Answer`. An exception fails one case. With ``client`` also a program and its
        arguments, at the same path on every worker; without ``client``, use :func:`hexbench.commands.challenge_run` for
        programs.
    depends : sequence of paths
        Files and folders to which the answers are bound, in addition to the file that defines the function.
    again : bool
        Answer again even if answers exist.
    client : distributed.Client, optional
        A cluster whose workers have this version of hexbench. The cases and the function are sent to them; a worker refuses a
        program whose files differ there.
    limits : (float, int, int)
        For a program: wall time of a case, s; memory and output, MB. A function has no limits.
    retries, patience : int, float
        How often a failed task is retried; seconds without any worker after which the run stops.

    Notes
    -----
    In this process, cases run one after the other, without limits of time and memory, and the function can access everything
    that this process can: if the truth is on the same disk, the challenge relies on good faith. Times are comparable with those
    of programs except for their start. On a cluster, a worker sees only the public files of its cases, and times are those of
    the worker.

    Answers are bound to the SHA-256 of the file that defines the function; for a function in a notebook or at a prompt, to that
    of its source, or of its code if Python does not keep the source. Mixing answers of an edited function is then refused.
    Nothing else is checked: imported modules (name them in ``depends``), captured values, arguments of a ``functools.partial``,
    other versions of packages. Use ``again=True`` after such a change.

    Raises
    ------
    UsageError, BadInput, InputOutput
        With the text of the command: a folder of other answers, an edited function.
    """
    own = _own(algorithm, depends, client, (limits, retries, patience))
    answered, failures, known = _native.challenge_run_inside(fspath(challenge), fspath(out), name, again, own)
    return ChallengeRun(name, answered, dict(failures), known)


def _own(
    algorithm: Algorithm | Sequence[str],
    depends: Sequence[str | PathLike[str]],
    client: Client | None,
    how: tuple[tuple[float, int, int], int, float] = (LIMITS, 3, 600.0),
) -> dict[str, Any]:
    """Return an algorithm as the native half takes it: called with two folders, with what its answers are bound to."""
    limits, retries, patience = how
    named = [fspath(path) for path in depends]
    own: dict[str, Any]
    if callable(algorithm):
        files, sources = bound_to(algorithm)
        own = {"called": f"Python function {called(algorithm)}", "line": None, "files": [*files, *named], "sources": sources}
    elif client is None:
        next_step = "Use hexbench.commands.challenge_run, gate_record or gate_check, which start it here."
        raise UsageError("a program runs on the workers of a cluster, but there is no client", next_step)
    else:
        own = {"called": "", "line": list(map(str, algorithm)), "files": named, "sources": []}
    own |= {"limits": limits, "begin": None, "function": None}
    if client is not None:
        there = OnCluster(client, algorithm if callable(algorithm) else None, retries, patience)
        return own | {"begin": there.begin, "function": there.answer}

    def asked(case: Path, answer: Path) -> None:
        seen = Case(case)
        said: Answer = algorithm(seen)  # type: ignore[operator]
        said.write(seen, answer)

    return own | {"function": asked}


@dataclass(frozen=True)
class StudyTrial:
    """One trial of a study: the data a laboratory would provide, and the hidden truth."""

    #: Value on each axis that the study gives.
    cell: dict[str, Any]
    #: Number of the trial in its cell, from 0.
    number: int
    #: Readings to fit; ``campaign.hexapod`` is the machine as stated.
    campaign: Campaign
    #: Readings to judge by.
    holdout: Campaign
    #: The same as an ideal instrument reads them.
    ideal: Campaign
    #: The truth, which an algorithm must not see: ``leg_stiffness_N_per_um`` (6,), ``effect`` (ids joined by ``+``; None for
    #: nothing), ``effects`` (their ids), ``size`` (of one alone, in the unit of its kind).
    truth: dict[str, Any] = field(repr=False)


def study_columns(
    study: str | PathLike[str],
    algorithm: Callable[[StudyTrial], Mapping[str, Any]],
    *,
    trials: int | None = None,
) -> pd.DataFrame:
    """Return the results of your own algorithm over the trials of a study: a DataFrame with one row per trial.

    Parameters
    ----------
    study : path
        The study file; with ``task = "diagnose"`` the readings are those that the study diagnoses itself.
    algorithm : function
        Function from a :class:`StudyTrial` to a mapping: one value for each of your columns.
    trials : int, optional
        Number of trials per cell, the first ones; default all.

    Returns
    -------
    DataFrame
        Axes of the study, ``trial``, ``status`` (``done``, or why there are no readings and no columns), and your columns.
    """
    import pandas as pd

    return pd.DataFrame(list(_rows(_native.StudyTrials(fspath(study)), algorithm, trials)))


def _rows(
    all_: _native.StudyTrials, algorithm: Callable[[StudyTrial], Mapping[str, Any]], trials: int | None
) -> Iterator[dict[str, Any]]:
    for index, cell in enumerate(all_.cells()):
        for number in islice(range(all_.trials), trials):
            status, opened = all_.trial(index, number)
            row = {**cell, "trial": number, "status": status}
            yield row if opened is None else row | dict(algorithm(_trial(cell, number, opened)))


def _trial(cell: dict[str, Any], number: int, opened: tuple[Any, ...]) -> StudyTrial:
    machine = Hexapod._of(opened[0])
    measured, held, ideal = (Campaign(native, machine) for native in opened[1:4])
    stiffness, effects, size = opened[4:]
    effect = "+".join(effects) or None
    truth = {"leg_stiffness_N_per_um": np.array(stiffness), "effect": effect, "effects": effects, "size": size}
    return StudyTrial(dict(cell), number, measured, held, ideal, truth)


def _write_json(path: Path, keys: dict[str, Any]) -> None:
    path.write_text(json.dumps(keys), encoding="utf-8")


def _parameter(name: str, stated: float | tuple[float, float], units: Mapping[str, str]) -> dict[str, Any]:
    value, std = stated if isinstance(stated, tuple) else (stated, None)
    spread = {} if std is None else {"std": float(std)}
    return {"name": name, "value": float(value), **spread, "unit": units.get(name, "N/um")}
