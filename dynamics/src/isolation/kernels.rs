//! The kernels of a platform by itself, expressed in the axes of its mount: what other kinds have
//! emitted, written by hand for six joints in the axes of one body.

#![expect(clippy::inline_always, reason = "lanes reach wide instructions only in what is inlined")]

use crate::equations::assembly::Assembly;
use crate::equations::gravity::gradient_moment;
use crate::equations::hub::{BodySums, HubConstants};
use crate::generated::hub::{BodyAcceleration, BodyRate, BodyVelocity, EnergyMomentum};
use crate::isolation::elimination::{Eliminated, eliminate, moved};
use crate::isolation::motion::{
    Motion, Moving, Pose, Spatial, about_x, about_y, about_z, identity, transposed,
};
use crate::isolation::records::{JointAccelerations, Joints, PerJoint};
use crate::model::mode::Drive;
use crate::model::wrench::{Carried, Wrench};
use crate::numbers::each::Value;
use crate::numbers::real::{Real, Scalar};
use crate::numbers::symmetric::Symmetric;
use crate::numbers::vec3::{
    Columns, Vec3, add, components, cross, map, rotate, rotate_transposed, scale,
};

/// Constants of a carrier.
#[derive(Clone, Copy, Debug)]
pub struct Constants<T> {
    /// Columns: the mount's axes expressed in B.
    pub(crate) mount: Columns<T>,
    /// P from B with every coordinate zero, mount axes.
    pub(crate) origin: Vec3<T>,
    /// The carrier about P, carrier axes.
    pub(crate) body: HubConstants<T>,
}

/// Wrenches on the bodies of a platform.
type Wrenches<T> = PerJoint<Wrench<T>>;

impl<T: Real> Constants<T> {
    /// Axes of the mount and origin, expressed in the base.
    #[inline(always)]
    pub(crate) fn place(&self) -> (&Columns<T>, Vec3<T>) {
        (&self.mount, rotate(&self.mount, self.origin))
    }
}

impl<T: Value> Constants<T> {
    /// Constants joined number by number.
    #[inline(always)]
    pub(crate) fn zip<U: Value, W: Value>(
        &self,
        other: &Constants<U>,
        mut join: impl FnMut(T, U) -> W,
    ) -> Constants<W> {
        let mut vector =
            |a: [T; 3], b: [U; 3]| [join(a[0], b[0]), join(a[1], b[1]), join(a[2], b[2])];
        let mount: Columns<W> = [
            vector(self.mount[0], other.mount[0]),
            vector(self.mount[1], other.mount[1]),
            vector(self.mount[2], other.mount[2]),
        ];
        let origin = vector(self.origin, other.origin);
        Constants { mount, origin, body: self.body.zip(&other.body, join) }
    }
}

impl<T: Real + Value> Constants<T> {
    /// The motion on a base expressed in mount axes.
    #[inline(always)]
    fn in_mount(&self, pose: &Pose<T>, joints: &Joints<T>, omega: Vec3<T>) -> Moving<T, 6> {
        Moving::of_platform((&identity(self.body.m_b), self.origin), pose, joints, omega)
    }

    /// The motion on the base, expressed in it.
    #[inline(always)]
    pub(crate) fn moving(
        &self,
        pose: &Pose<T>,
        joints: &Joints<T>,
        omega: Vec3<T>,
    ) -> Moving<T, 6> {
        Moving::of_platform(self.place(), pose, joints, omega)
    }

    /// The elimination of a platform that carries nothing.
    #[inline(always)]
    pub(crate) fn eliminate(
        &self,
        pose: &Pose<T>,
        joints: &Joints<T>,
        omega: &BodyRate<T>,
        drives: &PerJoint<Drive<T>>,
    ) -> Eliminated<T, 6> {
        let none = [self.body.m_b.like(0.0); 3];
        let moving = self.moving(pose, joints, [omega.omega_bx, omega.omega_by, omega.omega_bz]);
        eliminate(&moving, none, &Assembly::new(&self.body, none, none), drives.array())
    }

