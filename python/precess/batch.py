"""Batches: many states of a spacecraft, or of as many spacecraft whose parameters differ."""

from __future__ import annotations

import warnings
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np

from . import _native
from .errors import ScenarioError
from .inputs import Inputs
from .scenario import ScenarioWarning
from .spacecraft import Spacecraft
from .state import State

if TYPE_CHECKING:
    import numpy.typing as npt

    from .scenario import Scenario

    Array = npt.NDArray[np.float64]

__all__ = ["Batch", "BatchLinearization", "BatchRun"]

Errors = dict[int, Exception]


@dataclass(frozen=True)
class BatchRun:
    """What a run of a batch returned.

    Attributes
    ----------
    final : array, shape (n, state_size)
        The states at the end; NaN of an element that failed.
    time : array, shape (samples,)
        Times of the samples, s.
    history : array, shape (n, samples, state_size), or None
        The states after every so many steps, the first one included.
    reduced : dict
        ``"min"``, ``"max"``, ``"mean"``, ``"rms"`` of those samples, each of shape ``(n, state_size)``.
    errors : dict
        The exception of each element that failed, by its index.
    """

    final: Array
    time: Array
    history: Array | None
    reduced: dict[str, Array]
    errors: Errors


@dataclass(frozen=True)
class BatchLinearization:
    """Derivatives of the accelerations of many states, as :class:`Linearization` has them.

    Attributes
    ----------
    outputs, states, inputs : tuple of str
        Names of rows and columns.
    C, D : arrays, shapes (n, outputs, states) and (n, outputs, inputs)
        Derivatives by states and by inputs; NaN of an element that failed.
    """

    outputs: tuple[str, ...]
    states: tuple[str, ...]
    inputs: tuple[str, ...]
    C: Array
    D: Array


