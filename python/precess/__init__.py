"""Dynamics of spacecraft with spinning hardware, derived and proven by machine.

>>> import precess
>>> scenario = precess.Scenario.from_toml("bus.toml")
>>> result = scenario.run()
>>> result["omega_x"]

Numbers are SI and radians. Axes N are inertial, axes B those of the hub.
"""

from . import errors
from ._native import version as _version
from .batch import Batch, BatchRun
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
from .inputs import Inputs
from .result import Drift, Event, Requirement, Result
from .scenario import Scenario, ScenarioWarning
from .spacecraft import (
    Accelerations,
    Joint,
    Linearization,
    MassMatrix,
    Momentum,
    Parameter,
    Spacecraft,
)
from .state import State

__version__ = _version()
__all__ = [
    "Accelerations",
    "Batch",
    "BatchRun",
    "Column",
    "DerivativeError",
    "Drift",
    "Error",
    "Event",
    "Inputs",
    "Joint",
    "Linearization",
    "MassMatrix",
    "Momentum",
    "Parameter",
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
    "Spacecraft",
    "State",
    "UnsupportedError",
    "errors",
]
