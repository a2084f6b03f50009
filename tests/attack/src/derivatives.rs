//! Derivatives: results or the solver's own errors, and those of differences of the accelerations.

use precess_dynamics::{
    About, Axis, DerivativeError, Each, JointStates, LoadAxes, Outputs, SolveError, Variable,
};

use super::case::{Case, List, PreparedCase};
use super::residual::numbers;
use super::{Checked, Verdict};

/// Everything is differentiated.
const OUTPUTS: Outputs =
    Outputs { momentum: Some(About::InertialOrigin), loads: Some(LoadAxes::Body) };

/// The step of the differences, of the variable's size: the error of what is extrapolated once is of its fourth
/// power.
const STEP: f64 = 1e-3;

/// Largest difference of a derivative, of the largest one of its block by the variable.
const APART: f64 = 1e-6;

/// What rounding of badly conditioned accelerations may be, of the largest one of their block.
const ROUNDING: f64 = 1e-9;

/// `derivatives-or-error`: the linearised system is finite and has the accelerations of the solver, bit by bit; or
/// the error is that of the solver, or says which derivative is not finite.
///
/// # Errors
/// Where it does not hold.
pub fn derivatives_or_error(case: &Case) -> Verdict {
    let Ok(PreparedCase { craft, state, inputs }) = case.list() else {
        return Ok(Checked::Rejected);
    };
    let expected = craft.accelerations(&state, &inputs);
    let text = |error: &SolveError| error.to_string();
    match (craft.linearize(&state, &inputs, &OUTPUTS), expected) {
        (Ok(system), Ok(expected)) => {
            let bits = |of| numbers(of).into_iter().map(f64::to_bits).collect::<Vec<_>>();
            if bits(&system.accelerations) != bits(&expected) {
                return Err("other accelerations than those of the solver".to_owned());
            }
            let all = [&system.a, &system.b, &system.c, &system.d];
            match all.into_iter().flatten().find(|number| !number.is_finite()) {
                Some(bad) => Err(format!("a derivative is {bad}")),
                None => Ok(Checked::Holds),
            }
        }
        (Err(DerivativeError::Solve(found)), Err(expected)) if text(&found) == text(&expected) => {
            Ok(Checked::Holds)
        }
        (Err(DerivativeError::NotFinite { .. }), Ok(_)) => Ok(Checked::Holds),
        (Err(DerivativeError::Solve(found)), Ok(accelerations)) => {
            let momentum = craft.energy_and_momentum(&state, About::InertialOrigin).err();
            let loads = craft.loads(&state, &inputs, &accelerations, LoadAxes::Body).err();
            if [momentum, loads].iter().flatten().any(|error| text(error) == text(&found)) {
                return Ok(Checked::Holds);
            }
            Err(format!("{found}, which no service says"))
        }
        (found, expected) => {
            Err(format!("{:?}, accelerations {:?}", found.map(|_| ()), expected.map(|_| ())))
        }
    }
}

/// Changes a variable; its size, or none of one that is not changed here.
fn changed(placed: &mut PreparedCase<List>, variable: Variable, by: f64) -> Option<f64> {
    let PreparedCase { craft, state, inputs } = placed;
    let at = |axis: Axis| Axis::ALL.iter().position(|other| *other == axis).unwrap_or_default();
    let (of, size) = match variable {
        Variable::Velocity(axis) => (&mut state.r_b_n_dot[at(axis)], 1.0),
        Variable::Omega(axis) => (&mut state.omega[at(axis)], 1.0),
        Variable::Force(axis) => (&mut inputs.force[at(axis)], 1.0),
        Variable::TorqueB(axis) => (&mut inputs.torque_b[at(axis)], 1.0),
        Variable::Motor(joint) => (inputs.motors.values_mut().nth(joint)?, 1.0),
        Variable::Coordinate(joint) => {
            let (_, info) = craft.joints().nth(joint)?;
            let [coordinate, _] = state.devices.states_mut().nth(joint)?;
            (coordinate, if info.slides { 0.1 } else { 1.0 })
        }
        Variable::Rate(joint) => {
            let [_, rate] = state.devices.states_mut().nth(joint)?;
            let size = rate.abs().max(1.0);
            (rate, size)
        }
        _ => return None,
    };
    *of += by * size;
    Some(size)
}

