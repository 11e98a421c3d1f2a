"""Native half of hexbench: plain numbers, arrays and texts in the units of the files. Use the classes of ``hexbench``."""

from collections.abc import Callable, Mapping, Sequence
from os import PathLike
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

__version__: str

class Hexapod:
    """A machine."""

    @staticmethod
    def read(path: str) -> Hexapod: ...
    @staticmethod
    def of_text(text: str, name: str, origin: tuple[str, str] | None = None) -> Hexapod: ...
    @property
    def origin(self) -> tuple[str, str]: ...
    @property
    def name(self) -> str: ...
    @property
    def base_joints_mm(self) -> NDArray[np.float64]: ...
    @property
    def platform_joints_mm(self) -> NDArray[np.float64]: ...
    @property
    def sigma_translation_um(self) -> float | None: ...
    @property
    def sigma_rotation_urad(self) -> float | None: ...
    def to_toml(self) -> str: ...
    def described(self) -> str: ...
    def is_like(self, other: Hexapod) -> bool: ...
    def with_sensor(
        self, name: str, function: Callable[[NDArray[np.float64]], float], sigma: float, is_angle: bool
    ) -> Hexapod: ...

class Campaign:
    """A machine with its measurements."""

    @staticmethod
    def read(hexapod: Hexapod, path: str) -> tuple[Campaign, list[tuple[str, str]]]: ...
    @staticmethod
    def of_text(hexapod: Hexapod, text: str, name: str, origin: tuple[str, str]) -> Campaign: ...
    @property
    def origin(self) -> tuple[str, str]: ...
    @staticmethod
    def of_columns(
        hexapod: Hexapod, names: Sequence[str], columns: Sequence[NDArray[np.float64] | list[str]], name: str
    ) -> tuple[Campaign, list[tuple[str, str]]]: ...
    def columns(self) -> list[tuple[str, NDArray[np.float64]]]: ...
    def to_csv(self) -> str: ...
    @property
    def readings(self) -> int: ...
    @property
    def absolute(self) -> bool: ...
    @property
    def name(self) -> str: ...

class Model:
    """A fitted model."""

    @staticmethod
    def read(path: str, trust: bool) -> Model: ...
    @staticmethod
    def of_text(text: str, summary: str) -> Model: ...
    def to_toml(self) -> str: ...
    def estimates(self) -> list[tuple[str, float, float, str]]: ...
    def predict(
        self, names: Sequence[str], columns: Sequence[NDArray[np.float64]]
    ) -> tuple[NDArray[np.float64], NDArray[np.float64]]: ...
    def predict_sensors(
        self, names: Sequence[str], columns: Sequence[NDArray[np.float64]]
    ) -> tuple[NDArray[np.float64], NDArray[np.float64]]: ...
    def compensate(self, names: Sequence[str], columns: Sequence[NDArray[np.float64]]) -> list[NDArray[np.float64]]: ...
    def stiffness(
        self,
        names: Sequence[str],
        columns: Sequence[NDArray[np.float64]],
        point: Sequence[float],
        axes: str,
        amplitude: float,
    ) -> list[NDArray[np.float64]]: ...
    @property
    def sensor_columns(self) -> list[str]: ...
    @property
    def not_determined(self) -> list[str]: ...
    @property
    def covariance(self) -> NDArray[np.float64]: ...
    @property
    def covariance_names(self) -> list[str]: ...
    @property
    def hexapod(self) -> Hexapod: ...
    @property
    def terms(self) -> list[str]: ...
    @property
    def absolute(self) -> bool: ...
    @property
    def chi2(self) -> float: ...
    @property
    def degrees_of_freedom(self) -> float: ...
    @property
    def noise(self) -> tuple[float, float]: ...
    @property
    def noise_source(self) -> str: ...
    @property
    def summary(self) -> str: ...

class Term:
    """A term with a function for its law."""

    def __init__(
        self,
        header: str,
        acts: str,
        variables: Sequence[str],
        name: str,
        function: Callable[[int, list[NDArray[np.float64]], list[float]], NDArray[np.float64]],
    ) -> None: ...

class Diagnosis:
    """A diagnosis."""

    def json(self) -> str: ...
    def text(self, verbose: bool) -> str: ...
    def html(self) -> str: ...

class Discovery:
    """A search for laws, by the native half."""

    def json(self) -> str: ...
    def text(self, verbose: bool) -> str: ...
    def html(self) -> str: ...
    def term(self) -> str | None: ...

class Comparison:
    """A comparison."""

    def json(self) -> str: ...
    def text(self) -> str: ...
    def html(self) -> str: ...

class Plan:
    """A plan."""

    @property
    def criterion(self) -> str: ...
    @property
    def value(self) -> float: ...
    @property
    def efficiency(self) -> float | None: ...
    @property
    def text(self) -> str: ...
    def columns(self) -> list[tuple[str, NDArray[np.float64]]]: ...

class SensorChoice:
    """Sensors out of candidates."""

    @property
    def text(self) -> str: ...
    def to_dict(self) -> dict[str, Any]: ...
    def hexapod(self) -> Hexapod: ...

class StudyTrials:
    """The trials of a study, for an algorithm of Python."""

    def __init__(self, study: str) -> None: ...
    @property
    def trials(self) -> int: ...
    def cells(self) -> list[dict[str, Any]]: ...
    def trial(self, cell: int, trial: int) -> tuple[str, tuple[Any, ...] | None]: ...

