//! The page `docs/performance-derivatives.md`: what derivatives cost.

use std::error::Error;
use std::fs;
use std::path::Path;

use serde::{Deserialize, Serialize};
use serde_json::Value;
use tera::{Context, Tera};

use crate::contender::{Contender, Missing};
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

/// Writes the spacecraft of each case, as `write_derivatives` of the peers.
pub(crate) fn write_cases(folder: &Path) -> Result<(), Box<dyn Error>> {
    let stored: Stored = serde_json::from_str(&fs::read_to_string(STORED)?)?;
    for case in DERIVATIVES {
        let of = stored.of_devices(case.parse()?);
        let of = of.ok_or_else(|| format!("{STORED} has no spacecraft of {case} devices"))?;
        let path = Subject::Derivatives.file(folder, case);
        if let Some(folder) = path.parent() {
            fs::create_dir_all(folder)?;
        }
        // What the peers were generated of stays, whoever wrote it.
        let there = fs::read_to_string(&path).ok();
        let there = there.and_then(|text| serde_json::from_str::<Value>(&text).ok());
        if there.as_ref() != Some(&of) {
            fs::write(path, of.to_string())?;
        }
    }
    Ok(())
}

impl Stored {
    /// The first one of so many devices; where none has so many, the one with most and the devices of all of declared
    /// ranges in turn.
    fn of_devices(&self, count: usize) -> Option<Value> {
        let devices = |of: &Value| of["devices"].as_array().cloned().unwrap_or_default();
        if let Some(of) = self.spacecraft.iter().find(|of| devices(of).len() == count) {
            return Some(of.clone());
        }
        let declared = || self.spacecraft.iter().filter(|of| of["scales"] == "declared");
        // Of equal ones the first.
        let mut largest = declared().rev().max_by_key(|of| devices(of).len())?.clone();
        let all: Vec<_> = declared().flat_map(devices).collect();
        largest["devices"] = all.into_iter().cycle().take(count).collect();
        Some(largest)
    }
}

/// What the page is made of.
pub(crate) struct Page {
    pub(crate) plan: Plan,
    pub(crate) machine: Machine,
    pub(crate) contenders: Vec<Contender>,
    pub(crate) missing: Vec<Missing>,
    /// The worst deviation of each contender, by name.
    pub(crate) worst: Vec<(String, f64)>,
    pub(crate) times: Times,
}

/// A peer, as the page describes it.
#[derive(Serialize)]
struct Peer<'a> {
    name: &'a str,
    note: &'a str,
    agrees: String,
    /// Its time in units of that of [`OURS`], for each number of devices.
    longer: Vec<String>,
}

/// A service: its time for each number of devices, and that in units of what it differentiates.
#[derive(Serialize)]
struct ServiceRow {
    title: String,
    cells: Vec<String>,
}

impl Page {
    /// The file, by name.
    pub(crate) fn files(&self) -> Result<Vec<(&'static str, String)>, Box<dyn Error>> {
        let peers = || self.contenders.iter().filter(|who| !who.is_ours());
        let mut rows: Vec<_> =
            SERVICES.into_iter().filter_map(|service| self.row(service)).collect();
        rows.extend(
            peers().filter_map(|peer| self.compared(peer.name.clone(), peer, "evaluation")),
        );
        let described: Vec<_> = peers()
            .map(|peer| {
                let worst = self.worst.iter().find(|(name, _)| *name == peer.name);
                let agrees = worst.map_or("-".to_owned(), |(_, worst)| format!("{worst:.1e}"));
                Peer { name: &peer.name, note: &peer.note, agrees, longer: self.longer(peer) }
            })
            .collect();
        let ours = self.worst.iter().find(|(name, _)| name.contains("linearize`"));
        for ServiceRow { title, cells } in &rows {
            println!("{title:60} {}", cells.join("  "));
        }
        let mut context = Context::new();
        context.insert("machine", &self.machine);
        context.insert("rounds", &self.plan.rounds);
        context.insert("rows", &rows);
        context.insert("peers", &described);
        context.insert("missing", &self.missing);
        context.insert("agrees", &ours.map(|(_, worst)| format!("{worst:.1e}")));
        let mut tera = Tera::default();
        tera.autoescape_on(Vec::<&str>::new());
        tera.add_raw_template("page", include_str!("derivatives.md.tera"))?;
        Ok(vec![("performance-derivatives.md", tera.render("page", &context)?)])
    }

    /// How many times longer a peer takes than we.
    fn longer(&self, peer: &Contender) -> Vec<String> {
        let ours = self.contenders.iter().find(|who| who.serves(OURS));
        let ratio = |case| self.times.ratio((peer, case), (ours?, case));
        let text = |case| ratio(case).map_or("-".to_owned(), |of| of_unit(of.value));
        DERIVATIVES.map(text).into()
    }

    fn row(&self, [name, unit, title]: [&'static str; 3]) -> Option<ServiceRow> {
        let who = self.contenders.iter().find(|who| who.serves(name))?;
        self.compared(title.to_owned(), who, unit)
    }

    /// Someone's times, and their ratios to those of a service.
    fn compared(&self, title: String, who: &Contender, unit: &str) -> Option<ServiceRow> {
        let unit = self.contenders.iter().find(|who| who.serves(unit))?;
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

/// The service that peers are compared with: it writes into matrices that are kept, as they do.
const OURS: &str = "linearized-into";

/// Service, what its time is compared with, and its title.
const SERVICES: [[&str; 3]; 12] = [
    ["evaluation", "evaluation", "an evaluation"],
    ["derivatives", "evaluation", "`derivatives`: by states and inputs"],
    ["linearized-into", "evaluation", "`linearize_into`: by states and inputs, matrices kept"],
    ["linearized", "evaluation", "`linearize`: by states and inputs, matrices allocated"],
    [
        "acceleration-derivatives",
        "evaluation",
        "`acceleration_derivatives_into`: only of the accelerations, matrices kept",
    ],
    ["jvp", "evaluation", "`jvp`: along one direction"],
    ["vjp", "evaluation", "`vjp`: of one weighted sum"],
    ["differences", "evaluation", "central differences by the same variables"],
    ["by-parameters", "evaluation", "`parameter_derivatives`: by six parameters a device"],
    ["single-step", "single-step", "an RK4 step"],
    [
        "linearized-step",
        "single-step",
        "`linearize_step`: by states and inputs, matrices allocated",
    ],
    [
        "linearized-step-into",
        "single-step",
        "`linearize_step_into`: by states and inputs, matrices kept",
    ],
];
