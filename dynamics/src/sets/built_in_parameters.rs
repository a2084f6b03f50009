//! [`BuiltInParameters`]: a device of whatever kind as bodies and joints, and [`Misfit`], what a
//! kind has no parameter for.

use core::error::Error;
use core::fmt::{self, Display, Formatter};

use nalgebra::Matrix3;

use crate::model::few::MAX_JOINTS;
use crate::model::kind::{BodyParameters, ImbalanceModel, Kind, no_inertia};
use crate::model::passive::Passive;
use crate::numbers::each::{Each, Value};
use crate::numbers::real::{Scalar, zero};
use crate::validation::parameter_error::Parameter;

/// A device as bodies and joints, which every kind can be stated in.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BuiltInParameters<T = f64> {
    /// Columns: the device's axes expressed in B, which are those of its first body at zero.
    pub mount: Matrix3<T>,
    /// The bodies from the hub to the tip, as many as the kind has joints; the first origin is
    /// along *B axes*, the others along those of the body before. What stands behind them is not
    /// read.
    pub bodies: [BodyParameters<T>; MAX_JOINTS],
    /// Spring, damper and friction of the joint before each body.
    pub passive: [Passive<T>; MAX_JOINTS],
    /// Which model the imbalance of its wheel has.
    pub model: ImbalanceModel,
}

/// A parameter that is not zero, or not symmetric, where the kind has it so.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Misfit {
    /// The body.
    pub body: &'static str,
    /// Its parameter; none for the model of the imbalance.
    pub parameter: Option<Parameter>,
}

impl Display for Misfit {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        let Self { body, parameter } = self;
        match parameter {
            Some(parameter) => write!(
                f,
                "{parameter} of the {body} is none that the kind can have; set to 0 what the kind \
                 has no parameter for, or use an imbalanced kind"
            ),
            None => write!(
                f,
                "the kind has no imbalance of the {body} that could be lumped; use the coupled model"
            ),
        }
    }
}

impl Error for Misfit {}

/// The device of a kind that is made of these bodies.
pub(crate) fn made<K: Kind>(stated: &BuiltInParameters<K::Scalar>) -> Result<K, Misfit> {
    let mut bodies = K::all(no_body());
    copy(&mut bodies, stated.bodies);
    let mut passive = K::all(Passive::none());
    copy(&mut passive, stated.passive);
    let made = K::of_bodies(&stated.mount, &bodies, &passive, stated.model);
    let taken = made.bodies();
    for ((asked, taken), info) in bodies.values().zip(taken.values()).zip(K::JOINTS) {
        let misfit = |parameter| Err(Misfit { body: info.body, parameter: Some(parameter) });
        if !same(&asked.centre, &taken.centre) {
            return misfit(Parameter::CentreOfMass);
        }
        if !same(asked.inertia.as_slice(), taken.inertia.as_slice()) {
            return misfit(Parameter::Inertia);
        }
    }
    if made.model() != stated.model {
        let body = K::JOINTS.last().map_or("device", |tip| tip.body);
        return Err(Misfit { body, parameter: None });
    }
    Ok(made)
}

/// The bodies of a device.
pub(crate) fn stated<K: Kind>(device: &K) -> BuiltInParameters<K::Scalar> {
    let mut bodies = [no_body(); MAX_JOINTS];
    for (to, from) in bodies.iter_mut().zip(device.bodies().values()) {
        *to = from;
    }
    let mut passive = [Passive::none(); MAX_JOINTS];
    for (to, from) in passive.iter_mut().zip(device.passive().values()) {
        *to = from;
    }
    BuiltInParameters { mount: *device.mount(), bodies, passive, model: device.model() }
}

fn copy<V: Value>(to: &mut impl Each<V>, from: impl IntoIterator<Item = V>) {
    for (to, from) in to.values_mut().zip(from) {
        *to = from;
    }
}

fn no_body<T: Scalar>() -> BodyParameters<T> {
    BodyParameters { origin: [zero(); 3], mass: zero(), centre: [zero(); 3], inertia: no_inertia() }
}

/// Whether all numbers are equal; what is no number equals itself, for validation to name.
fn same<T: Scalar>(a: &[T], b: &[T]) -> bool {
    a.iter().zip(b).all(|(a, b)| a == b || !(a.is_finite() || b.is_finite()))
}
