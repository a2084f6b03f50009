//! An orbit with fast wheels, without motors and friction: the sum of kinetic, potential and spring
//! energy is conserved, and so is angular momentum about the centre.

use core::f64::consts::TAU;

use nalgebra::{Matrix3, Rotation3, Vector3};
use precess_dynamics::{
    About, Attitude, BalancedVscmg, Dgvscmg, Gravity, HingedPanel, Hub, Inputs, Passive,
    Spacecraft, State, hinged_panel,
};

use super::bounds::{DRIFT, Worst};
use super::craft::Case;
use super::kinematics;
use super::run::run;

type Craft = (BalancedVscmg, Dgvscmg, HingedPanel);

/// Of the orbit, s: the field changes along the spacecraft by a tenth.
const PERIOD: f64 = 10.0;

fn case() -> Case<Craft> {
    let tensor = |x, y, z| Matrix3::from_diagonal(&Vector3::new(x, y, z));
    let v = Vector3::new;
    let hub = Hub { m_b: 60.0, r_bc_b: v(0.05, -0.03, 0.08), i_b_bc: tensor(6.0, 8.0, 7.0) };
    let balanced = BalancedVscmg {
        r_g_b: v(-0.3, 0.2, 0.1),
        m_g: 2.0,
        r_gc_g: v(0.02, 0.01, 0.01),
        i_g_gc: tensor(0.02, 0.03, 0.025),
        l_g: v(0.01, -0.02, 0.02),
        ..BalancedVscmg::bare_wheel(3.0, 0.02, 0.012)
    };
    let imbalanced = Dgvscmg {
        mount: *Rotation3::from_scaled_axis(v(0.3, -0.2, 0.9)).matrix(),
        r_go_b: v(0.4, 0.1, -0.2),
        m_go: 2.0,
        i_go_goc: tensor(0.02, 0.03, 0.025),
        m_gi: 1.0,
        i_gi_gic: tensor(0.02, 0.01, 0.015),
        l_i: v(0.01, 0.02, -0.02),
        d: 1e-4,
        ..Dgvscmg::bare_wheel(4.0, tensor(0.02, 0.012, 0.013))
    };
    let panel = HingedPanel {
        r_p_b: v(0.5, 0.5, 0.0),
        r_pc_p: v(0.6, 0.1, 0.02),
        passive: hinged_panel::PerJoint::all(Passive::spring(5.0, 0.0)),
        ..HingedPanel::bare_panel(3.0, tensor(0.2, 0.5, 0.6))
    };
    let devices = (balanced, imbalanced, panel);
    let craft = Spacecraft::new(&hub, &devices).expect("valid parameters");
    let mut state: State<Craft> = State::at_rest();
    let (far, mean) = (10.0, TAU / PERIOD);
    (state.r_b_n, state.r_b_n_dot) = (v(0.0, 0.8, 0.6) * far, v(mean * far, 0.0, 0.0));
    state.omega = v(0.2, -0.3, 0.25);
    state.devices.0.spin = 200.0;
    state.devices.1.spin = -250.0;
    state.devices.2.phi = 0.2;
    let gravity = Gravity::Central { mu: mean * mean * far * far * far };
    Case { seed: 0, hub, devices, craft, state, inputs: Inputs { gravity, ..Inputs::none() } }
}

#[test]
fn energy_and_angular_momentum_about_the_centre_stay_along_a_tenth_of_an_orbit() {
    energy_and_angular_momentum_stay(PERIOD / 10.0);
}

#[test]
#[ignore = "long: `cargo xtask test --all`"]
fn energy_and_angular_momentum_about_the_centre_stay_once_round() {
    energy_and_angular_momentum_stay(PERIOD);
}

fn energy_and_angular_momentum_stay(duration: f64) {
    let case = case();
    let (mut energy, mut angular) = (Worst::default(), Worst::default());
    let (mut start, mut kinetic, mut exchanged) = (None, 0.0_f64, 0.0_f64);
    let steps = run(&case, duration, |here, ledger, works| {
        let momentum = here.craft.momentum(&here.state, About::InertialOrigin).expect("finite");
        let (first, first_angular) = *start.get_or_insert((*ledger, momentum.angular));
        kinetic = kinetic.max(ledger.kinetic);
        energy.add((ledger.energy() - first.energy()).abs() / kinetic);
        let centre = -(here.state.attitude.dcm() * here.state.r_b_n);
        let [_, of_angular] = kinematics::momentum_units(here, &here.accelerations(), &centre);
        angular.add((momentum.angular - first_angular).norm() / of_angular);
        exchanged = exchanged.max(works.gravity.abs() / kinetic);
    });
    println!("orbit: {steps} steps; energy {:.1e}, angular {:.1e}", energy.0, angular.0);
    assert!(energy.0 <= DRIFT, "energy drifts by {:e}", energy.0);
    assert!(angular.0 <= DRIFT, "angular momentum drifts by {:e}", angular.0);
    // Gravity does work along the orbit: B's orbit is no circle of the whole.
    assert!(exchanged > 1e-3, "gravity exchanged {exchanged:e} of the energy");
}
