"""Spacecraft: accelerations, loads, energy, derivatives and steps at any state."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np

from . import _native
from ._wanted import instance, names, number, whole
from .columns import Column
from .inputs import Inputs
from .linearization import Linearization, StepLinearization
from .state import State

if TYPE_CHECKING:
    import numpy.typing as npt

    from .scenario import Scenario

    Array = npt.NDArray[np.float64]
    StateLike = State | npt.ArrayLike

__all__ = [
    "Accelerations",
    "Joint",
    "MassMatrix",
    "Momentum",
    "Parameter",
    "Spacecraft",
]


@dataclass(frozen=True)
class Joint:
    """A joint: the names of its body, coordinate, rate, acceleration and motor, with their units."""

    body: str
    coordinate: str
    rate: str
    acceleration: str
    motor: str
    units: tuple[str, str, str, str]
    slides: bool
    driven: bool


@dataclass(frozen=True)
class Parameter:
    """A number of hub or devices that derivatives are taken by.

    ``value`` is None of what a data sheet states and a rotation, which have only derivatives.
    """

    name: str
    unit: str
    meaning: str
    value: float | None


@dataclass(frozen=True)
class Momentum:
    """Linear momentum, kg m/s, and angular momentum, kg m²/s, in N, each of shape ``(3,)``."""

    linear: Array
    angular: Array


class Accelerations(Mapping[str, float]):
    """All accelerations, by name and as vectors.

    ``found["cmg1.spin_dot"]`` is one number; ``np.asarray(found)`` all of them in order.
    """

    def __init__(self, names: Sequence[str], array: Array) -> None:
        self._names, self._array = tuple(names), array

    @property
    def r_ddot(self) -> Array:
        """Inertial acceleration of B, in B, m/s², shape ``(3,)``."""
        return self._array[0:3]

    @property
    def omega_dot(self) -> Array:
        """Angular acceleration of the hub, in B, rad/s², shape ``(3,)``."""
        return self._array[3:6]

    def to_array(self) -> Array:
        """All in the order of the names, shape ``(6 + joints + modes,)``."""
        return self._array

    def __array__(self, dtype: npt.DTypeLike | None = None, copy: bool | None = None) -> Array:
        return np.array(self._array, dtype=dtype)

    def __getitem__(self, name: str) -> float:
        if name not in self._names:
            raise KeyError(f"no acceleration is named `{name}`; there are {', '.join(self._names)}")
        return float(self._array[self._names.index(name)])

    def __iter__(self) -> Any:
        return iter(self._names)

    def __len__(self) -> int:
        return len(self._names)

    def __repr__(self) -> str:
        pairs = ", ".join(f"{name}={value:.6g}" for name, value in self.items())
        return f"<precess.Accelerations {pairs}>"


@dataclass(frozen=True)
class MassMatrix:
    """``matrix @ a + bias = [F, L_B, u]``.

    Attributes
    ----------
    coordinates : tuple of str
        Names of ``a``: acceleration of B and of the hub, both in B, then of each joint with a motor, and of each
        modal coordinate.
    matrix : array, shape (n, n)
        kg, kg m, kg m²; one for a mode, and sqrt(kg), m sqrt(kg) beside it.
    bias : array, shape (n,)
        N, N m, N/sqrt(kg): Coriolis and centrifugal, gravity, springs, dampers and friction, stiffness and damping of
        modes, wrenches on bodies.
    """

    coordinates: tuple[str, ...]
    matrix: Array
    bias: Array


class Spacecraft:
    """The spacecraft of a scenario, evaluated at any state.

    A state is a :class:`State` or an array of shape ``(state_size,)`` in the order of
    :attr:`state_names`; quaternions are normalised where they are used. Inputs are those of
    :meth:`inputs` where none are given: what acts by the scenario at its start.
    """

    def __init__(self, scenario: Scenario) -> None:
        from .scenario import Scenario

        self._scenario = instance("scenario", scenario, Scenario, "a precess.Scenario")
        self._native = _native.NativeEvaluator(scenario._native)
        self._columns = tuple(Column(*facts) for facts in self._native.state_columns)
        self._joints = tuple(Joint(*facts) for facts in self._native.joints)
        self._places = {column.name: place for place, column in enumerate(self._columns)}
        pairs = [(joint.coordinate, joint.rate) for joint in self._joints]
        self._joint_places = {name: self._places[name] for pair in pairs for name in pair}
        self._motor_places = {joint.motor: place for place, joint in enumerate(self._joints)}
        self._coordinate_places = {
            joint.coordinate: place for place, joint in enumerate(self._joints)
        }
        first = 13 + 2 * len(self._joints)
        modes = (len(self._columns) - first) // 2
        self._modal = (slice(first, first + modes), slice(first + modes, first + 2 * modes))
        self._acceleration_names = tuple(self._native.acceleration_names)

    @property
    def scenario(self) -> Scenario:
        """The scenario that it is of."""
        return self._scenario

    @property
    def mass(self) -> float:
        """Mass of hub and devices, kg."""
        return self._native.mass

    @property
    def joints(self) -> tuple[Joint, ...]:
        """The joints in order."""
        return self._joints

    @property
    def state_size(self) -> int:
        """How many numbers a state has: 13 of the hub, two of each joint, two of each mode."""
        return len(self._columns)

    @property
    def state_names(self) -> tuple[str, ...]:
        """The names of a state's numbers, as columns of a run have them."""
        return tuple(self._places)

    @property
    def state_columns(self) -> tuple[Column, ...]:
        """The same with units, frames and meanings."""
        return self._columns

    @property
    def acceleration_names(self) -> tuple[str, ...]:
        """The names of all accelerations, in order."""
        return self._acceleration_names

    @property
    def parameters(self) -> dict[str, Parameter]:
        """The numbers of hub and devices by name, for :meth:`linearize` and :class:`Batch`."""
        return {facts[0]: Parameter(*facts) for facts in self._native.parameters}

    def _place(self, name: str) -> int:
        if name not in self._places:
            raise KeyError(f"no number of the state is `{name}`; there are {', '.join(self._places)}")
        return self._places[name]

    def initial_state(self) -> State:
        """The initial state of the scenario."""
        return State(self, self._native.initial())

    def state(self, values: Mapping[str, npt.ArrayLike] | None = None) -> State:
        """A state at rest, with these numbers: ``{"cmg1.spin": 300.0, "omega": [0, 0, 0.1]}``."""
        return State(self, self._native.at_rest()).replace({} if values is None else values)

    def inputs(self, time: float = 0.0, state: StateLike | None = None) -> Inputs:
        """What acts by the scenario at a time, s: gravity, drives, wrenches, sources of disturbance.

        Drives are those from the start: changes at later times and limits of joints are made by a run.
        """
        y = self._native.initial() if state is None else self._flat(state)
        return Inputs(self, self._native.inputs(number("time", time), y))

    def no_inputs(self) -> Inputs:
        """No force, torque or gravity, motors off, every joint in the mode of its kind, a free hub."""
        return Inputs(self)

    def _acting(self, y: Array, inputs: Inputs | None) -> _native.NativeInputs:
        if inputs is None:
            return self._native.inputs(0.0, y)
        return instance("inputs", inputs, Inputs, "precess.Inputs, or None")._native

    def _flat(self, state: StateLike) -> Array:
        """The numbers of a state."""
        if isinstance(state, State):
            array = state._array
        else:
            try:
                array = np.asarray(state, dtype=np.float64)
            except TypeError:
                raise TypeError(
                    f"state is a {type(state).__name__}; it needs a precess.State, or {self.state_size} numbers"
                ) from None
        if array.shape != (self.state_size,):
            raise ValueError(
                f"state has the shape {array.shape}; it needs ({self.state_size},), the numbers of state_names"
            )
        return array

    def accelerations(self, state: StateLike, inputs: Inputs | None = None) -> Accelerations:
        """All accelerations.

        Raises
        ------
        SolveError
            A state that is singular or not finite, inputs that are not finite.
        """
        y = self._flat(state)
        found = self._native.accelerations(y, self._acting(y, inputs))
        return Accelerations(self._acceleration_names, found)

    def mass_matrix_and_bias(self, state: StateLike, inputs: Inputs | None = None) -> MassMatrix:
        """Mass matrix and bias of a free hub with every motor driven.

        Raises
        ------
        SolveError
            A pose that has no accelerations.
        """
        y = self._flat(state)
        names, matrix, bias = self._native.mass_matrix(y, self._acting(y, inputs))
        return MassMatrix(tuple(names), matrix, bias)

    def energy(self, state: StateLike) -> float:
        """Kinetic energy of hub and devices, J. See :meth:`ledger` for potential energies."""
        return self._native.energy_and_momentum(self._flat(state), "origin")[0]

    def momentum(self, state: StateLike, about: str = "origin") -> Momentum:
        """Linear and angular momentum, in N; about the inertial ``origin`` or the ``centre_of_mass``."""
        _, linear, angular = self._native.energy_and_momentum(self._flat(state), about)
        return Momentum(linear, angular)

    def ledger(self, state: StateLike, inputs: Inputs | None = None) -> dict[str, float]:
        """The energy ledger: ``kinetic``, ``gravity``, ``springs`` and their sum ``energy``, J;
        ``kinetic_rate`` and the power of each source (``power_motors`` ...), W; ``residual``, W."""
        y = self._flat(state)
        return dict(self._native.ledger(y, self._acting(y, inputs)))

    def loads(self, state: StateLike, inputs: Inputs | None = None) -> dict[str, float]:
        """Loads at mounts and joints, N and N m, by the names of columns (``cmg1.mount.force_x``), and
        the motor torque or force of each joint (``cmg1.u_w``): what its motion requires where that is
        prescribed. At a mount they are about the ``position`` of the device or platform, which no joint
        of it moves, in B or in the axes of the platform that carries it."""
        y = self._flat(state)
        loads, motors = self._native.loads(y, self._acting(y, inputs))
        columns = [facts[0] for facts in self._native.load_columns]
        found = dict(zip(columns, loads.tolist(), strict=True))
        return found | dict(zip(self._motor_places, motors.tolist(), strict=True))

    def linearize(
        self,
        state: StateLike,
        inputs: Inputs | None = None,
        momentum: str | None = None,
        loads: bool = False,
        parameters: Sequence[str] = (),
    ) -> Linearization:
        """The linearised system, exact to rounding.

        Parameters
        ----------
        momentum : {"origin", "centre_of_mass"}, optional
            Adds kinetic energy and momenta to the outputs, the angular one about this point.
        loads : bool
            Adds the loads on joints and hub to the outputs.
        parameters : sequence of str
            Names of :attr:`parameters`: columns ``P`` and ``Q``.

        Raises
        ------
        SolveError, DerivativeError
        UnsupportedError
            Parameters of a flexible structure.
        """
        y = self._flat(state)
        acting = self._acting(y, inputs)
        by = names("parameters", parameters)
        found = self._native.linearize(y, acting, momentum, bool(loads), by)
        states, of_inputs, outputs, by, matrices = found
        return Linearization(tuple(states), tuple(of_inputs), tuple(outputs), tuple(by), *matrices)

    def step(
        self, state: StateLike, dt: float, inputs: Inputs | None = None, steps: int = 1
    ) -> State:
        """The state after ``steps`` steps of RK4 of ``dt`` s, inputs held."""
        y = self._flat(state)
        acting, count = self._acting(y, inputs), whole("steps", steps)
        return State(self, self._native.step(y, acting, number("dt", dt), count))

    def linearize_step(
        self,
        state: StateLike,
        dt: float,
        inputs: Inputs | None = None,
        steps: int = 1,
        parameters: Sequence[str] = (),
    ) -> StepLinearization:
        """Derivatives of ``steps`` steps of RK4 of ``dt`` s, inputs held: those of :meth:`step`, not of the motion it
        approximates.

        Parameters
        ----------
        parameters : sequence of str
            Names of :attr:`parameters`: columns ``P``.

        Raises
        ------
        SolveError, DerivativeError
        UnsupportedError
            Parameters of a flexible structure.
        """
        y = self._flat(state)
        found = self._native.linearize_steps(
            y,
            self._acting(y, inputs),
            number("dt", dt),
            whole("steps", steps),
            names("parameters", parameters),
        )
        reached, states, of_inputs, by, matrices = found
        return StepLinearization(
            State(self, reached), tuple(states), tuple(of_inputs), tuple(by), *matrices
        )

    def derivative(self, t: float, y: npt.ArrayLike, inputs: Inputs | None = None) -> Array:
        """Time derivative of a flat state, a right-hand side for ``scipy.integrate.solve_ivp``.

        Without inputs it has what acts by the scenario at the time ``t``, as :meth:`inputs`. The
        attitude is a quaternion, whose norm an integrator need not keep.
        """
        y, time = self._flat(y), number("t", t)
        acting = None if inputs is None else self._acting(y, inputs)
        return self._native.derivative(time, y, acting)

    def __eq__(self, other: object) -> bool:
        if not isinstance(other, Spacecraft):
            return NotImplemented
        return self._scenario == other._scenario

    def __hash__(self) -> int:
        return hash(self._scenario)

    def __reduce__(self) -> tuple[type[Spacecraft], tuple[Scenario]]:
        return Spacecraft, (self._scenario,)

    def __repr__(self) -> str:
        return (
            f"<precess.Spacecraft of {self._scenario.name!r}: {self.mass:g} kg, "
            f"{len(self._joints)} joints>"
        )
