"""Searching for a law outside the catalogue."""

from __future__ import annotations

import json
from collections.abc import Sequence
from os import PathLike, fspath
from typing import Any

from hexbench import _native
from hexbench._html import pre
from hexbench._kept import Kept, Told
from hexbench.campaign import Campaign, Data, held_out
from hexbench.diagnosing import lines_named
from hexbench.own_term import OwnTerm, Term, native_terms, own_terms


class Discovery(Told):
    """The result of a search for laws. Attributes are the keys of ``discovery.json``, with its names and units."""

    #: ``discovery/1``.
    format: str
    #: Whether the first law is convincing.
    found: bool
    #: ``law``, ``nothing-missing``, ``catalogue``, ``readings`` or ``no-law-convinces``.
    reason: str
    #: The same in a sentence.
    text: str
    #: Verdict of the diagnosis with the catalogue alone.
    verdict: str
    #: Catalogue effects in addition to the law, or those that explain the readings without a law, as ``add`` of :func:`fit`
    #: takes them: with ``:richer`` where the readings need the richer form.
    beside: list[str]
    #: Laws, best first: ``id``, ``term``, ``formula``, ``kind``, ``legs``, ``probability``, ``complexity``, ``parameters``,
    #: ``held_out`` (``before`` and ``after``, times the noise), ``text``, ``look_at``, ``alike``.
    laws: list[dict[str, Any]]
    #: Errors, fitted and held out: springs alone, with the effects, with the law.
    steps: list[dict[str, Any]]
    #: Probability that one of the tested laws is present.
    probability: float
    #: Readings that separate the first law from its look-alikes, as in ``diagnosis.json``.
    next: list[dict[str, Any]]
    #: Expected odds from these readings for each pair.
    separation: list[dict[str, Any]]
    #: Number of laws tested.
    searched: int
    #: Warnings.
    warnings: list[str]
    #: Program, machine and digests of the files.
    run: dict[str, Any]

    def __init__(self, native: _native.Discovery | Kept, again: tuple[Any, ...] = ()) -> None:
        """Wrap the result of :func:`discover`, and its arguments."""
        self._made = native
        self._again = again
        self.__dict__.update(self.to_dict())

    def to_dict(self) -> dict[str, Any]:
        """Return all results, with exactly the keys of ``discovery.json``."""
        return dict(json.loads(self.to_json()))

    def to_json(self) -> str:
        """Return the text of ``discovery.json``."""
        return self._made.json()

    def term(self) -> str | None:
        """Return the best law as the text of a term file, or None if no law was found."""
        return self._made.term()

    def save(self, path: str | PathLike[str]) -> None:
        """Write the best law as a term file, for ``terms`` of :func:`diagnose` and :func:`fit`.

        Raises
        ------
        ValueError
            If no law was found.
        """
        text = self.term()
        if text is None:
            raise ValueError(f"no law was found: {self.text}")
        _native.write_text(fspath(path), text)

    def page(self, verbose: bool = False) -> str:
        """Return the page of ``hexbench discover``."""
        return self._made.text(verbose)

    def to_html(self, path: str | PathLike[str]) -> None:
        """Write the page of ``hexbench discover --html``: the readings as the law explains them, as a single HTML file that
        needs no network.
        """
        _native.write_text(fspath(path), self._made.html())

    def __str__(self) -> str:
        """Return the page of ``hexbench discover``."""
        return self.page()

    def __repr__(self) -> str:
        """Return the best law."""
        best = f"; {self.laws[0]['formula']}" if self.found else ""
        return f"Discovery({self.reason}{best})"

    def _repr_html_(self) -> str:
        return pre(str(self))

    def __reduce__(self) -> tuple[Any, ...]:
        """Pickle the report and the arguments."""
        return self._kept_with((self.page(), self.page(verbose=True)), self.term(), _discovered)


def discover(
    campaign: Campaign,
    *,
    holdout: Data | None = None,
    terms: Sequence[OwnTerm] = (),
    exclude: Sequence[int | str] = (),
    read_as: Sequence[str] = (),
) -> Discovery:
    """Search for a law outside the catalogue that explains what springs and catalogue do not.

    Parameters
    ----------
    campaign : Campaign
        The measurements.
    holdout : path, table or Campaign, optional
        Held-out readings, which no fit uses; by default poses are left out in turn.
    terms : sequence of paths or Term
        Terms of your own that compete with the catalogue: files (term/1), or functions (:class:`Term`).
    exclude : sequence of int or str
        Lines of readings to leave out before anything else, as for :func:`diagnose`.
    read_as : sequence of str
        Correct how the files are read: ``KIND=VALUE``.

    Returns
    -------
    Discovery
        ``found`` is false if nothing is missing, if the catalogue explains the readings, or if no law is convincing; that is a
        result, not an exception.

    Raises
    ------
    BadInput, NotDetermined
        If nothing can be computed, or a line in ``exclude`` has no reading.
    """
    changes = [read_as] if isinstance(read_as, str) else list(read_as)
    return _discovered(campaign, holdout, own_terms(terms), lines_named(exclude), changes)


def _discovered(
    campaign: Campaign, holdout: Data | None, terms: list[str | Term], exclude: list[str], read_as: list[str]
) -> Discovery:
    native = _native.discover(campaign._made, held_out(campaign, holdout), native_terms(terms), exclude, read_as)
    return Discovery(native, (campaign, holdout, terms, exclude, read_as))
