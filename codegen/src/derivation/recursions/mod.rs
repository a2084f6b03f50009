//! Recursions along the chain in local frames, each emitted as a function of its own.
//!
//! - [`axes`]: axes and origins of the bodies, outwards;
//! - [`composite`]: composite of the bodies outboard of each joint, inwards: mass matrix and bias, energy and momenta;
//! - [`loads`]: inverse dynamics, what each joint's parent body must exert;
//! - [`external`]: applied wrenches, summed inwards;
//! - [`gravity`]: wrenches of a field on the bodies;
//! - [`steering`]: what rates and accelerations of the joints require about B, one by one.

pub mod axes;
pub mod composite;
pub mod external;
pub mod gravity;
pub mod loads;
pub(crate) mod steering;
