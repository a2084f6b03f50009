//! [`Fmu`]: the spacecraft of a scenario as a functional mock-up unit of FMI 2.0 or 3.0, as sources, for Model Exchange
//! and Co-Simulation.
//!
//! ```text
//! Scenario --Fmu::new--> what its solver is derived from --precess-bake --general--> C files
//!                    \--> model.h, model.c, modelDescription.xml <--Fmu::files--/
//! ```
//!
//! The C between the standard's functions and the solver is in `c`, the same in every unit of a version; what a scenario
//! adds to it is numbers, in `model.c`. Versions differ in the names of functions, and in descriptions. A value reference is
//! a place in one array (`layout`). What the solver in C does not have is refused by name ([`FmuError`]); what the
//! importer is to give instead is [noted](Fmu::notes).
//!
//! Invariants: names of variables are unique, at most 55 characters of `[A-Za-z0-9_]`; the same scenario gives the same
//! bytes; every number is finite.

#[cfg(feature = "tool")]
mod archive;
mod dependencies;
mod engine;
mod error;
mod fmi2;
mod fmi3;
mod layout;
mod model;
mod names;
mod parameters;
mod refused;
mod sources;
mod units;
mod variables;
mod version;
mod xml;

use std::fmt::Write as _;

use precess_description::Description;
use precess_dynamics::HubMode;
use sha2::{Digest as _, Sha256};

#[cfg(feature = "tool")]
pub use archive::{archive, compiler_arguments, platform};
pub use engine::EngineFmu;
pub use error::FmuError;
pub use sources::headers;
pub use version::FmiVersion;

use crate::scenario::{Drive, IntegratorChoice, Profile, Scenario};
use layout::Layout;
use names::{Names, identifier};
use variables::{Variable, variables};

/// The name of the solver in file names and code: the same in every unit.
const SOLVER: &str = "satellite";

/// A unit of a scenario, before its solver is derived.
#[derive(Clone, Debug)]
pub struct Fmu {
    name: String,
    spacecraft: Description,
    notes: Vec<String>,
    layout: Layout,
    variables: Vec<Variable>,
    description: xml::Header,
    constants: model::Constants,
}

impl Fmu {
    /// The unit of a checked scenario.
    ///
    /// # Errors
    ///
    /// [`FmuError`] with the name of what the solver in C does not have.
    pub fn new(scenario: &Scenario) -> Result<Self, FmuError> {
        refused::check(scenario)?;
        let IntegratorChoice::Rk4 { step } = scenario.settings.integrator else {
            return Err(FmuError::Tolerance);
        };
        // What holds a hub or a joint is an input of the solver.
        let free = Scenario { hub_mode: HubMode::Free, ..scenario.clone() };
        let described = free.description(true)?;
        let spacecraft = Description { name: SOLVER.to_owned(), title: String::new(), ..described };
        let layout = Layout::new(scenario);
        let mut names = Names::default();
        let variables = variables(scenario, &layout, step, &mut names);
        Ok(Self {
            name: identifier(&scenario.name),
            spacecraft,
            notes: notes(scenario),
            description: xml::Header::new(scenario, &layout, step),
            constants: model::Constants::new(scenario, &layout),
            layout,
            variables,
        })
    }

    /// The name of the unit's functions and binaries: at most 55 characters of `[A-Za-z0-9_]`.
    #[must_use]
    pub fn name(&self) -> &str {
        &self.name
    }

    /// What `precess-bake --general` derives the solver from.
    #[must_use]
    pub fn spacecraft(&self) -> &Description {
        &self.spacecraft
    }

    /// What the importer has to do that the scenario does itself, in sentences.
    #[must_use]
    pub fn notes(&self) -> &[String] {
        &self.notes
    }

    /// How many variables it has.
    #[must_use]
    pub fn variable_count(&self) -> usize {
        self.variables.len()
    }

    /// The files of the unit of a version by their paths in it, in the order of the archive, from the files of its solver.
    /// What identifies the unit is a digest of them.
    #[must_use]
    pub fn files(&self, version: FmiVersion, solver: &[(String, String)]) -> Vec<(String, String)> {
        let unidentified = self.files_of(version, "", solver);
        let mut digest = Sha256::new();
        for (path, text) in &unidentified {
            digest.update(path.as_bytes());
            digest.update([0]);
            digest.update(text.as_bytes());
            digest.update([0]);
        }
        self.files_of(version, &token(&digest.finalize()), solver)
    }

    fn files_of(
        &self,
        version: FmiVersion,
        token: &str,
        solver: &[(String, String)],
    ) -> Vec<(String, String)> {
        let mut sources: Vec<(String, String)> = solver
            .iter()
            .filter(|(path, _)| sources::is_source(path))
            .cloned()
            .chain(sources::all(version))
            .collect();
        sources.push(("model.h".to_owned(), model::header(&self.layout, &self.constants, token)));
        let start = model::values(&self.layout, &self.constants, &self.variables);
        sources.push(("model.c".to_owned(), self.constants.source(&start)));
        sources.sort();
        let compiled: Vec<&str> = sources
            .iter()
            .map(|(path, _)| path.as_str())
            .filter(|path| sources::is_compiled(path))
            .collect();
        let identifier = self.name.as_str();
        let contents = xml::Contents {
            identifier,
            token,
            sources: &compiled,
            variables: &self.variables,
            is_run: false,
        };
        let (description, build) = match version {
            FmiVersion::Two => (fmi2::description(&self.description, &contents), None),
            FmiVersion::Three => (
                fmi3::description(&self.description, &contents),
                Some(fmi3::build_description(identifier, &compiled)),
            ),
        };
        sources.extend(build.map(|text| ("buildDescription.xml".to_owned(), text)));
        sources.sort();
        let sources = sources.into_iter().map(|(path, text)| (format!("sources/{path}"), text));
        std::iter::once(("modelDescription.xml".to_owned(), description)).chain(sources).collect()
    }
}

/// A digest as an identifier.
fn token(digest: &[u8]) -> String {
    let mut hexadecimal = String::new();
    for byte in digest.iter().take(16) {
        // Writing into a text does not fail.
        let _ = write!(hexadecimal, "{byte:02x}");
    }
    let (a, b) = hexadecimal.split_at(8);
    let (b, c) = b.split_at(4);
    let (c, d) = c.split_at(4);
    let (d, e) = d.split_at(4);
    format!("{{{a}-{b}-{c}-{d}-{e}}}")
}

/// What the importer has to give.
fn notes(scenario: &Scenario) -> Vec<String> {
    let mut notes = Vec::new();
    for ((_, name, info), drive) in scenario.joints().zip(&scenario.drives) {
        if drive.profile().is_some_and(|profile| !profile.is_constant()) {
            let what =
                if matches!(drive, Drive::Torque { .. }) { info.motor } else { info.acceleration };
            notes.push(format!(
                "the scenario varies {name}.{what} with time; in the unit it is an input that starts at its value at 0 s"
            ));
        }
    }
    for (number, wrench) in (1..).zip(&scenario.wrenches) {
        if !wrench.force.iter().chain(&wrench.moment).all(Profile::is_constant) {
            notes.push(format!(
                "the scenario varies wrench {number} with time; in the unit it is inputs that start at their values at 0 s"
            ));
        }
    }
    for crossing in scenario.crossings.iter().filter(|crossing| crossing.ends) {
        let name = &crossing.name;
        notes.push(format!("the scenario ends at the crossing `{name}`; the unit does not"));
    }
    notes
}
