//! [`of_kind`]: the batch of spacecraft with devices of one kind.

use nalgebra::Vector3;
use precess_dynamics::kind::{Each as _, Kind};
use precess_dynamics::lanes::{Batch, BatchInputs, Observers};
use precess_dynamics::{
    Accelerations, Attitude as _, Hub, Inputs, JointStates as _, ParameterError, Quaternion,
    SolveError, Spacecraft, State,
};

use crate::{BatchSupport, Lanes, PART, RunObserver, SEGMENT, StateInputs, StateResults, Steps};

/// Numbers of the hub in a flat state.
const HUB: usize = 13;

/// Devices of a kind.
pub(crate) type Set<K> = Vec<K>;

/// Accelerations of a state.
type KindAccelerations<K> = Result<Accelerations<Set<K>>, SolveError<f64>>;

/// A batch of one spacecraft for every state, or of one for each, part by part.
struct KindBatch<K: Kind<Scalar = f64>> {
    each: bool,
    parts: Vec<Batch<Set<K>>>,
}

/// The batch, and what is wrong with each spacecraft: in its place is the first sound one.
pub(crate) fn of_kind<K: Kind<Scalar = f64>>(crafts: &[(Hub, Set<K>)], each: bool) -> BatchSupport {
    if !each {
        let Some((hub, devices)) = crafts.first() else { return BatchSupport::Unsupported };
        return match Batch::new(hub, devices) {
            Ok(batch) => {
                BatchSupport::Lanes(Box::new(KindBatch { each, parts: vec![batch] }), vec![None])
            }
            Err(error) => failed(vec![Some(error)]),
        };
    }
    let made: Vec<_> = crafts.iter().map(|(hub, set)| Spacecraft::new(hub, set)).collect();
    let errors: Vec<_> = made.iter().map(|of| of.as_ref().err().copied()).collect();
    let Some(sound) = made.iter().find_map(|of| of.as_ref().ok()).cloned() else {
        return failed(errors);
    };
    let sound: Vec<_> = made.into_iter().map(|of| of.unwrap_or_else(|_| sound.clone())).collect();
    let parts = sound.chunks(PART).map(|part| Batch::from_spacecraft(part.to_vec())).collect();
    BatchSupport::Lanes(Box::new(KindBatch { each, parts }), errors)
}

/// No spacecraft is sound.
fn failed(errors: Vec<Option<ParameterError<f64>>>) -> BatchSupport {
    BatchSupport::Lanes(Box::new(EmptyBatch), errors)
}

/// A batch of no sound spacecraft: nothing is evaluated.
struct EmptyBatch;

impl Lanes for EmptyBatch {
    fn accelerations(&self, _: usize, _: &[f64], _: &[StateInputs], _: &mut [f64]) -> StateResults {
        Vec::new()
    }

    fn run(
        &self,
        _: usize,
        _: &mut [f64],
        _: &[StateInputs],
        _: Steps,
        _: RunObserver<'_>,
    ) -> StateResults {
        Vec::new()
    }
}

impl<K: Kind<Scalar = f64>> KindBatch<K> {
    /// A spacecraft of the shape of all.
    fn shape(&self) -> Option<&Spacecraft<Set<K>>> {
        self.parts.first()?.spacecraft().first()
    }

    /// The batch of a part; none where there is no such part.
    fn part(&self, part: usize) -> Option<&Batch<Set<K>>> {
        if self.each { self.parts.get(part) } else { self.parts.first() }
    }
}

impl<K: Kind<Scalar = f64>> Lanes for KindBatch<K> {
    fn accelerations(
        &self,
        part: usize,
        y: &[f64],
        inputs: &[StateInputs],
        out: &mut [f64],
    ) -> StateResults {
        let Some(shape) = self.shape() else { return Vec::new() };
        let states = states(shape, y);
        let inputs = inputs_of(shape, inputs);
        let mut found = Vec::new();
        let acting = batch_inputs(&inputs);
        let Some(batch) = self.part(part) else { return Vec::new() };
        if let Err(error) = batch.accelerations(&states, acting, &mut found) {
            return vec![Err(error); states.len()];
        }
        let width = out.len() / states.len().max(1);
        let rows = out.chunks_exact_mut(width.max(1));
        let one = |(row, found): (&mut [f64], KindAccelerations<K>)| {
            let found = found?;
            let hub = found.r_b_n_ddot.iter().chain(found.omega_dot.iter()).copied();
            let numbers = hub.chain(found.devices.values());
            row.iter_mut().zip(numbers).for_each(|(to, from)| *to = from);
            Ok(())
        };
        rows.zip(found).map(one).collect()
    }

