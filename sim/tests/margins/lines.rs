//! Lines of rotors through the loop, and their aliases, against runs.

use std::f64::consts::TAU;
use std::ops::ControlFlow;
use std::path::Path;

use nalgebra::{Complex, DMatrix, DVector};
use precess::engine::run;
use precess::file::{budget_from_toml, from_file};
use precess::jitter::prepared::Prepared;
use precess::jitter::sweep::sweep;
use precess::margins::analysis::chosen;
use precess::margins::closed_sweep::close;
use precess::margins::lines::ClosedLine;
use precess::record::Samples;
use precess::scenario::Scenario;

use super::{loop_of, read};

/// What a run and the linear loop may differ by off resonance, and at it.
const AGREEMENT: [f64; 2] = [0.01, 0.05];

/// A bus whose wheel about z is out of balance; the rate of that wheel.
fn bus(rate: &str, keys: &str) -> String {
    let wheel = "wheel = { mass = \"6 kg\", inertia = \"0.0191, 0.0114, 0.0114 kg m^2\"";
    let device = |name: &str, axis: &str, kind: &str, more: &str| {
        format!(
            "[[device]]\nname = \"{name}\"\nkind = \"{kind}\"\nmount = {{ spin_axis = {axis} }}\n{wheel}{more}\n"
        )
    };
    let out = format!(
        ", rate = \"{rate}\" }}\nimbalance = {{ static = \"1 g cm\", dynamic = \"40 g cm^2\" }}"
    );
    [
        "format = 1\n[hub]\nmass = \"100 kg\"\ninertia = \"12, 11, 10 kg m^2\"\n".to_owned(),
        device("rwx", "[1, 0, 0]", "balanced_reaction_wheel", " }"),
        device("rwy", "[0, 1, 0]", "balanced_reaction_wheel", " }"),
        device("rwz", "[0, 0, 1]", "reaction_wheel", &out),
        format!(
            "[[controller]]\nname = \"aocs\"\nrate = \"4 Hz\"\ndelay = \"50 ms\"\n{keys}\n\
             [controller.law]\nkind = \"eigen_axis\"\nfrequency = \"0.1 Hz\"\ndamping_ratio = 0.4\n\
             [controller.reference.attitude]\nquaternion = [1, 0, 0, 0]\nscalar = \"first\"\n"
        ),
    ]
    .concat()
}

/// Amplitudes of the rotation about each axis at some frequencies, Hz, fitted to the end of a run.
fn amplitudes(text: &str, frequencies: &[f64]) -> Vec<[Complex<f64>; 3]> {
    let run_keys = "[run]\nduration = \"180 s\"\nintegrator = \"dop853\"\ntolerance = 1e-11\n\
                    [output]\nrate = \"97 Hz\"\ncolumns = [\"q0\", \"q1\", \"q2\", \"q3\"]\n";
    let scenario = read(&format!("{text}{run_keys}"));
    let samples = ran(&scenario);
    let columns = ["q1", "q2", "q3"].map(|name| samples.column(name).expect(name));
    let count = 2 * frequencies.len() + 1;
    let (mut normal, mut right) = (DMatrix::zeros(count, count), DMatrix::zeros(count, 3));
    for (index, row) in samples.rows.iter().enumerate().filter(|(_, row)| row[0] > 90.0) {
        let time = row[0];
        let own: Vec<f64> = std::iter::once(1.0)
            .chain(frequencies.iter().flat_map(|f| {
                let (sine, cosine) = (TAU * f * time).sin_cos();
                [cosine, sine]
            }))
            .collect();
        let own = DVector::from_vec(own);
        normal += &own * own.transpose();
        let turns = columns.each_ref().map(|column| 2.0 * column[index]);
        right += &own * DVector::from_column_slice(&turns).transpose();
    }
    let found = normal.lu().solve(&right).expect("frequencies that differ");
    let of = |line: usize| {
        [0, 1, 2]
            .map(|axis| Complex::new(found[(1 + 2 * line, axis)], -found[(2 + 2 * line, axis)]))
    };
    (0..frequencies.len()).map(of).collect()
}

fn ran(scenario: &Scenario) -> Samples {
    let mut samples = Samples::default();
    run(scenario, &mut samples, &mut |_| ControlFlow::Continue(())).expect("a run");
    samples
}

fn line_of(text: &str) -> ClosedLine {
    let scenario = read(&format!("{text}[run]\nduration = \"1 s\"\n[output]\nrate = \"4 Hz\"\n"));
    let lines = loop_of(&scenario).lines().expect("lines");
    assert_eq!(lines.len(), 1, "one rotor is out of balance, at its own rate");
    lines[0].clone()
}

