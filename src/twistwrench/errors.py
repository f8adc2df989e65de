"""The errors of the package, and the wording of their messages.

Every error of the package is a `ValueError`, so that code which catches those keeps working.
Each message names the argument, joint, link or frame, what was expected and what was got.
"""

from __future__ import annotations

from collections.abc import Collection, Iterable
from os import PathLike
from typing import Any

__all__ = ["FrameError", "ModelError", "ShapeError", "SingularError", "check_known", "no_model", "unknown_name"]


class ModelError(ValueError):
    """A model that cannot be right: a broken file, a mass below zero, an inertia no body can have."""


class ShapeError(ValueError):
    """An array of the wrong shape. The message names the argument, what was expected and what was got."""


class SingularError(ValueError):
    """A quantity that does not exist here. The message names what is singular, and where.

    Attributes
    ----------
    motion : Simulation or None
        Where a step of a simulation failed: the motion until then.
    """

    motion: Any = None


class FrameError(ValueError):
    """Two quantities expressed in different frames were combined. The message prints both frames."""


def unknown_name(kind: str, name: object, known: Iterable[str], where: str = "") -> NameNotFound:
    """Make the error for a name that is not known, with the nearest known ones.

    Parameters
    ----------
    kind : str
        What the name should have named, for example ``"frame"``.
    name : object
        The value that was given, a string if it is a name at all.
    known : iterable of str
        The names that exist.
    where : str
        Which of several sets of names that is, for example ``" of model 'go2'"``.

    Returns
    -------
    NameNotFound
        A `KeyError` (and `ValueError`) ready to be raised.

    Examples
    --------
    >>> raise unknown_name("frame", "FR_fot", ["FL_foot", "FR_foot", "base"])
    Traceback (most recent call last):
    twistwrench.errors.NameNotFound: unknown frame 'FR_fot'; did you mean 'FR_foot', 'FL_foot'?
    """
    import difflib  # only where something went wrong

    names = list(dict.fromkeys(known))
    shown = ", ".join(map(repr, names[:12])) + (f" and {len(names) - 12} more" if len(names) > 12 else "")
    if not isinstance(name, str):
        return NameNotFound(f"{kind}: expected a name, got {_typed(name)}" + (f"; known: {shown}" if names else ""))
    longer = sorted((k for k in names if name and k.lower().startswith(name.lower())), key=len)
    shorter = [k for k in names if len(k) > 2 and k.lower() in name.lower()]
    near = longer + (difflib.get_close_matches(name, names, n=4, cutoff=0.5) or shorter)
    if near := list(dict.fromkeys(near))[:4]:
        hint = "did you mean " + ", ".join(map(repr, near)) + "?"
    else:
        hint = f"known: {shown or 'none'}"
    return NameNotFound(f"unknown {kind} {name!r}{where}; {hint}")


def check_known(kind: str, name: object, known: Collection[str], where: str = "") -> None:
    """Raise NameNotFound unless the name is known: see `unknown_name`.

    Examples
    --------
    >>> check_known("base", "flat", ["fixed", "floating"])
    Traceback (most recent call last):
    twistwrench.errors.NameNotFound: unknown base 'flat'; did you mean 'floating'?
    """
    if not isinstance(name, str) or name not in known:
        raise unknown_name(kind, name, known, where)


def no_model(value: object, what: str = "model", expected: str = "a Model") -> TypeError:
    """Make the error for a value that is not a model, with a hint how to get one from it.

    Parameters
    ----------
    value : object
        The value that was given.
    what : str
        The name of the argument.
    expected : str
        Everything that is accepted there.

    Returns
    -------
    TypeError
        Ready to be raised.

    Examples
    --------
    >>> raise no_model("go2")
    Traceback (most recent call last):
    TypeError: model: expected a Model, got the str 'go2'; did you mean tw.load('go2')?
    """
    kind = type(value)
    package, hint = kind.__module__.partition(".")[0], ""
    got = f"the {kind.__name__}" if package in ("builtins", "twistwrench") else f"{package}'s {kind.__name__}"
    if value is None or isinstance(value, type):
        got = "None" if value is None else f"the class {value.__name__}"
    elif isinstance(value, str | PathLike):
        got, hint = f"the {kind.__name__} {str(value)!r}", f"; did you mean tw.load({str(value)!r})?"
    elif (package, kind.__name__) == ("pinocchio", "Model"):
        hint = "; tw.bridge.from_pinocchio_model makes one of it"
    elif package == "twistwrench" and hasattr(value, "full") and hasattr(value, "laws"):
        follower, (leader, ratio, _) = next(iter(value.laws.items()))
        held = f"contacts=[tw.Coupling({follower!r}, {{{leader!r}: {ratio:g}}}){', …' * (len(value.laws) > 1)}]"
        hint = (
            "; this function does not support joints that follow others; its .full has them free, and where a "
            f"function takes contacts, {held} couples them there"
        )
    elif package == "twistwrench" and hasattr(value, "model"):
        hint = "; did you mean its .model?"
    return TypeError(f"{what}: expected {expected}, got {got}{hint}")


def _typed(value: object) -> str:
    """Return the type and the value, the type once where the value's text already names it."""
    kind, text = type(value).__name__, repr(value)
    return text if text.startswith(kind) else f"{kind} {text}"


class NameNotFound(KeyError, ValueError):
    """A name that is not known. The message lists the nearest known ones."""

    def __str__(self) -> str:
        return str(self.args[0])
