//! The checks of [`ParameterError`] and [`Warning`](crate::Warning): finite numbers, masses,
//! inertia tensors and mounts.

use nalgebra::Matrix3;

use crate::model::kind::{JointInfo, Kind};
use crate::model::parameters::Hub;
use crate::model::passive::Passive;
use crate::numbers::each::Each;
use crate::numbers::real::{Scalar, one, zero};
use crate::numbers::symmetric::Symmetric;
use crate::numbers::vec3::{Columns, columns, components, cross, dot};
use crate::validation::parameter_error::{Parameter, ParameterError, Part};

/// Relative size below which a deviation counts as rounding, in machine epsilons.
///
/// Twelve bits: a product of some tens of rotation matrices stays below it, a direction typed to
/// ten digits does not.
const ROUNDING_EPSILONS: f64 = 4096.0;

/// Checks the hub. The result is the excess of its triangle inequality, kg m^2, zero if it holds.
pub(crate) fn check_hub<T: Scalar>(hub: &Hub<T>) -> Result<T, ParameterError<T>> {
    finite(Part::Hub, Parameter::Mass, &[hub.m_b])?;
    finite(Part::Hub, Parameter::CentreOfMass, &components(&hub.r_bc_b))?;
    check_mass(Part::Hub, hub.m_b, false)?;
    check_inertia(Part::Hub, &hub.i_b_bc)
}

/// Checks what a structure's model contains at a mount. Its inertia comes of one about B, so the
/// rounding of the parallel axes, `m |c|²`, is part of the bound: a point mass has none of its own.
pub(crate) fn check_contained<T: Scalar>(body: &Hub<T>) -> Result<(), ParameterError<T>> {
    let (part, centre) = (Part::Hub, components(&body.r_bc_b));
    finite(part, Parameter::Mass, &[body.m_b])?;
    finite(part, Parameter::CentreOfMass, &centre)?;
    check_mass(part, body.m_b, false)?;
    check_moved_inertia(part, &body.i_b_bc, body.m_b * dot(centre, centre))?;
    Ok(())
}

/// Checks a device.
pub(crate) fn check_device<K: Kind>(device: usize, p: &K) -> Result<(), ParameterError<K::Scalar>> {
    let part = |info: &JointInfo| Part::Body { device, body: info.body };
    let first = K::JOINTS.first().map_or(Part::Hub, part);
    check_mount(first, device, p.mount())?;
    for (body, info) in p.bodies().values().zip(K::JOINTS) {
        let part = part(info);
        finite(part, Parameter::Origin, &body.origin)?;
        finite(part, Parameter::CentreOfMass, &body.centre)?;
        finite(part, Parameter::Mass, &[body.mass])?;
        check_mass(part, body.mass, !info.tip)?;
    }
    for (passive, info) in p.passive().values().zip(K::JOINTS) {
        check_passive(part(info), &passive)?;
    }
    for (body, info) in p.bodies().values().zip(K::JOINTS) {
        check_inertia(part(info), &body.inertia)?;
    }
    Ok(())
}

/// By how much the largest principal moment of an accepted inertia exceeds the sum of the other
/// two, kg m^2; zero where it does not.
pub(crate) fn triangle_excess<T: Scalar>(inertia: &Matrix3<T>) -> T {
    check_inertia(Part::Hub, inertia).unwrap_or_else(|_| zero())
}

fn check_passive<T: Scalar>(part: Part, passive: &Passive<T>) -> Result<(), ParameterError<T>> {
    for (name, value) in passive.named() {
        finite(part, Parameter::Passive(name), &[value])?;
    }
    let Passive { stiffness, viscous, coulomb, coulomb_rate, .. } = *passive;
    for (name, value) in [("stiffness", stiffness), ("viscous", viscous), ("coulomb", coulomb)] {
        if value < zero() {
            return Err(ParameterError::Passive { part, name, value });
        }
    }
    if coulomb > zero() && coulomb_rate <= zero() {
        return Err(ParameterError::Passive { part, name: "coulomb_rate", value: coulomb_rate });
    }
    Ok(())
}

pub(crate) fn rounding<T: Scalar>() -> T {
    T::from_f64(ROUNDING_EPSILONS) * T::EPSILON
}

pub(crate) fn finite<T: Scalar>(
    part: Part,
    parameter: Parameter,
    values: &[T],
) -> Result<(), ParameterError<T>> {
    match values.iter().find(|value| !value.is_finite()) {
        Some(&value) => Err(ParameterError::NotFinite { part, parameter, value }),
        None => Ok(()),
    }
}

fn finite_matrix<T: Scalar>(
    part: Part,
    parameter: Parameter,
    [x, y, z]: &Columns<T>,
) -> Result<(), ParameterError<T>> {
    finite(part, parameter, x)?;
    finite(part, parameter, y)?;
    finite(part, parameter, z)
}

fn check_mass<T: Scalar>(part: Part, value: T, massless: bool) -> Result<(), ParameterError<T>> {
    if value > zero() || (massless && value == zero()) {
        Ok(())
    } else {
        Err(ParameterError::Mass { part, massless, value })
    }
}

/// Finite, symmetric and positive semidefinite to rounding, relative to the largest element. The
/// result is what the largest principal moment has above the sum of the other two, or zero.
fn check_inertia<T: Scalar>(part: Part, inertia: &Matrix3<T>) -> Result<T, ParameterError<T>> {
    check_moved_inertia(part, inertia, zero())
}

/// As [`check_inertia`], of an inertia that is the difference of two of this size.
fn check_moved_inertia<T: Scalar>(
    part: Part,
    inertia: &Matrix3<T>,
    size: T,
) -> Result<T, ParameterError<T>> {
    let [x, y, z] = columns(inertia);
    finite_matrix(part, Parameter::Inertia, &[x, y, z])?;

    let tensor = Symmetric::part_of(inertia);
    let bound = rounding::<T>() * tensor.largest_element().max(size);
    for (row, column, difference) in [(1, 2, y[0] - x[1]), (1, 3, z[0] - x[2]), (2, 3, z[1] - y[2])]
    {
        if difference.abs() > bound {
            return Err(ParameterError::Asymmetric { part, row, column, difference, bound });
        }
    }

    let [least, middle, most] = tensor.principal_moments();
    if least < -bound {
        return Err(ParameterError::NegativeInertia { part, value: least, bound: -bound });
    }
    if !most.is_finite() {
        return Err(ParameterError::LargeInertia { part, value: most });
    }
    // Negative by rounding counts as zero: the excess is not above the largest moment, thus finite.
    let excess = most - (least.max(zero()) + middle.max(zero()));
    Ok(if excess > bound { excess } else { zero() })
}

fn check_mount<T: Scalar>(
    part: Part,
    device: usize,
    mount: &Matrix3<T>,
) -> Result<(), ParameterError<T>> {
    let [x, y, z] = columns(mount);
    finite_matrix(part, Parameter::Mount, &[x, y, z])?;

    let mut residual = zero::<T>();
    for product in [dot(x, x) - one(), dot(y, y) - one(), dot(z, z) - one()] {
        residual = residual.max(product.abs());
    }
    for product in [dot(x, y), dot(x, z), dot(y, z)] {
        residual = residual.max(product.abs());
    }
    let bound = rounding();
    if residual > bound {
        return Err(ParameterError::SkewedMount { device, residual, bound });
    }
    let determinant = dot(x, cross(y, z));
    if determinant > zero() {
        Ok(())
    } else {
        Err(ParameterError::LeftHandedMount { device, determinant })
    }
}
