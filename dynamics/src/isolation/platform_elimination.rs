//! [`PlatformConstants`]: a platform in an elimination. What it carries is eliminated into its own equations,
//! then its joints, by their modes, into those of its base.

use crate::equations::assembly::Assembly;
use crate::equations::device::Device;
use crate::equations::error::SolveError;
use crate::equations::hub::HubConstants;
use crate::equations::joint_inputs::{DeviceInputs, Environment};
use crate::equations::mass_reduction::MassReduction;
use crate::equations::system::{WELL_SCALED, bound, check_pivot};
use crate::isolation::elimination::{Eliminated, Gains, eliminate};
use crate::isolation::kernels::moved_second_moment;
use crate::isolation::motion::{Motion, Pose};
use crate::isolation::parameters::Platform;
use crate::isolation::records::{Joints, PerJoint, at_rest};
use crate::isolation::suspension::Suspension;
use crate::model::kernels::Kernels;
use crate::model::kind::Kind;
use crate::model::mode::Drive;
use crate::numbers::each::{Each, JointStates, filled};
use crate::numbers::real::{Scalar, one, zero};
use crate::numbers::vec3::zeros;

/// A platform, precomputed.
#[derive(Clone, Debug)]
pub struct PlatformConstants<T: Scalar> {
    pub(crate) device: Device<Platform<T>>,
    pub(crate) suspension: Suspension<T>,
    /// The platform with the constant shares of what it carries, about P, platform axes.
    pub(crate) body: HubConstants<T>,
    /// Of what it carries, the mass, kg.
    pub(crate) carried_mass: T,
}

/// A platform whose carried devices are to be eliminated.
pub(crate) struct PlatformElimination<'a, T: Scalar> {
    pub(crate) carrier: &'a PlatformConstants<T>,
    /// Its number among the devices.
    pub(crate) device: usize,
    joints: &'a Joints<T>,
    pose: Pose<T>,
    motion: Motion<T>,
    base: &'a Environment<T>,
    /// For the carried devices.
    pub(crate) environment: Environment<T>,
    /// Platform and carried devices about P, platform axes.
    pub(crate) assembly: Assembly<T>,
}

impl<'a, T: Scalar> PlatformElimination<'a, T> {
    /// The platform's motion, and its own equations before those of any carried device are added.
    pub(crate) fn start(
        carrier: &'a PlatformConstants<T>,
        device: usize,
        joints: &'a Joints<T>,
        base: &'a Environment<T>,
    ) -> Self {
        let still = Joints::of(joints.coordinates(), at_rest().rates());
        let moving = if base.impulse { &still } else { joints };
        let pose = Platform::<T>::pose(joints);
        let motion = carrier.device.constants.motion(&pose, moving, base.omega);
        let environment = motion.environment(base);
        let mut assembly = Assembly::new(&carrier.body, zeros(), zeros());
        if let Some(central) = &environment.central {
            let own = &carrier.device.constants.body;
            let second = own.second_moment();
            let (force, moment) = central.wrench(own.first_moment, &second);
            assembly.add_wrench(force, moment);
            assembly.second_moment = assembly.second_moment.plus(second);
        }
        Self { carrier, device, joints, pose, motion, base, environment, assembly }
    }

    /// Eliminates the joints once every carried device is: adds to the equations of the base, and
    /// returns what back substitution needs.
    pub(crate) fn finish(
        self,
        given: DeviceInputs<'_, Platform<T>>,
        base: &mut Assembly<T>,
    ) -> Result<Gains<T>, SolveError<T>> {
        let drives = self.drives(given, base)?;
        let Self { motion, assembly, .. } = &self;
        let eliminated = eliminate(motion, motion.field(self.base), assembly, &drives);
        let body = assembly.body();
        base.add(&eliminated.share);
        if self.base.reduction.is_some() {
            self.check_definite(&eliminated, &drives)?;
            return Ok(eliminated.gains);
        }
        if !self.base.impulse {
            self.add_stiffness(&eliminated, &drives, base);
        }
        if self.environment.central.is_some() {
            let Motion { axes, p, .. } = motion;
            let second = moved_second_moment(&body, &assembly.second_moment, axes, *p);
            base.second_moment = base.second_moment.plus(second);
        }
        self.check_pivots(&eliminated, &drives, &body)?;
        Ok(eliminated.gains)
    }

