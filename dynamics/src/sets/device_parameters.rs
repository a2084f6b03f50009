//! [`DeviceParameters`]: a device of any kind as bodies and joints, and [`UnsupportedParameter`]:
//! one that a kind does not have.

use core::error::Error;
use core::fmt::{self, Display, Formatter};

use nalgebra::Matrix3;

use crate::model::joint_array::MAX_JOINTS;
use crate::model::kind::{BodyParameters, ImbalanceModel, Kind, no_body};
use crate::model::passive::Passive;
use crate::numbers::each::{Each, filled};
use crate::numbers::real::Scalar;
use crate::validation::parameter_error::Parameter;

/// Parameters of a device of any kind, by body and joint.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct DeviceParameters<T = f64> {
    /// Columns: the device's axes expressed in B, which are those of its first body at zero.
    pub mount: Matrix3<T>,
    /// The bodies from the hub to the tip, as many as the kind has joints; entries after them are
    /// not read. The first origin is expressed in B, the others in the axes of the parent body.
    pub bodies: [BodyParameters<T>; MAX_JOINTS],
    /// Spring, damper and friction of the joint of each body.
    pub passive: [Passive<T>; MAX_JOINTS],
    /// The model of the wheel's imbalance.
    pub model: ImbalanceModel,
}

/// A parameter is not zero, or not symmetric, though the kind requires it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct UnsupportedParameter {
    /// The body.
    pub body: &'static str,
    /// Its parameter; `None` for the model of the imbalance.
    pub parameter: Option<Parameter>,
}

impl Display for UnsupportedParameter {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        let Self { body, parameter } = self;
        match parameter {
            Some(parameter) => write!(
                f,
                "{parameter} of the {body} is not zero, or not symmetric, where the kind requires it; \
                 change it, or use an imbalanced kind"
            ),
            None => {
                write!(f, "the kind has no imbalance of the {body}; use the coupled model")
            }
        }
    }
}

impl Error for UnsupportedParameter {}

/// The device of a kind with these parameters.
pub(crate) fn device_of<K: Kind>(
    parameters: &DeviceParameters<K::Scalar>,
) -> Result<K, UnsupportedParameter> {
    let bodies = filled(K::all(no_body()), parameters.bodies);
    let passive = filled(K::all(Passive::none()), parameters.passive);
    let made = K::of_bodies(&parameters.mount, &bodies, &passive, parameters.model);
    let taken = made.bodies();
    for ((asked, taken), info) in bodies.values().zip(taken.values()).zip(K::JOINTS) {
        let unsupported =
            |parameter| Err(UnsupportedParameter { body: info.body, parameter: Some(parameter) });
        // A link without a body has no mass, a joint at the origin of its parent body no offset.
        if !same(&[asked.mass], &[taken.mass]) {
            return unsupported(Parameter::Mass);
        }
        if !same(&asked.origin, &taken.origin) {
            return unsupported(Parameter::Origin);
        }
        if !same(&asked.centre, &taken.centre) {
            return unsupported(Parameter::CentreOfMass);
        }
        if !same(asked.inertia.as_slice(), taken.inertia.as_slice()) {
            return unsupported(Parameter::Inertia);
        }
    }
    if made.model() != parameters.model {
        let body = K::JOINTS.last().map_or("device", |tip| tip.body);
        return Err(UnsupportedParameter { body, parameter: None });
    }
    Ok(made)
}

/// The parameters of a device.
pub(crate) fn parameters_of<K: Kind>(device: &K) -> DeviceParameters<K::Scalar> {
    let mut bodies = [no_body(); MAX_JOINTS];
    for (to, from) in bodies.iter_mut().zip(device.bodies().values()) {
        *to = from;
    }
    let mut passive = [Passive::none(); MAX_JOINTS];
    for (to, from) in passive.iter_mut().zip(device.passive().values()) {
        *to = from;
    }
    DeviceParameters { mount: *device.mount(), bodies, passive, model: device.model() }
}

/// Whether all numbers are equal; what is no number equals itself, for validation to name.
fn same<T: Scalar>(a: &[T], b: &[T]) -> bool {
    a.iter().zip(b).all(|(a, b)| a == b || !(a.is_finite() || b.is_finite()))
}
