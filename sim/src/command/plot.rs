//! `plot`: the figures of a run, as SVG files.

use std::path::PathBuf;
use std::process::ExitCode;

use clap::Args;

use super::error::CommandError;
use super::run::{may_write, read_all, watch_interrupts, with_progress, write_whole};
use super::{Files, print};
use crate::report::Report;

/// The options of `plot`.
#[derive(Debug, Args)]
pub(super) struct Plot {
    #[command(flatten)]
    files: Files,
    /// Folder for the figures; made if it is missing.
    #[arg(long, value_name = "FOLDER", default_value = "precess-out")]
    out: PathBuf,
    /// Replace figures that are there.
    #[arg(long)]
    force: bool,
}

impl Plot {
    pub(super) fn execute(&self) -> Result<ExitCode, CommandError> {
        watch_interrupts();
        for (scenario, _) in &read_all(&self.files)? {
            let mut report = Report::new(scenario, &[]);
            with_progress(scenario, &mut report)?;
            let figures = report.figures().map_err(|e| CommandError::Other(e.to_string()))?;
            let name = |of: &str| format!("{}-{of}.svg", scenario.name);
            let names: Vec<_> = figures.iter().map(|(of, _)| name(of)).collect();
            may_write(&self.out, &names, self.force)?;
            std::fs::create_dir_all(&self.out)
                .map_err(|source| CommandError::Io { path: self.out.clone(), source })?;
            for (of, svg) in &figures {
                let path = self.out.join(name(of));
                write_whole(&path, svg)?;
                print(&format!("{}\n", path.display()));
            }
        }
        Ok(ExitCode::SUCCESS)
    }
}
