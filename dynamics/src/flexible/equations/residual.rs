//! Residual flexibility: coordinates without mass for the static response of the modes left out,
//! (F16) to (F18).

use crate::attitude::quaternion::Quaternion;
use crate::flexible::modal::modes::Modes;
use crate::flexible::modal::modes_error::{ModesError, ResidualFault};
use crate::flexible::modal::storage::{Flexible, ModalStorage};
use crate::numbers::real::{Scalar, one, two, zero};
use crate::numbers::vec3::{components, extreme};
use crate::sets::devices::Devices;
use crate::solve::spacecraft::Spacecraft;
use crate::solve::state::State;

/// Rejects residual coordinates that have momentum, no stiffness, or move a contained body.
pub(crate) fn check_residual<M: ModalStorage, T: Scalar>(
    modes: &Modes<M, T>,
    residual: usize,
) -> Result<(), ModesError<T>> {
    let count = modes.frequencies.as_ref().len();
    let reject = |mode, fault| Err(ModesError::Residual { mode, fault });
    let Some(first) = count.checked_sub(residual) else {
        return reject(residual, ResidualFault::Count { modes: count });
    };
    let integrals = modes.linear.as_ref().iter().zip(modes.angular.as_ref());
    let all = modes.frequencies.as_ref().iter().zip(integrals).enumerate().skip(first);
    for (mode, (frequency, (linear, angular))) in all {
        if *frequency <= zero() {
            return reject(mode, ResidualFault::NoStiffness);
        }
        let ([a, b, c], [d, e, f]) = (components(linear), components(angular));
        if extreme([a, b, c, d, e, f]) != zero() {
            return reject(mode, ResidualFault::Momentum);
        }
        for (number, mount) in modes.mounts.as_ref().iter().enumerate() {
            let point = &mount.point;
            let of_mode = [&point.translation, &point.rotation].map(|shapes| {
                let shape = shapes.as_ref().get(mode).map(components);
                shape.map_or_else(zero, extreme)
            });
            if mount.contained.is_some() && extreme(of_mode) != zero() {
                return reject(mode, ResidualFault::Contained { mount: number });
            }
        }
    }
    Ok(())
}

impl<D: Devices, M: ModalStorage> Spacecraft<D, Flexible<M>> {
    /// Damping of the residual coordinates from their ratios: `2 zeta w sqrt(m)`, with the mass that
    /// each moves, undeformed and with the joints at zero.
    pub(crate) fn damp_residual(
        &mut self,
        ratios: &[D::Scalar],
    ) -> Result<(), ModesError<D::Scalar>> {
        let still = State::<D, Quaternion<D::Scalar>, Flexible<M>>::at_rest_for(self);
        for (mode, ratio) in ratios.iter().enumerate().skip(self.massive()) {
            let mut moving = still.clone();
            if let Some(rate) = moving.modal.eta_dot.as_mut().get_mut(mode) {
                *rate = one();
            }
            let mass = two::<D::Scalar>() * self.sums_flexible(&moving).motion.bodies.energy;
            if !(mass > zero() && mass.is_finite()) {
                let fault = ResidualFault::Massless { mass };
                return Err(ModesError::Residual { mode, fault });
            }
            if let Some([stiffness, damping]) = self.structure.passive.as_mut().get_mut(mode) {
                *damping = two::<D::Scalar>() * *ratio * (*stiffness * mass).sqrt();
            }
        }
        Ok(())
    }
}

#[cfg(feature = "alloc")]
mod compliance {
    use alloc::vec::Vec;

    use nalgebra::Vector3;

    use super::{ModesError, ResidualFault};
    use crate::flexible::modal::modes::{ModalPoint, Modes};
    use crate::flexible::modal::storage::ListedModes;
    use crate::numbers::real::{Scalar, one, zero};
    use crate::validation::check::rounding;

