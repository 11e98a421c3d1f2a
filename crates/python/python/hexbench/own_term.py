"""Terms of your own: effects whose law is a Python function."""

from __future__ import annotations

import inspect
import json
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from os import PathLike, fspath
from typing import Any, Literal

import numpy as np
from numpy.typing import ArrayLike

from hexbench import _native
from hexbench._tables import Floats
from hexbench.errors import UsageError

#: What the six numbers of a law are.
Acts = Literal["elongation", "wrench", "base_motion", "platform_motion"]


@dataclass(frozen=True)
class Parameter:
    """A parameter of a term, in which its law is linear."""

    #: Letters, digits and underscores; the law has an argument of this name.
    name: str
    #: Unit shown to people, such as ``"nm/N"``.
    unit: str
    #: Its physically sensible size, in that unit.
    scale: float
    #: True if a negative value has no physical meaning.
    positive: bool = False
    #: True if every leg has its own size (``acts="elongation"`` only).
    per_leg: bool = False
    #: Number of these units in one SI unit; known for the units of ``hexbench fit --help``.
    per_si: float | None = None


@dataclass(frozen=True)
class ShapeParameter:
    """The one parameter of a term in which its law may be nonlinear: an exponent, a period, a time constant."""

    #: As of :class:`Parameter`.
    name: str
    #: As of :class:`Parameter`.
    unit: str
    #: Smallest and largest value, in that unit, both positive.
    bounds: tuple[float, float]
    #: Starting values of a fit, in that unit.
    grid: tuple[float, ...]
    #: As of :class:`Parameter`.
    per_si: float | None = None


class Term:
    """An effect of your own whose law is a Python function: it competes with the catalogue and can be fitted, compared and
    predicted.

    Parameters
    ----------
    law : function
        Its arguments are passed by name. Those named in ``parameters`` and ``shape`` get numbers in SI; every other is a
        variable of formulas (``docs/reference/file-formats.md``, term/1): ``f``, ``f0``, ``df`` (N), ``q`` (m), ``delta_T``
        (K), ``elapsed`` (s), ``fz``. A variable of a leg is an array (n, 6), any other (n, 1), for n conditions at once; with
        ``acts`` other than ``"elongation"``, (n,). Everything is SI. The law returns what ``acts`` says, must be linear in its
        parameters, and must treat every condition independently.
    id : str
        Name of the effect: kebab-case.
    parameters : sequence of Parameter
        Parameters to estimate.
    acts : str
        ``"elongation"``: of each leg, m, (n, 6) or an array that can be broadcast to it. Six numbers, as a sequence of six or
        an array (n, 6): ``"wrench"`` on the platform, N and N m, mobile origin, fixed axes; ``"base_motion"``, m and rad, fixed
        origin and axes; ``"platform_motion"`` of the measured target relative to the platform joints, m and rad, mobile origin
        and axes.
    title, physics : str
        For people; default: the id.
    shape : ShapeParameter, optional
        A parameter in which the law is nonlinear; found by search.
    prior : float
        Prior probability relative to an effect of the catalogue: above 0, at most 1.

    Raises
    ------
    BadInput
        A broken rule: a duplicate name, an unknown variable, a law that is nonlinear in a parameter or mixes conditions.
    UsageError
        A law whose result has the wrong shape. Exceptions of the law reach the caller.

    Notes
    -----
    The law is evaluated for all conditions of a campaign at once, in a few calls per step of a fit, and never twice for the
    same numbers; computing threads continue meanwhile. Derivatives come from unit values of each parameter (exact, because the
    law is linear) and from differences in the leg forces. Files cannot contain a function, so such a model cannot be saved;
    write a law of elementary functions as the formula of a term file instead.
    """

    def __init__(
        self,
        law: Callable[..., Any],
        *,
        id: str,  # noqa: A002
        parameters: Sequence[Parameter],
        acts: Acts = "elongation",
        title: str | None = None,
        physics: str = "",
        shape: ShapeParameter | None = None,
        prior: float = 1.0,
    ) -> None:
        """Check and store the law."""
        self.id = id
        self._again = (law, id, tuple(parameters), acts, title, physics, shape, prior)
        own = [p.name for p in parameters] + ([] if shape is None else [shape.name])
        named = _arguments(law)
        missing = next((name for name in own if name not in named), None)
        if missing is not None:
            next_step = "Give it an argument of the name of each parameter."
            raise UsageError(f"the law of {id} has no argument {missing!r}", next_step)
        variables = [name for name in named if name not in own]
        header = _header(id, title or id, physics, prior, parameters, shape)
        called = f"{getattr(law, '__name__', type(law).__name__)}({', '.join(named)})"

        def asked(count: int, columns: list[Floats], sizes: list[float]) -> Floats:
            values = dict(zip(variables, (_column(c, count, acts) for c in columns), strict=True))
            return _six(law(**values, **dict(zip(own, sizes, strict=True))), count, acts, id)

        self._made = _native.Term(header, acts, variables, called, asked)

    def __repr__(self) -> str:
        """Return name and law."""
        return f"Term({self.id!r}, {getattr(self._again[0], '__name__', 'law')})"

    def __eq__(self, other: object) -> bool:
        """Compare all arguments; laws are equal if they are the same function."""
        return isinstance(other, Term) and self._again == other._again

    def __hash__(self) -> int:
        """Hash the name."""
        return hash(self.id)

    def __reduce__(self) -> tuple[Any, ...]:
        """Pickle the arguments; the law is pickled like any function, by its name in its module."""
        return (_restored, self._again)


