"""Batches: many states of a spacecraft, or of as many spacecraft whose parameters differ."""

from __future__ import annotations

import warnings
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np

from . import _native
from ._backend import is_cuda, warn_of
from ._batch_arguments import is_of_key, lists, rows_of_inputs, table_of, threads_of, written
from ._wanted import finite, function, instance, names, number, whole
from .errors import ParameterError, ScenarioError
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
    in_lanes : bool, optional
        Whether several states are evaluated at a time within a core, where lanes support the devices.
    backend : {"cpu", "cuda"}, optional
        Where :meth:`accelerations` and :meth:`run` compute: on the processor, or on a GPU of NVIDIA, with the same
        bits. Without a GPU, its driver, NVRTC or ``precess-bake`` the processor does, and a ``RuntimeWarning``
        says why. Everything else is computed on the processor.

    Numbers do not depend on threads or on the other elements: they have the bits of
    :meth:`Spacecraft.accelerations` and :meth:`Spacecraft.step`. Devices of one kind on a rigid hub are
    evaluated in lanes (:attr:`in_lanes`), others one by one.

    Raises
    ------
    KeyError
        A name that is neither a parameter of the spacecraft nor a key of the scenario, with the nearest
        ones. A value that is wrong is an error of its element, in :attr:`errors`.
    ValueError
        Parameters of different lengths, another backend.
    UnsupportedError
        A flexible structure, a platform, a panel that carries devices or a lumped imbalance on a GPU; a GPU in a
        build without the feature ``cuda``.

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
        backend: str = "cpu",
    ) -> None:
        from .scenario import Scenario

        cuda = is_cuda(backend)

        if isinstance(spacecraft, Scenario):
            spacecraft = spacecraft.spacecraft
        wanted = "a precess.Spacecraft or precess.Scenario"
        self._spacecraft = instance("spacecraft", spacecraft, Spacecraft, wanted)
        self._rejected: Errors = {}
        self.errors: Errors = {}
        given = {} if parameters is None else lists(parameters)
        counts = {name: len(values) for name, values in given.items()}
        if len(set(counts.values())) > 1:
            raise ValueError(f"parameters of different lengths: {counts}")
        self._count = next(iter(counts.values()), None)
        known = self._spacecraft.parameters
        keys = {name: values for name, values in given.items() if name not in known}
        for key, values in keys.items():
            self._check_key(key, values)
        rows = None
        if len(keys) < len(given):
            columns = [self._column(name, given[name]) for name in given if name in known]
            rows = ([name for name in given if name in known], np.column_stack(columns))
        scenarios = self._scenarios(keys) if keys else None
        native = _native.NativeBatch
        self._native = native(self._spacecraft._native, rows, scenarios, bool(in_lanes), cuda)
        self._fallback = warn_of(self._native.fallback, None, 2)
        # Of keys also before a call: no state is needed to know that they are wrong.
        self.errors = dict(self._rejected)

    def _check_key(self, key: str, values: Sequence[Any]) -> None:
        """Rejects a key that the scenario does not have, whatever its values are."""
        try:
            with warnings.catch_warnings():
                warnings.simplefilter("ignore", ScenarioWarning)
                self._spacecraft.scenario.with_values({key: values[0] if len(values) else 0.0})
        except ScenarioError as error:
            unknown = [of for of in error.diagnostics if is_of_key(of, key)]
            if not unknown:
                return
            import difflib

            known = list(self._spacecraft.parameters)
            near = difflib.get_close_matches(key, known, n=3, cutoff=0.6)
            hints = [of.help for of in unknown if of.help]
            hints += [f"nearest parameters: {', '.join(near)}"] if near else []
            raise KeyError(
                f"`{key}` is neither a parameter of the spacecraft nor a key of its scenario: "
                + "; ".join([unknown[0].message, *hints])
            ) from None

    def _column(self, name: str, values: Sequence[Any]) -> Array:
        """The numbers of a parameter, NaN where a value is none."""
        column = np.full(len(values), np.nan)
        for index, value in enumerate(values):
            try:
                column[index] = number(f"`{name}` of element {index}", value)
            except (TypeError, ValueError) as error:
                self._rejected.setdefault(index, ParameterError(str(error)))
        return column

    def _scenarios(self, keys: Mapping[str, Any]) -> list[_native.NativeScenario]:
        scenario = self._spacecraft.scenario
        found = []
        with warnings.catch_warnings():
            warnings.simplefilter("ignore", ScenarioWarning)
            for index in range(self._count or 0):
                values = {key: values[index] for key, values in keys.items()}
                try:
                    found.append(scenario.with_values(values)._native)
                except (ScenarioError, TypeError, ValueError) as error:
                    self._rejected.setdefault(index, error)
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
        count = self._count if n is None else whole("n", n)
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
        of_threads, progress = threads_of(threads), function("progress", progress)
        found, failures = self._native.accelerations(y, base, u, of_threads, progress)
        self._note(failures, [found])
        return found

    def linearize(
        self,
        states: npt.ArrayLike | Sequence[State],
        inputs: Inputs | npt.ArrayLike | None = None,
        threads: int | None = None,
        out: tuple[Array, Array] | None = None,
    ) -> BatchLinearization:
        """Derivatives of all accelerations of each state, exact to rounding, as :meth:`Spacecraft.linearize`.

        Parameters
        ----------
        states, inputs, threads
            As of :meth:`accelerations`.
        out : tuple of two arrays, optional
            What is written, and returned as ``C`` and ``D``: those of an earlier result, so that nothing is allocated.

        Spacecraft that differ are each linearised with their own parameters, not in lanes.
        """
        y, base, u = self._given(states, inputs)
        given = None if out is None else written(out)
        found = self._native.linearize(y, base, u, threads_of(threads), given)
        outputs, of_states, of_inputs, by_state, by_input, failures = found
        self._note(failures, [by_state, by_input])
        return BatchLinearization(
            tuple(outputs), tuple(of_states), tuple(of_inputs), by_state, by_input
        )

    def jvp(
        self,
        states: npt.ArrayLike | Sequence[State],
        dx: npt.ArrayLike | None = None,
        du: npt.ArrayLike | None = None,
        inputs: Inputs | npt.ArrayLike | None = None,
        threads: int | None = None,
    ) -> Array:
        """What the accelerations of each state change by along a direction, ``C dx + D du``, shape ``(n, outputs)``.

        Parameters
        ----------
        dx : array, shape (n, states), optional
            The direction of the states as :meth:`linearize` names them, the attitude as a small rotation; zero by default.
        du : array, shape (n, inputs), optional
            That of the inputs; zero by default.
        states, inputs, threads
            As of :meth:`accelerations`.

        Exact to rounding, at the cost of some evaluations and without a matrix: for one direction of a state. Of several
        directions, matrices cost less.
        """
        y, base, u = self._given(states, inputs)
        dx, du = (None if of is None else table_of(name, of) for name, of in (("dx", dx), ("du", du)))
        found, failures = self._native.jvp(y, base, dx, du, u, threads_of(threads))
        self._note(failures, [found])
        return found

    def vjp(
        self,
        states: npt.ArrayLike | Sequence[State],
        weights: npt.ArrayLike,
        inputs: Inputs | npt.ArrayLike | None = None,
        threads: int | None = None,
    ) -> tuple[Array, Array]:
        """The gradient of the weighted sum of the accelerations of each state, ``C' w`` and ``D' w``.

        Parameters
        ----------
        weights : array, shape (n, outputs)
            In the order of the outputs of :meth:`linearize`.
        states, inputs, threads
            As of :meth:`accelerations`.

        Returns
        -------
        arrays, shapes (n, states) and (n, inputs)
            By the states and inputs as :meth:`linearize` names them.
        """
        y, base, u = self._given(states, inputs)
        weights = table_of("weights", weights)
        by_state, by_input, failures = self._native.vjp(y, base, weights, u, threads_of(threads))
        self._note(failures, [by_state, by_input])
        return by_state, by_input

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
        dt, steps, reduce = finite("dt", dt), whole("steps", steps), names("reduce", reduce)
        every = None if every is None else whole("every", every, 1)
        of_threads, progress = threads_of(threads), function("progress", progress)
        keep = (every is not None and not reduce) if history is None else bool(history)
        stride = every or (1 if reduce or keep else max(steps, 1))
        if keep:
            # Memory for them: a MemoryError, or nothing.
            np.empty((len(y), steps // stride + 1, self._spacecraft.state_size))
        final, samples, reduced, failures = self._native.run(
            y, base, u, dt, steps, stride, keep, reduce, of_threads, progress
        )
        all_rows = [final, *reduced] + ([samples] if samples is not None else [])
        self._note(failures, all_rows)
        time = np.arange(0, steps // stride + 1, dtype=np.float64) * (stride * dt)
        named = dict(zip(reduce, reduced, strict=True))
        return BatchRun(final, time, samples, named, dict(self.errors))

    def _given(
        self, states: npt.ArrayLike | Sequence[State], inputs: Inputs | npt.ArrayLike | None
    ) -> tuple[Array, _native.NativeInputs, Array | None]:
        try:
            y = np.atleast_2d(np.asarray(states, dtype=np.float64))
        except TypeError:
            raise TypeError(
                f"states are a {type(states).__name__}; they need an array of shape (n, state_size), or a "
                "list of precess.State"
            ) from None
        size = self._spacecraft.state_size
        if y.ndim != 2 or y.shape[1] != size:
            raise ValueError(f"states have the shape {y.shape}; they need (n, {size})")
        if isinstance(inputs, Inputs):
            return y, inputs._native, None
        base = self._spacecraft.inputs()._native
        if inputs is None:
            return y, base, None
        return y, base, rows_of_inputs(inputs, (len(y), 6 + len(self._spacecraft.joints)))

    def _note(self, failures: list[tuple[int, Any]], rows: list[Array]) -> None:
        self.errors = dict(failures) | self._rejected
        self._fallback = warn_of(self._native.fallback, self._fallback, 3)
        for index in self._rejected:
            for array in rows:
                array[index] = np.nan

    def __repr__(self) -> str:
        count = "any number of states" if self._count is None else f"{self._count} spacecraft"
        how = "in lanes" if self.in_lanes else "one by one"
        return f"<precess.Batch of {self._spacecraft.scenario.name!r}: {count}, {how}>"
