//! The guards on results: finite inputs whose result is not finite are rejected, by every function.

use nalgebra::{Matrix3, Vector3};

use crate::equations::error::{Quantity, SolveError};
use crate::results::momentum::About;
use crate::{Dgvscmg, Hub, Inputs, Spacecraft, State};

fn hub() -> Hub {
    Hub {
        m_b: 20.0,
        r_bc_b: Vector3::new(0.1, -0.2, 0.3),
        i_b_bc: Matrix3::new(4.0, 0.3, -0.2, 0.3, 5.0, 0.6, -0.2, 0.6, 7.0),
    }
}

fn without_devices(hub: Hub) -> Spacecraft<[Dgvscmg; 0]> {
    Spacecraft::new(&hub, &[]).unwrap()
}

/// State of a hub without devices: at rest, then changed.
fn state(change: fn(&mut State<[Dgvscmg; 0]>)) -> State<[Dgvscmg; 0]> {
    let mut state = State::at_rest();
    change(&mut state);
    state
}

fn rejected<R>(result: Result<R, SolveError>, what: Quantity) {
    assert_eq!(result.map(|_| ()), Err(SolveError::Overflow { what }));
}

#[test]
fn accelerations_that_overflow_are_rejected() {
    let turning = state(|s| s.omega.x = 1e200);
    rejected(
        without_devices(hub()).accelerations(&turning, &Inputs::none()),
        Quantity::HubAcceleration,
    );

    // Only one of the two vectors.
    let light = Hub { m_b: 1e-3, r_bc_b: Vector3::zeros(), ..hub() };
    let force = Vector3::new(1e308, 0.0, 0.0);
    let pushed = Inputs { force, ..Inputs::none() };
    rejected(
        without_devices(light).accelerations(&State::<[Dgvscmg; 0]>::at_rest(), &pushed),
        Quantity::HubAcceleration,
    );

    // It does not reach the hub: what overflows is the wheel's own acceleration.
    let light = Dgvscmg::bare_wheel(4.0, Matrix3::identity() * 1e-5);
    let spacecraft = Spacecraft::new(&hub(), &[light]).unwrap();
    let mut torques = Inputs::<[Dgvscmg; 1]>::none();
    torques.motors[0].u_w = 1e305;
    let wheel = Quantity::JointAcceleration { device: 0, joint: "wheel" };
    rejected(spacecraft.accelerations(&State::<[Dgvscmg; 1]>::at_rest(), &torques), wheel);
}

/// A pivot that is not finite is no singularity.
#[test]
fn pivots_that_overflow_are_not_called_singular() {
    for hub in
        [Hub { m_b: 1e-310, ..hub() }, Hub { r_bc_b: Vector3::new(1e160, 0.0, 0.0), ..hub() }]
    {
        let found =
            without_devices(hub).accelerations(&State::<[Dgvscmg; 0]>::at_rest(), &Inputs::none());
        rejected(found, Quantity::HubAcceleration);
    }
}

#[test]
fn energy_that_overflows_is_rejected() {
    rejected(without_devices(hub()).energy(&state(|s| s.r_b_n_dot.x = 1e200)), Quantity::Energy);
}

#[test]
fn momentum_that_overflows_is_rejected() {
    let momentum = |change| without_devices(hub()).momentum(&state(change), About::InertialOrigin);
    rejected(momentum(|s| s.r_b_n_dot.x = 1e308), Quantity::Momentum);
    rejected(momentum(|s| (s.r_b_n_dot.x, s.r_b_n.y) = (1e200, 1e200)), Quantity::Momentum);
}

#[test]
fn centre_of_mass_that_overflows_is_rejected() {
    let far = Hub { r_bc_b: Vector3::new(1e308, 0.0, 0.0), ..hub() };
    rejected(
        without_devices(far).centre_of_mass(&State::<[Dgvscmg; 0]>::at_rest()),
        Quantity::CentreOfMass,
    );

    let disc = Matrix3::from_diagonal(&Vector3::new(0.2, 0.1, 0.1));
    let wide = Dgvscmg { d: 10.0, ..Dgvscmg::bare_wheel(4.0, disc) };
    let mut state = State::<[Dgvscmg; 1]>::at_rest();
    state.devices[0].spin = 1e308;
    rejected(
        Spacecraft::new(&hub(), &[wide]).unwrap().centre_of_mass(&state),
        Quantity::CentreOfMass,
    );
}
