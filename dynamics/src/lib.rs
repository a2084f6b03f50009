//! The solver over the emitted kernels: fully coupled dynamics of a rigid hub with imbalanced
//! momentum devices, hinged panels and slosh masses.
//!
//! Computes all accelerations of a state and its inputs, or returns a typed error. `no_std`, no
//! heap, no `unsafe`, no panic on input; bit-identical on every IEEE-754 target. SI units and
//! radians everywhere. Conventions are documented with the kinds and [`State`], the equations in
//! the emitted text under [`generated`]. What a step calls, in order: `docs/architecture.md`, *One
//! step, call by call*.
//!
//! A spacecraft has any [set of devices](Devices): `[Dgvscmg; 4]`, or
//! `([ReactionWheel; 3], Sgcmg, HingedPanel)`, or with the feature `alloc` a vector of
//! [`BuiltIn`]. Joints may be driven, prescribed or locked ([`Mode`]), the hub free, fixed or
//! prescribed ([`HubMode`]); [`Spacecraft::loads`] returns the motor torques that this needs and
//! the load on every joint, [`Spacecraft::ledger`] the power of every source;
//! [`Spacecraft::derivatives`] and [`Spacecraft::parameter_derivatives`] differentiate what they
//! compute. Many states at a time: `lanes::Batch`, with the feature `lanes`.
//!
//! ```
//! use nalgebra::{Matrix3, Vector3};
//! use precess_dynamics::{About, Dgvscmg, Hub, Inputs, Spacecraft, State};
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
//! let mut state: State<[Dgvscmg; 1]> = State::at_rest();
//! state.devices[0].spin = 50.0;
//! let mut inputs: Inputs<[Dgvscmg; 1]> = Inputs::none();
//! inputs.motors[0].u_w = 0.2;
//!
//! // The motor spins the wheel up and turns the hub back: the sum is conserved.
//! let before = spacecraft.momentum(&state, About::CentreOfMass)?;
//! for _ in 0..100 {
//!     state = spacecraft.step(&state, &inputs, 1e-3)?;
//! }
//! let after = spacecraft.momentum(&state, About::CentreOfMass)?;
//! assert!(state.devices[0].spin > 50.0 && state.omega.x < 0.0);
//! assert!((after.angular - before.angular).norm() < 1e-10);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

#![no_std]
#![expect(
    private_bounds,
    reason = "only this crate has structures: its traits of them are private"
)]

#[cfg(test)]
extern crate std;

#[cfg(feature = "alloc")]
extern crate alloc;

#[cfg(all(feature = "lanes", not(test)))]
extern crate std;

mod attitude;
mod derivatives;
mod equations;
mod flexible;
pub mod generated;
mod integrate;
mod isolation;
#[cfg(feature = "lanes")]
pub mod lanes;
mod model;
mod numbers;
mod results;
mod rigid;
mod sets;
mod solve;
mod steering;
mod validation;

