//! The solver over the emitted kernels: fully coupled dynamics of a rigid hub with `N` imbalanced
//! double-gimbal variable-speed control moment gyros.
//!
//! State and torques go in, all `6 + 3 N` accelerations come out, or a typed error. `no_std`, no
//! heap, no `unsafe`, no panic on input; the same bits on every IEEE-754 target. SI units and
//! radians everywhere. Conventions stand with [`Dgvscmg`] and [`State`], the equations in the
//! emitted text under [`generated`].
//!
//! ```
//! use nalgebra::{Matrix3, Vector3};
//! use precess_dynamics::{About, Dgvscmg, Hub, Spacecraft, State, Torques};
//!
//! // A hub of 800 kg and one wheel of 4 kg, 0.3 m from B, 0.08 mm off balance.
//! let hub = Hub {
//!     m_b: 800.0,
//!     r_bc_b: Vector3::zeros(),
//!     i_b_bc: Matrix3::from_diagonal(&Vector3::new(900.0, 800.0, 600.0)),
//! };
//! let wheel = Dgvscmg {
//!     r_go_b: Vector3::new(0.3, 0.0, 0.0),
//!     d: 0.08e-3,
//!     ..Dgvscmg::bare_wheel(4.0, Matrix3::from_diagonal(&Vector3::new(0.2, 0.1, 0.1)))
//! };
//! let spacecraft = Spacecraft::new(&hub, &[wheel])?;
//! assert_eq!(spacecraft.warnings().count(), 0);
//!
//! let mut state: State<1> = State::at_rest();
//! state.devices[0].spin = 50.0;
//! let mut torques = Torques::none();
//! torques.motors[0].u_w = 0.2;
//!
//! // The motor spins the wheel up and turns the hub back: the sum is conserved.
//! let before = spacecraft.momentum(&state, About::CentreOfMass)?;
//! for _ in 0..100 {
//!     state = spacecraft.step(&state, &torques, 1e-3)?;
//! }
//! let after = spacecraft.momentum(&state, About::CentreOfMass)?;
//! assert!(state.devices[0].spin > 50.0 && state.omega.x < 0.0);
//! assert!((after.angular - before.angular).norm() < 1e-10);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

#![no_std]

#[cfg(test)]
extern crate std;

mod attitude;
#[cfg(test)]
mod attitude_checks;
mod device;
mod error;
mod finite;
pub mod generated;
mod hub;
mod imbalance;
#[cfg(test)]
mod imbalance_checks;
mod imbalance_error;
mod momentum;
mod mrp;
#[cfg(test)]
mod overflow_checks;
mod parameter_error;
mod parameters;
mod quaternion;
mod real;
mod rk4;
mod solve;
mod spacecraft;
mod state;
mod symmetric;
pub mod units;
mod validation;
mod vec3;

pub use attitude::Attitude;
pub use error::{Joint, JointField, Quantity, SolveError};
pub use imbalance::{Imbalance, WheelImbalance};
pub use imbalance_error::{ImbalanceError, ImbalanceQuantity};
pub use momentum::{About, CentreOfMass, Momentum};
pub use mrp::Mrp;
pub use parameter_error::{Parameter, ParameterError, Part, Warning};
pub use parameters::{Dgvscmg, Hub};
pub use quaternion::Quaternion;
pub use real::{Real, Scalar};
pub use spacecraft::Spacecraft;
pub use state::{Accelerations, JointAccelerations, Joints, MotorTorques, State, Torques};

/// Any thread may own or borrow any value of this crate: checked when the tests are compiled.
#[cfg(test)]
const _: () = {
    const fn shareable<T: Send + Sync>() {}
    const fn of_scalar<T: Scalar>() {
        shareable::<Spacecraft<4, T>>();
        shareable::<State<4, T>>();
        shareable::<State<4, T, Mrp<T>>>();
        shareable::<Torques<4, T>>();
        shareable::<Accelerations<4, T>>();
        shareable::<(Hub<T>, Dgvscmg<T>)>();
        shareable::<(About<T>, Momentum<T>, CentreOfMass<T>)>();
        shareable::<(ParameterError<T>, Warning<T>, Part, Parameter)>();
        shareable::<(Imbalance<T>, WheelImbalance<T>, ImbalanceError<T>, ImbalanceQuantity)>();
        shareable::<(SolveError<T>, Quantity, Joint, JointField)>();
    }
    of_scalar::<f64>();
    of_scalar::<f32>();
};
