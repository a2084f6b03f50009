"""Arguments of batches: checked, with messages that name them."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING, Any

import numpy as np

from ._tables import path_of
from ._wanted import table, text, whole

if TYPE_CHECKING:
    import numpy.typing as npt

    from .errors import Diagnostic

    Array = npt.NDArray[np.float64]

__all__ = ["is_of_key", "lists", "rows_of_inputs", "table_of", "threads_of", "written"]


def threads_of(threads: int | None) -> int:
    """How many, where zero is all cores."""
    return 0 if threads is None else whole("threads", threads)


def written(out: object) -> tuple[Array, Array]:
    """Two arrays that can be written."""
    if not isinstance(out, tuple) or len(out) != 2:
        raise TypeError(f"`out` is a {type(out).__name__}; it needs a tuple of two arrays, for C and D")
    for index, of in enumerate(out):
        if not isinstance(of, np.ndarray) or of.dtype != np.float64 or of.ndim != 3:
            raise TypeError(f"`out[{index}]` needs an array of float64 of three dimensions")
    return out[0], out[1]


def table_of(name: str, of: npt.ArrayLike) -> Array:
    """Numbers in rows."""
    try:
        found = np.asarray(of, dtype=np.float64)
    except (TypeError, ValueError):
        raise TypeError(f"`{name}` is a {type(of).__name__}; it needs an array of numbers") from None
    if found.ndim != 2:
        raise ValueError(f"`{name}` has the shape {found.shape}; it needs a row for each state")
    return found


def rows_of_inputs(inputs: npt.ArrayLike, shape: tuple[int, int]) -> Array:
    """Force, torque and motors of each state."""
    try:
        u = np.asarray(inputs, dtype=np.float64)
    except TypeError:
        raise TypeError(
            f"inputs are a {type(inputs).__name__}; they need precess.Inputs, or an array"
        ) from None
    if u.shape != shape:
        raise ValueError(f"inputs have the shape {u.shape}; they need {shape}: force, torque, motors")
    return u


def lists(parameters: Mapping[str, Any]) -> dict[str, Sequence[Any]]:
    """One value for each element, by name."""
    found: dict[str, Sequence[Any]] = {}
    for name, values in table("parameters", parameters).items():
        if isinstance(values, str | bytes) or not hasattr(values, "__len__"):
            raise TypeError(
                f"`{name}` is {values!r}; it needs a list or an array, one value for each element"
            )
        if isinstance(values, Mapping | set | frozenset) or np.ndim(values) == 0:
            raise TypeError(f"`{name}` is a {type(values).__name__}; it needs a list or an array")
        found[text("the name of a parameter", name)] = list(values)
    return found


def is_of_key(diagnostic: Diagnostic, key: str) -> bool:
    """Whether an error of an override is about its key, and not about its value."""
    if diagnostic.severity != "error":
        return False
    if diagnostic.file.startswith("--set "):
        return diagnostic.column <= len(path_of(key))
    # Of a pattern, or of a component of a vector.
    return diagnostic.message.startswith("--set ")
