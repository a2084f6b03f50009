//! [`CarryingPanel`]: a hinged panel that carries devices, as the panels of a row that have others
//! outboard of them do.
//!
//! Its kernels are those that are emitted for a [`HingedPanel`], but for the elimination: the panel with
//! what it carries is no rigid body, so its hinge is eliminated by (I4) to (I7), as the joints of a
//! platform are.

#![expect(clippy::inline_always, reason = "lanes reach wide instructions only in what is inlined")]

use nalgebra::Matrix3;

use crate::equations::assembly::Assembly;
use crate::equations::hub::HubConstants;
use crate::equations::suspension_forces::{Forces, Six};
use crate::generated::hinged_panel::device::{HingedPanel, Joints, MotorTorques, PerJoint};
use crate::generated::hinged_panel::{JointAccelerations, Prepared, Trig};
use crate::generated::hub::{
    BodyAcceleration, BodyRate, BodyVelocity, ConstantShare, EnergyMomentum, HubShare,
};
use crate::isolation::carrier::Carrier;
use crate::isolation::elimination::{Eliminated, Gains, eliminate};
use crate::isolation::kernels::Constants;
use crate::isolation::motion::{Motion, Moving, Relative, Spatial, about_z, identity};
use crate::model::kernels::Kernels;
use crate::model::kind::{
    BodyParameters, Carried, Drive, ImbalanceModel, JointInfo, Kind, ParameterInfo, ParameterMut,
    Wrenches,
};
use crate::model::parameters::Hub;
use crate::model::passive::Passive;
use crate::model::wrench::Wrench;
use crate::numbers::each::Value;
use crate::numbers::real::{Real, Scalar, zero};
use crate::numbers::vec3::{Vec3, columns, map};
use crate::validation::parameter_error::ParameterError;

/// A hinged panel that carries devices: the carrier of a [`Carrying`](crate::Carrying) set.
///
/// Joints, motors and data are those of a [`HingedPanel`], by the same names.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CarryingPanel<T = f64>(pub HingedPanel<T>);

/// Constants: the emitted ones, and where the panel stands.
#[derive(Clone, Copy, Debug)]
pub struct PanelConstants<T> {
    emitted: Prepared<T>,
    base: Constants<T>,
}

impl<T: Real + Value> PanelConstants<T> {
    /// The motion on a base that turns, expressed in it.
    #[inline(always)]
    fn moving(&self, pose: &Trig<T>, joints: &Joints<T>, omega: Vec3<T>) -> Moving<T, 1> {
        let (zero, one) = (pose.sin_phi.like(0.0), pose.sin_phi.like(1.0));
        let none = [zero; 3];
        let turn = (pose.sin_phi, pose.cos_phi);
        let turned = map(identity(zero), |axis| about_z(turn, axis));
        let angular = [zero, zero, joints.phi_dot];
        let seen = Relative { turned, slid: [none, none], angular, turning: none };
        let motion = Motion::of(self.base.place(), &seen, omega);
        Moving { motion, directions: [[none, [zero, zero, one]]] }
    }
}

impl<S: Scalar> Kernels for CarryingPanel<S> {
    type Constants<T: Value> = PanelConstants<T>;
    type Joints<T: Value> = Joints<T>;
    type Accelerations<T: Value> = JointAccelerations<T>;
    type PerJoint<V: Value> = PerJoint<V>;
    type Pose<T: Value> = Trig<T>;
    type Eliminated<T: Value> = Eliminated<T, 1>;
    type Gains<T: Value> = Gains<T, 1>;

    #[inline(always)]
    fn pose_by<T: Value>(joints: &Joints<T>, sin_cos: impl FnMut(usize, T) -> (T, T)) -> Trig<T> {
        HingedPanel::<S>::pose_by(joints, sin_cos)
    }

    #[inline(always)]
    fn eliminate<T: Real>(
        constants: &PanelConstants<T>,
        pose: &Trig<T>,
        joints: &Joints<T>,
        omega: &BodyRate<T>,
        drives: &PerJoint<Drive<T>>,
    ) -> Eliminated<T, 1> {
        let body = &constants.base.body;
        let none = [body.m_b.like(0.0); 3];
        let omega = [omega.omega_bx, omega.omega_by, omega.omega_bz];
        let moving = constants.moving(pose, joints, omega);
        eliminate(&moving, none, &Assembly::new(body, none, none), [drives.panel])
    }

    #[inline(always)]
    fn share<T: Real>(eliminated: &Eliminated<T, 1>) -> &HubShare<T> {
        &eliminated.share
    }

