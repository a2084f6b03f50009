//! The loads of one device, and the powers at its joints.

use crate::equations::assembly::expressed_in_b;
use crate::equations::device::Device;
use crate::equations::joint_inputs::{DeviceInputs, Environment};
use crate::equations::load_sums::{Added, Along, HubAccelerations, LoadSums};
use crate::equations::suspension_forces::Forces;
use crate::equations::system::Solution;
use crate::model::kind::{Carried, Kernels, Kind, Wrenches};
use crate::model::mode::Mode;
use crate::model::wrench::Wrench;
use crate::numbers::each::{Each, JointStates};
use crate::numbers::real::{Scalar, zero};
use crate::numbers::vec3::{Columns, Vec3, rotate_transposed, vector};

/// The loads of one device; `W` has a wrench, `U` a number, `P` a [`JointPower`] per joint.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct DeviceLoads<W, U, P, T> {
    /// What the hub exerts on the device at its mount, about the device's place: the origin of its
    /// first joint at coordinate zero, which no joint of the device moves. Expressed in N if the
    /// joints' loads are, otherwise in B; of a device on a carrier, exerted by it, in the
    /// carrier's axes with [`LoadAxes::Body`](crate::LoadAxes::Body) and
    /// [`LoadAxes::Parent`](crate::LoadAxes::Parent). About another point: [`Wrench::moved`].
    pub mount: Wrench<T>,
    /// What its parent body exerts on the child body of each joint, motor, spring and friction
    /// included, about the joint's origin, expressed in the axes of the call.
    pub joints: W,
    /// The motor torque, N m (force, N, of a sliding joint), that each joint's acceleration needs:
    /// the load about its axis less spring and friction. (80), (101), (119).
    pub motors: U,
    /// The power of each joint's motor, spring and friction: the ledger's sums one by one.
    pub powers: P,
}

/// What acts at one joint, as power on the spacecraft's motion, W.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct JointPower<T = f64> {
    /// Of the motor: with the input torque, or with the computed one of a joint that is not driven.
    pub motor: T,
    /// Of the spring.
    pub spring: T,
    /// Of friction; not above zero.
    pub friction: T,
}

impl<T: Scalar> JointPower<T> {
    /// Nothing acts.
    pub(crate) fn none() -> Self {
        Self { motor: zero(), spring: zero(), friction: zero() }
    }

    /// Whether all three are finite.
    pub(crate) fn is_finite(&self) -> bool {
        [self.motor, self.spring, self.friction].into_iter().all(Scalar::is_finite)
    }
}

/// The loads of a device of a kind.
pub(crate) type LoadsOf<K> = DeviceLoads<
    Wrenches<K>,
    <K as Kernels>::PerJoint<<K as Kind>::Scalar>,
    <K as Kernels>::PerJoint<JointPower<<K as Kind>::Scalar>>,
    <K as Kind>::Scalar,
>;

/// Motor torque and power of each joint.
type MotorsAndPowers<K> = (
    <K as Kernels>::PerJoint<<K as Kind>::Scalar>,
    <K as Kernels>::PerJoint<JointPower<<K as Kind>::Scalar>>,
);

/// Moments about the joints' axes, forces along those of sliding joints.
struct AlongJoints<K: Kind> {
    /// For the accelerations.
    needed: K::PerJoint<K::Scalar>,
    /// From outside.
    applied: K::PerJoint<K::Scalar>,
    /// From the gradient of gravity.
    gradient: K::PerJoint<K::Scalar>,
}

impl<K: Kind> Device<K> {
    /// The loads of one device; adds to the totals.
    #[inline(never)]
    #[expect(clippy::too_many_arguments, reason = "state, inputs and accelerations, then results")]
    pub(crate) fn loads(
        &self,
        joints: &K::Joints<K::Scalar>,
        given: DeviceInputs<'_, K>,
        environment: &Environment<K::Scalar>,
        hub: &HubAccelerations<K::Scalar>,
        accelerations: &K::Accelerations<K::Scalar>,
        along: &Along<K::Scalar>,
        totals: &mut LoadSums<K::Scalar>,
    ) -> LoadsOf<K> {
        self.loads_with(joints, given, environment, hub, accelerations, along, totals, None)
    }

