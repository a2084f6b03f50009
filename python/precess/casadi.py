"""Accelerations as a function of CasADi, with exact derivatives.

>>> accelerations = precess.casadi.accelerations(craft)
>>> y, u = casadi.MX.sym("y", craft.state_size), casadi.MX.sym("u", 6 + len(craft.joints))
>>> casadi.jacobian(accelerations(y, u), y)

The function is called on the host, and has first derivatives: :meth:`precess.Spacecraft.linearize`. CasADi has a second derivative, for
an exact Hessian, by differences of them.
"""

from __future__ import annotations

from typing import Any

import casadi
import numpy as np

from ._derivatives import Derivatives
from .inputs import Inputs
from .spacecraft import Spacecraft

__all__ = ["Accelerations", "accelerations"]


class _Jacobian(casadi.Callback):
    """``jac_a_y`` and ``jac_a_u``."""

    def __init__(self, name: str, of: Derivatives, options: dict[str, Any]) -> None:
        casadi.Callback.__init__(self)
        self._of = of
        # A second derivative is by differences of this one.
        self.construct(name, {**options, "enable_fd": True})

    def get_n_in(self) -> int:
        return 3

    def get_n_out(self) -> int:
        return 2

    def get_name_in(self, i: int) -> str:
        return ("y", "u", "out_a")[i]

    def get_name_out(self, i: int) -> str:
        return ("jac_a_y", "jac_a_u")[i]

    def get_sparsity_in(self, i: int) -> Any:
        sizes = (self._of.state_size, self._of.input_size, self._of.acceleration_size)
        return casadi.Sparsity.dense(sizes[i], 1)

    def get_sparsity_out(self, i: int) -> Any:
        columns = (self._of.state_size, self._of.input_size)
        return casadi.Sparsity.dense(self._of.acceleration_size, columns[i])

    def eval(self, arguments: Any) -> list[Any]:
        y, u = (np.array(of, dtype=np.float64).ravel() for of in arguments[:2])
        return [casadi.DM(of) for of in self._of.jacobians(y, u)]


class Accelerations(casadi.Callback):
    """All accelerations ``a`` of a flat state ``y`` and a row of inputs ``u``; keep it as long as it is used in expressions."""

    def __init__(self, name: str, of: Derivatives) -> None:
        casadi.Callback.__init__(self)
        self._of = of
        self._jacobians: list[_Jacobian] = []
        self.construct(name, {})

    @property
    def calls(self) -> dict[str, int]:
        """How often the library was called, by what it computed."""
        return self._of.calls

    def get_n_in(self) -> int:
        return 2

    def get_n_out(self) -> int:
        return 1

    def get_name_in(self, i: int) -> str:
        return ("y", "u")[i]

    def get_name_out(self, i: int) -> str:
        return "a"

    def get_sparsity_in(self, i: int) -> Any:
        return casadi.Sparsity.dense((self._of.state_size, self._of.input_size)[i], 1)

    def get_sparsity_out(self, i: int) -> Any:
        return casadi.Sparsity.dense(self._of.acceleration_size, 1)

    def eval(self, arguments: Any) -> list[Any]:
        y, u = (np.array(of, dtype=np.float64).ravel() for of in arguments)
        return [casadi.DM(self._of.values(y, u))]

    def has_jacobian(self) -> bool:
        return True

    def get_jacobian(self, name: str, inames: Any, onames: Any, opts: Any) -> Any:
        # CasADi does not keep a callback of Python alive.
        self._jacobians.append(_Jacobian(name, self._of, opts))
        return self._jacobians[-1]


def accelerations(
    spacecraft: Spacecraft, inputs: Inputs | None = None, name: str = "accelerations"
) -> Accelerations:
    """All accelerations as a CasADi function ``a = f(y, u)``.

    Parameters
    ----------
    spacecraft, inputs
        As of :func:`precess.jax.accelerations`, whose ``y``, ``u`` and result these are.
    name : str
        The name of the function.
    """
    return Accelerations(name, Derivatives(spacecraft, inputs))