    /// Wrenches on the bodies, each about its joint's origin in its own axes, summed from the
    /// platform inwards; the last about B.
    #[inline(always)]
    pub(crate) fn external(
        &self,
        pose: &Pose<T>,
        bodies: &Wrenches<T>,
    ) -> Carried<Wrenches<T>, Wrench<T>> {
        let zero = self.body.m_b.like(0.0);
        let [x_slide, y_slide, z_slide, x_turn, y_turn, platform] = bodies.array().map(parts);
        let [x, y, z] = pose.slid;
        let carried = |[f, n]: Spatial<T>, own: Spatial<T>, arm: Vec3<T>| {
            [add(own[0], f), add(own[1], add(n, cross(arm, f)))]
        };
        let y_turn = turned(platform, y_turn, |v| about_z(pose.z, v));
        let x_turn = turned(y_turn, x_turn, |v| about_y(pose.y, v));
        let z_slide = turned(x_turn, z_slide, |v| about_x(pose.x, v));
        let y_slide = carried(z_slide, y_slide, [zero, zero, z]);
        let x_slide = carried(y_slide, x_slide, [zero, y, zero]);
        let [o_x, o_y, o_z] = self.origin;
        let hub = carried(x_slide, [[zero; 3]; 2], [o_x + x, o_y, o_z]);
        let joints = [x_slide, y_slide, z_slide, x_turn, y_turn, platform].map(wrench);
        Carried { joints: PerJoint::of(joints), hub: wrench(hub) }
    }

    /// The wrench of the field `G r` on the platform, and its second moment about B, mount axes.
    #[inline(always)]
    pub(crate) fn gravity(&self, pose: &Pose<T>, gradient: [T; 6]) -> (Wrenches<T>, [T; 6]) {
        let [xx, xy, xz, yy, yz, zz] = gradient;
        let turned = pose.turned();
        let gradient = Symmetric { xx, xy, xz, yy, yz, zz }.rotated(&transposed(&turned));
        let p = add(self.origin, pose.slid);
        let (s, own) = (self.body.first_moment, self.body.second_moment());
        let at_p = gradient.times(rotate_transposed(&turned, p));
        let force = add(scale(self.body.m_b, at_p), gradient.times(s));
        let moment = add(cross(s, at_p), gradient_moment(&gradient, &own));
        let none = [[self.body.m_b.like(0.0); 3]; 2];
        let wrenches = [none, none, none, none, none, [force, moment]].map(wrench);
        let e = moved_second_moment(&self.body, &own, &turned, p);
        (PerJoint::of(wrenches), [e.xx, e.xy, e.xz, e.yy, e.yz, e.zz])
    }
}

impl<T: Scalar> Constants<T> {
    /// Kinetic energy and momenta, mount axes.
    pub(crate) fn energy_momentum(
        &self,
        pose: &Pose<T>,
        joints: &Joints<T>,
        hub: &BodyVelocity<T>,
    ) -> EnergyMomentum<T> {
        let omega = [hub.omega_bx, hub.omega_by, hub.omega_bz];
        let motion = self.in_mount(pose, joints, omega);
        let velocity = motion.velocity([hub.r_b_n_dot_bx, hub.r_b_n_dot_by, hub.r_b_n_dot_bz]);
        let sums = motion.on_base(&self.body.sums(velocity, motion.omega));
        let ([linear_bx, linear_by, linear_bz], [angular_b_bx, angular_b_by, angular_b_bz]) =
            (sums.linear, sums.angular_b);
        let energy = sums.energy;
        EnergyMomentum {
            energy,
            linear_bx,
            linear_by,
            linear_bz,
            angular_b_bx,
            angular_b_by,
            angular_b_bz,
        }
    }

    /// First moment about B and its derivative seen from B, mount axes.
    pub(crate) fn first_moment(&self, pose: &Pose<T>, joints: &Joints<T>) -> [Vec3<T>; 2] {
        let still = [crate::numbers::real::zero(); 3];
        let motion = self.in_mount(pose, joints, still);
        motion.first_moments(self.body.m_b, [self.body.first_moment, still])
    }

