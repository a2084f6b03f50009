//! [`Basis`]: the directions of modal space that mounts and momentum integrals reach, (F10).
//!
//! The 6 (K + 1) rows of `Y = [Y_1; ...; Y_K; Y_0]`, of the shapes of K mounts and of the momentum
//! integrals, are `Y = L Q` with orthonormal rows of Q. Devices and hub meet the modes in Q only:
//! in all directions beside it the mass matrix is the identity. With no more modes than rows, Q is
//! the identity. Residual coordinates, (F16), are directions of their own, the last ones.

use crate::flexible::equations::block::Six;
use crate::flexible::equations::factor::inner;
use crate::flexible::modal::storage::ModalStorage;
use crate::numbers::real::{Scalar, one, zero};

/// A row whose remainder is below so many epsilons of it depends on those before it.
const DEPENDENT_EPSILONS: f64 = 64.0;

/// Orthonormal directions, and the coupling of mounts and momentum integrals with them.
#[derive(Clone, Debug)]
pub(crate) struct Basis<M: ModalStorage, T: Scalar> {
    /// The number of directions.
    pub(crate) count: usize,
    /// How many of them, at the end, are residual coordinates, without a modal mass.
    pub(crate) residual: usize,
    /// The rows of Q; none if it is the identity.
    directions: Option<M::Modes<M::Modes<T>>>,
    /// `L_k` by its columns, mount by mount.
    pub(crate) mounts: M::Mounts<M::Modes<Six<T>>>,
    /// `L_0` by its columns.
    pub(crate) momenta: M::Modes<Six<T>>,
}

impl<M: ModalStorage, T: Scalar> Basis<M, T> {
    /// The basis for shapes of mounts and momentum integrals, each by its columns, the last ones of
    /// residual coordinates.
    pub(crate) fn new(
        mounts: &M::Mounts<M::Modes<Six<T>>>,
        momenta: &M::Modes<Six<T>>,
        residual: usize,
    ) -> Self {
        let modes = momenta.as_ref().len();
        let rows = mounts.as_ref().len().saturating_add(1).saturating_mul(6);
        if modes <= rows {
            return Self::of_modes(mounts, momenta, residual);
        }
        let none = M::modes(modes, &[zero(); 6]);
        let most = rows.saturating_add(residual);
        let mut basis = Self {
            count: 0,
            residual,
            directions: Some(M::modes(most, &M::modes(modes, &zero()))),
            mounts: M::mounts(mounts.as_ref().len(), &none),
            momenta: none,
        };
        for (index, columns) in mounts.as_ref().iter().enumerate() {
            for row in 0..6 {
                let coordinates = basis.orthonormalised(columns, row);
                if let Some(to) = basis.mounts.as_mut().get_mut(index) {
                    set_row(to, row, &coordinates);
                }
            }
        }
        for row in 0..6 {
            let coordinates = basis.orthonormalised(momenta, row);
            set_row(&mut basis.momenta, row, &coordinates);
        }
        for mode in modes.saturating_sub(residual)..modes {
            basis.add_residual(mounts, mode);
        }
        basis
    }

    /// The same with each number converted.
    pub(crate) fn map<U: Scalar>(&self, number: impl Fn(T) -> U + Copy) -> Basis<M, U> {
        let columns = |of: &M::Modes<Six<T>>| M::per_mode(of, |column| column.map(number));
        Basis {
            count: self.count,
            residual: self.residual,
            directions: self.directions.as_ref().map(|directions| {
                M::per_mode(directions, |row| M::per_mode(row, |of| number(*of)))
            }),
            mounts: M::per_mount(&self.mounts, columns),
            momenta: columns(&self.momenta),
        }
    }

    /// Every mode as a direction.
    pub(crate) fn of_modes(
        mounts: &M::Mounts<M::Modes<Six<T>>>,
        momenta: &M::Modes<Six<T>>,
        residual: usize,
    ) -> Self {
        let (mounts, momenta) = (mounts.clone(), momenta.clone());
        Self { count: momenta.as_ref().len(), residual, directions: None, mounts, momenta }
    }

    /// Whether every mode is a direction.
    pub(crate) fn is_of_modes(&self) -> bool {
        self.directions.is_none()
    }

