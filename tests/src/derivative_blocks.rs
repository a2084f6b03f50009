//! Errors of derivatives, block by block: one kind of output by one kind of variable.

use std::collections::BTreeMap;

use nalgebra::Vector3;
use precess_dynamics::{
    Devices, EnergyAndMomentum, Scalar, Spacecraft, Structure, Variable, Wrench,
};

use crate::blocks::largest;
use crate::differences::Named;
use crate::double_double::DoubleDouble as Wide;

/// Everything that is differentiated, with the name of the block of each number: the acceleration of B expressed in B
/// and in N, the angular one; those of joints and modes; energy and momenta; the loads on the joints, and on a hub
/// that is held.
pub fn named<T: Scalar, D: Devices<Scalar = T>, S: Structure>(
    craft: &Spacecraft<D, S>,
    [in_b, in_n, omega_dot]: [Vector3<T>; 3],
    [joints, modes]: [Vec<T>; 2],
    momentum: &EnergyAndMomentum<T>,
    (loads, held): (&[Wrench<T>], Option<Wrench<T>>),
) -> Named<T> {
    let mut list = Vec::new();
    let mut add = |name: &str, v: &Vector3<T>| list.extend(v.iter().map(|x| (name.to_owned(), *x)));
    add("r_b_n_ddot", &in_b);
    add("r_b_n_ddot_n", &in_n);
    add("omega_dot", &omega_dot);
    add("linear", &momentum.momentum.linear);
    add("angular", &momentum.momentum.angular);
    for (load, (_, info)) in loads.iter().zip(craft.joints()) {
        add(&format!("force {}", info.body), &load.force);
        add(&format!("moment {}", info.body), &load.moment);
    }
    if let Some(load) = held {
        add("force on the hub", &load.force);
        add("moment on the hub", &load.moment);
    }
    list.push(("energy".to_owned(), momentum.energy));
    let joints = joints.into_iter().zip(craft.joints());
    list.extend(joints.map(|(value, (_, info))| (info.acceleration.to_owned(), value)));
    list.extend(modes.into_iter().map(|value| ("eta_ddot".to_owned(), value)));
    list
}

/// The kind of a variable: by one of a kind, one kind of output is a block.
#[must_use]
pub fn kind<D: Devices, S: Structure>(craft: &Spacecraft<D, S>, variable: Variable) -> String {
    let name = craft.variable_name(variable).to_string();
    // Without the number of the device, and without the axis.
    let name: String = name.chars().filter(|c| !c.is_ascii_digit()).collect();
    let axis = [".x", ".y", ".z"].into_iter().find(|axis| name.ends_with(axis));
    match (axis, variable) {
        (Some(axis), v) if !matches!(v, Variable::Coordinate(_)) => {
            name.trim_end_matches(axis).to_owned()
        }
        _ => name,
    }
}

/// Differences of derivatives and the magnitude of their blocks, by kinds of output and variable.
#[derive(Debug, Default)]
pub struct Blocks(BTreeMap<(String, String), Block>);

/// The derivatives of one kind of output by one kind of variable.
#[derive(Clone, Copy, Debug, Default)]
struct Block {
    /// Largest difference.
    difference: f64,
    /// Largest magnitude expected.
    unit: f64,
    /// The size of the variable.
    size: f64,
}

/// Below this share of what an output changes by all variables, a derivative is zero: what the
/// differences leave of it is 1e-24.
const ZERO: f64 = 1e-15;
/// The same of the load on a held hub. Its derivative by the hub's inertia, by the gradient of a field, is a share of 1e-14,
/// and the differences are off by up to 7e-22.
const ZERO_OF_HUB: f64 = 1e-11;

impl Blocks {
    /// Takes one column, by a variable of a kind and of a size.
    ///
    /// # Panics
    /// If the two have other blocks.
    pub fn add(&mut self, kind: &str, size: f64, found: &Named<f64>, expected: &Named<Wide>) {
        assert_eq!(found.len(), expected.len());
        for ((name, found), (expected_name, expected)) in found.iter().zip(expected) {
            assert_eq!(name, expected_name);
            let block = self.0.entry((name.clone(), kind.to_owned())).or_default();
            let apart = (Wide::from_f64(*found) - *expected).abs().to_f64();
            block.difference = largest([block.difference, apart]);
            block.unit = largest([block.unit, expected.abs().to_f64()]);
            block.size = size;
        }
    }

    /// The error of each block with its name, in units of its largest magnitude.
    ///
    /// Energy and momenta are sums over all bodies of terms that cancel: their unit is the largest
    /// change of the output by any variable's size. So is that of a load by what a central field
    /// depends on, as the weights cancel in what falls; and the unit of a block that is zero.
    pub fn errors(&self) -> impl Iterator<Item = (f64, String)> {
        self.errors_in(|output, variable, block, change| {
            let of_field = ["gravity.mu", "r_b_n", "attitude"].contains(&variable);
            let load = output.starts_with("force ") || output.starts_with("moment ");
            let sum = ["energy", "linear", "angular"].contains(&output) || (load && of_field);
            let zero = if output.ends_with(" on the hub") { ZERO_OF_HUB } else { ZERO };
            if sum || block <= zero * change { change } else { block }
        })
    }

    /// The same with that unit for all: a rotor that moves in all six freedoms acts on what carries it through its
    /// bearings alone, so that inertia and gyroscopic torque cancel in every row of hub and gimbal.
    pub fn errors_of_changes(&self) -> impl Iterator<Item = (f64, String)> {
        self.errors_in(|_, _, _, change| change)
    }

    /// In units made of output, variable, the block's largest magnitude, and the largest change of the
    /// output by any variable's size.
    fn errors_in(
        &self,
        unit: impl Fn(&str, &str, f64, f64) -> f64,
    ) -> impl Iterator<Item = (f64, String)> {
        self.0.iter().map(move |((output, variable), block)| {
            let row = self.0.iter().filter(|((other, _), _)| other == output);
            let change = largest(row.map(|(_, block)| block.unit * block.size)) / block.size;
            let unit = unit(output, variable, block.unit, change);
            let error = if block.difference == 0.0 { 0.0 } else { block.difference / unit };
            (error, format!("{output} by {variable}"))
        })
    }
}
