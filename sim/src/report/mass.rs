//! Mass properties of the spacecraft with its joints at their initial coordinates, and the mass and
//! imbalance of each device.

use nalgebra::{Matrix3, Vector3};
use precess_dynamics::{
    About, Attitude, BuiltIn, Imbalance, ImbalanceModel, Quaternion, SolveError, State, units,
};

use super::blocks::{Block, table};
use super::number;
use crate::scenario::{Scenario, Set};

/// Of the whole spacecraft.
struct Properties {
    /// kg.
    mass: f64,
    /// Centre of mass from B, m.
    centre: Vector3<f64>,
    /// About B, kg m².
    about_b: Matrix3<f64>,
}

/// The tables; empty for a scenario that the solver rejects.
pub(super) fn blocks(scenario: &Scenario) -> Vec<Block> {
    let Some(properties) = properties(scenario) else { return Vec::new() };
    vec![whole(scenario, &properties), devices(scenario)]
}

/// Inertia about B is the angular momentum about B per angular velocity, joints at rest.
fn properties(scenario: &Scenario) -> Option<Properties> {
    let spacecraft = scenario.spacecraft().ok()?;
    let mut state: State<Set> = scenario.initial.clone();
    state.r_b_n = Vector3::zeros();
    state.r_b_n_dot = Vector3::zeros();
    state.attitude = Quaternion::identity();
    for joint in state.devices.iter_mut().flat_map(precess_dynamics::JointArray::as_mut_slice) {
        joint[1] = 0.0;
    }
    let mut column = |axis: usize| -> Result<Vector3<f64>, SolveError> {
        state.omega = Vector3::zeros();
        state.omega[axis] = 1.0;
        Ok(spacecraft.momentum(&state, About::InertialOrigin)?.angular)
    };
    let columns = [column(0).ok()?, column(1).ok()?, column(2).ok()?];
    Some(Properties {
        mass: spacecraft.mass(),
        centre: spacecraft.centre_of_mass(&state).ok()?.c,
        about_b: Matrix3::from_columns(&columns),
    })
}

fn whole(scenario: &Scenario, properties: &Properties) -> Block {
    let Properties { mass, centre, about_b } = properties;
    let shift = Matrix3::identity() * centre.norm_squared() - centre * centre.transpose();
    let about_c = about_b - shift * *mass;
    let hub = &scenario.hub;
    let row = |what: &str, mass: f64, centre: &Vector3<f64>, inertia: &Matrix3<f64>| {
        let mut cells = vec![what.to_owned(), number::short(mass, 7)];
        cells.extend(centre.iter().map(|part| number::short(1e3 * part, 5)));
        let entries = [(0, 0), (1, 1), (2, 2), (0, 1), (0, 2), (1, 2)];
        // What is left of a sum that cancels is rounding.
        let least = 1e-13 * inertia.amax();
        let entry = |at: (usize, usize)| if inertia[at].abs() < least { 0.0 } else { inertia[at] };
        cells.extend(entries.map(|at| number::short(entry(at), 6)));
        ("", cells)
    };
    let rows = [
        row("spacecraft, about B", *mass, centre, about_b),
        row("spacecraft, about its centre of mass", *mass, centre, &about_c),
        row("hub, about its centre of mass", hub.m_b, &hub.r_bc_b, &hub.i_b_bc),
    ];
    let columns = [
        ("Body and point", ""),
        ("Mass", "kg"),
        ("x", "mm"),
        ("y", "mm"),
        ("z", "mm"),
        ("I₁₁", "kg m²"),
        ("I₂₂", "kg m²"),
        ("I₃₃", "kg m²"),
        ("I₁₂", "kg m²"),
        ("I₁₃", "kg m²"),
        ("I₂₃", "kg m²"),
    ];
    let caption = "Mass, centre of mass from B and inertia, expressed in B, joints as at the start; \
                   products are elements of the tensor";
    table(caption, &columns, 1..11, rows)
}

fn devices(scenario: &Scenario) -> Block {
    let rows = scenario.names.iter().zip(&scenario.devices).map(|(name, device)| {
        let joints = device.kind().joints();
        let parameters = device.parameters();
        let mass: f64 = parameters.bodies.iter().take(joints.len()).map(|body| body.mass).sum();
        let mut cells = vec![name.clone(), device.kind().name().to_owned(), number::short(mass, 7)];
        match imbalance(device) {
            Some(Imbalance { u_s, u_d, phase }) => {
                cells.push(number::short(units::to_g_cm(u_s), 5));
                cells.push(number::short(units::to_g_cm2(u_d), 5));
                cells.push(number::short(units::to_deg(phase), 5));
                let lumped = parameters.model == ImbalanceModel::Lumped;
                cells.push(if lumped { "lumped" } else { "coupled" }.to_owned());
            }
            None => cells.extend(["–"; 4].map(str::to_owned)),
        }
        ("", cells)
    });
    let columns = [
        ("Device", ""),
        ("Kind", ""),
        ("Mass", "kg"),
        ("Static imbalance U_s", "g cm"),
        ("Dynamic imbalance U_d", "g cm²"),
        ("Phase", "deg"),
        ("Model", ""),
    ];
    table("Devices, and the imbalance of their wheels", &columns, 2..6, rows)
}

/// The imbalance of a device's wheel; none of a kind that is balanced or has no wheel.
fn imbalance(device: &BuiltIn) -> Option<Imbalance> {
    match device {
        BuiltIn::ReactionWheel(device) => device.imbalance().ok(),
        BuiltIn::Sgcmg(device) => device.imbalance().ok(),
        BuiltIn::Vscmg(device) => device.imbalance().ok(),
        BuiltIn::Dgcmg(device) => device.imbalance().ok(),
        BuiltIn::Dgvscmg(device) => device.imbalance().ok(),
        _ => None,
    }
}
