//! [`Gpu`]: the steps of many runs at a time on a GPU (feature `cuda`). What happens between steps is the runs' own, as with
//! lanes: a run whose step the GPU refuses makes it by itself.

use precess_dynamics::{BuiltIn, Hub, SolveError};
use precess_gpu::{
    ActingInputs, Batch, BatchInputs, Device, GpuError, SampleSettings, Sources, Steps, generator,
    open,
};
use precess_lanes::{Motion, SideBySide, StateInputs, StateResults};

/// A GPU, and the kernels of a set of devices.
pub struct Gpu {
    device: Box<dyn Device>,
    sources: Sources,
}

impl std::fmt::Debug for Gpu {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_tuple("Gpu").field(&self.device.name()).finish()
    }
}

impl Gpu {
    /// How many runs make their steps together: some for each of ten thousand threads, and memory for their records.
    pub const SIDE_BY_SIDE: usize = 4096;

    /// The GPU of this machine, with kernels for these devices, derived and compiled.
    ///
    /// # Errors
    /// Why there is none.
    pub fn open(devices: &[BuiltIn]) -> Result<Self, GpuError> {
        let device = open()?;
        let kinds: Vec<_> = devices.iter().map(BuiltIn::kind).collect();
        Self::new(device, Sources::derive(&generator(), &kinds)?)
    }

    /// A device, with kernels that it compiles.
    ///
    /// # Errors
    /// It cannot.
    pub fn new(device: Box<dyn Device>, sources: Sources) -> Result<Self, GpuError> {
        device.compile(&sources)?;
        Ok(Self { device, sources })
    }

    /// Runs of these spacecraft; none that are no batch.
    pub(super) fn runs(&self, crafts: Vec<(Hub, Vec<BuiltIn>)>) -> Option<Box<dyn SideBySide>> {
        let joints = crafts.first()?.1.iter().map(|device| device.kind().joints().len()).collect();
        let batch =
            Batch::new(crafts, true, Ok(&*self.device), |_| Ok(self.sources.clone())).ok()?;
        Some(Box::new(GpuRuns { batch, joints }))
    }
}

/// Runs on a GPU.
struct GpuRuns {
    batch: Batch,
    /// Joints of each device.
    joints: Vec<usize>,
}

impl GpuRuns {
    /// A motion as a flat state.
    fn row(&self, motion: &Motion) -> Vec<f64> {
        let q = motion.attitude;
        let hub = motion.r_b_n.iter().chain(motion.r_b_n_dot.iter()).copied();
        let hub = hub.chain([q.q0, q.q1, q.q2, q.q3]).chain(motion.omega.iter().copied());
        let mut row: Vec<f64> = hub.collect();
        let mut joints = motion.joints.as_slice();
        for count in &self.joints {
            let (own, rest) = joints.split_at((*count).min(joints.len()));
            row.extend(own.iter().map(|[coordinate, _]| coordinate));
            row.extend(own.iter().map(|[_, rate]| rate));
            joints = rest;
        }
        row
    }

    fn write(&self, row: &[f64], motion: &mut Motion) {
        let mut numbers = row.iter().copied();
        let q = &mut motion.attitude;
        let hub = motion.r_b_n.iter_mut().chain(motion.r_b_n_dot.iter_mut());
        let hub = hub.chain([&mut q.q0, &mut q.q1, &mut q.q2, &mut q.q3]);
        for to in hub.chain(motion.omega.iter_mut()) {
            *to = numbers.next().unwrap_or(f64::NAN);
        }
        let mut joints = motion.joints.as_mut_slice();
        for count in &self.joints {
            let (own, rest) = joints.split_at_mut((*count).min(joints.len()));
            for which in 0..2 {
                for of in own.iter_mut() {
                    of[which] = numbers.next().unwrap_or(f64::NAN);
                }
            }
            joints = rest;
        }
    }
}

/// As a batch takes them.
fn acting(of: &StateInputs) -> ActingInputs {
    ActingInputs {
        force: of.force,
        torque_b: of.torque_b,
        motors: of.motors.clone(),
        modes: of.modes.clone(),
        hub: of.hub,
        gravity: of.gravity,
        bodies: of.bodies.clone(),
    }
}

impl SideBySide for GpuRuns {
    fn advance(
        &mut self,
        at: &mut [(Motion, StateInputs)],
        length: f64,
        steps: usize,
    ) -> StateResults {
        let inputs: Vec<_> = at.iter().map(|(_, inputs)| acting(inputs)).collect();
        let Some(base) = inputs.first() else { return Vec::new() };
        let mut y: Vec<f64> = at.iter().flat_map(|(motion, _)| self.row(motion)).collect();
        let rows: Vec<f64> = inputs.iter().flat_map(ActingInputs::row).collect();
        let settings =
            SampleSettings { every: steps.max(1), history: false, reductions: Vec::new() };
        let steps = Steps { length, count: steps, normalises: false };
        let size = self.batch.state_size();
        let inputs_of_all = BatchInputs { base, rows: &rows };
        let found = self.batch.run(&mut y, inputs_of_all, steps, &settings, &|_| true);
        // The run makes such a step by itself, and says what is wrong with it: this error is not shown.
        let alone = Err(SolveError::Count { expected: 1, found: at.len() });
        let Ok((_, result)) = found else { return vec![alone; at.len()] };
        let rows = y.chunks_exact(size).zip(inputs.iter().zip(result.states));
        let each = at.iter_mut().zip(rows).map(|((motion, _), (row, (own, end)))| {
            // Modes, field and wrenches are those of the first.
            if end.is_err() || !own.shares_with(base) {
                return alone;
            }
            self.write(row, motion);
            Ok(())
        });
        each.collect()
    }
}
