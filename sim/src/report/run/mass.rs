//! Mass properties of the spacecraft with its joints at their initial coordinates, and the mass and
//! imbalance of each device, and the inertia that each motor moves.

use nalgebra::{Matrix3, Vector3};
use precess_dynamics::{Imbalance, units};

use crate::report::blocks::{Block, table};
use crate::report::number;
use crate::scenario::mass::{MassMatrix, MassProperties, imbalance};
use crate::scenario::{Scenario, joint_key};

/// The tables; empty for a scenario that the solver rejects.
pub(in crate::report) fn blocks(scenario: &Scenario) -> Vec<Block> {
    let Ok(spacecraft) = scenario.spacecraft() else { return Vec::new() };
    let Ok(properties) = MassProperties::from_spacecraft(scenario, &spacecraft) else {
        return Vec::new();
    };
    let mut blocks = vec![whole(scenario, &properties), devices(scenario)];
    if let Ok(matrix) = MassMatrix::from_spacecraft(scenario, &spacecraft) {
        blocks.push(motors(scenario, &matrix));
    }
    blocks
}

fn whole(scenario: &Scenario, properties: &MassProperties) -> Block {
    let MassProperties { mass, centre_of_mass: centre, inertia_b: about_b } = properties;
    let shift = Matrix3::identity() * centre.norm_squared() - centre * centre.transpose();
    let about_c = about_b - shift * *mass;
    // Without what the model of a structure contains of the devices; the solver has accepted it.
    let hub = &scenario.bare_hub().unwrap_or(scenario.hub);
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
    let rows = scenario.members().map(|(name, member)| {
        let mass: f64 = member.bodies().iter().map(|body| body.mass).sum();
        let mut cells =
            vec![name.to_owned(), member.kind_name().to_owned(), number::short(mass, 7)];
        match member.device().as_ref().and_then(imbalance) {
            Some(Imbalance { u_s, u_d, phase }) => {
                cells.push(number::short(units::to_g_cm(u_s), 5));
                cells.push(number::short(units::to_g_cm2(u_d), 5));
                cells.push(number::short(units::to_deg(phase), 5));
                cells.push(if member.is_lumped() { "lumped" } else { "coupled" }.to_owned());
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

/// What each motor moves, and the condition of the mass matrix in the caption.
fn motors(scenario: &Scenario, matrix: &MassMatrix) -> Block {
    let cell =
        |inertia: Option<f64>| inertia.map_or_else(|| "–".to_owned(), |i| number::short(i, 5));
    let rows = scenario.joints().zip(&matrix.joints).map(|((_, name, info), inertia)| {
        let unit = if info.slides { "kg" } else { "kg m²" };
        let cells = [
            format!("{name}.{}", joint_key(info)),
            cell(inertia.held),
            cell(inertia.free),
            unit.to_owned(),
        ];
        ("", cells.to_vec())
    });
    let columns = [
        ("Joint", ""),
        ("Inertia, all else held", ""),
        ("Inertia, all else free", ""),
        ("Unit", ""),
    ];
    let condition = matrix.condition.map_or_else(String::new, |condition| {
        format!(
            "; condition number of the mass matrix, scaled to a unit diagonal: {}",
            number::short(condition, 3)
        )
    });
    let caption = format!("Inertia that each motor moves, joints as at the start{condition}");
    table(&caption, &columns, 1..3, rows)
}
