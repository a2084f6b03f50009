//! Who is measured: services of Precess, and peers.

use std::path::Path;

use serde::Deserialize;

use crate::program::Program;

/// A service or a peer.
#[derive(Clone, Debug)]
pub(crate) struct Contender {
    /// What it is called.
    pub(crate) name: String,
    /// Version, compiler, flags.
    pub(crate) note: String,
    program: Program,
    /// What follows the file on its command line.
    options: Vec<String>,
    /// The numbers of devices that it can do; all, where nothing is said.
    pub(crate) counts: Option<Vec<usize>>,
    /// Whether its accelerations are compared.
    pub(crate) checked: bool,
    /// The service of Precess that it is, and the row of the issue floor that bounds it.
    pub(crate) service: Option<Service>,
}

/// A service of Precess.
#[derive(Clone, Debug, Deserialize)]
pub(crate) struct Service {
    /// As `measure` knows it.
    pub(crate) name: String,
    title: String,
    checked: bool,
    /// The row of the issue floor that bounds it.
    pub(crate) floor: String,
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
    Present { name: String, command: Vec<String>, n: Vec<usize>, note: String },
    Missing(Missing),
}

impl Contender {
    /// Runs it on a spacecraft.
    pub(crate) fn query<T: serde::de::DeserializeOwned>(
        &self,
        what: &str,
        file: &Path,
    ) -> Result<T, String> {
        let file = file.display().to_string();
        let options = self.options.iter().map(String::as_str);
        self.program.query(&[what, &file].into_iter().chain(options).collect::<Vec<_>>())
    }

    /// Whether it can do so many devices.
    pub(crate) fn takes(&self, count: usize) -> bool {
        self.counts.as_ref().is_none_or(|counts| counts.contains(&count))
    }

    /// Whether it is a service of this name.
    pub(crate) fn serves(&self, name: &str) -> bool {
        self.service.as_ref().is_some_and(|service| service.name == name)
    }
}

/// The services of Precess.
pub(crate) fn services(measure: &Program) -> Result<Vec<Contender>, String> {
    let services: Vec<Service> = measure.query(&["services"])?;
    Ok(services
        .into_iter()
        .map(|service| Contender {
            name: service.title.clone(),
            note: String::new(),
            program: measure.clone(),
            options: vec!["--service".to_owned(), service.name.clone()],
            counts: None,
            checked: service.checked,
            service: Some(service),
        })
        .collect())
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
            Entry::Present { name, command, n, note } => peers.present.push(Contender {
                name,
                note,
                program: Program::with_arguments(&command, pinned),
                options: Vec::new(),
                counts: Some(n),
                checked: true,
                service: None,
            }),
        }
    }
    Ok(peers)
}
