//! [`Kind`]: what the solver requires of a device kind. Implemented by the emitted text.

use core::fmt::Debug;

use nalgebra::{Matrix3, Vector3};

use crate::generated::hub::{
    BodyAcceleration, BodyRate, BodyVelocity, ConstantShare, EnergyMomentum,
};
pub use crate::model::kernels::{Kernels, LoadColumn, LoadDerivatives};
pub use crate::model::mode::Drive;
use crate::model::mode::Mode;
use crate::model::parameter_info;
pub use crate::model::parameter_info::{
    NameError, ParameterInfo, ParameterMut, ParameterValue, Shape,
};
use crate::model::passive::Passive;
pub use crate::model::wrench::Carried;
use crate::model::wrench::Wrench;
pub use crate::numbers::each::{Each, JointStates, Value};
use crate::numbers::real::{Real, Scalar};
use crate::numbers::symmetric::Symmetric;

/// A joint and its child body: names, and how the joint moves.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[expect(clippy::struct_excessive_bools, reason = "independent facts about a joint")]
pub struct JointInfo {
    /// From 0, from the hub to the tip.
    pub index: usize,
    /// Its child body, which also names the joint: `inner gimbal`.
    pub body: &'static str,
    /// Its coordinate: `gamma_i`.
    pub coordinate: &'static str,
    /// Its rate: `gamma_i_dot`.
    pub rate: &'static str,
    /// Its acceleration: `gamma_i_ddot`.
    pub acceleration: &'static str,
    /// Its motor torque or force: `u_i`.
    pub motor: &'static str,
    /// The axis it turns about or slides along, of x, y, z.
    pub axis: usize,
    /// Whether it slides.
    pub slides: bool,
    /// Whether no equation of motion depends on the coordinate: that of a rotor which is symmetric
    /// about its axis.
    pub ignorable: bool,
    /// Whether it has a motor torque as an input; otherwise the kind keeps its rate constant.
    pub driven: bool,
    /// Whether no body is outboard of this one.
    pub tip: bool,
}

impl JointInfo {
    /// Units of coordinate, rate, acceleration and motor.
    #[must_use]
    pub const fn units(&self) -> [&'static str; 4] {
        if self.slides { ["m", "m/s", "m/s²", "N"] } else { ["rad", "rad/s", "rad/s²", "N m"] }
    }

    /// The mode that the kind gives the joint.
    pub(crate) fn own_mode<T: Scalar>(&self) -> Mode<T> {
        if self.driven { Mode::Driven } else { Mode::Prescribed(zero()) }
    }
}

/// Parameters of a body, and the origin of its joint.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BodyParameters<T> {
    /// Origin of the joint from the origin of its parent body, expressed in the parent body's axes,
    /// m.
    pub origin: [T; 3],
    /// Mass, kg.
    pub mass: T,
    /// Centre of mass from the origin, own axes, m.
    pub centre: [T; 3],
    /// Inertia about the centre of mass, own axes, kg m².
    pub inertia: Matrix3<T>,
}

/// A wheel's imbalance as a force and a torque of the simplified model.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Lumped<T> {
    /// `U_s = m_W d`, along the wheel's y axis, kg m.
    pub u_s: T,
    /// `J_12`, kg m².
    pub j_12: T,
    /// `J_13`, kg m².
    pub j_13: T,
}

impl<T: Copy> Lumped<T> {
    /// Each number changed.
    #[inline(always)]
    #[expect(clippy::inline_always, reason = "lanes reach wide instructions only where inlined")]
    pub(crate) fn map<U>(&self, mut change: impl FnMut(T) -> U) -> Lumped<U> {
        Lumped { u_s: change(self.u_s), j_12: change(self.j_12), j_13: change(self.j_13) }
    }
}

impl<T: Real> Lumped<T> {
    /// The disturbance at a wheel rate, W axes, about W: force `U_s Omega²` along `w_y`, torque
    /// `Omega² (J_13 w_y - J_12 w_z)`.
    #[inline(always)]
    #[expect(clippy::inline_always, reason = "lanes reach wide instructions only where inlined")]
    pub(crate) fn at(&self, spin: T) -> Wrench<T> {
        let (square, zero) = (spin * spin, spin.like(0.0));
        Wrench {
            force: vector([zero, self.u_s * square, zero]),
            moment: vector([zero, self.j_13 * square, -(self.j_12 * square)]),
        }
    }
}

/// Which model of its wheel's imbalance a device has.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum ImbalanceModel {
    /// The imbalanced rotor itself, coupled with everything else.
    #[default]
    Coupled,
    /// A balanced rotor (`d`, `J_12`, `J_13` zero) with the usual lumped disturbance on it: force
    /// `U_s Omega²` through W along `w_y`, torque `U_d Omega²` ahead of it by the phase.
    ///
    /// Omega is the wheel's rate relative to its parent body. The disturbance comes from outside,
    /// so neither momentum nor energy is conserved under it; the ledger counts it as external.
    Lumped,
}

