//! [`Platform`] as a kind of device: its joints by name, its parameters by name, its kernels.
//!
//! By itself it is a set of one device, a mass on springs; [`Isolated`](crate::Isolated) carries
//! devices on it.

#![expect(clippy::inline_always, reason = "lanes reach wide instructions only in what is inlined")]

use nalgebra::Matrix3;

use crate::equations::hub::HubConstants;
use crate::generated::hub::{
    BodyAcceleration, BodyRate, BodyVelocity, ConstantShare, EnergyMomentum, HubShare,
};
use crate::isolation::elimination::{Eliminated, Gains, zip_each};
use crate::isolation::kernels::Constants;
use crate::isolation::motion::Pose;
use crate::isolation::parameters::Platform;
use crate::isolation::records::{JointAccelerations, Joints, MotorTorques, PerJoint, at_rest};
use crate::model::kernels::Kernels;
use crate::model::kind::{
    BodyParameters, Carried, Drive, ImbalanceModel, JointInfo, Kind, ParameterInfo, ParameterMut,
    Shape, Wrenches, components, no_inertia, vector, zero,
};
use crate::model::parameters::Hub;
use crate::model::passive::Passive;
use crate::model::wrench::Wrench;
use crate::numbers::each::Value;
use crate::numbers::real::{Real, Scalar};
use crate::numbers::vec3::{Columns, columns};

impl<S: Scalar> Kernels for Platform<S> {
    type Constants<T: Value> = Constants<T>;
    type Joints<T: Value> = Joints<T>;
    type Accelerations<T: Value> = JointAccelerations<T>;
    type PerJoint<V: Value> = PerJoint<V>;
    type Pose<T: Value> = Pose<T>;
    type Eliminated<T: Value> = Eliminated<T, 6>;
    type Gains<T: Value> = Gains<T, 6>;

    #[inline(always)]
    fn pose_by<T: Value>(
        joints: &Joints<T>,
        mut sin_cos: impl FnMut(usize, T) -> (T, T),
    ) -> Pose<T> {
        let slid = [joints.x, joints.y, joints.z];
        let (x, y) = (sin_cos(3, joints.alpha), sin_cos(4, joints.beta));
        Pose { slid, x, y, z: sin_cos(5, joints.gamma) }
    }

    #[inline(always)]
    fn eliminate<T: Real>(
        constants: &Constants<T>,
        pose: &Pose<T>,
        joints: &Joints<T>,
        omega: &BodyRate<T>,
        drives: &PerJoint<Drive<T>>,
    ) -> Eliminated<T, 6> {
        constants.eliminate(pose, joints, omega, drives)
    }

    #[inline(always)]
    fn share<T: Real>(eliminated: &Eliminated<T, 6>) -> &HubShare<T> {
        &eliminated.share
    }

    #[inline(always)]
    fn gains<T: Real>(eliminated: &Eliminated<T, 6>) -> &Gains<T, 6> {
        &eliminated.gains
    }

    #[inline(always)]
    fn pivots<T: Real>(eliminated: &Eliminated<T, 6>) -> PerJoint<Option<[T; 2]>> {
        PerJoint::of(eliminated.pivots.map(Some))
    }

    #[inline(always)]
    fn back_substitute<T: Real>(
        gains: &Gains<T, 6>,
        hub: &BodyAcceleration<T>,
    ) -> JointAccelerations<T> {
        JointAccelerations::of(gains.outward(hub).0)
    }

    #[inline(always)]
    fn slope<T: Value>(joints: &Joints<T>, accelerations: &JointAccelerations<T>) -> Joints<T> {
        Joints::of(joints.rates(), accelerations.array())
    }

    #[inline(always)]
    fn external<T: Real>(
        constants: &Constants<T>,
        pose: &Pose<T>,
        bodies: &PerJoint<Wrench<T>>,
    ) -> Carried<PerJoint<Wrench<T>>, Wrench<T>> {
        constants.external(pose, bodies)
    }

    #[inline(always)]
    fn gravity<T: Real>(
        constants: &Constants<T>,
        pose: &Pose<T>,
        gradient: [T; 6],
    ) -> (PerJoint<Wrench<T>>, [T; 6]) {
        constants.gravity(pose, gradient)
    }

