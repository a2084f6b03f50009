//! Quantities with written units: `4 kg`, `6000 rpm`, `32 g cm`, `-0.02, 0.01, 10 cm`.
//!
//! A unit is a product of powers of the symbols of `symbols`, and what a key wants is a
//! [`Measure`]: a dimension and the unit that an error names. The plane angle is a
//! dimension of its own, so an angular rate in hertz is an error and not a factor of 2 pi; so are hertz within any
//! other unit of a rate, `N/Hz^2`. What data sheets write is read where it has one reading.
//! Torque and energy have one dimension; which of them is meant is known by the key.
//!
//! Powers of ten are not multiplied: `0.08 mm` is the number `0.08e-3` as a compiler reads it. A
//! unit that is no power of ten of SI costs one rounding, or two.
//!
//! The parser is ours: `uom` 0.38 parses one unit of a quantity known at compile time, and
//! `dyn_quantity` 0.5 takes the radian for the number one and has no rpm.

mod error;
mod expression;
mod measure;
mod plain;
mod symbols;
mod unit;

pub use error::{UnitError, UnitErrorKind};
pub use expression::{Quantity, parse_quantity, parse_unit};
pub use measure::{Dimension, Measure, measure_of};
pub(crate) use plain::Plain;
