//! Every number of a batch on a device has the bits of the solver: whatever differs from state to state, whatever is kept, however
//! many states fit at a time; states that the kernels refuse are computed again.

use precess_dynamics::BuiltInKind;
use precess_gpu::{
    Batch, BatchInputs, BatchResult, Device, GpuError, Reduction, SampleSettings, Samples, Steps,
};

use crate::case::Case;
use crate::host::{HostDevice, sources};
use crate::random::Random;
use crate::spacecraft::{SETTINGS, craft, expected, inputs, random, row};

/// Where random numbers start.
const SEED: u64 = 0x6_0042;
/// States; of them one is not finite, one has an angle beyond 2^24 rad, one is not normalised.
const STATES: usize = 9;
const NOT_FINITE: usize = 2;
const FAR: usize = 4;
const LONG: usize = 6;
/// Where parameters differ: a spacecraft without mass.
const NO_MASS: usize = 7;
/// Steps: more than one call of the device takes; and, where that was tried, what covers every sample and the sums.
const STEPS: usize = 260;
const FEW_STEPS: usize = 40;
const EVERY: usize = 7;
/// Bytes of a device on which all states fit, and on which two or three do.
const MEMORY: [usize; 2] = [1 << 30, 1 << 17];

fn kinds(names: &[&str]) -> Vec<BuiltInKind> {
    names.iter().map(|name| BuiltInKind::of_name(name).expect("a kind")).collect()
}

/// What differs from state to state.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Own {
    parameters: bool,
    inputs: bool,
}

/// The states of a batch; what they share is that of the first.
fn cases(kinds: &[BuiltInKind], own: Own, generator: &mut Random) -> Vec<Case> {
    let shared = random(kinds, SETTINGS, generator);
    let mut all = Vec::new();
    for index in 0..STATES {
        let mut case = random(kinds, SETTINGS, generator);
        case.mu = shared.mu;
        for (joint, of) in case.joints.iter_mut().zip(&shared.joints) {
            (joint.mode, joint.force, joint.moment) = (of.mode, of.force, of.moment);
            if joint.mode == 2 {
                joint.rate = 0.0;
            }
            if !own.inputs {
                (joint.torque, joint.acceleration) = (of.torque, of.acceleration);
            }
        }
        if !own.inputs {
            (case.force, case.torque_b) = (shared.force, shared.torque_b);
        }
        if !own.parameters {
            (case.mass, case.centre_of_mass) = (shared.mass, shared.centre_of_mass);
            (case.inertia, case.devices) = (shared.inertia, shared.devices.clone());
        }
        if index == NOT_FINITE {
            case.omega[1] = f64::NAN;
        }
        if index == FAR {
            // The first joint is a wheel's, without a spring.
            case.joints[0].coordinate = 2e7;
        }
        if own.parameters && index == NO_MASS {
            case.mass = -1.0;
        }
        all.push(case);
    }
    all
}

struct Found {
    steps: usize,
    accelerations: Vec<f64>,
    of_accelerations: BatchResult,
    states: Vec<f64>,
    samples: Samples,
    of_run: BatchResult,
}

/// The batch on a device.
fn found(cases: &[Case], own: Own, count: usize, device: Result<&dyn Device, GpuError>) -> Found {
    let crafts = cases.iter().take(if own.parameters { STATES } else { 1 }).map(craft).collect();
    let mut batch = Batch::new(crafts, own.parameters, device, sources).expect("a batch");
    let base = inputs(&cases[0]);
    let rows: Vec<f64> = if own.inputs {
        cases.iter().flat_map(|case| inputs(case).row()).collect()
    } else {
        Vec::new()
    };
    let acting = BatchInputs { base: &base, rows: &rows };
    let mut y: Vec<f64> = cases.iter().flat_map(row).collect();
    let size = batch.state_size();
    // Twice as long: normalised to the same bits.
    y[LONG * size + 6..LONG * size + 10].iter_mut().for_each(|of| *of *= 2.0);
    let mut accelerations = vec![0.0; STATES * batch.acceleration_size()];
    let of_accelerations =
        batch.accelerations(&y, acting, &mut accelerations, &|_| true).expect("lengths");
    let all = [Reduction::Rms, Reduction::Min, Reduction::Mean, Reduction::Max];
    let settings = SampleSettings { every: EVERY, history: true, reductions: all.to_vec() };
    let steps = Steps { length: SETTINGS.dt, count, normalises: true };
    let (samples, of_run) =
        batch.run(&mut y, acting, steps, &settings, &|_| true).expect("lengths");
    Found { steps: count, accelerations, of_accelerations, states: y, samples, of_run }
}

fn bits(numbers: &[f64]) -> Vec<u64> {
    numbers.iter().map(|number| number.to_bits()).collect()
}

