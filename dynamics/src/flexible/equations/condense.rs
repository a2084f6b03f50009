//! [`Condensed`]: the equations of hub and modal directions, to which each mount adds its own, (F10)
//! to (F12).
//!
//! ```text
//! [ M_uu  M_pu^T ] [ u ]   [ h_u ]     u = (r_b_n'', omega'),  p = Q eta''
//! [ M_pu  M_pp   ] [ p ] = [ h_p ]
//! ```

use crate::equations::system::{
    Scale, SmallPivot, Solution, System, WELL_SCALED, bound, check_pivot,
};
use crate::flexible::equations::basis::Basis;
use crate::flexible::equations::block::{
    Block, Six, add_scaled, dot6, joined, parted, sub6, times,
};
use crate::flexible::equations::factor::{Right, Rows, back_substitute, factorise};
use crate::flexible::equations::mount::MountMotion;
use crate::flexible::modal::storage::ModalStorage;
use crate::numbers::real::{Scalar, one, zero};
use crate::numbers::symmetric::Symmetric;

/// The equations of hub and modal directions.
#[derive(Clone, Debug)]
pub(crate) struct Condensed<M: ModalStorage, T: Scalar> {
    /// `M_uu` and `h_u`.
    hub: Block<T>,
    force: Six<T>,
    /// The triangle of `M_pp` up to the diagonal, by rows.
    square: M::Square<T>,
    /// `M_pu` and `h_p`, row by row.
    right: M::Modes<Right<T>>,
    /// The acceleration of a mount for each direction, while it is added.
    moved: M::Modes<Six<T>>,
    /// What each pivot of `M_pp` is checked against: the mass of its direction before any joint was
    /// eliminated.
    scales: M::Modes<T>,
    /// The number of directions.
    count: usize,
}

/// Accelerations of the hub, and in the directions.
pub(crate) type Solved<M, T> = (Solution<T>, <M as ModalStorage>::Modes<T>);

/// Why the modal part has no solution.
pub(crate) enum SmallMass<T> {
    /// A pivot of the modal mass.
    Modal(SmallPivot<T>),
    /// A pivot of the hub.
    Hub(SmallPivot<T>),
}

impl<M: ModalStorage, T: Scalar> Condensed<M, T> {
    /// The structure without what stands on its mounts, for modal forces in the directions.
    pub(crate) fn new(structure: &System<T>, basis: &Basis<M, T>, forces: &M::Modes<T>) -> Self {
        let count = basis.count;
        let mut square = M::square(count, &zero());
        let massive = count.saturating_sub(basis.residual);
        let mut scales = M::modes(count, &zero());
        let rows = M::rows(&mut square, count).zip(scales.as_mut()).enumerate();
        for (index, (row, scale)) in rows.take(massive) {
            if let Some(diagonal) = row.get_mut(index) {
                (*diagonal, *scale) = (one(), one());
            }
        }
        let mut right = M::modes(count, &[zero(); 7]);
        let given = basis.momenta.as_ref().iter().zip(forces.as_ref());
        for (right, ([a, b, c, d, e, f], force)) in right.as_mut().iter_mut().zip(given) {
            *right = [*a, *b, *c, *d, *e, *f, *force];
        }
        let (hub, force) = (block(structure), joined(structure.h_v, structure.h_w));
        let moved = M::modes(count, &[zero(); 6]);
        Self { hub, force, square, right, moved, scales, count }
    }

    /// Subtracts one number for each direction from the diagonal of `M_pp`.
    pub(crate) fn reduce(&mut self, numbers: impl Iterator<Item = T>) {
        let rows = M::rows(&mut self.square, self.count).zip(numbers).enumerate();
        for (index, (row, number)) in rows {
            if let Some(diagonal) = row.get_mut(index) {
                *diagonal = *diagonal - number;
            }
        }
    }

