//! [`Device`]: the precomputed constants of one device, and its part of an evaluation.
//!
//! The equations of motion contain the mount and are expressed in B. All other kernels have one
//! frame, the axes of the device's first joint at zero: what comes from the hub is rotated into it
//! by `mount^T`, results out of it by `mount`.

#![expect(clippy::inline_always, reason = "instructions are reached only in what is inlined")]

#[cfg(feature = "lanes")]
use std::sync::Arc;

use crate::equations::error::{Quantity, SolveError};
use crate::equations::gravity::{Central, gradient};
use crate::equations::hub::BodySums;
use crate::equations::joint_inputs::DeviceInputs;
use crate::equations::pivot_bound::pivot_bounds;
#[cfg(feature = "lanes")]
use crate::equations::side_by_side::group::DeviceGroup;
use crate::generated::hub::BodyVelocity;
use crate::model::kind::{Carried, ImbalanceModel, Kernels, Kind, Lumped, Wrenches};
use crate::model::mode::{Drive, Mode};
use crate::model::passive::Passive;
use crate::model::wrench::Wrench;
use crate::numbers::each::{Each, JointStates};
use crate::numbers::real::{Scalar, one, zero};
use crate::numbers::symmetric::Symmetric;
use crate::numbers::vec3::{Columns, Vec3, add, columns, rotate, rotate_transposed};
use crate::validation::check::triangle_excess;

/// Torques and weights of the joints of a kind.
pub(crate) type Drives<K> = <K as Kernels>::PerJoint<Drive<<K as Kind>::Scalar>>;

/// Constants of one device.
#[derive(Clone, Debug)]
pub struct Device<K: Kind> {
    pub(crate) mount: Columns<K::Scalar>,
    pub(crate) constants: K::Constants<K::Scalar>,
    pub(crate) passive: K::PerJoint<Passive<K::Scalar>>,
    /// What the pivot of each joint must exceed.
    pub(crate) bound: K::PerJoint<K::Scalar>,
    /// Whether no joint has a spring or friction.
    pub(crate) free: bool,
    /// The lumped disturbance that replaces the rotor's imbalance in the lumped model.
    pub(crate) lumped: Option<Lumped<K::Scalar>>,
    /// By how much each inertia breaks the triangle inequality, kg m².
    pub(crate) excess: K::PerJoint<K::Scalar>,
    /// This device and those after it in a row, where they are evaluated side by side.
    #[cfg(feature = "lanes")]
    pub(crate) group: Option<Arc<DeviceGroup<K>>>,
}

impl<K: Kind> Device<K> {
    /// Computes what depends only on parameters; they have been checked. Compiled once a kind, and not
    /// into every set.
    #[inline(never)]
    pub(crate) fn new(parameters: &K) -> Self {
        let (made, lumped) = match (parameters.model(), parameters.balanced()) {
            (ImbalanceModel::Lumped, Some((balanced, lumped))) => (balanced, Some(lumped)),
            _ => (*parameters, None),
        };
        let mount = columns(made.mount());
        let bodies = made.bodies();
        let origin = bodies.values().next().map_or([zero(); 3], |body| body.origin);
        let mut excess = K::all(zero());
        for (excess, body) in excess.values_mut().zip(parameters.bodies().values()) {
            *excess = triangle_excess(&body.inertia);
        }
        let (passive, bound) = (made.passive(), pivot_bounds::<K>(&bodies));
        let free = passive.values().all(|joint| joint.is_none());
        Self {
            mount,
            constants: made.constants(rotate_transposed(&mount, origin)),
            passive,
            bound,
            free,
            lumped,
            excess,
            #[cfg(feature = "lanes")]
            group: None,
        }
    }

