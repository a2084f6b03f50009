//! [`EngineFmu`]: a scenario as a functional mock-up unit that runs the simulator's engine, for what cannot be C sources:
//! platforms, flexible structures, controllers and the rest of what a run has.
//!
//! Its library is linked from the C of [`EngineFmu::sources`] and the static library of the package `precess-fmu`. It takes
//! the steps itself: Co-Simulation alone. Outputs are the columns that the scenario records.

use std::fmt::Write as _;

use sha2::{Digest as _, Sha256};

use super::error::FmuError;
use super::layout::Layout;
use super::model::number;
use super::names::{Names, identifier};
use super::variables::{Role, Variable, hub_inputs, motor};
use super::{FmiVersion, fmi2, fmi3, sources, token, xml};
use crate::engine::{driven_by_program, hub_input_count};
use crate::record::Columns;
use crate::scenario::{ControlLaw, IntegratorChoice, Scenario};
use crate::units::Plain;

/// A unit that the engine runs.
#[derive(Clone, Debug)]
pub struct EngineFmu {
    name: String,
    notes: Vec<String>,
    outputs: usize,
    inputs: usize,
    variables: Vec<Variable>,
    description: xml::Header,
    /// The scenario with every default.
    scenario: String,
}

impl EngineFmu {
    /// The unit of a checked scenario that was read from a file.
    ///
    /// # Errors
    ///
    /// [`FmuError`] with the name of a controller that is another program; of a scenario with a tolerance; of a column that it
    /// has not.
    pub fn new(scenario: &Scenario) -> Result<Self, FmuError> {
        let IntegratorChoice::Rk4 { step } = scenario.settings.integrator else {
            return Err(FmuError::Tolerance);
        };
        let program =
            |of: &&crate::scenario::SampledController| matches!(of.law, ControlLaw::Program { .. });
        if let Some(of) = scenario.controllers.iter().find(program) {
            return Err(FmuError::Program(of.name.clone()));
        }
        let columns = Columns::from_scenario(scenario)
            .map_err(|error| FmuError::Column(error.to_string()))?;
        let mut names = Names::default();
        let mut variables = Vec::new();
        for (place, column) in columns.as_slice().iter().enumerate() {
            let name = match column.name.split_once('.') {
                Some((device, what)) => names.of_device(device, &what.replace('.', "_")),
                None => names.of_hub(&column.name),
            };
            let frame = column.frame.as_ref();
            let frame = frame.map_or_else(String::new, |frame| format!(", expressed in {frame}"));
            let (unit, shown) = unit(column.unit);
            variables.push(Variable {
                name,
                place,
                role: if place == 0 { Role::Independent } else { Role::Output },
                unit,
                shown,
                start: 0.0,
                meaning: column.meaning.clone() + &frame,
            });
        }
        let outputs = variables.len() - 1;
        let layout = Layout::new(scenario);
        let first = variables.len();
        let joints = driven_by_program(scenario);
        let on_hub = hub_input_count(scenario);
        for of in hub_inputs(scenario, &layout, &mut names).into_iter().take(on_hub) {
            let place = first + of.place - layout.input(0);
            variables.push(Variable { place, ..of });
        }
        let mut notes = Vec::new();
        for (index, number) in joints.iter().enumerate() {
            let Some(((_, device, info), drive)) =
                scenario.joints().zip(&scenario.drives).nth(*number)
            else {
                continue;
            };
            let Some(profile) = drive.profile() else { continue };
            if !profile.is_constant() {
                notes.push(format!(
                    "the scenario varies {device}.{} with time; in the unit it is an input that starts at its value at 0 s",
                    info.motor
                ));
            }
            if let Some(change) = scenario.changes.iter().find(|change| change.joint == *number) {
                notes.push(format!(
                    "the scenario changes the drive of {device}.{} at {} s: from then on the input {} does not act",
                    info.coordinate,
                    Plain(change.time),
                    info.motor
                ));
            }
            let place = first + on_hub + index;
            variables.extend(motor((device, info), drive, place, &mut names));
        }
        Ok(Self {
            name: identifier(&scenario.name),
            notes,
            outputs,
            inputs: on_hub + joints.len(),
            variables,
            description: xml::Header::new(scenario, &layout, step),
            scenario: scenario.source.filled.clone(),
        })
    }