    /// [`Self::loads`] with what else acts on the last body and between the joints: of a carrier.
    #[expect(clippy::too_many_arguments, reason = "state, inputs and accelerations, then results")]
    pub(crate) fn loads_with(
        &self,
        joints: &K::Joints<K::Scalar>,
        given: DeviceInputs<'_, K>,
        environment: &Environment<K::Scalar>,
        hub: &HubAccelerations<K::Scalar>,
        accelerations: &K::Accelerations<K::Scalar>,
        along: &Along<K::Scalar>,
        totals: &mut LoadSums<K::Scalar>,
        added: Option<&Added<K::Scalar>>,
    ) -> LoadsOf<K> {
        let pose = K::pose(joints);
        // Expressed in the device's axes, as this kernel requires.
        let within = |v| rotate_transposed(&self.mount, v);
        let hub = Solution { r_b_n_ddot: within(hub.r_b_n_ddot), omega_dot: within(hub.omega_dot) };
        let mut needed = K::loads(
            &self.constants,
            &pose,
            joints,
            &expressed_in_b(within(environment.omega)),
            &hub.expressed_in_b(),
            accelerations,
        );
        let mut applied = self.carried(&pose, &self.applied(joints, given.bodies));
        let mut gradient = Carried { joints: K::all(Wrench::none()), hub: Wrench::none() };
        if let Some(central) = &environment.central {
            let (wrenches, second_moment) = self.gradient(&pose, central);
            let second_moment = second_moment.rotated(&self.mount);
            totals.second_moment = totals.second_moment.plus(second_moment);
            gradient = self.carried(&pose, &wrenches);
        }
        if let Some(added) = added {
            let parts = [
                (&mut needed, &added.inertial),
                (&mut applied, &added.applied),
                (&mut gradient, &added.gradient),
            ];
            for (sum, wrench) in parts {
                self.add_to_tip(&pose, wrench, sum);
            }
        }
        totals.inertial = totals.inertial.plus(&needed.hub.turned(&self.mount));
        totals.applied = totals.applied.plus(&applied.hub.turned(&self.mount));
        totals.gradient = totals.gradient.plus(&gradient.hub.turned(&self.mount));
        let along_joints = AlongJoints {
            needed: along_joints::<K>(&needed.joints),
            applied: along_joints::<K>(&applied.joints),
            gradient: along_joints::<K>(&gradient.joints),
        };
        let forces = added.map(|added| &added.suspension);
        let (motors, powers) = self.add_powers(joints, given, &along_joints, totals, forces);

        let mut loads = needed.joints;
        let outside = applied.joints.values().zip(gradient.joints.values());
        for (load, (applied, gradient)) in loads.values_mut().zip(outside) {
            *load = load.minus(&applied).minus(&gradient);
        }
        let slid = slid::<K>(joints);
        let (mount, joints) = self.expressed(&pose, slid, loads, along);
        let finite = joints.values().zip(motors.values()).zip(powers.values());
        let first = finite.map(|((load, motor), power)| {
            mount.is_finite() && load.is_finite() && motor.is_finite() && power.is_finite()
        });
        let first = first.enumerate().find(|(_, finite)| !finite);
        totals.overflow =
            totals.overflow.or(first.map(|(joint, _)| totals.joints.wrapping_add(joint)));
        totals.joints = totals.joints.wrapping_add(K::JOINTS.len());
        DeviceLoads { mount, joints, motors, powers }
    }

