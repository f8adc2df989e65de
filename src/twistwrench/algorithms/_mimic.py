"""A decorator with which a function of a model takes a `MimicModel` as well."""

from __future__ import annotations

from collections.abc import Callable
from functools import wraps
from typing import Any, TypeVar

__all__ = ["also_of_mimics"]

Function = TypeVar("Function", bound=Callable[..., Any])


def also_of_mimics(function: Function) -> Function:
    """Let a function take a model whose joints follow others: it runs on the full one, and its result is projected."""

    @wraps(function)
    def face(*args: Any, **kwargs: Any) -> Any:
        answer = getattr(args[0] if args else kwargs.get("model"), "_project", None)
        return answer(function, *args, **kwargs) if callable(answer) else function(*args, **kwargs)

    return face  # type: ignore[return-value]
