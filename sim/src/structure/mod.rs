//! [`Structure`]: the modes of a spacecraft's structure in a floating frame, and what files have them.
//!
//! A small displacement of the structure at the point `r` is, expressed in B,
//!
//! ```text
//! u(r, t) = q_r + theta_r x r + sum_k phi_k(r) eta_k(t)
//! ```
//!
//! with the rigid displacement `q_r`, `theta_r` of the floating frame and mass-normalised shapes
//! `phi_k`: `integral phi_j . phi_k dm` is 1 for `j = k` and 0 otherwise. Each mode has a linear and an
//! angular momentum integral, `P_k = integral phi_k dm` and `H_k = integral r x phi_k dm` about B.
//! Both vanish for the modes of a free structure. Their equations are
//!
//! ```text
//! [M_rr  L] [a_r ]   [0                               ]   [T^T f  ]
//! [L^T   1] [eta''] + [2 zeta_k w_k eta_k' + w_k^2 eta_k] = [Phi^T f]      L = [P_1 ..; H_1 ..]
//! ```
//!
//! with the rigid mass matrix `M_rr` about B, and the rows `T` and `Phi` of the nodes: rigid-body motion
//! and shapes. All in SI units and radians; axes are those of B, and B is the origin of positions.
//!
//! | file | module |
//! |---|---|
//! | NPZ | [`npz`] |
//! | Flex text of 42 | [`flex42`] |
//! | Nastran's op4, with a table that maps rows to nodes | [`op4`], [`table`](crate::file::structure_from_toml) |
//!
//! What follows from a structure: [`accelerance`], the dynamic mass of devices on it ([`averaged`]; of one
//! wheel in closed form [`dynamic_mass`]), and the force of a mounted wheel from that of a blocked one ([`mounted`]).

pub mod accelerance;
pub mod averaged;
mod bytes;
pub mod checks;
pub mod condensed;
pub mod dynamic_mass;
mod error;
pub mod flex42;
pub(crate) mod harmonics;
pub mod modes;
pub mod mounted;
pub mod npz;
pub mod op4;

use std::collections::HashSet;

use nalgebra::{DMatrix, Matrix3, Matrix6, Matrix6xX, Vector3};

use crate::names::{NAME_MAX, name_fault};

pub use bytes::{MOST_BYTES, bytes_of};
pub use error::{Fault, FileLocation, StructureError};

/// Coordinates of a node: three of translation, three of rotation.
pub const COORDINATES: usize = 6;
/// Their names, in order.
pub const COORDINATE_NAMES: [&str; COORDINATES] = ["x", "y", "z", "rx", "ry", "rz"];
/// Nodes and modes that a structure may have, each.
pub const MOST: usize = 10_000;

/// The modes of a structure.
#[derive(Clone, Debug, PartialEq)]
pub struct Structure {
    /// A description; may be empty.
    pub name: String,
    /// The nodes, with names that are unique.
    pub nodes: Vec<Node>,
    /// The modes.
    pub modes: Vec<Mode>,
    /// Mass-normalised shapes, six rows for each node and a column for each mode: translation, kg^-1/2,
    /// and rotation, rad m^-1 kg^-1/2, expressed in B.
    pub shapes: DMatrix<f64>,
    /// Rigid-body mass properties; none where the file has none.
    pub mass: Option<RigidMass>,
    /// Mass matrix of all coordinates of the nodes; none where the file has none. For checks only.
    pub mass_matrix: Option<DMatrix<f64>>,
    /// Residual flexibility: what the modes that are left out add to the displacement of the nodes by
    /// forces on them, m/N, rad/N, m/(N m), rad/(N m). None where the file has none.
    pub residual: Option<DMatrix<f64>>,
    /// Whether the model has the mass of the devices that will be mounted; none where nobody said.
    pub has_devices: Option<bool>,
    /// Coordinate, m kg^1/2, and rate of each mode at the start; empty where the file has none.
    pub initial: Vec<[f64; 2]>,
}

/// A point of the structure.
#[derive(Clone, Debug, PartialEq)]
pub struct Node {
    /// Its name.
    pub name: String,
    /// Its position from B, m.
    pub position: Vector3<f64>,
}

