"""Dynamics of spacecraft with spinning hardware, derived and proven by machine.

>>> import precess
>>> scenario = precess.Scenario.from_toml("bus.toml")
>>> result = scenario.run()
>>> result["omega_x"]

Numbers are SI and radians. Axes N are inertial, axes B those of the hub.
"""

from typing import TYPE_CHECKING, Any

from . import errors
from ._native import version as _version
from .batch import Batch, BatchLinearization, BatchRun
from .columns import Column
from .control import ControllerFunction, ControllerReference, ControllerSample
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
from .linearization import Linearization, StepLinearization
from .result import Drift, Event, Requirement, Result
from .scenario import Scenario, ScenarioWarning
from .spacecraft import (
    Accelerations,
    Joint,
    MassMatrix,
    Momentum,
    Parameter,
    Spacecraft,
)
from .state import State

if TYPE_CHECKING:
    from . import (
        campaign,
        casadi,
        fit,
        health,
        identification,
        jax,
        jitter,
        montecarlo,
        pointing,
        spectra,
        sweep,
    )
    from .health import watch
    from .identification import identify

__version__ = _version()
__all__ = [
    "Accelerations",
    "Batch",
    "BatchLinearization",
    "BatchRun",
    "Column",
    "ControllerFunction",
    "ControllerReference",
    "ControllerSample",
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
    "StepLinearization",
    "UnsupportedError",
    "campaign",
    "errors",
    "fit",
    "health",
    "identification",
    "identify",
    "jitter",
    "montecarlo",
    "pointing",
    "spectra",
    "sweep",
    "watch",
]

#: What is imported where it is first used: none of it is needed to run a scenario, and some needs other packages.
_LATER = frozenset(
    (
        "campaign",
        "casadi",
        "fit",
        "health",
        "identification",
        "jax",
        "jitter",
        "montecarlo",
        "pointing",
        "spectra",
        "sweep",
    )
)


def __getattr__(name: str) -> Any:
    if name in _LATER:
        import importlib

        return importlib.import_module(f".{name}", __name__)
    if name == "identify":
        from .identification import identify

        return identify
    if name == "watch":
        from .health import watch

        return watch
    raise AttributeError(f"module {__name__!r} has no attribute {name!r}")


def __dir__() -> list[str]:
    return sorted([*globals(), *_LATER, "identify", "watch"])
