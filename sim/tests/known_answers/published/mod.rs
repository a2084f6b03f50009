//! Scenarios against numbers that others published: cases of NASA's JEOD (JSC Engineering Orbital
//! Dynamics, github.com/nasa/jeod) and check cases of the NASA Engineering and Safety Center
//! (NASA/TM-2015-218675). Each scenario is a file as a user writes it. Each test prints its largest
//! difference, beside the bound; docs/testing.md has them in a table.
//!
//! JEOD's quaternions transform from the parent's axes to the frame's own and have the vector with
//! the sign opposite to that of Euler parameters; `T_parent_this` is the matrix from N to the frame.

mod brick;
mod frames;
mod gravity;
mod masses;
mod orbits;

use std::path::Path;

use nalgebra::{Matrix3, Vector3};
use precess::file::from_toml;
use precess::scenario::Scenario;

use super::ScenarioRun;

/// A scenario from the text of its file.
fn read(name: &str, text: &str) -> Scenario {
    let read = from_toml(name, text, Path::new(""));
    read.unwrap_or_else(|errors| panic!("{errors}")).0
}

/// From N to the frame of these Euler parameters.
fn dcm([q0, q1, q2, q3]: [f64; 4]) -> Matrix3<f64> {
    let vector = Vector3::new(q1, q2, q3);
    (q0 * q0 - vector.norm_squared()) * Matrix3::identity() + 2.0 * vector * vector.transpose()
        - 2.0 * q0 * vector.cross_matrix()
}

/// From a frame to axes that are turned about z, then y, then x.
fn turned(yaw: f64, pitch: f64, roll: f64) -> Matrix3<f64> {
    let about = |axis, angle: f64| {
        let (sin, cos) = (0.5 * angle).sin_cos();
        let vector = Vector3::ith(axis, sin);
        dcm([cos, vector.x, vector.y, vector.z])
    };
    about(0, roll) * about(1, pitch) * about(2, yaw)
}

/// The matrix whose rows are these.
fn rows(rows: [[f64; 3]; 3]) -> Matrix3<f64> {
    Matrix3::from_fn(|row, column| rows[row][column])
}

/// The largest magnitude of numbers; a NaN if one is.
fn largest<'a>(numbers: impl IntoIterator<Item = &'a f64>) -> f64 {
    let larger = |most: f64, number: &f64| {
        if number.is_nan() || number.abs() > most { number.abs() } else { most }
    };
    numbers.into_iter().fold(0.0, larger)
}

impl ScenarioRun {
    /// Runs a scenario from the text of its file.
    fn from_text(name: &str, text: &str) -> Self {
        Self::of(read(name, text))
    }

    /// The columns at a time of a sample.
    fn at<const N: usize>(&self, time: f64, names: [&str; N]) -> [f64; N] {
        let found = self.columns(names).find(|(own, _)| (own - time).abs() < 1e-9 * (1.0 + time));
        found.unwrap_or_else(|| panic!("no sample at {time} s")).1
    }
}

/// The functions that the comparisons stand on: a turn by a right angle about z takes y to x.
#[test]
fn matrices_turn_the_axes() {
    let half = 0.5_f64.sqrt();
    let quarter = rows([[0.0, 1.0, 0.0], [-1.0, 0.0, 0.0], [0.0, 0.0, 1.0]]);
    assert!((dcm([half, 0.0, 0.0, half]) - quarter).norm() < 1e-15);
    assert!((turned(std::f64::consts::FRAC_PI_2, 0.0, 0.0) - quarter).norm() < 1e-15);
    // Schaub and Junkins, equation 3.34: the first row of yaw, pitch, roll.
    let (yaw, pitch, roll) = (0.3_f64, -0.2_f64, 0.7_f64);
    let first = [pitch.cos() * yaw.cos(), pitch.cos() * yaw.sin(), -pitch.sin()];
    assert!(
        largest((turned(yaw, pitch, roll).row(0).transpose() - Vector3::from(first)).iter())
            < 1e-15
    );
}