    #[inline(always)]
    fn gains<T: Real>(eliminated: &Eliminated<T, 1>) -> &Gains<T, 1> {
        &eliminated.gains
    }

    #[inline(always)]
    fn pivots<T: Real>(eliminated: &Eliminated<T, 1>) -> PerJoint<Option<[T; 2]>> {
        let [panel] = eliminated.pivots.map(Some);
        PerJoint { panel }
    }

    #[inline(always)]
    fn back_substitute<T: Real>(
        gains: &Gains<T, 1>,
        hub: &BodyAcceleration<T>,
    ) -> JointAccelerations<T> {
        let ([phi_ddot], _) = gains.outward(hub);
        JointAccelerations { phi_ddot }
    }

    #[inline(always)]
    fn slope<T: Value>(joints: &Joints<T>, accelerations: &JointAccelerations<T>) -> Joints<T> {
        HingedPanel::<S>::slope(joints, accelerations)
    }

    #[inline(always)]
    fn external<T: Real>(
        constants: &PanelConstants<T>,
        pose: &Trig<T>,
        bodies: &PerJoint<Wrench<T>>,
    ) -> Carried<PerJoint<Wrench<T>>, Wrench<T>> {
        HingedPanel::<S>::external(&constants.emitted, pose, bodies)
    }

    #[inline(always)]
    fn gravity<T: Real>(
        constants: &PanelConstants<T>,
        pose: &Trig<T>,
        gradient: [T; 6],
    ) -> (PerJoint<Wrench<T>>, [T; 6]) {
        HingedPanel::<S>::gravity(&constants.emitted, pose, gradient)
    }

    #[inline(always)]
    fn zip_constants<T: Value, U: Value, W: Value>(
        a: &PanelConstants<T>,
        b: &PanelConstants<U>,
        mut join: impl FnMut(T, U) -> W,
    ) -> PanelConstants<W> {
        let emitted = a.emitted.zip(&b.emitted, &mut join);
        PanelConstants { emitted, base: a.base.zip(&b.base, join) }
    }

    #[inline(always)]
    fn zip_joints<T: Value, U: Value, W: Value>(
        a: &Joints<T>,
        b: &Joints<U>,
        join: impl FnMut(T, U) -> W,
    ) -> Joints<W> {
        a.zip(b, join)
    }

    #[inline(always)]
    fn zip_gains<T: Value, U: Value, W: Value>(
        a: &Gains<T, 1>,
        b: &Gains<U, 1>,
        join: impl FnMut(T, U) -> W,
    ) -> Gains<W, 1> {
        a.zip(b, join)
    }

    #[inline(always)]
    fn zip_accelerations<T: Value, U: Value, W: Value>(
        a: &JointAccelerations<T>,
        b: &JointAccelerations<U>,
        join: impl FnMut(T, U) -> W,
    ) -> JointAccelerations<W> {
        a.zip(b, join)
    }

    #[inline(always)]
    fn zip_per_joint<T: Value, U: Value, W: Value>(
        a: &PerJoint<T>,
        b: &PerJoint<U>,
        join: impl FnMut(T, U) -> W,
    ) -> PerJoint<W> {
        a.zip(b, join)
    }
}

impl<T: Scalar> Kind for CarryingPanel<T> {
    type Scalar = T;
    type Motors = MotorTorques<T>;
    type With<U: Scalar> = CarryingPanel<U>;

    const NAME: &'static str = HingedPanel::<T>::NAME;
    const JOINTS: &'static [JointInfo] = HingedPanel::<T>::JOINTS;
    const PARAMETERS: &'static [ParameterInfo] = HingedPanel::<T>::PARAMETERS;

