//! [`HeldCommands`]: what controllers, and a program that is coupled to the run, command and hold until they command anew;
//! and what controllers computed at their last samples.

use nalgebra::Vector3;
use precess_control::Checkpoint;

use crate::scenario::{SampledController, Scenario};

/// Commands in force.
#[derive(Clone, Debug)]
pub(crate) struct HeldCommands {
    /// Of each joint.
    joints: Vec<Held>,
    /// External torque of each controller that dumps momentum, B, N m.
    externals: Vec<Option<Vector3<f64>>>,
    /// Force on the hub through B, N, and torque about B, N m, of a program; both expressed in B.
    on_hub: [Vector3<f64>; 2],
    /// Of each controller.
    values: Vec<ControlValues>,
}

/// The command of a joint.
#[derive(Clone, Copy, Debug)]
struct Held {
    /// Torque or force of its motor before clipping, N m or N; none where neither a controller nor a program commands it.
    torque: Option<f64>,
    /// Whether a change, a brake or an end stop has taken the place of what is commanded.
    replaced: bool,
    /// Torque of the motor by that which is commanded.
    factor: f64,
}

/// What a controller computed at its last sample.
#[derive(Clone, Debug)]
pub(crate) struct ControlValues {
    /// Torque on the spacecraft, B, N m.
    pub(crate) torque: [f64; 3],
    /// What the commands give less that, N m.
    pub(crate) torque_error: [f64; 3],
    /// Rate or acceleration of each joint that it commands, rad/s or rad/s².
    pub(crate) commands: Vec<f64>,
    /// Measure of singularity, dimensionless.
    pub(crate) measure: f64,
    /// How many commands or torques are at a limit.
    pub(crate) limited: f64,
    /// External torque that is commanded, B, N m.
    pub(crate) external: [f64; 3],
    /// What was read.
    pub(crate) measured: MeasuredValues,
}

/// What a controller read at its last sample; NaN of what it does not read.
#[derive(Clone, Copy, Debug)]
pub(crate) struct MeasuredValues {
    /// Reading of the gyro, rad/s.
    pub(crate) gyro: [f64; 3],
    /// Its bias, rad/s.
    pub(crate) gyro_bias: [f64; 3],
    /// Reading of the accelerometer, its axes, m/s².
    pub(crate) accelerometer: [f64; 3],
    /// Angular velocity that the law reads, B, rad/s.
    pub(crate) omega: [f64; 3],
    /// Attitude that the law reads, Euler parameters.
    pub(crate) attitude: [f64; 4],
    /// Rotation vector from that to the true attitude, B, rad.
    pub(crate) error: [f64; 3],
    /// Bias of the gyro that is estimated, rad/s.
    pub(crate) estimated_bias: [f64; 3],
    /// Standard deviations of the estimated attitude about the axes of B, rad.
    pub(crate) deviation: [f64; 3],
}

impl Default for MeasuredValues {
    fn default() -> Self {
        let nothing = [f64::NAN; 3];
        Self {
            gyro: nothing,
            gyro_bias: nothing,
            accelerometer: nothing,
            omega: nothing,
            attitude: [f64::NAN; 4],
            error: nothing,
            estimated_bias: nothing,
            deviation: nothing,
        }
    }
}

impl MeasuredValues {
    fn visit(&mut self, checkpoint: &mut Checkpoint<'_>) {
        let Self { gyro, gyro_bias, accelerometer, omega, attitude, error, .. } = self;
        for vector in [gyro, gyro_bias, accelerometer, omega, error] {
            checkpoint.numbers(vector);
        }
        checkpoint.numbers(attitude);
        let Self { estimated_bias, deviation, .. } = self;
        checkpoint.numbers(estimated_bias.iter_mut().chain(deviation));
    }
}

impl ControlValues {
    fn visit(&mut self, checkpoint: &mut Checkpoint<'_>) {
        let Self { torque, torque_error, commands, measure, limited, external, measured } = self;
        for vector in [torque, torque_error, external] {
            checkpoint.numbers(vector);
        }
        checkpoint.numbers(commands.iter_mut().chain([measure, limited]));
        measured.visit(checkpoint);
    }