fn compare(names: &[&str], steps: usize) {
    let kinds = kinds(names);
    let mut generator = Random::new(SEED);
    for (parameters, own_inputs) in [(false, false), (true, true), (false, true), (true, false)] {
        let own = Own { parameters, inputs: own_inputs };
        let cases = cases(&kinds, own, &mut generator);
        let processor = found(&cases, own, steps, Err(GpuError::NoDriver));
        assert_eq!(processor.of_run.fallback, Some(GpuError::NoDriver));
        for (bytes, threads) in MEMORY.into_iter().zip([3, 64]) {
            let in_parts = bytes == MEMORY[1];
            let device = HostDevice { bytes, threads };
            let found = found(&cases, own, steps, Ok(&device));
            for (result, kernels, processor) in [
                (&found.of_accelerations, &found.accelerations, &processor.accelerations),
                (&found.of_run, &found.states, &processor.states),
            ] {
                assert_eq!(result.fallback, None);
                assert_eq!(result.recomputed, if parameters { 3 } else { 2 }, "{own:?}");
                assert!(result.states[NOT_FINITE].is_err() && result.states[FAR].is_ok());
                assert_eq!(result.states[NO_MASS].is_err(), parameters);
                assert_eq!(
                    result.states.iter().filter(|of| of.is_err()).count(),
                    result.recomputed - 1
                );
                let width = kernels.len() / STATES;
                let rows = kernels.chunks(width).zip(processor.chunks(width));
                for (index, (found, expected)) in rows.enumerate() {
                    if result.states[index].is_ok() {
                        assert_eq!(bits(found), bits(expected), "{own:?}, state {index}");
                    }
                }
            }
            assert_eq!(
                format!("{:?}", found.of_run.states),
                format!("{:?}", processor.of_run.states)
            );
            same_samples(&found, &processor, own);
            if in_parts {
                by_another_suite(&cases, &found);
            }
        }
    }
}

fn same_samples(found: &Found, processor: &Found, own: Own) {
    let (a, b) = (&found.samples, &processor.samples);
    let of = |samples: &Samples| -> Vec<Vec<f64>> {
        samples.reduced.iter().chain([&samples.history]).cloned().collect()
    };
    for (which, (a, b)) in of(a).iter().zip(&of(b)).enumerate() {
        let width = a.len() / STATES;
        for (index, (found, expected)) in a.chunks(width).zip(b.chunks(width)).enumerate() {
            if found.is_empty() || processor.of_run.states[index].is_err() {
                continue;
            }
            assert_eq!(bits(found), bits(expected), "{own:?}, array {which} of state {index}");
        }
    }
    // The first sample is what was given.
    let width = a.history.len() / STATES;
    let q = &a.history[LONG * width + 6..LONG * width + 10];
    let norm: f64 = q.iter().map(|of| of * of).sum();
    assert!((norm - 4.0).abs() < 1e-12, "{norm}");
    let last = (found.steps / EVERY) * found.states.len() / STATES;
    let q: f64 = a.history[LONG * width + last..][6..10].iter().map(|of| of * of).sum();
    assert!((q - 1.0).abs() < 1e-9, "{q}");
}

/// Against what the suite of the emitted solver has of each state.
fn by_another_suite(cases: &[Case], found: &Found) {
    let [wide, size] = [found.accelerations.len() / STATES, found.states.len() / STATES];
    for (index, case) in cases.iter().enumerate() {
        let [accelerations, state] = expected(case, found.steps);
        let own = &found.accelerations[index * wide..(index + 1) * wide];
        assert_eq!(found.of_accelerations.states[index].is_ok(), accelerations.is_some());
        if let Some(expected) = accelerations {
            assert_eq!(bits(own), bits(&expected), "state {index}");
        }
        assert_eq!(found.of_run.states[index].is_ok(), state.is_some());
        if let Some(expected) = state {
            let own = &found.states[index * size..(index + 1) * size];
            assert_eq!(bits(own), bits(&expected), "state {index}");
        }
    }
}

#[test]
fn batches_of_wheels_and_gyros_have_the_bits_of_the_solver() {
    compare(&["reaction_wheel", "dgvscmg", "hinged_panel", "vscmg"], STEPS);
}

#[test]
#[ignore = "long: `cargo xtask test --all`"]
fn batches_of_every_other_kind_have_the_bits_of_the_solver() {
    compare(&["reaction_wheel", "sgcmg", "balanced_sgcmg", "slosh_mass"], FEW_STEPS);
    compare(&["reaction_wheel", "balanced_reaction_wheel", "dgcmg", "balanced_dgcmg"], FEW_STEPS);
    compare(&["reaction_wheel", "balanced_vscmg", "balanced_dgvscmg"], FEW_STEPS);
}

#[test]
fn a_run_of_no_steps_has_the_state_as_its_only_sample() {
    let kinds = kinds(&["reaction_wheel"]);
    let case = random(&kinds, SETTINGS, &mut Random::new(SEED));
    let device = HostDevice { bytes: MEMORY[0], threads: 1 };
    let mut batch = Batch::new(vec![craft(&case)], false, Ok(&device), sources).expect("a batch");
    let base = inputs(&case);
    let (given, mut y) = (row(&case), row(&case));
    let settings = SampleSettings { every: 1, history: true, reductions: vec![Reduction::Mean] };
    let steps = Steps { length: 1e-3, count: 0, normalises: true };
    let acting = BatchInputs { base: &base, rows: &[] };
    let (samples, result) =
        batch.run(&mut y, acting, steps, &settings, &|_| true).expect("lengths");
    assert_eq!((result.fallback, result.recomputed), (None, 0));
    assert_eq!([&y, &samples.history, &samples.reduced[0]], [&given; 3]);
}
