//! Lines of a wheel on a rigid hub, natural frequencies of a wheel on its bearings, and polynomials over the speed,
//! against closed forms.

use std::path::Path;

use precess::file::from_toml;
use precess::jitter::campbell::{Whirl, branches, crossings, oscillations};
use precess::jitter::device::{Steady, SweptDevice};
use precess::jitter::model::{HUB, Model, Output};
use precess::jitter::sweep::{Phases, refined, speeds, sweep};
use precess::jitter::weight::Weight;
use precess::pointing::Metric;
use precess::scenario::steady::SteadyJoints;
use precess::scenario::{Scenario, set_of};
use precess::structure::averaged::AveragedDevices;
use precess::structure::dynamic_mass::Motor;

/// Rounding of products of a few matrices of six rows.
const ROUNDING: f64 = 1e-12;

pub(crate) const STEADY: Steady<'static> =
    Steady { motor: Motor::ConstantTorque, sprung: true, swept: Some(&[]) };

fn scenario(text: &str) -> Scenario {
    let text = format!("format = 1\n{text}\n[run]\nduration = \"1 s\"\n");
    let (scenario, _) =
        from_toml("test", &text, Path::new("")).unwrap_or_else(|errors| panic!("{errors}"));
    scenario
}

fn rows(node: &str) -> Vec<Output> {
    let output = |axis: usize| {
        let mut row = [0.0; 6];
        row[axis] = 1.0;
        Output { name: format!("{node} {axis}"), terms: vec![(node.to_owned(), row)] }
    };
    (0..6).map(output).collect()
}

const WHEEL: &str = r#"
[hub]
mass = "46 kg"
inertia = "8, 7, 7 kg m^2"
[[device]]
name = "rw"
kind = "reaction_wheel"
mount = { spin_axis = [1, 0, 0] }
imbalance = { static = "2 g cm", dynamic = "30 g cm^2", phase = "25 deg" }
[device.wheel]
mass = "4 kg"
inertia = "0.02, 0.012, 0.012 kg m^2"
rate = "RATE rad/s"
"#;

/// The whole moves by `U_s / m` at every speed, and turns by `U_d / (I + J_t - J_s)`: the inertia across the axis
/// less the momentum of the wheel, which a rotating moment at the wheel's rate feels as inertia.
#[test]
fn a_wheel_at_the_centre_of_a_rigid_hub_moves_it_by_its_imbalance_over_the_mass() {
    for rate in [500.0_f64, -500.0] {
        let scenario = scenario(&WHEEL.replace("RATE", &rate.to_string()));
        let model = Model::new(&scenario, &rows(HUB), &STEADY).expect("valid");
        let contributors = model.contributors();
        assert_eq!(contributors.len(), 1, "{contributors:?}");
        assert_eq!((contributors[0].order, contributors[0].cause.as_str()), (1.0, "imbalance"));
        assert_eq!(contributors[0].rotor, "rw.wheel");
        let (moved, turned): (f64, f64) = (2e-5 / 50.0, 3e-6 / (7.0 + 0.012 - 0.02));
        for speed in [30.0, 200.0, 700.0] {
            let lines = model.lines(speed).expect("above zero");
            assert!((lines[0].frequency - speed).abs() < 1e-12 * speed);
            let values: Vec<f64> = lines[0].values.iter().map(|value| value.norm()).collect();
            // The static imbalance turns nothing: the wheel's centre is that of the hub. Its mass is off its centre,
            // which changes the transverse inertia by m d^2: 1e-10 kg m^2.
            let near = |found: f64, expected: f64| {
                assert!((found - expected).abs() < 1e-10 * expected, "{found:e}, {expected:e}");
            };
            for axis in [1, 2] {
                near(values[axis], moved);
                near(values[3 + axis], turned);
            }
            assert!(values[0] < 1e-9 * moved && values[3] < 1e-9 * turned, "{values:?}");
            // It turns with the wheel: z lags y by a quarter turn, or leads.
            let [y, z] = [lines[0].values[1], lines[0].values[2]];
            let ratio = z / y;
            assert!((ratio.im + rate.signum()).abs() < 1e-9 && ratio.re.abs() < 1e-9, "{ratio}");
        }
    }
}

