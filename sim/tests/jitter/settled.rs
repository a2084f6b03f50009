//! A run that starts in the vibration of its rotors: no mean rate, no mean velocity.

use std::ops::ControlFlow;
use std::path::Path;

use nalgebra::{DMatrix, DVector, Vector3};
use precess::engine;
use precess::file::from_toml;
use precess::jitter::device::Steady;
use precess::jitter::mean_acceleration::MeanAcceleration;
use precess::jitter::model::{HUB, Model, Output};
use precess::record::Histories;
use precess::scenario::Scenario;
use precess::structure::dynamic_mass::Motor;

/// A cubesat with three wheels at other speeds each, off its centre of mass.
const CUBESAT: &str = r#"format = 1
[hub]
mass = "12 kg"
centre_of_mass = "1, -2, 3 mm"
inertia = "0.12, 0.11, 0.05 kg m^2"
[initial]
position = "3, 4, 5 m"
velocity = "0.1, 0.2, 0.3 m/s"
attitude = { axis = [1, 2, 3], angle = "70 deg" }
settled = true
WHEELS
[run]
duration = "4 s"
[output]
rate = "2 kHz"
columns = ["position", "velocity", "omega", "rotation"]
"#;

fn cubesat(rates: [f64; 3]) -> String {
    let wheel = |(k, rate): (usize, &f64)| {
        let axis = [[1, 0, 0], [0, 1, 0], [0, 0, 1]][k];
        format!(
            "[[device]]\nname = \"rw{k}\"\nkind = \"reaction_wheel\"\nposition = \"{k}, 2, -4 cm\"\n\
             mount = {{ spin_axis = {axis:?} }}\n\
             imbalance = {{ static = \"0.5 g mm\", dynamic = \"3 g mm^2\", phase = \"40 deg\" }}\n\
             wheel = {{ mass = \"0.18 kg\", inertia = \"6.8e-5, 3.8e-5, 3.8e-5 kg m^2\", rate = \"{rate} rpm\", \
             angle = \"{} deg\" }}\n",
            25 * (k + 1)
        )
    };
    CUBESAT.replace("WHEELS", &rates.iter().enumerate().map(wheel).collect::<String>())
}

fn read(text: &str) -> Scenario {
    let (scenario, _) = from_toml("cubesat", text, Path::new("")).unwrap_or_else(|e| panic!("{e}"));
    scenario
}

/// Mean slope of a column by least squares, and half of its range about that line.
fn line(time: &[f64], values: &[f64]) -> [f64; 3] {
    let count = f64::from(u32::try_from(time.len()).expect("a few thousand"));
    let mean = |of: &dyn Fn(usize) -> f64| (0..time.len()).map(of).sum::<f64>() / count;
    let (t, v) = (mean(&|k| time[k]), mean(&|k| values[k]));
    let slope = mean(&|k| (time[k] - t) * (values[k] - v)) / mean(&|k| (time[k] - t).powi(2));
    let rest = (0..time.len()).map(|k| values[k] - v - slope * (time[k] - t));
    [v, slope, rest.fold(0.0, |most: f64, rest| most.max(rest.abs()))]
}

fn columns(scenario: &Scenario) -> impl Fn(&str) -> Vec<f64> + use<> {
    let mut found = Histories::default();
    engine::run(scenario, &mut found, &mut |_| ControlFlow::Continue(())).expect("it runs");
    move |name: &str| {
        let header = found.header.as_ref().expect("a run");
        let index = header.columns.iter().position(|column| column.name == name);
        found.columns[index.expect("a column")].clone()
    }
}

#[test]
fn a_settled_start_has_no_mean_rate_and_the_velocity_of_the_file() {
    for rates in [[3000.0, 3000.0, 3000.0], [-700.0, 2100.0, 5900.0]] {
        let settled = columns(&read(&cubesat(rates)));
        let at_rest = columns(&read(&cubesat(rates).replace("settled = true\n", "")));
        let time = settled("time");
        for axis in ["x", "y", "z"] {
            let rotation = format!("rotation_{axis}");
            // The mean rate is the slope of the angle.
            let [_, mean, vibration] = line(&time, &settled(&rotation));
            let rate =
                vibration * rates.iter().fold(0.0_f64, |most, rate| most.max(rate.abs())) / 9.55;
            assert!(mean.abs() < 1e-3 * rate, "{rates:?} {axis}: {mean:e} of {rate:e}");
            let [_, without, _] = line(&time, &at_rest(&rotation));
            assert!(without.abs() > 0.05 * rate, "{rates:?} {axis}: at rest {without:e}");
        }
        for (axis, wanted) in [("x", 0.1), ("y", 0.2), ("z", 0.3)] {
            let [_, velocity, vibration] = line(&time, &settled(&format!("position_{axis}")));
            let rate = vibration * 5900.0 / 9.55;
            assert!(
                (velocity - wanted).abs() < 1e-3 * rate,
                "{rates:?} {axis}: {velocity} {rate:e}"
            );
        }
    }
}

