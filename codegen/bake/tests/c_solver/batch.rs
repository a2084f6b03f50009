//! The batch kernels, compiled for the host and run by a loop over threads: every state has the bits of the Rust,
//! for any number of threads and parts of a run.

use std::path::{Path, PathBuf};

use precess_bake::batch;
use precess_codegen::emit::EmittedFile;

use crate::case::{Case, Settings};
use crate::random::Random;
use crate::reference::reference;
use crate::{SEED, SETS, build, description, files, kinds, settings};

/// States of a batch.
const STATES: usize = 7;
/// Steps of a run.
const BATCH_STEPS: usize = 20;
/// Steps between samples.
const EVERY: usize = 4;
/// Threads, and parts of the run: one, more than states, numbers that divide neither states nor steps.
const LAUNCHES: [[usize; 2]; 3] = [[1, 1], [3, 3], [64, 20]];
/// `PRECESS_BAD_ANGLE`.
const BAD_ANGLE: f64 = 3.0;

/// The files of the solver of a set with those of its batches.
fn batch_files(name: &str, names: &[&str]) -> Vec<EmittedFile> {
    let devices: Vec<_> = (0..names.len()).map(|k| format!("device{k}")).collect();
    let more = batch(&description(name, &devices, names)).expect("a batch");
    let is_host = |file: &EmittedFile| !file.path.starts_with("nvrtc/");
    let more = more.into_iter().filter(is_host);
    files(name, names).into_iter().chain(more).collect()
}

/// The program of a set; `more` comes after the flags of the page.
fn batch_program(
    [name, compiler, test]: [&str; 3],
    files: &[EmittedFile],
    more: &[&str],
) -> PathBuf {
    let main = include_str!("batch.c").replace("NAME", name);
    let main = main.replace("UPPER", &name.to_uppercase());
    let folder = build::folder(&format!("solver_{test}_{name}_{compiler}"));
    build::c(&folder, compiler, files, &[("main.c", &main)], more)
}

/// A batch: the shared case, and one for each state.
struct Cases {
    shared: Case,
    all: Vec<Case>,
    /// What the Rust makes of each.
    expected: Vec<Expected>,
    /// Whether parameters and inputs are each state's own.
    own: bool,
}

/// A batch of random states; one of them not finite, one with an angle beyond 2^24 rad.
fn cases(names: &[&str], settings: Settings, own: bool, random: &mut Random) -> Cases {
    let kinds = kinds(names);
    let shared = Case::random(&kinds, settings, random);
    let state = |k: usize| {
        let mut case = Case::random(&kinds, settings, random);
        (case.r_b_n_ddot, case.omega_dot) = (shared.r_b_n_ddot, shared.omega_dot);
        (case.uniform, case.mu) = (shared.uniform, shared.mu);
        for (joint, of) in case.joints.iter_mut().zip(&shared.joints) {
            (joint.mode, joint.force, joint.moment) = (of.mode, of.force, of.moment);
            if joint.mode == 2 {
                joint.rate = 0.0;
            }
            if !own {
                (joint.torque, joint.acceleration) = (of.torque, of.acceleration);
            }
        }
        if !own {
            (case.mass, case.centre_of_mass) = (shared.mass, shared.centre_of_mass);
            (case.inertia, case.devices) = (shared.inertia, shared.devices.clone());
            (case.force, case.torque_b) = (shared.force, shared.torque_b);
        }
        match k {
            2 => case.omega[1] = f64::NAN,
            4 => {
                // A spring would be wound up by so many turns.
                let springs = case.devices.iter().flat_map(|device| {
                    let joints = device.kind().joints().iter();
                    let passive = device.parameters().passive;
                    joints.zip(passive).map(|(info, own)| !info.slides && own.stiffness == 0.0)
                });
                let turning: Vec<_> = springs.collect();
                let free = turning.iter().position(|free| *free).expect("a joint that turns");
                case.joints[free].coordinate = 2e7;
            }
            _ => {}
        }
        case
    };
    let all: Vec<_> = (0..STATES).map(state).collect();
    let expected = all.iter().map(expected).collect();
    Cases { shared, all, expected, own }
}

/// Rows as columns.
fn columns(rows: &[Vec<f64>]) -> Vec<f64> {
    (0..rows[0].len()).flat_map(|k| rows.iter().map(move |row| row[k])).collect()
}

