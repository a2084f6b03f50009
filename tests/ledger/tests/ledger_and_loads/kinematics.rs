//! The reference of this suite: motion of the bodies from the hub to the tip, by velocity and
//! acceleration of points of a rigid body, without emitted code.

use nalgebra::{Matrix3, Rotation3, Unit, Vector3};
use precess_dynamics::kind::JointInfo;
use precess_dynamics::{Accelerations, Attitude, Each, Gravity, Hub, Wrench};

use super::craft::{Case, Chain, Craft};

/// A frame: where it is and how it moves, from B along B axes, seen from N.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Frame {
    /// Its axes as columns.
    pub(crate) axes: Matrix3<f64>,
    pub(crate) origin: Vector3<f64>,
    pub(crate) omega: Vector3<f64>,
    pub(crate) alpha: Vector3<f64>,
    pub(crate) velocity: Vector3<f64>,
    pub(crate) acceleration: Vector3<f64>,
    /// Sums of the magnitudes of the terms of `alpha` and `acceleration`.
    pub(crate) of_alpha: f64,
    pub(crate) of_acceleration: f64,
}

/// The child body of a joint.
#[derive(Clone, Debug)]
pub(crate) struct Body {
    pub(crate) frame: Frame,
    /// How far its joint's origin has slid, along B axes; that of the first body from the device's
    /// place.
    pub(crate) slid: Vector3<f64>,
    /// The axes in which its wrenches are expressed.
    pub(crate) load_axes: Matrix3<f64>,
    pub(crate) parent: Matrix3<f64>,
    pub(crate) mass: f64,
    /// Its centre of mass from its joint's origin, along B axes.
    pub(crate) arm: Vector3<f64>,
    /// The same from B.
    pub(crate) centre: Vector3<f64>,
    /// About the centre of mass, along B axes.
    pub(crate) inertia: Matrix3<f64>,
    pub(crate) info: &'static JointInfo,
    /// What acts on it from outside, about its joint's origin, along B axes.
    pub(crate) applied: Wrench,
}

impl Frame {
    /// Velocity and acceleration of a point fixed in the frame, this far from its origin, and the
    /// magnitudes of the latter.
    pub(crate) fn of_point(&self, arm: &Vector3<f64>) -> (Vector3<f64>, Vector3<f64>, f64) {
        let relative = self.omega.cross(arm);
        let acceleration = self.acceleration + self.alpha.cross(arm) + self.omega.cross(&relative);
        let (long, fast) = (arm.norm(), self.omega.norm());
        let of_terms = self.of_acceleration + self.of_alpha * long + fast * fast * long;
        (self.velocity + relative, acceleration, of_terms)
    }

    /// The frame of the child body of a joint, from the joint's origin in this frame.
    fn child(
        &self,
        info: &JointInfo,
        origin: &Vector3<f64>,
        [q, rate, acceleration]: [f64; 3],
    ) -> Self {
        let mut axis = Vector3::zeros();
        axis[info.axis] = 1.0;
        let hat = self.axes * axis;
        let slide = if info.slides { hat * q } else { Vector3::zeros() };
        let arm = self.axes * origin + slide;
        let (velocity, of_origin, of_terms) = self.of_point(&arm);
        let mut next = Self {
            origin: self.origin + arm,
            velocity,
            acceleration: of_origin,
            of_acceleration: of_terms,
            ..*self
        };
        // Twice the parent body's rate times the relative one, for a velocity or an angular
        // velocity.
        let turned = self.omega.cross(&(hat * rate));
        if info.slides {
            next.velocity += hat * rate;
            next.acceleration += hat * acceleration + turned * 2.0;
            next.of_acceleration += acceleration.abs() + 2.0 * self.omega.norm() * rate.abs();
        } else {
            next.axes =
                self.axes * Rotation3::from_axis_angle(&Unit::new_unchecked(axis), q).matrix();
            next.omega += hat * rate;
            next.alpha += hat * acceleration + turned;
            next.of_alpha += acceleration.abs() + self.omega.norm() * rate.abs();
        }
        next
    }
}

impl Body {
    /// Newton and Euler: force and moment about the joint's origin that the motion needs.
    pub(crate) fn needs(&self) -> Wrench {
        let (_, acceleration, _) = self.frame.of_point(&self.arm);
        let force = acceleration * self.mass;
        let momentum = self.inertia * self.frame.omega;
        let euler = self.inertia * self.frame.alpha + self.frame.omega.cross(&momentum);
        Wrench { force, moment: euler + self.arm.cross(&force) }
    }

