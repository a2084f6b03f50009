//! Checks of a [`Suspension`]: finite numbers, matrices that are symmetric and positive
//! semidefinite, struts with a length and a direction.

use crate::equations::suspension_forces::Six;
use crate::isolation::suspension::{Strut, Suspension};
use crate::numbers::real::{Scalar, one, zero};
use crate::numbers::vec3::{components, dot};
use crate::validation::check::{finite, rounding};
use crate::validation::parameter_error::{Parameter, ParameterError, Part};

/// Checks the suspension of a platform that is the device of this number.
pub(crate) fn check_suspension<T: Scalar>(
    device: usize,
    suspension: &Suspension<T>,
) -> Result<(), ParameterError<T>> {
    let part = Part::Body { device, body: "platform" };
    if let Some(coupled) = &suspension.coupled {
        let [rest] = coupled.rest.data.0;
        finite(part, Parameter::Passive("suspension rest"), &rest)?;
        check_matrix(device, "stiffness", &coupled.stiffness.data.0)?;
        check_matrix(device, "damping", &coupled.damping.data.0)?;
    }
    for (index, strut) in suspension.struts.iter().enumerate() {
        if let Some(strut) = strut {
            check_strut(device, index, strut)?;
        }
    }
    Ok(())
}

fn check_strut<T: Scalar>(
    device: usize,
    strut: usize,
    of: &Strut<T>,
) -> Result<(), ParameterError<T>> {
    let part = Part::Body { device, body: "platform" };
    finite(part, Parameter::Passive("strut position"), &components(&of.position))?;
    finite(part, Parameter::Passive("strut direction"), &components(&of.direction))?;
    let numbers = [of.length, of.stiffness, of.damping];
    finite(part, Parameter::Passive("length, stiffness or damping of a strut"), &numbers)?;
    let reject = |name, value| Err(ParameterError::Strut { device, strut, name, value });
    let direction = components(&of.direction);
    let size = dot(direction, direction);
    if (size - one()).abs() > rounding() {
        return reject("squared length of the direction", size);
    }
    if of.length <= zero() {
        return reject("length", of.length);
    }
    if of.stiffness < zero() {
        return reject("stiffness", of.stiffness);
    }
    if of.damping < zero() {
        return reject("damping", of.damping);
    }
    Ok(())
}

/// Finite, symmetric and positive semidefinite to rounding, each element in units of the roots of
/// its diagonal elements.
fn check_matrix<T: Scalar>(
    device: usize,
    name: &'static str,
    m: &[Six<T>; 6],
) -> Result<(), ParameterError<T>> {
    let part = Part::Body { device, body: "platform" };
    for column in m {
        finite(part, Parameter::Passive(name), column)?;
    }
    let mut roots = [zero::<T>(); 6];
    for (index, root) in roots.iter_mut().enumerate() {
        let value = m[index][index];
        if value < zero() {
            return Err(ParameterError::Suspension { device, name, value, bound: zero() });
        }
        *root = value.sqrt();
    }
    let bound = rounding::<T>();
    let mut scaled = [[zero::<T>(); 6]; 6];
    for row in 0..6 {
        for column in 0..6 {
            let (above, below) = (m[column][row], m[row][column]);
            let (size, difference) = (roots[row] * roots[column], (above - below).abs());
            if difference > bound * size.max(above.abs()) {
                let (row, column) = (row.wrapping_add(1), column.wrapping_add(1));
                let difference = above - below;
                let (row, column) = (row.min(column), row.max(column));
                return Err(ParameterError::AsymmetricSuspension {
                    device,
                    name,
                    row,
                    column,
                    difference,
                });
            }
            if size > zero() {
                scaled[row][column] = above * size.recip();
            } else if above != zero() {
                let value = -above.abs();
                return Err(ParameterError::Suspension { device, name, value, bound: zero() });
            }
        }
    }
    check_pivots(device, name, scaled)
}

/// Pivots of a matrix of unit diagonal, and zero where one is only rounding.
fn check_pivots<T: Scalar>(
    device: usize,
    name: &'static str,
    mut m: [Six<T>; 6],
) -> Result<(), ParameterError<T>> {
    let bound = rounding::<T>();
    for pivot in 0..6 {
        let value = m[pivot][pivot];
        let reject = |value| Err(ParameterError::Suspension { device, name, value, bound: -bound });
        if value < -bound {
            return reject(value);
        }
        for row in pivot + 1..6 {
            let element = m[row][pivot];
            if value <= bound {
                // Of a positive semidefinite matrix it is at most the root of the pivot's size.
                if element * element > bound {
                    return reject(-element.abs());
                }
                continue;
            }
            let factor = element * value.recip();
            let of_pivot = m[pivot];
            for (entry, of_pivot) in m[row].iter_mut().zip(of_pivot).skip(pivot + 1) {
                *entry = *entry - factor * of_pivot;
            }
        }
    }
    Ok(())
}
