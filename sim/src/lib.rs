//! The desktop tool: a spacecraft's scenario file in, results and a report out.
//!
//! ```text
//! scenario file --file--> Scenario --engine--> samples --record--> CSV, NPZ, Parquet; MCAP
//!                                                    \--report--> page and figures
//! ```
//!
//! A [`scenario::Scenario`] is read from TOML ([`mod@file`]) or built by a program, run by [`engine::run`]
//! into any [`record::Recorder`], and shown by [`report::Report`]; [`evaluation`] evaluates its spacecraft
//! at any state. The commands are in [`command`].
//! [`spectra`] and [`pointing`] are of any sampled signal, recorded or measured.
//!
//! Commands and reports are behind the feature `tool`, which is on by default: a program that reads scenarios and
//! runs them builds a third less without it.
//!
//! ```
//! use std::ops::ControlFlow;
//! use std::path::Path;
//!
//! use precess::record::Decimate;
//!
//! let text = r#"
//! format = 1
//! [hub]
//! mass = "350 kg"
//! inertia = "80, 70, 60 kg m^2"
//! [[device]]
//! name = "wheel1"
//! kind = "reaction_wheel"
//! mount = { spin_axis = [0, 0, 1] }
//! imbalance = { static = "1 g cm", dynamic = "20 g cm^2" }
//! [device.wheel]
//! mass = "4 kg"
//! inertia = "288, 150, 150 kg cm^2"
//! rate = "3000 rpm"
//! [run]
//! duration = "0.1 s"
//! [output]
//! rate = "1 kHz"
//! "#;
//! let (scenario, _) = precess::file::from_toml("wheel", text, Path::new(""))?;
//! let mut buckets = Decimate::new(100);
//! let outcome = precess::engine::run(&scenario, &mut buckets, &mut |_| ControlFlow::Continue(()))?;
//! assert!(outcome.drift.energy.is_some_and(|drift| drift < 1e-9));
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

pub mod campaign;
#[cfg(feature = "tool")]
pub mod command;
pub mod control;
pub mod disturbance;
pub mod engine;
pub mod evaluation;
pub mod file;
pub mod fit;
pub mod fmu;
pub mod health;
pub mod identify;
pub mod jitter;
pub mod margins;
#[cfg(feature = "mcap")]
pub mod mcap;
mod names;
mod nearest;
mod opened;
pub mod pointing;
pub mod record;
#[cfg(feature = "tool")]
pub mod report;
pub mod scenario;
#[cfg(any(feature = "tool", feature = "mcap"))]
mod shapes;
pub mod spectra;
pub mod structure;
pub mod tables;
pub mod telemetry;
pub mod units;
pub mod variation;
pub mod watch;
