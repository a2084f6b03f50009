"""What is computed of each sample, and samples of it."""

from __future__ import annotations

import inspect
import math
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from typing import Any, TypeVar

from .. import _native
from .._native import NativeScenario
from ..errors import Error
from ..scenario import Scenario, _native_of
from .bundle import Bundle

__all__ = ["Job", "Measure", "Row", "VersionError", "in_groups"]

T = TypeVar("T")

#: A function of a scenario that returns numbers by name.
Measure = Callable[[Scenario], Mapping[str, float]]

#: The numbers of a sample, or why there are none.
Row = tuple[list[float] | None, str | None]


class VersionError(Error):
    """A worker has another version of the package than the client."""


@dataclass(frozen=True)
class Job:
    """What is computed of each sample.

    Attributes
    ----------
    columns, lines, start
        Columns or vectors of which RMS, peak and the strongest lines are computed, from a time on, s.
    fields : tuple of (name, unit)
        The numbers of a row.
    measure : callable or None
        What computes them instead, of the scenario of a sample.
    version : str
        That of the package.
    """

    columns: tuple[str, ...]
    lines: int
    start: float
    fields: tuple[tuple[str, str], ...]
    measure: Measure | None
    version: str

    def identity(self) -> str:
        """Everything that a row depends on beside scenario and sample."""
        facts = (self.version, self.columns, self.lines, self.start, self.fields)
        return f"{facts!r} {_source(self.measure)}"

    def rows(self, bundle: Bundle, samples: Sequence[tuple[str, ...]]) -> list[Row]:
        """Runs samples, as many at a time as take the least time. Whatever is wrong with one is in its row."""
        found: list[Row] = [(None, None)] * len(samples)
        read: list[tuple[int, NativeScenario]] = []
        for place, overrides in enumerate(samples):
            origin = bundle.laid_out()
            at = 2 if origin[0] == "file" else 4
            origin = (*origin[:at], (*origin[at], *overrides), *origin[at + 1 :])
            # A sample that raises is a row with its error: the others go on.
            try:
                native = _native_of(origin)
                if self.measure is None:
                    read.append((place, native))
                else:
                    measured = self.measure(Scenario._of(native, origin))
                    numbers = [float(measured[name]) for name, _ in self.fields]
                    found[place] = self._checked(bundle, numbers, None)
            except Exception as error:
                found[place] = None, bundle.shown(_line(error))
        columns = list(self.columns)
        for group in in_groups(read, 1):
            natives = [native for _, native in group]
            rows = _native.rows(natives, columns, self.lines, self.start)
            for (place, _), (row, message) in zip(group, rows, strict=True):
                found[place] = self._checked(bundle, row, message)
        return found

    def _checked(self, bundle: Bundle, numbers: list[float] | None, message: str | None) -> Row:
        if message is not None:
            return None, bundle.shown(message)
        if numbers is None or len(numbers) != len(self.fields):
            count = 0 if numbers is None else len(numbers)
            return None, (
                f"{count} numbers, where other samples have {len(self.fields)}; "
                "vary no key that adds columns"
            )
        return [value if math.isfinite(value) else math.nan for value in numbers], None


def in_groups(samples: Sequence[T], threads: int) -> list[Sequence[T]]:
    """As many samples as take the least time together; fewer where threads would have nothing to do."""
    size = min(_native.side_by_side(), max(1, math.ceil(len(samples) / threads)))
    return [samples[start : start + size] for start in range(0, len(samples), size)]


def _line(error: Exception) -> str:
    """The error in one line: a diagnostic also shows where in the text."""
    diagnostics = getattr(error, "diagnostics", None)
    if diagnostics:
        return str(diagnostics[0].message)
    return f"{type(error).__name__}: {error}".splitlines()[0]


def _source(measure: Measure | None) -> str:
    """Name and text of a function: another text is another campaign."""
    if measure is None:
        return ""
    try:
        text: Any = inspect.getsource(measure)
    except (OSError, TypeError):
        code = getattr(measure, "__code__", None)
        text = (code.co_code, code.co_consts, code.co_names) if code else repr(type(measure))
    return f"{getattr(measure, '__qualname__', type(measure).__qualname__)} {text!r}"
