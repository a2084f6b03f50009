//! Poses and velocities of the bodies of any device: body after body along the chain, without the
//! emitted kernels.
//!
//! They turn wrenches that are given in N, and make the unit of momentum drift: the sum over the
//! bodies of the magnitudes of their momenta. Only the sum of the momenta themselves has to equal
//! what the solver says; a test compares them.

use nalgebra::{Matrix3, Vector3};
use precess_dynamics::kind::{BodyParameters, JointInfo};
use precess_dynamics::{Angle, Attitude, BuiltIn, Hub, JointArray, State};

use crate::scenario::Set;

/// Momentum of one body, expressed in N.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct BodyMomentum {
    /// m v, kg m/s.
    pub(crate) linear: Vector3<f64>,
    /// r x m v + I omega about the inertial origin, kg m²/s.
    pub(crate) angular: Vector3<f64>,
}

/// The bodies of a device, from the hub to the tip.
#[derive(Clone, Debug)]
pub(crate) struct Chain {
    mount: Matrix3<f64>,
    bodies: Vec<(BodyParameters<f64>, &'static JointInfo)>,
}

impl Chain {
    pub(crate) fn new(device: &BuiltIn) -> Self {
        let parameters = device.parameters();
        let bodies = parameters.bodies.into_iter().zip(device.kind().joints()).collect();
        Self { mount: parameters.mount, bodies }
    }

    /// The axes of a body, columns expressed in B: those in which a wrench on it is given.
    ///
    /// A rotor that is the same from every angle has those of its parent body, as
    /// `Inputs::bodies` has it.
    pub(crate) fn axes(&self, index: usize, joints: &JointArray<[f64; 2]>) -> Matrix3<f64> {
        let turning = self.bodies.iter().zip(joints.as_slice()).take(index + 1);
        turning.fold(self.mount, |axes, ((_, info), [coordinate, _])| {
            if info.slides || info.ignorable { axes } else { axes * turn(info, *coordinate) }
        })
    }

    fn momenta(
        &self,
        b: &Frame,
        joints: &JointArray<[f64; 2]>,
        mut each: impl FnMut(BodyMomentum),
    ) {
        let mut parent = *b;
        for ((body, info), state) in self.bodies.iter().zip(joints.as_slice()) {
            let mut frame = parent.moved(Vector3::from(body.origin));
            if info.index == 0 {
                frame.axes = self.mount;
            }
            frame = frame.jointed(info, *state);
            each(frame.body(body.mass, Vector3::from(body.centre), body.inertia));
            parent = frame;
        }
    }
}

/// Calls `each` with the momentum of the hub, then of each device's bodies.
pub(crate) fn momenta(
    hub: &Hub,
    chains: &[Chain],
    state: &State<Set>,
    mut each: impl FnMut(BodyMomentum),
) {
    let nb = state.attitude.dcm().transpose();
    // Every point and axis is expressed in B, every velocity is inertial.
    let b = Frame {
        axes: Matrix3::identity(),
        omega: state.omega,
        origin: nb.tr_mul(&state.r_b_n),
        velocity: nb.tr_mul(&state.r_b_n_dot),
    };
    let mut in_n = |body: BodyMomentum| {
        each(BodyMomentum { linear: nb * body.linear, angular: nb * body.angular });
    };
    in_n(b.body(hub.m_b, hub.r_bc_b, hub.i_b_bc));
    for (chain, joints) in chains.iter().zip(&state.devices) {
        chain.momenta(&b, joints, &mut in_n);
    }
}

/// A frame on a moving body.
#[derive(Clone, Copy)]
struct Frame {
    /// Columns: the frame's axes expressed in B.
    axes: Matrix3<f64>,
    omega: Vector3<f64>,
    /// From the inertial origin, expressed in B, as all below.
    origin: Vector3<f64>,
    velocity: Vector3<f64>,
}

impl Frame {
    /// The same body, the origin moved by an offset expressed in the frame's axes.
    fn moved(&self, offset: Vector3<f64>) -> Self {
        let offset = self.axes * offset;
        Self {
            origin: self.origin + offset,
            velocity: self.velocity + self.omega.cross(&offset),
            ..*self
        }
    }

    /// The child body of a joint at this frame.
    fn jointed(&self, info: &JointInfo, [coordinate, rate]: [f64; 2]) -> Self {
        let axis = self.axes * unit(info);
        if info.slides {
            let moved = self.moved(unit(info) * coordinate);
            return Self { velocity: moved.velocity + axis * rate, ..moved };
        }
        Self { axes: self.axes * turn(info, coordinate), omega: self.omega + axis * rate, ..*self }
    }

    fn body(&self, mass: f64, centre: Vector3<f64>, inertia: Matrix3<f64>) -> BodyMomentum {
        let c = self.moved(centre);
        let linear = c.velocity * mass;
        let spin = c.axes * (inertia * c.axes.tr_mul(&c.omega));
        BodyMomentum { linear, angular: c.origin.cross(&linear) + spin }
    }
}

/// The axis of a joint, expressed in its parent's axes and in its child's.
fn unit(info: &JointInfo) -> Vector3<f64> {
    let mut axis = Vector3::zeros();
    axis[info.axis.min(2)] = 1.0;
    axis
}

/// The rotation of a joint about its axis.
fn turn(info: &JointInfo, angle: f64) -> Matrix3<f64> {
    // The solver's own sine: bit-identical on every host.
    let (sin, cos) = Angle::sin_cos(angle);
    match info.axis {
        0 => Matrix3::new(1.0, 0.0, 0.0, 0.0, cos, -sin, 0.0, sin, cos),
        1 => Matrix3::new(cos, 0.0, sin, 0.0, 1.0, 0.0, -sin, 0.0, cos),
        _ => Matrix3::new(cos, -sin, 0.0, sin, cos, 0.0, 0.0, 0.0, 1.0),
    }
}
