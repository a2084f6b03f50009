//! Swapped axes, swapped wheels and wrong units end with an error that names them.

use precess::file::identification_example as example;
use precess::identify::IdentifyError;
use precess::identify::recording::Recording;
use precess::scenario::Scenario;

use super::identified;
use super::recovered::unknowns;

/// The record of the example, each row through a function.
fn record(truth: &Scenario, change: impl Fn(&mut Vec<String>)) -> String {
    let recording = Recording { duration: 12.0, ..example::RECORDING };
    let text = recording.csv(truth).expect("telemetry");
    let mut lines = text.lines();
    let mut changed = lines.next().unwrap_or_default().to_owned() + "\n";
    for line in lines {
        let mut cells: Vec<String> = line.split(',').map(str::to_owned).collect();
        change(&mut cells);
        changed += &(cells.join(",") + "\n");
    }
    changed
}

fn error(change: impl Fn(&mut Vec<String>)) -> IdentifyError {
    let scenario = example::scenario().expect("a scenario");
    let text = record(&example::truth().expect("a scenario"), change);
    match identified(&scenario, &text, &unknowns(&scenario)) {
        Err(error) => error,
        Ok(_) => panic!("no error"),
    }
}

fn times(cell: &mut String, factor: f64) {
    *cell = (cell.parse::<f64>().expect("a number") * factor).to_string();
}

#[test]
fn swapped_axes_are_named() {
    let found = error(|cells| cells.swap(1, 2)).to_string();
    assert!(found.contains("x is the column y and y is the column x"), "{found}");
}

#[test]
fn an_axis_of_the_other_sense_is_named() {
    let found = error(|cells| times(&mut cells[3], -1.0)).to_string();
    assert!(found.contains("z is the column -z"), "{found}");
}

#[test]
fn rates_in_degrees_are_named() {
    let in_degrees = |cells: &mut Vec<String>| {
        cells[1..4].iter_mut().for_each(|cell| times(cell, 180.0 / std::f64::consts::PI));
    };
    let found = error(in_degrees).to_string();
    assert!(found.contains("its unit is deg/s"), "{found}");
}

#[test]
fn speeds_in_rpm_and_torques_in_millinewton_metres_are_named() {
    // Columns: time, gyro, then rate and motor of each wheel.
    let in_rpm = |cells: &mut Vec<String>| {
        times(&mut cells[4], 30.0 / std::f64::consts::PI);
    };
    let found = error(in_rpm);
    assert!(matches!(&found, IdentifyError::Unit { unit: "rpm", .. }), "{found}");
    let in_millis = |cells: &mut Vec<String>| times(&mut cells[5], 1e3);
    let found = error(in_millis);
    assert!(matches!(&found, IdentifyError::Unit { unit: "mN m", .. }), "{found}");
}

#[test]
fn swapped_wheels_are_named() {
    // Columns: time, gyro, then rate and motor of each wheel.
    let all_of_two = |cells: &mut Vec<String>| {
        cells.swap(4, 6);
        cells.swap(5, 7);
    };
    let found = error(all_of_two).to_string();
    assert!(found.contains("rw1 has the columns of rw2 and rw2 has the columns of rw1"), "{found}");
    let of_opposite = |cells: &mut Vec<String>| {
        cells.swap(6, 10);
        cells.swap(7, 11);
    };
    let found = error(of_opposite).to_string();
    assert!(found.contains("rw2 has the columns of rw4 and rw4 has the columns of rw2"), "{found}");
}

#[test]
fn swapped_rates_of_wheels_are_named() {
    let found = error(|cells| cells.swap(4, 8)).to_string();
    let both = "rw1.spin is the column rw3.spin and rw3.spin is the column rw1.spin";
    assert!(found.contains(both), "{found}");
}
