//! What a controller reads: sensors, filters, estimator; and the torque by which it dumps momentum.

use std::thread;

use precess::engine::{Advance, Run};
use precess::file::to_toml;
use precess::record::Samples;
use precess_control::{AnalogSection, Discretisation, Filter};

use super::{BUS, column, controller, ran, read};

/// Samples per second of controller and result, Hz.
const RATE: f64 = 4.0;
const TURNED: &str = "[initial]\nangular_velocity = \"0.02, -0.01, 0.05 rad/s\"\n[initial.attitude]\naxis = [1, 2, 3]\nangle = \"40 deg\"\n";

fn text(keys: &str, duration: &str) -> String {
    let run = format!(
        "[run]\nduration = \"{duration}\"\nintegrator = \"rk4\"\nstep = \"50 ms\"\n[output]\nrate = \"4 Hz\"\n"
    );
    format!("{BUS}{TURNED}{}{keys}\n{run}", controller("", ""))
}

fn samples(keys: &str, duration: &str) -> Samples {
    let (outcome, samples) = ran(&read(&text(keys, duration)));
    assert!(outcome.end.is_complete(), "{}", outcome.end);
    samples
}

fn vector(samples: &Samples, name: &str) -> Vec<[f64; 3]> {
    let [x, y, z] = ["x", "y", "z"].map(|axis| column(samples, &format!("{name}_{axis}")));
    x.iter().zip(&y).zip(&z).map(|((x, y), z)| [*x, *y, *z]).collect()
}

/// All but the last, at the end of the run, where no controller samples.
fn sampled<T>(of: &[T]) -> &[T] {
    of.get(..of.len() - 1).expect("a sample")
}

#[test]
fn sensors_without_errors_change_no_bit() {
    let plain = samples("", "10 s");
    let read = samples("[controller.sensors]\ngyro = {}\nstar_tracker = {}", "10 s");
    for name in ["q0", "q1", "q2", "q3", "omega_x", "omega_z", "rwx.spin", "aocs.torque_y"] {
        let bits = |of: &Samples| column(of, name).iter().map(|x| x.to_bits()).collect::<Vec<_>>();
        assert_eq!(bits(&plain), bits(&read), "{name}");
    }
    let omega = vector(&read, "omega");
    assert_eq!(sampled(&vector(&read, "aocs.gyro")), sampled(&omega));
    assert!(vector(&read, "aocs.measurement_error").iter().flatten().all(|e| e.abs() < 1e-15));
}

/// A gyro of a bus that turns about one axis: what it integrates is the angle.
#[test]
fn an_integrating_gyro_reads_the_turn_since_the_sample_before() {
    let keys = "[controller.sensors.gyro]\noutput = \"integrating\"\nbias = \"0, 0, 3e-3 rad/s\"";
    let text = text(keys, "10 s").replace("\"0.02, -0.01, 0.05 rad/s\"", "\"0, 0, 0.05 rad/s\"");
    let text = text.replace("axis = [1, 2, 3]", "axis = [0, 0, 1]");
    let (_, of) = ran(&read(&text));
    let [q0, q3, gyro, omega] =
        ["q0", "q3", "aocs.gyro_z", "omega_z"].map(|name| column(&of, name));
    let angle: Vec<_> = q0.iter().zip(&q3).map(|(q0, q3)| 2.0 * q3.atan2(*q0)).collect();
    assert!((gyro[0] - 3e-3 - omega[0]).abs() < 1e-15, "the first one is the rate");
    for k in 1..gyro.len() - 1 {
        let mean = (angle[k] - angle[k - 1]) * RATE + 3e-3;
        assert!((gyro[k] - mean).abs() < 1e-13, "{k}: {} {mean}", gyro[k]);
        assert!((gyro[k] - 3e-3 - omega[k]).abs() > 1e-9, "{k}: not the rate");
    }
}

#[test]
fn a_star_tracker_has_its_rate_and_its_latency() {
    // Measurements at 0 s, 1 s, .. arrive 0.3 s later: at the second sample after.
    let keys = "[controller.sensors.star_tracker]\nrate = \"1 Hz\"\nlatency = \"0.3 s\"";
    let of = samples(keys, "10 s");
    for q in ["q0", "q1", "q2", "q3"] {
        let [truth, read] = [q.to_owned(), format!("aocs.measured_{q}")].map(|n| column(&of, &n));
        for (k, read) in sampled(&read).iter().enumerate() {
            let measured = k.saturating_sub(2) / 4 * 4;
            assert_eq!(*read, truth[measured], "{q} at sample {k}");
        }
    }
}

