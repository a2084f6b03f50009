//! Recursions along the chain in local frames, each emitted as a function of its own.
//!
//! - [`axes`]: axes and origins of the bodies, outwards;
//! - [`composite`]: composite of the bodies outboard of each joint, inwards: mass matrix and bias, energy and momenta;
//! - [`loads`]: inverse dynamics, what each joint's parent body must exert;
//! - `load_derivatives`: what `loads` changes by, by coordinates, rates and accelerations; below it the moment of the
//!   momenta of a composite, `momenta`;
//! - [`external`]: applied wrenches, summed inwards;
//! - [`gravity`]: wrenches of a field on the bodies;
//! - `steering`: what rates and accelerations of the joints require about B, one by one.

pub mod axes;
pub mod composite;
pub mod external;
pub mod gravity;
pub(crate) mod load_derivatives;
pub mod loads;
mod momenta;
pub(crate) mod steering;
