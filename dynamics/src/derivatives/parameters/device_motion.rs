//! [`DeviceMotion`]: how the bodies of a device move, and what its loads change by with its parameters, the
//! accelerations given.
//!
//! A wrench acts on every joint inboard of it. A body enters by the wrench that its motion requires; the origin of a joint
//! moves all outboard bodies together, with the mass and first moment of their composite; a mount turns the whole device
//! with what acts on it, as seen from which the hub moves the other way.

use crate::derivatives::parameters::rigid_body::{ForceAndMoment, Motion, RigidBody, turned};
use crate::model::joint_array::MAX_JOINTS;
use crate::model::kind::{BodyParameters, JointInfo};
use crate::model::wrench::Wrench;
use crate::numbers::real::{Scalar, one, zero};
use crate::numbers::symmetric::Symmetric;
use crate::numbers::vec3::{Columns, Vec3, add, components, cross, dot, rotate, scale, sub, zeros};

/// What the loads of one device, or of the hub, change by: what the hub exerts, about B, B axes, and what each motor
/// exerts less spring and friction.
#[derive(Clone, Copy, Debug)]
pub(crate) struct LoadChange<T> {
    /// N.
    pub(crate) force: Vec3<T>,
    /// N m.
    pub(crate) moment: Vec3<T>,
    /// N m, or N of a sliding joint.
    pub(crate) joints: [T; MAX_JOINTS],
}

/// A joint with its child body, as given.
#[derive(Clone, Copy, Debug)]
pub(crate) struct GivenJoint<T> {
    pub(crate) info: &'static JointInfo,
    pub(crate) body: BodyParameters<T>,
    /// Coordinate and rate.
    pub(crate) state: [T; 2],
    pub(crate) acceleration: T,
    /// The wrench on the body from outside, about its origin, own axes.
    pub(crate) applied: Wrench<T>,
}

/// A body in motion, with its joint. Expressed in B unless said otherwise.
#[derive(Clone, Copy, Debug)]
struct Body<T> {
    rigid: RigidBody<T>,
    axes: Columns<T>,
    /// The axis of the joint, also in own axes, and whether it slides.
    axis: Vec3<T>,
    own_axis: Vec3<T>,
    slides: bool,
    /// Velocity relative to the parent body of one that slides.
    slide: Vec3<T>,
    /// Origin from that of the parent body.
    lever: Vec3<T>,
    motion: Motion<T>,
    /// The motion, own axes.
    own: Motion<T>,
    /// Mass and first moment about the origin of this body and all outboard of it.
    composite: (T, Vec3<T>),
    /// What the parent body exerts, about the origin.
    exerted: ForceAndMoment<T>,
}

/// The bodies of a device.
#[derive(Clone, Debug)]
pub(crate) struct DeviceMotion<T> {
    hub: Motion<T>,
    /// Origin of the first joint at coordinate zero from B.
    place: Vec3<T>,
    bodies: [Body<T>; MAX_JOINTS],
    count: usize,
}

impl<T: Scalar> LoadChange<T> {
    pub(crate) fn none() -> Self {
        Self { force: zeros(), moment: zeros(), joints: [zero(); MAX_JOINTS] }
    }

    /// Of the hub alone.
    pub(crate) fn of_hub((force, moment): ForceAndMoment<T>) -> Self {
        Self { force, moment, ..Self::none() }
    }
}

impl<T: Scalar> Body<T> {
    fn none() -> Self {
        let still =
            Motion { omega: zeros(), spin: zeros(), omega_dot: zeros(), acceleration: zeros() };
        Self {
            rigid: RigidBody { mass: zero(), centre: zeros(), inertia: Symmetric::zero() },
            axes: [zeros(); 3],
            axis: zeros(),
            own_axis: zeros(),
            slides: false,
            slide: zeros(),
            lever: zeros(),
            motion: still,
            own: still,
            composite: (zero(), zeros()),
            exerted: (zeros(), zeros()),
        }
    }

    /// The component along the joint of what its parent body exerts.
    fn along(&self, (force, moment): ForceAndMoment<T>) -> T {
        dot(self.axis, if self.slides { force } else { moment })
    }

    /// The same of what is expressed in own axes. A fast rotor exerts nothing about its axis by the square of its rate,
    /// of which a rotation leaves rounding.
    fn along_own(&self, (force, moment): ForceAndMoment<T>) -> T {
        dot(self.own_axis, if self.slides { force } else { moment })
    }

    /// A wrench about the origin, about that of the parent body.
    fn about_parent(&self, (force, moment): ForceAndMoment<T>) -> ForceAndMoment<T> {
        (force, add(moment, cross(self.lever, force)))
    }
}