    /// Torques and modes of the joints: motors, springs, dampers, friction, wrenches on the bodies.
    fn drives(
        &self,
        given: DeviceInputs<'_, Platform<T>>,
        base: &mut Assembly<T>,
    ) -> Result<PerJoint<Drive<T>>, SolveError<T>> {
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
        let forces = carrier.suspension.forces(pose, joints);
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
        let [damping, stiffness] = self.carrier.suspension.diagonals(Some(&self.pose));
        let joints = self.carrier.device.passive.values().zip(self.joints.states());
        joints.zip(damping.into_iter().zip(stiffness)).map(|((passive, [_, rate]), (c, k))| {
            let own: [T; 2] = [passive.damping(rate), passive.stiffness];
            [own, [own[0] + c, own[1] + k]]
        })
    }

    /// Subtracts shares of damping and stiffness from the inertia of the driven joints, (S1): at
    /// least what those of the suspension are. Of a share that is added, what it has at most.
    #[cold]
    fn reduce(&self, reduction: &MassReduction<T>, drives: &mut PerJoint<Drive<T>>) {
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
        eliminated: &Eliminated<T>,
        drives: &PerJoint<Drive<T>>,
    ) -> Result<(), SolveError<T>> {
        let joints = eliminated.pivots.values().zip(drives.values()).zip(Platform::<T>::JOINTS);
        for (([pivot, _], drive), info) in joints {
            if drive.driven == one() {
                let checked = check_pivot(pivot + drive.held, zero());
                checked.map_err(|small| small.of(Some(self.device), Some(info.body)))?;
            }
        }
        Ok(())
    }

    /// Adds springs and friction, of the platform's joints and of the carried ones, to the stiffness
    /// that a step has to resolve.
    fn add_stiffness(
        &self,
        eliminated: &Eliminated<T>,
        drives: &PerJoint<Drive<T>>,
        base: &mut Assembly<T>,
    ) {
        let entries = self.coefficients().map(|[_, with_suspension]| with_suspension);
        let coefficients = filled(PerJoint::all([zero(); 2]), entries);
        let pivots = Platform::<T>::pivots(eliminated);
        base.stiffness.add::<Platform<T>>(&coefficients, &pivots, drives);
        // The response of a carried joint grows with the platform, as shows in its pivots.
        let mut growth = one::<T>();
        for ([pivot, diagonal], drive) in eliminated.pivots.values().zip(drives.values()) {
            if drive.driven == one() {
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
        eliminated: &Eliminated<T>,
        drives: &PerJoint<Drive<T>>,
        body: &HubConstants<T>,
    ) -> Result<(), SolveError<T>> {
        // The moving share of inertia may cancel nearly all of the constant one.
        let inertia = body.i_b_b.trace() + self.carrier.body.i_b_b.trace();
        let share = T::from_f64(WELL_SCALED);
        let mut joints = eliminated.pivots.values().zip(drives.values()).zip(Platform::<T>::JOINTS);
        let well_scaled = joints.all(|(([pivot, _], drive), info)| {
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
        eliminated: &Eliminated<T>,
        drives: &PerJoint<Drive<T>>,
        mass: T,
        inertia: T,
    ) -> Result<(), SolveError<T>> {
        let mut rejected = Ok(());
        let joints = eliminated.pivots.values().zip(drives.values()).zip(Platform::<T>::JOINTS);
        for ((([pivot, _], drive), info), responses) in joints.zip(eliminated.gains.responses()) {
            let moved = responses.into_iter().zip(Platform::<T>::JOINTS);
            let scale = moved.fold(zero(), |scale: T, (response, info)| {
                scale + (if info.slides { mass } else { inertia }) * (response * response)
            });
            if drive.driven == one()
                && let Err(small) = check_pivot(pivot, bound(scale))
            {
                // From the base to the platform: the one nearest the tip was eliminated first.
                rejected = Err(small.of(Some(self.device), Some(info.body)));
            }
        }
        rejected
    }
}