pub use attitude::mrp::Mrp;
pub use attitude::parameterisation::Attitude;
pub use attitude::quaternion::Quaternion;
#[cfg(feature = "alloc")]
pub use derivatives::acceleration_derivatives::AccelerationDerivatives;
pub use derivatives::dual::column::{Column, Outputs};
pub use derivatives::error::DerivativeError;
pub use derivatives::fixed_linearization::LinearizationWorkspace;
#[cfg(feature = "alloc")]
pub use derivatives::linearization::{Linearization, Output};
pub use derivatives::parameters::columns::{Component, ParameterVariable};
#[cfg(feature = "alloc")]
pub use derivatives::parameters::direction::ParameterDirection;
#[cfg(feature = "alloc")]
pub use derivatives::step::along::WithChanges;
#[cfg(feature = "alloc")]
pub use derivatives::step::linearization::StepLinearization;
pub use derivatives::structure::Structure;
pub use derivatives::variable::{Axis, Variable, VariableName};
pub use equations::device_loads::{DeviceLoads, JointPower};
pub use equations::error::{Quantity, SolveError};
pub use equations::gravity::Gravity;
pub use flexible::modal::inputs::ModalInputs;
pub use flexible::modal::modes::{ContainedBody, ModalMount, ModalPoint, Modes};
pub use flexible::modal::modes_error::{ModalQuantity, ModesError, ResidualFault};
pub use flexible::modal::state::{ModalAccelerations, ModalState};
#[cfg(feature = "alloc")]
pub use flexible::modal::storage::ListedModes;
pub use flexible::modal::storage::{FixedModes, Flexible, ModalStorage};
pub use flexible::results::ledger::ModalLedger;
pub use flexible::results::loads::ModalLoads;
pub use flexible::results::point::{PointAcceleration, PointMotion};
pub use generated::devices::*;
pub use integrate::rk4::Stepped;
pub use integrate::stop::Stopped;
pub use isolation::carrier::Carrier;
pub use isolation::panel::CarryingPanel;
pub use isolation::parameters::Platform;
pub use isolation::suspension::{Coupled, Strut, Suspension};
pub use model::joint_array::{JointArray, MAX_JOINTS};
pub use model::kind::{self, ImbalanceModel};
pub use model::mode::{HubMode, Mode};
pub use model::parameter_info::{NameError, ParameterInfo, ParameterMut, ParameterValue, Shape};
pub use model::parameters::Hub;
pub use model::passive::Passive;
pub use model::units;
pub use model::wrench::Wrench;
pub use numbers::dual::Dual;
pub use numbers::each::{Each, JointStates, Value};
pub use numbers::real::{Angle, Real, Scalar};
pub use results::contributions::{DeviceContributions, JointGains};
pub use results::joint_by_joint::JointReading;
pub use results::ledger::{Ledger, Power};
pub use results::loads::{LoadAxes, Loads};
pub use results::momentum::{About, CentreOfMass, EnergyAndMomentum, Momentum};
pub use sets::built_in::{BuiltIn, BuiltInKind};
pub use sets::carrying::{Carrying, Isolated, OnPanel};
pub use sets::device_parameters::{DeviceParameters, UnsupportedParameter};
pub use sets::devices::{DeviceSet, Devices, FixedSet};
pub use solve::inputs::Inputs;
pub use solve::spacecraft::Spacecraft;
pub use solve::state::{Accelerations, State};
pub use solve::structure::{Rigid, StructureData};
pub use steering::error::SteeringError;
pub use steering::law::{Allocation, Dither, Inverse, SteeringLaw, steering_weights};
pub use steering::matrix::{Steered, SteeringMatrix};
pub use steering::servo::{Servo, ServoTorques};
pub use steering::terms::SteeringTerms;
pub use steering::wheels::KeepOut;
pub use validation::imbalance::{Imbalance, WheelImbalance};
pub use validation::imbalance_error::{ImbalanceError, ImbalanceQuantity};
pub use validation::parameter_error::{Parameter, ParameterError, Part, Warning};

/// Data of a platform's joints, by name, and of a [`Carrying`] set.
pub mod platform {
    pub use crate::isolation::records::{Data, JointAccelerations, Joints, MotorTorques, PerJoint};
}

/// Sets of devices from the inside: data in the shape of a set, and visitors of its members.
pub mod set {
    pub use crate::equations::device::Device;
    pub use crate::equations::joint_inputs::JointInputs;
    pub use crate::isolation::carrier_elimination::CarrierConstants;
    pub use crate::sets::bundle::{Bundle, Given, Maybe, MemberIndex, Part, Shared, Unique};
    pub use crate::sets::carrying::PreparedCarrying;
    pub use crate::sets::carrying_numbers::CarrierNumbers;
    pub use crate::sets::devices::{List, Visit};
    pub use crate::sets::enumeration::{DeviceEnum, Variant, WithKind};
    #[doc(hidden)]
    pub use crate::sets::enumeration::{Listed, NewData, Visited};
    #[doc(hidden)]
    pub use crate::sets::groups::set_groups_of_enum;
    pub use crate::sets::kind_data::{KindData, KindDataMut};
    pub use crate::sets::per_device::OnMount;
    pub use crate::sets::per_device::{
        Accelerations, EnumLoads, Gains, Joints, Loads, Motors, PerDevice, PerJoint,
    };
    pub use crate::sets::with_numbers::{Change, WithNumbers};
}

/// Any thread may own or borrow any value of this crate: checked when the tests are compiled.
#[cfg(test)]
const _: () = {
    const fn shareable<T: Send + Sync>() {}
    const fn of_set<D: Devices>()
    where
        Spacecraft<D>: Send + Sync,
        State<D>: Send + Sync,
        Inputs<D>: Send + Sync,
        Accelerations<D>: Send + Sync,
        Loads<D>: Send + Sync,
    {
    }
    const fn of_scalar<T: Scalar>() {
        shareable::<(Hub<T>, Wrench<T>, Passive<T>, Mode<T>, HubMode<T>, Gravity<T>)>();
        shareable::<(About<T>, Momentum<T>, CentreOfMass<T>, Ledger<T>)>();
        shareable::<(ParameterError<T>, Warning<T>, Part, Parameter)>();
        shareable::<(Imbalance<T>, WheelImbalance<T>, ImbalanceError<T>, ImbalanceQuantity)>();
        shareable::<(SolveError<T>, Quantity)>();
    }
    of_set::<[Dgvscmg; 4]>();
    #[cfg(feature = "alloc")]
    of_set::<alloc::vec::Vec<BuiltIn>>();
    of_set::<([ReactionWheel<f32>; 4], Sgcmg<f32>, SloshMass<f32>)>();
    of_scalar::<f64>();
    of_scalar::<f32>();
};