/// What the program reads.
fn numbers(cases: &Cases, [threads, parts]: [usize; 2]) -> Vec<f64> {
    let joints = cases.shared.joints.len();
    let parameters = 11 + 9 * cases.shared.devices.len() + 18 * joints;
    let size = 13 + 2 * joints;
    let all: Vec<_> = cases.all.iter().map(Case::numbers).collect();
    let shared = cases.shared.numbers();
    let inputs = |case: &Case| {
        let motors = case.joints.iter();
        let motors =
            motors.map(|joint| if joint.mode == 1 { joint.acceleration } else { joint.torque });
        case.force.iter().chain(&case.torque_b).copied().chain(motors).collect::<Vec<_>>()
    };
    let own: Vec<_> = all.iter().map(|all| all[..parameters].to_vec()).collect();
    let states: Vec<_> =
        all.iter().map(|all| all[parameters..parameters + size].to_vec()).collect();
    let counts = [STATES, threads, parts, usize::from(cases.own)].map(count);
    let [steps, every] = [BATCH_STEPS, EVERY].map(count);
    let mut numbers = counts.to_vec();
    numbers.extend([cases.shared.settings.dt, steps, every]);
    numbers.extend(&shared[..parameters]);
    numbers.extend(&shared[parameters + size..shared.len() - 2]);
    numbers.extend(columns(&own));
    numbers.extend(columns(&cases.all.iter().map(inputs).collect::<Vec<_>>()));
    numbers.extend(columns(&states));
    numbers
}

#[expect(clippy::cast_precision_loss, reason = "counts are small")]
fn count(of: usize) -> f64 {
    of as f64
}

/// What the Rust makes of a state.
#[derive(Clone)]
struct Expected {
    /// Of accelerations and of the run.
    statuses: [f64; 2],
    accelerations: Vec<f64>,
    samples: Vec<Vec<f64>>,
}

fn expected(case: &Case) -> Expected {
    let joints = case.joints.len();
    let at = |steps: usize| {
        let settings = Settings { steps, ..case.settings };
        reference(&Case { settings, ..case.clone() })
    };
    let all: Vec<_> = (0..=BATCH_STEPS).step_by(EVERY).map(at).collect();
    let state = |all: &Vec<f64>| all[10 + joints..][..13 + 2 * joints].to_vec();
    let last = &all[all.len() - 1];
    Expected {
        statuses: [last[1], last[2]],
        accelerations: last[4..10 + joints].to_vec(),
        samples: all.iter().map(state).collect(),
    }
}

/// Minimum, maximum, mean and root of the mean square of each number, as a batch on the processor has them.
fn reduced(samples: &[Vec<f64>]) -> [Vec<f64>; 4] {
    let [mut least, mut most] = [samples[0].clone(), samples[0].clone()];
    let (mut sum, mut squares) = (vec![0.0; least.len()], vec![0.0; least.len()]);
    for sample in samples {
        for (k, x) in sample.iter().copied().enumerate() {
            least[k] = if x < least[k] { x } else { least[k] };
            most[k] = if x > most[k] { x } else { most[k] };
            sum[k] += x;
            squares[k] += x * x;
        }
    }
    let samples = count(samples.len());
    for (sum, square) in sum.iter_mut().zip(&mut squares) {
        (*sum, *square) = (*sum / samples, (*square / samples).sqrt());
    }
    [least, most, sum, squares]
}