/// A wrench on the child body of each joint of a kind.
pub type Wrenches<K> = <K as Kernels>::PerJoint<Wrench<<K as Kind>::Scalar>>;

/// A device kind: a structure of parameters, and functions over the emitted kernels.
///
/// Implemented by emitted text, next to each kernel; written by hand for nothing. The equations of
/// motion (`constant_share`, `eliminate`, `back_substitute`) are expressed in B; everything else is
/// expressed in the device's own axes: those of its first joint at zero, `mount` in the hub.
pub trait Kind: Kernels + Copy + Debug + PartialEq + Send + Sync {
    /// The number type.
    type Scalar: Scalar;
    /// Motor torques.
    type Motors: Each<Self::Scalar> + Copy;
    /// The same kind with parameters of other numbers.
    type With<U: Scalar>: Kind<Scalar = U> + Kernels<Constants<U> = Self::Constants<U>>;

    /// The name of the kind, that of its module: `reaction_wheel`.
    const NAME: &'static str;
    /// The joints from the hub to the tip.
    const JOINTS: &'static [JointInfo];
    /// The fields of the structure in order, without `passive`.
    const PARAMETERS: &'static [ParameterInfo];

    /// The value of a parameter by its name in the structure, `r_goc_go`, or of a joint's spring,
    /// damper and friction, `passive.inner_gimbal.stiffness`.
    ///
    /// # Errors
    ///
    /// [`NameError::Unknown`].
    fn parameter(&self, name: &str) -> Result<ParameterValue<Self::Scalar>, NameError> {
        parameter_info::value(self, name)
    }
    /// Writes a parameter by its name, as [`Self::parameter`] reads it. Nothing is checked:
    /// [`Spacecraft::new`](crate::Spacecraft::new) does that.
    ///
    /// # Errors
    ///
    /// [`NameError`] where there is no such parameter, or where the value has another shape.
    fn set_parameter(
        &mut self,
        name: &str,
        value: ParameterValue<Self::Scalar>,
    ) -> Result<(), NameError> {
        parameter_info::write(self, name, value)
    }
    /// A field of the structure by its name, `passive` left out; none where there is no such.
    fn parameter_mut(&mut self, name: &str) -> Option<ParameterMut<'_, Self::Scalar>>;
    /// Springs, dampers, friction, to be written.
    fn passive_mut(&mut self) -> &mut Self::PerJoint<Passive<Self::Scalar>>;

    /// All coordinates and rates zero.
    fn at_rest() -> Self::Joints<Self::Scalar>;
    /// All motors off.
    fn motors_off() -> Self::Motors;
    /// No joint accelerating.
    fn no_accelerations() -> Self::Accelerations<Self::Scalar>;
    /// One value at every joint.
    fn all<V: Value>(value: V) -> Self::PerJoint<V>;

    /// Columns: the device's axes expressed in B.
    fn mount(&self) -> &Matrix3<Self::Scalar>;
    /// The bodies; the first origin is expressed in *B*.
    fn bodies(&self) -> Self::PerJoint<BodyParameters<Self::Scalar>>;
    /// Springs, dampers, friction.
    fn passive(&self) -> Self::PerJoint<Passive<Self::Scalar>>;
    /// The device of these bodies, the first origin expressed in *B*. What it has no parameter for,
    /// such as a product of inertia of a balanced rotor, is left out: [`Self::bodies`] shows what
    /// it has.
    fn of_bodies(
        mount: &Matrix3<Self::Scalar>,
        bodies: &Self::PerJoint<BodyParameters<Self::Scalar>>,
        passive: &Self::PerJoint<Passive<Self::Scalar>>,
        model: ImbalanceModel,
    ) -> Self;
    /// Which model its wheel's imbalance has.
    fn model(&self) -> ImbalanceModel {
        ImbalanceModel::Coupled
    }
    /// The same device with a balanced wheel, and what was taken out; none where there is no wheel
    /// that can be imbalanced.
    fn balanced(&self) -> Option<(Self, Lumped<Self::Scalar>)> {
        None
    }
    /// The constants, the first origin turned into the device's axes.
    fn constants(&self, origin: [Self::Scalar; 3]) -> Self::Constants<Self::Scalar>;

    /// The emitted `constant_share`: the constant share of the hub, expressed in B.
    fn constant_share(constants: &Self::Constants<Self::Scalar>) -> ConstantShare<Self::Scalar>;

