//! `evaluate`: everything that a scenario's columns tell at the initial state.

use std::ops::ControlFlow;

use clap::Args;

use super::error::CommandError;
use super::exit::Exit;
use super::options::{Form, Set};
use super::table::{aligned, six};
use super::terminal::print;
use crate::engine::run;
use crate::file::from_file;
use crate::record::{Columns, Samples};

/// The options of `evaluate`.
#[derive(Debug, Args)]
pub(super) struct Evaluate {
    /// The scenario file.
    file: std::path::PathBuf,
    #[command(flatten)]
    overrides: Set,
    /// How the values are printed.
    #[arg(long, value_enum, default_value_t)]
    format: Form,
}

impl Evaluate {
    pub(super) fn execute(&self) -> Result<Exit, CommandError> {
        let (mut scenario, _) =
            from_file(&self.file, &self.overrides.overrides()).map_err(|errors| {
                match self.format {
                    Form::Text => CommandError::Scenario(errors),
                    Form::Json => CommandError::ScenarioJson(errors),
                }
            })?;
        let all = Columns::all(&scenario);
        scenario.output.columns = all.as_slice().iter().map(|c| c.name.clone()).collect();
        // One sample at the start, and one where the run is cancelled: after the first step.
        scenario.output.rate = 1.0 / scenario.settings.duration;
        let mut samples = Samples::default();
        let name = scenario.name.clone();
        run(&scenario, &mut samples, &mut |_| ControlFlow::Break(()))
            .map_err(|source| CommandError::Run { name, source })?;
        let columns = samples.header.iter().flat_map(|header| &header.columns);
        let first = samples.rows.iter().take(1).flatten();
        let of_interest = columns.zip(first).filter(|(column, _)| column.name != "time");
        if self.format == Form::Json {
            let object: serde_json::Map<_, _> = of_interest
                .map(|(column, value)| {
                    let entry = serde_json::json!({
                        "value": value,
                        "unit": column.unit,
                        "frame": column.frame,
                        "meaning": column.meaning,
                    });
                    (column.name.clone(), entry)
                })
                .collect();
            let text = serde_json::to_string_pretty(&object).unwrap_or_default();
            print(&(text + "\n"))?;
            return Ok(Exit::Success);
        }
        let mut rows = Vec::new();
        let mut group = "";
        for (column, value) in of_interest {
            if column.group != group {
                group = &column.group;
                rows.push(vec![format!("\n{group}")]);
            }
            let frame =
                column.frame.as_ref().map_or_else(String::new, |frame| format!("in {frame}"));
            rows.push(vec![
                format!("  {}", column.name),
                six(*value),
                column.unit.to_owned(),
                frame,
            ]);
        }
        print(aligned(&rows).trim_start_matches('\n'))?;
        Ok(Exit::Success)
    }
}
