//! [`CarrierConstants`]: a carrier in an elimination. What it carries is eliminated into its own equations,
//! then its joints, by their modes, into those of its base.

use crate::equations::assembly::Assembly;
use crate::equations::device::Device;
use crate::equations::error::SolveError;
use crate::equations::hub::HubConstants;
use crate::equations::joint_inputs::{DeviceInputs, Environment};
use crate::equations::mass_reduction::MassReduction;
use crate::equations::system::{WELL_SCALED, bound, check_pivot};
use crate::isolation::carrier::Carrier;
use crate::isolation::kernels::moved_second_moment;
use crate::isolation::motion::Motion;
use crate::model::mode::Drive;
use crate::numbers::each::{Each, JointStates, filled};
use crate::numbers::real::{Scalar, one, zero};
use crate::numbers::vec3::{Vec3, zeros};

/// A carrier, precomputed.
#[derive(Clone, Debug)]
pub struct CarrierConstants<C: Carrier> {
    pub(crate) device: Device<C>,
    pub(crate) suspension: C::Suspension,
    /// The carrier with the constant shares of what it carries, about P, carrier axes.
    pub(crate) body: HubConstants<C::Scalar>,
    /// Of what it carries, the mass, kg.
    pub(crate) carried_mass: C::Scalar,
}

impl<C: Carrier> CarrierConstants<C> {
    /// The motion on a base that turns, expressed in it.
    pub(crate) fn moving(
        &self,
        joints: &C::Joints<C::Scalar>,
        omega: Vec3<C::Scalar>,
    ) -> C::Moving {
        C::moving(&self.device.constants, &C::pose(joints), joints, omega)
    }
}

/// A carrier whose carried devices are to be eliminated.
pub(crate) struct CarrierElimination<'a, C: Carrier> {
    pub(crate) carrier: &'a CarrierConstants<C>,
    /// Its number among the devices.
    pub(crate) device: usize,
    joints: &'a C::Joints<C::Scalar>,
    pose: C::Pose<C::Scalar>,
    moving: C::Moving,
    base: &'a Environment<C::Scalar>,
    /// For the carried devices.
    pub(crate) environment: Environment<C::Scalar>,
    /// Carrier and carried devices about P, carrier axes.
    pub(crate) assembly: Assembly<C::Scalar>,
}

impl<'a, T: Scalar, C: Carrier<Scalar = T>> CarrierElimination<'a, C> {
    /// The carrier's motion, and its own equations before those of any carried device are added.
    pub(crate) fn start(
        carrier: &'a CarrierConstants<C>,
        device: usize,
        joints: &'a C::Joints<T>,
        base: &'a Environment<T>,
    ) -> Self {
        let mut still = *joints;
        if base.impulse {
            still.states_mut().for_each(|[_, rate]| *rate = zero());
        }
        let (constants, pose) = (&carrier.device.constants, C::pose(joints));
        let moving = C::moving(constants, &pose, &still, base.omega);
        let environment = moving.environment(base);
        let mut assembly = Assembly::new(&carrier.body, zeros(), zeros());
        if let Some(central) = &environment.central {
            let own = &C::base(constants).body;
            let second = own.second_moment();
            let (force, moment) = central.wrench(own.first_moment, &second);
            assembly.add_wrench(force, moment);
            assembly.second_moment = assembly.second_moment.plus(second);
        }
        Self { carrier, device, joints, pose, moving, base, environment, assembly }
    }

    /// Eliminates the joints once every carried device is: adds to the equations of the base, and
    /// returns what back substitution needs.
    pub(crate) fn finish(
        self,
        given: DeviceInputs<'_, C>,
        base: &mut Assembly<T>,
    ) -> Result<C::Gains<T>, SolveError<T>> {
        let drives = self.drives(given, base)?;
        let Self { moving, assembly, .. } = &self;
        let eliminated = C::eliminate_with(moving, moving.field(self.base), assembly, &drives);
        let body = assembly.body();
        let gains = *C::gains(&eliminated);
        base.add(C::share(&eliminated));
        if self.base.reduction.is_some() {
            self.check_definite(&eliminated, &drives)?;
            return Ok(gains);
        }
        if !self.base.impulse {
            self.add_stiffness(&eliminated, &drives, base);
        }
        if self.environment.central.is_some() {
            let Motion { axes, p, .. } = &**moving;
            let second = moved_second_moment(&body, &assembly.second_moment, axes, *p);
            base.second_moment = base.second_moment.plus(second);
        }
        self.check_pivots(&eliminated, &drives, &body)?;
        Ok(gains)
    }

    /// Torques and modes of the joints: motors, springs, dampers, friction, wrenches on the bodies.
    fn drives(
        &self,
        given: DeviceInputs<'_, C>,
        base: &mut Assembly<T>,
    ) -> Result<C::PerJoint<Drive<T>>, SolveError<T>> {
        let Self { carrier, joints, pose, .. } = self;
        let mut drives = carrier.device.drives(joints, given, self.base.impulse, self.device)?;
        if self.base.impulse {
            if let Some(reduction) = &self.base.reduction {
                self.reduce(reduction, &mut drives);
            }
            return Ok(drives);
        }
        if given.bodies.is_some() {
            carrier.device.add_wrenches(pose, joints, given.bodies, None, &mut drives, base);
        }
        let forces = C::forces(&carrier.suspension, pose, joints);
        let forces = forces.springs.into_iter().zip(forces.dampers);
        for (drive, (spring, damper)) in drives.values_mut().zip(forces) {
            // Only of driven joints, as the springs of single joints.
            if drive.driven == one() {
                drive.torque = drive.torque + (spring + damper);
            }
        }
        Ok(drives)
    }

