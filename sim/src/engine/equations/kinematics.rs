//! Poses and velocities of the bodies of any device and platform: body after body along the chain,
//! without the emitted kernels. A device on a platform continues the platform's chain.
//!
//! They turn wrenches that are given in N, and make the units of drift: sums over the bodies of the
//! magnitudes of the terms of their velocities, which cannot cancel as the velocities can,
//!
//! ```text
//! m (|v_B| + |omega x c| + |rates of slides| + ...)
//! ```
//!
//! Only the sum of the momenta themselves has to equal what the solver says; a test compares them.

use nalgebra::{Matrix3, Vector3};
use precess_craft::CraftState;
use precess_dynamics::kind::{BodyParameters, JointInfo};
use precess_dynamics::{Angle, Attitude, Hub, JointStates};

use crate::scenario::{Set, members};

/// Momentum of one body, expressed in N, and what is added in it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct BodyMomentum {
    /// m v, kg m/s.
    pub(crate) linear: Vector3<f64>,
    /// r x m v + I omega about the inertial origin, kg m²/s.
    pub(crate) angular: Vector3<f64>,
    /// Sums of the magnitudes of the terms; not below the momenta and the kinetic energy.
    pub(crate) sizes: Sizes,
}

/// Sums of magnitudes that cannot cancel.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(crate) struct Sizes {
    /// Of linear momentum, kg m/s.
    pub(crate) linear: f64,
    /// Of angular momentum about the inertial origin, kg m²/s.
    pub(crate) angular: f64,
    /// Of kinetic energy, J.
    pub(crate) kinetic: f64,
}

/// The bodies of a device or platform, from its base to the tip.
#[derive(Clone, Debug)]
pub(crate) struct Chain {
    mount: Matrix3<f64>,
    bodies: Vec<(BodyParameters<f64>, &'static JointInfo)>,
    /// The number of the first joint in the set.
    first: usize,
    /// The number of the platform's chain whose tip is the base; none on the hub.
    on: Option<usize>,
}

impl Chain {
    /// Those of a set, in order.
    pub(crate) fn all(set: &Set) -> Vec<Self> {
        let mut first = 0;
        let chain = |member: crate::scenario::Member<'_>| {
            let bodies: Vec<_> = member.bodies().into_iter().zip(member.joints()).collect();
            let of = Self { mount: member.mount(), first, on: member.on(), bodies };
            first += of.bodies.len();
            of
        };
        members(set).into_iter().map(chain).collect()
    }

    /// The number of the first joint in the set.
    pub(super) fn first(&self) -> usize {
        self.first
    }

    /// The number of the last one.
    pub(super) fn tip(&self) -> usize {
        (self.first + self.bodies.len()).saturating_sub(1)
    }

    /// The mount: columns are the device's axes, expressed in those of the base.
    pub(super) fn mount(&self) -> Matrix3<f64> {
        self.mount
    }

