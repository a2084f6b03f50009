//! Telemetry that is watched: imbalance of each wheel from the body rates of a run, drag, alarms with their sizes, none without a change, gaps.

mod gimbals;

use std::ops::ControlFlow;
use std::path::Path;

use precess::engine::run;
use precess::file::from_toml;
use precess::record::{Header, Outcome, RecordError, Recorder};
use precess::scenario::Scenario;
use precess::telemetry::{Reading, Sensor, SensorColumns};
use precess::watch::{Alarm, Block, Watch, WatchSettings, Watched};
use precess_control::Noise;

/// Two imbalanced wheels with motors on a hub, at speeds of their own.
const BUS: &str = r#"format = 1
[hub]
mass = "100 kg"
inertia = "12, 11, 10 kg m^2"
[[device]]
name = "rw1"
kind = "reaction_wheel"
mount = { spin_axis = [0.6, 0, 0.8] }
position = "20, 5, 0 cm"
imbalance = { static = "1 g cm", dynamic = "10 g cm^2", phase = "40 deg" }
wheel = { mass = "2 kg", inertia = "0.02, 0.012, 0.012 kg m^2", rate = "900 rpm", torque = "2 mN m" }
[[device]]
name = "rw2"
kind = "reaction_wheel"
mount = { spin_axis = [0, 1, 0] }
position = "0, -20, 10 cm"
imbalance = { static = "2 g cm", dynamic = "30 g cm^2" }
wheel = { mass = "2 kg", inertia = "0.02, 0.012, 0.012 kg m^2", rate = "1500 rpm", torque = "-1 mN m" }
[run]
duration = "12 s"
integrator = "rk4"
step = "2.5 ms"
[output]
rate = "100 Hz"
columns = ["omega", "rw1.spin", "rw2.spin", "rw1.u_w", "rw2.u_w"]
"#;

fn scenario(text: &str) -> Scenario {
    from_toml("bus", text, Path::new("")).expect("accepted").0
}

/// Rows of a run: time, and the columns of the scenario.
#[derive(Default)]
struct Rows(Vec<Vec<f64>>);

impl Recorder for Rows {
    fn begin(&mut self, _: &Header) -> Result<(), RecordError> {
        Ok(())
    }

    fn sample(&mut self, row: &[f64]) -> Result<(), RecordError> {
        self.0.push(row.to_vec());
        Ok(())
    }

    fn finish(&mut self, _: &Outcome) -> Result<(), RecordError> {
        Ok(())
    }
}

fn rows(of: &Scenario) -> Vec<Vec<f64>> {
    let mut rows = Rows::default();
    run(of, &mut rows, &mut |_| ControlFlow::Continue(())).expect("a run");
    rows.0
}

/// The sensors of the rows.
fn sensors() -> Vec<SensorColumns> {
    let all = [
        Sensor::Gyro,
        Sensor::Tachometer(0),
        Sensor::Tachometer(1),
        Sensor::Motor(0),
        Sensor::Motor(1),
    ];
    let columns = |sensor| SensorColumns {
        sensor,
        name: String::new(),
        columns: Vec::new(),
        size: 1.0,
        period: None,
        noisy: false,
        range: None,
    };
    all.map(columns).to_vec()
}

/// Feeds rows, with noise of the gyro of this deviation, rad/s, and of the tachometers, rad/s.
fn watched(
    of: &Scenario,
    rows: &[Vec<f64>],
    settings: &WatchSettings,
    [gyro, tachometer]: [f64; 2],
) -> (Vec<String>, Vec<Block>) {
    let sensors = sensors();
    let mut watch = Watch::new(of, &sensors, settings).expect("watched");
    assert_eq!(watch.remarks(), &[] as &[String]);
    let noise = Noise::new(1, "watch");
    let reading = |k, row: &[f64], index: usize| {
        let [a, b, c, d, e, ..] = noise.at(k);
        // time, omega, spins, motors: columns of a run are in the order of the devices.
        let [time, x, y, z, spin1, u1, spin2, u2] = row[..] else { panic!("{row:?}") };
        let value = match sensors[index].sensor {
            Sensor::Gyro => [x + gyro * a, y + gyro * b, z + gyro * c, 0.0],
            Sensor::Tachometer(0) => [spin1 + tachometer * d, 0.0, 0.0, 0.0],
            Sensor::Tachometer(_) => [spin2 + tachometer * e, 0.0, 0.0, 0.0],
            Sensor::Motor(0) => [u1, 0.0, 0.0, 0.0],
            _ => [u2, 0.0, 0.0, 0.0],
        };
        Reading { index, time, value }
    };
    let count = sensors.len();
    let all = (0..).zip(rows);
    let mut readings = all.flat_map(|(k, row)| (0..count).map(move |index| (k, row, index)));
    let mut blocks = Vec::new();
    let mut next = || Ok(readings.next().map(|(k, row, index)| reading(k, row, index)));
    while let Some(block) = watch.next_block(&mut next).expect("solved") {
        blocks.push(block);
    }
    let names = watch.quantities().map(|(name, _)| name.to_owned()).collect();
    (names, blocks)
}

