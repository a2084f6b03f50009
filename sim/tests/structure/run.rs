//! The mounted force of an imbalanced wheel on a hub with a sprung panel, by the filter, against runs of the
//! nonlinear equations over thirty turns, off resonance and at it.

use nalgebra::{Complex, DMatrix, DVector, Matrix3, Rotation3, Vector3};
use precess::structure::accelerance::{Accelerance, Base};
use precess::structure::dynamic_mass::Wheel;
use precess::structure::mounted::mounted_force;
use precess::structure::{Mode, Node, RigidMass};
use precess_dynamics::{HingedPanel, Inputs, ReactionWheel, Spacecraft, State};

use super::structure;
use super::wheel::{I, blocked, hub, wheel};

type Set = (ReactionWheel, HingedPanel);

const RATE: f64 = 400.0;
/// Static imbalance over mass, m: motion so small that what is not linear does not count.
const OFFSET: f64 = 1e-7;
/// Steps of a turn, and turns.
const STEPS: u32 = 200;
const TURNS: u32 = 30;
/// Differences over the largest motion: what is not linear in the offset, 1e-7 of a length; and what is left of
/// the motion that a run begins with, which resonance multiplies by fifty.
const OFF_MAX: f64 = 1e-6;
const AT_MAX: f64 = 1e-5;

/// Motion of the hub and of the panel's angle, for exp(i RATE t).
struct Motion {
    acceleration: DVector<Complex<f64>>,
    angle: Complex<f64>,
}

fn panel(stiffness: f64) -> HingedPanel {
    let inertia = Matrix3::from_diagonal(&Vector3::new(0.05, 0.2, 0.24));
    let mut panel = HingedPanel {
        mount: Rotation3::from_euler_angles(0.4, -0.3, 0.9).into_inner(),
        r_p_b: Vector3::new(-0.3, 0.5, 0.1),
        r_pc_p: Vector3::new(0.4, 0.1, -0.05),
        ..HingedPanel::bare_panel(3.0, inertia)
    };
    panel.passive.panel.stiffness = stiffness;
    panel.passive.panel.viscous = 6.0;
    panel
}

/// By the hub with the panel as a structure of one mode, which carries momentum, and the filter.
fn predicted(panel: &HingedPanel) -> Motion {
    let axis = panel.mount.column(2).into_owned();
    let arm = panel.mount * panel.r_pc_p;
    let inertia = panel.mount * panel.i_p_pc * panel.mount.transpose();
    let centre = panel.r_p_b + arm;
    // The mode: the panel turns by 1 / sqrt(I_h) about its hinge.
    let swept = axis.cross(&arm) * panel.m_p;
    let about_hinge = axis.dot(&(inertia * axis)) + axis.cross(&arm).dot(&swept);
    let norm = about_hinge.sqrt();
    let passive = panel.passive.panel;
    let mode = Mode {
        frequency: (passive.stiffness / about_hinge).sqrt(),
        damping: passive.viscous / (2.0 * (passive.stiffness * about_hinge).sqrt()),
        linear: swept / norm,
        angular: (inertia * axis + centre.cross(&swept)) / norm,
    };
    let node = Node { name: "hub".into(), position: Vector3::zeros() };
    let mut whole = structure(vec![node], vec![mode], DMatrix::zeros(6, 1));
    let hub = hub();
    let [of_hub, of_panel] = [
        RigidMass::about_centre(hub.m_b, hub.r_bc_b, hub.i_b_bc),
        RigidMass::about_centre(panel.m_p, centre, inertia),
    ];
    whole.mass = Some(RigidMass {
        mass: of_hub.mass + of_panel.mass,
        first_moment: of_hub.first_moment + of_panel.first_moment,
        inertia: of_hub.inertia + of_panel.inertia,
    });
    let own = Accelerance::new(&whole, Base::Free, &[0], &[0]).expect("a node");
    let own = own.at(RATE).expect("damped");
    let device = wheel(OFFSET);
    let averaged = Wheel::from_reaction_wheel(&device, &Vector3::zeros(), RATE).expect("valid");
    let mass = averaged.dynamic_mass(RATE).expect("above zero");
    let force = mounted_force(&mass, &own, &blocked(&device, RATE), RATE).expect("damped");
    let acceleration = own * force;
    // eta'' = -g L^T a;  the angle is eta / sqrt(I_h).
    let stiff = mode.frequency * mode.frequency - RATE * RATE;
    let stiff = Complex::new(stiff, 2.0 * mode.damping * mode.frequency * RATE);
    let momentum = whole.momenta().column(0).map(|value| Complex::new(value, 0.0));
    let along: Complex<f64> = momentum.iter().zip(acceleration.iter()).map(|(l, a)| l * a).sum();
    Motion { angle: -along / (stiff * norm), acceleration }
}

/// The largest difference of hub's rate and panel's angle, over the largest of each, in a run that starts with
/// the motion that is predicted.
fn difference(panel: &HingedPanel, motion: &Motion) -> f64 {
    let device = wheel(OFFSET);
    let craft = Spacecraft::new(&hub(), &(device, *panel)).expect("valid");
    let at = |value: Complex<f64>, time: f64| (value * (I * RATE * time).exp()).re;
    let by_rate = I * RATE;
    let omega = |time| Vector3::from_fn(|row, _| at(motion.acceleration[3 + row] / by_rate, time));
    let mut state: State<Set> = State::at_rest();
    state.r_b_n_dot = Vector3::from_fn(|row, _| at(motion.acceleration[row] / by_rate, 0.0));
    state.omega = omega(0.0);
    // The wheel keeps its absolute rate.
    state.devices.0.spin = RATE - device.mount.column(0).dot(&state.omega);
    state.devices.1.phi = at(motion.angle, 0.0);
    state.devices.1.phi_dot = at(motion.angle * by_rate, 0.0);
    let inputs: Inputs<Set> = Inputs::none();
    let step = std::f64::consts::TAU / RATE / f64::from(STEPS);
    let units = [motion.acceleration.rows(3, 3).norm() / RATE, motion.angle.norm()];
    let mut worst = 0.0_f64;
    for k in 1..=STEPS * TURNS {
        state = craft.step(&state, &inputs, step).expect("regular");
        let time = step * f64::from(k);
        let of_hub = (state.omega - omega(time)).norm() / units[0];
        let of_panel = (state.devices.1.phi - at(motion.angle, time)).abs() / units[1];
        worst = worst.max(of_hub).max(of_panel);
    }
    worst
}

#[test]
fn the_filter_is_the_run_off_resonance_and_at_it() {
    // Stiffnesses around the one that resonates at the wheel's rate.
    let stiffness = |k: u32| 4e4 * 1.01_f64.powi(i32::try_from(k).unwrap_or(0));
    let angle = |k: u32| predicted(&panel(stiffness(k))).angle.norm();
    let at = (0..300).max_by(|a, b| angle(*a).total_cmp(&angle(*b))).expect("some");
    assert!((5..295).contains(&at), "a resonance at {at} is within the range");
    assert!(angle(at) > 10.0 * angle(at - at.min(60)), "it is a resonance");
    for (k, bound) in [(at, AT_MAX), (at + 60, OFF_MAX), (at.saturating_sub(60), OFF_MAX)] {
        let panel = panel(stiffness(k));
        let found = difference(&panel, &predicted(&panel));
        assert!(found < bound, "{} N m/rad: {found:e}", stiffness(k));
    }
}