#[test]
fn readings_have_the_quantum() {
    const STEP: f64 = 1e-3;
    let keys =
        "[controller.sensors]\ntachometer_quantum = \"0.5 rad/s\"\ngyro.quantum = \"1 mrad/s\"";
    let of = samples(keys, "10 s");
    let read = vector(&of, "aocs.gyro");
    for (read, truth) in sampled(&read).iter().flatten().zip(vector(&of, "omega").iter().flatten())
    {
        assert!((read - truth).abs() <= 0.5 * STEP * (1.0 + 1e-9), "{read} {truth}");
        assert!((read / STEP - (read / STEP).round()).abs() < 1e-9, "{read}");
    }
    // The momentum that the law compensates is that of the rates as they are read.
    let plain = samples("[controller.sensors]\ngyro.quantum = \"1 mrad/s\"", "10 s");
    assert_ne!(column(&plain, "aocs.torque_x"), column(&of, "aocs.torque_x"));
}

/// The rate that the law reads is that of the filters by themselves, to the bit; of the torque likewise.
#[test]
fn filters_are_those_of_the_library() {
    use std::f64::consts::{FRAC_1_SQRT_2, TAU};
    let keys = "[[controller.filter]]\nkind = \"low_pass\"\nfrequency = \"1.5 Hz\"\n\
                [[controller.filter]]\nkind = \"notch\"\nfrequency = \"0.7 Hz\"\nzero_damping = 0.05\npole_damping = 0.6\n\
                [[controller.filter]]\nkind = \"lead_lag\"\nzero = \"0.3 Hz\"\npole = \"0.6 Hz\"\n\
                [[controller.filter]]\nkind = \"first_order_low_pass\"\nfrequency = \"1 Hz\"";
    let of = samples(keys, "10 s");
    let made = |analog: Result<AnalogSection, _>, by| {
        analog.and_then(|of: AnalogSection| of.discrete(1.0 / RATE, by)).expect("a section")
    };
    let at = |hertz: f64| Discretisation::Prewarped(TAU * hertz);
    let sections = vec![
        made(AnalogSection::low_pass(TAU * 1.5, FRAC_1_SQRT_2), at(1.5)),
        made(AnalogSection::notch(TAU * 0.7, 0.05, 0.6), at(0.7)),
        made(AnalogSection::lead_lag(TAU * 0.3, TAU * 0.6), Discretisation::Bilinear),
        made(AnalogSection::low_pass_of_first_order(TAU), at(1.0)),
    ];
    for axis in ["x", "y", "z"] {
        let mut filter = Filter::new(sections.clone());
        let truth = column(&of, &format!("omega_{axis}"));
        let read = column(&of, &format!("aocs.measured_omega_{axis}"));
        for (k, (truth, read)) in truth.iter().zip(sampled(&read)).enumerate() {
            let wanted = if k == 0 { filter.settle(*truth) } else { filter.filter(*truth) };
            assert_eq!(wanted.to_bits(), read.to_bits(), "{axis} {k}");
        }
    }
    let torque =
        "[[controller.filter]]\nsignal = \"torque\"\nkind = \"low_pass\"\nfrequency = \"1 Hz\"";
    let (plain, filtered) = (samples("", "10 s"), samples(torque, "10 s"));
    let [plain, filtered] = [&plain, &filtered].map(|of| column(of, "aocs.torque_z"));
    // The first one as if it had always been there.
    assert!((plain[0] - filtered[0]).abs() < 1e-14 && (plain[4] - filtered[4]).abs() > 1e-6);
}

const NOISY: &str = "[controller.sensors]\nseed = SEED\n\
    gyro = { angle_random_walk = \"2e-5 rad/sqrt(s)\", rate_random_walk = \"1e-6 rad/s/sqrt(s)\", bias = \"2, -1, 3 mrad/s\" }\n\
    star_tracker = { noise = \"1e-4 rad\", rate = \"1 Hz\", latency = \"0.3 s\" }\n";
const ESTIMATOR: &str =
    "[controller.estimator]\nattitude_deviation = \"1 mrad\"\nbias_deviation = \"3 mrad/s\"\n";

fn noisy(seed: u32) -> String {
    NOISY.replace("SEED", &seed.to_string())
}

