"""Accelerations of many states with their exact derivatives by flat states and rows of inputs: what the bridges to JAX and CasADi
are made of.

A flat state has the attitude as a quaternion ``q``, which is normalised where it is used; the linearised system has a small
rotation ``d`` about the axes of B. With ``q* dq = (s, w)``, ``d = 2 w / |q|^2``.
"""

from __future__ import annotations

import threading
from collections.abc import Sequence
from functools import cached_property
from typing import Any

import numpy as np
import numpy.typing as npt

from . import _native
from .batch import Batch
from .inputs import Inputs
from .spacecraft import Spacecraft

__all__ = ["Derivatives", "rotation_rows"]

Array = npt.NDArray[np.float64]
_QUATERNION = slice(6, 10)


class Derivatives:
    """Accelerations of a spacecraft, and their derivatives, by state and by force, torque and motors.

    Modes, gravity and wrenches are those of ``inputs``. A state that has no accelerations has NaN.
    """

    def __init__(self, spacecraft: Spacecraft, inputs: Inputs | None = None) -> None:
        self.spacecraft = spacecraft
        self.inputs = (spacecraft.inputs() if inputs is None else inputs).copy()
        self._batch = Batch(spacecraft)
        self._lock = threading.Lock()
        # Of the linearised system, which the inputs determine.
        self._places: _Places | None = None
        self.calls = {"values": 0, "derivatives": 0}
        """How often the library was called from Python, by what it computed: once for a batch."""

    @cached_property
    def jax_function(self) -> _native.NativeFunction:
        """What XLA calls, with a copy of the inputs at the first use."""
        return _native.NativeFunction(self._batch._native, self.inputs._native)

    @property
    def jax_calls(self) -> dict[str, int]:
        """How often XLA called the library: once for a batch."""
        values, derivatives = self.jax_function.calls
        return {"values": values, "derivatives": derivatives}

    @property
    def state_size(self) -> int:
        return self.spacecraft.state_size

    @property
    def input_size(self) -> int:
        """Force, torque, and a motor torque (or prescribed acceleration) of each joint."""
        return 6 + len(self.spacecraft.joints)

    @property
    def acceleration_size(self) -> int:
        return len(self.spacecraft.acceleration_names)

    def _count(self, what: str) -> None:
        with self._lock:
            self.calls[what] += 1

    def _rows(self, y: npt.ArrayLike, u: npt.ArrayLike) -> tuple[tuple[int, ...], Array, Array]:
        states, rows = np.asarray(y, dtype=np.float64), np.asarray(u, dtype=np.float64)
        shape = np.broadcast_shapes(states.shape[:-1], rows.shape[:-1])
        states = np.broadcast_to(states, (*shape, self.state_size)).reshape(-1, self.state_size)
        rows = np.broadcast_to(rows, (*shape, self.input_size)).reshape(-1, self.input_size)
        return shape, np.ascontiguousarray(states), np.ascontiguousarray(rows)

    def values(self, y: npt.ArrayLike, u: npt.ArrayLike) -> Array:
        """Accelerations, shape ``(..., accelerations)``, of states ``(..., state_size)`` and inputs ``(..., input_size)``."""
        self._count("values")
        shape, states, rows = self._rows(y, u)
        found, _ = self._batch._native.accelerations(states, self.inputs._native, rows)
        return found.reshape(*shape, self.acceleration_size)

    def jacobians(self, y: npt.ArrayLike, u: npt.ArrayLike) -> tuple[Array, Array]:
        """Derivatives of the accelerations, shapes ``(..., accelerations, state_size)`` and ``(..., accelerations, input_size)``."""
        self._count("derivatives")
        shape, states, rows = self._rows(y, u)
        found = self._batch._native.linearize(states, self.inputs._native, rows)
        outputs, by_state, by_input, c, d, _ = found
        if self._places is None:
            self._places = _Places(self, outputs, by_state, by_input)
        of_y, of_u = self._places.spread(states, c, d)
        # A state that has no derivatives has none by anything.
        failed = np.isnan(c).any(axis=(1, 2))
        of_y[failed], of_u[failed] = np.nan, np.nan
        return of_y.reshape(*shape, *of_y.shape[1:]), of_u.reshape(*shape, *of_u.shape[1:])

    def output_places(self, outputs: Sequence[str]) -> list[int]:
        """Where the rows of the linearised system are among the accelerations."""
        names = self.spacecraft.acceleration_names
        return [names.index(name) for name in outputs]

    def state_places(self, states: Sequence[str]) -> list[tuple[int, int]]:
        """Columns of C, and where they are in a flat state; the attitude apart."""
        flat = {name: place for place, name in enumerate(self.spacecraft.state_names)}
        return [(column, flat[name]) for column, name in enumerate(states) if name in flat]

    def attitude_columns(self, states: Sequence[str]) -> list[int]:
        """Columns of C by the attitude; none where nothing depends on it."""
        names = [f"attitude_{axis}" for axis in "xyz"]
        return [states.index(name) for name in names if name in states]

    def input_places(self, inputs: Sequence[str]) -> list[tuple[int, int]]:
        """Columns of D, and where they are in a row of inputs."""
        columns = {f"{what}_{axis}": 3 * k + m for k, what in enumerate(("force", "torque")) for m, axis in enumerate("xyz")}
        for place, joint in enumerate(self.spacecraft.joints):
            columns[joint.motor] = columns[joint.acceleration] = 6 + place
        return [(column, columns[name]) for column, name in enumerate(inputs) if name in columns]


class _Places:
    """Where rows and columns of the linearised system are among accelerations, flat states and rows of inputs."""

    def __init__(
        self, of: Derivatives, outputs: Sequence[str], states: Sequence[str], inputs: Sequence[str]
    ) -> None:
        self._shape_y = of.acceleration_size, of.state_size
        self._shape_u = of.acceleration_size, of.input_size
        self._rows = np.array(of.output_places(outputs), dtype=int)[:, None]
        self._states = np.array(of.state_places(states), dtype=int).reshape(-1, 2).T
        self._inputs = np.array(of.input_places(inputs), dtype=int).reshape(-1, 2).T
        self._attitude = of.attitude_columns(states)

    def spread(self, y: Array, c: Array, d: Array) -> tuple[Array, Array]:
        """Derivatives by flat states and by rows of inputs, zero where the system has no row or column."""
        of_y, of_u = np.zeros((len(y), *self._shape_y)), np.zeros((len(y), *self._shape_u))
        columns, places = self._states
        of_y[:, self._rows, places] = c[:, :, columns]
        if self._attitude:
            by_quaternion = np.einsum("nak,nkq->naq", c[:, :, self._attitude], _rotation_of(y[:, _QUATERNION]))
            of_y[:, self._rows, np.arange(6, 10)] = by_quaternion
        columns, places = self._inputs
        of_u[:, self._rows, places] = d[:, :, columns]
        return of_y, of_u


def rotation_rows(q: Any) -> list[list[Any]]:
    """``d`` by ``dq``, times ``|q|^2 / 2``: rows of components of NumPy or of JAX."""
    q0, q1, q2, q3 = q
    return [[-q1, q0, q3, -q2], [-q2, -q3, q0, q1], [-q3, q2, -q1, q0]]


def _rotation_of(q: Array) -> Array:
    """``d`` by ``dq``, shape ``(n, 3, 4)``."""
    turn = np.moveaxis(np.array(rotation_rows(q.T)), 2, 0)
    scaled: Array = 2.0 * turn / np.sum(q * q, axis=1)[:, None, None]
    return scaled
