//! Vectors and tensors that carry their frame in the type, and the turn between two frames.

mod frame;
mod tensor;
mod vector;

pub use frame::{Axis, BodyFrame, Frame, Hub, ParentFrame, Turn};
pub use tensor::{ENTRIES, Symmetric};
pub use vector::{Vector, XYZ};
