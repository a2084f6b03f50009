//! The example of the page as the Rust library computes it.

use nalgebra::{Matrix3, Vector3};
use precess_dynamics::{Gravity, Hub, Inputs, ReactionWheel, Spacecraft, State};

/// Rate of the wheel, and of the hub about x, after the steps of the example.
pub(crate) fn in_rust() -> [f64; 2] {
    let tensor = Matrix3::new(0.0069, 2e-8, -1.5e-8, 2e-8, 0.0041, 0.0, -1.5e-8, 0.0, 0.0041);
    let mut wheel = ReactionWheel {
        r_w_b: Vector3::new(0.3, 0.0, 0.0),
        d: 3e-7,
        ..ReactionWheel::bare_wheel(2.6, tensor)
    };
    wheel.passive.wheel.viscous = 1e-5;
    let hub = Hub {
        m_b: 120.0,
        r_bc_b: Vector3::zeros(),
        i_b_bc: Matrix3::from_diagonal(&Vector3::new(14.0, 16.0, 11.0)),
    };
    let craft = Spacecraft::new(&hub, &[wheel]).expect("a spacecraft");
    let mut state: State<[ReactionWheel; 1]> = State::at_rest();
    (state.r_b_n.x, state.r_b_n_dot.y) = (7e6, 7546.0);
    let mut inputs: Inputs<[ReactionWheel; 1]> = Inputs::none();
    inputs.gravity = Gravity::Central { mu: 3.986_004_418e14 };
    inputs.motors[0].u_w = 0.01;
    for _ in 0..1000 {
        state = craft.step(&state, &inputs, 0.01).expect("a step");
    }
    [state.devices[0].spin, state.omega.x]
}
