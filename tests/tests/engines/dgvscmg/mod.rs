//! The solver against independent engines: accelerations, momenta and bodies by Pinocchio and
//! `MuJoCo` for random spacecraft, stored in `fixtures/engines.json` by `engines/store.py`.
//!
//! Run with `--nocapture` to see worst and median of each claim.

mod bodies;
mod solved;
mod stored;

use nalgebra::Vector3;
use precess_tests::blocks::{Figures, NAMES, largest};
use precess_tests::bounds::{ACCELERATIONS_MEDIAN, ACCELERATIONS_WORST};
use precess_tests::stored::symmetric;
use serde_json::Value;

use bodies::{Kernels, Moment};
use solved::Solved;
use stored::{Blocks, Craft, StoredBody};

/// What every input is changed by, relatively, to see whether the comparison notices: a thousand
/// times [`ACCELERATIONS_WORST`], so an input with a thousandth of the influence of the largest one
/// still shows.
const CHANGE: f64 = 1e-8;

/// The bodies of a device, in the order of the file.
const PARTS: [&str; 3] = ["outer gimbal", "inner gimbal", "wheel"];

/// The inputs of a stored spacecraft.
const INPUTS: [&str; 6] = ["hub", "devices", "omega", "r_b_n_dot", "force", "torque_b"];

/// Figures of one claim: errors in units of a block.
struct Claim {
    name: &'static str,
    figures: Figures,
}

impl Claim {
    fn new(name: &'static str) -> Self {
        Self { name, figures: Figures::default() }
    }

    /// Takes the largest difference in units of the largest number expected. Energy, momenta and
    /// bodies are held to the bound of the accelerations: none is worse conditioned.
    fn take(&mut self, craft: &Craft, what: &str, actual: &[f64], expected: &[f64]) {
        let error = error(actual, expected);
        self.figures.add(error);
        assert!(
            error <= ACCELERATIONS_WORST,
            "{}: {what} differs by {error:e} of the block, above {ACCELERATIONS_WORST:e} ({})",
            self.name,
            craft.name
        );
    }

    fn take_blocks(&mut self, craft: &Craft, actual: &Blocks, expected: &Blocks) {
        for ((name, actual), expected) in NAMES.into_iter().zip(actual).zip(expected) {
            self.take(craft, name, actual, expected);
        }
    }

    fn finish(self) {
        let (worst, median) = (self.figures.worst(), self.figures.median());
        println!("{}: worst {worst:.2e} of the block, median {median:.2e}", self.name);
        assert!(
            median <= ACCELERATIONS_MEDIAN,
            "{}: median {median:e} is above {ACCELERATIONS_MEDIAN:e}",
            self.name
        );
    }
}

fn error(actual: &[f64], expected: &[f64]) -> f64 {
    assert_eq!(actual.len(), expected.len(), "one number for each number");
    let difference = largest(actual.iter().zip(expected).map(|(a, e)| (a - e).abs()));
    if difference == 0.0 { 0.0 } else { difference / largest(expected.iter().map(|e| e.abs())) }
}

#[test]
fn file_holds_one_to_four_devices_from_two_engines() {
    let file = stored::file();
    println!("pinocchio {}, mujoco {}", file.engines.pinocchio, file.engines.mujoco);
    for n in 1..=4 {
        assert!(file.spacecraft.iter().any(|craft| craft.stored.devices.len() == n), "{n} devices");
    }
    let mut claim = Claim::new("mujoco against pinocchio");
    for craft in &file.spacecraft {
        let (one, other) = (craft.pinocchio.motion.blocks(), craft.mujoco.blocks());
        claim.take_blocks(craft, &other, &one);
    }
    claim.finish();
}

#[test]
fn solver_gives_the_accelerations_of_both_engines() {
    let mut pinocchio = Claim::new("solver against pinocchio");
    let mut mujoco = Claim::new("solver against mujoco");
    for craft in &stored::file().spacecraft {
        let solver = Solved::new(craft).solver;
        pinocchio.take_blocks(craft, &solver, &craft.pinocchio.motion.blocks());
        mujoco.take_blocks(craft, &solver, &craft.mujoco.blocks());
    }
    pinocchio.finish();
    mujoco.finish();
}

#[test]
fn plain_reference_gives_the_accelerations_of_an_engine() {
    let mut claim = Claim::new("Newton-Euler reference against pinocchio");
    for craft in &stored::file().spacecraft {
        claim.take_blocks(craft, &Solved::new(craft).reference, &craft.pinocchio.motion.blocks());
    }
    claim.finish();
}

#[test]
fn solver_gives_energy_and_momenta_of_an_engine() {
    let mut claim = Claim::new("energy and momenta against pinocchio");
    for craft in &stored::file().spacecraft {
        let (solved, stored) = (Solved::new(craft), &craft.pinocchio);
        claim.take(craft, "energy", &[solved.energy], &[stored.motion.energy]);
        claim.take(craft, "energy of mujoco", &[solved.energy], &[craft.mujoco.energy]);
        claim.take(craft, "linear", solved.linear.as_slice(), &stored.linear);
        claim.take(craft, "angular_b", solved.angular_b.as_slice(), &stored.angular_b);
    }
    claim.finish();
}