/// Accelerations with a variable changed by a share of its size, and that size.
fn with(placed: &PreparedCase<List>, variable: Variable, by: f64) -> Option<(Vec<f64>, f64)> {
    let mut placed = placed.clone();
    let size = changed(&mut placed, variable, by)?;
    let found = placed.craft.accelerations(&placed.state, &placed.inputs).ok()?;
    Some((numbers(&found), size))
}

/// The block of each acceleration: of B, of the hub, of each device.
fn blocks(placed: &PreparedCase<List>) -> Vec<usize> {
    let joints = placed.craft.joints().map(|(device, _)| device + 2);
    [0, 0, 0, 1, 1, 1].into_iter().chain(joints).collect()
}

/// `derivatives-are-differences`: the derivatives of the accelerations by velocities, forces, torques, motors,
/// coordinates and rates are those of central differences.
///
/// # Errors
/// Where it does not hold.
pub fn derivatives_are_differences(case: &Case) -> Verdict {
    let Ok(placed) = case.list() else { return Ok(Checked::Rejected) };
    // Dry friction changes within the step.
    let dry = case
        .devices
        .iter()
        .any(|device| device.parameters().passive.iter().any(|passive| passive.coulomb != 0.0));
    let PreparedCase { craft, state, inputs } = &placed;
    let (blocks, mut columns) = (blocks(&placed), Vec::new());
    let variables = craft.state_variables(inputs).chain(craft.input_variables(inputs));
    let variables: Vec<_> =
        variables.filter(|variable| !(dry && matches!(variable, Variable::Rate(_)))).collect();
    let outputs = Outputs::accelerations();
    let found = craft.derivatives(state, inputs, &outputs, variables, |variable, column| {
        columns.push((variable, numbers(&column.accelerations)));
    });
    let Ok(found) = found else { return Ok(Checked::Rejected) };
    let found = numbers(&found);
    let mut checked = Checked::Rejected;
    for (variable, derivatives) in columns {
        let shares = [STEP, -STEP, 0.5 * STEP, -0.5 * STEP];
        let [Some(up), Some(down), Some(half_up), Some(half_down)] =
            shares.map(|share| with(&placed, variable, share))
        else {
            continue;
        };
        let size = up.1;
        let slope =
            |up: &[f64], down: &[f64], k: usize, step: f64| (up[k] - down[k]) / (2.0 * step * size);
        let differences: Vec<f64> = (0..derivatives.len())
            .map(|k| {
                let (full, half) = (
                    slope(&up.0, &down.0, k, STEP),
                    slope(&half_up.0, &half_down.0, k, 0.5 * STEP),
                );
                half + (half - full) / 3.0
            })
            .collect();
        let largest = |of: &[f64], block: usize| {
            let own = of.iter().zip(&blocks).filter(|(_, other)| **other == block);
            own.map(|(value, _)| value.abs()).fold(0.0, f64::max)
        };
        for (k, block) in blocks.iter().enumerate() {
            let bound = APART * largest(&derivatives, *block)
                + ROUNDING * largest(&found, *block).max(largest(&up.0, *block)) / (STEP * size);
            let apart = (derivatives[k] - differences[k]).abs();
            if apart > bound {
                let (found, expected) = (derivatives[k], differences[k]);
                return Err(format!(
                    "acceleration {k} by {variable}: {found:e}, by differences {expected:e}, apart by {apart:.1e}, bound {bound:.1e}"
                ));
            }
        }
        checked = Checked::Holds;
    }
    Ok(checked)
}
