//! [`DeviceElimination`]: the joints of one device eliminated from the equations of the hub.

#![expect(clippy::inline_always, reason = "instructions are reached only in what is inlined")]

use crate::equations::arithmetic::{EliminationInputs, Pivots};
use crate::equations::assembly::{Assembly, expressed_in_b};
use crate::equations::device::{Device, Drives};
use crate::equations::error::SolveError;
use crate::equations::gravity::Central;
use crate::equations::joint_inputs::{DeviceInputs, Environment};
use crate::equations::mass_reduction::MassReduction;
use crate::equations::system::check_pivot;
use crate::model::kind::{Kind, Wrenches};
use crate::numbers::each::{Each, JointStates};
use crate::numbers::real::{one, zero};
use crate::numbers::vec3::components;

/// A device whose joints are to be eliminated.
#[derive(Debug)]
pub(crate) struct DeviceElimination<'a, K: Kind> {
    pub(crate) device: &'a Device<K>,
    /// Its number.
    pub(crate) index: usize,
    pub(crate) joints: &'a K::Joints<K::Scalar>,
    pub(crate) given: DeviceInputs<'a, K>,
    pub(crate) environment: &'a Environment<K::Scalar>,
    /// The hub's system: wrenches on bodies and stiffness of joints are added to it.
    pub(crate) assembly: &'a mut Assembly<K::Scalar>,
    /// What back substitution needs, to be written.
    pub(crate) gains: &'a mut Option<K::Gains<K::Scalar>>,
}

impl<K: Kind> DeviceElimination<'_, K> {
    /// Eliminates the joints. `eliminate` is the kernel: it writes the gains, and adds the
    /// share of the hub's equations to the hub's system or keeps it for its caller.
    #[inline(always)]
    pub(crate) fn run(
        self,
        eliminate: impl FnOnce(
            &EliminationInputs<'_, K, K::Scalar>,
            Option<K::Pose<K::Scalar>>,
            &mut Assembly<K::Scalar>,
            &mut Option<K::Gains<K::Scalar>>,
        ) -> Pivots<K, K::Scalar>,
    ) -> Result<(), SolveError<K::Scalar>> {
        let Self { device, index, joints, given, environment, assembly, gains } = self;
        let mut pose = None;
        let mut drives = device.drives(joints, given, environment.impulse, index)?;
        if !environment.impulse {
            let central = environment.central.as_ref();
            if given.bodies.is_some() || central.is_some() || device.lumped.is_some() {
                let pose = pose.get_or_insert_with(|| K::pose(joints));
                device.add_wrenches(pose, joints, given.bodies, central, &mut drives, assembly);
            }
        }
        // A copy: numbers whose place another function knows do not stay in registers.
        let mut joints = *joints;
        if environment.impulse {
            if let Some(reduction) = &environment.reduction {
                device.reduce(&joints, reduction, &mut drives);
            }
            joints.states_mut().for_each(|[_, rate]| *rate = zero());
        }
        let (constants, omega) = (&device.constants, expressed_in_b(environment.omega));
        let inputs =
            EliminationInputs::<K, _> { constants, joints: &joints, omega, drives: &drives };
        let pivots = eliminate(&inputs, pose, assembly, gains);
        if environment.impulse {
            if environment.reduction.is_some() {
                return Device::<K>::check_definite(index, &pivots, &drives);
            }
        } else if !device.free {
            device.add_stiffness(&joints, &pivots, &drives, assembly);
        }
        device.check_pivots(index, &pivots, &drives)
    }
}

impl<K: Kind> Device<K> {
    /// Subtracts shares of damping and stiffness from the inertia of the driven joints, (S1).
    #[cold]
    fn reduce(
        &self,
        joints: &K::Joints<K::Scalar>,
        reduction: &MassReduction<K::Scalar>,
        drives: &mut Drives<K>,
    ) {
        let own = joints.states().zip(self.passive.values());
        for (drive, ([_, rate], passive)) in drives.values_mut().zip(own) {
            if drive.driven == one() && !passive.is_none() {
                drive.held = -reduction.subtracted(passive.damping(rate), passive.stiffness);
            }
        }
    }