class Batch:
    """Many states at a time: in lanes within a core, on threads across, without the interpreter's lock.

    Parameters
    ----------
    spacecraft : Spacecraft or Scenario
        What is evaluated.
    parameters : mapping, optional
        What differs: ``{"hub.m_b": array(n), "wheel1.d": array(n)}`` by the names of
        :attr:`Spacecraft.parameters`, or by keys of the scenario, ``{"device.wheel1.wheel.mass":
        array(n)}``, which are read for each element and take longer to prepare.

    Numbers do not depend on threads or on the other elements: they have the bits of
    :meth:`Spacecraft.accelerations` and :meth:`Spacecraft.step`. Devices of one kind on a rigid hub are
    evaluated in lanes (:attr:`in_lanes`), others one by one.

    Attributes
    ----------
    errors : dict
        The exception of each element that failed in the last call, by its index; its rows are NaN.
    """

    def __init__(
        self,
        spacecraft: Spacecraft | Scenario,
        parameters: Mapping[str, Array | Sequence[Any]] | None = None,
        in_lanes: bool = True,
    ) -> None:
        if not isinstance(spacecraft, Spacecraft):
            spacecraft = spacecraft.spacecraft
        self._spacecraft = spacecraft
        self._rejected: Errors = {}
        self.errors: Errors = {}
        numbers: dict[str, Any] = {}
        keys: dict[str, Any] = {}
        known = spacecraft.parameters
        for name, values in (parameters or {}).items():
            (numbers if name in known else keys)[name] = values
        counts = {name: len(values) for name, values in (parameters or {}).items()}
        if len(set(counts.values())) > 1:
            raise ValueError(f"parameters of different lengths: {counts}")
        self._count = next(iter(counts.values()), None)
        rows = None
        if numbers:
            columns = [np.asarray(values, dtype=np.float64) for values in numbers.values()]
            rows = (list(numbers), np.column_stack(columns))
        scenarios = self._scenarios(keys) if keys else None
        self._native = _native.NativeBatch(spacecraft._native, rows, scenarios, in_lanes)

    def _scenarios(self, keys: Mapping[str, Any]) -> list[_native.NativeScenario]:
        scenario = self._spacecraft.scenario
        found = []
        with warnings.catch_warnings():
            warnings.simplefilter("ignore", ScenarioWarning)
            for index in range(self._count or 0):
                values = {key: values[index] for key, values in keys.items()}
                try:
                    found.append(scenario.with_values(values)._native)
                except ScenarioError as error:
                    self._rejected[index] = error
                    found.append(scenario._native)
        return found

    @property
    def spacecraft(self) -> Spacecraft:
        """What is evaluated."""
        return self._spacecraft

    @property
    def in_lanes(self) -> bool:
        """Whether several states are evaluated at a time within a core."""
        return self._native.is_laned

    def states(self, n: int | None = None) -> Array:
        """The initial state of the scenario ``n`` times, to be changed, shape ``(n, state_size)``."""
        count = self._count if n is None else n
        if count is None:
            raise ValueError("how many states is not known: give n")
        return np.tile(self._spacecraft.initial_state().to_array(), (count, 1))

    def accelerations(
        self,
        states: npt.ArrayLike | Sequence[State],
        inputs: Inputs | npt.ArrayLike | None = None,
        threads: int | None = None,
        progress: Callable[[float], object] | None = None,
    ) -> Array:
        """All accelerations of each state, shape ``(n, accelerations)``.

        Parameters
        ----------
        states : array, shape (n, state_size)
            In the order of :attr:`Spacecraft.state_names`.
        inputs : Inputs, or array, shape (n, 6 + joints)
            The same for all; or for each force, torque, and motor torques (prescribed accelerations),
            as :meth:`Inputs.to_array`. What acts by the scenario at its start by default.
        threads : int, optional
            All cores by default.
        progress : callable, optional
            Called with the share that is done, 0 to 1.
        """
        y, base, u = self._given(states, inputs)
        found, failures = self._native.accelerations(y, base, u, threads or 0, progress)
        self._note(failures, [found])
        return found

    def linearize(
        self,
        states: npt.ArrayLike | Sequence[State],
        inputs: Inputs | npt.ArrayLike | None = None,
        threads: int | None = None,
    ) -> BatchLinearization:
        """Derivatives of all accelerations of each state, exact to rounding, as :meth:`Spacecraft.linearize`.

        Raises
        ------
        UnsupportedError
            Spacecraft that differ, a structure that bends.
        """
        y, base, u = self._given(states, inputs)
        found = self._native.linearize(y, base, u, threads or 0)
        outputs, of_states, of_inputs, by_state, by_input, failures = found
        self._note(failures, [by_state, by_input])
        return BatchLinearization(
            tuple(outputs), tuple(of_states), tuple(of_inputs), by_state, by_input
        )

    def run(
        self,
        states: npt.ArrayLike | Sequence[State],
        dt: float,
        steps: int,
        inputs: Inputs | npt.ArrayLike | None = None,
        every: int | None = None,
        history: bool | None = None,
        reduce: Sequence[str] = (),
        threads: int | None = None,
        progress: Callable[[float], object] | None = None,
    ) -> BatchRun:
        """Steps of RK4 of ``dt`` s, inputs held.

        Parameters
        ----------
        every : int, optional
            After how many steps a state is a sample; by default of one step where samples are reduced.
        history : bool, optional
            Whether samples are kept: by default where ``every`` is given and nothing is reduced.
        reduce : sequence of {"min", "max", "mean", "rms"}
            What samples are reduced to on the way; memory does not grow with the steps.

        Ctrl-C ends it between parts and segments of steps, and raises ``KeyboardInterrupt``.
        """
        y, base, u = self._given(states, inputs)
        keep = (every is not None and not reduce) if history is None else history
        stride = every or (1 if reduce or keep else max(steps, 1))
        final, samples, reduced, failures = self._native.run(
            y, base, u, dt, steps, stride, keep, list(reduce), threads or 0, progress
        )
        all_rows = [final, *reduced] + ([samples] if samples is not None else [])
        self._note(failures, all_rows)
        time = np.arange(0, steps // stride + 1, dtype=np.float64) * (stride * dt)
        named = dict(zip(reduce, reduced, strict=True))
        return BatchRun(final, time, samples, named, dict(self.errors))

    def _given(
        self, states: npt.ArrayLike | Sequence[State], inputs: Inputs | npt.ArrayLike | None
    ) -> tuple[Array, _native.NativeInputs, Array | None]:
        y = np.atleast_2d(np.asarray(states, dtype=np.float64))
        if isinstance(inputs, Inputs):
            return y, inputs._native, None
        base = self._spacecraft.inputs()._native
        return y, base, None if inputs is None else np.asarray(inputs, dtype=np.float64)

    def _note(self, failures: list[tuple[int, Any]], rows: list[Array]) -> None:
        self.errors = dict(failures) | self._rejected
        for index in self._rejected:
            for array in rows:
                array[index] = np.nan

    def __repr__(self) -> str:
        count = "any number of states" if self._count is None else f"{self._count} spacecraft"
        how = "in lanes" if self.in_lanes else "one by one"
        return f"<precess.Batch of {self._spacecraft.scenario.name!r}: {count}, {how}>"