/// What is written out is the state itself, without the key.
#[test]
fn the_record_of_a_settled_run_has_its_start() {
    let scenario = read(&cubesat([3000.0, 2000.0, 1000.0]));
    let again = read(&scenario.source.filled);
    assert_eq!(again.initial.omega, scenario.initial.omega);
    assert_eq!(again.initial.r_b_n_dot, scenario.initial.r_b_n_dot);
    assert!(scenario.initial.omega.norm() > 0.0);
    assert_eq!(again.reference, scenario.reference);
    assert_ne!(scenario.reference, scenario.initial.attitude);
}

/// `run` and `jitter` agree on the RMS of the hub's rotation about each axis.
#[test]
fn a_settled_run_has_the_rms_of_its_lines() {
    let scenario = read(&cubesat([-700.0, 2100.0, 5900.0]));
    let output = |axis: usize| {
        let mut row = [0.0; 6];
        row[3 + axis] = 1.0;
        Output { name: format!("hub {axis}"), terms: vec![(HUB.to_owned(), row)] }
    };
    let steady = Steady { motor: Motor::ConstantTorque, sprung: true, swept: None };
    let model = Model::new(&scenario, &[0, 1, 2].map(output), &steady).expect("valid");
    let lines = model.lines(0.0).expect("no resonance");
    let found = columns(&scenario);
    for (axis, name) in ["rotation_x", "rotation_y", "rotation_z"].into_iter().enumerate() {
        let predicted =
            lines.iter().map(|line| 0.5 * line.values[axis].norm_sqr()).sum::<f64>().sqrt();
        let values = found(name);
        let count = f64::from(u32::try_from(values.len()).expect("a few thousand"));
        // It is from the mean attitude, so nothing is to be taken off.
        let rms = (values.iter().map(|v| v * v).sum::<f64>() / count).sqrt();
        assert!((rms / predicted - 1.0).abs() < 0.01, "{name}: {rms:e} {predicted:e}");
    }
}

/// Speeds and angles of a settled scenario are those of its file.
#[test]
fn the_lines_of_a_settled_scenario_are_those_of_its_file() {
    let text = cubesat([3000.0; 3]);
    let lines = |text: &str| {
        let mut row = [0.0; 6];
        row[3] = 1.0;
        let output = Output { name: "hub".to_owned(), terms: vec![(HUB.to_owned(), row)] };
        let steady = Steady { motor: Motor::ConstantTorque, sprung: true, swept: None };
        let model = Model::new(&read(text), &[output], &steady).expect("valid");
        model.lines(0.0).expect("no resonance")
    };
    let settled = lines(&text);
    assert_eq!(settled, lines(&text.replace("settled = true\n", "")));
    assert!(settled.iter().all(|line| line.frequency.to_bits() == settled[0].frequency.to_bits()));
}

/// The constant of the acceleration of a column, in the basis of a cubic and the vibration, by least squares.
fn acceleration(time: &[f64], values: &[f64], frequency: f64) -> f64 {
    let duration = time.last().copied().expect("samples");
    let row = |t: f64| {
        let x = t / duration;
        let vibration = [1.0, 2.0].map(|k| (k * frequency * t).sin_cos());
        let [(s1, c1), (s2, c2)] = vibration;
        [1.0, x, x * x, x.powi(3), x.powi(4), s1, c1, s2, c2, x * s1, x * c1]
    };
    let rows: Vec<f64> = time.iter().flat_map(|t| row(*t)).collect();
    let basis = DMatrix::from_row_slice(time.len(), 11, &rows);
    let normal = basis.transpose() * &basis;
    let right = basis.transpose() * DVector::from_column_slice(values);
    let found = normal.lu().solve(&right).expect("independent");
    2.0 * found[2] / (duration * duration)
}