/// A mode.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Mode {
    /// Angular frequency without damping, rad/s; above zero.
    pub frequency: f64,
    /// Damping ratio; not below zero, below one.
    pub damping: f64,
    /// Linear momentum integral `P`, kg^1/2.
    pub linear: Vector3<f64>,
    /// Angular momentum integral `H` about B, kg^1/2 m.
    pub angular: Vector3<f64>,
}

/// Mass, first moment and inertia, of the structure without deformation.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RigidMass {
    /// Mass, kg.
    pub mass: f64,
    /// First moment about B, kg m: mass times position of the centre of mass.
    pub first_moment: Vector3<f64>,
    /// Inertia about B, kg m².
    pub inertia: Matrix3<f64>,
}

impl RigidMass {
    /// Of a body with its centre of mass at `centre`, m, and its inertia about that, kg m².
    #[must_use]
    pub fn about_centre(mass: f64, centre: Vector3<f64>, inertia: Matrix3<f64>) -> Self {
        let cross = centre.cross_matrix();
        let inertia = inertia - mass * cross * cross;
        Self { mass, first_moment: mass * centre, inertia }
    }

    /// The 6 × 6 mass matrix about B, of (acceleration of B, angular acceleration).
    #[must_use]
    pub fn matrix(&self) -> Matrix6<f64> {
        let mut matrix = Matrix6::zeros();
        let cross = self.first_moment.cross_matrix();
        matrix.fixed_view_mut::<3, 3>(0, 0).fill_diagonal(self.mass);
        matrix.fixed_view_mut::<3, 3>(0, 3).copy_from(&-cross);
        matrix.fixed_view_mut::<3, 3>(3, 0).copy_from(&cross);
        matrix.fixed_view_mut::<3, 3>(3, 3).copy_from(&self.inertia);
        matrix
    }

    /// The centre of mass from B, m.
    #[must_use]
    pub fn centre(&self) -> Vector3<f64> {
        self.first_moment / self.mass
    }
}

/// Motion of a point at `position`, m, by a rigid-body motion of B: `[1, -r~; 0, 1]`.
#[must_use]
pub fn rigid_rows(position: &Vector3<f64>) -> Matrix6<f64> {
    let mut rows = Matrix6::identity();
    rows.fixed_view_mut::<3, 3>(0, 3).copy_from(&-position.cross_matrix());
    rows
}

impl Structure {
    /// Coordinates and rates of all modes at the start; zeros where the file has none.
    #[must_use]
    pub fn states(&self) -> [Vec<f64>; 2] {
        [0, 1].map(|of| {
            let state = |mode| self.initial.get(mode).map_or(0.0, |state: &[f64; 2]| state[of]);
            (0..self.modes.len()).map(state).collect()
        })
    }

    /// Keeps the modes of these numbers, in this order.
    pub(crate) fn keep(&mut self, modes: &[usize]) {
        self.shapes = self.shapes.select_columns(modes);
        self.modes = modes.iter().filter_map(|mode| self.modes.get(*mode).copied()).collect();
        self.initial = modes.iter().filter_map(|mode| self.initial.get(*mode).copied()).collect();
    }

    /// Number of a node.
    ///
    /// # Errors
    /// [`Fault::UnknownNode`], with the names that there are.
    pub fn node(&self, name: &str) -> Result<usize, Fault> {
        self.nodes.iter().position(|node| node.name == name).ok_or_else(|| Fault::UnknownNode {
            name: name.to_owned(),
            nodes: self.nodes.iter().map(|node| node.name.clone()).collect(),
        })
    }

    /// Momentum integrals of all modes, `L`: a column each, linear above angular.
    #[must_use]
    pub fn momenta(&self) -> Matrix6xX<f64> {
        let mut momenta = Matrix6xX::zeros(self.modes.len());
        for (mode, mut column) in self.modes.iter().zip(momenta.column_iter_mut()) {
            column.fixed_rows_mut::<3>(0).copy_from(&mode.linear);
            column.fixed_rows_mut::<3>(3).copy_from(&mode.angular);
        }
        momenta
    }

