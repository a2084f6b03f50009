//! [`Allocator`]: from a torque on the spacecraft to rates of gimbals and accelerations of wheels.
//!
//! ```text
//! Q x = -(u - omega x (I omega + h)) - drift
//! ```
//!
//! u is the torque about the centre of mass that the devices exert by the change of their momentum relative to the hub as
//! seen from B; `omega x (I omega + h)`, with inertia and relative momentum of the devices on the hub, is what they take
//! by turning with the hub, which the law has as part of the whole spacecraft's. Columns and drift are those of
//! [`SteeringMatrix`].

use nalgebra::Vector3;
use precess_control::Checkpoint;
use precess_craft::SteeringSums;
use precess_dynamics::{
    Allocation, Dither, Inverse, KeepOut, Steered, SteeringError, SteeringLaw, SteeringMatrix,
    steering_weights,
};

use crate::scenario::{
    AllocationInverse, COMMANDED_MAX, MotorLimits, NullMotion, SampledController,
};

/// A bound that no command reaches.
const UNBOUNDED: f64 = 1e30;
/// Phases of the dither's three elements, a quarter turn apart: they are not all zero at one time. rad.
const PHASES: [f64; 3] = [0.0, std::f64::consts::FRAC_PI_2, std::f64::consts::PI];

/// What a controller's torque is divided by.
#[derive(Clone, Debug)]
pub(super) struct Allocator {
    /// The momentum that makes lambda and the measure dimensionless, N m s; where none is stated, that of the first sample
    /// at which there is one.
    reference: Option<f64>,
}

/// Commands of the joints of a controller.
#[derive(Clone, Debug)]
pub(super) struct Allocated {
    /// Rates and accelerations; zero of a joint that is not available.
    pub(super) commands: Vec<f64>,
    pub(super) torque_error: Vector3<f64>,
    pub(super) bounded: usize,
    pub(super) measure: f64,
}

/// A joint of a controller, at a sample.
#[derive(Clone, Copy, Debug)]
pub(super) struct Available {
    pub(super) joint: usize,
    pub(super) steered: Steered,
    pub(super) limits: MotorLimits,
    /// Coordinate and rate as they are read.
    pub(super) state: [f64; 2],
    /// Whether nothing has taken the place of its controller.
    pub(super) commanded: bool,
    /// Whether its motor is at its largest power or rate.
    pub(super) at_limit: bool,
}

/// The joints at a sample.
#[derive(Clone, Copy, Debug)]
pub(super) struct Pose<'a> {
    /// Those of the controller.
    pub(super) joints: &'a [Available],
    /// The rates of all joints.
    pub(super) rates: &'a [f64],
    /// Angular velocity of the hub, B, rad/s.
    pub(super) omega: &'a Vector3<f64>,
}

/// Joints beyond those of a controller are padded: nothing is commanded of them.
pub(super) type Padded<T> = [T; COMMANDED_MAX];

impl Allocator {
    pub(super) fn new(of: &SampledController) -> Self {
        Self { reference: of.allocation.reference }
    }

    /// Visits what it keeps from sample to sample.
    pub(super) fn visit(&mut self, checkpoint: &mut Checkpoint<'_>) {
        checkpoint.optional(&mut self.reference, || 0.0, Checkpoint::number);
    }