    /// The magnitudes of the terms of that force and moment.
    pub(crate) fn sizes(&self) -> [f64; 2] {
        let force = self.frame.of_point(&self.arm).2 * self.mass;
        let rates = self.frame.of_alpha + self.frame.omega.norm_squared();
        [force, self.inertia.norm() * rates + self.arm.norm() * force]
    }
}

/// The hub's frame for some accelerations.
pub(crate) fn hub_frame<D: Craft>(case: &Case<D>, found: &Accelerations<D>) -> Frame {
    Frame {
        axes: Matrix3::identity(),
        origin: Vector3::zeros(),
        omega: case.state.omega,
        alpha: found.omega_dot,
        velocity: case.state.attitude.dcm() * case.state.r_b_n_dot,
        acceleration: found.r_b_n_ddot,
        of_alpha: found.omega_dot.norm(),
        of_acceleration: found.r_b_n_ddot.norm(),
    }
}

/// The bodies of every device, from the hub outwards.
pub(crate) fn bodies<D: Craft>(case: &Case<D>, found: &Accelerations<D>) -> Vec<Vec<Body>> {
    let hub = hub_frame(case, found);
    let given = case.inputs.bodies.as_ref().map(|all| all.values().collect());
    let wrenches: Vec<_> = given.unwrap_or_else(|| vec![Wrench::none(); case.joints().len()]);
    let joints = case.joints();
    let mut joints = joints.iter().zip(found.devices.values()).zip(wrenches);
    let mut devices = Vec::new();
    for chain in case.devices.chains() {
        let joints: Vec<_> = joints
            .by_ref()
            .take(chain.bodies.len())
            .map(|((&[q, rate], acceleration), wrench)| ([q, rate, acceleration], wrench))
            .collect();
        devices.push(outwards(case, &chain, &hub, &joints));
    }
    devices
}

fn outwards<D: Craft>(
    case: &Case<D>,
    chain: &Chain,
    hub: &Frame,
    joints: &[([f64; 3], Wrench)],
) -> Vec<Body> {
    // The first origin is along B axes, all others along the parent body's.
    let mut parent = Frame { axes: chain.mount, ..*hub };
    let mut bodies = Vec::new();
    for ((parameters, info), (joint, wrench)) in chain.bodies.iter().zip(chain.infos).zip(joints) {
        let mut origin = Vector3::from(parameters.origin);
        if info.index == 0 {
            origin = chain.mount.transpose() * origin;
        }
        let frame = parent.child(info, &origin, *joint);
        let load_axes = if info.tip && chain.round { parent.axes } else { frame.axes };
        let mut applied = turned(&load_axes, wrench);
        if let (true, Some([u_s, j_12, j_13])) = (info.tip, chain.lumped) {
            let square = joint[1] * joint[1];
            let force = Vector3::new(0.0, u_s, 0.0) * square;
            let moment = Vector3::new(0.0, j_13, -j_12) * square;
            applied = applied.plus(&turned(&frame.axes, &Wrench { force, moment }));
        }
        let arm = frame.axes * Vector3::from(parameters.centre);
        let body = Body {
            frame,
            slid: if info.slides {
                parent.axes.column(info.axis) * joint[0]
            } else {
                Vector3::zeros()
            },
            load_axes,
            parent: parent.axes,
            mass: parameters.mass,
            arm,
            centre: frame.origin + arm,
            inertia: frame.axes * parameters.inertia * frame.axes.transpose(),
            info,
            applied,
        };
        let pull = pull(case, body.mass, &body.centre, &body.inertia);
        let applied = body.applied.plus(&pull.moved(&arm));
        bodies.push(Body { applied, ..body });
        parent = frame;
    }
    bodies
}

/// What gravity exerts on a body about its centre of mass, along B axes: `m (g + G r)` and
/// `3 mu / R³ n x I n`, with the gradient G taken at B.
pub(crate) fn pull<D: Craft>(
    case: &Case<D>,
    mass: f64,
    centre: &Vector3<f64>,
    inertia: &Matrix3<f64>,
) -> Wrench {
    let bn = case.state.attitude.dcm();
    match case.inputs.gravity {
        Gravity::None => Wrench::none(),
        Gravity::Uniform(g) => Wrench { force: bn * g * mass, moment: Vector3::zeros() },
        Gravity::Central { mu } => {
            let r = bn * case.state.r_b_n;
            let (n, far) = (r.normalize(), r.norm());
            let field = n * (-mu / (far * far));
            let gradient = (n * (3.0 * n.dot(centre)) - centre) * (mu / far.powi(3));
            let moment = n.cross(&(inertia * n)) * (3.0 * mu / far.powi(3));
            Wrench { force: (field + gradient) * mass, moment }
        }
    }
}

