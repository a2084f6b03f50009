//! Runs with springs, dampers and friction of any stiffness: they lose energy, or a step is refused.

use nalgebra::{Matrix3, Vector3};
use precess_dynamics::{
    BuiltIn, Each, HingedPanel, Hub, JointStates, Passive, ReactionWheel, SloshMass, Spacecraft,
    State, Vscmg,
};
use proptest::collection::vec;
use proptest::prelude::{BoxedStrategy, Strategy};

use super::bodies::rotation;
use super::case::{Case, List, Placed};
use super::number::Number;
use super::{Checked, Verdict};

/// How far energy may grow by itself in a run that the step resolves, of what there is: truncation, a
/// tenth of a radian at most, 300 times.
const GROWTH: f64 = 1e-3;

/// How many times the energy may become what it was in a run that is stable but not resolved: a step
/// near the limit turns one form of energy into another at the wrong ratio before both decay. Five
/// percent beyond the limit, 300 steps make 1e12 of it.
const TRANSIENT: f64 = 100.0;

/// How far energy less work may drift in a run whose springs and dampers the step resolves too.
const DRIFT: f64 = 1e-3;

/// What a step resolves: a tenth of the time in which a damper or spring acts.
const RESOLVED: f64 = 0.1;

/// How far joints and hub move in a step that resolves the motion, rad or m.
const MOTION: f64 = 0.2;

/// Steps of a run.
const STEPS: usize = 300;

/// A joint's own numbers, in units of what the step can do: damper, spring, friction, its rate.
#[derive(Clone, Debug)]
struct Bound {
    kind: usize,
    mount: [f64; 4],
    place: [f64; 3],
    stiff: [f64; 3],
    used: [bool; 3],
    dry_rate: f64,
    motion: [f64; 4],
}

/// Spacecraft with up to three devices, whose joints act up to a hundred times as fast as the step.
pub fn cases() -> BoxedStrategy<Case> {
    let stiff = [(); 3].map(|()| Number::log_within(1e-3, 100.0));
    let bound = (
        0_usize..4,
        [(); 4].map(|()| Number::within(-1.0, 1.0)),
        [(); 3].map(|()| Number::within(-1.0, 1.0)),
        stiff,
        proptest::array::uniform3(proptest::bool::weighted(0.5)),
        Number::log_within(1e-4, 1.0),
        [(); 4].map(|()| Number::within(-1.0, 1.0)),
    )
        .prop_map(|(kind, mount, place, stiff, used, dry_rate, motion)| Bound {
            kind,
            mount,
            place,
            stiff,
            used,
            dry_rate,
            motion,
        });
    let omega = [(); 3].map(|()| Number::within(-0.6, 0.6));
    let mass = Number::log_within(0.1, 1000.0);
    (vec(bound, 1..=3), omega, mass, Number::log_within(1e-4, 1e-3))
        .prop_map(|(bound, omega, mass, dt)| spacecraft(&bound, omega, mass, dt))
        .boxed()
}

fn spacecraft(bound: &[Bound], omega: [f64; 3], mass: f64, dt: f64) -> Case {
    let i_b_bc = Matrix3::from_diagonal(&(0.1 * mass * Vector3::new(1.0, 1.2, 0.9)));
    let hub = Hub { m_b: mass, r_bc_b: Vector3::zeros(), i_b_bc };
    let devices: List = bound.iter().map(|bound| device(bound, dt)).collect();
    let mut case = Case::still(hub, devices);
    (case.dt, case.state.omega) = (dt, omega.into());
    let counts: Vec<_> = case.devices.iter().map(|device| device.kind().joints()).collect();
    let motions = bound.iter().zip(&counts).flat_map(|(bound, infos)| {
        let [q, rate, q_other, rate_other] = bound.motion;
        [[q, rate], [q_other, rate_other]].into_iter().zip(*infos)
    });
    for (([q, rate], info), [to_q, to_rate]) in motions.zip(case.state.devices.states_mut()) {
        (*to_q, *to_rate) = (q, if info.body == "wheel" { 50.0 * rate } else { rate });
    }
    // A spring is stretched so far that what it sets in motion is resolved by the step.
    let passives: Vec<_> = passives(&case.devices).collect();
    for ([q, _], (own, [_, spring, _])) in case.state.devices.states_mut().zip(passives.iter().zip(
        bound.iter().zip(&counts).flat_map(|(bound, infos)| infos.iter().map(|_| bound.stiff)),
    )) {
        if own.stiffness != 0.0 {
            *q *= 0.03 / spring.max(1.0);
        }
    }
    case
}