#: A term file, or a term whose law is a function.
OwnTerm = str | PathLike[str] | Term


def own_terms(terms: Sequence[OwnTerm]) -> list[str | Term]:
    """Return terms of your own as they are stored: paths as texts."""
    return [term if isinstance(term, Term) else fspath(term) for term in terms]


def native_terms(terms: Sequence[str | Term]) -> list[str | _native.Term]:
    """Return them for the native half."""
    return [term._made if isinstance(term, Term) else term for term in terms]


def _restored(*given: Any) -> Term:
    law, name, parameters, acts, title, physics, shape, prior = given
    return Term(law, id=name, parameters=parameters, acts=acts, title=title, physics=physics, shape=shape, prior=prior)


def _arguments(law: Callable[..., Any]) -> list[str]:
    all_ = inspect.signature(law).parameters.values()
    wrong = next((p for p in all_ if p.kind not in (p.POSITIONAL_OR_KEYWORD, p.KEYWORD_ONLY)), None)
    if wrong is not None:
        raise UsageError(f"the argument {wrong} of a law has no name of its own", "Name every variable and parameter it takes.")
    return [p.name for p in all_ if p.default is p.empty]


def _header(
    id: str,  # noqa: A002
    title: str,
    physics: str,
    prior: float,
    parameters: Sequence[Parameter],
    shape: ShapeParameter | None,
) -> str:
    """Return the term file, without a formula."""
    head: dict[str, Any] = {"format": "term/1", "id": id, "title": title, "physics": physics, "prior": float(prior)}
    lines = _keys(head)
    for parameter in parameters:
        lines += ["[[parameters]]", *_keys({**vars(parameter), "scale": float(parameter.scale)})]
    if shape is not None:
        lists = {"bounds": [float(x) for x in shape.bounds], "grid": [float(x) for x in shape.grid]}
        lines += ["[shape]", *_keys({**vars(shape), **lists})]
    return "\n".join(lines) + "\n"


def _keys(table: dict[str, Any]) -> list[str]:
    # Texts, numbers, switches and lists of JSON are those of TOML.
    return [f"{key} = {json.dumps(value)}" for key, value in table.items() if value is not None]


def _column(values: Floats, count: int, acts: Acts) -> Floats:
    if values.size != count:
        return values.reshape(count, 6)
    return values.reshape(count, 1) if acts == "elongation" else values


def _six(found: ArrayLike, count: int, acts: Acts, id: str) -> Floats:  # noqa: A002
    """Return what a law gave as an array (n, 6)."""
    try:
        if acts == "elongation":
            wide = np.broadcast_to(np.asarray(found, dtype=np.float64), (count, 6))
        elif isinstance(found, (list, tuple)) and len(found) == 6:
            wide = np.stack([np.broadcast_to(np.asarray(one, dtype=np.float64), (count,)) for one in found], axis=1)
        else:
            wide = np.asarray(found, dtype=np.float64)
            if wide.shape != (count, 6):
                raise ValueError(f"shape {wide.shape}")
    except ValueError as cause:
        expected = "an array (n, 6), or what broadcasts to it"
        if acts != "elongation":
            expected = "six arrays (n,), or an array (n, 6)"
        next_step = f"n is {count} here; variables of a leg are (n, 6)."
        raise UsageError(f"the law of {id} gave what is not {expected}: {cause}", next_step) from cause
    return np.ascontiguousarray(wide)
