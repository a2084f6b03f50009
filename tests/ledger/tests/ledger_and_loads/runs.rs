//! A minute with six kinds: the change of energy is the sum of all works, the change of momentum
//! the impulse of gravity.

use nalgebra::{Matrix3, Rotation3, Vector3};
use precess_dynamics::{
    About, Attitude, Dgvscmg, Each, FixedSet, Gravity, HingedPanel, Hub, Inputs, JointStates,
    Passive, Quaternion, ReactionWheel, Sgcmg, SloshMass, Spacecraft, State, Vscmg, dgvscmg,
    hinged_panel, reaction_wheel, sgcmg, slosh_mass, vscmg,
};

use super::bounds::{DRIFT, Worst};
use super::craft::{Case, Mixed};
use super::kinematics;
use super::run::{Works, run};

const DURATION: f64 = 60.0;

/// Below this rate Coulomb friction fades, rad/s (or m/s). Narrower, each change of sign is a
/// corner that the integrator has to find.
const FADING: f64 = 0.05;

/// Moments, and products of this share of the first: no axis is a principal one.
fn tensor(moments: [f64; 3], share: f64) -> Matrix3<f64> {
    let mut inertia = Matrix3::from_diagonal(&Vector3::from(moments));
    let product = share * moments[0];
    for (i, j, share) in [(0, 1, 1.0), (0, 2, -0.5), (1, 2, 0.3)] {
        (inertia[(i, j)], inertia[(j, i)]) = (share * product, share * product);
    }
    inertia
}

/// A mount by its rotation vector.
fn mount(x: f64, y: f64, z: f64) -> Matrix3<f64> {
    *Rotation3::from_scaled_axis(Vector3::new(x, y, z)).matrix()
}

/// Springs, viscous and Coulomb friction at every joint; wheels have no spring.
fn passive<P: Each<Passive>>(mut all: P, stiffness: &[f64]) -> P {
    for (passive, stiffness) in all.values_mut().zip(stiffness) {
        let dry = Passive::friction(0.01, 0.01, FADING);
        let wheel = Passive::friction(1e-4, 2e-3, FADING);
        *passive = if *stiffness == 0.0 { wheel } else { dry };
        (passive.stiffness, passive.rest) = (*stiffness, 0.1);
    }
    all
}

/// Gimbals with offsets on a hub of 60 kg; wheels with ten times a catalogue's imbalance, so that
/// each shakes the hub by newtons.
fn devices() -> Mixed {
    let v = Vector3::new;
    let (j, g) = (tensor([0.02, 0.012, 0.013], 1e-3), tensor([0.02, 0.03, 0.025], 0.1));
    let dgvscmg = Dgvscmg {
        mount: mount(0.3, -0.2, 0.9),
        r_go_b: v(0.4, 0.1, -0.2),
        m_go: 2.0,
        r_goc_go: v(0.01, 0.02, -0.01),
        i_go_goc: g,
        l_o: v(0.02, -0.01, 0.03),
        m_gi: 1.0,
        r_gic_gi: v(-0.01, 0.01, 0.02),
        i_gi_gic: g * 0.5,
        l_i: v(0.01, 0.02, -0.02),
        d: 1e-4,
        passive: passive(dgvscmg::PerJoint::all(Passive::none()), &[0.5, 0.8, 0.0]),
        ..Dgvscmg::bare_wheel(4.0, j)
    };
    let vscmg = Vscmg {
        mount: mount(-0.5, 0.8, 0.1),
        r_g_b: v(-0.3, 0.2, 0.1),
        m_g: 2.0,
        r_gc_g: v(0.02, 0.01, 0.01),
        i_g_gc: g,
        l_g: v(0.01, -0.02, 0.02),
        d: 2e-4,
        passive: passive(vscmg::PerJoint::all(Passive::none()), &[0.6, 0.0]),
        ..Vscmg::bare_wheel(3.0, j)
    };
    let sgcmg = Sgcmg {
        mount: mount(1.2, 0.1, -0.4),
        r_g_b: v(0.1, -0.4, 0.2),
        m_g: 1.5,
        r_gc_g: v(-0.01, 0.02, 0.02),
        i_g_gc: g,
        l_g: v(-0.01, 0.01, 0.01),
        d: 1e-4,
        passive: passive(sgcmg::PerJoint::all(Passive::none()), &[0.7, 0.0]),
        ..Sgcmg::bare_wheel(3.0, j)
    };
    let wheel = ReactionWheel {
        mount: mount(0.2, 1.4, 0.3),
        r_w_b: v(0.2, 0.3, 0.3),
        d: 2e-4,
        passive: passive(reaction_wheel::PerJoint::all(Passive::none()), &[0.0]),
        ..ReactionWheel::bare_wheel(4.0, j)
    };
    let panel = HingedPanel {
        mount: mount(0.1, 0.1, 0.2),
        r_p_b: v(0.5, 0.5, 0.0),
        r_pc_p: v(0.6, 0.1, 0.02),
        passive: passive(hinged_panel::PerJoint::all(Passive::none()), &[5.0]),
        ..HingedPanel::bare_panel(3.0, tensor([0.2, 0.5, 0.6], 0.1))
    };
    let slosh = SloshMass {
        mount: mount(-0.7, 0.4, 1.0),
        r_s_b: v(-0.1, 0.1, -0.3),
        passive: passive(slosh_mass::PerJoint::all(Passive::none()), &[20.0]),
        ..SloshMass::bare_slosh_mass(5.0)
    };
    (dgvscmg, vscmg, sgcmg, wheel, panel, slosh)
}

