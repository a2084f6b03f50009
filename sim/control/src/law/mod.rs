//! Laws: from a [`Sample`] to the torque that is wanted on the spacecraft.

pub(crate) mod damping;
pub(crate) mod dumping;
pub(crate) mod gyroscopic;
pub(crate) mod mrp;
pub(crate) mod quaternion;

use nalgebra::Vector3;

use crate::model::motion::{Motion, Reference};

/// What a law reads at a sample.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Sample {
    /// The hub, as measured or estimated.
    pub motion: Motion,
    /// What it is to follow.
    pub reference: Reference,
    /// What the whole angular momentum about the centre of mass is above the law's inertia times the angular velocity,
    /// expressed in B, N m s.
    pub momentum: Vector3<f64>,
    /// Known external torque about the centre of mass, expressed in B, N m.
    pub external: Vector3<f64>,
    /// Time since the law's previous sample, s; 0 at its first.
    pub elapsed: f64,
    /// Whether actuators clipped the previous command: integrals are then kept as they are.
    pub limited: bool,
}

impl Sample {
    /// Of a motion and a reference, without devices and external torque, at the first sample.
    #[must_use]
    pub fn new(motion: Motion, reference: Reference) -> Self {
        Self {
            motion,
            reference,
            momentum: Vector3::zeros(),
            external: Vector3::zeros(),
            elapsed: 0.0,
            limited: false,
        }
    }
}

/// A control law, sampled.
pub trait Law {
    /// The torque that actuators are to exert on the spacecraft about its centre of mass, expressed in B, N m.
    ///
    /// Once a sample: the law's integrals advance.
    fn torque(&mut self, sample: &Sample) -> Vector3<f64>;

    /// Starts anew: integrals are zero.
    fn reset(&mut self);

    /// The numbers that it keeps from sample to sample; none of a law that keeps nothing.
    fn kept(&mut self) -> &mut [f64] {
        &mut []
    }
}
