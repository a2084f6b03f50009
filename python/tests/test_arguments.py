"""Every public function with every argument of a wrong type or value: an error that says what is wanted, or a result.

The functions are listed by the package itself: one without an example here fails the test.
"""

from __future__ import annotations

import inspect
import pickle
import types
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import precess
from argument_examples import VARY, calls
from precess import (
    campaign,
    errors,
    fit,
    health,
    identification,
    jitter,
    montecarlo,
    pointing,
    spectra,
    sweep,
)

MODULES = (
    precess,
    campaign,
    errors,
    fit,
    health,
    identification,
    jitter,
    montecarlo,
    pointing,
    spectra,
    sweep,
)
#: What is made by the package only, and records of facts, whose fields are what they are given.
NOT_CALLED = {
    "Accelerations.__init__",
    "AmplitudeSpectrum.__init__",
    "Budget.__init__",
    "Fit.__init__",
    "Fit.to_toml",
    "Identification.__init__",
    "Psd.__init__",
    "Result.__init__",
    "Samples.__init__",
    "Sweep.__init__",
    "WatchedRecord.__init__",
}
#: Needs another package, whose own errors it passes on.
OTHERS = {
    "Campaign.table",
    "Campaign.to_pandas",
    "Design.to_pandas",
    "Identification.to_pandas",
    "Result.plot",
    "Result.to_pandas",
    "Result.to_parquet",
    "Result.to_xarray",
    "WatchedRecord.alarms_to_pandas",
    "WatchedRecord.to_pandas",
    "campaign.run",
    "campaign.sobol",
}
#: What may be raised. A KeyError names what there is, an OSError a file.
RAISED = (TypeError, ValueError, KeyError, IndexError, OSError, MemoryError, precess.Error)
#: What the package itself must never say.
INTERNAL = ("_native", "NoneType' object", "has no attribute", "__float__", "no len()")

WRONG: tuple[Any, ...] = (
    object(),
    "?",
    b"?",
    -1,
    -0.5,
    10**30,
    float("nan"),
    float("-inf"),
    None,
    [],
    [[1.0]],
    ["?"],
    {},
    {"?": "?"},
    np.zeros((2, 2, 2)),
    lambda: None,
)

#: Examples that have no result: what they name is not there, or determines nothing.
NO_RESULT = {"fit.fit", "fit.fit_records", "jitter.budget", "montecarlo.sensitivities"}


@pytest.fixture
def folder(wheels: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    (tmp_path / "one.toml").write_text(wheels, encoding="utf-8")
    monkeypatch.chdir(tmp_path)
    return tmp_path


def public() -> Iterator[str]:
    """The names of all public functions, and of all methods of public classes."""
    seen = set()
    for module in MODULES:
        for name in module.__all__:
            of = getattr(module, name)
            if isinstance(of, types.FunctionType):
                yield f"{module.__name__.removeprefix('precess.')}.{name}"
            if not isinstance(of, type) or issubclass(of, Exception | Warning) or of in seen:
                continue
            seen.add(of)
            for cls in of.__mro__:
                if not cls.__module__.startswith("precess"):
                    continue
                for method, function in vars(cls).items():
                    called = isinstance(function, types.FunctionType | classmethod | staticmethod)
                    is_field = method == "__init__" and hasattr(of, "__dataclass_fields__")
                    shown = method in ("__init__", "__getitem__", "__setitem__")
                    if called and (shown or not method.startswith("_")) and not is_field:
                        yield f"{of.__name__}.{method}"


def test_every_public_function_has_an_example(wheels: str, folder: Path) -> None:
    missing = {*public()} - calls(wheels).keys() - NOT_CALLED - OTHERS
    assert not missing
    for name, (function, arguments) in calls(wheels).items():
        if name not in NO_RESULT:
            function(**arguments)
        parameters = inspect.signature(function).parameters
        kinds = (inspect.Parameter.VAR_KEYWORD, inspect.Parameter.VAR_POSITIONAL)
        named = {of for of, parameter in parameters.items() if parameter.kind not in kinds}
        hidden = {"native"}
        assert named - hidden <= arguments.keys(), f"{name}: {named - arguments.keys()}"


def test_a_wrong_argument_is_an_error_that_says_what_is_wanted(wheels: str, folder: Path) -> None:
    failures = []
    for name, (function, arguments) in calls(wheels).items():
        for parameter in arguments:
            for wrong in WRONG:
                try:
                    function(**{**arguments, parameter: wrong})
                except RAISED as error:
                    says_little = not str(error) or any(words in str(error) for words in INTERNAL)
                    found = error if says_little else None
                except BaseException as error:
                    found = error
                else:
                    found = None
                if found is not None:
                    what = f"{name}({parameter}={wrong!r})"
                    failures.append(f"{what}: {type(found).__name__}: {found}")
    assert not failures, "\n".join(failures)


def test_setters_reject_what_they_cannot_take(wheels: str) -> None:
    craft = precess.Scenario.from_text(wheels).spacecraft
    state, inputs = craft.initial_state(), craft.inputs()
    for of in (state, inputs):
        before = pickle.dumps(of)
        setters = [
            name
            for name, member in vars(type(of)).items()
            if isinstance(member, property) and member.fset is not None
        ]
        assert len(setters) >= 5
        for name in setters:
            for wrong in WRONG:
                rejected = True
                try:
                    setattr(of, name, wrong)
                    rejected = False
                except RAISED as error:
                    assert not [words for words in INTERNAL if words in str(error)], f"{name}: {error}"
                if rejected:
                    # Numbers that cannot be assigned are not assigned in part.
                    assert pickle.dumps(of) == before, f"{name} = {wrong!r}"
                else:
                    of = pickle.loads(before)
    for place, wrong in (("wheel1.u_w", "?"), ("wheel1.u_w", None), (3, 0.1), ("?", 0.1)):
        with pytest.raises((TypeError, KeyError)):
            inputs.motors[place] = wrong  # type: ignore[index,assignment]


@pytest.fixture
def craft(wheels: str) -> precess.Spacecraft:
    return precess.Scenario.from_text(wheels).spacecraft


def test_messages_name_argument_value_and_what_is_wanted(craft: precess.Spacecraft) -> None:
    state = craft.initial_state()
    wrong: Any = 3
    with pytest.raises(TypeError, match=r"inputs is 3, a int; it needs precess\.Inputs, or None"):
        craft.accelerations(state, wrong)
    with pytest.raises(ValueError, match="steps is -1; it needs at least 0"):
        craft.step(state, 1e-3, steps=-1)
    with pytest.raises(ValueError, match="steps is -2; it needs at least 0"):
        precess.Batch(craft).run(precess.Batch(craft).states(2), 1e-3, -2)
    with pytest.raises(TypeError, match="parameters is 'hub.m_b', a str; it needs a list of texts"):
        craft.linearize(state, parameters="hub.m_b")
    with pytest.raises(ValueError, match=r"state has the shape \(2,\); it needs \(17,\)"):
        craft.energy([0.0, 1.0])
    with pytest.raises(ValueError, match="samples is -1; it needs at least 0"):
        montecarlo.run(craft.scenario, VARY, -1)
    with pytest.raises(TypeError, match="scenario is 3, a int; it needs a precess.Scenario"):
        precess.Spacecraft(wrong)
