//! On what the figures were measured.

use std::process::Command;

use serde::{Deserialize, Serialize};

use crate::program::Program;

/// CPU, compiler, core, and what the core can issue.
#[derive(Serialize)]
pub(crate) struct Machine {
    cpu: String,
    system: String,
    compiler: String,
    pinned: bool,
    /// GHz, where it can be had.
    ghz: Option<f64>,
    /// Operations per nanosecond.
    pub(crate) floor: Vec<Floor>,
}

/// What the core issues of one kind of instruction.
#[derive(Serialize, Deserialize)]
pub(crate) struct Floor {
    pub(crate) name: String,
    pub(crate) per_ns: f64,
}

#[derive(Deserialize)]
struct Measured {
    floor: Vec<Floor>,
    ghz: Option<f64>,
}

impl Machine {
    /// Asks the machine.
    pub(crate) fn new(measure: &Program, pinned: &[String]) -> Result<Self, String> {
        let Measured { floor, ghz } = measure.query(&["floor".to_owned()])?;
        Ok(Self {
            cpu: cpu(),
            system: format!("{} on {}", std::env::consts::OS, std::env::consts::ARCH),
            compiler: first_line("rustc", &["--version"]),
            pinned: !pinned.is_empty(),
            ghz,
            floor,
        })
    }

    /// Operations per nanosecond of one row.
    pub(crate) fn per_ns(&self, name: &str) -> Option<f64> {
        self.floor.iter().find(|row| row.name == name).map(|row| row.per_ns)
    }
}

/// The model, as the system names it.
fn cpu() -> String {
    let info = std::fs::read_to_string("/proc/cpuinfo").unwrap_or_default();
    let model = info.lines().find_map(|line| line.strip_prefix("model name")?.split_once(": "));
    model.map_or_else(
        || first_line("sysctl", &["-n", "machdep.cpu.brand_string"]),
        |(_, model)| {
            let field = |name| {
                let line = info.lines().find_map(|line: &str| line.strip_prefix(name));
                line.and_then(|rest| Some(rest.split_once(": ")?.1.to_owned())).unwrap_or_default()
            };
            // A virtual machine may show only a family's name.
            format!("{model} (family {}, model {})", field("cpu family"), field("model\t"))
        },
    )
}

/// What a program says first; `unknown` where it cannot be run.
fn first_line(program: &str, arguments: &[&str]) -> String {
    let output = Command::new(program).args(arguments).output();
    let text = output.map(|output| String::from_utf8_lossy(&output.stdout).into_owned());
    text.ok().and_then(|text| Some(text.lines().next()?.to_owned())).unwrap_or("unknown".to_owned())
}