/// Expressed in B, from these axes.
pub(crate) fn turned(axes: &Matrix3<f64>, wrench: &Wrench) -> Wrench {
    Wrench { force: axes * wrench.force, moment: axes * wrench.moment }
}

/// Newton and Euler of the hub, about B.
pub(crate) fn hub_needs<D: Craft>(case: &Case<D>, found: &Accelerations<D>) -> Wrench {
    let frame = hub_frame(case, found);
    let (_, acceleration, _) = frame.of_point(&case.hub.r_bc_b);
    let force = acceleration * case.hub.m_b;
    let gyroscopic = frame.omega.cross(&(case.hub.i_b_bc * frame.omega));
    let euler = case.hub.i_b_bc * frame.alpha + gyroscopic;
    Wrench { force, moment: euler + case.hub.r_bc_b.cross(&force) }
}

/// What gravity exerts on the hub about B, with the third-order force on the spacecraft that
/// belongs to the potential: `½ ∂(G : S)/∂R`, S the second moment of all bodies about B.
pub(crate) fn hub_pull<D: Craft>(case: &Case<D>, devices: &[Vec<Body>]) -> Wrench {
    let own = pull(case, case.hub.m_b, &case.hub.r_bc_b, &case.hub.i_b_bc);
    let own = own.moved(&case.hub.r_bc_b);
    let Gravity::Central { mu } = case.inputs.gravity else { return own };
    let r = case.state.attitude.dcm() * case.state.r_b_n;
    let (n, far) = (r.normalize(), r.norm());
    let of_hub = spread(case.hub.m_b, &case.hub.r_bc_b, &case.hub.i_b_bc);
    let spread = devices
        .iter()
        .flatten()
        .fold(of_hub, |sum, body| sum + spread(body.mass, &body.centre, &body.inertia));
    let along = spread * n;
    let force = along * 3.0 - n * (7.5 * n.dot(&along)) + n * (1.5 * spread.trace());
    Wrench { force: own.force + force * (mu / far.powi(4)), ..own }
}

/// Integral of `r rᵀ dm` about B.
fn spread(mass: f64, centre: &Vector3<f64>, inertia: &Matrix3<f64>) -> Matrix3<f64> {
    let own = Matrix3::from_diagonal_element(0.5 * inertia.trace()) - inertia;
    own + centre * centre.transpose() * mass
}

/// Gravity's force on the whole, along B axes.
pub(crate) fn weight<D: Craft>(case: &Case<D>, found: &Accelerations<D>) -> Vector3<f64> {
    let devices = bodies(case, found);
    let hub = hub_pull(case, &devices).force;
    let pulls = devices.iter().flatten();
    pulls.fold(hub, |sum, b| sum + pull(case, b.mass, &b.centre, &b.inertia).force)
}

/// Sums over the bodies of the magnitudes of linear momentum and, about a point from B along B
/// axes, of angular momentum: the units of drifts.
pub(crate) fn momentum_units<D: Craft>(
    case: &Case<D>,
    found: &Accelerations<D>,
    about: &Vector3<f64>,
) -> [f64; 2] {
    let hub = hub_frame(case, found);
    let mut sums = [0.0; 2];
    let mut count =
        |mass: f64, centre: &Vector3<f64>, velocity: Vector3<f64>, spin: Vector3<f64>| {
            sums[0] += mass * velocity.norm();
            sums[1] += mass * (centre - about).cross(&velocity).norm() + spin.norm();
        };
    let Hub { m_b, r_bc_b, i_b_bc } = case.hub;
    count(m_b, &r_bc_b, hub.of_point(&r_bc_b).0, i_b_bc * hub.omega);
    for body in bodies(case, found).into_iter().flatten() {
        let velocity = body.frame.of_point(&body.arm).0;
        count(body.mass, &body.centre, velocity, body.inertia * body.frame.omega);
    }
    sums
}
