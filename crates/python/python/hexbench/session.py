"""Sessions saved by the workbench: models, readings left out, notes."""

from __future__ import annotations

from os import PathLike, fspath
from typing import NamedTuple

from hexbench import _native
from hexbench.campaign import Campaign, Data, held_out
from hexbench.model import Model


class SessionStep(NamedTuple):
    """A model of a session, and its error."""

    terms: list[str]
    """Terms in addition to the leg springs, as :func:`hexbench.fit` takes them, and formulas by their id."""
    own: list[str]
    """Your term files (term/1), as text."""
    exclude: list[int]
    """Lines of the measurements left out of the fit."""
    times_noise: float
    """Held-out error, or else the error on fitted readings, as a multiple of the noise."""


class Session:
    """The contents of ``session.json``; :func:`load_session` reads it."""

    _made: _native.Session

    def __init__(self, native: _native.Session, path: str) -> None:
        """Wrap the contents of a file; use :func:`load_session`."""
        self._made = native
        self._path = path

    @property
    def program(self) -> str:
        """Program that wrote the session."""
        return self._made.program

    @property
    def inputs(self) -> dict[str, str]:
        """SHA-256 of every file of the session: machine, measurements and, if there are any, held-out measurements."""
        return dict(self._made.inputs)

    @property
    def read_as(self) -> list[str]:
        """How the session reads the files differently from what they say, in the words of :func:`hexbench.diagnose`."""
        return self._made.read_as

    @property
    def steps(self) -> list[SessionStep]:
        """Every model that was tried, the springs alone first."""
        return [SessionStep(*step) for step in self._made.steps]

    @property
    def shown(self) -> SessionStep:
        """The model that was shown when the session was saved."""
        return self.steps[self._made.at]

    @property
    def notes(self) -> str:
        """Notes of the user."""
        return self._made.notes

    def fit(self, campaign: Campaign, *, holdout: Data | None = None) -> Model:
        """Fit the current model of the session: the numbers are those of the workbench and of ``hexbench fit --session``.

        Parameters
        ----------
        campaign : Campaign
            The measurements, from the files of the session.
        holdout : path or Campaign, optional
            The held-out readings, if the session has any.

        Raises
        ------
        BadInput
            Machine, measurements or held-out measurements differ from those of the session.
        NotDetermined
            The parameters that the data do not determine, in words.
        """
        return Model(self._made.fit(campaign._made, held_out(campaign, holdout)))

    def __repr__(self) -> str:
        """Return the model shown and its error."""
        shown = self.shown
        without = f", {len(shown.exclude)} left out" if shown.exclude else ""
        return f"Session({' + '.join(['springs', *shown.terms])}{without}, {shown.times_noise:.3g} times the noise)"

    def __reduce__(self) -> tuple[object, ...]:
        """Pickle the path of the file."""
        return (load_session, (self._path,))


def load_session(path: str | PathLike[str]) -> Session:
    """Read ``session.json`` saved by the workbench.

    Raises
    ------
    BadInput
        The file is not a session.
    InputOutput
        The file cannot be read.
    """
    return Session(_native.Session.read(fspath(path)), fspath(path))
