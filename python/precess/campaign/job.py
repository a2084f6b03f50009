"""What is computed of each sample, and one sample of it."""

from __future__ import annotations

import inspect
import math
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from typing import Any

from .. import _native
from ..errors import Error
from ..scenario import Scenario, _native_of
from .bundle import Bundle

__all__ = ["Job", "Measure", "Row", "VersionError"]

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

    def row(self, bundle: Bundle, overrides: tuple[str, ...]) -> Row:
        """Runs one sample. Whatever is wrong with it is in the row."""
        origin = bundle.laid_out()
        place = 2 if origin[0] == "file" else 4
        origin = (*origin[:place], (*origin[place], *overrides), *origin[place + 1 :])
        try:
            native = _native_of(origin)
            if self.measure is None:
                numbers, message = _native.row(native, list(self.columns), self.lines, self.start)
            else:
                measured = self.measure(Scenario._of(native, origin))
                numbers, message = [float(measured[name]) for name, _ in self.fields], None
        # A sample that raises is a row with its error: the others go on.
        except Exception as error:
            return None, bundle.shown(_line(error))
        if message is not None:
            return None, bundle.shown(message)
        if numbers is None or len(numbers) != len(self.fields):
            count = 0 if numbers is None else len(numbers)
            return None, (
                f"{count} numbers, where other samples have {len(self.fields)}; "
                "vary no key that adds columns"
            )
        return [value if math.isfinite(value) else math.nan for value in numbers], None


def rows(job: Job, bundle: Bundle, samples: list[tuple[str, ...]]) -> list[Row]:
    """The rows of some samples, one after another."""
    return [job.row(bundle, overrides) for overrides in samples]


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