    fn parameter_mut(&mut self, name: &str) -> Option<ParameterMut<'_, T>> {
        self.0.parameter_mut(name)
    }

    fn passive_mut(&mut self) -> &mut PerJoint<Passive<T>> {
        self.0.passive_mut()
    }

    fn at_rest() -> Joints<T> {
        HingedPanel::at_rest()
    }

    fn motors_off() -> MotorTorques<T> {
        HingedPanel::motors_off()
    }

    fn no_accelerations() -> JointAccelerations<T> {
        HingedPanel::<T>::no_accelerations()
    }

    fn all<V: Value>(value: V) -> PerJoint<V> {
        PerJoint::all(value)
    }

    fn mount(&self) -> &Matrix3<T> {
        self.0.mount()
    }

    fn bodies(&self) -> PerJoint<BodyParameters<T>> {
        self.0.bodies()
    }

    fn passive(&self) -> PerJoint<Passive<T>> {
        self.0.passive()
    }

    fn of_bodies(
        mount: &Matrix3<T>,
        bodies: &PerJoint<BodyParameters<T>>,
        passive: &PerJoint<Passive<T>>,
        model: ImbalanceModel,
    ) -> Self {
        Self(HingedPanel::of_bodies(mount, bodies, passive, model))
    }

    fn constants(&self, origin: [T; 3]) -> PanelConstants<T> {
        let HingedPanel { m_p: m_b, r_pc_p: r_bc_b, i_p_pc: i_b_bc, .. } = self.0;
        let body = HubConstants::new(&Hub { m_b, r_bc_b, i_b_bc });
        let base = Constants { mount: columns(&self.0.mount), origin, body };
        PanelConstants { emitted: self.0.constants(origin), base }
    }

    fn constant_share(constants: &PanelConstants<T>) -> ConstantShare<T> {
        ConstantShare::of_mass(constants.base.body.m_b)
    }

    fn energy_momentum(
        constants: &PanelConstants<T>,
        joints: &Joints<T>,
        hub: &BodyVelocity<T>,
    ) -> EnergyMomentum<T> {
        HingedPanel::<T>::energy_momentum(&constants.emitted, joints, hub)
    }

    fn first_moment(constants: &PanelConstants<T>, joints: &Joints<T>) -> [[T; 3]; 2] {
        HingedPanel::<T>::first_moment(&constants.emitted, joints)
    }

    fn axes(constants: &PanelConstants<T>, pose: &Trig<T>) -> PerJoint<[[T; 3]; 3]> {
        HingedPanel::<T>::axes(&constants.emitted, pose)
    }

    fn loads(
        constants: &PanelConstants<T>,
        pose: &Trig<T>,
        joints: &Joints<T>,
        omega: &BodyRate<T>,
        hub: &BodyAcceleration<T>,
        accelerations: &JointAccelerations<T>,
    ) -> Carried<Wrenches<Self>, Wrench<T>> {
        HingedPanel::<T>::loads(&constants.emitted, pose, joints, omega, hub, accelerations)
    }
}

impl<T: Scalar> Carrier for CarryingPanel<T> {
    type Suspension = ();
    type Moving = Moving<T, 1>;

    fn base(constants: &PanelConstants<T>) -> &Constants<T> {
        &constants.base
    }

    fn moving(
        constants: &PanelConstants<T>,
        pose: &Trig<T>,
        joints: &Joints<T>,
        omega: Vec3<T>,
    ) -> Moving<T, 1> {
        constants.moving(pose, joints, omega)
    }

    fn acceleration(
        moving: &Moving<T, 1>,
        base: Spatial<T>,
        joints: &JointAccelerations<T>,
    ) -> Spatial<T> {
        moving.acceleration(base, [joints.phi_ddot])
    }

    fn directions(Moving { directions: [turn], .. }: &Moving<T, 1>) -> [Spatial<T>; 6] {
        let none = [[zero(); 3]; 2];
        [*turn, none, none, none, none, none]
    }

    fn eliminate_with(
        moving: &Moving<T, 1>,
        field: Vec3<T>,
        assembly: &Assembly<T>,
        drives: &PerJoint<Drive<T>>,
    ) -> Eliminated<T, 1> {
        eliminate(moving, field, assembly, [drives.panel])
    }

    fn outward(
        gains: &Gains<T, 1>,
        base: &BodyAcceleration<T>,
    ) -> (JointAccelerations<T>, Spatial<T>) {
        let ([phi_ddot], carrier) = gains.outward(base);
        (JointAccelerations { phi_ddot }, carrier)
    }

    fn scales(gains: &Gains<T, 1>, mass: T, inertia: T) -> PerJoint<T> {
        let [panel] = gains.scales(Self::JOINTS, mass, inertia);
        PerJoint { panel }
    }

    fn forces((): &(), _: &Trig<T>, _: &Joints<T>) -> Forces<T> {
        Forces::none()
    }

    fn force_slopes((): &(), _: &Joints<T>) -> [[Six<T>; 6]; 2] {
        [[[zero(); 6]; 6]; 2]
    }

    fn diagonals((): &(), _: Option<&Trig<T>>) -> [Six<T>; 2] {
        [[zero(); 6]; 2]
    }

    fn check_suspension(_: usize, (): &()) -> Result<(), ParameterError<T>> {
        Ok(())
    }
}
