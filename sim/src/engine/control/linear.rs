//! [`LinearAllocation`]: what an [`Allocator`](super::allocation::Allocator) commands for small torques and small motions about rest,
//! within the limits of motors.

use nalgebra::{DMatrix, Vector3};
use precess_craft::{SteeringDevices, SteeringSums};
use precess_dynamics::{Steered, SteeringError, SteeringLaw, SteeringMatrix, steering_weights};

use super::allocation::{Available, Padded, inverse, largest, matrix, only};
use crate::control::ControllerError;
use crate::scenario::{AllocationInverse, COMMANDED_MAX, MotorLimits, SampledController, Scenario};

/// `x = P u + R_omega omega + R_q q'`: a row for each joint that the controller commands.
#[derive(Clone, Debug)]
pub(crate) struct LinearAllocation {
    /// By the torque on the spacecraft, expressed in B, 1/(N m s) of a gimbal, 1/(kg m²) of a wheel.
    pub(crate) by_torque: DMatrix<f64>,
    /// By the angular velocity of the hub, expressed in B.
    pub(crate) by_omega: DMatrix<f64>,
    /// By the rate of each joint of the scenario.
    pub(crate) by_rate: DMatrix<f64>,
    /// Momentum of the devices on the hub about B relative to it, which the law reads, N m s.
    pub(crate) momentum: Vector3<f64>,
}

/// About rest, with coordinates and rates of all joints. The least largest command is taken as the pseudo-inverse, which gives
/// the same torque; a dither as it is at the time zero.
pub(crate) fn linear_allocation(
    scenario: &Scenario,
    of: &SampledController,
    states: &[[f64; 2]],
) -> Result<LinearAllocation, ControllerError> {
    let (on_hub, ..) = &scenario.devices;
    let rejected = |error: precess_dynamics::ParameterError| ControllerError::Program {
        reason: error.to_string(),
    };
    let mut devices = SteeringDevices::new(on_hub).map_err(rejected)?;
    let wheels: Vec<bool> = scenario.joints().map(|(.., info)| info.body == "wheel").collect();
    let rates: Vec<f64> = states.iter().map(|[_, rate]| *rate).collect();
    let available = |own: &crate::scenario::CommandedJoint| Available {
        joint: own.joint,
        steered: own.steered,
        limits: MotorLimits::default(),
        state: states.get(own.joint).copied().unwrap_or_default(),
        commanded: true,
        at_limit: false,
    };
    let joints: Vec<Available> = of.joints.iter().map(available).collect();
    let mut steered: Padded<Steered> = [Steered::Nothing; COMMANDED_MAX];
    for (to, of) in steered.iter_mut().zip(&joints) {
        *to = of.steered;
    }
    let mut terms = |omega: Vector3<f64>| -> Result<SteeringSums, SteeringError> {
        let mut sums = devices.terms(states.iter().copied(), &omega)?;
        let turning = sums.by_rate.iter_mut().zip(&sums.by_acceleration).zip(&wheels);
        for ((by_rate, n), _) in turning.filter(|(_, wheel)| **wheel) {
            *by_rate = omega.cross(n);
        }
        Ok(sums)
    };
    let sums = terms(Vector3::zeros())?;
    let at_rest = matrix(&steered, &joints, &rates, &sums);
    let reference = of.allocation.reference.or_else(|| largest(&at_rest, &steered, &joints));
    let commands = solution(of, &steered, &at_rest, reference.unwrap_or(1.0));
    let count = joints.len();
    let column = |torque: Vector3<f64>| -> Result<Vec<f64>, SteeringError> {
        Ok(commands(&torque)?.into_iter().take(count).collect())
    };
    let columns = |torques: &[Vector3<f64>]| -> Result<DMatrix<f64>, SteeringError> {
        let all: Result<Vec<_>, _> = torques.iter().map(|torque| column(*torque)).collect();
        Ok(DMatrix::from_iterator(count, torques.len(), all?.into_iter().flatten()))
    };
    let axes = [Vector3::x(), Vector3::y(), Vector3::z()];
    // What is commanded beside the torque, `drift - omega x h`: its quadratic part is the same for both signs.
    let mut by_omega = Vec::new();
    for axis in axes {
        let mut ends = [Vector3::zeros(); 2];
        for (end, sign) in ends.iter_mut().zip([1.0, -1.0]) {
            let sums = terms(axis * sign)?;
            *end = matrix(&steered, &joints, &rates, &sums).drift;
        }
        by_omega.push((ends[0] - ends[1]) * 0.5 - axis.cross(&sums.momentum));
    }
    let by_rate: Vec<Vector3<f64>> = (0..states.len())
        .map(|joint| {
            let mut one = vec![0.0; states.len()];
            if let Some(rate) = one.get_mut(joint) {
                *rate = 1.0;
            }
            matrix(&steered, &joints, &one, &sums).drift - sums.gyroscopic
        })
        .collect();
    Ok(LinearAllocation {
        by_torque: columns(&axes)?,
        by_omega: columns(&by_omega)?,
        by_rate: columns(&by_rate)?,
        momentum: sums.momentum,
    })
}

/// Commands for a torque on the spacecraft, without drift and limits.
fn solution<'a>(
    of: &'a SampledController,
    steered: &Padded<Steered>,
    at_rest: &SteeringMatrix<f64, COMMANDED_MAX>,
    reference: f64,
) -> impl Fn(&Vector3<f64>) -> Result<[f64; COMMANDED_MAX], SteeringError> + use<'a> {
    let settings = &of.allocation;
    let weight = |of: Steered| match of {
        Steered::Rate => settings.gimbal_weight,
        Steered::Acceleration => settings.wheel_weight,
        Steered::Nothing => 0.0,
    };
    let has_gimbals = steered.contains(&Steered::Rate);
    let counts = |of: Steered| if has_gimbals { of == Steered::Rate } else { weight(of) > 0.0 };
    let measure = only(at_rest, steered, counts).measure(reference);
    let mut matrix = only(at_rest, steered, |of| weight(of) > 0.0);
    matrix.drift = Vector3::zeros();
    let weights = [settings.gimbal_weight, settings.wheel_weight];
    let kept = match settings.inverse {
        AllocationInverse::LeastLargest => AllocationInverse::Exact,
        other => other,
    };
    let law = SteeringLaw {
        inverse: inverse(kept, 0.0),
        weights: steering_weights(steered, weights, settings.wheel_mu, measure),
        reference,
    };
    move |torque| Ok(law.allocate(&matrix, torque)?.commands)
}
