//! The page `docs/performance-derivatives.md`: what derivatives cost.

use std::error::Error;
use std::fs;
use std::path::Path;

use serde::{Deserialize, Serialize};
use serde_json::Value;
use tera::{Context, Tera};

use crate::contender::Contender;
use crate::machine::Machine;
use crate::plan::{DERIVATIVES, Plan};
use crate::race::Times;
use crate::subject::Subject;
use crate::tables::{digits, of_unit};
use crate::verdict::WAITED;

/// Spacecraft in a state, with what engines make of them.
const STORED: &str = "tests/fixtures/engines.json";

#[derive(Deserialize)]
struct Stored {
    spacecraft: Vec<Value>,
}

/// Writes the spacecraft of each case: the first stored one of so many devices.
pub(crate) fn write_cases(folder: &Path) -> Result<(), Box<dyn Error>> {
    let stored: Stored = serde_json::from_str(&fs::read_to_string(STORED)?)?;
    for case in DERIVATIVES {
        let devices = |of: &&Value| of["devices"].as_array().map(Vec::len) == case.parse().ok();
        let of = stored.spacecraft.iter().find(devices);
        let of = of.ok_or_else(|| format!("{STORED} has no spacecraft of {case} devices"))?;
        let path = Subject::Derivatives.file(folder, case);
        if let Some(folder) = path.parent() {
            fs::create_dir_all(folder)?;
        }
        fs::write(path, of.to_string())?;
    }
    Ok(())
}

/// What the page is made of.
pub(crate) struct Page {
    pub(crate) plan: Plan,
    pub(crate) machine: Machine,
    pub(crate) contenders: Vec<Contender>,
    pub(crate) times: Times,
}

/// A service: its time for each number of devices, and that in units of what it differentiates.
#[derive(Serialize)]
struct ServiceRow {
    title: &'static str,
    cells: Vec<String>,
}

impl Page {
    /// The file, by name.
    pub(crate) fn files(&self) -> Result<Vec<(&'static str, String)>, Box<dyn Error>> {
        let rows: Vec<_> = SERVICES.into_iter().filter_map(|service| self.row(service)).collect();
        for ServiceRow { title, cells } in &rows {
            println!("{title:60} {}", cells.join("  "));
        }
        let mut context = Context::new();
        context.insert("machine", &self.machine);
        context.insert("rounds", &self.plan.rounds);
        context.insert("rows", &rows);
        let mut tera = Tera::default();
        tera.autoescape_on(Vec::<&str>::new());
        tera.add_raw_template("page", include_str!("derivatives.md.tera"))?;
        Ok(vec![("performance-derivatives.md", tera.render("page", &context)?)])
    }

    fn row(&self, [name, unit, title]: [&'static str; 3]) -> Option<ServiceRow> {
        let find = |name: &str| self.contenders.iter().find(|who| who.serves(name));
        let (who, unit) = (find(name)?, find(unit)?);
        let cells = DERIVATIVES.map(|case| {
            let Some(time) = self.times.of_contender(who, case) else { return "-".to_owned() };
            let waited = if time.waited < WAITED { "" } else { " †" };
            let ratio = self.times.ratio((who, case), (unit, case));
            let ratio = ratio.map_or("-".to_owned(), |of| of_unit(of.value));
            format!("{} ({ratio}, {:.0} %){waited}", digits(time.ns()), 100.0 * time.spread())
        });
        Some(ServiceRow { title, cells: cells.into() })
    }
}

/// Service, what its time is compared with, and its title.
const SERVICES: [[&str; 3]; 6] = [
    ["evaluation", "evaluation", "an evaluation"],
    ["linearized", "evaluation", "`linearize`: by states and inputs"],
    ["differences", "evaluation", "central differences by the same variables"],
    ["by-parameters", "evaluation", "`parameter_derivatives`: by six parameters a device"],
    ["single-step", "single-step", "an RK4 step"],
    ["linearized-step", "single-step", "`linearize_step`: by states and inputs"],
];