    /// Commands for a torque, N m, B, at a time and terms of the devices on the hub.
    pub(super) fn allocate(
        &mut self,
        of: &SampledController,
        (time, torque): (f64, &Vector3<f64>),
        Pose { joints, rates, omega }: Pose<'_>,
        sums: &SteeringSums,
    ) -> Result<Allocated, SteeringError> {
        let mut steered: Padded<Steered> = [Steered::Nothing; COMMANDED_MAX];
        for (to, of) in steered.iter_mut().zip(joints).filter(|(_, of)| of.commanded) {
            *to = of.steered;
        }
        let matrix = matrix(&steered, joints, rates, sums);
        if self.reference.is_none() {
            self.reference = largest(&matrix, &steered, joints);
        }
        // Of the first sample at which a joint is available.
        let reference = self.reference.unwrap_or(1.0);
        let settings = &of.allocation;
        let has_gimbals = steered.contains(&Steered::Rate);
        let weight = |of: Steered| match of {
            Steered::Rate => settings.gimbal_weight,
            Steered::Acceleration => settings.wheel_weight,
            Steered::Nothing => 0.0,
        };
        // Of gimbals where there are any: wheels help where these are singular.
        let counts = |of: Steered| if has_gimbals { of == Steered::Rate } else { weight(of) > 0.0 };
        let measure = only(&matrix, &steered, counts).measure(reference);
        let turning = omega.cross(&(sums.inertia * omega + sums.momentum));
        let demand = torque - turning;
        let matrix = only(&matrix, &steered, |of| weight(of) > 0.0);
        let bounds = bounds(joints, &matrix);
        let weights = [settings.gimbal_weight, settings.wheel_weight];
        let law = SteeringLaw {
            inverse: inverse(settings.inverse, time),
            weights: steering_weights(&steered, weights, settings.wheel_mu, measure),
            reference,
        };
        let mut found = if settings.inverse == AllocationInverse::LeastLargest {
            clipped(matrix.least_largest(&demand)?, &matrix, &bounds)
        } else {
            law.allocate_within(&matrix, &demand, &bounds)?
        };
        // Where the exact inverse does not exist, nor does motion without torque.
        if let Some(preferred) = preferred(&settings.null_motion, &steered, joints)
            && let Ok(motion) = law.null_motion(&matrix, &preferred)
        {
            let share = add_within(&mut found.commands, &motion, &bounds);
            // What it exerts by rounding.
            for (column, motion) in matrix.columns.iter().zip(&motion) {
                found.torque_error -= column * (share * motion);
            }
        }
        let commands = found.commands.into_iter().take(joints.len()).collect();
        let (torque_error, bounded) = (found.torque_error, found.bounded);
        Ok(Allocated { commands, torque_error, bounded, measure })
    }
}

/// Columns of the commanded joints, and the drift of all others.
pub(super) fn matrix(
    steered: &Padded<Steered>,
    joints: &[Available],
    rates: &[f64],
    sums: &SteeringSums,
) -> SteeringMatrix<f64, COMMANDED_MAX> {
    let mut columns = [Vector3::zeros(); COMMANDED_MAX];
    let mut drift = sums.gyroscopic;
    for (by_rate, rate) in sums.by_rate.iter().zip(rates) {
        drift += by_rate * *rate;
    }
    for ((column, steered), of) in columns.iter_mut().zip(steered).zip(joints) {
        let by = |of_joints: &[Vector3<f64>]| of_joints.get(of.joint).copied().unwrap_or_default();
        match steered {
            Steered::Rate => {
                *column = by(&sums.by_rate);
                drift -= *column * rates.get(of.joint).copied().unwrap_or_default();
            }
            Steered::Acceleration => *column = by(&sums.by_acceleration),
            Steered::Nothing => {}
        }
    }
    SteeringMatrix { columns, drift }
}

/// The matrix with the columns of some joints only.
pub(super) fn only(
    matrix: &SteeringMatrix<f64, COMMANDED_MAX>,
    steered: &Padded<Steered>,
    keep: impl Fn(Steered) -> bool,
) -> SteeringMatrix<f64, COMMANDED_MAX> {
    let mut kept = *matrix;
    for (column, _) in kept.columns.iter_mut().zip(steered).filter(|(_, of)| !keep(**of)) {
        *column = Vector3::zeros();
    }
    kept
}