    /// Torques and modes of the joints, valid only where each has its own mode; and whether each has.
    #[inline(always)]
    fn by_own_mode(
        joints: &K::Joints<K::Scalar>,
        given: DeviceInputs<'_, K>,
        impulse: bool,
    ) -> (Drives<K>, bool) {
        let mut usual = !impulse;
        let mut each = joints.states().zip(given.motors.values()).zip(K::JOINTS);
        let drives = K::zip_per_joint(given.modes, given.modes, |mode, _| {
            let Some((([coordinate, _], torque), info)) = each.next() else {
                return Mode::Driven.drive(zero());
            };
            let own = info.own_mode();
            usual &= mode == own && (!info.ignorable || coordinate.is_finite());
            own.drive(torque)
        });
        (drives, usual)
    }

    /// Torques and modes of the joints where one has a mode that is not its own.
    #[inline(never)]
    fn by_other_mode(
        joints: &K::Joints<K::Scalar>,
        given: DeviceInputs<'_, K>,
        impulse: bool,
        device: usize,
    ) -> Result<Drives<K>, SolveError<K::Scalar>> {
        let mut drives = K::all(Mode::Driven.drive(zero()));
        let motors = given.motors.values().zip(given.modes.values());
        let states = joints.states().zip(K::JOINTS);
        for ((drive, (torque, mode)), ([coordinate, rate], info)) in
            drives.values_mut().zip(motors).zip(states)
        {
            if info.ignorable && !coordinate.is_finite() {
                let what = Quantity::Joint { device, field: info.coordinate };
                return Err(SolveError::Overflow { what });
            }
            // Locked at rest is what the kind does anyway.
            let still = mode == Mode::Locked && rate == zero();
            if !(info.driven || still || mode == info.own_mode()) {
                return Err(SolveError::NotDriven { device, joint: info.body });
            }
            *drive = match mode {
                Mode::Locked if impulse => Mode::Prescribed(-rate).drive(zero()),
                Mode::Prescribed(_) if impulse => Mode::Locked.drive(zero()),
                Mode::Locked if rate != zero() => {
                    return Err(SolveError::LockedJointMoves { device, joint: info.body, rate });
                }
                mode => mode.drive(torque),
            };
        }
        Ok(drives)
    }

    /// Torques and modes of the joints for lanes, without springs and friction. `None` where the
    /// modes are rejected.
    #[cfg(feature = "lanes")]
    #[inline]
    pub(crate) fn given_drives(
        joints: &K::Joints<K::Scalar>,
        given: DeviceInputs<'_, K>,
    ) -> Option<Drives<K>> {
        match Self::by_own_mode(joints, given, false) {
            (drives, true) => Some(drives),
            _ => Self::by_other_mode(joints, given, false, 0).ok(),
        }
    }

    /// Whether a joint has dry friction.
    #[cfg(feature = "lanes")]
    pub(crate) fn is_dry(&self) -> bool {
        !self.free && self.passive.values().any(|passive| passive.coulomb != zero())
    }

    /// Torques and modes of the joints, springs and friction with the motors.
    #[inline(always)]
    pub(crate) fn drives(
        &self,
        joints: &K::Joints<K::Scalar>,
        given: DeviceInputs<'_, K>,
        impulse: bool,
        device: usize,
    ) -> Result<Drives<K>, SolveError<K::Scalar>> {
        let (mut drives, usual) = Self::by_own_mode(joints, given, impulse);
        if !usual {
            drives = Self::by_other_mode(joints, given, impulse, device)?;
        }
        if !(self.free || impulse) {
            let states = joints.states().zip(self.passive.values());
            for (drive, ([coordinate, rate], passive)) in drives.values_mut().zip(states) {
                // Only of driven joints: an overflow of a torque that moves nothing must not
                // reach other joints.
                if drive.driven == one() {
                    let own = passive.of_spring(coordinate) + passive.of_friction(rate);
                    drive.torque = drive.torque + own;
                }
            }
        }
        Ok(drives)
    }

