"""The machine as its drawings describe it."""

from __future__ import annotations

import json
from collections.abc import Callable, Sequence
from os import PathLike, fspath
from typing import Any

from numpy.typing import ArrayLike

from hexbench import _native
from hexbench._tables import Floats, rows
from hexbench.errors import UsageError


class Hexapod:
    """A hexapod: six base joints, six platform joints, and further properties.

    Names and units are those of ``hexapod.toml``. The fixed (base) frame and the mobile (platform) frame coincide at the zero
    pose.

    Parameters
    ----------
    base_joints_mm : array (6, 3)
        Base joints A_i in the fixed frame, mm.
    platform_joints_mm : array (6, 3)
        Platform joints B_i in the mobile frame, mm.
    name : str
        Name of the machine in reports.
    sigma_translation_um, sigma_rotation_urad : float, optional
        Standard deviation of ONE reading of a deflection (or of an absolute pose); both or neither.
    nominal_stiffness_N_per_um : float or six floats, optional
        Nominal stiffness of the legs.
    min_length_mm, max_length_mm : float, optional
        Shortest and longest leg length; both or neither.
    brackets : pairs of leg numbers, optional
        Legs, from 1, that share a bracket.
    mounting_plane_z_mm : float, optional
        Height of the mounting plane in the fixed frame; default: the mean z of the base joints.
    center_of_gravity_mm : three floats, optional
        Center of gravity of the payload, mobile frame.

    Raises
    ------
    BadInput
        The broken rule, with the text that the command prints for a hexapod file.
    """

    _made: _native.Hexapod

    def __init__(
        self,
        base_joints_mm: ArrayLike,
        platform_joints_mm: ArrayLike,
        *,
        name: str = "hexapod",
        sigma_translation_um: float | None = None,
        sigma_rotation_urad: float | None = None,
        nominal_stiffness_N_per_um: float | Sequence[float] | None = None,
        min_length_mm: float | None = None,
        max_length_mm: float | None = None,
        brackets: Sequence[Sequence[int]] | None = None,
        mounting_plane_z_mm: float | None = None,
        center_of_gravity_mm: Sequence[float] | None = None,
    ) -> None:
        sections: dict[str, dict[str, Any]] = {
            "geometry": {
                "base_joints_mm": rows(base_joints_mm, 3, "base_joints_mm").tolist(),
                "platform_joints_mm": rows(platform_joints_mm, 3, "platform_joints_mm").tolist(),
            },
            "metrology": {"sigma_translation_um": sigma_translation_um, "sigma_rotation_urad": sigma_rotation_urad},
            "legs": {
                "nominal_stiffness_N_per_um": nominal_stiffness_N_per_um,
                "min_length_mm": min_length_mm,
                "max_length_mm": max_length_mm,
                "brackets": brackets,
            },
            "base": {"mounting_plane_z_mm": mounting_plane_z_mm},
            "payload": {"center_of_gravity_mm": center_of_gravity_mm},
        }
        self._made = _native.Hexapod.of_text(_toml(name, sections), "hexapod")

    @classmethod
    def read(cls, path: str | PathLike[str]) -> Hexapod:
        """Read ``hexapod.toml``.

        Raises
        ------
        BadInput
            What is wrong with the file: line, column, value, rule, next step.
        InputOutput
            The file cannot be read.
        """
        return cls._of(_native.Hexapod.read(fspath(path)))

    @classmethod
    def _of(cls, native: _native.Hexapod) -> Hexapod:
        hexapod = cls.__new__(cls)
        hexapod._made = native
        return hexapod

    @property
    def name(self) -> str:
        """Name of the machine in reports."""
        return self._made.name

    @property
    def base_joints_mm(self) -> Floats:
        """Base joints A_i in the fixed frame, mm, shape (6, 3)."""
        return self._made.base_joints_mm

    @property
    def platform_joints_mm(self) -> Floats:
        """Platform joints B_i in the mobile frame, mm, shape (6, 3)."""
        return self._made.platform_joints_mm

    @property
    def sigma_translation_um(self) -> float | None:
        """Standard deviation of one reading of a translation, um; None if it is not stated."""
        return self._made.sigma_translation_um

    @property
    def sigma_rotation_urad(self) -> float | None:
        """Standard deviation of one reading of a rotation, urad; None if it is not stated."""
        return self._made.sigma_rotation_urad

    def with_sensor(
        self,
        name: str,
        function: Callable[[Floats], float],
        *,
        sigma_um: float | None = None,
        sigma_urad: float | None = None,
    ) -> Hexapod:
        """Return the machine with a sensor of your own: it reads the change of a function between the reference and the loaded
        state.

        Its column is ``NAME_um`` or ``NAME_urad``. A campaign loaded with the returned machine is compared, diagnosed, fitted
        and predicted as one with the sensors of ``hexapod.toml``; derivatives are difference quotients halfway between the two
        states, so the error is of third order in the deflection, as for every other kind. The position of such a sensor is
        taken as exact. A diagnosis of a few hundred conditions calls the function some hundred thousand times, once for each
        pose. Files cannot contain it: the machine and models fitted with it can be neither saved nor pickled.

        Parameters
        ----------
        name : str
            Lowercase letters, digits and ``_``.
        function : callable
            Takes the transform of the platform, an array (4, 4) that maps a point of the mobile frame, mm, to the fixed frame,
            and returns a number that depends smoothly on it, um or urad, and on nothing else. It is called from other threads.
            Its exceptions reach the caller.
        sigma_um, sigma_urad : float
            Standard deviation of one reading; one of the two states the unit that the function returns.

        Raises
        ------
        BadInput
            A missing or duplicate name, or a standard deviation that is not positive.
        UsageError
            Both standard deviations or neither; a function that does not return a finite number.

        Examples
        --------
        A dial gauge along z at a point of the platform::

            point = np.array([120.0, 0.0, 25.0, 1.0])
            bench = hexapod.with_sensor("z1", lambda transform: 1e3 * (transform @ point)[2], sigma_um=0.3)
        """
        if sigma_um is not None and sigma_urad is None:
            return Hexapod._of(self._made.with_sensor(name, function, float(sigma_um), False))
        if sigma_urad is not None and sigma_um is None:
            return Hexapod._of(self._made.with_sensor(name, function, float(sigma_urad), True))
        raise UsageError(
            "a sensor states one standard deviation, of a length or of an angle", "Give sigma_um or sigma_urad."
        )

    def to_toml(self) -> str:
        """Return the text of ``hexapod.toml``; reading it gives the same machine.

        Raises
        ------
        UsageError
            A sensor is a Python function.
        """
        return self._made.to_toml()

    def save(self, path: str | PathLike[str]) -> None:
        """Write ``hexapod.toml``, completely or not at all."""
        _native.write_text(fspath(path), self.to_toml())

    def __repr__(self) -> str:
        """Return the name of the machine."""
        return f"Hexapod({self.name!r})"

    def __reduce__(self) -> tuple[Any, ...]:
        """Pickle as the text of the file."""
        return (_restored, (self.to_toml(), self._made.origin))

    def __eq__(self, other: object) -> bool:
        """Compare all that is stated."""
        return isinstance(other, Hexapod) and self._made.is_like(other._made)

    def __hash__(self) -> int:
        """Hash what is compared."""
        return hash(self._made.described())


def _restored(text: str, origin: tuple[str, str]) -> Hexapod:
    return Hexapod._of(_native.Hexapod.of_text(text, "hexapod", origin))


def _toml(name: str, sections: dict[str, dict[str, Any]]) -> str:
    text = f'format = "hexapod/1"\nname = {json.dumps(str(name), ensure_ascii=False)}\n'
    for title, keys in sections.items():
        given = {key: value for key, value in keys.items() if value is not None}
        if given:
            text += f"\n[{title}]\n" + "".join(f"{key} = {_value(value)}\n" for key, value in given.items())
    return text


def _value(value: Any) -> str:
    if hasattr(value, "tolist"):
        value = value.tolist()
    if isinstance(value, (list, tuple)):
        return "[" + ", ".join(_value(item) for item in value) + "]"
    return repr(value) if isinstance(value, (int, float)) and not isinstance(value, bool) else json.dumps(str(value))
