//! A batch on its device: in parts that fit its memory, a run in calls of some hundred steps.

use std::ops::Range;

use crate::batch::{Batch, COMPUTED};
use crate::layout::{columns, normalise, parameters};
use crate::processor::share;
use crate::{Array, BatchInputs, GpuError, Progress, Samples, Segment, Steps};

/// Steps of a call of the device.
const SEGMENT: usize = 256;
/// The share of the free memory that a batch takes.
const MEMORY: usize = 2;

impl Batch {
    /// Bytes of a state with so many numbers beside parameters and inputs.
    pub(crate) fn bytes(&self, numbers: usize, inputs: BatchInputs<'_>) -> usize {
        let own = if self.each { 11 + 9 * self.devices() + 18 * self.layout.joints } else { 0 };
        let rows = if inputs.rows.is_empty() { 0 } else { self.layout.width() };
        8 * (numbers + own + rows) + 4
    }

    fn devices(&self) -> usize {
        self.crafts.first().map_or(0, |(_, devices)| devices.len())
    }

    /// Does work with parts of the states that fit the device. The statuses of the states, and why the device did not compute
    /// the last ones: these have a status that is none of the kernels'.
    pub(crate) fn in_parts(
        &mut self,
        count: usize,
        bytes: usize,
        mut work: impl FnMut(&mut Self, Range<usize>, &mut [i32]) -> Result<bool, GpuError>,
    ) -> (Vec<i32>, Option<GpuError>) {
        const NOT_COMPUTED: i32 = -1;
        let mut statuses = vec![NOT_COMPUTED; count];
        let mut start = 0;
        while start < count {
            let done = self.part(bytes).and_then(|most| {
                let part = start..count.min(start + most);
                let goes_on = work(self, part.clone(), &mut statuses[part.clone()])?;
                Ok((part.end, goes_on))
            });
            match done {
                Ok((_, false)) => return (statuses, None),
                Ok((end, true)) => start = end,
                Err(error) => {
                    statuses[start..].fill(NOT_COMPUTED);
                    return (statuses, Some(error));
                }
            }
        }
        (statuses, None)
    }

    /// The most states of a part.
    fn part(&mut self, bytes: usize) -> Result<usize, GpuError> {
        let kernels = self.kernels.as_mut().map_err(|error| error.clone())?;
        let free = kernels.free_bytes()?;
        match (free / MEMORY / bytes).min(i32::MAX as usize) {
            0 => Err(GpuError::Memory { state: bytes, free }),
            most => Ok(most),
        }
    }

    /// Writes what a part of the states is and what acts on it; `normalised` where its attitudes are.
    pub(crate) fn begin(
        &mut self,
        y: &[f64],
        part: &Range<usize>,
        inputs: BatchInputs<'_>,
        normalised: Option<&[f64]>,
    ) -> Result<(), GpuError> {
        let (size, width) = (self.layout.size(), self.layout.width());
        let kernels = self.kernels.as_mut().map_err(|error| error.clone())?;
        let count = i32::try_from(part.len()).unwrap_or(i32::MAX);
        let shared = self.crafts.first().map(|(hub, devices)| parameters(hub, devices));
        // Parameters that are refused: every state is, and the solver says why.
        let status = kernels.prepare(&shared.unwrap_or_default(), &inputs.base.shared())?;
        kernels.begin(count)?;
        if self.each || status != COMPUTED {
            let one = part.clone().map(|index| if self.each { index } else { 0 });
            let one = one.filter_map(|index| self.crafts.get(index));
            let rows: Vec<f64> = one.flat_map(|(hub, devices)| parameters(hub, devices)).collect();
            kernels.write(Array::Parameters, &columns(&rows, rows.len() / part.len().max(1)))?;
        }
        if !inputs.rows.is_empty() {
            let rows = &inputs.rows[part.start * width..part.end * width];
            kernels.write(Array::Inputs, &columns(rows, width))?;
        }
        let given = &y[part.start * size..part.end * size];
        let mut states = given.to_vec();
        states.chunks_exact_mut(size).for_each(normalise);
        let states = match normalised {
            // As they are.
            Some(rows) => rows,
            None => &states,
        };
        kernels.write(Array::States, &self.layout.columns(states))
    }

    /// Runs a part of the states on the device; whether to go on.
    pub(crate) fn run_part(
        &mut self,
        (y, kept, statuses): (&mut [f64], &mut Samples, &mut [i32]),
        (part, inputs): (Range<usize>, BatchInputs<'_>),
        (steps, every, taken): (Steps, usize, usize),
        progress: Progress<'_>,
    ) -> Result<bool, GpuError> {
        let size = self.layout.size();
        let given = y[part.start * size..part.end * size].to_vec();
        self.begin(y, &part, inputs, (!steps.normalises).then_some(&given))?;
        let layout = self.layout.clone();
        let kernels = self.kernels.as_mut().map_err(|error| error.clone())?;
        if steps.normalises {
            kernels.write(Array::Start, &layout.columns(&given))?;
        }
        let reductions: Vec<_> = kept.reductions.clone();
        for of in &reductions {
            kernels.zeros(of.array(), given.len())?;
        }
        if !kept.history.is_empty() {
            kernels.zeros(Array::History, given.len() * taken)?;
        }
        let whole = |of: usize| {
            let found = i32::try_from(of);
            found.map_err(|_| GpuError::Length {
                array: "a run",
                expected: i32::MAX as usize,
                found: of,
            })
        };
        whole(steps.count)?;
        let mut first = 0;
        loop {
            let now = SEGMENT.min(steps.count - first);
            let is_last = first + now == steps.count;
            kernels.run(Segment {
                dt: steps.length,
                first: whole(first)?,
                steps: whole(now)?,
                every: whole(every.min(i32::MAX as usize))?,
                is_last,
            })?;
            first += now;
            if !progress(share(first, steps.count.max(1))) {
                return Ok(false);
            }
            if is_last {
                break;
            }
        }
        kernels.statuses(statuses)?;
        let mut found = vec![0.0; given.len()];
        let mut take = |array: Array, rows: &mut [f64]| {
            kernels.read(array, &mut found)?;
            for (index, row) in rows.chunks_exact_mut(size).enumerate() {
                if statuses[index] == COMPUTED {
                    layout.write(&found, (index, part.len()), row);
                }
            }
            Ok::<(), GpuError>(())
        };
        // A state that is refused keeps what was given, for the solver.
        for (of, rows) in reductions.iter().zip(&mut kept.reduced) {
            take(of.array(), &mut rows[part.start * size..part.end * size])?;
        }
        if !kept.history.is_empty() {
            let mut all = vec![0.0; given.len() * taken];
            kernels.read(Array::History, &mut all)?;
            let rows = kept.history[part.start * taken * size..part.end * taken * size]
                .chunks_exact_mut(taken * size);
            for (index, rows) in rows.enumerate() {
                for (sample, row) in all.chunks_exact(given.len()).zip(rows.chunks_exact_mut(size))
                {
                    layout.write(sample, (index, part.len()), row);
                }
            }
        }
        let mut found = vec![0.0; given.len()];
        kernels.read(Array::States, &mut found)?;
        let rows = y[part.start * size..part.end * size].chunks_exact_mut(size);
        for (index, row) in rows.enumerate() {
            if statuses[index] == COMPUTED {
                layout.write(&found, (index, part.len()), row);
            }
        }
        Ok(true)
    }
}
