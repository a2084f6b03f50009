//! A platform as a `[[platform]]` table: every default written out, in SI units.

use std::fmt::Write as _;

use nalgebra::{Matrix6, Vector3};
use precess_dynamics::kind::{Each, Kind};
use precess_dynamics::{Coupled, Platform, Strut, Suspension};

use super::write::{Written, inertia, mount, of_joint, quoted, structure, vector};
use crate::scenario::{Scenario, joint_key};

/// The table of a platform on the hub or on the platform of a number, by its numbers as a member and of its first
/// joint.
pub(super) fn platform(
    out: &mut String,
    s: &Scenario,
    name: &str,
    (platform, suspension, on): (&Platform, &Suspension, Option<usize>),
    [member, first]: [usize; 2],
) -> Written {
    writeln!(out, "\n[[platform]]\nname = {}", quoted(name))?;
    if let Some(base) = on.and_then(|on| s.names.get(on)) {
        writeln!(out, "on = {}", quoted(base))?;
    }
    writeln!(out, "position = {}", vector(&platform.r_p_b, "m"))?;
    if on.is_none() {
        structure::node(out, s, member)?;
    }
    mount(out, &platform.mount)?;
    writeln!(out, "mass = \"{:?} kg\"", platform.m_p)?;
    writeln!(out, "centre_of_mass = {}", vector(&platform.r_pc_p, "m"))?;
    inertia(out, &platform.i_p_pc)?;
    let infos = <Platform as Kind>::JOINTS;
    for (index, (info, passive)) in infos.iter().zip(platform.passive.values()).enumerate() {
        writeln!(out, "\n[platform.{}]", joint_key(info))?;
        of_joint(out, s, first + index, (info, &passive))?;
    }
    if let Some(of) = &suspension.coupled {
        coupled(out, of)?;
    }
    suspension.struts.iter().flatten().try_for_each(|of| strut(out, of))
}

fn coupled(out: &mut String, of: &Coupled) -> Written {
    let [x, y, z, alpha, beta, gamma] = of.rest.into();
    writeln!(out, "\n[platform.coupled]")?;
    writeln!(out, "rest_slides = {}", vector(&Vector3::new(x, y, z), "m"))?;
    writeln!(out, "rest_turns = {}", vector(&Vector3::new(alpha, beta, gamma), "rad"))?;
    matrix(out, "stiffness", &of.stiffness, ["N/m", "N/rad", "N m/rad"])?;
    matrix(out, "damping", &of.damping, ["N s/m", "N s/rad", "N m s/rad"])
}

/// A symmetric matrix by its blocks, row by row.
fn matrix(out: &mut String, key: &str, m: &Matrix6<f64>, units: [&str; 3]) -> Written {
    writeln!(out, "\n[platform.coupled.{key}]")?;
    let blocks = [("slides", 0, 0), ("coupling", 0, 3), ("turns", 3, 3)];
    for ((name, row, column), unit) in blocks.into_iter().zip(units) {
        let rows = [0, 1, 2].map(|k| {
            let block = m.fixed_view::<3, 3>(row, column);
            vector(&block.row(k).transpose(), unit)
        });
        writeln!(out, "{name} = [{}]", rows.join(", "))?;
    }
    Ok(())
}

fn strut(out: &mut String, of: &Strut) -> Written {
    let Strut { position, direction, length, stiffness, damping } = of;
    writeln!(out, "\n[[platform.strut]]\nposition = {}", vector(position, "m"))?;
    let [x, y, z] = (*direction).into();
    writeln!(out, "direction = [{x:?}, {y:?}, {z:?}]\nlength = \"{length:?} m\"")?;
    writeln!(out, "stiffness = \"{stiffness:?} N/m\"\ndamping = \"{damping:?} N s/m\"")
}
