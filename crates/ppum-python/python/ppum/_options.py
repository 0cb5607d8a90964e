"""Keyword options that several functions share, each with its name, type, default and description in one place.

An option is a key of a `TypedDict` whose type is `Annotated[type, Option(default, description)]`. A function takes the options of a
dictionary by `**options: Unpack[...]`, which type checkers and editors read, and the decorator `takes` with the same dictionary. It
refuses names and words that there are not, fills in defaults, and gives the function its signature and its help. A function that
passes options on to another one has the decorator `passes`, which fills in nothing.
"""

import functools
import inspect
import numbers
import re
from collections.abc import Callable, Iterable, Mapping
from dataclasses import dataclass, replace
from typing import Any, Literal, TypeVar, get_args, get_origin, is_typeddict

import numpy as np

from . import _core
from ._text import hint, one_of

_F = TypeVar("_F", bound=Callable[..., Any])

#: The program's names of options that have those of matplotlib here.
_RENAMED = {
    "bar": "colorbar", "colormap": "cmap", "extremes": "contrast", "overlay": "overlays", "range": "clim", "scale": "norm",
}  # fmt: skip

#: The names that other packages and the program have for options.
FOREIGN = {
    **{foreign: _RENAMED.get(ours, ours) for foreign, ours in _core.foreign_options()},
    **_RENAMED,
    "axes": "ax", "cbar_kwargs": "colorbar", "log_scale": "norm",
}  # fmt: skip


_TEXTS = _core.option_texts()


class _Unset:
    """The default of options that are left out."""

    def __repr__(self) -> str:
        return "..."


UNSET = _Unset()


@dataclass(frozen=True)
class Option:
    """The default and the description of an option; one without a default is left out where it is not given.

    An option without a text has that of the program's option, by the name of `FOREIGN` if theirs differ, and `more`.
    Options of images stand `at` a place of a request, such as ``colors.bands``, as what `written` makes of them.
    """

    default: Any
    text: str = ""
    more: str = ""
    at: str = ""
    written: Callable[[Any], Any] | None = None


def options_of(kind: type) -> dict[str, tuple[Any, Option]]:
    """Return types and options of a dictionary by name; its module has no annotations as texts."""
    return {name: _split(name, *get_args(hint)) for name, hint in kind.__annotations__.items()}


def _split(name: str, kind: Any, option: Option) -> tuple[Any, Option]:
    shared, bracket, default = ("" if option.text else _shared_text(name)).partition(" [default")
    text = option.text or "; ".join(filter(None, [shared, option.more])) + bracket + default
    return kind, replace(option, text=text[:1].upper() + text[1:])


def _shared_text(name: str) -> str:
    """Return the program's text about an option, with Python's names of options."""
    names = [name, *(foreign for foreign, ours in FOREIGN.items() if ours == name)]
    (text,) = (_TEXTS[known] for known in names if known in _TEXTS)
    return re.sub(r"--([a-z-]+)", lambda found: f"`{FOREIGN.get(found[1], found[1])}`", text)


def defaults(kind: type) -> Any:
    return {name: option.default for name, (_, option) in options_of(kind).items() if option.default is not UNSET}


def takes(kind: type, called: str = "", *, fill: bool = True) -> Callable[[_F], _F]:
    """Make a function check the options of a dictionary and know their defaults; `called` is its name in messages."""
    return lambda function: _checking(function, options_of(kind), defaults(kind) if fill else {}, called)


def passes(kind: type) -> Callable[[_F], _F]:
    """Make a function check the options of a dictionary, and receive only those that are given."""
    return takes(kind, fill=False)


def _checking(function: _F, known: Mapping[str, Any], defaults: Mapping[str, Any], called: str) -> _F:
    signature = inspect.signature(function)
    own = [p for p in signature.parameters.values() if p.kind is not p.VAR_KEYWORD]
    names = [*known, *(p.name for p in own if p.name != "self")]


    @functools.wraps(function)
    def checked(*args: Any, **given: Any) -> Any:
        refuse_unknown(called or f"{function.__name__}()", given, names)
        for name in given.keys() & known.keys():
            _check(name, known[name][0], given[name])
        return function(*args, **{**defaults, **given})

    only = inspect.Parameter.KEYWORD_ONLY
    more = [inspect.Parameter(n, only, default=o.default, annotation=kind) for n, (kind, o) in known.items()]
    checked.__signature__ = signature.replace(parameters=[*own, *more])  # type: ignore[attr-defined]
    lines = "\n".join(f"    {name}: {option.text}" for name, (_, option) in known.items())
    checked.__doc__ = f"{inspect.cleandoc(function.__doc__ or '')}\n\nOptions:\n{lines}\n"
    return checked  # type: ignore[return-value]


def refuse_unknown(what: str, given: Iterable[str], known: Iterable[str]) -> None:
    names = sorted(known)
    for name in given:
        if name in names:
            continue
        meant = f"did you mean `{FOREIGN[name]}`?" if FOREIGN.get(name) in names else hint(name, names)
        raise TypeError(f"{what} has no option `{name}`; {meant}")


def _check(name: str, kind: Any, value: Any) -> None:
    """Refuse other words and types than an option may have.

    Only options of words, numbers, truth values and None are looked at, and lists of words; others check themselves.
    """
    if is_typeddict(kind) and not isinstance(value, Mapping):
        keys = ", ".join(kind.__annotations__)
        raise TypeError(f"{name}: a dictionary of {keys} is needed, not {value!r}")
    atoms = list(_atoms(kind))
    words = [atom for atom in atoms if isinstance(atom, str)]
    if str in atoms or set(atoms) - _PLAIN.keys() - set(words):
        return
    for part in value if isinstance(value, (list, tuple, set, frozenset, np.ndarray)) else [value]:
        if isinstance(part, str) and words:
            one_of(name, part, words, " or a number" if float in atoms else "")
        elif not any(_fits(part, atom) for atom in atoms):
            needed = " or ".join(_CALLED.get(atom, repr(atom)) for atom in atoms)
            raise TypeError(f"{name}: {needed} is needed, not {part!r}")


def _fits(value: Any, atom: Any) -> bool:
    """Return whether a value is of a type; truth values are no numbers."""
    return isinstance(value, _PLAIN.get(atom, ())) and (atom is bool or not isinstance(value, bool))


#: What values of a type may be.
_PLAIN: dict[Any, Any] = {bool: (bool, np.bool_), float: numbers.Real, int: numbers.Integral, type(None): type(None)}
_CALLED = {bool: "True or False", float: "a number", int: "a whole number", type(None): "None"}


def _atoms(kind: Any) -> Iterable[Any]:
    """Return the types of a union and the words of its literals; items of sequences count as their own."""
    if get_origin(kind) is Literal:
        return get_args(kind)
    parts = get_args(kind)
    return dict.fromkeys(atom for part in parts for atom in _atoms(part)) if parts else (kind,)
