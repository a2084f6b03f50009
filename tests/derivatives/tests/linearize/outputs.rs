//! Everything that is differentiated, as a list with the name of the block of each number.

use nalgebra::Vector3;
use precess_dynamics::kind::Each;
use precess_dynamics::{About, Column, HubMode, LoadAxes, Outputs, Scalar, Spacecraft};
use precess_tests::derivative_blocks::named;
use precess_tests::differences::Named;

use crate::draw::{Case, List};

/// The outputs of every comparison.
pub(crate) const OUTPUTS: Outputs =
    Outputs { momentum: Some(About::InertialOrigin), loads: Some(LoadAxes::Body) };

/// The values at a state.
pub(crate) fn values<T: Scalar>(craft: &Spacecraft<List<T>>, case: &Case<T>) -> Named<T> {
    let Case { state, inputs, .. } = case;
    let expect = "regular";
    let found = craft.accelerations(state, inputs).expect(expect);
    let bn = precess_dynamics::Attitude::dcm(&state.attitude);
    let in_n = Vector3::from_fn(|k, _| {
        let [x, y, z] = [0, 1, 2].map(|row| bn[(row, k)] * found.r_b_n_ddot[row]);
        x + y + z
    });
    let momentum = craft.energy_and_momentum(state, About::InertialOrigin).expect(expect);
    let loads = craft.loads(state, inputs, &found, LoadAxes::Body).expect(expect);
    let joints: Vec<_> = loads.devices.iter().flat_map(|device| device.joints.values()).collect();
    let hub = [found.r_b_n_ddot, in_n, found.omega_dot];
    // What holds the hub.
    let held = (inputs.hub != HubMode::Free).then_some(loads.hub);
    named(craft, hub, [found.devices.values().collect(), vec![]], &momentum, (&joints, held))
}

/// The derivatives of a column, with a hub of that mode.
pub(crate) fn derivatives(
    craft: &Spacecraft<List>,
    hub: HubMode,
    column: &Column<List>,
) -> Named<f64> {
    let Column { accelerations, r_b_n_ddot_n, momentum, loads, hub_load } = column;
    let held = if hub == HubMode::Free { None } else { *hub_load };
    let hub = [accelerations.r_b_n_ddot, *r_b_n_ddot_n, accelerations.omega_dot];
    let joints = accelerations.devices.values().collect();
    let loads: Vec<_> = loads.iter().flat_map(Each::values).collect();
    named(craft, hub, [joints, vec![]], &momentum.expect("requested"), (&loads, held))
}
