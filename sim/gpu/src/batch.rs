//! [`Batch`]: the states of spacecraft with the same kinds of devices, on a device; what it refuses, and everything without
//! one, by the solver in Rust on every core.
//!
//! Invariants: no number depends on the device, on how many states it takes at a time, on the parts of a run or on threads.

use precess_dynamics::{BuiltIn, BuiltInKind, Hub, kind::ImbalanceModel};

use crate::layout::{Layout, row};
use crate::processor::{Solvers, on_every_core, share};
use crate::samples::StateSamples;
use crate::solver::Solver;
use crate::{
    ActingInputs, Array, BatchInputs, Device, GpuError, Kernels, SampleSettings, Samples, SetError,
    Sources, StateError,
};

/// The status of a state that is computed.
pub(crate) const COMPUTED: i32 = 0;

/// Hears of the share of a call that is done, 0 to 1; whether to go on.
pub type Progress<'a> = &'a (dyn Fn(f64) -> bool + 'a);

/// What became of the states of a call.
#[derive(Clone, Debug, PartialEq)]
pub struct BatchResult {
    /// Of each state, in order.
    pub states: Vec<Result<(), StateError>>,
    /// Why the processor computed all of them, or the rest after the device failed; none where the device did.
    pub fallback: Option<GpuError>,
    /// States that the device refused and the processor computed again.
    pub recomputed: usize,
}

/// Steps of a run.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Steps {
    /// Length, s.
    pub length: f64,
    /// How many.
    pub count: usize,
    /// Whether attitudes are normalised before the first, as those of flat states are.
    pub normalises: bool,
}

/// States of one spacecraft, or of as many spacecraft whose parameters differ.
pub struct Batch {
    pub(crate) crafts: Vec<(Hub, Vec<BuiltIn>)>,
    pub(crate) each: bool,
    pub(crate) layout: Layout,
    pub(crate) kernels: Result<Box<dyn Kernels>, GpuError>,
    /// Of the only spacecraft.
    solver: Option<Result<Solver, StateError>>,
}

/// The kinds of the devices, which a batch has in common.
///
/// # Errors
/// [`SetError`], but for lengths.
fn kinds(crafts: &[(Hub, Vec<BuiltIn>)]) -> Result<Vec<BuiltInKind>, SetError> {
    let (_, first) = crafts.first().ok_or(SetError::Empty)?;
    if first.is_empty() {
        return Err(SetError::NoDevice);
    }
    let of = |devices: &[BuiltIn]| devices.iter().map(BuiltIn::kind).collect::<Vec<_>>();
    let kinds = of(first);
    for (number, (_, devices)) in crafts.iter().enumerate() {
        if of(devices) != kinds {
            return Err(SetError::Kinds(number));
        }
        let lumped = |device: &BuiltIn| device.parameters().model == ImbalanceModel::Lumped;
        if let Some(device) = devices.iter().position(lumped) {
            return Err(SetError::Lumped(number, device));
        }
    }
    Ok(kinds)
}

impl Batch {
    /// Of one spacecraft for every state, or with `each` of one for each state. Kernels are those of `sources` for the kinds
    /// of its devices; without a device or sources, the processor computes, and results say why.
    ///
    /// # Errors
    /// [`SetError`]: what is no batch, with or without a device.
    pub fn new(
        crafts: Vec<(Hub, Vec<BuiltIn>)>,
        each: bool,
        device: Result<&dyn Device, GpuError>,
        sources: impl FnOnce(&[BuiltInKind]) -> Result<Sources, GpuError>,
    ) -> Result<Self, SetError> {
        let kinds = kinds(&crafts)?;
        let layout = Layout::new(kinds.iter().map(|kind| kind.joints().len()));
        let kernels = device.and_then(|device| device.compile(&sources(&kinds)?));
        let shared = crafts.first().filter(|_| !each);
        let solver =
            shared.map(|(hub, devices)| Solver::new(hub, devices).map_err(StateError::Parameters));
        Ok(Self { crafts, each, layout, kernels, solver })
    }

    /// Why the processor computes; none with a device.
    #[must_use]
    pub fn fallback(&self) -> Option<&GpuError> {
        self.kernels.as_ref().err()
    }

    /// Numbers of a flat state.
    #[must_use]
    pub fn state_size(&self) -> usize {
        self.layout.size()
    }

    /// Numbers of accelerations, and of a row of inputs.
    #[must_use]
    pub fn acceleration_size(&self) -> usize {
        self.layout.width()
    }

    /// Checks the lengths of what is given; how many states there are.
    fn check(&self, y: &[f64], inputs: BatchInputs<'_>) -> Result<usize, SetError> {
        let (size, joints) = (self.layout.size(), self.layout.joints);
        let count = y.len() / size;
        let states = if self.each { self.crafts.len() } else { count };
        let rows = if inputs.rows.is_empty() { 0 } else { count * self.layout.width() };
        let bodies = inputs.base.bodies.as_ref().map_or(joints, Vec::len);
        for (array, expected, found) in [
            ("the array of states", states * size, y.len()),
            ("the array of inputs", rows, inputs.rows.len()),
            ("the list of motors", joints, inputs.base.motors.len()),
            ("the list of modes", joints, inputs.base.modes.len()),
            ("the list of wrenches", joints, bodies),
        ] {
            if expected != found {
                return Err(SetError::Length { array, expected, found });
            }
        }
        Ok(count)
    }