impl<T: Scalar> DeviceMotion<T> {
    /// No device.
    pub(crate) fn none() -> Self {
        let Body { motion, .. } = Body::none();
        Self { hub: motion, place: zeros(), bodies: [Body::none(); MAX_JOINTS], count: 0 }
    }

    /// Becomes that of a device on a hub that moves so, expressed in B, with at most [`MAX_JOINTS`] joints.
    pub(crate) fn set(
        &mut self,
        hub: &Motion<T>,
        mount: &Columns<T>,
        joints: impl Iterator<Item = GivenJoint<T>>,
    ) {
        (self.hub, self.count) = (*hub, 0);
        let mut applied = [(zeros(), zeros()); MAX_JOINTS];
        let (mut axes, mut parent) = (*mount, *hub);
        for ((to, applied), joint) in self.bodies.iter_mut().zip(&mut applied).zip(joints) {
            // The first origin is expressed in B.
            let mut offset = joint.body.origin;
            if self.count == 0 {
                self.place = offset;
            } else {
                offset = rotate(&axes, offset);
            }
            outward(&axes, &parent, offset, &joint, to);
            *applied = (components(&joint.applied.force), components(&joint.applied.moment));
            (axes, parent) = (to.axes, to.motion);
            self.count = self.count.saturating_add(1);
        }
        self.load(&applied);
    }

    /// The bodies of the first joints, at most all.
    fn first(&self, joints: usize) -> &[Body<T>] {
        self.bodies.get(..joints.min(self.count)).unwrap_or_default()
    }

    /// The inward pass: composites, and what each joint exerts.
    fn load(&mut self, applied: &[ForceAndMoment<T>; MAX_JOINTS]) {
        let (mut composite, mut exerted) = ((zero(), zeros()), (zeros(), zeros()));
        let bodies = self.bodies.get_mut(..self.count).unwrap_or_default();
        let applied = applied.get(..bodies.len()).unwrap_or_default();
        for (body, applied) in bodies.iter_mut().rev().zip(applied.iter().rev()) {
            let RigidBody { mass, centre, .. } = body.rigid;
            let (force, moment) = body.rigid.wrench(&body.own);
            let net = (sub(force, applied.0), sub(moment, applied.1));
            let first_moment = rotate(&body.axes, scale(mass, centre));
            composite = (composite.0 + mass, add(composite.1, first_moment));
            exerted = plus(exerted, turned(&body.axes, net));
            (body.composite, body.exerted) = (composite, exerted);
            composite.1 = add(composite.1, scale(composite.0, body.lever));
            exerted = body.about_parent(exerted);
        }
    }

    /// Adds the change by mass, centre of mass and inertia of the body of a joint.
    pub(crate) fn add_by_body(
        &self,
        joint: usize,
        change: &RigidBody<T>,
        load: &mut LoadChange<T>,
    ) {
        let Some(body) = self.bodies.get(joint) else { return };
        let own = body.rigid.wrench_by_body(&body.own, change);
        if let Some(to) = load.joints.get_mut(joint) {
            *to = *to + body.along_own(own);
        }
        self.inward(joint, body.about_parent(turned(&body.axes, own)), load);
    }

    /// Adds the change by the origin of a joint, in the axes of its parent body, of the first joint in B.
    pub(crate) fn add_by_origin(&self, joint: usize, change: Vec3<T>, load: &mut LoadChange<T>) {
        let Some(moved) = self.bodies.get(joint) else { return };
        let parent = joint.checked_sub(1).and_then(|parent| self.bodies.get(parent));
        let (motion, change) = parent
            .map_or((&self.hub, change), |parent| (&parent.motion, rotate(&parent.axes, change)));
        let acceleration = motion.relative(change);
        let of = |(mass, first_moment): (T, Vec3<T>)| {
            (scale(mass, acceleration), cross(first_moment, acceleration))
        };
        let joints = self.first(MAX_JOINTS).iter().zip(&mut load.joints);
        for (body, to) in joints.skip(joint) {
            *to = *to + body.along(of(body.composite));
        }
        let (force, moment) = moved.about_parent(of(moved.composite));
        let lever = cross(change, moved.exerted.0);
        self.inward(joint, (force, add(moment, lever)), load);
    }

