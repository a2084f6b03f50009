//! What is given of a joint. SI units and radians.

/// What is given of a joint that has a motor.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Drive {
    /// The torque, N m, or force, N, on the child body and reversed on the parent body.
    Torque(f64),
    /// The acceleration, rad/s² or m/s²; zero where the joint is locked at a rate of zero.
    Acceleration(f64),
}

impl Drive {
    /// Torque; one where it is given, else zero; the other way round; acceleration.
    pub(crate) fn numbers(self) -> (f64, f64, f64, f64) {
        match self {
            Self::Torque(torque) => (torque, 1.0, 0.0, 0.0),
            Self::Acceleration(given) => (0.0, 0.0, 1.0, given),
        }
    }
}
