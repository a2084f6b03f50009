//! What a sampled controller is made of, without scenarios, runs or devices: laws, and what they read.
//!
//! Plain numbers of `f64`; SI units and radians; nothing is allocated at a sample, and the same inputs give the same bits
//! on every host: without the standard library only `libm` has transcendental functions. B is the frame of the hub, N
//! inertial, R that of the reference; `omega_br` is the angular velocity of B relative to R.
//!
//! - [`Motion`], [`Reference`], [`Tracking`]: what is measured, what is wanted, and the difference;
//! - [`Law`]: from these to the torque on the spacecraft: [`MrpFeedback`],
//!   [`QuaternionFeedback`], [`RateDamping`];
//! - [`Guidance`]: references at a time: [`Hold`], [`Slew`], [`Turning`], [`AttitudeTable`];
//! - [`AnalogSection`], [`Section`], [`Filter`]: filters of second order, made discrete;
//! - [`Gyro`], [`StarTracker`], [`Accelerometer`], [`Quantum`] (of tachometers and encoders), [`DelayLine`]: sensors, with
//!   [`Noise`] by a seed;
//! - [`SampledPlant`], [`Feedback`], [`SampledLoop`]: a linear loop with hold and delay, its margins and poles;
//! - [`Mekf`]: attitude and gyro bias from a gyro and a star tracker;
//! - [`MomentumDumping`]: an external torque;
//! - [`rotation`]: quaternions as turns one after another.

#![no_std]

#[cfg(test)]
extern crate std;

extern crate alloc;

mod estimator;
mod filter;
mod law;
mod linear;
mod model;
mod reference;
mod sensor;

pub use estimator::covariance::Covariance;
pub use estimator::mekf::{Estimate, Mekf, MekfParameters};
pub use filter::analog::{AnalogSection, Discretisation};
pub use filter::cascade::Filter;
pub use filter::section::Section;
pub use law::damping::RateDamping;
pub use law::dumping::MomentumDumping;
pub use law::gyroscopic::Gyroscopic;
pub use law::mrp::{MrpFeedback, MrpGains};
pub use law::quaternion::QuaternionFeedback;
pub use law::{Law, Sample};
pub use linear::feedback::Feedback;
pub use linear::margins::{AtFrequency, AxisMargins, delay_margin};
pub use linear::plant::{Plant, SampledPlant, Sampling};
pub use linear::sampled_loop::{LoopResponse, SampledLoop};
pub use model::error::ControlError;
pub use model::motion::{Motion, Reference, Tracking};
pub use model::rotation;
pub use reference::Guidance;
pub use reference::profile::{Profile, ProfilePoint, TurnLimits};
pub use reference::slew::Slew;
pub use reference::table::{AttitudeRow, AttitudeTable};
pub use reference::turning::{Hold, Turning};
pub use sensor::accelerometer::{Accelerometer, AccelerometerParameters};
pub use sensor::delay::DelayLine;
pub use sensor::gyro::{Gyro, GyroOutput, GyroParameters};
pub use sensor::noise::Noise;
pub use sensor::quantum::Quantum;
pub use sensor::star_tracker::StarTracker;