    /// The change by a small rotation of the mount about an axis, expressed in B.
    pub(crate) fn by_mount(&self, about: Vec3<T>) -> LoadChange<T> {
        let mut load = LoadChange::none();
        // As seen from the device, the hub turns the other way.
        let mut parent = self.hub;
        parent.acceleration = add(parent.acceleration, parent.relative(self.place));
        let mut change = Motion {
            omega: cross(parent.omega, about),
            spin: zeros(),
            omega_dot: cross(parent.omega_dot, about),
            acceleration: cross(parent.acceleration, about),
        };
        // Expressed in own axes.
        let mut wrenches = [(zeros(), zeros()); MAX_JOINTS];
        let mut from = self.place;
        let bodies = self.first(MAX_JOINTS);
        for (body, wrench) in bodies.iter().zip(&mut wrenches) {
            let relative = parent.relative_change(&change, sub(body.lever, from));
            change.acceleration = add(change.acceleration, relative);
            change.omega_dot = add(change.omega_dot, cross(change.omega, parent.spin));
            let by_slide = cross(change.omega, body.slide);
            change.acceleration = add(change.acceleration, add(by_slide, by_slide));
            *wrench = body.rigid.wrench_by_motion(&body.own, &change.within(&body.axes));
            (parent, from) = (body.motion, zeros());
        }
        let mut sum = (zeros(), zeros());
        let joints = load.joints.get_mut(..bodies.len()).unwrap_or_default();
        let wrenches = wrenches.get(..bodies.len()).unwrap_or_default();
        let rows = joints.iter_mut().rev().zip(wrenches.iter().rev());
        for (body, (to, wrench)) in bodies.iter().rev().zip(rows) {
            *to = body.along(sum) + body.along_own(*wrench);
            sum = body.about_parent(plus(sum, turned(&body.axes, *wrench)));
        }
        // What the hub exerts turns about the place, which stays.
        if let Some(Body { lever, exerted: (force, moment), .. }) = bodies.first() {
            let at_place = add(*moment, cross(sub(*lever, self.place), *force));
            let force = cross(about, *force);
            load.force = add(sum.0, force);
            load.moment = add(sum.1, add(cross(about, at_place), cross(self.place, force)));
        }
        load
    }

    /// Adds a wrench about the origin of the last of some joints, about B of none, to them and the hub.
    fn inward(&self, joints: usize, mut wrench: ForceAndMoment<T>, load: &mut LoadChange<T>) {
        let bodies = self.first(joints);
        let joints = load.joints.get_mut(..bodies.len()).unwrap_or_default();
        for (body, to) in bodies.iter().rev().zip(joints.iter_mut().rev()) {
            *to = *to + body.along(wrench);
            wrench = body.about_parent(wrench);
        }
        load.force = add(load.force, wrench.0);
        load.moment = add(load.moment, wrench.1);
    }
}

/// Writes a body outboard of one with these axes and this motion; composite and loads come inward.
fn outward<T: Scalar>(
    axes: &Columns<T>,
    parent: &Motion<T>,
    offset: Vec3<T>,
    joint: &GivenJoint<T>,
    to: &mut Body<T>,
) {
    let GivenJoint { info, state: [coordinate, rate], acceleration, .. } = *joint;
    let axis = axes.get(info.axis).copied().unwrap_or_else(zeros);
    let lever = if info.slides { add(offset, scale(coordinate, axis)) } else { offset };
    let (along, relative) = (scale(acceleration, axis), scale(rate, axis));
    let mut motion = parent.base();
    motion.acceleration = add(motion.acceleration, parent.relative(lever));
    let (mut own_axes, mut slide) = (*axes, zeros());
    if info.slides {
        let coriolis = cross(motion.omega, relative);
        motion.acceleration = add(motion.acceleration, add(along, add(coriolis, coriolis)));
        slide = relative;
    } else {
        motion.omega_dot = add(motion.omega_dot, along);
        motion.spin = relative;
        // A rotor that is the same from every angle has the axes of its parent body.
        if !info.ignorable {
            own_axes = turned_about(axes, info.axis, coordinate);
        }
    }
    let mut own = motion.within(&own_axes);
    let own_axis = [0, 1, 2].map(|place| if place == info.axis { one() } else { zero() });
    if !info.slides {
        own.spin = scale(rate, own_axis);
    }
    (to.rigid, to.axes) = (RigidBody::of(&joint.body), own_axes);
    (to.axis, to.own_axis, to.slides) = (axis, own_axis, info.slides);
    (to.slide, to.lever) = (slide, lever);
    (to.motion, to.own) = (motion, own);
}

/// Axes after a rotation about one of them.
fn turned_about<T: Scalar>(axes: &Columns<T>, axis: usize, angle: T) -> Columns<T> {
    let (sine, cosine) = angle.sin_cos();
    let turn =
        |y, z| (add(scale(cosine, y), scale(sine, z)), sub(scale(cosine, z), scale(sine, y)));
    let [x, y, z] = *axes;
    match axis {
        0 => {
            let (y, z) = turn(y, z);
            [x, y, z]
        }
        1 => {
            let (z, x) = turn(z, x);
            [x, y, z]
        }
        _ => {
            let (x, y) = turn(x, y);
            [x, y, z]
        }
    }
}

fn plus<T: Scalar>(a: ForceAndMoment<T>, b: ForceAndMoment<T>) -> ForceAndMoment<T> {
    (add(a.0, b.0), add(a.1, b.1))
}