#[test]
fn kernels_place_and_move_every_body_as_an_engine_does() {
    let mut claim = Claim::new("bodies seen from B against pinocchio");
    for craft in &stored::file().spacecraft {
        let joints = &craft.pinocchio.motion.accelerations;
        let devices = craft.stored.devices.iter().zip(joints).zip(&craft.pinocchio.bodies);
        for ((device, joints), expected) in devices {
            let found = Kernels::new(device, *joints).bodies();
            for ((part, found), expected) in PARTS.into_iter().zip(found).zip(expected) {
                let mut take = |what: &str, actual: &[f64], expected: &[f64]| {
                    claim.take(craft, &format!("{what} of {part}"), actual, expected);
                };
                take("r", found.r.as_slice(), &expected.r);
                take("r'", found.r_prime.as_slice(), &expected.r_prime);
                take("r''", found.r_dprime.as_slice(), &expected.r_dprime);
                take("omega", found.omega_b.as_slice(), &expected.omega_b);
                let inertia = symmetric(expected.i_b);
                take("inertia about B", found.i_b.as_slice(), inertia.as_slice());
            }
        }
    }
    claim.finish();
}

#[test]
fn kernels_sum_the_bodies_of_an_engine_to_the_first_moment() {
    let mut claim = Claim::new("first moment against pinocchio");
    for craft in &stored::file().spacecraft {
        let joints = &craft.pinocchio.motion.accelerations;
        let devices = craft.stored.devices.iter().zip(joints).zip(&craft.pinocchio.bodies);
        for ((device, joints), bodies) in devices {
            let Moment { mc, mc_prime, mc_dprime } = Kernels::new(device, *joints).moment();
            let p = device.parameters;
            let sum = |of: fn(&StoredBody) -> [f64; 3]| {
                let weighted = [p.m_go, p.m_gi, p.m_w].into_iter().zip(bodies);
                weighted.map(|(m, body)| Vector3::from(of(body)) * m).sum::<Vector3<f64>>()
            };
            let mut take = |what, actual: Vector3<f64>, expected: Vector3<f64>| {
                claim.take(craft, what, actual.as_slice(), expected.as_slice());
            };
            take("m c", mc, sum(|body| body.r));
            take("m c'", mc_prime, sum(|body| body.r_prime));
            take("m c''", mc_dprime, sum(|body| body.r_dprime));
        }
    }
    claim.finish();
}

/// At unit scales no contribution is hidden by a larger one: whichever input changes by [`CHANGE`],
/// an acceleration, or with the velocity of B the energy, leaves what the engines gave.
#[test]
fn comparison_notices_every_input_of_a_spacecraft_at_unit_scales() {
    let file: Value = serde_json::from_str(&stored::text()).expect("read as a file already");
    let craft = &file["spacecraft"][0];
    let mut inputs = Vec::new();
    for part in INPUTS {
        collect_numbers(&craft[part], &format!("/{part}"), &mut inputs);
    }
    inputs.retain(|pointer| !pointer.contains("/mount/"));
    println!("{} inputs of {}", inputs.len(), craft["name"]);
    assert_eq!(inputs.len(), 10 + 37 + 9 + 12, "hub, parameters, joints and motors, vectors");

    let mut least = (f64::INFINITY, String::new());
    for pointer in inputs {
        let mut changed = craft.clone();
        let number = changed.pointer_mut(&pointer).expect("collected from this very value");
        *number = (number.as_f64().expect("a number") * (1.0 + CHANGE)).into();
        let changed: Craft = serde_json::from_value(changed).expect("numbers for numbers");
        let solved = Solved::new(&changed);
        let blocks = changed.pinocchio.motion.blocks();
        let energy = error(&[solved.energy], &[changed.pinocchio.motion.energy]);
        let errors = solved.solver.iter().zip(&blocks).map(|(found, stored)| error(found, stored));
        let noticed = largest(errors.chain([energy]));
        assert!(
            noticed > ACCELERATIONS_WORST,
            "{pointer} changed by {CHANGE:e} moves nothing by more than {noticed:e} of its block"
        );
        if noticed < least.0 {
            least = (noticed, pointer);
        }
    }
    println!("least noticed: {}, by {:.1e} of a block", least.1, least.0);
}

/// JSON pointers of all numbers within a value.
fn collect_numbers(value: &Value, pointer: &str, found: &mut Vec<String>) {
    match value {
        Value::Number(_) => found.push(pointer.to_owned()),
        Value::Array(items) => {
            for (index, item) in items.iter().enumerate() {
                collect_numbers(item, &format!("{pointer}/{index}"), found);
            }
        }
        Value::Object(fields) => {
            for (key, field) in fields {
                collect_numbers(field, &format!("{pointer}/{key}"), found);
            }
        }
        Value::Null | Value::Bool(_) | Value::String(_) => {}
    }
}
