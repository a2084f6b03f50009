//! Motors that come to one of their limits or leave it.
//!
//! A motor delivers no more than its largest power: `u rate <= P`. It accelerates its joint up to the largest rate
//! and holds it there, by whatever torque that takes, while the profile is above that torque, counted along the
//! rate; where it is below, the joint leaves the largest rate. Where holding takes more than the largest torque
//! against the rate, the joint exceeds its largest rate, and the motor brakes with the largest torque until it is back.

use crate::engine::equations::motors::{MotorState, POWER};
use crate::engine::equations::system::System;
use crate::engine::integration::Moment;
use crate::engine::quantities::joint_torques::TorquesOnce;
use crate::record::RunError;
use crate::scenario::Drive;
use precess_control::Checkpoint;
use precess_craft::CraftState;
use precess_dynamics::JointStates;

/// A joint leaves its largest rate where the torque that holds it is above the profile by this part of the largest
/// torque: at the largest rate without friction both are zero, but for rounding.
const TORQUE: f64 = 1e-9;
/// A rate beyond the largest one by less than this part of it is that rate.
const RATE: f64 = 1e-9;

/// A motor that comes to another state.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct MotorChange {
    pub(crate) joint: usize,
    pub(crate) to: MotorState,
}

/// The changes that are possible in the present states.
pub(super) fn possible(system: &System<'_>) -> Vec<MotorChange> {
    let mut changes = Vec::new();
    for (joint, state) in system.acting.motors().iter().enumerate() {
        let limits = system.acting.drive(joint).limits();
        let mut add = |to| changes.push(MotorChange { joint, to });
        match *state {
            MotorState::Commanded | MotorState::LargestPower => {
                if limits.power.is_some() {
                    add(match state {
                        MotorState::Commanded => MotorState::LargestPower,
                        _ => MotorState::Commanded,
                    });
                }
                if limits.rate.is_some() {
                    add(MotorState::LargestRate(1.0));
                    add(MotorState::LargestRate(-1.0));
                }
            }
            MotorState::LargestRate(sign) => {
                add(MotorState::Commanded);
                if limits.torque.is_some() {
                    add(MotorState::Beyond(sign));
                }
            }
            MotorState::Beyond(sign) => add(MotorState::LargestRate(sign)),
        }
    }
    changes
}

impl MotorChange {
    /// Visits it, of one of so many joints.
    pub(crate) fn visit(&mut self, joints: usize, checkpoint: &mut Checkpoint<'_>) {
        checkpoint.index(&mut self.joint, joints);
        self.to.visit(checkpoint);
    }

    /// How far the joint is from this change: below zero once it is due. W, rad/s or m/s, N m or N.
    pub(super) fn distance(
        &self,
        system: &System<'_>,
        time: f64,
        state: &CraftState,
        torques: &mut TorquesOnce,
    ) -> Result<f64, RunError> {
        let joint = self.joint;
        let mut holding = || torques.of(system, time, state, joint).map(|[motor, _]| motor);
        let limits = system.acting.drive(joint).limits();
        let present = system.acting.motors().get(joint).copied().unwrap_or_default();
        let rate = state.devices.states().nth(joint).map_or(f64::NAN, |[_, rate]| rate);
        let commanded = || system.acting.commanded(joint, time);
        let [power, rate_max] =
            [limits.power, limits.rate].map(|limit| limit.unwrap_or(f64::INFINITY));
        Ok(match (present, self.to) {
            (_, MotorState::LargestPower) => power - commanded() * rate,
            (MotorState::LargestPower, MotorState::Commanded) => commanded() * rate - power,
            (MotorState::Beyond(sign), MotorState::LargestRate(_)) => sign * rate - rate_max,
            (_, MotorState::LargestRate(sign)) => rate_max - sign * rate,
            (MotorState::LargestRate(sign), MotorState::Beyond(_)) => {
                let limit = limits.torque.map_or(f64::INFINITY, f64::abs);
                sign * holding()? + limit * (1.0 + TORQUE)
            }
            (MotorState::LargestRate(sign), MotorState::Commanded) => {
                let largest = system.acting.largest_torque(joint);
                let holding = holding()?;
                let available = (sign * commanded()).min(power / rate.abs());
                available - sign * holding + TORQUE * largest
            }
            (_, MotorState::Commanded | MotorState::Beyond(_)) => f64::INFINITY,
        })
    }
}

/// The change that is due at the start of a segment, where a profile, a drive or another motor jumps.
///
/// # Errors
///
/// [`RunError::BeyondLargestRate`] of a joint that no torque limit lets slow down.
pub(crate) fn due(
    system: &System<'_>,
    time: f64,
    moment: &Moment,
    joint: usize,
) -> Result<Option<MotorChange>, RunError> {
    let limits = system.acting.drive(joint).limits();
    let present = system.acting.motors().get(joint).copied().unwrap_or_default();
    let state = &moment.state;
    let mut torques = TorquesOnce::default();
    let mut is_due = |to| {
        let change = MotorChange { joint, to };
        let distance = change.distance(system, time, state, &mut torques)?;
        Ok::<_, RunError>((distance < 0.0).then_some(change))
    };
    // An impulse may have taken the joint below its largest rate.
    let rate = state.devices.states().nth(joint).map_or(0.0, |[_, rate]| rate);
    let is_below = |sign: f64| limits.rate.is_some_and(|limit| sign * rate < limit * (1.0 - RATE));
    let commanded = Some(MotorChange { joint, to: MotorState::Commanded });
    match present {
        MotorState::Commanded | MotorState::LargestPower => {
            if limits.rate.is_some_and(|limit| rate.abs() > limit * (1.0 + RATE)) {
                if limits.torque.is_none() {
                    return Err(beyond(system, time, joint, rate));
                }
                return Ok(Some(MotorChange { joint, to: MotorState::Beyond(rate.signum()) }));
            }
            let Some(power) = limits.power else { return Ok(None) };
            let excess = system.acting.commanded(joint, time) * rate - power;
            let to = match present {
                MotorState::Commanded if excess > POWER * power => MotorState::LargestPower,
                MotorState::LargestPower if excess < -POWER * power => MotorState::Commanded,
                _ => return Ok(None),
            };
            Ok(Some(MotorChange { joint, to }))
        }
        MotorState::LargestRate(sign) | MotorState::Beyond(sign) if is_below(sign) => Ok(commanded),
        MotorState::LargestRate(sign) => match is_due(MotorState::Commanded)? {
            None if limits.torque.is_some() => is_due(MotorState::Beyond(sign)),
            found => Ok(found),
        },
        MotorState::Beyond(_) => Ok(None),
    }
}

/// The error of a joint beyond the largest rate of its motor.
pub(crate) fn beyond(system: &System<'_>, time: f64, joint: usize, rate: f64) -> RunError {
    let limit = system.acting.drive(joint).limits().rate.unwrap_or(f64::INFINITY);
    let (joint, unit) = system.layout.joints.get(joint).map_or_else(Default::default, |place| {
        let [_, unit, ..] = place.info.units();
        (place.name.clone(), unit)
    });
    RunError::BeyondLargestRate { time, joint, rate, limit, unit }
}

/// The joints whose motor's torque depends on the rate.
pub(crate) fn limited(system: &System<'_>) -> Vec<usize> {
    let joints = 0..system.layout.joints.len();
    let is_limited = |joint: &usize| match system.acting.drive(*joint) {
        Drive::Torque { limit: Some(limits), .. } => limits.depend_on_rate(),
        _ => false,
    };
    joints.filter(is_limited).collect()
}
