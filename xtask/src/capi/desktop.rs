//! A run of the desktop tool, repeated by the library from the exported table: the same bits.

use std::process::Command;

use super::{COMPILERS, Host, is_there, printed};
use crate::run::{run, tool};
use crate::say;
use crate::skip::skip;

/// Scenarios, each with the version of its table.
const SCENARIOS: [(&str, &str); 4] =
    [("desktop", "1"), ("desktop-platform", "2"), ("desktop-stacked", "2"), ("desktop-rows", "2")];
const SOURCE: &[&str] = &["flight/capi/tests/desktop.c"];
/// The step of the scenarios, s.
const STEP: &str = "0.001";

impl Host {
    /// Exports and runs the scenarios by the tool; steps them again in C, from the tables.
    pub(super) fn desktop(&self) -> Result<(), String> {
        for (name, version) in SCENARIOS {
            self.repeat(name, version)?;
        }
        Ok(())
    }

    fn repeat(&self, name: &str, version: &str) -> Result<(), String> {
        let table = self.programs.join(format!("{name}.table"));
        let (table_text, out) = (table.to_string_lossy(), self.programs.to_string_lossy());
        let scenario = format!("flight/capi/tests/{name}.toml");
        let export = ["export", "table", &scenario, "--force", "--to", &table_text];
        run(Command::new(tool()?).args(export))?;
        let arguments = ["run", &scenario, "--no-report", "--force", "--out", &out];
        run(Command::new(tool()?).args(arguments))?;
        let options = ["-O2", &format!("-DPRECESS_TABLE_VERSION={version}")];
        for compiler in &COMPILERS {
            if !is_there(compiler.name) {
                skip(&format!("{name} by {}", compiler.name), compiler.install)?;
                continue;
            }
            let program = self.compile(compiler, name, SOURCE, &options, true)?;
            let mut program = Command::new(program);
            program.arg(&table).arg(self.programs.join(format!("{name}.csv"))).arg(STEP);
            let output = printed(&mut program)?;
            say!("{name} and library, {}: {}", compiler.name, output.trim_end());
        }
        Ok(())
    }
}
