//! [`Layout`]: where the numbers of a state are: in rows as flat states have them, in columns as kernels do.
//!
//! A row has, after the hub, for each device its coordinates and then its rates; columns have the coordinates of all joints
//! and then their rates. Number `k` of state `i` of `count` is at `k * count + i` of the columns.

use precess_dynamics::{Attitude as _, BuiltIn, Hub, Quaternion};

/// Numbers of the hub.
pub(crate) const HUB: usize = 13;

/// The numbers of a set of devices.
#[derive(Clone, Debug)]
pub(crate) struct Layout {
    /// The place in a row of each number of a column.
    places: Vec<usize>,
    /// Joints.
    pub(crate) joints: usize,
}

impl Layout {
    /// Of devices with so many joints each.
    pub(crate) fn new(joints: impl Iterator<Item = usize>) -> Self {
        let (mut coordinates, mut rates) = (Vec::new(), Vec::new());
        let mut next = HUB;
        for count in joints {
            coordinates.extend(next..next + count);
            rates.extend(next + count..next + 2 * count);
            next += 2 * count;
        }
        let joints = coordinates.len();
        Self { places: (0..HUB).chain(coordinates).chain(rates).collect(), joints }
    }

    /// Numbers of a state.
    pub(crate) fn size(&self) -> usize {
        self.places.len()
    }

    /// Numbers of accelerations, and of a row of inputs.
    pub(crate) fn width(&self) -> usize {
        6 + self.joints
    }

    /// States as columns.
    pub(crate) fn columns(&self, rows: &[f64]) -> Vec<f64> {
        let row = rows.chunks_exact(self.size());
        let column = |place: usize| row.clone().filter_map(move |row| row.get(place).copied());
        self.places.iter().copied().flat_map(column).collect()
    }

    /// Writes state `index` of the columns into a row.
    pub(crate) fn write(&self, columns: &[f64], (index, count): (usize, usize), row: &mut [f64]) {
        for (number, place) in self.places.iter().enumerate() {
            if let (Some(to), Some(from)) =
                (row.get_mut(*place), columns.get(number * count + index))
            {
                *to = *from;
            }
        }
    }
}

/// Rows of equal length as columns.
pub(crate) fn columns(rows: &[f64], width: usize) -> Vec<f64> {
    let row = rows.chunks_exact(width.max(1));
    (0..width).flat_map(|k| row.clone().filter_map(move |row| row.get(k).copied())).collect()
}

/// Row `index` of columns.
pub(crate) fn row(columns: &[f64], (index, count): (usize, usize), row: &mut [f64]) {
    for (number, to) in row.iter_mut().enumerate() {
        if let Some(from) = columns.get(number * count + index) {
            *to = *from;
        }
    }
}

/// Normalises the attitude of a row.
pub(crate) fn normalise(row: &mut [f64]) {
    if let Some([q0, q1, q2, q3]) = row.get_mut(6..10) {
        let of = Quaternion { q0: *q0, q1: *q1, q2: *q2, q3: *q3 }.normalised();
        (*q0, *q1, *q2, *q3) = (of.q0, of.q1, of.q2, of.q3);
    }
}

/// Parameters as kernels read them: see `NAME_batch.h`.
pub(crate) fn parameters(hub: &Hub, devices: &[BuiltIn]) -> Vec<f64> {
    let inertia = |i: &nalgebra::Matrix3<f64>| [i.m11, i.m12, i.m13, i.m22, i.m23, i.m33];
    let mut numbers = vec![hub.m_b];
    numbers.extend(hub.r_bc_b.iter());
    numbers.extend(inertia(&hub.i_b_bc));
    // A quaternion.
    numbers.push(0.0);
    let all: Vec<_> = devices.iter().map(|device| (device.kind(), device.parameters())).collect();
    // Columns first, as nalgebra stores them.
    numbers.extend(all.iter().flat_map(|(_, device)| device.mount.iter().copied()));
    for (kind, device) in &all {
        let bodies = device.bodies.iter().zip(&device.passive).take(kind.joints().len());
        for (body, passive) in bodies {
            numbers.push(body.mass);
            numbers.extend(body.origin);
            numbers.extend(body.centre);
            numbers.extend(inertia(&body.inertia));
            numbers.extend([passive.stiffness, passive.rest, passive.viscous]);
            numbers.extend([passive.coulomb, passive.coulomb_rate]);
        }
    }
    numbers
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn columns_are_read_back_as_the_rows() {
        // A device of two joints and one of one.
        let layout = Layout::new([2, 1].into_iter());
        assert_eq!(layout.size(), HUB + 6);
        let rows: Vec<f64> = (0..2 * 19).map(f64::from).collect();
        let columns = layout.columns(&rows);
        // The coordinate of the second device: after two coordinates and two rates of a row, third of the columns.
        assert_eq!(columns[2 * (HUB + 2)], rows[HUB + 4]);
        assert_eq!(columns[2 * (HUB + 3) + 1], rows[19 + HUB + 2]);
        for (index, expected) in rows.chunks(19).enumerate() {
            let mut row = [0.0; 19];
            layout.write(&columns, (index, 2), &mut row);
            assert_eq!(row, expected);
        }
    }

    #[test]
    fn rows_of_inputs_are_columns_and_rows_again() {
        let rows = [1.0, 2.0, 3.0, 4.0, 5.0, 6.0];
        let columns = columns(&rows, 3);
        assert_eq!(columns, [1.0, 4.0, 2.0, 5.0, 3.0, 6.0]);
        let mut second = [0.0; 3];
        row(&columns, (1, 2), &mut second);
        assert_eq!(second, [4.0, 5.0, 6.0]);
    }
}
