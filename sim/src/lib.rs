//! The desktop tool: scenarios, runs and reports.
//!
//! A [`scenario::Scenario`] is run into a [`history::History`], whose [`ledger::Ledger`] shows how
//! far energy less work and both momenta drift. The command line adds data files, figures and a
//! report.
//!
//! ```
//! use precess::run::{Settings, run};
//! use precess::scenario::table1::{Drive, Imbalance, Variant};
//!
//! let scenario = Variant { imbalance: Imbalance::Printed, drive: Drive::Free }.scenario();
//! let settings = Settings { duration: 0.1, ..Settings::default() };
//! let history = run(&scenario, &settings, &mut |_| {})?;
//! assert!(history.ledger.drift().energy < 1e-12);
//! # Ok::<(), precess::error::RunError>(())
//! ```

pub mod bodies;
pub mod bound;
pub mod cli;
pub mod engine;
pub mod error;
pub mod file;
pub mod history;
mod integrator;
pub mod jitter;
pub mod ledger;
pub mod outcome;
pub mod output;
mod packing;
pub mod plan;
pub mod record;
pub mod report;
pub mod run;
pub mod scenario;
pub mod units;
