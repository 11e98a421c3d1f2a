"""Comparing a model with measurements, and identifying missing effects."""

from __future__ import annotations

import json
from collections.abc import Mapping, Sequence
from html import escape
from os import PathLike, fspath
from typing import Any

from hexbench import _native
from hexbench._bounds import whole
from hexbench._html import bar, pre
from hexbench._kept import Kept, Told
from hexbench.campaign import Campaign, Data, held_out
from hexbench.model import Model
from hexbench.own_term import OwnTerm, Term, native_terms, own_terms

#: Largest number of a line.
_LAST_LINE = 2**64 - 1


class Comparison(Told):
    """A comparison of a model with measurements: errors relative to the noise, where they occur, what they follow.

    The keys of ``comparison.json`` are attributes (:attr:`error`, :attr:`holdout`) or in :meth:`to_dict`.
    """

    #: Chi-square per degree of freedom, root mean squares (um, urad), on the compared readings.
    error: dict[str, Any]
    #: The same on held-out readings; None without them.
    holdout: dict[str, Any] | None

    def __init__(self, native: _native.Comparison | Kept, again: tuple[Any, ...] = ()) -> None:
        """Wrap the result of :func:`compare`, and its arguments."""
        self._made = native
        self._again = again
        found = self.to_dict()
        self.error = found["error"]
        self.holdout = found["holdout"]

    def to_dict(self) -> dict[str, Any]:
        """Return all numbers, with the keys of ``comparison.json``."""
        return _dictionary(self.to_json())

    def to_json(self) -> str:
        """Return the text of ``comparison.json``."""
        return self._made.json()

    def to_html(self, path: str | PathLike[str]) -> None:
        """Write the page with charts, as a single HTML file that needs no network."""
        _native.write_text(fspath(path), self._made.html())

    def __str__(self) -> str:
        """Return the page of ``hexbench compare``."""
        return self._made.text()

    def __repr__(self) -> str:
        """Return the size of the error."""
        held = "" if self.holdout is None else f", held out {self.holdout['chi2_reduced']:.3g}"
        return f"Comparison(chi2/dof {self.error['chi2_reduced']:.3g}{held})"

    def _repr_html_(self) -> str:
        return pre(str(self))

    def __reduce__(self) -> tuple[Any, ...]:
        """Pickle the report and the arguments."""
        return self._kept_with((str(self), str(self)), None, _compared)


