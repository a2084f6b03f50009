//! [`PointMotion`]: place, velocity and acceleration of a point that moves with a body, by the chain of its joints.
//!
//! ```text
//! along an offset o          r + o,  v + omega x o,  a + omega' x o + omega x (omega x o)
//! a slide along e by q       as an offset q e, and  v + q' e,  a + q'' e + 2 omega x q' e
//! a turn about e             omega + q' e,  omega' + q'' e + omega x q' e
//! ```

use nalgebra::Vector3;
use precess_craft::CraftState;
use precess_dynamics::Attitude;
use precess_dynamics::kind::JointInfo;

use super::kinematics::{Chain, Frame, unit};
use crate::scenario::{BodyPoint, Target};

/// How a point moves.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct PointMotion {
    /// From the inertial origin, expressed in N, m.
    pub(crate) position: Vector3<f64>,
    /// Inertial, expressed in N, m/s.
    pub(crate) velocity: Vector3<f64>,
    /// Inertial, expressed in the axes of the body, m/s²: an accelerometer reads it less gravity. NaN where no
    /// accelerations are given.
    pub(crate) acceleration: Vector3<f64>,
}

/// Accelerations of the hub, inertial of B and angular, both expressed in B; and of the joints.
#[derive(Clone, Debug)]
pub(crate) struct Accelerations {
    pub(crate) b: Vector3<f64>,
    pub(crate) omega_dot: Vector3<f64>,
    pub(crate) joints: Vec<f64>,
}

/// The motion of a point; `joints` are those of the set.
pub(crate) fn point_motion(
    point: &BodyPoint,
    chains: &[Chain],
    state: &CraftState,
    joints: &[[f64; 2]],
    accelerations: Option<&Accelerations>,
) -> PointMotion {
    let nan = Vector3::repeat(f64::NAN);
    let [acceleration, omega_dot] = match accelerations {
        Some(of) => [of.b, of.omega_dot],
        None => [nan; 2],
    };
    let b = MovingFrame { frame: Frame::of_hub(state), acceleration, omega_dot };
    let known = accelerations.map_or(&[][..], |of| &of.joints);
    let body = match point.body {
        Target::Joint(joint) => of_body(chains, joint, &b, joints, known),
        Target::Hub | Target::Node(_) => b,
    };
    let at = body.moved(&point.position);
    let nb = state.attitude.dcm().transpose();
    PointMotion {
        position: nb * at.frame.origin,
        velocity: nb * at.frame.velocity,
        acceleration: at.frame.axes.tr_mul(&at.acceleration),
    }
}

/// The frame of the child body of a joint.
fn of_body(
    chains: &[Chain],
    joint: usize,
    b: &MovingFrame,
    joints: &[[f64; 2]],
    accelerations: &[f64],
) -> MovingFrame {
    let Some(chain) = chains.iter().rev().find(|chain| chain.first() <= joint) else { return *b };
    let base = chain.on().and_then(|on| chains.get(on)).map(Chain::tip);
    let base = base.map_or(*b, |tip| of_body(chains, tip, b, joints, accelerations));
    let mut frame = base;
    for (number, (body, info)) in (chain.first()..=joint).zip(chain.bodies()) {
        frame = frame.moved(&Vector3::from(body.origin));
        if info.index == 0 {
            frame.frame.axes *= chain.mount();
        }
        let state = joints.get(number).copied().unwrap_or([f64::NAN; 2]);
        let acceleration = accelerations.get(number).copied().unwrap_or(f64::NAN);
        frame = frame.jointed(info, state, acceleration);
    }
    frame
}

/// A frame on a moving body, with its accelerations, expressed in B.
#[derive(Clone, Copy)]
struct MovingFrame {
    frame: Frame,
    acceleration: Vector3<f64>,
    omega_dot: Vector3<f64>,
}

impl MovingFrame {
    /// The same body, the origin moved by an offset expressed in the frame's axes.
    fn moved(&self, offset: &Vector3<f64>) -> Self {
        let (o, omega) = (self.frame.axes * offset, self.frame.omega);
        let carried = self.omega_dot.cross(&o) + omega.cross(&omega.cross(&o));
        let acceleration = self.acceleration + carried;
        Self { frame: self.frame.moved(*offset), acceleration, ..*self }
    }

    /// The child body of a joint at this frame.
    fn jointed(&self, info: &JointInfo, state: [f64; 2], acceleration: f64) -> Self {
        let [coordinate, rate] = state;
        let (e, omega) = (self.frame.axes * unit(info), self.frame.omega);
        let frame = self.frame.jointed(info, state);
        if info.slides {
            let carried = self.moved(&(unit(info) * coordinate)).acceleration;
            let own = e * acceleration + 2.0 * omega.cross(&(e * rate));
            return Self { frame, acceleration: carried + own, ..*self };
        }
        let omega_dot = self.omega_dot + e * acceleration + omega.cross(&(e * rate));
        Self { frame, omega_dot, ..*self }
    }
}
