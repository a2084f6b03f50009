//! The imaging satellite, four DGVSCMGs with locked gimbals, by the kernels of its kind.

use std::path::Path;

use nalgebra::Matrix3;
use precess_description::Description;
use precess_dynamics::kind::BodyParameters;
use precess_dynamics::{
    BuiltIn, BuiltInKind, Dgvscmg, Each as _, Hub, Inputs, JointStates as _, Mode, Spacecraft,
    State,
};

use super::Rejected;
use super::parameters::parameters;
use super::single_state::SingleState;

/// How many devices it has.
pub(super) const DEVICES: usize = 4;
/// Angular velocity of the hub, rad/s.
pub(super) const OMEGA: [f64; 3] = [0.02, -0.03, 0.01];
/// Force on the hub, N.
pub(super) const FORCE: [f64; 3] = [1.0, -2.0, 0.5];
/// Torque on the hub about B, N m.
pub(super) const TORQUE_B: [f64; 3] = [0.3, 0.1, -0.2];
/// Angle, rate and motor torque of each wheel, rad, rad/s, N m.
pub(super) const WHEELS: [[f64; 3]; DEVICES] =
    [[0.3, 300.0, 0.02], [-1.2, -250.0, -0.01], [2.0, 200.0, 0.03], [0.7, -310.0, 0.015]];

/// Its description.
pub(super) fn read(path: &Path) -> Result<Description, Rejected> {
    let text = std::fs::read_to_string(path);
    let text = text.map_err(|error| format!("{}: {error}", path.display()))?;
    Ok(Description::read(&text)?)
}

/// The satellite in its state.
pub(super) fn open(description: &Description) -> Result<SingleState<[Dgvscmg; DEVICES]>, Rejected> {
    let matrix = |rows: &[[f64; 3]; 3]| Matrix3::from_fn(|row, column| rows[row][column]);
    let hub = Hub {
        m_b: description.hub.mass,
        r_bc_b: description.hub.centre_of_mass.into(),
        i_b_bc: matrix(&description.hub.inertia),
    };
    let device = |device: &precess_description::Device| {
        let bodies = device.body.iter().map(|body| BodyParameters {
            origin: body.origin,
            mass: body.mass,
            centre: body.centre_of_mass,
            inertia: matrix(&body.inertia),
        });
        match BuiltIn::new(BuiltInKind::Dgvscmg, &parameters(matrix(&device.mount), bodies))? {
            BuiltIn::Dgvscmg(device) => Ok(device),
            _ => Err(Rejected::from("another kind")),
        }
    };
    let devices: Result<Vec<_>, _> = description.device.iter().map(device).collect();
    let devices: [Dgvscmg; DEVICES] =
        devices?.try_into().map_err(|_| "another number of devices")?;
    let craft = Spacecraft::new(&hub, &devices)?;
    let mut state = State { omega: OMEGA.into(), ..State::at_rest_for(&craft) };
    let (force, torque_b) = (FORCE.into(), TORQUE_B.into());
    let mut inputs = Inputs { force, torque_b, ..Inputs::none_for(&craft) };
    let bodies = || description.device.iter().flat_map(|device| &device.body);
    let mut wheels = WHEELS.into_iter();
    let joints = state.devices.states_mut().zip(inputs.motors.values_mut());
    for ((([at, rate], motor), mode), body) in joints.zip(inputs.modes.values_mut()).zip(bodies()) {
        if let Some(locked) = body.locked_at {
            (*at, *mode) = (locked, Mode::Locked);
        } else if let Some(wheel) = wheels.next() {
            [*at, *rate, *motor] = wheel;
        }
    }
    Ok(SingleState { craft, state, inputs })
}
