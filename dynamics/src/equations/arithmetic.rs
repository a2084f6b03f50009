//! [`Arithmetic`]: by which instructions an evaluation is computed; the kernel `eliminate` for one
//! device by each.

#![expect(clippy::inline_always, reason = "instructions are reached only in what is inlined")]

use crate::equations::assembly::Assembly;
#[cfg(feature = "lanes")]
use crate::equations::cpu::Cpu;
use crate::equations::device::Device;
#[cfg(feature = "lanes")]
use crate::equations::dispatched::Dispatched;
use crate::equations::eliminate::DeviceElimination;
use crate::equations::error::SolveError;
use crate::equations::joint_inputs::{DeviceInputs, Environment};
use crate::generated::hub::BodyRate;
use crate::model::kernels::Kernels;
use crate::model::kind::Kind;
use crate::model::mode::Drive;
use crate::numbers::each::Value;
use crate::numbers::real::Real;

/// By which instructions an evaluation is computed: always with the same bits.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Arithmetic {
    /// By instructions that every CPU of the target has.
    Portable,
    /// By instructions of this CPU, in less time.
    #[cfg(feature = "lanes")]
    Dispatched(Cpu),
}

impl Arithmetic {
    /// By the instructions of this CPU where they are known.
    pub(crate) fn detected() -> Self {
        #[cfg(feature = "lanes")]
        if let Some(cpu) = Cpu::detected() {
            return Self::Dispatched(cpu);
        }
        Self::Portable
    }

    /// Eliminates the joints of a device.
    #[inline(always)]
    pub(crate) fn eliminate<K: Kind>(
        self,
        of: DeviceElimination<'_, K>,
    ) -> Result<(), SolveError<K::Scalar>> {
        match self {
            #[cfg(feature = "lanes")]
            Self::Dispatched(cpu) if K::JOINTS.len() >= LONG => dispatched(cpu, of),
            _ => {
                let DeviceElimination { device, index, joints, given, .. } = of;
                let DeviceElimination { environment, assembly, gains, .. } = of;
                portable(device, joints, given, environment, assembly, gains, index)
            }
        }
    }
}

/// From so many joints on, dispatched instructions and sums that do not wait bring more than it
/// takes to write a device's share to memory and to read it.
#[cfg(feature = "lanes")]
const LONG: usize = 2;

/// By instructions of this CPU. The share is added here: within the function, each device would wait
/// for the sums that the one before it has just written.
#[cfg(feature = "lanes")]
#[inline(always)]
fn dispatched<K: Kind>(
    cpu: Cpu,
    of: DeviceElimination<'_, K>,
) -> Result<(), SolveError<K::Scalar>> {
    let mut share = None;
    let DeviceElimination { assembly, .. } = of;
    let of = DeviceElimination { assembly: &mut *assembly, ..of };
    cpu.dispatch(Dispatched { of, share: &mut share })?;
    if let Some(share) = &share {
        assembly.add(share);
    }
    Ok(())
}

// Never inlined: one copy of the kernel for all sets.
#[inline(never)]
fn portable<K: Kind>(
    device: &Device<K>,
    joints: &K::Joints<K::Scalar>,
    given: DeviceInputs<'_, K>,
    environment: &Environment<K::Scalar>,
    assembly: &mut Assembly<K::Scalar>,
    gains: &mut Option<K::Gains<K::Scalar>>,
    index: usize,
) -> Result<(), SolveError<K::Scalar>> {
    let of = DeviceElimination { device, index, joints, given, environment, assembly, gains };
    of.run(|inputs, pose, assembly, gains| {
        let pose = pose.unwrap_or_else(|| K::pose(inputs.joints));
        let eliminated = inputs.eliminated(&pose);
        *gains = Some(*K::gains(&eliminated));
        let pivots = K::pivots(&eliminated);
        // Added at once: where registers are few, a share that is kept goes through memory.
        assembly.add(K::share(&eliminated));
        pivots
    })
}

/// What the kernel `eliminate` takes of one device.
#[derive(Debug)]
pub(crate) struct EliminationInputs<'a, K: Kernels, T: Value> {
    pub(crate) constants: &'a K::Constants<T>,
    pub(crate) joints: &'a K::Joints<T>,
    pub(crate) omega: BodyRate<T>,
    pub(crate) drives: &'a K::PerJoint<Drive<T>>,
}

/// Pivot and diagonal of each driven joint.
pub(crate) type Pivots<K, T> = <K as Kernels>::PerJoint<Option<[T; 2]>>;

impl<K: Kernels, T: Real + Value> EliminationInputs<'_, K, T> {
    /// Eliminates the joints.
    #[inline(always)]
    pub(crate) fn eliminated(&self, pose: &K::Pose<T>) -> K::Eliminated<T> {
        let Self { constants, joints, omega, drives } = self;
        K::eliminate(constants, pose, joints, omega, drives)
    }
}
