//! The fit of what the coupled equations of motion exert on a fixed table: a rotor with static and dynamic
//! imbalance that slides and tilts on soft bearings, run to its steady state at each speed.

use std::f64::consts::TAU;
use std::fs;
use std::path::Path;

use nalgebra::Vector3;
use precess::fit::{Group, Measurement, Mode, ModeGuess, Options, Record, TablePose, fit};

use super::scene::{SEED, rpm};
use super::synthetic::Random;

/// Between critical speeds of 2387 and 3796 rpm.
const SPEEDS: [f64; 12] = [
    1000.0, 1400.0, 1800.0, 2150.0, 2300.0, 2500.0, 2800.0, 3300.0, 3600.0, 3950.0, 4300.0, 4800.0,
];
/// Samples from 2 s on: by then exp(-zeta w t) of the slowest mode is below 5e-5.
const FROM: usize = 4000;
const RATE: f64 = 2000.0;
/// Noise of the table, N and N m, 1e-4 of the loads.
const NOISE: [f64; 2] = [1e-3, 1e-4];
/// What linear bearings leave of an offset of 1 um: the acceptance holds by far.
const IMBALANCE: f64 = 2e-3;
const MODE: f64 = 2e-3;
const ANGLE: f64 = 5e-3;

const SCENARIO: &str = r#"
format = 1
[hub]
mass = "1 t"
inertia = "100, 100, 100 kg m^2"
mode = "fixed"
[[device]]
name = "rw"
kind = "flexible_reaction_wheel"
position = "0, 0, 25 cm"
mount = { spin_axis = [0, 0, 1] }
imbalance = { static = "0.3 g cm", dynamic = "2 g cm^2", phase = "40 deg" }
axial_slide = { stiffness = "4e5 N/m", damping = "50 N s/m" }
radial_slide_y = { stiffness = "2.5e5 N/m", damping = "40 N s/m" }
radial_slide_z = { stiffness = "2.5e5 N/m", damping = "40 N s/m" }
tilt_y = { stiffness = "1580 N m/rad", damping = "0.4 N m s/rad" }
tilt_z = { stiffness = "1580 N m/rad", damping = "0.4 N m s/rad" }
wheel = { mass = "4 kg", inertia = "0.020, 0.030, 0.030 kg m^2", acceleration = "0 rpm/s" }
[run]
duration = "3 s"
[output]
rate = "2 kHz"
columns = ["rw.mount.force", "rw.mount.moment"]
"#;

/// What the hub exerts on the device at each sample of a run: force and moment about the mount, in B.
fn loads(folder: &Path, speed: f64) -> [Vec<f64>; 6] {
    let file = folder.join("soft.toml");
    fs::write(&file, SCENARIO).expect("a file");
    let out = folder.join(format!("{speed}"));
    let done = std::process::Command::new(env!("CARGO_BIN_EXE_precess"))
        .args(["run", "--no-report", "--force", "--set"])
        .arg(format!("device.rw.wheel.rate={speed} rpm"))
        .arg(&file)
        .arg("--out")
        .arg(&out)
        .output()
        .expect("the command starts");
    assert!(done.status.success(), "{}", String::from_utf8_lossy(&done.stderr));
    let text = fs::read_to_string(out.join("soft.csv")).expect("a result");
    let mut lines = text.lines().filter(|line| !line.starts_with('#'));
    let heads: Vec<&str> = lines.next().expect("a heading").split(',').collect();
    let place = |kind: &str, axis: &str| {
        let name = format!("rw.mount.{kind}_{axis}");
        heads.iter().position(|head| head.starts_with(&name)).expect("a column")
    };
    let axes = ["x", "y", "z"];
    let places: Vec<usize> = axes
        .iter()
        .map(|axis| place("force", axis))
        .chain(axes.iter().map(|axis| place("moment", axis)))
        .collect();
    let mut channels: [Vec<f64>; 6] = Default::default();
    for line in lines.skip(FROM) {
        let cells: Vec<&str> = line.split(',').collect();
        for (channel, place) in channels.iter_mut().zip(&places) {
            channel.push(cells[*place].parse().expect("a number"));
        }
    }
    channels
}

#[test]
#[ignore = "long: `cargo xtask test --all --for sim/src/fit`"]
fn a_rotor_on_soft_bearings_is_found_by_its_loads() {
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join("fit-coupled");
    fs::create_dir_all(&folder).expect("a folder");
    // The moment is about the bearing centre, the mount's origin; the hub's load is on the wheel.
    let placement = TablePose::new(Vector3::zeros(), Vector3::z(), Vector3::x(), true);
    let placement = placement.expect("axes");
    let mut random = Random::new(SEED);
    let records = SPEEDS.map(|speed| {
        let mut channels = loads(&folder, speed);
        for (k, channel) in channels.iter_mut().enumerate() {
            for value in channel.iter_mut() {
                *value += NOISE[k / 3] * random.normal();
            }
        }
        Record {
            name: format!("{speed} rpm"),
            rate: RATE,
            speed: rpm(speed),
            drift: 0.0,
            pulses: Vec::new(),
            channels: placement.referred_samples(&channels),
        }
    });
    let measurement = Measurement { records: records.to_vec() };
    let guess = |group, frequency: f64, ratio: f64| ModeGuess {
        group,
        mode: Mode { frequency, damping: 0.02, inertia_ratio: ratio, share: 1.0 },
        // Where h = 1 is the only line, only w_0² / (1 - g) counts: the ratio is that of the inertias.
        fit_ratio: false,
        fit_share: false,
    };
    let options = Options {
        harmonics: vec![1.0],
        modes: Some(vec![
            guess(Group::RadialForce, 240.0, 0.0),
            guess(Group::RadialTorque, 240.0, 2.0 / 3.0),
        ]),
        ..Options::default()
    };
    let fitted = fit(&measurement, &options).expect("it fits");
    let imbalance = &fitted.imbalance;
    for (found, put_in) in [(imbalance.u_s, 3e-6), (imbalance.u_d, 2e-7)] {
        assert!((found.value / put_in - 1.0).abs() < IMBALANCE, "{found:?}");
    }
    let phase = imbalance.phase.expect("force and torque").value;
    assert!((phase - 40.0 * TAU / 360.0).abs() < ANGLE, "{phase}");
    // sqrt(k / m) and sqrt(k / I_r).
    let [radial, rocking] = fitted.modes.as_slice() else { panic!("{:?}", fitted.modes) };
    let rest = f64::sqrt(1580.0 / 0.03);
    assert!((radial.frequency.value / 250.0 - 1.0).abs() < MODE, "{radial:?}");
    assert!((rocking.frequency.value / rest - 1.0).abs() < MODE, "{rocking:?}");
    assert!((radial.damping.value / 0.02 - 1.0).abs() < 10.0 * MODE, "{radial:?}");
}
