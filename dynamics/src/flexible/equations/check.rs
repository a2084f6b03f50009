//! The checks of [`ModesError`].

use core::fmt::Debug;

use nalgebra::Vector3;

use crate::equations::hub::HubConstants;
use crate::flexible::equations::block::{Block, Six, add_scaled};
use crate::flexible::modal::modes::{ContainedBody, Modes};
use crate::flexible::modal::modes_error::{ModalQuantity, ModesError};
use crate::flexible::modal::storage::ModalStorage;
use crate::model::parameters::Hub;
use crate::numbers::real::{Scalar, zero};
use crate::numbers::vec3::components;
use crate::validation::check::{check_contained, rounding};

/// Checks counts, finite numbers and signs.
pub(crate) fn check_modes<M: ModalStorage, T: Scalar>(
    modes: &Modes<M, T>,
) -> Result<(), ModesError<T>> {
    let expected = modes.frequencies.as_ref().len();
    for (what, values) in [
        (ModalQuantity::Frequency, modes.frequencies.as_ref()),
        (ModalQuantity::Damping, modes.damping.as_ref()),
    ] {
        count(what, expected, values)?;
        for (mode, value) in values.iter().copied().enumerate() {
            if !value.is_finite() {
                return Err(ModesError::NotFinite { what, mode, value });
            }
            if value < zero() {
                return Err(ModesError::Negative { what, mode, value });
            }
        }
    }
    check_vectors(ModalQuantity::LinearIntegral, expected, modes.linear.as_ref())?;
    check_vectors(ModalQuantity::AngularIntegral, expected, modes.angular.as_ref())?;
    for (mount, of) in modes.mounts.as_ref().iter().enumerate() {
        let what = ModalQuantity::Position { mount };
        check_vectors(what, 1, core::slice::from_ref(&of.point.position))?;
        let what = ModalQuantity::Translation { mount };
        check_vectors(what, expected, of.point.translation.as_ref())?;
        check_vectors(ModalQuantity::Rotation { mount }, expected, of.point.rotation.as_ref())?;
        if let Some(contained) = &of.contained {
            let checked = check_contained(&contained.hub());
            checked.map_err(|error| ModesError::Contained { mount, error })?;
        }
    }
    Ok(())
}

fn count<T: Scalar, V: Clone + Debug>(
    what: ModalQuantity,
    expected: usize,
    values: &[V],
) -> Result<(), ModesError<T>> {
    let found = values.len();
    if found == expected { Ok(()) } else { Err(ModesError::ModeCount { what, expected, found }) }
}

fn check_vectors<T: Scalar>(
    what: ModalQuantity,
    expected: usize,
    vectors: &[Vector3<T>],
) -> Result<(), ModesError<T>> {
    count(what, expected, vectors)?;
    for (mode, vector) in vectors.iter().enumerate() {
        if let Some(value) = components(vector).into_iter().find(|value| !value.is_finite()) {
            return Err(ModesError::NotFinite { what, mode, value });
        }
    }
    Ok(())
}

/// Rejects modes that carry more momentum than the structure has: pivots of the mass of its rigid
/// motion less that of the modes, up to rounding.
pub(crate) fn check_momenta<T: Scalar>(
    structure: &HubConstants<T>,
    momenta: &[Six<T>],
) -> Result<(), ModesError<T>> {
    let still = [zero(); 3];
    let mut rest: Block<T> =
        crate::flexible::equations::condense::block(&structure.system(still, still, still));
    let [a, b, c, d, e, f] = &rest;
    let scales = [a[0], b[1], c[2], d[3], e[4], f[5]];
    for column in momenta {
        for (row, component) in rest.iter_mut().zip(column) {
            add_scaled(row, -*component, column);
        }
    }
    for (row, scale) in scales.into_iter().enumerate() {
        let Some((done, below)) = rest.split_at_mut_checked(row) else { break };
        let (_, Some((first, below))) = (done, below.split_first_mut()) else { break };
        let (pivot, bound) =
            (first.get(row).copied().unwrap_or_else(zero), rounding::<T>() * scale);
        if pivot < -bound {
            return Err(ModesError::MoreThanStructure { row, pivot, bound: -bound });
        }
        // What is left of a direction that the modes carry wholly is rounding.
        if pivot > bound {
            for other in below {
                let factor = other.get(row).copied().unwrap_or_else(zero) * pivot.recip();
                add_scaled(other, -factor, first);
            }
        }
    }
    Ok(())
}

impl<T: Scalar> ContainedBody<T> {
    /// As a hub: the same three parameters.
    pub(crate) fn hub(&self) -> Hub<T> {
        Hub { m_b: self.mass, r_bc_b: self.centre, i_b_bc: self.inertia }
    }
}