/// The largest column, of gimbals where the controller has any: the momentum of a wheel; of wheels by themselves an inertia.
/// None where no such joint is available.
pub(super) fn largest(
    matrix: &SteeringMatrix<f64, COMMANDED_MAX>,
    steered: &Padded<Steered>,
    joints: &[Available],
) -> Option<f64> {
    let has_gimbals = joints.iter().any(|of| of.steered == Steered::Rate);
    let counts = |of: Steered| of == Steered::Rate || !has_gimbals;
    let sizes = only(matrix, steered, counts).columns.map(|column| column.norm());
    Some(sizes.into_iter().fold(0.0, f64::max)).filter(|largest| *largest > 0.0)
}

/// The motion that is preferred of each joint: rate towards an angle, acceleration out of a band of speeds; none where
/// nothing is.
fn preferred(
    of: &NullMotion,
    steered: &Padded<Steered>,
    joints: &[Available],
) -> Option<Padded<f64>> {
    let mut wanted = [0.0; COMMANDED_MAX];
    let mut angles = of.preferred_angles.iter();
    for ((to, steered), joint) in wanted.iter_mut().zip(steered).zip(joints) {
        // Angles are of all gimbals, also of those that are not available.
        let angle = if joint.steered == Steered::Rate { angles.next() } else { None };
        let [coordinate, rate] = joint.state;
        *to = match (steered, angle) {
            (Steered::Rate, Some(angle)) => {
                let (sin, cos) = libm::sincos(angle - coordinate);
                of.angle_gain * libm::atan2(sin, cos)
            }
            (Steered::Acceleration, _) => {
                let out = |[lower, upper]: &[f64; 2]| {
                    let band = KeepOut { lower: *lower, upper: *upper };
                    band.acceleration(rate.abs(), of.keep_out_gain)
                };
                rate.signum() * of.keep_out.iter().map(out).sum::<f64>()
            }
            _ => 0.0,
        };
    }
    wanted.iter().any(|of| *of != 0.0).then_some(wanted)
}

/// Adds as much of a motion without torque as keeps commands within their bounds; the share of it.
fn add_within(commands: &mut Padded<f64>, motion: &Padded<f64>, bounds: &Padded<[f64; 2]>) -> f64 {
    let mut share = 1.0_f64;
    for ((command, motion), [lower, upper]) in commands.iter().zip(motion).zip(bounds) {
        let room = if *motion > 0.0 { upper - command } else { lower - command };
        if *motion != 0.0 {
            share = share.min((room / motion).max(0.0));
        }
    }
    for (command, motion) in commands.iter_mut().zip(motion) {
        *command += share * motion;
    }
    share
}

/// Commands within bounds: what they no longer give is an error of the torque, `-q x`.
fn clipped(
    mut of: Allocation<f64, COMMANDED_MAX>,
    matrix: &SteeringMatrix<f64, COMMANDED_MAX>,
    bounds: &Padded<[f64; 2]>,
) -> Allocation<f64, COMMANDED_MAX> {
    for ((command, column), [lower, upper]) in
        of.commands.iter_mut().zip(&matrix.columns).zip(bounds)
    {
        let within = command.clamp(*lower, *upper);
        of.bounded += usize::from(within != *command);
        of.torque_error += column * (*command - within);
        *command = within;
    }
    of
}

pub(super) fn inverse(of: AllocationInverse, time: f64) -> Inverse {
    match of {
        AllocationInverse::Exact | AllocationInverse::LeastLargest => Inverse::Exact,
        AllocationInverse::SingularityRobust([lambda, mu]) => {
            Inverse::SingularityRobust { lambda, mu }
        }
        AllocationInverse::Generalised([lambda, mu], [amplitude, frequency]) => {
            let dither = Dither { amplitude, frequency, phases: PHASES }.at(time);
            Inverse::Generalised { lambda, mu, dither }
        }
    }
}

