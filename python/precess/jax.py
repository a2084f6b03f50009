"""Accelerations as functions of JAX, with exact derivatives.

>>> import jax
>>> jax.config.update("jax_enable_x64", True)
>>> accelerations = precess.jax.accelerations(craft)
>>> jax.jacobian(accelerations)(y, u)

Functions are foreign functions of XLA on the CPU: they read and write its buffers, without Python. They pass ``jit``, ``vmap`` (one
call of the library for all elements), ``jvp``, ``vjp`` and what is made of them; derivatives are those of
:meth:`precess.Spacecraft.linearize`, and have none of their own.
"""

from __future__ import annotations

import functools
from typing import Any, Protocol

import jax
import jax.numpy as jnp
import numpy as np

from . import _native
from ._derivatives import Derivatives, rotation_rows
from .inputs import Inputs
from .spacecraft import Spacecraft

__all__ = ["Function", "accelerations", "derivative"]

#: A part of JAX has no types.
_jax: Any = jax


class Function(Protocol):
    """A function of a flat state, shape ``(state_size,)``, and a row of inputs, shape ``(6 + joints,)``."""

    def __call__(self, y: Any, u: Any) -> jax.Array: ...


def accelerations(
    spacecraft: Spacecraft, inputs: Inputs | None = None, *, of: Derivatives | None = None
) -> Function:
    """All accelerations as a function ``f(y, u)``.

    Parameters
    ----------
    spacecraft : Spacecraft
        What is evaluated.
    inputs : Inputs, optional
        Modes, gravity and wrenches; those of the scenario at its start by default. Force, torque and motors are ``u``, as
        :meth:`precess.Inputs.to_array`.
    of : Derivatives, optional
        What evaluates them; its ``jax_calls`` count the calls of the library.

    ``y`` is in the order of :attr:`precess.Spacecraft.state_names`, its quaternion normalised where it is used; the result in that of
    :attr:`precess.Spacecraft.acceleration_names`. NaN where a state has no accelerations. Keep the function as long as anything that was
    compiled of it is called.

    Raises
    ------
    ValueError
        Where JAX has no numbers of 64 bits.
    """
    _register()
    host = Derivatives(spacecraft, inputs) if of is None else of
    native = host.jax_function

    @functools.cache
    def system() -> _System:
        return _System(host)

    def call(name: str, shapes: Any, y: Any, u: Any) -> Any:
        foreign = _jax.ffi.ffi_call(name, shapes, vmap_method="broadcast_all")
        return foreign(y, u, number=np.int64(native.number))

    def result(*shape: int) -> Any:
        return _jax.ShapeDtypeStruct(shape, np.float64)

    @jax.custom_jvp
    def found(y: Any, u: Any) -> Any:
        return call("precess_accelerations", result(host.acceleration_size), y, u)

    @found.defjvp
    def tangent(primals: Any, tangents: Any) -> Any:
        (y, u), (dy, du) = primals, tangents
        rows, states, inputs = system().sizes
        shapes = (result(rows, states), result(rows, inputs))
        c, d = call("precess_linearize", shapes, y, u)
        return found(y, u), system().tangent(c, d, y, dy, du)

    def function(y: Any, u: Any) -> jax.Array:
        if not _jax.config.read("jax_enable_x64"):
            raise ValueError(
                "JAX has numbers of 32 bits; call jax.config.update('jax_enable_x64', True) at the start"
            )
        result_: jax.Array = found(jnp.asarray(y, dtype=jnp.float64), jnp.asarray(u, dtype=jnp.float64))
        return result_

    return function


@functools.cache
def _register() -> None:
    for name, address in _native.xla_functions():
        _jax.ffi.register_ffi_target(name, _jax.ffi.pycapsule(address), platform="cpu")


class _System:
    """The linearised system, applied to tangents of a flat state and of a row of inputs."""

    def __init__(self, of: Derivatives) -> None:
        outputs, states, inputs = of.jax_function.linearized
        self.sizes = len(outputs), len(states), len(inputs)
        self._size = of.acceleration_size
        self._outputs = np.array(of.output_places(outputs), dtype=int)
        self._states = np.array(of.state_places(states), dtype=int).reshape(-1, 2)
        self._inputs = np.array(of.input_places(inputs), dtype=int).reshape(-1, 2)
        self._attitude = np.array(of.attitude_columns(states), dtype=int)

    def tangent(self, c: Any, d: Any, y: Any, dy: Any, du: Any) -> Any:
        """``C dx + D dw`` as accelerations, zero where the system has no row; NaN by every number where there is no system."""
        dx = jnp.zeros(self.sizes[1]).at[self._states[:, 0]].set(dy[self._states[:, 1]], unique_indices=True)
        if len(self._attitude):
            q = y[6:10]
            turn = jnp.array(rotation_rows(q))
            dx = dx.at[self._attitude].set(2.0 / jnp.dot(q, q) * (turn @ dy[6:10]), unique_indices=True)
        dw = jnp.zeros(self.sizes[2]).at[self._inputs[:, 0]].set(du[self._inputs[:, 1]], unique_indices=True)
        value = jnp.zeros(self._size).at[self._outputs].set(c @ dx + d @ dw, unique_indices=True)
        none = jnp.where(jnp.isnan(c).any(), jnp.nan, 0.0)
        return value + none * (dy.sum() + du.sum())


def derivative(
    spacecraft: Spacecraft, inputs: Inputs | None = None, *, of: Derivatives | None = None
) -> Function:
    """Time derivative of a flat state as a function ``f(y, u)``, for integrators of JAX. See :func:`accelerations`.

    The quaternion has the rate of its direction; its norm is kept.
    """
    solved = accelerations(spacecraft, inputs, of=of)
    places = {name: place for place, name in enumerate(spacecraft.state_names)}
    joints = spacecraft.joints
    coordinates = np.array([places[joint.coordinate] for joint in joints], dtype=int)
    rates = np.array([places[joint.rate] for joint in joints], dtype=int)
    modal, modal_rates = spacecraft._modal

    def function(y: Any, u: Any) -> jax.Array:
        y = jnp.asarray(y, dtype=jnp.float64)
        found = solved(y, u)
        q, omega = y[6:10], y[10:13]
        unit = q / jnp.linalg.norm(q)
        scalar, vector = unit[0], unit[1:]
        turned = jnp.cross(vector, found[0:3])
        # From B to N: v + 2 q0 (q x v) + 2 q x (q x v).
        acceleration = found[0:3] + 2.0 * scalar * turned + 2.0 * jnp.cross(vector, turned)
        q_dot = 0.5 * jnp.concatenate(
            [-jnp.dot(q[1:], omega)[None], q[0] * omega + jnp.cross(q[1:], omega)]
        )
        slopes = jnp.zeros_like(y).at[0:3].set(y[3:6]).at[3:6].set(acceleration)
        slopes = slopes.at[6:10].set(q_dot).at[10:13].set(found[3:6])
        slopes = slopes.at[coordinates].set(y[rates]).at[rates].set(found[6 : 6 + len(joints)])
        return slopes.at[modal].set(y[modal_rates]).at[modal_rates].set(found[6 + len(joints) :])

    return function
