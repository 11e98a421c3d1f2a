"""What the tests share: the command, the cases that come with the repository, a cluster."""

from __future__ import annotations

import contextlib
import os
import subprocess
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import TYPE_CHECKING

import pytest

if TYPE_CHECKING:
    from cluster import Cluster

ROOT = Path(__file__).resolve().parents[3]
CASES = ROOT / "data" / "cases"
SCENES = ROOT / "scenes"

Command = Callable[..., "subprocess.CompletedProcess[str]"]


@pytest.fixture(scope="session")
def command() -> Command:
    """Run the command; HEXBENCH_BINARY names it."""
    binary = os.environ["HEXBENCH_BINARY"]

    def run(*words: object, code: int = 0) -> subprocess.CompletedProcess[str]:
        done = subprocess.run([binary, *map(str, words)], capture_output=True, text=True, check=False)
        assert done.returncode == code, done.stderr
        return done

    return run


def case(name: str) -> list[Path]:
    """Return hexapod, measurements and holdout of a case."""
    return [CASES / name / file for file in ("hexapod.toml", "measurements.csv", "holdout.csv")]


@pytest.fixture(scope="session")
def scenes() -> Path:
    """Return the folder of the scenes."""
    return SCENES


@pytest.fixture
def cluster(tmp_path: Path) -> Iterator[Cluster]:
    """Yield a scheduler and two workers of one thread."""
    pytest.importorskip("distributed")
    from cluster import Cluster

    with contextlib.closing(Cluster(tmp_path)) as made:
        made.add_worker()
        made.add_worker()
        yield made