    /// The emitted `energy_momentum`.
    fn energy_momentum(
        constants: &Self::Constants<Self::Scalar>,
        joints: &Self::Joints<Self::Scalar>,
        hub: &BodyVelocity<Self::Scalar>,
    ) -> EnergyMomentum<Self::Scalar>;
    /// The emitted `first_moment`: it and its derivative seen from B.
    fn first_moment(
        constants: &Self::Constants<Self::Scalar>,
        joints: &Self::Joints<Self::Scalar>,
    ) -> [[Self::Scalar; 3]; 2];
    /// The emitted `axes`: each body's own, as columns.
    fn axes(
        constants: &Self::Constants<Self::Scalar>,
        pose: &Self::Pose<Self::Scalar>,
    ) -> Self::PerJoint<[[Self::Scalar; 3]; 3]>;
    /// The emitted `loads`: what each parent body exerts on its child body, about the joint's
    /// origin along the body's own axes.
    fn loads(
        constants: &Self::Constants<Self::Scalar>,
        pose: &Self::Pose<Self::Scalar>,
        joints: &Self::Joints<Self::Scalar>,
        omega: &BodyRate<Self::Scalar>,
        hub: &BodyAcceleration<Self::Scalar>,
        accelerations: &Self::Accelerations<Self::Scalar>,
    ) -> Carried<Wrenches<Self>, Wrench<Self::Scalar>>;
    /// The emitted `steer`; none of a kind that has none: a platform.
    fn steer(
        _constants: &Self::Constants<Self::Scalar>,
        _pose: &Self::Pose<Self::Scalar>,
        _joints: &Self::Joints<Self::Scalar>,
        _omega: &BodyRate<Self::Scalar>,
    ) -> Option<Steering<Self>> {
        None
    }
}

/// What the motion of one joint requires about B, device axes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct JointSteering<T> {
    /// Moment per rate, `dH/dq + omega x n`, N m s/rad; N s of a sliding joint.
    pub by_rate: Vector3<T>,
    /// Moment per acceleration, `n`, kg m^2; kg m of a sliding joint.
    pub by_acceleration: Vector3<T>,
}

/// The moment about B that a device requires, term by term, device axes:
/// `sum by_rate q' + sum by_acceleration q'' + inertia omega' + first_moment x r_B'' + gyroscopic`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Steering<K: Kind> {
    /// Joint by joint.
    pub joints: K::PerJoint<JointSteering<K::Scalar>>,
    /// Angular momentum about B relative to the hub, kg m^2/s.
    pub momentum: Vector3<K::Scalar>,
    /// First moment about B, kg m.
    pub first_moment: Vector3<K::Scalar>,
    /// Entries 11, 12, 13, 22, 23, 33 of the inertia about B, kg m^2.
    pub inertia: [K::Scalar; 6],
    /// `omega x inertia omega`, N m.
    pub gyroscopic: Vector3<K::Scalar>,
}

/// Entries 11, 12, 13, 22, 23, 33 of a tensor's symmetric part, exact where it is symmetric.
#[must_use]
pub fn entries<T: Scalar>(tensor: &Matrix3<T>) -> [T; 6] {
    let s = Symmetric::part_of(tensor);
    [s.xx, s.xy, s.xz, s.yy, s.yz, s.zz]
}

/// The components of a vector.
#[must_use]
pub fn components<T: Scalar>(v: &Vector3<T>) -> [T; 3] {
    crate::numbers::vec3::components(v)
}

/// A vector from its components.
#[inline(always)]
#[expect(clippy::inline_always, reason = "lanes reach wide instructions only where inlined")]
#[must_use]
pub fn vector<T: Real>(components: [T; 3]) -> Vector3<T> {
    crate::numbers::vec3::vector(components)
}

/// Zero.
#[must_use]
pub fn zero<T: Scalar>() -> T {
    crate::numbers::real::zero()
}

/// A tensor with these moments and no products.
#[must_use]
pub fn diagonal<T: Scalar>([xx, yy, zz]: [T; 3]) -> Matrix3<T> {
    let o = zero();
    Matrix3::new(xx, o, o, o, yy, o, o, o, zz)
}

/// The tensor that is zero.
#[must_use]
pub fn no_inertia<T: Scalar>() -> Matrix3<T> {
    diagonal([zero(); 3])
}

/// A body without mass at the origin of its parent body.
pub(crate) fn no_body<T: Scalar>() -> BodyParameters<T> {
    BodyParameters { origin: [zero(); 3], mass: zero(), centre: [zero(); 3], inertia: no_inertia() }
}

/// The tensor that changes nothing.
#[must_use]
pub fn unit<T: Scalar>() -> Matrix3<T> {
    diagonal([T::from_f64(1.0); 3])
}