/// Two equal wheels at the centre: mean squares, amplitudes or magnitudes are added.
#[test]
fn phases_between_rotors_are_unknown_given_or_the_worst() {
    let wheel = WHEEL.split_once("[[device]]").expect("a device").1;
    let second = wheel
        .replace("\"rw\"", "\"other\"")
        .replace("RATE rad/s\"", "RATE rad/s\"\nangle = \"180 deg\"");
    let text = format!("{WHEEL}[[device]]{second}").replace("RATE", "300");
    let model = Model::new(&scenario(&text), &rows(HUB), &STEADY).expect("valid");
    let found = sweep(&model, &[300.0], 1, &|_| {}).expect("a speed");
    let sum = |phases| found.mean_square(0, &[1], phases, &Weight::one());
    let one = 0.5 * (2e-5_f64 / 54.0).powi(2);
    for (phases, factor) in [(Phases::Unknown, 2.0), (Phases::Worst, 4.0)] {
        assert!((sum(phases) / (factor * one) - 1.0).abs() < 1e-9, "{phases:?}");
    }
    // The imbalances oppose each other.
    assert!(sum(Phases::Given) < 1e-20 * one, "{:e}", sum(Phases::Given));
    let above = Metric::BandRms([200.0 / std::f64::consts::TAU, 1e9]);
    let above = Weight::of_metric(&above).expect("no index");
    let shares = found.shares(0, &[1], Phases::Unknown, &above);
    assert_eq!(shares.len(), 2);
    assert!(shares.iter().all(|share| (share / one - 1.0).abs() < 1e-9));
    let nowhere = Weight::of_metric(&Metric::BandRms([1e8, 1e9])).expect("no index");
    assert!(found.mean_square(0, &[1], Phases::Unknown, &nowhere) == 0.0);
}

#[test]
fn a_sweep_does_not_depend_on_the_number_of_threads() {
    let text = WHEEL.replace("RATE", "300");
    let model = Model::new(&scenario(&text), &rows(HUB), &STEADY).expect("valid");
    let speeds = speeds([10.0, 600.0], 40);
    assert_eq!((speeds.len(), speeds[0], speeds[39]), (40, 10.0, 600.0));
    let one = sweep(&model, &speeds, 1, &|_| {}).expect("above zero");
    let three = sweep(&model, &speeds, 3, &|_| {}).expect("above zero");
    assert_eq!(one.lines, three.lines);
    let zero = sweep(&model, &[0.0], 1, &|_| {}).expect_err("a speed of zero");
    assert!(zero.to_string().contains("rad/s"), "{zero}");
    assert!(sweep(&model, &[], 1, &|_| {}).is_err());
}

const GYRO: &str = r#"
[hub]
mass = "40 kg"
inertia = "8, 7, 6 kg m^2"
[[device]]
name = "cmg"
kind = "vscmg"
position = "10, -20, 30 cm"
mount = { gimbal_axis = [0, 1, 0], spin_axis = [1, 0, 0] }
imbalance = { static = "2 g cm", dynamic = "30 g cm^2" }
[device.gimbal]
mass = "1 kg"
inertia = "0.01, 0.02, 0.03 kg m^2"
stiffness = "30 N m/rad"
damping = "0.1 N m s/rad"
angle = "20 deg"
[device.wheel]
mass = "4 kg"
inertia = "0.02, 0.012, 0.013 kg m^2"
rate = "-400 rad/s"
"#;

#[test]
fn three_speeds_give_the_means_at_every_speed() {
    let scenario = scenario(GYRO);
    let place = nalgebra::Vector3::new(0.1, 0.0, 0.2);
    let device = SweptDevice::new(&scenario, &[0], &place, &STEADY).expect("valid");
    let joints = SteadyJoints::new(&scenario, &[0], Motor::ConstantTorque, true);
    for speed in [3.0, 123.0, 900.0] {
        let mut states = joints.states.clone();
        states[1][1] = -speed;
        let direct =
            AveragedDevices::new(&set_of(&scenario, &[0]), &place, &states, &joints.motors)
                .expect("valid");
        for (found, expected) in device.mean(speed).iter().zip(direct.mean()) {
            // Of the largest element at the speeds that the polynomial is of.
            let unit = expected.amax() * (1.0 + (800.0_f64 / speed).powi(2)) + 1.0;
            let error = (found - expected).amax();
            assert!(error < ROUNDING * unit, "{speed}: {error:e} of {unit:e}");
        }
    }
}