    /// Damping and stiffness of each joint's own spring and friction, and of those with the
    /// diagonals that bound the suspension in this pose.
    fn coefficients(&self) -> impl Iterator<Item = [[T; 2]; 2]> {
        let [damping, stiffness] = C::diagonals(&self.carrier.suspension, Some(&self.pose));
        let joints = self.carrier.device.passive.values().zip(self.joints.states());
        joints.zip(damping.into_iter().zip(stiffness)).map(|((passive, [_, rate]), (c, k))| {
            let own: [T; 2] = [passive.damping(rate), passive.stiffness];
            [own, [own[0] + c, own[1] + k]]
        })
    }

    /// Subtracts shares of damping and stiffness from the inertia of the driven joints, (S1): at
    /// least what those of the suspension are. Of a share that is added, what it has at most.
    #[cold]
    fn reduce(&self, reduction: &MassReduction<T>, drives: &mut C::PerJoint<Drive<T>>) {
        let added = reduction.stiffness < zero();
        for (drive, [own, with_suspension]) in drives.values_mut().zip(self.coefficients()) {
            let [damping, most] = with_suspension;
            let [_, least] = own;
            if drive.driven == one() {
                drive.held = -reduction.subtracted(damping, if added { least } else { most });
            }
        }
    }

    /// Rejects the first pivot of a driven joint, with what was added to it, that is not above zero.
    #[cold]
    fn check_definite(
        &self,
        eliminated: &C::Eliminated<T>,
        drives: &C::PerJoint<Drive<T>>,
    ) -> Result<(), SolveError<T>> {
        let pivots = pivots::<C>(eliminated);
        let joints = pivots.values().zip(drives.values()).zip(C::JOINTS);
        for ((pivot, drive), info) in joints {
            if drive.driven == one() {
                let checked = check_pivot(pivot + drive.held, zero());
                checked.map_err(|small| small.of(Some(self.device), Some(info.body)))?;
            }
        }
        Ok(())
    }

    /// Adds springs and friction, of the carrier's joints and of the carried ones, to the stiffness
    /// that a step has to resolve.
    fn add_stiffness(
        &self,
        eliminated: &C::Eliminated<T>,
        drives: &C::PerJoint<Drive<T>>,
        base: &mut Assembly<T>,
    ) {
        let entries = self.coefficients().map(|[_, with_suspension]| with_suspension);
        let coefficients = filled(C::all([zero(); 2]), entries);
        let pivots = C::pivots(eliminated);
        base.stiffness.add::<C>(&coefficients, &pivots, drives);
        // The response of a carried joint grows with the carrier, as shows in its pivots.
        let mut growth = one::<T>();
        for (pivot, drive) in pivots.values().zip(drives.values()) {
            if let Some([pivot, diagonal]) = pivot
                && drive.driven == one()
            {
                growth = growth * (diagonal * pivot.recip());
            }
        }
        let carried = &self.assembly.stiffness;
        base.stiffness.damping = base.stiffness.damping + growth * carried.damping;
        base.stiffness.spring = base.stiffness.spring + growth * carried.spring;
    }

    /// Rejects pivots that are rounding: of mass and inertia of platform and carried devices, as
    /// they come together in the pivot.
    fn check_pivots(
        &self,
        eliminated: &C::Eliminated<T>,
        drives: &C::PerJoint<Drive<T>>,
        body: &HubConstants<T>,
    ) -> Result<(), SolveError<T>> {
        // The moving share of inertia may cancel nearly all of the constant one.
        let inertia = body.i_b_b.trace() + self.carrier.body.i_b_b.trace();
        let share = T::from_f64(WELL_SCALED);
        let pivots = pivots::<C>(eliminated);
        let mut joints = pivots.values().zip(drives.values()).zip(C::JOINTS);
        let well_scaled = joints.all(|((pivot, drive), info)| {
            let scale = if info.slides { body.m_b } else { inertia };
            drive.driven != one() || pivot > share * scale
        });
        if well_scaled { Ok(()) } else { self.small_pivot(eliminated, drives, body.m_b, inertia) }
    }

    /// The pivot rejected, in the order of the elimination. Its scale is what is rounded in mass and
    /// inertia, as the joints that follow bring it together.
    #[cold]
    fn small_pivot(
        &self,
        eliminated: &C::Eliminated<T>,
        drives: &C::PerJoint<Drive<T>>,
        mass: T,
        inertia: T,
    ) -> Result<(), SolveError<T>> {
        let mut rejected = Ok(());
        let pivots = pivots::<C>(eliminated);
        let joints = pivots.values().zip(drives.values()).zip(C::JOINTS);
        let scales = C::scales(C::gains(eliminated), mass, inertia);
        for (((pivot, drive), info), scale) in joints.zip(scales.values()) {
            if drive.driven == one()
                && let Err(small) = check_pivot(pivot, bound(scale))
            {
                // From the base to the tip: the one nearest the tip was eliminated first.
                rejected = Err(small.of(Some(self.device), Some(info.body)));
            }
        }
        rejected
    }
}

/// The pivot of each joint.
fn pivots<C: Carrier>(eliminated: &C::Eliminated<C::Scalar>) -> C::PerJoint<C::Scalar> {
    let found = C::pivots(eliminated);
    let pivots = found.values().map(|pivot| pivot.map_or_else(zero, |[pivot, _]| pivot));
    filled(C::all(zero()), pivots)
}
