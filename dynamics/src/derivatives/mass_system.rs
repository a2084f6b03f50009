//! [`MassSystem`]: what accelerations change by where the loads change, all else given: `-M⁻¹ δ(loads)`.
//!
//! The joints of each device are eliminated into the hub's six equations, as an evaluation does it; joints and a hub
//! whose accelerations are given have no row.

use alloc::vec::Vec;

use crate::derivatives::load_columns::{Load, LoadColumns};
use crate::equations::hub::HubConstants;
use crate::equations::system::System;
use crate::model::joint_array::MAX_JOINTS;
use crate::numbers::real::{Scalar, one, zero};
use crate::numbers::symmetric::Symmetric;

/// Numbers of the hub: along the axes of B of the translation, then of the rotation.
pub(super) type Six<T> = [T; 6];

/// How many joints are computed side by side.
const TOGETHER: usize = 4;

/// The mass matrix, eliminated.
#[derive(Debug)]
pub(super) struct MassSystem<T> {
    devices: Vec<Eliminated<T>>,
    /// Of all joints, some side by side: `M_jj⁻¹ M_jh`, by how much less a free joint accelerates where the hub does.
    gains: Vec<[[T; TOGETHER]; 6]>,
    /// The inverse of what is left for the hub, by columns; none where its accelerations are given.
    hub: Option<[Six<T>; 6]>,
}

/// The joints of one device.
#[derive(Clone, Copy, Debug)]
struct Eliminated<T> {
    count: usize,
    free: [bool; MAX_JOINTS],
    /// `L` below its unit diagonal of the joints' mass matrix, reciprocal pivots on it; of a joint that is not free the
    /// row of the unit matrix.
    factors: [[T; MAX_JOINTS]; MAX_JOINTS],
    /// Of each free joint, the loads of the hub by its acceleration.
    coupling: [Six<T>; MAX_JOINTS],
    /// `M_jj⁻¹ M_jh`.
    gains: [Six<T>; MAX_JOINTS],
}

impl<T: Scalar> MassSystem<T> {
    /// Of a hub whose accelerations are free or not, with the mass of the whole.
    pub(super) fn new(
        hub: &HubConstants<T>,
        mass: T,
        devices: &[LoadColumns<T>],
        hub_is_free: bool,
    ) -> Self {
        let eliminated: Vec<_> = devices.iter().map(Eliminated::new).collect();
        let system = hub_is_free.then(|| {
            let mut matrix = whole(hub, mass, devices);
            for device in &eliminated {
                device.reduce(&mut matrix);
            }
            inverse(&matrix)
        });
        let of_joints = eliminated.iter().flat_map(|of| of.gains.iter().take(of.count));
        let mut gains = Vec::with_capacity(eliminated.len().saturating_mul(MAX_JOINTS));
        for (number, of) in of_joints.enumerate() {
            if number % TOGETHER == 0 {
                gains.push([[zero(); TOGETHER]; 6]);
            }
            let group = gains.last_mut().into_iter().flatten();
            for (to, gain) in group.zip(of) {
                to[number % TOGETHER] = *gain;
            }
        }
        Self { devices: eliminated, gains, hub: system }
    }

    /// The accelerations of hub and joints where the loads of the hub change by `hub`, those of the devices from the
    /// n-th on by `joints`; `given` are those of a hub that is not free.
    pub(super) fn solve(
        &self,
        hub: &Six<T>,
        (first, joints): (usize, &[[T; MAX_JOINTS]]),
        given: Six<T>,
        out: &mut [T],
    ) -> Six<T> {
        let mut right = hub.map(|load| -load);
        let own;
        let mut several = Vec::new();
        let mut devices = self.devices.iter().skip(first);
        let by_loads: &[[T; MAX_JOINTS]] = if let [of] = joints {
            own = [devices.next().map_or(*of, |device| device.solved(of))];
            &own
        } else {
            several.extend(devices.zip(joints).map(|(device, of)| device.solved(of)));
            &several
        };
        for (device, accelerations) in self.devices.iter().skip(first).zip(by_loads) {
            let joints = device.coupling.iter().zip(accelerations).take(device.count);
            for (coupling, acceleration) in joints {
                for (to, entry) in right.iter_mut().zip(coupling) {
                    *to = *to + *entry * *acceleration;
                }
            }
        }
        let base = self.hub.as_ref().map_or(given, |inverse| {
            let mut base = [zero(); 6];
            for (column, load) in inverse.iter().zip(right) {
                for (to, entry) in base.iter_mut().zip(column) {
                    *to = *to + *entry * load;
                }
            }
            base
        });
        // Of joints on which no load changes minus zero, as the negative of their load.
        out.fill(-zero::<T>());
        let mut start = self.devices.iter().take(first).map(|device| device.count).sum();
        for (device, loads) in self.devices.iter().skip(first).zip(by_loads) {
            let end = device.count.saturating_add(start);
            for (to, load) in out.get_mut(start..end).unwrap_or_default().iter_mut().zip(loads) {
                *to = -*load;
            }
            start = end;
        }
        for (to, gains) in out.chunks_mut(TOGETHER).zip(&self.gains) {
            let mut sums = [zero(); TOGETHER];
            sums.iter_mut().zip(&*to).for_each(|(sum, number)| *sum = *number);
            for (gains, base) in gains.iter().zip(base) {
                for (sum, gain) in sums.iter_mut().zip(gains) {
                    *sum = *sum - *gain * base;
                }
            }
            to.iter_mut().zip(sums).for_each(|(to, sum)| *to = sum);
        }
        base
    }
}

