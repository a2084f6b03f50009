//! [`Quantity`]: what a column shows.

use super::control::ControlQuantity;

/// What a column shows: of an axis 0 to 2, of a joint, device or platform by its number in the set.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Quantity {
    Time,
    Position(usize),
    Velocity(usize),
    HubAcceleration(usize),
    Quaternion(usize),
    Sigma(usize),
    /// Rotation vector from the reference attitude.
    HubRotation(usize),
    /// Roll, pitch, yaw from N.
    EulerAngle(usize),
    /// Roll, pitch, yaw from the orbital frame.
    OrbitAngle(usize),
    OrbitOmega(usize),
    Omega(usize),
    OmegaDot(usize),
    Coordinate(usize),
    Rate(usize),
    JointAcceleration(usize),
    Torque(usize),
    /// Friction that sticks, and drag.
    Friction(usize),
    Energy,
    Work,
    Lost,
    Linear(usize),
    Angular(usize),
    /// Angular momentum about the centre of mass.
    CentreMomentum(usize),
    MountForce(usize, usize),
    MountMoment(usize, usize),
    CarriedForce(usize, usize),
    CarriedMoment(usize, usize),
    LoadForce(usize, usize),
    LoadMoment(usize, usize),
    ModalCoordinate(usize),
    ModalRate(usize),
    Displacement(usize, usize),
    Rotation(usize, usize),
    PointSigma(usize, usize),
    PointOmega(usize, usize),
    PointAcceleration(usize, usize),
    /// Of a point of a body.
    BodyPointPosition(usize, usize),
    BodyPointVelocity(usize, usize),
    BodyPointAcceleration(usize, usize),
    /// Of a disturbance: a component of force, 0 to 2, or moment, 3 to 5.
    Disturbance(usize, usize),
    /// Of a controller.
    Control(usize, ControlQuantity),
}

/// What a quantity is read from.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Source {
    /// Time, state and sums that are integrated: nothing is evaluated.
    State,
    Accelerations,
    Motors,
    Loads,
    Energy,
    Momentum,
    CentreMomentum,
    /// Place and velocity of a point of the structure.
    PointMotion(usize),
    PointAcceleration(usize),
    Disturbances,
    /// Reference of a controller, and what it computed last.
    Control,
}

impl Quantity {
    /// What it is read from.
    pub(crate) fn source(&self) -> Source {
        match *self {
            Self::Time
            | Self::Position(_)
            | Self::Velocity(_)
            | Self::Quaternion(_)
            | Self::Sigma(_)
            | Self::HubRotation(_)
            | Self::EulerAngle(_)
            | Self::OrbitAngle(_)
            | Self::OrbitOmega(_)
            | Self::Omega(_)
            | Self::Coordinate(_)
            | Self::Rate(_)
            | Self::Work
            | Self::Lost
            | Self::ModalCoordinate(_)
            | Self::ModalRate(_)
            | Self::BodyPointPosition(..)
            | Self::BodyPointVelocity(..) => Source::State,
            Self::HubAcceleration(_)
            | Self::OmegaDot(_)
            | Self::JointAcceleration(_)
            | Self::BodyPointAcceleration(..) => Source::Accelerations,
            Self::Torque(_) | Self::Friction(_) => Source::Motors,
            Self::Energy => Source::Energy,
            Self::Linear(_) | Self::Angular(_) => Source::Momentum,
            Self::CentreMomentum(_) => Source::CentreMomentum,
            Self::MountForce(..)
            | Self::MountMoment(..)
            | Self::CarriedForce(..)
            | Self::CarriedMoment(..)
            | Self::LoadForce(..)
            | Self::LoadMoment(..) => Source::Loads,
            Self::Displacement(point, _)
            | Self::Rotation(point, _)
            | Self::PointSigma(point, _)
            | Self::PointOmega(point, _) => Source::PointMotion(point),
            Self::PointAcceleration(point, _) => Source::PointAcceleration(point),
            Self::Disturbance(..) => Source::Disturbances,
            Self::Control(..) => Source::Control,
        }
    }

    pub(crate) fn is_load(&self) -> bool {
        self.source() == Source::Loads
    }

    /// Whether it is recorded where a scenario selects nothing.
    pub(super) fn is_default(&self) -> bool {
        let selected = matches!(
            self,
            Self::HubRotation(_)
                | Self::EulerAngle(_)
                | Self::OrbitAngle(_)
                | Self::OrbitOmega(_)
                | Self::CentreMomentum(_)
        );
        !self.is_load() && !selected
    }

    /// Whether the accelerations of the spacecraft are needed.
    pub(crate) fn is_acceleration(&self) -> bool {
        matches!(self.source(), Source::Accelerations | Source::PointAcceleration(_))
    }

    /// Whether frames of bodies and lines of wheels are computed from it.
    pub(super) fn is_of_frames(&self) -> bool {
        matches!(
            self,
            Self::Position(_) | Self::Quaternion(_) | Self::Coordinate(_) | Self::Rate(_)
        )
    }

    /// Whether it is part of the state that is integrated.
    pub(super) fn is_state(&self) -> bool {
        matches!(
            self,
            Self::Position(_)
                | Self::Velocity(_)
                | Self::Quaternion(_)
                | Self::Omega(_)
                | Self::Coordinate(_)
                | Self::Rate(_)
                | Self::ModalCoordinate(_)
                | Self::ModalRate(_)
        )
    }
}
