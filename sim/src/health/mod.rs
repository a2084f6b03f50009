//! A benchmark of what `precess watch` finds, and others may: records of two spacecraft whose hardware changes, with what is true.
//!
//! ```text
//! case --truth (richer than what is watched), a change at a time--> readings --> CSV
//!                                                      \--watch, baselines--> alarms --score--> table, rates
//! ```
//!
//! The truth has imbalances, friction and inertia of its own, flexible bearings (of the bus), tones and noise of bearings, a flexible array,
//! noise of all sensors, and clocks of each sensor. The model that is watched is rigid, as data sheets have it. Everything is drawn
//! from one seed: the same bits on any host.
//!
//! | file | what |
//! |---|---|
//! | `case` | [`HealthCase`]: spacecraft, loop, fault and size |
//! | `fault` | [`Fault`]: eight, their sizes, what they change |
//! | `truth` | scenarios of a case |
//! | `recording` | readings of a run, and as CSV |
//! | `statistic` | features of blocks against their reference, for baselines |
//! | `spectrum_baseline`, `observer_baseline` | a threshold on amplitudes, an observer with balanced wheels |
//! | `alarm` | [`MethodAlarm`] |
//! | `methods` | alarms of the watch and of both baselines |
//! | `score` | delays, false alarms, names and sizes; rates over bounds |
//! | `error` | [`HealthError`] |

mod alarm;
mod case;
mod error;
mod fault;
mod methods;
mod observer_baseline;
mod recording;
mod score;
mod spectrum_baseline;
mod statistic;
#[cfg(test)]
mod tests;
mod truth;

pub use alarm::{Method, MethodAlarm};
pub use case::{HealthCase, Loop, Spacecraft, Timing, TrueChange};
pub use error::HealthError;
pub use fault::{Fault, Size};
pub use methods::{Examined, Examining, examine};
pub use recording::{Record, record};
pub use score::{CaseScore, RatePoint, alarms_from_csv, rates, score};
