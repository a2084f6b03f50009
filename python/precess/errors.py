"""Exceptions of the package. Every one is an :class:`Error`.

Messages are those of the command line: what is wrong, where, the bound, and the remedy.
"""

from __future__ import annotations

from dataclasses import dataclass

__all__ = [
    "DerivativeError",
    "Diagnostic",
    "Error",
    "ParameterError",
    "RecordError",
    "RunError",
    "ScenarioError",
    "SignalError",
    "SolveError",
    "UnsupportedError",
]


class Error(Exception):
    """Whatever this package raises of its own."""


@dataclass(frozen=True)
class Diagnostic:
    """An error or a warning at a place of a scenario's text. Lines and columns count from 1."""

    severity: str
    file: str
    line: int
    column: int
    end_line: int
    end_column: int
    message: str
    label: str
    help: str


class ScenarioError(Error, ValueError):
    """A scenario that is rejected. The message shows every error with its place and remedy.

    Attributes
    ----------
    diagnostics : list of Diagnostic
        The same, one by one.
    """

    def __init__(self, message: str, diagnostics: str = "[]") -> None:
        super().__init__(message)
        import json

        self.diagnostics = [Diagnostic(**entry) for entry in json.loads(diagnostics)]
        self._json = diagnostics

    def __reduce__(self) -> tuple[type[ScenarioError], tuple[str, str]]:
        return type(self), (str(self), self._json)


class ParameterError(Error, ValueError):
    """Parameters that are not those of a spacecraft."""


class SolveError(Error, ArithmeticError):
    """A state and inputs that have no accelerations: singular, not finite, or of another size."""


class DerivativeError(SolveError):
    """A derivative that does not exist."""


class RunError(Error, RuntimeError):
    """A run that cannot be started, or that an error has ended.

    Attributes
    ----------
    time : float or None
        Simulated time at which it happened, s; None before the start.
    result : Result or None
        What was recorded up to there.
    """

    def __init__(self, message: str, time: float | None = None, result: object = None) -> None:
        super().__init__(message)
        self.time = time
        self.result = result

    def __reduce__(self) -> tuple[type[RunError], tuple[str, float | None, object]]:
        return type(self), (str(self), self.time, self.result)


class RecordError(Error, OSError):
    """Samples that cannot be recorded, or a file that could not be written."""


class SignalError(Error, ValueError):
    """A signal or a setting that has no spectrum or no metric."""


class UnsupportedError(Error, NotImplementedError):
    """What the library does not have for this spacecraft."""
