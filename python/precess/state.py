"""States of a spacecraft: one flat array, read and written by name."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, MutableMapping
from typing import TYPE_CHECKING

import numpy as np

from ._wanted import instance, table

if TYPE_CHECKING:
    import numpy.typing as npt

    from .spacecraft import Spacecraft

    Array = npt.NDArray[np.float64]

__all__ = ["Joints", "State"]


class Joints(MutableMapping[str, float]):
    """Coordinates and rates of the joints by name: ``joints["cmg1.theta"]``, rad, m, rad/s or m/s."""

    def __init__(self, state: State) -> None:
        self._state = state

    def __getitem__(self, name: str) -> float:
        return float(self._state._array[self._place(name)])

    def __setitem__(self, name: str, value: float) -> None:
        self._state._array[self._place(name)] = value

    def __delitem__(self, name: str) -> None:
        raise TypeError("the joints of a state are those of its spacecraft")

    def __iter__(self) -> Iterator[str]:
        return iter(self._state._spacecraft._joint_places)

    def __len__(self) -> int:
        return len(self._state._spacecraft._joint_places)

    def _place(self, name: str) -> int:
        places = self._state._spacecraft._joint_places
        if name not in places:
            raise KeyError(f"no joint has `{name}`; there are {', '.join(places)}")
        return places[name]

    def __repr__(self) -> str:
        return repr(dict(self))


class State:
    """A state of a spacecraft. Attributes are views of one array: writing to them changes the state.

    ``state["omega_x"]`` and ``state["cmg1.theta"]`` are single numbers by the names of columns,
    :attr:`joints` those of the joints.
    """

    __slots__ = ("_array", "_spacecraft")

    def __init__(self, spacecraft: Spacecraft, array: npt.ArrayLike) -> None:
        from .spacecraft import Spacecraft

        instance("spacecraft", spacecraft, Spacecraft, "a precess.Spacecraft")
        numbers = np.array(array, dtype=np.float64)
        if numbers.shape != (spacecraft.state_size,):
            raise ValueError(
                f"a state has the shape {numbers.shape}; it needs ({spacecraft.state_size},)"
            )
        self._spacecraft = spacecraft
        self._array = numbers

    @property
    def r(self) -> Array:
        """Position of B from the inertial origin, in N, m, shape ``(3,)``."""
        return self._array[0:3]

    @r.setter
    def r(self, value: npt.ArrayLike) -> None:
        self._array[0:3] = value

    @property
    def v(self) -> Array:
        """Inertial velocity of B, in N, m/s, shape ``(3,)``."""
        return self._array[3:6]

    @v.setter
    def v(self, value: npt.ArrayLike) -> None:
        self._array[3:6] = value

    @property
    def quaternion(self) -> Array:
        """Attitude of B with respect to N, scalar first, shape ``(4,)``. Normalised where it is used."""
        return self._array[6:10]

    @quaternion.setter
    def quaternion(self, value: npt.ArrayLike) -> None:
        self._array[6:10] = value

    @property
    def mrp(self) -> Array:
        """The same as modified Rodrigues parameters ``sigma_{B/N}``, a copy, shape ``(3,)``.

        The inner of the two sets: ``|sigma| <= 1``. Assigning sets the quaternion.
        """
        q = self._array[6:10] / np.linalg.norm(self._array[6:10])
        if q[0] < 0.0:
            q = -q
        sigma: Array = q[1:] / (1.0 + q[0])
        return sigma

    @mrp.setter
    def mrp(self, value: npt.ArrayLike) -> None:
        sigma = np.asarray(value, dtype=np.float64)
        if sigma.shape != (3,):
            raise ValueError(f"mrp has the shape {sigma.shape}; it needs (3,)")
        square = float(sigma @ sigma)
        self._array[6] = (1.0 - square) / (1.0 + square)
        self._array[7:10] = 2.0 * sigma / (1.0 + square)

    @property
    def omega(self) -> Array:
        """Angular velocity of the hub, in B, rad/s, shape ``(3,)``."""
        return self._array[10:13]

    @omega.setter
    def omega(self, value: npt.ArrayLike) -> None:
        self._array[10:13] = value

    @property
    def joints(self) -> Joints:
        """Coordinates and rates of the joints by name."""
        return Joints(self)

    @property
    def modal(self) -> Array:
        """Coordinates of a structure's modes, m kg^1/2; empty on a rigid hub, shape ``(modes,)``."""
        return self._array[self._spacecraft._modal[0]]

    @property
    def modal_rates(self) -> Array:
        """Their rates, m kg^1/2/s, shape ``(modes,)``."""
        return self._array[self._spacecraft._modal[1]]

    def __getitem__(self, name: str) -> float:
        return float(self._array[self._spacecraft._place(name)])

    def __setitem__(self, name: str, value: float) -> None:
        self._array[self._spacecraft._place(name)] = value

    def to_array(self) -> Array:
        """A copy as one array, in the order of :attr:`Spacecraft.state_names`, shape ``(state_size,)``."""
        return self._array.copy()

    @classmethod
    def from_array(cls, spacecraft: Spacecraft, array: npt.ArrayLike) -> State:
        """The state of numbers in the order of :attr:`Spacecraft.state_names`."""
        return cls(spacecraft, array)

    def copy(self) -> State:
        """Another state with the same numbers."""
        return State(self._spacecraft, self._array)

    def replace(self, values: Mapping[str, npt.ArrayLike]) -> State:
        """A copy with numbers replaced: ``{"cmg1.spin": 300.0, "omega": [0, 0, 0.1]}``."""
        other = self.copy()
        for name, value in table("values", values).items():
            if name in ("r", "v", "quaternion", "mrp", "omega"):
                setattr(other, name, value)
            else:
                other[name] = float(np.asarray(value, dtype=np.float64))
        return other

    def __array__(self, dtype: npt.DTypeLike | None = None, copy: bool | None = None) -> Array:
        return np.array(self._array, dtype=dtype)

    def __eq__(self, other: object) -> bool:
        if not isinstance(other, State):
            return NotImplemented
        return self._spacecraft == other._spacecraft and bool(
            np.array_equal(self._array, other._array)
        )

    __hash__ = None  # type: ignore[assignment]

    def __reduce__(self) -> tuple[type[State], tuple[Spacecraft, Array]]:
        return State, (self._spacecraft, self._array)

    def __repr__(self) -> str:
        pairs = zip(self._spacecraft.state_names, self._array, strict=True)
        moving = ", ".join(f"{name}={value:.6g}" for name, value in pairs if value != 0.0)
        return f"<precess.State {moving or 'at rest'}>"
