//! Energy and momentum: the ledger balances, kinetic energy is not negative, stops lose energy and
//! keep momentum, what is locked stays.

use nalgebra::{Matrix3, Rotation3, Vector3};
use precess_dynamics::{About, Dgvscmg, Each, Hub, HubMode, JointStates, Mode, SloshMass};
use proptest::prelude::{BoxedStrategy, Strategy};

use super::bodies::rotation;
use super::call_results::no_accelerations;
use super::case::{Case, PreparedCase};
use super::draw::Profile;
use super::number::Number;
use super::residual::numbers;
use super::sizes::{Motion, motion, sizes};
use super::{Checked, Verdict};

/// The bound of docs/promises.md on the ledger's residual, in epsilons of its magnitude.
const LEDGER: f64 = 50.0;

/// Momentum and energy over a stop, in epsilons of the sums of magnitudes before and after.
const STOP: f64 = 200.0;

/// `ledger-balances`: what is left between the rate of the kinetic energy and all powers is
/// rounding.
///
/// # Errors
/// Where it does not hold.
pub fn ledger_balances(case: &Case) -> Verdict {
    let Ok(PreparedCase { craft, state, inputs }) = case.list() else {
        return Ok(Checked::Rejected);
    };
    let Ok(found) = craft.accelerations(&state, &inputs) else { return Ok(Checked::Rejected) };
    let ledger = craft.ledger(&state, &inputs, &found).map_err(|error| error.to_string())?;
    // The magnitude counts sums, not their terms: where terms cancel, rounding is that of the
    // terms.
    let sizes = sizes(case, &state, &inputs, &numbers(&found));
    let rates = state.devices.states().map(|[_, rate]| rate.abs());
    let joints: f64 = rates.zip(&sizes.joints).map(|(rate, size)| rate * size).sum();
    let hub = sizes.force * state.r_b_n_dot.norm() + sizes.moment * state.omega.norm();
    let unit = f64::EPSILON * (ledger.magnitude + hub + joints);
    if ledger.residual.abs() > LEDGER * unit {
        let error = ledger.residual.abs() / unit;
        return Err(format!("{error:.1} epsilons of its terms are left: {ledger:?}"));
    }
    if ledger.power.friction > 0.0 {
        return Err(format!("friction gives {:?} W", ledger.power.friction));
    }
    Ok(Checked::Holds)
}

/// Cases in which the parts of the kinetic energy cancel: a heavy body at rest on a light hub
/// that moves, or a hub that turns about its centre of mass, far from B and without much inertia.
pub fn cancelling() -> BoxedStrategy<Case> {
    let turn = [(); 4].map(|()| Number::within(-1.0, 1.0));
    let light = Number::log_within(1e-30, 1.0);
    let speed = Number::log_within(1e-3, 1e3);
    let position = [(); 3].map(|()| Number::within(-1.0, 1.0));
    let motion = [(); 5].map(|()| Number::within(-1.0, 1.0));
    (0..3, turn, light, speed, position, motion)
        .prop_map(|(form, turn, light, speed, position, motion)| {
            let mount = rotation(turn);
            let position = Vector3::from(position);
            let i_b_bc = Matrix3::identity() * light;
            let hub = Hub { m_b: light, r_bc_b: Vector3::zeros(), i_b_bc };
            let omega = speed * Vector3::new(motion[0], motion[1], motion[2]);
            if form == 0 {
                let mut case = Case::still(Hub { m_b: 4.0, r_bc_b: position, ..hub }, Vec::new());
                (case.state.omega, case.state.r_b_n_dot) = (omega, -omega.cross(&position));
                return case;
            }
            if form == 1 {
                let mass = SloshMass { mount, r_s_b: position, ..SloshMass::bare_slosh_mass(4.0) };
                let mut case = Case::still(hub, vec![mass.into()]);
                case.state.r_b_n_dot = speed * mount.column(0);
                set(&mut case, &[[motion[0], -speed]]);
                return case;
            }
            // The hub turns back what the joints turn the wheel, about the wheel's centre.
            let disc = Matrix3::from_diagonal(&Vector3::new(0.2, 0.1, 0.1));
            let wheel = Dgvscmg { mount, r_go_b: position, ..Dgvscmg::bare_wheel(4.0, disc) };
            let mut case = Case::still(hub, vec![wheel.into()]);
            let [gamma_o, gamma_i, o, i, w] = motion;
            let [o, i, w] = [o, i, w].map(|rate| speed * rate);
            let outer = Rotation3::from_axis_angle(&Vector3::z_axis(), 3.0 * gamma_o);
            let inner = outer * Rotation3::from_axis_angle(&Vector3::y_axis(), gamma_i);
            let rates = o * Vector3::z() + outer * (i * Vector3::y()) + inner * (w * Vector3::x());
            case.state.omega = -(mount * rates);
            case.state.r_b_n_dot = -case.state.omega.cross(&position);
            set(&mut case, &[[3.0 * gamma_o, o], [gamma_i, i], [0.0, w]]);
            case
        })
        .boxed()
}

/// Sets coordinates and rates.
fn set(case: &mut Case, joints: &[[f64; 2]]) {
    for ([q, rate], to) in case.state.devices.states_mut().zip(joints) {
        [*q, *rate] = *to;
    }
}