/// Rates within those of the motors; accelerations within what their torques give the wheel with the hub held.
fn bounds(joints: &[Available], matrix: &SteeringMatrix<f64, COMMANDED_MAX>) -> Padded<[f64; 2]> {
    let mut bounds = [[-UNBOUNDED, UNBOUNDED]; COMMANDED_MAX];
    for ((to, of), column) in bounds.iter_mut().zip(joints).zip(&matrix.columns) {
        let most = match of.steered {
            Steered::Rate => of.limits.rate,
            Steered::Acceleration => of.limits.torque.map(|torque| torque.abs() / column.norm()),
            Steered::Nothing => None,
        };
        if let Some(most) = most.filter(|most| *most < UNBOUNDED) {
            *to = [-most, most];
        }
    }
    bounds
}

#[cfg(test)]
mod tests {
    use super::*;

    fn available(steered: Steered) -> Available {
        let limits = MotorLimits::default();
        Available { joint: 0, steered, limits, state: [0.0; 2], commanded: true, at_limit: false }
    }

    #[test]
    fn motion_without_torque_stays_within_bounds() {
        let mut commands = [0.0; COMMANDED_MAX];
        let mut motion = commands;
        let mut bounds = [[-1.0, 1.0]; COMMANDED_MAX];
        (commands[0], commands[1]) = (0.5, -0.5);
        (motion[0], motion[1], motion[2]) = (1.0, 0.1, -0.2);
        let mut added = commands;
        add_within(&mut added, &motion, &bounds);
        assert_eq!(added[..3], [1.0, -0.45, -0.1], "half of it");
        // Beyond a bound already: nothing is added.
        bounds[0] = [-0.1, 0.1];
        let mut added = commands;
        add_within(&mut added, &motion, &bounds);
        assert_eq!(added, commands);
    }

    #[test]
    fn what_is_preferred_is_the_nearer_way() {
        let of = NullMotion {
            preferred_angles: vec![3.0],
            angle_gain: 0.5,
            keep_out: vec![[100.0, 120.0]],
            keep_out_gain: 0.25,
        };
        let mut steered = [Steered::Nothing; COMMANDED_MAX];
        (steered[0], steered[1]) = (Steered::Rate, Steered::Acceleration);
        let mut joints = [Steered::Rate, Steered::Acceleration].map(available);
        (joints[0].state, joints[1].state) = ([-3.0, 0.0], [0.0, -118.0]);
        let wanted = preferred(&of, &steered, &joints).expect("both");
        let back = std::f64::consts::TAU - 6.0;
        assert!((wanted[0] + 0.5 * back).abs() < 1e-15, "{}", wanted[0]);
        // 2 rad/s to the upper end and a tenth of the width beyond it.
        assert!((wanted[1] + 0.25 * 4.0).abs() < 1e-15, "{}", wanted[1]);
        joints[1].state = [0.0, 90.0];
        steered[0] = Steered::Nothing;
        assert_eq!(preferred(&of, &steered, &joints), None);
    }

    /// Columns of wheels, kg m², are not compared with those of gimbals, N m s.
    #[test]
    fn the_reference_momentum_is_that_of_a_gimbal() {
        let joints = [Steered::Rate, Steered::Acceleration].map(available);
        let mut steered = [Steered::Nothing; COMMANDED_MAX];
        let mut columns = [Vector3::zeros(); COMMANDED_MAX];
        (columns[0], columns[1]) = (Vector3::new(0.0, 2.0, 0.0), Vector3::new(5.0, 0.0, 0.0));
        let matrix = SteeringMatrix { columns, drift: Vector3::zeros() };
        (steered[0], steered[1]) = (Steered::Rate, Steered::Acceleration);
        assert_eq!(largest(&matrix, &steered, &joints), Some(2.0));
        // The gimbal is not available: no reference yet, and not that of a wheel.
        steered[0] = Steered::Nothing;
        assert_eq!(largest(&matrix, &steered, &joints), None);
        // Wheels by themselves.
        assert_eq!(largest(&matrix, &steered, &joints[1..]), Some(5.0));
    }
}