/// In the second order wheels of one speed, and a damped panel, take power from wheels; other speeds exchange none.
#[test]
fn the_hub_of_a_settled_run_accelerates_by_the_power_that_its_rotors_exchange() {
    let panel = "[[device]]\nname = \"p\"\nkind = \"hinged_panel\"\nposition = \"0, 0, 20 cm\"\n[device.panel]\n\
                 mass = \"0.1 kg\"\ncentre_of_mass = \"0, 10, 0 cm\"\ninertia = \"1e-4, 1e-4, 1e-4 kg m^2\"\n\
                 stiffness = \"108 N m/rad\"\ndamping = \"35 mN m s/rad\"\n";
    let alike = cubesat([3000.0; 3]);
    let damped = cubesat([3000.0, 0.0, 0.0]).replace("[run]", &format!("{panel}[run]"));
    for (name, text) in [("alike", &alike), ("damped", &damped)] {
        let scenario = read(&text.replace("4 s", "1 s"));
        let found = columns(&scenario);
        let time = found("time");
        let of = |stem: &str| {
            let one = |axis: &str| {
                acceleration(&time, &found(&format!("{stem}_{axis}")), 100.0 * std::f64::consts::PI)
            };
            Vector3::new(one("x"), one("y"), one("z"))
        };
        let MeanAcceleration { angular, linear, .. } =
            MeanAcceleration::new(&scenario).expect("valid").expect("a free hub");
        let ran = of("rotation");
        // B is off the centre of mass, about which the hub turns.
        assert!(linear.norm() < 0.01 * angular.norm(), "{name}: {linear:?}");
        assert!(angular.norm() > 1e-12);
        assert!((ran - angular).norm() < 0.01 * angular.norm(), "{name}: {ran:?} {angular:?}");
    }
    let apart = read(&cubesat([-700.0, 2100.0, 5900.0]));
    let of = |scenario: &Scenario| MeanAcceleration::new(scenario).expect("valid").expect("free");
    let ratio = of(&apart).angular.norm() / of(&read(&alike)).angular.norm();
    assert!(ratio < 1e-9, "{ratio:e}");
}

#[test]
fn a_panel_on_a_spring_vibrates_along() {
    let panel = "[[device]]\nname = \"p\"\nkind = \"hinged_panel\"\nposition = \"0, 0, 20 cm\"\n[device.panel]\n\
                 mass = \"1e-3 kg\"\ncentre_of_mass = \"0, 10, 0 cm\"\ninertia = \"1e-6, 1e-6, 1e-6 kg m^2\"\n\
                 stiffness = \"1 mN m/rad\"\n";
    let text = cubesat([3000.0, 2000.0, 1000.0]).replace("[run]", &format!("{panel}[run]"));
    let scenario = read(&text);
    let panel = precess_dynamics::JointStates::states(&scenario.initial.devices).last();
    assert!(panel.is_some_and(|[angle, rate]: [f64; 2]| angle != 0.0 && rate != 0.0), "{panel:?}");
}

#[test]
fn a_start_that_drifts_is_named_where_a_requirement_counts_it() {
    let limit = "[[requirement]]\nname = \"pointing\"\nquantity = \"rotation\"\nstatistic = \"peak\"\n\
                 limit = \"2 arcsec\"\n";
    let folder = std::env::temp_dir().join(format!("precess-settled-{}", std::process::id()));
    std::fs::create_dir_all(&folder).expect("a folder");
    let shown = |text: &str| {
        let file = folder.join("cubesat.toml");
        std::fs::write(&file, text).expect("it is written");
        let mut command = std::process::Command::new(env!("CARGO_BIN_EXE_precess"));
        let found = command.arg("check").arg(&file).output().expect("it starts");
        format!(
            "{}{}",
            String::from_utf8_lossy(&found.stdout),
            String::from_utf8_lossy(&found.stderr)
        )
    };
    let text = cubesat([3000.0; 3]).replace("velocity = \"0.1, 0.2, 0.3 m/s\"\n", "");
    let at_rest = text.replace("settled = true\n", "");
    let drift = "the hub starts at rest while its rotors are out of balance";
    assert!(shown(&format!("{at_rest}{limit}")).contains(drift));
    assert!(!shown(&format!("{text}{limit}")).contains(drift));
    let band = limit.replace("\"peak\"", "\"band_rms\"\nband = \"10, 90 Hz\"");
    assert!(!shown(&format!("{at_rest}{band}")).contains(drift));
    std::fs::remove_dir_all(folder).expect("it was made");
}