    /// Rigid-body motion of all nodes: six rows for each.
    #[must_use]
    pub fn rigid_shapes(&self) -> DMatrix<f64> {
        let mut rows = DMatrix::zeros(COORDINATES * self.nodes.len(), COORDINATES);
        for (index, node) in self.nodes.iter().enumerate() {
            rows.fixed_view_mut::<6, 6>(COORDINATES * index, 0)
                .copy_from(&rigid_rows(&node.position));
        }
        rows
    }

    /// The structure where every number is finite and within its bounds and every size fits.
    ///
    /// # Errors
    /// The first [`Fault`].
    pub fn checked(self) -> Result<Self, Fault> {
        let [nodes, modes] = [self.nodes.len(), self.modes.len()];
        for (what, found) in [("nodes", nodes), ("modes", modes)] {
            if found == 0 || found > MOST {
                return Err(Fault::Number { what: what.into(), found, range: [1, MOST] });
            }
        }
        let mut names = HashSet::new();
        for node in &self.nodes {
            if let Some(fault) = name_fault(&node.name) {
                let name = node.name.escape_debug().take(NAME_MAX).collect();
                return Err(Fault::Name { name, reason: fault.to_string() });
            }
            finite(node.position.iter(), || format!("position of node `{}`", node.name))?;
            if !names.insert(node.name.as_str()) {
                return Err(Fault::NameTwice { name: node.name.clone() });
            }
        }
        for (index, mode) in self.modes.iter().enumerate() {
            let number = index + 1;
            finite(mode.linear.iter().chain(mode.angular.iter()), || {
                format!("momentum integral of mode {number}")
            })?;
            let what = format!("angular frequency of mode {number}, rad/s,");
            within(what, mode.frequency, [f64::MIN_POSITIVE, 1e12])?;
            // From one on a mode does not oscillate.
            within(format!("damping ratio of mode {number}"), mode.damping, [0.0, 0.999_999])?;
        }
        let size = COORDINATES * nodes;
        sized("shapes", &self.shapes, [size, modes])?;
        for (what, matrix) in
            [("mass matrix", &self.mass_matrix), ("residual flexibility", &self.residual)]
        {
            if let Some(matrix) = matrix {
                sized(what, matrix, [size, size])?;
                symmetric(what, matrix)?;
            }
        }
        if let Some(mass) = &self.mass {
            within("mass, kg,".into(), mass.mass, [f64::MIN_POSITIVE, 1e12])?;
            finite(mass.first_moment.iter(), || "first moment".into())?;
            finite(mass.inertia.iter(), || "inertia".into())?;
            symmetric("inertia", &DMatrix::from_column_slice(3, 3, mass.inertia.as_slice()))?;
        }
        Ok(self)
    }
}

/// What rounding may make of a symmetric matrix, of its largest element: six digits, as files have them.
const SKEW_MAX: f64 = 1e-6;

fn symmetric(what: &'static str, matrix: &DMatrix<f64>) -> Result<(), Fault> {
    let skew = (matrix - matrix.transpose()).amax();
    if skew > SKEW_MAX * matrix.amax() {
        return Err(Fault::Skew { what, skew, bound: SKEW_MAX * matrix.amax() });
    }
    Ok(())
}

fn sized(what: &'static str, matrix: &DMatrix<f64>, wanted: [usize; 2]) -> Result<(), Fault> {
    let found = [matrix.nrows(), matrix.ncols()];
    if found != wanted {
        return Err(Fault::Shape { what: what.into(), found: found.into(), wanted: wanted.into() });
    }
    finite(matrix.iter(), || what.into())
}

fn finite<'a>(
    mut values: impl Iterator<Item = &'a f64>,
    what: impl Fn() -> String,
) -> Result<(), Fault> {
    match values.find(|value| !value.is_finite()) {
        Some(value) => Err(Fault::NotFinite { what: what(), value: *value }),
        None => Ok(()),
    }
}

pub(crate) fn within(what: String, value: f64, range: [f64; 2]) -> Result<(), Fault> {
    if (range[0]..=range[1]).contains(&value) {
        return Ok(());
    }
    Err(Fault::Range { what, value, range })
}
