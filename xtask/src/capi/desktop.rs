//! A run of the desktop tool, repeated by the library from the exported table: the same bits.

use std::process::Command;

use super::{COMPILERS, Host, is_there, printed};
use crate::run::{cargo, say};
use crate::skip::skip;

const SCENARIO: &str = "flight/capi/tests/desktop.toml";
const SOURCE: &[&str] = &["flight/capi/tests/desktop.c"];
/// The step of the scenario, s.
const STEP: &str = "0.001";

impl Host {
    /// Exports and runs the scenario by the tool; steps it again in C, from the table.
    pub(super) fn desktop(&self) -> Result<(), String> {
        let table = self.programs.join("desktop.table");
        let (table_text, out) = (table.to_string_lossy(), self.programs.to_string_lossy());
        // As the tests build it.
        let tool = ["run", "--quiet", "-p", "precess", "--"];
        let export = ["export", "table", SCENARIO, "--force", "--to", &table_text];
        cargo(&[&tool[..], &export].concat())?;
        let run = ["run", SCENARIO, "--no-report", "--force", "--out", &out];
        cargo(&[&tool[..], &run].concat())?;
        for compiler in &COMPILERS {
            if !is_there(compiler.name) {
                skip(&format!("the desktop's run by {}", compiler.name), compiler.install)?;
                continue;
            }
            let program = self.compile(compiler, "desktop", SOURCE, &["-O2"], true)?;
            let mut program = Command::new(program);
            program.arg(&table).arg(self.programs.join("desktop.csv")).arg(STEP);
            let output = printed(&mut program)?;
            say!("desktop and library, {}: {}", compiler.name, output.trim_end());
        }
        Ok(())
    }
}
