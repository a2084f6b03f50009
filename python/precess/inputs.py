"""Inputs of a spacecraft: forces, torques and modes at one instant."""

from __future__ import annotations

from collections.abc import Callable, Iterator, MutableMapping
from typing import TYPE_CHECKING, Any

import numpy as np

from . import _native
from ._wanted import instance, number

if TYPE_CHECKING:
    import numpy.typing as npt

    from .spacecraft import Spacecraft

    Array = npt.NDArray[np.float64]

__all__ = ["Inputs"]


class _PerJoint(MutableMapping[str, Any]):
    """Values of the joints by name."""

    def __init__(
        self, names: dict[str, int], read: Callable[[], list[Any]], write: Callable[[list[Any]], None]
    ) -> None:
        self._names, self._read, self._write = names, read, write

    def _place(self, name: str) -> int:
        if name not in self._names:
            raise KeyError(f"no joint has `{name}`; there are {', '.join(self._names)}")
        return self._names[name]

    def __getitem__(self, name: str) -> Any:
        return self._read()[self._place(name)]

    def __setitem__(self, name: str, value: Any) -> None:
        values = self._read()
        values[self._place(name)] = value
        self._write(values)

    def __delitem__(self, name: str) -> None:
        raise TypeError("the joints of inputs are those of their spacecraft")

    def __iter__(self) -> Iterator[str]:
        return iter(self._names)

    def __len__(self) -> int:
        return len(self._names)

    def __repr__(self) -> str:
        return repr(dict(self))