#[test]
fn what_a_seed_draws_has_its_size_and_is_the_same_on_any_thread() {
    let of = samples(&noisy(1), "500 s");
    let (read, truth) = (vector(&of, "aocs.gyro"), vector(&of, "omega"));
    let bias = vector(&of, "aocs.gyro_bias");
    let mut sum = 0.0;
    for ((read, truth), bias) in sampled(&read).iter().zip(&truth).zip(&bias) {
        for k in 0..3 {
            sum += (read[k] - truth[k] - bias[k]).powi(2);
        }
    }
    #[expect(clippy::cast_precision_loss, reason = "a few thousand")]
    let count = (3 * (read.len() - 1)) as f64;
    // s_v² / T; of 6000 numbers the variance is within a few times sqrt(2 / 6000).
    let ratio = sum / count / (2e-5 * 2e-5 * RATE);
    assert!((ratio - 1.0).abs() < 4.0 * (2.0 / count).sqrt(), "{ratio}");
    let end = |seed| {
        let scenario = read_noisy(seed);
        let mut run = Run::new(&scenario).expect("a run");
        while let Advance::Stepped = run.advance().expect("a step") {}
        run.state().omega.map(f64::to_bits)
    };
    let first = end(1);
    assert_ne!(first, end(2), "another seed");
    let threads: Vec<_> = (0..3).map(|_| thread::spawn(move || end(1))).collect();
    for thread in threads {
        assert_eq!(thread.join().expect("a thread"), first);
    }
}

fn read_noisy(seed: u32) -> precess::scenario::Scenario {
    read(&text(&format!("{}{ESTIMATOR}", noisy(seed)), "10 s"))
}

/// The square of the attitude's error in units of its deviations has the mean 3, and of a hundred runs, each at its end, is
/// within the 95 % band of chi-square with 300 degrees of freedom: 253.9 to 349.9, over 100.
#[test]
fn the_estimator_in_the_loop_is_consistent() {
    let mut sum = 0.0;
    let mut worst: f64 = 0.0;
    for seed in 1..=100 {
        // Of a sampled gyro the mean rate would differ from what it reads by more than its noise.
        let sensors = noisy(seed).replace("gyro = {", "gyro = { output = \"integrating\",");
        let text = text(&format!("{sensors}{ESTIMATOR}"), "30 s").replace(
            "bias = \"2, -1, 3 mrad/s\"",
            // Of one deviation, in all directions.
            &format!(
                "bias = \"{} mrad/s\"",
                ["3, 3, -3", "-3, 3, 3", "3, -3, 3", "-3, -3, -3"][seed as usize % 4]
            ),
        );
        let (_, of) = ran(&read(&text));
        let (error, deviation) =
            (vector(&of, "aocs.measurement_error"), vector(&of, "aocs.attitude_deviation"));
        let (error, deviation) = (error[error.len() - 1], deviation[deviation.len() - 1]);
        sum += (0..3).map(|k| (error[k] / deviation[k]).powi(2)).sum::<f64>();
        let (bias, estimated) = (vector(&of, "aocs.gyro_bias"), vector(&of, "aocs.estimated_bias"));
        let last = bias.len() - 1;
        worst = (0..3).map(|k| (bias[last][k] - estimated[last][k]).abs()).fold(worst, f64::max);
    }
    let mean = sum / 100.0;
    println!("mean square {mean}, largest error of the bias {worst:e} rad/s");
    assert!((2.539..3.499).contains(&mean), "{mean}");
    assert!(worst < 1e-4, "of 3e-3 rad/s at first: {worst:e}");
}

/// Wheels that start with momentum: an external torque takes it, the law has the devices exert the opposite.
#[test]
fn an_external_torque_takes_the_momentum_of_the_wheels() {
    let spinning = BUS.replace(
        "mount = { spin_axis = [0, 0, 1] }\nwheel = { ",
        "mount = { spin_axis = [0, 0, 1] }\nwheel = { rate = \"100 rad/s\", ",
    );
    let keys = "[controller.dumping]\ngain = \"0.08 1/s\"\nmomentum = \"0, 0, 0.4 N m s\"\ntorque_limit = \"0.1 N m\"";
    let text = text(keys, "60 s").replace(BUS, &spinning);
    let text = text.replace("\"0.02, -0.01, 0.05 rad/s\"", "\"0, 0, 0 rad/s\"");
    // It starts at the reference.
    let text =
        text.replace("axis = [1, 2, 3]\nangle = \"40 deg\"", "axis = [1, 2, 3]\nangle = \"0 deg\"");
    let (outcome, of) = ran(&read(&text));
    let [spin, torque, error] =
        ["rwz.spin", "aocs.external_torque_z", "aocs.error_angle"].map(|name| column(&of, name));
    // 2 N m s above 0.4: at the limit until 1.25 are left, then by 1 - k T a sample.
    let mut momentum = 0.02 * spin[0];
    for k in 0..spin.len() - 1 {
        let wanted = (0.08 * (0.4 - momentum)).clamp(-0.1, 0.1);
        assert!((torque[k] - wanted).abs() < 1e-9, "{k}: {} {wanted}", torque[k]);
        assert!((0.02 * spin[k] - momentum).abs() < 1e-8, "{k}: {} {momentum}", spin[k]);
        momentum += wanted / RATE;
    }
    assert!((momentum - 0.4).abs() < 0.03, "{momentum}");
    assert!(error.iter().all(|angle| *angle < 1e-9), "the hub stays: {error:?}");
    // Its work is in the ledger.
    assert!(outcome.drift.energy.expect("a ledger") < 1e-12, "{:?}", outcome.drift);
}