    /// Adds a residual coordinate as a direction; it carries no momentum.
    fn add_residual(&mut self, mounts: &M::Mounts<M::Modes<Six<T>>>, mode: usize) {
        let direction = self.directions.as_mut().and_then(|all| all.as_mut().get_mut(self.count));
        let Some(own) = direction.and_then(|direction| direction.as_mut().get_mut(mode)) else {
            return;
        };
        *own = one();
        for (to, from) in self.mounts.as_mut().iter_mut().zip(mounts.as_ref()) {
            let pair = to.as_mut().get_mut(self.count).zip(from.as_ref().get(mode));
            if let Some((to, from)) = pair {
                *to = *from;
            }
        }
        self.count = self.count.saturating_add(1);
    }

    /// The coordinates of a row in the directions, to which its remainder is added.
    fn orthonormalised(&mut self, columns: &M::Modes<Six<T>>, row: usize) -> M::Modes<T> {
        let modes = columns.as_ref().len();
        let mut rest = M::modes(modes, &zero());
        let massive = modes.saturating_sub(self.residual);
        let columns = columns.as_ref().iter().take(massive);
        for (to, column) in rest.as_mut().iter_mut().zip(columns) {
            *to = column.get(row).copied().unwrap_or_else(zero);
        }
        let mut coordinates = M::modes(modes, &zero());
        let whole = norm(rest.as_ref());
        let Some(directions) = &mut self.directions else { return coordinates };
        // Twice: the remainder of a row that nearly depends on others is orthogonal, too.
        for _ in 0..2 {
            let known = directions.as_ref().iter().take(self.count);
            for (direction, coordinate) in known.zip(coordinates.as_mut()) {
                let along = inner(direction.as_ref(), rest.as_ref());
                *coordinate = *coordinate + along;
                for (to, from) in rest.as_mut().iter_mut().zip(direction.as_ref()) {
                    *to = *to - along * *from;
                }
            }
        }
        let size = norm(rest.as_ref());
        if size > T::from_f64(DEPENDENT_EPSILONS) * T::EPSILON * whole
            && let (Some(direction), Some(coordinate)) =
                (directions.as_mut().get_mut(self.count), coordinates.as_mut().get_mut(self.count))
        {
            let per_size = size.recip();
            for (to, from) in direction.as_mut().iter_mut().zip(rest.as_ref()) {
                *to = per_size * *from;
            }
            *coordinate = size;
            self.count = self.count.saturating_add(1);
        }
        coordinates
    }

    /// `Q f`.
    pub(crate) fn projected(&self, f: &M::Modes<T>) -> M::Modes<T> {
        let Some(directions) = &self.directions else { return f.clone() };
        let mut projected = M::modes(self.count, &zero());
        for (to, direction) in projected.as_mut().iter_mut().zip(directions.as_ref()) {
            *to = inner(direction.as_ref(), f.as_ref());
        }
        projected
    }

    /// `f + Qᵀ (p - Q f)`: p in the directions, f beside them.
    pub(crate) fn completed(
        &self,
        f: &M::Modes<T>,
        p: &M::Modes<T>,
        projected: &M::Modes<T>,
    ) -> M::Modes<T> {
        let Some(directions) = &self.directions else { return p.clone() };
        let mut sum = f.clone();
        let differences = p.as_ref().iter().zip(projected.as_ref());
        let known = directions.as_ref().iter().take(self.count);
        for (direction, (p, own)) in known.zip(differences) {
            let difference = *p - *own;
            for (to, from) in sum.as_mut().iter_mut().zip(direction.as_ref()) {
                *to = *to + difference * *from;
            }
        }
        // Those of residual coordinates are accelerations by themselves, not beside a force.
        let first = self.count.saturating_sub(self.residual);
        let own = p.as_ref().iter().take(self.count).skip(first);
        let massive = sum.as_ref().len().saturating_sub(self.residual);
        for (to, from) in sum.as_mut().iter_mut().skip(massive).zip(own) {
            *to = *from;
        }
        sum
    }
}

fn set_row<T: Scalar, C: AsMut<[Six<T>]>, V: AsRef<[T]>>(columns: &mut C, row: usize, values: &V) {
    for (column, value) in columns.as_mut().iter_mut().zip(values.as_ref()) {
        if let Some(to) = column.get_mut(row) {
            *to = *value;
        }
    }
}

fn norm<T: Scalar>(v: &[T]) -> T {
    inner(v, v).sqrt()
}