    fn run(
        &self,
        part: usize,
        y: &mut [f64],
        inputs: &[StateInputs],
        steps: Steps,
        watch: RunObserver<'_>,
    ) -> StateResults {
        let (Some(shape), Some(batch)) = (self.shape(), self.part(part)) else {
            return Vec::new();
        };
        let mut now = states(shape, y);
        let inputs = inputs_of(shape, inputs);
        let width = HUB + 2 * joints(shape);
        let every = steps.every.max(1);
        let mut ends = vec![Ok(()); now.len()];
        let (mut done, mut reached) = (0, Vec::new());
        // Samples of each state, one after the other, where one is seen before the last step.
        let on_the_way = steps.every < steps.count;
        let segment = if on_the_way { SEGMENT.div_ceil(every) * every } else { SEGMENT };
        let mut records = vec![Record::default(); if on_the_way { now.len() } else { 0 }];
        while done < steps.count && (watch.go)() {
            let count = segment.min(steps.count - done);
            records.iter_mut().for_each(Record::clear);
            let observe = |record: &mut Record, steps: usize, state: &State<Set<K>>| {
                record.push(steps, state, width);
            };
            let observers = on_the_way.then(|| Observers::new(every, &mut records, observe));
            let (acting, length) = (batch_inputs(&inputs), steps.length);
            let fit = match observers {
                Some(of) => batch.run_observed(&mut now, acting, length, count, of, &mut reached),
                None => batch.run(&mut now, acting, length, count, &mut reached),
            };
            if let Err(error) = fit {
                return vec![Err(error); now.len()];
            }
            // A state that failed fails again at the same step: its first error stays.
            for (end, reached) in ends.iter_mut().zip(&reached) {
                if end.is_ok() {
                    *end = *reached;
                }
            }
            for (index, record) in records.iter().enumerate() {
                for (steps, row) in record.steps.iter().zip(record.rows.chunks_exact(width)) {
                    (watch.see)(index, done + *steps, row);
                }
            }
            done += count;
        }
        let seen_last = !on_the_way && done == every;
        for (index, (state, row)) in now.iter().zip(y.chunks_exact_mut(width)).enumerate() {
            pack(state, row);
            if seen_last && ends.get(index).is_some_and(Result::is_ok) {
                (watch.see)(index, done, row);
            }
        }
        ends
    }
}

/// The samples of a state within a segment.
#[derive(Clone, Default)]
struct Record {
    steps: Vec<usize>,
    rows: Vec<f64>,
}

impl Record {
    fn push<K: Kind<Scalar = f64>>(&mut self, steps: usize, state: &State<Set<K>>, width: usize) {
        self.steps.push(steps);
        let start = self.rows.len();
        self.rows.resize(start + width, 0.0);
        if let Some(row) = self.rows.get_mut(start..) {
            pack(state, row);
        }
    }

    fn clear(&mut self) {
        self.steps.clear();
        self.rows.clear();
    }
}

fn joints<K: Kind<Scalar = f64>>(shape: &Spacecraft<Set<K>>) -> usize {
    shape.joints().count()
}

/// Rows as states, their quaternions normalised.
fn states<K: Kind<Scalar = f64>>(shape: &Spacecraft<Set<K>>, y: &[f64]) -> Vec<State<Set<K>>> {
    let rest = State::at_rest_for(shape);
    let per_device = K::JOINTS.len();
    let rows = y.chunks_exact(HUB + 2 * joints(shape));
    let one = |row: &[f64]| {
        let mut state = rest.clone();
        let at = |index: usize| row.get(index).copied().unwrap_or(f64::NAN);
        let vector = |index| Vector3::new(at(index), at(index + 1), at(index + 2));
        (state.r_b_n, state.r_b_n_dot, state.omega) = (vector(0), vector(3), vector(10));
        state.attitude = Quaternion { q0: at(6), q1: at(7), q2: at(8), q3: at(9) }.normalised();
        for (joint, [coordinate, rate]) in state.devices.states_mut().enumerate() {
            let (device, own) = (joint / per_device, joint % per_device);
            let first = HUB + 2 * per_device * device + own;
            (*coordinate, *rate) = (at(first), at(first + per_device));
        }
        state
    };
    rows.map(one).collect()
}

/// A state as a row.
fn pack<K: Kind<Scalar = f64>>(state: &State<Set<K>>, row: &mut [f64]) {
    let q = state.attitude;
    let hub = state.r_b_n.iter().chain(state.r_b_n_dot.iter()).copied();
    let hub = hub.chain([q.q0, q.q1, q.q2, q.q3]).chain(state.omega.iter().copied());
    row.iter_mut().zip(hub).for_each(|(to, from)| *to = from);
    let per_device = K::JOINTS.len();
    for (joint, [coordinate, rate]) in state.devices.states().enumerate() {
        let (device, own) = (joint / per_device, joint % per_device);
        let first = HUB + 2 * per_device * device + own;
        if let Some(to) = row.get_mut(first) {
            *to = coordinate;
        }
        if let Some(to) = row.get_mut(first + per_device) {
            *to = rate;
        }
    }
}

/// Inputs of the set.
fn inputs_of<K: Kind<Scalar = f64>>(
    shape: &Spacecraft<Set<K>>,
    inputs: &[StateInputs],
) -> Vec<Inputs<Set<K>>> {
    let none = Inputs::none_for(shape);
    let one = |of: &StateInputs| {
        let mut inputs = none.clone();
        write_inputs(shape, of, &mut inputs);
        inputs
    };
    inputs.iter().map(one).collect()
}

/// Writes what acts into inputs of the set.
pub(crate) fn write_inputs<K: Kind<Scalar = f64>>(
    shape: &Spacecraft<Set<K>>,
    of: &StateInputs,
    inputs: &mut Inputs<Set<K>>,
) {
    (inputs.force, inputs.torque_b) = (of.force, of.torque_b);
    (inputs.hub, inputs.gravity) = (of.hub, of.gravity);
    inputs.motors.values_mut().zip(&of.motors).for_each(|(to, from)| *to = *from);
    inputs.modes.values_mut().zip(&of.modes).for_each(|(to, from)| *to = *from);
    let Some(bodies) = &of.bodies else {
        inputs.bodies = None;
        return;
    };
    let all = inputs.bodies.get_or_insert_with(|| Inputs::no_wrenches_for(shape));
    all.values_mut().zip(bodies).for_each(|(to, from)| *to = *from);
}

/// The same for every state where there is one.
fn batch_inputs<K: Kind<Scalar = f64>>(inputs: &[Inputs<Set<K>>]) -> BatchInputs<'_, Set<K>> {
    match inputs {
        [one] => BatchInputs::Same(one),
        each => BatchInputs::Each(each),
    }
}