    /// Wrenches on the bodies from outside, the simplified model's among them, and the second
    /// moment that the gradient of gravity requires.
    pub(crate) fn acting(
        &self,
        pose: &K::Pose<K::Scalar>,
        joints: &K::Joints<K::Scalar>,
        bodies: Option<&Wrenches<K>>,
        central: Option<&Central<K::Scalar>>,
    ) -> (Wrenches<K>, Symmetric<K::Scalar>) {
        let mut sum = self.applied(joints, bodies);
        let mut second_moment = Symmetric::zero();
        if let Some(central) = central {
            let (wrenches, second) = self.gradient(pose, central);
            second_moment = second;
            for (sum, wrench) in sum.values_mut().zip(wrenches.values()) {
                *sum = sum.plus(&wrench);
            }
        }
        (sum, second_moment)
    }

    /// Wrenches on the bodies from outside, the simplified model's among them.
    pub(crate) fn applied(
        &self,
        joints: &K::Joints<K::Scalar>,
        bodies: Option<&Wrenches<K>>,
    ) -> Wrenches<K> {
        let mut sum = bodies.copied().unwrap_or_else(|| K::all(Wrench::none()));
        if let Some(lumped) = &self.lumped {
            let tip = sum.values_mut().zip(joints.states()).last();
            if let Some((wrench, [_, spin])) = tip {
                *wrench = wrench.plus(&lumped.at(spin));
            }
        }
        sum
    }

    /// Wrenches of the gradient of gravity on the bodies, and the device's second moment about B,
    /// expressed in its own axes.
    #[inline(never)]
    pub(crate) fn gradient(
        &self,
        pose: &K::Pose<K::Scalar>,
        central: &Central<K::Scalar>,
    ) -> (Wrenches<K>, Symmetric<K::Scalar>) {
        gradient::<K, _>(&self.constants, &self.mount, pose, central)
    }

    /// Adds kinetic energy and momenta for the inertial velocity of B, expressed in B.
    pub(crate) fn add_sums(
        &self,
        joints: &K::Joints<K::Scalar>,
        r_b_n_dot: Vec3<K::Scalar>,
        omega: Vec3<K::Scalar>,
        sums: &mut BodySums<K::Scalar>,
    ) {
        let [r_b_n_dot_bx, r_b_n_dot_by, r_b_n_dot_bz] = rotate_transposed(&self.mount, r_b_n_dot);
        let [omega_bx, omega_by, omega_bz] = rotate_transposed(&self.mount, omega);
        let hub =
            BodyVelocity { r_b_n_dot_bx, r_b_n_dot_by, r_b_n_dot_bz, omega_bx, omega_by, omega_bz };
        let found = K::energy_momentum(&self.constants, joints, &hub);
        let linear = [found.linear_bx, found.linear_by, found.linear_bz];
        let angular_b = [found.angular_b_bx, found.angular_b_by, found.angular_b_bz];
        sums.energy = sums.energy + found.energy;
        sums.linear = add(sums.linear, rotate(&self.mount, linear));
        sums.angular_b = add(sums.angular_b, rotate(&self.mount, angular_b));
    }

    /// Adds the first moment about B and its derivative seen from B, expressed in B.
    pub(crate) fn add_first_moment(
        &self,
        joints: &K::Joints<K::Scalar>,
        moment: &mut [Vec3<K::Scalar>; 2],
    ) {
        for (sum, share) in moment.iter_mut().zip(K::first_moment(&self.constants, joints)) {
            *sum = add(*sum, rotate(&self.mount, share));
        }
    }

    /// `external`, in the device's axes. Never inlined: one copy of the kernel.
    #[inline(never)]
    pub(crate) fn carried(
        &self,
        pose: &K::Pose<K::Scalar>,
        bodies: &Wrenches<K>,
    ) -> Carried<Wrenches<K>, Wrench<K::Scalar>> {
        K::external(&self.constants, pose, bodies)
    }
}
