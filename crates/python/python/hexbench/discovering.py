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
    """What a search for laws came to. Attributes are the keys of ``discovery.json``, with its names and units."""

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
    #: Catalogue effects beside the law, or those that explain the readings without one.
    beside: list[str]
    #: Laws, best first: ``id``, ``term``, ``formula``, ``kind``, ``legs``, ``probability``, ``complexity``, ``parameters``,
    #: ``held_out`` (``before`` and ``after``, times the noise), ``text``, ``look_at``, ``alike``.
    laws: list[dict[str, Any]]
    #: Errors, fitted and held out: springs alone, effects beside, the law.
    steps: list[dict[str, Any]]
    #: Probability that one of the laws weighed is present.
    probability: float
    #: Readings that separate the first law from those that look like it, as in ``diagnosis.json``.
    next: list[dict[str, Any]]
    #: What these readings promise for each pair.
    separation: list[dict[str, Any]]
    #: Number of laws weighed.
    searched: int
    #: Things to know.
    warnings: list[str]
    #: Program, machine and digests of the files.
    run: dict[str, Any]

    def __init__(self, native: _native.Discovery | Kept, again: tuple[Any, ...] = ()) -> None:
        """Hold what :func:`discover` has found, and what it was asked."""
        self._made = native
        self._again = again
        self.__dict__.update(self.to_dict())

    def to_dict(self) -> dict[str, Any]:
        """Return all of it, with exactly the keys of ``discovery.json``."""
        return dict(json.loads(self.to_json()))

    def to_json(self) -> str:
        """Return the text of ``discovery.json``."""
        return self._made.json()

    def term(self) -> str | None:
        """Return the best law as the text of a term file, or None where no law was found."""
        return self._made.term()

    def save(self, path: str | PathLike[str]) -> None:
        """Write the best law as a term file, for ``terms`` of :func:`diagnose` and :func:`fit`.

        Raises
        ------
        ValueError
            Where no law was found.
        """
        text = self.term()
        if text is None:
            raise ValueError(f"no law was found: {self.text}")
        _native.write_text(fspath(path), text)

    def page(self, verbose: bool = False) -> str:
        """Return the page of ``hexbench discover``."""
        return self._made.text(verbose)

    def to_html(self, path: str | PathLike[str]) -> None:
        """Write the page of ``hexbench discover --html``: the readings as the law explains them; one file, needs no network."""
        _native.write_text(fspath(path), self._made.html())

    def __str__(self) -> str:
        """Return the page of ``hexbench discover``."""
        return self.page()

    def __repr__(self) -> str:
        """Return what was found."""
        best = f"; {self.laws[0]['formula']}" if self.found else ""
        return f"Discovery({self.reason}{best})"

    def _repr_html_(self) -> str:
        return pre(str(self))

    def __reduce__(self) -> tuple[Any, ...]:
        """Pickle what is reported, and what was asked."""
        return self._kept_with((self.page(), self.page(verbose=True)), self.term(), _discovered)


def discover(
    campaign: Campaign,
    *,
    holdout: Data | None = None,
    terms: Sequence[OwnTerm] = (),
    exclude: Sequence[int | str] = (),
    read_as: Sequence[str] = (),
) -> Discovery:
    """Search for a law outside the catalogue that explains what springs and catalogue leave.

    Parameters
    ----------
    campaign : Campaign
        The measurements.
    holdout : path, table or Campaign, optional
        Readings kept out of every fit; without them poses are left out in turn.
    terms : sequence of paths or Term
        Terms of your own that compete with the catalogue: files (term/1), or functions (:class:`Term`).
    exclude : sequence of int or str
        Lines of the readings to be left out before anything else, as for :func:`diagnose`.
    read_as : sequence of str
        Read the files differently from what they say: ``KIND=VALUE``.

    Returns
    -------
    Discovery
        ``found`` is false where nothing is missing, where the catalogue explains the readings, and where no law convinces;
        that is a result, not an exception.

    Raises
    ------
    BadInput, NotDetermined
        When nothing can be computed, or a line of ``exclude`` has no reading.
    """
    changes = [read_as] if isinstance(read_as, str) else list(read_as)
    return _discovered(campaign, holdout, own_terms(terms), lines_named(exclude), changes)


def _discovered(
    campaign: Campaign, holdout: Data | None, terms: list[str | Term], exclude: list[str], read_as: list[str]
) -> Discovery:
    native = _native.discover(campaign._made, held_out(campaign, holdout), native_terms(terms), exclude, read_as)
    return Discovery(native, (campaign, holdout, terms, exclude, read_as))