    /// Adds the six equations of a mount, `system`, for its coupling with the directions. `scale` is
    /// mass and inertia of what stands on it, no joint eliminated.
    pub(crate) fn add(
        &mut self,
        motion: &MountMotion<T>,
        system: &System<T>,
        (standing, [x, y, z]): Scale<T>,
        coupling: &[Six<T>],
    ) {
        let MountMotion { of_hub, of_shape, bias, .. } = motion;
        let mass = block(system);
        let force = sub6(&joined(system.h_v, system.h_w), &times(&mass, bias));
        of_hub.add_congruent(&mut self.hub, &mass);
        add_scaled(&mut self.force, one(), &of_hub.transposed_times(&force));

        // The acceleration of the mount for each direction, and what it requires.
        let moved = self.moved.as_mut();
        for (moved, column) in moved.iter_mut().zip(coupling) {
            *moved = of_shape.times(column);
        }
        for (scale, [a, b, c, d, e, f]) in self.scales.as_mut().iter_mut().zip(moved.iter()) {
            let slid = *a * *a + *b * *b + *c * *c;
            *scale = *scale + (standing * slid + x * *d * *d + y * *e * *e + z * *f * *f);
        }
        let lines = M::rows(&mut self.square, self.count).zip(self.right.as_mut());
        for (index, (column, (row, right))) in moved.iter().zip(lines).enumerate() {
            let needed = times(&mass, column);
            let up_to = moved.iter().take(index.saturating_add(1));
            for (entry, other) in row.iter_mut().zip(up_to) {
                *entry = *entry + dot6(&needed, other);
            }
            let [a, b, c, d, e, f, h] = right;
            let by_hub = of_hub.transposed_times(&needed);
            for (to, from) in [a, b, c, d, e, f].into_iter().zip(by_hub) {
                *to = *to + from;
            }
            *h = *h + dot6(column, &force);
        }
    }

    /// The acceleration of the hub, unless it is given, and those in the directions.
    pub(crate) fn solve(
        mut self,
        given: Option<Solution<T>>,
        scale: &Scale<T>,
    ) -> Result<Solved<M, T>, SmallMass<T>> {
        let (scaled, reciprocals) = self.factorised();
        self.check(&reciprocals).map_err(SmallMass::Modal)?;
        let hub = match given {
            Some(hub) => hub,
            None => self.hub_system(&scaled).solve(scale).map_err(SmallMass::Hub)?,
        };
        Ok(self.completed(hub, reciprocals))
    }

    /// The same without a check of the pivots.
    pub(crate) fn unchecked(mut self, given: Option<Solution<T>>) -> Solved<M, T> {
        let (scaled, reciprocals) = self.factorised();
        let hub = given.unwrap_or_else(|| self.hub_system(&scaled).solved().0);
        self.completed(hub, reciprocals)
    }

    /// Whether the matrix is positive definite; that of a held hub, without the hub's rows.
    pub(crate) fn is_definite(&mut self, hub_is_free: bool) -> bool {
        let (scaled, reciprocals) = self.factorised();
        let mut pivots = reciprocals.as_ref().iter().take(self.count);
        pivots.all(|reciprocal| *reciprocal > zero() && reciprocal.is_finite())
            && (!hub_is_free || {
                let (_, pivots) = self.hub_system(&scaled).solved();
                pivots.into_iter().all(|pivot| pivot > zero())
            })
    }

    /// Factorises `M_pp`: `L⁻¹` times the right sides, and the reciprocals of the pivots.
    fn factorised(&mut self) -> (M::Modes<Right<T>>, M::Modes<T>) {
        let mut scaled = M::modes(self.count, &[zero(); 7]);
        let mut reciprocals = M::modes(self.count, &zero());
        let (flat, length) = M::flat(&mut self.square, self.count);
        let mut rows = Rows { flat, length, count: self.count };
        factorise(&mut rows, self.right.as_mut(), scaled.as_mut(), reciprocals.as_mut());
        (scaled, reciprocals)
    }

