//! Runs with springs, dampers and friction of any stiffness: energy is kept, or a step is rejected.

use nalgebra::{Matrix3, Vector3};
use precess_dynamics::{
    BuiltIn, Each, HingedPanel, Hub, JointStates, Passive, ReactionWheel, SloshMass, Spacecraft,
    State, Vscmg,
};
use proptest::collection::vec;
use proptest::prelude::{BoxedStrategy, Strategy};

use super::bodies::rotation;
use super::case::{Case, List, PreparedCase};
use super::number::Number;
use super::{Checked, Verdict};

/// How far energy less work may drift in a run that the step resolves, of what there is:
/// truncation, a tenth of a radian at most in each of the steps.
const DRIFT: f64 = 1e-5;

/// RK4 is unstable where a root of a joint's own equation is beyond 2.96 steps in any direction:
/// surely where the product of both is, or half their sum.
const SPRING: f64 = 3.0;

/// What a step resolves: a tenth of the time in which a damper or spring acts.
const RESOLVED: f64 = 0.1;

/// Steps of a run.
const STEPS: usize = 50;

/// A joint's own numbers, in units of what the step can do: damper, spring, friction, its rate.
#[derive(Clone, Debug)]
struct Bound {
    kind: usize,
    mount: [f64; 4],
    position: [f64; 3],
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
        .prop_map(|(kind, mount, position, stiff, used, dry_rate, motion)| Bound {
            kind,
            mount,
            position,
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
    case
}

fn device(bound: &Bound, dt: f64) -> BuiltIn {
    let mount = rotation(bound.mount);
    let position = Vector3::from(bound.position);
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
                ReactionWheel { mount, r_w_b: position, ..ReactionWheel::bare_wheel(4.0, disc) };
            wheel.passive.wheel = passive(0.2);
            wheel.into()
        }
        1 => {
            let bare = HingedPanel::bare_panel(4.0, disc);
            let r_pc_p = Vector3::new(0.0, 0.5, 0.0);
            let mut panel = HingedPanel { mount, r_p_b: position, r_pc_p, ..bare };
            panel.passive.panel = passive(1.1);
            panel.into()
        }
        2 => {
            let mut mass = SloshMass { mount, r_s_b: position, ..SloshMass::bare_slosh_mass(4.0) };
            mass.passive.slosh_mass = passive(4.0);
            mass.into()
        }
        _ => {
            let mut gimbal = Vscmg { mount, r_g_b: position, ..Vscmg::bare_wheel(4.0, disc) };
            gimbal.passive.gimbal = passive(0.1);
            gimbal.passive.wheel = passive(0.2);
            gimbal.into()
        }
    }
}

/// How fast the joints act in a pose, times the step.
struct Fast {
    /// Dampers: damping over the inertia that the joint moves.
    damper: f64,
    /// Springs: the root of stiffness over it.
    spring: f64,
    /// Dry friction at rest.
    dry: f64,
}

/// Of a state's pose, the worst joint of each.
fn fast(case: &Case, craft: &Spacecraft<List>, state: &State<List>) -> Option<Fast> {
    let mut rest = state.clone();
    rest.omega = Vector3::zeros();
    rest.devices.states_mut().for_each(|[_, rate]| *rate = 0.0);
    let mut inputs = case.inputs.clone();
    let none = craft.accelerations(&rest, &inputs).ok()?;
    let mut worst = Fast { damper: 0.0, spring: 0.0, dry: 0.0 };
    let passives = case.devices.iter().flat_map(|device| {
        device.parameters().passive.into_iter().take(device.kind().joints().len())
    });
    for (index, own) in passives.enumerate() {
        // So large that the difference has digits next to the work of springs.
        let torque = 1.0 + own.stiffness;
        *inputs.motors.values_mut().nth(index)? = torque;
        let moved = craft.accelerations(&rest, &inputs).ok()?;
        *inputs.motors.values_mut().nth(index)? = 0.0;
        let change = moved.devices.values().nth(index)? - none.devices.values().nth(index)?;
        let per_inertia = change.abs() / torque;
        let dry = if own.coulomb == 0.0 { 0.0 } else { own.coulomb / own.coulomb_rate };
        worst.damper = worst.damper.max(case.dt * own.viscous * per_inertia);
        worst.spring = worst.spring.max(case.dt * (own.stiffness * per_inertia).sqrt());
        worst.dry = worst.dry.max(case.dt * dry * per_inertia);
    }
    Some(worst)
}

/// `runs-conserve-or-refuse`: a step that a spring or damper of any joint makes unstable is
/// rejected, and a run that resolves springs and friction keeps energy less work, without motors
/// and fields.
///
/// # Errors
/// Where it does not hold.
pub fn runs_conserve_or_refuse(case: &Case) -> Verdict {
    let Ok(PreparedCase { craft, state, inputs }) = case.list() else {
        return Ok(Checked::Rejected);
    };
    let energy = |state: &State<List>| -> Result<f64, String> {
        let found = craft.accelerations(state, &inputs).map_err(|error| error.to_string())?;
        let ledger = craft.ledger(state, &inputs, &found).map_err(|error| error.to_string())?;
        Ok(ledger.energy())
    };
    let (Ok(start), Some(fast)) = (energy(&state), fast(case, &craft, &state)) else {
        return Ok(Checked::Rejected);
    };
    let Fast { damper, spring, dry } = fast;
    if spring > SPRING || damper > 2.0 * SPRING {
        return match craft.step(&state, &inputs, case.dt) {
            Err(_) => Ok(Checked::Holds),
            Ok(_) => Err(format!("springs act {spring:.3}, dampers {damper:.3} times in a step")),
        };
    }
    if damper.max(spring).max(dry) > RESOLVED {
        return Ok(Checked::Rejected);
    }
    let (mut now, mut work) = (state.clone(), 0.0);
    for step in 1..=STEPS {
        let stepped = craft.step_with_work(&now, &inputs, case.dt);
        let stepped = stepped.map_err(|error| format!("step {step}: {error}"))?;
        now = stepped.state;
        // The springs' work is their energy, which is counted already.
        work += stepped.work.total() - stepped.work.springs;
        let after = energy(&now)?;
        let drift = after - start - work;
        if drift.abs() > DRIFT * start || after > (1.0 + DRIFT) * start {
            return Err(format!(
                "after {step} steps energy less work drifts by {drift:?} J of {start:?} J"
            ));
        }
    }
    Ok(Checked::Holds)
}