#[test]
fn written_and_read_again_it_is_the_same() {
    let keys = format!(
        "{}{ESTIMATOR}[controller.dumping]\ngain = \"0.1 1/s\"\n\
         [[controller.filter]]\nsignal = \"torque\"\nkind = \"low_pass\"\nfrequency = \"1 Hz\"\n\
         [[controller.filter]]\nkind = \"notch\"\nfrequency = \"1 Hz\"\npole_damping = 0.7",
        noisy(3)
    );
    let scenario = read(&text(&keys, "1 s"));
    let written = to_toml(&scenario);
    let again = read(&written);
    assert_eq!(again.controllers, scenario.controllers, "{written}");
    assert_eq!(to_toml(&again), written);
    let gyro = scenario.controllers[0].sensors.gyro.expect("a gyro");
    // Units of a random walk: 0.3 deg/sqrt(h) is 0.3 / 60 deg/sqrt(s).
    let other = text(&keys.replace("2e-5 rad/sqrt(s)", "0.3 deg/sqrt(h)"), "1 s");
    let other = read(&other).controllers[0].sensors.gyro.expect("a gyro");
    assert_eq!(gyro.angle_random_walk, 2e-5);
    assert!((other.angle_random_walk - (0.3_f64 / 60.0).to_radians()).abs() < 1e-18);
}

/// A gyro on a node of a structure reads the node, in the node's axes.
#[test]
fn a_gyro_on_a_node_reads_the_node() {
    let structure = "[structure]\ncontains_devices = false\n[[structure.point]]\nname = \"tip\"\n\
        [[structure.node]]\nname = \"tip\"\nposition = \"1, 0, 0 m\"\n\
        [[structure.node]]\nname = \"base\"\nposition = \"0, 0, 0 m\"\n\
        [[structure.mode]]\nfrequency = \"1 Hz\"\ndamping = 0.01\nangular_momentum = [0, -1.1, 0]\n\
        shape = [{ node = \"tip\", translation = [0, 0, 0.5], rotation = [0, -0.6, 0] }]\n";
    let bus = BUS.replace(
        "kind = \"balanced_reaction_wheel\"",
        "kind = \"balanced_reaction_wheel\"\nnode = \"base\"",
    );
    let keys = "[controller.sensors]\ngyro.node = \"tip\"";
    let text = text(keys, "5 s").replace(BUS, &format!("{bus}{structure}"));
    let scenario = read(&text);
    assert_eq!(read(&to_toml(&scenario)).controllers, scenario.controllers);
    let (_, of) = ran(&scenario);
    let (read, rate) = (vector(&of, "aocs.gyro"), vector(&of, "tip.omega"));
    let turn = vector(&of, "tip.rotation");
    let mut moved: f64 = 0.0;
    for ((read, [x, y, z]), [a, b, c]) in sampled(&read).iter().zip(&rate).zip(&turn) {
        // Of a small rotation: omega - turn x omega, to its square.
        let first = [x - (b * z - c * y), y - (c * x - a * z), z - (a * y - b * x)];
        for (read, wanted) in read.iter().zip(first) {
            assert!((read - wanted).abs() < 1e-5, "{read} {wanted}");
        }
        moved = moved.max(b.abs());
    }
    assert!(moved > 1e-4, "the node turns: {moved}");
    let omega = vector(&of, "omega");
    assert!(read.iter().zip(&omega).any(|(read, omega)| (read[1] - omega[1]).abs() > 1e-4));
}
