"""Dynamics of spacecraft with spinning hardware, derived and proven by machine.

>>> import precess
>>> scenario = precess.Scenario.from_toml("bus.toml")
>>> result = scenario.run()
>>> result["omega_x"]

Numbers are SI and radians. Axes N are inertial, axes B those of the hub.
"""

import logging

from . import errors
from ._native import version as _version
from .columns import Column
from .errors import (
    DerivativeError,
    Error,
    ParameterError,
    RecordError,
    RunError,
    ScenarioError,
    SignalError,
    SolveError,
    UnsupportedError,
)
from .result import Drift, Event, Requirement, Result
from .scenario import Scenario, ScenarioWarning

__version__ = _version()
__all__ = [
    "Column",
    "DerivativeError",
    "Drift",
    "Error",
    "Event",
    "ParameterError",
    "RecordError",
    "Requirement",
    "Result",
    "RunError",
    "Scenario",
    "ScenarioError",
    "ScenarioWarning",
    "SignalError",
    "SolveError",
    "UnsupportedError",
    "errors",
]

# Quiet until a program configures logging.
logging.getLogger("precess").addHandler(logging.NullHandler())
