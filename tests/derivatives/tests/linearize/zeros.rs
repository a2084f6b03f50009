//! What docs/performance-derivatives.md names zero by structure is exactly zero, and nothing else is
//! said to be.

use nalgebra::{DMatrix, Vector3};
use precess_dynamics::{BalancedReactionWheel, Dgvscmg, Gravity, Outputs, Quaternion, Variable};
use precess_tests::measured::{Measured, dgvscmg};

type Set = (Dgvscmg, BalancedReactionWheel);

/// The joint of the balanced wheel.
const WHEEL: usize = 3;
/// A step, s.
const DT: f64 = 0.05;

fn measured(gravity: Gravity<f64>) -> Measured<Set> {
    let wheel = BalancedReactionWheel::bare_wheel(4.0, 0.2, 0.1);
    let mut measured = Measured::new(&(dgvscmg::<f64>(), wheel));
    measured.state.attitude = Quaternion { q0: 0.8, q1: 0.2, q2: -0.4, q3: 0.4 };
    measured.inputs.gravity = gravity;
    measured
}

/// Whether an element of A is zero by structure, in no field or a uniform one.
fn zero_in_a(row: Variable, by: Variable) -> bool {
    use Variable::{Attitude, Coordinate, Omega, Position, Rate, Velocity};
    match (row, by) {
        (Position(axis), Velocity(other)) | (Attitude(axis), Omega(other)) => axis != other,
        (Attitude(axis), Attitude(other)) => axis == other,
        (Coordinate(joint), Rate(other)) => joint != other,
        (Position(_) | Coordinate(_) | Attitude(_), _)
        | (_, Position(_) | Velocity(_) | Coordinate(WHEEL))
        | (Omega(_) | Rate(_), Attitude(_)) => true,
        _ => false,
    }
}

/// Whether an element of A of a step is zero by structure, without gravity, of two variables that are
/// not the same.
fn zero_in_step(row: Variable, by: Variable) -> bool {
    use Variable::{Attitude, Coordinate, Omega, Position, Rate, Velocity};
    match (row, by) {
        (Position(axis), Velocity(other)) => axis != other,
        (_, Position(_) | Velocity(_) | Coordinate(WHEEL))
        | (Omega(_) | Coordinate(_) | Rate(_), Attitude(_)) => true,
        _ => false,
    }
}

/// Asserts the zeros; how many other elements there are, and how many of them are not zero.
fn others(
    of: &DMatrix<f64>,
    [rows, columns]: [&[Variable]; 2],
    zero: impl Fn(Variable, Variable) -> bool,
) -> [usize; 2] {
    let (mut filled, mut not_zero) = (0, 0);
    for (i, row) in rows.iter().enumerate() {
        for (k, by) in columns.iter().enumerate() {
            let element = of[(i, k)];
            if zero(*row, *by) {
                assert_eq!(element.to_bits() << 1, 0, "{row:?} by {by:?} is {element:e}");
            } else {
                filled += 1;
                not_zero += usize::from(element != 0.0);
            }
        }
    }
    [filled, not_zero]
}

#[test]
fn what_is_zero_by_structure_is_exactly_zero() {
    for gravity in [Gravity::None, Gravity::Uniform(Vector3::new(1.0, -3.0, 9.0))] {
        let Measured { craft, state, inputs } = measured(gravity);
        let found = craft.linearize(&state, &inputs, &Outputs::accelerations()).unwrap();
        let states = &found.states[..];
        let [filled, not_zero] = others(&found.a, [states, states], zero_in_a);
        // A few more are zero for this device, which has no offsets.
        assert!(10 * not_zero > 9 * filled, "{not_zero} of {filled}");
        let kinematic = |row, _| {
            matches!(row, Variable::Position(_) | Variable::Attitude(_) | Variable::Coordinate(_))
        };
        let [filled, not_zero] = others(&found.b, [states, &found.inputs], kinematic);
        assert!(10 * not_zero > 8 * filled, "{not_zero} of {filled}");
    }
}

#[test]
fn a_central_field_fills_columns() {
    let Measured { craft, state, inputs } = measured(Gravity::Central { mu: 4e4 });
    let found = craft.linearize(&state, &inputs, &Outputs::accelerations()).unwrap();
    let place = |variable| found.states.iter().position(|state| *state == variable).unwrap();
    let omega = place(Variable::Omega(precess_dynamics::Axis::X));
    for by in [Variable::Position, Variable::Attitude] {
        assert!(found.a[(omega, place(by(precess_dynamics::Axis::Y)))] != 0.0);
    }
}

#[test]
fn what_is_zero_by_structure_in_a_step_is_exactly_zero() {
    let Measured { craft, state, inputs } = measured(Gravity::None);
    let found = craft.linearize_step(&state, &inputs, DT).unwrap();
    let states = &found.states[..];
    let zero = |row, by| row != by && zero_in_step(row, by);
    let [filled, not_zero] = others(&found.a, [states, states], zero);
    assert!(10 * not_zero > 9 * filled, "{not_zero} of {filled}");
}
