//! Rate and acceleration of every reference against differences of its attitude and rate.

use nalgebra::Vector3;
use precess_control::rotation::{from_vector, inverse, product, to_vector};
use precess_control::{
    AttitudeRow, AttitudeTable, ControlError, Guidance, Hold, Slew, TurnLimits, Turning,
};
use precess_dynamics::{Attitude as _, Quaternion};

/// Step of the differences, s, and what they have of error: its square times third derivatives about one.
const H: f64 = 1e-4;
const DIFFERENCES: f64 = 1e-7;

/// Between the times at which the acceleration jumps.
fn check(guidance: &dyn Guidance, times: &[f64]) {
    for time in times {
        let (before, now, after) =
            (guidance.at(time - H), guidance.at(*time), guidance.at(time + H));
        assert!((now.attitude.norm() - 1.0).abs() < 1e-14);
        let turn = to_vector(&product(&inverse(&before.attitude), &after.attitude)) / (2.0 * H);
        // The vector is of the axes of the start, the rate of those in the middle, which turn alike to first order.
        assert!((turn - now.omega).amax() < DIFFERENCES, "{time}: {turn} {}", now.omega);
        let slope = (after.omega - before.omega) / (2.0 * H);
        assert!((slope - now.omega_dot).amax() < DIFFERENCES, "{time}: {slope} {}", now.omega_dot);
    }
}

fn turn(x: f64, y: f64, z: f64) -> Quaternion {
    from_vector(&Vector3::new(x, y, z))
}

/// Times at which no segment of what is tested ends.
const TIMES: [f64; 9] = [-1.7, 0.31, 1.13, 2.17, 3.07, 4.41, 6.23, 7.9, 12.3];

#[test]
fn a_frame_at_rest_and_one_that_turns() {
    check(&Hold::new(turn(0.1, 0.4, -1.0)).unwrap(), &TIMES);
    let omega = Vector3::new(0.3, -0.5, 0.2);
    let turning = Turning::new(2.0, turn(0.1, 0.4, -1.0), omega).unwrap();
    check(&turning, &TIMES);
    assert_eq!(turning.at(2.0).attitude, turn(0.1, 0.4, -1.0).normalised());
}

/// In a circular orbit the frame that `Turning` documents keeps z to the centre.
#[test]
fn nadir_turns_against_y() {
    const RATE: f64 = 1.1e-3;
    // At time zero x of N is the flight direction, z of N points to the centre; the orbit's normal is -y.
    let nadir = Turning::new(0.0, Quaternion::identity(), Vector3::new(0.0, -RATE, 0.0)).unwrap();
    for time in [0.0, 500.0, 4000.0] {
        let (sin, cos) = libm::sincos(RATE * time);
        let to_centre = Vector3::new(-sin, 0.0, cos);
        let seen = nadir.at(time).attitude.dcm() * to_centre;
        assert!((seen - Vector3::z()).amax() < 1e-14, "{seen}");
    }
}

#[test]
fn a_slew() {
    let limits = TurnLimits { rate: 0.5, acceleration: 0.4, jerk: 0.3 };
    let slew = Slew::new(0.5, turn(0.2, 0.1, -0.4), turn(-1.0, 0.7, 0.9), &limits).unwrap();
    assert!(slew.end() < 12.0);
    check(&slew, &TIMES);
    let off = product(&inverse(&slew.at(slew.end()).attitude), &turn(-1.0, 0.7, 0.9));
    assert!(to_vector(&off).norm() < 1e-15);
}

/// A motion with known rates, given at rows.
fn rows(spacing: f64) -> Vec<AttitudeRow> {
    let motion = |t: f64| {
        let first = Vector3::new(0.0, 0.0, 0.4 * t);
        let second = Vector3::new(0.3 * libm::sin(0.7 * t), 0.0, 0.0);
        let attitude = product(&from_vector(&first), &from_vector(&second));
        let second_rate = Vector3::new(0.3 * 0.7 * libm::cos(0.7 * t), 0.0, 0.0);
        let omega = from_vector(&second).dcm() * Vector3::new(0.0, 0.0, 0.4) + second_rate;
        AttitudeRow { time: t, attitude, omega }
    };
    (0..1000).map(|k| f64::from(k) * spacing).take_while(|t| *t <= 10.0).map(motion).collect()
}

#[test]
fn a_table_has_its_rows_and_is_smooth_between() {
    for spacing in [0.4, 1.0, 2.5] {
        let rows = rows(spacing);
        let table = AttitudeTable::new(&rows).unwrap();
        check(&table, &TIMES);
        for row in &rows {
            for side in [-1e-13, 0.0, 1e-13] {
                let found = table.at(row.time + side);
                let off = to_vector(&product(&inverse(&found.attitude), &row.attitude));
                assert!(off.norm() < 1e-12 && (found.omega - row.omega).amax() < 1e-12);
            }
        }
    }
    // An error of attitude that falls with the fourth power of the spacing.
    let error = |spacing: f64| {
        let table = AttitudeTable::new(&rows(spacing)).unwrap();
        let exact = rows(0.05);
        let errors = exact.iter().map(|row| {
            to_vector(&product(&inverse(&table.at(row.time).attitude), &row.attitude)).norm()
        });
        errors.fold(0.0, f64::max)
    };
    let ratio = error(1.0) / error(0.5);
    assert!((13.0..19.0).contains(&ratio), "{ratio}");
}

/// Turns between rows up to nearly half a turn, of either form of the coefficients.
#[test]
fn a_table_of_two_rows_far_apart() {
    for angle in [1e-9, 1e-3, 0.09, 0.11, 0.9, 1.1, 3.0] {
        let row = |time, attitude, omega| AttitudeRow { time, attitude, omega };
        let first = row(0.0, turn(0.5, 0.5, 0.5), Vector3::new(0.1, -0.2, 0.3));
        let relative = Vector3::new(0.48, 0.6, 0.64) * angle;
        let end = product(&first.attitude, &from_vector(&relative));
        let second = row(10.0, end, Vector3::new(-0.2, 0.1, 0.15));
        let table = AttitudeTable::new(&[first, second]).unwrap();
        check(&table, &TIMES);
        let last = table.at(10.0 - 1e-12);
        assert!((last.omega - second.omega).amax() < 1e-11, "{angle}: {}", last.omega);
    }
}

#[test]
fn tables_that_are_none_are_rejected() {
    let rows = rows(1.0);
    assert_eq!(AttitudeTable::new(&[]), Err(ControlError::NoRows));
    let mut late = rows.clone();
    late[4].time = 3.0;
    assert_eq!(AttitudeTable::new(&late), Err(ControlError::NotIncreasing { row: 4, time: 3.0 }));
    let mut fast = rows.clone();
    fast[3].omega *= 20.0;
    assert_eq!(AttitudeTable::new(&fast), Err(ControlError::TooCoarse { row: 3 }));
    let mut none = rows;
    none[2].attitude = Quaternion { q0: 0.0, q1: 0.0, q2: 0.0, q3: 0.0 };
    let error = AttitudeTable::new(&none).unwrap_err();
    assert_eq!(error.to_string(), "attitude is no attitude: its length is zero or not finite");
}
