//! The system of `6 + 3 N` equations, assembled row by row from the paper's own statements.

use precess_dynamics::Scalar;

use super::Snapshot;
use super::affine::{Affine, R_B_N_DDOT, UNKNOWNS};
use super::bodies::{Body, Device, Point};
use super::vector::{Vector, cross};
use crate::blocks::largest;

/// `matrix * unknowns = right`, rows and unknowns in the order force, moment, then `u_z`, `u_y`,
/// `u_x` of each device.
#[derive(Clone, Debug)]
pub struct System<T> {
    /// Square, by rows.
    pub matrix: Vec<Vec<T>>,
    /// One entry a row.
    pub right: Vec<T>,
}

impl<T: Scalar> System<T> {
    /// All equations of one snapshot.
    #[must_use]
    pub fn new(snapshot: &Snapshot<T>) -> Self {
        let size = 6 + 3 * snapshot.devices.len();
        let zero = T::from_f64(0.0);
        let mut system = Self { matrix: vec![vec![zero; size]; size], right: vec![zero; size] };
        system.translation(snapshot);
        system.rotation(snapshot);
        for j in 0..snapshot.devices.len() {
            system.motors(snapshot, j);
        }
        system
    }

    /// Backward error of accelerations: the largest `abs(M q'' - h)` of any row, in units
    /// of the row's `abs(M) abs(q'') + abs(h)`.
    #[must_use]
    pub fn backward_error(&self, accelerations: &[T]) -> f64 {
        let rows = self.matrix.iter().zip(&self.right).map(|(row, right)| {
            let products = || row.iter().zip(accelerations).map(|(m, x)| *m * *x);
            let residual = products().fold(-*right, |sum, product| sum + product);
            let unit = products().fold(right.abs(), |sum, product| sum + product.abs());
            (residual.abs() * unit.recip()).to_f64()
        });
        largest(rows)
    }

    /// (6), (8): `m_sc (r_B'' + c'') = F`, with `m_sc c''` summed body by body, (7), (9)-(11).
    fn translation(&mut self, snapshot: &Snapshot<T>) {
        self.force_and_moment(0, snapshot, |body| {
            body.centre.ddot(snapshot.omega) * body.mass + r_b_n_ddot() * body.mass
        });
        self.known(0, snapshot.force);
    }

    /// (75): `m_sc c x r_B'' + sum of H_dot = L_B`, with `m_sc c` summed body by body, (9).
    fn rotation(&mut self, snapshot: &Snapshot<T>) {
        let b = Point::fixed(Vector::zero());
        self.force_and_moment(3, snapshot, |body| {
            let first_moment = body.centre.r * body.mass;
            r_b_n_ddot().map(|a| cross(first_moment, a)) + body.h_dot_about(&b, snapshot.omega)
        });
        self.known(3, snapshot.torque_b);
    }

    /// (80), (101), (119): the motor torques of one device.
    fn motors(&mut self, snapshot: &Snapshot<T>, j: usize) {
        let device = &snapshot.devices[j];
        for joint in 0..3 {
            let row = 6 + 3 * j + joint;
            let moment = moment_about_origin(device, joint, snapshot.omega);
            self.row(row, j, moment.along(device.axes[joint]));
            let (torque, _) = snapshot.motors[j][joint];
            self.right[row] = self.right[row] + torque;
        }
    }

    /// Adds the same expression of every body to three rows.
    fn force_and_moment(
        &mut self,
        row: usize,
        snapshot: &Snapshot<T>,
        of: impl Fn(&Body<T>) -> Affine<T>,
    ) {
        let hub = core::iter::once((0, &snapshot.hub));
        let carried = snapshot.devices.iter().enumerate();
        let carried = carried.flat_map(|(j, device)| device.bodies.iter().map(move |b| (j, b)));
        for (j, body) in hub.chain(carried) {
            let vector = of(body);
            for axis in 0..3 {
                self.row(row + axis, j, vector.along(Vector::unit(axis)));
            }
        }
    }

    /// Adds a scalar expression of device `j` to the left side of a row; what is known changes
    /// sides.
    fn row(&mut self, row: usize, j: usize, (coefficients, rest): ([T; UNKNOWNS], T)) {
        for (index, coefficient) in coefficients.into_iter().enumerate() {
            let column = if index < 6 { index } else { index + 3 * j };
            if let Some(entry) = self.matrix[row].get_mut(column) {
                *entry = *entry + coefficient;
            }
        }
        self.right[row] = self.right[row] - rest;
    }

    /// Adds a known vector to the right side of three rows.
    fn known(&mut self, row: usize, vector: Vector<T>) {
        for (axis, component) in vector.0.into_iter().enumerate() {
            self.right[row + axis] = self.right[row + axis] + component;
        }
    }
}

fn r_b_n_ddot<T: Scalar>() -> Affine<T> {
    Affine::unknown_vector(R_B_N_DDOT)
}

/// (78), (99), (117): the moment about the joint's origin of all bodies outboard of the joint.
///
/// About the common centre of mass of the carried bodies (D of all three, V of inner gimbal and
/// wheel, Wc for the wheel only) their angular momenta change by (79), (100), (118); to this comes
/// the moment of their common acceleration. Print writes `r_{D/N}''` in (99) for `r_{V/N}''`, and
/// drops the dot over `H` on the left of (81) and (102).
fn moment_about_origin<T: Scalar>(device: &Device<T>, joint: usize, omega: Vector<T>) -> Affine<T> {
    let carried = &device.bodies[joint..];
    let (mass, centre) = Point::centre_of_mass(carried);
    let arm = centre - device.origins[joint];

    let acceleration = centre.ddot(omega) + r_b_n_ddot();
    let of_centre = acceleration.map(|a| cross(arm.r, a)) * mass;
    carried.iter().fold(of_centre, |sum, body| sum + body.h_dot_about(&centre, omega))
}
