//! Runs in lanes that are observed on the way, and batches on several threads, against steps one by
//! one: to the bit, errors included.

use precess_dynamics::lanes::{Batch, BatchInputs, Observers};
use precess_dynamics::{Gravity, HubMode, Inputs, Passive, SolveError, Spacecraft, State};

use super::batch::{Mixed, hub, inputs, mixed, states};
use super::one_spacecraft_each::{crafts, printed};

/// Length of a step, s.
const DT: f64 = 1e-3;

/// Longer than the stretch between two takings out of the lanes, and no multiple of it.
const STEPS: usize = 75;

/// What a record sees of a run.
type Record = Vec<(usize, State<Mixed>)>;

/// Inputs of which some lanes do not support, and some are rejected; early or late in a run.
fn mixed_inputs(count: u32) -> Vec<Inputs<Mixed>> {
    let input = |k: u32| {
        let mut inputs = inputs(k % 3);
        match k {
            4 => inputs.hub = HubMode::Fixed,
            5 => inputs.gravity = Gravity::Central { mu: 1e3 },
            6 => inputs.force.x = f64::NAN,
            8 => inputs.motors.0[0].u_w = 1e305,
            _ => {}
        }
        inputs
    };
    (0..count).map(input).collect()
}

/// A spacecraft with dry friction: of a gimbal, and of a wheel that may not come to rest in a step.
fn dry() -> Spacecraft<Mixed> {
    let mut devices = mixed();
    devices.1.passive.gimbal = Passive::friction(0.0, 0.02, 0.05);
    devices.0[1].passive.wheel = Passive::friction(0.0, 0.02, 1e-6);
    Spacecraft::new(&hub(), &devices).unwrap()
}

/// The ends of runs one by one, what became of them and what is seen of them.
fn one_by_one<'a>(
    craft: impl Fn(usize) -> &'a Spacecraft<Mixed>,
    states: &[State<Mixed>],
    inputs: &[Inputs<Mixed>],
    every: usize,
) -> String {
    let run = |(k, (start, inputs)): (usize, (&State<Mixed>, &Inputs<Mixed>))| {
        let (mut state, mut record) = (*start, Record::new());
        let end = (1..=STEPS).try_for_each(|step| {
            state = craft(k).step(&state, inputs, DT)?;
            if step.is_multiple_of(every) {
                record.push((step, state));
            }
            Ok::<_, SolveError<f64>>(())
        });
        (state, end, record)
    };
    let runs: Vec<_> = states.iter().zip(inputs).enumerate().map(run).collect();
    printed(&runs)
}

/// The same of a batch, by its call.
fn of_batch(
    states: &[State<Mixed>],
    every: usize,
    run: impl FnOnce(
        &mut [State<Mixed>],
        Observers<'_, Record, fn(&mut Record, usize, &State<Mixed>)>,
        &mut Vec<Result<(), SolveError<f64>>>,
    ),
) -> String {
    let (mut ends, mut outcomes) = (states.to_vec(), Vec::new());
    let mut records = vec![Record::new(); states.len()];
    let see: fn(&mut Record, usize, &State<Mixed>) = |record, step, state| {
        record.push((step, *state));
    };
    run(&mut ends, Observers::new(every, &mut records, see), &mut outcomes);
    let runs: Vec<_> =
        ends.into_iter().zip(outcomes).zip(records).map(|((s, e), r)| (s, e, r)).collect();
    printed(&runs)
}

#[test]
fn observed_runs_have_the_bits_of_single_steps() {
    let (mut states, inputs) = (states(19), mixed_inputs(19));
    // The wheel's angle passes what lanes support on the way.
    states[7].devices.0[0].theta = 16_777_211.0;
    // The other wheel's comes back, and lanes with it.
    (states[10].devices.0[0].theta, states[10].devices.0[0].spin) = (16_777_221.0, -290.0);
    // Friction stops the wheel after 50 steps.
    states[9].devices.0[1].spin = 0.05;
    let crafts: Vec<_> = crafts(19)
        .into_iter()
        .enumerate()
        .map(|(k, c)| if k % 4 == 1 { dry() } else { c })
        .collect();
    let batch = Batch::new(&hub(), &mixed()).unwrap();
    let each = Batch::from_spacecraft(crafts.clone());
    for every in [1, 7, 32, 80] {
        let single = one_by_one(|_| &batch.spacecraft()[0], &states, &inputs, every);
        let found = of_batch(&states, every, |states, observers, ends| {
            batch.run_observed(states, &inputs, DT, STEPS, observers, ends).unwrap();
        });
        assert_eq!(found, single, "every {every}");
        let single = one_by_one(|k| &crafts[k], &states, &inputs, every);
        let found = of_batch(&states, every, |states, observers, ends| {
            each.run_observed(states, &inputs, DT, STEPS, observers, ends).unwrap();
        });
        assert_eq!(found, single, "parameters, every {every}");
    }
    // The inputs are what they are meant to be: some runs fail, one spacecraft's on the way.
    let (mut run, mut ends) = (states.clone(), Vec::new());
    batch.run(&mut run, &inputs, DT, STEPS, &mut ends).unwrap();
    let failed: Vec<_> = (0..19).filter(|k| ends[*k].is_err()).collect();
    assert_eq!(failed, [4, 6, 8]);
    assert!(run[7].devices.0[0].theta > 16_777_216.0);
    run.clone_from(&states);
    each.run(&mut run, &inputs, DT, STEPS, &mut ends).unwrap();
    assert!(matches!(ends[9], Err(SolveError::Unstable { .. })), "{:?}", ends[9]);
    assert!(run[9].devices.0[1].spin < 0.02, "failed early");
}

