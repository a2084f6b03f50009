//! Names near to an unknown one, for errors.

/// Less alike than this, a name is no likely meaning.
const LIKENESS: f64 = 0.7;
/// More than this, a list is not read.
const MOST: usize = 3;

/// The names most like an unknown one, the most alike first.
pub(crate) fn nearest<N: AsRef<str>>(unknown: &str, names: impl Iterator<Item = N>) -> Vec<String> {
    let mut alike: Vec<(f64, N)> = names
        .map(|name| (strsim::jaro_winkler(unknown, name.as_ref()), name))
        .filter(|(likeness, _)| *likeness >= LIKENESS)
        .collect();
    alike.sort_by(|a, b| b.0.total_cmp(&a.0));
    let mut found: Vec<String> = Vec::new();
    for (_, name) in alike {
        let name = name.as_ref();
        if found.len() < MOST && !found.iter().any(|other| other == name) {
            found.push(name.to_owned());
        }
    }
    found
}