    #[inline(always)]
    fn zip_constants<T: Value, U: Value, W: Value>(
        a: &Constants<T>,
        b: &Constants<U>,
        join: impl FnMut(T, U) -> W,
    ) -> Constants<W> {
        a.zip(b, join)
    }

    #[inline(always)]
    fn zip_joints<T: Value, U: Value, W: Value>(
        a: &Joints<T>,
        b: &Joints<U>,
        mut join: impl FnMut(T, U) -> W,
    ) -> Joints<W> {
        let coordinates = zip_each(a.coordinates(), b.coordinates(), &mut join);
        Joints::of(coordinates, zip_each(a.rates(), b.rates(), join))
    }

    #[inline(always)]
    fn zip_gains<T: Value, U: Value, W: Value>(
        a: &Gains<T, 6>,
        b: &Gains<U, 6>,
        join: impl FnMut(T, U) -> W,
    ) -> Gains<W, 6> {
        a.zip(b, join)
    }

    #[inline(always)]
    fn zip_accelerations<T: Value, U: Value, W: Value>(
        a: &JointAccelerations<T>,
        b: &JointAccelerations<U>,
        join: impl FnMut(T, U) -> W,
    ) -> JointAccelerations<W> {
        JointAccelerations::of(zip_each(a.array(), b.array(), join))
    }

    #[inline(always)]
    fn zip_per_joint<T: Value, U: Value, W: Value>(
        a: &PerJoint<T>,
        b: &PerJoint<U>,
        join: impl FnMut(T, U) -> W,
    ) -> PerJoint<W> {
        PerJoint::of(zip_each(a.array(), b.array(), join))
    }
}