/// How much more the alias moves the hub than the line itself.
fn agree(rate: &str, keys: &str, bound: f64) -> f64 {
    let text = bus(rate, keys);
    let line = line_of(&text);
    let two: Vec<_> = line.components.iter().take(2).collect();
    assert!(line.is_aliased() && (two[1].frequency - line.alias).abs() < 1e-12);
    let frequencies: Vec<f64> = two.iter().map(|of| of.frequency).collect();
    let found = amplitudes(&text, &frequencies);
    for (of, found) in two.iter().zip(&found) {
        let size = |of: &[Complex<f64>; 3]| of.iter().map(Complex::norm_sqr).sum::<f64>().sqrt();
        let apart: Vec<Complex<f64>> = of.attitude.iter().zip(found).map(|(a, b)| a - b).collect();
        let apart = apart.iter().map(Complex::norm_sqr).sum::<f64>().sqrt() / size(&of.attitude);
        println!("{rate} {keys} at {} Hz: {:e} rad, {apart:e}", of.frequency, size(&of.attitude));
        assert!(
            apart < bound,
            "{rate} at {} Hz: {apart}\n{:?}\n{found:?}",
            of.frequency,
            of.attitude
        );
    }
    two[1].attitude[0].norm() / two[0].attitude[0].norm()
}

/// 20.3 Hz at 4 Hz is 0.3 Hz: above the bandwidth of the loop.
#[test]
fn an_alias_off_resonance_is_in_the_run() {
    assert!(agree("1218 rpm", "", AGREEMENT[0]) > 10.0);
}

/// 20.1 Hz is 0.1 Hz, where the loop resonates.
#[test]
fn an_alias_at_the_resonance_of_the_loop_is_in_the_run() {
    assert!(agree("1206 rpm", "", AGREEMENT[1]) > 10.0);
}

/// The servo computes torques of what the imbalance requires several times in a period.
#[test]
fn an_alias_through_a_servo_at_its_own_rate_is_in_the_run() {
    assert!(agree("1218 rpm", "servo = { rate = \"12 Hz\" }", AGREEMENT[0]) > 10.0);
}

/// An integrating gyro, a late star tracker, a filter of the rate and one of the torque, with momentum of the wheel that turns with what
/// is read.
#[test]
fn an_alias_through_sensors_and_filters_is_in_the_run() {
    let keys = "sensors = { gyro = { output = \"integrating\" }, star_tracker = { latency = \"0.2 s\" } }\n\
                [[controller.filter]]\nkind = \"low_pass\"\nfrequency = \"1.5 Hz\"\n\
                [[controller.filter]]\nsignal = \"torque\"\nkind = \"notch\"\nfrequency = \"1.2 Hz\"\npole_damping = 0.3";
    assert!(agree("1218 rpm", keys, AGREEMENT[0]) > 5.0);
}

/// The lines of the example's budget through the loop: those of `margins` at its speed, each with its alias.
#[test]
fn a_budget_with_the_loop_closed_has_the_aliases() {
    let path = Path::new(concat!(
        env!("CARGO_MANIFEST_DIR"),
        "/../scenarios/budgets/aliased-wheel-jitter.toml"
    ));
    let (budget, of) = budget_from_toml(path, &[]).expect("a budget");
    let (scenario, _) = from_file(&of, &[]).expect("a scenario");
    let prepared = Prepared::new(&scenario, &budget).expect("a model");
    let speeds = [1203.0 / 60.0 * TAU];
    let mut found = sweep(&prepared.model, &speeds, 1, &|_| {}).expect("lines");
    let open = found.lines[0].clone();
    let controller = chosen(&scenario, None).expect("a controller");
    let closed = close(&scenario, controller, &budget, &mut found, &|_| {}).expect("a loop");
    assert!(closed.unstable.is_empty());
    let count = open.len();
    assert_eq!((found.contributors.len(), found.lines[0].len()), (2 * count, 2 * count));
    let lines = loop_of(&scenario).lines().expect("lines");
    for (index, line) in lines.iter().enumerate() {
        let (own, alias) = (&found.lines[0][index], &found.lines[0][count + index]);
        assert_eq!(found.contributors[count + index].cause, "imbalance aliased");
        assert!((alias.frequency / TAU - 0.05).abs() < 1e-9, "{}", alias.frequency / TAU);
        for (line, component) in [own, alias].into_iter().zip(&line.components) {
            // Across the boresight, z: rotation about x and y.
            let across = component.attitude.iter().take(2).map(Complex::norm_sqr).sum::<f64>();
            let found = line.values.iter().map(Complex::norm_sqr).sum::<f64>();
            assert!((found / across - 1.0).abs() < 1e-6, "{found:e} {across:e}");
        }
        // The loop is too slow to answer the line itself.
        let size = |of: &[Complex<f64>]| of.iter().map(Complex::norm_sqr).sum::<f64>().sqrt();
        assert!((size(&own.values) / size(&open[index].values) - 1.0).abs() < 0.05);
        assert!(size(&alias.values) > 100.0 * size(&own.values));
    }
}