/// The first number that differs from the Rust, and where.
fn differing(program: &Path, cases: &Cases, launch: [usize; 2]) -> Option<String> {
    let found = build::run(program, &numbers(cases, launch));
    let joints = cases.shared.joints.len();
    let (size, width) = (13 + 2 * joints, 6 + joints);
    let samples = BATCH_STEPS / EVERY + 1;
    assert_eq!(found.len(), STATES * (2 + width + (5 + samples) * size));
    let column = |start: usize, width: usize, state: usize| -> Vec<f64> {
        (0..width).map(|k| found[STATES * (start + k) + state]).collect()
    };
    let mut succeeded = 0;
    for (k, (case, expected)) in cases.all.iter().zip(&cases.expected).enumerate() {
        let mut expected = expected.clone();
        let statuses = [found[k], found[STATES + k]];
        if case.joints.iter().any(|joint| joint.coordinate > 1.9e7) {
            assert_eq!(expected.statuses, [0.0; 2], "the Rust takes that angle");
            (expected.statuses, expected.samples) = ([BAD_ANGLE; 2], Vec::new());
            expected.accelerations = vec![0.0; width];
        } else if statuses[1] == BAD_ANGLE && expected.statuses[1] != 0.0 {
            // A state that fails in the Rust, too, later in its step: its joint turns ever faster.
            (expected.statuses[1], expected.samples) = (BAD_ANGLE, Vec::new());
        }
        if statuses != expected.statuses {
            return Some(format!("state {k}: statuses {statuses:?}, not {:?}", expected.statuses));
        }
        let mut pairs = vec![("accelerations", 2, expected.accelerations.clone())];
        let from = |part: usize| 2 + width + part * size;
        // Of a state that failed, the last one before.
        if let Some(last) = expected.samples.last() {
            pairs.push(("the last state", from(0), last.clone()));
        }
        if statuses[1] == 0.0 {
            succeeded += 1;
            let names = ["minimum", "maximum", "mean", "rms"].into_iter().enumerate();
            let reduced = names.zip(reduced(&expected.samples));
            pairs.extend(reduced.map(|((n, name), own)| (name, from(1 + n), own)));
            let history = expected.samples.iter().cloned().enumerate();
            pairs.extend(history.map(|(n, sample)| ("a sample", from(5 + n), sample)));
        }
        for (name, start, expected) in pairs {
            let found = column(start, expected.len(), k);
            let differs = |(a, b): (&f64, &f64)| a.to_bits() != b.to_bits();
            if let Some(place) = found.iter().zip(&expected).position(differs) {
                let (found, expected) = (found[place], expected[place]);
                return Some(format!(
                    "{launch:?}, {:?}: number {place} of {name} of state {k} is {found:e}, not {expected:e}",
                    case.settings
                ));
            }
        }
    }
    // Two cannot; in bearings a random load may turn a wheel over.
    assert!(succeeded + 3 >= STATES, "{:?}: {succeeded} states", cases.shared.settings);
    None
}

/// Batches of a set in every setting, with parameters and inputs of their own and shared.
fn batches(names: &[&str]) -> Vec<Cases> {
    let flexible = names.iter().any(|name| name.starts_with("flexible"));
    let shorter = if flexible { 0.1 } else { 1.0 };
    let mut random = Random::new(SEED);
    let mut all = Vec::new();
    for own in [true, false] {
        for settings in settings() {
            let settings = Settings { dt: shorter * settings.dt, ..settings };
            all.push(cases(names, settings, own, &mut random));
        }
    }
    all
}

fn compare(name: &str, more: &[&str]) {
    let (_, names) = SETS.iter().find(|(set, _)| *set == name).expect("a set");
    let (files, batches) = (batch_files(name, names), batches(names));
    for compiler in build::compilers() {
        let program = batch_program([name, compiler, "batch"], &files, more);
        for batch in &batches {
            for launch in LAUNCHES {
                assert_eq!(differing(&program, batch, launch), None, "{name}, {compiler}");
            }
        }
    }
}

#[test]
fn batches_of_wheels_a_panel_and_slosh_have_the_bits_of_rust() {
    compare("mixed", &[]);
}

#[test]
#[ignore = "long: `cargo xtask test --all`"]
fn batches_of_every_other_kind_have_the_bits_of_rust() {
    for name in ["pyramid", "flexible", "others"] {
        // What the optimiser warns of it has seen in the first set, and in the solver of each.
        compare(name, &["-O0"]);
    }
}

/// A text of the batch kernels and what stands in its place.
const MUTANTS: [(&str, &str, &str); 4] = [
    ("precess_batch.h", "(sample == 0 || x < batch", "(x < batch"),
    ("precess_batch.h", ": batch->rms[place]) + x * x;", ": batch->rms[place]) + x;"),
    ("mixed_batch.c", "step % batch->every == 0", "(step - batch->first) % batch->every == 0"),
    ("mixed_batch.c", "joint->acceleration = number;", "joint->torque = number;"),
];

#[test]
#[ignore = "long: `cargo xtask test --all`"]
fn an_error_of_a_batch_is_noticed() {
    let (name, names) = SETS[1];
    let (files, batches) = (batch_files(name, names), batches(names));
    let Some(compiler) = build::compilers().first().copied() else { return };
    for (path, right, wrong) in MUTANTS {
        let mut files = files.clone();
        let file = files.iter_mut().find(|file| file.path == path).expect("a file");
        assert!(file.text.contains(right), "{path}: {right}");
        file.text = file.text.replacen(right, wrong, 1);
        let program = batch_program([name, compiler, "batch_mutants"], &files, &[]);
        let noticed = batches.iter().any(|batch| differing(&program, batch, [3, 3]).is_some());
        assert!(noticed, "{path}: `{wrong}` is not noticed");
    }
}