class ShardRunner:
    """An experiment that computes records of its shards, for a folder elsewhere."""

    @staticmethod
    def of_study(study: str | PathLike[str], threads: int) -> ShardRunner: ...
    @staticmethod
    def of_command(words: Sequence[str], files: Sequence[str], which: int, threads: int) -> ShardRunner: ...
    def run(self, shards: Sequence[int]) -> list[bytes]: ...

class ExperimentWork:
    """The experiments of a command with their journals, in use by this object alone until it is closed."""

    def __init__(self, words: Sequence[str]) -> None: ...
    def close(self) -> None: ...
    @property
    def files(self) -> list[Path]: ...
    def todo(self) -> list[dict[str, Any]]: ...
    def keep(self, which: int, shard: int, record: bytes) -> None: ...

class StudyWork:
    """The folder of a study that takes records from elsewhere, in use by this object alone until it is closed."""

    def __init__(self, study: str | PathLike[str], folder: str | PathLike[str]) -> None: ...
    def close(self) -> None: ...
    def todo(self) -> dict[str, Any]: ...
    def keep(self, shard: int, record: bytes) -> None: ...
    def write(self, markdown: str | PathLike[str] | None) -> dict[str, Any]: ...

class Session:
    """A session of the workbench."""

    @staticmethod
    def read(path: str) -> Session: ...
    @property
    def program(self) -> str: ...
    @property
    def inputs(self) -> list[tuple[str, str]]: ...
    @property
    def read_as(self) -> list[str]: ...
    @property
    def steps(self) -> list[tuple[list[str], list[str], list[int], float]]: ...
    @property
    def at(self) -> int: ...
    @property
    def notes(self) -> str: ...
    def fit(self, campaign: Campaign, holdout: Campaign | None) -> Model: ...

def fit(campaign: Campaign, add: Sequence[str], holdout: Campaign | None, terms: Sequence[str | Term], estimator: str) -> Model:
    """Fit springs and the terms that are named."""

def compare(campaign: Campaign, model: Model | None, holdout: Campaign | None) -> Comparison:
    """Compare a model, or springs fitted to the data, with measurements."""

def diagnose(
    campaign: Campaign,
    holdout: Campaign | None,
    terms: Sequence[str | Term],
    exclude: Sequence[str],
    keep_all: bool,
    read_as: Sequence[str],
) -> Diagnosis:
    """Name the physical effect the model lacks."""

def discover(
    campaign: Campaign,
    holdout: Campaign | None,
    terms: Sequence[str | Term],
    exclude: Sequence[str],
    read_as: Sequence[str],
) -> Discovery:
    """Search the law that no catalogue has."""

def design(hexapod: Hexapod, space: str, wanted: Mapping[str, Any]) -> Plan:
    """Search a plan."""

def choose_sensors(hexapod: Hexapod, plan: str, candidates: str, wanted: Mapping[str, Any]) -> SensorChoice:
    """Choose sensors for the rows of a plan."""

def simulate(folder: str | PathLike[str], output: str, wanted: Mapping[str, Any]) -> None:
    """Measure a scene and write the folder that the command writes."""

def terms() -> list[dict[str, Any]]:
    """Every term of the catalogue."""

def write_text(path: str, text: str) -> None:
    """Write a text whole or not at all."""

def study_plan(study: str | PathLike[str], parts: int) -> dict[str, Any]:
    """How a study divides into parts."""

def study_run_part(study: str | PathLike[str], part: str, folder: str | PathLike[str]) -> dict[str, Any]:
    """Compute what is missing of a part."""

def study_merge(
    study: str | PathLike[str],
    parts: Sequence[str | PathLike[str]],
    folder: str | PathLike[str],
    markdown: str | PathLike[str] | None = None,
) -> dict[str, Any]:
    """Put parts together and write the results."""

def command(words: Sequence[str]) -> tuple[str, bool]:
    """Run a command; what it wrote to standard output, and whether the check it made passed."""

def command_names() -> list[str]:
    """Names of all commands."""

def legs(
    hexapod: Hexapod, names: Sequence[str], columns: Sequence[NDArray[np.float64]]
) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """Leg lengths (n, 6), geometric leg Jacobians (n, 6, 6), SI."""

def regressor(hexapod: Hexapod, names: Sequence[str], columns: Sequence[NDArray[np.float64]]) -> NDArray[np.float64]:
    """Blocks (n, 6, 6) of the regressor of the paper, SI."""

def challenge_run_inside(
    challenge: str, out: str, name: str, again: bool, own: Mapping[str, Any]
) -> tuple[int, list[tuple[str, str]], int]:
    """Let a function answer the cases of a challenge that it has not answered."""

def answer_case(public: str, program: tuple[list[str], list[Path], tuple[float, int, int], str]) -> bytes:
    """Run a program over a case as a run elsewhere wants it; the answer as it travels."""

def answer_of_function(out: str, said: str | None, wall_s: float) -> bytes:
    """Return the answer that a function has written into a folder, as it travels."""

def gate(words: Sequence[str], own: Mapping[str, Any]) -> tuple[str, bool]:
    """Guard the scores of a function; what the command wrote to standard output, and whether it passed."""

def signatures(
    hexapod: Hexapod,
    names: Sequence[str],
    columns: Sequence[NDArray[np.float64]],
    term: str,
    own: Sequence[str | Term],
    shape: float | None,
    compliances: Sequence[float],
) -> tuple[NDArray[np.float64], list[tuple[str, str]], float | None]:
    """What a unit of every parameter adds to the readings, um and urad."""
