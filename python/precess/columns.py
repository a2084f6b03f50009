"""Columns: the quantities of a scenario and of a result, by name."""

from __future__ import annotations

from dataclasses import dataclass

__all__ = ["Column"]


@dataclass(frozen=True)
class Column:
    """A quantity with its unit, frame and meaning.

    Attributes
    ----------
    name : str
        ``omega_x``, ``cmg1.theta``.
    unit : str
        Its SI unit; ``1`` of a pure number.
    frame : str or None
        The axes that it is a component in: ``N``, ``B``, ``cmg1.wheel``.
    meaning : str
        What it is.
    group : str
        The group that it belongs to: ``omega``, ``cmg1``.
    vector : str or None
        The vector that it is a component of: ``omega``.
    """

    name: str
    unit: str
    frame: str | None
    meaning: str
    group: str
    vector: str | None
