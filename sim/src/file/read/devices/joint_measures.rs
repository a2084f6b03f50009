//! [`JointMeasures`]: what the quantities of a joint are, of one that turns and of one that slides.

use precess_dynamics::kind::JointInfo;

use crate::units::Measure;

/// The measures of a joint.
#[derive(Clone, Copy)]
pub(in crate::file::read) struct JointMeasures {
    pub(in crate::file::read) coordinate: Measure,
    pub(in crate::file::read) rate: Measure,
    pub(in crate::file::read) acceleration: Measure,
    pub(in crate::file::read) torque: Measure,
    pub(super) stiffness: Measure,
    pub(super) damping: Measure,
    pub(super) drag: Measure,
}

impl JointMeasures {
    pub(in crate::file::read) fn of_joint(joint: &JointInfo) -> Self {
        if joint.slides {
            Self {
                coordinate: Measure::LENGTH,
                rate: Measure::VELOCITY,
                acceleration: Measure::ACCELERATION,
                torque: Measure::FORCE,
                stiffness: Measure::STIFFNESS,
                damping: Measure::DAMPING,
                drag: Measure::DRAG,
            }
        } else {
            Self {
                coordinate: Measure::ANGLE,
                rate: Measure::ANGULAR_RATE,
                acceleration: Measure::ANGULAR_ACCELERATION,
                torque: Measure::TORQUE,
                stiffness: Measure::ANGULAR_STIFFNESS,
                damping: Measure::ANGULAR_DAMPING,
                drag: Measure::ANGULAR_DRAG,
            }
        }
    }
}
