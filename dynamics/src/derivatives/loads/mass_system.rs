//! [`MassSystem`]: what accelerations change by where the loads change, all else given: `-M⁻¹ δ(loads)`.
//!
//! The joints of each device are eliminated into the hub's six equations ([`JointElimination`]), as an evaluation does
//! it; joints and a hub whose accelerations are given have no row.

#![expect(clippy::inline_always, reason = "instructions are reached only in what is inlined")]

use alloc::vec;
use alloc::vec::Vec;

use crate::derivatives::loads::side_by_side::{HubGroup, Six, TOGETHER};
use crate::equations::hub::HubConstants;
use crate::equations::system::System;
use crate::numbers::real::{Scalar, one, zero};
use crate::numbers::symmetric::Symmetric;

/// `M_jj⁻¹ M_jh` of all joints, one hub acceleration after another: by how much less a free joint accelerates where the hub
/// does.
#[derive(Debug)]
pub(crate) struct Gains<T> {
    numbers: Vec<T>,
    joints: usize,
    /// The joint that comes next.
    next: usize,
}

impl<T: Scalar> Gains<T> {
    /// Of so many joints.
    pub(crate) fn new(joints: usize) -> Self {
        Self { numbers: vec![zero(); joints.saturating_mul(6)], joints, next: 0 }
    }

    /// Those of the next joint.
    #[inline(always)]
    pub(crate) fn push(&mut self, of: &Six<T>) {
        let places = self.numbers.iter_mut().skip(self.next).step_by(self.joints.max(1));
        places.zip(of).for_each(|(to, gain)| *to = *gain);
        self.next = self.next.saturating_add(1);
    }

    /// Those of all joints by each hub acceleration.
    pub(crate) fn rows(&self) -> [&[T]; 6] {
        let mut rows = self.numbers.chunks_exact(self.joints.max(1));
        [(); 6].map(|()| rows.next().unwrap_or_default())
    }
}

/// What the joints' accelerations are where the hub has these: of joints that nothing moves minus zero.
#[inline(always)]
pub(crate) fn follow<T: Scalar>([a, b, c, d, e, f]: [&[T]; 6], base: &Six<T>, out: &mut [T]) {
    let linear = out.iter_mut().zip(a).zip(b).zip(c);
    for ((((((to, a), b), c), d), e), f) in linear.zip(d).zip(e).zip(f) {
        let linear = -(*a * base[0]) - *b * base[1] - *c * base[2];
        *to = linear - *d * base[3] - *e * base[4] - *f * base[5];
    }
}

/// The hub's equations with the joints of all devices eliminated.
#[derive(Debug)]
pub(crate) struct MassSystem<T> {
    /// The inverse of what is left for the hub, by columns; none where its accelerations are given.
    inverse: Option<[Six<T>; 6]>,
}

impl<T: Scalar> MassSystem<T> {
    /// Of a hub whose accelerations are free or not, with the mass of the whole and what the devices add.
    pub(crate) fn new(
        hub: &HubConstants<T>,
        mass: T,
        devices: &[Six<T>; 6],
        hub_is_free: bool,
    ) -> Self {
        Self { inverse: hub_is_free.then(|| inverse(&whole(hub, mass, devices))) }
    }

    /// The hub's accelerations for a right side of its equations; those that are given where it is not free.
    #[inline(always)]
    pub(crate) fn hub(&self, right: &Six<T>, given: Six<T>) -> Six<T> {
        let Some(inverse) = &self.inverse else { return given };
        let mut base = [zero(); 6];
        for (column, load) in inverse.iter().zip(right) {
            for (to, entry) in base.iter_mut().zip(column) {
                *to = *to + *entry * *load;
            }
        }
        base
    }

    /// The same in place of groups of right sides.
    #[inline(always)]
    pub(crate) fn hub_of_groups(&self, groups: &mut [HubGroup<T>]) {
        let Some(inverse) = &self.inverse else {
            groups.as_flattened_mut().fill([zero(); TOGETHER]);
            return;
        };
        for group in groups {
            let mut base = [[zero(); TOGETHER]; 6];
            for (column, loads) in inverse.iter().zip(&*group) {
                for (to, entry) in base.iter_mut().zip(column) {
                    for (to, load) in to.iter_mut().zip(loads) {
                        *to = *to + *entry * *load;
                    }
                }
            }
            *group = base;
        }
    }

    /// The same for a unit of the right side.
    #[inline(always)]
    pub(crate) fn hub_by_unit(&self, place: usize) -> Six<T> {
        let column = self.inverse.as_ref().and_then(|inverse| inverse.get(place));
        column.copied().unwrap_or([zero(); 6])
    }
}

/// The hub's six equations with everything that it carries, by columns.
fn whole<T: Scalar>(hub: &HubConstants<T>, mass: T, devices: &[Six<T>; 6]) -> [Six<T>; 6] {
    let System { m_vw, m_ww, .. } = hub.system([zero(); 3], [zero(); 3], [zero(); 3]);
    let mut matrix = *devices;
    for (axis, (force, moment)) in m_vw.iter().zip(m_ww.columns()).enumerate() {
        matrix[axis][axis] = matrix[axis][axis] + mass;
        let own = force.iter().chain(&moment);
        let column = matrix[axis.wrapping_add(3)].iter_mut().zip(own);
        column.for_each(|(to, from)| *to = *to + *from);
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