    impl<T: Scalar> Modes<ListedModes, T> {
        /// Adds residual coordinates for a residual compliance of the mounts, (F17), and their
        /// shapes at the mounts and at other points; returns their number, for
        /// [`Spacecraft::flexible_with_residual`](crate::Spacecraft::flexible_with_residual).
        ///
        /// `compliance` has six columns for each mount (force, N, and moment, N m, on it) and six
        /// rows for each mount, then for each point (displacement, m, and rotation, rad), row by
        /// row, expressed in B: static compliance of the structure, less that of the modes given,
        /// `sum of Y_k Y_lᵀ / w²`. Of mounts without devices it has to be zero. It is factorised
        /// with the largest pivot first; what is left below rounding is left out. Their damping
        /// ratio is 0.
        ///
        /// # Errors
        ///
        /// [`ModesError::Residual`]; then nothing is changed.
        pub fn add_residual(
            &mut self,
            points: &mut [ModalPoint<ListedModes, T>],
            compliance: &[T],
        ) -> Result<usize, ModesError<T>> {
            let columns = self.mounts.len().saturating_mul(6);
            let rows = columns.saturating_add(points.len().saturating_mul(6));
            let reject = |mode, fault| Err(ModesError::Residual { mode, fault });
            let expected = rows.saturating_mul(columns);
            if compliance.len() != expected {
                let found = compliance.len();
                return reject(0, ResidualFault::Entries { expected, found });
            }
            if columns == 0 {
                return Ok(0);
            }
            let mut rest: Vec<Vec<T>> = compliance.chunks(columns).map(<[T]>::to_vec).collect();
            let entry = |rest: &[Vec<T>], row: usize, column: usize| {
                rest.get(row).and_then(|row| row.get(column)).copied().unwrap_or_else(zero)
            };
            let scale: Vec<T> = (0..columns).map(|k| entry(&rest, k, k)).collect();
            for (number, row) in rest.iter().enumerate() {
                if let Some(value) = row.iter().copied().find(|value| !value.is_finite()) {
                    return reject(number, ResidualFault::NotFinite { value });
                }
                for column in 0..number.min(columns) {
                    let difference = entry(&rest, number, column) - entry(&rest, column, number);
                    let sizes = scale.get(number).zip(scale.get(column));
                    let bound = sizes.map(|(a, b)| rounding::<T>() * (a.abs() * b.abs()).sqrt());
                    if bound.is_some_and(|bound| difference.abs() > bound) {
                        return reject(number, ResidualFault::Asymmetric { difference });
                    }
                }
            }
            let mut shapes: Vec<Vec<T>> = Vec::new();
            for _ in 0..columns {
                let shares = scale.iter().enumerate().map(|(k, scale)| {
                    let own = entry(&rest, k, k);
                    (k, if *scale > zero() { own * scale.recip() } else { own })
                });
                let shares: Vec<(usize, T)> = shares.collect();
                if let Some((row, pivot)) = shares.iter().find(|(_, x)| *x < -rounding::<T>()) {
                    return reject(*row, ResidualFault::Negative { pivot: *pivot });
                }
                let largest = |a: (usize, T), b: (usize, T)| if b.1 > a.1 { b } else { a };
                let Some((pivot, share)) = shares.into_iter().reduce(largest) else { break };
                if share <= rounding::<T>() {
                    break;
                }
                let over = entry(&rest, pivot, pivot).sqrt().recip();
                let shape: Vec<T> = (0..rows).map(|k| over * entry(&rest, k, pivot)).collect();
                for (row, of_row) in rest.iter_mut().zip(&shape) {
                    for (to, of_column) in row.iter_mut().zip(&shape) {
                        *to = *to - *of_row * *of_column;
                    }
                }
                // What is left of the pivot's own row and column is rounding.
                for (number, row) in rest.iter_mut().enumerate() {
                    for (column, to) in row.iter_mut().enumerate() {
                        if number == pivot || column == pivot {
                            *to = zero();
                        }
                    }
                }
                shapes.push(shape);
            }
            for shape in &shapes {
                self.frequencies.push(one());
                self.damping.push(zero());
                self.linear.push(Vector3::from_element(zero()));
                self.angular.push(Vector3::from_element(zero()));
                let mounts = self.mounts.iter_mut().map(|mount| &mut mount.point);
                for (point, six) in mounts.chain(points.iter_mut()).zip(shape.chunks(6)) {
                    if let [x, y, z, p, q, r] = six {
                        point.translation.push(Vector3::new(*x, *y, *z));
                        point.rotation.push(Vector3::new(*p, *q, *r));
                    }
                }
            }
            Ok(shapes.len())
        }
    }
}
