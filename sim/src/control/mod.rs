//! [`Controller`]: what a sampled controller of a run computes: a law of [`precess_control`], one of a program that runs
//! the scenario, or a program of its own ([`ProgramController`]).
//!
//! A run calls it once a sample, in the order of time, from the start of the run. Its answer is held until the next one
//! acts: a torque on the spacecraft, which the run divides among the joints that the controller commands, or the torques
//! of their motors.

mod error;
mod identity;
mod process;
mod protocol;

use nalgebra::Vector3;
use precess_control::{Checkpoint, Law, Sample};

pub use error::ControllerError;
pub(crate) use identity::program_digests;
pub use process::ProgramController;
pub use protocol::Greeting;

/// What a controller reads at a sample.
#[derive(Clone, Copy, Debug)]
pub struct ControllerSample<'a> {
    /// Time of the sample, s.
    pub time: f64,
    /// Motion of the hub and what it is to follow; what a law reads.
    pub of: Sample,
    /// Coordinate and rate of each joint that it commands, rad and rad/s.
    pub joints: &'a [[f64; 2]],
    /// What its accelerometer reads: inertial acceleration less gravity, along the axes of the hub or of its node, m/s²; none
    /// without one.
    pub specific_force: Option<Vector3<f64>>,
}

/// What a controller answers.
#[derive(Clone, Debug, PartialEq)]
pub enum Command {
    /// Torque that the devices are to exert on the spacecraft about its centre of mass, expressed in B, N m: their
    /// momentum relative to the hub changes by its opposite, as seen from B.
    Torque(Vector3<f64>),
    /// Torques of the motors of the joints that it commands, N m.
    Motors(Vec<f64>),
}

/// A controller.
pub trait Controller: Send {
    /// Its answer to a sample.
    ///
    /// # Errors
    ///
    /// Why it has none: the run ends there, its result complete up to the sample.
    fn sample(&mut self, sample: &ControllerSample<'_>) -> Result<Command, ControllerError>;

    /// Visits what it keeps from sample to sample; one that cannot, such as another process, refuses.
    fn visit(&mut self, checkpoint: &mut Checkpoint<'_>) {
        checkpoint.refuse();
    }
}

/// A law as a controller.
pub struct LawController(pub Box<dyn Law + Send>);

impl Controller for LawController {
    fn sample(&mut self, sample: &ControllerSample<'_>) -> Result<Command, ControllerError> {
        Ok(Command::Torque(self.0.torque(&sample.of)))
    }

    fn visit(&mut self, checkpoint: &mut Checkpoint<'_>) {
        checkpoint.numbers(self.0.kept());
    }
}
