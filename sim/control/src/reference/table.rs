//! [`AttitudeTable`]: attitude and rate at some times, and a smooth motion through them.
//!
//! From row to row the frame turns by `exp(phi(t))` after the row's attitude. `phi` is the cubic polynomial that is zero
//! at the first of them and the rotation vector between them at the second, with the derivatives there that the rates of
//! both require, `omega = J(phi) phi'` with the right Jacobian J. Attitude and rate are thus continuous and those of the
//! table; the acceleration jumps at rows.

use alloc::vec::Vec;

use core::f64::consts::PI;

use nalgebra::Vector3;
use precess_dynamics::Quaternion;

use crate::model::error::{self, ControlError};
use crate::model::jacobian::{coefficients, inverse_jacobian};
use crate::model::motion::Reference;
use crate::model::rotation::{from_vector, inverse, product, to_vector};
use crate::reference::Guidance;
use crate::reference::turning::Turning;

/// A row of a table.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct AttitudeRow {
    /// Time, s.
    pub time: f64,
    /// Attitude of R relative to N.
    pub attitude: Quaternion,
    /// Angular velocity of R relative to N, expressed in R, rad/s.
    pub omega: Vector3<f64>,
}

/// What there is between a row and the next.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Interval {
    start: AttitudeRow,
    length: f64,
    /// `phi = t (first + t (second + t third))`, t from the row.
    first: Vector3<f64>,
    second: Vector3<f64>,
    third: Vector3<f64>,
}

/// The table. Before its first row and after its last the frame turns at that row's rate.
#[derive(Clone, Debug, PartialEq)]
pub struct AttitudeTable {
    before: (f64, Turning),
    intervals: Vec<Interval>,
    after: (f64, Turning),
}

impl AttitudeTable {
    /// Of rows, one at least, whose times increase. Between two rows the frame turns by less than half a turn.
    ///
    /// # Errors
    ///
    /// No rows, a number that is not finite, a time that is not above the one before, a quaternion that is not an
    /// attitude, or rows between which the frame turns by more: the mean of their rates differs from what is between
    /// them by more than half a turn.
    pub fn new(rows: &[AttitudeRow]) -> Result<Self, ControlError> {
        let (Some(first), Some(last)) = (rows.first(), rows.last()) else {
            return Err(ControlError::NoRows);
        };
        let outside = |row: &AttitudeRow| {
            Turning::new(row.time, row.attitude, row.omega).map(|turning| (row.time, turning))
        };
        let (before, after) = (outside(first)?, outside(last)?);
        let mut intervals = Vec::with_capacity(rows.len());
        for (number, (row, next)) in (1..).zip(rows.iter().zip(rows.iter().skip(1))) {
            intervals.push(Interval::new(row, next, number)?);
        }
        Ok(Self { before, intervals, after })
    }
}

impl Interval {
    fn new(row: &AttitudeRow, next: &AttitudeRow, number: usize) -> Result<Self, ControlError> {
        let length = next.time - row.time;
        let sound = length > 0.0 && length.is_finite();
        if !sound {
            return Err(ControlError::NotIncreasing { row: number, time: next.time });
        }
        for value in row.omega.iter().chain(next.omega.iter()) {
            error::finite("rate", *value)?;
        }
        let from = error::attitude("attitude", &row.attitude)?;
        let to = error::attitude("attitude", &next.attitude)?;
        let turn = to_vector(&product(&inverse(&from), &to));
        if (turn - (row.omega + next.omega) * (0.5 * length)).norm() > PI {
            return Err(ControlError::TooCoarse { row: number });
        }
        let (slope, slope_next) = (row.omega, inverse_jacobian(&turn, &next.omega));
        // Hermite's cubic.
        let second = (turn * (3.0 / length) - slope * 2.0 - slope_next) / length;
        let third = (slope + slope_next - turn * (2.0 / length)) / (length * length);
        let start = AttitudeRow { attitude: from, ..*row };
        Ok(Self { start, length, first: slope, second, third })
    }

    fn at(&self, time: f64) -> Reference {
        let t = time - self.start.time;
        let phi = (self.first + (self.second + self.third * t) * t) * t;
        let phi_dot = self.first + (self.second * 2.0 + self.third * (3.0 * t)) * t;
        let phi_ddot = self.second * 2.0 + self.third * (6.0 * t);
        let (omega, omega_dot) = rates(&phi, &phi_dot, &phi_ddot);
        Reference { attitude: product(&self.start.attitude, &from_vector(&phi)), omega, omega_dot }
    }
}

impl Guidance for AttitudeTable {
    fn at(&self, time: f64) -> Reference {
        if time < self.before.0 {
            return self.before.1.at(time);
        }
        let count = self.intervals.partition_point(|interval| interval.start.time <= time);
        match count.checked_sub(1).and_then(|last| self.intervals.get(last)) {
            Some(interval) if time < self.after.0.min(interval.start.time + interval.length) => {
                interval.at(time)
            }
            _ => self.after.1.at(time),
        }
    }
}

/// `omega` and `omega'` of `exp(phi)`.
fn rates(
    phi: &Vector3<f64>,
    phi_dot: &Vector3<f64>,
    phi_ddot: &Vector3<f64>,
) -> (Vector3<f64>, Vector3<f64>) {
    let [(a, a_slope), (b, b_slope)] = coefficients(phi.norm_squared());
    let (once, along) = (phi.cross(phi_dot), phi.dot(phi_dot));
    let twice = phi.cross(&once);
    let omega = phi_dot - once * a + twice * b;
    let (once_next, turned) = (phi.cross(phi_ddot), phi_dot.cross(&once));
    let omega_dot = phi_ddot - once_next * a + (turned + phi.cross(&once_next)) * b
        - once * (a_slope * along)
        + twice * (b_slope * along);
    (omega, omega_dot)
}
