"""Accelerations as functions of JAX, with exact derivatives.

>>> import jax
>>> jax.config.update("jax_enable_x64", True)
>>> accelerations = precess.jax.accelerations(craft)
>>> jax.jacobian(accelerations)(y, u)

Functions are called on the host. They pass ``jit``, ``vmap`` (one call of the library for all elements), ``jvp``, ``vjp`` and what is
made of them; derivatives are those of :meth:`precess.Spacecraft.linearize`, and have none of their own.
"""

from __future__ import annotations

from typing import Any, Protocol

import jax
import jax.numpy as jnp
import numpy as np

from ._derivatives import Derivatives
from .inputs import Inputs
from .spacecraft import Spacecraft

__all__ = ["Function", "accelerations", "derivative"]


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
        A rigid hub: a structure that bends has no linearised system.
    inputs : Inputs, optional
        Modes, gravity and wrenches; those of the scenario at its start by default. Force, torque and motors are ``u``, as
        :meth:`precess.Inputs.to_array`.
    of : Derivatives, optional
        What evaluates them; its ``calls`` count the calls of the library.

    ``y`` is in the order of :attr:`precess.Spacecraft.state_names`, its quaternion normalised where it is used; the result in that of
    :attr:`precess.Spacecraft.acceleration_names`. NaN where a state has no accelerations.

    Raises
    ------
    ValueError
        Where JAX has no numbers of 64 bits.
    """
    host = Derivatives(spacecraft, inputs) if of is None else of
    # A part of JAX has no types.
    untyped: Any = jax
    size, by_y, by_u = host.acceleration_size, host.state_size, host.input_size

    def call(function: Any, shapes: Any, y: Any, u: Any) -> Any:
        return jax.pure_callback(function, shapes, y, u, vmap_method="broadcast_all")

    def result(*shape: int) -> Any:
        return untyped.ShapeDtypeStruct(shape, np.float64)

    def values(y: Any, u: Any) -> Any:
        return host.values(np.asarray(y), np.asarray(u))

    def jacobians(y: Any, u: Any) -> Any:
        return host.jacobians(np.asarray(y), np.asarray(u))

    @jax.custom_jvp
    def found(y: Any, u: Any) -> Any:
        return call(values, result(size), y, u)

    @found.defjvp
    def tangent(primals: Any, tangents: Any) -> Any:
        (y, u), (dy, du) = primals, tangents
        of_y, of_u = call(jacobians, (result(size, by_y), result(size, by_u)), y, u)
        return found(y, u), of_y @ dy + of_u @ du

    def function(y: Any, u: Any) -> jax.Array:
        if not untyped.config.read("jax_enable_x64"):
            raise ValueError(
                "JAX has numbers of 32 bits; call jax.config.update('jax_enable_x64', True) at the start"
            )
        result_: jax.Array = found(jnp.asarray(y, dtype=jnp.float64), jnp.asarray(u, dtype=jnp.float64))
        return result_

    return function


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
        return slopes.at[coordinates].set(y[rates]).at[rates].set(found[6 : 6 + len(joints)])

    return function
