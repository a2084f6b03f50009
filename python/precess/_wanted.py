"""What public functions want, where they are given something else: a TypeError or ValueError that names it."""

from __future__ import annotations

import math
import operator
from collections.abc import Callable, Iterable, Mapping
from typing import Any, TypeVar

__all__ = [
    "called",
    "finite",
    "function",
    "instance",
    "items",
    "names",
    "number",
    "share",
    "table",
    "text",
    "whole",
]

T = TypeVar("T")
F = TypeVar("F", bound=Callable[..., Any])

#: More steps, samples or threads than any memory or life is long enough for.
_MOST = 2**63 - 1


def _shown(value: object) -> str:
    shown = repr(value)
    return shown if len(shown) <= 60 else f"{shown[:57]}..."


def _wrong(name: str, value: object, wanted: str) -> TypeError:
    return TypeError(f"{name} is {_shown(value)}, a {type(value).__name__}; it needs {wanted}")


def instance(name: str, value: object, kind: type[T], wanted: str) -> T:
    """The value, of a class of the package."""
    if not isinstance(value, kind):
        raise _wrong(name, value, wanted)
    return value


def whole(name: str, value: Any, least: int = 0) -> int:
    """A whole number from ``least`` on."""
    try:
        found = operator.index(value)
    except TypeError:
        raise _wrong(name, value, "a whole number") from None
    if found < least:
        raise ValueError(f"{name} is {_shown(found)}; it needs at least {least}")
    if found > _MOST:
        raise ValueError(f"{name} is {_shown(found)}; it needs at most {_MOST}")
    return found


def number(name: str, value: Any) -> float:
    """A real number."""
    if isinstance(value, str | bytes):
        raise _wrong(name, value, "a number")
    try:
        return float(value)
    except TypeError:
        raise _wrong(name, value, "a number") from None
    except OverflowError:
        raise ValueError(f"{name} is {_shown(value)}; it needs a number below 1.8e308") from None


def finite(name: str, value: Any) -> float:
    """A real number that is neither infinite nor NaN."""
    found = number(name, value)
    if not math.isfinite(found):
        raise ValueError(f"{name} is {found}; it needs a finite number")
    return found


def share(name: str, value: Any) -> float:
    """A probability or a share between zero and one."""
    found = number(name, value)
    if not 0.0 < found < 1.0:
        raise ValueError(f"{name} is {found}; it needs a number between 0 and 1")
    return found


def items(name: str, value: Any, wanted: str) -> list[Any]:
    """What a list or another iterable has."""
    if isinstance(value, str | bytes) or not isinstance(value, Iterable):
        raise _wrong(name, value, wanted)
    return list(value)


def text(name: str, value: Any) -> str:
    """A text."""
    if not isinstance(value, str):
        raise _wrong(name, value, "a text")
    return value


def names(name: str, values: Any) -> list[str]:
    """A sequence of texts; one text by itself, whose letters would be taken for names, is none."""
    return [text(f"a text of {name}", value) for value in items(name, values, "a list of texts")]


def table(name: str, value: Any) -> Mapping[Any, Any]:
    """A mapping."""
    if not isinstance(value, Mapping):
        raise _wrong(name, value, "a mapping, such as a dict")
    return value


def function(name: str, value: F | None) -> F | None:
    """A function, or None."""
    if value is not None and not callable(value):
        raise _wrong(name, value, "a function, or None")
    return value


def called(name: str, value: F) -> F:
    """A function that is called."""
    if not callable(value):
        raise _wrong(name, value, "a function")
    return value