    /// Accelerations of flat states, a row for each; what a state that failed has does not count.
    ///
    /// # Errors
    /// [`SetError::Length`].
    pub fn accelerations(
        &mut self,
        y: &[f64],
        inputs: BatchInputs<'_>,
        out: &mut [f64],
        progress: Progress<'_>,
    ) -> Result<BatchResult, SetError> {
        let count = self.check(y, inputs)?;
        let (size, width) = (self.layout.size(), self.layout.width());
        if out.len() != count * width {
            let (expected, found) = (count * width, out.len());
            return Err(SetError::Length { array: "the array of accelerations", expected, found });
        }
        let bytes = self.bytes(size + width, inputs);
        let (statuses, fallback) = self.in_parts(count, bytes, |own, part, statuses| {
            own.begin(y, &part, inputs, None)?;
            let kernels = own.kernels.as_mut().map_err(|error| error.clone())?;
            let mut found = vec![0.0; part.len() * width];
            kernels.zeros(Array::Accelerations, found.len())?;
            kernels.accelerations()?;
            kernels.read(Array::Accelerations, &mut found)?;
            kernels.statuses(statuses)?;
            let rows = out[part.start * width..part.end * width].chunks_exact_mut(width);
            for (index, to) in rows.enumerate() {
                row(&found, (index, part.len()), to);
            }
            Ok(progress(share(part.end, count)))
        });
        let jobs = out.chunks_exact_mut(width).enumerate();
        let jobs: Vec<_> = jobs.filter(|(index, _)| statuses[*index] != COMPUTED).collect();
        let (recomputed, solvers) = (jobs.len(), self.solvers());
        let failed = on_every_core(jobs, progress, |(index, out), _| {
            let acting = acting(inputs, index, width);
            let found = solvers.with(index, |solver| {
                solver.accelerations(&y[index * size..(index + 1) * size], &acting, out)
            });
            (index, found)
        });
        Ok(result(count, failed, fallback, recomputed))
    }

    /// Steps of RK4 of flat states, inputs held; `y` has those at their end. What a state that failed has does not count.
    ///
    /// # Errors
    /// [`SetError::Length`].
    pub fn run(
        &mut self,
        y: &mut [f64],
        inputs: BatchInputs<'_>,
        steps: Steps,
        settings: &SampleSettings,
        progress: Progress<'_>,
    ) -> Result<(Samples, BatchResult), SetError> {
        let count = self.check(y, inputs)?;
        let (size, every) = (self.layout.size(), settings.every.max(1));
        let taken = steps.count / every + 1;
        let mut kept = Samples::new(settings, taken, count * size);
        let arrays = 2 + settings.reductions.len() + if settings.history { taken } else { 0 };
        let bytes = self.bytes(arrays * size, inputs);
        let (statuses, fallback) = self.in_parts(count, bytes, |own, part, statuses| {
            let goes_on = own.run_part(
                (y, &mut kept, statuses),
                (part.clone(), inputs),
                (steps, every, taken),
                &|done| {
                    progress((share(part.start, count) + done * share(part.len(), count)).min(1.0))
                },
            )?;
            Ok(goes_on)
        });
        let mut histories = kept.history.chunks_exact_mut((taken * size).max(1));
        let mut reduced: Vec<_> = settings
            .reductions
            .iter()
            .zip(&mut kept.reduced)
            .map(|(of, all)| (*of, all.chunks_exact_mut(size)))
            .collect();
        let mut jobs = Vec::new();
        for (index, y) in y.chunks_exact_mut(size).enumerate() {
            let history = histories.next().unwrap_or_default();
            let reduced = reduced
                .iter_mut()
                .map(|(of, rows)| (*of, rows.next().unwrap_or_default()))
                .collect();
            if statuses[index] != COMPUTED {
                jobs.push((index, y, StateSamples { history, reduced, taken: 0 }));
            }
        }
        let (recomputed, solvers) = (jobs.len(), self.solvers());
        let width = self.layout.width();
        let failed = on_every_core(jobs, progress, |(index, y, mut samples), go| {
            let acting = acting(inputs, index, width);
            let of = ((steps.length, steps.count), every, steps.normalises);
            let run = |solver: &Solver| solver.run(y, &acting, of, &mut samples, go);
            (index, solvers.with(index, run))
        });
        Ok((kept, result(count, failed, fallback, recomputed)))
    }

    /// Solvers of the states.
    fn solvers(&self) -> Solvers<'_> {
        Solvers { crafts: &self.crafts, shared: self.solver.as_ref() }
    }
}

/// What acts on a state.
fn acting(inputs: BatchInputs<'_>, index: usize, width: usize) -> ActingInputs {
    match inputs.rows.get(index * width..(index + 1) * width) {
        Some(row) => inputs.base.with_row(row),
        None => inputs.base.clone(),
    }
}

fn result(
    count: usize,
    failed: Vec<(usize, Result<(), StateError>)>,
    fallback: Option<GpuError>,
    recomputed: usize,
) -> BatchResult {
    let mut states = vec![Ok(()); count];
    for (index, end) in failed {
        states[index] = end;
    }
    BatchResult { states, fallback, recomputed }
}