fn device(bound: &Bound, dt: f64) -> BuiltIn {
    let mount = rotation(bound.mount);
    let place = Vector3::from(bound.place);
    let disc = Matrix3::from_diagonal(&Vector3::new(0.2, 0.1, 0.1));
    // Of a joint that moves this inertia, or mass.
    let passive = |inertia: f64| {
        let [damper, spring, dry] = bound.stiff;
        let mut own = Passive::none();
        if bound.used[0] {
            own.viscous = damper * inertia / dt;
        }
        if bound.used[1] {
            own.stiffness = spring * spring * inertia / (dt * dt);
        }
        if bound.used[2] {
            own.coulomb_rate = bound.dry_rate;
            own.coulomb = dry * inertia / dt * bound.dry_rate;
        }
        own
    };
    match bound.kind {
        0 => {
            let mut wheel =
                ReactionWheel { mount, r_w_b: place, ..ReactionWheel::bare_wheel(4.0, disc) };
            wheel.passive.wheel = passive(0.2);
            wheel.into()
        }
        1 => {
            let bare = HingedPanel::bare_panel(4.0, disc);
            let r_pc_p = Vector3::new(0.0, 0.5, 0.0);
            let mut panel = HingedPanel { mount, r_p_b: place, r_pc_p, ..bare };
            panel.passive.panel = passive(1.1);
            panel.into()
        }
        2 => {
            let mut mass = SloshMass { mount, r_s_b: place, ..SloshMass::bare_slosh_mass(4.0) };
            mass.passive.slosh_mass = passive(4.0);
            mass.into()
        }
        _ => {
            let mut gimbal = Vscmg { mount, r_g_b: place, ..Vscmg::bare_wheel(4.0, disc) };
            gimbal.passive.gimbal = passive(0.1);
            gimbal.passive.wheel = passive(0.2);
            gimbal.into()
        }
    }
}

/// Spring, damper and friction of each joint.
fn passives(list: &List) -> impl Iterator<Item = Passive> + '_ {
    list.iter()
        .flat_map(|device| device.stated().passive.into_iter().take(device.kind().joints().len()))
}

/// How fast things are, times the step.
struct Speeds {
    /// Springs and dampers: damper and friction over the inertia that the joint moves, and the root of
    /// the spring over it.
    passive: f64,
    /// Joints and hub, with all of the energy.
    motion: f64,
}

fn speeds(case: &Case, craft: &Spacecraft<List>, energy: f64) -> Option<Speeds> {
    let rest: State<List> = State::at_rest_for(craft);
    let mut inputs = case.inputs.clone();
    let none = craft.accelerations(&rest, &inputs).ok()?;
    let mut worst = Speeds { passive: 0.0, motion: 0.0 };
    let moves = |per_inertia: f64| case.dt * (2.0 * energy * per_inertia).sqrt();
    for axis in 0..3 {
        inputs.torque_b[axis] = 1.0;
        let moved = craft.accelerations(&rest, &inputs).ok()?;
        inputs.torque_b[axis] = 0.0;
        let per_inertia = (moved.omega_dot[axis] - none.omega_dot[axis]).abs();
        worst.motion = worst.motion.max(moves(per_inertia));
    }
    for (index, own) in passives(&case.devices).enumerate() {
        *inputs.motors.values_mut().nth(index)? = 1.0;
        let moved = craft.accelerations(&rest, &inputs).ok()?;
        *inputs.motors.values_mut().nth(index)? = 0.0;
        let per_inertia =
            (moved.devices.values().nth(index)? - none.devices.values().nth(index)?).abs();
        let dry = if own.coulomb == 0.0 { 0.0 } else { own.coulomb / own.coulomb_rate };
        worst.passive = worst.passive.max(case.dt * (own.viscous + dry) * per_inertia);
        worst.passive = worst.passive.max(case.dt * (own.stiffness * per_inertia).sqrt());
        worst.motion = worst.motion.max(moves(per_inertia));
    }
    Some(worst)
}

/// `runs-conserve-or-refuse`: without motors and fields, energy does not grow by itself; where the step
/// resolves springs and friction, energy less work drifts no more than its truncation; or the step is
/// refused.
///
/// # Errors
/// Where it does not hold.
pub fn runs_conserve_or_refuse(case: &Case) -> Verdict {
    let Ok(Placed { craft, state, inputs }) = case.list() else { return Ok(Checked::Rejected) };
    let energy = |state: &State<List>| -> Result<f64, String> {
        let found = craft.accelerations(state, &inputs).map_err(|error| error.to_string())?;
        let ledger = craft.ledger(state, &inputs, &found).map_err(|error| error.to_string())?;
        Ok(ledger.energy())
    };
    let Ok(start) = energy(&state) else { return Ok(Checked::Rejected) };
    let Some(Speeds { passive: stiffness, motion }) = speeds(case, &craft, start) else {
        return Ok(Checked::Rejected);
    };
    // A step that does not resolve the motion itself promises nothing.
    if motion > MOTION {
        return Ok(Checked::Rejected);
    }
    let (mut now, mut work) = (state.clone(), 0.0);
    for step in 1..=STEPS {
        let Ok(stepped) = craft.step_with_work(&now, &inputs, case.dt) else {
            return Ok(Checked::Holds);
        };
        now = stepped.state;
        work += stepped.work.total();
        let after = energy(&now)?;
        let grown = if stiffness <= RESOLVED { 1.0 + GROWTH } else { TRANSIENT };
        if after > grown * start {
            return Err(format!(
                "after {step} steps {after:?} J, of {start:?} J at the start; joints act {stiffness:.3} \
                 times as fast as the step"
            ));
        }
        // The springs' work is their energy, which is counted already.
        work -= stepped.work.springs;
        let drift = after - start - work;
        if stiffness <= RESOLVED && drift.abs() > DRIFT * start {
            return Err(format!(
                "after {step} steps energy less work drifts by {drift:?} J of {start:?} J"
            ));
        }
    }
    Ok(Checked::Holds)
}