impl<T: Scalar> Eliminated<T> {
    #[expect(clippy::needless_range_loop, reason = "rows and columns as the formula has them")]
    fn new(of: &LoadColumns<T>) -> Self {
        let LoadColumns { count, free, accelerations, .. } = of;
        let (count, free) = (*count, *free);
        let mut factors = [[zero(); MAX_JOINTS]; MAX_JOINTS];
        let mut coupling = [[zero(); 6]; MAX_JOINTS];
        for row in 0..count {
            for column in 0..=row {
                factors[row][column] = match (free[row] && free[column], row == column) {
                    (true, _) => accelerations[column].joints[row],
                    (false, true) => one(),
                    (false, false) => zero(),
                };
            }
            if free[row] {
                coupling[row] = accelerations[row].hub;
            }
        }
        for row in 0..count {
            for column in 0..row {
                let mut entry = factors[row][column];
                for k in 0..column {
                    entry = entry - factors[row][k] * factors[column][k];
                }
                factors[row][column] = entry;
            }
            let mut pivot = factors[row][row];
            for k in 0..row {
                let factor = factors[row][k] * factors[k][k];
                pivot = pivot - factor * factors[row][k];
                factors[row][k] = factor;
            }
            factors[row][row] = pivot.recip();
        }
        let mut found = Self { count, free, factors, coupling, gains: coupling };
        for direction in 0..6 {
            let solved = found.solved(&coupling.map(|of| of[direction]));
            for (gains, number) in found.gains.iter_mut().zip(solved) {
                gains[direction] = number;
            }
        }
        found
    }

    /// `M_jj⁻¹` times what is of free joints.
    fn solved(&self, right: &[T; MAX_JOINTS]) -> [T; MAX_JOINTS] {
        let mut v = *right;
        for (number, free) in v.iter_mut().zip(self.free) {
            if !free {
                *number = zero();
            }
        }
        for row in 0..self.count {
            for k in 0..row {
                v[row] = v[row] - self.factors[row][k] * v[k];
            }
        }
        for row in (0..self.count).rev() {
            v[row] = v[row] * self.factors[row][row];
            for k in row.saturating_add(1)..self.count {
                v[row] = v[row] - self.factors[k][row] * v[k];
            }
        }
        v
    }

    /// Subtracts what the free joints take over from the hub's matrix.
    fn reduce(&self, matrix: &mut [Six<T>; 6]) {
        for (coupling, gains) in self.coupling.iter().zip(&self.gains).take(self.count) {
            for (column, gain) in matrix.iter_mut().zip(gains) {
                for (to, entry) in column.iter_mut().zip(coupling) {
                    *to = *to - *entry * *gain;
                }
            }
        }
    }
}

/// The hub's six equations with everything that it carries, by columns.
fn whole<T: Scalar>(hub: &HubConstants<T>, mass: T, devices: &[LoadColumns<T>]) -> [Six<T>; 6] {
    let System { m_vw, m_ww, .. } = hub.system([zero(); 3], [zero(); 3], [zero(); 3]);
    let mut matrix = [[zero(); 6]; 6];
    for axis in 0..3 {
        let (force, moment) = (m_vw[axis], m_ww.columns()[axis]);
        let mut column = [force[0], force[1], force[2], moment[0], moment[1], moment[2]];
        for device in devices {
            let Load { hub, .. } = &device.omega_dot[axis];
            column.iter_mut().zip(hub).for_each(|(to, from)| *to = *to + *from);
        }
        matrix[axis][axis] = mass;
        for row in 0..3 {
            matrix[row][axis + 3] = column[row];
        }
        matrix[axis + 3] = column;
    }
    matrix
}

/// The inverse of a symmetric matrix, by columns.
fn inverse<T: Scalar>(m: &[Six<T>; 6]) -> [Six<T>; 6] {
    let [a, b, c, d, e, f] = m;
    let block = |x: &[T], y: &[T], z: &[T]| Symmetric {
        xx: x[0],
        xy: y[0],
        xz: z[0],
        yy: y[1],
        yz: z[1],
        zz: z[2],
    };
    let unit = |place: usize| [0, 1, 2].map(|own| if own == place { one() } else { zero() });
    [0, 1, 2, 3, 4, 5].map(|place| {
        let system = System {
            m_vv: block(&a[..3], &b[..3], &c[..3]),
            m_vw: [[d[0], d[1], d[2]], [e[0], e[1], e[2]], [f[0], f[1], f[2]]],
            m_ww: block(&d[3..], &e[3..], &f[3..]),
            h_v: unit(place),
            h_w: unit(place.wrapping_sub(3)),
        };
        let (found, _) = system.solved();
        let ([a, b, c], [d, e, f]) = (found.r_b_n_ddot, found.omega_dot);
        [a, b, c, d, e, f]
    })
}