/// A joint of the platform: where it is, its child body, its names, its axis.
const fn joint(
    index: usize,
    body: &'static str,
    [coordinate, rate, acceleration, motor]: [&'static str; 4],
) -> JointInfo {
    JointInfo {
        index,
        body,
        coordinate,
        rate,
        acceleration,
        motor,
        axis: index % 3,
        slides: index < 3,
        ignorable: false,
        driven: true,
        tip: index == 5,
    }
}

/// A parameter of the platform.
const fn parameter(
    [name, symbol, unit]: [&'static str; 3],
    shape: Shape,
    frame: Option<&'static str>,
    meaning: &'static str,
) -> ParameterInfo {
    let body = if matches!(shape, Shape::Rotation) { None } else { Some("platform") };
    ParameterInfo { name, symbol, unit, shape, frame, body, meaning }
}

impl<T: Scalar> Kind for Platform<T> {
    type Scalar = T;
    type Motors = MotorTorques<T>;
    type With<U: Scalar> = Platform<U>;

    const NAME: &'static str = "platform";

    const JOINTS: &'static [JointInfo] = &[
        joint(0, "x slide", ["x", "x_dot", "x_ddot", "f_x"]),
        joint(1, "y slide", ["y", "y_dot", "y_ddot", "f_y"]),
        joint(2, "z slide", ["z", "z_dot", "z_ddot", "f_z"]),
        joint(3, "x turn", ["alpha", "alpha_dot", "alpha_ddot", "u_x"]),
        joint(4, "y turn", ["beta", "beta_dot", "beta_ddot", "u_y"]),
        joint(5, "platform", ["gamma", "gamma_dot", "gamma_ddot", "u_z"]),
    ];

    const PARAMETERS: &'static [ParameterInfo] = &[
        parameter(
            ["mount", "mount", "1"],
            Shape::Rotation,
            Some("B"),
            "columns: the axes of the mount, those of the platform at zero",
        ),
        parameter(
            ["r_p_b", "r_{P/B}", "m"],
            Shape::Vector,
            Some("B"),
            "origin of the platform from B, every coordinate zero",
        ),
        parameter(["m_p", "m_P", "kg"], Shape::Scalar, None, "mass of the platform"),
        parameter(
            ["r_pc_p", "r_{Pc/P}", "m"],
            Shape::Vector,
            Some("platform"),
            "centre of mass of the platform from its origin",
        ),
        parameter(
            ["i_p_pc", "[I_{P,Pc}]", "kg m²"],
            Shape::Symmetric,
            Some("platform"),
            "inertia of the platform about its centre of mass",
        ),
    ];

    fn parameter_mut(&mut self, name: &str) -> Option<ParameterMut<'_, T>> {
        Some(match name {
            "mount" => ParameterMut::Matrix(&mut self.mount),
            "r_p_b" => ParameterMut::Vector(&mut self.r_p_b),
            "m_p" => ParameterMut::Scalar(&mut self.m_p),
            "r_pc_p" => ParameterMut::Vector(&mut self.r_pc_p),
            "i_p_pc" => ParameterMut::Matrix(&mut self.i_p_pc),
            _ => return None,
        })
    }

    fn passive_mut(&mut self) -> &mut PerJoint<Passive<T>> {
        &mut self.passive
    }

    fn at_rest() -> Joints<T> {
        at_rest()
    }

    fn motors_off() -> MotorTorques<T> {
        MotorTorques::all(zero())
    }

    fn no_accelerations() -> JointAccelerations<T> {
        JointAccelerations::all(zero())
    }

    fn all<V: Value>(value: V) -> PerJoint<V> {
        PerJoint::all(value)
    }

    fn mount(&self) -> &Matrix3<T> {
        &self.mount
    }

    fn bodies(&self) -> PerJoint<BodyParameters<T>> {
        let none = [zero(); 3];
        let link =
            BodyParameters { origin: none, mass: zero(), centre: none, inertia: no_inertia() };
        let platform = BodyParameters {
            origin: none,
            mass: self.m_p,
            centre: components(&self.r_pc_p),
            inertia: self.i_p_pc,
        };
        let x_slide = BodyParameters { origin: components(&self.r_p_b), ..link };
        PerJoint { x_slide, platform, ..PerJoint::all(link) }
    }

    fn passive(&self) -> PerJoint<Passive<T>> {
        self.passive
    }

    fn of_bodies(
        mount: &Matrix3<T>,
        bodies: &PerJoint<BodyParameters<T>>,
        passive: &PerJoint<Passive<T>>,
        _: ImbalanceModel,
    ) -> Self {
        Self {
            mount: *mount,
            r_p_b: vector(bodies.x_slide.origin),
            m_p: bodies.platform.mass,
            r_pc_p: vector(bodies.platform.centre),
            i_p_pc: bodies.platform.inertia,
            passive: *passive,
        }
    }

    fn constants(&self, origin: [T; 3]) -> Constants<T> {
        let Self { m_p: m_b, r_pc_p: r_bc_b, i_p_pc: i_b_bc, .. } = *self;
        let body = HubConstants::new(&Hub { m_b, r_bc_b, i_b_bc });
        Constants { mount: columns(&self.mount), origin, body }
    }

    fn constant_share(constants: &Constants<T>) -> ConstantShare<T> {
        ConstantShare::of_mass(constants.body.m_b)
    }

    fn energy_momentum(
        constants: &Constants<T>,
        joints: &Joints<T>,
        hub: &BodyVelocity<T>,
    ) -> EnergyMomentum<T> {
        constants.energy_momentum(&Self::pose(joints), joints, hub)
    }

    fn first_moment(constants: &Constants<T>, joints: &Joints<T>) -> [[T; 3]; 2] {
        constants.first_moment(&Self::pose(joints), joints)
    }

    fn axes(_: &Constants<T>, pose: &Pose<T>) -> PerJoint<Columns<T>> {
        PerJoint::of(pose.axes())
    }

    fn loads(
        constants: &Constants<T>,
        pose: &Pose<T>,
        joints: &Joints<T>,
        omega: &BodyRate<T>,
        hub: &BodyAcceleration<T>,
        accelerations: &JointAccelerations<T>,
    ) -> Carried<Wrenches<Self>, Wrench<T>> {
        constants.loads(pose, joints, omega, hub, accelerations)
    }
}

impl<T: Scalar> ConstantShare<T> {
    /// Of what moves with every joint: only its mass.
    pub(crate) fn of_mass(constant_m: T) -> Self {
        let o = zero();
        Self {
            constant_m,
            constant_mr_bx: o,
            constant_mr_by: o,
            constant_mr_bz: o,
            constant_i_11: o,
            constant_i_12: o,
            constant_i_13: o,
            constant_i_22: o,
            constant_i_23: o,
            constant_i_33: o,
        }
    }
}