    /// Rejects the first pivot of a driven joint, with what was added to it, that is not above zero.
    #[cold]
    fn check_definite(
        device: usize,
        pivots: &Pivots<K, K::Scalar>,
        drives: &Drives<K>,
    ) -> Result<(), SolveError<K::Scalar>> {
        for ((pivot, drive), info) in pivots.values().zip(drives.values()).zip(K::JOINTS) {
            if let (Some([pivot, _]), true) = (pivot, drive.driven == one()) {
                let checked = check_pivot(pivot + drive.held, zero());
                checked.map_err(|small| small.of(Some(device), Some(info.body)))?;
            }
        }
        Ok(())
    }

    /// Adds springs and friction to the stiffness that a step has to resolve.
    #[inline(never)]
    fn add_stiffness(
        &self,
        joints: &K::Joints<K::Scalar>,
        pivots: &Pivots<K, K::Scalar>,
        drives: &Drives<K>,
        assembly: &mut Assembly<K::Scalar>,
    ) {
        let mut coefficients = K::all([zero::<K::Scalar>(); 2]);
        let states = joints.states().zip(self.passive.values());
        for (entry, ([_, rate], passive)) in coefficients.values_mut().zip(states) {
            *entry = [passive.damping(rate), passive.stiffness];
        }
        assembly.stiffness.add::<K>(&coefficients, pivots, drives);
    }

    /// Adds what acts on the bodies from outside to the joints' torques and to the hub's system.
    #[inline(never)]
    pub(crate) fn add_wrenches(
        &self,
        pose: &K::Pose<K::Scalar>,
        joints: &K::Joints<K::Scalar>,
        bodies: Option<&Wrenches<K>>,
        central: Option<&Central<K::Scalar>>,
        drives: &mut Drives<K>,
        assembly: &mut Assembly<K::Scalar>,
    ) {
        let (wrenches, second_moment) = self.acting(pose, joints, bodies, central);
        let carried = self.carried(pose, &wrenches);
        for ((drive, wrench), info) in
            drives.values_mut().zip(carried.joints.values()).zip(K::JOINTS)
        {
            drive.torque = drive.torque + wrench.along(info) * drive.driven;
        }
        let hub = carried.hub.turned(&self.mount);
        assembly.add_wrench(components(&hub.force), components(&hub.moment));
        let second_moment = second_moment.rotated(&self.mount);
        assembly.second_moment = assembly.second_moment.plus(second_moment);
    }

    /// Rejects pivots that are rounding.
    #[inline(always)]
    fn check_pivots(
        &self,
        device: usize,
        pivots: &Pivots<K, K::Scalar>,
        drives: &Drives<K>,
    ) -> Result<(), SolveError<K::Scalar>> {
        let mut all_above = true;
        K::zip_per_joint(pivots, &self.bound, |pivot, bound| {
            all_above &= pivot.is_none_or(|[pivot, _]| pivot > bound);
        });
        if all_above { Ok(()) } else { self.small_pivot(device, pivots, drives) }
    }

    /// The pivot of a driven joint rejected, in the order of the elimination: the first one is the
    /// cause, those after it may be its consequence. What is not driven needs no pivot.
    #[cold]
    fn small_pivot(
        &self,
        device: usize,
        pivots: &Pivots<K, K::Scalar>,
        drives: &Drives<K>,
    ) -> Result<(), SolveError<K::Scalar>> {
        let mut rejected = Ok(());
        let joints = pivots.values().zip(self.bound.values());
        for (((pivot, bound), drive), info) in joints.zip(drives.values()).zip(K::JOINTS) {
            if let (Some([pivot, _]), true) = (pivot, drive.driven == one())
                && let Err(small) = check_pivot(pivot, bound)
            {
                // From the hub to the tip: the one nearest the tip was eliminated first.
                rejected = Err(small.of(Some(device), Some(info.body)));
            }
        }
        rejected
    }
}
