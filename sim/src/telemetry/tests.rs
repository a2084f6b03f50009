//! Tests of [`Telemetry`](super::Telemetry): rates, gaps, and each kind of bad data by its name.

use std::fs;
use std::path::{Path, PathBuf};

use super::{
    Reason, Sensor, SensorColumns, Telemetry, TelemetryFault, TelemetryLayout, TelemetryRows,
};

fn folder() -> tempfile::TempDir {
    tempfile::tempdir().expect("a folder")
}

/// A gyro at 10 Hz with noise, a star tracker, the tachometer and motor of a joint.
fn layout() -> TelemetryLayout {
    let sensor = |sensor, columns: &[&str], period, noisy| SensorColumns {
        sensor,
        name: format!("{sensor:?}"),
        columns: columns.iter().map(|&name| name.to_owned()).collect(),
        size: 1.0,
        period,
        noisy,
        range: None,
    };
    let star = ["q0", "q1", "q2", "q3"];
    TelemetryLayout {
        time: "time".to_owned(),
        time_size: 1.0,
        sensors: vec![
            sensor(Sensor::Gyro, &["x", "y", "z"], Some(0.1), true),
            sensor(Sensor::StarTracker, &star, Some(0.2), true),
            sensor(Sensor::Tachometer(0), &["spin"], None, false),
            sensor(Sensor::Motor(0), &["u"], None, false),
        ],
    }
}

fn written(folder: &Path, text: &str) -> PathBuf {
    let path = folder.join("telemetry.csv");
    fs::write(&path, text).expect("a file");
    path
}

fn read(text: &str) -> Result<Telemetry, TelemetryFault> {
    let folder = folder();
    Telemetry::read(&written(folder.path(), text), &layout()).map_err(|error| error.fault)
}

/// A number that differs from row to row.
fn noise(row: u32, axis: u32) -> f64 {
    f64::from((row * 7 + axis * 3) % 31) * 1e-3 + f64::from(row) * 1e-5
}

/// Gyro rows at 10 Hz, each through a function.
fn gyro(rows: u32, change: impl Fn(u32, &mut f64, &mut [f64; 3])) -> String {
    let mut text = String::from("time,x,y,z\n");
    for row in 0..rows {
        let mut time = f64::from(row) * 0.1;
        let mut value = [noise(row, 0), noise(row, 1), noise(row, 2)];
        change(row, &mut time, &mut value);
        text += &[time.to_string(), value.map(|of| of.to_string()).join(",")].join(",");
        text.push('\n');
    }
    text
}

fn count(of: &Telemetry, reason: Reason) -> u64 {
    of.exclusions.iter().filter(|of| of.reason == reason).map(|of| of.count).sum()
}

#[test]
fn sensors_have_their_own_rates() {
    let text = "time,x,y,z,q0,q1,q2,q3,spin,u\n\
                0,1,2,3,1,0,0,0,100,0.1\n\
                0.1,1.1,2.1,3.1,,,,,,0.2\n\
                0.15,,,,,,,,101,\n\
                0.2,1.2,2.2,3.2,0.999999,0.001414,0,0.00001,,\n";
    let found = read(text);
    // The star tracker reads zero twice along y: with noise that is stuck.
    let found = found.expect("telemetry");
    assert_eq!(found.of(Sensor::Gyro).expect("a gyro").times, [0.0, 0.1, 0.2]);
    assert_eq!(found.of(Sensor::Tachometer(0)).expect("a tachometer").times, [0.0, 0.15]);
    assert_eq!(found.of(Sensor::Motor(0)).expect("a motor").values[1][0], 0.2);
    assert_eq!(count(&found, Reason::Stuck), 2);
    assert!(found.of(Sensor::StarTracker).is_none());
}

#[test]
fn gaps_are_named() {
    let found = read(&gyro(50, |row, time, _| {
        if row >= 20 {
            *time += 1.0;
        }
    }));
    let gaps = found.expect("telemetry").of(Sensor::Gyro).expect("a gyro").gaps();
    assert_eq!(gaps.len(), 1);
    assert!((gaps[0][0] - 1.9).abs() < 1e-9 && (gaps[0][1] - 3.0).abs() < 1e-9, "{gaps:?}");
}

#[test]
fn repeated_times_are_left_out_and_falling_ones_are_an_error() {
    let found = read(&gyro(20, |row, time, _| {
        if row == 7 {
            *time = 0.6;
        }
    }));
    assert_eq!(count(&found.expect("telemetry"), Reason::RepeatedTime), 1);
    let falls = read(&gyro(20, |row, time, _| {
        if row == 7 {
            *time = 0.1;
        }
    }));
    assert!(matches!(falls, Err(TelemetryFault::Falls { row: 8, .. })), "{falls:?}");
}