class Inputs:
    """Forces, torques and modes, held during a step. Made by :meth:`Spacecraft.inputs`."""

    __slots__ = ("_native", "_spacecraft")

    def __init__(self, spacecraft: Spacecraft, native: _native.NativeInputs | None = None) -> None:
        from .spacecraft import Spacecraft

        self._spacecraft = instance("spacecraft", spacecraft, Spacecraft, "a precess.Spacecraft")
        self._native = native if native is not None else spacecraft._native.no_inputs()

    @property
    def force(self) -> Array:
        """External force through B, in B, N, a copy, shape ``(3,)``."""
        return np.array(self._native.force)

    @force.setter
    def force(self, value: npt.ArrayLike) -> None:
        self._native.force = _three(value)

    @property
    def torque(self) -> Array:
        """External torque about B, in B, N m, a copy, shape ``(3,)``."""
        return np.array(self._native.torque)

    @torque.setter
    def torque(self, value: npt.ArrayLike) -> None:
        self._native.torque = _three(value)

    @property
    def motors(self) -> MutableMapping[str, float]:
        """Motor torques (forces) by the names of motors, ``cmg1.u_w``, N m or N."""
        native = self._native

        def write(values: list[float]) -> None:
            native.motors = [number("a motor", value) for value in values]

        return _PerJoint(self._spacecraft._motor_places, lambda: native.motors.tolist(), write)

    @property
    def modes(self) -> MutableMapping[str, Any]:
        """Mode of each joint by the name of its coordinate: ``"driven"``, ``"locked"``, or an acceleration.

        A number is a prescribed acceleration, rad/s² or m/s².
        """
        native = self._native

        def read() -> list[Any]:
            return [number if mode == "prescribed" else mode for mode, number in native.modes]

        def write(values: list[Any]) -> None:
            native.modes = [
                (value, 0.0) if isinstance(value, str) else ("prescribed", number("a mode", value))
                for value in values
            ]

        return _PerJoint(self._spacecraft._coordinate_places, read, write)

    @property
    def hub(self) -> str | tuple[Array, Array]:
        """Mode of the hub: ``"free"``, ``"fixed"``, or its accelerations, in B, m/s² and rad/s²."""
        mode, acceleration, omega_dot = self._native.hub
        return (np.array(acceleration), np.array(omega_dot)) if mode == "prescribed" else mode

    @hub.setter
    def hub(self, value: str | tuple[npt.ArrayLike, npt.ArrayLike]) -> None:
        zero = [0.0] * 3
        if isinstance(value, str):
            self._native.hub = (value, zero, zero)
            return
        if not isinstance(value, tuple | list) or len(value) != 2:
            raise TypeError(
                f"hub is {value!r}; it needs a text, or a tuple of two vectors: acceleration, angular acceleration"
            )
        self._native.hub = ("prescribed", _three(value[0]), _three(value[1]))

    @property
    def gravity(self) -> Array | float | None:
        """A uniform field, in N, m/s², shape ``(3,)``; a central body's parameter, m³/s²; None."""
        uniform, mu = self._native.gravity
        return np.array(uniform) if uniform is not None else mu

    @gravity.setter
    def gravity(self, value: npt.ArrayLike | None) -> None:
        if value is None:
            self._native.gravity = (None, None)
        elif np.ndim(value) == 0:
            self._native.gravity = (None, float(np.asarray(value)))
        else:
            self._native.gravity = (_three(value), None)

    @property
    def wrenches(self) -> Array | None:
        """Force, N, and moment, N m, on the child body of each joint, shape ``(joints, 6)``; None without.

        Moments are about the joint's origin, both in the body's own axes.
        """
        return self._native.wrenches

    @wrenches.setter
    def wrenches(self, value: npt.ArrayLike | None) -> None:
        shape = (len(self._spacecraft.joints), 6)
        self._native.wrenches = None if value is None else _of_shape("wrenches", value, shape)

    @property
    def modal(self) -> Array:
        """Modal forces on a structure, N/sqrt(kg), a copy, shape ``(modes,)``."""
        return self._native.modal

    @modal.setter
    def modal(self, value: npt.ArrayLike) -> None:
        self._native.modal = _of_shape("modal", value, self._native.modal.shape)

    def to_array(self) -> Array:
        """Force, torque, and for each joint its motor torque or prescribed acceleration, shape ``(6 + joints,)``."""
        numbers = [
            number if mode == "prescribed" else motor
            for (mode, number), motor in zip(self._native.modes, self._native.motors, strict=True)
        ]
        return np.array([*self._native.force, *self._native.torque, *numbers])

    def copy(self) -> Inputs:
        """Other inputs with the same values."""
        return Inputs(self._spacecraft, self._native.copy())

    def _facts(self) -> dict[str, Any]:
        native = self._native
        return {
            "force": list(native.force),
            "torque": list(native.torque),
            "motors": native.motors.tolist(),
            "modes": native.modes,
            "hub": native.hub,
            "gravity": native.gravity,
            "wrenches": None if native.wrenches is None else native.wrenches.tolist(),
            "modal": native.modal.tolist(),
        }

    def __eq__(self, other: object) -> bool:
        if not isinstance(other, Inputs):
            return NotImplemented
        return self._spacecraft == other._spacecraft and self._facts() == other._facts()

    __hash__ = None  # type: ignore[assignment]

    def __reduce__(self) -> tuple[Callable[..., Inputs], tuple[Spacecraft, dict[str, Any]]]:
        return _unpickled, (self._spacecraft, self._facts())

    def __repr__(self) -> str:
        shown = [f"force={self.force.tolist()}", f"torque={self.torque.tolist()}"]
        shown += [f"{name}={value:g}" for name, value in self.motors.items() if value != 0.0]
        shown += [f"{name}: {mode}" for name, mode in self.modes.items() if mode != "driven"]
        return f"<precess.Inputs {', '.join(shown)}>"


def _unpickled(spacecraft: Spacecraft, facts: dict[str, Any]) -> Inputs:
    inputs = Inputs(spacecraft)
    for name, value in facts.items():
        setattr(inputs._native, name, value)
    return inputs


def _three(value: npt.ArrayLike) -> list[float]:
    listed: list[float] = _of_shape("a vector", value, (3,))
    return listed


def _of_shape(name: str, value: npt.ArrayLike, shape: tuple[int, ...]) -> list[Any]:
    numbers = np.asarray(value, dtype=np.float64)
    if numbers.shape != shape:
        raise ValueError(f"{name} has the shape {numbers.shape}; it needs {shape}")
    listed: list[Any] = numbers.tolist()
    return listed