    /// Those of a number of joints before anything is computed.
    fn nothing(joints: usize) -> Self {
        Self {
            torque: [0.0; 3],
            torque_error: [0.0; 3],
            commands: vec![0.0; joints],
            measure: f64::NAN,
            limited: 0.0,
            external: [0.0; 3],
            measured: MeasuredValues::default(),
        }
    }

    /// Leaves nothing of what an earlier sample computed for joints but how many are at a limit.
    pub(crate) fn clear(&mut self) {
        let Self { limited, external, measured, .. } = *self;
        *self = Self { limited, external, measured, ..Self::nothing(self.commands.len()) };
    }
}

impl HeldCommands {
    /// No torques, and nothing computed.
    pub(crate) fn new(scenario: &Scenario) -> Self {
        let free = Held { torque: None, replaced: false, factor: 1.0 };
        let mut joints = vec![free; scenario.joint_count()];
        for of in scenario.controllers.iter().flat_map(|of| &of.joints) {
            if let Some(held) = joints.get_mut(of.joint) {
                held.torque = Some(0.0);
            }
        }
        let nothing = |of: &SampledController| ControlValues::nothing(of.joints.len());
        let external = |of: &SampledController| of.dumping.map(|_| Vector3::zeros());
        Self {
            joints,
            externals: scenario.controllers.iter().map(external).collect(),
            on_hub: [Vector3::zeros(); 2],
            values: scenario.controllers.iter().map(nothing).collect(),
        }
    }

    /// Visits all of it.
    pub(crate) fn visit(&mut self, checkpoint: &mut Checkpoint<'_>) {
        for Held { torque, replaced, factor } in &mut self.joints {
            checkpoint.optional(torque, || 0.0, Checkpoint::number);
            checkpoint.flag(replaced);
            checkpoint.number(factor);
        }
        for external in &mut self.externals {
            checkpoint.optional_vector(external);
        }
        checkpoint.numbers(self.on_hub.iter_mut().flatten());
        for values in &mut self.values {
            values.visit(checkpoint);
        }
    }

    /// The external torque of all controllers, B, N m; none where none dumps momentum.
    pub(crate) fn external(&self) -> Option<Vector3<f64>> {
        self.externals.iter().flatten().copied().reduce(|sum, of| sum + of)
    }

    /// Holds the external torque of a controller, N m.
    pub(crate) fn hold_external(&mut self, controller: usize, torque: Vector3<f64>) {
        if let Some(Some(held)) = self.externals.get_mut(controller) {
            *held = torque;
        }
    }

    /// Force, N, and torque, N m, of a program on the hub; none where nothing acts.
    pub(crate) fn on_hub(&self) -> Option<[Vector3<f64>; 2]> {
        self.on_hub.iter().any(|of| *of != Vector3::zeros()).then_some(self.on_hub)
    }

    /// Holds a force on the hub through B, N, and a torque about B, N m; both expressed in B.
    pub(crate) fn hold_on_hub(&mut self, force: Vector3<f64>, torque: Vector3<f64>) {
        self.on_hub = [force, torque];
    }

    /// The torque or force of a joint's motor before clipping, N m or N; none where nothing commands it at present.
    pub(crate) fn torque(&self, joint: usize) -> Option<f64> {
        let held = self.joints.get(joint).filter(|held| !held.replaced)?;
        Some(held.factor * held.torque?)
    }

    /// Holds a torque or force of a joint's motor; while another drive has its place it waits for its release.
    pub(crate) fn hold(&mut self, joint: usize, torque: f64) {
        if let Some(held) = self.joints.get_mut(joint) {
            held.torque = Some(torque);
        }
    }

    /// Lets the motor of a joint exert this multiple of what is commanded from now on.
    pub(crate) fn set_factor(&mut self, joint: usize, factor: f64) {
        if let Some(held) = self.joints.get_mut(joint) {
            held.factor = factor;
        }
    }

    /// Another drive takes the place of what is commanded, or that acts again.
    pub(crate) fn set_replaced(&mut self, joint: usize, replaced: bool) {
        if let Some(held) = self.joints.get_mut(joint) {
            held.replaced = replaced;
        }
    }

    /// What a controller computed at its last sample.
    pub(crate) fn values(&self, controller: usize) -> Option<&ControlValues> {
        self.values.get(controller)
    }

    /// The same, to be written.
    pub(crate) fn values_mut(&mut self, controller: usize) -> Option<&mut ControlValues> {
        self.values.get_mut(controller)
    }
}