class Diagnosis(Told):
    """The verdict on a campaign. Attributes are the keys of ``diagnosis.json``, with its names and units."""

    #: ``diagnosis/1``.
    format: str
    #: ``adequate``, ``named``, ``ambiguous``, ``outside``, ``measurement`` or ``undecided``.
    verdict: str
    #: Effects named, in the order in which they were added.
    added: list[str]
    #: Terms of the fitted model that the numbers belong to.
    model: list[str]
    #: Effects that are certain but reduce the held-out error by less than 0.5 %; they are in the model but not named.
    small: list[str]
    #: Terms of the model that needed their richer form.
    richer: list[str]
    #: What ``add`` of :func:`fit` takes to fit this model: ``model``, with ``:richer`` behind the terms that need that form.
    add: list[str]
    #: Probability of every first addition, of ``outside`` and of ``none``; best first.
    candidates: list[dict[str, Any]]
    #: Probability that an effect is present at all.
    present: dict[str, float]
    #: Check of the Gaussian approximation behind these probabilities, for the leading sets of effects: ``terms``, ``draws``,
    #: ``pareto_k`` (None if all weights are equal), ``log_evidence_change``; empty with more than 300 conditions and for
    #: absolute poses.
    gaussian_checks: list[dict[str, Any]]
    #: Smallest set of effects with 95 % of the probability.
    credible_set: list[str]
    #: Errors, fitted and held out, of every step of the model, springs alone first; ``gain`` and ``worth`` of the effect added.
    steps: list[dict[str, Any]]
    #: The error on poses left out of both fit and choice of terms, and the terms ``chosen``; None with a holdout file.
    nested: dict[str, Any] | None
    #: How the held-out error was obtained.
    holdout: str
    #: The noise of one reading: ``translation_um``, ``rotation_urad``, ``source``.
    noise: dict[str, Any]
    #: ``name``, ``value``, ``std`` (k = 1), ``unit`` of every number of the model.
    parameters: list[dict[str, Any]]
    #: Names of parameters that the data do not determine.
    not_determined: list[str]
    #: Terms that the data cannot test, and why.
    untestable: list[dict[str, Any]]
    #: Smallest sizes that this campaign can detect.
    detectable: list[dict[str, Any]]
    #: Readings that would separate the candidates.
    next: list[dict[str, Any]]
    #: Expected odds from those readings, pair by pair.
    separation: list[dict[str, Any]]
    #: Bias of the leg stiffnesses if an effect is omitted.
    absorbed: list[dict[str, Any]]
    #: Readings far from every prediction; ``row`` is the line of measurements.csv (for a table in memory: its row plus two).
    suspects: list[dict[str, Any]]
    #: The unexplained pattern, or None.
    outside: dict[str, Any] | None
    #: With the verdict ``outside``: the law that explains what the catalogue does not, with the keys of ``laws`` of
    #: ``discovery.json``; None if none is convincing.
    law: dict[str, Any] | None
    #: Leg residuals of the fitted model beyond the noise (``times_noise``, ``legs``, ``follows``), or None.
    remainder: dict[str, Any] | None
    #: Warnings about the numbers.
    warnings: list[str]
    #: Faults of the data: ``kind``, ``probability``, ``rows`` (lines, as of ``suspects``), ``size``, ``text``, ``next``.
    findings: list[dict[str, Any]]
    #: Lines left out because ``exclude`` named them.
    excluded: list[int]
    #: Whether suspect readings were kept in the fit.
    keep_all: bool
    #: Corrections applied to the files because of ``read_as``, as ``KIND=VALUE``.
    read_as: list[str]
    #: The answer under the opposite choice, if findings leave readings out or would do so: ``rows`` (lines concerned),
    #: ``verdict``, ``added``, ``stiffness`` (six, None if undetermined), ``chi2_reduced``; None if nothing differs.
    alternative: dict[str, Any] | None
    #: The answer to misread files with the first correction of ``findings``: ``read_as``, ``verdict``, ``added``,
    #: ``times_noise`` (springs alone, all effects); None for files that mean what they say.
    other_reading: dict[str, Any] | None
    #: Program, machine and digests of the files.
    run: dict[str, Any]

    def __init__(self, native: _native.Diagnosis | Kept, again: tuple[Any, ...] = ()) -> None:
        """Wrap the result of :func:`diagnose`, and its arguments."""
        self._made = native
        self._again = again
        self.__dict__.update(self.to_dict())

    def to_dict(self) -> dict[str, Any]:
        """Return all results, with exactly the keys of ``diagnosis.json``."""
        return _dictionary(self.to_json())

    def to_json(self) -> str:
        """Return the text of ``diagnosis.json``."""
        return self._made.json()

    def to_html(self, path: str | PathLike[str]) -> None:
        """Write the page with charts, as a single HTML file that needs no network."""
        _native.write_text(fspath(path), self._made.html())

    def text(self, verbose: bool = False) -> str:
        """Return the page of ``hexbench diagnose``; ``verbose`` with every parameter and every detectable size."""
        return self._made.text(verbose)

    def __str__(self) -> str:
        """Return the page of ``hexbench diagnose``."""
        return self.text()

    def __repr__(self) -> str:
        """Return the verdict and the best candidates."""
        best = ", ".join(f"{c['term']} {c['probability']:.2f}" for c in self.candidates[:3])
        return f"Diagnosis({self.verdict}{''.join(f' {a}' for a in self.added)}; {best})"

    def _repr_html_(self) -> str:
        likely = [c for c in self.candidates if c["probability"] >= 0.001]
        cells = [(escape(c["term"]), f"{c['probability']:.3f}", bar(c["probability"])) for c in likely]
        rows = "".join(f"<tr><td>{name}</td><td>{share}</td><td>{drawn}</td></tr>" for name, share, drawn in cells)
        steps = " → ".join(f"{s['holdout']['chi2_reduced'] ** 0.5:.2f}" for s in self.steps if s["holdout"])
        error = f"<p>held-out error over the noise: {steps}</p>" if steps else ""
        named = " ".join(escape(a) for a in self.added)
        head = "<tr><th>effect</th><th>probability</th><th></th></tr>"
        return f"<p><b>{escape(self.verdict)}</b> {named}</p>{error}<table>{head}{rows}</table>"

    def plot(self, axes: Any = None) -> Any:
        """Draw the probabilities of the first addition and the held-out error of every step (needs matplotlib).

        Parameters
        ----------
        axes : two matplotlib axes, optional
            Axes for the drawing; a new figure by default.

        Returns
        -------
        The two axes.
        """
        from hexbench._plots import diagnosis

        return diagnosis(self, axes)

    def __reduce__(self) -> tuple[Any, ...]:
        """Pickle the report and the arguments."""
        return self._kept_with((self.text(), self.text(verbose=True)), None, _diagnosed)


