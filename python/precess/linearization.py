"""Linearised systems: of accelerations, and of steps."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from .state import State

if TYPE_CHECKING:
    import numpy.typing as npt

    Array = npt.NDArray[np.float64]

__all__ = ["Linearization", "StepLinearization"]


@dataclass(frozen=True)
class Linearization:
    """A spacecraft linearised about a state and inputs, exact to rounding::

        x' = f + A dx + B du + P dp        y = g + C dx + D du + Q dp

    The attitude in ``dx`` is a small rotation about the axes of B (``attitude_x``): states have one
    number fewer than a :class:`State`. What does not move is no state: those of a fixed hub and of
    locked joints. Of a flexible structure modal coordinates and their rates are states, and modal forces
    (``modes.force_1``) and wrenches on the mounts, by their nodes (``tip.force_x``), inputs.

    Attributes
    ----------
    states, inputs, outputs, parameters : tuple of str
        Names of rows and columns.
    A, B, C, D, P, Q : arrays
        Derivatives.
    """

    states: tuple[str, ...]
    inputs: tuple[str, ...]
    outputs: tuple[str, ...]
    parameters: tuple[str, ...]
    A: Array
    B: Array
    C: Array
    D: Array
    P: Array
    Q: Array

    def element(self, row: str, column: str) -> float:
        """The derivative of an output, or of the rate of a state, by a state, input or parameter."""
        rows = [(self.outputs, (self.C, self.D, self.Q)), (self.states, (self.A, self.B, self.P))]
        columns = (self.states, self.inputs, self.parameters)
        for names, matrices in rows:
            for column_names, matrix in zip(columns, matrices, strict=True):
                if row in names and column in column_names:
                    return float(matrix[names.index(row), column_names.index(column)])
        raise KeyError(f"no derivative of `{row}` by `{column}`")


@dataclass(frozen=True)
class StepLinearization:
    """Steps of RK4 linearised about a state and inputs, which are held, exact to rounding::

        x1 = F + A dx + B du + P dp

    The attitude in ``dx`` is a small rotation about the axes of B before the steps, in the change of ``x1`` one about those
    after them. Matrices of steps one after the other are the product: ``A = A2 @ A1``, ``B = A2 @ B1 + B2``.

    Zero by structure in ``A``: of columns by position and velocity, rows of the attitude, of ``omega`` and of the joints,
    except in a central field; of columns by the attitude, without gravity, rows of ``omega`` and of the joints; of the column
    by the angle of a balanced wheel, all rows but its own.

    Attributes
    ----------
    state : State
        The state after the steps: that of :meth:`Spacecraft.step`, to the bit.
    states, inputs, parameters : tuple of str
        Names of rows and columns, as of :class:`Linearization`.
    A, B, P : arrays, shapes (states, states), (states, inputs) and (states, parameters)
        Derivatives of the state after the steps.
    """

    state: State
    states: tuple[str, ...]
    inputs: tuple[str, ...]
    parameters: tuple[str, ...]
    A: Array
    B: Array
    P: Array