    /// Adds the powers of the joints to the sums; returns them and the motor torques that the
    /// accelerations need.
    fn add_powers(
        &self,
        joints: &K::Joints<K::Scalar>,
        given: DeviceInputs<'_, K>,
        along_joints: &AlongJoints<K>,
        totals: &mut LoadSums<K::Scalar>,
        forces: Option<&Forces<K::Scalar>>,
    ) -> MotorsAndPowers<K> {
        let power = &mut totals.power;
        let mut forces = forces.into_iter().flat_map(|of| of.springs.iter().zip(&of.dampers));
        let mut motors = K::all(zero::<K::Scalar>());
        let mut powers = K::all(JointPower::none());
        let components = along_joints.needed.values().zip(along_joints.applied.values());
        let components = components.zip(along_joints.gradient.values());
        let given = given.motors.values().zip(given.modes.values());
        let states = joints.states().zip(self.passive.values());
        let found = motors.values_mut().zip(powers.values_mut());
        for ((((motor, joint_power), components), given), state) in
            found.zip(components).zip(given).zip(states)
        {
            let (((needed, applied), gradient), (torque, mode)) = (components, given);
            let ([coordinate, rate], passive) = state;
            let (mut spring, mut friction) =
                (passive.of_spring(coordinate), passive.of_friction(rate));
            if let Some((of_spring, of_damper)) = forces.next() {
                (spring, friction) = (spring + *of_spring, friction + *of_damper);
            }
            *motor = needed - applied - gradient - spring - friction;
            let driven = if mode == Mode::Driven { torque } else { *motor };
            for (sum, drive) in [
                (&mut power.inertial, needed),
                (&mut power.applied, applied),
                (&mut power.gradient, gradient),
                (&mut power.motors, driven),
                (&mut power.springs, spring),
                (&mut power.friction, friction),
            ] {
                *sum = *sum + drive * rate;
                power.magnitude = power.magnitude + (drive * rate).abs();
            }
            *joint_power = JointPower {
                motor: driven * rate,
                spring: spring * rate,
                friction: friction * rate,
            };
            power.stored = power.stored + passive.potential(coordinate);
        }
        (motors, powers)
    }

    /// Adds a wrench on the last body, about its joint's origin in its axes, and what its parents take
    /// of it.
    fn add_to_tip(
        &self,
        pose: &K::Pose<K::Scalar>,
        wrench: &Wrench<K::Scalar>,
        to: &mut Carried<Wrenches<K>, Wrench<K::Scalar>>,
    ) {
        let mut bodies = K::all(Wrench::none());
        if let Some(tip) = bodies.values_mut().last() {
            *tip = *wrench;
        }
        let carried = self.carried(pose, &bodies);
        for (sum, wrench) in to.joints.values_mut().zip(carried.joints.values()) {
            *sum = sum.plus(&wrench);
        }
        to.hub = to.hub.plus(&carried.hub);
    }

    /// The load of the mount, for a first joint that slid so far, expressed in the device's axes, and
    /// those of the joints expressed in `along`.
    fn expressed(
        &self,
        pose: &K::Pose<K::Scalar>,
        slid: Option<Vec3<K::Scalar>>,
        mut loads: Wrenches<K>,
        along: &Along<K::Scalar>,
    ) -> (Wrench<K::Scalar>, Wrenches<K>) {
        let axes = K::axes(&self.constants, pose);
        let first = loads.values().zip(axes.values()).next();
        let first = first.map_or_else(Wrench::none, |(load, own)| load.turned(&own));
        let at_place = slid.map_or(first, |slid| first.moved(&vector(slid)));
        let hub = at_place.turned(&self.mount);
        let mut mount = hub;
        if let Along::Hub(Some(bn)) = along {
            mount = hub.turned_back(bn);
        }
        // The axes of each parent body: the device's own for the first.
        let mut parent = identity();
        for (load, own) in loads.values_mut().zip(axes.values()) {
            let in_device = load.turned(&own);
            *load = match along {
                Along::Body => *load,
                Along::Parent => in_device.turned_back(&parent),
                Along::Hub(None) => in_device.turned(&self.mount),
                Along::Hub(Some(bn)) => in_device.turned(&self.mount).turned_back(bn),
            };
            parent = own;
        }
        (mount, loads)
    }
}

/// The present origin of a device's first joint from the device's place, expressed in the device's
/// axes: none of a joint that turns.
fn slid<K: Kind>(joints: &K::Joints<K::Scalar>) -> Option<Vec3<K::Scalar>> {
    let info = K::JOINTS.first().filter(|info| info.slides)?;
    let [coordinate, _] = joints.states().next()?;
    let along = |axis| if axis == info.axis { coordinate } else { zero() };
    Some([along(0), along(1), along(2)])
}

/// The component of each wrench along its joint.
pub(super) fn along_joints<K: Kind>(wrenches: &Wrenches<K>) -> K::PerJoint<K::Scalar> {
    let mut components = K::all(zero());
    let joints = components.values_mut().zip(wrenches.values()).zip(K::JOINTS);
    for ((component, wrench), info) in joints {
        *component = wrench.along(info);
    }
    components
}

fn identity<T: Scalar>() -> Columns<T> {
    let (one, zero) = (crate::numbers::real::one(), zero());
    [[one, zero, zero], [zero, one, zero], [zero, zero, one]]
}