#[test]
fn records_for_another_number_of_states_are_rejected() {
    let batch = Batch::new(&hub(), &mixed()).unwrap();
    let mut records = vec![0; 3];
    let count = |count: &mut usize, _, _: &State<Mixed>| *count += 1;
    let (mut states, mut ends) = (states(4), Vec::new());
    let observers = Observers::new(2, &mut records, count);
    let run = batch.run_observed(&mut states, &inputs(0), DT, 5, observers, &mut ends);
    assert_eq!(run, Err(SolveError::Count { expected: 4, found: 3 }));
    // Every zeroth step is every step; none is seen where there are none.
    records.push(0);
    for (every, steps, seen) in [(0, 5, 5), (2, 5, 2), (6, 5, 0), (1, 0, 0)] {
        records.fill(0);
        let observers = Observers::new(every, &mut records, count);
        batch.run_observed(&mut states, &inputs(0), DT, steps, observers, &mut ends).unwrap();
        assert_eq!(records, [seen; 4], "{steps} steps, every {every}");
    }
}

/// What a call finds in pools of so many threads.
fn in_pools(call: impl Fn() -> String + Sync) -> Vec<String> {
    let pool = |threads| rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
    [1, 2, 3, 5].map(|threads| pool(threads).install(&call)).to_vec()
}

#[test]
fn any_number_of_threads_has_the_bits_of_one() {
    for count in [0, 1, 19, 300, 2500] {
        let (states, inputs) = (states(count), mixed_inputs(count));
        let batch = Batch::new(&hub(), &mixed()).unwrap();
        let each = Batch::from_spacecraft(crafts(count));
        let evaluated = |batch: &Batch<Mixed>, each: &Batch<Mixed>| {
            let mut found = [Vec::new(), Vec::new(), Vec::new()];
            batch.accelerations(&states, &inputs, &mut found[0]).unwrap();
            batch.accelerations(&states, &super::batch::inputs(1), &mut found[1]).unwrap();
            each.accelerations(&states, &inputs, &mut found[2]).unwrap();
            printed(&found)
        };
        let one = evaluated(&batch, &each);
        let (batch, each) = (batch.on_threads(), each.on_threads());
        for found in in_pools(|| evaluated(&batch, &each)) {
            assert!(found == one, "{count} states");
        }
    }
}

#[test]
fn runs_on_any_number_of_threads_have_the_bits_of_one() {
    for count in [1, 19, 150] {
        let (states, inputs) = (states(count), mixed_inputs(count));
        let batch = Batch::new(&hub(), &mixed()).unwrap();
        let each = Batch::from_spacecraft(crafts(count));
        let of_batch = |batch: &Batch<Mixed>| {
            of_batch(&states, 20, |states, observers, ends| {
                batch.run_observed(states, &inputs, DT, STEPS, observers, ends).unwrap();
            })
        };
        let of_each = |each: &Batch<Mixed>| {
            let (mut run, mut ends) = (states.clone(), Vec::new());
            each.run(&mut run, BatchInputs::from(&inputs), DT, STEPS, &mut ends).unwrap();
            printed(&(run, ends))
        };
        let (one, on_threads) = (of_batch(&batch), batch.clone().on_threads());
        let found = in_pools(|| of_batch(&on_threads));
        assert!(found.iter().all(|found| *found == one), "{count} states");
        let (one, on_threads) = (of_each(&each), each.clone().on_threads());
        let found = in_pools(|| of_each(&on_threads));
        assert!(found.iter().all(|found| *found == one), "{count} spacecraft");
    }
}

/// Parts are handed to other threads: in a pool of two, not all states are observed by one.
#[test]
fn several_threads_take_part() {
    let batch = Batch::new(&hub(), &mixed()).unwrap().on_threads();
    let pool = rayon::ThreadPoolBuilder::new().num_threads(2).build().unwrap();
    let (mut run, mut ends) = (states(400), Vec::new());
    let mut by = vec![None; 400];
    let see = |by: &mut Option<usize>, _, _: &State<Mixed>| {
        *by = rayon::current_thread_index();
        // Long enough for the other thread to wake up.
        std::thread::sleep(std::time::Duration::from_micros(50));
    };
    pool.install(|| {
        let observers = Observers::new(2, &mut by, see);
        batch.run_observed(&mut run, &inputs(0), DT, 2, observers, &mut ends).unwrap();
    });
    assert!(by.contains(&Some(0)) && by.contains(&Some(1)), "{by:?}");
}