    /// The hub's equations, the directions eliminated.
    fn hub_system(&self, scaled: &M::Modes<Right<T>>) -> System<T> {
        let (mut mass, mut force) = (self.hub, self.force);
        let pairs = scaled.as_ref().iter().zip(self.right.as_ref()).take(self.count);
        for ([a, b, c, d, e, f, _], [p, q, r, s, t, u, h]) in pairs {
            let (left, own) = ([*a, *b, *c, *d, *e, *f], [*p, *q, *r, *s, *t, *u]);
            for (row, factor) in mass.iter_mut().zip(left) {
                add_scaled(row, -factor, &own);
            }
            add_scaled(&mut force, -*h, &left);
        }
        system(&mass, &force)
    }

    /// The accelerations in the directions, once that of the hub is known; in place of `known`.
    fn completed(mut self, hub: Solution<T>, mut known: M::Modes<T>) -> Solved<M, T> {
        let u = joined(hub.r_b_n_ddot, hub.omega_dot);
        for (to, [a, b, c, d, e, f, h]) in known.as_mut().iter_mut().zip(self.right.as_ref()) {
            *to = *h - dot6(&[*a, *b, *c, *d, *e, *f], &u);
        }
        let (flat, length) = M::flat(&mut self.square, self.count);
        let rows = Rows { flat, length, count: self.count };
        back_substitute(&rows, known.as_mut().get_mut(..self.count).unwrap_or_default());
        (hub, known)
    }

    /// Rejects a pivot that is rounding.
    fn check(&mut self, reciprocals: &M::Modes<T>) -> Result<(), SmallPivot<T>> {
        let share = T::from_f64(WELL_SCALED);
        let mut pivots = reciprocals.as_ref().iter().zip(self.scales.as_ref()).take(self.count);
        let well_scaled = pivots.all(|(reciprocal, scale)| {
            *reciprocal > zero() && share * *scale * *reciprocal < one()
        });
        if well_scaled { Ok(()) } else { self.check_pivots(reciprocals) }
    }

    /// Checks each pivot against its scale, grown by the rounding of those before it, as of the hub:
    /// pivot k is `v . M v` with `Lᵀ v = e_k`.
    #[cold]
    fn check_pivots(&mut self, reciprocals: &M::Modes<T>) -> Result<(), SmallPivot<T>> {
        let (flat, length) = M::flat(&mut self.square, self.count);
        let mut direction = M::modes(self.count, &zero());
        for (index, reciprocal) in reciprocals.as_ref().iter().enumerate().take(self.count) {
            let count = index.saturating_add(1);
            let v = direction.as_mut().get_mut(..count).unwrap_or_default();
            v.fill(zero());
            if let Some(own) = v.last_mut() {
                *own = one();
            }
            back_substitute(&Rows { flat: &mut *flat, length, count }, v);
            let terms = v.iter().zip(self.scales.as_ref());
            let scale = terms.fold(zero(), |sum: T, (v, scale)| sum + *scale * (*v * *v));
            check_pivot(reciprocal.recip(), bound(scale))?;
        }
        Ok(())
    }
}

/// The matrix of a system.
pub(crate) fn block<T: Scalar>(system: &System<T>) -> Block<T> {
    let [a, b, c] = system.m_vv.columns();
    let [d, e, f] = system.m_ww.columns();
    let [[xa, ya, za], [xb, yb, zb], [xc, yc, zc]] = system.m_vw;
    [
        joined(a, [xa, xb, xc]),
        joined(b, [ya, yb, yc]),
        joined(c, [za, zb, zc]),
        joined([xa, ya, za], d),
        joined([xb, yb, zb], e),
        joined([xc, yc, zc], f),
    ]
}

/// The system of a symmetric matrix, by its triangle from the diagonal on.
fn system<T: Scalar>(mass: &Block<T>, force: &Six<T>) -> System<T> {
    let [a, b, c, d, e, f] = mass;
    let (h_v, h_w) = parted(force);
    System {
        m_vv: Symmetric { xx: a[0], xy: a[1], xz: a[2], yy: b[1], yz: b[2], zz: c[2] },
        m_vw: [[a[3], b[3], c[3]], [a[4], b[4], c[4]], [a[5], b[5], c[5]]],
        m_ww: Symmetric { xx: d[3], xy: d[4], xz: d[5], yy: e[4], yz: e[5], zz: f[5] },
        h_v,
        h_w,
    }
}
