//! `compare`: the differences of two results, of the results in two folders, or of the runs of two
//! scenario files, which are run first, into a temporary folder.

mod difference;
mod tolerance;

use std::fmt::Write as _;
use std::path::{Path, PathBuf};

use clap::Args;

use super::error::CommandError;
use super::exit::Exit;
use super::options::{Form, Set};
use super::outputs::files;
use super::progress::{interrupted, watch_interrupts, with_progress};
use super::table::{aligned, six};
use super::terminal::{note, print};
use crate::file::from_file;
use crate::record::Csv;
use difference::{Differences, differences};
use tolerance::Tolerance;

pub(super) const HELP: &str = "\
Examples:
  precess compare a/bus.csv b/bus.csv
      every column that is not the same to the last bit differs
  precess compare a b --tolerance 1e-9 --tolerance mount.force='1 uN'
      results of two folders, to 1e-9 of the largest value of each column or vector, or a micronewton

Columns or results that only one of both has differ, too.";

/// A heading and two results, or scenario files.
type Pair = (String, [PathBuf; 2]);

/// The options of `compare`.
#[derive(Debug, Args)]
pub(super) struct Compare {
    /// A result (CSV), a folder of results, or a scenario file.
    a: PathBuf,
    /// What it is compared with.
    b: PathBuf,
    #[command(flatten)]
    overrides: Set,
    /// Difference that is no difference: a share of the largest value of a column or its vector, 1e-9, or a quantity of a
    /// column or vector, omega='1e-12 rad/s'; may be repeated. Without it every bit counts.
    #[arg(long, value_name = "TOLERANCE", value_parser = Tolerance::parse)]
    tolerance: Vec<Tolerance>,
    /// How the differences are printed.
    #[arg(long, value_enum, default_value_t)]
    format: Form,
}

impl Compare {
    pub(super) fn execute(&self) -> Result<Exit, CommandError> {
        watch_interrupts();
        let folder = tempfile::tempdir()
            .map_err(|source| CommandError::Io { path: std::env::temp_dir(), source })?;
        let mut entries = Vec::new();
        let (pairs, mut differ) = self.pairs()?;
        for (name, [a, b]) in pairs {
            let a = self.result(&a, &folder.path().join("a.csv"))?;
            let b = self.result(&b, &folder.path().join("b.csv"))?;
            let mut found = differences(&a, &b)?;
            Tolerance::mark(&self.tolerance, &mut found)?;
            differ |= found.any();
            match self.format {
                Form::Json => entries.push(json(&name, &found)),
                Form::Text => print(&shown(&name, &found))?,
            }
        }
        if self.format == Form::Json {
            print(&(serde_json::to_string_pretty(&entries).unwrap_or_default() + "\n"))?;
        }
        Ok(if differ { Exit::Violated } else { Exit::Success })
    }

    /// What is compared with what, each with a heading, none for a single pair; whether only one folder has a result.
    fn pairs(&self) -> Result<(Vec<Pair>, bool), CommandError> {
        let folders = [&self.a, &self.b].map(|path| path.is_dir());
        if folders == [false; 2] {
            return Ok((vec![(String::new(), [self.a.clone(), self.b.clone()])], false));
        }
        if folders != [true; 2] {
            let message = "one is a folder and the other is not; compare two folders, or two files";
            return Err(CommandError::Other(message.to_owned()));
        }
        let [a, b] = [files(&self.a, "csv")?, files(&self.b, "csv")?];
        for (only, folder) in [(a.difference(&b), &self.a), (b.difference(&a), &self.b)] {
            only.for_each(|name| note(&format!("only in {}: {name}", folder.display())));
        }
        let both: Vec<_> = a.intersection(&b).collect();
        if both.is_empty() {
            let [a, b] = [self.a.display(), self.b.display()];
            let message = format!("no result (CSV) is both in {a} and in {b}");
            return Err(CommandError::Other(message));
        }
        let pair = |name: &String| (name.clone(), [self.a.join(name), self.b.join(name)]);
        Ok((both.into_iter().map(pair).collect(), a != b))
    }

    /// The CSV file of a result, or of the run of a scenario.
    fn result(&self, path: &Path, to: &Path) -> Result<PathBuf, CommandError> {
        if path.extension().is_none_or(|extension| extension != "toml") {
            return Ok(path.to_owned());
        }
        let (scenario, _) =
            from_file(path, &self.overrides.overrides()).map_err(CommandError::Scenario)?;
        let outcome = with_progress(&scenario, scenario.settings.duration, &mut Csv::new(to))?;
        if interrupted() {
            let message = "interrupted: nothing is compared with a shorter run".to_owned();
            return Err(CommandError::Other(message));
        }
        if !outcome.end.is_complete() {
            let message = format!("{}: at {} s {}", scenario.name, outcome.end_time, outcome.end);
            return Err(CommandError::Other(message));
        }
        Ok(to.to_owned())
    }
}

fn json(name: &str, found: &Differences) -> serde_json::Value {
    let columns = found.columns.iter().map(|d| {
        serde_json::json!({
            "column": d.name, "unit": d.unit, "peak": d.peak, "time": d.time,
            "rms": d.rms(found.samples), "largest": d.largest, "differs": d.differs,
        })
    });
    serde_json::json!({
        "result": name, "samples": found.samples, "differs": found.any(), "only": found.only,
        "columns": columns.collect::<Vec<_>>(),
    })
}

fn shown(name: &str, found: &Differences) -> String {
    let head = [
        "column",
        "peak difference",
        "at (s)",
        "RMS difference",
        "largest in the first",
        "in the second",
        "unit",
        "state",
    ];
    let mut rows = vec![head.map(str::to_owned).to_vec()];
    for d in &found.columns {
        rows.push(vec![
            d.name.clone(),
            six(d.peak),
            if d.peak == 0.0 { "-".to_owned() } else { six(d.time) },
            six(d.rms(found.samples)),
            six(d.largest[0]),
            six(d.largest[1]),
            d.unit.clone(),
            if d.differs {
                "differs"
            } else if d.peak == 0.0 {
                "same"
            } else {
                "within"
            }
            .to_owned(),
        ]);
    }
    let heading = if name.is_empty() { String::new() } else { format!("{name}\n") };
    let columns = found.columns.len();
    let mut text =
        format!("{heading}{}{} samples, {columns} columns in both", aligned(&rows), found.samples);
    let differing = found.columns.iter().filter(|d| d.differs).count();
    let _ = match differing {
        0 => writeln!(text, ", none differs"),
        count => writeln!(text, ", {count} differ"),
    };
    for (which, only) in ["first", "second"].into_iter().zip(&found.only) {
        if !only.is_empty() {
            let _ = writeln!(text, "only in the {which}: {}", only.join(", "));
        }
    }
    text
}