const SETTINGS: WatchSettings = WatchSettings { block: 2.0, learn: 10.0, false_alarms: 1.0 };

fn value(names: &[String], block: &Block, name: &str) -> [f64; 2] {
    let index = names.iter().position(|of| of == name).expect("a quantity");
    block.values[index].unwrap_or_else(|| panic!("{name} is not determined"))
}

/// From body rates without noise every block has the imbalance of the scenario, to what a rate that changes and angles from a tachometer
/// at 100 Hz leave: 1e-4 where rates between readings are held.
#[test]
fn the_imbalance_of_each_wheel_is_that_of_the_run() {
    let scenario = scenario(BUS);
    let (names, blocks) = watched(&scenario, &rows(&scenario), &SETTINGS, [0.0; 2]);
    assert_eq!(blocks.len(), 6);
    for block in &blocks {
        for (name, expected) in [
            ("static imbalance of rw1", 1e-5),
            ("dynamic imbalance of rw1", 1e-6),
            ("static imbalance of rw2", 2e-5),
            ("dynamic imbalance of rw2", 3e-6),
        ] {
            let [found, variance] = value(&names, block, name);
            println!(
                "{name}: {:e} of {expected:e}, deviation {:e}",
                found / expected - 1.0,
                variance.sqrt()
            );
            assert!((found / expected - 1.0).abs() < 3e-5, "{name}: {found:e}");
        }
        for name in ["drag torque of rw1", "drag torque of rw2"] {
            let [found, _] = value(&names, block, name);
            assert!(found.abs() < 2e-6, "{name}: {found:e}");
        }
    }
}

/// With noise, errors are within what the stated variances allow.
#[test]
fn variances_are_those_of_the_noise() {
    let scenario = scenario(BUS);
    let rows = rows(&scenario);
    let settings = WatchSettings { block: 1.0, ..SETTINGS };
    let (names, blocks) = watched(&scenario, &rows, &settings, [2e-5, 0.02]);
    let mut squares = 0.0;
    let mut count = 0.0;
    for block in &blocks {
        for (name, expected) in [
            ("static imbalance of rw2", 2e-5),
            ("dynamic imbalance of rw2", 3e-6),
            ("drag torque of rw1", 0.0),
            ("drag torque of rw2", 0.0),
        ] {
            let [found, variance] = value(&names, block, name);
            squares += (found - expected).powi(2) / variance;
            count += 1.0;
        }
    }
    let mean = squares / count;
    println!("{count} normalised squares, mean {mean}");
    // Chi-square with 48 degrees of freedom, by 48: from 0.46 to 1.79 in 9999 of 10,000.
    assert!(count == 48.0 && (0.46..1.79).contains(&mean), "{mean}");
}

/// A drag that grows in the middle of a record is found, dated and sized; nothing else is, and nothing before.
#[test]
fn a_drag_that_grows_is_found_with_its_size() {
    let text = BUS.replace("12 s", "40 s").replace(
        "[run]",
        "[[at]]\ntime = \"24 s\"\njoint = \"rw1.wheel\"\ntorque = \"1.5 mN m\"\n[run]",
    );
    let truth = scenario(&text);
    let mut rows = rows(&truth);
    // The telemetry says what is commanded: 2 mN m all the time.
    for row in &mut rows {
        row[5] = 2e-3;
    }
    let model = scenario(BUS);
    let settings = WatchSettings { block: 1.0, learn: 15.0, false_alarms: 1.0 };
    let (_, blocks) = watched(&model, &rows, &settings, [2e-5, 0.01]);
    let alarms: Vec<&Alarm> = blocks.iter().flat_map(|block| &block.alarms).collect();
    let [alarm] = alarms[..] else { panic!("{alarms:?}") };
    println!("{alarm:?}");
    assert_eq!(alarm.watched, Watched::Drag);
    assert_eq!(alarm.name, "drag torque of rw1");
    assert!((23.0..=25.0).contains(&alarm.shift.onset), "{alarm:?}");
    assert!(alarm.time <= 29.0, "{alarm:?}");
    assert!((alarm.shift.change - 5e-4).abs() < 2.0 * alarm.shift.half_width, "{alarm:?}");
    assert!(!alarm.alike.is_empty());
}

/// The blocks across a gap are left out, and the watch goes on after it.
#[test]
fn a_gap_leaves_out_its_block_only() {
    let scenario = scenario(BUS);
    let mut rows = rows(&scenario);
    rows.retain(|row| !(5.0..5.5).contains(&row[0]));
    let (_, blocks) = watched(&scenario, &rows, &SETTINGS, [0.0; 2]);
    let starts: Vec<f64> = blocks.iter().map(|block| block.times[0]).collect();
    assert_eq!(starts.len(), 5, "{starts:?}");
    assert!(
        blocks.iter().all(|block| block.times[1] <= 5.0 || block.times[0] >= 5.5),
        "{starts:?}"
    );
}
