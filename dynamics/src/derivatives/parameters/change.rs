//! [`add_change`]: what the structure of a device, or of the hub, changes by with one of its parameters.

use crate::derivatives::error::DerivativeError;
use crate::derivatives::parameters::columns::{Component, ParameterVariable};
use crate::derivatives::variable::Axis;
use crate::model::kind::Kind;
use crate::model::parameter_info::{NameError, ParameterMut, ParameterValue, Shape, find};
use crate::model::parameters::Hub;
use crate::numbers::real::{Scalar, one, zero};
use crate::numbers::vec3::{Columns, cross};
use crate::validation::imbalance::WheelImbalance;

/// Adds what the hub changes by with a parameter of it.
pub(crate) fn add_hub_change<U: Scalar>(
    hub: &mut Hub<U>,
    variable: ParameterVariable<'_>,
    add: impl Fn(&mut U),
) {
    match variable {
        ParameterVariable::HubCentre(axis) => add(axis.of_mut(&mut hub.r_bc_b)),
        ParameterVariable::HubInertia(row, column) => {
            each_element(&mut hub.i_b_bc.data.0, row, column, add);
        }
        _ => add(&mut hub.m_b),
    }
}

/// Adds to `to` what a device changes by with a parameter of it, `device` being its number: each number of its
/// structure by `add`. Its values are those of `of`.
pub(crate) fn add_change<T: Scalar, K: Kind, F: Kind>(
    to: &mut K,
    (of, value): (&F, impl Fn(F::Scalar) -> T + Copy),
    (device, variable): (usize, ParameterVariable<'_>),
    add: impl Fn(&mut K::Scalar, T) + Copy,
) -> Result<(), DerivativeError<T>> {
    match variable {
        ParameterVariable::Device { name, component, .. } => {
            let error = |name| DerivativeError::NoSuchParameter { device, name };
            add_named(to, name, component, |number| add(number, one())).map_err(error)
        }
        ParameterVariable::MountRotation { about, .. } => {
            if let Some(ParameterMut::Matrix(mount)) = to.parameter_mut("mount") {
                let columns = mount.data.0.iter_mut().zip(of.mount().data.0);
                for (column, from) in columns {
                    let turned = cross(unit(about), from.map(value));
                    for (element, change) in column.iter_mut().zip(turned) {
                        add(element, change);
                    }
                }
            }
            Ok(())
        }
        _ => add_imbalance(to, (of, value), (device, variable), add),
    }
}

/// The unit vector along an axis.
pub(crate) fn unit<T: Scalar>(axis: Axis) -> [T; 3] {
    Axis::ALL.map(|other| if other == axis { one() } else { zero() })
}

/// Each element of a symmetric tensor in a row and a column: one on the diagonal.
fn each_element<U>(tensor: &mut Columns<U>, row: Axis, column: Axis, add: impl Fn(&mut U)) {
    for (of, elements) in Axis::ALL.into_iter().zip(tensor) {
        for (at, element) in Axis::ALL.into_iter().zip(elements) {
            if (at, of) == (row, column) || (of, at) == (row, column) {
                add(element);
            }
        }
    }
}

fn add_named<K: Kind>(
    device: &mut K,
    name: &str,
    component: Component,
    add: impl Fn(&mut K::Scalar),
) -> Result<(), NameError> {
    let info = K::PARAMETERS.iter().find(|info| info.name == name);
    // What the table leaves out is of a joint: one number.
    let required = info.map_or(Shape::Scalar, |info| info.shape);
    match (find(device, name), component, required) {
        (None, ..) => return Err(NameError::Unknown { kind: K::NAME }),
        (Some(ParameterMut::Scalar(of)), Component::Number, _) => add(of),
        (Some(ParameterMut::Vector(of)), Component::Along(axis), _) => add(axis.of_mut(of)),
        (Some(ParameterMut::Matrix(of)), Component::Element(row, column), Shape::Symmetric) => {
            each_element(&mut of.data.0, row, column, add);
        }
        _ => return Err(NameError::Shape { kind: K::NAME, required }),
    }
    Ok(())
}

/// By static or dynamic imbalance or phase: `d`, `J_12` and `J_13` change as [`Imbalance`](crate::Imbalance) says.
fn add_imbalance<T: Scalar, K: Kind, F: Kind>(
    to: &mut K,
    (of, value): (&F, impl Fn(F::Scalar) -> T + Copy),
    (device, variable): (usize, ParameterVariable<'_>),
    add: impl Fn(&mut K::Scalar, T) + Copy,
) -> Result<(), DerivativeError<T>> {
    let parameters = [of.parameter("m_w"), of.parameter("d"), of.parameter("i_w_wc")];
    let [
        Ok(ParameterValue::Scalar(m_w)),
        Ok(ParameterValue::Scalar(d)),
        Ok(ParameterValue::Matrix(inertia)),
    ] = parameters
    else {
        return Err(DerivativeError::NoImbalance { device });
    };
    let (m_w, d, [j_12, j_13]) = (value(m_w), value(d), [inertia.m12, inertia.m13].map(value));
    let polar = WheelImbalance { d, j_12, j_13 }.polar(m_w);
    let (_, _, [cosine, sine]) =
        polar.map_err(|error| DerivativeError::Imbalance { device, error })?;
    // The phase of a negative d counts from -w_y, so that sheet is of a wheel half a turn on.
    let sense = if d < zero() { -one::<T>() } else { one() };
    let none = zero();
    let [by_d, by_j_12, by_j_13] = match variable {
        ParameterVariable::StaticImbalance { .. } => [sense * m_w.recip(), none, none],
        ParameterVariable::DynamicImbalance { .. } => [none, -(sense * sine), sense * cosine],
        _ => [none, -j_13, j_12],
    };
    if let Some(ParameterMut::Scalar(d)) = to.parameter_mut("d") {
        add(d, by_d);
    }
    if let Some(ParameterMut::Matrix(inertia)) = to.parameter_mut("i_w_wc") {
        let tensor = &mut inertia.data.0;
        each_element(tensor, Axis::X, Axis::Y, |number| add(number, by_j_12));
        each_element(tensor, Axis::X, Axis::Z, |number| add(number, by_j_13));
    }
    Ok(())
}
