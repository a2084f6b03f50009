//! Who is measured: services of Precess, and peers.

use std::path::Path;

use serde::Deserialize;

use crate::program::{Program, Turns};
use crate::subject::Subject;

/// A service or a peer.
#[derive(Clone, Debug)]
pub(crate) struct Contender {
    /// What it is called.
    pub(crate) name: String,
    /// Version, compiler, flags.
    pub(crate) note: String,
    pub(crate) subject: Subject,
    program: Program,
    /// What follows the file on its command line.
    options: Vec<String>,
    /// The cases that it can do; all, where nothing is said.
    cases: Option<Vec<String>>,
    /// The service of `measure` that it is.
    pub(crate) service: Option<Service>,
}

/// A service of Precess.
#[derive(Clone, Debug, Deserialize)]
pub(crate) struct Service {
    /// As `measure` knows it.
    pub(crate) name: String,
    title: String,
    subject: Subject,
    /// The row of the issue floor that bounds it.
    pub(crate) floor: Option<String>,
    /// How many it runs on.
    pub(crate) threads: usize,
}

/// Peers that are there, and others.
pub(crate) struct Peers {
    pub(crate) present: Vec<Contender>,
    pub(crate) missing: Vec<Missing>,
}

/// A peer that is not there: why, and what installs it.
#[derive(Clone, Debug, Deserialize, serde::Serialize)]
pub(crate) struct Missing {
    pub(crate) name: String,
    pub(crate) missing: String,
}

/// An entry of `peers.json`.
#[derive(Deserialize)]
#[serde(untagged)]
enum Entry {
    Present {
        name: String,
        subject: Subject,
        cases: Vec<String>,
        command: Vec<String>,
        #[serde(default)]
        options: Vec<String>,
        note: String,
    },
    Missing(Missing),
}

impl Contender {
    /// Runs it on a case.
    pub(crate) fn query<T: serde::de::DeserializeOwned>(
        &self,
        what: &str,
        folder: &Path,
        case: &str,
    ) -> Result<T, String> {
        self.program.query(&self.words(what, folder, case))
    }

    /// Starts it on a case, for turns.
    pub(crate) fn start(&self, folder: &Path, case: &str) -> Result<Turns, String> {
        match self.subject {
            Subject::Floor => self.program.start(&self.options),
            _ => self.program.start(&self.words("turns", folder, case)),
        }
    }

    fn words(&self, what: &str, folder: &Path, case: &str) -> Vec<String> {
        let file = self.subject.file(folder, case).display().to_string();
        [&[what.to_owned(), file], &self.options[..]].concat()
    }

    /// Whether it can do a case.
    pub(crate) fn takes(&self, case: &str) -> bool {
        self.cases.as_ref().is_none_or(|cases| cases.iter().any(|own| own == case))
    }

    /// Whether it is a service of this name.
    pub(crate) fn serves(&self, name: &str) -> bool {
        self.service.as_ref().is_some_and(|service| service.name == name)
    }

    /// Whether it is Precess: a service, or its C library.
    pub(crate) fn is_ours(&self) -> bool {
        self.service.is_some() || self.name.starts_with("Precess")
    }
}

/// The services of a program; those on several threads are not pinned.
pub(crate) fn services(path: &Path, pinned: &[String]) -> Result<Vec<Contender>, String> {
    let (one_core, any) = (Program::new(path, pinned), Program::new(path, &[]));
    let services: Vec<Service> = any.query(&["services".to_owned()])?;
    let contender = |service: Service| Contender {
        name: service.title.clone(),
        note: String::new(),
        subject: service.subject,
        program: if service.threads > 1 { any.clone() } else { one_core.clone() },
        options: vec!["--service".to_owned(), service.name.clone()],
        cases: None,
        service: Some(service),
    };
    Ok(services.into_iter().map(contender).collect())
}

/// The rows of the issue floor that bound services: timed in turns with them.
pub(crate) fn floors(measure: &Program, services: &[Contender]) -> Vec<Contender> {
    let mut rows: Vec<_> =
        services.iter().filter_map(|own| own.service.as_ref()?.floor.clone()).collect();
    rows.sort();
    rows.dedup();
    let contender = |row: String| Contender {
        name: row.clone(),
        note: String::new(),
        subject: Subject::Floor,
        program: measure.clone(),
        options: vec!["floor-turns".to_owned(), row],
        cases: None,
        service: None,
    };
    rows.into_iter().map(contender).collect()
}

/// The peers that `tests/peers/setup.py` found.
pub(crate) fn peers(folder: &Path, pinned: &[String]) -> Result<Peers, String> {
    let path = folder.join("peers.json");
    let wrong = |error: &dyn std::fmt::Display| format!("{}: {error}", path.display());
    let text = std::fs::read_to_string(&path).map_err(|error| wrong(&error))?;
    let entries: Vec<Entry> = serde_json::from_str(&text).map_err(|error| wrong(&error))?;
    let mut peers = Peers { present: Vec::new(), missing: Vec::new() };
    for entry in entries {
        match entry {
            Entry::Missing(missing) => peers.missing.push(missing),
            Entry::Present { name, subject, cases, command, options, note } => {
                peers.present.push(Contender {
                    name,
                    note,
                    subject,
                    program: Program::with_arguments(&command, pinned),
                    options,
                    cases: Some(cases),
                    service: None,
                });
            }
        }
    }
    Ok(peers)
}