const SOFT: &str = r#"
[hub]
mass = "1e9 kg"
inertia = "1e9, 1e9, 1e9 kg m^2"
[[device]]
name = "rw"
kind = "flexible_reaction_wheel"
mount = { spin_axis = [1, 0, 0] }
imbalance = { static = "0.1 g cm", dynamic = "1 g cm^2" }
[device.axial_slide]
stiffness = "2e6 N/m"
[device.radial_slide_y]
stiffness = "8e6 N/m"
[device.radial_slide_z]
stiffness = "8e6 N/m"
[device.tilt_y]
stiffness = "3200 N m/rad"
[device.tilt_z]
stiffness = "3200 N m/rad"
[device.wheel]
mass = "4 kg"
inertia = "0.03, 0.02, 0.02 kg m^2"
rate = "300 rad/s"
"#;

/// `w = J_s Omega / 2 J_t +- sqrt((J_s Omega / 2 J_t)^2 + k / J_t)` on a hub that hardly moves.
#[test]
fn whirls_are_those_of_the_closed_form_and_orders_cross_them() {
    let model = Model::new(&scenario(SOFT), &rows(HUB), &STEADY).expect("valid");
    let speeds = speeds([50.0, 850.0], 41);
    let found: Result<Vec<_>, _> =
        speeds.iter().map(|speed| oscillations(&model, *speed)).collect();
    let found = found.expect("regular");
    for (speed, found) in speeds.iter().zip(&found) {
        let half = 0.5 * 1.5 * speed;
        let root = (half * half + 160_000.0).sqrt();
        let mut expected =
            [root - half, root + half, (5e5_f64).sqrt(), (2e6_f64).sqrt(), (2e6_f64).sqrt()];
        expected.sort_by(f64::total_cmp);
        assert_eq!(found.len(), 5, "{found:?}");
        for (found, expected) in found.iter().zip(expected) {
            // The hub is 1e9 kg.
            let error = (found.frequency / expected - 1.0).abs();
            assert!(error < 1e-7, "{speed}: {} for {expected}", found.frequency);
        }
    }
    let branches = branches(&speeds, &found);
    assert_eq!(branches.len(), 5, "each branch goes on through the others");
    let all = crossings(&speeds, &branches, &[1.0]);
    // Order 1 crosses the backward whirl at s^2 = k / (J_t + J_s); the forward one it never meets, because the
    // rotor is a disc; and the axial slide.
    let backward = all.iter().find(|crossing| crossing.whirl == Whirl::Backward).expect("it falls");
    let expected = (3200.0_f64 / 0.05).sqrt();
    assert!((backward.speed / expected - 1.0).abs() < 1e-3, "{backward:?}");
    let axial = all.iter().find(|crossing| crossing.whirl == Whirl::None).expect("it is flat");
    assert!((axial.speed / 5e5_f64.sqrt() - 1.0).abs() < 1e-6, "{axial:?}");
    assert!(all.iter().all(|crossing| crossing.whirl != Whirl::Forward), "{all:?}");
}

/// A grid of few speeds has the peaks of a fine one: speeds are added around every crossing.
#[test]
#[ignore = "long: `cargo xtask test --all`"]
fn a_coarse_grid_does_not_miss_a_resonance() {
    let path =
        Path::new(env!("CARGO_MANIFEST_DIR")).join("../scenarios/imaging-satellite-flexible.toml");
    let (scenario, _) =
        precess::file::from_file(&path, &[]).unwrap_or_else(|errors| panic!("{errors}"));
    let outputs = rows("camera");
    let model = Model::new(&scenario, &outputs, &STEADY).expect("valid");
    let range = [60.0, 690.0];
    let some = speeds(range, 61);
    let natural: Result<Vec<_>, _> = some.iter().map(|s| oscillations(&model, *s)).collect();
    let branches = branches(&some, &natural.expect("regular"));
    let crossings = crossings(&some, &branches, &[1.0]);
    let largest = |speeds: &[f64]| {
        let found = sweep(&model, speeds, 2, &|_| {}).expect("damped");
        let all = (0..speeds.len())
            .map(|k| found.mean_square(k, &[3, 4], Phases::Unknown, &Weight::one()));
        all.fold(0.0, f64::max).sqrt()
    };
    let fine = largest(&speeds(range, 20_000));
    let coarse = largest(&refined(speeds(range, 11), range, &crossings));
    assert!((coarse / fine - 1.0).abs() < 0.01, "{coarse:e} for {fine:e}");
    assert!(largest(&speeds(range, 11)) < 0.7 * fine, "the grid by itself misses it");
}
