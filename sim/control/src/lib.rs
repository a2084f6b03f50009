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
//! - [`HeldPlant`], [`SampledPlant`], [`Feedback`], [`SampledLoop`], [`LoopCurve`]: a linear loop with hold and delay, its margins and
//!   poles;
//! - [`Mekf`]: attitude and gyro bias from a gyro and a star tracker;
//! - [`LineTracker`], [`DragTracker`]: imbalance line and drag torque of a rotor, followed on board in fixed memory;
//! - [`MomentumDumping`]: an external torque;
//! - [`Checkpoint`]: what all of these keep from sample to sample, as bytes;
//! - [`rotation`]: quaternions as turns one after another.
//!
//! A slew, as a controller samples it: sensors, estimator, reference, law.
//!
//! ```
//! use nalgebra::{Matrix3, Vector3};
//! use precess_control::{
//!     Covariance, Estimate, Guidance, Gyro, GyroOutput, GyroParameters, Law, Mekf, MekfParameters,
//!     QuaternionFeedback, Sample, Slew, StarTracker, TurnLimits, rotation,
//! };
//! use precess_dynamics::{Attitude, Quaternion};
//!
//! const PERIOD: f64 = 0.1;
//! let (walk, drift) = (1e-6, 1e-9);
//! let mut gyro = Gyro::new(
//!     &GyroParameters {
//!         output: GyroOutput::Integrating,
//!         period: PERIOD,
//!         angle_random_walk: walk,
//!         rate_random_walk: drift,
//!         bias: Vector3::new(1e-5, 0.0, -1e-5),
//!         quantum: 0.0,
//!     },
//!     1,
//!     "gyro",
//! )?;
//! let start = Quaternion::identity();
//! let mut star = StarTracker::new(start, Vector3::new(2e-5, 2e-5, 1e-4), 1, "star tracker")?;
//! let mut filter = Mekf::new(
//!     &MekfParameters {
//!         period: PERIOD,
//!         angle_random_walk: walk,
//!         rate_random_walk: drift,
//!         measured: star.covariance(),
//!         longest_latency: 0,
//!     },
//!     &Estimate {
//!         attitude: start,
//!         bias: Vector3::zeros(),
//!         covariance: Covariance::new(1e-4, 1e-5),
//!     },
//! )?;
//! let end = rotation::from_vector(&Vector3::new(0.0, 0.0, 0.5));
//! let limits = TurnLimits { rate: 0.02, acceleration: 2e-3, jerk: 1e-3 };
//! let slew = Slew::new(0.0, start, end, &limits)?;
//! let inertia = Matrix3::from_diagonal(&Vector3::new(900.0, 800.0, 600.0));
//! let mut law = QuaternionFeedback::eigen_axis(0.5, 0.7, inertia)?;
//!
//! // The body turns about z only: its angle and rate, with the torque held.
//! let (mut angle, mut rate) = (0.0, 0.0);
//! let mut time = 0.0;
//! while time < slew.end() + 20.0 {
//!     let attitude = rotation::from_vector(&Vector3::new(0.0, 0.0, angle));
//!     filter.update(&star.measure(&attitude), 0)?;
//!     let sample = Sample::new(filter.motion(), slew.at(time));
//!     let acceleration = law.torque(&sample).z / inertia.m33;
//!     let turned = rate * PERIOD + 0.5 * acceleration * PERIOD * PERIOD;
//!     (angle, rate) = (angle + turned, rate + acceleration * PERIOD);
//!     time += PERIOD;
//!     filter.propagate(&gyro.measure(&Vector3::new(0.0, 0.0, turned / PERIOD)));
//! }
//! assert!((angle - 0.5).abs() < 1e-4 && rate.abs() < 1e-4);
//! # Ok::<(), precess_control::ControlError>(())
//! ```

#![no_std]

#[cfg(test)]
extern crate std;

extern crate alloc;

mod checkpoint;
mod estimator;
mod filter;
mod law;
mod linear;
mod model;
mod reference;
mod sensor;

pub use checkpoint::Checkpoint;
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
pub use linear::curve::LoopCurve;
pub use linear::feedback::Feedback;
pub use linear::held::{HeldPlant, held_step};
pub use linear::margins::{AtFrequency, AxisMargins, delay_margin, longest_delay};
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

pub use precess_tracker::{
    DragEstimate, DragSample, DragTracker, LineEstimate, LineTracker, TrackerError,
};