def compare(campaign: Campaign, model: Model | None = None, *, holdout: Data | None = None) -> Comparison:
    """Compare a model with measurements.

    Parameters
    ----------
    campaign : Campaign
        The measurements.
    model : Model, optional
        Model to compare without refitting; by default leg springs are fitted to the data.
    holdout : path, table or Campaign, optional
        Held-out readings, which no fit uses; they are compared too.

    Raises
    ------
    BadInput, NotDetermined
        With the text of the command.
    """
    return _compared(campaign, model, holdout)


def diagnose(
    campaign: Campaign,
    *,
    holdout: Data | None = None,
    terms: Sequence[OwnTerm] = (),
    exclude: Sequence[int | str] = (),
    keep_all: bool = False,
    read_as: Sequence[str] = (),
) -> Diagnosis:
    """Identify the physical effect that the model lacks, and show the held-out error drop.

    Parameters
    ----------
    campaign : Campaign
        The measurements.
    holdout : path, table or Campaign, optional
        Held-out readings, which no fit uses; by default poses are left out in turn.
    terms : sequence of paths or Term
        Terms of your own that compete with the catalogue: files (term/1), or functions (:class:`Term`).
    exclude : sequence of int or str
        Lines of readings to leave out before anything else, as the diagnosis names them (``rows``; for a table in memory: its
        row plus two), or ranges such as ``"12-15"``.
    keep_all : bool
        Keep every other reading in the fit; findings are reported anyway.
    read_as : sequence of str
        Correct how the files are read: ``KIND=VALUE`` as a finding names it
        (``"deflection-sign=reversed"``), applied in order.

    Returns
    -------
    Diagnosis
        ``verdict`` is ``adequate``, ``named``, ``ambiguous``, ``outside``, ``measurement`` or ``undecided``; an unfavorable
        verdict is a result, not an exception.

    Raises
    ------
    BadInput, NotDetermined
        If nothing can be computed, or a line in ``exclude`` has no reading.
    """
    changes = [read_as] if isinstance(read_as, str) else list(read_as)
    return _diagnosed(campaign, holdout, own_terms(terms), lines_named(exclude), bool(keep_all), changes)


def terms() -> list[dict[str, Any]]:
    """Return the catalogue of effects.

    Each has ``id``, ``title``, ``physics``, ``equation``, ``source``, ``shows`` (what the data must contain), ``breaker``
    (what to vary to isolate it), ``parameters`` (``name``, ``unit``) and ``shape`` (``name``, ``unit``, or None).
    """
    return _native.terms()


def _compared(campaign: Campaign, model: Model | None, holdout: Data | None) -> Comparison:
    native = None if model is None else model._made
    return Comparison(_native.compare(campaign._made, native, held_out(campaign, holdout)), (campaign, model, holdout))


def _diagnosed(
    campaign: Campaign,
    holdout: Data | None,
    terms: list[str | Term],
    exclude: list[str],
    keep_all: bool,
    read_as: list[str],
) -> Diagnosis:
    held = held_out(campaign, holdout)
    native = _native.diagnose(campaign._made, held, native_terms(terms), exclude, keep_all, read_as)
    return Diagnosis(native, (campaign, holdout, terms, exclude, keep_all, read_as))


def lines_named(exclude: Sequence[int | str]) -> list[str]:
    """Return lines and ranges of lines as the command writes them."""
    named = [exclude] if isinstance(exclude, str) else exclude
    return [line if isinstance(line, str) else str(whole(line, "exclude", 1, _LAST_LINE)) for line in named]


def _dictionary(text: str) -> dict[str, Any]:
    found: Mapping[str, Any] = json.loads(text)
    return dict(found)