    /// The bodies and their joints, from the base to the tip.
    pub(super) fn bodies(&self) -> &[(BodyParameters<f64>, &'static JointInfo)] {
        &self.bodies
    }

    /// The number of the platform's chain whose tip is the base; none on the hub.
    pub(crate) fn on(&self) -> Option<usize> {
        self.on
    }

    /// The point that the load at the mount is about, from the origin of the base, in its axes: the
    /// origin of the first joint at coordinate zero.
    pub(crate) fn mount_point(&self) -> Vector3<f64> {
        let first = self.bodies.first();
        first.map_or_else(Vector3::zeros, |(body, _)| Vector3::from(body.origin))
    }

    /// Calls `each` with the momentum of each body; returns the frame of the tip.
    fn momenta(
        &self,
        base: &Frame,
        joints: &[[f64; 2]],
        mut each: impl FnMut(BodyMomentum),
    ) -> Frame {
        let mut parent = *base;
        for ((body, info), state) in self.bodies.iter().zip(joints.iter().skip(self.first)) {
            let mut frame = parent.moved(Vector3::from(body.origin));
            if info.index == 0 {
                frame.axes *= self.mount;
            }
            frame = frame.jointed(info, *state);
            each(frame.body(body.mass, Vector3::from(body.centre), body.inertia));
            parent = frame;
        }
        parent
    }
}

/// The axes of a body of a chain, columns expressed in B: those in which a wrench on it is given.
/// `joints` are those of the set.
///
/// A rotor that is the same from every angle has those of its parent body, as `Inputs::bodies` has
/// it.
pub(crate) fn axes(
    chains: &[Chain],
    chain: usize,
    index: usize,
    joints: &[[f64; 2]],
) -> Matrix3<f64> {
    let Some(own) = chains.get(chain) else { return Matrix3::identity() };
    // A platform is before the devices on it.
    let base = own.on.filter(|on| *on < chain);
    let base = base.map_or_else(Matrix3::identity, |on| axes(chains, on, usize::MAX - 1, joints));
    let turning = own.bodies.iter().zip(joints.iter().skip(own.first)).take(index + 1);
    turning.fold(base * own.mount, |axes, ((_, info), [coordinate, _])| {
        if info.slides || info.ignorable { axes } else { axes * turn(info, *coordinate) }
    })
}

/// Calls `each` with the momentum of the hub, then of the bodies of each device and platform.
pub(crate) fn momenta(
    hub: &Hub,
    chains: &[Chain],
    state: &CraftState,
    mut each: impl FnMut(BodyMomentum),
) {
    let nb = state.attitude.dcm().transpose();
    let b = Frame::of_hub(state);
    let mut in_n = |body: BodyMomentum| {
        each(BodyMomentum { linear: nb * body.linear, angular: nb * body.angular, ..body });
    };
    in_n(b.body(hub.m_b, hub.r_bc_b, hub.i_b_bc));
    let joints: Vec<_> = state.devices.states().collect();
    let mut tips = Vec::with_capacity(chains.len());
    for chain in chains {
        let base = chain.on.and_then(|on| tips.get(on)).copied().unwrap_or(b);
        tips.push(chain.momenta(&base, &joints, &mut in_n));
    }
}

/// The magnitude of a vector, also where its square is no number: a spacecraft may start 1e200 m from the origin.
pub(crate) fn magnitude(vector: &Vector3<f64>) -> f64 {
    let largest = vector.amax();
    let norm = vector.norm();
    if norm.is_finite() || !largest.is_finite() {
        norm
    } else {
        largest * (vector / largest).norm()
    }
}

/// A frame on a moving body.
#[derive(Clone, Copy)]
pub(super) struct Frame {
    /// Columns: the frame's axes expressed in B.
    pub(super) axes: Matrix3<f64>,
    pub(super) omega: Vector3<f64>,
    /// From the inertial origin, expressed in B, as all below.
    pub(super) origin: Vector3<f64>,
    pub(super) velocity: Vector3<f64>,
    /// Sums of the magnitudes of the terms of origin and velocity.
    far: f64,
    fast: f64,
}

impl Frame {
    /// That of the hub. Every point and axis is expressed in B, every velocity is inertial.
    pub(super) fn of_hub(state: &CraftState) -> Self {
        let nb = state.attitude.dcm().transpose();
        Self {
            axes: Matrix3::identity(),
            omega: state.omega,
            origin: nb.tr_mul(&state.r_b_n),
            velocity: nb.tr_mul(&state.r_b_n_dot),
            far: magnitude(&state.r_b_n),
            fast: magnitude(&state.r_b_n_dot),
        }
    }

    /// The same body, the origin moved by an offset expressed in the frame's axes.
    pub(super) fn moved(&self, offset: Vector3<f64>) -> Self {
        let offset = self.axes * offset;
        let turning = self.omega.cross(&offset);
        Self {
            origin: self.origin + offset,
            velocity: self.velocity + turning,
            far: self.far + magnitude(&offset),
            fast: self.fast + magnitude(&turning),
            ..*self
        }
    }

    /// The child body of a joint at this frame.
    pub(super) fn jointed(&self, info: &JointInfo, [coordinate, rate]: [f64; 2]) -> Self {
        let axis = self.axes * unit(info);
        if info.slides {
            let moved = self.moved(unit(info) * coordinate);
            let (velocity, fast) = (moved.velocity + axis * rate, moved.fast + rate.abs());
            return Self { velocity, fast, ..moved };
        }
        Self { axes: self.axes * turn(info, coordinate), omega: self.omega + axis * rate, ..*self }
    }

    fn body(&self, mass: f64, centre: Vector3<f64>, inertia: Matrix3<f64>) -> BodyMomentum {
        let c = self.moved(centre);
        let linear = c.velocity * mass;
        let spin = c.axes * (inertia * c.axes.tr_mul(&c.omega));
        let sizes = Sizes {
            linear: mass * c.fast,
            angular: mass * c.far * c.fast + magnitude(&spin),
            kinetic: 0.5 * (mass * c.fast * c.fast + spin.dot(&c.omega).abs()),
        };
        BodyMomentum { linear, angular: c.origin.cross(&linear) + spin, sizes }
    }
}

/// The axis of a joint, expressed in its parent's axes and in its child's.
pub(super) fn unit(info: &JointInfo) -> Vector3<f64> {
    let mut axis = Vector3::zeros();
    axis[info.axis.min(2)] = 1.0;
    axis
}

/// The rotation of a joint about its axis.
pub(crate) fn turn(info: &JointInfo, angle: f64) -> Matrix3<f64> {
    // The solver's own sine: bit-identical on every host.
    let (sin, cos) = Angle::sin_cos(angle);
    match info.axis {
        0 => Matrix3::new(1.0, 0.0, 0.0, 0.0, cos, -sin, 0.0, sin, cos),
        1 => Matrix3::new(cos, 0.0, sin, 0.0, 1.0, 0.0, -sin, 0.0, cos),
        _ => Matrix3::new(cos, -sin, 0.0, sin, cos, 0.0, 0.0, 0.0, 1.0),
    }
}
