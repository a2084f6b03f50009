"""Controllers: what a function that is a controller of a run reads."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from typing import NamedTuple

__all__ = ["ControllerFunction", "ControllerReference", "ControllerSample"]

Vector = tuple[float, float, float]
Attitude = tuple[float, float, float, float]


class ControllerReference(NamedTuple):
    """What the hub is to follow at a sample."""

    #: Euler parameters of the reference with respect to N, scalar first.
    attitude: Attitude
    #: Its angular velocity, expressed in its own axes, rad/s.
    omega: Vector
    #: The derivative of that, rad/s².
    omega_dot: Vector


class ControllerSample(NamedTuple):
    """What a controller reads at a sample: what its sensors and its estimator, if it has any, tell."""

    #: Time of the sample, s.
    time: float
    #: Euler parameters of the hub with respect to N, scalar first.
    attitude: Attitude
    #: Angular velocity of the hub, B, rad/s.
    omega: Vector
    #: What the hub is to follow.
    reference: ControllerReference
    #: Momentum of the devices relative to the hub about B, B, N m s.
    momentum: Vector
    #: External torque by which the controller dumps momentum, B, N m.
    external: Vector
    #: Time since the sample before, s; zero at the first.
    elapsed: float
    #: Whether a command or a motor was at a limit since the sample before.
    limited: bool
    #: Coordinate and rate of each joint that it commands, rad and rad/s.
    joints: list[tuple[float, float]]
    #: What its accelerometer reads: inertial acceleration less gravity, along the axes of the hub or of its node, m/s²;
    #: none without one.
    specific_force: Vector | None = None


#: From a sample to the torque on the spacecraft about its centre of mass, B, N m: three numbers, or
#: ``{"torque": [x, y, z]}``; or to the torque of each motor, ``{"motors": [..]}``.
ControllerFunction = Callable[
    [ControllerSample], Sequence[float] | Mapping[str, Sequence[float]]
]


def _of_fields(function: ControllerFunction) -> Callable[..., object]:
    """The function of a sample as one of its fields, which is what a run calls."""

    def called(
        time: float,
        attitude: Attitude,
        omega: Vector,
        reference: tuple[Attitude, Vector, Vector],
        *others: object,
    ) -> object:
        of = ControllerReference(*reference)
        return function(ControllerSample(time, attitude, omega, of, *others))  # type: ignore[arg-type]

    return called
