"""The virtual bench: it measures a machine with hidden imperfections."""

from __future__ import annotations

import json
from dataclasses import dataclass, field
from os import PathLike, fspath
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Any

from hexbench import _native
from hexbench._bounds import whole
from hexbench.campaign import Campaign, load
from hexbench.machine import Hexapod

_LARGEST_SEED = 2**64 - 1
_LARGEST_COUNT = 2**32


@dataclass(frozen=True)
class Simulation:
    """Measurements of the virtual bench, and the hidden truth of the machine."""

    #: The readings to fit.
    campaign: Campaign
    #: Held-out readings; None if the scene has none.
    holdout: Campaign | None
    #: The truth, which an algorithm must not see: leg stiffnesses, hidden effects, seed; the contents of ``sealed/truth.json``.
    truth: dict[str, Any] = field(repr=False)

    @property
    def hexapod(self) -> Hexapod:
        """The machine as its drawings describe it."""
        return self.campaign.hexapod


@dataclass(frozen=True)
class Scene:
    """A folder with ``scene.toml``, ``hexapod.toml`` and ``sealed/truth.toml``."""

    folder: str | PathLike[str]

    def simulate(
        self,
        *,
        seed: int | None = None,
        poses: int | None = None,
        repeats: int | None = None,
        noise_free: bool = False,
        folder: str | PathLike[str] | None = None,
        force: bool = False,
    ) -> Simulation:
        """Measure the machine of the scene; see :func:`simulate`."""
        return simulate(self.folder, seed=seed, poses=poses, repeats=repeats, noise_free=noise_free, folder=folder, force=force)


def simulate(
    scene: str | PathLike[str] | Scene,
    *,
    seed: int | None = None,
    poses: int | None = None,
    repeats: int | None = None,
    noise_free: bool = False,
    folder: str | PathLike[str] | None = None,
    force: bool = False,
) -> Simulation:
    """Measure a machine with hidden imperfections on the virtual bench: ``hexbench simulate``, with the same bytes.

    Parameters
    ----------
    scene : path or Scene
        Folder of the scene, which contains scene.toml.
    seed : int, optional
        Seed of plan and noise; default: that of the scene. The same seed gives the same numbers.
    poses : int, optional
        Number of training poses, for a scene whose poses are sampled.
    repeats : int, optional
        Readings of each training condition.
    noise_free : bool
        Use an instrument without errors.
    folder : path, optional
        Save the files here: hexapod.toml, measurements.csv, holdout.csv, balls.csv, loads.csv, sealed/truth.json.
    force : bool
        Replace files in a folder that is not empty.

    Raises
    ------
    BadInput
        An error in the scene.
    UsageError
        An option that the scene does not allow, or a folder that is not empty.
    """
    wanted = {
        "seed": whole(seed, "seed", 0, _LARGEST_SEED),
        "poses": whole(poses, "poses", 0, _LARGEST_COUNT),
        "repeats": whole(repeats, "repeats", 0, _LARGEST_COUNT),
        "noise_free": bool(noise_free),
        "force": bool(force),
    }
    source = scene.folder if isinstance(scene, Scene) else scene
    if folder is not None:
        _native.simulate(fspath(source), fspath(folder), wanted)
        return _read(Path(folder))
    with TemporaryDirectory(prefix="hexbench-") as temporary:
        inside = Path(temporary, Path(source).resolve().name)
        _native.simulate(fspath(source), fspath(inside), wanted)
        return _read(inside)


def _read(folder: Path) -> Simulation:
    campaign = load(folder / "hexapod.toml", folder / "measurements.csv")
    held = folder / "holdout.csv"
    truth = json.loads((folder / "sealed" / "truth.json").read_text(encoding="utf-8"))
    return Simulation(campaign, load(campaign.hexapod, held) if held.exists() else None, truth)