    /// What the bodies need for these accelerations, each about its joint's origin in its own
    /// axes, and about B, mount axes.
    pub(crate) fn loads(
        &self,
        pose: &Pose<T>,
        joints: &Joints<T>,
        omega: &BodyRate<T>,
        hub: &BodyAcceleration<T>,
        accelerations: &JointAccelerations<T>,
    ) -> Carried<Wrenches<T>, Wrench<T>> {
        let motion = self.in_mount(pose, joints, [omega.omega_bx, omega.omega_by, omega.omega_bz]);
        let linear = [hub.r_b_n_ddot_bx, hub.r_b_n_ddot_by, hub.r_b_n_ddot_bz];
        let angular = [hub.omega_dot_bx, hub.omega_dot_by, hub.omega_dot_bz];
        let [v, w] = motion.acceleration([linear, angular], accelerations.array());
        let platform = self.body.needs(motion.omega, v, w);
        self.external(pose, &PerJoint { platform, ..PerJoint::all(Wrench::none()) })
    }
}

impl<T: Real> Pose<T> {
    /// The axes of each body in the mount's, as columns.
    pub(crate) fn axes(&self) -> [Columns<T>; 6] {
        let unit = identity(self.x.0);
        let x_turn = map(unit, |axis| about_x(self.x, axis));
        let y_turn = map(unit, |axis| about_x(self.x, about_y(self.y, axis)));
        [unit, unit, unit, x_turn, y_turn, self.turned()]
    }
}

impl<T: Scalar> Motion<T> {
    /// Energy and momenta about P in carrier axes, as about the origin of the base in its axes.
    pub(crate) fn on_base(&self, sums: &BodySums<T>) -> BodySums<T> {
        let linear = rotate(&self.axes, sums.linear);
        let angular_b = add(rotate(&self.axes, sums.angular_b), cross(self.p, linear));
        BodySums { energy: sums.energy, linear, angular_b }
    }

    /// First moment about P in carrier axes, and its derivative seen from the carrier, of what
    /// has a mass: as about the origin of the base, seen from it.
    pub(crate) fn first_moments(&self, mass: T, [s, s_prime]: [Vec3<T>; 2]) -> [Vec3<T>; 2] {
        let prime = rotate(&self.axes, add(s_prime, cross(self.relative, s)));
        [add(scale(mass, self.p), rotate(&self.axes, s)), add(scale(mass, self.p_prime), prime)]
    }
}

/// The second moment about the origin of the base from that about P.
#[inline(always)]
pub(crate) fn moved_second_moment<T: Real>(
    body: &HubConstants<T>,
    own: &Symmetric<T>,
    axes: &Columns<T>,
    p: Vec3<T>,
) -> Symmetric<T> {
    let (half, minus_one) = (body.m_b.like(0.5), body.m_b.like(-1.0));
    // The inertia with this second moment: tr(S) 1 - S.
    let i_b_b = Symmetric::scalar(own.trace()).plus(own.scaled(minus_one));
    let (_, inertia) = moved(&HubConstants { i_b_b, ..*body }, axes, p);
    Symmetric::scalar(half * inertia.trace()).plus(inertia.scaled(minus_one))
}

/// A body's own wrench and that of its child body, which is turned into the body's axes.
#[inline(always)]
fn turned<T: Real>(
    [force, moment]: Spatial<T>,
    own: Spatial<T>,
    turn: impl Fn(Vec3<T>) -> Vec3<T>,
) -> Spatial<T> {
    [add(own[0], turn(force)), add(own[1], turn(moment))]
}

/// Force and moment of a wrench.
#[inline(always)]
fn parts<T: Real>(wrench: Wrench<T>) -> Spatial<T> {
    [components(&wrench.force), components(&wrench.moment)]
}

/// A wrench from force and moment.
#[inline(always)]
fn wrench<T: Real>([force, moment]: Spatial<T>) -> Wrench<T> {
    Wrench::of(force, moment)
}
