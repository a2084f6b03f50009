//! [`Quantity`]: what a column shows.

/// What a column shows: of an axis 0 to 2, of a joint, device or platform by its number in the set.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Quantity {
    Time,
    Position(usize),
    Velocity(usize),
    HubAcceleration(usize),
    Quaternion(usize),
    Sigma(usize),
    Omega(usize),
    OmegaDot(usize),
    Coordinate(usize),
    Rate(usize),
    JointAcceleration(usize),
    Torque(usize),
    Energy,
    Work,
    Lost,
    Linear(usize),
    Angular(usize),
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
    /// Of a disturbance: a component of force, 0 to 2, or moment, 3 to 5.
    Disturbance(usize, usize),
}

impl Quantity {
    pub(crate) fn is_load(&self) -> bool {
        matches!(
            self,
            Self::MountForce(..)
                | Self::MountMoment(..)
                | Self::CarriedForce(..)
                | Self::CarriedMoment(..)
                | Self::LoadForce(..)
                | Self::LoadMoment(..)
        )
    }

    pub(crate) fn is_acceleration(&self) -> bool {
        matches!(
            self,
            Self::HubAcceleration(_)
                | Self::OmegaDot(_)
                | Self::JointAcceleration(_)
                | Self::PointAcceleration(..)
        )
    }

    /// Whether place or velocity of a point of the structure is needed.
    pub(crate) fn is_motion_of(&self, index: usize) -> bool {
        matches!(
            self,
            Self::Displacement(point, _)
                | Self::Rotation(point, _)
                | Self::PointSigma(point, _)
                | Self::PointOmega(point, _)
                if *point == index
        )
    }

    /// Whether the acceleration of a point of the structure is needed.
    pub(crate) fn is_acceleration_of(&self, index: usize) -> bool {
        matches!(self, Self::PointAcceleration(point, _) if *point == index)
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