    /// The name of the unit's library: at most 55 characters of `[A-Za-z0-9_]`.
    #[must_use]
    pub fn name(&self) -> &str {
        &self.name
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

    /// `modelDescription.xml` of a version.
    #[must_use]
    pub fn description(&self, version: FmiVersion) -> String {
        self.described(version, &self.token(version))
    }

    /// The C files of a version that are linked with the engine, by their names.
    #[must_use]
    pub fn sources(&self, version: FmiVersion) -> Vec<(String, String)> {
        let mut files = sources::of_engine(version);
        files.push(("model.h".to_owned(), self.header(&self.token(version))));
        files.push(("model.c".to_owned(), self.model()));
        files.sort();
        files
    }

    /// A digest of the description and the scenario.
    fn token(&self, version: FmiVersion) -> String {
        let mut digest = Sha256::new();
        for text in [&self.described(version, ""), &self.scenario] {
            digest.update(text.as_bytes());
            digest.update([0]);
        }
        token(&digest.finalize())
    }

    fn described(&self, version: FmiVersion, token: &str) -> String {
        let contents = xml::Contents {
            identifier: &self.name,
            token,
            sources: &[],
            variables: &self.variables,
            is_run: true,
        };
        match version {
            FmiVersion::Two => fmi2::description(&self.description, &contents),
            FmiVersion::Three => fmi3::description(&self.description, &contents),
        }
    }

    fn header(&self, token: &str) -> String {
        let Self { outputs, inputs, .. } = self;
        format!(
            "/* Written by `precess export fmu`: sizes. */\n\n#ifndef MODEL_H\n#define MODEL_H\n\n\
             #define FMU_OUTPUTS {outputs}\n#define FMU_INPUTS {inputs}\n#define FMU_TOKEN \"{token}\"\n\n#endif\n"
        )
    }

    /// `model.c`: values at the start, and the scenario.
    fn model(&self) -> String {
        let mut start = vec![0.0; 1 + self.outputs + self.inputs];
        for variable in &self.variables {
            if let Some(value) = start.get_mut(variable.place) {
                *value = variable.start;
            }
        }
        let start: Vec<_> = start.into_iter().map(number).collect();
        let nominal = vec!["1.0"; self.outputs];
        let mut text = format!(
            "/* Written by `precess export fmu`: values at the start, and the scenario. */\n\n#include <float.h>\n\n\
             #include \"precess_fmu.h\"\n\nconst double precess_fmu_start[FMU_VALUES] = {{\n    {}\n}};\n\n\
             const double precess_fmu_nominal[FMU_STATES] = {{\n    {}\n}};\n\n\
             const size_t precess_fmu_scenario_size = {};\n\nconst unsigned char precess_fmu_scenario[] = {{",
            start.join(",\n    "),
            nominal.join(", "),
            self.scenario.len(),
        );
        for (index, byte) in self.scenario.bytes().enumerate() {
            // Writing into a text does not fail.
            let _ = write!(text, "{}{byte},", if index % 20 == 0 { "\n    " } else { " " });
        }
        text.push_str("\n    0\n};\n");
        text
    }
}

/// The name in a description of a column's unit, empty where the standard's units have none; and what it is shown in.
fn unit(of_column: &str) -> (&'static str, Option<&'static str>) {
    match of_column {
        "s" => ("s", None),
        "m" => ("m", None),
        "m/s" => ("m/s", None),
        "m/s²" => ("m/s2", None),
        "1" => ("1", None),
        "1/s" => ("1/s", None),
        "rad" => ("rad", Some("deg")),
        "rad/s" => ("rad/s", Some("deg/s")),
        "rad/s²" => ("rad/s2", None),
        "N" => ("N", None),
        "N m" => ("N.m", None),
        "J" => ("J", None),
        "kg m/s" => ("kg.m/s", None),
        "kg m²/s" => ("kg.m2/s", None),
        _ => ("", None),
    }
}