#[test]
fn saturated_readings_are_left_out() {
    let clipped = |row: u32, _: &mut f64, value: &mut [f64; 3]| {
        if (10..15).contains(&row) {
            value[1] = 0.5;
        }
    };
    let found = read(&gyro(30, clipped)).expect("telemetry");
    assert_eq!(count(&found, Reason::Stuck), 5);
    assert_eq!(found.of(Sensor::Gyro).expect("a gyro").times.len(), 25);
    // With a stated range each of them, one alone, too.
    let folder = folder();
    let path = written(folder.path(), &gyro(30, clipped));
    let mut layout = layout();
    layout.sensor_mut(Sensor::Gyro).expect("a gyro").range = Some(0.5);
    let found = Telemetry::read(&path, &layout).expect("telemetry");
    assert_eq!(count(&found, Reason::Saturated), 5);
}

#[test]
fn numbers_that_are_not_finite_and_missing_components_are_left_out() {
    let found = read("time,x,y,z\n0,1,2,3\n0.1,NaN,2.1,3.1\n0.2,1.2,,3.2\n0.3,1.3,2.3,inf\n");
    let found = found.expect("telemetry");
    assert_eq!(count(&found, Reason::NotFinite), 2);
    assert_eq!(count(&found, Reason::Incomplete), 1);
    assert_eq!(found.of(Sensor::Gyro).expect("a gyro").times, [0.0]);
}

#[test]
fn times_in_milliseconds_and_readings_too_fast_are_errors() {
    let slow = read(&gyro(20, |_, time, _| *time *= 1e3));
    assert!(matches!(slow, Err(TelemetryFault::TimeUnit { unit: "ms", .. })), "{slow:?}");
    let fast = read(&gyro(20, |_, time, _| *time *= 0.1));
    assert!(matches!(fast, Err(TelemetryFault::TooFast { .. })), "{fast:?}");
}

#[test]
fn held_values_between_samples_are_left_out() {
    let held = |row: u32, time: &mut f64, value: &mut [f64; 3]| {
        *time = f64::from(row) * 0.025;
        *value = [0, 1, 2].map(|axis| noise(row / 4, axis));
    };
    let found = read(&gyro(40, held)).expect("telemetry");
    assert_eq!(count(&found, Reason::Held), 30);
    assert_eq!(found.of(Sensor::Gyro).expect("a gyro").times.len(), 10);
}

#[test]
fn a_sensor_without_all_of_its_columns_is_an_error() {
    let partial = read("time,x,y\n0,1,2\n");
    assert!(
        matches!(&partial, Err(TelemetryFault::Partial { missing, .. }) if missing == "z"),
        "{partial:?}"
    );
    let none = read("time,a\n0,1\n");
    assert!(matches!(none, Err(TelemetryFault::NoSensor { .. })), "{none:?}");
    let text = read("time,x,y,z\n0,1,2,high\n");
    assert!(matches!(text, Err(TelemetryFault::Table(_))), "{text:?}");
}

#[test]
fn readings_come_one_by_one_in_the_order_of_time() {
    let folder = folder();
    let path = written(folder.path(), &gyro(100, |_, _, _| {}));
    let mut rows = TelemetryRows::open(&path, &layout()).expect("telemetry");
    let mut last = -1.0;
    let mut count = 0;
    while let Some(reading) = rows.next_reading().expect("a row") {
        assert!(reading.time > last);
        last = reading.time;
        count += 1;
    }
    assert_eq!(count, 100);
}

#[test]
fn npz_is_read_with_empty_cells() {
    use crate::structure::npz::{archived, numbers};
    let folder = folder();
    let path = folder.path().join("telemetry.npz");
    let column = |values: &[f64]| numbers(values, &[values.len()]);
    let (time, nan) = (column(&[0.0, 0.1, 0.2]), f64::NAN);
    let members = [
        ("time", time),
        ("x", column(&[1.0, 1.1, 1.2])),
        ("y", column(&[2.0, 2.1, 2.2])),
        ("z", column(&[3.0, 3.1, 3.2])),
        ("spin", column(&[100.0, nan, 101.0])),
    ];
    fs::write(&path, archived(&members).expect("bytes")).expect("a file");
    let found = Telemetry::read(&path, &layout()).expect("telemetry");
    assert_eq!(found.of(Sensor::Gyro).expect("a gyro").times.len(), 3);
    assert_eq!(found.of(Sensor::Tachometer(0)).expect("a tachometer").times, [0.0, 0.2]);
}