/// `kinetic-energy-is-not-negative`.
///
/// # Errors
/// Where it does not hold.
pub fn kinetic_energy_is_not_negative(case: &Case) -> Verdict {
    let Ok(PreparedCase { craft, state, inputs }) = case.list() else {
        return Ok(Checked::Rejected);
    };
    let ledger = no_accelerations(&craft)
        .map(|still| craft.ledger(&state, &inputs, &still).map(|ledger| ledger.kinetic));
    let mut checked = Checked::Rejected;
    let energies = ledger.map(|energy| ("ledger", energy));
    for (what, energy) in [("energy", craft.energy(&state))].into_iter().chain(energies) {
        match energy {
            Ok(energy) if energy >= 0.0 => checked = Checked::Holds,
            Ok(energy) => return Err(format!("kinetic energy is {energy:?} J by `{what}`")),
            Err(_) => {}
        }
    }
    Ok(checked)
}

/// Cases that are stopped while they move.
pub fn moving() -> BoxedStrategy<Case> {
    Profile { modes: true, ..Profile::REAL }
        .cases()
        .prop_map(|mut case| {
            let held = case.inputs.modes.values().zip(case.inputs.motors.values());
            for ([_, rate], (mode, motor)) in case.state.devices.states_mut().zip(held) {
                if mode == Mode::Locked {
                    *rate = motor;
                }
            }
            if case.inputs.hub == HubMode::Fixed {
                (case.state.r_b_n_dot, case.state.omega) =
                    (case.inputs.force, case.inputs.torque_b);
            }
            case
        })
        .boxed()
}

/// `stop-conserves`: a stop keeps momentum, loses energy, and leaves what is locked at rest.
///
/// # Errors
/// Where it does not hold.
pub fn stop_conserves(case: &Case) -> Verdict {
    let Ok(PreparedCase { craft, state, inputs }) = case.list() else {
        return Ok(Checked::Rejected);
    };
    let Ok(stopped) = craft.stop(&state, &inputs) else { return Ok(Checked::Rejected) };
    let next = &stopped.state;
    let modes = inputs.modes.values();
    for (([q, before], [same, after]), mode) in
        state.devices.states().zip(next.devices.states()).zip(modes)
    {
        let right = match mode {
            Mode::Locked => after.to_bits() == 0,
            Mode::Prescribed(_) => after == before,
            Mode::Driven => true,
        };
        if !right || q.to_bits() != same.to_bits() {
            return Err(format!(
                "{mode:?} joint at {q:?}, {before:?} is left at {same:?}, {after:?}"
            ));
        }
    }
    let [old, new] = [&state, next].map(|state| motion(case, state));
    let unit = Motion {
        linear: old.linear + new.linear,
        angular: old.angular + new.angular,
        energy: old.energy + new.energy,
    };
    let held = matches!(inputs.hub, HubMode::Prescribed { .. })
        || inputs.modes.values().any(|mode| matches!(mode, Mode::Prescribed(_)));
    if !held && stopped.energy_lost < -STOP * f64::EPSILON * unit.energy {
        return Err(format!("{:?} J are lost of {:?} J", stopped.energy_lost, unit.energy));
    }
    if inputs.hub == HubMode::Fixed && next.omega.norm() + next.r_b_n_dot.norm() != 0.0 {
        return Err(format!("fixed hub moves: {:?}", next.omega));
    }
    if inputs.hub != HubMode::Free {
        return Ok(Checked::Holds);
    }
    let momentum = |about| -> Result<_, String> {
        let of = |state| craft.momentum(state, about).map_err(|error| error.to_string());
        Ok((of(next)?, of(&state)?))
    };
    // About B: no digits are lost to the distance from the origin.
    let (after, before) = momentum(About::Point(state.r_b_n))?;
    for (what, error, unit) in [
        ("linear", (after.linear - before.linear).norm(), unit.linear),
        ("angular", (after.angular - before.angular).norm(), unit.angular),
    ] {
        let error = if error == 0.0 { 0.0 } else { error / (f64::EPSILON * unit) };
        if error > STOP {
            return Err(format!("{what} momentum changes by {error:.1} epsilons"));
        }
    }
    Ok(Checked::Holds)
}

/// `locked-stays-locked`: over steps, a locked joint's rate is zero and its coordinate keeps its
/// bits.
///
/// # Errors
/// Where it does not hold.
pub fn locked_stays_locked(case: &Case) -> Verdict {
    let Ok(PreparedCase { craft, state, inputs }) = case.list() else {
        return Ok(Checked::Rejected);
    };
    if inputs.modes.values().all(|mode| mode != Mode::Locked) {
        return Ok(Checked::Rejected);
    }
    let mut now = state.clone();
    for step in 0..20 {
        let Ok(next) = craft.step(&now, &inputs, case.dt) else { break };
        now = next;
        let joints = state.devices.states().zip(now.devices.states()).zip(inputs.modes.values());
        for (([q, _], [found, rate]), mode) in joints {
            if mode == Mode::Locked && (rate != 0.0 || q.to_bits() != found.to_bits()) {
                return Err(format!("after step {step}, {q:?} is {found:?} and moves at {rate:?}"));
            }
        }
    }
    Ok(Checked::Holds)
}