fn case(gravity: Gravity, r_b_n: Vector3<f64>, r_b_n_dot: Vector3<f64>) -> Case<Mixed> {
    let hub = Hub {
        m_b: 60.0,
        r_bc_b: Vector3::new(0.05, -0.03, 0.08),
        i_b_bc: tensor([6.0, 8.0, 7.0], 0.1),
    };
    let devices = devices();
    let craft = Spacecraft::new(&hub, &devices).expect("valid parameters");
    assert_eq!(craft.warnings().count(), 0);
    let mut inputs: Inputs<Mixed> = Inputs { gravity, ..Inputs::none() };
    let mut state: State<Mixed> = State::at_rest();
    (state.r_b_n, state.r_b_n_dot) = (r_b_n, r_b_n_dot);
    state.attitude = Quaternion { q0: 0.8, q1: 0.2, q2: -0.4, q3: 0.4 };
    state.omega = Vector3::new(0.2, -0.3, 0.25);
    // Wheels at 30 to 50 rad/s, gimbals and panel at a tenth of a radian a second.
    let speeds = [50.0, -40.0, 45.0, 30.0].into_iter();
    let (mut speeds, mut sign) = (speeds, 1.0);
    let joints = state.devices.states_mut().zip(inputs.motors.values_mut());
    for (([_, rate], motor), info) in joints.zip(<Mixed as FixedSet>::joint_infos()) {
        sign = -sign;
        *rate = 0.1 * sign;
        *motor = if info.slides { 0.5 } else { 0.05 * sign };
        if info.body == "wheel" {
            *rate = speeds.next().expect("four wheels");
            *motor = 0.02 * sign;
        }
    }
    Case { seed: 0, hub, devices, craft, state, inputs }
}

/// Holds the drifts of energy less work and of momentum less impulse, each in its unit, to the
/// bound; returns the works.
fn check(case: &Case<Mixed>, what: &str, about: About) -> Works {
    let (mut energy, mut linear, mut angular) =
        (Worst::default(), Worst::default(), Worst::default());
    let (mut by_source, mut kinetic) = (Worst::default(), 0.0_f64);
    let mut start = None;
    let mut last = None;
    let clock = std::time::Instant::now();
    let steps = run(case, DURATION, |here, ledger, works| {
        let momentum = here.craft.momentum(&here.state, about).expect("finite");
        let (first, first_angular) = *start.get_or_insert((*ledger, momentum.angular));
        kinetic = kinetic.max(ledger.kinetic);
        let unit = kinetic + works.throughput;
        let work = works.external + works.motors + works.friction;
        energy.add((ledger.energy() - first.energy() - work).abs() / unit);
        by_source.add((ledger.gravity - first.gravity + works.gravity).abs() / unit);
        by_source.add((ledger.springs - first.springs + works.springs).abs() / unit);

        let from = match about {
            About::CentreOfMass => here.craft.centre_of_mass(&here.state).expect("finite").c,
            _ => -(here.state.attitude.dcm() * here.state.r_b_n),
        };
        let [of_linear, of_angular] =
            kinematics::momentum_units(here, &here.accelerations(), &from);
        let off = ledger.momentum.linear - first.momentum.linear - works.impulse;
        linear.add(off.norm() / of_linear);
        angular.add((momentum.angular - first_angular).norm() / of_angular);
        last = Some((*ledger, *works));
    });
    let (ledger, works) = last.expect("a run");
    println!(
        "{what}: {steps} steps in {:.1?}; energy {:.1e}, sources {:.1e}, linear {:.1e}, angular {:.1e}",
        clock.elapsed(),
        energy.0,
        by_source.0,
        linear.0,
        angular.0
    );
    println!("  {:.3?}\n  {works:.3?}", ledger.power);
    // The run is one in which something happened: every source took part.
    let unit = 1e-3 * kinetic;
    assert!(works.motors.abs() > unit && works.friction < -unit && works.gravity.abs() > unit);
    assert!(works.springs != 0.0 && works.external == 0.0);
    for (name, drift) in
        [("energy", energy), ("sources", by_source), ("linear", linear), ("angular", angular)]
    {
        assert!(drift.0 <= DRIFT, "{what}, {name}: {:e} is above {DRIFT:e}", drift.0);
    }
    works
}

/// The fall of a minute brings 3 m/s: as much energy as the motion inside.
#[test]
#[ignore = "long: `cargo xtask test --all`"]
fn books_close_over_a_minute_in_a_uniform_field() {
    let g = Vector3::new(0.03, -0.02, 0.04);
    let case = case(Gravity::Uniform(g), Vector3::zeros(), Vector3::new(0.1, 0.2, -0.1));
    let works = check(&case, "uniform", About::CentreOfMass);
    let impulse = g * (case.craft.mass() * DURATION);
    assert!((works.impulse - impulse).norm() <= DRIFT * impulse.norm(), "{}", works.impulse);
}

/// An ellipse of 10 to 20 m, once round in three quarters of a minute: a tenth of it is the
/// spacecraft, so that the gradient matters and the orbit's energy does not hide the rest.
#[test]
#[ignore = "long: `cargo xtask test --all`"]
fn books_close_over_a_minute_around_a_centre() {
    let mu = 60.0;
    let case =
        case(Gravity::Central { mu }, Vector3::new(0.0, 16.0, 12.0), Vector3::new(1.4, 0.0, 0.0));
    check(&case, "central", About::InertialOrigin);
}
